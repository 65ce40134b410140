!> What the networks of the force correction and of its errors have in common: their inputs
!> of a patch that rolls, and how a network of two layers is evaluated.
module faststrip_tangential_force_network
    use faststrip_base_kinds, only: wp
    use faststrip_base_limits, only: nothing
    use faststrip_tangential_patch_shape, only: patch_shape_t, n_even
    use faststrip_tangential_force_weights, only: &
        n_ellipse_inputs, n_shape_inputs, even_scale, odd_scale, largest_log_ratio, &
        largest_shape, least_poisson, largest_poisson, hidden, error_hidden
    implicit none
    private

    public :: rolling_state_t, network_inputs, evaluate_network, shape_measure, share_seen, &
              share_rolling, least

    !> What the forces of a patch depend on beside its shape.
    type :: rolling_state_t
        real(wp) :: linear(3) = 0.0_wp
            !! linear forces of the ellipse over mu N, with the signs of the creepages
        real(wp) :: creepage(3) = 0.0_wp
            !! of the ellipse's centre: cksi, ceta, and cphi in 1/mm
        real(wp) :: a = 0.0_wp, b = 0.0_wp !! semi-axes of the ellipse, mm
        real(wp) :: poisson = 0.0_wp       !! combined Poisson's ratio
        real(wp) :: sliding = 0.0_wp       !! weight of saturation, 0 to 1
        integer :: points = 1              !! of the march, along a strip
    end type rolling_state_t

    ! Where nothing moves there is no direction; changes no digit.
    real(wp), parameter :: least = nothing**2
    ! Tuned [1]: Linear force over mu N above which the inputs tell strong from stronger creepage.
    ! Origin: chosen.
    real(wp), parameter :: strong = 10.0_wp
    ! Tuned [1]: The same, weak from weaker creepage. Origin: chosen.
    real(wp), parameter :: weak = 0.2_wp
    ! Tuned [1]: What counts, squared, beside the distances of the pole of spin from the axes.
    ! Origin: chosen: the factors may change over a seventh of the ellipse.
    real(wp), parameter :: near = 0.02_wp
    ! Linear force over mu N from where a patch without spin slides whole.
    ! Given: Carter's contact slides whole from 2 on.
    real(wp), parameter :: whole_slip = 2.0_wp
    ! Tuned [1]: Slip by spin over that of the centre up to where a patch counts as not spinning;
    ! nothing is left of this at twice as much. Origin: chosen.
    real(wp), parameter :: little_spin = 0.05_wp

contains

    !> Inputs of networks: first of creepages, ellipse and elements, then of the shape. Nothing
    !> of it changes when the creepages change sign or left and right are exchanged.
    pure subroutine network_inputs(state, shape, x, v)
        type(rolling_state_t), intent(in) :: state !! that moves
        type(patch_shape_t), intent(in) :: shape   !! of the patch
        real(wp), intent(out) :: x(n_ellipse_inputs + n_shape_inputs)
        real(wp), intent(out) :: v(3)
            !! the linear forces over mu N, over the root of 1 and the sum of their squares

        real(wp) :: squared

        squared = sum(state%linear**2)
        v = state%linear/sqrt(1.0_wp + squared)
        call ellipse_inputs(state, shape%width, v, squared, x(:n_ellipse_inputs))
        call shape_inputs(shape, v, x(n_ellipse_inputs + 1:))
    end subroutine network_inputs

    !> How far a shape is from an ellipse: 0 for one, 1 if its numbers are as large as they get.
    pure real(wp) function shape_measure(shape)
        type(patch_shape_t), intent(in) :: shape !! of a patch

        shape_measure = sum((even_scale*shape%even)**2) + sum((odd_scale*shape%odd)**2)
    end function shape_measure

    !> How much of a patch is left to the march: not what slides whole.
    pure real(wp) function share_rolling(state) result(share)
        type(rolling_state_t), intent(in) :: state !! that moves

        real(wp) :: spin, slip

        associate (c => state%creepage)
            slip = c(1)**2 + c(2)**2 + least
            spin = 0.25_wp*c(3)**2*(state%a**2 + state%b**2)
        end associate
        share = (1.0_wp - state%sliding) &
                *(1.0_wp - (1.0_wp - fade(norm2(state%linear)/whole_slip)) &
                  *fade(sqrt(spin/slip)/little_spin))
    end function share_rolling

    !> How much of an ellipse and a shape lies within what the fits have seen: 1, beyond it less.
    pure real(wp) function share_seen(state, unlike) result(seen)
        type(rolling_state_t), intent(in) :: state !! its ellipse counts
        real(wp), intent(in) :: unlike             !! `shape_measure`

        seen = fade(abs(log(state%a/state%b))/largest_log_ratio)*fade(sqrt(unlike)/largest_shape)
    end function share_seen

    !> 1 up to 1, then smoothly down to 0 at 2.
    elemental real(wp) function fade(x)
        real(wp), intent(in) :: x

        real(wp) :: t

        t = min(max(x - 1.0_wp, 0.0_wp), 1.0_wp)
        ! Given: the polynomial with two derivatives zero at both ends
        fade = 1.0_wp - t*t*t*(10.0_wp - t*(15.0_wp - 6.0_wp*t))
    end function fade

    !> Creepages, ellipse and elements.
    pure subroutine ellipse_inputs(state, width, v, squared, x)
        type(rolling_state_t), intent(in) :: state
        real(wp), intent(in) :: width, v(3), squared
        real(wp), intent(out) :: x(n_ellipse_inputs)

        real(wp) :: slip, along, across

        associate (c => state%creepage, u => state%linear, a => state%a, b => state%b)
            ! Where the pole of the spin lies in the ellipse.
            slip = c(1)**2 + c(2)**2 + 0.25_wp*c(3)**2*(a**2 + b**2) + least
            across = c(2)**2 + (c(3)*a)**2 + near*slip
            along = c(1)**2 + (c(3)*b)**2 + near*slip
            x(:12) = [v(1)**2, v(2)**2, v(3)**2, v(2)*v(3), log(1.0_wp + squared), log(a/b), &
                      min(max(state%poisson, least_poisson), largest_poisson), &
                      c(1)**2/slip, c(2)**2/slip, c(2)*c(3)*a/slip, c(3)**2*a*b/slip, &
                      log(1.0_wp + squared/strong**2)]
            x(13:) = [log(1.0_wp + squared/weak**2), u(1)**2/squared, u(2)**2/squared, &
                      u(2)*u(3)/squared, c(1)**2/along, c(2)**2/across, c(2)*c(3)*a/across, &
                      sqrt(a/b), width, 1.0_wp/state%points]
        end associate
    end subroutine ellipse_inputs

    !> The shape.
    pure subroutine shape_inputs(shape, v, x)
        type(patch_shape_t), intent(in) :: shape
        real(wp), intent(in) :: v(3)
        real(wp), intent(out) :: x(n_shape_inputs)

        associate (o => shape%odd)
            x(:n_even) = shape%even
            x(n_even + 1:n_even + 4) = o(:4)*(v(1)*v(2))
            x(n_even + 5:n_even + 8) = o(:4)*(v(1)*v(3))
            x(n_even + 9:) = [o(1)**2, o(2)**2, o(3)**2, o(4)**2, o(1)*o(2), o(1)*o(3)]
        end associate
    end subroutine shape_inputs

    !> Two layers of x/sqrt(1 + x^2), then a linear one.
    pure subroutine evaluate_network(inputs, units, outputs, first, first_bias, second, &
                                     second_bias, third, third_bias, x, c)
        integer, intent(in) :: inputs, units, outputs !! numbers
        real(wp), intent(in) :: first(units, inputs), first_bias(units)    !! of the first layer
        real(wp), intent(in) :: second(units, units), second_bias(units)   !! of the second
        real(wp), intent(in) :: third(outputs, units), third_bias(outputs) !! of the last
        real(wp), intent(in) :: x(inputs)                                  !! its inputs
        real(wp), intent(out) :: c(outputs)                                !! what it says

        ! Not of `units`: such arrays would be allocated.
        real(wp), dimension(max(hidden, error_hidden)) :: one, two

        call add_layer(units, inputs, first, first_bias, x, one)
        one(:units) = one(:units)/sqrt(1.0_wp + one(:units)**2)
        call add_layer(units, units, second, second_bias, one, two)
        two(:units) = two(:units)/sqrt(1.0_wp + two(:units)**2)
        call add_layer(outputs, units, third, third_bias, two, c)
    end subroutine evaluate_network

    !> One linear layer; four inputs at a time, which saves loads and stores of the sums.
    pure subroutine add_layer(outputs, inputs, weights, bias, x, y)
        integer, intent(in) :: outputs, inputs
        real(wp), intent(in) :: weights(outputs, inputs), bias(outputs), x(inputs)
        real(wp), intent(out) :: y(outputs)

        integer :: j, k

        y = bias
        do j = 1, inputs - 3, 4
            !$omp simd
            do k = 1, outputs
                y(k) = y(k) + ((weights(k, j)*x(j) + weights(k, j + 1)*x(j + 1)) &
                               + (weights(k, j + 2)*x(j + 2) + weights(k, j + 3)*x(j + 3)))
            end do
        end do
        do j = 4*(inputs/4) + 1, inputs
            y = y + weights(:, j)*x(j)
        end do
    end subroutine add_layer
end module faststrip_tangential_force_network
