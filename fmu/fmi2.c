/* FMI 2.0 on a model. */
#include "model.h"

#include <fmi2Functions.h>
#include <stdlib.h>
#include <string.h>

#define FMI(NAME) fmi2##NAME
#define OF_STATE(BEFORE, AFTER) fmi2##BEFORE##FMUstate##AFTER
#define N_VALUES
#include "both.h"

REALS(Real)
INTS(Integer, INTEGER)
NOTHING(EnterInitializationMode)
NO_NUMBERS(GetDerivatives, )

void tell(model *m, int status, const char *text)
{
    fmi2CallbackLogger logger = (fmi2CallbackLogger)m->logger;
    if (logger)
        logger(m->environment, m->name, (fmi2Status)status, categories[status], "%s", text);
}

const char *fmi2GetTypesPlatform(void)
{
    return fmi2TypesPlatform;
}

const char *fmi2GetVersion(void)
{
    return fmi2Version;
}

/* Making */

static int hexadecimal(char digit)
{
    const char *digits = "0123456789abcdef0123456789ABCDEF", *found = strchr(digits, digit);
    return digit && found ? (int)(found - digits) % 16 : -1;
}

/* The folder of an address as file:///opt/my%20unit; to be freed. */
static char *folder_of(const char *address)
{
    char *folder, *to;
    if (!address || strncmp(address, "file:", 5) != 0) return NULL;
    address += 5;
    if (strncmp(address, "//", 2) == 0) address = strchr(address + 2, '/');
    folder = to = address ? malloc(strlen(address) + 1) : NULL;
    if (!folder) return NULL;
    for (; *address; address++) {
        int high = *address == '%' ? hexadecimal(address[1]) : -1;
        int low = high >= 0 ? hexadecimal(address[2]) : -1;
        *to++ = low >= 0 ? (char)(16 * high + low) : *address;
        if (low >= 0) address += 2;
    }
    *to = '\0';
    return folder;
}

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String token,
                              fmi2String resources, const fmi2CallbackFunctions *functions,
                              fmi2Boolean is_visible, fmi2Boolean is_logging)
{
    char *folder = folder_of(resources);
    model *m = make_model(name, token, folder);
    free(folder);
    if (!m) return NULL;
    m->is_logging = is_logging;
    if (functions) {
        m->logger = (void (*)(void))functions->logger;
        m->environment = functions->componentEnvironment;
    }
    return m;
}

fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean has_tolerance, fmi2Real tolerance,
                               fmi2Real start, fmi2Boolean has_stop, fmi2Real stop)
{
    ((model *)c)->now.time = start;
    return fmi2OK;
}

/* States and derivatives */

fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte bytes[], size_t size,
                                   fmi2FMUstate *state)
{
    return (fmi2Status)read_state(c, bytes, size, state);
}

fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference unknown[],
                                        size_t n, const fmi2ValueReference known[], size_t k,
                                        const fmi2Real seeds[], fmi2Real derivatives[])
{
    return (fmi2Status)find_derivatives(c, unknown, n, known, k, seeds, derivatives);
}

#define NO_RATES(NAME, CONSTANT)                                                                  \
    fmi2Status fmi2##NAME(fmi2Component c, const fmi2ValueReference of[], size_t n,               \
                          const fmi2Integer orders[], CONSTANT fmi2Real x[])                      \
    {                                                                                             \
        return none(c, n);                                                                        \
    }
NO_RATES(SetRealInputDerivatives, const)
NO_RATES(GetRealOutputDerivatives, )

/* Steps and events */

fmi2Status fmi2NewDiscreteStates(fmi2Component c, fmi2EventInfo *info)
{
    memset(info, 0, sizeof *info);
    return fmi2OK;
}

fmi2Status fmi2DoStep(fmi2Component c, fmi2Real time, fmi2Real step, fmi2Boolean is_final)
{
    return take_step(c, time, step);
}

fmi2Status fmi2CancelStep(fmi2Component c)
{
    return none(c, 1);
}

/* After a step that was discarded. */
fmi2Status fmi2GetRealStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Real *value)
{
    *value = ((model *)c)->now.time;
    return kind == fmi2LastSuccessfulTime ? fmi2OK : fmi2Discard;
}

fmi2Status fmi2GetBooleanStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Boolean *value)
{
    *value = fmi2False;
    return kind == fmi2Terminated ? fmi2OK : fmi2Discard;
}

/* No step is ever pending. */
#define NO_STATUS(NAME, TYPE)                                                                     \
    fmi2Status fmi2##NAME(fmi2Component c, const fmi2StatusKind kind, TYPE *value)                \
    {                                                                                             \
        return fmi2Discard;                                                                       \
    }
NO_STATUS(GetStatus, fmi2Status)
NO_STATUS(GetIntegerStatus, fmi2Integer)
NO_STATUS(GetStringStatus, fmi2String)
