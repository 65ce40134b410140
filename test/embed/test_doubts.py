"""What no contact can be is named by the library too, in every interface; no status and no figure
depends on it."""

import warnings

from installed import HostTest

C = r"""
#include <faststrip.h>
#include <stdio.h>
int main(void)
{
    static double y[301], h[301], a[301];
    char text[FASTSTRIP_TEXT];
    faststrip_workspace *workspace;
    faststrip_case contact;
    faststrip_result result;
    for (int i = 0; i < 301; i++)
        y[i] = 0.1 * (i - 150), h[i] = y[i] * y[i] / 600.0, a[i] = 1.0 / 920.0;
    faststrip_default_case(&contact, sizeof contact);
    faststrip_new(&contact, 301, &workspace);
    faststrip_set_gap(workspace, 301, y, h, a, NULL);
    contact.load = 80.0, contact.mu = 35.0, contact.cksi = 1e-3;
    int status = faststrip_solve(workspace, &contact, &result);
    printf("%d\n", status < FASTSTRIP_FIRST_ERROR);
    for (int i = 0; faststrip_doubt(workspace, i, text, sizeof text) == 0 && text[0]; i++)
        puts(text);
    contact.load = 1e5, contact.mu = 0.3;
    faststrip_solve(workspace, &contact, &result);
    printf("%d[%s]\n", faststrip_doubt(workspace, 0, text, sizeof text), text);
    printf("%d\n", faststrip_doubt(workspace, 0, NULL, 0));
    faststrip_free(&workspace);
    printf("%d\n", faststrip_doubt(workspace, 0, text, sizeof text));
    return 0;
}
"""
F77 = """\
      PROGRAM DOUBT
      INTEGER IOPT(9), IWORK(8), INFO, I, N
      DOUBLE PRECISION PAR(9), RES(14), Y(301), H(301), A(301)
      CHARACTER*200 TEXT
      CALL FSDFLT(IOPT, PAR)
      CALL FSINIT(IOPT, 301, IWORK, 8, INFO)
      DO 10 I = 1, 301
        Y(I) = 0.1D0*(I - 151)
        H(I) = Y(I)*Y(I)/600.0D0
        A(I) = 1.0D0/920.0D0
   10 CONTINUE
      PAR(5) = 35.0D0
      PAR(6) = 80.0D0
      PAR(7) = 1.0D-3
      CALL FSCONT(IWORK, 301, Y, H, A, IOPT, PAR, RES, INFO)
      CALL FSDOUB(IWORK, 1, N, TEXT, INFO)
      WRITE (*, '(I1)') 1
      DO 20 I = 1, N
        CALL FSDOUB(IWORK, I, N, TEXT, INFO)
        WRITE (*, '(A)') TRIM(TEXT)
   20 CONTINUE
      CALL FSFREE(IWORK, INFO)
      END
"""
LINES = ["load should be at least 423.200, got 80.0000: kN or tonnes?",
         "mu should be at most 1.00000, got 35.0000: percent?"]


class Doubts(HostTest):
    def test_c(self):
        self.write("doubt.c", C)
        self.shell("gcc -Wall -Wextra -Werror doubt.c $(pkg-config --cflags --libs faststrip) -o c")
        lines = self.shell("./c").splitlines()
        self.assertEqual(lines[0], "1")
        self.assertEqual(sorted(lines[1:-3]), LINES)
        self.assertEqual(lines[-3:], ["0[]", "100", "100"])

    def test_fixed_form_fortran(self):
        self.write("doubt.f", F77)
        self.shell("gfortran -std=legacy doubt.f $(pkg-config --libs faststrip) -o f77")
        lines = self.shell("./f77").splitlines()
        self.assertEqual(sorted(lines[1:]), LINES)

    def test_python(self):
        faststrip = self.import_package()
        import numpy
        y = numpy.linspace(-15.0, 15.0, 301)
        contact = faststrip.Contact()

        def solve(inv2r=1.0 / 920.0, **case):
            contact.set_gap(y, y**2 / 600.0, inv2r)
            with warnings.catch_warnings(record=True) as caught:
                warnings.simplefilter("always")
                result = contact.solve(**({"load": 1e5, "creepage": (1e-3, 0.0, 0.0)} | case))
            self.assertTrue(all(w.category is faststrip.ImplausibleWarning for w in caught))
            self.assertTrue(all(w.filename == __file__ for w in caught))
            return result, [str(w.message) for w in caught]

        self.assertEqual(solve()[1], [])
        for case, says in (({"mu": 35.0}, "percent?"), ({"load": 80.0}, "kN or tonnes?"),
                           ({"creepage": (0.5, 0.0, 0.0)}, "percent?"),
                           ({"creepage": (0.0, 0.0, 0.17)}, "1/m?"),
                           ({"inv2r": 1.0 / 0.92}, "1/m"),
                           ({"inv2r": 1.0 / 1840.0}, "the diameter?"),
                           ({"material": faststrip.Material(210.0, 210.0, 0.28, 0.28)}, "GPa?")):
            with self.subTest(case):
                result, said = solve(**case)
                self.assertTrue(any(says in line for line in said), said)
                self.assertIn(result.status, (0, *range(1, 11)))
        with self.assertRaises(faststrip.FaststripError), \
                self.assertWarns(faststrip.ImplausibleWarning):
            contact.solve(load=-1.0, mu=35.0)

    def test_python_wheelset(self):
        faststrip = self.import_package()
        wheelset = faststrip.Wheelset("s1002", "60e1")
        state = {"y": 1.0, "yaw": 0.001, "speed": 20000.0, "axle_load": 160000.0}
        with warnings.catch_warnings():
            warnings.simplefilter("error", faststrip.ImplausibleWarning)
            usual = wheelset.solve(**state)
        for change, says in (({"axle_load": 160.0}, "kN or tonnes?"), ({"speed": 100.0}, "km/h?")):
            with self.assertWarnsRegex(faststrip.ImplausibleWarning, says):
                wheelset.solve(**state | change)
        with self.assertRaisesRegex(faststrip.FaststripError, "degrees or mrad?"), \
                self.assertWarns(faststrip.ImplausibleWarning):
            wheelset.solve(**state | {"yaw": 4.0})
        self.assertGreater(len(usual.contacts), 1)
