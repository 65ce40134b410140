C     Contact geometry functions and equivalent conicity from fixed-form
C     Fortran, as bits.
      PROGRAM CONIC
      INTEGER NY, NA
      PARAMETER (NY = 161, NA = 12)
      INTEGER NPROF(4), ISTAT(NY), JSTAT(2, NA), IROLL, I, K, N, INFO
      DOUBLE PRECISION SETUP(9), Y(NY), FUNC(10, NY), S(NY), DR(NY)
      DOUBLE PRECISION AMP(NA), EQU(2), CON(6, NA)
      DATA NPROF /-1, -2, -2, -3/
      CALL FSWDFT(SETUP)
      SETUP(2) = 460.25D0
      DO 10 I = 1, NY
        Y(I) = 0.5D0*(I - 81)
   10 CONTINUE
      DO 20 I = 1, NA
        AMP(I) = 0.5D0*I*I
   20 CONTINUE
      DO 50 IROLL = 0, 1
        CALL FSCFUN(SETUP, NPROF, Y, Y, IROLL, NY, Y, FUNC, ISTAT, INFO)
        IF (INFO .NE. 0) STOP 1
        N = 0
        DO 30 I = 1, NY
          WRITE (*, '(A, 1X, I0)') 'shift', ISTAT(I)
          WRITE (*, 100) (FUNC(K, I), K = 1, 10)
          IF (ISTAT(I) .NE. 0) GO TO 30
          N = N + 1
          S(N) = Y(I)
          DR(N) = FUNC(1, I)
   30   CONTINUE
        CALL FSCONI(N, S, DR, NA, AMP, EQU, CON, JSTAT, INFO)
        IF (INFO .NE. 0) STOP 2
        WRITE (*, 100) EQU
        DO 40 I = 1, NA
          WRITE (*, '(A, 2(1X, I0))') 'amplitude', JSTAT(1, I),
     &      JSTAT(2, I)
          WRITE (*, 100) (CON(K, I), K = 1, 6)
   40   CONTINUE
   50 CONTINUE
  100 FORMAT (10(Z16.16, :, 1X))
      END
