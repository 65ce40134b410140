!> The error estimate of the wanted figure of a solution.
module faststrip_contact_target
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_status, only: status_t, set_status, add_limitation, join_limitations, &
                                     number_text, add_words, message_length, st_target_missed, &
                                     st_under_resolved
    use faststrip_contact_case, only: contact_case_t
    use faststrip_contact_method, only: contact_result_t
    use faststrip_contact_wanted, only: unknown_error, target_forces, target_pmax, &
                                        target_penetration, target_area, target_power, &
                                        target_names, wanted_t, needs_forces
    implicit none
    private

    public :: target_error, name_target

contains

    !> The estimated error of the wanted figure; `unknown_error` where it is not known.
    pure real(wp) function target_error(target, case, result) result(error)
        integer, intent(in) :: target                !! one of the `target_` numbers
        type(contact_case_t), intent(in) :: case     !! what was solved
        type(contact_result_t), intent(in) :: result !! with its estimates

        error = unknown_error
        if (.not. result%is_estimated) return
        if (needs_forces(target) .and. .not. result%forces_are_estimated) return
        associate (normal_errors => result%normal_errors, errors => result%force_errors)
            select case (target)
            case (target_forces)
                error = max(errors%fx, errors%fy, errors%mz)
            case (target_pmax)
                error = normal_errors%est_err_pmax
            case (target_penetration)
                error = normal_errors%est_err_penetration
            case (target_area)
                error = normal_errors%est_err_area
            case (target_power)
                error = power_error(case, result)
            end select
        end associate
        if (.not. ieee_is_finite(error)) error = unknown_error
    end function target_error

    !> Of the friction power, what the creepages feed into the forces: relative.
    pure real(wp) function power_error(case, result) result(error)
        type(contact_case_t), intent(in) :: case
        type(contact_result_t), intent(in) :: result

        associate (errors => result%force_errors, c => result%creepage, normal => result%normal, &
                   power => result%tangential%friction_power)
            error = (abs(c%cksi)*errors%fx + abs(c%ceta)*errors%fy &
                     + abs(c%cphi)*errors%mz*sqrt(normal%area/pi))*result%mu*normal%load
            if (error <= 0.0_wp) return
            if (power > error*tiny(error)) then
                error = error/power
            else
                error = unknown_error
            end if
        end associate
    end function power_error

    !> Say that the estimate is above the tolerance, before all other limitations; or, where there
    !> is none, above the limit of what is resolved, behind them.
    pure subroutine name_target(wanted, estimate, limit, status)
        type(wanted_t), intent(in) :: wanted    !! target and tolerance
        real(wp), intent(in) :: estimate        !! of its error
        real(wp), intent(in) :: limit           !! largest error that is called resolved
        type(status_t), intent(inout) :: status !! limitations so far, no error

        type(status_t) :: before
        character(len=message_length) :: words
        real(wp) :: most

        most = wanted%tolerance
        if (most <= 0.0_wp) most = limit
        if (estimate <= most) return
        words = 'the estimated error of the target, ' // target_names(wanted%target)
        if (estimate < unknown_error) then
            call add_words(words, ', is '//number_text(estimate))
        else
            call add_words(words, ', is not known')
        end if
        call add_words(words, ': the largest wanted is '//number_text(most))
        if (wanted%tolerance > 0.0_wp) then
            before = status
            call set_status(status, st_target_missed, words)
            call join_limitations(status, before)
        else
            call add_limitation(status, st_under_resolved, words)
        end if
    end subroutine name_target
end module faststrip_contact_target
