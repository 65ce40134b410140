!> What the march in the strips misses of the forces of one patch, S10 of
!> `faststrip_tangential_faststrip`: a smooth function of the creepages, of the ellipse's
!> proportion, of Poisson's ratio and of the patch's shape, fitted to Kalker's variational method.
!>
!> With u the linear forces over mu N and v = u/sqrt(1 + |u|^2), the correction over mu N (moment
!> about the centroid over mu N sqrt(ab); share of the area that sticks) is
!>
!>     Fx: A1 v1 + sum o_j (D_j v2 + E_j v3),   Fy: A2 v2 + A3 v3 + sum o_j G_j v1,
!>     Mz: A4 v3 + A5 v2 + sum o_j H_j v1,      stick: A6 |v|^2,
!>
!> o_j the odd numbers of the shape. The factors are two networks of two layers of numbers that do
!> not change when the creepages change sign or left and right are exchanged; so both symmetries
!> are exact. The first has the part of an ellipse, the factors A, multiplied by |v|, which leaves
!> the linear forces; the second that of the shape, multiplied by a measure of it, which leaves the
!> ellipses. Both fade out where everything slides, and outside what the fit has seen; no more is
!> corrected than the march was found to miss.
module faststrip_tangential_force_correction
    use faststrip_base_kinds, only: wp
    use faststrip_tangential_patch_shape, only: patch_shape_t
    use faststrip_tangential_force_network, only: rolling_state_t, network_inputs, &
                                                  evaluate_network, shape_measure, share_seen, &
                                                  share_rolling, least
    use faststrip_tangential_force_weights, only: &
        n_ellipse_inputs, n_shape_inputs, n_sides, n_factors, n_side_factors, hidden, &
        ellipse_first, ellipse_first_bias, ellipse_second, ellipse_second_bias, ellipse_third, &
        ellipse_third_bias, shape_first, shape_first_bias, shape_second, shape_second_bias, &
        shape_third, shape_third_bias, side_scale, half_shape, &
        most
    implicit none
    private

    public :: force_correction

contains

    !> Forces over mu N, moment about the centroid over mu N sqrt(ab) and share of the area that
    !> sticks, to be added.
    pure function force_correction(state, shape) result(missing)
        type(rolling_state_t), intent(in) :: state !! how the patch rolls
        type(patch_shape_t), intent(in) :: shape   !! of the patch
        real(wp) :: missing(4)

        real(wp) :: x(n_ellipse_inputs + n_shape_inputs), c(n_factors + n_side_factors), v(3)
        real(wp) :: o(n_sides), unlike, seen
        integer :: j, k

        unlike = shape_measure(shape)
        seen = share_rolling(state)*share_seen(state, unlike)
        missing = 0.0_wp
        if (seen <= 0.0_wp .or. sum(state%linear**2) <= least) return
        call network_inputs(state, shape, x, v)
        call evaluate_network(n_ellipse_inputs, hidden, n_factors, ellipse_first, &
                              ellipse_first_bias, ellipse_second, ellipse_second_bias, &
                              ellipse_third, ellipse_third_bias, x, c)
        missing = norm2(v)*by_factors(c, v)
        call evaluate_network(n_ellipse_inputs + n_shape_inputs, hidden, &
                              n_factors + n_side_factors, shape_first, shape_first_bias, &
                              shape_second, shape_second_bias, shape_third, shape_third_bias, x, c)
        o = shape%odd(:n_sides)/side_scale
        associate (form => unlike/(unlike + half_shape))
            missing = missing + form*by_factors(c, v)
            k = n_factors
            do j = 1, n_sides
                missing(1) = missing(1) + form*o(j)*(c(k + 1)*v(2) + c(k + 2)*v(3))
                k = k + 2
            end do
            missing(2) = missing(2) + form*v(1)*dot_product(o, c(k + 1:k + n_sides))
            k = k + n_sides
            missing(3) = missing(3) + form*v(1)*dot_product(o, c(k + 1:k + n_sides))
        end associate
        ! Given: a limit that leaves what is far below it alone.
        missing = seen*missing/sqrt(sqrt(1.0_wp + (missing/most)**4))
    end function force_correction

    !> What the factors of an ellipse give.
    pure function by_factors(c, v) result(forces)
        real(wp), intent(in) :: c(:), v(3)
        real(wp) :: forces(4)

        forces = [c(1)*v(1), c(2)*v(2) + c(3)*v(3), c(4)*v(3) + c(5)*v(2), c(6)*sum(v**2)]
    end function by_factors
end module faststrip_tangential_force_correction
