/* faststrip_solve_many against the same contacts one by one: `many bits`, `chains`, `errors` or
 * `forked`. */
#define _GNU_SOURCE
#include "contacts.h"

#include <stdio.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

enum { CONTACTS = 240, CHAIN = 7 };

static example examples[CONTACTS];
static faststrip_case cases[CONTACTS];
static faststrip_gap gaps[CONTACTS];
static faststrip_result results[CONTACTS], expected[CONTACTS];
static int gap_of[CONTACTS], statuses[CONTACTS], wanted[CONTACTS];
static char text[FASTSTRIP_TEXT];

/* The examples, the first of which needs the capacity of all. */
static void make_all(void)
{
    int i;

    for (i = 0; i < CONTACTS; i++) {
        make_example((uint64_t)i, &examples[i]);
        cases[i] = examples[i].contact;
        gaps[i] = (faststrip_gap){POINTS, examples[i].y, examples[i].h, examples[i].inv2r, NULL};
        gap_of[i] = i;
    }
    faststrip_default_case(&cases[0], sizeof cases[0]);
    cases[0].normal = FASTSTRIP_NORMAL_AUTO;
    cases[0].with_elements = 1;
    cases[0].fastsim_nx = cases[0].fastsim_ny = 11;
    cases[0].load = 5e4;
}

static int many(int chain, int threads)
{
    memset(results, 7, sizeof results);
    memset(statuses, 7, sizeof statuses);
    return faststrip_solve_many(CONTACTS, cases, CONTACTS, gaps, gap_of, chain, threads, results,
                                statuses, text, sizeof text);
}

/* One by one: each a cold start, or in chains from the one before if that has a result. */
static void one_by_one(int chain)
{
    faststrip_workspace *workspace = NULL;
    faststrip_case contact;
    int i;

    memset(expected, 0, sizeof expected);
    for (i = 0; i < CONTACTS; i++) {
        if (i % chain == 0) {
            faststrip_free(&workspace);
            workspace = make_workspace();
        }
        contact = cases[i];
        if (i % chain == 0 || wanted[i - 1] >= FASTSTRIP_FIRST_ERROR) contact.warm_start = 0;
        wanted[i] = faststrip_set_gap(workspace, gaps[gap_of[i]].n, gaps[gap_of[i]].y,
                                      gaps[gap_of[i]].h, gaps[gap_of[i]].inv2r, NULL);
        if (wanted[i] == 0) wanted[i] = faststrip_solve(workspace, &contact, &expected[i]);
    }
    faststrip_free(&workspace);
}

static int different(void)
{
    int i, count = 0;

    for (i = 0; i < CONTACTS; i++)
        count += bits_of(statuses[i], &results[i]) != bits_of(wanted[i], &expected[i]);
    return count;
}

static int failures(void)
{
    int i, count = 0;

    for (i = 0; i < CONTACTS; i++) count += statuses[i] >= FASTSTRIP_FIRST_ERROR;
    return count;
}

static void compare(int chain)
{
    static const int threads[] = {1, 4, 7};
    int i;

    one_by_one(chain);
    for (i = 0; i < 3; i++) {
        printf("status %d\n", many(chain, threads[i]));
        printf("different %d\n", different());
    }
    printf("failed %d\n", failures());
}

static void bits(void)
{
    make_all();
    compare(1);
    /* One gap for many contacts, which follow each other or not. */
    for (int i = 0; i < CONTACTS; i++) gap_of[i] = i % 3 ? i : 0;
    compare(1);
}

/* A load that grows in steps on the same gap, with some that have no result. */
static void chains(void)
{
    int cold = 0;

    make_all();
    for (int i = 0; i < CONTACTS; i++) {
        cases[i] = examples[1].contact;
        cases[i].normal = FASTSTRIP_NORMAL_STRIP;
        cases[i].by_load = 1;
        cases[i].load = i % 31 == 30 ? -1.0 : 5e4 * (1.0 + 1e-3 * i);
        cases[i].warm_start = 1;
        gap_of[i] = 1;
    }
    compare(CHAIN);
    /* The test can fail: from nothing it is not the same. */
    many(1, 1);
    cold = different();
    printf("cold %d\n", cold);
}

/* What a single contact has wrong costs only that contact. */
static void one_wrong(const char *what, int i, int status)
{
    int wrong, others = 0, k;

    wrong = many(1, 3) != 0 || statuses[i] != status || results[i].penetration != 0.0
            || results[i].size != sizeof results[i] || strstr(text, what) == NULL;
    for (k = 0; k < CONTACTS; k++)
        others += k != i && bits_of(statuses[k], &results[k]) != bits_of(wanted[k], &expected[k]);
    if (wrong || others) printf("line %d\n", i);
    printf("checked 1\n");
}

static void refused(int status, const char *what)
{
    if (status != FASTSTRIP_BAD_ARGUMENT || strstr(text, what) == NULL)
        printf("line %d\n", status);
    printf("checked 1\n");
}

static void errors(void)
{
    faststrip_case kept;
    faststrip_gap gap;
    double hole[POINTS];
    const size_t length = sizeof text;
    int i;

    make_all();
    for (i = 0; i < CONTACTS; i++) {
        cases[i] = examples[1].contact;
        cases[i].by_load = 1;
        cases[i].load = 5e4 + 100.0 * i;
        cases[i].normal = FASTSTRIP_NORMAL_HERTZ;
        gaps[i] = gaps[1];
    }
    one_by_one(1);
    kept = cases[40];
    cases[40].load = NAN;
    one_wrong("contacts[40]: a Hertz contact", 40, FASTSTRIP_NOT_FINITE);
    cases[40] = kept;
    cases[40].size -= 8;
    one_wrong("contacts[40]: the case must have the", 40, FASTSTRIP_BAD_ARGUMENT);
    cases[40].size = 3;
    one_wrong("contacts[40]: the case must have the", 40, FASTSTRIP_BAD_ARGUMENT);
    cases[40] = kept;
    cases[40].strips_per_patch = 1000;
    cases[40].normal = FASTSTRIP_NORMAL_STRIP;
    one_wrong("contacts[40]: ", 40, FASTSTRIP_WORKSPACE_TOO_SMALL);
    cases[40] = kept;
    for (i = -1; i <= CONTACTS; i += CONTACTS + 1) {
        gap_of[200] = i;
        one_wrong("contacts[200]: gap_of must be from 0 to 239", 200, FASTSTRIP_BAD_ARGUMENT);
    }
    gap_of[200] = 200;
    gap = gaps[200];
    memcpy(hole, gap.h, sizeof hole);
    hole[50] = NAN;
    gaps[200].h = hole;
    one_wrong("contacts[200]: ", 200, FASTSTRIP_NOT_FINITE);
    gaps[200].h = NULL;
    one_wrong("contacts[200]: the gap must have y, h and inv2r", 200, FASTSTRIP_BAD_ARGUMENT);
    gaps[200] = gap;
    gaps[200].n = -1;
    one_wrong("contacts[200]: the number of gap points", 200, FASTSTRIP_BAD_ARGUMENT);
    gaps[200].n = 4;
    one_wrong("contacts[200]: ", 200, FASTSTRIP_TOO_FEW_POINTS);
    gaps[200].n = 2000000;
    one_wrong("contacts[200]: ", 200, FASTSTRIP_WORKSPACE_TOO_SMALL);
    gaps[200] = gap;

    refused(many(1, 0), "threads must be at least 1, got 0");
    refused(many(0, 1), "chain must be at least 1, got 0");
#define CALL(n, cases, n_gaps, gaps, gap_of, results, statuses) \
    faststrip_solve_many(n, cases, n_gaps, gaps, gap_of, 1, 2, results, statuses, text, length)
    refused(CALL(CONTACTS, cases, 0, gaps, gap_of, results, statuses), "n_gaps must be at least 1");
    refused(CALL(CONTACTS, cases, 2, gaps, NULL, results, statuses), "got 2");
    refused(CALL((size_t)-1, cases, 1, gaps, NULL, results, statuses), "out of range");
    refused(CALL(CONTACTS, NULL, 1, gaps, NULL, results, statuses), "must be there");
    refused(CALL(CONTACTS, cases, 1, NULL, NULL, results, statuses), "must be there");
    refused(CALL(CONTACTS, cases, 1, gaps, NULL, NULL, statuses), "must be there");
    refused(CALL(CONTACTS, cases, 1, gaps, NULL, results, NULL), "must be there");
    cases[0].size = 5;
    refused(many(1, 2), "the case must have the");
    cases[0].size = sizeof cases[0];
    cases[0].strips_per_patch = 5000;
    refused(many(1, 2), "strips");
    cases[0] = cases[1];
    /* Nothing to do, nowhere to put words, one gap for all, and a gap of each in order. */
    i = CALL(0, NULL, 1, NULL, NULL, NULL, NULL) != 0 || text[0] != '\0';
    i += faststrip_solve_many(CONTACTS, cases, CONTACTS, gaps, NULL, 1, 2, results, statuses, NULL,
                              0) != 0;
    i += faststrip_solve_many(CONTACTS, cases, 1, gaps, NULL, 1, 2, results, statuses, NULL, 0)
         != 0;
    cases[3].load = NAN;
    i += faststrip_solve_many(CONTACTS, cases, 1, gaps, NULL, 1, 2, results, statuses, text, 12)
         != 0 || strcmp(text, "contacts[3]") != 0;
    printf("wrong %d\n", i);
}

/* A child made after a call, and one made by a child, can do the same. */
static void forked(void)
{
    int i, status, wrong;
    pid_t child;

    make_all();
    one_by_one(1);
    wrong = many(1, 4) != 0 || different() > 0;
    for (i = 0; i < 20; i++) {
        child = fork();
        if (child == 0) {
            alarm(120); /* a child that waits for ever ends by this */
            _exit(many(1, 4) != 0 || different() > 0);
        }
        wrong += waitpid(child, &status, 0) != child || status != 0;
    }
    printf("wrong %d\n", wrong);
}

int main(int argc, char **argv)
{
    const char *what = argc > 1 ? argv[1] : "";

    if (strcmp(what, "bits") == 0) bits();
    else if (strcmp(what, "chains") == 0) chains();
    else if (strcmp(what, "errors") == 0) errors();
    else if (strcmp(what, "forked") == 0) forked();
    else return 2;
    return 0;
}
