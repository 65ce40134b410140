!> Between the strips of a patch: lengths and pressures as curves over y.
!>
!> The squares of the half-lengths and of the centre pressures are smooth up to the ends of a
!> patch, where they vanish (they are parabolas on an ellipse). Through them goes a parabola at
!> each strip: its own middle and the two neighbours', the end of the patch standing in for the
!> neighbour an end strip lacks.
module faststrip_normal_patch_curves
    use faststrip_base_kinds, only: wp
    implicit none
    private

    public :: curve_integral, curve_peak

contains

    !> Integral over y of a quantity known at the middles of a patch's strips.
    pure real(wp) function curve_integral(left, right, value) result(integral)
        real(wp), intent(in) :: left(:)  !! left edges of the patch's strips, (n), mm
        real(wp), intent(in) :: right(:) !! right edges, (n), mm
        real(wp), intent(in) :: value(:) !! values at the middles, not negative, (n)

        ! Gauss-Legendre with five points on [0, 1].
        ! Given: Gauss-Legendre with five points.
        real(wp), parameter :: t(5) = [0.046910077030668_wp, 0.230765344947158_wp, 0.5_wp, &
                                       0.769234655052842_wp, 0.953089922969332_wp]
        ! Given: Gauss-Legendre with five points.
        real(wp), parameter :: weight(5) = [0.118463442528095_wp, 0.239314335249683_wp, &
                                            0.284444444444444_wp, 0.239314335249683_wp, &
                                            0.118463442528095_wp]
        real(wp) :: width, q0, slope, bend, s(5), jacobian(5)
        integer :: k, n

        n = size(value)
        integral = 0.0_wp
        do k = 1, n
            call parabola(left, right, value, k, q0, slope, bend)
            width = right(k) - left(k)
            ! A square root at the end of the patch is no matter in the root of the distance.
            if (k == 1 .and. n > 1) then
                s = (t**2 - 0.5_wp)*width
                jacobian = 2.0_wp*t*width
            else if (k == n .and. n > 1) then
                s = (0.5_wp - t**2)*width
                jacobian = 2.0_wp*t*width
            else
                s = (t - 0.5_wp)*width
                jacobian = width
            end if
            integral = integral + sum(weight*jacobian &
                                      *sqrt(max(q0 + s*(slope + s*bend), 0.0_wp)))
        end do
    end function curve_integral

    !> Largest value of a quantity known at the middles of a patch's strips.
    !>
    !> From one middle to the next the square goes over from the parabola of the one strip to that
    !> of the other, so that the peak does not jump where another strip becomes the largest.
    !>
    !> A parabola through strips of one width rises above the largest by an eighth of its fall to a
    !> neighbour; where widths or falls are unlike it is limited to four times that.
    pure real(wp) function curve_peak(left, right, value) result(peak)
        real(wp), intent(in) :: left(:)  !! left edges of the patch's strips, (n), mm
        real(wp), intent(in) :: right(:) !! right edges, (n), mm
        real(wp), intent(in) :: value(:) !! values at the middles, not negative, (n)

        real(wp) :: q0, slope, bend, next_q0, next_bend, distance, s, largest
        integer :: k, n

        n = size(value)
        largest = maxval(value)**2
        call parabola(left, right, value, 1, q0, slope, bend)
        if (slope < 0.0_wp .and. bend < 0.0_wp) then
            s = max(-0.5_wp*slope/bend, left(1) - 0.5_wp*(left(1) + right(1)))
            largest = max(largest, q0 + s*(slope + s*bend))
        end if
        do k = 1, n - 1
            call parabola(left, right, value, k + 1, next_q0, slope, next_bend)
            distance = 0.5_wp*(left(k + 1) - left(k) + right(k + 1) - right(k))
            largest = max(largest, peak_between(q0, next_q0, bend*distance**2, &
                                                next_bend*distance**2))
            q0 = next_q0
            bend = next_bend
        end do
        if (slope > 0.0_wp .and. bend < 0.0_wp) then
            s = min(-0.5_wp*slope/bend, right(n) - 0.5_wp*(left(n) + right(n)))
            largest = max(largest, q0 + s*(slope + s*bend))
        end if
        peak = sqrt(min(largest, maxval(value)**2 + 0.5_wp*largest_fall(value)))
    end function curve_peak

    !> The largest fall of the squares from a strip near the largest to a neighbour; zero beyond.
    pure real(wp) function largest_fall(value) result(fall)
        real(wp), intent(in) :: value(:)

        ! Strips with less than this of the largest have no peak beside them.
        ! Tuned [1]: of the largest. Origin: chosen: a strip with less has no peak beside it.
        real(wp), parameter :: near_largest = 0.9_wp
        real(wp) :: least, lower
        integer :: k, n

        n = size(value)
        least = near_largest*maxval(value)
        fall = 0.0_wp
        do k = 1, n
            if (value(k) < least) cycle
            lower = 0.0_wp
            if (k > 1 .and. k < n) lower = min(value(max(k - 1, 1)), value(min(k + 1, n)))
            fall = max(fall, value(k)**2 - lower**2)
        end do
    end function largest_fall

    !> Largest value on 0 <= t <= 1 of `q0 + (q1 - q0) t + t (t - 1) (b0 + (b1 - b0) t)`.
    pure real(wp) function peak_between(q0, q1, b0, b1) result(peak)
        real(wp), intent(in) :: q0, q1, b0, b1

        real(wp) :: a, b, c, discriminant, t

        peak = max(q0, q1)
        ! The slope a t^2 + 2 b t + c falls through zero at the maximum.
        a = 3.0_wp*(b1 - b0)
        b = 2.0_wp*b0 - b1
        c = q1 - q0 - b0
        discriminant = b*b - a*c
        if (discriminant <= 0.0_wp) return
        if (b > 0.0_wp) then
            if (-a < b + sqrt(discriminant)) return
            t = (b + sqrt(discriminant))/(-a)
        else
            if (c <= 0.0_wp .or. c > sqrt(discriminant) - b) return
            t = c/(sqrt(discriminant) - b)
        end if
        peak = max(peak, q0 + t*(q1 - q0 + (t - 1.0_wp)*(b0 + (b1 - b0)*t)))
    end function peak_between

    !> The parabola `q0 + slope s + bend s^2` of a square about the middle of strip k.
    pure subroutine parabola(left, right, value, k, q0, slope, bend)
        real(wp), intent(in) :: left(:), right(:), value(:)
        integer, intent(in) :: k
        real(wp), intent(out) :: q0, slope, bend

        real(wp) :: middle, before, after, q_before, q_after
        integer :: n

        n = size(value)
        middle = 0.5_wp*(left(k) + right(k))
        q0 = value(k)**2
        before = left(1) - middle
        q_before = 0.0_wp
        if (k > 1) then
            before = 0.5_wp*(left(k - 1) + right(k - 1)) - middle
            q_before = value(k - 1)**2
        end if
        after = right(n) - middle
        q_after = 0.0_wp
        if (k < n) then
            after = 0.5_wp*(left(k + 1) + right(k + 1)) - middle
            q_after = value(k + 1)**2
        end if
        slope = (q_after - q0)/after
        bend = (slope - (q_before - q0)/before)/(after - before)
        slope = slope - bend*after
    end subroutine parabola
end module faststrip_normal_patch_curves
