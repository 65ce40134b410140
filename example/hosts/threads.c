/* The same contacts by one thread, by POSIX threads and by a host's OpenMP team: the same bits.
 * `threads NUMBER [posix]`: so many contacts, with posix without OpenMP. */
#include "contacts.h"
#include "wheelsets.h"

#include <omp.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>

#ifndef THREADS
#define THREADS 8
#endif

static int contacts;
static uint64_t *found;

/* One contact; the first ones are those of wheelsets, too. */
static uint64_t solve(faststrip_workspace *workspace, faststrip_wheelset *wheelset, int i,
                      int *status)
{
    faststrip_wheelset_state state;
    faststrip_wheelset_demand demand;
    uint64_t bits = 0;

    if (i < ASKED) {
        memset(&state, 0, sizeof state);
        ask_wheelset(i + 1, &state, &demand);
        bits = wheelset_bits(wheelset, &state, &demand, status);
    }
    return bits ^ solve_example(workspace, (uint64_t)i, status);
}

static void *work(void *argument)
{
    faststrip_workspace *workspace = make_workspace();
    faststrip_wheelset *wheelset = make_wheelset(0);
    int first = (int)(intptr_t)argument, status, i;

    if (workspace == NULL) return NULL;
    for (i = first; i < contacts; i += THREADS) found[i] = solve(workspace, wheelset, i, &status);
    faststrip_wheelset_free(&wheelset);
    faststrip_free(&workspace);
    return NULL;
}

static int compare(const uint64_t *serial, const char *what)
{
    int i, different = 0;

    for (i = 0; i < contacts; i++) different += serial[i] != found[i];
    printf("%s %d\n", what, different);
    memset(found, 0, (size_t)contacts * sizeof *found);
    return different;
}

int main(int argc, char **argv)
{
    faststrip_workspace *workspace = make_workspace();
    faststrip_wheelset *wheelset = make_wheelset(0);
    uint64_t *serial;
    pthread_t thread[THREADS];
    int i, status, solved = 0;

    make_points();
    contacts = argc > 1 ? atoi(argv[1]) : 10000;
    serial = calloc((size_t)contacts, sizeof *serial);
    found = calloc((size_t)contacts, sizeof *found);
    if (workspace == NULL || serial == NULL || found == NULL) return 2;
    for (i = 0; i < contacts; i++) {
        serial[i] = solve(workspace, wheelset, i, &status);
        solved += status < FASTSTRIP_FIRST_ERROR;
    }
    printf("solved %d\n", solved);
    for (i = 0; i < THREADS; i++) pthread_create(&thread[i], NULL, work, (void *)(intptr_t)i);
    for (i = 0; i < THREADS; i++) pthread_join(thread[i], NULL);
    compare(serial, "pthreads");
    if (argc > 2) contacts = 0;
#pragma omp parallel num_threads(THREADS) if (contacts > 0)
    {
        faststrip_workspace *own = make_workspace();
        faststrip_wheelset *own_wheelset = make_wheelset(0);
        int own_status, k;
#pragma omp for schedule(dynamic, 7)
        for (k = contacts - 1; k >= 0; k--)
            found[k] = solve(own, own_wheelset, k, &own_status);
        faststrip_wheelset_free(&own_wheelset);
        faststrip_free(&own);
    }
    compare(serial, "openmp");
    faststrip_wheelset_free(&wheelset);
    faststrip_free(&workspace);
    free(serial);
    free(found);
    return 0;
}
