"""Each column holds what its name says: slip, sides of elements, lists of a sweep, profiles."""


from cli_program import ProgramTest, gap_case, gap_text, numbers, parabola, profile_case


class Columns(ProgramTest):
    def test_slip_and_traction_give_the_power_of_every_element(self):
        self.write("gap.csv", gap_text(parabola))
        self.write("case.nml", gap_case(
            motion="cksi = 0.002, ceta = -0.001, cphi_rad_per_mm = 1e-4"))
        for method in ("faststrip", "fastsim", "faststrip-corrected", "tang"):
            row = self.good("contact", "case.nml", "--tangential", method, "--fields", "f.csv")[0]
            px, py, sx, sy, power, area = (
                numbers(self.read("f.csv"), name)
                for name in ("px_MPa", "py_MPa", "sx", "sy", "power_MPa", "area_mm2"))
            top = max(power)
            self.assertGreater(top, 0.0)
            for k, value in enumerate(power):
                self.assert_close(-(px[k] * sx[k] + py[k] * sy[k]), value, 0, 1e-9 * top, method)
            # TANG's is that of the forces, of which elements see a little less.
            self.assert_close(sum(a * p for a, p in zip(area, power)),
                              float(row["friction_power_N"]), 0.01 if method == "tang" else 1e-6,
                              what=method)

    def test_sides_of_elements_along_x_and_y(self):
        self.write("gap.csv", gap_text(parabola))
        self.write("case.nml", gap_case(motion="cksi = 0.001"))
        for normal in ("hertz", "strip", "norm"):
            self.good("contact", "case.nml", "--normal", normal, "--tangential", "tang",
                      "--element-dx", "0.5", "--element-dy", "0.8", "--fields", "f.csv")
            for name, side in (("x_mm", 0.5), ("y_mm", 0.8)):
                places = sorted({round(value, 6) for value in numbers(self.read("f.csv"), name)})
                for low, high in zip(places, places[1:]):
                    self.assert_close(high - low, side, 0, 2e-6, (normal, name))

    def test_a_sweep_takes_its_lists_shift_by_shift(self):
        lists = {"N_N": (9e4, 8e4), "cksi": (1e-3, -2e-3), "ceta": (5e-4, 7e-4),
                 "cphi_rad_per_mm": (1e-4, -3e-4)}
        text = "".join(f" {name.replace('N_N', 'load_N')} = {', '.join(map(repr, values))}\n"
                       for name, values in lists.items())
        self.write("case.nml", profile_case(extra=f"&sweep\n shifts_mm = 1.0, -2.0\n{text}/\n"))
        self.good("sweep", "case.nml", "-o", "s.csv")
        rows = self.read("s.csv")
        self.assertEqual(len(rows), 6)
        for row in rows:
            place = (1.0, -2.0).index(float(row["yw_mm"]))
            for name, values in lists.items():
                self.assertEqual(float(row[name]), values[place], name)

    def test_profiles_are_written_where_they_touch(self):
        self.write("case.nml", profile_case(contact="load_N = 1e5, shift_mm = 3"))
        self.good("contact", "case.nml", "--profiles", "p.csv")
        points = {body: sorted((float(row["y_mm"]), float(row["z_mm"]))
                               for row in self.read("p.csv") if row["body"] == body)
                  for body in ("wheel", "rail")}

        def height(body, y):
            line = points[body]
            for (y0, z0), (y1, z1) in zip(line, line[1:]):
                if y0 <= y <= y1 and y1 > y0:
                    return z0 + (z1 - z0) * (y - y0) / (y1 - y0)
            return None

        gaps = []
        for k in range(-250, 251):
            rail, wheel = (height(body, 0.1 * k) for body in ("rail", "wheel"))
            if rail is not None and wheel is not None:
                gaps.append(rail - wheel)
        self.assertGreater(len(gaps), 300)
        # z points down: the wheel lies above the rail and touches it once.
        self.assert_close(min(gaps), 0.0, 0, 5e-3)
        self.assertGreater(max(gaps), 0.1)
