/* Friction and wear from C: forces and figures of contacts and wheelsets, as bits. */
#include <faststrip.h>
#include <inttypes.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { POINTS = 301, STRIPS = 2000 };

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

static void solve_contact(faststrip_case c, const faststrip_wear_law *law, double yield, int known)
{
    static double y[POINTS], h[POINTS], a[POINTS], rows[6][STRIPS];
    faststrip_workspace *workspace = NULL;
    faststrip_result r;
    double figures[6];
    int i, k, n, status;

    for (i = 0; i < POINTS; i++) {
        y[i] = 0.1 * (i - 150);
        h[i] = 2e-3 * y[i] * y[i] + 3e-5 * y[i] * y[i] * y[i];
        a[i] = 1.0 / 920.0;
    }
    c.load = 8e4;
    c.cksi = 4e-3;
    c.ceta = -2e-3;
    c.cphi = 2e-4;
    if (faststrip_new(&c, POINTS, &workspace) != 0) exit(1);
    if (faststrip_set_gap(workspace, POINTS, y, h, a, NULL) != 0) exit(2);
    status = faststrip_solve(workspace, &c, &r);
    printf("contact %d\n", status);
    if (status < FASTSTRIP_FIRST_ERROR) {
        const double forces[3] = {r.fx, r.fy, r.mz};

        show(3, forces);
        if (faststrip_get_wear(workspace, known ? law : NULL, yield, figures) != 0) exit(3);
        show(4, figures);
        if (known) show(2, figures + 4);
        status = faststrip_get_strip_wear(workspace, law, STRIPS, &n, rows[0], rows[1], rows[2],
                                          rows[3], rows[4], rows[5]);
        if ((status == 0) != known) exit(4);
        for (i = 0; known && i < n; i++) {
            for (k = 0; k < 6; k++) figures[k] = rows[k][i];
            show(6, figures);
        }
    }
    faststrip_free(&workspace);
}

static void solve_wheels(faststrip_case c, const faststrip_wear_law *law, double yield, int known)
{
    faststrip_wheelset *wheelset = NULL;
    faststrip_wheelset_setup setup;
    faststrip_profile wheels[2], rails[2];
    faststrip_wheelset_state state;
    faststrip_wheelset_demand demand;
    faststrip_wheelset_contact contacts[FASTSTRIP_MOST_CONTACTS];
    faststrip_wheelset_result r;
    double figures[6];
    int i, n, status;

    memset(wheels, 0, sizeof wheels);
    memset(rails, 0, sizeof rails);
    memset(&state, 0, sizeof state);
    memset(&demand, 0, sizeof demand);
    wheels[0].name = "s1002";
    rails[0].name = "60e1";
    faststrip_default_wheelset(&setup, sizeof setup);
    if (faststrip_wheelset_new(&setup, wheels, rails, &c, &wheelset, NULL, 0) != 0) exit(5);
    state.y = 6.2;
    state.yaw = 1e-3;
    state.speed = 1e4;
    state.pitch_rate = -1e4 / 460.0;
    demand.kind = FASTSTRIP_BY_LOADS;
    demand.load_right = demand.load_left = 6e4;
    status = faststrip_wheelset_solve(wheelset, &state, &demand, FASTSTRIP_MOST_CONTACTS, &n,
                                      contacts, &r);
    printf("wheelset %d\n", status);
    for (i = 0; i < n; i++) {
        const double forces[3] = {contacts[i].fx, contacts[i].fy, contacts[i].mz};

        show(3, forces);
        status = faststrip_wheelset_get_wear(wheelset, i, known ? law : NULL, yield, figures);
        if (status != 0) exit(6);
        show(4, figures);
        if (known) show(2, figures + 4);
    }
    faststrip_wheelset_free(&wheelset);
}

int main(void)
{
    double regimes[4 * 32], yield;
    faststrip_wear_law law;
    faststrip_case c;
    int i, n;

    if (scanf("%d %d %lf %lf", &n, &law.n, &law.density, &yield) != 4) return 7;
    law.regimes = regimes;
    for (i = 0; i < 4 * law.n; i++)
        if (scanf("%lf", &regimes[i]) != 1) return 7;
    for (i = 0; i < n; i++) {
        faststrip_default_case(&c, sizeof c);
        if (scanf("%d %d %d %lf %lf %lf %lf %lf %lf %lf %lf %lf", &c.normal, &c.tangential,
                  &c.friction, &c.mu, &c.kinetic_share, &c.half_slip_speed, &c.speed,
                  &c.slope_factor, &c.flange_share, &c.tread_angle, &c.flange_angle,
                  &c.contact_angle) != 12)
            return 7;
        solve_contact(c, &law, yield, c.tangential == FASTSTRIP_TANGENTIAL_FASTSTRIP);
        solve_wheels(c, &law, yield, c.tangential == FASTSTRIP_TANGENTIAL_FASTSTRIP);
    }
    return 0;
}
