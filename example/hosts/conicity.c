/* Contact geometry functions and equivalent conicity from C, as bits. */
#include <faststrip.h>
#include <inttypes.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

enum { SHIFTS = 161, AMPLITUDES = 12 };

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

int main(void)
{
    static double y[SHIFTS], functions[SHIFTS][10], shift[SHIFTS], delta_r[SHIFTS];
    double amplitudes[AMPLITUDES], equilibrium[2], conicities[AMPLITUDES][6];
    int states[SHIFTS], found[AMPLITUDES][2], roll, i, n;
    faststrip_wheelset_setup setup;
    faststrip_profile wheels[2], rails[2];

    memset(wheels, 0, sizeof wheels);
    memset(rails, 0, sizeof rails);
    wheels[0].name = "s1002";
    wheels[1].name = "cone20";
    rails[0].name = "60e1";
    rails[1].name = "54e1";
    faststrip_default_wheelset(&setup, sizeof setup);
    setup.radius_left = 460.25;
    for (i = 0; i < SHIFTS; i++) y[i] = 0.5 * (i - 80);
    for (i = 0; i < AMPLITUDES; i++) amplitudes[i] = 0.5 * (i + 1) * (i + 1);
    for (roll = 0; roll < 2; roll++) {
        if (faststrip_contact_functions(&setup, wheels, rails, roll, SHIFTS, y, functions[0],
                                        states, NULL, 0) != 0)
            return 1;
        for (i = n = 0; i < SHIFTS; i++) {
            printf("shift %d\n", states[i]);
            show(10, functions[i]);
            if (states[i] != 0) continue;
            shift[n] = y[i];
            delta_r[n++] = functions[i][0];
        }
        if (faststrip_conicity(n, shift, delta_r, AMPLITUDES, amplitudes, equilibrium,
                               conicities[0], found[0], NULL, 0) != 0)
            return 2;
        show(2, equilibrium);
        for (i = 0; i < AMPLITUDES; i++) {
            printf("amplitude %d %d\n", found[i][0], found[i][1]);
            show(6, conicities[i]);
        }
    }
    return 0;
}
