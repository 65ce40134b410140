!> Error estimates of the lattice's answer: from two lattices, and from what the last cannot see.
!>
!> The last lattice and the one before lie over ranges of different widths: their cells differ in
!> width, in length and in place. Of what the two solutions differ by the errors are a part. Both
!> miss what is narrower than a cell. That shows in the gap between the deformed surfaces at the
!> cells' edges: closing it takes a wave of pressure, of the amplitude e/(2 H w) over a width w.
!> And a patch may end anywhere in its last cell.
!>
!>     penetration   2 |difference| + 0.2/n^2 + 0.03 mean wave
!>     pmax          1.2 |difference| + 1/n^2 + 1.1 largest wave where p0 > pmax/2
!>     area          3.3 |difference| + 0.9 (area of the strips at the ends)
!>
!> each over the value itself or pmax, n the strips of the patch with the maximum pressure. The
!> factors were calibrated on random gaps, solved by strips and by falling back, against NORM.
module faststrip_normal_cells_estimate
    use faststrip_base_kinds, only: wp
    use faststrip_normal_strips, only: contact_strips_t
    implicit none
    private

    public :: lattice_errors_t, lattice_figures_t, lattice_figures, estimate_errors

    !> Estimated relative errors of a lattice's answer.
    type :: lattice_errors_t
        logical :: is_known = .false.            !! was there such an answer?
        real(wp) :: est_err_penetration = 0.0_wp !! of D - h_lowest, relative, not negative
        real(wp) :: est_err_pmax = 0.0_wp        !! relative, not negative
        real(wp) :: est_err_area = 0.0_wp        !! relative, not negative
    end type lattice_errors_t

    !> What two lattices are compared by.
    type :: lattice_figures_t
        real(wp) :: depth = 0.0_wp !! penetration above the lowest height, mm
        real(wp) :: pmax = 0.0_wp  !! MPa
        real(wp) :: area = 0.0_wp  !! mm2
        integer :: across = 0      !! strips of the patch with the maximum pressure
        ! Tuned [1]: Of the area, by the cells at the ends. Origin: calibrated on random gaps, see
        ! the module's head.
        real(wp) :: ends = 0.0_wp  !! area of the strips at the ends of patches, mm2
    end type lattice_figures_t

    ! Of penetration, pmax and area; with half of them every second estimate is too small.
    ! Tuned [1]: Factors of the estimates, see the module's head. Origin: calibrated on random gaps,
    ! see the module's head.
    real(wp), parameter :: difference(3) = [2.0_wp, 1.2_wp, 3.3_wp]
    ! Tuned [1]: Of penetration and pmax: by cells, and by waves. Origin: calibrated on random gaps,
    ! see the module's head.
    real(wp), parameter :: smooth(2) = [0.2_wp, 1.0_wp], waves(2) = [0.03_wp, 1.1_wp]
    ! Tuned [1]: Of the area, by the cells at the ends. Origin: calibrated on random gaps, see the
    ! module's head.
    real(wp), parameter :: ends = 0.9_wp
    ! Tuned [1]. Origin: chosen, see the module's head.
    real(wp), parameter :: high_pressure = 0.5_wp ! of pmax: a wave there counts for it

contains

    !> The figures of one lattice.
    pure type(lattice_figures_t) function lattice_figures(strips, depth) result(figures)
        type(contact_strips_t), intent(in) :: strips !! those that press
        real(wp), intent(in) :: depth                !! penetration above the lowest height, mm

        integer :: peak, k

        associate (n => strips%n)
            peak = maxloc(strips%p0(:n), dim=1)
            figures%depth = depth
            figures%pmax = strips%p0(peak)
            figures%area = 2.0_wp*sum(strips%half_length(:n) &
                                      *(strips%y_right(:n) - strips%y_left(:n)))
            figures%across = count(strips%patch(:n) == strips%patch(peak))
            do k = 1, n
                if (is_end(strips, k)) figures%ends = figures%ends + 2.0_wp*strips%half_length(k) &
                                                      *(strips%y_right(k) - strips%y_left(k))
            end do
        end associate
    end function lattice_figures

    !> Errors of a lattice's answer.
    pure type(lattice_errors_t) function estimate_errors(before, last, strips, wave) result(errors)
        type(lattice_figures_t), intent(in) :: before !! of the lattice before
        type(lattice_figures_t), intent(in) :: last   !! the errors are its
        type(contact_strips_t), intent(in) :: strips  !! of the last
        real(wp), intent(in) :: wave(:) !! pressure that closes the gap at the edges, (n), MPa

        real(wp) :: missed, mean_wave, top_wave
        integer :: k

        missed = 1.0_wp/real(last%across, wp)**2
        associate (n => strips%n)
            mean_wave = sum(wave(:n)*(strips%y_right(:n) - strips%y_left(:n))) &
                        /sum(strips%y_right(:n) - strips%y_left(:n))/last%pmax
            top_wave = 0.0_wp
            do k = 1, n
                if (strips%p0(k) > high_pressure*last%pmax) &
                    top_wave = max(top_wave, wave(k)/last%pmax)
            end do
        end associate
        errors%is_known = .true.
        errors%est_err_penetration = difference(1)*abs(before%depth - last%depth)/last%depth &
                                     + smooth(1)*missed + waves(1)*mean_wave
        errors%est_err_pmax = difference(2)*abs(before%pmax - last%pmax)/last%pmax &
                              + smooth(2)*missed + waves(2)*top_wave
        errors%est_err_area = difference(3)*abs(before%area - last%area)/last%area &
                              + ends*last%ends/last%area
    end function estimate_errors

    !> Is a strip the first or the last of its patch?
    pure logical function is_end(strips, k)
        type(contact_strips_t), intent(in) :: strips
        integer, intent(in) :: k

        is_end = k == 1 .or. k == strips%n
        if (.not. is_end) is_end = strips%patch(k) /= strips%patch(k - 1) &
                                   .or. strips%patch(k) /= strips%patch(k + 1)
    end function is_end
end module faststrip_normal_cells_estimate
