C     A free wheelset with coned wheels on straight track: it starts
C     three millimetres off the middle and hunts. Twice 10000 steps:
C
C       1  each wheel's contact by strips on its gap, started from the
C          step before (FSINIT, FSGAP, FSSOLV, FSFREE)
C       2  Hertz ellipse once, then FASTSIM (FSHERZ, FSKALK, FSTSIM)
C
C     Units are mm, N, s and tonnes. x forward, y to the right, z down;
C     PSI turns the nose to the right. Every step goes to unit 10
C     (wheelset.txt), a line a run to the terminal: the wavelength
C     measured between zero crossings, Klingel's, the largest shift of
C     the first and of the last half wave, mm.
      PROGRAM WHLSET
      INTEGER METHOD
      OPEN (10, FILE='wheelset.txt', STATUS='UNKNOWN')
      DO 10 METHOD = 1, 2
        CALL SIMUL(METHOD)
   10 CONTINUE
      CLOSE (10)
      END

      SUBROUTINE SIMUL(METHOD)
      INTEGER METHOD
      INTEGER NSTEP, NPTS
      PARAMETER (NSTEP = 10000, NPTS = 301)
      DOUBLE PRECISION V, DT, TMASS, TINERT, WEIGHT, R0, S, CONE, HIGH
      PARAMETER (V = 2.0D4, DT = 2.5D-4, TMASS = 1.5D0,
     &  TINERT = 0.8D6, WEIGHT = 1.6D5, R0 = 460.0D0, S = 750.0D0,
     &  CONE = 0.05D0, HIGH = 460.0D0)
      DOUBLE PRECISION Y, PSI, VY, VPSI, FLAT, TURN, FN(2), SIDE
      DOUBLE PRECISION CKSI, CETA, CPHI, F(3), FSUM(2), X, XZERO, XLAST
      DOUBLE PRECISION PEAK, FIRST, YOLD, WAVE, PI
      INTEGER ISTEP, IWHEEL, NCROSS, INFO
      INTEGER IWORK(8, 2)
      COMMON /ELLIPS/ A, B, C(4), G
      DOUBLE PRECISION A, B, C, G
      CHARACTER*256 TEXT
      PI = 4.0D0*ATAN(1.0D0)
      CALL START(METHOD, WEIGHT/2.0D0, R0, IWORK)
      Y = 3.0D0
      PSI = 0.0D0
      VY = 0.0D0
      VPSI = 0.0D0
      FLAT = 0.0D0
      NCROSS = 0
      PEAK = 0.0D0
      FIRST = 0.0D0
      XZERO = 0.0D0
      XLAST = 0.0D0
      DO 30 ISTEP = 1, NSTEP
        X = V*DT*ISTEP
C       Wheel 1 is the right one. The axle's lateral force rolls it.
        FN(1) = WEIGHT/2.0D0 - FLAT*HIGH/(2.0D0*S)
        FN(2) = WEIGHT - FN(1)
        FSUM(1) = 0.0D0
        FSUM(2) = 0.0D0
        DO 20 IWHEEL = 1, 2
          SIDE = 3.0D0 - 2.0D0*IWHEEL
          CKSI = SIDE*(CONE*Y/R0 + S*VPSI/V)
          CETA = PSI - VY/V
          CPHI = SIDE*CONE/R0 - VPSI/V
          CALL WHEEL(METHOD, IWORK(1, IWHEEL), FN(IWHEEL), CKSI, CETA,
     &      CPHI, F, INFO)
          IF (INFO .GE. 100) THEN
            CALL FSMSG(INFO, TEXT)
            WRITE (*, '(1X, A, I6, 1X, A)') 'STEP', ISTEP, TEXT(1:20)
            STOP 1
          END IF
          IF (IWHEEL .EQ. 1) WRITE (10, '(I2, 1P, 9E25.16E3)') METHOD,
     &      X, Y, FN(1), CKSI, CETA, CPHI, F
C         The rail's forces on the wheel are the opposite ones.
          FSUM(1) = FSUM(1) - F(2)
          FSUM(2) = FSUM(2) + SIDE*S*F(1) - F(3)
   20   CONTINUE
        FLAT = FSUM(1)
        TURN = FSUM(2)
        VY = VY + DT*FLAT/TMASS
        VPSI = VPSI + DT*TURN/TINERT
        YOLD = Y
        Y = Y + DT*VY
        PSI = PSI + DT*VPSI
        PEAK = MAX(PEAK, ABS(Y))
        IF (Y*YOLD .LT. 0.0D0) THEN
          NCROSS = NCROSS + 1
          XLAST = X + V*DT*Y/(YOLD - Y)
          IF (NCROSS .EQ. 1) XZERO = XLAST
          IF (NCROSS .EQ. 2) FIRST = PEAK
          IF (NCROSS .GE. 1) PEAK = 0.0D0
        END IF
   30 CONTINUE
      WAVE = 2.0D0*(XLAST - XZERO)/(NCROSS - 1)
      WRITE (*, '(I2, I4, 2F12.3, 2F10.4)') METHOD, NCROSS, WAVE,
     &  2.0D0*PI*SQRT(R0*S/CONE), FIRST, PEAK
      IF (METHOD .EQ. 1) THEN
        CALL FSFREE(IWORK(1, 1), INFO)
        CALL FSFREE(IWORK(1, 2), INFO)
      END IF
      END

C     The workspaces and the gap of method 1, the ellipse of method 2.
      SUBROUTINE START(METHOD, FN, R0, IWORK)
      INTEGER METHOD, IWORK(8, 2)
      DOUBLE PRECISION FN, R0
      INTEGER NPTS
      PARAMETER (NPTS = 301)
      DOUBLE PRECISION YG(NPTS), HG(NPTS), AG(NPTS), PEN, PMAX
      INTEGER I, K, LIWORK, IQUERY(1), INFO
      COMMON /ELLIPS/ A, B, C(4), G
      COMMON /CHOICE/ PAR(9), IOPT(9)
      DOUBLE PRECISION A, B, C, G, PAR
      INTEGER IOPT
      CALL FSDFLT(IOPT, PAR)
      IOPT(3) = 7
      G = PAR(1)/(2.0D0*(1.0D0 + PAR(3)))
      IF (METHOD .EQ. 2) THEN
        CALL FSHERZ(PAR, 0.5D0/R0, 0.5D0/300.0D0, FN, A, B, PEN, PMAX,
     &    INFO)
        CALL FSKALK(A/B, PAR(3), C, INFO)
        RETURN
      END IF
C     A cone on a rail head of 300 mm.
      DO 10 I = 1, NPTS
        YG(I) = -15.0D0 + 0.1D0*(I - 1)
        HG(I) = 0.5D0*YG(I)**2/300.0D0
        AG(I) = 0.5D0/R0
   10 CONTINUE
      CALL FSINIT(IOPT, NPTS, IQUERY, -1, INFO)
      LIWORK = IQUERY(1)
      IF (LIWORK .GT. 8) STOP 1
      DO 20 K = 1, 2
        CALL FSINIT(IOPT, NPTS, IWORK(1, K), LIWORK, INFO)
        IF (INFO .EQ. 0) CALL FSGAP(IWORK(1, K), NPTS, YG, HG, AG, INFO)
        IF (INFO .NE. 0) STOP 1
   20 CONTINUE
      END

C     Forces of one wheel on its rail.
      SUBROUTINE WHEEL(METHOD, IWORK, FN, CKSI, CETA, CPHI, F, INFO)
      INTEGER METHOD, IWORK(8), INFO
      DOUBLE PRECISION FN, CKSI, CETA, CPHI, F(3), RES(14)
      COMMON /ELLIPS/ A, B, C(4), G
      COMMON /CHOICE/ PAR(9), IOPT(9)
      DOUBLE PRECISION A, B, C, G, PAR
      INTEGER IOPT
      IF (METHOD .EQ. 1) THEN
        IOPT(8) = 1
        PAR(6) = FN
        PAR(7) = CKSI
        PAR(8) = CETA
        PAR(9) = CPHI
        CALL FSSOLV(IWORK, IOPT, PAR, RES, INFO)
        F(1) = RES(8)
        F(2) = RES(9)
        F(3) = RES(10)
      ELSE
        CALL FSTSIM(A, B, G, C(1), C(2), C(3), CKSI, CETA, CPHI, PAR(5),
     &    FN, 15, 15, F(1), F(2), F(3), INFO)
      END IF
      END
