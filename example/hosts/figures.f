C     The same figures by the F77 interface; see figures.f90. Contacts with a
C     turn are left out, which this face does not take, and limits and
C     tolerances that FSLIMT and FSWANT refuse.
      PROGRAM FIGURE
      INTEGER MPTS, MOST
      PARAMETER (MPTS = 400, MOST = 20000)
      INTEGER NC, IC, IOPT(9), IW(8), IW2(8), NORM, NTAN, NS, NP, NX,
     &  NY, IBYL, IEL, ITURN, IEST, ITARG, N, I, INFO
      DOUBLE PRECISION D(20), Y(MPTS), H(MPTS), A(MPTS), T, PAR(9),
     &  X(11), F(4), RLIM, TOL
      CHARACTER*20 SNORM, STAN, TEXT
      CALL FSDFLT(IOPT, PAR)
      CALL PUT('default_normal', 0, 0, 0, DBLE(IOPT(1)))
      CALL PUT('default_tangential', 0, 0, 0, DBLE(IOPT(2)))
      CALL PUT('default_strips_per_patch', 0, 0, 0, DBLE(IOPT(3)))
      CALL PUT('default_points_per_strip', 0, 0, 0, DBLE(IOPT(4)))
      CALL PUT('default_fastsim_nx', 0, 0, 0, DBLE(IOPT(5)))
      CALL PUT('default_fastsim_ny', 0, 0, 0, DBLE(IOPT(6)))
      CALL PUT('default_by_load', 0, 0, 0, DBLE(IOPT(7)))
      CALL PUT('default_warm_start', 0, 0, 0, DBLE(IOPT(8)))
      CALL PUT('default_with_elements', 0, 0, 0, DBLE(IOPT(9)))
      CALL PUT('default_e_wheel', 0, 0, 0, PAR(1))
      CALL PUT('default_e_rail', 0, 0, 0, PAR(2))
      CALL PUT('default_nu_wheel', 0, 0, 0, PAR(3))
      CALL PUT('default_nu_rail', 0, 0, 0, PAR(4))
      CALL PUT('default_mu', 0, 0, 0, PAR(5))
      CALL PUT('default_load', 0, 0, 0, PAR(6))
      CALL PUT('default_cksi', 0, 0, 0, PAR(7))
      CALL PUT('default_ceta', 0, 0, 0, PAR(8))
      CALL PUT('default_cphi', 0, 0, 0, PAR(9))
      DO 10 I = -1, 130
        CALL FSMSG(I, TEXT)
        WRITE (*, '(A, I4, 1X, A)') 'word 0 ', I, TEXT
   10 CONTINUE
      READ (*, *) NC
      DO 40 IC = 1, NC
        READ (*, *) SNORM, STAN, NORM, NTAN, NS, NP, NX, NY, IBYL, IEL,
     &    ITURN, IEST, RLIM, ITARG, TOL, N
        READ (*, *) D
        DO 20 I = 1, N
          READ (*, *) Y(I), H(I), A(I), T
   20   CONTINUE
        IF (ITURN .EQ. 1 .OR. RLIM .LE. 0.0D0) GO TO 40
        IF (TOL .LE. 0.0D0) GO TO 40
        IOPT(1) = NORM
        IOPT(2) = NTAN
        IOPT(3) = NS
        IOPT(4) = NP
        IOPT(5) = NX
        IOPT(6) = NY
        IOPT(7) = IBYL
        IOPT(8) = 0
        IOPT(9) = IEL
        CALL FSINIT(IOPT, N, IW, 8, INFO)
        IF (INFO .NE. 0) STOP 3
        CALL FSINIT(IOPT, N, IW2, 8, INFO)
        IF (INFO .NE. 0) STOP 4
C       By default errors are estimated, and named above 0.1.
        IF (IEST .EQ. 0 .OR. RLIM .NE. 0.1D0) THEN
          CALL FSLIMT(IW, IEST, RLIM, INFO)
          IF (INFO .NE. 0) STOP 8
        END IF
C       By default forces are wanted, with 0.02.
        IF (ITARG .NE. 1 .OR. TOL .NE. 0.02D0) THEN
          CALL FSWANT(IW, ITARG, TOL, 0.0D0, INFO)
          IF (INFO .NE. 0) STOP 11
        END IF
        CALL SOLVE(IW, IOPT, D(1), IC, 1, N, Y, H, A)
        CALL FSCOPY(IW, IW2, INFO)
        IF (INFO .NE. 0) STOP 5
        CALL ARRAYS(IW2, IC, 2)
        IOPT(8) = 1
        CALL SOLVE(IW, IOPT, D(11), IC, 3, N, Y, H, A)
        CALL SOLVE(IW2, IOPT, D(11), IC, 4, N, Y, H, A)
        CALL FSFREE(IW, INFO)
        CALL FSFREE(IW2, INFO)
   40 CONTINUE
      DO 50 I = 1, 5
        READ (*, *) X, NX, NY
        CALL FSTSIM(X(1), X(2), X(3), X(4), X(5), X(6), X(7), X(8),
     &    X(9), X(10), X(11), NX, NY, F(1), F(2), F(3), INFO)
        CALL PUT('fastsim_status', 0, I, 0, DBLE(INFO))
        CALL PUT('fastsim_fx', 0, I, 0, F(1))
        CALL PUT('fastsim_fy', 0, I, 0, F(2))
        CALL PUT('fastsim_mz', 0, I, 0, F(3))
   50 CONTINUE
      DO 60 I = 1, 5
        READ (*, *) (PAR(N), N = 1, 4), X(1), X(2), X(3)
        CALL FSHERZ(PAR, X(1), X(2), X(3), F(1), F(2), F(3), F(4),
     &    INFO)
        CALL PUT('hertz_status', 0, I, 0, DBLE(INFO))
        CALL PUT('hertz_a', 0, I, 0, F(1))
        CALL PUT('hertz_b', 0, I, 0, F(2))
        CALL PUT('hertz_penetration', 0, I, 0, F(3))
        CALL PUT('hertz_pmax', 0, I, 0, F(4))
   60 CONTINUE
      DO 70 I = 1, 5
        READ (*, *) X(1), X(2)
        CALL FSKALK(X(1), X(2), F, INFO)
        CALL PUT('kalker_status', 0, I, 0, DBLE(INFO))
        CALL PUT('kalker_c11', 0, I, 0, F(1))
        CALL PUT('kalker_c22', 0, I, 0, F(2))
        CALL PUT('kalker_c23', 0, I, 0, F(3))
        CALL PUT('kalker_c33', 0, I, 0, F(4))
   70 CONTINUE
      END
C     The first step by FSCONT, the others by FSSOLV.
      SUBROUTINE SOLVE(IW, IOPT, D, IC, IS, N, Y, H, A)
      INTEGER IW(8), IOPT(9), IC, IS, N, INFO, LSET
      DOUBLE PRECISION D(10), Y(N), H(N), A(N), PAR(9), RES(14), ERR(7),
     &  FERR(4), CREEP(5)
      CHARACTER*256 TEXT
      PAR(1) = D(1)
      PAR(2) = D(2)
      PAR(3) = D(3)
      PAR(4) = D(4)
      PAR(5) = D(5)
      PAR(6) = D(7)
      IF (IOPT(7) .EQ. 1) PAR(6) = D(6)
      PAR(7) = D(8)
      PAR(8) = D(9)
      PAR(9) = D(10)
      IF (IS .EQ. 1) THEN
        CALL FSCONT(IW, N, Y, H, A, IOPT, PAR, RES, INFO)
      ELSE
        CALL FSSOLV(IW, IOPT, PAR, RES, INFO)
      END IF
      CALL PUT('status', IC, IS, 0, DBLE(INFO))
      CALL FSLAST(IW, TEXT)
      WRITE (*, '(A, 2(1X, I4), 1X, A)') 'message', IC, IS, TEXT
      CALL PUT('load', IC, IS, 0, RES(1))
      CALL PUT('penetration', IC, IS, 0, RES(2))
      CALL PUT('area', IC, IS, 0, RES(3))
      CALL PUT('pmax', IC, IS, 0, RES(4))
      CALL PUT('y_min', IC, IS, 0, RES(5))
      CALL PUT('y_max', IC, IS, 0, RES(6))
      CALL PUT('x_max', IC, IS, 0, RES(7))
      CALL PUT('fx', IC, IS, 0, RES(8))
      CALL PUT('fy', IC, IS, 0, RES(9))
      CALL PUT('mz', IC, IS, 0, RES(10))
      CALL PUT('friction_power', IC, IS, 0, RES(11))
      CALL PUT('stick_fraction', IC, IS, 0, RES(12))
      CALL PUT('n_patches', IC, IS, 0, RES(13))
      CALL FSERRS(IW, ERR, INFO)
      IF (INFO .NE. 0) STOP 9
      CALL PUT('est_err_penetration', IC, IS, 0, ERR(1))
      CALL PUT('est_err_pmax', IC, IS, 0, ERR(2))
      CALL PUT('est_err_area', IC, IS, 0, ERR(3))
      CALL PUT('residual_inside', IC, IS, 0, ERR(4))
      CALL PUT('overlap_outside', IC, IS, 0, ERR(5))
      CALL PUT('is_estimated', IC, IS, 0, ERR(6))
      CALL PUT('strips_across', IC, IS, 0, ERR(7))
      CALL FSFERR(IW, FERR, INFO)
      IF (INFO .NE. 0) STOP 10
      CALL PUT('est_err_fx', IC, IS, 0, FERR(1))
      CALL PUT('est_err_fy', IC, IS, 0, FERR(2))
      CALL PUT('est_err_mz', IC, IS, 0, FERR(3))
      CALL PUT('forces_are_estimated', IC, IS, 0, FERR(4))
      CALL FSCREP(IW, CREEP, INFO)
      IF (INFO .NE. 0) STOP 10
      CALL PUT('cksi', IC, IS, 0, CREEP(1))
      CALL PUT('ceta', IC, IS, 0, CREEP(2))
      CALL PUT('est_err_cksi', IC, IS, 0, CREEP(4))
      CALL PUT('est_err_ceta', IC, IS, 0, CREEP(5))
      CALL FSLSET(IW, LSET, INFO)
      IF (INFO .NE. 0) STOP 10
      CALL PUT('limitations', IC, IS, 0, DBLE(LSET))
      CALL STEPS(IW, IC, IS)
      CALL ARRAYS(IW, IC, IS)
      CALL PUT('result_n_strips', IC, IS, 0, RES(14))
      END
      SUBROUTINE STEPS(IW, IC, IS)
      INTEGER MSTP
      PARAMETER (MSTP = 20)
      INTEGER IW(8), IC, IS, N, K(MSTP, 4), INFO, I
      DOUBLE PRECISION A(MSTP, 3), TAKN(5)
      CALL FSTAKN(IW, TAKN, INFO)
      IF (INFO .NE. 0) STOP 12
      CALL PUT('n_steps', IC, IS, 0, TAKN(1))
      CALL PUT('best_step', IC, IS, 0, TAKN(2))
      CALL PUT('est_err_target', IC, IS, 0, TAKN(3))
      CALL PUT('target_is_known', IC, IS, 0, TAKN(4))
      CALL PUT('target_is_met', IC, IS, 0, TAKN(5))
      CALL FSSTEP(IW, MSTP, N, K(1, 1), K(1, 2), K(1, 3), K(1, 4),
     &  A(1, 1), A(1, 2), A(1, 3), INFO)
      IF (INFO .NE. 0) STOP 13
      DO 10 I = 1, N
        CALL PUT('step_normal', IC, IS, I, DBLE(K(I, 1)))
        CALL PUT('step_tangential', IC, IS, I, DBLE(K(I, 2)))
        CALL PUT('step_strips', IC, IS, I, DBLE(K(I, 3)))
        CALL PUT('step_points', IC, IS, I, DBLE(K(I, 4)))
        CALL PUT('step_estimate', IC, IS, I, A(I, 1))
        IF (A(I, 2) .LE. 0D0 .OR. A(I, 3) .LT. 0D0) STOP 14
   10 CONTINUE
      END
      SUBROUTINE ARRAYS(IW, IC, IS)
      INTEGER MOST
      PARAMETER (MOST = 20000)
      INTEGER IW(8), IC, IS, N, K(MOST), INFO, I
      DOUBLE PRECISION A(MOST, 8)
      SAVE A, K
      CALL FSSTRP(IW, MOST, N, A(1, 1), A(1, 2), A(1, 3), A(1, 4), K,
     &  INFO)
      IF (INFO .NE. 0) STOP 6
      CALL PUT('n_strips', IC, IS, 0, DBLE(N))
      DO 10 I = 1, N
        CALL PUT('strip_y_left', IC, IS, I, A(I, 1))
        CALL PUT('strip_y_right', IC, IS, I, A(I, 2))
        CALL PUT('strip_half_length', IC, IS, I, A(I, 3))
        CALL PUT('strip_p0', IC, IS, I, A(I, 4))
        CALL PUT('strip_patch', IC, IS, I, DBLE(K(I)))
   10 CONTINUE
      CALL FSELEM(IW, MOST, N, A(1, 1), A(1, 2), A(1, 3), A(1, 4),
     &  A(1, 5), A(1, 6), A(1, 7), A(1, 8), K, INFO)
      IF (INFO .NE. 0) STOP 7
      IF (IS .NE. 2) CALL PUT('n_elements', IC, IS, 0, DBLE(N))
      DO 20 I = 1, N
        CALL PUT('element_x', IC, IS, I, A(I, 1))
        CALL PUT('element_y', IC, IS, I, A(I, 2))
        CALL PUT('element_area', IC, IS, I, A(I, 3))
        CALL PUT('element_pn', IC, IS, I, A(I, 4))
        CALL PUT('element_px', IC, IS, I, A(I, 5))
        CALL PUT('element_py', IC, IS, I, A(I, 6))
        CALL PUT('element_sx', IC, IS, I, A(I, 7))
        CALL PUT('element_sy', IC, IS, I, A(I, 8))
        CALL PUT('element_state', IC, IS, I, DBLE(K(I)))
   20 CONTINUE
      END
      SUBROUTINE PUT(NAME, IC, IS, I, VALUE)
      CHARACTER*(*) NAME
      INTEGER IC, IS, I
      DOUBLE PRECISION VALUE
      WRITE (*, '(A, 3(1X, I5), 1P, E26.17E3)') NAME, IC, IS, I, VALUE
      END
