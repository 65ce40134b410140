!> A column of the classic table: equal strips seen from the centre line.
!>
!> The integrals are those of faststrip_influence_closed, arranged for vector arithmetic: field
!> points side by side, and the logarithms of odd numbers are constants.
module faststrip_influence_equal_column
    use faststrip_base_kinds, only: wp, pi
    use faststrip_influence_closed, only: strip_influence, c_small, c_large, c_near, c_far, &
                                          table_end
    use faststrip_influence_closed_coefficients, only: a_small, b_small, r_large, r_centre, &
                                                       a_short, b_short, r_short
    use faststrip_influence_plain_sizes, only: is_plain
    implicit none
    private

    public :: influence_column

    integer :: k_

    ! Up to n = table_end: ln(2n + 1), (n - 1/2) ln((2n + 1)/(2n - 1)), (2n + 1)^2,
    ! (2n + 1)^2 - (2n + 1)(2n - 1) + ..., and for the far form the same of the reciprocals.
    real(wp), parameter :: log_odd(table_end) = [(log(2.0_wp*k_ + 1.0_wp), k_=1, table_end)]
    real(wp), parameter :: left_log(table_end) = [((2*k_ - 1)*atanh(0.5_wp/k_), k_=1, table_end)]
    real(wp), parameter :: odd_square(0:table_end) = [((2.0_wp*k_ + 1.0_wp)**2, k_=0, table_end)]
    real(wp), parameter :: step_square(table_end) = [(4.0_wp*k_*(2*k_ + 1), k_=1, table_end)]
    real(wp), parameter :: half_pi_log(table_end) = [(pi*atanh(0.5_wp/k_), k_=1, table_end)]
    real(wp), parameter :: inverse_square(0:table_end) = 1.0_wp/odd_square
    ! Given: follows from the series.
    real(wp), parameter :: inverse_step(table_end) = &
        [(8.0_wp*k_/((2.0_wp*k_ - 1.0_wp)*(2.0_wp*k_ + 1.0_wp))**2, k_=1, table_end)]

contains

    !> i_n(b) of eq. (12) for n = 0, 1, ..., size(values) - 1: the column of the classic table,
    !> equal strips, centre line. Relative error below 2e-15.
    !>
    !> One logarithm for the whole column and no division: those of 2n + 1 are constants up to
    !> n = 64, farther strips are left to `strip_influence`.
    pure subroutine influence_column(b, values)
        real(wp), intent(in) :: b           !! half-width over half-length of the strips, > 0
        real(wp), intent(out) :: values(0:) !! (0:N-1), of half-length 1; 0 for b <= 0, NaN for b
                                            !! not finite

        integer :: last, near, small, large, far, n

        last = ubound(values, 1)
        if (last >= 0) values(0) = strip_influence(0, b)
        far = 1
        if (is_plain(b, b)) then
            ! Up to `near` and from `far` on the short forms, up to `small` and from `large` on the
            ! long ones.
            far = min(last, table_end)
            near = min(far, nint_below(c_near/b))
            small = max(near, min(far, nint_below(c_small/b)))
            large = max(small, min(far, nint_below(c_large/b + 2.0_wp)))
            n = max(large, min(far, nint_below(c_far/b + 2.0_wp)))
            if (near > 0) call near_column_short(1, near, b, values(1:near))
            if (small > near) call near_column(near + 1, small, b, values(near + 1:small))
            do far = small + 1, large
                values(far) = strip_influence(far, b)
            end do
            if (n > large) call far_column(large + 1, n, b, values(large + 1:n))
            far = min(last, table_end)
            if (far > n) call far_column_short(n + 1, far, b, values(n + 1:far))
            far = far + 1
        end if
        do n = far, last
            values(n) = strip_influence(n, b)
        end do
    end subroutine influence_column

    !> The largest n with 2n + 1 <= x, at least 0 and at most `table_end`.
    pure integer function nint_below(x) result(n)
        real(wp), intent(in) :: x

        n = int(0.5_wp*(max(1.0_wp, min(x, 2.0_wp*table_end + 2.0_wp)) - 1.0_wp))
    end function nint_below

    !> i_n(b) for n from `first` to `last`, (2n + 1) b <= c_near, by
    !> `c [A(c^2) - B(c^2) ln c]`; even and odd powers apart as in faststrip_influence_closed.
    !>
    !> Its divided differences stand in each of the four loops: from one procedure, of constant or
    !> any degree, a column takes 1.25 to 1.45 times as long, for all points at once 1.8 times.
    pure subroutine near_column_short(first, last, b, values)
        integer, intent(in) :: first, last
        real(wp), intent(in) :: b
        real(wp), intent(out) :: values(first:last)

        real(wp) :: square, log_b, two_b, x, y, x2, y2, ap, ad, bp, bd, p
        real(wp) :: e, o, d_even, d_odd
        integer :: n, k

        square = b*b
        log_b = log(b)
        two_b = 2.0_wp*b
        !$omp simd private(x, y, x2, y2, ap, ad, bp, bd, p, &
        !$omp& e, o, d_even, d_odd, k)
        do n = first, last
            x = square*odd_square(n)
            y = square*odd_square(n - 1)
            x2 = x*x
            y2 = y*y
            d_even = a_short(10)
            d_odd = a_short(11)
            e = d_even*y2 + a_short(8)
            o = d_odd*y2 + a_short(9)
            do k = 6, 0, -2 ! Given: degree of the polynomial
                d_even = d_even*x2 + e
                d_odd = d_odd*x2 + o
                e = e*y2 + a_short(k)
                o = o*y2 + a_short(k + 1)
            end do
            ap = e + y*o
            ad = (x + y)*(d_even + x*d_odd) + o
            d_even = b_short(10)
            d_odd = b_short(11)
            e = d_even*y2 + b_short(8)
            o = d_odd*y2 + b_short(9)
            do k = 6, 0, -2 ! Given: degree of the polynomial
                d_even = d_even*x2 + e
                d_odd = d_odd*x2 + o
                e = e*y2 + b_short(k)
                o = o*y2 + b_short(k + 1)
            end do
            bp = e + y*o
            bd = (x + y)*(d_even + x*d_odd) + o
            p = square*step_square(n)
            values(n) = two_b*(ap + p*ad - (log_b + log_odd(n))*(bp + p*bd) - left_log(n)*bp)
        end do
    end subroutine near_column_short

    !> The same for (2n + 1) b <= c_small.
    pure subroutine near_column(first, last, b, values)
        integer, intent(in) :: first, last
        real(wp), intent(in) :: b
        real(wp), intent(out) :: values(first:last)

        real(wp) :: square, log_b, two_b, x, y, x2, y2, ap, ad, bp, bd, p
        real(wp) :: e, o, d_even, d_odd
        integer :: n, k

        square = b*b
        log_b = log(b)
        two_b = 2.0_wp*b
        !$omp simd private(x, y, x2, y2, ap, ad, bp, bd, p, &
        !$omp& e, o, d_even, d_odd, k)
        do n = first, last
            x = square*odd_square(n)
            y = square*odd_square(n - 1)
            x2 = x*x
            y2 = y*y
            e = a_small(18)
            o = a_small(19)
            d_even = 0.0_wp
            d_odd = 0.0_wp
            do k = 16, 0, -2 ! Given: degree of the polynomial
                d_even = d_even*x2 + e
                d_odd = d_odd*x2 + o
                e = e*y2 + a_small(k)
                o = o*y2 + a_small(k + 1)
            end do
            ap = e + y*o
            ad = (x + y)*(d_even + x*d_odd) + o
            e = b_small(20)
            o = 0.0_wp
            d_even = 0.0_wp
            d_odd = 0.0_wp
            do k = 18, 0, -2 ! Given: degree of the polynomial
                d_even = d_even*x2 + e
                d_odd = d_odd*x2 + o
                e = e*y2 + b_small(k)
                o = o*y2 + b_small(k + 1)
            end do
            bp = e + y*o
            bd = (x + y)*(d_even + x*d_odd) + o
            p = square*step_square(n)
            values(n) = two_b*(ap + p*ad - (log_b + log_odd(n))*(bp + p*bd) - left_log(n)*bp)
        end do
    end subroutine near_column

    !> i_n(b) for n from `first` to `last`, (2n - 1) b >= c_far, by
    !> `(pi/2)(ln 4c + 1/2) + R(1/c^2)/c^2`.
    pure subroutine far_column_short(first, last, b, values)
        integer, intent(in) :: first, last
        real(wp), intent(in) :: b
        real(wp), intent(out) :: values(first:last)

        real(wp) :: square, x, y, x2, y2, rp, rd
        real(wp) :: e, o, d_even, d_odd
        integer :: n, k

        square = (1.0_wp/b)**2
        !$omp simd private(x, y, x2, y2, rp, rd, &
        !$omp& e, o, d_even, d_odd, k)
        do n = first, last
            x = square*inverse_square(n)
            y = square*inverse_square(n - 1)
            x2 = x*x
            y2 = y*y
            d_even = r_short(10)
            d_odd = r_short(11)
            e = d_even*y2 + r_short(8)
            o = d_odd*y2 + r_short(9)
            do k = 6, 0, -2 ! Given: degree of the polynomial
                d_even = d_even*x2 + e
                d_odd = d_odd*x2 + o
                e = e*y2 + r_short(k)
                o = o*y2 + r_short(k + 1)
            end do
            rp = e + y*o
            rd = (x + y)*(d_even + x*d_odd) + o
            values(n) = half_pi_log(n) - square*inverse_step(n)*(rp + square*inverse_square(n)*rd)
        end do
    end subroutine far_column_short

    !> The same for (2n - 1) b >= c_large.
    pure subroutine far_column(first, last, b, values)
        integer, intent(in) :: first, last
        real(wp), intent(in) :: b
        real(wp), intent(out) :: values(first:last)

        real(wp) :: square, x, y, x2, y2, rp, rd
        real(wp) :: e, o, d_even, d_odd
        integer :: n, k

        square = (1.0_wp/b)**2
        !$omp simd private(x, y, x2, y2, rp, rd, &
        !$omp& e, o, d_even, d_odd, k)
        do n = first, last
            x = square*inverse_square(n) - r_centre
            y = square*inverse_square(n - 1) - r_centre
            x2 = x*x
            y2 = y*y
            e = r_large(26)
            o = 0.0_wp
            d_even = 0.0_wp
            d_odd = 0.0_wp
            do k = 24, 0, -2 ! Given: degree of the polynomial
                d_even = d_even*x2 + e
                d_odd = d_odd*x2 + o
                e = e*y2 + r_large(k)
                o = o*y2 + r_large(k + 1)
            end do
            rp = e + y*o
            rd = (x + y)*(d_even + x*d_odd) + o
            values(n) = half_pi_log(n) - square*inverse_step(n)*(rp + square*inverse_square(n)*rd)
        end do
    end subroutine far_column
end module faststrip_influence_equal_column
