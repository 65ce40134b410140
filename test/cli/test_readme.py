"""The figures that the README shows are today's; what it runs test_pages runs."""


import measured
import validation
from cli_program import ROOT, ProgramTest

# How far a figure may be from the stored one before the stored one is stale, relative.
STALE = 0.1


class Readme(ProgramTest):
    def test_the_figures_are_those_of_today(self):
        """Errors on the paper's contacts, computed anew; ./run stored measured stores them."""
        self.good("sweep", ROOT / "example" / "s1002_uic60.nml", "-o", "sweep.csv")
        stored = measured.Measured(ROOT / validation.MEASURED)
        rows = measured.contact_rows(str(self.folder / "sweep.csv"))
        self.assertGreater(len(rows), 30)
        for table, row, column, value in rows:
            with self.subTest(row=row, column=column):
                known = stored.number(table, row, column)
                self.assert_close(float(value), known, STALE)
