#!/usr/bin/env python3
"""Write src/faststrip/tangential/force/weights.f90 from reference/force_correction.json.

    tools/generate/force_weights.py            write the module
    tools/generate/force_weights.py --check    exit 1 if the module is not what would be written
"""

import argparse
import json
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
SOURCE = ROOT / "reference" / "force_correction.json"
MODULE = ROOT / "src" / "faststrip" / "tangential" / "force" / "weights.f90"
LAYERS = ("first", "second", "third")

HEAD = """\
!> The networks of the force correction and of its errors: their numbers. Written by
!> tools/generate/force_weights.py from reference/force_correction.json, which
!> tools/generate/fit_forces.py has fitted; change those, not this.
module faststrip_tangential_force_weights
    use faststrip_base_kinds, only: wp
    implicit none
    private

    public :: n_ellipse_inputs, n_shape_inputs, n_sides, n_factors, n_side_factors, hidden
    public :: ellipse_first, ellipse_first_bias, ellipse_second, ellipse_second_bias, &
              ellipse_third, ellipse_third_bias
    public :: shape_first, shape_first_bias, shape_second, shape_second_bias, shape_third, &
              shape_third_bias
    public :: n_error_inputs, n_errors, error_hidden, error_first, error_first_bias, &
              error_second, error_second_bias, error_third, error_third_bias, error_safety, &
              smallest_error, largest_estimate
    public :: most, side_scale, even_scale, odd_scale, half_shape, largest_log_ratio, &
              largest_shape, least_poisson, largest_poisson
"""


def literal(value):
    return f"{value!r}_wp"


def listed(values):
    """Literals of an array, in lines of at most 100 columns."""
    lines, line = [], ""
    for k, value in enumerate(values):
        word = literal(value) + (", " if k + 1 < len(values) else "]")
        if len(line) + len(word) > 88:
            lines.append(line + "&")
            line = ""
        line += word
    return "\n".join(" " * 8 + one for one in [*lines, line])


def array(name, shape, values, text):
    return (f"    !> {text}\n    real(wp), parameter :: {name}({shape}) = [ &\n"
            f"{listed(values)}\n")


def matrix(name, rows, columns, values, text):
    """A matrix by its columns, each a constant of its own: few lines to one statement."""
    parts = [array(f"{name}_{j + 1}", rows, values[j * rows:(j + 1) * rows],
                   f"Column {j + 1} of `{name}`.") for j in range(columns)]
    names = listed_names([f"{name}_{j + 1}" for j in range(columns)])
    return "\n".join(parts) + (f"\n    !> {text}\n    real(wp), parameter :: "
                               f"{name}({rows}, {columns}) = reshape([ &\n{names}, "
                               f"[{rows}, {columns}])\n")


def listed_names(names):
    lines, line = [], ""
    for k, name in enumerate(names):
        word = name + (", " if k + 1 < len(names) else "]")
        if len(line) + len(word) > 84:
            lines.append(line + "&")
            line = ""
        line += word
    return "\n".join(" " * 8 + one for one in [*lines, line])


def module(fitted):
    ellipse, shape, errors = fitted["ellipse"], fitted["shape"], fitted["errors"]
    parts = [HEAD]
    factors = ellipse[2]["outputs"]
    for name, value, text in (
            ("n_ellipse_inputs", ellipse[0]["inputs"], "Inputs of both networks."),
            ("n_shape_inputs", shape[0]["inputs"] - ellipse[0]["inputs"],
             "Further inputs of the second one."),
            ("hidden", ellipse[0]["outputs"], "Units of each of their two layers."),
            ("n_factors", factors, "Factors that an ellipse has."),
            ("n_side_factors", shape[2]["outputs"] - factors, "Factors of the odd numbers."),
            ("n_error_inputs", errors[0]["inputs"], "Inputs of the network of the errors."),
            ("error_hidden", errors[0]["outputs"], "Units of each of its layers."),
            ("n_errors", errors[2]["outputs"], "Errors that it estimates."),
            ("n_sides", len(fitted["side_scale"]), "Odd numbers of the shape in the forces.")):
        parts.append(f"    !> {text}\n    integer, parameter :: {name} = {value}\n")
    for name, text in (
            ("half_shape", "Measure of the shape at which half of the shape's part counts."),
            ("largest_log_ratio", "Largest |ln(a/b)| of the fit."),
            ("largest_shape", "Largest root of the shape's measure in the fit, one in 100 above."),
            ("error_safety", "The estimates are larger by this than the network's."),
            ("smallest_error", "Errors and corrections count from here on."),
            ("largest_estimate", "Estimates of the normal figures count up to here."),
            ("least_poisson", "Least Poisson's ratio of the fit."),
            ("largest_poisson", "Largest Poisson's ratio of the fit.")):
        parts.append(f"    !> {text}\n    real(wp), parameter :: {name} = "
                     f"{literal(fitted[name])}\n")
    for name, text in (("most", "Most that is corrected: forces, moment, stick."),
                       ("side_scale", "Scales of the odd numbers in the forces."),
                       ("even_scale", "Scales of the even numbers in the measure of the shape."),
                       ("odd_scale", "Scales of the odd numbers in the measure of the shape.")):
        values = fitted[name]
        parts.append(array(name, len(values), values, text))
    for part, layers in (("ellipse", ellipse), ("shape", shape), ("error", errors)):
        for word, layer in zip(LAYERS, layers, strict=True):
            name = f"{part}_{word}"
            # The file has the weights input by input: the columns of the matrix.
            parts.append(matrix(name, layer["outputs"], layer["inputs"], layer["weights"],
                                f"Weights of the {part}'s {word} layer, a column for each input."))
            parts.append(array(f"{name}_bias", layer["outputs"], layer["bias"],
                               f"Biases of the {part}'s {word} layer."))
    return "\n".join(parts) + "end module faststrip_tangential_force_weights\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true")
    options = parser.parse_args()
    text = module(json.loads(SOURCE.read_text(encoding="utf-8")))
    if not options.check:
        MODULE.write_text(text, encoding="utf-8")
        return 0
    if MODULE.read_text(encoding="utf-8") == text:
        return 0
    print(f"{MODULE.relative_to(ROOT)} must be what tools/generate/force_weights.py writes, got "
          "another text", file=sys.stderr)
    return 1


if __name__ == "__main__":
    sys.exit(main())
