/* FMI 3.0 on a model. */
#include "model.h"

#include <fmi3Functions.h>
#include <stdlib.h>

#define FMI(NAME) fmi3##NAME
#define OF_STATE(BEFORE, AFTER) fmi3##BEFORE##FMUState##AFTER
#define N_VALUES , size_t n_values
#include "both.h"

REALS(Float64)
INTS(Int32, INTEGER)
INTS(Int64, INTEGER) /* enumerations */
NOTHING(EnterStepMode)
NOTHING(EvaluateDiscreteStates)
NO_NUMBERS(GetContinuousStateDerivatives, )

void tell(model *m, int status, const char *text)
{
    fmi3LogMessageCallback logger = (fmi3LogMessageCallback)m->logger;
    if (logger) logger(m->environment, (fmi3Status)status, categories[status], text);
}

const char *fmi3GetVersion(void)
{
    return fmi3Version;
}

/* Making */

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

fmi3Status fmi3EnterInitializationMode(fmi3Instance c, fmi3Boolean has_tolerance,
                                       fmi3Float64 tolerance, fmi3Float64 start,
                                       fmi3Boolean has_stop, fmi3Float64 stop)
{
    ((model *)c)->now.time = start;
    return fmi3OK;
}

/* States and derivatives */

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

#define NO_COUNT(NAME)                                                                            \
    fmi3Status fmi3##NAME(fmi3Instance c, size_t *n)                                              \
    {                                                                                             \
        *n = 0;                                                                                   \
        return fmi3OK;                                                                            \
    }
NO_COUNT(GetNumberOfContinuousStates)
NO_COUNT(GetNumberOfEventIndicators)

/* Steps and events */

fmi3Status fmi3UpdateDiscreteStates(fmi3Instance c, fmi3Boolean *needs_update,
                                    fmi3Boolean *is_over, fmi3Boolean *has_other_nominals,
                                    fmi3Boolean *has_other_states, fmi3Boolean *has_next,
                                    fmi3Float64 *next)
{
    *needs_update = *is_over = *has_other_nominals = *has_other_states = *has_next = fmi3False;
    return fmi3OK;
}

fmi3Status fmi3DoStep(fmi3Instance c, fmi3Float64 time, fmi3Float64 step, fmi3Boolean is_final,
                      fmi3Boolean *has_event, fmi3Boolean *is_over, fmi3Boolean *is_early,
                      fmi3Float64 *last)
{
    fmi3Status status = take_step(c, time, step);
    *last = ((model *)c)->now.time;
    *has_event = *is_over = *is_early = fmi3False;
    return status;
}

/* What this unit has none of */

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
