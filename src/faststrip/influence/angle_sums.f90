!> Influence coefficients off the centre line by rules whose nodes are constants.
!>
!> The integrals are those of faststrip_influence_offcentre. A node costs one square root and one
!> division. How many nodes, and how many terms of a thin strip's kernel, the accuracy says.
module faststrip_influence_angle_sums
    use faststrip_base_kinds, only: wp, pi
    use faststrip_influence_angle_rules, only: fine, coarse, n_column_rules, rule_size, &
                                               rule_start, cosine, far_limit, near_a0, near_a1, &
                                               near_last, one_cosh, one_sinh, d_cosh, d_sinh
    use faststrip_influence_closed_coefficients, only: a => atanh_series, atanh_last
    use faststrip_influence_four_lanes, only: far_rule_lanes, near_rule_lanes
    use faststrip_influence_offcentre_rules, only: for_gradient
    use faststrip_influence_thin_kernel, only: expand_kernel, last_power
    implicit none
    private

    public :: angle_moments

    ! The largest far rule that is cheaper than a near one.
    ! Tuned [rule's number]. Origin: chosen for the time.
    integer, parameter :: last_far = 8

    ! Forms of the kernel: 1 to 4 with 2, 4, 6, 8 powers for thin strips, and of any width.
    ! Given: numbers of kinds.
    integer, parameter :: wide = 5
    ! Largest narrowness, half-width over distance, that a form serves for each accuracy; negative:
    ! not used.
    ! Tuned [1]. Origin: errors within the accuracy, see faststrip_influence_angle_rules.
    real(wp), parameter :: thin_last(wide - 1, fine:coarse) = reshape( &
        [-1.0_wp, -1.0_wp, -1.0_wp, 0.26_wp, 0.045_wp, 0.16_wp, 0.28_wp, -1.0_wp], [wide - 1, 2])

    ! Largest X and distance of an edge, in half-lengths: beyond, differences lose more than
    ! derivatives may, and scalar procedures less.
    real(wp), parameter :: largest_sigma = for_gradient%loss

contains

    !> Value, derivative in X and derivative in the half-length of a strip's influence, as in
    !> faststrip_influence_offcentre. Relative error exp(-digits) of the accuracy.
    pure subroutine angle_moments(accuracy, by_lanes, x, cl, cr, m, found)
        integer, intent(in) :: accuracy !! `fine` or `coarse`
        logical, intent(in) :: by_lanes !! by faststrip_influence_four_lanes, if the processor can
        real(wp), intent(in) :: x       !! X, field point along the strip in half-lengths, >= 0
        real(wp), intent(in) :: cl      !! the nearer edge less the field point's y, in half-lengths
        real(wp), intent(in) :: cr      !! the farther edge less the field point's y
        real(wp), intent(out) :: m(3)   !! the three numbers, over the half-length; 0 if not found
        logical, intent(out) :: found   !! does a rule fit?

        real(wp) :: narrowness, sigma
        integer :: rule, i, form
        logical :: far

        found = .false.
        m = 0.0_wp
        if (.not. (cl > 0.0_wp .and. cr > cl .and. cr < largest_sigma &
                   .and. x < largest_sigma)) return
        narrowness = (cr - cl)/(max(cr, x - 1.0_wp) + max(cl, x - 1.0_wp))
        if (narrowness > atanh_last) return
        do form = 1, wide - 1
            if (narrowness <= thin_last(form, accuracy)) exit
        end do
        sigma = 0.5_wp*(sqrt((x - 1.0_wp)**2 + cl*cl) + sqrt((x + 1.0_wp)**2 + cl*cl))
        do rule = 1, n_column_rules
            if (sigma >= far_limit(rule, accuracy)) exit
        end do
        far = rule <= last_far
        if (.not. far) then
            do i = 1, n_column_rules
                if (near_a0(i, accuracy) - x*x*near_a1(i, accuracy) <= cl*cl) exit
            end do
            if (i > n_column_rules) return
            far = x > near_last(i, accuracy)
            if (far .and. rule > n_column_rules) return
            if (.not. far) rule = i
        end if
        found = .true.
        i = rule_start(rule)
        if (by_lanes) then
            call sum_by_lanes(accuracy, far, rule, form, x, cl, cr, m)
        else if (far) then
            call far_sums(rule_size(rule), cosine(i), x, cl, cr, form, m)
        else
            call near_sums(rule_size(rule), one_cosh(i, accuracy), one_sinh(i, accuracy), &
                           d_cosh(i, accuracy), d_sinh(i, accuracy), x, cl, cr, form, m)
        end if
    end subroutine angle_moments

    !> What far_sums and near_sums do, four nodes at a time: two thirds to three quarters of a
    !> column's time. Four field points at a time, sorted by their rules, take longer: rules are
    !> many, and few points share one.
    pure subroutine sum_by_lanes(accuracy, far, rule, form, x, cl, cr, m)
        integer, intent(in) :: accuracy, rule, form
        logical, intent(in) :: far
        real(wp), intent(in) :: x, cl, cr
        real(wp), intent(out) :: m(3)

        real(wp) :: c(0:2*last_power)
        integer :: i, n, last

        i = rule_start(rule)
        n = rule_size(rule)
        if (form < wide) then
            last = 4*form ! Given: powers of a form, see expand_kernel
            call expand_kernel(form, cl, cr, c)
        else
            last = ubound(a, 1)
            c(:last) = a
        end if
        if (far) then
            call far_rule_lanes(last, n, cosine(i), x, cl, cr, c, m)
        else
            call near_rule_lanes(last, n, one_cosh(i, accuracy), one_sinh(i, accuracy), &
                                 d_cosh(i, accuracy), d_sinh(i, accuracy), x, cl, cr, c, m)
        end if
        m = merge(2.0_wp, 1.0_wp, form == wide)*pi/n*(cr - cl)*[m(1), -m(2), m(3)]
    end subroutine sum_by_lanes

    !> Trapezium rule in theta, u = cos(theta): the sums of sqrt(1 - u^2), -u/sqrt(1 - u^2) and
    !> u^2/sqrt(1 - u^2) times the kernel.
    !>
    !> Here and in `near_sums` each form of the kernel is written out. One loop over all forms for
    !> both rules takes 1.05 to 1.06 times as long for an influence coefficient of 9 to 61 strips,
    !> and 1.04 to 1.09 times for a cold solution (medians of both in turn in one run, -O3).
    pure subroutine far_sums(n, u, x, cl, cr, form, m)
        integer, intent(in) :: n, form
        real(wp), intent(in) :: u(n), x, cl, cr
        real(wp), intent(out) :: m(3)

        real(wp) :: c(0:2*last_power), middle, delta, r, y, y2, y4, ker, s0, s1, s2
        integer :: j

        s0 = 0.0_wp
        s1 = 0.0_wp
        s2 = 0.0_wp
        if (form < wide) call expand_kernel(form, cl, cr, c)
        middle = (0.5_wp*(cl + cr))**2
        select case (form)
        case (1)
            !$omp simd private(delta, r, y, y2, y4, ker) reduction(+:s0, s1, s2)
            do j = 1, n
                delta = u(j) - x
                r = 1.0_wp/sqrt(delta*delta + middle)
                y = middle*(r*r)
                y2 = y*y
                ker = r*((c(0) + y*c(1)) + y2*((c(2) + y*c(3)) + y2*c(4)))
                s0 = s0 + ker
                s1 = s1 + u(j)*ker
                s2 = s2 + u(j)*u(j)*ker
            end do
        case (2)
            !$omp simd private(delta, r, y, y2, y4, ker) reduction(+:s0, s1, s2)
            do j = 1, n
                delta = u(j) - x
                r = 1.0_wp/sqrt(delta*delta + middle)
                y = middle*(r*r)
                y2 = y*y
                y4 = y2*y2
                ker = r*((c(0) + y*c(1)) + y2*(c(2) + y*c(3)) &
                         + y4*(((c(4) + y*c(5)) + y2*(c(6) + y*c(7))) + y4*c(8)))
                s0 = s0 + ker
                s1 = s1 + u(j)*ker
                s2 = s2 + u(j)*u(j)*ker
            end do
        case (3)
            !$omp simd private(delta, r, y, y2, y4, ker) reduction(+:s0, s1, s2)
            do j = 1, n
                delta = u(j) - x
                r = 1.0_wp/sqrt(delta*delta + middle)
                y = middle*(r*r)
                y2 = y*y
                y4 = y2*y2
                ker = r*((c(0) + y*c(1)) + y2*(c(2) + y*c(3)) &
                         + y4*(((c(4) + y*c(5)) + y2*(c(6) + y*c(7))) &
                               + y4*(((c(8) + y*c(9)) + y2*(c(10) + y*c(11))) + y4*c(12))))
                s0 = s0 + ker
                s1 = s1 + u(j)*ker
                s2 = s2 + u(j)*u(j)*ker
            end do
        case (4)
            !$omp simd private(delta, r, y, y2, y4, ker) reduction(+:s0, s1, s2)
            do j = 1, n
                delta = u(j) - x
                r = 1.0_wp/sqrt(delta*delta + middle)
                y = middle*(r*r)
                y2 = y*y
                y4 = y2*y2
                ker = r*((c(0) + y*c(1)) + y2*(c(2) + y*c(3)) &
                         + y4*(((c(4) + y*c(5)) + y2*(c(6) + y*c(7))) &
                               + y4*(((c(8) + y*c(9)) + y2*(c(10) + y*c(11))) &
                                     + y4*(((c(12) + y*c(13)) + y2*(c(14) + y*c(15))) &
                                           + y4*c(16)))))
                s0 = s0 + ker
                s1 = s1 + u(j)*ker
                s2 = s2 + u(j)*u(j)*ker
            end do
        case default
            !$omp simd private(delta, r, y, y2, y4, ker) reduction(+:s0, s1, s2)
            do j = 1, n
                delta = u(j) - x
                r = 1.0_wp/(sqrt(delta*delta + cl*cl) + sqrt(delta*delta + cr*cr))
                y = ((cr - cl)*r)**2
                y2 = y*y
                y4 = y2*y2
                ker = r*((a(0) + y*a(1)) + y2*(a(2) + y*a(3)) &
                         + y4*(((a(4) + y*a(5)) + y2*(a(6) + y*a(7))) &
                               + y4*(((a(8) + y*a(9)) + y2*(a(10) + y*a(11))) &
                                     + y4*((a(12) + y*a(13)) + y2*(a(14) + y*a(15))))))
                s0 = s0 + ker
                s1 = s1 + u(j)*ker
                s2 = s2 + u(j)*u(j)*ker
            end do
        end select
        m = merge(2.0_wp, 1.0_wp, form == wide)*pi/n*(cr - cl)*[s0 - s2, -s1, s2]
    end subroutine far_sums

    !> Trapezium rule in phi, tau = H cos(phi), `rest` is 1 - u; the nodes of
    !> faststrip_influence_angle_rules.
    pure subroutine near_sums(n, p, q, dp, dq, x, cl, cr, form, m)
        integer, intent(in) :: n, form
        real(wp), intent(in), dimension(n) :: p, q, dp, dq
        real(wp), intent(in) :: x, cl, cr
        real(wp), intent(out) :: m(3)

        real(wp) :: c(0:2*last_power), middle, u, delta, rest, root, root2, r, y, y2, y4, ker, &
                    s0, s1, s2
        integer :: j

        s0 = 0.0_wp
        s1 = 0.0_wp
        s2 = 0.0_wp
        if (form < wide) call expand_kernel(form, cl, cr, c)
        middle = (0.5_wp*(cl + cr))**2
        select case (form)
        case (1)
            !$omp simd private(u, delta, rest, root2, r, y, y2, y4, ker) &
            !$omp& reduction(+:s0, s1, s2)
            do j = 1, n
                rest = q(j) - x*p(j)
                u = 1.0_wp - rest
                delta = (1.0_wp - x) - rest
                root2 = rest*(2.0_wp - rest)
                r = 1.0_wp/sqrt(root2*(delta*delta + middle))
                y = middle*root2*(r*r)
                y2 = y*y
                ker = (dq(j) - x*dp(j))*r*((c(0) + y*c(1)) + y2*((c(2) + y*c(3)) + y2*c(4)))
                s0 = s0 + root2*ker
                s1 = s1 + u*ker
                s2 = s2 + u*u*ker
            end do
        case (2)
            !$omp simd private(u, delta, rest, root2, r, y, y2, y4, ker) &
            !$omp& reduction(+:s0, s1, s2)
            do j = 1, n
                rest = q(j) - x*p(j)
                u = 1.0_wp - rest
                delta = (1.0_wp - x) - rest
                root2 = rest*(2.0_wp - rest)
                r = 1.0_wp/sqrt(root2*(delta*delta + middle))
                y = middle*root2*(r*r)
                y2 = y*y
                y4 = y2*y2
                ker = (dq(j) - x*dp(j))*r*((c(0) + y*c(1)) + y2*(c(2) + y*c(3)) &
                         + y4*(((c(4) + y*c(5)) + y2*(c(6) + y*c(7))) + y4*c(8)))
                s0 = s0 + root2*ker
                s1 = s1 + u*ker
                s2 = s2 + u*u*ker
            end do
        case (3)
            !$omp simd private(u, delta, rest, root2, r, y, y2, y4, ker) &
            !$omp& reduction(+:s0, s1, s2)
            do j = 1, n
                rest = q(j) - x*p(j)
                u = 1.0_wp - rest
                delta = (1.0_wp - x) - rest
                root2 = rest*(2.0_wp - rest)
                r = 1.0_wp/sqrt(root2*(delta*delta + middle))
                y = middle*root2*(r*r)
                y2 = y*y
                y4 = y2*y2
                ker = (dq(j) - x*dp(j))*r*((c(0) + y*c(1)) + y2*(c(2) + y*c(3)) &
                         + y4*(((c(4) + y*c(5)) + y2*(c(6) + y*c(7))) &
                               + y4*(((c(8) + y*c(9)) + y2*(c(10) + y*c(11))) + y4*c(12))))
                s0 = s0 + root2*ker
                s1 = s1 + u*ker
                s2 = s2 + u*u*ker
            end do
        case (4)
            !$omp simd private(u, delta, rest, root2, r, y, y2, y4, ker) &
            !$omp& reduction(+:s0, s1, s2)
            do j = 1, n
                rest = q(j) - x*p(j)
                u = 1.0_wp - rest
                delta = (1.0_wp - x) - rest
                root2 = rest*(2.0_wp - rest)
                r = 1.0_wp/sqrt(root2*(delta*delta + middle))
                y = middle*root2*(r*r)
                y2 = y*y
                y4 = y2*y2
                ker = (dq(j) - x*dp(j))*r*((c(0) + y*c(1)) + y2*(c(2) + y*c(3)) &
                         + y4*(((c(4) + y*c(5)) + y2*(c(6) + y*c(7))) &
                               + y4*(((c(8) + y*c(9)) + y2*(c(10) + y*c(11))) &
                                     + y4*(((c(12) + y*c(13)) + y2*(c(14) + y*c(15))) &
                                           + y4*c(16)))))
                s0 = s0 + root2*ker
                s1 = s1 + u*ker
                s2 = s2 + u*u*ker
            end do
        case default
            !$omp simd private(u, delta, rest, root, root2, r, y, y2, y4, ker) &
            !$omp& reduction(+:s0, s1, s2)
            do j = 1, n
                rest = q(j) - x*p(j)
                u = 1.0_wp - rest
                delta = (1.0_wp - x) - rest
                root2 = rest*(2.0_wp - rest)
                root = sqrt(root2)
                r = 1.0_wp/(root*(sqrt(delta*delta + cl*cl) + sqrt(delta*delta + cr*cr)))
                y = ((cr - cl)*root*r)**2
                y2 = y*y
                y4 = y2*y2
                ker = (dq(j) - x*dp(j))*r*((a(0) + y*a(1)) + y2*(a(2) + y*a(3)) &
                         + y4*(((a(4) + y*a(5)) + y2*(a(6) + y*a(7))) &
                               + y4*(((a(8) + y*a(9)) + y2*(a(10) + y*a(11))) &
                                     + y4*((a(12) + y*a(13)) + y2*(a(14) + y*a(15))))))
                s0 = s0 + root2*ker
                s1 = s1 + u*ker
                s2 = s2 + u*u*ker
            end do
        end select
        m = merge(2.0_wp, 1.0_wp, form == wide)*pi/n*(cr - cl)*[s0, -s1, s2]
    end subroutine near_sums
end module faststrip_influence_angle_sums
