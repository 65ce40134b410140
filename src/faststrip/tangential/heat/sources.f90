!> Temperatures under heat that moves fast over a half-space, which flows in depth only (J. C.
!> Jaeger, Proc. R. Soc. NSW 76, 1942; H. S. Carslaw and J. C. Jaeger, Conduction of heat in solids,
!> 1959, section 10.7): at the distance s behind the leading edge the rise is proportional to
!>
!>     I(s) = int_0^s q(s')/sqrt(s - s') ds'.
!>
!> In t = s/xd - 1, -1 at the leading edge and 1 at the trailing one, over sqrt(xd):
!>
!> - uniform q = 1: `2 sqrt(t + 1)`, behind the trailing edge `4/(sqrt(t + 1) + sqrt(t - 1))`;
!> - semi-elliptic q = sqrt(1 - t^2): `(4 sqrt2/3) [t E + (1 - t)/2 K]`, m = (1 + t)/2; behind
!>   `8/sqrt(1 + t) [(2 - m) E - 2 (1 - m) K]/(3 m^2)`, m = 2/(1 + t). With B = K - D and E = B +
!>   (1 - m) D the first is `(4 sqrt2/3) m [B + 2 (1 - m) D]`, a sum of positive terms, and the
!>   second `8/sqrt(1 + t) [B - (1 - m) D]/(3 m)`.
!>
!> Heat that is uniform over each of the elements of a row, all of one length, has at the middle of
!> element i `sqrt(length) sum_j W(i - j) q_j`: one table of numbers serves all rows. A march
!> knows the heat of its steps instead, from middle to middle, the first half as long.
module faststrip_tangential_heat_sources
    use faststrip_base_kinds, only: wp
    use faststrip_numerics_elliptic, only: complete_elliptic, complete_elliptic_d
    use faststrip_tangential_types, only: most_points
    implicit none
    private

    public :: uniform_source, semi_elliptic_source, rise_ahead, rise_by_steps, own_weight
    public :: most_along, weight_of_itself

    !> The most elements along a row.
    integer, parameter :: most_along = most_points
    !> What the heat of an element does at its middle: `int ds/sqrt(s)` over half of it, over the
    !> root of its length.
    real(wp), parameter :: weight_of_itself = sqrt(2.0_wp)

contains

    !> `int ds/sqrt(t - s)` from -1 on, to 1 at most: a uniform source.
    elemental real(wp) function uniform_source(t) result(rise)
        real(wp), intent(in) :: t !! place over half-length; below -1 there is no heat yet

        rise = 2.0_wp*sqrt(max(t + 1.0_wp, 0.0_wp))
        if (t > 1.0_wp) rise = 4.0_wp/(sqrt(t + 1.0_wp) + sqrt(t - 1.0_wp))
    end function uniform_source

    !> `int sqrt(1 - s^2)/sqrt(t - s) ds` likewise: the heat of pressure that slides. Within 1e-9,
    !> relative, up to t = 1e6.
    elemental real(wp) function semi_elliptic_source(t) result(rise)
        real(wp), intent(in) :: t !! place over half-length; below -1 there is no heat yet

        real(wp) :: m, m1, k, e, d

        rise = 0.0_wp
        if (t <= -1.0_wp) return
        m = 0.5_wp*(1.0_wp + t)
        m1 = 0.5_wp*abs(1.0_wp - t)
        if (t > 1.0_wp) then
            m1 = m1/m
            m = 1.0_wp/m
        end if
        ! At the trailing edge B is 1, and (1 - m) D is nothing.
        m1 = max(m1, tiny(m1))
        call complete_elliptic(m1, k, e)
        d = complete_elliptic_d(m1)
        if (t > 1.0_wp) then
            ! Given: as above.
            rise = 8.0_wp/(3.0_wp*m*sqrt(1.0_wp + t))*(k - d - m1*d)
        else
            rise = 4.0_wp*sqrt(2.0_wp)/3.0_wp*m*(k - d + 2.0_wp*m1*d)
        end if
    end function semi_elliptic_source

    !> What the heat of the elements ahead in its row does at the middle of an element, over the
    !> root of their length.
    pure real(wp) function rise_ahead(heat)
        real(wp), intent(in) :: heat(:) !! of these elements, the leading edge first

        integer :: k
        ! The table: what the heat of an element does so many elements behind.
        real(wp), parameter :: weight(most_along) = &
            [(2.0_wp/(sqrt(k + 0.5_wp) + sqrt(k - 0.5_wp)), k=1, most_along)]

        rise_ahead = dot_product(weight(size(heat):1:-1), heat)
    end function rise_ahead

    !> What the heat of the steps before does at the end of the next step of a march, over the root
    !> of their length.
    pure real(wp) function rise_by_steps(heat) result(rise)
        real(wp), intent(in) :: heat(:) !! of these steps, uniform over each, the first one first

        integer :: i, k, n
        ! What the heat of a step does so many steps behind its end.
        real(wp), parameter :: weight(most_points) = &
            [(2.0_wp/(sqrt(k + 1.0_wp) + sqrt(real(k, wp))), k=1, most_points)]

        n = size(heat)
        rise = 0.0_wp
        if (n == 0) return
        rise = heat(1)/(sqrt(n + 0.5_wp) + sqrt(real(n, wp)))
        do i = 2, n
            rise = rise + heat(i)*weight(n + 1 - i)
        end do
    end function rise_by_steps

    !> The same of the step itself.
    elemental real(wp) function own_weight(step)
        integer, intent(in) :: step !! from 1 on

        own_weight = merge(weight_of_itself, 2.0_wp, step == 1)
    end function own_weight
end module faststrip_tangential_heat_sources
