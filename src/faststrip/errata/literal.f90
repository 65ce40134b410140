!> The paper's formulas read as they are printed, to show what that gives. Nothing computes with
!> these; the right readings are in the rooms of the subjects.
module faststrip_errata_literal
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_kinds, only: wp, pi
    use faststrip_status, only: status_t, set_status, clear_status, is_error, number_text, &
                                st_bad_argument, st_not_finite, st_out_of_range, &
                                st_no_convergence
    use faststrip_material, only: material_t, check_material, combined_shear_modulus, &
                                  combined_poisson_ratio
    use faststrip_creepage, only: creepage_t
    use faststrip_influence_closed, only: strip_influence, strip_influence_edges
    use faststrip_influence_polynomial, only: published_coefficients, table_last_distance
    use faststrip_numerics_lapack, only: dgetrf, dgetrs
    use faststrip_normal_strips, only: contact_strips_t, strips_load
    use faststrip_tangential_kalker, only: kalker_coefficients_t, kalker_coefficients
    use faststrip_tangential_motion, only: check_motion
    use faststrip_normal_patch_ellipse, only: check_strips
    implicit none
    private

    public :: literal_table_influence, literal_area_integral, literal_offcentre_influence
    public :: center_pressures
    public :: march_reading_t, march_sum_t, printed_march

    !> Which of the paper's statements (25)-(48) are taken as printed.
    type :: march_reading_t
        logical :: bound_of_strip = .true. !! (34) T0 = mu p0_i; else one T0, mu max(p0)
        logical :: way_from_edge = .true.  !! (41) adds s (ae - xe); else s times the last step
        logical :: bare_moment = .true.    !! (44) with coordinates of the ellipse; else in mm
        logical :: scaled = .true.         !! (46)-(48); else the sum of the tractions
        logical :: from_reference = .true. !! (32) y from the reference point; else from y0 (28)
        integer :: points = 0              !! points along a strip; 0: nx = Int(8a) of (31)
    end type march_reading_t

    !> What the march adds up.
    type :: march_sum_t
        real(wp) :: tx = 0.0_wp !! force along x, N
        real(wp) :: ty = 0.0_wp !! force along y, N
        real(wp) :: mz = 0.0_wp !! moment, N mm (bare: N)
        real(wp) :: a = 0.0_wp  !! semi-axis of the virtual ellipse (27), mm
        real(wp) :: b = 0.0_wp  !! semi-axis (26), mm
        integer :: points = 0   !! points along each strip
    end type march_sum_t

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
            call set_status(status, st_out_of_range, 'no such column, or b outside 0.01 to 10: ' &
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
            call set_status(status, st_bad_argument, 'strips without length, or too little room')
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
            call set_status(status, st_no_convergence, 'a singular matrix of influence numbers')
            return
        end if
        call dgetrs(merge('T', 'N', transposed), n, 1, matrix, n, pivot, right, n, info)
        p0(:n) = right(:, 1)
    end subroutine center_pressures

    !> Eqs. (25)-(48) statement by statement, with the chosen ones as printed.
    subroutine printed_march(strips, material, mu, creepage, reading, total, status)
        type(contact_strips_t), intent(in) :: strips  !! one patch
        type(material_t), intent(in) :: material      !! moduli in MPa
        real(wp), intent(in) :: mu                    !! coefficient of friction, > 0
        type(creepage_t), intent(in) :: creepage      !! about y = 0
        type(march_reading_t), intent(in) :: reading  !! which statements as printed
        type(march_sum_t), intent(out) :: total       !! forces on the rail, moment as printed
        type(status_t), intent(out) :: status
            !! those of `check_motion`, `check_material`, `check_strips`; `st_bad_argument`

        type(kalker_coefficients_t) :: c
        real(wp), dimension(strips%n) :: y, width
        real(wp) :: y0, ratio, area, load, c1, c2, c3, t0, ux, uy, fx, fy, factor
        real(wp) :: ye, ae, step, way, xe, before, cell, sx, sy, px, py, p, stress, lever
        integer :: n, i, j

        call check_motion(mu, creepage, status)
        if (is_error(status)) return
        call check_material(material, status)
        if (is_error(status)) return
        call check_strips(strips, status)
        if (is_error(status)) return
        n = strips%n
        if (strips%n_patches /= 1 .or. mu <= 0.0_wp .or. reading%points < 0 &
            .or. minval(strips%half_length(:n)) <= 0.0_wp &
            .or. minval(strips%p0(:n)) <= 0.0_wp) then
            call set_status(status, st_bad_argument, 'one patch under pressure with friction only')
            return
        end if
        y = 0.5_wp*(strips%y_left(:n) + strips%y_right(:n))
        width = strips%y_right(:n) - strips%y_left(:n)
        area = 2.0_wp*sum(strips%half_length(:n)*width)
        load = strips_load(strips)
        total%b = 0.5_wp*(strips%y_right(n) - strips%y_left(1))              ! (26)
        total%a = area/(pi*total%b)                                          ! (27)
        y0 = 0.5_wp*(strips%y_left(1) + strips%y_right(n))                   ! (28)
        ratio = total%b/total%a                                              ! (29)
        call kalker_coefficients(1.0_wp/ratio, combined_poisson_ratio(material), c, status)
        if (is_error(status)) return
        c1 = 9.0_wp/32.0_wp*c%c11                                            ! (30)
        c2 = 9.0_wp/32.0_wp*c%c22
        c3 = 3.0_wp/pi*sqrt(ratio)*c%c23
        total%points = reading%points
        if (total%points == 0) total%points = max(int(8.0_wp*total%a), 1)    ! (31)
        do i = 1, n
            ye = y(i)/total%b                                                ! (32)
            if (.not. reading%from_reference) ye = (y(i) - y0)/total%b
            t0 = mu*maxval(strips%p0(:n))
            if (reading%bound_of_strip) t0 = mu*strips%p0(i)                 ! (34)
            factor = combined_shear_modulus(material)/t0                     ! (35)
            ux = factor*c1*creepage%cksi
            uy = factor*c2*creepage%ceta
            fx = factor*c3*total%b*creepage%cphi
            fy = factor*c3*total%a*creepage%cphi
            ae = strips%half_length(i)/total%a                               ! (36)
            step = 2.0_wp*ae/total%points                                    ! (37)
            cell = width(i)/total%b*step                                     ! (33), (38)
            sx = ux - fx*ye                                                  ! (39)
            px = 0.0_wp
            py = 0.0_wp
            before = ae
            do j = 1, total%points
                xe = ae - (j - 0.5_wp)*step
                way = ae - xe
                if (.not. reading%way_from_edge) way = before - xe
                sy = uy + fy*(xe + 0.5_wp*way)                               ! (40)
                before = xe
                px = px - sx*way                                             ! (41)
                py = py - sy*way
                p = sqrt(px*px + py*py)/(ae*ae - xe*xe)                      ! (42)
                if (p > 1.0_wp) then
                    px = px/p                                                ! (43)
                    py = py/p
                end if
                ! (46)-(48) take pi/2 for the sum of the bounds and mu N for the sum of T0 times it.
                stress = cell*mu*load/(0.5_wp*pi)
                if (.not. reading%scaled) stress = cell*total%a*total%b*t0
                total%tx = total%tx + px*stress                              ! (44), (45)
                total%ty = total%ty + py*stress
                if (reading%bare_moment) then
                    lever = px*ye - py*xe
                else
                    lever = py*xe*total%a - px*ye*total%b
                end if
                total%mz = total%mz + lever*stress
            end do
        end do
    end subroutine printed_march
end module faststrip_errata_literal
