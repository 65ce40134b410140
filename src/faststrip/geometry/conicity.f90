!> Equivalent conicity of a wheelset on a track, from its rolling radius difference.
!>
!> Delta r is the rolling radius on the side to which y points less that on the other side, over
!> the lateral displacement y of the wheelset, linear between the points of a table. By Klingel's
!> equation, y'' = -delta r(y)/(e r0) over the way (e between the rolling circles, r0 their
!> radius), the wheelset swings about the equilibrium, where delta r rises through zero. With S, the
!> integral of delta r over y, it turns where S is as high, S_max, on both sides; the wavelength and
!> the conicity of the cone that has the same wavelength are
!>
!>     lambda = sqrt(2 e r0) I,  I = integral of dy/sqrt(S_max - S(y)) between the turning points,
!>     tan(gamma_e) = (2 pi/lambda)**2 e r0/2 = (pi/I)**2.
!>
!> Neither e nor r0 counts. Half of the way between the turning points is the amplitude. Between two
!> points of the table S is a parabola, and its part of I is, exactly,
!> 2 atan(sqrt(k) h/(sqrt(D0) + sqrt(D1)))/sqrt(k), with the width h, the slope 2 k of delta r and
!> S_max - S = D0, D1 at the ends (atanh and -k where delta r falls): nothing is lost at the turning
!> points.
!>
!> Where delta r falls through zero, as on hollow wheels, the wheelset leaves the equilibrium: there
!> is no wave about it unless the motion comes round a hollow on each side, and the conicity of the
!> straight line, that of the regression, is negative.
!>
!> Source: EN 15302:2008+A1:2010, Annex B (integration of the nonlinear equation) and Annex C
!> (linear regression of delta r).
module faststrip_geometry_conicity
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_limits, only: most_steps, equal_within
    use faststrip_base_status, only: status_t, clear_status, set_status, is_error, number_text, &
                                     count_text, st_bad_argument, st_not_finite, &
                                     st_not_increasing, st_no_wave, st_out_of_range, &
                                     st_too_few_points
    implicit none
    private

    public :: conicity_t, find_conicity, find_equilibrium, klingel_conicity, &
              regression_conicity, largest_amplitude

    ! Nonlinearity is half of what the conicity rises from an amplitude 1 mm less to one 1 mm more.
    ! Given: Polach (2010): (tan gamma_e(4 mm) - tan gamma_e(2 mm))/2 at 3 mm.
    real(wp), parameter :: half_span = 1.0_wp
    ! Given: Simpson's rule: a sixth of the ends and four times the middle.
    real(wp), parameter :: simpson = 6.0_wp

    !> The conicity at one amplitude, both by Klingel's equation (Annex B) and by linear regression
    !> between its turning points (Annex C).
    type :: conicity_t
        real(wp) :: klingel = 0.0_wp         !! tan gamma_e; 0 without a wave
        real(wp) :: regression = 0.0_wp      !! the same; below 0: it leaves the equilibrium
        real(wp) :: y_min = 0.0_wp           !! turning point, or where the line begins, mm
        real(wp) :: y_max = 0.0_wp           !! turning point, or where the line ends, mm
        real(wp) :: nonlinearity(2) = 0.0_wp !! of both, 1/mm
        logical :: has_nonlinearity = .false. !! is it known? Not near 0 and the end of the table
    end type conicity_t

contains

    !> The conicity at an amplitude by both methods, and how it rises with the amplitude.
    pure subroutine find_conicity(y, delta_r, y_equilibrium, amplitude, conicity, status)
        real(wp), intent(in) :: y(:)          !! lateral displacement, rising, mm
        real(wp), intent(in) :: delta_r(:)    !! rolling radius difference, mm
        real(wp), intent(in) :: y_equilibrium !! of `find_equilibrium`, mm
        real(wp), intent(in) :: amplitude     !! half of the way between the turning points, mm
        type(conicity_t), intent(out) :: conicity !! zeros on an error
        type(status_t), intent(out) :: status !! those of `klingel_conicity`, `regression_conicity`
                                              !! `st_no_wave`: the regression stands

        type(conicity_t) :: below, above
        type(status_t) :: beside

        call find_both(y, delta_r, y_equilibrium, amplitude, conicity, status)
        if (is_error(status)) conicity = conicity_t()
        if (status%code /= 0 .or. .not. amplitude > half_span) return
        call find_both(y, delta_r, y_equilibrium, amplitude - half_span, below, beside)
        if (beside%code /= 0) return
        call find_both(y, delta_r, y_equilibrium, amplitude + half_span, above, beside)
        if (beside%code /= 0) return
        conicity%has_nonlinearity = .true.
        conicity%nonlinearity = 0.5_wp*[above%klingel - below%klingel, &
                                        above%regression - below%regression]/half_span
    end subroutine find_conicity

    pure subroutine find_both(y, delta_r, y_equilibrium, amplitude, conicity, status)
        real(wp), intent(in) :: y(:), delta_r(:), y_equilibrium, amplitude
        type(conicity_t), intent(out) :: conicity
        type(status_t), intent(out) :: status

        type(status_t) :: of_line

        call klingel_conicity(y, delta_r, y_equilibrium, amplitude, conicity%klingel, &
                              conicity%y_min, conicity%y_max, status)
        if (is_error(status)) return
        call regression_conicity(y, delta_r, conicity%y_min, conicity%y_max, &
                                 conicity%regression, of_line)
        if (is_error(of_line)) status = of_line
    end subroutine find_both

    !> Where delta r passes through zero: of several places the one nearest to y = 0, of a stretch
    !> with zero its middle. Where delta r rises the wheelset swings about it, where it falls the
    !> wheelset leaves it; of two places equally far the one where it rises.
    pure subroutine find_equilibrium(y, delta_r, y_equilibrium, status, falls)
        real(wp), intent(in) :: y(:)           !! lateral displacement, rising, mm
        real(wp), intent(in) :: delta_r(:)     !! rolling radius difference, mm
        real(wp), intent(out) :: y_equilibrium !! mm; 0 on an error
        type(status_t), intent(out) :: status  !! `st_bad_argument` (sizes), `st_too_few_points`,
                                               !! `st_not_finite`, `st_not_increasing`,
                                               !! `st_out_of_range` (no such place)
        logical, intent(out), optional :: falls !! does delta r fall there?
        real(wp) :: place, gain
        integer :: i, last
        logical :: is_found, is_falling, is_nearer

        y_equilibrium = 0.0_wp
        is_falling = .false.
        if (present(falls)) falls = .false.
        call check_table(y, delta_r, status)
        if (status%code /= 0) return
        is_found = .false.
        last = 1
        do i = 2, size(y)
            if (.not. abs(delta_r(i)) > 0.0_wp) cycle
            if (abs(delta_r(last)) > 0.0_wp .and. &
                sign(1.0_wp, delta_r(last))*delta_r(i) < 0.0_wp) then
                if (i == last + 1) then
                    place = y(last) - delta_r(last)*(y(i) - y(last))/(delta_r(i) - delta_r(last))
                else
                    place = 0.5_wp*(y(last + 1) + y(i - 1))
                end if
                gain = abs(y_equilibrium) - abs(place)
                is_nearer = gain > equal_within*(y(size(y)) - y(1))
                if (is_falling .and. delta_r(i) > 0.0_wp) &
                    is_nearer = gain >= -equal_within*(y(size(y)) - y(1))
                if (.not. is_found .or. is_nearer) then
                    y_equilibrium = place
                    is_falling = delta_r(i) < 0.0_wp
                end if
                is_found = .true.
            end if
            last = i
        end do
        if (present(falls)) falls = is_falling
        if (.not. any(abs(delta_r) > 0.0_wp)) then
            ! Cylinders: it is in equilibrium everywhere.
            y_equilibrium = min(max(0.0_wp, y(1)), y(size(y)))
            return
        end if
        if (.not. is_found) call set_status(status, st_out_of_range, &
            'delta r must rise through 0, or fall, got from ' // trim(number_text(delta_r(1))) &
            // ' to ' // trim(number_text(delta_r(size(y)))) // ' mm')
    end subroutine find_equilibrium

    pure subroutine check_table(y, delta_r, status)
        real(wp), intent(in) :: y(:), delta_r(:)
        type(status_t), intent(out) :: status
        integer :: i

        call clear_status(status)
        if (size(y) /= size(delta_r)) then
            call set_status(status, st_bad_argument, 'y and delta r must be of one size, got ' &
                            // trim(count_text(size(y))) // ' and ' // count_text(size(delta_r)))
        else if (size(y) < 2) then
            call set_status(status, st_too_few_points, 'delta r must have at least 2 points, got ' &
                            // count_text(size(y)))
        end if
        if (status%code /= 0) return
        do i = 1, size(y)
            if (.not. ieee_is_finite(y(i)) .or. .not. ieee_is_finite(delta_r(i))) then
                call set_status(status, st_not_finite, 'y and delta r must be finite, got ' &
                                // trim(number_text(y(i))) // ' and ' &
                                // trim(number_text(delta_r(i))) // ' at point ' // count_text(i))
                return
            end if
        end do
        do i = 2, size(y)
            if (.not. y(i) > y(i - 1)) then
                call set_status(status, st_not_increasing, 'y must rise, got ' &
                                // trim(number_text(y(i))) // ' after ' &
                                // trim(number_text(y(i - 1))) // ' at point ' // count_text(i))
                return
            end if
        end do
    end subroutine check_table

    !> Equivalent conicity by Klingel's equation. Inside a stretch with delta r = 0 nothing steers
    !> the wheelset: 0. Without a wave of this amplitude about the equilibrium it is not known.
    pure subroutine klingel_conicity(y, delta_r, y_equilibrium, amplitude, tan_gamma_e, y_min, &
                                     y_max, status)
        real(wp), intent(in) :: y(:)          !! lateral displacement, rising, mm
        real(wp), intent(in) :: delta_r(:)    !! rolling radius difference, mm
        real(wp), intent(in) :: y_equilibrium !! of `find_equilibrium`, mm
        real(wp), intent(in) :: amplitude     !! half of the way between the turning points, mm
        real(wp), intent(out) :: tan_gamma_e  !! equivalent conicity; 0 on an error, without a wave
        real(wp), intent(out) :: y_min        !! turning point, mm; without a wave an amplitude
        real(wp), intent(out) :: y_max        !! the same to the other side of the equilibrium, mm
        type(status_t), intent(out) :: status !! `st_bad_argument`; `st_out_of_range`: beyond the
                                              !! table; limitation `st_no_wave`: no motion turns
                                              !! there, since delta r falls through zero
        real(wp) :: low, high, middle, difference, times(2)
        integer :: step
        logical :: is_free(2)

        tan_gamma_e = 0.0_wp
        y_min = y_equilibrium - amplitude
        y_max = y_equilibrium + amplitude
        call check_amplitude(amplitude, largest_amplitude(y, delta_r, y_equilibrium), status)
        if (status%code /= 0) return
        if (y_min >= y(1) .and. y_max <= y(size(y))) then
            ! Neither hill nor hollow of S on the way.
            if (.not. max(level(y, delta_r, y_equilibrium, y_min), &
                          level(y, delta_r, y_equilibrium, y_max), &
                          level(y, -delta_r, y_equilibrium, y_min), &
                          level(y, -delta_r, y_equilibrium, y_max)) > 0.0_wp) return
        end if

        ! The levels reached on both sides do not fall: their difference has one sign change over
        ! the middle of the way.
        low = max(y_equilibrium - amplitude, y(1) + amplitude)
        high = max(low, min(y_equilibrium + amplitude, y(size(y)) - amplitude))
        middle = 0.5_wp*(low + high)
        do step = 1, most_steps
            difference = level(y, delta_r, y_equilibrium, min(middle + amplitude, y(size(y)))) &
                         - level(y, delta_r, y_equilibrium, max(middle - amplitude, y(1)))
            if (difference < 0.0_wp) low = middle
            if (difference > 0.0_wp) high = middle
            if (.not. abs(difference) > 0.0_wp) exit
            middle = 0.5_wp*(low + high)
        end do
        y_min = max(middle - amplitude, y(1))
        y_max = min(middle + amplitude, y(size(y)))
        call travel(y, delta_r, y_min, y_equilibrium, times(1), is_free(1))
        call travel(y, delta_r, y_max, y_equilibrium, times(2), is_free(2))
        if (.not. all(is_free)) then
            y_min = y_equilibrium - amplitude
            y_max = y_equilibrium + amplitude
            call set_status(status, st_no_wave, 'no motion about ' // &
                            trim(number_text(y_equilibrium)) // ' mm turns at the amplitude ' // &
                            trim(number_text(amplitude)) // ' mm, delta r falls through 0 before')
            return
        end if
        tan_gamma_e = (pi/sum(times))**2
    end subroutine klingel_conicity

    !> Equivalent conicity by linear regression: half the slope of the straight line that is
    !> nearest to delta r by least squares between two places, as the turning points of
    !> `klingel_conicity`; every place counts the same, however the points of the table are spread.
    pure subroutine regression_conicity(y, delta_r, y_min, y_max, tan_gamma_e, status)
        real(wp), intent(in) :: y(:)          !! lateral displacement, rising, mm
        real(wp), intent(in) :: delta_r(:)    !! rolling radius difference, mm
        real(wp), intent(in) :: y_min         !! where the line begins, mm
        real(wp), intent(in) :: y_max         !! where it ends, mm
        real(wp), intent(out) :: tan_gamma_e  !! equivalent conicity; 0 on an error
        type(status_t), intent(out) :: status !! `st_bad_argument` (no width), `st_out_of_range`
        real(wp) :: ends(2), radii(2), middle, moment
        integer :: i

        call clear_status(status)
        tan_gamma_e = 0.0_wp
        if (.not. y_max > y_min) then
            call set_status(status, st_bad_argument, 'y_max must be above y_min, got ' &
                            // trim(number_text(y_max)) // ' and ' // number_text(y_min))
            return
        else if (y_min < y(1) .or. y_max > y(size(y))) then
            call set_status(status, st_out_of_range, 'y must lie within the table, got ' &
                            // trim(number_text(y_min)) // ' to ' &
                            // trim(number_text(y_max)) // ' mm')
            return
        end if
        middle = 0.5_wp*(y_min + y_max)
        moment = 0.0_wp
        do i = 1, size(y) - 1
            ends = [max(y(i), y_min), min(y(i + 1), y_max)]
            if (.not. ends(2) > ends(1)) cycle
            radii = [value(y, delta_r, i, ends(1)), value(y, delta_r, i, ends(2))]
            ends = ends - middle
            ! Simpson's rule, exact for the product of two lines.
            moment = moment + (ends(2) - ends(1))/simpson*(dot_product(ends, radii) &
                                                          + sum(ends)*sum(radii))
        end do
        ! Half the slope: the moment over that of a line of slope 2.
        tan_gamma_e = moment/(4.0_wp/3.0_wp*(0.5_wp*(y_max - y_min))**3)
    end subroutine regression_conicity

    !> The largest amplitude of `klingel_conicity` that the table holds, mm.
    pure real(wp) function largest_amplitude(y, delta_r, y_equilibrium) result(largest)
        real(wp), intent(in) :: y(:)          !! lateral displacement, rising, mm
        real(wp), intent(in) :: delta_r(:)    !! rolling radius difference, mm
        real(wp), intent(in) :: y_equilibrium !! of `find_equilibrium`, mm
        real(wp) :: levels(2), ends(2), low, high, middle
        integer :: step, far

        ends = [y(1), y(size(y))]
        levels = [level(y, delta_r, y_equilibrium, ends(1)), &
                  level(y, delta_r, y_equilibrium, ends(2))]
        largest = 0.5_wp*(ends(2) - ends(1))
        if (.not. minval(levels) > 0.0_wp) then
            ! No wave: what a straight line about the equilibrium has.
            largest = min(ends(2) - y_equilibrium, y_equilibrium - ends(1))
            return
        end if
        if (abs(levels(2) - levels(1)) <= equal_within*maxval(levels)) return
        ! On the side that climbs higher the wheelset turns before the end.
        far = maxloc(levels, 1)
        low = y_equilibrium
        high = ends(far)
        do step = 1, most_steps
            middle = 0.5_wp*(low + high)
            if (level(y, delta_r, y_equilibrium, middle) > minval(levels)) then
                high = middle
            else
                low = middle
            end if
        end do
        largest = 0.5_wp*abs(high - ends(3 - far))
    end function largest_amplitude

    pure subroutine check_amplitude(amplitude, largest, status)
        real(wp), intent(in) :: amplitude, largest
        type(status_t), intent(out) :: status
        logical :: is_positive

        call clear_status(status)
        is_positive = ieee_is_finite(amplitude)
        if (is_positive) is_positive = amplitude > 0.0_wp
        if (.not. is_positive) then
            call set_status(status, st_bad_argument, 'the amplitude must be above 0, got ' &
                            // trim(number_text(amplitude)) // ' mm')
        else if (amplitude > largest*(1.0_wp + equal_within)) then
            call set_status(status, st_out_of_range, 'the table ends before the amplitude, got ' &
                            // trim(number_text(amplitude)) // ', at most ' &
                            // trim(number_text(largest)) // ' mm')
        end if
    end subroutine check_amplitude

    !> The highest S on the way from one place to another, S = 0 at the first, mm**2.
    pure real(wp) function level(y, delta_r, from, to)
        real(wp), intent(in) :: y(:), delta_r(:), from, to
        real(wp) :: at, next, forces(2), s, outward
        integer :: i

        outward = sign(1.0_wp, to - from)
        level = 0.0_wp
        s = 0.0_wp
        at = from
        i = segment(y, from, outward)
        do
            next = step_end(y, i, outward, to)
            forces = outward*[value(y, delta_r, i, at), value(y, delta_r, i, next)]
            ! Within the step S is highest where delta r falls through zero.
            if (forces(1) > 0.0_wp .and. forces(2) < 0.0_wp) level = &
                max(level, s + 0.5_wp*forces(1)**2/(forces(1) - forces(2))*abs(next - at))
            s = s + 0.5_wp*sum(forces)*abs(next - at)
            level = max(level, s)
            if (.not. outward*(to - next) > 0.0_wp) return
            at = next
            i = i + nint(outward)
        end do
    end function level

    !> The part of I between a turning point and the equilibrium, 1; not free: S is as high as at
    !> the turning point on the way.
    pure subroutine travel(y, delta_r, turn, y_equilibrium, time, is_free)
        real(wp), intent(in) :: y(:), delta_r(:), turn, y_equilibrium
        real(wp), intent(out) :: time
        logical, intent(out) :: is_free
        real(wp) :: at, next, forces(2), inward, h, drop(2), half_slope, ratio
        integer :: i

        inward = sign(1.0_wp, y_equilibrium - turn)
        time = 0.0_wp
        is_free = .false.
        drop = 0.0_wp
        at = turn
        i = segment(y, turn, inward)
        do
            next = step_end(y, i, inward, y_equilibrium)
            h = abs(next - at)
            if (h > 0.0_wp) then
                forces = -inward*[value(y, delta_r, i, at), value(y, delta_r, i, next)]
                drop = [drop(2), drop(2) + 0.5_wp*sum(forces)*h]
                if (.not. drop(2) > 0.0_wp) return
                half_slope = 0.5_wp*(forces(1) - forces(2))/h
                ratio = sqrt(abs(half_slope))*h/sum(sqrt(drop))
                if (half_slope > 0.0_wp) then
                    time = time + 2.0_wp*atan(ratio)/sqrt(half_slope)
                else if (half_slope < 0.0_wp) then
                    if (ratio >= 1.0_wp) return
                    time = time + 2.0_wp*atanh(ratio)/sqrt(-half_slope)
                else
                    time = time + 2.0_wp*h/sum(sqrt(drop))
                end if
            end if
            if (.not. inward*(y_equilibrium - next) > 0.0_wp) exit
            at = next
            i = i + nint(inward)
        end do
        is_free = time > 0.0_wp
    end subroutine travel

    !> The stretch between two points that a way along a direction enters at a place.
    pure integer function segment(y, at, direction) result(i)
        real(wp), intent(in) :: y(:), at, direction

        if (direction > 0.0_wp) then
            do i = 1, size(y) - 2
                if (y(i + 1) > at) return
            end do
        else
            do i = size(y) - 1, 2, -1
                if (y(i) < at) return
            end do
        end if
    end function segment

    !> Where the way leaves a stretch, or ends inside it.
    pure real(wp) function step_end(y, i, direction, to)
        real(wp), intent(in) :: y(:), direction, to
        integer, intent(in) :: i

        if (direction > 0.0_wp) then
            step_end = min(y(i + 1), to)
        else
            step_end = max(y(i), to)
        end if
    end function step_end

    !> Delta r within a stretch, exactly that of the table at both of its ends.
    pure real(wp) function value(y, delta_r, i, at)
        real(wp), intent(in) :: y(:), delta_r(:), at
        integer, intent(in) :: i
        real(wp) :: part

        part = (at - y(i))/(y(i + 1) - y(i))
        value = (1.0_wp - part)*delta_r(i) + part*delta_r(i + 1)
    end function value
end module faststrip_geometry_conicity
