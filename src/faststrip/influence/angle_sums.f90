!> Influence numbers off the centre line by rules whose nodes are constants.
!>
!> The integrals are those of faststrip_influence_offcentre. A node costs one square root and one
!> division. How many nodes, and how many terms of a thin strip's kernel, the accuracy says.
module faststrip_influence_angle_sums
    use faststrip_base_kinds, only: wp, pi
    use faststrip_influence_angle_rules, only: fine, coarse, n_column_rules, rule_size, &
                                               rule_start, cosine, far_limit, near_a0, near_a1, &
                                               near_last, one_cosh, one_sinh, d_cosh, d_sinh
    use faststrip_influence_closed_coefficients, only: atanh_series, atanh_last
    use faststrip_influence_thin_kernel, only: expand_kernel, last_power
    implicit none
    private

    public :: angle_moments, least_near

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

    ! Powers of the kernel of a strip of any width, as many as four at a time make.
    real(wp), parameter :: twice_atanh(0:2*last_power) = [2.0_wp*atanh_series, 0.0_wp]
    integer, parameter :: most_nodes = rule_size(n_column_rules)

    ! Largest X and distance of an edge, in half-lengths: beyond, scalar procedures lose less.
    ! Tuned [half-lengths]. Origin: accuracy: beyond, differences of large numbers. d_x errs by
    ! 4e-12 of itself here and at double, 3e-10 from 2e3 to 1e4; at half points between take 1.2
    ! times as long.
    real(wp), parameter :: largest_sigma = 1.0e3_wp
    !> Least distance of a field point from the nearer edge, in half-lengths: below, no rule fits.
    !> Tuned [half-lengths]. Origin: the last rule's smallest interval.
    real(wp), parameter :: least_near = 1.0e-5_wp

contains

    !> Value, derivative in X and derivative in the half-length of a strip's influence, as in
    !> faststrip_influence_offcentre. Relative error exp(-digits) of the accuracy.
    pure subroutine angle_moments(accuracy, x, cl, cr, m, found)
        integer, intent(in) :: accuracy !! `fine` or `coarse`
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
        if (.not. (cl >= least_near .and. cr > cl .and. cr < largest_sigma &
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
        if (far) then
            call far_sums(rule_size(rule), cosine(i), x, cl, cr, form, m)
        else
            call near_sums(rule_size(rule), one_cosh(i, accuracy), one_sinh(i, accuracy), &
                           d_cosh(i, accuracy), d_sinh(i, accuracy), x, cl, cr, form, m)
        end if
    end subroutine angle_moments

    !> Trapezium rule in theta, u = cos(theta): the sums of sqrt(1 - u^2), -u/sqrt(1 - u^2) and
    !> u^2/sqrt(1 - u^2) times the kernel.
    pure subroutine far_sums(n, u, x, cl, cr, form, m)
        integer, intent(in) :: n, form
        real(wp), intent(in) :: u(n), x, cl, cr
        real(wp), intent(out) :: m(3)

        real(wp), dimension(most_nodes) :: delta, root2, ker
        real(wp) :: s0, s1, s2
        integer :: j

        delta(:n) = u - x
        root2(:n) = 1.0_wp
        call kernel_at_nodes(n, delta, root2, cl, cr, form, ker)
        s0 = 0.0_wp
        s1 = 0.0_wp
        s2 = 0.0_wp
        !$omp simd reduction(+:s0, s1, s2)
        do j = 1, n
            s0 = s0 + ker(j)
            s1 = s1 + u(j)*ker(j)
            s2 = s2 + u(j)*u(j)*ker(j)
        end do
        m = pi/n*(cr - cl)*[s0 - s2, -s1, s2]
    end subroutine far_sums

    !> Trapezium rule in phi, tau = H cos(phi), `rest` is 1 - u; the nodes of
    !> faststrip_influence_angle_rules. The kernel comes over sqrt(1 - u^2).
    pure subroutine near_sums(n, p, q, dp, dq, x, cl, cr, form, m)
        integer, intent(in) :: n, form
        real(wp), intent(in), dimension(n) :: p, q, dp, dq
        real(wp), intent(in) :: x, cl, cr
        real(wp), intent(out) :: m(3)

        real(wp), dimension(most_nodes) :: delta, root2, ker
        real(wp) :: rest, u, weighted, s0, s1, s2
        integer :: j

        !$omp simd private(rest)
        do j = 1, n
            rest = q(j) - x*p(j)
            delta(j) = (1.0_wp - x) - rest
            root2(j) = rest*(2.0_wp - rest)
        end do
        call kernel_at_nodes(n, delta, root2, cl, cr, form, ker)
        s0 = 0.0_wp
        s1 = 0.0_wp
        s2 = 0.0_wp
        !$omp simd private(u, weighted) reduction(+:s0, s1, s2)
        do j = 1, n
            u = 1.0_wp - (q(j) - x*p(j))
            weighted = (dq(j) - x*dp(j))*ker(j)
            s0 = s0 + root2(j)*weighted
            s1 = s1 + u*weighted
            s2 = s2 + u*u*weighted
        end do
        m = pi/n*(cr - cl)*[s0, -s1, s2]
    end subroutine near_sums

    !> The kernel of u - X = delta over the width and sqrt(root2): a root and a reciprocal, and a
    !> series in y, four terms at a time for all nodes.
    !>
    !> With each form written out for each rule columns of tips take 0.97 of the time, those off the
    !> centre line 1.06 of it, a cold solution the same; with the nodes in the outer loop columns
    !> take 1.1 to 1.2 times as long, with Horner's rule there 1.25 to 1.3.
    pure subroutine kernel_at_nodes(n, delta, root2, cl, cr, form, ker)
        integer, intent(in) :: n, form
        real(wp), intent(in) :: delta(n), root2(n), cl, cr
        real(wp), intent(out) :: ker(n)

        real(wp) :: c(0:2*last_power), y(most_nodes), sum_(most_nodes), middle, root
        integer :: j, k, last

        if (form < wide) then
            call expand_kernel(form, cl, cr, c)
            middle = (0.5_wp*(cl + cr))**2
            !$omp simd
            do j = 1, n
                ker(j) = 1.0_wp/sqrt(root2(j)*(delta(j)*delta(j) + middle))
                y(j) = middle*root2(j)*(ker(j)*ker(j))
            end do
            last = 4*form
        else
            !$omp simd private(root)
            do j = 1, n
                root = sqrt(root2(j))
                ker(j) = 1.0_wp/(root*(sqrt(delta(j)*delta(j) + cl*cl) &
                                       + sqrt(delta(j)*delta(j) + cr*cr)))
                y(j) = ((cr - cl)*root*ker(j))**2
            end do
            c = twice_atanh
            last = 2*last_power
        end if
        sum_(:n) = c(last)
        do k = last - 4, 4, -4
            !$omp simd
            do j = 1, n
                sum_(j) = four_terms(c(k:k + 3), y(j)) + y(j)**4*sum_(j)
            end do
        end do
        !$omp simd
        do j = 1, n
            ker(j) = ker(j)*(four_terms(c(0:3), y(j)) + y(j)**4*sum_(j))
        end do
    end subroutine kernel_at_nodes

    !> c(1) + c(2) y + c(3) y^2 + c(4) y^3.
    pure real(wp) function four_terms(c, y)
        real(wp), intent(in) :: c(4), y

        four_terms = (c(1) + y*c(2)) + y*y*(c(3) + y*c(4))
    end function four_terms
end module faststrip_influence_angle_sums
