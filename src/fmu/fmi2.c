/* FMI 2.0 on a model. */
#include "model.h"

#include <fmi2Functions.h>
#include <stdlib.h>
#include <string.h>

void tell(model *m, int status, const char *text)
{
    fmi2CallbackLogger logger = (fmi2CallbackLogger)m->logger;
    static const char *const categories[] = {"", "logStatusWarning", "logStatusDiscard",
                                             "logStatusError"};
    if (logger)
        logger(m->environment, m->name, (fmi2Status)status, categories[status], "%s", text);
}

static int hexadecimal(char digit)
{
    const char *digits = "0123456789abcdef0123456789ABCDEF", *found = strchr(digits, digit);
    return digit && found ? (int)(found - digits) % 16 : -1;
}

/* The folder of an address as file:///opt/my%20unit, with a slash at its end; to be freed. */
static char *folder_of(const char *address)
{
    char *folder, *to;
    if (!address || strncmp(address, "file:", 5) != 0) return NULL;
    address += 5;
    if (strncmp(address, "//", 2) == 0) address = strchr(address + 2, '/');
    if (!address) return NULL;
    folder = to = malloc(strlen(address) + 2);
    if (!folder) return NULL;
    for (; *address; address++) {
        int high = *address == '%' ? hexadecimal(address[1]) : -1;
        int low = high >= 0 ? hexadecimal(address[2]) : -1;
        *to++ = low >= 0 ? (char)(16 * high + low) : *address;
        if (low >= 0) address += 2;
    }
    if (to == folder || to[-1] != '/') *to++ = '/';
    *to = '\0';
    return folder;
}

/* Making */

const char *fmi2GetTypesPlatform(void)
{
    return fmi2TypesPlatform;
}

const char *fmi2GetVersion(void)
{
    return fmi2Version;
}

fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean is_on, size_t n,
                               const fmi2String categories[])
{
    ((model *)c)->is_logging = is_on;
    return fmi2OK;
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

void fmi2FreeInstance(fmi2Component c)
{
    free_model(c);
}

fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean has_tolerance, fmi2Real tolerance,
                               fmi2Real start, fmi2Boolean has_stop, fmi2Real stop)
{
    ((model *)c)->now.time = start;
    return fmi2OK;
}

fmi2Status fmi2EnterInitializationMode(fmi2Component c)
{
    return fmi2OK;
}

fmi2Status fmi2ExitInitializationMode(fmi2Component c)
{
    return (fmi2Status)start_model(c);
}

fmi2Status fmi2Terminate(fmi2Component c)
{
    return fmi2OK;
}

fmi2Status fmi2Reset(fmi2Component c)
{
    reset_model(c);
    return fmi2OK;
}

/* Variables */

fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference of[], size_t n, fmi2Real to[])
{
    int status = STATUS_OK;
    for (size_t i = 0; i < n && status == STATUS_OK; i++) status = read_real(c, of[i], &to[i]);
    return (fmi2Status)status;
}

static fmi2Status get_int(model *m, const fmi2ValueReference of[], size_t n, enum kind kind,
                          int to[])
{
    const void *place;
    int status = STATUS_OK;
    for (size_t i = 0; i < n && status == STATUS_OK; i++) {
        status = read_variable(m, of[i], kind, &place);
        if (status == STATUS_OK) to[i] = *(const int *)place;
    }
    return (fmi2Status)status;
}

static fmi2Status set_numbers(model *m, const fmi2ValueReference of[], size_t n, enum kind kind,
                              const void *from, size_t size)
{
    int status = STATUS_OK;
    for (size_t i = 0; i < n && status == STATUS_OK; i++)
        status = write_variable(m, of[i], kind, (const char *)from + i * size);
    return (fmi2Status)status;
}

fmi2Status fmi2GetInteger(fmi2Component c, const fmi2ValueReference of[], size_t n,
                          fmi2Integer to[])
{
    return get_int(c, of, n, INTEGER, to);
}

fmi2Status fmi2GetBoolean(fmi2Component c, const fmi2ValueReference of[], size_t n,
                          fmi2Boolean to[])
{
    return get_int(c, of, n, BOOLEAN, to);
}

fmi2Status fmi2GetString(fmi2Component c, const fmi2ValueReference of[], size_t n, fmi2String to[])
{
    const void *place;
    int status = STATUS_OK;
    for (size_t i = 0; i < n && status == STATUS_OK; i++) {
        status = read_variable(c, of[i], STRING, &place);
        if (status == STATUS_OK) to[i] = place;
    }
    return (fmi2Status)status;
}

fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference of[], size_t n,
                       const fmi2Real from[])
{
    return set_numbers(c, of, n, REAL, from, sizeof *from);
}

fmi2Status fmi2SetInteger(fmi2Component c, const fmi2ValueReference of[], size_t n,
                          const fmi2Integer from[])
{
    return set_numbers(c, of, n, INTEGER, from, sizeof *from);
}

fmi2Status fmi2SetBoolean(fmi2Component c, const fmi2ValueReference of[], size_t n,
                          const fmi2Boolean from[])
{
    return set_numbers(c, of, n, BOOLEAN, from, sizeof *from);
}

fmi2Status fmi2SetString(fmi2Component c, const fmi2ValueReference of[], size_t n,
                         const fmi2String from[])
{
    int status = STATUS_OK;
    for (size_t i = 0; i < n && status == STATUS_OK; i++)
        status = write_variable(c, of[i], STRING, from[i]);
    return (fmi2Status)status;
}

/* States and derivatives */

fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate *state)
{
    return (fmi2Status)keep_state(c, state);
}

fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate state)
{
    return (fmi2Status)restore_state(c, state);
}

fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate *state)
{
    free_model(*state);
    *state = NULL;
    return fmi2OK;
}

fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate state, size_t *size)
{
    *size = state_size();
    return fmi2OK;
}

fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate state, fmi2Byte bytes[],
                                 size_t size)
{
    return (fmi2Status)write_state(c, state, bytes, size);
}

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

/* Model exchange: there are no states and no events. */

fmi2Status fmi2EnterEventMode(fmi2Component c)
{
    return fmi2OK;
}

fmi2Status fmi2NewDiscreteStates(fmi2Component c, fmi2EventInfo *info)
{
    memset(info, 0, sizeof *info);
    return fmi2OK;
}

fmi2Status fmi2EnterContinuousTimeMode(fmi2Component c)
{
    return fmi2OK;
}

fmi2Status fmi2CompletedIntegratorStep(fmi2Component c, fmi2Boolean is_final,
                                       fmi2Boolean *has_event, fmi2Boolean *is_over)
{
    *has_event = *is_over = fmi2False;
    return fmi2OK;
}

fmi2Status fmi2SetTime(fmi2Component c, fmi2Real time)
{
    ((model *)c)->now.time = time;
    return fmi2OK;
}

static fmi2Status none(model *m, size_t n)
{
    if (n == 0) return fmi2OK;
    tell(m, STATUS_ERROR, "there are no states, event indicators or derivatives by time");
    return fmi2Error;
}

fmi2Status fmi2SetContinuousStates(fmi2Component c, const fmi2Real x[], size_t n)
{
    return none(c, n);
}

fmi2Status fmi2GetDerivatives(fmi2Component c, fmi2Real derivatives[], size_t n)
{
    return none(c, n);
}

fmi2Status fmi2GetEventIndicators(fmi2Component c, fmi2Real indicators[], size_t n)
{
    return none(c, n);
}

fmi2Status fmi2GetContinuousStates(fmi2Component c, fmi2Real x[], size_t n)
{
    return none(c, n);
}

fmi2Status fmi2GetNominalsOfContinuousStates(fmi2Component c, fmi2Real nominals[], size_t n)
{
    return none(c, n);
}

/* Co-simulation: the outputs follow the inputs at once, so that a step is a solution. */

fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference of[], size_t n,
                                       const fmi2Integer order[], const fmi2Real value[])
{
    return none(c, n);
}

fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference of[], size_t n,
                                        const fmi2Integer order[], fmi2Real value[])
{
    return none(c, n);
}

fmi2Status fmi2DoStep(fmi2Component c, fmi2Real time, fmi2Real step, fmi2Boolean is_final)
{
    model *m = c;
    int status = solve_model(m);
    m->now.time = status == STATUS_OK ? time + step : time;
    return (fmi2Status)status;
}

static fmi2Status not_pending(model *m)
{
    tell(m, STATUS_DISCARD, "a step is never pending");
    return fmi2Discard;
}

fmi2Status fmi2CancelStep(fmi2Component c)
{
    tell(c, STATUS_ERROR, "a step is never pending");
    return fmi2Error;
}

fmi2Status fmi2GetStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Status *value)
{
    return not_pending(c);
}

fmi2Status fmi2GetRealStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Real *value)
{
    if (kind != fmi2LastSuccessfulTime) return not_pending(c);
    *value = ((model *)c)->now.time;
    return fmi2OK;
}

fmi2Status fmi2GetIntegerStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Integer *value)
{
    return not_pending(c);
}

fmi2Status fmi2GetBooleanStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Boolean *value)
{
    if (kind != fmi2Terminated) return not_pending(c);
    *value = fmi2False;
    return fmi2OK;
}

fmi2Status fmi2GetStringStatus(fmi2Component c, const fmi2StatusKind kind, fmi2String *value)
{
    return not_pending(c);
}
