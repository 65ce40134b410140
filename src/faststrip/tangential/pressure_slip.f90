!> The slip that pressures cause between dissimilar materials, strip by strip, closed.
!>
!> Pressures move the surfaces along each other by `u = -K/(pi G) int p (X, Y)/(X^2 + Y^2)`,
!> X = x - x', Y = y - y' (Johnson, Contact Mechanics, 1985, section 3.2; K of
!> `faststrip_influence_rectangle`). Of a strip with the pressure p0 sqrt(1 - (x/xd)^2), with
!> zeta = (x + i (y - y'))/xd and w(zeta) = zeta - sqrt(zeta - 1) sqrt(zeta + 1),
!>
!>     int sqrt(1 - s^2)/(zeta - s) ds = pi w(zeta)
!>
!> so that the slip in rolling, w = -du/dx, is
!>
!>     w_x - i w_y = (K/G) i p0 {w(zeta_2) - w(zeta_1)},   in the strip w_x + 2 (K/G) p besides,
!>
!> zeta_1 and zeta_2 of its left and right edge. Tractions do not change pressures here (Goodman).
module faststrip_tangential_pressure_slip
    use faststrip_base_kinds, only: wp
    use faststrip_base_material, only: material_t, combined_shear_modulus
    use faststrip_influence_rectangle, only: coupling_constant
    use faststrip_normal_strips, only: contact_strips_t
    implicit none
    private

    public :: slip_by_pressure, find_pressure_slip, node_weights, bed_factor, n_nodes

    !> Places along a strip where the slip is known, but for what its own pressure does to it there:
    !> Chebyshev's.
    !> Tuned [points]. Origin: chosen: seven change no force by 1e-4 of mu N.
    integer, parameter :: n_nodes = 5

    ! Coupling below which materials are alike.
    ! Tuned [1]. Origin: moduli given with five digits.
    real(wp), parameter :: least_coupling = 1.0e-5_wp

    ! Given: Chebyshev's nodes, cos(pi/10), cos(3 pi/10) and their opposites.
    real(wp), parameter :: node(n_nodes) = [ &
        0.951056516295153572116439333379382143_wp, 0.587785252292473129168705954639072769_wp, &
        0.0_wp, -0.587785252292473129168705954639072769_wp, &
        -0.951056516295153572116439333379382143_wp]

    ! Proportions a/b of ellipses.
    ! Given: places of a table.
    real(wp), parameter :: ratio(8) = [0.01_wp, 0.1_wp, 0.2_wp, 0.5_wp, 1.0_wp, 2.0_wp, 5.0_wp, &
                                       10.0_wp]
    ! By how much the bedding of springs is too stiff for this slip there.
    ! Tuned [1]. Origin: TANG's force in full adhesion, plane strain (pi^2/8) at the first; between
    ! by the logarithm.
    real(wp), parameter :: factor(8) = [1.234_wp, 1.307_wp, 1.322_wp, 1.351_wp, 1.377_wp, &
                                        1.397_wp, 1.414_wp, 1.418_wp]
    ! Slope of adhesion by the slip over the bound's, at which half of that is left: where the slip
    ! by pressures alone makes the patch slide it counts as it is.
    ! Tuned [1]. Origin: TANG on a circle and an ellipse, mu from .005 to .1.
    real(wp), parameter :: half_adhesion = 5.0_wp

contains

    !> K/G, slip by unit pressure, 1/MPa; zero of like materials.
    pure real(wp) function slip_by_pressure(material) result(slip)
        type(material_t), intent(in) :: material !! checked moduli, MPa

        slip = coupling_constant(material)
        if (abs(slip) <= least_coupling) slip = 0.0_wp
        slip = slip/combined_shear_modulus(material)
    end function slip_by_pressure

    !> Slip at the nodes of a strip by all pressures, but for the part 2 (K/G) p of its own.
    pure subroutine find_pressure_slip(strips, k, factor, slip_x, slip_y)
        type(contact_strips_t), intent(in) :: strips !! a normal solution
        integer, intent(in) :: k                     !! of its strips
        real(wp), intent(in) :: factor               !! K/G, 1/MPa
        real(wp), intent(out) :: slip_x(n_nodes)     !! over the rolling speed, along
        real(wp), intent(out) :: slip_y(n_nodes)     !! and across

        complex(wp) :: total
        real(wp) :: y, x
        integer :: at, j

        y = 0.5_wp*(strips%y_left(k) + strips%y_right(k))
        ! With x the real part of what is summed changes its sign, the imaginary one stays.
        do at = 1, (n_nodes + 1)/2
            x = strips%half_length(k)*node(at)
            total = 0.0_wp
            do j = 1, strips%n
                if (.not. strips%p0(j) > 0.0_wp) cycle
                associate (xd => strips%half_length(j))
                    total = total + strips%p0(j)*(w(cmplx(x, y - strips%y_right(j), wp)/xd) &
                                                  - w(cmplx(x, y - strips%y_left(j), wp)/xd))
                end associate
            end do
            ! Times i: the real part of i z is -Im z, the imaginary one Re z.
            slip_x(at) = -factor*aimag(total)
            slip_y(at) = -factor*real(total)
            slip_x(n_nodes + 1 - at) = slip_x(at)
            slip_y(n_nodes + 1 - at) = merge(slip_y(at), -slip_y(at), 2*at > n_nodes)
        end do
    end subroutine find_pressure_slip

    !> zeta - sqrt(zeta - 1) sqrt(zeta + 1), without cancellation.
    elemental complex(wp) function w(zeta)
        complex(wp), intent(in) :: zeta

        complex(wp) :: root

        ! Of both roots that on the side of zeta.
        root = sqrt((zeta - 1.0_wp)*(zeta + 1.0_wp))
        if (real(zeta)*real(root) + aimag(zeta)*aimag(root) < 0.0_wp) root = -root
        w = 1.0_wp/(zeta + root)
    end function w

    !> Weights of the nodes for a place between them: Lagrange's polynomial.
    pure function node_weights(t) result(weights)
        real(wp), intent(in) :: t !! over the half-length, -1 to 1
        real(wp) :: weights(n_nodes)

        integer :: i, j

        weights = 1.0_wp
        do i = 1, n_nodes
            do j = 1, n_nodes
                if (j /= i) weights(i) = weights(i)*(t - node(j))/(node(i) - node(j))
            end do
        end do
    end function node_weights

    !> What the slip by pressures is divided by where a bedding of springs takes it.
    pure real(wp) function bed_factor(a, b, share)
        real(wp), intent(in) :: a, b  !! semi-axes of the patch, along and across, mm
        real(wp), intent(in) :: share !! traction by the slip in adhesion over its bound

        real(wp) :: place
        integer :: i

        place = min(max(a/b, ratio(1)), ratio(size(ratio)))
        i = min(max(count(ratio <= place), 1), size(ratio) - 1)
        bed_factor = factor(i) + (factor(i + 1) - factor(i)) &
                     *log(place/ratio(i))/log(ratio(i + 1)/ratio(i))
        bed_factor = 1.0_wp + (bed_factor - 1.0_wp)/(1.0_wp + (share/half_adhesion)**4)
    end function bed_factor
end module faststrip_tangential_pressure_slip
