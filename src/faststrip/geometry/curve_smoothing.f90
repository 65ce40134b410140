!> Smoothing of a profile's points along its arc, on request only: by wavelength or by noise.
!>
!> Both coordinates are smoothed as functions of the arc length s, so that an upright side is
!> smoothed like a tread: with spacings w as weights
!>
!>     sum w (f - d)^2 + mu int f'''^2 ds  ->  least,   mu = (L/(2 pi))^6,
!>
!> which halves a wave of the length L, takes away shorter ones, (1 + (L/l)^6)^(-1) of a length l,
!> and leaves parabolas alone. Kinks stay where they are: the stretches between them are smoothed
!> one by one. By noise, L is the one with the least estimate of the curve's error, as for gaps
!> (`faststrip_geometry_gap_smoothing`).
module faststrip_geometry_curve_smoothing
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, number_text, &
                                     st_bad_argument, st_linear_algebra, st_out_of_range
    use faststrip_numerics_lapack, only: dpbtrf, dpbtrs
    use faststrip_geometry_arc_spline, only: chord_lengths
    implicit none
    private

    public :: smooth_by_wavelength, smooth_by_noise, caution, bad_fit

    ! Given: third differences.
    integer, parameter :: band = 3
    ! The penalty over the weight of a point beyond which rounding shows.
    ! Tuned [1]. Origin: its product with the rounding of doubles and a change of 0.1 mm is 1 um.
    real(wp), parameter :: stiffest = 1.0e14_wp
    ! A kink is held with this weight over that of its neighbours.
    ! Tuned [1]. Origin: chosen: it moves by a millionth of what they move.
    real(wp), parameter :: held = 1.0e6_wp
    !> Weight of the degrees of freedom, of profiles and gaps.
    !> Given: Kim and Gu, J. R. Statist. Soc. B 66 (2004) 337-356: 1.4 for penalised regression.
    real(wp), parameter :: caution = 1.4_wp
    ! Tuned [1]: Wavelengths tried, each over the one before. Origin: chosen: within 12 % of the
    ! best, where the estimate is flat.
    real(wp), parameter :: finer = 1.25_wp
    ! First wavelength over the mean spacing.
    ! Given: the sampling theorem: shorter ones cannot be told from longer ones.
    real(wp), parameter :: shortest = 2.0_wp
    !> Largest misfit over the noise where nearly nothing is smoothed.
    !> Tuned [1]. Origin: chosen: a curve that follows the points has less than once the noise.
    real(wp), parameter :: bad_fit = 2.0_wp

contains

    !> Halve waves of a length, take away shorter ones.
    subroutine smooth_by_wavelength(y, z, is_kink, wavelength, rms_change, status)
        real(wp), intent(inout) :: y(:)           !! mm, along the curve
        real(wp), intent(inout) :: z(:)           !! mm, as many
        logical, intent(in) :: is_kink(:)         !! is there a kink at the point? as many
        real(wp), intent(in) :: wavelength        !! above 0, mm
        real(wp), intent(out) :: rms_change       !! of the points, mm
        type(status_t), intent(out) :: status     !! `st_bad_argument`, `st_not_increasing` (two
                                                  !! points in one place), `st_out_of_range` (too
                                                  !! long for the spacing), `st_linear_algebra`

        real(wp) :: dy(size(y)), dz(size(y)), degrees
        logical :: valid

        rms_change = 0.0_wp
        valid = ieee_is_finite(wavelength)
        if (valid) valid = wavelength > 0.0_wp
        if (.not. valid) then
            call set_status(status, st_bad_argument, 'the wavelength must be above 0 mm, got ' &
                            //number_text(wavelength))
            return
        end if
        call changes(y, z, is_kink, wavelength, dy, dz, degrees, status)
        if (is_error(status)) return
        y = y + dy
        z = z + dz
        rms_change = sqrt(sum(dy**2 + dz**2)/size(y))
    end subroutine smooth_by_wavelength

    !> Smooth by the wavelength with the least estimate of the curve's error, for a stated noise.
    subroutine smooth_by_noise(y, z, is_kink, noise, wavelength, rms_change, status)
        real(wp), intent(inout) :: y(:)           !! mm, along the curve
        real(wp), intent(inout) :: z(:)           !! mm, as many
        logical, intent(in) :: is_kink(:)         !! is there a kink at the point? as many
        real(wp), intent(in) :: noise             !! standard deviation across the curve, mm
        real(wp), intent(out) :: wavelength       !! that was taken, mm
        real(wp), intent(out) :: rms_change       !! of the points, mm
        type(status_t), intent(out) :: status     !! as `smooth_by_wavelength`; `st_out_of_range`
                                                  !! also where the curve bends too sharply

        real(wp) :: dy(size(y)), dz(size(y)), degrees, length, tried, risk, best
        integer :: i
        logical :: valid

        rms_change = 0.0_wp
        wavelength = 0.0_wp
        valid = ieee_is_finite(noise)
        if (valid) valid = noise > 0.0_wp
        if (.not. valid) then
            call set_status(status, st_bad_argument, 'the noise must be above 0 mm, got ' &
                            //number_text(noise))
            return
        end if
        length = 0.0_wp
        do i = 2, size(y)
            length = length + hypot(y(i) - y(i - 1), z(i) - z(i - 1))
        end do
        tried = shortest*length/max(size(y) - 1, 1)
        best = huge(best)
        do while (tried < length)
            call changes(y, z, is_kink, tried, dy, dz, degrees, status)
            if (is_error(status)) exit
            risk = sum(dy**2 + dz**2)
            if (wavelength <= 0.0_wp .and. risk > size(y)*(bad_fit*noise)**2) then
                call set_status(status, st_out_of_range, 'the profile bends too sharply to be ' &
                                //'smoothed within a noise of '//trim(number_text(noise))//' mm')
                return
            end if
            risk = risk + 2.0_wp*caution*noise**2*degrees
            if (risk < best) then
                best = risk
                wavelength = tried
            end if
            tried = finer*tried
        end do
        ! Too long a wavelength ends the search, the first one is an error.
        if (wavelength <= 0.0_wp) then
            if (.not. is_error(status)) call set_status(status, st_out_of_range, &
                'the profile is too short to be smoothed')
            return
        end if
        call smooth_by_wavelength(y, z, is_kink, wavelength, rms_change, status)
    end subroutine smooth_by_noise

    !> By how much the points move, and the degrees of freedom the curve takes up.
    subroutine changes(y, z, is_kink, wavelength, dy, dz, degrees, status)
        real(wp), intent(in) :: y(:), z(:), wavelength
        logical, intent(in) :: is_kink(:)
        real(wp), intent(out) :: dy(:), dz(:), degrees
        type(status_t), intent(out) :: status

        real(wp) :: part
        integer :: first, last, n

        call clear_status(status)
        n = size(y)
        dy = 0.0_wp
        dz = 0.0_wp
        degrees = 0.0_wp
        last = 1
        do while (last < n)
            first = last
            last = first + 1
            do while (last < n .and. .not. is_kink(last))
                last = last + 1
            end do
            if (last - first < band + 1) then
                degrees = degrees + last - first
                cycle
            end if
            call change_stretch(y(first:last), z(first:last), first > 1, last < n, wavelength, &
                                dy(first:last), dz(first:last), part, status)
            if (is_error(status)) return
            degrees = degrees + part
        end do
    end subroutine changes

    !> The same for a stretch without kinks but at its ends.
    subroutine change_stretch(y, z, holds_first, holds_last, wavelength, dy, dz, degrees, status)
        real(wp), intent(in) :: y(:), z(:), wavelength
        logical, intent(in) :: holds_first, holds_last
        real(wp), intent(out) :: dy(:), dz(:), degrees
        type(status_t), intent(inout) :: status

        real(wp) :: weight(size(y)), s(size(y)), row(0:band), mu
        real(wp) :: system(band + 1, size(y)), change(size(y), 2), derivative(2)
        integer :: i, j, k, n, info

        n = size(y)
        degrees = 0.0_wp
        call chord_lengths(y, z, s, status)
        if (is_error(status)) return
        weight(1) = 0.5_wp*(s(2) - s(1))
        weight(n) = 0.5_wp*(s(n) - s(n - 1))
        weight(2:n - 1) = 0.5_wp*(s(3:) - s(:n - 2))
        if (holds_first) weight(1) = held*weight(1)
        if (holds_last) weight(n) = held*weight(n)
        mu = (wavelength/(2.0_wp*pi))**(2*band)
        system = 0.0_wp
        system(band + 1, :) = weight
        change = 0.0_wp
        do i = 1, n - band
            row = third_derivative(s(i:i + band))
            derivative = [dot_product(row, y(i:i + band) - y(i)), &
                          dot_product(row, z(i:i + band) - z(i))]
            do j = 0, band
                do k = 0, j
                    system(band + 1 + k - j, i + j) = system(band + 1 + k - j, i + j) &
                        + mu*row(j)*row(k)*(s(i + band) - s(i))/band
                end do
                change(i + j, :) = change(i + j, :) &
                    - mu*row(j)*derivative*(s(i + band) - s(i))/band
            end do
        end do
        if (maxval(system(band + 1, :)/weight) > stiffest) then
            call set_status(status, st_out_of_range, 'points of the profile are too close for a ' &
                            //'wavelength of '//trim(number_text(wavelength)) &
                            //' mm: resample them, or drop double ones')
            return
        end if
        call dpbtrf('U', n, band, system, band + 1, info)
        if (info == 0) call dpbtrs('U', n, band, 2, system, band + 1, change, n, info)
        if (info /= 0) then
            call set_status(status, st_linear_algebra, 'the smoothing system is singular')
            return
        end if
        dy = change(:, 1)
        dz = change(:, 2)
        degrees = trace(system, weight)
    end subroutine change_stretch

    !> Factors of four values in the third derivative at four places.
    pure function third_derivative(s) result(row)
        real(wp), intent(in) :: s(0:band)
        real(wp) :: row(0:band)

        integer :: j, k

        row = 6.0_wp ! Given: 3!
        do j = 0, band
            do k = 0, band
                if (k /= j) row(j) = row(j)/(s(j) - s(k))
            end do
        end do
    end function third_derivative

    !> The sum of weights times the diagonal of the inverse, from the factor of the system.
    pure real(wp) function trace(factor, weight)
        real(wp), intent(in) :: factor(:, :), weight(:)

        real(wp) :: inverse(0:band, size(weight) + band), value
        integer :: i, j, k, n

        ! inverse(j - i, i) is the element (i, j); Takahashi's recurrence from the last row up.
        n = size(weight)
        inverse = 0.0_wp
        trace = 0.0_wp
        do i = n, 1, -1
            do j = min(i + band, n), i, -1
                value = 0.0_wp
                if (j == i) value = 1.0_wp/factor(band + 1, i)**2
                do k = i + 1, min(i + band, n)
                    value = value - factor(band + 1 + i - k, k)/factor(band + 1, i) &
                        *inverse(abs(j - k), min(j, k))
                end do
                inverse(j - i, i) = value
            end do
            trace = trace + weight(i)*inverse(0, i)
        end do
    end function trace
end module faststrip_geometry_curve_smoothing
