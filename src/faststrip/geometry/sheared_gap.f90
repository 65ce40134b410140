!> The gap of a yawed wheel, whose strips do not stand beside each other: wheel and rail are nearest
!> at x0(y), which runs with y.
!>
!> To second order the gap is `A (x - s y)**2 + B y**2`. Its principal axes are turned by theta,
!> `tan(2 theta) = 2 A s/(B + A s**2 - A)`, in which it is `A* x'**2 + B* y'**2`, with
!> `A* B* = A B` and `A* + B* = A + B + A s**2`. The strips of a normal solution lie along x': the
!> least of the gap on each line along x' is the height there. Forces take these strips along the
!> rolling direction x, theta away (some hundredths on a flange).
!>
!> With s and B by least squares over the overlap, each point weighted as in `overlap`; a point y of
!> the gap comes to lie at `x = x0 - f' sin(theta)/(2 A (cos(theta) - s sin(theta)))`, f its height,
!> and has the slope `f'/(cos(theta) - s sin(theta))`.
module faststrip_geometry_sheared_gap
    use faststrip_base_kinds, only: wp
    use faststrip_geometry_contact_frame, only: frame_gap_t
    use faststrip_geometry_overlap, only: depth_weight
    implicit none
    private

    public :: turn_sheared_gap

    ! Tuned [1]: A s**2 over B beyond which no axes are sought. Origin: safeguard: the gap is no
    ! paraboloid.
    real(wp), parameter :: most_shear = 0.5_wp
    ! Tuned [1]: B over A up to which gaps stay as they are, and from which they are turned wholly.
    ! Origin: measured: up to 20 strips at their places are as near to the exact gap (0.5 % of the
    ! load), and where curvature jumps far nearer (1 instead of 16 %); from 100 turned ones are
    ! (0.3 instead of 0.7 %).
    real(wp), parameter :: round_ratio = 20.0_wp, slender_ratio = 2.0_wp*round_ratio
    ! Part of a determinant that has half of its digits: of fewer than three points nothing is left.
    real(wp), parameter :: least_determinant = sqrt(epsilon(1.0_wp))

contains

    !> Turn a gap into its principal axes; one without shear stays as it is.
    pure subroutine turn_sheared_gap(gap)
        type(frame_gap_t), intent(inout) :: gap !! sampled; its slope is known

        real(wp) :: a, b, s, b_turned, a_turned, theta, cosine, sine, x, part, share
        integer :: i, n

        call fit_paraboloid(gap, a, b, s)
        if (.not. abs(s) > 0.0_wp) return
        part = a*s**2/b
        if (part > most_shear) s = s*sqrt(most_shear/part)
        ! A round or wide patch is not turned: its strips lie at their places. The turn fades in.
        share = max(0.0_wp, min((b/a - round_ratio)/(slender_ratio - round_ratio), 1.0_wp))
        s = s*share
        if (.not. abs(s) > 0.0_wp) return
        theta = 0.5_wp*atan2(2.0_wp*a*s, b + a*s**2 - a)
        cosine = cos(theta)
        sine = sin(theta)
        b_turned = 0.5_wp*(a + b + a*s**2 + sqrt((b + a*s**2 - a)**2 + (2.0_wp*a*s)**2))
        a_turned = a*b/b_turned
        n = gap%n
        do i = 2, n
            ! Where a kink would fold the gap it stays as it is.
            if (turned(i) <= turned(i - 1)) return
        end do
        do i = 1, n
            x = along(i)
            gap%y(i) = turned(i)
            gap%h(i) = gap%h(i) + a*x**2
            gap%slope(i) = gap%slope(i)/(cosine - s*sine)
            gap%inv2r(i) = gap%inv2r(i)*a_turned/a
            gap%x0(i) = gap%x0(i)*(1.0_wp - share)
        end do

    contains

        pure real(wp) function along(i)
            integer, intent(in) :: i

            along = -gap%slope(i)*sine/(2.0_wp*a*(cosine - s*sine))
        end function along

        pure real(wp) function turned(i)
            integer, intent(in) :: i

            turned = cosine*gap%y(i) - sine*(along(i) + s*gap%y(i))
        end function turned
    end subroutine turn_sheared_gap

    ! A, B and s about the middle of the overlap.
    pure subroutine fit_paraboloid(gap, a, b, s)
        type(frame_gap_t), intent(in) :: gap
        real(wp), intent(out) :: a, b, s

        real(wp) :: weight, total, y, y2, mean_y, mean_x, moment(0:4), right(0:2), xy, yy, scale, &
            determinant
        integer :: i

        b = 1.0_wp
        s = 0.0_wp
        total = 0.0_wp
        mean_y = 0.0_wp
        mean_x = 0.0_wp
        a = 0.0_wp
        do i = 1, gap%n
            weight = weight_of(i)
            total = total + weight
            mean_y = mean_y + weight*gap%y(i)
            mean_x = mean_x + weight*gap%x0(i)
            a = a + weight*gap%inv2r(i)
        end do
        if (.not. total > 0.0_wp) return
        mean_y = mean_y/total
        mean_x = mean_x/total
        a = a/total
        moment = 0.0_wp
        right = 0.0_wp
        xy = 0.0_wp
        yy = 0.0_wp
        do i = 1, gap%n
            weight = weight_of(i)/total
            y = gap%y(i) - mean_y
            y2 = y**2
            moment = moment + weight*[1.0_wp, y, y2, y*y2, y2**2]
            right = right + weight*gap%h(i)*[1.0_wp, y, y2]
            xy = xy + weight*y*(gap%x0(i) - mean_x)
            yy = yy + weight*y2
        end do
        if (.not. yy > 0.0_wp) return
        ! Normal equations of h = c0 + c1 y + B y**2 with moment(0) = 1 and moment(1) = 0.
        scale = moment(2)*moment(4)
        determinant = moment(2)*(moment(4) - moment(2)**2) - moment(3)**2
        if (determinant <= least_determinant*scale) return
        b = (moment(2)*(right(2) - moment(2)*right(0)) - moment(3)*right(1))/determinant
        if (b <= 0.0_wp) return
        s = xy/yy

    contains

        pure real(wp) function weight_of(i)
            integer, intent(in) :: i

            integer :: before, after

            weight_of = 0.0_wp
            if (gap%h(i) >= gap%overlap) return
            before = max(i - 1, 1)
            after = min(i + 1, gap%n)
            weight_of = depth_weight(gap%overlap - gap%h(i))*(gap%y(after) - gap%y(before))
        end function weight_of
    end subroutine fit_paraboloid
end module faststrip_geometry_sheared_gap
