!> Smoothing of a measured gap, on request only: nothing in the library does so by itself.
!>
!> The gap is a parabola fitted to all points and what is left of them smoothed by a cubic spline
!> on even knots, with a penalty on the third differences of its coefficients (Eilers and Marx,
!> Statistical Science 11, 1996, 89-121): with N = B'B and third differences D,
!>
!>     (N + lambda D'D) c = B' h.
!>
!> Parabolas, and with them all Hertzian gaps, remain what they are, their curvature is not
!> levelled down as by a penalty on the second derivative. The user states the noise, and
!> lambda is the one with the least unbiased estimate of the curve's error (Mallows, Technometrics
!> 15, 1973, 661-675),
!>
!>     sum (h - g)^2 + 2 f noise^2 e,    e = tr [(N + lambda D'D)^(-1) N],
!>
!> e being the degrees of freedom the curve takes up, and f = 1.4 against curves that follow the
!> noise (Kim and Gu, J. R. Statist. Soc. B 66, 2004, 337-356). A noise stated somewhat wrongly
!> changes little, other than where the deviation is asked to be equal to it. The longitudinal
!> term is left as it is: it comes from the radius, not from the points' heights.
!>
!> Measured with noise of 0.5 um on the 20 gaps of the reference and on Hertzian gaps of 200 to
!> 20000 points: see `test_gap_smoothing`.
module faststrip_geometry_gap_smoothing
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_kinds, only: wp
    use faststrip_base_limits, only: beyond_all
    use faststrip_base_status, only: status_t, set_status, is_error, number_text, st_bad_argument, &
                                     st_not_finite, st_out_of_range, st_linear_algebra
    use faststrip_numerics_lapack, only: dpbtrf, dpbtrs
    use faststrip_geometry_curve_smoothing, only: caution, bad_fit
    use faststrip_geometry_gap, only: gap_t, check_gap
    implicit none
    private

    public :: smooth_gap

    ! Tuned [intervals]: Most intervals of the spline. Origin: capacity; several in each strip of
    ! any patch.
    integer, parameter :: most_intervals = 400 ! between knots
    ! Given: third differences.
    integer, parameter :: band = 3             ! upper diagonals of the system
    ! Given: coefficients of a third difference.
    real(wp), parameter :: third_difference(0:3) = [-1.0_wp, 3.0_wp, -3.0_wp, 1.0_wp]
    ! lambda, with the traces of N and D'D made equal: a factor of 10, then finer
    ! Tuned [decades; halvings]: Range of the search and its refinements. Origin: chosen; beyond
    ! both ends nothing changes.
    integer, parameter :: first_decade = -6, last_decade = 13, refinements = 4

    !> The spline through the points of a gap, and the system of its coefficients but for lambda;
    !> heights in units of the largest.
    type :: spline_t
        real(wp) :: noise = 0.0_wp            !! standard deviation of the heights' errors
        real(wp), allocatable :: basis(:, :)  !! the four B-splines at each point
        integer, allocatable :: first(:)      !! coefficient of the first of the four
        real(wp), allocatable :: normal(:, :) !! N, upper band
        real(wp), allocatable :: penalty(:, :) !! D'D, upper band, scaled
        real(wp), allocatable :: right(:)     !! B'h
    end type spline_t

contains

    !> Smooth the heights of a gap.
    subroutine smooth_gap(gap, noise, smoothed, rms_change, status)
        type(gap_t), intent(in) :: gap          !! mm, mm, 1/mm
        real(wp), intent(in) :: noise           !! standard deviation of the heights' errors, mm
        type(gap_t), intent(out) :: smoothed    !! the same points; nothing allocated on an error
        real(wp), intent(out) :: rms_change     !! root mean square of the heights' changes, mm
        type(status_t), intent(out) :: status
            !! those of `check_gap`; `st_not_finite`, `st_bad_argument` (noise not positive),
            !! `st_out_of_range` (the gap bends too sharply for 400 knots to follow it within the
            !! noise), `st_linear_algebra`

        type(spline_t) :: spline
        real(wp), allocatable :: rest(:), curve(:)
        real(wp) :: risk, log_lambda, unit
        logical :: follows, solved

        rms_change = 0.0_wp
        call check_gap(gap, status)
        if (is_error(status)) return
        if (.not. ieee_is_finite(noise)) then
            call set_status(status, st_not_finite, &
                            'the noise must be a finite number, got '//number_text(noise))
            return
        else if (noise <= 0.0_wp) then
            call set_status(status, st_bad_argument, &
                            'the noise must be above 0, got '//trim(number_text(noise))//' mm')
            return
        end if
        allocate (rest(size(gap%y)), curve(size(gap%y)), source=0.0_wp)
        call take_parabola(gap%y, gap%h, rest)
        unit = maxval(abs(rest))
        if (unit <= epsilon(1.0_wp)*maxval(abs(gap%h))) then
            smoothed = gap
            return
        end if
        if (noise/unit > beyond_all .or. unit/noise > beyond_all) then
            call set_status(status, st_out_of_range, 'noise and heights beyond all proportion')
            return
        end if
        rest = rest/unit
        call make_spline(gap%y, rest, noise/unit, spline)
        call choose_lambda(spline, rest, log_lambda, follows)
        if (.not. follows) then
            call set_status(status, st_out_of_range, 'the gap bends too sharply to be ' &
                            //'smoothed within a noise of '//trim(number_text(noise))//' mm')
            return
        end if
        call fit(spline, rest, log_lambda, curve, risk, solved)
        if (.not. solved) then
            call set_status(status, st_linear_algebra, 'the smoothing system is singular')
            return
        end if
        smoothed = gap
        smoothed%h = gap%h - unit*(rest - curve)
        rms_change = sqrt(sum((rest - curve)**2)/size(rest))*unit
    end subroutine smooth_gap

    !> The lambda with the least estimate of the curve's error: by decades, then by halvings.
    subroutine choose_lambda(spline, rest, best_log, follows)
        type(spline_t), intent(in) :: spline
        real(wp), intent(in) :: rest(:)
        real(wp), intent(out) :: best_log ! its logarithm
        logical, intent(out) :: follows   ! can the curve follow the gap within the noise?

        real(wp) :: curve(size(rest)), risk, best_risk, log_lambda, step
        integer :: i, j
        logical :: solved

        follows = .true.
        best_risk = huge(1.0_wp)
        best_log = 0.0_wp
        step = log(10.0_wp) ! Given: a decade
        do i = first_decade, last_decade
            call fit(spline, rest, i*step, curve, risk, solved)
            if (.not. solved) cycle
            if (i == first_decade) then
                follows = .not. sum((rest - curve)**2) > size(rest)*(bad_fit*spline%noise)**2
                if (.not. follows) return
            end if
            if (risk >= best_risk) cycle
            best_risk = risk
            best_log = i*step
        end do
        do j = 1, refinements
            step = 0.5_wp*step
            do i = -1, 1, 2
                log_lambda = best_log + i*step
                call fit(spline, rest, log_lambda, curve, risk, solved)
                if (.not. solved .or. risk >= best_risk) cycle
                best_risk = risk
                best_log = log_lambda
                exit
            end do
        end do
    end subroutine choose_lambda

    !> The curve for a lambda, and the estimate of its error.
    subroutine fit(spline, rest, log_lambda, curve, error, solved)
        type(spline_t), intent(in) :: spline
        real(wp), intent(in) :: rest(:), log_lambda
        real(wp), intent(inout) :: curve(:) ! as it was if not solved
        real(wp), intent(out) :: error
        logical, intent(out) :: solved

        real(wp) :: system(band + 1, size(spline%right)), degrees
        real(wp) :: solution(size(spline%right), size(spline%right) + 1)
        integer :: l, k, m, info

        m = size(spline%right)
        error = huge(1.0_wp)
        system = spline%normal + exp(log_lambda)*spline%penalty
        call dpbtrf('U', m, band, system, band + 1, info)
        solved = info == 0
        if (.not. solved) return
        solution = 0.0_wp
        do l = 1, m
            do k = max(1, l - band), l
                solution(k, l) = spline%normal(band + 1 + k - l, l)
                solution(l, k) = solution(k, l)
            end do
        end do
        solution(:, m + 1) = spline%right
        call dpbtrs('U', m, band, m + 1, system, band + 1, solution, m, info)
        solved = info == 0
        degrees = 0.0_wp
        do l = 1, m
            degrees = degrees + solution(l, l)
        end do
        associate (first => spline%first)
            do l = 1, size(rest)
                curve(l) = dot_product(spline%basis(:, l), solution(first(l):first(l) + 3, m + 1))
            end do
        end associate
        error = sum((rest - curve)**2) + 2.0_wp*caution*spline%noise**2*degrees
    end subroutine fit

    !> The spline's basis and its system for heights without their parabola.
    subroutine make_spline(y, rest, noise, spline)
        real(wp), intent(in) :: y(:), rest(:), noise
        type(spline_t), intent(out) :: spline

        integer :: n, m

        n = size(y)
        m = min(n, most_intervals) + 3
        allocate (spline%basis(0:3, n), spline%normal(band + 1, m), spline%penalty(band + 1, m), &
                  spline%right(m), source=0.0_wp)
        allocate (spline%first(n), source=0)
        spline%noise = noise
        call fill_basis(y, m - 3, spline%basis, spline%first)
        call fill_system(spline%basis, spline%first, rest, spline%normal, spline%penalty, &
                         spline%right)
    end subroutine make_spline

    !> What is left of heights without the parabola that fits them best.
    pure subroutine take_parabola(y, h, rest)
        real(wp), intent(in) :: y(:), h(:)
        real(wp), intent(out) :: rest(:)

        real(wp) :: t(size(y)), p(size(y)), slope, mean
        integer :: n, pass

        n = size(y)
        t = (y - 0.5_wp*(y(1) + y(n)))/(0.5_wp*(y(n) - y(1)))
        t = t - sum(t)/n
        slope = sum(t**3)/sum(t**2)
        mean = sum(t**2)/n
        p = t**2 - mean - slope*t
        rest = h
        do pass = 1, 2
            rest = rest - sum(rest)/n
            rest = rest - t*(sum(t*rest)/sum(t**2))
            rest = rest - p*(sum(p*rest)/sum(p**2))
        end do
    end subroutine take_parabola

    !> The four cubic B-splines on even knots that are not zero at each point.
    pure subroutine fill_basis(y, intervals, basis, first)
        real(wp), intent(in) :: y(:)
        integer, intent(in) :: intervals
        real(wp), intent(out) :: basis(0:, :)
        integer, intent(out) :: first(:) ! of the four

        real(wp) :: t, u
        integer :: i, n

        n = size(y)
        do i = 1, n
            t = intervals*((y(i) - y(1))/(y(n) - y(1)))
            first(i) = min(int(t), intervals - 1) + 1
            u = t - (first(i) - 1)
            basis(0, i) = (1.0_wp - u)**3/6.0_wp ! Given: cubic B-spline
            basis(1, i) = (4.0_wp + u*u*(3.0_wp*u - 6.0_wp))/6.0_wp ! Given: cubic B-spline
            ! Given: cubic B-spline
            basis(2, i) = (1.0_wp + u*(3.0_wp + u*(3.0_wp - 3.0_wp*u)))/6.0_wp
            basis(3, i) = u**3/6.0_wp ! Given: cubic B-spline
        end do
    end subroutine fill_basis

    !> N, D'D scaled to its trace (upper bands as LAPACK stores them), and B'h.
    pure subroutine fill_system(basis, first, rest, normal, penalty, right)
        real(wp), intent(in) :: basis(0:, :), rest(:)
        integer, intent(in) :: first(:)
        real(wp), intent(inout) :: normal(:, :), penalty(:, :), right(:)

        integer :: i, j, k

        do i = 1, size(rest)
            do j = 0, 3
                right(first(i) + j) = right(first(i) + j) + basis(j, i)*rest(i)
                do k = 0, j
                    associate (entry => normal(band + 1 + k - j, first(i) + j))
                        entry = entry + basis(j, i)*basis(k, i)
                    end associate
                end do
            end do
        end do
        do i = 1, size(right) - 3
            do j = 0, 3
                do k = 0, j
                    associate (entry => penalty(band + 1 + k - j, i + j))
                        entry = entry + third_difference(j)*third_difference(k)
                    end associate
                end do
            end do
        end do
        penalty = penalty*(sum(normal(band + 1, :))/sum(penalty(band + 1, :)))
    end subroutine fill_system
end module faststrip_geometry_gap_smoothing
