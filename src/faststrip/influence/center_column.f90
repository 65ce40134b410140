!> Columns of influence numbers on the centre line of the strip with the pressure, any edges.
!>
!> The integrals are those of faststrip_influence_closed, arranged for vector arithmetic: field
!> points are sorted by the two forms of G and evaluated side by side.
module faststrip_influence_center_column
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_kinds, only: wp, pi
    use faststrip_influence_closed, only: strip_influence_center_gradient, c_small, c_large
    use faststrip_influence_closed_coefficients, only: a_small, b_small, r_large, r_centre
    use faststrip_influence_offcentre, only: strip_influence_gradient
    use faststrip_influence_plain_sizes, only: is_plain, least_size, largest_size
    implicit none
    private

    public :: center_influence_column, center_influence_column_gradient

    ! Field points are taken so many at a time, as many as a patch seldom has strips: five arrays of
    ! that length for each form are on the stack, 10 kB.
    ! Tuned [field points]. Origin: as said with it.
    integer, parameter :: chunk = 64
    ! An edge this close to the field point, over the other edge's distance, counts as this far: its
    ! part of the integral, c ln c, is below rounding. From 1e-17 down no digit changes.
    ! Tuned [1]. Origin: as said with it.
    real(wp), parameter :: least_ratio = 1.0e-30_wp

contains

    !> Influence of a strip on points of its centre line, any edges. Relative error below 2e-15,
    !> given the edges' distances over the half-length.
    pure subroutine center_influence_column(half_length, y_left, y_right, y, value)
        real(wp), intent(in) :: half_length !! xd of the strip that carries the pressure, mm, > 0
        real(wp), intent(in) :: y_left      !! its left edge, mm
        real(wp), intent(in) :: y_right     !! its right edge, mm
        real(wp), intent(in) :: y(:)        !! field points, (n), mm
        real(wp), intent(out) :: value(:)   !! influence I, (n), mm

        real(wp) :: slope(chunk)
        integer :: from, to

        do from = 1, size(y), chunk
            to = min(from + chunk - 1, size(y))
            call center_chunk(to - from + 1, half_length, y_left, y_right, y(from:to), .false., &
                              value(from:to), slope)
        end do
    end subroutine center_influence_column

    !> Influence of a strip on points of its centre line, and its derivative with respect to the
    !> half-length at fixed edges; the derivative to 1e-14 max(1, |c|/(c_right - c_left)).
    pure subroutine center_influence_column_gradient(half_length, y_left, y_right, y, value, &
                                                     d_half_length)
        real(wp), intent(in) :: half_length       !! xd of the strip with the pressure, mm, > 0
        real(wp), intent(in) :: y_left            !! its left edge, mm
        real(wp), intent(in) :: y_right           !! its right edge, mm
        real(wp), intent(in) :: y(:)              !! field points, (n), mm
        real(wp), intent(out) :: value(:)         !! influence I, (n), mm
        real(wp), intent(out) :: d_half_length(:) !! dI/dxd, (n)

        integer :: from, to

        do from = 1, size(y), chunk
            to = min(from + chunk - 1, size(y))
            call center_chunk(to - from + 1, half_length, y_left, y_right, y(from:to), .true., &
                              value(from:to), d_half_length(from:to))
        end do
    end subroutine center_influence_column_gradient

    !> The same for at most `chunk` points, the derivative if asked for.
    pure subroutine center_chunk(n, half_length, y_left, y_right, y, with_slope, value, slope)
        integer, intent(in) :: n
        real(wp), intent(in) :: half_length, y_left, y_right, y(n)
        logical, intent(in) :: with_slope
        real(wp), intent(inout) :: value(n), slope(n)

        real(wp), dimension(chunk, 2) :: width, cl, cr, i0, i1
        real(wp) :: per_length, c1, c2, other
        integer :: place(chunk, 2), members(2), form, k, j
        logical :: plain, inside

        plain = is_plain(half_length, abs(y_left)) .and. is_plain(1.0_wp, abs(y_right))
        per_length = 0.0_wp
        if (plain) per_length = 1.0_wp/half_length
        members = 0
        do k = 1, n
            form = 0
            ! Written out: a call of `is_plain` for each point costs a column 6 %.
            inside = .false.
            if (plain .and. ieee_is_finite(y(k))) inside = abs(y(k)) <= largest_size
            if (inside) then
                c1 = (y_left - y(k))*per_length
                c2 = (y_right - y(k))*per_length
                if (c1 + c2 < 0.0_wp) then
                    other = -c1
                    c1 = -c2
                    c2 = other
                end if
                if (c1 >= c_large .and. c2 > c1) then
                    form = 2
                else if (c2 <= c_small .and. c2 > max(c1, least_size) &
                         .and. (c1 >= 0.0_wp .or. c1 <= -c2)) then
                    form = 1
                end if
            end if
            if (form > 0) then
                members(form) = members(form) + 1
                j = members(form)
                place(j, form) = k
                cr(j, form) = c2
                if (c1 >= 0.0_wp) then
                    cl(j, form) = c1
                    width(j, form) = (y_right - y_left)*per_length
                else
                    cl(j, form) = 0.0_wp
                    width(j, form) = c2
                end if
            else if (inside) then
                call strip_influence_center_gradient((y_left - y(k))*per_length, &
                                                     (y_right - y(k))*per_length, value(k), &
                                                     slope(k))
                value(k) = half_length*value(k)
            else
                call strip_influence_gradient(0.0_wp, half_length, y_left - y(k), &
                                              y_right - y(k), value(k), other, slope(k))
            end if
        end do
        if (with_slope) then
            if (members(1) > 0) call near_center(members(1), width(:, 1), cl(:, 1), cr(:, 1), &
                                                 i0(:, 1), i1(:, 1))
            if (members(2) > 0) call far_center(members(2), width(:, 2), cl(:, 2), cr(:, 2), &
                                                i0(:, 2), i1(:, 2))
        else
            if (members(1) > 0) call near_center_value(members(1), width(:, 1), cl(:, 1), &
                                                       cr(:, 1), i0(:, 1))
            if (members(2) > 0) call far_center_value(members(2), width(:, 2), cl(:, 2), &
                                                      cr(:, 2), i0(:, 2))
        end if
        do form = 1, 2
            do j = 1, members(form)
                k = place(j, form)
                value(k) = half_length*i0(j, form)
                if (with_slope) slope(k) = i1(j, form)
                ! Edges on both sides at the same distance: twice one of them.
                if (cl(j, form) > 0.0_wp) cycle
                if (y_left < y(k)) then
                    if (y(k) < y_right) value(k) = 2.0_wp*value(k)
                    if (y(k) < y_right .and. with_slope) slope(k) = 2.0_wp*slope(k)
                end if
            end do
        end do
    end subroutine center_chunk

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

    !> The value alone.
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

    !> The value alone.
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
