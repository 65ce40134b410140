"""Fixed-form Fortran: its errors; the wheelset of example/legacy, which hunts as Klingel says.

The tolerance of Klingel's wavelength is 4 %."""

import math

from installed import HOSTS, ROOT, HostTest

# Rolling radius and half the distance of the contacts, mm.
R0, S = 460.0, 750.0


ERRORS = """\
      PROGRAM ERRORS
      INTEGER IOPT(9), IW(8), IW2(8), IW3(8), N, I, INFO, K(400),
     &  BITS(2)
      DOUBLE PRECISION PAR(9), RES(14), Y(6), H(6), A(6), X(400), F(3),
     &  ERR(7), ERR2(7), FERR(4), FERR2(4), TAKN(5), TAKN2(5), Z, IEEE
      CHARACTER*12 TEXT
      CHARACTER*80 LONG
      EQUIVALENCE (IEEE, BITS)
      DATA BITS /0, 2146959360/
      DATA Y /-2.0D0, -1.0D0, 0.0D0, 1.0D0, 2.0D0, 3.0D0/
      DATA H /0.4D0, 0.1D0, 0.0D0, 0.1D0, 0.4D0, 0.9D0/, A /6*1.0D-3/
      CALL FSDFLT(IOPT, PAR)
      CALL FSINIT(IOPT, 5, IW, -1, INFO)
      WRITE (*, *) 'query', IW(1)*1000 + INFO
      CALL FSINIT(IOPT, 5, IW, 7, INFO)
      WRITE (*, *) 'short', INFO
      CALL FSINIT(IOPT, 4, IW, 8, INFO)
      WRITE (*, *) 'points', INFO
      CALL FSGAP(IW, 5, Y, H, A, INFO)
      WRITE (*, *) 'unmade', INFO
      CALL FSLAST(IW, TEXT)
      WRITE (*, *) 'blank', INDEX(TEXT, 'no workspace')
      IOPT(9) = 1
      CALL FSINIT(IOPT, 5, IW, 8, INFO)
      WRITE (*, *) 'made', INFO
      CALL FSSOLV(IW, IOPT, PAR, RES, INFO)
      WRITE (*, *) 'gapless', INFO
      CALL FSGAP(IW, -1, Y, H, A, INFO)
      WRITE (*, *) 'negative', INFO
      CALL FSCONT(IW, 6, Y, H, A, IOPT, PAR, RES, INFO)
      WRITE (*, *) 'long', INFO
      CALL FSCONT(IW, 5, Y, H, A, IOPT, PAR, RES, INFO)
      WRITE (*, *) 'loadless', INFO
      CALL FSLAST(IW, TEXT)
      WRITE (*, *) 'words', INDEX(TEXT, 'the load')
      CALL FSMSG(INFO, TEXT)
      WRITE (*, *) 'word', INDEX(TEXT, 'bad_load    ')
      PAR(6) = 1.0D3
      PAR(7) = 1.0D-3
      CALL FSSOLV(IW, IOPT, PAR, RES, INFO)
      WRITE (*, *) 'solved', INFO
      CALL FSSTRP(IW, 400, N, X, X, X, X, K, INFO)
      WRITE (*, *) 'strips', N*1000 + INFO - INT(RES(14))*1000
      CALL FSSTRP(IW, 2, N, X, X, X, X, K, INFO)
      WRITE (*, *) 'few', INFO
      CALL FSELEM(IW, 400, N, X, X, X, X, X, X, X, X, K, INFO)
      WRITE (*, *) 'elements', N - 15*INT(RES(14))
      CALL FSINIT(IOPT, 5, IW2, 8, INFO)
      CALL FSCOPY(IW, IW2, INFO)
      WRITE (*, *) 'copied', INFO
      CALL FSSOLV(IW2, IOPT, PAR, RES, INFO)
      WRITE (*, *) 'again', INFO
      CALL FSERRS(IW, ERR, INFO)
      WRITE (*, *) 'errors', INFO
      WRITE (*, *) 'known', NINT(ERR(6)*1000 + ERR(7) - RES(14))
      WRITE (*, *) 'small', INT(ERR(2)*10)
      CALL FSCOPY(IW, IW2, INFO)
      CALL FSERRS(IW2, ERR2, INFO)
      CALL FSFERR(IW, FERR, INFO)
      WRITE (*, *) 'forces', INFO + NINT(FERR(4))
      WRITE (*, *) 'part', INT(FERR(1)*10) + INT(FERR(3)*10)
      CALL FSFERR(IW2, FERR2, INFO)
      N = 0
      DO 5 I = 1, 4
        IF (FERR(I) .NE. FERR2(I)) N = N + 1
    5 CONTINUE
      WRITE (*, *) 'equal', N
      N = 0
      DO 10 I = 1, 7
        IF (ERR(I) .NE. ERR2(I)) N = N + 1
   10 CONTINUE
      WRITE (*, *) 'differ', N
      Z = 0.0D0
      CALL FSLIMT(IW, 1, Z, INFO)
      WRITE (*, *) 'zero', INFO
      CALL FSLAST(IW, LONG)
      WRITE (*, *) 'limit', INDEX(LONG, 'must be above 0, got 0.00000')
      CALL FSLIMT(IW, 0, -1.0D0, INFO)
      WRITE (*, *) 'below', INFO
      CALL FSLIMT(IW, 0, IEEE, INFO)
      WRITE (*, *) 'nan', INFO
      CALL FSLAST(IW, LONG)
      WRITE (*, *) 'named', INDEX(LONG, 'got NaN')
      CALL FSSOLV(IW, IOPT, PAR, RES, INFO)
      CALL FSERRS(IW, ERR2, INFO)
      WRITE (*, *) 'kept', NINT(ERR2(6))
      CALL FSLIMT(IW, 1, 1.0D-6, INFO)
      WRITE (*, *) 'strict', INFO
      CALL FSSOLV(IW, IOPT, PAR, RES, INFO)
      WRITE (*, *) 'rough', INFO
      CALL FSCOPY(IW, IW2, INFO)
      CALL FSSOLV(IW2, IOPT, PAR, RES, INFO)
      WRITE (*, *) 'alike', INFO
      CALL FSLIMT(IW, 0, 1.0D-6, INFO)
      CALL FSSOLV(IW, IOPT, PAR, RES, INFO)
      WRITE (*, *) 'off', INFO
      CALL FSERRS(IW, ERR, INFO)
      N = 0
      DO 20 I = 1, 6
        IF (ERR(I) .NE. 0.0D0) N = N + 1
   20 CONTINUE
      WRITE (*, *) 'unknown', N
      CALL FSFERR(IW, FERR, INFO)
      N = 0
      DO 30 I = 1, 4
        IF (FERR(I) .NE. 0.0D0) N = N + 1
   30 CONTINUE
      WRITE (*, *) 'silent', N + INFO
      CALL FSGAP(IW2, 5, Y, H, A, INFO)
      CALL FSERRS(IW2, ERR2, INFO)
      WRITE (*, *) 'anew', NINT(ERR2(6) + ERR2(7)) + INFO
      CALL FSFREE(IW2, INFO)
      WRITE (*, *) 'freed', INFO
      CALL FSERRS(IW2, ERR2, INFO)
      WRITE (*, *) 'gone', INFO
      CALL FSFERR(IW2, FERR, INFO)
      WRITE (*, *) 'lost', INFO
      CALL FSLIMT(IW2, 1, 0.1D0, INFO)
      WRITE (*, *) 'went', INFO
      CALL FSFREE(IW2, INFO)
      WRITE (*, *) 'twice', INFO
      CALL FSCOPY(IW, IW2, INFO)
      WRITE (*, *) 'nowhere', INFO
      CALL FSFREE(IW, INFO)
      CALL FSDFLT(IOPT, PAR)
      PAR(6) = 1.0D3
      PAR(7) = 1.0D-3
      CALL FSINIT(IOPT, 6, IW3, 8, INFO)
      IOPT(1) = 6
      CALL FSCONT(IW3, 6, Y, H, A, IOPT, PAR, RES, INFO)
      WRITE (*, *) 'unmeant', INFO
      CALL FSFREE(IW3, INFO)
      CALL FSINIT(IOPT, 6, IW, 8, INFO)
      CALL FSINIT(IOPT, 6, IW2, 8, INFO)
      WRITE (*, *) 'auto', INFO
C     Unlike sides, no ellipse.
      H(4) = 0.2D0
      H(5) = 0.8D0
      H(6) = 1.8D0
      CALL FSWANT(IW, 6, 0.1D0, 0.0D0, INFO)
      WRITE (*, *) 'target', INFO
      CALL FSLAST(IW, LONG)
      WRITE (*, *) 'which', INDEX(LONG, 'must be 1 to 5, got 6')
      CALL FSWANT(IW, 1, -0.1D0, 0.0D0, INFO)
      WRITE (*, *) 'tolerance', INFO
      CALL FSWANT(IW, 1, 0.1D0, IEEE, INFO)
      WRITE (*, *) 'budget', INFO
      CALL FSWANT(IW, 1, 0.0D0, 0.0D0, INFO)
      WRITE (*, *) 'neither', INFO
C     Refused, all is as it was: forces, 0.02.
      CALL FSCONT(IW, 6, Y, H, A, IOPT, PAR, RES, INFO)
      WRITE (*, *) 'wanted', INFO
      CALL FSTAKN(IW, TAKN, INFO)
      CALL FSFERR(IW, FERR, INFO)
      N = 0
      IF (TAKN(3) .NE. MAX(FERR(1), FERR(2), FERR(3))) N = 1
      IF (TAKN(3) .GT. 0.02D0 .OR. TAKN(5) .NE. 1D0) N = N + 2
      WRITE (*, *) 'met', N + INFO
      CALL FSWANT(IW, 2, 1.0D-9, 0.0D0, INFO)
      CALL FSSOLV(IW, IOPT, PAR, RES, INFO)
      WRITE (*, *) 'missed', INFO
      CALL FSTAKN(IW, TAKN, INFO)
      CALL FSERRS(IW, ERR, INFO)
      N = 0
      IF (TAKN(3) .NE. ERR(2) .OR. TAKN(4) .NE. 1D0) N = 1
      IF (TAKN(1) .LT. 2D0 .OR. TAKN(5) .NE. 0D0) N = N + 2
      WRITE (*, *) 'pmax', N + INFO
C     The other workspace takes over the steps and what is wanted.
      CALL FSCOPY(IW, IW2, INFO)
      CALL FSTAKN(IW2, TAKN2, INFO)
      N = 0
      DO 40 I = 1, 5
        IF (TAKN(I) .NE. TAKN2(I)) N = N + 1
   40 CONTINUE
      WRITE (*, *) 'taken', N + INFO
      CALL FSSTEP(IW2, 1, N, K, K(20), K(40), K(60), X, X(20), X(40),
     &  INFO)
      WRITE (*, *) 'steps', INFO + N - NINT(TAKN(1))
      CALL FSSTEP(IW2, 9, N, K, K(20), K(40), K(60), X, X(20), X(40),
     &  INFO)
      I = NINT(TAKN(2))
      WRITE (*, *) 'best', INFO + K(I)*100 + K(I + 19)
      WRITE (*, *) 'across', K(I + 39) - NINT(ERR(7))
      CALL FSSOLV(IW2, IOPT, PAR, RES, INFO)
      WRITE (*, *) 'likewise', INFO
      CALL FSGAP(IW2, 6, Y, H, A, INFO)
      CALL FSTAKN(IW2, TAKN2, INFO)
      WRITE (*, *) 'forgot', NINT(TAKN2(1) + TAKN2(3)) + INFO
      CALL FSFREE(IW2, INFO)
      CALL FSTAKN(IW2, TAKN2, INFO)
      WRITE (*, *) 'lapsed', INFO
      CALL FSWANT(IW2, 1, 0.1D0, 0.0D0, INFO)
      WRITE (*, *) 'ended', INFO
      CALL FSSTEP(IW2, 9, N, K, K, K, K, X, X, X, INFO)
      WRITE (*, *) 'over', INFO + N
      CALL FSFREE(IW, INFO)
      CALL FSTSIM(6D0, 0D0, 8D4, 4D0, 4D0, 2D0, 0D0, 0D0, 0D0, 0.3D0,
     &  1D5, 9, 9, F(1), F(2), F(3), INFO)
      WRITE (*, *) 'flat', INFO
      CALL FSKALK(0D0, 0.3D0, X, INFO)
      WRITE (*, *) 'ratio', INFO
      CALL FSHERZ(PAR, 1D-3, -1D-3, 1D5, X(1), X(2), X(3), X(4), INFO)
      WRITE (*, *) 'saddle', INFO
      END
"""
ANSWERS = {
    "query": 8000, "short": 110, "points": 100, "unmade": 100, "blank": 1, "made": 0,
    "gapless": 110, "negative": 100, "long": 110, "loadless": 105, "words": 1, "word": 1,
    "forces": 1, "part": 0, "equal": 0, "silent": 0, "lost": 100,
    "errors": 0, "known": 1000, "small": 0, "differ": 0, "zero": 100, "limit": 22, "below": 100,
    "nan": 100, "named": 39, "kept": 1, "strict": 0, "rough": 8, "alike": 8, "off": 0, "unknown": 0,
    "unmeant": 110, "auto": 0, "target": 100, "which": 12, "tolerance": 100, "budget": 100,
    "neither": 100, "wanted": 0, "met": 0, "missed": 7, "pmax": 0, "taken": 0, "steps": 110,
    "best": 101, "across": 0, "likewise": 7, "forgot": 0, "lapsed": 100, "ended": 100, "over": 100,
    "anew": 0, "gone": 100, "went": 100,
    "solved": 0, "strips": 0, "few": 110, "elements": 0, "copied": 0, "again": 0, "freed": 0,
    "twice": 100, "nowhere": 100, "flat": 100, "ratio": 109, "saddle": 107,
}


class Errors(HostTest):
    def test_every_subroutine_says_what_is_wrong(self):
        self.write("errors.f", ERRORS)
        self.shell("gfortran -std=legacy -g -ffpe-trap=invalid,zero,overflow errors.f"
                   " $(pkg-config --libs faststrip) -o errors")
        found = self.findings("./errors")
        self.assertEqual({name: value for name, (value,) in found.items()}, ANSWERS)


class Wheelset(HostTest):
    """Run 1 is below the critical speed, run 2 above, run 3 is run 2 in a mirror."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        source = (ROOT / "example" / "legacy" / "wheelset.f").read_text(encoding="utf-8")
        cls.lines, cls.calls = cls.hunt("wheelset", source)
        # The first call of a step is where the wheelset is, the second one where it may get to.
        cls.steps = {run: [row for row in rows if row[1] == 1] for run, rows in cls.calls.items()}

    @classmethod
    def hunt(cls, name, source):
        """Lines a run, and numbers a call of every run: as RATES writes them."""
        cls.write(f"{name}.f", source)
        cls.shell(f"gfortran -std=legacy -Wall -Werror -O2 {name}.f"
                  f" $(pkg-config --libs faststrip) -o {name}")
        lines = [[float(word) for word in line.split()]
                 for line in cls.shell(f"mkdir {name}_out\ncd {name}_out\n../{name}").splitlines()]
        calls = {}
        text = (cls.folder / f"{name}_out" / "wheelset.txt").read_text(encoding="utf-8")
        for line in text.splitlines():
            row = [float(word) for word in line.split()]
            calls.setdefault(int(row[0]), []).append(row)
        return lines, calls

    def peaks(self, run):
        """Largest shift of every half wave but the last, unfinished one."""
        found = [0.0]
        for (_, _, _, _, last, *_), (_, _, _, _, y, *_) in zip(self.steps[run],
                                                               self.steps[run][1:]):
            found[-1] = max(found[-1], abs(last))
            if y * last < 0.0:
                found.append(0.0)
        return found[:-1]

    def test_every_call_is_there(self):
        self.assertEqual([len(self.calls[run]) for run in (1, 2, 3)], [1200, 800, 800])
        for rows in self.calls.values():
            self.assertTrue(all(map(math.isfinite, sum(rows, []))))

    def test_below_the_critical_speed_it_dies_out(self):
        peaks = self.peaks(1)
        self.assertGreater(len(peaks), 5)
        for last, peak in zip(peaks, peaks[1:]):
            self.assertLess(peak, 0.9 * last)

    def test_above_it_grows_to_the_flange_roots(self):
        peaks = self.peaks(2)
        self.assertGreater(len(peaks), 10)
        self.assertGreater(peaks[3], 1.5 * peaks[0])
        for last, peak in zip(peaks[:6], peaks[1:]):
            self.assertGreater(peak, last)
        # A limit cycle, where the clearance ends.
        self.assertAlmostEqual(peaks[-1], peaks[-3], delta=5e-3 * peaks[-1])
        self.assertGreater(peaks[-1], 5.0)
        self.assertLess(peaks[-1], 7.0)

    def test_rolling_radii_are_those_of_s1002_on_60e1(self):
        for y, tangent in ((0.5, 0.189), (1.0, 0.185), (2.0, 0.168), (3.0, 0.153)):
            near = min(self.steps[1], key=lambda row: abs(abs(row[4]) - y))
            self.assertAlmostEqual((near[19] - near[20]) / (2.0 * near[4]), tangent, delta=5e-3)

    def test_the_wave_is_klingel_s(self):
        _, _, wave, formula, first, last = self.lines[0]
        steps = self.steps[1]
        conicity = (sum((row[19] - row[20]) * row[4] for row in steps)
                    / (2.0 * sum(row[4] ** 2 for row in steps)))
        self.assertAlmostEqual(formula, 2.0 * math.pi * math.sqrt(R0 * S / conicity), delta=1e-2)
        # A patch is wide, and has spin: no moment is left at a somewhat smaller difference of the
        # rolling radii than that of the reference points, so the wave is longer, by 2 to 3 %.
        self.assertGreater(wave, formula)
        self.assertLess(wave, 1.04 * formula)
        peaks = self.peaks(1)
        self.assertAlmostEqual(first, peaks[0], delta=1e-4)
        self.assertAlmostEqual(last, peaks[-1], delta=1e-4)

    def test_the_mirror_has_the_same_bits(self):
        for one, other in zip(self.calls[2], self.calls[3]):
            # Right is left; what points to the right changes its sign.
            self.assertEqual(one[1:4], other[1:4])
            self.assertEqual(one[4:9], [-number for number in other[4:9]])
            self.assertEqual(one[9:11], other[9:11][::-1])
            self.assertEqual(one[11:14], [other[14], -other[15], other[16]])
            self.assertEqual(one[17], -other[18])
            self.assertEqual(one[19:], [other[20], other[19], other[21]])
        self.assertEqual(self.lines[1][1:], self.lines[2][1:])

    def test_the_wheels_carry_the_load(self):
        for row in sum(self.calls.values(), []):
            self.assertAlmostEqual(row[9] + row[10], 1.6e5, delta=1e-9)
            self.assertAlmostEqual(row[13], row[9], delta=1e-7 * row[9])
            self.assertAlmostEqual(row[16], row[10], delta=1e-7 * row[10])

    def test_forces_stay_below_friction(self):
        used = [row[21] for row in sum(self.calls.values(), [])]
        self.assertLessEqual(max(used), 0.3 * (1.0 + 1e-12))
        self.assertGreater(max(used), 0.1)

    def test_half_the_step_gives_the_same_waves(self):
        source = (self.folder / "wheelset.f").read_text(encoding="utf-8")
        for old, new in (("DT = 2.5D-3", "DT = 1.25D-3"),
                         ("CALL SIMUL(3, 6.0D4, 6.0D4, -3.0D0, IWORK)", "CONTINUE")):
            self.assertIn(old, source)
            source = source.replace(old, new)
        lines, _ = self.hunt("halved", source)
        for ours, halved in zip(self.lines[:2], lines, strict=True):
            self.assertEqual(ours[:2], halved[:2])
            self.assertAlmostEqual(ours[2], halved[2], delta=2e-3 * halved[2])
            self.assertAlmostEqual(ours[5], halved[5], delta=1e-2 * halved[5])

    def test_the_same_bits_by_the_fortran_api(self):
        self.shell(f"gfortran -O2 '{HOSTS}/replay.f90' $(pkg-config --cflags --libs faststrip)"
                   " -o replay")
        found = self.findings("cd wheelset_out\n../replay")
        self.assertEqual(found, {"rows": [2800], "different": [0]})
