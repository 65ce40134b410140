"""The lookup table of a wheel gives the same contacts and forces in every interface."""

import math
import struct
import subprocess
import zlib

import numpy as np

from installed import HostTest, number
from test_allocation import COUNTER

CASE = ("&wheel\n profile = 's1002'\n/\n&rail\n profile = '60e1'\n/\n&material\n mu = 0.3\n/\n")
PLACES, STATES = 6, 40
SHOW = r"""
#include <inttypes.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
static void show(int n, const double *numbers)
{
    uint64_t bits;
    for (int i = 0; i < n; i++) {
        memcpy(&bits, &numbers[i], sizeof bits);
        printf("%s%016" PRIX64, i > 0 ? " " : "", bits);
    }
    printf("\n");
}
static faststrip_lookup *opened(const char *path)
{
    static char bytes[40000000];
    faststrip_lookup *table = NULL;
    FILE *file = fopen(path, "rb");
    size_t length = fread(bytes, 1, sizeof bytes, file);
    if (faststrip_lookup_open(bytes, length, &table, NULL, 0) != 0) exit(1);
    return table;
}
enum { PLACES = 6, STATES = 40 };
static double places[PLACES][3], contacts[PLACES][14], slopes[PLACES][42];
static double states[STATES][7], forces[STATES][3], jacobians[STATES][21], about[60];
static int slots[STATES], codes[STATES];
static void fill(void)
{
    for (int i = 0; i < PLACES; i++) {
        places[i][0] = -2.0 + 0.7 * i; places[i][1] = 0.0; places[i][2] = 5e4 + 1e4 * (i % 3);
    }
    for (int i = 0; i < STATES; i++) {
        double state[7] = {-1.9 + 0.05 * i, 0.0, 6e4 + 1e3 * (i % 11), 0.1 + 0.01 * i,
                           1e-4 * (i - 20), 1e-4 * (i % 7 - 3), 1e-5 * (i % 5 - 2)};
        for (int k = 0; k < 7; k++) states[i][k] = state[k];
        slots[i] = 1;
    }
    slots[3] = 9;
    states[4][0] = 77.0;
}
"""
WHEELSET = r"""
static faststrip_wheelset_contact contact[FASTSTRIP_MOST_CONTACTS];
static faststrip_wheelset_result result;
static faststrip_wheelset *made(void)
{
    faststrip_wheelset_setup setup;
    faststrip_case settings;
    faststrip_profile wheels[2] = {{.name = "s1002"}}, rails[2] = {{.name = "60e1"}};
    faststrip_wheelset *wheelset = NULL;
    faststrip_default_wheelset(&setup, sizeof setup);
    setup.inclination = 0.025;
    faststrip_default_case(&settings, sizeof settings);
    settings.estimate = 0;
    if (faststrip_wheelset_new(&setup, wheels, rails, &settings, &wheelset, NULL, 0) != 0) exit(1);
    return wheelset;
}
static int solve_at(faststrip_wheelset *wheelset, double y)
{
    faststrip_wheelset_state state = {.y = y, .speed = 2e4};
    faststrip_wheelset_demand demand = {.kind = FASTSTRIP_BY_LOADS, .load_right = 8e4,
                                        .load_left = 8e4};
    int n;
    return faststrip_wheelset_solve(wheelset, &state, &demand, FASTSTRIP_MOST_CONTACTS, &n, contact,
                                    &result);
}
static void solve(faststrip_wheelset *wheelset, double y)
{
    double found[14];
    if (solve_at(wheelset, y) != 0) exit(8);
    printf("%d %d\n", result.n_solutions[0], result.n_solutions[1]);
    memcpy(found, result.z, sizeof result.z);
    memcpy(found + 2, result.force, sizeof result.force);
    memcpy(found + 8, result.moment, sizeof result.moment);
    show(14, found);
}
"""
BY_C = "#include <faststrip.h>\n" + SHOW + WHEELSET + r"""
int main(void)
{
    faststrip_lookup *table = opened("wheel.fslt");
    if (faststrip_lookup_wheel_about(table, about) != 0) return 2;
    show(60, about);
    if (faststrip_lookup_wheel_z_errors(table, about) != 0) return 6;
    show(12, about);
    fill();
    for (int order = 1; order <= 3; order += 2) {
        printf("%d\n", faststrip_lookup_wheel_contacts(table, (enum faststrip_lookup_order)order,
                                                       PLACES, places[0], contacts[0], slopes[0],
                                                       codes));
        for (int i = 0; i < PLACES; i++) { show(14, contacts[i]); show(42, slopes[i]); }
        printf("%d\n", faststrip_lookup_wheel_forces(table, (enum faststrip_lookup_order)order,
                                                     STATES, slots, states[0], forces[0],
                                                     jacobians[0], codes));
        for (int i = 0; i < STATES; i++) {
            printf("%d\n", codes[i]); show(3, forces[i]); show(21, jacobians[i]);
        }
    }
    if (faststrip_lookup_about(table, about) != FASTSTRIP_BAD_ARGUMENT) return 3;
    if (faststrip_lookup_forces(table, FASTSTRIP_LINEAR, 1, states[0], forces[0], NULL, NULL)
        != FASTSTRIP_BAD_ARGUMENT) return 4;
    if (faststrip_lookup_wheel_forces(table, FASTSTRIP_LINEAR, 1, NULL, states[0], forces[0], NULL,
                                      NULL) != FASTSTRIP_BAD_ARGUMENT) return 5;
    faststrip_wheelset *wheelset = made();
    if (faststrip_wheelset_use_lookup(wheelset, table, FASTSTRIP_LINEAR) != 0) return 7;
    solve(wheelset, 0.7);
    solve(wheelset, 5.0);
    faststrip_lookup_free(&table);
    printf("%d\n", solve_at(wheelset, 0.7));
    return faststrip_wheelset_free(&wheelset);
}
"""
ALLOCATIONS = "#include <faststrip.h>\n" + SHOW + WHEELSET + r"""
int main(void)
{
    faststrip_lookup *table = opened("wheel.fslt");
    fill();
    slots[3] = 1;
    states[4][0] = 0.0;
    for (int order = 1; order <= 3; order += 2) {
        long before = allocations();
        int status = faststrip_lookup_wheel_contacts(table, (enum faststrip_lookup_order)order,
                                                     PLACES, places[0], contacts[0], slopes[0],
                                                     NULL);
        status |= faststrip_lookup_wheel_forces(table, (enum faststrip_lookup_order)order, STATES,
                                                slots, states[0], forces[0], jacobians[0], NULL);
        before = allocations() - before;
        printf("%d %ld\n", status, before);
    }
    faststrip_wheelset *wheelset = made();
    int used = faststrip_wheelset_use_lookup(wheelset, table, FASTSTRIP_CUBIC);
    long before = allocations();
    used |= solve_at(wheelset, 0.7) | solve_at(wheelset, 5.0);
    printf("%d %ld\n", used, allocations() - before);
    faststrip_wheelset_free(&wheelset);
    return faststrip_lookup_free(&table);
}
"""
BY_F77 = r"""
      PROGRAM WHEEL
      INTEGER MBYTES, NP, NS
      PARAMETER (MBYTES = 40000000, NP = 6, NS = 40)
      CHARACTER*1 BYTES(MBYTES)
      INTEGER IWORK(8), ISTAT(NS), ISLOT(NS), I, J, K, N, IORDER, INFO
      DOUBLE PRECISION PLACE(3, NP), CONTAC(14, 1, NP), DCON(14, 1, 3, NP), STATE(7, NS)
      DOUBLE PRECISION FORCE(3, NS), DJAC(3, 7, NS), ABOUT(60)
      INTEGER IOPT(9), NPROF(4), IWHEEL(8), IDMND(4), NCONT
      DOUBLE PRECISION PAR(9), SETUP(9), NONE(1), POS(11), DMND(4), CONT(48, 20), WRES(27)
      OPEN (10, FILE='wheel.fslt', ACCESS='DIRECT', RECL=1, FORM='UNFORMATTED', STATUS='OLD')
      N = 0
   10 CONTINUE
      READ (10, REC=N + 1, ERR=20) BYTES(N + 1)
      N = N + 1
      GO TO 10
   20 CONTINUE
      CLOSE (10)
      CALL FSLOPN(N, BYTES, IWORK, 8, INFO)
      IF (INFO .NE. 0) STOP 1
      CALL FSLWIN(IWORK, ABOUT, INFO)
      IF (INFO .NE. 0) STOP 2
      WRITE (*, 100) ABOUT
      CALL FSLWZE(IWORK, ABOUT, INFO)
      IF (INFO .NE. 0) STOP 6
      WRITE (*, 100) (ABOUT(I), I = 1, 12)
      DO 30 I = 1, NP
        PLACE(1, I) = -2.0D0 + 0.7D0*(I - 1)
        PLACE(2, I) = 0.0D0
        PLACE(3, I) = 5.0D4 + 1.0D4*MOD(I - 1, 3)
   30 CONTINUE
      DO 40 I = 1, NS
        STATE(1, I) = -1.9D0 + 0.05D0*(I - 1)
        STATE(2, I) = 0.0D0
        STATE(3, I) = 6.0D4 + 1.0D3*MOD(I - 1, 11)
        STATE(4, I) = 0.1D0 + 0.01D0*(I - 1)
        STATE(5, I) = 1.0D-4*(I - 21)
        STATE(6, I) = 1.0D-4*(MOD(I - 1, 7) - 3)
        STATE(7, I) = 1.0D-5*(MOD(I - 1, 5) - 2)
        ISLOT(I) = 1
   40 CONTINUE
      ISLOT(4) = 9
      STATE(1, 5) = 77.0D0
      DO 70 IORDER = 1, 3, 2
        CALL FSLCON(IWORK, IORDER, NP, 1, PLACE, CONTAC, DCON, ISTAT, INFO)
        WRITE (*, '(I0)') INFO
        DO 50 I = 1, NP
          WRITE (*, 100) (CONTAC(J, 1, I), J = 1, 14)
          WRITE (*, 100) ((DCON(J, 1, K, I), J = 1, 14), K = 1, 3)
   50   CONTINUE
        CALL FSLWHL(IWORK, IORDER, NS, ISLOT, STATE, FORCE, DJAC, ISTAT, INFO)
        WRITE (*, '(I0)') INFO
        DO 60 I = 1, NS
          WRITE (*, '(I0)') ISTAT(I)
          WRITE (*, 100) (FORCE(J, I), J = 1, 3)
          WRITE (*, 100) ((DJAC(J, K, I), J = 1, 3), K = 1, 7)
   60   CONTINUE
   70 CONTINUE
      CALL FSLINF(IWORK, ABOUT, INFO)
      IF (INFO .NE. 100) STOP 3
      CALL FSDFLT(IOPT, PAR)
      CALL FSWDFT(SETUP)
      SETUP(8) = 0.025D0
      NPROF(1) = -1
      NPROF(2) = 0
      NPROF(3) = -2
      NPROF(4) = 0
      NONE(1) = 0.0D0
      CALL FSWNEW(IOPT, PAR, SETUP, NPROF, NONE, NONE, IWHEEL, 8, INFO)
      IF (INFO .NE. 0) STOP 7
      CALL FSWLKP(IWHEEL, IWORK, 1, INFO)
      IF (INFO .NE. 0) STOP 8
      DO 80 I = 1, 11
        POS(I) = 0.0D0
   80 CONTINUE
      POS(5) = 2.0D4
      IDMND(1) = 1
      IDMND(2) = 0
      IDMND(3) = 0
      IDMND(4) = 0
      DMND(1) = 8.0D4
      DMND(2) = 8.0D4
      DMND(3) = 0.0D0
      DMND(4) = 0.0D0
      DO 90 I = 1, 2
        POS(1) = 0.7D0
        IF (I .EQ. 2) POS(1) = 5.0D0
        CALL FSWSLV(IWHEEL, POS, IDMND, DMND, 20, NCONT, CONT, WRES, INFO)
        IF (INFO .NE. 0) STOP 9
        WRITE (*, '(I0, 1X, I0)') NINT(WRES(26)), NINT(WRES(27))
        WRITE (*, 100) WRES(1), WRES(2), (WRES(J), J = 4, 9), (WRES(J), J = 16, 21)
   90 CONTINUE
      CALL FSLFRE(IWORK, INFO)
      IF (INFO .NE. 0) STOP 4
      POS(1) = 0.7D0
      CALL FSWSLV(IWHEEL, POS, IDMND, DMND, 20, NCONT, CONT, WRES, INFO)
      WRITE (*, '(I0)') INFO
      CALL FSWFRE(IWHEEL, INFO)
  100 FORMAT (60(Z16.16, :, 1X))
      END
"""


def numbers(line):
    return list(map(number, line.split()))


def without_z_errors(content):
    """A file as it was before z was in the promise."""
    head = list(struct.unpack_from("<12i", content, 8))
    numbers_about = np.frombuffer(content, "<f8", head[6], 56)
    errors = numbers_about[5:].reshape(2, 2, 3, 5)[..., :4]
    behind = content[56 + 8 * head[6]:-4]
    head[6] = 5 + errors.size
    older = content[:8] + struct.pack("<12i", *head) + numbers_about[:5].tobytes() \
        + errors.tobytes() + behind
    return older + struct.pack("<I", zlib.crc32(older))


class WheelFaces(HostTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.package = cls.import_package()
        (cls.folder / "case.nml").write_text(CASE, encoding="utf-8")
        cls.table = cls.make_table("wheel.fslt", "--error", "0.03", "--y", "-2:2", "--tests", "299")
        (cls.folder / "by_c.c").write_text(BY_C, encoding="utf-8")
        cls.shell("gcc -Wall -O1 by_c.c $(pkg-config --cflags --libs faststrip) -o by_c")
        cls.lines = cls.shell("./by_c").splitlines()

    @classmethod
    def make_table(cls, name, *options):
        subprocess.run([str(cls.installed.prefix / "bin" / "faststrip"), "lookup", "wheel",
                        "case.nml", "-o", name, *options], cwd=cls.folder, check=True,
                       stdin=subprocess.DEVNULL)
        return cls.package.WheelLookup(cls.folder / name)

    def test_fixed_form_fortran_has_the_bits_of_c(self):
        self.write("by_f77.f", BY_F77)
        self.shell("gfortran -std=legacy -ffixed-line-length-100 -O1 by_f77.f"
                   " $(pkg-config --libs faststrip) -o by_f77")
        self.assertEqual(self.shell("./by_f77").splitlines(), self.lines)
        self.assertEqual((self.lines.count("100"), self.lines.count("109")), (2 + 2 + 1, 2))

    def test_python_has_them(self):
        about = numbers(self.lines[0])
        table = self.table
        self.assertEqual([table.nu, table.g, table.promised, *table.tested, table.slots, *table.y,
                          *table.yaw, *table.load], about[:12])
        self.assertEqual(table.errors[..., :4].ravel().tolist(), about[12:])
        self.assertEqual(table.errors[..., 4].ravel().tolist(), numbers(self.lines[1]))
        at = 2
        i, k = np.arange(PLACES), np.arange(STATES)
        slot, y = np.ones(STATES, dtype=int), -1.9 + 0.05 * k
        slot[3], y[4] = 9, 77.0
        creepage = 1e-4 * (k - 20), 1e-4 * (k % 7 - 3), 1e-5 * (k % 5 - 2)
        for order in ("linear", "cubic"):
            there = table.contacts(-2.0 + 0.7 * i, 0.0, 5e4 + 1e4 * (i % 3), order=order,
                                   slopes=True)
            self.assertEqual(there.slopes.shape, (PLACES, 1, 14, 3))
            for place in range(PLACES):
                self.assertEqual(there.numbers[place, 0].tolist(), numbers(self.lines[at + 1]))
                self.assertEqual(there.slopes[place, 0].T.ravel().tolist(),
                                 numbers(self.lines[at + 2]))
                at += 2
            at += 2
            found = table(slot, y, 0.0, 6e4 + 1e3 * (k % 11), 0.1 + 0.01 * k, creepage,
                          order=order, jacobian=True)
            for state in k:
                self.assertEqual(found.status[state], int(self.lines[at]))
                if found.status[state] == 0:
                    self.assertEqual(found.forces[state].tolist(), numbers(self.lines[at + 1]))
                    self.assertEqual(found.jacobian[state].T.ravel().tolist(),
                                     numbers(self.lines[at + 2]))
                else:
                    self.assertTrue(np.isnan(found.forces[state]).all())
                at += 3
        wheelset = self.package.Wheelset(estimate=False)
        wheelset.use_lookup(table, order="linear")
        for y in (0.7, 5.0):
            solved = wheelset.solve(y=y, speed=2e4, load=8e4, roll=0.0)
            self.assertEqual([*solved.z, *solved.force.ravel(), *solved.moment.ravel()],
                             numbers(self.lines[at + 1]))
            self.assertEqual(list(solved.n_solutions), list(map(int, self.lines[at].split())))
            at += 2
        self.assertEqual(self.lines[at:], ["100"])

    def test_a_wheelset_by_its_table_is_that_by_strips(self):
        package, table = self.package, self.table
        strips, wheelset = (package.Wheelset(estimate=False) for _ in range(2))
        wheelset.use_lookup(table)
        moved = package.RailState(y=0.3, z=0.4), package.RailState(y=0.3, z=0.4)
        for i in range(12):
            # Between the nodes; forwards, backwards, on rails that lie elsewhere.
            state = {"y": -1.9 + 0.317 * i, "y_rate": 60.0 - 11.0 * i, "yaw_rate": 0.02 - 0.003 * i,
                     "speed": 2e4 if i % 3 else -2e4, "roll": 0.0}
            if i % 4 == 3:
                state |= {"right_rail": moved[0], "left_rail": moved[1]}
            load = 5e4 + 5.3e3 * i, 11e4 - 4.9e3 * i
            there, here = (of.solve(load=load, **state) for of in (strips, wheelset))
            self.assertEqual(here.n_solutions, (0, 0))
            self.assertTrue(min(there.n_solutions) > 0)
            slip = 0.3 * np.array(load)[:, None]
            self.assertLess((abs(here.force - there.force) / slip).max(), table.promised)
            np.testing.assert_allclose(here.force[:, 2], load, rtol=1e-8)
            # z by the load that it makes; moments by the lever of a wheel.
            self.assertLess(abs(np.array(here.z) - there.z).max(), table.promised * 0.06)
            self.assertLess(abs(here.moment - there.moment).max(),
                            table.promised * slip.max() * 760.0)
            self.assertEqual([c.side for c in here.contacts], [c.side for c in there.contacts])
            for one, other in zip(here.contacts, there.contacts):
                self.assertAlmostEqual(one.contact_angle, other.contact_angle, delta=2e-3)
                self.assertAlmostEqual(one.load, other.load, delta=0.01 * other.load)
                # At the place of contact, not where the overlap is deepest.
                self.assertAlmostEqual(one.penetration, other.penetration,
                                       delta=0.2 * other.penetration)
                self.assertAlmostEqual(one.pmax, other.pmax, delta=0.1 * other.pmax)
                self.assertAlmostEqual(one.friction_power, other.friction_power,
                                       delta=table.promised * 0.3 * other.load * 1e-2)
            # From z to the load.
            place = {**state, "z": float(there.z[0]), "wheels": "right"}
            there, here = (of.solve(**place) for of in (strips, wheelset))
            self.assertEqual(here.n_solutions, (0, 0))
            self.assertAlmostEqual(here.force[0, 2] / there.force[0, 2], 1.0, delta=table.promised)

    def test_derivatives_are_those_of_the_table(self):
        strips, wheelset = (self.package.Wheelset(estimate=False) for _ in range(2))
        wheelset.use_lookup(self.table)
        # Steps of y, z, roll, yaw and their rates: a table of one yaw has neighbours beside it.
        steps = np.array([1e-5, 1e-6, 1e-8, 2e-8, 1e-2, 1e-2, 1e-5, 1e-5, 1e-5])
        names = ["y", "z", "roll", "yaw", "y_rate", "z_rate", "roll_rate", "yaw_rate",
                 "pitch_rate"]
        place = wheelset.solve(y=0.413, axle_load=1.5e5, speed=2e4)
        for speed, rate in ((2e4, 30.0), (-2e4, -17.0)):
            state = {"y": 0.413, "z": float(place.z[0]), "roll": float(place.roll), "yaw": 0.0,
                     "speed": speed, "y_rate": rate, "z_rate": 0.0, "roll_rate": 0.0,
                     "yaw_rate": 0.01, "pitch_rate": -speed / 460.0}
            found = wheelset.solve(**state, derivatives=True)
            self.assertEqual(found.n_solutions, (0, 0))
            alike = strips.solve(**state, derivatives=True).derivatives
            for k, name in enumerate(names):
                there, here = (np.hstack([of.force, of.moment]) for of in (
                    wheelset.solve(**state | {name: state[name] + steps[k]}),
                    wheelset.solve(**state | {name: state[name] - steps[k]})))
                slope = (there - here) / (2 * steps[k])
                scale = abs(slope[:, :3]).max(), abs(slope[:, 3:]).max()
                for part, size in zip((slice(0, 3), slice(3, 6)), scale):
                    np.testing.assert_allclose(found.derivatives[:, part, k], slope[:, part],
                                               atol=5e-5 * size, err_msg=name)
                    # The table's own slopes are near those of strips.
                    np.testing.assert_allclose(found.derivatives[:, part, k], alike[:, part, k],
                                               atol=0.15 * size, err_msg=name)

    def test_strips_take_over_without_a_jump(self):
        strips, wheelset = (self.package.Wheelset(estimate=False) for _ in range(2))
        wheelset.use_lookup(self.table)
        moving = {"speed": 2e4, "y_rate": 20.0, "wheels": "right", "roll": 0.0}

        def height(**state):
            return float(strips.solve(**{**moving, **state}).z[0])

        steps = np.arange(-15, 3) * 1e-3
        walks = [[{"y": way * (2.0 + k), "load": 8e4} for k in 6 * steps] for way in (1, -1)]
        walks += [[{"y": way * (2.0 + k), "z": height(y=way * (2.0 + k), load=8e4)}
                   for k in 6 * steps] for way in (1, -1)]
        for load, way in ((1.2e5, 1), (4e4, -1)):
            last = height(y=0.4, load=load)
            walks.append([{"y": 0.4, "z": last + way * k} for k in steps])
            walks.append([{"y": 0.4, "load": load * (1.0 + way * k)} for k in 16 * steps])
        for way in (1, -1):
            rolls = [way * (5e-4 + k / 750.0) for k in 6 * steps]
            walks.append([{"y": 0.4, "load": 8e4, "roll": roll} for roll in rolls])
            first = height(y=0.4, load=8e4)
            walks.append([{"y": 0.4, "z": first - 750.0 * roll, "roll": roll} for roll in rolls])
            # The table has one yaw.
            walks.append([{"y": 0.4, "load": 8e4, "yaw": way * (1e-4 + k / 150.0)} for k in steps])
        jumps = 0
        for walk in walks:
            # What the table adds, step by step.
            added, alone = [], []
            for here in walk:
                found, wanted = (one.solve(**moving | here) for one in (wheelset, strips))
                total = np.sum([c.force for c in found.contacts], 0)
                np.testing.assert_allclose(total, found.force[0], rtol=1e-12)
                added.append([*(found.force - wanted.force)[0], 1e6 * (found.z[0] - wanted.z[0])])
                alone.append(found.n_solutions[0] == 0)
            added = abs(np.array(added))
            self.assertTrue(alone[0] and not any(alone[-2:]))
            self.assertEqual(added[-2:].max(), 0.0, walk[-1])
            changes = abs(np.diff(added, axis=0)).max(0)
            # Steps of 6 um along y and of the rim, 1 um of z.
            self.assertLess(changes[:3].max(), 100.0, walk[-1])
            self.assertLess(changes[:3].max(), 0.25 * added[:, :3].max() + 1.0, walk[-1])
            self.assertLess(changes[3], 60.0)
            jumps += added[:, :3].max() > 100.0
        self.assertGreater(jumps, 4)

    def test_strips_take_over_at_loads_that_friction_moves(self):
        # Under yaw normal forces differ from the load: a table ends at another load than its own.
        strips, wheelset = (self.package.Wheelset(estimate=False) for _ in range(2))
        wheelset.use_lookup(self.make_table("yawed.fslt", "--error", "0.2", "--y", "-1.5:1.5",
                                            "--yaw", "-0.004:0.004", "--load", "6e4:1e5",
                                            "--tests", "299"))
        beyond = 0
        for end, way in ((1e5, 1.0), (6e4, -1.0)):
            for yaw in (-0.003, 0.003):
                added = []
                for load in end * (1.0 + way * np.arange(-40, 41) * 1e-3):
                    here = {"y": -1.0, "yaw": yaw, "speed": 2e4, "load": load, "roll": 0.0,
                            "wheels": "right"}
                    found, wanted = (of.solve(**here).force[0] for of in (wheelset, strips))
                    added.append(abs(found - wanted).max())
                    beyond += way * load > way * end and added[-1] > 50.0
                self.assertEqual(added[-1], 0.0)
                self.assertGreater(max(added), 100.0)
                self.assertLess(abs(np.diff(added)).max(), 0.1 * max(added))
        self.assertGreater(beyond, 5)

    def test_derivatives_where_strips_take_over(self):
        wheelset = self.package.Wheelset(estimate=False)
        wheelset.use_lookup(self.table)
        steps = np.array([1e-5, 1e-5, 1e-8, 2e-8, 1e-2, 1e-2, 1e-5, 1e-5, 1e-5])
        names = ["y", "z", "roll", "yaw", "y_rate", "z_rate", "roll_rate", "yaw_rate",
                 "pitch_rate"]
        for y, roll in ((1.951, 0.0), (0.413, 4.5e-4)):
            place = wheelset.solve(y=y, load=8e4, speed=2e4, roll=roll)
            state = {"y": y, "z": float(place.z[0]), "roll": roll, "yaw": 0.0, "speed": 2e4,
                     "y_rate": 30.0, "z_rate": 0.0, "roll_rate": 0.0, "yaw_rate": 0.01,
                     "pitch_rate": -2e4 / 460.0, "wheels": "right"}
            found = wheelset.solve(**state, derivatives=True)
            self.assertGreater(found.n_solutions[0], 0)
            for k, name in enumerate(names):
                there, here = (np.hstack([of.force[0], of.moment[0]]) for of in (
                    wheelset.solve(**state | {name: state[name] + steps[k]}),
                    wheelset.solve(**state | {name: state[name] - steps[k]})))
                slope = (there - here) / (2 * steps[k])
                for part in (slice(0, 3), slice(3, 6)):
                    np.testing.assert_allclose(found.derivatives[0, part, k], slope[part],
                                               atol=2e-3 * abs(slope[part]).max(), err_msg=name)

    def test_derivatives_are_of_one_side_where_strips_begin(self):
        wheelset = self.package.Wheelset(estimate=False)
        wheelset.use_lookup(self.table)
        inside, there = (wheelset.solve(y=y, load=8e4, speed=2e4, roll=0.0, derivatives=True)
                         for y in (0.9, 2.0))
        self.assertEqual((inside.n_solutions[0], there.n_solutions[0] > 0), (0, True))
        self.assertFalse(np.isnan(there.derivatives).any())

    def test_roll_moves_a_wheel_as_strips_have_it(self):
        strips, wheelset = (self.package.Wheelset(estimate=False) for _ in range(2))
        wheelset.use_lookup(self.table)
        for y in (-1.37, 0.41, 1.83):
            there, here = (of.solve(y=y, speed=2e4, load=8e4) for of in (strips, wheelset))
            self.assertEqual(here.n_solutions, (0, 0))
            self.assertGreater(abs(there.roll), 1e-5)
            self.assertAlmostEqual(here.roll, there.roll, delta=2e-7)
            self.assertLess(abs(here.force - there.force).max(), 0.03 * 0.3 * 8e4)
            self.assertAlmostEqual(here.z[0], there.z[0], delta=1e-3)
        rolled = self.package.RailState(roll=3e-4)
        there, here = (of.solve(y=0.4, speed=2e4, load=8e4, roll=3e-4, right_rail=rolled,
                                left_rail=rolled) for of in (strips, wheelset))
        self.assertLess(abs(np.array(here.z) - there.z).max(), 1e-3)
        self.assertAlmostEqual(here.contacts[0].contact_angle, there.contacts[0].contact_angle,
                               delta=5e-4)
        # More roll over a rail than the promise bears is left to strips; not with the rail.
        for roll, lies, by_strips in ((2e-3, 0.0, True), (6e-4, 0.0, True), (3.9e-4, 0.0, False),
                                      (2e-3, 2e-3, False), (-2e-3, -1.3e-3, True)):
            rail = self.package.RailState(roll=lies)
            state = {"y": 0.4, "speed": 2e4, "load": 8e4, "roll": roll, "right_rail": rail,
                     "left_rail": rail}
            here = wheelset.solve(**state)
            self.assertEqual(min(here.n_solutions) > 0, by_strips, (roll, lies))
            if by_strips:
                self.assertEqual(here.force.tolist(), strips.solve(**state).force.tolist())

    def test_beyond_the_table_strips_answer(self):
        strips, wheelset = (self.package.Wheelset() for _ in range(2))
        wheelset.use_lookup(self.table)
        for state in ({"y": 2.3, "load": 8e4}, {"y": 0.5, "load": 1.5e5}, {"y": 0.5, "load": 3e4},
                      {"y": 0.5, "yaw": 1e-3, "load": 8e4}, {"y": -2.5, "z": 0.2},
                      {"y": 0.0, "z": -3.0}):
            here, there = (of.solve(speed=2e4, roll=0.0, **state) for of in (wheelset, strips))
            for name in ("force", "moment", "z", "n_solutions"):
                np.testing.assert_array_equal(getattr(here, name), getattr(there, name))
        mixed = wheelset.solve(y=0.5, speed=2e4, roll=0.0, load=(8e4, 3e4))
        self.assertEqual(mixed.n_solutions[0], 0)
        self.assertGreater(mixed.n_solutions[1], 0)
        self.assertIsNone(mixed.contacts[0].est_err_fx)
        self.assertIsNotNone(mixed.contacts[1].est_err_fx)
        wheelset.use_lookup(None)
        here, there = (of.solve(y=0.5, speed=2e4, axle_load=16e4) for of in (wheelset, strips))
        np.testing.assert_array_equal(here.force, there.force)

    def test_a_table_that_is_not_its_own_is_refused(self):
        package, table = self.package, self.table
        content = bytearray((self.folder / "wheel.fslt").read_bytes())
        older = package.WheelLookup(without_z_errors(bytes(content)))
        self.assertTrue(np.isnan(older.errors[..., 4]).all())
        np.testing.assert_array_equal(older.errors[..., :4], table.errors[..., :4])
        good = package.Wheelset()
        good.use_lookup(table)
        solved = package.Wheelset()
        solved.use_lookup(table)
        solved.solve(y=0.3, load=8e4, speed=2e4, roll=0.0)
        self.all_refused(
            ("of another wheel or rail: at y",
             lambda: package.Wheelset("cone20").use_lookup(table)),
            ("of another wheel or rail: at y",
             lambda: package.Wheelset(inclination=0.05).use_lookup(table)),
            ("that are alike", lambda: package.Wheelset(radius_left=459.9).use_lookup(table)),
            ("of other materials: G 82000", lambda: package.Wheelset(
                material=package.Material(e_wheel=2e5)).use_lookup(table)),
            ("needs strips", lambda: package.Wheelset(normal="auto").use_lookup(table)),
            ("curved surface", lambda: package.Wheelset(curved=True).use_lookup(table)),
            ("of an older version", lambda: good.use_lookup(older)),
            ("order must be linear or cubic", lambda: good.use_lookup(table, order="square")),
            ("a WheelLookup or None", lambda: good.use_lookup(1)),
            ("no strips, elements or wear", lambda: solved.strips(0)))

    def test_looking_up_allocates_nothing(self):
        self.write("counted.c", COUNTER + ALLOCATIONS)
        self.shell("gcc -O1 counted.c $(pkg-config --cflags --libs faststrip) -o counted")
        self.assertEqual(self.shell("./counted"), "0 0\n0 0\n0 0\n")

    def test_what_is_none_is_refused(self):
        package, table, creepage = self.package, self.table, (1e-3, 0.0, 0.0)
        content = (self.folder / "wheel.fslt").read_bytes()
        self.all_refused(
            ("WheelLookup", lambda: package.Lookup(self.folder / "wheel.fslt")),
            ("a lookup table must have as many bytes", lambda: package.WheelLookup(content[:-1])),
            ("out_of_range: no place of 1", lambda: table.contacts(77.0, 0.0, 8e4)),
            ("bad_argument: no state of 1", lambda: table(9, 0.0, 0.0, 8e4, 0.3, creepage)),
            ("order", lambda: table.contacts(0.0, 0.0, 8e4, order="square")),
            ("creepage", lambda: table(1, 0.0, 0.0, 8e4, 0.3, 1e-3)),
            *(("slot must be whole numbers",
               lambda slot=slot: table(slot, 0.0, 0.0, 8e4, 0.3, creepage))
              for slot in (1.5, math.nan, 1e12)))
