/* Creep forces from a table that `faststrip lookup make` made, as bits; with a second word, the
 * processor time of a look-up with derivatives instead, us. */
#include <faststrip.h>
#include <inttypes.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { STATES = 5000, NUMBERS = 8, FORCES = 3, PASSES = 20 };

static double states[STATES][NUMBERS], forces[STATES][FORCES];
static double jacobians[STATES][NUMBERS][FORCES];
static int codes[STATES];

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

static double us_per_call(faststrip_lookup *table, enum faststrip_lookup_order order, int at_once)
{
    clock_t before = clock();
    int i, pass;

    for (pass = 0; pass < PASSES; pass++)
        for (i = 0; i < STATES; i += at_once)
            if (faststrip_lookup_forces(table, order, at_once, states[i], forces[i],
                                        jacobians[i][0], &codes[i]) != 0)
                return -1.0;
    return (double)(clock() - before) / CLOCKS_PER_SEC * 1e6 / PASSES / STATES;
}

int main(int argc, char **argv)
{
    char text[FASTSTRIP_TEXT], *bytes;
    double about[23], c;
    faststrip_lookup *table;
    FILE *file;
    long length;
    int i;

    if (argc < 2 || !(file = fopen(argv[1], "rb"))) return 1;
    if (fseek(file, 0, SEEK_END) != 0 || (length = ftell(file)) < 0) return 2;
    rewind(file);
    bytes = malloc((size_t)length);
    if (!bytes || fread(bytes, 1, (size_t)length, file) != (size_t)length) return 3;
    fclose(file);
    if (faststrip_lookup_open(bytes, (size_t)length, &table, text, sizeof text) != 0) {
        puts(text);
        return 4;
    }
    free(bytes);
    if (faststrip_lookup_about(table, about) != 0) return 5;
    for (i = 0; i < STATES; i++) {
        c = 1.0 + i % 7;
        states[i][0] = c * (about[3] < 1.0 && about[4] > 1.25 ? 1.0 + 0.01 * (i % 23) : 1.0);
        states[i][1] = c;
        states[i][2] = 1e4 + 1e3 * (i % 101);
        states[i][3] = 0.1 + 0.01 * (i % 41);
        states[i][4] = 82000.0;
        states[i][5] = 1e-4 * (i % 89 - 44);
        states[i][6] = 1e-4 * (i % 61 - 30);
        states[i][7] = 1e-5 * (i % 37 - 18);
    }
    if (argc > 2) {
        printf("linear %.3f\ncubic %.3f\n", us_per_call(table, FASTSTRIP_LINEAR, STATES),
               us_per_call(table, FASTSTRIP_CUBIC, STATES));
        printf("linear_one_by_one %.3f\n", us_per_call(table, FASTSTRIP_LINEAR, 1));
        return faststrip_lookup_free(&table);
    }
    states[3][2] = 0.0;
    states[4][0] = 1e9;
    show(23, about);
    for (i = 1; i <= 3; i += 2) {
        printf("%d\n", faststrip_lookup_forces(table, (enum faststrip_lookup_order)i, 200,
                                               states[0], forces[0], jacobians[0][0], codes));
        for (int k = 0; k < 200; k++) {
            printf("%d\n", codes[k]);
            show(FORCES, forces[k]);
            show(NUMBERS * FORCES, jacobians[k][0]);
        }
    }
    i = faststrip_lookup_free(&table);
    return i != 0 || table != NULL || faststrip_lookup_free(&table) != 0;
}
