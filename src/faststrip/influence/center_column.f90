!> Columns of influence coefficients on the centre line of the strip with the pressure, any edges.
!>
!> The integrals are those of faststrip_influence_closed, arranged for vector arithmetic: field
!> points are sorted by the two forms of G and evaluated side by side.
module faststrip_influence_center_column
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_limits, only: smallest_size
    use faststrip_influence_closed, only: strip_influence_center_gradient, c_small, c_large
    use faststrip_influence_closed_coefficients, only: a_small, b_small, r_large, r_centre
    use faststrip_influence_four_lanes, only: are_lanes_wanted, lanes, near_center_lanes, &
                                              near_center_value_lanes, far_center_lanes, &
                                              far_center_value_lanes
    use faststrip_influence_offcentre, only: strip_influence_gradient
    use faststrip_influence_plain_sizes, only: is_plain, least_plain, largest_plain
    implicit none
    private

    public :: center_influence_column, center_influence_column_gradient

    ! Field points are taken so many at a time, as many as a patch seldom has strips: three lists of
    ! them are on the stack, 9 kB.
    ! Tuned [field points]. Origin: chosen; no digit depends on it. Columns of 61 to 201 points take
    ! 1.01 to 1.03 times as long at half, 0.98 to 1.0 at double; shorter ones the same.
    integer, parameter :: chunk = 64
    ! An edge this close to the field point, over the other edge's distance, counts as this far: its
    ! part of the integral, c ln c, is below rounding.
    real(wp), parameter :: least_ratio = smallest_size

    !> Field points of one form; edges and width in half-lengths.
    type :: points_t
        integer :: n = 0        !! so many
        integer :: place(chunk) !! in the column
        real(wp), dimension(chunk) :: width, cl, cr !! the farther edge cr
        real(wp), dimension(chunk) :: value, slope  !! of the form, value over the half-length
    end type points_t

contains

    !> Influence of a strip on points of its centre line, any edges. Relative error below 2e-15,
    !> given the edges' distances over the half-length.
    pure subroutine center_influence_column(half_length, y_left, y_right, y, value, portable)
        real(wp), intent(in) :: half_length !! xd of the strip that carries the pressure, mm, > 0
        real(wp), intent(in) :: y_left      !! its left edge, mm
        real(wp), intent(in) :: y_right     !! its right edge, mm
        real(wp), intent(in) :: y(:)        !! field points, (n), mm
        real(wp), intent(out) :: value(:)   !! influence I, (n), mm
        logical, intent(in), optional :: portable !! by what any processor has; default: if need be

        real(wp) :: slope(chunk)
        integer :: from, to
        logical :: by_lanes

        by_lanes = are_lanes_wanted(portable)
        do from = 1, size(y), chunk
            to = min(from + chunk - 1, size(y))
            call center_chunk(to - from + 1, by_lanes, half_length, y_left, y_right, y(from:to), &
                              .false., value(from:to), slope)
        end do
    end subroutine center_influence_column

    !> Influence of a strip on points of its centre line, and its derivative with respect to the
    !> half-length at fixed edges; the derivative to 1e-14 max(1, |c|/(c_right - c_left)).
    pure subroutine center_influence_column_gradient(half_length, y_left, y_right, y, value, &
                                                     d_half_length, portable)
        real(wp), intent(in) :: half_length       !! xd of the strip with the pressure, mm, > 0
        real(wp), intent(in) :: y_left            !! its left edge, mm
        real(wp), intent(in) :: y_right           !! its right edge, mm
        real(wp), intent(in) :: y(:)              !! field points, (n), mm
        real(wp), intent(out) :: value(:)         !! influence I, (n), mm
        real(wp), intent(out) :: d_half_length(:) !! dI/dxd, (n)
        logical, intent(in), optional :: portable !! by what any processor has; default: if need be

        integer :: from, to
        logical :: by_lanes

        by_lanes = are_lanes_wanted(portable)
        do from = 1, size(y), chunk
            to = min(from + chunk - 1, size(y))
            call center_chunk(to - from + 1, by_lanes, half_length, y_left, y_right, y(from:to), &
                              .true., value(from:to), d_half_length(from:to))
        end do
    end subroutine center_influence_column_gradient

    !> The same for at most `chunk` points, the derivative if asked for.
    pure subroutine center_chunk(n, by_lanes, half_length, y_left, y_right, y, with_slope, value, &
                                 slope)
        integer, intent(in) :: n
        logical, intent(in) :: by_lanes
        real(wp), intent(in) :: half_length, y_left, y_right, y(n)
        logical, intent(in) :: with_slope
        real(wp), intent(inout) :: value(n), slope(n)

        type(points_t) :: near, far, others

        call sort_points(n, half_length, y_left, y_right, y, near, far, others)
        if (by_lanes) then
            call evaluate_by_lanes(with_slope, near, far)
        else if (with_slope) then
            if (near%n > 0) call near_center(near%n, near%width, near%cl, near%cr, near%value, &
                                             near%slope)
            if (far%n > 0) call far_center(far%n, far%width, far%cl, far%cr, far%value, far%slope)
        else
            if (near%n > 0) call near_center_value(near%n, near%width, near%cl, near%cr, near%value)
            if (far%n > 0) call far_center_value(far%n, far%width, far%cl, far%cr, far%value)
        end if
        call hand_back(near, half_length, y_left, y_right, y, with_slope, value, slope)
        call hand_back(far, half_length, y_left, y_right, y, with_slope, value, slope)
        call point_by_point(others, half_length, y_left, y_right, y, value, slope)
    end subroutine center_chunk

    !> Which form serves which field point, and its edges for that form.
    pure subroutine sort_points(n, half_length, y_left, y_right, y, near, far, others)
        integer, intent(in) :: n
        real(wp), intent(in) :: half_length, y_left, y_right, y(n)
        type(points_t), intent(inout) :: near, far, others

        real(wp) :: per_length, width, c1, c2, other
        integer :: k
        logical :: plain, inside

        plain = is_plain(half_length, abs(y_left)) .and. is_plain(1.0_wp, abs(y_right))
        per_length = 0.0_wp
        if (plain) per_length = 1.0_wp/half_length
        width = 0.0_wp
        if (plain) width = (y_right - y_left)*per_length
        do k = 1, n
            ! Written out: a call of `is_plain` for each point costs a column 6 %.
            inside = .false.
            if (plain .and. ieee_is_finite(y(k))) inside = abs(y(k)) <= largest_plain
            if (inside) then
                c1 = (y_left - y(k))*per_length
                c2 = (y_right - y(k))*per_length
                if (c1 + c2 < 0.0_wp) then
                    other = -c1
                    c1 = -c2
                    c2 = other
                end if
                if (c1 >= c_large .and. c2 > c1) then
                    call put_point(k, c1, c2, width, far)
                    cycle
                else if (c2 <= c_small .and. c2 > max(c1, least_plain)) then
                    if (c1 >= 0.0_wp) then
                        call put_point(k, c1, c2, width, near)
                        cycle
                    else if (c1 <= -c2) then
                        call put_point(k, 0.0_wp, c2, c2, near)
                        cycle
                    end if
                end if
            end if
            others%n = others%n + 1
            others%place(others%n) = k
        end do
    end subroutine sort_points

    !> Both forms, four points at a time.
    pure subroutine evaluate_by_lanes(with_slope, near, far)
        logical, intent(in) :: with_slope
        type(points_t), intent(inout) :: near, far

        call fill_lanes(near)
        call fill_lanes(far)
        if (with_slope) then
            call near_center_lanes(near%n, least_ratio, near%width, near%cl, near%cr, a_small, &
                                   b_small, near%value, near%slope)
            call far_center_lanes(far%n, 0.5_wp*pi, r_centre, far%width, far%cl, far%cr, r_large, &
                                  far%value, far%slope)
        else
            call near_center_value_lanes(near%n, least_ratio, near%width, near%cl, near%cr, &
                                         a_small, b_small, near%value)
            call far_center_value_lanes(far%n, 0.5_wp*pi, r_centre, far%width, far%cl, far%cr, &
                                        r_large, far%value)
        end if
    end subroutine evaluate_by_lanes

    !> The last point once more in lanes without a point.
    pure subroutine fill_lanes(points)
        type(points_t), intent(inout) :: points

        integer :: n, last

        n = points%n
        last = lanes*((n + lanes - 1)/lanes)
        if (n < 1) return
        points%width(n + 1:last) = points%width(n)
        points%cl(n + 1:last) = points%cl(n)
        points%cr(n + 1:last) = points%cr(n)
    end subroutine fill_lanes

    !> One more point of a form.
    pure subroutine put_point(k, cl, cr, width, points)
        integer, intent(in) :: k
        real(wp), intent(in) :: cl, cr, width
        type(points_t), intent(inout) :: points

        points%n = points%n + 1
        points%place(points%n) = k
        points%cl(points%n) = cl
        points%cr(points%n) = cr
        points%width(points%n) = width
    end subroutine put_point

    !> What was found for the points of a form, to their places in the column.
    pure subroutine hand_back(points, half_length, y_left, y_right, y, with_slope, value, slope)
        type(points_t), intent(in) :: points
        real(wp), intent(in) :: half_length, y_left, y_right, y(:)
        logical, intent(in) :: with_slope
        real(wp), intent(inout) :: value(:), slope(:)

        integer :: k, j

        do j = 1, points%n
            k = points%place(j)
            value(k) = half_length*points%value(j)
            if (with_slope) slope(k) = points%slope(j)
            ! Edges on both sides at the same distance: twice one of them.
            if (points%cl(j) > 0.0_wp) cycle
            if (y_left < y(k) .and. y(k) < y_right) then
                value(k) = 2.0_wp*value(k)
                if (with_slope) slope(k) = 2.0_wp*slope(k)
            end if
        end do
    end subroutine hand_back

    !> Points that no form takes, by the scalar procedures.
    pure subroutine point_by_point(points, half_length, y_left, y_right, y, value, slope)
        type(points_t), intent(in) :: points
        real(wp), intent(in) :: half_length, y_left, y_right, y(:)
        real(wp), intent(inout) :: value(:), slope(:)

        real(wp) :: per_length, d_x
        integer :: k, j

        do j = 1, points%n
            k = points%place(j)
            if (is_plain(half_length, abs(y_left)) .and. is_plain(1.0_wp, abs(y_right)) &
                .and. is_plain(1.0_wp, abs(y(k)))) then
                per_length = 1.0_wp/half_length
                call strip_influence_center_gradient((y_left - y(k))*per_length, &
                                                     (y_right - y(k))*per_length, value(k), &
                                                     slope(k))
                value(k) = half_length*value(k)
            else
                call strip_influence_gradient(0.0_wp, half_length, y_left - y(k), &
                                              y_right - y(k), value(k), d_x, slope(k))
            end if
        end do
    end subroutine point_by_point

    !> G(cr) - G(cl) and its derivative in the half-length for 0 <= cl < cr <= c_small.
    pure subroutine near_center(n, width, cl, cr, value, slope)
        integer, intent(in) :: n
        real(wp), intent(in) :: width(n), cl(n), cr(n)
        real(wp), intent(out) :: value(n), slope(n)

        real(wp) :: xl, xr, al, ar, dal, dar, da, bl, br, dbl, dbr, db, d, log_r, ratio
        real(wp) :: left, right
        integer :: i, k

        !$omp simd private(xl, xr, al, ar, dal, dar, da, bl, br, dbl, dbr, db, d, &
        !$omp& log_r, ratio, left, right, k)
        do i = 1, n
            xl = cl(i)*cl(i)
            xr = cr(i)*cr(i)
            bl = b_small(20)*xl + b_small(19)
            br = b_small(20)*xr + b_small(19)
            db = b_small(20)
            dbl = b_small(20)
            dbr = b_small(20)
            al = a_small(19)
            ar = a_small(19)
            da = 0.0_wp
            dal = 0.0_wp
            dar = 0.0_wp
            do k = 18, 0, -1 ! Given: degree of the polynomial
                da = da*xr + al
                dal = dal*xl + al
                dar = dar*xr + ar
                al = al*xl + a_small(k)
                ar = ar*xr + a_small(k)
                db = db*xr + bl
                dbl = dbl*xl + bl
                dbr = dbr*xr + br
                bl = bl*xl + b_small(k)
                br = br*xr + b_small(k)
            end do
            ratio = log_1p(width(i)/max(cl(i), least_ratio*cr(i)))
            log_r = log(cr(i))
            d = cr(i)*(cr(i) + cl(i))
            value(i) = width(i)*(al + d*da - log_r*(bl + d*db)) - cl(i)*ratio*bl
            right = cr(i)*(2.0_wp*xr*(dar - log_r*dbr) - br)
            left = cl(i)*(2.0_wp*xl*(dal - (log_r - ratio)*dbl) - bl)
            slope(i) = left - right
        end do
    end subroutine near_center

    !> The value alone: columns take 0.8 of the time with a loop of its own.
    pure subroutine near_center_value(n, width, cl, cr, value)
        integer, intent(in) :: n
        real(wp), intent(in) :: width(n), cl(n), cr(n)
        real(wp), intent(out) :: value(n)

        real(wp) :: xl, xr, al, da, bl, db, d, ratio
        integer :: i, k

        !$omp simd private(xl, xr, al, da, bl, db, d, ratio, k)
        do i = 1, n
            xl = cl(i)*cl(i)
            xr = cr(i)*cr(i)
            bl = b_small(20)*xl + b_small(19)
            db = b_small(20)
            al = a_small(19)
            da = 0.0_wp
            do k = 18, 0, -1 ! Given: degree of the polynomial
                da = da*xr + al
                al = al*xl + a_small(k)
                db = db*xr + bl
                bl = bl*xl + b_small(k)
            end do
            ratio = log_1p(width(i)/max(cl(i), least_ratio*cr(i)))
            d = cr(i)*(cr(i) + cl(i))
            value(i) = width(i)*(al + d*da - log(cr(i))*(bl + d*db)) - cl(i)*ratio*bl
        end do
    end subroutine near_center_value

    !> G(cr) - G(cl) and its derivative in the half-length for c_large <= cl < cr.
    pure subroutine far_center(n, width, cl, cr, value, slope)
        integer, intent(in) :: n
        real(wp), intent(in) :: width(n), cl(n), cr(n)
        real(wp), intent(out) :: value(n), slope(n)

        real(wp) :: xl, xr, ul, ur, wl, wr, rl, rr, drl, drr, dr, d, ratio
        integer :: i, k

        !$omp simd private(xl, xr, ul, ur, wl, wr, rl, rr, drl, drr, dr, d, ratio, k)
        do i = 1, n
            ul = 1.0_wp/cl(i)
            ur = 1.0_wp/cr(i)
            wl = ul*ul
            wr = ur*ur
            xl = wl - r_centre
            xr = wr - r_centre
            rl = r_large(26)
            rr = r_large(26)
            dr = 0.0_wp
            drl = 0.0_wp
            drr = 0.0_wp
            do k = 25, 0, -1 ! Given: degree of the polynomial
                dr = dr*xr + rl
                drl = drl*xl + rl
                drr = drr*xr + rr
                rl = rl*xl + r_large(k)
                rr = rr*xr + r_large(k)
            end do
            d = width(i)*ul
            ratio = log_1p(d)
            value(i) = 0.5_wp*pi*ratio - d*(1.0_wp + cl(i)*ur)*ul*ur*(rl + wr*dr)
            slope(i) = value(i) + 2.0_wp*(wr*(rr + wr*drr) - wl*(rl + wl*drl))
        end do
    end subroutine far_center

    !> The value alone, as near_center_value.
    pure subroutine far_center_value(n, width, cl, cr, value)
        integer, intent(in) :: n
        real(wp), intent(in) :: width(n), cl(n), cr(n)
        real(wp), intent(out) :: value(n)

        real(wp) :: xl, xr, ul, ur, rl, dr, d, ratio
        integer :: i, k

        !$omp simd private(xl, xr, ul, ur, rl, dr, d, ratio, k)
        do i = 1, n
            ul = 1.0_wp/cl(i)
            ur = 1.0_wp/cr(i)
            xl = ul*ul - r_centre
            xr = ur*ur - r_centre
            rl = r_large(26)
            dr = 0.0_wp
            do k = 25, 0, -1 ! Given: degree of the polynomial
                dr = dr*xr + rl
                rl = rl*xl + r_large(k)
            end do
            d = width(i)*ul
            ratio = log_1p(d)
            value(i) = 0.5_wp*pi*ratio - d*(1.0_wp + cl(i)*ur)*ul*ur*(rl + ur*ur*dr)
        end do
    end subroutine far_center_value

    !> As in faststrip_numerics_logarithm. From here the compiler puts it into the loops; that of
    !> another module gfortran 12 calls number by number where a vector holds two, and a column
    !> takes 1.6 times as long; 1.2 times with a loop of its own over there.
    elemental real(wp) function log_1p(d)
        real(wp), intent(in) :: d

        real(wp) :: one_d

        one_d = 1.0_wp + d
        log_1p = log(one_d) + (d - (one_d - 1.0_wp))/one_d
    end function log_1p
end module faststrip_influence_center_column
