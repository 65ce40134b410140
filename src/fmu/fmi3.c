/* FMI 3.0 on a model. */
#include "model.h"

#include <fmi3Functions.h>
#include <stdlib.h>

void tell(model *m, int status, const char *text)
{
    fmi3LogMessageCallback logger = (fmi3LogMessageCallback)m->logger;
    static const char *const categories[] = {"", "logStatusWarning", "logStatusDiscard",
                                             "logStatusError"};
    if (logger) logger(m->environment, (fmi3Status)status, categories[status], text);
}

/* Making */

const char *fmi3GetVersion(void)
{
    return fmi3Version;
}

fmi3Status fmi3SetDebugLogging(fmi3Instance c, fmi3Boolean is_on, size_t n,
                               const fmi3String categories[])
{
    ((model *)c)->is_logging = is_on;
    return fmi3OK;
}

fmi3Instance fmi3InstantiateModelExchange(fmi3String name, fmi3String token, fmi3String resources,
                                          fmi3Boolean is_visible, fmi3Boolean is_logging,
                                          fmi3InstanceEnvironment environment,
                                          fmi3LogMessageCallback log)
{
    model *m = make_model(name, token, resources);
    if (!m) return NULL;
    m->is_logging = is_logging;
    m->logger = (void (*)(void))log;
    m->environment = environment;
    return m;
}

fmi3Instance fmi3InstantiateCoSimulation(fmi3String name, fmi3String token, fmi3String resources,
                                         fmi3Boolean is_visible, fmi3Boolean is_logging,
                                         fmi3Boolean has_events, fmi3Boolean may_return_early,
                                         const fmi3ValueReference intermediate[], size_t n,
                                         fmi3InstanceEnvironment environment,
                                         fmi3LogMessageCallback log,
                                         fmi3IntermediateUpdateCallback update)
{
    return fmi3InstantiateModelExchange(name, token, resources, is_visible, is_logging,
                                        environment, log);
}

fmi3Instance fmi3InstantiateScheduledExecution(fmi3String name, fmi3String token,
                                               fmi3String resources, fmi3Boolean is_visible,
                                               fmi3Boolean is_logging,
                                               fmi3InstanceEnvironment environment,
                                               fmi3LogMessageCallback log,
                                               fmi3ClockUpdateCallback update,
                                               fmi3LockPreemptionCallback lock,
                                               fmi3UnlockPreemptionCallback unlock)
{
    return NULL;
}

void fmi3FreeInstance(fmi3Instance c)
{
    free_model(c);
}

fmi3Status fmi3EnterInitializationMode(fmi3Instance c, fmi3Boolean has_tolerance,
                                       fmi3Float64 tolerance, fmi3Float64 start,
                                       fmi3Boolean has_stop, fmi3Float64 stop)
{
    ((model *)c)->now.time = start;
    return fmi3OK;
}

fmi3Status fmi3ExitInitializationMode(fmi3Instance c)
{
    return (fmi3Status)start_model(c);
}

fmi3Status fmi3Reset(fmi3Instance c)
{
    reset_model(c);
    return fmi3OK;
}

/* Variables */

fmi3Status fmi3GetFloat64(fmi3Instance c, const fmi3ValueReference of[], size_t n,
                          fmi3Float64 to[], size_t n_values)
{
    int status = STATUS_OK;
    for (size_t i = 0; i < n && status == STATUS_OK; i++) status = read_real(c, of[i], &to[i]);
    return (fmi3Status)status;
}

fmi3Status fmi3SetFloat64(fmi3Instance c, const fmi3ValueReference of[], size_t n,
                          const fmi3Float64 from[], size_t n_values)
{
    int status = STATUS_OK;
    for (size_t i = 0; i < n && status == STATUS_OK; i++)
        status = write_variable(c, of[i], REAL, &from[i]);
    return (fmi3Status)status;
}

fmi3Status fmi3GetString(fmi3Instance c, const fmi3ValueReference of[], size_t n, fmi3String to[],
                         size_t n_values)
{
    const void *place;
    int status = STATUS_OK;
    for (size_t i = 0; i < n && status == STATUS_OK; i++) {
        status = read_variable(c, of[i], STRING, &place);
        if (status == STATUS_OK) to[i] = place;
    }
    return (fmi3Status)status;
}

fmi3Status fmi3SetString(fmi3Instance c, const fmi3ValueReference of[], size_t n,
                         const fmi3String from[], size_t n_values)
{
    int status = STATUS_OK;
    for (size_t i = 0; i < n && status == STATUS_OK; i++)
        status = write_variable(c, of[i], STRING, from[i]);
    return (fmi3Status)status;
}

/* Types that an int stands for: an enumeration is an Int64. */
#define INTS(TYPE, KIND)                                                                          \
    fmi3Status fmi3Get##TYPE(fmi3Instance c, const fmi3ValueReference of[], size_t n,             \
                             fmi3##TYPE to[], size_t n_values)                                    \
    {                                                                                             \
        const void *place;                                                                        \
        int status = STATUS_OK;                                                                   \
        for (size_t i = 0; i < n && status == STATUS_OK; i++) {                                   \
            status = read_variable(c, of[i], KIND, &place);                                       \
            if (status == STATUS_OK) to[i] = (fmi3##TYPE)*(const int *)place;                     \
        }                                                                                         \
        return (fmi3Status)status;                                                                \
    }                                                                                             \
    fmi3Status fmi3Set##TYPE(fmi3Instance c, const fmi3ValueReference of[], size_t n,             \
                             const fmi3##TYPE from[], size_t n_values)                            \
    {                                                                                             \
        int status = STATUS_OK;                                                                   \
        for (size_t i = 0; i < n && status == STATUS_OK; i++) {                                   \
            int number = (int)from[i];                                                            \
            status = write_variable(c, of[i], KIND, &number);                                     \
        }                                                                                         \
        return (fmi3Status)status;                                                                \
    }
INTS(Int32, INTEGER)
INTS(Int64, INTEGER)
INTS(Boolean, BOOLEAN)

/* States and derivatives */

fmi3Status fmi3GetFMUState(fmi3Instance c, fmi3FMUState *state)
{
    return (fmi3Status)keep_state(c, state);
}

fmi3Status fmi3SetFMUState(fmi3Instance c, fmi3FMUState state)
{
    return (fmi3Status)restore_state(c, state);
}

fmi3Status fmi3FreeFMUState(fmi3Instance c, fmi3FMUState *state)
{
    free_model(*state);
    *state = NULL;
    return fmi3OK;
}

fmi3Status fmi3SerializedFMUStateSize(fmi3Instance c, fmi3FMUState state, size_t *size)
{
    *size = state_size();
    return fmi3OK;
}

fmi3Status fmi3SerializeFMUState(fmi3Instance c, fmi3FMUState state, fmi3Byte bytes[], size_t size)
{
    return (fmi3Status)write_state(c, state, bytes, size);
}

fmi3Status fmi3DeserializeFMUState(fmi3Instance c, const fmi3Byte bytes[], size_t size,
                                   fmi3FMUState *state)
{
    return (fmi3Status)read_state(c, bytes, size, state);
}

fmi3Status fmi3GetDirectionalDerivative(fmi3Instance c, const fmi3ValueReference unknown[],
                                        size_t n, const fmi3ValueReference known[], size_t k,
                                        const fmi3Float64 seeds[], size_t n_seeds,
                                        fmi3Float64 derivatives[], size_t n_derivatives)
{
    return (fmi3Status)find_derivatives(c, unknown, n, known, k, seeds, derivatives);
}

/* Nothing happens: there are neither states nor events, and no parameter may change later. */
#define NOTHING(NAME)                                                                             \
    fmi3Status fmi3##NAME(fmi3Instance c)                                                         \
    {                                                                                             \
        return fmi3OK;                                                                            \
    }
NOTHING(EnterEventMode)
NOTHING(EnterContinuousTimeMode)
NOTHING(EnterStepMode)
NOTHING(Terminate)
NOTHING(EvaluateDiscreteStates)

fmi3Status fmi3UpdateDiscreteStates(fmi3Instance c, fmi3Boolean *needs_update,
                                    fmi3Boolean *is_over, fmi3Boolean *has_other_nominals,
                                    fmi3Boolean *has_other_states, fmi3Boolean *has_next,
                                    fmi3Float64 *next)
{
    *needs_update = *is_over = *has_other_nominals = *has_other_states = *has_next = fmi3False;
    return fmi3OK;
}

fmi3Status fmi3CompletedIntegratorStep(fmi3Instance c, fmi3Boolean is_final,
                                       fmi3Boolean *has_event, fmi3Boolean *is_over)
{
    *has_event = *is_over = fmi3False;
    return fmi3OK;
}

fmi3Status fmi3SetTime(fmi3Instance c, fmi3Float64 time)
{
    ((model *)c)->now.time = time;
    return fmi3OK;
}

/* Co-simulation: the outputs follow the inputs at once, so that a step is a solution. */
fmi3Status fmi3DoStep(fmi3Instance c, fmi3Float64 time, fmi3Float64 step, fmi3Boolean is_final,
                      fmi3Boolean *has_event, fmi3Boolean *is_over, fmi3Boolean *is_early,
                      fmi3Float64 *last)
{
    model *m = c;
    int status = solve_model(m);
    *last = m->now.time = status == STATUS_OK ? time + step : time;
    *has_event = *is_over = *is_early = fmi3False;
    return (fmi3Status)status;
}

/* What this unit has none of; to ask for none of them is right. */
static fmi3Status none(model *m, size_t n)
{
    if (n == 0) return fmi3OK;
    tell(m, STATUS_ERROR, "there is none of what was asked for");
    return fmi3Error;
}

#define NO_NUMBERS(NAME, CONSTANT)                                                                \
    fmi3Status fmi3##NAME(fmi3Instance c, CONSTANT fmi3Float64 x[], size_t n)                     \
    {                                                                                             \
        return none(c, n);                                                                        \
    }
NO_NUMBERS(SetContinuousStates, const)
NO_NUMBERS(GetContinuousStates, )
NO_NUMBERS(GetContinuousStateDerivatives, )
NO_NUMBERS(GetNominalsOfContinuousStates, )
NO_NUMBERS(GetEventIndicators, )

#define NO_COUNT(NAME)                                                                            \
    fmi3Status fmi3##NAME(fmi3Instance c, size_t *n)                                              \
    {                                                                                             \
        *n = 0;                                                                                   \
        return fmi3OK;                                                                            \
    }
NO_COUNT(GetNumberOfContinuousStates)
NO_COUNT(GetNumberOfEventIndicators)

#define NO_VARIABLES(TYPE)                                                                        \
    fmi3Status fmi3Get##TYPE(fmi3Instance c, const fmi3ValueReference of[], size_t n,             \
                             fmi3##TYPE to[], size_t n_values)                                    \
    {                                                                                             \
        return none(c, n);                                                                        \
    }                                                                                             \
    fmi3Status fmi3Set##TYPE(fmi3Instance c, const fmi3ValueReference of[], size_t n,             \
                             const fmi3##TYPE from[], size_t n_values)                            \
    {                                                                                             \
        return none(c, n);                                                                        \
    }
NO_VARIABLES(Float32)
NO_VARIABLES(Int8)
NO_VARIABLES(UInt8)
NO_VARIABLES(Int16)
NO_VARIABLES(UInt16)
NO_VARIABLES(UInt32)
NO_VARIABLES(UInt64)

/* What takes arguments of its own and is never right to call. */
#define NEVER(NAME, ...)                                                                          \
    fmi3Status fmi3##NAME(fmi3Instance c, __VA_ARGS__)                                            \
    {                                                                                             \
        return none(c, 1);                                                                        \
    }
#define REFERENCES const fmi3ValueReference of[], size_t n
NEVER(GetBinary, REFERENCES, size_t sizes[], fmi3Binary to[], size_t n_values)
NEVER(SetBinary, REFERENCES, const size_t sizes[], const fmi3Binary from[], size_t n_values)
NEVER(GetClock, REFERENCES, fmi3Clock to[])
NEVER(SetClock, REFERENCES, const fmi3Clock from[])
NEVER(GetIntervalDecimal, REFERENCES, fmi3Float64 to[], fmi3IntervalQualifier qualifiers[])
NEVER(GetIntervalFraction, REFERENCES, fmi3UInt64 counters[], fmi3UInt64 resolutions[],
      fmi3IntervalQualifier qualifiers[])
NEVER(GetShiftDecimal, REFERENCES, fmi3Float64 to[])
NEVER(GetShiftFraction, REFERENCES, fmi3UInt64 counters[], fmi3UInt64 resolutions[])
NEVER(SetIntervalDecimal, REFERENCES, const fmi3Float64 from[])
NEVER(SetIntervalFraction, REFERENCES, const fmi3UInt64 counters[],
      const fmi3UInt64 resolutions[])
NEVER(SetShiftDecimal, REFERENCES, const fmi3Float64 from[])
NEVER(SetShiftFraction, REFERENCES, const fmi3UInt64 counters[], const fmi3UInt64 resolutions[])
NEVER(GetOutputDerivatives, REFERENCES, const fmi3Int32 orders[], fmi3Float64 to[],
      size_t n_values)
NEVER(GetNumberOfVariableDependencies, fmi3ValueReference of, size_t *n)
NEVER(GetVariableDependencies, fmi3ValueReference of, size_t elements[],
      fmi3ValueReference independent[], size_t their_elements[], fmi3DependencyKind kinds[],
      size_t n)
NEVER(GetAdjointDerivative, REFERENCES, const fmi3ValueReference known[], size_t k,
      const fmi3Float64 seeds[], size_t n_seeds, fmi3Float64 derivatives[], size_t n_derivatives)
NEVER(ActivateModelPartition, fmi3ValueReference clock, fmi3Float64 time)

/* There are no structural parameters, so no mode for them. */
fmi3Status fmi3EnterConfigurationMode(fmi3Instance c)
{
    return none(c, 1);
}

fmi3Status fmi3ExitConfigurationMode(fmi3Instance c)
{
    return none(c, 1);
}
