"""Files in the places where the program makes files of its own: inputs, and what others have there.

Beside an output stand, while a run goes on, a lock, a journal, what there is of the output, parts
and manifests; unfinished tables; temporary files. Whatever has such a name, and however it is
spelled, must be the same after the run, which either does without the name or refuses to begin.
`tries()` lists all of them, the same each time.
"""

import dataclasses
import functools
import os
import socket

GONE = 2147483646       # no process has this number
STALE = f"faststrip_{socket.gethostname().replace('/', '')}_{GONE}_1.tmp"

COLUMNS = "case,gap_file,E_MPa,nu,mu,N_N,cksi,ceta,cphi_rad_per_mm"
GAP = "y_mm,h_mm,inv2R_per_mm\n" + "".join(
    f"{y / 2},{y * y / 2400},{1 / 920}\n" for y in range(-30, 31))
WEAR = ("# source: nobody\n# body: wheel\n# density_kg_per_m3: 8000\n"
        "from_N_per_mm2,to_N_per_mm2,constant_ug_per_m_mm2,slope_ug_per_m_N\n0,1000,0,4\n")
POINTS = "".join(f"{y} {abs(y) ** 1.5 / 100}\n" for y in range(-30, 31))
RADII = "y_mm,delta_r_mm\n" + "".join(
    f"{y / 2},{(y / 8) ** 3 / 10 + y / 20}\n" for y in range(-20, 21))
VICTIM = "the only copy\n"

# How an input is called that lies at a place.
SPELLINGS = ("{}", "./{}", ".//{}", "dir/../{}", "{{folder}}/{}", "dirlink/{}", "symbolic", "hard")
# What of others may lie at a place.
KINDS = ("text", "nothing", "result", "symbolic", "dangling", "hard", "folder", "pipe")

KEPT = (".lock", ".journal", ".partial")
PART = (*KEPT, ".manifest")
SHARED = (".lock", ".manifest", ".part1of2", ".part2of2", *(f".part1of2{word}" for word in PART),
          ".part2of2.partial", ".part2of2.manifest")
MODES = (((), KEPT), (("--resume",), KEPT), (("--part", "1/2"), PART),
         (("--parts", "2"), SHARED))


@dataclasses.dataclass
class Side:
    """One run: its words, files, and what it may leave."""

    label: str
    words: list
    files: dict                                 # names and texts; {folder} is filled in
    at: str                                     # the place
    spelling: str = "{}"
    kind: str = ""                              # of what others have there; empty: an input
    codes: tuple = (2,)
    makes: tuple = ()                           # what may be there afterwards that was not

    def prepare(self, folder):
        """Lay everything into a folder."""
        (folder / "dir").mkdir()
        (folder / "dirlink").symlink_to(".")
        (folder / "victim").write_text(VICTIM)
        for name, text in self.files.items():
            (folder / name).write_text(text.replace("{folder}", str(folder)))
        place = folder / self.at
        if self.spelling == "symbolic":
            (folder / "symbolic").symlink_to(self.at)
        elif self.spelling == "hard":
            os.link(place, folder / "hard")
        if self.kind == "text":
            place.write_text("somebody's\n")
        elif self.kind == "nothing":
            place.touch()
        elif self.kind == "result":
            place.write_text("# faststrip 0.1.0 rev 0\ny_mm,h_mm\n0,0\n")
        elif self.kind == "symbolic":
            place.symlink_to("victim")
        elif self.kind == "dangling":
            place.symlink_to("new")
        elif self.kind == "hard":
            os.link(folder / "victim", place)
        elif self.kind == "folder":
            place.mkdir()
        elif self.kind == "pipe":
            os.mkfifo(place)


def spelled(spelling, name):
    """How a file is called; the folder is filled in where that is known."""
    return spelling.format(name)


def cases(gap="gap.csv"):
    return f"{COLUMNS}\na,{gap},210000,0.28,0.3,1e5,0.001,0,0\n"


def gap_case(gap="gap.csv"):
    return (f"&contact\n gap_file = '{gap}'\n load_N = 1e5\n/\n&material\n mu = 0.3\n/\n"
            "&motion\n cksi = 0.001\n/\n")


def profile_case(wheel="w.txt"):
    return (f"&contact\n load_N = 1e5\n/\n&wheel\n profile = '{wheel}'\n/\n&rail\n"
            " profile = 'uic60'\n/\n&material\n mu = 0.3\n/\n&motion\n/\n")


def inputs_of_batches():
    parts = ("r.csv.part1of2", "r.csv.part1of2.manifest")
    for options, places in MODES:
        words = ["-o", "r.csv", *options]
        makes = parts if "--parts" in options else ()
        for place in places:
            at = f"r.csv{place}"
            for spelling in SPELLINGS:
                called = spelled(spelling, at)
                yield Side("batch, table", ["batch", called, *words],
                           {"gap.csv": GAP, at: cases()}, at, spelling)
                yield Side("batch, gap", ["batch", "b.csv", *words],
                           {"b.csv": cases(called), at: GAP}, at, spelling, codes=(1, 2),
                           makes=makes)
                yield Side("batch, wear law", ["batch", "b.csv", "--wear", called, *words],
                           {"b.csv": cases(), "gap.csv": GAP, at: WEAR}, at, spelling)


def inputs_of_others():
    table = "FSLT\r\n"
    for spelling in SPELLINGS:
        for at, words, files in (
            ("r.csv.lock", ["merge", "{}", "p.csv", "-o", "r.csv"], {"p.csv": "a\n1\n"}),
            ("p.csv.manifest", ["merge", "p.csv", "-o", "{}"], {"p.csv": "a\n1\n"}),
            ("q.fslt.unfinished", ["lookup", "make", "--axes-of", "{}", "-o", "q.fslt"], {}),
            ("q.fslt.unfinished", ["lookup", "wheel", "c.nml", "--axes-of", "{}", "-o", "q.fslt"],
             {"c.nml": profile_case("s1002")}),
            ("q.fslt.unfinished", ["lookup", "wheel", "{}", "--axes-of", "t.fslt", "-o", "q.fslt"],
             {"t.fslt": table}),
            ("q.fslt.unfinished", ["lookup", "wheel", "c.nml", "--axes-of", "t.fslt", "-o",
                                   "q.fslt"],
             {"t.fslt": table, "c.nml": profile_case(spelled(spelling, "q.fslt.unfinished"))}),
        ):
            called = spelled(spelling, at)
            yield Side(" ".join(words[:2]), [called if word == "{}" else word for word in words],
                       {**files, at: table}, at, spelling)


def stale_inputs():
    """Inputs that are called as what a killed run has left."""
    for spelling in SPELLINGS:
        called = spelled(spelling, STALE)
        for label, words, files in (
            ("contact, case", ["contact", called], {STALE: gap_case(), "gap.csv": GAP}),
            ("contact, gap", ["contact", "c.nml"], {"c.nml": gap_case(called), STALE: GAP}),
            ("contact, profile", ["contact", "c.nml"], {"c.nml": profile_case(called),
                                                        STALE: POINTS}),
            ("contact, wear law", ["contact", "c.nml", "--wear", called],
             {"c.nml": gap_case(), "gap.csv": GAP, STALE: WEAR}),
            ("batch, table", ["batch", called], {STALE: cases(), "gap.csv": GAP}),
            ("batch, gap", ["batch", "b.csv"], {"b.csv": cases(called), STALE: GAP}),
            ("sweep", ["sweep", called],
             {STALE: profile_case() + "&sweep\n shifts_mm = 0\n/\n", "w.txt": POINTS}),
            ("conicity", ["conicity", "--delta-r", called], {STALE: RADII}),
            ("netcdf", ["netcdf", called], {STALE: RADII}),
        ):
            out = "r.nc" if label == "netcdf" else "r.csv"
            yield Side(f"stale, {label}", [*words, "-o", out], files, STALE, spelling, codes=(0,),
                       makes=(out,))


def strangers():
    parts = ("r.csv.part1of2", "r.csv.part1of2.manifest")
    files = {"b.csv": cases(), "gap.csv": GAP}
    for kind in KINDS:
        for options, places in MODES:
            for place in places:
                yield Side("strange", ["batch", "b.csv", "-o", "r.csv", *options], files,
                           f"r.csv{place}", kind=kind, codes=(1,),
                           makes=parts if "--parts" in options else ())
        if kind in ("symbolic", "dangling", "hard", "folder", "pipe"):
            for words in (["batch", "b.csv"], ["contact", "c.nml"]):
                yield Side("strange, stale", [*words, "-o", "r.csv"],
                           {**files, "c.nml": gap_case()}, STALE, kind=kind, codes=(0,),
                           makes=("r.csv",))


@functools.cache
def tries():
    """All of them."""
    return [*inputs_of_batches(), *inputs_of_others(), *stale_inputs(), *strangers()]
