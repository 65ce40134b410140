!> The paper's formulas read as they are printed, to show what that gives. Nothing computes with
!> these; the right readings are in the rooms of the subjects.
module faststrip_tables_literal
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, number_text, &
                                     st_bad_argument, st_not_finite, st_out_of_range, &
                                     st_no_convergence
    use faststrip_influence_closed, only: strip_influence, strip_influence_edges
    use faststrip_influence_polynomial, only: published_coefficients, table_last_distance
    use faststrip_numerics_lapack, only: dgetrf, dgetrs
    use faststrip_normal_strips, only: contact_strips_t
    use faststrip_normal_simple_patch_ellipse, only: check_strips
    implicit none
    private

    public :: literal_table_influence, literal_area_integral, literal_offcentre_influence
    public :: center_pressures

contains

    !> `10**E` of the printed column |s - k|, taken for i at that distance in strips; as `10**E` is
    !> half of i and the column twice the distance, both are wrong.
    pure subroutine literal_table_influence(distance, b, value, status)
        integer, intent(in) :: distance       !! printed heading: 0, 2, ..., 40
        real(wp), intent(in) :: b             !! half-width over half-length, in [0.01, 10]
        real(wp), intent(out) :: value        !! 10**E; 0 on error
        type(status_t), intent(out) :: status !! `st_not_finite`, `st_out_of_range`

        real(wp) :: l, e
        integer :: k

        call clear_status(status)
        value = 0.0_wp
        if (.not. ieee_is_finite(b)) then
            call set_status(status, st_not_finite, 'b is not a finite number')
            return
        end if
        if (distance < 0 .or. distance > 2*table_last_distance .or. mod(distance, 2) /= 0 &
            .or. b < 0.01_wp .or. b > 10.0_wp) then
            call set_status(status, st_out_of_range, &
                            'b must be 0.01 to 10 in a column of the table, got ' &
                            // trim(number_text(b)))
            return
        end if
        l = log10(b)
        e = published_coefficients(0, distance/2)
        do k = 1, 6
            e = e*l + published_coefficients(k, distance/2)
        end do
        value = 10.0_wp**e
    end subroutine literal_table_influence

    !> The double integral of (12) as printed, over strips of width 2 without the Jacobian b.
    elemental real(wp) function literal_area_integral(n, b) result(value)
        integer, intent(in) :: n  !! distance of the strips in strips
        real(wp), intent(in) :: b !! half-width over half-length, > 0

        value = 0.0_wp
        if (b > 0.0_wp) value = strip_influence(n, b)/b
    end function literal_area_integral

    !> Eqs. (22)-(24): `i(u) = i(0) [q(u) + q(-u)]/q(0)` with the parabolic numerator 1 - u^2 that
    !> alone makes q elementary, in closed form.
    elemental real(wp) function literal_offcentre_influence(n, b, u) result(value)
        integer, intent(in) :: n  !! distance of the strips in strips
        real(wp), intent(in) :: b !! half-width over half-length, > 0
        real(wp), intent(in) :: u !! field point along the strip over the half-length

        real(wp) :: cl, cr

        cl = (2*abs(n) - 1)*b
        cr = (2*abs(n) + 1)*b
        value = strip_influence(n, b)*(parabola_primitive(cr, u) - parabola_primitive(cl, u)) &
                /(parabola_primitive(cr, 0.0_wp) - parabola_primitive(cl, 0.0_wp))
    end function literal_offcentre_influence

    !> `int_{-1}^{1} (1 - u^2) asinh(c/|u + B|) du`, odd in c: `(1 - B^2) M0 + 2B M1 - M2` between
    !> x = B - 1 and B + 1, `M_k` the primitives of `x^k asinh(c/|x|)`.
    elemental real(wp) function parabola_primitive(c, b) result(h)
        real(wp), intent(in) :: c, b

        h = between(1.0_wp + b) - between(b - 1.0_wp)

    contains

        pure real(wp) function between(x)
            real(wp), intent(in) :: x

            real(wp) :: kernel, root, m0, m1, m2

            kernel = 0.0_wp
            if (abs(x) > 0.0_wp) kernel = asinh(c/abs(x))
            root = sqrt(x*x + c*c)
            m0 = x*kernel + abs(c)*asinh(x/abs(c))*sign(1.0_wp, c)
            m1 = 0.5_wp*x*x*kernel + 0.5_wp*c*root
            m2 = x**3/3.0_wp*kernel + c*x*root/6.0_wp - c**2*abs(c)/6.0_wp*asinh(x/abs(c)) &
                 *sign(1.0_wp, c)
            between = (1.0_wp - b*b)*m0 + 2.0_wp*b*m1 - m2
        end function between
    end function parabola_primitive

    !> Pressures of strips of given lengths that give the displacements w on their centre lines:
    !> `H sum_s M_ks p0_s = w_k`, M as it should be or as (6), (9) print it, which is its transpose.
    subroutine center_pressures(strips, compliance, w, transposed, p0, status)
        type(contact_strips_t), intent(in) :: strips !! places and lengths; p0 is not used
        real(wp), intent(in) :: compliance           !! H of eq. (4), 1/MPa
        real(wp), intent(in) :: w(:)                 !! displacements, (n), mm
        logical, intent(in) :: transposed            !! as printed?
        real(wp), intent(out) :: p0(:)               !! (n), MPa; 0 on error
        type(status_t), intent(out) :: status        !! `st_bad_argument`, `st_no_convergence`

        real(wp), allocatable :: matrix(:, :), right(:, :)
        integer, allocatable :: pivot(:)
        real(wp) :: y, per_length
        integer :: n, k, s, info

        p0 = 0.0_wp
        call check_strips(strips, status)
        if (is_error(status)) return
        n = strips%n
        if (size(w) < n .or. size(p0) < n .or. compliance <= 0.0_wp &
            .or. minval(strips%half_length(:n)) <= 0.0_wp) then
            call set_status(status, st_bad_argument, &
                            'strips without length, or too little capacity')
            return
        end if
        allocate (matrix(n, n), right(n, 1), pivot(n))
        do s = 1, n
            per_length = 1.0_wp/strips%half_length(s)
            do k = 1, n
                y = 0.5_wp*(strips%y_left(k) + strips%y_right(k))
                matrix(k, s) = compliance*strips%half_length(s) &
                               *strip_influence_edges((strips%y_left(s) - y)*per_length, &
                                                      (strips%y_right(s) - y)*per_length)
            end do
        end do
        right(:, 1) = w(:n)
        call dgetrf(n, n, matrix, n, pivot, info)
        if (info /= 0) then
            call set_status(status, st_no_convergence, &
                            'a singular matrix of influence coefficients')
            return
        end if
        call dgetrs(merge('T', 'N', transposed), n, 1, matrix, n, pivot, right, n, info)
        p0(:n) = right(:, 1)
    end subroutine center_pressures
end module faststrip_tables_literal
