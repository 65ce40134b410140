!> Only the model a contact requires: the cheapest method whose expected error meets a target.
!>
!> What is expected was measured on contacts of many kinds (`tools/choice_table.py`): a base that
!> depends on how far the contact is from linear and how much it spins, and an excess that depends
!> on how far its gap is from a parabola; 95 of 100 contacts stay below their sum. Methods that
!> need more than the embeddable core (Kalker's variational ones) are left to the caller where
!> none of the core's is good enough.
module faststrip_contact_choice
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, set_status, clear_status, number_text, count_text, &
                                     st_bad_argument, st_target_missed
    use faststrip_contact_methods, only: contact_methods_t
    use faststrip_contact_choice_table, only: misfit_edges, saturation_edges, spin_edges, &
                                              forces_methods, forces_base, forces_excess, &
                                              pmax_methods, pmax_excess, penetration_methods, &
                                              penetration_excess
    use faststrip_contact_indicators, only: indicators_t
    implicit none
    private

    public :: choose_methods, target_forces, target_pmax, target_penetration

    ! Given: numbers of kinds.
    integer, parameter :: target_forces = 1      !! Fx and Fy together, over mu N
    integer, parameter :: target_pmax = 2        !! largest pressure, relative
    integer, parameter :: target_penetration = 3 !! relative

contains

    !> Choose the cheapest method whose expected error is within a tolerance.
    pure subroutine choose_methods(indicators, target, tolerance, methods, expected, status)
        type(indicators_t), intent(in) :: indicators    !! of the contact
        integer, intent(in) :: target                   !! one of the `target_` numbers
        real(wp), intent(in) :: tolerance               !! largest error wanted, > 0
        type(contact_methods_t), intent(out) :: methods !! the choice
        real(wp), intent(out) :: expected               !! error expected of it
        type(status_t), intent(out) :: status
            !! `st_bad_argument`; limitation `st_target_missed`: none is expected to be good
            !! enough, the best is chosen

        integer :: misfit, force

        expected = 0.0_wp
        call clear_status(status)
        if (.not. ieee_is_finite(tolerance)) then
            call set_status(status, st_bad_argument, 'the tolerance must be a finite number, ' &
                            // 'got ' // trim(number_text(tolerance)))
            return
        else if (tolerance <= 0.0_wp) then
            call set_status(status, st_bad_argument, 'the tolerance must be above 0, got ' &
                            // trim(number_text(tolerance)))
            return
        end if
        misfit = bin(indicators%misfit, misfit_edges)
        force = 1 + (size(spin_edges) + 1)*(bin(indicators%saturation, saturation_edges) - 1) &
                + bin(indicators%spin_share, spin_edges) - 1
        select case (target)
        case (target_forces)
            call take(forces_methods, forces_base(force, :) + forces_excess(misfit, :), tolerance, &
                      methods, expected, status)
        case (target_pmax)
            call take(pmax_methods, pmax_excess(misfit, :), tolerance, methods, expected, status)
        case (target_penetration)
            call take(penetration_methods, penetration_excess(misfit, :), tolerance, methods, &
                      expected, status)
        case default
            call set_status(status, st_bad_argument, 'the target of a choice must be ' &
                            // 'forces, pmax or penetration, got ' // count_text(target))
        end select
    end subroutine choose_methods

    !> The first of the choices that is good enough, or the best.
    pure subroutine take(choices, errors, tolerance, methods, expected, status)
        type(contact_methods_t), intent(in) :: choices(:)
        real(wp), intent(in) :: errors(:), tolerance
        type(contact_methods_t), intent(out) :: methods
        real(wp), intent(out) :: expected
        type(status_t), intent(inout) :: status

        integer :: k

        k = findloc(errors <= tolerance, .true., dim=1)
        if (k == 0) then
            k = minloc(errors, dim=1)
            call set_status(status, st_target_missed, 'no method of the core is expected to ' // &
                            'meet the tolerance: the best of them is expected to be wrong by ' &
                            // trim(number_text(errors(k))))
        end if
        methods = choices(k)
        expected = errors(k)
    end subroutine take

    !> The bin of a value, 1 to size(edges) + 1.
    pure integer function bin(value, edges)
        real(wp), intent(in) :: value, edges(:)

        bin = 1 + count(value >= edges)
    end function bin
end module faststrip_contact_choice
