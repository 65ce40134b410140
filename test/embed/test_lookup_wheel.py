"""The lookup table of a wheel gives the same contacts and forces in every interface."""

import math
import subprocess

import numpy as np

from installed import HostTest, number
from test_allocation import COUNTER

CASE = ("&wheel\n profile = 's1002'\n/\n&rail\n profile = '60e1'\n/\n&material\n mu = 0.3\n/\n")
PLACES, STATES = 6, 40
SHOW = r"""
#include <inttypes.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
static void show(int n, const double *numbers)
{
    uint64_t bits;
    for (int i = 0; i < n; i++) {
        memcpy(&bits, &numbers[i], sizeof bits);
        printf("%s%016" PRIX64, i > 0 ? " " : "", bits);
    }
    printf("\n");
}
static faststrip_lookup *opened(const char *path)
{
    static char bytes[40000000];
    faststrip_lookup *table = NULL;
    FILE *file = fopen(path, "rb");
    size_t length = fread(bytes, 1, sizeof bytes, file);
    if (faststrip_lookup_open(bytes, length, &table, NULL, 0) != 0) exit(1);
    return table;
}
enum { PLACES = 6, STATES = 40 };
static double places[PLACES][3], contacts[PLACES][14], slopes[PLACES][42];
static double states[STATES][7], forces[STATES][3], jacobians[STATES][21], about[60];
static int slots[STATES], codes[STATES];
static void fill(void)
{
    for (int i = 0; i < PLACES; i++) {
        places[i][0] = -2.0 + 0.7 * i; places[i][1] = 0.0; places[i][2] = 5e4 + 1e4 * (i % 3);
    }
    for (int i = 0; i < STATES; i++) {
        double state[7] = {-1.9 + 0.05 * i, 0.0, 6e4 + 1e3 * (i % 11), 0.1 + 0.01 * i,
                           1e-4 * (i - 20), 1e-4 * (i % 7 - 3), 1e-5 * (i % 5 - 2)};
        for (int k = 0; k < 7; k++) states[i][k] = state[k];
        slots[i] = 1;
    }
    slots[3] = 9;
    states[4][0] = 77.0;
}
"""
BY_C = "#include <faststrip.h>\n" + SHOW + r"""
int main(void)
{
    faststrip_lookup *table = opened("wheel.fslt");
    if (faststrip_lookup_wheel_about(table, about) != 0) return 2;
    show(60, about);
    fill();
    for (int order = 1; order <= 3; order += 2) {
        printf("%d\n", faststrip_lookup_wheel_contacts(table, (enum faststrip_lookup_order)order,
                                                       PLACES, places[0], contacts[0], slopes[0],
                                                       codes));
        for (int i = 0; i < PLACES; i++) { show(14, contacts[i]); show(42, slopes[i]); }
        printf("%d\n", faststrip_lookup_wheel_forces(table, (enum faststrip_lookup_order)order,
                                                     STATES, slots, states[0], forces[0],
                                                     jacobians[0], codes));
        for (int i = 0; i < STATES; i++) {
            printf("%d\n", codes[i]); show(3, forces[i]); show(21, jacobians[i]);
        }
    }
    if (faststrip_lookup_about(table, about) != FASTSTRIP_BAD_ARGUMENT) return 3;
    if (faststrip_lookup_forces(table, FASTSTRIP_LINEAR, 1, states[0], forces[0], NULL, NULL)
        != FASTSTRIP_BAD_ARGUMENT) return 4;
    if (faststrip_lookup_wheel_forces(table, FASTSTRIP_LINEAR, 1, NULL, states[0], forces[0], NULL,
                                      NULL) != FASTSTRIP_BAD_ARGUMENT) return 5;
    return faststrip_lookup_free(&table);
}
"""
ALLOCATIONS = "#include <faststrip.h>\n" + SHOW + r"""
int main(void)
{
    faststrip_lookup *table = opened("wheel.fslt");
    fill();
    slots[3] = 1;
    states[4][0] = 0.0;
    for (int order = 1; order <= 3; order += 2) {
        long before = allocations();
        int status = faststrip_lookup_wheel_contacts(table, (enum faststrip_lookup_order)order,
                                                     PLACES, places[0], contacts[0], slopes[0],
                                                     NULL);
        status |= faststrip_lookup_wheel_forces(table, (enum faststrip_lookup_order)order, STATES,
                                                slots, states[0], forces[0], jacobians[0], NULL);
        before = allocations() - before;
        printf("%d %ld\n", status, before);
    }
    return faststrip_lookup_free(&table);
}
"""
BY_F77 = r"""
      PROGRAM WHEEL
      INTEGER MBYTES, NP, NS
      PARAMETER (MBYTES = 40000000, NP = 6, NS = 40)
      CHARACTER*1 BYTES(MBYTES)
      INTEGER IWORK(8), ISTAT(NS), ISLOT(NS), I, J, K, N, IORDER, INFO
      DOUBLE PRECISION PLACE(3, NP), CONTAC(14, 1, NP), DCON(14, 1, 3, NP), STATE(7, NS)
      DOUBLE PRECISION FORCE(3, NS), DJAC(3, 7, NS), ABOUT(60)
      OPEN (10, FILE='wheel.fslt', ACCESS='DIRECT', RECL=1, FORM='UNFORMATTED', STATUS='OLD')
      N = 0
   10 CONTINUE
      READ (10, REC=N + 1, ERR=20) BYTES(N + 1)
      N = N + 1
      GO TO 10
   20 CONTINUE
      CLOSE (10)
      CALL FSLOPN(N, BYTES, IWORK, 8, INFO)
      IF (INFO .NE. 0) STOP 1
      CALL FSLWIN(IWORK, ABOUT, INFO)
      IF (INFO .NE. 0) STOP 2
      WRITE (*, 100) ABOUT
      DO 30 I = 1, NP
        PLACE(1, I) = -2.0D0 + 0.7D0*(I - 1)
        PLACE(2, I) = 0.0D0
        PLACE(3, I) = 5.0D4 + 1.0D4*MOD(I - 1, 3)
   30 CONTINUE
      DO 40 I = 1, NS
        STATE(1, I) = -1.9D0 + 0.05D0*(I - 1)
        STATE(2, I) = 0.0D0
        STATE(3, I) = 6.0D4 + 1.0D3*MOD(I - 1, 11)
        STATE(4, I) = 0.1D0 + 0.01D0*(I - 1)
        STATE(5, I) = 1.0D-4*(I - 21)
        STATE(6, I) = 1.0D-4*(MOD(I - 1, 7) - 3)
        STATE(7, I) = 1.0D-5*(MOD(I - 1, 5) - 2)
        ISLOT(I) = 1
   40 CONTINUE
      ISLOT(4) = 9
      STATE(1, 5) = 77.0D0
      DO 70 IORDER = 1, 3, 2
        CALL FSLCON(IWORK, IORDER, NP, 1, PLACE, CONTAC, DCON, ISTAT, INFO)
        WRITE (*, '(I0)') INFO
        DO 50 I = 1, NP
          WRITE (*, 100) (CONTAC(J, 1, I), J = 1, 14)
          WRITE (*, 100) ((DCON(J, 1, K, I), J = 1, 14), K = 1, 3)
   50   CONTINUE
        CALL FSLWHL(IWORK, IORDER, NS, ISLOT, STATE, FORCE, DJAC, ISTAT, INFO)
        WRITE (*, '(I0)') INFO
        DO 60 I = 1, NS
          WRITE (*, '(I0)') ISTAT(I)
          WRITE (*, 100) (FORCE(J, I), J = 1, 3)
          WRITE (*, 100) ((DJAC(J, K, I), J = 1, 3), K = 1, 7)
   60   CONTINUE
   70 CONTINUE
      CALL FSLINF(IWORK, ABOUT, INFO)
      IF (INFO .NE. 100) STOP 3
      CALL FSLFRE(IWORK, INFO)
      IF (INFO .NE. 0) STOP 4
  100 FORMAT (60(Z16.16, :, 1X))
      END
"""


def numbers(line):
    return list(map(number, line.split()))


class WheelFaces(HostTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.package = cls.import_package()
        (cls.folder / "case.nml").write_text(CASE, encoding="utf-8")
        subprocess.run([str(cls.installed.prefix / "bin" / "faststrip"), "lookup", "wheel",
                        "case.nml", "-o", "wheel.fslt", "--error", "0.3", "--y", "-2:2", "--tests",
                        "299"], cwd=cls.folder, check=True, stdin=subprocess.DEVNULL)
        cls.table = cls.package.WheelLookup(cls.folder / "wheel.fslt")
        (cls.folder / "by_c.c").write_text(BY_C, encoding="utf-8")
        cls.shell("gcc -Wall -O1 by_c.c $(pkg-config --cflags --libs faststrip) -o by_c")
        cls.lines = cls.shell("./by_c").splitlines()

    def test_fixed_form_fortran_has_the_bits_of_c(self):
        self.write("by_f77.f", BY_F77)
        self.shell("gfortran -std=legacy -ffixed-line-length-100 -O1 by_f77.f"
                   " $(pkg-config --libs faststrip) -o by_f77")
        self.assertEqual(self.shell("./by_f77").splitlines(), self.lines)
        self.assertEqual((self.lines.count("100"), self.lines.count("109")), (2 + 2, 2))

    def test_python_has_them(self):
        about = numbers(self.lines[0])
        table = self.table
        self.assertEqual([table.nu, table.g, table.promised, *table.tested, table.slots, *table.y,
                          *table.yaw, *table.load], about[:12])
        self.assertEqual(table.errors.ravel().tolist(), about[12:])
        at = 1
        i, k = np.arange(PLACES), np.arange(STATES)
        slot, y = np.ones(STATES, dtype=int), -1.9 + 0.05 * k
        slot[3], y[4] = 9, 77.0
        creepage = 1e-4 * (k - 20), 1e-4 * (k % 7 - 3), 1e-5 * (k % 5 - 2)
        for order in ("linear", "cubic"):
            there = table.contacts(-2.0 + 0.7 * i, 0.0, 5e4 + 1e4 * (i % 3), order=order,
                                   slopes=True)
            self.assertEqual(there.slopes.shape, (PLACES, 1, 14, 3))
            for place in range(PLACES):
                self.assertEqual(there.numbers[place, 0].tolist(), numbers(self.lines[at + 1]))
                self.assertEqual(there.slopes[place, 0].T.ravel().tolist(),
                                 numbers(self.lines[at + 2]))
                at += 2
            at += 2
            found = table(slot, y, 0.0, 6e4 + 1e3 * (k % 11), 0.1 + 0.01 * k, creepage,
                          order=order, jacobian=True)
            for state in k:
                self.assertEqual(found.status[state], int(self.lines[at]))
                if found.status[state] == 0:
                    self.assertEqual(found.forces[state].tolist(), numbers(self.lines[at + 1]))
                    self.assertEqual(found.jacobian[state].T.ravel().tolist(),
                                     numbers(self.lines[at + 2]))
                else:
                    self.assertTrue(np.isnan(found.forces[state]).all())
                at += 3
        self.assertEqual(at, len(self.lines))

    def test_looking_up_allocates_nothing(self):
        self.write("counted.c", COUNTER + ALLOCATIONS)
        self.shell("gcc -O1 counted.c $(pkg-config --cflags --libs faststrip) -o counted")
        self.assertEqual(self.shell("./counted"), "0 0\n0 0\n")

    def test_what_is_none_is_refused(self):
        package, table, creepage = self.package, self.table, (1e-3, 0.0, 0.0)
        content = (self.folder / "wheel.fslt").read_bytes()
        self.all_refused(
            ("WheelLookup", lambda: package.Lookup(self.folder / "wheel.fslt")),
            ("a lookup table must have as many bytes", lambda: package.WheelLookup(content[:-1])),
            ("out_of_range: no place of 1", lambda: table.contacts(77.0, 0.0, 8e4)),
            ("bad_argument: no state of 1", lambda: table(9, 0.0, 0.0, 8e4, 0.3, creepage)),
            ("order", lambda: table.contacts(0.0, 0.0, 8e4, order="square")),
            ("creepage", lambda: table(1, 0.0, 0.0, 8e4, 0.3, 1e-3)),
            *(("slot must be whole numbers",
               lambda slot=slot: table(slot, 0.0, 0.0, 8e4, 0.3, creepage))
              for slot in (1.5, math.nan, 1e12)))
