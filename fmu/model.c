#include "model.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct variable {
    enum kind kind;
    enum causality causality;
    size_t offset; /* within `values` */
    double step;   /* of an input: that of a difference */
} variable;

/* `variables`, and what names this very unit: UNIT_TOKEN. */
#include "variables.h"

enum { N_VARIABLES = sizeof variables / sizeof *variables,
       N_STATE = sizeof(faststrip_wheelset_state) / sizeof(double) };

/* Messages */

static int refuse(model *m, int status, const char *text)
{
    tell(m, status, text);
    return status;
}

/* What the library said of its error. */
static int refuse_call(model *m, int status, int code, const char *said)
{
    char word[FASTSTRIP_TEXT], text[2 * FASTSTRIP_TEXT + 2];
    faststrip_message(code, word, sizeof word);
    snprintf(text, sizeof text, "%s: %s", word, said);
    return refuse(m, status, text);
}

/* Making */

model *make_model(const char *name, const char *token, const char *resources)
{
    model *m = calloc(1, sizeof *m);
    if (!m) return NULL;
    m->name = strdup(name ? name : "");
    m->resources = calloc(1, (resources ? strlen(resources) : 0) + 2);
    if (m->resources && resources) strcpy(m->resources, resources);
    if (!m->name || !m->resources || !token || strcmp(token, UNIT_TOKEN) != 0) {
        free_model(m);
        return NULL;
    }
    if (*m->resources && m->resources[strlen(m->resources) - 1] != '/') strcat(m->resources, "/");
    reset_model(m);
    return m;
}

void free_model(model *m)
{
    if (!m) return;
    faststrip_wheelset_free(&m->wheelset);
    free(m->resources);
    free(m->name);
    free(m);
}

void reset_model(model *m)
{
    faststrip_wheelset_free(&m->wheelset);
    memset(&m->now, 0, sizeof m->now);
    strcpy(m->now.profile[0], "s1002");
    strcpy(m->now.profile[2], "60e1");
    faststrip_default_wheelset(&m->now.setup, sizeof m->now.setup);
    faststrip_default_case(&m->now.contact, sizeof m->now.contact);
    m->now.demand.warm_start = 1;
}

/* A profile by its name, or by the points of a file: what has a point or a slash is one, a path or
 * a name in the resources. `points` is to be freed. */
static int find_profile(model *m, int kind, const char *name, double **points,
                        faststrip_profile *profile)
{
    char text[FASTSTRIP_TEXT], path[2 * PATH_LENGTH];
    faststrip_reading reading;
    double nothing[1];
    int n = 0, code;
    memset(profile, 0, sizeof *profile);
    if (!*name) return STATUS_OK;
    profile->name = name;
    if (!strpbrk(name, "./\\")) return STATUS_OK;
    if (snprintf(path, sizeof path, "%s%s", *name == '/' ? "" : m->resources, name)
        >= (int)sizeof path)
        return refuse(m, STATUS_ERROR, "the path of a profile is too long");
    faststrip_default_reading(&reading, sizeof reading);
    reading.kind = kind;
    code = faststrip_read_profile(path, &reading, 0, &n, nothing, nothing, NULL, text,
                                  sizeof text);
    if (code == FASTSTRIP_WORKSPACE_TOO_SMALL) {
        *points = malloc(2 * (size_t)n * sizeof **points);
        if (!*points) return refuse(m, STATUS_ERROR, "there is no memory for a profile");
        code = faststrip_read_profile(path, &reading, n, &n, *points, *points + n, NULL, text,
                                      sizeof text);
    }
    if (code >= FASTSTRIP_FIRST_ERROR) return refuse_call(m, STATUS_ERROR, code, text);
    profile->name = NULL;
    profile->y = *points;
    profile->z = *points + n;
    profile->n = n;
    return STATUS_OK;
}

/* Outputs of a wheelset; the status of the library, with an error they stay. */
static int solve_state(model *m, const faststrip_wheelset_state *state,
                       const faststrip_wheelset_demand *demand, values *found)
{
    faststrip_wheelset_contact contacts[FASTSTRIP_MOST_CONTACTS];
    faststrip_wheelset_result result;
    int n, shown[2] = {0, 0};
    int code = faststrip_wheelset_solve(m->wheelset, state, demand, FASTSTRIP_MOST_CONTACTS, &n,
                                        contacts, &result);
    if (code >= FASTSTRIP_FIRST_ERROR) return code;
    memset(found->side, 0, sizeof found->side);
    found->roll = result.roll;
    for (int i = 0; i < 2; i++) {
        side *to = &found->side[i];
        to->status = result.status[i];
        to->n_contacts = result.n_contacts[i];
        to->z = result.z[i];
        memcpy(to->force, result.force[i], sizeof to->force);
        memcpy(to->moment, result.moment[i], sizeof to->moment);
    }
    for (int i = 0; i < n; i++) {
        int of = contacts[i].side == FASTSTRIP_LEFT_WHEEL;
        if (shown[of] < SHOWN) found->side[of].contact[shown[of]++] = contacts[i];
    }
    return code;
}

static int make_of_profiles(model *m)
{
    char text[FASTSTRIP_TEXT];
    double *points[4] = {NULL, NULL, NULL, NULL};
    faststrip_profile profiles[4];
    int status = STATUS_OK, code;
    for (int i = 0; i < 4 && status == STATUS_OK; i++)
        status = find_profile(m, i < 2 ? 1 : 2, m->now.profile[i], &points[i], &profiles[i]);
    if (status == STATUS_OK) {
        code = faststrip_wheelset_new(&m->now.setup, profiles, profiles + 2, &m->now.contact,
                                      &m->wheelset, text, sizeof text);
        if (code >= FASTSTRIP_FIRST_ERROR) status = refuse_call(m, STATUS_ERROR, code, text);
    }
    for (int i = 0; i < 4; i++) free(points[i]);
    return status;
}

/* What is wrong with a rolling wheelset in the middle of its track is wrong with the parameters. */
static int try_demand(model *m, const faststrip_wheelset_demand *demand)
{
    const faststrip_wheelset_state rolling = {.speed = 1e3};
    char text[FASTSTRIP_TEXT];
    values found;
    int code = solve_state(m, &rolling, demand, &found);
    if (code != FASTSTRIP_BAD_ARGUMENT && code != FASTSTRIP_NOT_FINITE
        && code != FASTSTRIP_BAD_MATERIAL)
        return STATUS_OK;
    faststrip_wheelset_last_message(m->wheelset, text, sizeof text);
    return refuse_call(m, STATUS_ERROR, code, text);
}

static int make_wheelset(model *m)
{
    const faststrip_wheelset_demand any = {.kind = FASTSTRIP_BY_AXLE_LOAD, .axle_load = 1e5};
    int status;
    if (m->wheelset) return STATUS_OK;
    status = make_of_profiles(m);
    if (status == STATUS_OK) status = try_demand(m, &any);
    if (status == STATUS_OK) status = try_demand(m, &m->now.demand);
    if (status != STATUS_OK) faststrip_wheelset_free(&m->wheelset);
    m->last = ELSEWHERE;
    return status;
}

int start_model(model *m)
{
    int status = make_wheelset(m);
    m->now.is_running = status == STATUS_OK;
    return status;
}

/* Solving */

/* What would be worth a look: limitations, and numbers that no vehicle has in practice. */
static void tell_doubts(model *m, int code)
{
    char text[FASTSTRIP_TEXT];
    for (int i = 0; faststrip_doubt((faststrip_workspace *)m->wheelset, i, text, sizeof text) == 0
                    && *text; i++)
        tell(m, STATUS_WARNING, text);
    faststrip_wheelset_last_message(m->wheelset, text, sizeof text);
    if (code != FASTSTRIP_OK) refuse_call(m, STATUS_WARNING, code, text);
}

int solve_model(model *m)
{
    faststrip_wheelset_demand demand = m->now.demand;
    char text[FASTSTRIP_TEXT];
    int code, status = STATUS_OK;
    if (m->now.is_solved) return STATUS_OK;
    status = make_wheelset(m);
    if (status != STATUS_OK) return status;
    if (m->last == ELSEWHERE) demand.warm_start = 0;
    code = solve_state(m, &m->now.state, &demand, &m->now);
    if (code >= FASTSTRIP_FIRST_ERROR) {
        faststrip_wheelset_last_message(m->wheelset, text, sizeof text);
        return refuse_call(m, STATUS_DISCARD, code, text);
    }
    m->now.is_solved = 1;
    m->last = HERE;
    m->slopes_are = UNKNOWN;
    if (m->is_logging) tell_doubts(m, code);
    return STATUS_OK;
}

/* Variables */

static int find_variable(model *m, unsigned int reference, enum kind kind, const variable **found)
{
    char text[FASTSTRIP_TEXT];
    if (reference < N_VARIABLES) {
        *found = &variables[reference];
        if ((*found)->kind == kind || (kind == REAL && (*found)->kind == COUNT)) return STATUS_OK;
    }
    snprintf(text, sizeof text, "there is no variable of this type with value reference %u",
             reference);
    return refuse(m, STATUS_ERROR, text);
}

double real_at(unsigned int reference, const void *place)
{
    return variables[reference].kind == COUNT ? *(const int *)place : *(const double *)place;
}

int read_variable(model *m, unsigned int reference, enum kind kind, const void **value)
{
    const variable *of;
    int status = find_variable(m, reference, kind, &of);
    if (status == STATUS_OK && of->causality == OUTPUT) status = solve_model(m);
    if (status == STATUS_OK) *value = (const char *)&m->now + of->offset;
    return status;
}

int write_variable(model *m, unsigned int reference, enum kind kind, const void *value)
{
    const variable *of;
    size_t size = kind == REAL ? sizeof(double) : sizeof(int);
    char *place;
    int status = find_variable(m, reference, kind, &of);
    if (status != STATUS_OK) return status;
    if (of->causality != INPUT && (of->causality != PARAMETER || m->now.is_running))
        return refuse(m, STATUS_ERROR, of->causality == PARAMETER
                      ? "a parameter cannot be set after the initialization"
                      : "only inputs and parameters can be set");
    place = (char *)&m->now + of->offset;
    if (kind == STRING) {
        size = strlen(value) + 1;
        if (size > PATH_LENGTH) return refuse(m, STATUS_ERROR, "a text is too long");
    }
    if (memcmp(place, value, size) == 0) return STATUS_OK;
    memcpy(place, value, size);
    m->now.is_solved = 0;
    if (of->causality == PARAMETER) faststrip_wheelset_free(&m->wheelset);
    return STATUS_OK;
}

/* States */

/* What has variables, and the library's memory of its last solution; plain bytes. */
typedef struct state {
    char token[sizeof UNIT_TOKEN];
    size_t size; /* of all of it */
    values now;
    unsigned char memory[];
} state;

int keep_state(model *m, void **kept)
{
    size_t memory = 0;
    state *s;
    if (m->wheelset && m->last != ELSEWHERE)
        faststrip_wheelset_save(m->wheelset, 0, &memory, NULL);
    s = realloc(*kept, sizeof(state) + memory);
    if (!s) return refuse(m, STATUS_ERROR, "there is no memory for a state");
    *kept = s;
    memset(s, 0, sizeof(state));
    memcpy(s->token, UNIT_TOKEN, sizeof UNIT_TOKEN);
    s->size = sizeof(state) + memory;
    s->now = m->now;
    if (memory > 0) faststrip_wheelset_save(m->wheelset, memory, &memory, s->memory);
    return STATUS_OK;
}

int restore_state(model *m, const void *kept)
{
    const state *s = kept;
    size_t first = offsetof(values, profile), size = offsetof(values, demand) - first;
    int status = STATUS_OK;
    if (memcmp((const char *)&s->now + first, (const char *)&m->now + first, size) != 0)
        faststrip_wheelset_free(&m->wheelset);
    m->now = s->now;
    m->last = ELSEWHERE;
    m->slopes_are = UNKNOWN;
    if (s->size == sizeof(state)) return STATUS_OK;
    status = make_wheelset(m);
    if (status != STATUS_OK) return status;
    if (faststrip_wheelset_restore(m->wheelset, s->size - sizeof(state), s->memory)
        < FASTSTRIP_FIRST_ERROR)
        m->last = RESTORED;
    else
        status = refuse(m, STATUS_ERROR, "the bytes are not those of a state of this unit");
    return status;
}

size_t state_size(const void *kept)
{
    return ((const state *)kept)->size;
}

int write_state(model *m, const void *kept, void *bytes, size_t size)
{
    if (size < state_size(kept))
        return refuse(m, STATUS_ERROR, "the bytes are too few for a state");
    memcpy(bytes, kept, state_size(kept));
    return STATUS_OK;
}

int read_state(model *m, const void *bytes, size_t size, void **kept)
{
    state head, *s;
    if (size >= sizeof head) memcpy(&head, bytes, sizeof head);
    if (size < sizeof head || head.size != size
        || memcmp(head.token, UNIT_TOKEN, sizeof UNIT_TOKEN) != 0)
        return refuse(m, STATUS_ERROR, "the bytes are not those of a state of this unit");
    s = realloc(*kept, size);
    if (!s) return refuse(m, STATUS_ERROR, "there is no memory for a state");
    *kept = s;
    memcpy(s, bytes, size);
    for (int i = 0; i < 4; i++) s->now.profile[i][PATH_LENGTH - 1] = '\0';
    return STATUS_OK;
}

/* Derivatives */

/* Which of the library's derivatives an output has, as a row of both wheels' 6; -1: none. */
static int row_of(size_t offset)
{
    for (int i = 0; i < 2; i++) {
        size_t first = offsetof(values, side) + (size_t)i * sizeof(side);
        size_t force = (offset - first - offsetof(side, force)) / sizeof(double);
        size_t moment = (offset - first - offsetof(side, moment)) / sizeof(double);
        if (force < 3) return 6 * i + (int)force;
        if (moment < 3) return 6 * i + 3 + (int)moment;
    }
    return -1;
}

/* The same of an input, a number of the state: its position is one, and its rates after the speed.
 */
static int column_of(int i)
{
    return i < 4 ? i : i > 4 && i < 10 ? i - 1 : -1;
}

/* The outputs on both sides of the inputs along a direction, on one where the other has no
 * solution, and how far they are apart; 0 where the direction is none. */
typedef struct difference {
    double direction[N_STATE];
    int is_found;
    double distance;
    values side[2];
} difference;

/* The state that is to come back, before the first solution that changes it. */
static int keep_once(model *m, void **kept)
{
    return *kept ? STATUS_OK : keep_state(m, kept);
}

static int find_difference(model *m, difference *along, void **kept)
{
    faststrip_wheelset_demand demand = m->now.demand;
    double step = INFINITY;
    int status;
    demand.warm_start = 1;
    for (int i = 0; i < N_VARIABLES; i++) {
        size_t k = (variables[i].offset - offsetof(values, state)) / sizeof(double);
        if (variables[i].causality == INPUT && along->direction[k] != 0.0)
            step = fmin(step, variables[i].step / fabs(along->direction[k]));
    }
    along->is_found = 1;
    if (isinf(step)) return STATUS_OK;
    status = keep_once(m, kept);
    if (status != STATUS_OK) return status;
    for (int i = 0; i < 2; i++) {
        faststrip_wheelset_state state = m->now.state;
        double *numbers = (double *)&state;
        for (int k = 0; k < N_STATE; k++)
            numbers[k] += (i == 0 ? -step : step) * along->direction[k];
        memcpy(&along->side[i], &m->now, sizeof(values));
        if (solve_state(m, &state, &demand, &along->side[i]) < FASTSTRIP_FIRST_ERROR)
            along->distance += step;
    }
    return along->distance > 0.0 ? STATUS_OK
           : refuse(m, STATUS_DISCARD, "no solution beside the inputs has a derivative");
}

static int find_slopes(model *m, const unsigned int *outputs, size_t n,
                       const unsigned int *inputs, size_t k, const double *seeds,
                       double *derivatives, void **kept)
{
    difference all = {.distance = 0.0}, others = all, *along;
    const variable *of;
    int status = STATUS_OK;
    for (size_t i = 0; i < k; i++) {
        status = find_variable(m, inputs[i], REAL, &of);
        if (status != STATUS_OK) return status;
        if (of->causality != INPUT)
            return refuse(m, STATUS_ERROR, "derivatives are those over inputs");
        all.direction[(of->offset - offsetof(values, state)) / sizeof(double)] += seeds[i];
    }
    for (int j = 0; j < N_STATE; j++)
        if (column_of(j) < 0) others.direction[j] = all.direction[j];
    /* Of the library where z and roll are given, unless something comes or goes just there. */
    if (m->slopes_are == UNKNOWN) {
        status = keep_once(m, kept);
        if (status != STATUS_OK) return status;
        if (m->last != HERE) m->now.is_solved = 0;
        status = solve_model(m);
        if (status != STATUS_OK) return status;
        m->slopes_are = m->now.demand.kind == FASTSTRIP_BY_POSITION
                        && faststrip_wheelset_get_derivatives(m->wheelset, m->slopes)
                           < FASTSTRIP_FIRST_ERROR ? KNOWN : NONE;
    }
    for (size_t i = 0; i < n; i++) {
        int row;
        status = find_variable(m, outputs[i], REAL, &of);
        if (status != STATUS_OK) return status;
        row = m->slopes_are == KNOWN ? row_of(of->offset) : -1;
        along = row >= 0 ? &others : &all;
        if (!along->is_found) status = find_difference(m, along, kept);
        if (status != STATUS_OK) return status;
        derivatives[i] = 0.0;
        if (along->distance > 0.0)
            derivatives[i] = (real_at(outputs[i], (const char *)&along->side[1] + of->offset)
                              - real_at(outputs[i], (const char *)&along->side[0] + of->offset))
                             / along->distance;
        for (int j = 0; row >= 0 && j < N_STATE; j++)
            if (column_of(j) >= 0)
                derivatives[i] += m->slopes[row / 6][row % 6][column_of(j)] * all.direction[j];
    }
    return STATUS_OK;
}

/* What is solved for them is taken back: outputs and later solutions stay those of before. */
int find_derivatives(model *m, const unsigned int *outputs, size_t n, const unsigned int *inputs,
                     size_t k, const double *seeds, double *derivatives)
{
    void *kept = NULL;
    int found = solve_model(m), status, slopes_are;
    if (found != STATUS_OK) return found;
    found = find_slopes(m, outputs, n, inputs, k, seeds, derivatives, &kept);
    if (!kept) return found;
    slopes_are = m->slopes_are;
    status = restore_state(m, kept);
    m->slopes_are = slopes_are;
    free(kept);
    return found != STATUS_OK ? found : status;
}
