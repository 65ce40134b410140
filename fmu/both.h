/* What both versions of FMI have but for names and types: FMI(NAME) is one of these,
 * OF_STATE(BEFORE, AFTER) a name about states, N_VALUES an argument that FMI 3 has more. */

static const char *const categories[] = {"", "logStatusWarning", "logStatusDiscard",
                                         "logStatusError"};

FMI(Status) FMI(SetDebugLogging)(void *c, FMI(Boolean) is_on, size_t n, const FMI(String) names[])
{
    ((model *)c)->is_logging = is_on;
    return FMI(OK);
}

void FMI(FreeInstance)(void *c)
{
    free_model(c);
}

FMI(Status) FMI(ExitInitializationMode)(void *c)
{
    return (FMI(Status))start_model(c);
}

FMI(Status) FMI(Reset)(void *c)
{
    reset_model(c);
    return FMI(OK);
}

/* Nothing happens: there are neither states nor events. */
#define NOTHING(NAME)                                                                             \
    FMI(Status) FMI(NAME)(void *c)                                                                \
    {                                                                                             \
        return FMI(OK);                                                                           \
    }
NOTHING(EnterEventMode)
NOTHING(EnterContinuousTimeMode)
NOTHING(Terminate)

/* What this unit has none of; to ask for none of them is right. */
static FMI(Status) none(model *m, size_t n)
{
    if (n == 0) return FMI(OK);
    tell(m, STATUS_ERROR, "there is none of what was asked for");
    return FMI(Error);
}

#define NO_NUMBERS(NAME, CONSTANT)                                                                \
    FMI(Status) FMI(NAME)(void *c, CONSTANT double x[], size_t n)                                 \
    {                                                                                             \
        return none(c, n);                                                                        \
    }
NO_NUMBERS(SetContinuousStates, const)
NO_NUMBERS(GetContinuousStates, )
NO_NUMBERS(GetNominalsOfContinuousStates, )
NO_NUMBERS(GetEventIndicators, )

FMI(Status) FMI(CompletedIntegratorStep)(void *c, FMI(Boolean) is_final, FMI(Boolean) *has_event,
                                         FMI(Boolean) *is_over)
{
    *has_event = *is_over = FMI(False);
    return FMI(OK);
}

FMI(Status) FMI(SetTime)(void *c, double time)
{
    ((model *)c)->now.time = time;
    return FMI(OK);
}

/* Co-simulation: the outputs follow the inputs at once, so that a step is a solution. */
static FMI(Status) take_step(model *m, double time, double step)
{
    int status = solve_model(m);
    m->now.time = status == STATUS_OK ? time + step : time;
    return (FMI(Status))status;
}

/* Variables of a type: what is read at `place`, and what is written of `from[i]`. */
#define ACCESS(TYPE, KIND, READ, WRITE)                                                           \
    FMI(Status) FMI(Get##TYPE)(void *c, const FMI(ValueReference) of[], size_t n,                 \
                               FMI(TYPE) to[] N_VALUES)                                           \
    {                                                                                             \
        const void *place;                                                                        \
        int status = STATUS_OK;                                                                   \
        for (size_t i = 0; i < n && status == STATUS_OK; i++) {                                   \
            status = read_variable(c, of[i], KIND, &place);                                       \
            if (status == STATUS_OK) to[i] = READ;                                                \
        }                                                                                         \
        return (FMI(Status))status;                                                               \
    }                                                                                             \
    FMI(Status) FMI(Set##TYPE)(void *c, const FMI(ValueReference) of[], size_t n,                 \
                               const FMI(TYPE) from[] N_VALUES)                                   \
    {                                                                                             \
        int status = STATUS_OK;                                                                   \
        for (size_t i = 0; i < n && status == STATUS_OK; i++)                                     \
            status = write_variable(c, of[i], KIND, WRITE);                                       \
        return (FMI(Status))status;                                                               \
    }
#define REALS(TYPE) ACCESS(TYPE, REAL, real_at(of[i], place), &from[i])
#define INTS(TYPE, KIND) ACCESS(TYPE, KIND, (FMI(TYPE))*(const int *)place, &(int){(int)from[i]})
INTS(Boolean, BOOLEAN)
ACCESS(String, STRING, place, from[i])

FMI(Status) OF_STATE(Get, )(void *c, void **state)
{
    return (FMI(Status))keep_state(c, state);
}

FMI(Status) OF_STATE(Set, )(void *c, void *state)
{
    return (FMI(Status))restore_state(c, state);
}

FMI(Status) OF_STATE(Free, )(void *c, void **state)
{
    free(*state);
    *state = NULL;
    return FMI(OK);
}

FMI(Status) OF_STATE(Serialized, Size)(void *c, void *state, size_t *size)
{
    *size = state_size(state);
    return FMI(OK);
}

FMI(Status) OF_STATE(Serialize, )(void *c, void *state, FMI(Byte) bytes[], size_t size)
{
    return (FMI(Status))write_state(c, state, bytes, size);
}
