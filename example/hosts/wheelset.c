/* Wheelsets from C: every figure of every contact, as bits. */
#include "wheelsets.h"

#include <inttypes.h>
#include <stdint.h>
#include <stdio.h>

static void show(int n, const double *numbers)
{
    uint64_t bits;
    int i;

    for (i = 0; i < n; i++) {
        memcpy(&bits, &numbers[i], sizeof bits);
        printf("%s%016" PRIX64, i > 0 ? " " : "", bits);
    }
    printf("\n");
}

static void show_contact(const faststrip_wheelset_contact *c)
{
    const double rows[][5] = {{c->radius, c->speed, c->cksi, c->ceta, c->cphi},
                              {c->load, c->penetration, c->area},
                              {c->pmax, c->y_min, c->y_max},
                              {c->x_max, c->fx, c->fy},
                              {c->mz, c->friction_power},
                              {c->est_err_penetration, c->est_err_pmax},
                              {c->est_err_area, c->est_err_fx},
                              {c->est_err_fy, c->est_err_mz, c->est_err_load}};
    const int lengths[] = {5, 3, 3, 3, 2, 2, 2, 3};
    double place[9] = {0.0}, forces[7];
    int i;

    printf("contact %d %d %d %d %d %d %d\n", c->side, c->status, c->n_patches, c->strips_across,
           c->is_estimated, c->forces_are_estimated, c->limitations);
    memcpy(place, c->place, sizeof c->place);
    place[3] = c->angle;
    memcpy(place + 4, c->rail, sizeof c->rail);
    memcpy(place + 6, c->wheel, sizeof c->wheel);
    show(9, place);
    forces[0] = c->stick_fraction;
    memcpy(forces + 1, c->force, sizeof c->force);
    memcpy(forces + 4, c->force_wheelset, sizeof c->force_wheelset);
    for (i = 0; i < 8; i++) {
        if (i == 5) {
            show(7, forces);
            show(3, c->moment);
        }
        show(lengths[i], rows[i]);
    }
}

enum { MOST_STRIPS = 400, MOST_ELEMENTS = 8000 };

/* The second strip of a contact, and an element in its first half. */
static void show_parts(faststrip_wheelset *wheelset, int k)
{
    static double a[8][MOST_ELEMENTS];
    static int patch[MOST_STRIPS], state[MOST_ELEMENTS];
    int n, m, i, j, status;

    status = faststrip_wheelset_get_strips(wheelset, k, MOST_STRIPS, &n, a[0], a[1], a[2], a[3],
                                           patch);
    status += faststrip_wheelset_get_strip_wear(wheelset, k, NULL, MOST_STRIPS, &n, a[4], a[5],
                                                a[6], a[7], a[7] + MOST_STRIPS,
                                                a[7] + 2 * MOST_STRIPS);
    for (i = 0; i < 7; i++) a[0][i] = a[i][1];
    status += faststrip_wheelset_get_elements(wheelset, k, MOST_ELEMENTS, &m, a[0] + 7, a[1], a[2],
                                              a[3], a[4], a[5], a[6], a[7], state);
    j = m / 3;
    printf("parts %d %d %d %d %d\n", status, n, m, patch[1], state[j]);
    show(7, a[0]);
    a[0][0] = a[0][7 + j];
    for (i = 1; i < 8; i++) a[0][i] = a[i][j];
    show(8, a[0]);
}

/* Columns of the derivatives, one by one. */
static void show_derivatives(faststrip_wheelset *wheelset)
{
    double d[2][6][9], column[6];
    int status = faststrip_wheelset_get_derivatives(wheelset, d), side, i, j;

    printf("derivatives %d\n", status);
    for (side = 0; side < 2 && status < FASTSTRIP_FIRST_ERROR; side++) {
        for (j = 0; j < 9; j++) {
            for (i = 0; i < 6; i++) column[i] = d[side][i][j];
            show(6, column);
        }
    }
}

int main(void)
{
    faststrip_wheelset_contact contacts[FASTSTRIP_MOST_CONTACTS];
    faststrip_wheelset_result result;
    faststrip_wheelset_demand demand;
    int setup, i, side, k, n, status;

    make_points();
    for (setup = 1; setup <= 2; setup++) {
        faststrip_wheelset *wheelset = make_wheelset(setup == 2);
        faststrip_wheelset_state state;
        uint64_t bits;

        memset(&state, 0, sizeof state);
        for (i = 1; i <= ASKED; i++) {
            ask_wheelset(i, &state, &demand);
            status = faststrip_wheelset_solve(wheelset, &state, &demand, FASTSTRIP_MOST_CONTACTS,
                                              &n, contacts, &result);
            printf("solved %d %d\n", status, n);
            for (side = 1; side <= 2; side++) {
                double sums[11];

                if (status >= FASTSTRIP_FIRST_ERROR || demand.wheels == 3 - side) continue;
                printf("wheel %d %d %d\n", result.status[side - 1], result.n_contacts[side - 1],
                       result.n_solutions[side - 1]);
                sums[0] = state.z = result.z[side - 1];
                sums[1] = state.roll = result.roll;
                memcpy(sums + 2, result.force[side - 1], sizeof result.force[0]);
                memcpy(sums + 5, result.force_wheelset[side - 1], sizeof result.force[0]);
                memcpy(sums + 8, result.moment[side - 1], sizeof result.force[0]);
                show(11, sums);
                for (k = 0; k < n; k++) {
                    if (contacts[k].side != side) continue;
                    show_contact(&contacts[k]);
                    show_parts(wheelset, k);
                }
            }
            if (status < FASTSTRIP_FIRST_ERROR) show_derivatives(wheelset);
        }
        /* What came between does not count where nothing starts warm. */
        bits = wheelset_bits(wheelset, &state, &demand, &status);
        ask_wheelset(5, &state, &demand);
        wheelset_bits(wheelset, &state, &demand, &status);
        ask_wheelset(ASKED, &state, &demand);
        if (wheelset_bits(wheelset, &state, &demand, &status) != bits) return 1;
        if (faststrip_wheelset_free(&wheelset) != 0) return 1;
    }
    return 0;
}
