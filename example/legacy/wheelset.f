C     A wheelset with S1002 wheels on straight track of 60E1 rails, held
C     by springs to a frame that runs straight. It starts off the middle
C     and hunts. Three runs:
C
C       1  below the critical speed: the hunting dies out
C       2  above it: it grows to a limit cycle on the flange roots
C       3  as 2, in a mirror
C
C     The contacts and forces of both wheels come from FASTSTRIP:
C     position, yaw and their rates in, forces and moments out (FSWDFT,
C     FSWNEW, FSWSLV, FSWFRE).
C
C     Units are mm, N, s and tonnes. x forward, y to the right, z down;
C     PSI turns the nose to the right. Every call goes to unit 10
C     (wheelset.txt), a line a run to the terminal: run, zero crossings,
C     the wavelength measured between them, Klingel's of the rolling
C     radii of the run, the largest shift of the first and of the last
C     half wave, mm.
      PROGRAM WHLSET
      INTEGER IWORK(8), INFO
      OPEN (10, FILE='wheelset.txt', STATUS='UNKNOWN')
      CALL START(IWORK)
      CALL SIMUL(1, 2.0D4, 3.0D4, 3.0D0, IWORK)
      CALL SIMUL(2, 6.0D4, 6.0D4, 3.0D0, IWORK)
      CALL SIMUL(3, 6.0D4, 6.0D4, -3.0D0, IWORK)
      CALL FSWFRE(IWORK, INFO)
      CLOSE (10)
      END

C     The wheelset on its track: usual dimensions, seven strips.
      SUBROUTINE START(IWORK)
      INTEGER IWORK(8), IOPT(9), NPROF(4), INFO
      DOUBLE PRECISION PAR(9), SETUP(9), NONE(1)
      DATA NPROF /-1, 0, -2, 0/
      DATA NONE /0.0D0/
      CALL FSDFLT(IOPT, PAR)
      CALL FSWDFT(SETUP)
      IOPT(3) = 7
      CALL FSWNEW(IOPT, PAR, SETUP, NPROF, NONE, NONE, IWORK, 8, INFO)
      IF (INFO .NE. 0) STOP 1
      END

C     One run from Y0 over the length XEND. The unknowns are y, PSI and
C     their rates. A step is one of Verwer's method ROS2, of second
C     order whatever matrix SOLVE has; with one near the slopes of the
C     creep forces it is stable although they decay in a fraction of it.
      SUBROUTINE SIMUL(IRUN, V, XEND, Y0, IWORK)
      INTEGER IRUN, IWORK(8)
      DOUBLE PRECISION V, XEND, Y0
      DOUBLE PRECISION DT, R0, S
      PARAMETER (DT = 2.5D-3, R0 = 460.0D0, S = 750.0D0)
      DOUBLE PRECISION U(4), P(4), F(4), A(4), B(4), G, DR, X, YOLD
      DOUBLE PRECISION XZERO, XLAST, PEAK, FIRST, ALAST, DRY, YY, PI
      INTEGER I, ISTEP, NCROSS
      COMMON /AXLE/ ROLL, SHIFT, IWARM
      DOUBLE PRECISION ROLL, SHIFT
      INTEGER IWARM
      PI = 4.0D0*ATAN(1.0D0)
      G = (1.0D0 - SQRT(0.5D0))*DT
      ROLL = 0.0D0
      SHIFT = 0.0D0
      IWARM = 0
      U(1) = Y0
      U(2) = 0.0D0
      U(3) = 0.0D0
      U(4) = 0.0D0
      NCROSS = 0
      PEAK = ABS(Y0)
      FIRST = 0.0D0
      ALAST = 0.0D0
      XZERO = 0.0D0
      XLAST = 0.0D0
      DRY = 0.0D0
      YY = 0.0D0
      DO 40 ISTEP = 1, NINT(XEND/(V*DT))
        X = V*DT*(ISTEP - 1)
        CALL RATES(IRUN, 1, X, V, U, IWORK, F, DR)
        DRY = DRY + DR*U(1)
        YY = YY + U(1)**2
        CALL SOLVE(G, V, F, A)
        DO 10 I = 1, 4
          P(I) = U(I) + DT*A(I)
   10   CONTINUE
        CALL RATES(IRUN, 2, X + V*DT, V, P, IWORK, F, DR)
        DO 20 I = 1, 4
          F(I) = F(I) - 2.0D0*A(I)
   20   CONTINUE
        CALL SOLVE(G, V, F, B)
        YOLD = U(1)
        DO 30 I = 1, 4
          U(I) = U(I) + DT*(1.5D0*A(I) + 0.5D0*B(I))
   30   CONTINUE
        IF (U(1)*YOLD .LT. 0.0D0) THEN
          NCROSS = NCROSS + 1
          XLAST = X + V*DT*YOLD/(YOLD - U(1))
          IF (NCROSS .EQ. 1) XZERO = XLAST
          IF (NCROSS .EQ. 1) FIRST = PEAK
          ALAST = PEAK
          PEAK = 0.0D0
        END IF
        PEAK = MAX(PEAK, ABS(U(1)))
   40 CONTINUE
      WRITE (*, '(I2, I4, 2F12.3, 2F10.4)') IRUN, NCROSS,
     &  2.0D0*(XLAST - XZERO)/(NCROSS - 1),
     &  2.0D0*PI*SQRT(R0*S*2.0D0*YY/DRY), FIRST, ALAST
      END

C     K of (1 - G J) K = F, where J has the springs, and the creep
C     forces of linear theory; two of the four unknowns are eliminated.
      SUBROUTINE SOLVE(G, V, F, K)
      DOUBLE PRECISION G, V, F(4), K(4)
      DOUBLE PRECISION R0, S, CONE, CREEP
      PARAMETER (R0 = 460.0D0, S = 750.0D0, CONE = 0.17D0,
     &  CREEP = 1.2D7)
      DOUBLE PRECISION DY, DPSI, TY, TPSI, DVY, DVPSI, A, B, C, D, E, H
      COMMON /BODY/ TMASS, TINERT, CY, CPSI
      DOUBLE PRECISION TMASS, TINERT, CY, CPSI
      DY = -CY/TMASS
      DPSI = CREEP/TMASS
      DVY = -CREEP/(TMASS*V)
      TY = -CREEP*S*CONE/(R0*TINERT)
      TPSI = -CPSI/TINERT
      DVPSI = -CREEP*S*S/(TINERT*V)
      A = 1.0D0 - G*DVY - G*G*DY
      B = -G*G*DPSI
      C = -G*G*TY
      D = 1.0D0 - G*DVPSI - G*G*TPSI
      E = F(3) + G*(DY*F(1) + DPSI*F(2))
      H = F(4) + G*(TY*F(1) + TPSI*F(2))
      K(3) = (E*D - B*H)/(A*D - B*C)
      K(4) = (A*H - C*E)/(A*D - B*C)
      K(1) = F(1) + G*K(3)
      K(2) = F(2) + G*K(4)
      END

C     The rates of y, PSI, and of their rates; DR is the difference of
C     the rolling radii. The roll, and by how much the right wheel's
C     load is above the left one's, are those of the last call: both
C     hardly change the forces, and follow at once.
      SUBROUTINE RATES(IRUN, ISTAGE, X, V, U, IWORK, F, DR)
      INTEGER IRUN, ISTAGE, IWORK(8)
      DOUBLE PRECISION X, V, U(4), F(4), DR
      DOUBLE PRECISION WEIGHT, R0, S
      PARAMETER (WEIGHT = 1.6D5, R0 = 460.0D0, S = 750.0D0)
      DOUBLE PRECISION STATE(11), DMND(4), CONT(48, 16), WRES(27)
      DOUBLE PRECISION R(2), FN(2), USED
      INTEGER IDMND(4), N, INFO, I, K
      COMMON /AXLE/ ROLL, SHIFT, IWARM
      DOUBLE PRECISION ROLL, SHIFT
      INTEGER IWARM
      COMMON /BODY/ TMASS, TINERT, CY, CPSI
      DOUBLE PRECISION TMASS, TINERT, CY, CPSI
      CHARACTER*256 TEXT
      DO 10 I = 1, 11
        STATE(I) = 0.0D0
   10 CONTINUE
      STATE(1) = U(1)
      STATE(3) = ROLL
      STATE(4) = U(2)
      STATE(5) = V
      STATE(6) = U(3)
      STATE(9) = U(4)
      STATE(10) = -V/R0
C     Vertical forces of both wheels; a start from the last call.
      IDMND(1) = 1
      IDMND(2) = 0
      IDMND(3) = 0
      IDMND(4) = IWARM
      DMND(1) = 0.5D0*WEIGHT + SHIFT
      DMND(2) = 0.5D0*WEIGHT - SHIFT
      DMND(3) = 0.0D0
      DMND(4) = 0.0D0
      CALL FSWSLV(IWORK, STATE, IDMND, DMND, 16, N, CONT, WRES, INFO)
      IF (INFO .GE. 100) THEN
        CALL FSMSG(INFO, TEXT)
        WRITE (*, '(1X, A, I2, F12.3, 1X, A)') 'RUN', IRUN, X,
     &    TEXT(1:20)
        STOP 1
      END IF
C     The rolling radius is that of the wheel's largest contact.
      FN(1) = 0.0D0
      FN(2) = 0.0D0
      USED = 0.0D0
      DO 20 K = 1, N
        I = NINT(CONT(1, K))
        IF (CONT(21, K) .GT. FN(I)) R(I) = CONT(16, K)
        FN(I) = MAX(FN(I), CONT(21, K))
        USED = MAX(USED, SQRT(CONT(28, K)**2 + CONT(29, K)**2)
     &    /CONT(21, K))
   20 CONTINUE
      DR = R(1) - R(2)
      WRITE (10, '(2I2, 1P, 20E25.16E3)') IRUN, ISTAGE, X, V,
     &  (U(I), I = 1, 4), ROLL, DMND(1), DMND(2),
     &  (WRES(I), I = 4, 9), WRES(18), WRES(21), R, USED
C     The rails' forces on the wheelset are the opposite ones.
      F(1) = U(3)
      F(2) = U(4)
      F(3) = (-WRES(5) - WRES(8) - CY*U(1))/TMASS
      F(4) = (-WRES(18) - WRES(21) - CPSI*U(2))/TINERT
      ROLL = ROLL + 0.5D0*(WRES(1) - WRES(2))/S
      SHIFT = SHIFT - 0.5D0*(WRES(16) + WRES(19))/S
      IWARM = 1
      END

C     Mass, t, moment of inertia about z, t mm^2, springs, N/mm, N mm.
      BLOCK DATA
      COMMON /BODY/ TMASS, TINERT, CY, CPSI
      DOUBLE PRECISION TMASS, TINERT, CY, CPSI
      DATA TMASS, TINERT, CY, CPSI /1.5D0, 0.8D6, 1.25D3, 6.7D8/
      END
