"""Small results of `faststrip-lab claims`, with the reference and the methods they belong to."""

FIGURES = ("penetration", "pmax", "area", "Fx", "Fy", "Mz", "friction_power", "stick_fraction")
HEADER = ("kind,number,state,method,status,normal_us,tangential_us,"
          + ",".join(f"err_{name}" for name in FIGURES) + ","
          + ",".join(f"est_{name}" for name in FIGURES[:6]) + ",choice")
METHODS = """stage,method,when,normal,tangential,target,tolerance,baseline
both,Hertz,always,hertz,linear,,,
both,strips 31 + FASTSTRIP 15,always,strip,faststrip,,,strips
both,NORM + TANG 36,always,norm,tang,,,kalker
both,auto forces 5 %,always,auto,faststrip,forces,0.05,
both,auto forces 1 %,always,auto,faststrip,forces,0.01,
both,auto pmax 1 %,always,auto,faststrip,pmax,0.01,
"""
# Four contacts of two kinds.
CONTACTS = (("step", 1, 1), ("step", 1, 2), ("corner", 1, 1), ("corner", 2, 1))
# Of each: penetration, pmax, area, Fx, Fy, Mz, power, stick.
STRIPS = ((0.001, -0.02, 0.01, 0.004, -0.002, 0.008, 0.02, 0.03),
          (0.001, -0.02, 0.01, 0.002, 0.02, 0.001, 0.01, 0.0),
          (0.003, 0.004, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0),
          (0.0, 0.0, 0.0, -0.06, 0.0, 0.0, 0.01, 0.1))
EXACT = ((1e-5,) * 8,) * 4
AUTO_5 = STRIPS[:3] + ((0.0, 0.0, 0.0, -0.051, 0.0, 0.0, 0.01, 0.1),)
AUTO_1 = ((0.0, 0.02, 0.0, 0.004, 0.0, 0.009, 0.0, 0.0),
          (0.0, 0.0, 0.0, 0.0, 0.02, 0.0, 0.0, 0.0),
          (0.0, 0.0, 0.0, 0.0, 0.0, -0.0104, 0.0, 0.0),
          (0.0, 0.009, 0.0, 0.003, 0.0, 0.0, 0.0, 0.0))


def row(contact, method, status, us, errors, estimates=()):
    cells = [*contact, method, status, *us]
    cells += errors if errors else [""] * len(FIGURES)
    cells += [*estimates, *[""] * (6 - len(estimates)), ""]
    return ",".join(str(cell) for cell in cells)


def results():
    """The rows of all methods; the first fails on one contact."""
    lines = [f"# faststrip 0.1.0 rev {'ab' * 3}", "# err_*: sample", HEADER]
    for k, contact in enumerate(CONTACTS):
        errors = (0.1, 0.1, 0.1, 0.5, 0.0, 0.0, 0.1) + ("",)
        lines.append(row(contact, "Hertz", "ok" if k else "no_hertz_ellipse",
                         (2.0, 1.0) if k else (0, 0), errors if k else None))
    for method, status, us, errors in (
            ("strips 31 + FASTSTRIP 15", ("ok",) * 4, (300.0, 100.0), STRIPS),
            ("NORM + TANG 36", ("ok",) * 4, (1000.0, 3000.0), EXACT),
            ("auto forces 5 %", ("ok",) * 4, (60.0, 40.0), AUTO_5),
            ("auto forces 1 %", ("ok", "target_missed", "ok", "ok"), (700.0, 300.0), AUTO_1),
            ("auto pmax 1 %", ("target_missed", "ok", "ok", "ok"), (150.0, 5000.0), AUTO_1)):
        for k, contact in enumerate(CONTACTS):
            estimates = (0.002, 0.02, 0.01, 0.01, 0.01, 0.016) if "FASTSTRIP" in method else ()
            lines.append(row(contact, method, status[k], us, errors[k], estimates))
    return "\n".join(lines) + "\n"


def reference():
    """What is doubtful of the reference: of Mz of the third contact much."""
    lines = ["kind,number,state," + ",".join(f"doubt_{name}" for name in FIGURES)]
    for k, contact in enumerate(CONTACTS):
        values = [1e-4] * 8
        if k == 2:
            values[5] = 2e-3
        lines.append(",".join(str(cell) for cell in (*contact, *values)))
    return "\n".join(lines) + "\n"


def write_samples(folder):
    """Write results.csv, references.csv and methods.csv."""
    for name, text in (("results", results()), ("references", reference()), ("methods", METHODS)):
        (folder / f"{name}.csv").write_text(text, encoding="utf-8")
