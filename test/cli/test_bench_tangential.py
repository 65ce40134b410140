"""`faststrip-lab bench tangential` and `bench forces`: the columns, and what has been reached."""

import statistics

import methods
from cli_program import GAPS, ROOT, LabTest

CONTACTS = ROOT / "reference" / "contact"
SCENES = ROOT / "reference" / "scenes" / "scenes.csv"
LISTED = methods.listed("tangential")
METHODS = [name for name in LISTED if name != "none"]
LAWS = [name for name in METHODS if not LISTED[name].gives_elements]


class Bench(LabTest):
    def forces(self):
        """The rows of one run for all tests."""
        return self.written("bench", "forces", "--contacts", CONTACTS, "--scenes", SCENES,
                            share=True)

    def test_tangential(self):
        lines = (CONTACTS / "s1002_uic60_B.csv").read_text(encoding="utf-8").splitlines()
        rows = [line for line in lines if not line.startswith("#")]
        kept = rows[:1] + [row for row in rows if row.split(",")[0] in ("-5", "2")]
        self.write("contacts/s1002_uic60_B.csv", "\n".join(kept) + "\n")
        for shift in ("-5", "2"):
            name = f"shift_{shift}.csv"
            self.write(f"contacts/gaps/{name}", (GAPS / name).read_text(encoding="utf-8"))
        rows = self.written("bench", "tangential", "--contacts", "contacts", "--rounds", "3")
        self.assertEqual(list(rows[0]), (
            "method,strips,points,case,elements,us,ns_per_element,ratio,us_with_field,flags,"
            "compiler,cpu,cpu_us_median,cpu_us_p95,cpu_us_worst,us_with_heat").split(","))
        self.assertEqual([row["method"] for row in rows], METHODS * 8)
        for row in rows:
            us, elements = float(row["us"]), int(row["elements"])
            self.assertGreater(us, 0.0)
            self.assert_spread(row, "cpu_us")
            self.assert_close(float(row["ns_per_element"]), 1e3 * us / elements, 1e-12)
            self.assertEqual(row["us_with_field"] == "", row["method"] in LAWS)
            self.assertEqual(row["us_with_heat"] == "", row["method"] in LAWS)
            self.assertEqual(elements == 1, row["method"] in LAWS)
            if row["method"] == "fastsim":
                self.assertEqual(float(row["ratio"]), 1.0)

    def test_forces(self):
        rows = self.forces()
        errors = {}
        for row in rows:
            for group in {row["group"], "all"}:
                sums = errors.setdefault((row["set"], group, row["method"]), {})
                for name in ("Fx", "Fy", "force", "Mz", "power", "stick"):
                    value = row[f"{name}_err"]
                    if value:
                        sums.setdefault(name, []).append(abs(float(value)))
        self.assertEqual({key[2] for key in errors}, set(METHODS))
        self.assertEqual(len(errors["hertz", "all", "faststrip"]["force"]), 161)
        self.assertEqual(len(errors["scenes", "all", "faststrip"]["force"]), 240)
        # The goals, mean and largest: Fx, Fy, Mz.
        for group, goals in (
            (("s1002_uic60_B", "all"), ((0.6, 3.0), (0.35, 1.5), (1.0, 2.0))),
            (("scenes", "odd"), ((1.0, 5.0), (1.0, 5.0), (1.5, 10.0))),
            (("scenes", "even"), ((1.0, 5.0), (1.0, 5.0), (1.5, 10.0))),
        ):
            for name, (mean, largest) in zip(("Fx", "Fy", "Mz"), goals):
                own = errors[(*group, "faststrip")][name]
                self.assertLess(statistics.fmean(own), mean, (group, name))
                self.assertLess(max(own), largest, (group, name))
        self.assertLess(statistics.fmean(errors["hertz", "all", "faststrip"]["force"]), 0.65)
        own = errors["s1002_uic60_B", "all", "faststrip"]
        self.assertLess(statistics.fmean(own["power"]), 2.0)
        self.assertLess(statistics.fmean(own["stick"]), 2.5)
        # Nobody else comes near, except where there is no spin.
        for (name, group, method), sums in errors.items():
            if method in ("faststrip", "faststrip-plain") or group == "long":
                continue
            best = errors[name, group, "faststrip"]
            for quantity in ("force", "Mz"):
                self.assertLess(statistics.fmean(best[quantity]),
                                0.6 * statistics.fmean(sums[quantity]), (name, group, method))

    def test_the_fit_takes_half_of_the_errors_of_contacts_never_fitted(self):
        mean = {}
        for row in self.forces():
            if row["method"] in ("faststrip", "faststrip-plain"):
                for quantity in ("Fx_err", "Fy_err", "Mz_err"):
                    mean.setdefault((row["set"], quantity, row["method"]), []).append(
                        abs(float(row[quantity])))
        mean = {key: statistics.fmean(errors) for key, errors in mean.items()}
        for quantity in ("Fx_err", "Fy_err", "Mz_err"):
            for name, part in (("scenes", 0.5), ("hertz", 0.85), ("s1002_uic60_B", 0.7)):
                self.assertLess(mean[name, quantity, "faststrip"],
                                part * mean[name, quantity, "faststrip-plain"], (name, quantity))

    def test_the_correction_takes_what_is_missing_of_ellipses(self):
        rows = self.written("bench", "correction", "--quick")
        self.assertEqual(len(rows), 5 * 4 * 6)
        for direction, force in (("longitudinal", "Fx"), ("lateral", "Fy"), ("lateral", "Mz"),
                                 ("spin", "Fy"), ("all", "Fx"), ("all", "Fy"), ("all", "Mz")):
            own = [row for row in rows if row["direction"] == direction]
            before, after = (statistics.fmean(abs(float(row[name]) - float(row[f"{force}_tang"]))
                                              for row in own) for name in (f"{force}_plain", force))
            self.assertLess(after, 0.6 * before, (direction, force))
            self.assertGreater(before, 1e-3, (direction, force))

    def test_the_peers_are_beaten(self):
        # CONTACT's own fast methods on the same gaps, mean and largest of all three.
        rows = self.forces()
        own = {name: [abs(float(row[f"{name}_err"])) for row in rows
                      if (row["set"], row["method"]) == ("s1002_uic60_B", "faststrip")]
               for name in ("Fx", "Fy", "Mz")}
        peers = {}
        reference = {row["yw_mm"]: row for row in self.read(CONTACTS / "s1002_uic60_B.csv")}
        for row in self.read(CONTACTS / "s1002_uic60_fast_modes_B.csv"):
            sums = peers.setdefault((row["method"], row["dx_mm"]), {"Fx": [], "Fy": [], "Mz": []})
            size = (float(reference[row["yw_mm"]]["area_extrap_mm2"]) / 3.141592653589793) ** 0.5
            sums["Fx"].append(abs(float(row["err_Fx_pct_of_muN"])))
            sums["Fy"].append(abs(float(row["err_Fy_pct_of_muN"])))
            sums["Mz"].append(100.0 * abs(float(row["err_Mz_Nmm"]))
                              / (0.3 * float(row["Fn_N"]) * size))
        compared = 0
        for (method, _), sums in peers.items():
            compared += 1
            self.assertEqual(len(sums["Fx"]), 20)
            for name in ("Fx", "Fy", "Mz"):
                self.assertLess(statistics.fmean(own[name]), statistics.fmean(sums[name]), method)
                self.assertLess(max(own[name]), max(sums[name]), (method, name))
        self.assertEqual(compared, 17)

    def test_refused(self):
        for words, says in ((["tangential", "--seconds", "1"], "--seconds"),
                            (["forces", "--rounds", "1"], "--rounds"),
                            (["normal", "--scenes", "x"], "--scenes")):
            self.refused(2, "bench", *words, says=[says])
        self.refused_and_untouched("bench", "forces", "--scenes", "nowhere", "--contacts",
                                   str(CONTACTS), says=["nowhere"])
