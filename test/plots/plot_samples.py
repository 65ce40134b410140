"""Small CSV files for the plotting commands, and running a command in a folder of its own."""

import contextlib
import importlib.util
import io
import math
import os
import pathlib
import tempfile

PLOTS = pathlib.Path(__file__).resolve().parents[2] / "plots"

STAMP = "# faststrip 0.1.0 rev abc1234\n# compiler gfortran 12.2\n"
SWEEP_COLUMNS = (
    "case,yw_mm,normal,tangential,status,N_N,gamma_rad,cksi,ceta,cphi_rad_per_mm,penetration_mm,"
    "area_mm2,pmax_MPa,ymin_mm,ymax_mm,xmax_mm,n_patches,Fx_N,Fy_N,Mz_Nmm,friction_power_N,"
    "stick_fraction,normal_us,tangential_us"
).split(",")
REFERENCE_COLUMNS = (
    "yw_mm,Fn_N,penetration_mm,area_extrap_mm2,pmax_MPa,Fx_extrap_N,Fy_extrap_N,Mz_extrap_Nmm"
).split(",")
FAST_COLUMNS = (
    "method,dx_mm,yw_mm,cpu_norm_s,cpu_tang_s,err_pen_pct,err_area_pct,err_pmax_pct,"
    "err_Fx_pct_of_muN,err_Fy_pct_of_muN,err_Mz_Nmm"
).split(",")

AREA = 4.0 * math.pi  # mm2: c = sqrt(area/pi) = 2 mm


def csv_text(columns, rows, head=STAMP):
    lines = [",".join(columns)]
    lines += [",".join(str(row.get(name, "")) for name in columns) for row in rows]
    return head + "\n".join(lines) + "\n"


def sweep_row(yw, **changes):
    """A row like the reference at every shift: N = 10 kN, so that mu N = 3 kN."""
    row = dict(
        case="small", yw_mm=yw, normal="strip", tangential="faststrip", status="ok", N_N=10000.0,
        gamma_rad=0.0, cksi=0.001, ceta=0.0, cphi_rad_per_mm=1e-4, penetration_mm=0.05,
        area_mm2=repr(AREA), pmax_MPa=1000.0, ymin_mm=-3.0, ymax_mm=2.0, xmax_mm=1.5, n_patches=1,
        Fx_N=1000.0, Fy_N=-500.0, Mz_Nmm=600.0, friction_power_N=1.0, stick_fraction=0.5,
        normal_us=90.0, tangential_us=10.0,
    )
    row.update(changes)
    return row


def failed_row(yw, **changes):
    """A row as the program leaves it where a method gives no result."""
    row = dict(case="small", yw_mm=yw, normal="hertz", tangential="fastsim",
               status="no_hertz_ellipse", N_N=10000.0)
    row.update(changes)
    return row


def hertz_row(yw, **changes):
    return sweep_row(yw, **{"normal": "hertz", "tangential": "fastsim", **changes})


def sweep_text(*rows):
    return csv_text(SWEEP_COLUMNS, rows)


def reference_text(*shifts, **changes):
    row = dict(Fn_N=10000.0, penetration_mm=0.05, area_extrap_mm2=repr(AREA), pmax_MPa=1000.0,
               Fx_extrap_N=1000.0, Fy_extrap_N=-500.0, Mz_extrap_Nmm=600.0)
    row.update(changes)
    return csv_text(REFERENCE_COLUMNS, [dict(row, yw_mm=yw) for yw in shifts], "# reference\n")


def strips_text(patches=1):
    columns = "case,patch,strip,y_left_mm,y_right_mm,y_mm,half_length_mm,p0_MPa,load_N".split(",")
    rows = []
    for patch in range(patches):
        for k in range(5):
            left = -3.0 + k + 8.0 * patch
            root = math.sqrt(1.0 - ((k - 2.0) / 2.5) ** 2)
            rows.append(dict(case="small", patch=patch + 1, strip=len(rows) + 1, y_left_mm=left,
                             y_right_mm=left + 1.0, y_mm=left + 0.5, half_length_mm=1.5 * root,
                             p0_MPa=1000.0 * root, load_N=1.0))
    return csv_text(columns, rows)


def fields_text(patches=1):
    columns = "case,x_mm,y_mm,state,pn_MPa,px_MPa,py_MPa".split(",")
    rows = []
    for patch in range(patches):
        for k in range(5):
            root = math.sqrt(1.0 - ((k - 2.0) / 2.5) ** 2)
            for t in (-0.75, -0.25, 0.25, 0.75):
                rows.append(dict(case="small", x_mm=1.5 * root * t, y_mm=-2.5 + k + 8.0 * patch,
                                 state=1, pn_MPa=1000.0 * root * math.sqrt(1.0 - t * t), px_MPa=1.0,
                                 py_MPa=0.0))
    return csv_text(columns, rows)


def grid_text(step=0.5):
    """An ellipse of half-axes 1.5 (x) and 2.5 (y) about y = -0.5 on a square grid."""
    columns = "x_mm,y_mm,state,h_mm,pn_MPa,px_MPa,py_MPa".split(",")
    rows = []
    for i in range(-8, 8):
        for j in range(-12, 12):
            x, y = (i + 0.5) * step, (j + 0.5) * step
            rest = 1.0 - (x / 1.5) ** 2 - ((y + 0.5) / 2.5) ** 2
            if rest > 0.0:
                rows.append(dict(x_mm=x, y_mm=y, state=1, h_mm=0.0, pn_MPa=1000.0 * math.sqrt(rest),
                                 px_MPa=0.0, py_MPa=0.0))
    return csv_text(columns, rows, "# CONTACT\n")


def profiles_text():
    rows = [dict(body="wheel", y_mm=750.0 + y, z_mm=-y * y / 600.0 - 0.02 * y)
            for y in range(-40, 41, 2)]
    rows += [dict(body="rail", y_mm=750.0 + y, z_mm=y * y / 500.0 - 0.02 * y)
             for y in range(-30, 31, 2)]
    return csv_text(("body", "y_mm", "z_mm"), rows)


def gap_text():
    return csv_text(("y_mm", "h_mm", "inv2R_per_mm"),
                    [dict(y_mm=y, h_mm=y * y * 0.004, inv2R_per_mm=1e-3) for y in range(-10, 11)])


class Folder:
    """A temporary folder with files, to run a plotting command in."""

    def __init__(self, files):
        self.files = files

    def __enter__(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.path = pathlib.Path(self.temporary.name)
        for name, text in self.files.items():
            path = self.path / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
        return self

    def __exit__(self, *reason):
        self.temporary.cleanup()

    def run(self, command, *arguments):
        """Exit status, stdout and stderr of `plots/COMMAND.py ARGUMENTS` run in the folder."""
        from faststrip_plots.command import run

        main = load(command).main
        out, err = io.StringIO(), io.StringIO()
        before = os.getcwd()
        os.chdir(self.path)
        try:
            with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
                try:
                    status = run(main, [str(word) for word in arguments])
                except SystemExit as stop:
                    status = stop.code
        finally:
            os.chdir(before)
        return status, out.getvalue(), err.getvalue()

    def refused(self, test, words, command, *arguments):
        """A test that a command ends with one line that holds some words, and makes nothing."""
        before = sorted(self.path.rglob("*"))
        status, out, err = self.run(command, *arguments)
        test.assertEqual((status, out, err.count("\n")), (1, "", 1), (words, err))
        test.assertIn(words, err)
        test.assertEqual(sorted(self.path.rglob("*")), before, words)


def load(command):
    spec = importlib.util.spec_from_file_location(f"plots_{command}", PLOTS / f"{command}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module
