!> The largest von Mises stress below loads, and where: inside the body it is sought from points on
!> several depths, on the surface at the middles of the loads.
module faststrip_stress_peak
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_limits, only: most_halvings
    use faststrip_stress_invariants, only: von_mises
    use faststrip_stress_loads, only: loads_t, find_stress, same_row
    use faststrip_stress_rectangle, only: n_stresses
    implicit none
    private

    public :: peak_t, find_peak

    ! Tuned [loads]: below which the search begins, and on which surface points lie. Origin: chosen
    ! for the time; twice as many find the same on Hertz's ellipses.
    integer, parameter :: most_starts = 32, most_middles = 256
    ! Tuned [1]: ratio of depths, and that of the last step to the depth. Origin: chosen; the
    ! maximum is flat: a step of this part changes it by the sixth digit.
    real(wp), parameter :: deeper = 1.7_wp, last_step = 1.0e-3_wp
    ! Tuned [1]: part of the largest pressure from which on a maximum is sought below. Origin:
    ! chosen; the maximum of a patch goes with its pressure.
    real(wp), parameter :: telling = 0.5_wp
    ! Tuned [1]: relative error of the maximum inside over the area of the load above it per squared
    ! depth. Origin: Hertz's ellipses with axes of 1 to 4, in 13 to 51 elements and 15 to 31 strips:
    ! 0.02 to 0.054.
    real(wp), parameter :: error_inside = 0.06_wp
    ! Tuned [1]: relative error of that on the surface over the side of a load per half-width of
    ! all. Origin: the same, sliding.
    real(wp), parameter :: error_surface = 0.05_wp
    ! Tuned [1]: what the surface bears between middles of loads beyond that which bears most, over
    ! what the neighbour bears less. Origin: ellipses that slide in part, axes 0.5 to 2.5, mu 0.2 to
    ! 0.6, 11 to 31 elements; 0.25 holds of 1 % fewer, 0.35 of 1 % more.
    real(wp), parameter :: between = 0.3_wp
    ! Tuned [1]: what the rim bears at most beyond the largest at a middle, over that, per root of
    ! the side of a load over the half-width. Origin: the same; 0.3 holds of 3 % fewer where the
    ! largest is inside, 0.5 of 1 % more, at a quarter more.
    real(wp), parameter :: steepest = 0.4_wp

    !> The largest von Mises stress.
    type :: peak_t
        real(wp) :: von_mises = 0.0_wp !! MPa
        real(wp) :: x = 0.0_wp, y = 0.0_wp, z = 0.0_wp !! where it is, mm
        real(wp) :: est_err = 0.0_wp
            !! its estimated relative error by the size of the loads; what the surface may bear more
            !! than their middles counts
        logical :: is_known = .false.  !! are there loads?
    end type peak_t

contains

    !> Find it. Above half a side of the loads a stress is known at their middles alone, so between
    !> that depth and the surface none is sought.
    pure subroutine find_peak(loads, nu, peak)
        type(loads_t), intent(in) :: loads  !! any number
        real(wp), intent(in) :: nu          !! Poisson's ratio of the body
        type(peak_t), intent(out) :: peak   !! unknown without loads

        type(peak_t) :: surface
        real(wp) :: area, side, least, largest, limit, z
        integer :: i, k, best

        associate (n => loads%n, p => loads%traction(1, :))
            if (n == 0) return
            area = sum(loads%dx(:n)*loads%dy(:n))
            side = sqrt(area/n)
            least = 0.5_wp*side
            largest = max(sqrt(area/pi), deeper*least)
            best = maxloc(p(:n), dim=1)
            do k = 0, min(n, most_starts)
                i = merge(best, spread_out(k, n, most_starts), k == 0)
                if (p(i) < telling*p(best)) cycle
                z = least
                do while (z <= largest)
                    call try_point(loads, nu, loads%x(i), loads%y(i), z, peak)
                    z = deeper*z
                end do
            end do
            call climb(loads, nu, least, peak)
            i = minloc(hypot(loads%x(:n) - peak%x, loads%y(:n) - peak%y), dim=1)
            peak%est_err = error_inside*loads%dx(i)*loads%dy(i)/peak%z**2
            do k = 1, min(n, most_middles)
                call try_middle(loads, nu, spread_out(k, n, most_middles), best, surface)
            end do
        end associate
        do
            i = best
            if (i > 1) call try_middle(loads, nu, i - 1, best, surface)
            if (i < loads%n) call try_middle(loads, nu, i + 1, best, surface)
            if (i == best) exit
        end do
        surface%est_err = error_surface*side/largest
        limit = surface_limit(loads, nu, best, surface%von_mises, &
                             (1.0_wp + steepest*sqrt(side/largest))*surface%von_mises)
        if (surface%von_mises > peak%von_mises) peak = surface
        peak%est_err = max(peak%est_err, limit/peak%von_mises - 1.0_wp)
        peak%is_known = .true.
    end subroutine find_peak

    !> The k-th of most places among n that are spread out: multiples of the golden section, which
    !> do not fall into step with rows.
    pure integer function spread_out(k, n, most)
        integer, intent(in) :: k, n, most

        ! Given: the golden section, (sqrt(5) - 1)/2.
        real(wp), parameter :: golden = 0.618033988749894848204586834365638118_wp

        spread_out = k
        if (n > most) spread_out = 1 + int(n*modulo(k*golden, 1.0_wp))
    end function spread_out

    !> Take a point if it bears more.
    pure subroutine try_point(loads, nu, x, y, z, peak)
        type(loads_t), intent(in) :: loads
        real(wp), intent(in) :: nu, x, y, z
        type(peak_t), intent(inout) :: peak

        real(wp) :: stress(n_stresses), equivalent

        call find_stress(loads, nu, x, y, z, stress)
        equivalent = von_mises(stress)
        if (.not. equivalent > peak%von_mises) return
        peak%von_mises = equivalent
        peak%x = x
        peak%y = y
        peak%z = z
    end subroutine try_point

    !> Take the middle of a load if it bears more.
    pure subroutine try_middle(loads, nu, i, best, peak)
        type(loads_t), intent(in) :: loads
        real(wp), intent(in) :: nu
        integer, intent(in) :: i
        integer, intent(inout) :: best ! number of the load
        type(peak_t), intent(inout) :: peak

        real(wp) :: before

        before = peak%von_mises
        call try_point(loads, nu, loads%x(i), loads%y(i), 0.0_wp, peak)
        if (peak%von_mises > before) best = i
    end subroutine try_middle

    !> Climb to the maximum beside a point: steps along the axes, halved where none leads up.
    pure subroutine climb(loads, nu, least, peak)
        type(loads_t), intent(in) :: loads
        real(wp), intent(in) :: nu, least ! least depth, mm
        type(peak_t), intent(inout) :: peak

        real(wp) :: step, before
        integer :: halvings, sign

        step = 0.5_wp*peak%z
        do halvings = 1, most_halvings
            do
                before = peak%von_mises
                do sign = -1, 1, 2
                    call try_point(loads, nu, peak%x + sign*step, peak%y, peak%z, peak)
                    call try_point(loads, nu, peak%x, peak%y + sign*step, peak%z, peak)
                    if (peak%z + sign*step >= least) &
                        call try_point(loads, nu, peak%x, peak%y, peak%z + sign*step, peak)
                end do
                if (.not. peak%von_mises > before) exit
            end do
            if (step <= last_step*peak%z) return
            step = 0.5_wp*step
        end do
    end subroutine climb

    !> What a row may bear on the surface at most, where the middles of its loads do not tell.
    !>
    !> Between two of them more than both: a part of how much less the lesser neighbour bears. Where
    !> the row ends the pressure falls with infinite slope, which no element resolves. What the rim
    !> bears is estimated from each end of the row: what the pressure does, from the second and
    !> third element, linearly in their pressures, down to none; what tractions do, from the third
    !> and fifth, linearly in x. Where a patch slides over less than these that is too much.
    pure real(wp) function surface_limit(loads, nu, i, found, cap) result(limit)
        type(loads_t), intent(in) :: loads
        real(wp), intent(in) :: nu
        integer, intent(in) :: i      ! the load on the surface that bears most
        real(wp), intent(in) :: found ! what it bears, MPa
        real(wp), intent(in) :: cap   ! no rim bears more, MPa

        ! Given: the elements that are taken, from the rim, and places over a side.
        integer, parameter :: inner(4) = [1, 2, 2, 4]
        real(wp), parameter :: beyond = (inner(3) + 0.5_wp)/(inner(4) - inner(3))
        real(wp) :: s(n_stresses, 4), p(4), share(3)
        integer :: first, last, turn, k, j

        first = i
        do while (first > 1)
            if (.not. follows(loads, first - 1)) exit
            first = first - 1
        end do
        last = i
        do while (last < loads%n)
            if (.not. follows(loads, last)) exit
            last = last + 1
        end do
        limit = found
        do j = max(first, i - 1), min(last, i + 1)
            call find_stress(loads, nu, loads%x(j), loads%y(j), 0.0_wp, s(:, 1))
            limit = max(limit, found + between*(found - von_mises(s(:, 1))))
        end do
        if (last - first < 2*inner(4)) return
        do turn = 1, 2
            do k = 1, 4
                j = merge(first + inner(k), last - inner(k), turn == 1)
                share = merge([1, 0, 0], [0, 1, 1], k <= 2)
                call find_stress(loads, nu, loads%x(j), loads%y(j), 0.0_wp, s(:, k), share)
                p(k) = loads%traction(1, j)
            end do
            if (p(2) > p(1)) limit = max(limit, min(cap, &
                von_mises(s(:, 1) - p(1)/(p(2) - p(1))*(s(:, 2) - s(:, 1)) &
                          + s(:, 3) - beyond*(s(:, 4) - s(:, 3)))))
        end do
    end function surface_limit

    !> Does the load after this one go on with its row?
    pure logical function follows(loads, i)
        type(loads_t), intent(in) :: loads
        integer, intent(in) :: i

        follows = same_row(loads, i, 1.0_wp) .or. same_row(loads, i, -1.0_wp)
    end function follows
end module faststrip_stress_peak
