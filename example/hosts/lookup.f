C     Creep forces from a table that `faststrip lookup make` made, from
C     fixed-form Fortran, as bits. The table is table.fslt.
      PROGRAM LOOKUP
      INTEGER MBYTES, NS
      PARAMETER (MBYTES = 20000000, NS = 200)
      CHARACTER*1 BYTES(MBYTES)
      INTEGER IWORK(8), ISTAT(NS), I, J, K, N, IORDER, INFO
      DOUBLE PRECISION STATE(8, NS), FORCE(3, NS), DJAC(3, 8, NS)
      DOUBLE PRECISION ABOUT(23), C
      OPEN (10, FILE='table.fslt', ACCESS='DIRECT', RECL=1,
     &  FORM='UNFORMATTED', STATUS='OLD')
      N = 0
   10 CONTINUE
      READ (10, REC=N + 1, ERR=20) BYTES(N + 1)
      N = N + 1
      GO TO 10
   20 CONTINUE
      CLOSE (10)
      CALL FSLOPN(N, BYTES, IWORK, 8, INFO)
      IF (INFO .NE. 0) STOP 1
      CALL FSLINF(IWORK, ABOUT, INFO)
      IF (INFO .NE. 0) STOP 2
      WRITE (*, 100) ABOUT
      DO 30 I = 1, NS
        C = 1.0D0 + MOD(I - 1, 7)
        STATE(1, I) = C*(1.0D0 + 0.01D0*MOD(I - 1, 23))
        STATE(2, I) = C
        STATE(3, I) = 1.0D4 + 1.0D3*MOD(I - 1, 101)
        STATE(4, I) = 0.1D0 + 0.01D0*MOD(I - 1, 41)
        STATE(5, I) = 82000.0D0
        STATE(6, I) = 1.0D-4*(MOD(I - 1, 89) - 44)
        STATE(7, I) = 1.0D-4*(MOD(I - 1, 61) - 30)
        STATE(8, I) = 1.0D-5*(MOD(I - 1, 37) - 18)
   30 CONTINUE
      STATE(3, 4) = 0.0D0
      STATE(1, 5) = 1.0D9
      DO 50 IORDER = 1, 3, 2
        CALL FSLOOK(IWORK, IORDER, NS, STATE, FORCE, DJAC, ISTAT, INFO)
        WRITE (*, '(I0)') INFO
        DO 40 I = 1, NS
          WRITE (*, '(I0)') ISTAT(I)
          WRITE (*, 100) (FORCE(J, I), J = 1, 3)
          WRITE (*, 100) ((DJAC(J, K, I), J = 1, 3), K = 1, 8)
   40   CONTINUE
   50 CONTINUE
      CALL FSLFRE(IWORK, INFO)
      IF (INFO .NE. 0) STOP 3
      CALL FSLFRE(IWORK, INFO)
      IF (INFO .EQ. 0) STOP 4
  100 FORMAT (24(Z16.16, :, 1X))
      END
