!> Displacement under strips, computed for the checks alone: nothing of the library's influence
!> rooms is used, so that an error there cannot hide itself.
!>
!> A strip's pressure `p0 sqrt(1 - u^2)`, u = x/xd, moves the place (x, y) by `H p0 xd I`,
!>
!>     I = int_{-1}^{1} sqrt(1 - u^2) [asinh(cr/|u - X|) - asinh(cl/|u - X|)] du,
!>
!> X = x/xd, cl and cr the distances of the strip's edges from y over xd. Away from the strip the
!> rule of Gauss and Chebyshev (second kind) serves. Near it u = cos(theta) is parted at the pole,
!> and the distance from it is the fifth power of the variable of Gauss and Legendre, which the
!> logarithm does not disturb. Six digits, of strips up to 1e4 times as long as wide.
module faststrip_lab_fuzz_influence
    use faststrip_base_kinds, only: wp, pi
    use faststrip_normal_strips, only: contact_strips_t
    implicit none
    private

    public :: displacement

    integer, parameter :: n_far = 10, n_near = 48
    real(wp), parameter :: far = 1.5_wp ! of the half-length: from here on Chebyshev's nodes serve

    real(wp) :: node(n_near) = 0.0_wp, weight(n_near) = 0.0_wp ! of Gauss and Legendre on [0, 1]
    real(wp) :: far_node(n_far), far_weight(n_far)
    logical :: is_ready = .false.

contains

    !> Displacement over the compliance H, MPa mm, of a place.
    real(wp) function displacement(strips, x, y)
        type(contact_strips_t), intent(in) :: strips !! with pressures and lengths
        real(wp), intent(in) :: x, y                 !! mm

        integer :: s

        if (.not. is_ready) call make_nodes()
        displacement = 0.0_wp
        do s = 1, strips%n
            associate (a => strips%half_length(s))
                displacement = displacement + strips%p0(s)*a &
                               *influence(abs(x)/a, (strips%y_left(s) - y)/a, &
                                          (strips%y_right(s) - y)/a)
            end associate
        end do
    end function displacement

    real(wp) function influence(x, left, right)
        real(wp), intent(in) :: x, left, right

        real(wp) :: c_left, c_right

        c_left = left
        c_right = right
        ! The nearer edge first, the place not between them: the kernel is even.
        if (left + right < 0.0_wp) then
            c_left = -right
            c_right = -left
        end if
        if (max(c_left, x - 1.0_wp) > far) then
            influence = sum(far_weight*kernel(abs(far_node - x), c_left, c_right))
        else if (x < 1.0_wp) then
            influence = side(acos(x), x) + side(pi - acos(x), -x)
        else
            influence = side(pi, x)
        end if

    contains

        !> One side of the pole, over the angle from it. x is the pole seen from this side.
        real(wp) function side(angle, pole)
            real(wp), intent(in) :: angle, pole

            real(wp) :: tau(n_near), u(n_near), distance(n_near), outside

            tau = angle*node**5
            outside = max(pole - 1.0_wp, 0.0_wp)
            u = sin(angle - tau)
            distance = outside + 2.0_wp*sin(angle - 0.5_wp*tau)*sin(0.5_wp*tau)
            if (pole > 1.0_wp) then
                u = sin(tau)
                distance = outside + 2.0_wp*sin(0.5_wp*tau)**2
            end if
            side = sum(weight*5.0_wp*angle*node**4*u**2*kernel(distance, c_left, c_right))
        end function side
    end function influence

    elemental real(wp) function kernel(distance, c_left, c_right)
        real(wp), intent(in) :: distance, c_left, c_right

        if (c_left > 0.0_wp) then
            kernel = log((c_right + sqrt(c_right**2 + distance**2)) &
                         /(c_left + sqrt(c_left**2 + distance**2)))
        else
            kernel = log((c_right + sqrt(c_right**2 + distance**2)) &
                         *(-c_left + sqrt(c_left**2 + distance**2))/distance**2)
        end if
    end function kernel

    !> Nodes and weights of both rules.
    subroutine make_nodes()
        real(wp) :: z, p, before, last, slope
        integer :: i, k, step

        far_node = [(cos(i*pi/(n_far + 1)), i=1, n_far)]
        far_weight = [(pi/(n_far + 1)*sin(i*pi/(n_far + 1))**2, i=1, n_far)]
        do i = 1, n_near
            z = cos(pi*(i - 0.25_wp)/(n_near + 0.5_wp))
            do step = 1, 8
                p = 1.0_wp
                before = 0.0_wp
                do k = 1, n_near
                    last = before
                    before = p
                    p = ((2*k - 1)*z*before - (k - 1)*last)/k
                end do
                slope = n_near*(z*p - before)/(z*z - 1.0_wp)
                z = z - p/slope
            end do
            node(i) = 0.5_wp*(1.0_wp + z)
            weight(i) = 1.0_wp/((1.0_wp - z*z)*slope**2)
        end do
        is_ready = .true.
    end subroutine make_nodes
end module faststrip_lab_fuzz_influence
