"""`faststrip integral` against numbers of 30 digits."""

from cli_program import ROOT, ProgramTest, rows_of

REFERENCE = ROOT / "reference" / "influence"


def reference(name):
    return rows_of((REFERENCE / name).read_text(encoding="utf-8"))


class Integral(ProgramTest):
    def check(self, rows, results, key, relative):
        self.assertEqual(len(results), len(rows))
        for row, result in zip(rows, results):
            self.assertEqual(int(result["n"]), int(row["n"]))
            self.assertEqual(float(result["b"]), float(row["b"]))
            self.assert_close(float(result["value"]), float(row[key]), relative, what=row)

    def test_centre_line(self):
        rows = reference("reference_center.csv")
        results = self.good("integral", "--input", REFERENCE / "reference_center.csv")
        self.check(rows, results, "i_n", 1e-14)
        self.assertEqual({row["method"] for row in results}, {"closed"})
        self.assertEqual({float(row["X"]) for row in results}, {0.0})

    def test_off_centre(self):
        rows = reference("reference_offcenter.csv")
        results = self.good("integral", "--input", REFERENCE / "reference_offcenter.csv")
        self.check(rows, results, "value", 1e-12)
        self.assertEqual([float(row["X"]) for row in results], [float(row["X"]) for row in rows])

    def test_quadrature_of_a_file(self):
        rows = [row for row in reference("reference_offcenter.csv")
                if 1e-3 <= float(row["b"]) <= 1e3 and int(row["n"]) <= 100][::6]
        self.write("points.csv", "n,b,X\n" + "".join(
            f"{row['n']},{row['b']},{row['X']}\n" for row in rows))
        results = self.good("integral", "--input", "points.csv", "--method", "quadrature")
        self.check(rows, results, "value", 1e-9)
        self.assertEqual({row["method"] for row in results}, {"quadrature"})

    def test_every_method_is_the_one_of_its_name(self):
        """The same but for rounding, and within its fit the table."""
        for n, b in ((0, 0.01), (0, 1.0), (3, 0.2), (20, 5.0)):
            closed, quadrature, table = (
                float(self.good("integral", "--n", n, "--b", b, "--method", method)[0]["value"])
                for method in ("closed", "quadrature", "table"))
            self.assert_close(quadrature, closed, 1e-9, what=(n, b))
            self.assert_close(table, closed, 0.01, what=(n, b))
            self.assertNotEqual(table, closed)

    def test_one_value_by_options(self):
        result = self.good("integral", "--n=3", "--b", "0.2", "--x", "0.9")[0]
        self.assertEqual(list(result), ["n", "b", "X", "method", "value"])
        other = self.good("integral", "--n", "3", "--b", "2e-1", "--x", "-.9", "--method",
                          "quadrature")[0]
        self.assert_close(float(result["value"]), float(other["value"]), 1e-10)

    def test_far_points_do_not_overflow(self):
        words = ("integral", "--n", "2000000000", "--b", "1e-9", "--x", "0.5")
        closed = float(self.good(*words)[0]["value"])
        other = float(self.good(*words, "--method", "quadrature")[0]["value"])
        self.assert_close(closed, other, 1e-6)

    def test_numbers_keep_17_digits(self):
        done = self.run_program("integral", "--n", "1", "--b", "0.1", "--x", "0.3")
        row = rows_of(done.stdout)[0]
        self.assertEqual((float(row["b"]), float(row["X"])), (0.1, 0.3))
        for name in ("b", "X", "value"):
            self.assertRegex(row[name], r"\A-?\d\.\d{16}E[+-]\d{3}\Z")
            self.assertEqual(f"{float(row[name]):.16e}".split("e")[0], row[name].split("E")[0])
        self.assertRegex(done.stdout, r"\A# faststrip [0-9.]+ rev ")

    def test_file_is_what_stdout_is(self):
        words = ("integral", "--n", "1", "--b", "0.1")
        text = self.run_program(*words).stdout
        done = self.run_program(*words, "-o", "out.csv")
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))
        self.assertEqual((self.folder / "out.csv").read_text(encoding="utf-8"), text)
        self.assertEqual([path.name for path in self.folder.iterdir()], ["out.csv"])
        self.assertEqual(self.run_program(*words, "-o", "-").stdout, text)

    def test_bad_values(self):
        for words, says in (
            (["--n", "-1", "--b", "1"], "-1"),
            (["--n", "1", "--b", "0"], "0.0000"),
            (["--n", "1", "--b", "-2"], "-2.0"),
            (["--n", "21", "--b", "1", "--method", "table"], "21"),
            (["--n", "1", "--b", "11", "--method", "table"], "11.0"),
            (["--n", "1", "--b", "1", "--x", ".5", "--method", "table"], "0.5"),
            (["--n", "5", "--b", "1e308", "--x", ".5"], "0.1"),
        ):
            with self.subTest(words):
                self.refused_and_untouched("integral", *words, says=[says])

    def test_bad_files(self):
        for text, says in (
            ("n,b\n1,0.1\n2,-0.1\n", ["(in.csv:3)", "-0.1"]),
            ("n,b\n1,0.1\n\n# x\n-2,0.1\n", ["(in.csv:5)", "-2"]),
            ("n,b\n1,NaN\n", ["(in.csv:2)", "'NaN'", "column b"]),
            ("n,b\n1.5,1\n", ["(in.csv:2)", "'1.5'", "column n"]),
            ("n,b,X\n1,1,\n", ["(in.csv:2)", "column X"]),
            ("n,b\n1\n", ["(in.csv:2)"]),
            ("n,X\n1,2\n", ["(in.csv)", ": b "]),
            ("n,b,n\n1,2,3\n", ["(in.csv:1)", "'n'"]),
            ("", ["(in.csv)"]),
        ):
            with self.subTest(text):
                self.write("in.csv", text)
                self.refused_and_untouched("integral", "--input", "in.csv", says=says)
        self.refused_and_untouched("integral", "--input", "none.csv", says=["none.csv"])
