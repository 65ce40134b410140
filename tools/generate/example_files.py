#!/usr/bin/env python3
"""Make the profiles and the gaps that cases of example/cases and pages read.

    bin/faststrip contact example/cases/tread_straight.nml -o out/tread.csv --profiles out/p.csv
    python3 tools/generate/example_files.py out/p.csv example/cases

They are made up, not measured: an S1002 worn hollow, a 60E1 worn at its gauge corner, two arcs that
nearly conform, a crowned roller on a flat rail, the crown of a disc.
"""

import csv
import math
import sys
from bisect import bisect_right
from pathlib import Path

S1002_FIRST_MM = -70.0  # where the profile begins, towards the flange

HOLLOW_MM, HOLLOW_WIDTH_MM, HOLLOW_PLACE_MM = 1.6, 16.0, 4.0

CORNER_MM, CORNER_WIDTH_MM, CORNER_PLACE_MM = 0.8, 9.0, -28.0
RAIL_STEP_MM = 0.4  # between points along the rail

TAPE_CIRCLE_MM = 70.0  # from the back of the flange

WHEEL_ARC_MM, RAIL_ARC_MM, WHEEL_RADIUS_MM = 330.0, 300.0, 460.0

CROWN_MM, ROLLER_MM, ROLLER_HALF_WIDTH_MM, EDGE_MM = 150.0, 100.0, 20.0, 5.0

DISC_CROWN_MM = 200.0


def read_points(path, body):
    """Points of the program's `--profiles`, in the rail's frame."""
    with open(path, encoding="utf-8") as lines:
        rows = csv.DictReader(line for line in lines if not line.startswith("#"))
        return [(float(r["y_mm"]), float(r["z_mm"])) for r in rows if r["body"] == body]


def s1002_of(points):
    """Wheel points in the wheel's own frame."""
    shift = points[0][0] - S1002_FIRST_MM
    tread = interpolated(points, shift)
    return [(y - shift, z - tread) for y, z in points]


def interpolated(points, y):
    i = min(max(bisect_right(points, (y, -math.inf)), 1), len(points) - 1)
    (y0, z0), (y1, z1) = points[i - 1], points[i]
    return z0 + (z1 - z0) * (y - y0) / (y1 - y0)


def worn_wheel(points):
    """A hollow that is deepest on the field side of the rolling circle; z points down."""
    for i in range(-138, 120):
        y = 0.5 * i
        hollow = HOLLOW_MM * math.exp(-(((y - HOLLOW_PLACE_MM) / HOLLOW_WIDTH_MM) ** 2))
        yield y, interpolated(points, y) - hollow


def worn_rail(points):
    """A corner that is worn on the gauge side, from the field side on, as it lies in the track."""
    last = None
    for y, z in reversed(points):
        if last is None or math.dist(last, (y, z)) >= RAIL_STEP_MM:
            last = y, z
            yield y, z + CORNER_MM * math.exp(-(((y - CORNER_PLACE_MM) / CORNER_WIDTH_MM) ** 2))


def near_conformal():
    """A concave wheel on a rail of nearly its radius."""
    for i in range(-300, 301):
        y = 0.1 * i
        rail = RAIL_ARC_MM - math.sqrt(RAIL_ARC_MM**2 - y * y)
        wheel = WHEEL_ARC_MM - math.sqrt(WHEEL_ARC_MM**2 - y * y)
        yield y, rail - wheel, 0.5 / WHEEL_RADIUS_MM


def polymer_roller():
    """A crowned roller whose edges are rounded off."""
    for i in range(-200, 201):
        y = 0.1 * i
        edge = max(abs(y) - (ROLLER_HALF_WIDTH_MM - EDGE_MM), 0.0)
        crown = CROWN_MM - math.sqrt(CROWN_MM**2 - y * y)
        yield y, crown + EDGE_MM - math.sqrt(EDGE_MM**2 - edge * edge), 0.5 / ROLLER_MM


def disc():
    """The crown of a disc, z down into it."""
    for i in range(-100, 101):
        y = 0.2 * i
        yield y, DISC_CROWN_MM - math.sqrt(DISC_CROWN_MM**2 - y * y)


def write(path, header, rows, separator):
    with open(path, "w", encoding="utf-8") as out:
        out.write("".join(f"{line}\n" for line in header))
        out.writelines(separator.join(f"{value:.9g}" for value in row) + "\n" for row in rows)


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    folder = Path(sys.argv[2])
    worn = list(worn_wheel(s1002_of(read_points(sys.argv[1], "wheel"))))
    rail = list(worn_rail(read_points(sys.argv[1], "rail")))
    origin = "# made by tools/generate/example_files.py: "
    columns = "y_mm,h_mm,inv2R_per_mm"
    write(folder / "worn_wheel.txt",
          [origin + "S1002 worn hollow; y to the field side, z down, mm"], worn, " ")
    # As a MiniProf writes it: x from the back of the flange, y to its tip, rounded to 0.01 mm.
    write(folder / "worn_wheel.whl",
          ["ProgramName=tools/generate/example_files.py", "Comment=S1002 worn hollow, made up",
           "ColumnDef=X,Y", f"XYPoints={len(worn)}", ""],
          [(round(y + TAPE_CIRCLE_MM, 2), round(z, 2)) for y, z in worn], " ")
    # x to the gauge side, y up.
    write(folder / "worn_rail.ban",
          ["ProgramName=tools/generate/example_files.py",
           "Comment=60E1 worn at the gauge corner, made up", "ColumnDef=X,Y",
           f"XYPoints={len(rail)}", ""],
          [(round(-y, 2), round(-z, 2)) for y, z in rail], " ")
    write(folder / "near_conformal.csv", [origin + "radii 330 and 300 mm", columns],
          near_conformal(), ",")
    write(folder / "polymer_roller.csv", [origin + "roller of 100 mm, crown 150 mm", columns],
          polymer_roller(), ",")
    write(folder / "twin_disc.txt", [origin + "crown of 200 mm; y, z into the disc, mm"], disc(),
          " ")


if __name__ == "__main__":
    main()
