C     Wheelsets from fixed-form Fortran: every figure of every contact,
C     as bits.
      PROGRAM WHLSTS
      INTEGER NPTS, NCASE
      PARAMETER (NPTS = 61, NCASE = 12)
      INTEGER IOPT(9), NPROF(4), IWORK(8), IDMND(4), N, INFO, I, K, IC
      INTEGER ISIDE, MEMORY, NEEDED
      PARAMETER (MEMORY = 1000000)
      DOUBLE PRECISION BYTES(MEMORY/8)
      DOUBLE PRECISION PAR(9), SETUP(9), Y(2*NPTS), Z(2*NPTS), S(11)
      DOUBLE PRECISION DMND(4), CONT(48, 16), WRES(27), R(12), RK(12)
      DATA DMND /6.0D4, 5.0D4, 1.2D5, 1.0D6/
      DATA RK /0.01D0, -0.02D0, 1.0D-4, 2.0D0, -0.5D0, 1.0D-3,
     &  -0.02D0, 0.01D0, -2.0D-4, -1.0D0, 0.25D0, 2.0D-3/
      DO 90 IC = 1, 2
        CALL FSDFLT(IOPT, PAR)
        CALL FSWDFT(SETUP)
        PAR(5) = 0.35D0
        IOPT(3) = 9
        IOPT(9) = 1
        SETUP(2) = 460.25D0
        SETUP(8) = 0.05D0
        DO 10 I = 1, 4
          NPROF(I) = 0
   10   CONTINUE
        NPROF(1) = -1
        NPROF(3) = -2
        IF (IC .EQ. 2) THEN
          DO 20 I = 1, NPTS
            Y(I) = I - 31
            Z(I) = -Y(I)*Y(I)/2000.0D0 - Y(I)/20.0D0
            Y(NPTS + I) = Y(I)
            Z(NPTS + I) = Y(I)*Y(I)/600.0D0
   20     CONTINUE
          SETUP(7) = 1500.0D0
          NPROF(1) = NPTS
          NPROF(2) = -3
          NPROF(3) = NPTS
        END IF
        CALL FSWNEW(IOPT, PAR, SETUP, NPROF, Y, Z, IWORK, 8, INFO)
        IF (INFO .NE. 0) STOP 1
C         The second one has contact damping, and springs below rails.
        IF (IC .EQ. 2) CALL FSDAMP(IWORK, 1.0D-3, 100.0D0, INFO)
        IF (IC .EQ. 2) CALL FSSPRI(IWORK, 3.0D4, 8.0D4, INFO)
        DO 30 I = 1, 11
          S(I) = 0.0D0
   30   CONTINUE
        DO 80 I = 1, NCASE
          S(1) = 0.5D0*I - 3.0D0
          S(4) = 0.001D0*I
          S(5) = 20000.0D0
          S(6) = 10.0D0*I
          S(7) = 1.0D0
          S(8) = 0.001D0
          S(9) = 0.01D0*I
          S(10) = -20000.0D0/460.0D0
          S(11) = 1.0D-6
          IDMND(1) = MOD(I, 3)
          IDMND(2) = 0
          IF (MOD(I, 3) .LT. 2 .AND. I .GE. 9) IDMND(2) = 2 - MOD(I, 2)
          IDMND(3) = 0
          IF (MOD(I, 3) .GT. 0 .AND. I .LT. 7) IDMND(3) = 1
          IDMND(4) = MOD(I, 2)
C         The rails have moved in the second half, and each wheel
C         rotates by itself.
          DO 40 K = 1, 12
            R(K) = RK(K)*I
   40     CONTINUE
          IF (I .GT. 6) CALL FSRAIL(IWORK, R, INFO)
          IF (I .GT. 6) CALL FSPTCH(IWORK, 0.01D0*I, INFO)
C         Nothing changes where memory is taken out and put back.
          CALL FSWSAV(IWORK, MEMORY, BYTES, NEEDED, INFO)
          IF (INFO .NE. 0) STOP 5
          CALL FSWRST(IWORK, NEEDED, BYTES, INFO)
          IF (INFO .NE. 0) STOP 6
          CALL FSWSLV(IWORK, S, IDMND, DMND, 16, N, CONT, WRES, INFO)
          WRITE (*, '(A, 2(1X, I0))') 'solved', INFO, N
          DO 70 ISIDE = 1, 2
            IF (INFO .GE. 100 .OR. IDMND(2) .EQ. 3 - ISIDE) GO TO 70
            WRITE (*, '(A, 3(1X, I0))') 'wheel', NINT(WRES(21+ISIDE)),
     &        NINT(WRES(23 + ISIDE)), NINT(WRES(25 + ISIDE))
            WRITE (*, '(11(Z16.16, :, 1X))') WRES(ISIDE), WRES(3),
     &        (WRES(3*ISIDE + K), K = 1, 3),
     &        (WRES(6 + 3*ISIDE + K), K = 1, 3),
     &        (WRES(12 + 3*ISIDE + K), K = 1, 3)
            DO 60 K = 1, N
              IF (NINT(CONT(1, K)) .EQ. ISIDE) THEN
                CALL SHOW(IWORK, K, CONT)
                CALL PARTS(IWORK, K)
              END IF
   60       CONTINUE
            S(2) = WRES(ISIDE)
            S(3) = WRES(3)
   70     CONTINUE
          IF (INFO .LT. 100) CALL SLOPES(IWORK)
   80   CONTINUE
        CALL FSWFRE(IWORK, INFO)
        IF (INFO .NE. 0) STOP 1
   90 CONTINUE
      END

C     One contact, in the rows of the other languages' programs.
      SUBROUTINE SHOW(IWORK, K, CONT)
      INTEGER IWORK(8), K, I, M, LSET, INFO, LAST(11)
      DOUBLE PRECISION CONT(48, 16)
      DATA LAST /15, 20, 23, 26, 29, 31, 38, 41, 43, 45, 48/
      CALL FSWSET(IWORK, K, LSET, INFO)
      IF (INFO .NE. 0) STOP 2
      WRITE (*, '(A, 7(1X, I0))') 'contact',
     &  (NINT(CONT(I, K)), I = 1, 6), LSET
      M = 7
      DO 10 I = 1, 11
        WRITE (*, '(9(Z16.16, :, 1X))') CONT(M:LAST(I), K)
        M = LAST(I) + 1
   10 CONTINUE
      END

C     Columns of the derivatives, one by one.
      SUBROUTINE SLOPES(IWORK)
      INTEGER IWORK(8), I, J, K, INFO
      DOUBLE PRECISION D(6, 9, 2)
      CALL FSWDRV(IWORK, D, INFO)
      WRITE (*, '(A, 1X, I0)') 'derivatives', INFO
      IF (INFO .GE. 100) RETURN
      DO 20 K = 1, 2
        DO 10 J = 1, 9
          WRITE (*, '(6(Z16.16, :, 1X))') (D(I, J, K), I = 1, 6)
   10   CONTINUE
   20 CONTINUE
      END

C     The second strip of a contact, and an element in its first half.
      SUBROUTINE PARTS(IWORK, K)
      INTEGER MS, ME
      PARAMETER (MS = 400, ME = 8000)
      INTEGER IWORK(8), K, N, M, I, J, INFO, IPATCH(MS), ISTATE(ME)
      DOUBLE PRECISION S(MS, 10), E(ME, 8), REGIM(4, 1)
      CALL FSWSTR(IWORK, K, MS, N, S(1, 1), S(1, 2), S(1, 3), S(1, 4),
     &  IPATCH, INFO)
      IF (INFO .NE. 0) STOP 3
      CALL FSWSTW(IWORK, K, 0, REGIM, 0.0D0, MS, N, S(1, 5), S(1, 6),
     &  S(1, 7), S(1, 8), S(1, 9), S(1, 10), INFO)
      IF (INFO .NE. 0) STOP 4
      CALL FSWELM(IWORK, K, ME, M, E(1, 1), E(1, 2), E(1, 3), E(1, 4),
     &  E(1, 5), E(1, 6), E(1, 7), E(1, 8), ISTATE, INFO)
      J = M/3 + 1
      WRITE (*, '(A, 5(1X, I0))') 'parts', INFO, N, M, IPATCH(2),
     &  ISTATE(J)
      WRITE (*, '(7(Z16.16, :, 1X))') (S(2, I), I = 1, 7)
      WRITE (*, '(8(Z16.16, :, 1X))') (E(J, I), I = 1, 8)
      END
