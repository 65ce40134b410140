/* The same figures by the C interface; see figures.f90. */
#include <faststrip.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST = 20000, STEPS = 20, POINTS = 400 };

static const struct { const char *name; int number; } methods[] = {
    /* BEGIN methods */
    {"strip", FASTSTRIP_NORMAL_STRIP},
    {"hertz", FASTSTRIP_NORMAL_HERTZ},
    {"equal_area", FASTSTRIP_NORMAL_EQUAL_AREA},
    {"equal_moments", FASTSTRIP_NORMAL_EQUAL_MOMENTS},
    {"auto", FASTSTRIP_NORMAL_AUTO},
    {"kpec", FASTSTRIP_NORMAL_KPEC},
    {"analyn", FASTSTRIP_NORMAL_ANALYN},
    {"kpec_strips", FASTSTRIP_NORMAL_KPEC_STRIPS},
    {"none", FASTSTRIP_TANGENTIAL_NONE},
    {"faststrip", FASTSTRIP_TANGENTIAL_FASTSTRIP},
    {"fastsim", FASTSTRIP_TANGENTIAL_FASTSIM},
    {"faststrip-paper", FASTSTRIP_TANGENTIAL_FASTSTRIP_PAPER},
    {"faststrip-corrected", FASTSTRIP_TANGENTIAL_FASTSTRIP_CORRECTED},
    {"fastsim-elliptic", FASTSTRIP_TANGENTIAL_FASTSIM_ELLIPTIC},
    {"fastsim-weighted", FASTSTRIP_TANGENTIAL_FASTSIM_WEIGHTED},
    {"linear", FASTSTRIP_TANGENTIAL_LINEAR},
    {"she", FASTSTRIP_TANGENTIAL_SHE},
    {"polach", FASTSTRIP_TANGENTIAL_POLACH},
    {"faststrip-plain", FASTSTRIP_TANGENTIAL_FASTSTRIP_PLAIN},
    /* END methods */
};

static int contact;
static double a[8][MOST];
static int k[MOST];

static int method_of(const char *name)
{
    size_t i;

    for (i = 0; i < sizeof methods / sizeof methods[0]; i++)
        if (strcmp(methods[i].name, name) == 0) return methods[i].number;
    exit(3);
}

static double number(void)
{
    double value;

    if (scanf("%lf", &value) != 1) exit(4);
    return value;
}

static int whole(void)
{
    int value;

    if (scanf("%d", &value) != 1) exit(5);
    return value;
}

static void put(const char *name, int step, int i, double value)
{
    printf("%s %d %d %d %.17e\n", name, contact, step, i, value);
}

static void show_arrays(faststrip_workspace *workspace, int step)
{
    int n, i;

    if (faststrip_get_strips(workspace, MOST, &n, a[0], a[1], a[2], a[3], k) != 0) exit(6);
    put("n_strips", step, 0, n);
    for (i = 0; i < n; i++) {
        put("strip_y_left", step, i + 1, a[0][i]);
        put("strip_y_right", step, i + 1, a[1][i]);
        put("strip_half_length", step, i + 1, a[2][i]);
        put("strip_p0", step, i + 1, a[3][i]);
        put("strip_patch", step, i + 1, k[i]);
    }
    if (faststrip_get_elements(workspace, MOST, &n, a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7],
                               k) != 0) exit(7);
    for (i = 0; i < n; i++) {
        put("element_x", step, i + 1, a[0][i]);
        put("element_y", step, i + 1, a[1][i]);
        put("element_area", step, i + 1, a[2][i]);
        put("element_pn", step, i + 1, a[3][i]);
        put("element_px", step, i + 1, a[4][i]);
        put("element_py", step, i + 1, a[5][i]);
        put("element_sx", step, i + 1, a[6][i]);
        put("element_sy", step, i + 1, a[7][i]);
        put("element_state", step, i + 1, k[i]);
    }
}

static void show_steps(faststrip_workspace *workspace, const faststrip_result *r, int step)
{
    int normal[STEPS], tangential[STEPS], strips[STEPS], points[STEPS], n, i;
    double estimate[STEPS], normal_us[STEPS], tangential_us[STEPS];

    put("n_steps", step, 0, r->n_steps);
    put("best_step", step, 0, r->best_step);
    put("target_is_known", step, 0, r->target_is_known);
    put("target_is_met", step, 0, r->target_is_met);
    put("est_err_target", step, 0, r->est_err_target);
    if (faststrip_get_steps(workspace, STEPS, &n, normal, tangential, strips, points, estimate,
                            normal_us, tangential_us) != 0 || n != r->n_steps) exit(13);
    for (i = 0; i < n; i++) {
        put("step_normal", step, i + 1, normal[i]);
        put("step_tangential", step, i + 1, tangential[i]);
        put("step_strips", step, i + 1, strips[i]);
        put("step_points", step, i + 1, points[i]);
        put("step_estimate", step, i + 1, estimate[i]);
        if (!(normal_us[i] > 0.0 && normal_us[i] < 1e8)) exit(14);
        if (!(tangential_us[i] >= 0.0 && tangential_us[i] < 1e8)) exit(15);
    }
}

static void solve(faststrip_workspace *workspace, faststrip_case *c, const double *demand, int step)
{
    faststrip_result r;
    char text[FASTSTRIP_TEXT];

    c->e_wheel = demand[0];
    c->e_rail = demand[1];
    c->nu_wheel = demand[2];
    c->nu_rail = demand[3];
    c->mu = demand[4];
    c->load = demand[5];
    c->penetration = demand[6];
    c->cksi = demand[7];
    c->ceta = demand[8];
    c->cphi = demand[9];
    memset(&r, 0x55, sizeof r);
    put("status", step, 0, faststrip_solve(workspace, c, &r));
    faststrip_last_message(workspace, text, sizeof text);
    printf("message %d %d %s\n", contact, step, text);
    put("load", step, 0, r.load);
    put("penetration", step, 0, r.penetration);
    put("area", step, 0, r.area);
    put("pmax", step, 0, r.pmax);
    put("y_min", step, 0, r.y_min);
    put("y_max", step, 0, r.y_max);
    put("x_max", step, 0, r.x_max);
    put("cksi", step, 0, r.cksi);
    put("ceta", step, 0, r.ceta);
    put("fx", step, 0, r.fx);
    put("fy", step, 0, r.fy);
    put("mz", step, 0, r.mz);
    put("friction_power", step, 0, r.friction_power);
    put("stick_fraction", step, 0, r.stick_fraction);
    put("n_patches", step, 0, r.n_patches);
    put("iterations", step, 0, r.iterations);
    put("n_elements", step, 0, r.n_elements);
    put("is_estimated", step, 0, r.is_estimated);
    put("strips_across", step, 0, r.strips_across);
    put("est_err_penetration", step, 0, r.est_err_penetration);
    put("est_err_pmax", step, 0, r.est_err_pmax);
    put("est_err_area", step, 0, r.est_err_area);
    put("residual_inside", step, 0, r.residual_inside);
    put("overlap_outside", step, 0, r.overlap_outside);
    put("forces_are_estimated", step, 0, r.forces_are_estimated);
    put("est_err_fx", step, 0, r.est_err_fx);
    put("est_err_fy", step, 0, r.est_err_fy);
    put("est_err_mz", step, 0, r.est_err_mz);
    put("est_err_cksi", step, 0, r.est_err_cksi);
    put("est_err_ceta", step, 0, r.est_err_ceta);
    put("limitations", step, 0, r.limitations);
    show_steps(workspace, &r, step);
    show_arrays(workspace, step);
    put("result_n_strips", step, 0, r.n_strips);
}

static void without_workspace(void)
{
    double x[13], f[4];
    int i, j, nx, ny;

    contact = 0;
    for (i = 1; i <= 5; i++) {
        for (j = 0; j < 11; j++) x[j] = number();
        nx = whole();
        ny = whole();
        put("fastsim_status", i, 0,
            faststrip_fastsim(x[0], x[1], x[2], x[3], x[4], x[5], x[6], x[7], x[8], x[9], x[10], nx,
                              ny, f));
        put("fastsim_fx", i, 0, f[0]);
        put("fastsim_fy", i, 0, f[1]);
        put("fastsim_mz", i, 0, f[2]);
    }
    for (i = 1; i <= 5; i++) {
        for (j = 0; j < 7; j++) x[j] = number();
        put("hertz_status", i, 0, faststrip_hertz(x[0], x[1], x[2], x[3], x[4], x[5], x[6], f));
        put("hertz_a", i, 0, f[0]);
        put("hertz_b", i, 0, f[1]);
        put("hertz_penetration", i, 0, f[2]);
        put("hertz_pmax", i, 0, f[3]);
    }
    for (i = 1; i <= 5; i++) {
        for (j = 0; j < 2; j++) x[j] = number();
        put("kalker_status", i, 0, faststrip_kalker(x[0], x[1], f));
        put("kalker_c11", i, 0, f[0]);
        put("kalker_c22", i, 0, f[1]);
        put("kalker_c23", i, 0, f[2]);
        put("kalker_c33", i, 0, f[3]);
    }
}

static void defaults(void)
{
    faststrip_case c;

    if (faststrip_default_case(&c, sizeof c) != 0) exit(8);
    put("default_normal", 0, 0, c.normal);
    put("default_tangential", 0, 0, c.tangential);
    put("default_strips_per_patch", 0, 0, c.strips_per_patch);
    put("default_points_per_strip", 0, 0, c.points_per_strip);
    put("default_fastsim_nx", 0, 0, c.fastsim_nx);
    put("default_fastsim_ny", 0, 0, c.fastsim_ny);
    put("default_by_load", 0, 0, c.by_load);
    put("default_warm_start", 0, 0, c.warm_start);
    put("default_with_elements", 0, 0, c.with_elements);
    put("default_e_wheel", 0, 0, c.e_wheel);
    put("default_e_rail", 0, 0, c.e_rail);
    put("default_nu_wheel", 0, 0, c.nu_wheel);
    put("default_nu_rail", 0, 0, c.nu_rail);
    put("default_mu", 0, 0, c.mu);
    put("default_load", 0, 0, c.load);
    put("default_penetration", 0, 0, c.penetration);
    put("default_cksi", 0, 0, c.cksi);
    put("default_ceta", 0, 0, c.ceta);
    put("default_cphi", 0, 0, c.cphi);
    put("default_estimate", 0, 0, c.estimate);
    put("default_resolution_limit", 0, 0, c.resolution_limit);
    put("default_force_limit", 0, 0, c.force_limit);
    put("default_target", 0, 0, c.target);
    put("default_tolerance", 0, 0, c.tolerance);
    put("default_budget_us", 0, 0, c.budget_us);
}

int main(void)
{
    static double y[POINTS], h[POINTS], inv2r[POINTS], inclination[POINTS];
    faststrip_workspace *workspace, *copy;
    faststrip_case c;
    double demand[2][10];
    char normal[40], tangential[40], text[FASTSTRIP_TEXT];
    int contacts, has_inclination, n, i, code;

    defaults();
    for (code = -1; code <= 130; code++) {
        faststrip_message(code, text, sizeof text);
        printf("word 0 %d %s\n", code, text);
    }
    contacts = whole();
    for (contact = 1; contact <= contacts; contact++) {
        faststrip_default_case(&c, sizeof c);
        if (scanf("%39s %39s", normal, tangential) != 2) exit(9);
        whole();
        whole();
        c.normal = method_of(normal);
        c.tangential = method_of(tangential);
        c.strips_per_patch = whole();
        c.points_per_strip = whole();
        c.fastsim_nx = whole();
        c.fastsim_ny = whole();
        c.by_load = whole();
        c.with_elements = whole();
        has_inclination = whole();
        c.estimate = whole();
        c.resolution_limit = c.force_limit = number();
        c.target = whole();
        c.tolerance = number();
        n = whole();
        for (i = 0; i < 20; i++) demand[i / 10][i % 10] = number();
        for (i = 0; i < n; i++) {
            y[i] = number();
            h[i] = number();
            inv2r[i] = number();
            inclination[i] = number();
        }
        if (faststrip_new(&c, n, &workspace) != 0 || faststrip_new(&c, n, &copy) != 0) exit(10);
        if (faststrip_set_gap(workspace, n, y, h, inv2r,
                              has_inclination ? inclination : NULL) != 0) exit(11);
        solve(workspace, &c, demand[0], 1);
        if (faststrip_copy(workspace, copy) != 0) exit(12);
        show_arrays(copy, 2);
        c.warm_start = 1;
        solve(workspace, &c, demand[1], 3);
        solve(copy, &c, demand[1], 4);
        faststrip_free(&workspace);
        faststrip_free(&copy);
    }
    without_workspace();
    return 0;
}
