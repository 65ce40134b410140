"""Stresses below a contact in C, F77 and Python: the numbers of the program."""

import csv

from installed import HostTest

GAP = [(y, 2e-3 * y * y, 1e-3) for y in (0.1 * i - 15.0 for i in range(301))]
POINTS = [(x, y, z) for z in (0.5, 3.0) for y in (-1.0, 2.0) for x in (-4.0, 0.0, 1.25)]
NAMES = ("x", "y", "z", "sxx", "syy", "szz", "sxy", "sxz", "syz", "von_mises", "tresca", "s1", "s2",
         "s3")
CASE = """&contact
  gap_file = 'gap.csv'
  load_N = 8e4
/
&material
  mu = 0.3
/
&motion
  cksi = 0.004
/
"""
BY_C = r"""#include <faststrip.h>
#include <stdio.h>
int main(void) {
    double y[301], h[301], a[301], x[1] = {1.25}, at[1] = {2.0}, z[1] = {3.0}, s[11], peak[5];
    faststrip_case what;
    faststrip_result result;
    faststrip_workspace *workspace;
    for (int i = 0; i < 301; i++) {
        y[i] = 0.1 * i - 15.0;
        h[i] = 2e-3 * y[i] * y[i];
        a[i] = 1e-3;
    }
    faststrip_default_case(&what, sizeof what);
    what.load = 8e4;
    what.mu = 0.3;
    what.cksi = 0.004;
    what.with_elements = 1;
    if (faststrip_new(&what, 301, &workspace)) return 1;
    printf("%d\n", faststrip_get_stress_peak(workspace, peak));
    if (faststrip_set_gap(workspace, 301, y, h, a, NULL)) return 2;
    if (faststrip_solve(workspace, &what, &result)) return 3;
    printf("%d\n", faststrip_get_stresses(workspace, -1, x, at, z, s));
    printf("%d\n", faststrip_get_stresses(workspace, 1, x, at, NULL, s));
    printf("%d\n", faststrip_get_stress_peak(workspace, NULL));
    if (faststrip_get_stresses(workspace, 1, x, at, z, s)) return 4;
    if (faststrip_get_stress_peak(workspace, peak)) return 5;
    for (int i = 0; i < 11; i++) printf("%.17g\n", s[i]);
    for (int i = 0; i < 5; i++) printf("%.17g\n", peak[i]);
    faststrip_free(&workspace);
    return 0;
}
"""
# As in test_legacy.
DECLARED = """\
      INTEGER IW(8), IW2(8), IOPT(9), N, INFO, I
      DOUBLE PRECISION PAR(9), X(1), Y(1), Z(1), S(11), P(5), G(301), H(301), A(301), RES(14)
      DATA IW2 /8*0/, X /1.25D0/, Y /2D0/, Z /3D0/, A /301*1D-3/
      DO 1 I = 1, 301
        G(I) = 0.1D0*(I - 1) - 15D0
    1 H(I) = 2D-3*G(I)**2
      CALL FSDFLT(IOPT, PAR)
      IOPT(9) = 1
      PAR(6) = 8D4
      PAR(7) = 4D-3
      CALL FSINIT(IOPT, 301, IW, 8, INFO)
"""
ROWS = (
    ("none", 100, "CALL FSSTRS(IW2, 1, X, Y, Z, S, INFO)"),
    ("unsolved", 100, "CALL FSPEAK(IW, P, INFO)"),
    ("solved", 0, "CALL FSCONT(IW, 301, G, H, A, IOPT, PAR, RES, INFO)"),
    ("negative", 100, "CALL FSSTRS(IW, -1, X, Y, Z, S, INFO)"),
    ("stresses", 0, "CALL FSSTRS(IW, 1, X, Y, Z, S, INFO)"),
    ("sum", 0, "CALL FSPEAK(IW, P, INFO)",
     "INFO + NINT(S(1) + S(2) + S(3) - S(9) - S(10) - S(11))"),
    ("above", 100, "Z(1) = -1D0; CALL FSSTRS(IW, 1, X, Y, Z, S, INFO)"),
)


class Stresses(HostTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.write("gap.csv", "y_mm,h_mm,inv2R_per_mm\n"
                  + "".join(f"{y!r},{h!r},{a!r}\n" for y, h, a in GAP))
        cls.write("case.nml", CASE)
        cls.faststrip = cls.import_package()
        cls.contact = cls.faststrip.Contact(with_elements=True)
        cls.contact.set_gap(*zip(*GAP))
        cls.contact.solve(load=8e4, creepage=(0.004, 0.0, 0.0))
        cls.found = cls.contact.stresses(*zip(*POINTS))

    def test_the_program_has_them(self):
        self.shell(f"{self.installed.prefix}/bin/faststrip contact case.nml -o row.csv"
                   " --below below.csv --points-per-strip 15"
                   " --below-x=-4,0,1.25 --below-y=-1,2 --below-z 0.5,3")
        rows, figures = (list(csv.DictReader(line for line in (self.folder / name).read_text(
            encoding="utf-8").splitlines() if line[0] != "#")) for name in ("below.csv", "row.csv"))
        for name, column in zip(NAMES, rows[0], strict=True):
            for row, value in zip(rows, getattr(self.found, name), strict=True):
                self.assertAlmostEqual(float(row[column]), value, delta=1e-9 * 1e3, msg=column)
        peak = self.contact.stress_peak()
        for name, column in zip(("max_MPa", "x_mm", "y_mm", "z_mm"), peak):
            self.assertAlmostEqual(float(figures[0]["von_mises_" + name]), column, delta=1e-6)
        self.assertAlmostEqual(float(figures[0]["est_err_von_mises"]), peak.est_err_von_mises)

    def test_c_and_fixed_form_fortran(self):
        self.write("stresses.c", BY_C)
        self.shell("gcc -O1 -Wall -Wextra -Werror stresses.c"
                   " $(pkg-config --cflags --libs faststrip) -o by_c")
        lines = self.shell("./by_c").split()
        self.assertEqual(lines[:4], ["100"] * 4)
        place = POINTS.index((1.25, 2.0, 3.0))
        wanted = [getattr(self.found, name)[place] for name in NAMES[3:]]
        self.assertEqual([float(line) for line in lines[4:]],
                         [*wanted, *self.contact.stress_peak()])
        self.check_calls(DECLARED, ROWS)

    def test_shapes_and_bad_points(self):
        flat = self.contact.stresses(0.0, [[0.0], [1.0]], [0.5, 1.0, 2.0])
        self.assertEqual(flat.szz.shape, (2, 3))
        self.assertEqual(len(flat.to_pandas()), 6)
        alone = self.contact.stresses(0.0, 1.0, 2.0)
        self.assertEqual(float(alone.sxx), flat.sxx[1, 2])
        for points, said in (((0.0, 0.0, -1.0), "depths must be 0 or more, got -1"),
                             ((0.0, float("nan"), 1.0), "must be"),
                             (([0.0, 1.0], [0.0, 1.0, 2.0], 1.0), "shapes that fit together")):
            with self.assertRaisesRegex(self.faststrip.FaststripError, said):
                self.contact.stresses(*points)
        bare = self.faststrip.Contact()
        bare.set_gap(*zip(*GAP))
        bare.solve(load=8e4)
        with self.assertRaisesRegex(self.faststrip.FaststripError, "elements of the contact"):
            bare.stresses(0.0, 0.0, 1.0)
        pressed = self.faststrip.Contact(tangential="none")
        pressed.set_gap(*zip(*GAP))
        result = pressed.solve(load=8e4)
        self.assertAlmostEqual(pressed.stress_peak().von_mises_max / result.pmax, 0.63, delta=0.02)
