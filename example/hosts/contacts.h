/* Random contacts for the tests of hosts, the same for the same number. */
#ifndef CONTACTS_H
#define CONTACTS_H

#include <faststrip.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

enum { POINTS = 101 };

typedef struct {
    double y[POINTS], h[POINTS], inv2r[POINTS];
    faststrip_case contact;
} example;

static double next(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) / 9007199254740992.0;
}

/* Ellipses, lopsided patches, kinks, two patches, necks; some of them rough; by load or
 * penetration; all methods; some as well as is wanted. */
static void make_example(uint64_t number, example *e)
{
    uint64_t state = number * 2654435761u + 12345u, noise = number;
    double curvature, other, middle, slope;
    int kind, i;

    for (i = 0; i < 5; i++) next(&state);
    kind = (int)(4.0 * next(&state));
    curvature = 1e-3 * exp(2.0 * next(&state));
    other = curvature * (0.5 + next(&state));
    middle = 4.0 * next(&state) - 2.0;
    slope = 0.01 * next(&state);
    for (i = 0; i < POINTS; i++) {
        double y = -15.0 + 30.0 * i / (POINTS - 1), d = y - middle;
        e->y[i] = y;
        e->inv2r[i] = 1.0 / 920.0;
        e->h[i] = curvature * d * d;
        if (kind == 1 && d > 0.0) e->h[i] = other * d * d;
        if (kind == 2) e->h[i] += slope * fabs(d);
        if (kind == 3) e->h[i] = 0.02 * curvature * (d * d - 40.0) * (d * d - 40.0);
        if (number % 11 == 10) e->h[i] = 1e-4 * (d * d - 9.0) * (d * d - 9.0);
        if (number % 7 == 6) e->h[i] += 2e-3 * next(&noise);
    }
    faststrip_default_case(&e->contact, sizeof e->contact);
    e->contact.strips_per_patch = 5 + 2 * (int)(3.0 * next(&state));
    e->contact.normal = kind == 0 ? 1 + (int)(4.0 * next(&state)) : FASTSTRIP_NORMAL_STRIP;
    e->contact.tangential = (int)(3.0 * next(&state));
    e->contact.fastsim_nx = e->contact.fastsim_ny = 11;
    e->contact.load = 1e4 + 1.2e5 * next(&state);
    e->contact.by_load = next(&state) < 0.8;
    e->contact.penetration = 0.02 + 0.08 * next(&state);
    e->contact.cksi = 4e-3 * next(&state) - 2e-3;
    e->contact.ceta = 4e-3 * next(&state) - 2e-3;
    e->contact.cphi = 1e-3 * next(&state) - 5e-4;
    e->contact.mu = 0.1 + 0.5 * next(&state);
    if (number % 9 == 8) {
        e->contact.normal = FASTSTRIP_NORMAL_AUTO;
        e->contact.target = 1 + (int)(number % 5);
        if (e->contact.tangential == FASTSTRIP_TANGENTIAL_NONE)
            e->contact.target = FASTSTRIP_TARGET_PMAX;
        e->contact.tolerance = 0.002 * exp(4.0 * next(&state));
    }
}

/* A workspace that serves every example. */
static inline faststrip_workspace *make_workspace(void)
{
    faststrip_workspace *workspace;
    faststrip_case contact;

    faststrip_default_case(&contact, sizeof contact);
    contact.normal = FASTSTRIP_NORMAL_AUTO;
    contact.with_elements = 1;
    contact.fastsim_nx = contact.fastsim_ny = 11;
    return faststrip_new(&contact, POINTS, &workspace) == 0 ? workspace : NULL;
}

/* A hash of the bits of a solution and of its status. */
static uint64_t bits_of(int status, const faststrip_result *result)
{
    const double figures[] = {result->load, result->penetration, result->area, result->pmax,
                              result->y_min, result->y_max, result->x_max, result->fx, result->fy,
                              result->mz, result->friction_power, result->stick_fraction,
                              result->est_err_penetration, result->est_err_pmax,
                              result->est_err_area, result->residual_inside,
                              result->overlap_outside, result->est_err_fx,
                              result->est_err_fy, result->est_err_mz, result->est_err_target,
                              result->n_steps, result->best_step, result->target_is_met};
    uint64_t bits = (uint64_t)status, word;
    size_t i;

    for (i = 0; i < sizeof figures / sizeof figures[0]; i++) {
        memcpy(&word, &figures[i], sizeof word);
        bits = ((bits << 7) | (bits >> 57)) ^ word;
    }
    return bits;
}

static inline uint64_t solve_example(faststrip_workspace *workspace, uint64_t number, int *status)
{
    example e;
    faststrip_result result;

    make_example(number, &e);
    memset(&result, 0, sizeof result);
    *status = faststrip_set_gap(workspace, POINTS, e.y, e.h, e.inv2r, NULL);
    if (*status == 0) *status = faststrip_solve(workspace, &e.contact, &result);
    return bits_of(*status, &result);
}

#endif
