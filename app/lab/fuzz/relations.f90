!> What the answers to two related contacts have to do with each other.
!>
!> Each relation changes the case (`related_case`) and says how the figures change with it
!> (`check_relation`).
module faststrip_lab_fuzz_relations
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: is_error, st_ok
    use faststrip_geometry_gap_curve, only: gap_curve_t
    use faststrip_normal_types, only: normal_result_t
    use faststrip_lab_fuzz_cases, only: fuzz_case_t
    use faststrip_lab_fuzz_checks, only: verdict_t, report_badness, check_mirror, check_scale, &
                                         check_stiffness, check_monotone, check_wall
    implicit none
    private

    public :: relations, related_case, check_relation

    !> The checks that need a second solution.
    integer, parameter :: relations(5) = [check_mirror, check_scale, check_stiffness, &
                                          check_monotone, check_wall]

    real(wp), parameter :: same = 1.0e-9_wp          ! relative
    real(wp), parameter :: same_behind = 1.0e-6_wp   ! relative, where a wall is added: Newton's
                                                     ! steps may differ
    real(wp), parameter :: length_factor = 8.0_wp, stiffness_factor = 2.0_wp
    real(wp), parameter :: load_factor = 1.02_wp
    real(wp), parameter :: least_slack = 2.0e-3_wp   ! of the penetration, where the load changes
    real(wp), parameter :: wall_height = 10.0_wp     ! over the penetration
    ! Points between the contact and a wall: what the spline feels of it falls by 2 + sqrt(3) from
    ! each to the next, from the wall's 10 penetrations to 7e-9 over so many. (Over 12 it falls to
    ! 1.4e-6, more than the answers may differ by.)
    integer, parameter :: points_between = 16

contains

    !> The case that a relation is about.
    subroutine related_case(relation, case, curve, result, other, has_one)
        integer, intent(in) :: relation            !! one of `relations`
        type(fuzz_case_t), intent(in) :: case
        type(gap_curve_t), intent(in) :: curve     !! of its gap
        type(normal_result_t), intent(in) :: result !! its solution
        type(fuzz_case_t), intent(out) :: other
        logical, intent(out) :: has_one            !! is there such a case?

        real(wp) :: depth
        integer :: n, first, last

        other = case
        has_one = .true.
        n = size(case%gap%y)
        select case (relation)
        case (check_mirror)
            other%gap%y = -case%gap%y(n:1:-1)
            other%gap%h = case%gap%h(n:1:-1)
            other%gap%inv2r = case%gap%inv2r(n:1:-1)
        case (check_scale)
            other%gap%y = length_factor*case%gap%y
            other%gap%h = length_factor*case%gap%h
            other%gap%inv2r = case%gap%inv2r/length_factor
            other%load = length_factor**2*case%load
        case (check_stiffness)
            other%material%e_wheel = stiffness_factor*case%material%e_wheel
            other%material%e_rail = stiffness_factor*case%material%e_rail
            other%load = stiffness_factor*case%load
        case (check_monotone)
            other%load = load_factor*case%load
        case (check_wall)
            ! Behind all that is below the penetration and behind all patches: one may lie in a dip
            ! between two points that are both above it.
            depth = result%penetration - curve%h_lowest
            first = 1
            last = n
            do while (first < n)
                if (case%gap%h(first) < result%penetration + depth &
                    .or. case%gap%y(first + 1) > result%y_min) exit
                first = first + 1
            end do
            do while (last > 1)
                if (case%gap%h(last) < result%penetration + depth &
                    .or. case%gap%y(last - 1) < result%y_max) exit
                last = last - 1
            end do
            first = first - points_between
            last = last + points_between
            has_one = first >= 1 .or. last <= n
            if (.not. has_one) return
            if (first >= 1) other%gap%h(:first) = case%gap%h(:first) + wall_height*depth
            if (last <= n) other%gap%h(last:) = case%gap%h(last:) + wall_height*depth
        end select
    end subroutine related_case

    !> Compare the answers; the status words have to be the same too.
    subroutine check_relation(relation, verdict, curve, other, other_curve)
        integer, intent(in) :: relation          !! one of `relations`
        type(verdict_t), intent(inout) :: verdict !! of the case
        type(gap_curve_t), intent(in) :: curve    !! of the case's gap
        type(verdict_t), intent(in) :: other      !! of the related one
        type(gap_curve_t), intent(in) :: other_curve

        real(wp) :: depth, other_depth, slack, ratio

        if (is_error(other%status)) then
            call report_badness(verdict, relation, huge(1.0_wp))
            return
        end if
        depth = verdict%result%penetration - curve%h_lowest
        other_depth = other%result%penetration - other_curve%h_lowest
        select case (relation)
        case (check_mirror)
            call compare(1.0_wp, 1.0_wp, -other%result%y_max, -other%result%y_min, same)
        case (check_scale)
            call compare(length_factor, 1.0_wp, other%result%y_min/length_factor, &
                         other%result%y_max/length_factor, same)
        case (check_stiffness)
            call compare(1.0_wp, stiffness_factor, other%result%y_min, other%result%y_max, same)
        case (check_wall)
            call compare(1.0_wp, 1.0_wp, other%result%y_min, other%result%y_max, same_behind)
        case (check_monotone)
            ! The load grows with the penetration, ever more steeply: D is concave in Q.
            slack = least_slack + max(verdict%est_err(1), other%est_err(1))
            ratio = other_depth/depth
            call report_badness(verdict, relation, max(1.0_wp - ratio, ratio - load_factor)/slack)
        end select
        if (relation == check_monotone) return
        ! One that is ok must stay so. Whether patches converge may turn on the rounding: then the
        ! answer
        ! has a limitation, as has the other, and both agree as their estimates say.
        if ((verdict%status%code == st_ok) .neqv. (other%status%code == st_ok)) then
            if (verdict%status%code == st_ok .or. relation /= check_wall) &
                call report_badness(verdict, relation, huge(1.0_wp))
        end if

    contains

        subroutine compare(length, pressure, y_min, y_max, tolerance)
            real(wp), intent(in) :: length, pressure ! how they grow
            real(wp), intent(in) :: y_min, y_max     ! of the other, as they should be
            real(wp), intent(in) :: tolerance

            real(wp) :: width, change, estimates(3)

            width = verdict%result%y_max - verdict%result%y_min
            estimates = verdict%est_err + other%est_err
            associate (a => verdict%result, b => other%result)
                if (verdict%status%code /= st_ok .and. other%status%code /= st_ok) then
                    call report_badness(verdict, relation, max( &
                        over(other_depth/(length*depth), tolerance, estimates(1)), &
                        over(b%pmax/(pressure*a%pmax), tolerance, estimates(2)), &
                        over(b%area/(length**2*a%area), tolerance, estimates(3))))
                    return
                end if
                change = max(abs(other_depth/(length*depth) - 1.0_wp), &
                             abs(b%pmax/(pressure*a%pmax) - 1.0_wp), &
                             abs(b%area/(length**2*a%area) - 1.0_wp), &
                             abs(b%x_max/(length*a%x_max) - 1.0_wp), &
                             abs(b%load/(length**2*pressure*a%load) - 1.0_wp), &
                             max(abs(y_min - a%y_min), abs(y_max - a%y_max))/width)
            end associate
            call report_badness(verdict, relation, change/tolerance)
        end subroutine compare

        !> A ratio's distance from one, over what is allowed; the larger of two may be far off.
        pure real(wp) function over(ratio, tolerance, estimate)
            real(wp), intent(in) :: ratio, tolerance, estimate

            over = abs(ratio - 1.0_wp)/max(ratio, 1.0_wp)/max(tolerance, estimate)
        end function over
    end subroutine check_relation
end module faststrip_lab_fuzz_relations
