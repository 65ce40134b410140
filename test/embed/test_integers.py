"""Fixed-form hosts whose INTEGER is eight bytes long are told, and refused where it shows."""


from installed import HostTest

# Options as hosts set them: all of their own, or some after FSDFLT.
HOST = """
      PROGRAM HOST
      {kind} IOPT(9), IWORK(16), IONES(2), MINE(9), LENGTH, MOST
      {kind} ICHANG(3), IVALUE(3), I, K, INFO
      DOUBLE PRECISION PAR(9)
      DATA IONES /1, 1/
      DATA MINE /1, 1, 9, 15, 50, 50, 1, 0, 0/
      DATA ICHANG /3, 4, 5/
      DATA IVALUE /9, 21, 30/
      DATA LENGTH, MOST /8, 301/
      INFO = -1
      CALL FSINTS(IONES, INFO)
      WRITE (*, '(A, 1X, I0)') 'told', INFO
      INFO = 0
      CALL FSINIT(MINE, MOST, IWORK, LENGTH, INFO)
      WRITE (*, '(A, 1X, I0)') 'own', INFO
      IF (INFO .EQ. 0) CALL FSFREE(IWORK, INFO)
      DO 20 K = 1, 3
        DO 10 I = 1, 9
          IOPT(I) = 0
   10   CONTINUE
        CALL FSDFLT(IOPT, PAR)
        IOPT(ICHANG(K)) = IVALUE(K)
        CALL FSINIT(IOPT, MOST, IWORK, LENGTH, INFO)
        WRITE (*, '(A, 1X, I0)') 'changed', INFO
        IF (INFO .EQ. 0) CALL FSFREE(IWORK, INFO)
   20 CONTINUE
      END
"""
WHEELSET = """
      PROGRAM HOST
      INTEGER IOPT(9), NPROF(4), IWORK(16), IDMND(4), N, INFO
      DOUBLE PRECISION PAR(9), SETUP(9), S(11), DMND(4), CONT(48, 16)
      DOUBLE PRECISION WRES(27), NONE(1)
      DATA NPROF /-1, 0, -2, 0/
      DATA IDMND /1, {wheels}, 0, 0/
      DATA S /11*0.0D0/
      DATA DMND /6.0D4, 6.0D4, 0.0D0, 0.0D0/
      CALL FSDFLT(IOPT, PAR)
      CALL FSWDFT(SETUP)
      INFO = 0
      CALL FSWNEW(IOPT, PAR, SETUP, NPROF, NONE, NONE, IWORK, 8, INFO)
      WRITE (*, '(A, 1X, I0)') 'made', INFO
      IF (INFO .NE. 0) STOP
      CALL FSWSLV(IWORK, S, IDMND, DMND, 16, N, CONT, WRES, INFO)
      WRITE (*, '(A, 2(1X, I0))') 'solved', INFO, N
      IDMND(4) = 15
      CALL FSWSLV(IWORK, S, IDMND, DMND, 16, N, CONT, WRES, INFO)
      WRITE (*, '(A, 2(1X, I0))') 'asked', INFO, N
      CALL FSWFRE(IWORK, INFO)
      END
"""


class Integers(HostTest):
    def ran(self, text, flags=""):
        self.write("host.f", text)
        self.shell(f"gfortran -std=legacy -O1 {flags} host.f -o host"
                   " $(pkg-config --libs faststrip)")
        return self.shell("./host").split("\n")[:-1]

    def test_of_four_bytes_all_is_well(self):
        wanted = ["told 0", "own 0", *["changed 0"] * 3]
        self.assertEqual(self.ran(HOST.format(kind="INTEGER")), wanted)
        # Also where only what the library sees is four bytes long.
        self.assertEqual(self.ran(HOST.format(kind="INTEGER*4"), "-fdefault-integer-8"), wanted)

    def test_of_eight_bytes_they_are_told_and_refused(self):
        self.assertEqual(self.ran(HOST.format(kind="INTEGER"), "-fdefault-integer-8"),
                         ["told 100", "own 100", *["changed 100"] * 3])

    def test_wheelsets_ask_for_them_too(self):
        text = WHEELSET.format(wheels=0)
        self.assertEqual(self.ran(text), ["made 0", "solved 0 2", "asked 100 0"])
        self.assertEqual(self.ran(text, "-fdefault-integer-8"), ["made 100"])
