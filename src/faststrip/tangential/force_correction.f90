!> What the march in the strips misses of the forces of one patch, S10 of
!> `faststrip_tangential_faststrip`: a smooth function of the creepages, of the ellipse's
!> proportion, of Poisson's ratio and of the patch's shape, fitted to Kalker's variational method.
!>
!> With u the linear forces over mu N and v = u/sqrt(1 + |u|^2), the correction over mu N (moment
!> about the centroid over mu N sqrt(ab)) is
!>
!>     Fx: A1 v1 + sum o_j (D_j v2 + E_j v3),   Fy: A2 v2 + A3 v3 + sum o_j G_j v1,
!>     Mz: A4 v3 + A5 v2 + sum o_j H_j v1,
!>
!> o_j the odd numbers of the shape. The factors A to H are a network of two layers of numbers that
!> do not change when the creepages change sign or left and right are exchanged; so both
!> symmetries are exact. The part that an ellipse has is multiplied by |v|, which leaves the linear
!> forces; the part of the shape by a measure of it, which leaves the ellipses. Both fade out where
!> everything slides, and outside what the fit has seen.
module faststrip_tangential_force_correction
    use faststrip_base_kinds, only: wp
    use faststrip_tangential_patch_shape, only: patch_shape_t, n_even
    use faststrip_tangential_force_weights, only: &
        n_inputs, n_hidden, n_outputs, n_sides, first, first_bias, second, second_bias, third, &
        third_bias, side_scale, even_scale, odd_scale, half_shape, largest_log_ratio, &
        largest_shape, least_poisson, largest_poisson
    implicit none
    private

    public :: rolling_state_t, force_correction

    !> What the correction of a patch depends on.
    type :: rolling_state_t
        real(wp) :: linear(3) = 0.0_wp
            !! linear forces of the ellipse over mu N, with the signs of the creepages
        real(wp) :: creepage(3) = 0.0_wp
            !! of the ellipse's centre: cksi, ceta, and cphi in 1/mm
        real(wp) :: a = 0.0_wp, b = 0.0_wp !! semi-axes of the ellipse, mm
        real(wp) :: poisson = 0.0_wp       !! combined Poisson's ratio
        real(wp) :: sliding = 0.0_wp       !! weight of full sliding, 0 to 1
    end type rolling_state_t

    ! Given: factors that an ellipse has, those of the formulas above.
    integer, parameter :: n_ellipse = 5

    ! Where nothing moves there is no direction.
    ! Tuned [1]. Origin: safeguard: changes no digit.
    real(wp), parameter :: least = 1.0e-200_wp
    ! Tuned [1]: Linear force over mu N above which the inputs tell strong from stronger creepage.
    ! Origin: chosen.
    real(wp), parameter :: strong = 10.0_wp

contains

    !> Forces over mu N and moment about the centroid over mu N sqrt(ab), to be added.
    pure function force_correction(state, shape) result(missing)
        type(rolling_state_t), intent(in) :: state
        type(patch_shape_t), intent(in) :: shape
        real(wp) :: missing(3)

        real(wp) :: x(n_inputs), c(n_outputs), v(3), o(n_sides), squared, unlike, seen
        integer :: j, k

        squared = sum(state%linear**2)
        unlike = sum((even_scale*shape%even)**2) + sum((odd_scale*shape%odd)**2)
        seen = (1.0_wp - state%sliding) &
               *fade(abs(log(state%a/state%b))/largest_log_ratio)*fade(sqrt(unlike)/largest_shape)
        missing = 0.0_wp
        if (seen <= 0.0_wp .or. squared <= least) return
        v = state%linear/sqrt(1.0_wp + squared)
        call find_inputs(state, shape, v, squared, x)
        c = network(x)
        o = shape%odd(:n_sides)/side_scale
        ! The ellipse's part, then that of the shape.
        associate (ellipse => norm2(v), form => unlike/(unlike + half_shape))
            missing = [(ellipse*c(1) + form*c(6))*v(1), &
                       (ellipse*c(2) + form*c(7))*v(2) + (ellipse*c(3) + form*c(8))*v(3), &
                       (ellipse*c(4) + form*c(9))*v(3) + (ellipse*c(5) + form*c(10))*v(2)]
            k = n_ellipse + n_ellipse ! behind both sets of factors of an ellipse
            do j = 1, n_sides
                missing(1) = missing(1) + form*o(j)*(c(k + 1)*v(2) + c(k + 2)*v(3))
                k = k + 2
            end do
            missing(2) = missing(2) + form*v(1)*dot_product(o, c(k + 1:k + n_sides))
            k = k + n_sides
            missing(3) = missing(3) + form*v(1)*dot_product(o, c(k + 1:k + n_sides))
        end associate
        missing = seen*missing
    end function force_correction

    !> 1 up to 1, then smoothly down to 0 at 2.
    elemental real(wp) function fade(x)
        real(wp), intent(in) :: x

        real(wp) :: t

        t = min(max(x - 1.0_wp, 0.0_wp), 1.0_wp)
        ! Given: the polynomial with two derivatives zero at both ends
        fade = 1.0_wp - t*t*t*(10.0_wp - t*(15.0_wp - 6.0_wp*t))
    end function fade

    !> What the network is told: nothing that changes when the creepages change sign or left and
    !> right are exchanged.
    pure subroutine find_inputs(state, shape, v, squared, x)
        type(rolling_state_t), intent(in) :: state
        type(patch_shape_t), intent(in) :: shape
        real(wp), intent(in) :: v(3), squared
        real(wp), intent(out) :: x(n_inputs)

        real(wp) :: slip

        associate (c => state%creepage, o => shape%odd)
            ! Where the pole of the spin lies in the ellipse.
            slip = c(1)**2 + c(2)**2 + 0.25_wp*c(3)**2*(state%a**2 + state%b**2) + least
            x(:13) = [v(1)**2, v(2)**2, v(3)**2, v(2)*v(3), log(1.0_wp + squared), &
                      log(state%a/state%b), min(max(state%poisson, least_poisson), &
                                                largest_poisson), &
                      c(1)**2/slip, c(2)**2/slip, c(2)*c(3)*state%a/slip, &
                      c(3)**2*state%a*state%b/slip, log(1.0_wp + squared/strong**2), &
                      shape%even(1)]
            x(14:12 + n_even) = shape%even(2:)
            x(13 + n_even:16 + n_even) = o(:4)*(v(1)*v(2))
            x(17 + n_even:20 + n_even) = o(:4)*(v(1)*v(3))
            x(21 + n_even:) = [o(1)**2, o(2)**2, o(3)**2, o(4)**2, o(1)*o(2), o(1)*o(3)]
        end associate
    end subroutine find_inputs

    !> Two layers of x/sqrt(1 + x^2), then a linear one.
    pure function network(x) result(c)
        real(wp), intent(in) :: x(n_inputs)
        real(wp) :: c(n_outputs)

        real(wp), dimension(n_hidden) :: one, two
        integer :: j

        one = first_bias
        do j = 1, n_inputs
            one = one + first(:, j)*x(j)
        end do
        one = one/sqrt(1.0_wp + one*one)
        two = second_bias
        do j = 1, n_hidden
            two = two + second(:, j)*one(j)
        end do
        two = two/sqrt(1.0_wp + two*two)
        c = third_bias
        do j = 1, n_hidden
            c = c + third(:, j)*two(j)
        end do
    end function network
end module faststrip_tangential_force_correction
