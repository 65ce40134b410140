!> Numbers by which wear and rolling contact fatigue are judged: T gamma, without and with spin,
!> over the area, of a contact and of each strip; the surface-fatigue index.
!>
!>     T gamma            |Fx cksi| + |Fy ceta|                 N: J per metre rolled
!>     T gamma with spin  |Fx cksi| + |Fy ceta| + |Mz cphi|
!>     FI_surf            sqrt(Fx^2 + Fy^2)/N - 2 A k/(3 N)
!>
!> The sums are of magnitudes, as vehicle codes print them: never negative, and with spin they
!> depend on the reference point. The sum with signs, `-(Fx cksi + Fy ceta + Mz cphi)`, does not,
!> and in steady rolling it is the friction power of the contact, `friction_power`: elastic slip
!> gives back what it takes. The friction power is what the strips share.
!>
!> FI_surf: A. Ekberg, E. Kabo, H. Andersson, An engineering model for prediction of rolling
!> contact fatigue of railway wheels, Fatigue Fract. Engng Mater. Struct. 25 (2002) 899-909. Theirs
!> is `2 pi a b k/(3 N)`, k over the maximum pressure of the ellipse; the area A stands for pi a b.
module faststrip_tangential_wear_numbers
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, &
                                     st_bad_argument, st_workspace_too_small
    use faststrip_base_creepage, only: creepage_t
    use faststrip_normal_strips, only: contact_strips_t
    use faststrip_tangential_types, only: tangential_result_t, strip_forces_t
    implicit none
    private

    public :: t_gamma, t_gamma_with_spin, surface_fatigue_index
    public :: strip_areas, strip_power_densities

contains

    !> T gamma without spin, N.
    elemental real(wp) function t_gamma(forces, creepage)
        type(tangential_result_t), intent(in) :: forces !! N
        type(creepage_t), intent(in) :: creepage        !! about the reference point of `forces`

        t_gamma = abs(forces%fx*creepage%cksi) + abs(forces%fy*creepage%ceta)
    end function t_gamma

    !> T gamma with spin, N.
    elemental real(wp) function t_gamma_with_spin(forces, creepage)
        type(tangential_result_t), intent(in) :: forces !! N, N mm
        type(creepage_t), intent(in) :: creepage        !! about the reference point of `forces`

        t_gamma_with_spin = t_gamma(forces, creepage) + abs(forces%mz*creepage%cphi)
    end function t_gamma_with_spin

    !> Surface-fatigue index: above 0 the traction coefficient lies beyond elastic shakedown.
    elemental real(wp) function surface_fatigue_index(forces, load, area, yield_shear) &
            result(fatigue)
        type(tangential_result_t), intent(in) :: forces !! N
        real(wp), intent(in) :: load        !! normal force, N, > 0
        real(wp), intent(in) :: area        !! contact area, mm^2
        real(wp), intent(in) :: yield_shear !! yield stress in cyclic shear, k, MPa

        fatigue = (hypot(forces%fx, forces%fy) - 2.0_wp*area*yield_shear/3.0_wp)/load
    end function surface_fatigue_index

    !> Area of each strip, mm^2.
    pure subroutine strip_areas(strips, areas, status)
        type(contact_strips_t), intent(in) :: strips !! a normal solution
        real(wp), intent(out) :: areas(:)    !! the first `strips%n` count, the others are 0
        type(status_t), intent(out) :: status !! `st_workspace_too_small`

        areas = 0.0_wp
        call clear_status(status)
        if (size(areas) < strips%n) then
            call set_status(status, st_workspace_too_small, 'too little capacity for the strips')
            return
        end if
        areas(:strips%n) = 2.0_wp*strips%half_length(:strips%n) &
                           *(strips%y_right(:strips%n) - strips%y_left(:strips%n))
    end subroutine strip_areas

    !> T gamma over the area of each strip, N/mm^2: its friction power over its area.
    pure subroutine strip_power_densities(strips, forces, densities, status)
        type(contact_strips_t), intent(in) :: strips !! a normal solution
        type(strip_forces_t), intent(in) :: forces   !! of the same strips
        real(wp), intent(out) :: densities(:) !! the first `strips%n` count, the others are 0
        type(status_t), intent(out) :: status
            !! `st_workspace_too_small`; `st_bad_argument`: forces of other strips

        integer :: k

        call strip_areas(strips, densities, status)
        if (is_error(status)) return
        if (forces%n /= strips%n) then
            call set_status(status, st_bad_argument, 'the forces must be those of the strips')
            return
        end if
        do k = 1, strips%n
            ! A strip without length bears nothing.
            if (densities(k) > 0.0_wp) then
                densities(k) = forces%friction_power(k)/densities(k)
            else
                densities(k) = 0.0_wp
            end if
        end do
    end subroutine strip_power_densities
end module faststrip_tangential_wear_numbers
