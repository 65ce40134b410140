C     Friction and wear from fixed-form Fortran: forces and figures of
C     contacts and wheelsets, as bits.
      PROGRAM WEAR
      INTEGER NPTS, MSTRIP
      PARAMETER (NPTS = 301, MSTRIP = 2000)
      INTEGER IOPT(9), NPROF(4), IWORK(8), IDMND(4), N, NREG, INFO
      INTEGER I, K, J, NCON, NLAW, KIND
      DOUBLE PRECISION PAR(9), RES(14), SETUP(9), S(11), DMND(4)
      DOUBLE PRECISION CONT(48, 16), WRES(27), FRIC(8), REGIM(4, 32)
      DOUBLE PRECISION DENS, YIELD, W(6), X(MSTRIP, 6)
      DOUBLE PRECISION Y(NPTS), H(NPTS), A(NPTS)
      DATA NPROF /-1, 0, -2, 0/
      READ (*, *) N, NREG, DENS, YIELD
      DO 10 I = 1, NREG
        READ (*, *) (REGIM(K, I), K = 1, 4)
   10 CONTINUE
      DO 20 I = 1, NPTS
        Y(I) = 0.1D0*(I - 151)
        H(I) = 2.0D-3*Y(I)*Y(I) + 3.0D-5*Y(I)*Y(I)*Y(I)
        A(I) = 1.0D0/920.0D0
   20 CONTINUE
      DO 90 I = 1, N
        CALL FSDFLT(IOPT, PAR)
        READ (*, *) IOPT(1), IOPT(2), KIND, PAR(5), FRIC
        NLAW = 0
        IF (IOPT(2) .EQ. 1) NLAW = NREG
        PAR(6) = 8.0D4
        PAR(7) = 4.0D-3
        PAR(8) = -2.0D-3
        PAR(9) = 2.0D-4
        CALL FSINIT(IOPT, NPTS, IWORK, 8, INFO)
        IF (INFO .NE. 0) STOP 1
        CALL FSFRIC(IWORK, KIND, FRIC, INFO)
        IF (INFO .NE. 0) STOP 2
        CALL FSCONT(IWORK, NPTS, Y, H, A, IOPT, PAR, RES, INFO)
        WRITE (*, '(A, 1X, I0)') 'contact', INFO
        IF (INFO .LT. 100) THEN
          WRITE (*, 100) (RES(K), K = 8, 10)
          CALL FSWEAR(IWORK, 1, NLAW, REGIM, DENS, YIELD, W, INFO)
          IF (INFO .NE. 0) STOP 3
          WRITE (*, 100) (W(K), K = 1, 4)
          IF (NLAW .GT. 0) WRITE (*, 100) W(5), W(6)
          CALL FSSTWR(IWORK, NREG, REGIM, DENS, MSTRIP, NCON, X(1, 1),
     &      X(1, 2), X(1, 3), X(1, 4), X(1, 5), X(1, 6), INFO)
          IF ((INFO .EQ. 0) .NEQV. (NLAW .GT. 0)) STOP 4
          DO 30 J = 1, NCON
            WRITE (*, 100) (X(J, K), K = 1, 6)
   30     CONTINUE
        END IF
        CALL FSFREE(IWORK, INFO)
        CALL FSWDFT(SETUP)
        CALL FSWNEW(IOPT, PAR, SETUP, NPROF, Y, Y, IWORK, 8, INFO)
        IF (INFO .NE. 0) STOP 5
        CALL FSFRIC(IWORK, KIND, FRIC, INFO)
        DO 40 K = 1, 11
          S(K) = 0.0D0
   40   CONTINUE
        S(1) = 6.2D0
        S(4) = 1.0D-3
        S(5) = 1.0D4
        S(10) = -1.0D4/460.0D0
        DO 50 K = 1, 4
          IDMND(K) = 0
          DMND(K) = 0.0D0
   50   CONTINUE
        IDMND(1) = 1
        DMND(1) = 6.0D4
        DMND(2) = 6.0D4
        CALL FSWSLV(IWORK, S, IDMND, DMND, 16, NCON, CONT, WRES, INFO)
        WRITE (*, '(A, 1X, I0)') 'wheelset', INFO
        DO 60 J = 1, NCON
          WRITE (*, 100) (CONT(K, J), K = 28, 30)
          CALL FSWEAR(IWORK, J, NLAW, REGIM, DENS, YIELD, W, INFO)
          IF (INFO .NE. 0) STOP 6
          WRITE (*, 100) (W(K), K = 1, 4)
          IF (NLAW .GT. 0) WRITE (*, 100) W(5), W(6)
   60   CONTINUE
        CALL FSWFRE(IWORK, INFO)
   90 CONTINUE
  100 FORMAT (6(Z16.16, :, 1X))
      END
