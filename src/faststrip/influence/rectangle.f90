!> The influence of a rectangle with constant traction on the surface of a half-space
!> (Boussinesq, Cerruti; Love 1929, Kalker 1990), as displacement differences of two bodies.
!>
!> With (x, y) from the source to the field point, r = sqrt(x^2 + y^2) and integrals over the
!> rectangle, two bodies in contact have (rail less wheel, z into the rail, tractions on the rail)
!>
!>     pi G u_z = (1 - nu) int p_n/r + K int (x p_x + y p_y)/r^2,
!>     pi G u_x = int [(1 - nu)/r + nu x^2/r^3] p_x + nu int x y/r^3 p_y - K int x/r^2 p_n,
!>     pi G u_y = nu int x y/r^3 p_x + int [(1 - nu)/r + nu y^2/r^3] p_y - K int y/r^2 p_n,
!>     K = (G/4) [(1 - 2 nu_rail)/G_rail - (1 - 2 nu_wheel)/G_wheel],
!>
!> G and nu of the combined body (`faststrip_base_material`). K vanishes for like materials.
!>
!> The integrals are differences of primitives at the corners. They are taken edge by edge, each
!> difference along an edge in a form that does not cancel, so that what is left to lose is a
!> factor distance over shorter side; from `far` half-sides on four Gauss points each way are exact
!> to rounding. Sides within 1e-100 and 1e100 mm and finite distances raise no exception.
module faststrip_influence_rectangle
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_limits, only: smallest_size
    use faststrip_base_material, only: material_t, combined_shear_modulus, combined_poisson_ratio
    implicit none
    private

    public :: rectangle_influence_t, rectangle_influence, rectangle_potential
    public :: coupling_constant

    !> Displacement differences at a point by unit tractions on a rectangle, mm/MPa. The first
    !> letter is the displacement's, the second the traction's.
    type :: rectangle_influence_t
        real(wp) :: zz = 0.0_wp !! u_z by the pressure
        real(wp) :: xx = 0.0_wp !! u_x by p_x
        real(wp) :: xy = 0.0_wp !! u_x by p_y, and u_y by p_x
        real(wp) :: yy = 0.0_wp !! u_y by p_y
        real(wp) :: zx = 0.0_wp !! u_z by p_x; u_x by the pressure is its opposite
        real(wp) :: zy = 0.0_wp !! u_z by p_y; u_y by the pressure is its opposite
    end type rectangle_influence_t

    ! Given: Gauss-Legendre with four points.
    real(wp), parameter :: node(4) = [-0.861136311594052575223946488892809505_wp, &
                                      -0.339981043584856264802665759103244687_wp, &
                                      0.339981043584856264802665759103244687_wp, &
                                      0.861136311594052575223946488892809505_wp]
    ! Given: Gauss-Legendre with four points.
    real(wp), parameter :: weight(4) = [0.347854845137453857373063949221999407_wp, &
                                        0.652145154862546142626936050778000593_wp, &
                                        0.652145154862546142626936050778000593_wp, &
                                        0.347854845137453857373063949221999407_wp]
    ! Distance, in half-sides, from which n Gauss points serve: their error is (2 far)^(-2 n).
    integer, parameter :: far = floor(0.5_wp*epsilon(1.0_wp)**(-0.5_wp/size(node)))
    ! Tuned [1]: ratio of distances up to which a difference of two terms loses no digit. Origin:
    ! chosen; round.
    real(wp), parameter :: cancelling = 0.1_wp

contains

    !> K: how much pressures move points along the surface; zero for like materials.
    pure real(wp) function coupling_constant(material) result(k)
        type(material_t), intent(in) :: material !! checked moduli, MPa

        ! 1/G = 2 (1 + nu)/E
        k = 0.5_wp*combined_shear_modulus(material) &
            *((1.0_wp - 2.0_wp*material%nu_rail)*(1.0_wp + material%nu_rail)/material%e_rail &
              - (1.0_wp - 2.0_wp*material%nu_wheel)*(1.0_wp + material%nu_wheel)/material%e_wheel)
    end function coupling_constant

    !> `int 1/r` over a rectangle, mm; times `normal_compliance` it is u_z by unit pressure, mm/MPa.
    elemental real(wp) function rectangle_potential(x, y, dx, dy) result(potential)
        real(wp), intent(in) :: x, y   !! from the middle of the rectangle to the field point, mm
        real(wp), intent(in) :: dx, dy !! sides, mm, > 0

        real(wp) :: x1, x2, y1, y2
        integer :: j

        if (is_far(x, y, dx, dy)) then
            potential = 0.0_wp
            do j = 1, 4
                potential = potential + weight(j)*sum(weight/sqrt((x + 0.5_wp*dx*node)**2 &
                                                                  + (y + 0.5_wp*dy*node(j))**2))
            end do
            potential = 0.25_wp*dx*dy*potential
            return
        end if
        x1 = x - 0.5_wp*dx
        x2 = x + 0.5_wp*dx
        y1 = y - 0.5_wp*dy
        y2 = y + 0.5_wp*dy
        potential = (edge(x1, x2, y2) - edge(x1, x2, y1)) + (edge(y1, y2, x2) - edge(y1, y2, x1))
    end function rectangle_potential

    !> All coefficients at one point.
    pure subroutine rectangle_influence(x, y, dx, dy, material, influence)
        real(wp), intent(in) :: x, y             !! from the rectangle's middle to the point, mm
        real(wp), intent(in) :: dx, dy           !! sides, mm, > 0
        type(material_t), intent(in) :: material !! checked moduli, MPa
        type(rectangle_influence_t), intent(out) :: influence !! mm/MPa

        real(wp) :: along, across, mixed, slope_x, slope_y, nu, factor, k

        call rectangle_integrals(x, y, dx, dy, along, across, mixed, slope_x, slope_y)
        nu = combined_poisson_ratio(material)
        factor = 1.0_wp/(pi*combined_shear_modulus(material))
        k = coupling_constant(material)
        influence%zz = factor*(1.0_wp - nu)*(along + across)
        influence%xx = factor*(along + (1.0_wp - nu)*across)
        influence%yy = factor*(across + (1.0_wp - nu)*along)
        influence%xy = factor*nu*mixed
        influence%zx = factor*k*slope_x
        influence%zy = factor*k*slope_y
    end subroutine rectangle_influence

    !> The integrals of x^2/r^3, y^2/r^3, xy/r^3, x/r^2 and y/r^2 over a rectangle, mm.
    pure subroutine rectangle_integrals(x, y, dx, dy, along, across, mixed, slope_x, slope_y)
        real(wp), intent(in) :: x, y, dx, dy
        real(wp), intent(out) :: along, across, mixed, slope_x, slope_y

        real(wp) :: x1, x2, y1, y2, r11, r12, r21, r22, s1, s2, u(4), v, q(4), cube(4)
        integer :: j

        if (is_far(x, y, dx, dy)) then
            along = 0.0_wp
            across = 0.0_wp
            mixed = 0.0_wp
            slope_x = 0.0_wp
            slope_y = 0.0_wp
            u = x + 0.5_wp*dx*node
            do j = 1, 4
                v = y + 0.5_wp*dy*node(j)
                q = weight(j)*weight/(u**2 + v**2)
                cube = q/sqrt(u**2 + v**2)
                along = along + sum(cube*u**2)
                across = across + sum(cube)*v**2
                mixed = mixed + sum(cube*u)*v
                slope_x = slope_x + sum(q*u)
                slope_y = slope_y + sum(q)*v
            end do
            v = 0.25_wp*dx*dy
            along = v*along
            across = v*across
            mixed = v*mixed
            slope_x = v*slope_x
            slope_y = v*slope_y
            return
        end if
        x1 = x - 0.5_wp*dx
        x2 = x + 0.5_wp*dx
        y1 = y - 0.5_wp*dy
        y2 = y + 0.5_wp*dy
        ! y asinh(x/|y|) has the mixed derivative x^2/r^3, x asinh(y/|x|) has y^2/r^3.
        along = edge(x1, x2, y2) - edge(x1, x2, y1)
        across = edge(y1, y2, x2) - edge(y1, y2, x1)
        ! -r has xy/r^3; differences of roots by their squares.
        r11 = hypot(x1, y1)
        r12 = hypot(x1, y2)
        r21 = hypot(x2, y1)
        r22 = hypot(x2, y2)
        s1 = r11 + r21
        s2 = r12 + r22
        mixed = 2.0_wp*x*dx*(2.0_wp*y*dy)*(1.0_wp/(r11 + r12) + 1.0_wp/(r21 + r22))/(s1*s2)
        ! y ln r + x atan(y/x) has x/r^2.
        slope_x = (log_edge(x, dx, y2, r12, r22) - log_edge(x, dx, y1, r11, r21)) &
                  + (angle_edge(y1, y2, x2) - angle_edge(y1, y2, x1))
        slope_y = (log_edge(y, dy, x2, r21, r22) - log_edge(y, dy, x1, r11, r12)) &
                  + (angle_edge(x1, x2, y2) - angle_edge(x1, x2, y1))
    end subroutine rectangle_integrals

    !> Is the field point far enough for Gauss points?
    elemental logical function is_far(x, y, dx, dy)
        real(wp), intent(in) :: x, y, dx, dy

        is_far = max(abs(x), abs(y)) > 0.5_wp*far*max(dx, dy)
    end function is_far

    !> `t [asinh(s2/|t|) - asinh(s1/|t|)]`, s1 < s2.
    elemental real(wp) function edge(s1, s2, t)
        real(wp), intent(in) :: s1, s2, t

        real(wp) :: length

        edge = 0.0_wp
        length = s2 - s1
        ! On the edge t ln t is below rounding.
        if (abs(t) <= smallest_size*length) return
        if (min(abs(s1), abs(s2)) > cancelling*length .and. s1*s2 > 0.0_wp) then
            edge = 2.0_wp*t*atanh(length/(hypot(s1, t) + hypot(s2, t)))
        else
            edge = t*(asinh(s2/abs(t)) - asinh(s1/abs(t)))
        end if
    end function edge

    !> `t ln(r2/r1)` along an edge of middle s, r2^2 - r1^2 = 2 s ds.
    elemental real(wp) function log_edge(s, ds, t, r1, r2)
        real(wp), intent(in) :: s, ds, t, r1, r2

        log_edge = 0.0_wp
        if (abs(t) <= smallest_size*ds) return
        if (min(r1, r2) < cancelling*max(r1, r2)) then
            log_edge = t*log(r2/r1)
        else
            log_edge = t*atanh(2.0_wp*s*ds/(r1*r1 + r2*r2))
        end if
    end function log_edge

    !> `t [atan(s2/t) - atan(s1/t)]`, s1 < s2.
    elemental real(wp) function angle_edge(s1, s2, t)
        real(wp), intent(in) :: s1, s2, t

        angle_edge = 0.0_wp
        if (abs(t) <= smallest_size*(s2 - s1)) return
        angle_edge = abs(t)*atan2(abs(t)*(s2 - s1), t*t + s1*s2)
    end function angle_edge
end module faststrip_influence_rectangle
