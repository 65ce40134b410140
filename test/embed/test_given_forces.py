"""Forces given in place of creepages, in the interfaces for hosts: the same bits in each."""

import numpy as np

from installed import HostTest

C = r"""
#include <faststrip.h>
#include <stdio.h>
int main(void)
{
    static double y[301], h[301], a[301];
    faststrip_workspace *workspace;
    faststrip_case contact;
    faststrip_result result;
    for (int i = 0; i < 301; i++)
        y[i] = 0.1 * (i - 150), h[i] = y[i] * y[i] / 600.0, a[i] = 1.0 / 920.0;
    faststrip_default_case(&contact, sizeof contact);
    faststrip_new(&contact, 301, &workspace);
    faststrip_set_gap(workspace, 301, y, h, a, NULL);
    contact.load = 1e5, contact.cphi = 2e-4;
    contact.fx_is_given = contact.fy_is_given = 1;
    contact.given_fx = 1e4, contact.given_fy = -5e3;
    printf("%d ", faststrip_solve(workspace, &contact, &result));
    printf("%.17g %.17g %.17g %.17g\n", result.cksi, result.ceta, result.est_err_cksi,
           result.est_err_ceta);
    contact.given_fx = 4e4;
    printf("%d\n", faststrip_solve(workspace, &contact, &result));
    faststrip_free(&workspace);
    return 0;
}
"""
F77 = """\
      PROGRAM GIVEN
      INTEGER IOPT(9), IWORK(8), IGIV(2), INFO, I
      DOUBLE PRECISION PAR(9), RES(14), Y(301), H(301), A(301)
      DOUBLE PRECISION FGIV(2), CREEP(5)
      DATA IGIV/1, 1/, FGIV/1.0D4, -5.0D3/
      CALL FSDFLT(IOPT, PAR)
      CALL FSINIT(IOPT, 301, IWORK, 8, INFO)
      DO 10 I = 1, 301
        Y(I) = 0.1D0*(I - 151)
        H(I) = Y(I)*Y(I)/600.0D0
        A(I) = 1.0D0/920.0D0
   10 CONTINUE
      PAR(6) = 1.0D5
      PAR(9) = 2.0D-4
      CALL FSGIVN(IWORK, IGIV, FGIV, INFO)
      CALL FSCONT(IWORK, 301, Y, H, A, IOPT, PAR, RES, INFO)
      CALL FSCREP(IWORK, CREEP, INFO)
      WRITE (*, '(I3, 4ES25.17)') INFO, CREEP(1), CREEP(2), CREEP(4),
     &  CREEP(5)
      IGIV(1) = 0
      IGIV(2) = 0
      CALL FSGIVN(IWORK, IGIV, FGIV, INFO)
      CALL FSSOLV(IWORK, IOPT, PAR, RES, INFO)
      CALL FSCREP(IWORK, CREEP, INFO)
      WRITE (*, '(I3, 4ES25.17)') INFO, (CREEP(I), I = 1, 4)
      CALL FSFREE(IWORK, INFO)
      END
"""


class GivenForces(HostTest):
    def found(self, line):
        return [float(word) for word in line.split()]

    def test_every_interface_finds_the_same_creepages(self):
        faststrip = self.import_package()
        y = np.array([0.1 * (i - 150) for i in range(301)])
        gap = y, y * y / 600.0, np.full(301, 1.0 / 920.0)
        contact = faststrip.Contact()
        contact.set_gap(*gap)
        case = {"load": 1e5, "forces": (1e4, -5e3), "creepage": (0.0, 0.0, 2e-4)}
        one = contact.solve(**case)
        expected = [0.0, one.cksi, one.ceta, one.est_err_cksi, one.est_err_ceta]
        self.assertAlmostEqual(one.fx, 1e4, delta=0.3)
        self.assertAlmostEqual(one.fy, -5e3, delta=0.3)
        many = faststrip.solve_many(gap, **case | {"forces": ([1e4, 2e4], -5e3)})
        self.assertEqual((many.cksi[0], many.ceta[0]), (one.cksi, one.ceta))
        self.write("given.c", C)
        self.shell("gcc -Wall -Wextra -Werror given.c $(pkg-config --cflags --libs faststrip) -o c")
        lines = self.shell("./c").splitlines()
        self.assertEqual(self.found(lines[0]), expected)
        self.assertEqual(lines[1], "114")
        self.write("given.f", F77)
        self.shell("gfortran -std=legacy given.f $(pkg-config --libs faststrip) -o f77")
        lines = self.shell("./f77").splitlines()
        self.assertEqual(self.found(lines[0]), expected)
        # Given again they are what is given.
        self.assertEqual(self.found(lines[1])[:4], [0.0, 0.0, 0.0, 2e-4])

    def test_what_cannot_be_is_refused(self):
        faststrip = self.import_package()
        y = np.linspace(-15.0, 15.0, 301)
        contact = faststrip.Contact()
        contact.set_gap(y, y * y / 600.0, 1.0 / 920.0)
        for case, says in (({"forces": (4e4, None)}, "must not be above mu N, 30000.0 N"),
                           ({"forces": (1e3, None), "creepage": (1e-3, 0.0, 0.0)},
                            "cksi must be 0 where Fx is given"),
                           ({"forces": (np.nan, None)}, r"forces\[0\] must be finite"),
                           ({"forces": (1e3,)}, "forces must be longitudinal and lateral")):
            with self.assertRaisesRegex(faststrip.FaststripError, says):
                contact.solve(load=1e5, **case)
        # What was given does not stay.
        self.assertEqual(contact.solve(load=1e5).fx, 0.0)

    def test_slopes_are_those_at_the_creepages_found(self):
        faststrip = self.import_package()
        y = np.linspace(-15.0, 15.0, 301)
        contact = faststrip.Contact()
        contact.set_gap(y, y * y / 600.0, 1.0 / 920.0)
        found = contact.solve(load=1e5, forces=(1e4, None), derivatives=True)
        same = contact.solve(load=1e5, creepage=(found.cksi, 0.0, 0.0), derivatives=True)
        self.assertEqual(found.derivatives.tolist(), same.derivatives.tolist())
