/* Wheelsets that the hosts make and solve: one of profiles with names, one of points, which has
 * contact damping. */
#ifndef WHEELSETS_H
#define WHEELSETS_H

#include <faststrip.h>
#include <stdint.h>
#include <string.h>

enum { WHEEL_POINTS = 61 };

/* Points of a wheel and of a rail: made before anything is watched, as arithmetic of the host's. */
static double points_y[WHEEL_POINTS], points_wheel[WHEEL_POINTS], points_rail[WHEEL_POINTS];

static void make_points(void)
{
    int i;

    for (i = 0; i < WHEEL_POINTS; i++) {
        const double y = i - 30;

        points_y[i] = y;
        points_wheel[i] = -y * y / 2000.0 - y / 20.0;
        points_rail[i] = y * y / 600.0;
    }
}

static faststrip_wheelset *make_wheelset(int of_points)
{
    faststrip_wheelset *wheelset = NULL;
    faststrip_wheelset_setup setup;
    faststrip_case contact;
    faststrip_profile wheels[2], rails[2];

    faststrip_default_case(&contact, sizeof contact);
    faststrip_default_wheelset(&setup, sizeof setup);
    contact.mu = 0.35;
    contact.strips_per_patch = 9;
    contact.with_elements = 1;
    setup.radius_left = 460.25;
    setup.inclination = 0.05;
    memset(wheels, 0, sizeof wheels);
    memset(rails, 0, sizeof rails);
    wheels[0].name = "s1002";
    rails[0].name = "60e1";
    if (of_points) {
        setup.rail_distance = 1500.0;
        setup.damping = 1e-3;
        setup.speed_floor = 100.0;
        setup.rail_stiffness_y = 3e4;
        setup.rail_stiffness_z = 8e4;
        wheels[0].name = rails[0].name = NULL;
        wheels[0].y = rails[0].y = points_y;
        wheels[0].z = points_wheel;
        rails[0].z = points_rail;
        wheels[0].n = rails[0].n = WHEEL_POINTS;
        wheels[1].name = "cone40";
    }
    faststrip_wheelset_new(&setup, wheels, rails, &contact, &wheelset, NULL, 0);
    return wheelset;
}

enum { ASKED = 12 };

/* What is asked i-th, i from 1 to ASKED; z and roll stay. */
static void ask_wheelset(int i, faststrip_wheelset_state *state, faststrip_wheelset_demand *demand)
{
    /* The rails have moved in the second half, and each wheel rotates by itself. */
    const double moved = i > 6 ? i : 0;
    int side;

    memset(demand, 0, sizeof *demand);
    state->y = 0.5 * i - 3.0;
    state->yaw = 0.001 * i;
    state->speed = 20000.0;
    state->y_rate = 10.0 * i;
    state->z_rate = 1.0;
    state->roll_rate = 0.001;
    state->yaw_rate = 0.01 * i;
    state->pitch_rate = -20000.0 / 460.0;
    state->curvature = 1e-6;
    state->pitch_rate_difference = 0.01 * moved;
    for (side = 0; side < 2; side++) {
        faststrip_rail_state *rail = &state->rail[side];

        rail->y = (side ? -0.02 : 0.01) * moved;
        rail->z = (side ? 0.01 : -0.02) * moved;
        rail->roll = (side ? -2e-4 : 1e-4) * moved;
        rail->y_rate = (side ? -1.0 : 2.0) * moved;
        rail->z_rate = (side ? 0.25 : -0.5) * moved;
        rail->roll_rate = (side ? 2e-3 : 1e-3) * moved;
    }
    demand->kind = i % 3;
    demand->load_right = 60000.0;
    demand->load_left = 50000.0;
    demand->axle_load = 120000.0;
    demand->roll_moment = 1000000.0;
    demand->roll_is_free = i % 3 > 0 && i < 7;
    if (i % 3 < 2 && i >= 9)
        demand->wheels = i % 2 ? FASTSTRIP_RIGHT_WHEEL : FASTSTRIP_LEFT_WHEEL;
    demand->warm_start = i % 2;
}

/* A hash of the bits of what is asked, cold. */
static uint64_t wheelset_bits(faststrip_wheelset *wheelset, const faststrip_wheelset_state *state,
                              const faststrip_wheelset_demand *demand, int *status)
{
    faststrip_wheelset_contact contacts[FASTSTRIP_MOST_CONTACTS];
    faststrip_wheelset_demand cold = *demand;
    faststrip_wheelset_result result;
    uint64_t bits = 0, word;
    size_t k;
    int n;

    memset(contacts, 0, sizeof contacts);
    cold.warm_start = 0;
    *status = faststrip_wheelset_solve(wheelset, state, &cold, FASTSTRIP_MOST_CONTACTS, &n,
                                       contacts, &result);
    for (k = 0; k < sizeof contacts / (sizeof word); k++) {
        memcpy(&word, (char *)contacts + k * sizeof word, sizeof word);
        bits = ((bits << 7) | (bits >> 57)) ^ word;
    }
    for (k = 0; k < sizeof result / (sizeof word); k++) {
        memcpy(&word, (char *)&result + k * sizeof word, sizeof word);
        bits = ((bits << 7) | (bits >> 57)) ^ word;
    }
    return bits;
}

#endif
