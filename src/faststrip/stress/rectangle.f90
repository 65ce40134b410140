!> Stresses in a half-space under a rectangle with uniform pressure and tractions (Boussinesq,
!> Cerruti; Love 1929; Johnson, Contact Mechanics, 1985, 3.2 to 3.6).
!>
!> The body fills z > 0; tension is positive; the pressure p presses into it, qx and qy act on it
!> along x and y. With rho = |(x - x', y - y', z)| and integrals over the rectangle,
!>
!>     V = int 1/rho,   W = int ln(rho + z),   F = int (z ln(rho + z) - rho),
!>
!> all harmonic, F_z = W, W_z = V, the stresses are, times 1/(2 pi), for p = 1
!>
!>     sxx = 2 nu V_z - (1 - 2 nu) W_xx - z V_xx   syy likewise    szz = V_z - z V_zz
!>     sxy = -(1 - 2 nu) W_xy - z V_xy             sxz = -z V_xz   syz = -z V_yz,
!>
!> and for qx = 1 (for qy x and y are exchanged)
!>
!>     sxx = (2 + 2 nu) V_x + 2 nu F_xxx - z W_xxx   syy = 2 nu V_x + 2 nu F_xyy - z W_xyy
!>     szz = -z V_xz   sxy = V_y + 2 nu F_xxy - z W_xxy   sxz = V_z - z V_xx   syz = -z V_xy.
!>
!> Each is a sum over the corners. The functions of a corner below differ from the derivatives by
!> terms of a or b alone, which drop out of the sum; so nothing cancels near edges, corners or the
!> surface. The error of the sum is some roundings of the load, anywhere; far away its relative
!> error is that of `distance^2/area` roundings.
!>
!> Singular only where it should be: at z = 0 the stress along an edge's normal is logarithmic on
!> edges where the traction along the normal jumps. There it is what it is at a rounding of the
!> side beside the edge, large but finite: sample middles.
module faststrip_stress_rectangle
    use faststrip_base_kinds, only: wp, pi
    implicit none
    private

    public :: corner_stress, rectangle_stress, edge_core
    public :: n_stresses, n_tractions

    !> Components of a stress: xx, yy, zz, xy, xz, yz; of a load: p, qx, qy.
    !> Given: their numbers.
    integer, parameter :: n_stresses = 6, n_tractions = 3
    ! Given: the order of the components.
    integer, parameter :: xx = 1, yy = 2, zz = 3, xy = 4, xz = 5, yz = 6
    integer, parameter :: p = 1, qx = 2, qy = 3

contains

    !> Function of a corner: with + at the lower left and upper right corner and - at the others
    !> the sum is the stress by unit loads on the rectangle.
    pure subroutine corner_stress(a, b, z, core, nu, k)
        real(wp), intent(in) :: a, b !! field point less corner, along x and y, mm
        real(wp), intent(in) :: z    !! depth, mm, >= 0
        real(wp), intent(in) :: core !! see `edge_core`, mm, > 0
        real(wp), intent(in) :: nu   !! Poisson's ratio
        real(wp), intent(out) :: k(n_stresses, n_tractions)
            !! stress by p, qx and qy of 1, a column each

        real(wp) :: r, ra, rb, rz, one, two, c, half_angle, vx, vy, vz, vxx, vyy, vxy, vxz, vyz, &
                    wxx, wyy, wxy, wxxx, wyyy

        c = 1.0_wp - 2.0_wp*nu
        ra = a*a + (z*z + core*core)
        rb = b*b + (z*z + core*core)
        r = sqrt(a*a + rb)
        rz = r + z
        one = 1.0_wp/rz
        two = one/r
        ! asinh(b/sqrt(ra)), asinh(a/sqrt(rb)): their absolute error counts.
        vx = sign(log((abs(b) + r)/sqrt(ra)), b)
        vy = sign(log((abs(a) + r)/sqrt(rb)), a)
        vz = -atan2(a*b, z*r)
        vxy = 1.0_wp/r
        vxx = -a*b/(r*ra)
        vyy = -a*b/(r*rb)
        vxz = -z*b/(r*ra)
        vyz = -z*a/(r*rb)
        half_angle = a*b*(a*a + b*b)
        wxx = atan2(half_angle, rz*(a*a*r + b*b*z))
        wyy = -vz - wxx
        wxy = log(rz)
        wxxx = -b*two - vxz
        wyyy = -a*two - vyz
        k(xx, p) = 2.0_wp*nu*vz - c*wxx - z*vxx
        k(yy, p) = 2.0_wp*nu*vz - c*wyy - z*vyy
        k(zz, p) = vz + z*(vxx + vyy)
        k(xy, p) = -c*wxy - z*vxy
        k(xz, p) = -z*vxz
        k(yz, p) = -z*vyz
        k(xx, qx) = (2.0_wp + 2.0_wp*nu)*vx + 2.0_wp*nu*(b*one - vx) - z*wxxx
        k(yy, qx) = 2.0_wp*nu*(vx - b*one) - z*b*two
        k(zz, qx) = -z*vxz
        k(xy, qx) = vy - 2.0_wp*nu*a*one - z*a*two
        k(xz, qx) = vz - z*vxx
        k(yz, qx) = -z*vxy
        k(yy, qy) = (2.0_wp + 2.0_wp*nu)*vy + 2.0_wp*nu*(a*one - vy) - z*wyyy
        k(xx, qy) = 2.0_wp*nu*(vy - a*one) - z*a*two
        k(zz, qy) = -z*vyz
        k(xy, qy) = vx - 2.0_wp*nu*b*one - z*b*two
        k(yz, qy) = vz - z*vyy
        k(xz, qy) = -z*vxy
        k = k*(0.5_wp/pi)
    end subroutine corner_stress

    !> Stress by unit loads on a rectangle.
    pure subroutine rectangle_stress(x, y, z, dx, dy, nu, k)
        real(wp), intent(in) :: x, y   !! from the rectangle's middle to the point, mm
        real(wp), intent(in) :: z      !! depth, mm, >= 0
        real(wp), intent(in) :: dx, dy !! sides, mm, > 0
        real(wp), intent(in) :: nu     !! Poisson's ratio
        real(wp), intent(out) :: k(n_stresses, n_tractions)
            !! xx, yy, zz, xy, xz, yz by p, qx and qy of 1, a column each

        real(wp) :: corner(n_stresses, n_tractions)
        integer :: i, j

        k = 0.0_wp
        do j = -1, 1, 2
            do i = -1, 1, 2
                call corner_stress(x - 0.5_wp*i*dx, y - 0.5_wp*j*dy, z, edge_core(dx, dy), nu, &
                                   corner)
                k = k + (i*j)*corner
            end do
        end do
    end subroutine rectangle_stress

    !> Distance that is added to that from an edge, squared, so that the logarithm stays finite; no
    !> other digit changes.
    elemental real(wp) function edge_core(dx, dy)
        real(wp), intent(in) :: dx, dy !! sides, mm

        edge_core = epsilon(1.0_wp)*min(dx, dy)
    end function edge_core
end module faststrip_stress_rectangle
