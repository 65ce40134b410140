!> A strip that slides all along: the integral of its bound against the rigid slip, `S9` of
!> `faststrip_tangential_faststrip`.
!>
!>     F = -mu int p s/|s| dx w,   s = (cksi - y cphi, ceta + x cphi),   Mz = int x py - y px
!>
!> The strip is cut into cells between equal angles of x = xd cos(theta). In a cell the mean
!> direction of the slip is exact, the pole of the spin included: with r1, r2 = |s| at its ends and
!> v = (s_y2 - s_y1)/(r1 + r2) it is `(s_y1 + s_y2)/(r1 + r2)` across and
!> `s_x 2/(r1 + r2) atanh(v)/v` along, the potential of a rod.
module faststrip_tangential_saturation
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_creepage, only: creepage_t
    implicit none
    private

    public :: saturate

    ! Tuned [cells]: Cells along a strip. Origin: chosen: the moment of any strip is within 3e-4 of
    ! its bound times xd.
    integer, parameter :: cells = 20

    ! Given: ends of the cells over xd, their shares of the strip's load and the centres of these.
    integer, parameter :: number(0:cells) = &
        [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20]
    real(wp), parameter :: angle(0:cells) = number*pi/cells
    real(wp), parameter :: edge(0:cells) = cos(angle)
    real(wp), parameter :: primitive(0:cells) = (angle - sin(angle)*cos(angle))/pi
    real(wp), parameter :: share(cells) = primitive(1:) - primitive(:cells - 1)
    real(wp), parameter :: first_moment(0:cells) = 2.0_wp/(3.0_wp*pi)*sin(angle)**3
    real(wp), parameter :: centre(cells) = (first_moment(1:) - first_moment(:cells - 1))/share
    ! Given: the square of x in a cell about its centre, over xd^2.
    real(wp), parameter :: spread(cells) = (edge(1:) - edge(:cells - 1))**2/12.0_wp

    ! Given: the series of atanh(v)/v in the square of v.
    real(wp), parameter :: series(0:6) = 1.0_wp/[1, 3, 5, 7, 9, 11, 13]

    ! Below this square of v seven terms of the series of atanh(v)/v are enough.
    ! Tuned [1]. Origin: chosen: the term left out is below 2e-10.
    real(wp), parameter :: series_bound = 0.06_wp

contains

    !> Force and moment of one strip on the rail, all of it sliding.
    pure subroutine saturate(bound, half_length, y, creepage, fx, fy, mz)
        real(wp), intent(in) :: bound       !! mu times the strip's load, N
        real(wp), intent(in) :: half_length !! mm
        real(wp), intent(in) :: y           !! of the strip's middle, mm from the reference point
        type(creepage_t), intent(in) :: creepage !! about the reference point
        real(wp), intent(out) :: fx, fy     !! N
        real(wp), intent(out) :: mz         !! about the reference point, N mm

        real(wp), dimension(0:cells) :: slip_y, slip
        real(wp), dimension(cells) :: both, v, along, across
        real(wp) :: slip_x, square, arm
        integer :: k

        slip_x = creepage%cksi - y*creepage%cphi
        slip_y = creepage%ceta + half_length*edge*creepage%cphi
        slip = sqrt(slip_x**2 + slip_y**2)
        ! Without slip a cell lies within the pole.
        both = max(slip(1:) + slip(:cells - 1), tiny(1.0_wp))
        v = (slip_y(1:) - slip_y(:cells - 1))/both
        across = (slip_y(1:) + slip_y(:cells - 1))/both
        do k = 1, cells
            square = v(k)*v(k)
            if (square < series_bound) then
                along(k) = series(0) + square*(series(1) + square*(series(2) &
                           + square*(series(3) + square*(series(4) + square*(series(5) &
                           + square*series(6))))))
            else if (abs(v(k)) < 1.0_wp) then
                along(k) = atanh(abs(v(k)))/abs(v(k))
            else
                along(k) = 0.0_wp ! slip_x is zero there
            end if
        end do
        along = 2.0_wp*slip_x*along/both
        fx = -bound*dot_product(share, along)
        fy = -bound*dot_product(share, across)
        ! In a cell the slip across changes with x.
        arm = dot_product(share, centre*across + spread*half_length*creepage%cphi*2.0_wp/both &
                                 *max(1.0_wp - across**2, 0.0_wp))
        mz = -bound*half_length*arm - y*fx
    end subroutine saturate
end module faststrip_tangential_saturation
