/* A host that looks after its floating-point environment, memory, files, locale and stack.
 * `host WHAT` prints one line per finding; the test reads them. */
#define _GNU_SOURCE
#include "contacts.h"
#include "wheelsets.h"

#include <fcntl.h>
#include <fenv.h>
#include <limits.h>
#include <locale.h>
#include <pthread.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#ifdef COUNTING
/* Stand in for the C library's functions, in the program and in all libraries it loads. */
extern void *__libc_malloc(size_t);
extern void *__libc_calloc(size_t, size_t);
extern void *__libc_realloc(void *, size_t);
extern void *__libc_memalign(size_t, size_t);
static long allocations, file_calls;
void *malloc(size_t n) { allocations++; return __libc_malloc(n); }
void *calloc(size_t n, size_t m) { allocations++; return __libc_calloc(n, m); }
void *realloc(void *p, size_t n) { allocations++; return __libc_realloc(p, n); }
void *aligned_alloc(size_t a, size_t n) { allocations++; return __libc_memalign(a, n); }
int posix_memalign(void **p, size_t a, size_t n)
{ allocations++; *p = __libc_memalign(a, n); return *p ? 0 : 12; }
ssize_t write(int file, const void *from, size_t n)
{ file_calls++; return syscall(SYS_write, file, from, n); }
ssize_t read(int file, void *to, size_t n)
{ file_calls++; return syscall(SYS_read, file, to, n); }
int open(const char *name, int flags, ...)
{
    va_list rest;
    int mode;

    va_start(rest, flags);
    mode = va_arg(rest, int);
    va_end(rest);
    file_calls++;
    return (int)syscall(SYS_openat, AT_FDCWD, name, flags, mode);
}
int open64(const char *name, int flags, ...) __attribute__((alias("open")));
#endif

static const double hostile[] = {NAN, INFINITY, -INFINITY, 0.0, -0.0, -1.0, 1e-320, 1e-300, 1e300,
                                 1.7e308, 5e-324};
enum { HOSTILE = sizeof hostile / sizeof hostile[0], EXAMPLES = 40 };

/* Made before anything is watched: making them is arithmetic of the host's own. */
static example examples[EXAMPLES];
static faststrip_wheelset_state states[ASKED];
static faststrip_wheelset_demand demands[ASKED];

static const double wear_regimes[8] = {0.0, 3.0, 0.5, 1.0, 3.0, 1e9, 2.0, 0.1};
static const faststrip_wear_law wear_law = {2, wear_regimes, 7850.0};

/* A wheelset that is made, solved with every number in turn hostile, and freed. */
static long every_wheelset(void)
{
    faststrip_wheelset *wheelset = make_wheelset(1);
    faststrip_wheelset_contact contacts[FASTSTRIP_MOST_CONTACTS];
    faststrip_wheelset_result result;
    char text[FASTSTRIP_TEXT];
    static double slopes[2][6][9];
    double figures[6];
    long failures = 0;
    int i, n, status;

    for (i = 0; i < 15; i++) {
        faststrip_wheelset_state state = states[i % 6];
        faststrip_wheelset_demand demand = demands[i % 6];
        double *field = i < 11 ? &state.y + i : &demand.load_right + (i - 11);

        *field = hostile[i % HOSTILE];
        failures += faststrip_wheelset_solve(wheelset, &state, &demand, FASTSTRIP_MOST_CONTACTS,
                                             &n, contacts, &result) >= 100;
        faststrip_wheelset_last_message(wheelset, text, sizeof text);
        wheelset_bits(wheelset, &states[i % ASKED], &demands[i % ASKED], &status);
        failures += status >= 100;
        failures += faststrip_wheelset_get_derivatives(wheelset, slopes) >= 100;
        failures += faststrip_wheelset_get_wear(wheelset, 0, &wear_law, 300.0, figures) >= 100;
        failures += faststrip_wheelset_get_wear(wheelset, 0, NULL, hostile[i % HOSTILE],
                                                figures) >= 100;
    }
    failures += faststrip_wheelset_free(&wheelset) >= 100;
    return failures;
}

/* All numbers of a case in turn hostile, the gap too; calls that fail and calls that do not. */
static long every_contact(faststrip_workspace *workspace)
{
    double *field[22], forces[3], figures[6], c[4], array[4][400], slopes[4][4];
    int integers[400];
    char text[FASTSTRIP_TEXT];
    faststrip_result result;
    long failures = 0;
    int number, i, k, n;

    for (number = 0; number < EXAMPLES; number++) {
        example e = examples[number];
        double *all[22] = {&e.contact.e_wheel, &e.contact.e_rail, &e.contact.nu_wheel,
                           &e.contact.nu_rail, &e.contact.mu, &e.contact.load,
                           &e.contact.penetration, &e.contact.cksi, &e.contact.ceta,
                           &e.contact.cphi, &e.contact.resolution_limit,
                           &e.contact.force_limit, &e.contact.tolerance,
                           &e.contact.budget_us, &e.contact.kinetic_share,
                           &e.contact.half_slip_speed, &e.contact.speed, &e.contact.slope_factor,
                           &e.contact.flange_share, &e.contact.tread_angle,
                           &e.contact.flange_angle, &e.contact.contact_angle};
        memcpy(field, all, sizeof all);
        e.contact.with_elements = number % 2;
        failures += faststrip_set_gap(workspace, POINTS, e.y, e.h, e.inv2r, NULL) >= 100;
        failures += faststrip_solve(workspace, &e.contact, &result) >= 100;
        failures += faststrip_get_derivatives(workspace, slopes) >= 100;
        faststrip_get_strips(workspace, 400, &n, array[0], array[1], array[2], array[3], integers);
        faststrip_get_steps(workspace, 400, &n, integers, integers, integers, integers, array[0],
                            array[1], array[2]);
        failures += faststrip_get_wear(workspace, &wear_law, 300.0, figures) >= 100;
        failures += faststrip_get_strip_wear(workspace, &wear_law, 400, &n, array[0], array[1],
                                             array[2], array[3], array[3], array[3]) >= 100;
        failures += faststrip_get_wear(workspace, NULL, hostile[number % HOSTILE], figures) >= 100;
        e.contact.flange_share = 0.5;
        e.contact.flange_angle = 0.3;
        for (i = 0; i < 22; i++) {
            double kept = *field[i];
            k = (number + i) % HOSTILE;
            *field[i] = hostile[k];
            e.contact.friction = i % 5;
            failures += faststrip_solve(workspace, &e.contact, &result) >= 100;
            faststrip_last_message(workspace, text, sizeof text);
            *field[i] = kept;
        }
        e.h[number] = hostile[number % HOSTILE];
        failures += faststrip_set_gap(workspace, POINTS, e.y, e.h, e.inv2r, NULL) >= 100;
        failures += faststrip_solve(workspace, &e.contact, &result) >= 100;
    }
    for (i = 0; i < HOSTILE; i++) {
        const double x = hostile[i];
        failures += faststrip_fastsim(x, 5.0, 8e4, 4.0, 4.0, 1.5, 1e-3, 0.0, 0.0, 0.3, 1e5, 9, 9,
                                      forces) >= 100;
        failures += faststrip_fastsim(6.0, 5.0, x, x, 4.0, 1.5, x, x, 0.0, 0.3, 1e5, 9, 9,
                                      forces) >= 100;
        failures += faststrip_fastsim(6.0, 5.0, 8e4, 4.0, 4.0, 1.5, 1e-3, 0.0, x, x, x, 9, 9,
                                      forces) >= 100;
        failures += faststrip_hertz(2e5, 2e5, 0.3, 0.3, x, 1e-3, 1e5, figures) >= 100;
        failures += faststrip_hertz(x, 2e5, x, 0.3, 1e-3, 1e-3, x, figures) >= 100;
        failures += faststrip_kalker(x, 0.3, c) >= 100;
        failures += faststrip_kalker(1.0, x, c) >= 100;
    }
    return failures;
}

static long every_call(faststrip_workspace *workspace)
{
    return every_contact(workspace) + every_wheelset();
}

/* Flags, traps and rounding before and after, with the host trapping all that is serious. */
static void arithmetic(void)
{
    static const int roundings[] = {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO};
    faststrip_workspace *workspace = make_workspace();
    const int serious = FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW;
    volatile double big = 1e300;
    int i;

    for (i = 0; i < 4; i++) {
        feclearexcept(FE_ALL_EXCEPT);
        fesetround(roundings[i]);
        feenableexcept(serious);
        printf("failures %ld\n", every_call(workspace));
        printf("traps %d\n", fegetexcept() == serious);
        fedisableexcept(FE_ALL_EXCEPT);
        printf("rounding %d\n", fegetround() == roundings[i]);
        fesetround(FE_TONEAREST);
    }
    feclearexcept(FE_ALL_EXCEPT);
    every_call(workspace);
    printf("raised %d\n", fetestexcept(FE_ALL_EXCEPT));
    big *= big;
    every_call(workspace);
    printf("kept %d\n", fetestexcept(FE_ALL_EXCEPT) == (FE_OVERFLOW | FE_INEXACT));
    faststrip_free(&workspace);
}

/* The locale, in the whole program and in the thread. */
static void locale_kept(void)
{
    faststrip_workspace *workspace = make_workspace();
    locale_t own = newlocale(LC_ALL_MASK, "C.UTF-8", (locale_t)0);
    char *before;

    setlocale(LC_ALL, "C.UTF-8");
    before = strdup(setlocale(LC_ALL, NULL));
    every_call(workspace);
    printf("program %d\n", strcmp(before, setlocale(LC_ALL, NULL)) == 0);
    uselocale(own);
    every_call(workspace);
    printf("thread %d\n", own != (locale_t)0 && uselocale((locale_t)0) == own);
    uselocale(LC_GLOBAL_LOCALE);
    freelocale(own);
    free(before);
    faststrip_free(&workspace);
}

#ifdef COUNTING
/* Allocations while solving, files touched by anything. */
static void quiet(void)
{
    faststrip_workspace *workspace = make_workspace();
    char line[100];
    long before, solving = 0, solved = 0, limited = 0, rough = 0, missed = 0, made, files, failures;
    long rolling = 0, rolled = 0;
    faststrip_wheelset *wheelset = make_wheelset(0);
    long worn = 0, wearing = 0;
    enum { MOST = 4000 };
    static double a[8][MOST];
    static int k[MOST];
    double figures[6];
    int i, n, status;

    /* The linear algebra library sets itself up in its first call. */
    for (i = 0; i < 10; i++) solve_example(workspace, (uint64_t)i, &status);
    for (i = 0; i < 500; i++) {
        before = allocations;
        solve_example(workspace, (uint64_t)i, &status);
        if (status >= FASTSTRIP_FIRST_ERROR) continue;
        solving += allocations - before;
        solved++;
        limited += status != FASTSTRIP_OK;
        rough += status == FASTSTRIP_UNDER_RESOLVED;
        missed += status == FASTSTRIP_TARGET_MISSED;
        before = allocations;
        if (faststrip_get_wear(workspace, &wear_law, 300.0, figures) != FASTSTRIP_OK) continue;
        wearing += allocations - before;
        worn++;
    }
    for (i = 0; i < ASKED; i++) {
        before = allocations;
        wheelset_bits(wheelset, &states[i], &demands[i], &status);
        if (status >= FASTSTRIP_FIRST_ERROR) continue;
        worn += !faststrip_wheelset_get_wear(wheelset, 0, &wear_law, 300.0, figures);
        worn += !faststrip_wheelset_get_strip_wear(wheelset, 0, &wear_law, MOST, &n, a[0], a[1],
                                                   a[2], a[3], a[4], a[5]);
        worn += !faststrip_wheelset_get_strips(wheelset, 0, MOST, &n, a[0], a[1], a[2], a[3], k);
        worn += !faststrip_wheelset_get_elements(wheelset, 0, MOST, &n, a[0], a[1], a[2], a[3],
                                                 a[4], a[5], a[6], a[7], k);
        rolling += allocations - before;
        rolled++;
    }
    before = file_calls;
    failures = every_call(workspace);
    faststrip_free(&workspace);
    faststrip_wheelset_free(&wheelset);
    workspace = make_workspace();
    files = file_calls - before;
    faststrip_free(&workspace);
    before = allocations;
    workspace = make_workspace();
    faststrip_free(&workspace);
    made = allocations - before;
    n = snprintf(line, sizeof line, "solved %ld\nsolving %ld\nfiles %ld\nfailures %ld\n", solved,
                 solving, files, failures);
    if (write(1, line, (size_t)n) != n) exit(2);
    n = snprintf(line, sizeof line, "limited %ld\nrough %ld\nmissed %ld\n", limited, rough,
                 missed);
    if (write(1, line, (size_t)n) != n) exit(2);
    n = snprintf(line, sizeof line, "worn %ld\nwearing %ld\n", worn, wearing);
    if (write(1, line, (size_t)n) != n) exit(2);
    n = snprintf(line, sizeof line, "rolled %ld\nrolling %ld\n", rolled, rolling);
    if (write(1, line, (size_t)n) != n) exit(2);
    n = snprintf(line, sizeof line, "making %ld\nwritten %ld\n", made, file_calls);
    if (write(1, line, (size_t)n) != n) exit(2);
}
#endif

/* How much of a painted stack is touched. */
enum { STACK = 4 * 1024 * 1024 };
static unsigned char stack[STACK] __attribute__((aligned(4096)));
static faststrip_workspace *stack_workspace;

static void *on_stack(void *argument)
{
    int status, i;

    if (argument == NULL) return NULL;
    if (argument != &stack_workspace) {
        every_wheelset();
        return NULL;
    }
    every_contact(stack_workspace);
    for (i = 0; i < 2000; i++) solve_example(stack_workspace, (uint64_t)i, &status);
    return NULL;
}

static long touched(void *argument)
{
    pthread_attr_t attributes;
    pthread_t thread;
    long i;

    memset(stack, 0xa5, STACK);
    pthread_attr_init(&attributes);
    pthread_attr_setstack(&attributes, stack, STACK);
    pthread_create(&thread, &attributes, on_stack, argument);
    pthread_join(thread, NULL);
    for (i = 0; i < STACK; i++)
        if (stack[i] != 0xa5) break;
    return STACK - i;
}

static void stack_use(void)
{
    long empty;

    stack_workspace = make_workspace();
    empty = touched(NULL);
    printf("stack %ld\n", touched(&stack_workspace) - empty);
    printf("wheelset %ld\n", touched(stack) - empty);
    faststrip_free(&stack_workspace);
}

/* Workspaces of all sizes while memory runs out: an answer every time. */
static void little_memory(void)
{
    faststrip_case contact;
    faststrip_workspace *workspace;
    struct rlimit limit;
    int status, strips, made = 0, refused = 0;

    solve_example(workspace = make_workspace(), 1, &status);
    faststrip_free(&workspace);
    getrlimit(RLIMIT_AS, &limit);
    limit.rlim_cur = 400u * 1024u * 1024u;
    setrlimit(RLIMIT_AS, &limit);
    faststrip_default_case(&contact, sizeof contact);
    for (strips = 3; strips <= 1000; strips += 61) {
        contact.strips_per_patch = strips;
        contact.with_elements = strips % 2;
        contact.fastsim_nx = contact.fastsim_ny = 10 * strips;
        if (faststrip_new(&contact, 1000 * strips, &workspace) == 0) made++;
        else refused++;
        faststrip_free(&workspace);
    }
    printf("made %d\nrefused %d\n", made, refused);
}

static void memory(void)
{
    faststrip_workspace *workspace = make_workspace(), *other = make_workspace();
    int status;

    printf("failures %ld\n", every_call(workspace));
    printf("copy %d\n", faststrip_copy(workspace, other));
    solve_example(other, 3, &status);
    faststrip_free(&workspace);
    faststrip_free(&other);
}

/* Is a value what it should be? */
static int checked, wrong_lines;

#define EXPECT(value, call) \
    do { \
        checked++; \
        if ((int)(call) != (value)) { \
            wrong_lines++; \
            printf("line %d\n", __LINE__); \
        } \
    } while (0)

/* What auto refuses, what it misses, and that its steps go with its result. */
static void wanted_errors(faststrip_workspace *workspace)
{
    faststrip_workspace *plain, *copy = make_workspace();
    example e = examples[2];
    faststrip_case other;
    faststrip_result result;
    double a[400];
    int k[400], n = -1, i;
    char text[FASTSTRIP_TEXT];

    faststrip_default_case(&other, sizeof other);
    EXPECT(0, faststrip_new(&other, POINTS, &plain));
    EXPECT(0, faststrip_set_gap(plain, POINTS, e.y, e.h, e.inv2r, NULL));
    EXPECT(0, faststrip_set_gap(workspace, POINTS, e.y, e.h, e.inv2r, NULL));
    e.contact.normal = FASTSTRIP_NORMAL_AUTO;
    e.contact.tangential = FASTSTRIP_TANGENTIAL_FASTSTRIP;
    EXPECT(FASTSTRIP_WORKSPACE_TOO_SMALL, faststrip_solve(plain, &e.contact, &result));
    EXPECT(0, faststrip_last_message(plain, text, sizeof text));
    EXPECT(1, strstr(text, "not reserved for normal method auto") != NULL);
    EXPECT(0, faststrip_free(&plain));
    for (i = 0; i < 8; i++) {
        const int targets[] = {0, 6, -1, 1, 1, 1, 1, 5};
        const double tolerances[] = {0.02, 0.02, 0.02, -0.5, NAN, 0.02, 0.0, 0.02};
        const double budgets[] = {0.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0};
        const char *says[] = {"1 to 5, got 0", "got 6", "got -1", "the tolerance must be",
                              "got NaN", "the budget must be", "both are 0",
                              "needs a tangential method"};

        e.contact.target = targets[i];
        e.contact.tolerance = tolerances[i];
        e.contact.budget_us = budgets[i];
        e.contact.tangential = i < 7 ? 1 : 0;
        EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_solve(workspace, &e.contact, &result));
        EXPECT(0, faststrip_last_message(workspace, text, sizeof text));
        EXPECT(1, strstr(text, says[i]) != NULL);
        EXPECT(1, result.n_steps == 0 && result.load == 0.0 && result.est_err_target == 0.0);
    }
    e.contact.target = FASTSTRIP_TARGET_PMAX;
    e.contact.force_limit = -1.0;
    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_solve(workspace, &e.contact, &result));
    e.contact.force_limit = 0.1;
    e.contact.tolerance = 1e-9;
    EXPECT(FASTSTRIP_TARGET_MISSED, faststrip_solve(workspace, &e.contact, &result));
    EXPECT(1, result.n_steps > 1 && !result.target_is_met && result.target_is_known);
    EXPECT(1, result.est_err_target == result.est_err_pmax && result.est_err_target > 1e-9);
    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_get_steps(NULL, 9, &n, k, k, k, k, a, a, a));
    EXPECT(FASTSTRIP_BAD_ARGUMENT,
           faststrip_get_steps(workspace, 9, NULL, k, k, k, k, a, a, a));
    EXPECT(FASTSTRIP_BAD_ARGUMENT,
           faststrip_get_steps(workspace, 9, &n, k, k, k, NULL, a, a, a));
    EXPECT(FASTSTRIP_WORKSPACE_TOO_SMALL,
           faststrip_get_steps(workspace, 1, &n, k, k, k, k, a, a, a));
    EXPECT(1, n == result.n_steps);
    EXPECT(0, faststrip_copy(workspace, copy));
    EXPECT(0, faststrip_get_steps(copy, 9, &n, k, k + 100, k + 200, k + 300, a, a + 100, a + 200));
    EXPECT(1, n == result.n_steps && a[result.best_step - 1] == result.est_err_target);
    EXPECT(1, k[n - 1] == FASTSTRIP_NORMAL_STRIP && k[200 + n - 1] > 15);
    EXPECT(0, faststrip_free(&copy));
    /* Time for an ellipse or the first strips, and for no more. */
    e.contact.tolerance = 0.0;
    e.contact.budget_us = 1e-3;
    EXPECT(1, faststrip_solve(workspace, &e.contact, &result) < FASTSTRIP_FIRST_ERROR);
    EXPECT(1, result.n_steps == 1 && result.best_step == 1 && !result.target_is_met);
    e.contact.budget_us = 1e9;
    EXPECT(1, faststrip_solve(workspace, &e.contact, &result) < FASTSTRIP_FIRST_ERROR);
    EXPECT(1, result.n_steps > 1 && result.load > 0.0);
    e.contact.normal = FASTSTRIP_NORMAL_STRIP;
    EXPECT(1, faststrip_solve(workspace, &e.contact, &result) < FASTSTRIP_FIRST_ERROR);
    EXPECT(1, result.n_steps == 0 && result.best_step == 0 && result.est_err_target == 0.0);
    EXPECT(0, faststrip_get_steps(workspace, 0, &n, k, k, k, k, a, a, a));
    EXPECT(0, n);
}

/* Wear of what was not solved, or not by strips; pointers that are null, laws that are none. */
static void wear_errors(faststrip_workspace *workspace)
{
    example e = examples[0];
    faststrip_workspace *none = NULL, *empty = make_workspace();
    faststrip_wheelset *wheelset = make_wheelset(0), *gone = NULL;
    faststrip_wear_law law = wear_law;
    faststrip_result result;
    double f[6], a[400], slopes[2][6][9];
    size_t length;
    char text[FASTSTRIP_TEXT];
    faststrip_wheelset_state state;
    faststrip_wheelset_demand demand;
    int n, k[400];

    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_get_wear(none, &law, 0.0, f));
    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_get_wear(empty, &law, 0.0, f));
    EXPECT(0, faststrip_last_message(empty, text, sizeof text));
    EXPECT(0, strcmp(text, "there is no contact that was solved"));
    e.contact.tangential = FASTSTRIP_TANGENTIAL_FASTSTRIP;
    EXPECT(1, faststrip_solve(workspace, &e.contact, &result) < FASTSTRIP_FIRST_ERROR);
    EXPECT(1, result.load > 0.0);
    /* What was refused leaves nothing of the contact before. */
    e.contact.flange_share = 0.5;
    e.contact.flange_angle = 0.5;
    e.contact.contact_angle = NAN;
    EXPECT(FASTSTRIP_NOT_FINITE, faststrip_solve(workspace, &e.contact, &result));
    EXPECT(1, result.load == 0.0 && result.fx == 0.0);
    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_get_wear(workspace, NULL, 0.0, f));
    e.contact.contact_angle = 0.2;
    EXPECT(1, faststrip_solve(workspace, &e.contact, &result) < FASTSTRIP_FIRST_ERROR);
    f[4] = f[5] = 7.0;
    EXPECT(0, faststrip_get_wear(workspace, NULL, 0.0, f));
    EXPECT(1, f[0] > 0.0 && f[1] >= f[0] && f[3] == 0.0 && f[4] == 0.0 && f[5] == 0.0);
    EXPECT(0, faststrip_get_wear(workspace, &law, 300.0, f));
    EXPECT(1, f[3] != 0.0 && f[4] > 0.0 && f[5] > 0.0);
    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_get_wear(workspace, &law, 300.0, NULL));
    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_get_wear(workspace, &law, -1.0, f));
    EXPECT(1, f[0] == 0.0 && f[4] == 0.0);
    law.n = 0;
    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_get_wear(workspace, &law, 300.0, f));
    EXPECT(0, faststrip_last_message(workspace, text, sizeof text));
    EXPECT(1, strstr(text, "must have regimes, got 0") != NULL);
    law.n = 1;
    law.regimes = NULL;
    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_get_wear(workspace, &law, 300.0, f));
    law.regimes = wear_regimes + 4;
    EXPECT(FASTSTRIP_NOT_INCREASING, faststrip_get_wear(workspace, &law, 300.0, f));
    law = wear_law;
    law.density = NAN;
    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_get_wear(workspace, &law, 300.0, f));
    law = wear_law;
    EXPECT(FASTSTRIP_WORKSPACE_TOO_SMALL,
           faststrip_get_strip_wear(workspace, &law, 1, &n, a, a, a, a, a, a));
    EXPECT(1, n == result.n_strips);
    EXPECT(FASTSTRIP_BAD_ARGUMENT,
           faststrip_get_strip_wear(workspace, &law, 400, NULL, a, a, a, a, a, a));
    EXPECT(FASTSTRIP_BAD_ARGUMENT,
           faststrip_get_strip_wear(workspace, &law, 400, &n, a, a, a, a, a, NULL));
    EXPECT(FASTSTRIP_BAD_ARGUMENT,
           faststrip_get_strip_wear(none, &law, 400, &n, a, a, a, a, a, a));
    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_wheelset_get_wear(gone, 0, &law, 300.0, f));
    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_wheelset_get_wear(wheelset, 0, &law, 300.0, f));
    EXPECT(0, faststrip_wheelset_last_message(wheelset, text, sizeof text));
    EXPECT(0, strcmp(text, "there is no such contact: 0"));
    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_wheelset_get_wear(wheelset, 0, &law, 300.0, NULL));
    EXPECT(FASTSTRIP_BAD_ARGUMENT,
           faststrip_wheelset_get_strips(wheelset, 0, 400, &n, a, a, a, a, k));
    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_wheelset_get_derivatives(wheelset, slopes));
    EXPECT(0, faststrip_wheelset_last_message(wheelset, text, sizeof text));
    EXPECT(0, strcmp(text, "there is no solution of the wheelset"));
    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_wheelset_get_derivatives(wheelset, NULL));
    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_wheelset_get_derivatives(gone, slopes));
    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_get_derivatives(none, (double (*)[4])slopes));
    EXPECT(FASTSTRIP_WORKSPACE_TOO_SMALL, faststrip_wheelset_save(wheelset, 0, &length, NULL));
    EXPECT(1, length > 100 && length <= sizeof a);
    EXPECT(FASTSTRIP_WORKSPACE_TOO_SMALL,
           faststrip_wheelset_save(wheelset, length - 1, &length, a));
    EXPECT(0, faststrip_wheelset_save(wheelset, length, &length, a));
    EXPECT(0, faststrip_wheelset_restore(wheelset, length, a));
    EXPECT(FASTSTRIP_FILE_FORMAT, faststrip_wheelset_restore(wheelset, length - 1, a));
    EXPECT(0, faststrip_wheelset_last_message(wheelset, text, sizeof text));
    EXPECT(0, strcmp(text, "the memory of a wheelset is cut"));
    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_wheelset_save(wheelset, length, NULL, a));
    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_wheelset_save(wheelset, length, &length, NULL));
    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_wheelset_save(gone, length, &length, a));
    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_wheelset_restore(wheelset, length, NULL));
    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_wheelset_restore(gone, length, a));
    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_get_derivatives(workspace, NULL));
    EXPECT(FASTSTRIP_BAD_ARGUMENT,
           faststrip_wheelset_get_elements(wheelset, 0, 400, &n, a, a, a, a, a, a, a, a, k));
    EXPECT(FASTSTRIP_BAD_ARGUMENT,
           faststrip_wheelset_get_strip_wear(wheelset, 0, &law, 400, &n, a, a, a, a, a, a));
    memset(&state, 0, sizeof state);
    ask_wheelset(1, &state, &demand);
    wheelset_bits(wheelset, &state, &demand, &n);
    EXPECT(1, n < FASTSTRIP_FIRST_ERROR);
    EXPECT(FASTSTRIP_WORKSPACE_TOO_SMALL,
           faststrip_wheelset_get_strips(wheelset, 0, 0, &n, a, a, a, a, k));
    EXPECT(1, n > 8 && n < 400);
    EXPECT(FASTSTRIP_BAD_ARGUMENT,
           faststrip_wheelset_get_strips(wheelset, 0, 400, NULL, a, a, a, a, k));
    EXPECT(FASTSTRIP_BAD_ARGUMENT,
           faststrip_wheelset_get_strips(wheelset, 0, 400, &n, a, a, a, NULL, k));
    EXPECT(FASTSTRIP_BAD_ARGUMENT,
           faststrip_wheelset_get_strips(wheelset, -1, 400, &n, a, a, a, a, k));
    EXPECT(FASTSTRIP_BAD_ARGUMENT,
           faststrip_wheelset_get_strips(wheelset, 16, 400, &n, a, a, a, a, k));
    EXPECT(FASTSTRIP_WORKSPACE_TOO_SMALL,
           faststrip_wheelset_get_elements(wheelset, 0, 9, &n, a, a, a, a, a, a, a, a, k));
    EXPECT(FASTSTRIP_BAD_ARGUMENT,
           faststrip_wheelset_get_elements(wheelset, 0, 9000, &n, a, a, a, a, a, a, a, NULL, k));
    EXPECT(FASTSTRIP_BAD_ARGUMENT,
           faststrip_wheelset_get_elements(gone, 0, 9000, &n, a, a, a, a, a, a, a, a, k));
    EXPECT(FASTSTRIP_WORKSPACE_TOO_SMALL,
           faststrip_wheelset_get_strip_wear(wheelset, 0, &law, 3, &n, a, a, a, a, a, a));
    law.n = 0;
    EXPECT(FASTSTRIP_BAD_ARGUMENT,
           faststrip_wheelset_get_strip_wear(wheelset, 0, &law, 400, &n, a, a, a, a, a, a));
    EXPECT(0, faststrip_wheelset_last_message(wheelset, text, sizeof text));
    EXPECT(1, strstr(text, "a wear law must have regimes, got 0") != NULL);
    EXPECT(0, faststrip_wheelset_free(&wheelset));
    EXPECT(0, faststrip_free(&empty));
}

/* Geometry without its arrays, its setup or its profiles; a table that is none. */
static void geometry_errors(void)
{
    const double y[2] = {-1.0, 1.0}, delta_r[2] = {-0.1, 0.1}, high[2] = {1.0, 2.0}, a[1] = {0.5};
    double f[20], equilibrium[2];
    int states[4];
    char text[FASTSTRIP_TEXT];
    faststrip_wheelset_setup setup;
    faststrip_profile wheels[2], rails[2];

    memset(wheels, 0, sizeof wheels);
    memset(rails, 0, sizeof rails);
    wheels[0].name = "cone20";
    EXPECT(0, faststrip_default_wheelset(&setup, sizeof setup));
#define FUNCTIONS(status, setup, wheels, rails, n, y, f, states) \
    EXPECT(status, faststrip_contact_functions(setup, wheels, rails, 0, n, y, f, states, text, \
                                               sizeof text))
    FUNCTIONS(FASTSTRIP_BAD_ARGUMENT, &setup, wheels, rails, 2, y, f, states);
    EXPECT(1, strstr(text, "the right rail profile must have a name") != NULL);
    rails[0].name = "60e1";
    FUNCTIONS(0, &setup, wheels, rails, 2, y, f, states);
    EXPECT(1, states[0] == 0 && f[0] < 0.0 && f[10] > 0.0 && strlen(text) == 0);
    FUNCTIONS(FASTSTRIP_BAD_ARGUMENT, &setup, wheels, rails, -1, y, f, states);
    FUNCTIONS(FASTSTRIP_BAD_ARGUMENT, NULL, wheels, rails, 2, y, f, states);
    FUNCTIONS(FASTSTRIP_BAD_ARGUMENT, &setup, NULL, rails, 2, y, f, states);
    FUNCTIONS(FASTSTRIP_BAD_ARGUMENT, &setup, wheels, NULL, 2, y, f, states);
    FUNCTIONS(FASTSTRIP_BAD_ARGUMENT, &setup, wheels, rails, 2, NULL, f, states);
    FUNCTIONS(FASTSTRIP_BAD_ARGUMENT, &setup, wheels, rails, 2, y, NULL, states);
    FUNCTIONS(FASTSTRIP_BAD_ARGUMENT, &setup, wheels, rails, 2, y, f, NULL);
    setup.gauge = NAN;
    FUNCTIONS(FASTSTRIP_NOT_FINITE, &setup, wheels, rails, 2, y, f, states);
    EXPECT(1, f[0] == 0.0 && states[0] == 0);
#define CONICITY(status, n, y, delta_r, m, a, equilibrium, f, states) \
    EXPECT(status, faststrip_conicity(n, y, delta_r, m, a, equilibrium, f, states, text, \
                                      sizeof text))
    CONICITY(0, 2, y, delta_r, 1, a, equilibrium, f, states);
    EXPECT(1, fabs(f[0] - 0.05) < 1e-12 && equilibrium[1] == 1.0 && states[1] == 0);
    CONICITY(FASTSTRIP_BAD_ARGUMENT, -2, y, delta_r, 1, a, equilibrium, f, states);
    CONICITY(FASTSTRIP_BAD_ARGUMENT, 2, y, delta_r, -1, a, equilibrium, f, states);
    CONICITY(FASTSTRIP_BAD_ARGUMENT, 2, NULL, delta_r, 1, a, equilibrium, f, states);
    CONICITY(FASTSTRIP_BAD_ARGUMENT, 2, y, NULL, 1, a, equilibrium, f, states);
    CONICITY(FASTSTRIP_BAD_ARGUMENT, 2, y, delta_r, 1, NULL, equilibrium, f, states);
    CONICITY(FASTSTRIP_BAD_ARGUMENT, 2, y, delta_r, 1, a, NULL, f, states);
    CONICITY(FASTSTRIP_BAD_ARGUMENT, 2, y, delta_r, 1, a, equilibrium, NULL, states);
    CONICITY(FASTSTRIP_BAD_ARGUMENT, 2, y, delta_r, 1, a, equilibrium, f, NULL);
    CONICITY(FASTSTRIP_OUT_OF_RANGE, 2, y, high, 1, a, equilibrium, f, states);
    EXPECT(1, strstr(text, "delta r must rise through 0") != NULL && f[0] == 0.0);
}

/* What a wheelset cannot be made of. */
static void wheelsets_that_are_none(void)
{
    faststrip_wheelset *none = NULL;
    faststrip_wheelset_setup setup;
    faststrip_profile wheels[2] = {{"s1002", NULL, NULL, 0}, {NULL, NULL, NULL, 0}};
    faststrip_profile rails[2] = {{"60e1", NULL, NULL, 0}, {NULL, NULL, NULL, 0}};
    const double y[3] = {-1.0, 0.0, 1.0}, z[3] = {0.0, NAN, 0.0};
    faststrip_case contact;
    char text[FASTSTRIP_TEXT];

#define MAKES(status, words) \
    do { \
        EXPECT(status, faststrip_wheelset_new(&setup, wheels, rails, &contact, &none, text, \
                                              sizeof text)); \
        EXPECT(1, none == NULL && strstr(text, words) != NULL); \
    } while (0)
    EXPECT(0, faststrip_default_case(&contact, sizeof contact));
    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_default_wheelset(NULL, sizeof setup));
    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_default_wheelset(&setup, sizeof setup - 16));
    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_default_wheelset(&setup, sizeof setup + 8));
    EXPECT(0, faststrip_default_wheelset(&setup, sizeof setup));
    EXPECT(1, setup.radius_right == 460.0 && setup.radius_left == 460.0);
    EXPECT(1, setup.inclination == FASTSTRIP_INCLINATION_UNSET);
    EXPECT(1, setup.back_spacing == 1360.0 && setup.tread_line == 70.0 && setup.gauge == 1435.0);
    EXPECT(1, setup.gauge_depth == 14.0 && setup.rail_distance == 0.0);
    EXPECT(FASTSTRIP_BAD_ARGUMENT,
           faststrip_wheelset_new(NULL, wheels, rails, &contact, &none, NULL, 0));
    EXPECT(FASTSTRIP_BAD_ARGUMENT,
           faststrip_wheelset_new(&setup, NULL, rails, &contact, &none, NULL, 0));
    EXPECT(FASTSTRIP_BAD_ARGUMENT,
           faststrip_wheelset_new(&setup, wheels, NULL, &contact, &none, NULL, 0));
    EXPECT(FASTSTRIP_BAD_ARGUMENT,
           faststrip_wheelset_new(&setup, wheels, rails, NULL, &none, NULL, 0));
    EXPECT(FASTSTRIP_BAD_ARGUMENT,
           faststrip_wheelset_new(&setup, wheels, rails, &contact, NULL, NULL, 0));
    setup.size += 8;
    MAKES(FASTSTRIP_BAD_ARGUMENT, "the header is newer");
    setup.size -= 24;
    MAKES(FASTSTRIP_BAD_ARGUMENT, "112 bytes that faststrip_default_wheelset sets, got 96");
    setup.size += 16;
    setup.gauge = NAN;
    MAKES(FASTSTRIP_NOT_FINITE, "finite");
    setup.gauge = 1435.0;
    setup.radius_left = 0.0;
    MAKES(FASTSTRIP_BAD_ARGUMENT, "nominal radius");
    setup.radius_left = 460.0;
    setup.speed_floor = -1.0;
    MAKES(FASTSTRIP_BAD_ARGUMENT, "floor of the speed");
    setup.speed_floor = 0.0;
    setup.rail_stiffness_z = -1.0;
    MAKES(FASTSTRIP_BAD_ARGUMENT, "the stiffness below a rail");
    setup.rail_stiffness_z = 0.0;
    setup.roller_radius = 20.0;
    MAKES(FASTSTRIP_BAD_ARGUMENT, "radius of the rollers must be above");
    setup.roller_radius = 0.0;
    wheels[0].name = NULL;
    MAKES(FASTSTRIP_BAD_ARGUMENT, "the right wheel profile must have a name, or y and z");
    wheels[0].n = 3;
    wheels[0].y = y;
    MAKES(FASTSTRIP_BAD_ARGUMENT, "the right wheel profile must have");
    wheels[0].z = z;
    MAKES(FASTSTRIP_NOT_FINITE, "finite");
    wheels[0].name = "";
    MAKES(FASTSTRIP_BAD_ARGUMENT, "must be s1002, cone20 or cone40");
    wheels[0].name = "s1002";
    rails[1].n = -1;
    MAKES(FASTSTRIP_BAD_ARGUMENT, "the left rail profile must have");
    rails[1].name = "a name that is longer than any";
    MAKES(FASTSTRIP_BAD_ARGUMENT, "must be uic60, 60e1 or 54e1, got a name that is l");
    rails[1].name = "54e1";
    contact.normal = 99;
    MAKES(FASTSTRIP_BAD_ARGUMENT, "normal");
    contact.normal = FASTSTRIP_NORMAL_STRIP;
    EXPECT(0, faststrip_wheelset_new(&setup, wheels, rails, &contact, &none, text, sizeof text));
    EXPECT(0, strlen(text));
    EXPECT(0, faststrip_wheelset_free(&none));
#undef MAKES
}

/* Every pointer of a wheelset null in turn, and what cannot be asked. */
static void wheelset_errors(faststrip_workspace *workspace)
{
    faststrip_wheelset *wheelset = make_wheelset(0), *none = NULL, *kept = wheelset;
    faststrip_wheelset *wrong = (faststrip_wheelset *)workspace;
    faststrip_wheelset_contact contacts[FASTSTRIP_MOST_CONTACTS];
    faststrip_wheelset_state state;
    faststrip_wheelset_demand demand;
    faststrip_wheelset_result result;
    char text[FASTSTRIP_TEXT];
    int n = -1;

    memset(&state, 0, sizeof state);
    memset(&demand, 0, sizeof demand);
    demand.kind = FASTSTRIP_BY_LOADS;
    demand.load_right = demand.load_left = 5e4;
    EXPECT(0, faststrip_wheelset_solve(wheelset, &state, &demand, 2, &n, contacts, &result));
    EXPECT(1, n == 2 && result.n_contacts[0] == 1 && result.force[1][2] > 4.9e4);
    EXPECT(0, faststrip_wheelset_last_message(wheelset, text, sizeof text));
    EXPECT(0, strlen(text));
    EXPECT(FASTSTRIP_WORKSPACE_TOO_SMALL,
           faststrip_wheelset_solve(wheelset, &state, &demand, 1, &n, contacts, &result));
    EXPECT(1, n == 2 && result.n_contacts[0] == 0 && result.force[1][2] == 0.0);
    EXPECT(0, faststrip_wheelset_last_message(wheelset, text, sizeof text));
    EXPECT(1, strstr(text, "more contacts than fit: 2") != NULL);
    EXPECT(FASTSTRIP_BAD_ARGUMENT,
           faststrip_wheelset_solve(wheelset, &state, &demand, -1, &n, contacts, &result));
    EXPECT(FASTSTRIP_BAD_ARGUMENT,
           faststrip_wheelset_solve(none, &state, &demand, 2, &n, contacts, &result));
    EXPECT(FASTSTRIP_BAD_ARGUMENT,
           faststrip_wheelset_solve(wrong, &state, &demand, 2, &n, contacts, &result));
    EXPECT(FASTSTRIP_BAD_ARGUMENT,
           faststrip_wheelset_solve(wheelset, NULL, &demand, 2, &n, contacts, &result));
    EXPECT(FASTSTRIP_BAD_ARGUMENT,
           faststrip_wheelset_solve(wheelset, &state, NULL, 2, &n, contacts, &result));
    EXPECT(FASTSTRIP_BAD_ARGUMENT,
           faststrip_wheelset_solve(wheelset, &state, &demand, 2, NULL, contacts, &result));
    EXPECT(FASTSTRIP_BAD_ARGUMENT,
           faststrip_wheelset_solve(wheelset, &state, &demand, 2, &n, NULL, &result));
    EXPECT(FASTSTRIP_BAD_ARGUMENT,
           faststrip_wheelset_solve(wheelset, &state, &demand, 2, &n, contacts, NULL));
    demand.wheels = 3;
    EXPECT(FASTSTRIP_BAD_ARGUMENT,
           faststrip_wheelset_solve(wheelset, &state, &demand, 2, &n, contacts, &result));
    EXPECT(0, n);
    EXPECT(0, faststrip_wheelset_last_message(wheelset, text, sizeof text));
    EXPECT(1, strstr(text, "got 3") != NULL);
    demand.wheels = FASTSTRIP_LEFT_WHEEL;
    EXPECT(0, faststrip_wheelset_solve(wheelset, &state, &demand, 2, &n, contacts, &result));
    EXPECT(1, n == 1 && contacts[0].side == 2 && result.n_contacts[0] == 0);
    EXPECT(1, result.force[0][2] == 0.0 && result.z[0] == 0.0 && result.force[1][2] > 4.9e4);
    demand.roll_is_free = 1;
    EXPECT(FASTSTRIP_BAD_ARGUMENT,
           faststrip_wheelset_solve(wheelset, &state, &demand, 2, &n, contacts, &result));
    demand.wheels = FASTSTRIP_BOTH_WHEELS;
    state.y = 500.0;
    EXPECT(FASTSTRIP_NO_CONTACT,
           faststrip_wheelset_solve(wheelset, &state, &demand, 2, &n, contacts, &result));
    EXPECT(1, n == 0 && result.force[1][2] == 0.0);
    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_wheelset_last_message(none, text, sizeof text));
    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_wheelset_last_message(wrong, text, sizeof text));
    EXPECT(FASTSTRIP_BAD_ARGUMENT,
           faststrip_last_message((faststrip_workspace *)wheelset, text, sizeof text));
    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_wheelset_free(NULL));
    EXPECT(0, faststrip_wheelset_free(&none));
    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_wheelset_free(&wrong));
    EXPECT(0, faststrip_wheelset_free(&wheelset));
    EXPECT(1, wheelset == NULL);
    EXPECT(FASTSTRIP_BAD_ARGUMENT,
           faststrip_wheelset_solve(kept, &state, &demand, 2, &n, contacts, &result));
    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_wheelset_last_message(kept, text, sizeof text));
    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_wheelset_free(&kept));
}

/* Every pointer null in turn, wrong sizes, no workspace: is the status what it should be? */
static void errors(void)
{
    faststrip_workspace *workspace = make_workspace(), *none = NULL;
    long garbage[100] = {0};
    faststrip_workspace *wrong = (faststrip_workspace *)garbage;
    example e = examples[0];
    faststrip_case other;
    faststrip_result result;
    double a[400], f[4];
    int k[400], n = -1, i;
    char text[FASTSTRIP_TEXT], little[4];

    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_version(NULL, 10));
    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_version(text, 0));
    EXPECT(FASTSTRIP_WORKSPACE_TOO_SMALL, faststrip_version(little, sizeof little));
    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_message(106, NULL, 10));
    EXPECT(0, faststrip_message(106, text, sizeof text));
    EXPECT(0, strcmp(text, "no_contact"));
    EXPECT(FASTSTRIP_WORKSPACE_TOO_SMALL, faststrip_message(106, little, sizeof little));
    EXPECT(0, strcmp(little, "no_"));
    EXPECT(0, faststrip_message(-1, text, sizeof text));
    EXPECT(0, strcmp(text, "unknown_status"));
    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_default_case(NULL, sizeof other));
    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_default_case(&other, 0));
    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_default_case(&other, 8));
    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_default_case(&other, sizeof other - 1));
    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_default_case(&other, sizeof other + 8));
    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_default_case(&other, (size_t)-8));
    EXPECT(0, faststrip_default_case(&other, sizeof other));
    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_new(NULL, 100, &none));
    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_new(&other, 100, NULL));
    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_new(&other, 4, &none));
    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_check_case(NULL, 100, text, sizeof text));
    EXPECT(0, strcmp(text, "the case is missing"));
    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_check_case(&other, 4, text, sizeof text));
    EXPECT(1, strstr(text, "got 4") != NULL);
    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_check_case(&other, 4, NULL, 0));
    EXPECT(FASTSTRIP_WORKSPACE_TOO_SMALL, faststrip_check_case(&other, 4, little, sizeof little));
    EXPECT(0, faststrip_check_case(&other, 5, text, sizeof text));
    EXPECT(0, strlen(text));
    other.size += 8;
    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_check_case(&other, 100, text, sizeof text));
    EXPECT(1, strstr(text, "the header is newer") != NULL);
    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_new(&other, 100, &none));
    other.size = 3;
    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_new(&other, 100, &none));
    EXPECT(1, none == NULL);
    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_free(NULL));
    EXPECT(0, faststrip_free(&none));
    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_set_gap(none, POINTS, e.y, e.h, e.inv2r, NULL));
    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_set_gap(wrong, POINTS, e.y, e.h, e.inv2r, NULL));
    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_set_gap(workspace, POINTS, NULL, e.h, e.inv2r, NULL));
    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_set_gap(workspace, POINTS, e.y, NULL, e.inv2r, NULL));
    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_set_gap(workspace, POINTS, e.y, e.h, NULL, NULL));
    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_set_gap(workspace, -1, e.y, e.h, e.inv2r, NULL));
    EXPECT(FASTSTRIP_TOO_FEW_POINTS, faststrip_set_gap(workspace, 0, e.y, e.h, e.inv2r, NULL));
    EXPECT(FASTSTRIP_WORKSPACE_TOO_SMALL, faststrip_solve(workspace, &e.contact, &result));
    EXPECT(FASTSTRIP_WORKSPACE_TOO_SMALL, faststrip_set_gap(workspace, POINTS + 1, f, f, f, f));
    EXPECT(FASTSTRIP_WORKSPACE_TOO_SMALL, faststrip_set_gap(workspace, INT_MAX, f, f, f, NULL));
    EXPECT(0, faststrip_last_message(workspace, text, sizeof text));
    EXPECT(1, strstr(text, "got 2147483647") != NULL);
    for (i = 0; i < 3; i++) {
        memcpy(a, e.h, sizeof e.h);
        a[POINTS - 1 - 50 * i] = hostile[i];
        EXPECT(FASTSTRIP_NOT_FINITE, faststrip_set_gap(workspace, POINTS, e.y, e.h, e.inv2r, a));
        EXPECT(0, faststrip_last_message(workspace, text, sizeof text));
        EXPECT(1, strstr(text, "inclination(") != NULL);
    }
    EXPECT(0, faststrip_set_gap(workspace, POINTS, e.y, e.h, e.inv2r, e.h));
    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_solve(NULL, &e.contact, &result));
    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_solve(workspace, NULL, &result));
    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_solve(workspace, &e.contact, NULL));
    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_solve(workspace, &other, &result));
    EXPECT(0, faststrip_last_message(workspace, text, sizeof text));
    EXPECT(1, strlen(text) > 10);
    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_last_message(NULL, text, sizeof text));
    e.contact.mu = NAN;
    EXPECT(FASTSTRIP_NOT_FINITE, faststrip_solve(workspace, &e.contact, &result));
    EXPECT(1, result.fx == 0.0 && result.penetration == 0.0);
    e.contact.mu = 0.3;
    for (i = 0; i < 5; i++) {
        const double limits[] = {NAN, 0.0, -0.0, -0.25, -INFINITY};
        const char *got[] = {"NaN", "got 0.0", "got -0.0", "-0.250000", "-Inf"};

        e.contact.resolution_limit = limits[i];
        EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_solve(workspace, &e.contact, &result));
        EXPECT(1, result.pmax == 0.0 && result.est_err_pmax == 0.0 && !result.is_estimated);
        EXPECT(0, faststrip_last_message(workspace, text, sizeof text));
        EXPECT(1, strstr(text, "resolution limit") != NULL && strstr(text, got[i]) != NULL);
    }
    e.contact.resolution_limit = INFINITY;
    EXPECT(0, faststrip_solve(workspace, &e.contact, &result));
    EXPECT(1, result.forces_are_estimated);
    e.contact.force_limit = 0.5 * result.est_err_fx;
    EXPECT(FASTSTRIP_UNDER_RESOLVED, faststrip_solve(workspace, &e.contact, &result));
    EXPECT(0, faststrip_last_message(workspace, text, sizeof text));
    EXPECT(1, strstr(text, "error of Fx is above") != NULL && strstr(text, "mu N") != NULL);
    e.contact.force_limit = NAN;
    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_solve(workspace, &e.contact, &result));
    EXPECT(1, result.est_err_fx == 0.0 && !result.forces_are_estimated);
    EXPECT(0, faststrip_last_message(workspace, text, sizeof text));
    EXPECT(1, strstr(text, "limit of the errors of forces must be above 0, got NaN") != NULL);
    e.contact.force_limit = INFINITY;
    e.contact.resolution_limit = 0.1;
    e.contact.tangential = 99;
    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_solve(workspace, &e.contact, &result));
    EXPECT(0, faststrip_get_strips(workspace, 400, &n, a, a, a, a, k));
    EXPECT(0, n);
    e.contact.tangential = 1;
    e.contact.with_elements = 1;
    EXPECT(1, faststrip_solve(workspace, &e.contact, &result) < FASTSTRIP_FIRST_ERROR);
    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_get_strips(workspace, 400, NULL, a, a, a, a, k));
    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_get_strips(workspace, 400, &n, a, a, a, NULL, k));
    EXPECT(FASTSTRIP_WORKSPACE_TOO_SMALL, faststrip_get_strips(workspace, 1, &n, a, a, a, a, k));
    EXPECT(1, n == result.n_strips);
    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_get_strips(NULL, 400, &n, a, a, a, a, k));
    EXPECT(FASTSTRIP_WORKSPACE_TOO_SMALL,
           faststrip_get_elements(workspace, 1, &n, a, a, a, a, a, a, a, a, k));
    EXPECT(1, n == result.n_elements);
    EXPECT(FASTSTRIP_BAD_ARGUMENT,
           faststrip_get_elements(workspace, 400, &n, a, a, a, a, a, a, a, a, NULL));
    wanted_errors(workspace);
    wear_errors(workspace);
    geometry_errors();
    wheelsets_that_are_none();
    wheelset_errors(workspace);
    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_copy(workspace, NULL));
    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_copy(NULL, workspace));
    EXPECT(0, faststrip_copy(workspace, workspace));
    EXPECT(FASTSTRIP_BAD_ARGUMENT,
           faststrip_fastsim(6, 5, 8e4, 4, 4, 1.5, 0, 0, 0, 0.3, 1e5, 9, 9, NULL));
    EXPECT(FASTSTRIP_BAD_ARGUMENT,
           faststrip_fastsim(6, 5, 8e4, 4, 4, 1.5, 0, 0, 0, 0.3, 1e5, 0, 9, f));
    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_hertz(2e5, 2e5, 0.3, 0.3, 1e-3, 1e-3, 1e5, NULL));
    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_kalker(1.0, 0.3, NULL));
    EXPECT(FASTSTRIP_BAD_ARGUMENT, faststrip_free(&wrong));
    EXPECT(0, faststrip_free(&workspace));
    EXPECT(1, workspace == NULL);
    printf("checked %d\nwrong %d\n", checked, wrong_lines);
}

/* Workspaces that were freed, by pointers that were kept: told by every function, always, also
 * when others have been made since, in this thread or another. */
#ifndef KEPT
#define KEPT 200
#endif
static faststrip_workspace *kept[KEPT];

static long refused(faststrip_workspace *workspace)
{
    example e = examples[0];
    faststrip_workspace *alive = make_workspace(), *copy = workspace;
    faststrip_result result;
    double a[9];
    int k[9], n;
    char text[FASTSTRIP_TEXT];
    long wrong = 0;

    wrong += faststrip_set_gap(workspace, POINTS, e.y, e.h, e.inv2r, NULL) != 100;
    wrong += faststrip_solve(workspace, &e.contact, &result) != 100;
    wrong += faststrip_get_strips(workspace, 9, &n, a, a, a, a, k) != 100;
    wrong += faststrip_get_elements(workspace, 9, &n, a, a, a, a, a, a, a, a, k) != 100;
    wrong += faststrip_get_steps(workspace, 9, &n, k, k, k, k, a, a, a) != 100;
    wrong += faststrip_last_message(workspace, text, sizeof text) != 100;
    wrong += faststrip_copy(workspace, alive) != 100;
    wrong += faststrip_copy(alive, workspace) != 100;
    wrong += faststrip_free(&copy) != 100;
    wrong += faststrip_free(&alive) != 0;
    return wrong;
}

static void *refuse_all(void *argument)
{
    long *wrong = argument;
    int i;

    for (i = 0; i < KEPT; i++) *wrong += refused(kept[i]);
    return NULL;
}

static void freed(void)
{
    faststrip_workspace *other[KEPT];
    faststrip_case contact;
    pthread_t thread[4];
    long wrong = 0, found[4] = {0};
    int i, k, status, twins = 0;

    faststrip_default_case(&contact, sizeof contact);
    contact.strips_per_patch = 3;
    for (i = 0; i < KEPT; i++) wrong += faststrip_new(&contact, 5, &kept[i]) != 0;
    for (i = 0; i < KEPT; i++) wrong += faststrip_free((other[i] = kept[i], &other[i])) != 0;
    wrong += refused(kept[0]);
    for (i = 0; i < KEPT; i++) wrong += faststrip_new(&contact, POINTS, &other[i]) != 0;
    for (i = 0; i < KEPT; i++)
        for (k = 0; k < KEPT; k++) twins += other[i] == kept[k] || (k < i && other[i] == other[k]);
    for (i = 0; i < 4; i++) pthread_create(&thread[i], NULL, refuse_all, &found[i]);
    for (i = 0; i < 4; i++) pthread_join(thread[i], NULL);
    for (i = 0; i < 4; i++) wrong += found[i];
    for (i = 0; i < KEPT; i++) {
        solve_example(other[i], 0, &status);
        wrong += status == FASTSTRIP_BAD_ARGUMENT;
        wrong += faststrip_free(&other[i]) != 0 || other[i] != NULL;
    }
    printf("wrong %ld\ntwins %d\n", wrong, twins);
}

/* Processes forked while threads make and free workspaces: each can make one of its own. */
static volatile int stop;

static void *make_and_free(void *argument)
{
    faststrip_case contact = *(faststrip_case *)argument;
    faststrip_workspace *workspace;

    while (!stop) {
        faststrip_new(&contact, 5, &workspace);
        faststrip_free(&workspace);
    }
    return NULL;
}

static void forked(int forks)
{
    faststrip_workspace *workspace;
    faststrip_case contact;
    pthread_t thread[4];
    int i, status, children = 0, wrong = 0;
    pid_t child;

    faststrip_default_case(&contact, sizeof contact);
    contact.normal = FASTSTRIP_NORMAL_HERTZ;
    contact.strips_per_patch = 1;
    for (i = 0; i < 4; i++) pthread_create(&thread[i], NULL, make_and_free, &contact);
    for (i = 0; i < forks; i++) {
        child = fork();
        if (child == 0) {
            alarm(20); /* a child that waits for ever ends by this */
            status = faststrip_new(&contact, 5, &workspace);
            if (status == 0) status = faststrip_free(&workspace);
            _exit(status);
        }
        children += child > 0;
        wrong += waitpid(child, &status, 0) != child || status != 0;
    }
    stop = 1;
    for (i = 0; i < 4; i++) pthread_join(thread[i], NULL);
    printf("children %d\nwrong %d\n", children, wrong);
}

/* Cases of another header: every other size is refused, and nothing is written. */
static void sizes(void)
{
    const size_t whole = sizeof(faststrip_case);
    example e = examples[2];
    faststrip_workspace *workspace = make_workspace(), *own;
    union {
        faststrip_case contact;
        unsigned char byte[sizeof(faststrip_case) + 16];
    } filled;
    union {
        faststrip_result figures;
        unsigned char byte[sizeof(faststrip_result)];
    } solved;
    size_t size, i;
    int wrong = 0, refused = 0;

    faststrip_set_gap(workspace, POINTS, e.y, e.h, e.inv2r, NULL);
    for (size = 0; size <= sizeof filled; size++) {
        const int known = size == whole;
        faststrip_case contact = e.contact;
        int status;

        memset(&filled, 0x5a, sizeof filled);
        memset(&solved, 0x5a, sizeof solved);
        status = faststrip_default_case(&filled.contact, size);
        wrong += status != (known ? 0 : FASTSTRIP_BAD_ARGUMENT);
        for (i = known ? whole : 0; i < sizeof filled; i++) wrong += filled.byte[i] != 0x5a;
        contact.size = size;
        own = workspace;
        wrong += faststrip_new(&contact, POINTS, &own) != (known ? 0 : FASTSTRIP_BAD_ARGUMENT);
        wrong += (own != NULL) != known;
        wrong += faststrip_free(&own) != 0;
        status = faststrip_solve(workspace, &contact, &solved.figures);
        if (known) {
            wrong += status >= FASTSTRIP_FIRST_ERROR;
            wrong += solved.figures.size != sizeof solved.figures;
            continue;
        }
        wrong += status != FASTSTRIP_BAD_ARGUMENT;
        for (i = 0; i < sizeof solved; i++) wrong += solved.byte[i] != 0x5a;
        refused++;
    }
    faststrip_free(&workspace);
    printf("refused %d\nwrong %d\n", refused, wrong);
}

/* One of the things that a host looks after; is there such a one? */
static int look_after(const char *what)
{
    if (strcmp(what, "arithmetic") == 0) arithmetic();
    else if (strcmp(what, "locale") == 0) locale_kept();
    else if (strcmp(what, "stack") == 0) stack_use();
    else if (strcmp(what, "little_memory") == 0) little_memory();
    else if (strcmp(what, "memory") == 0) memory();
    else if (strcmp(what, "errors") == 0) errors();
    else if (strcmp(what, "freed") == 0) freed();
    else if (strcmp(what, "sizes") == 0) sizes();
    else if (strcmp(what, "forked") == 0) forked(300);
    else if (strcmp(what, "forked_once") == 0) forked(1);
#ifdef COUNTING
    else if (strcmp(what, "quiet") == 0) quiet();
#endif
    else return 0;
    return 1;
}

int main(int argc, char **argv)
{
    int i;

    for (i = 0; i < EXAMPLES; i++) make_example((uint64_t)i, &examples[i]);
    make_points();
    for (i = 0; i < ASKED; i++) {
        ask_wheelset(i + 1, &states[i], &demands[i]);
        states[i].z = 0.1;
    }
    for (i = 1; i < argc; i++)
        if (!look_after(argv[i])) return 2;
    return argc > 1 ? 0 : 2;
}
