!> Influence coefficients, linearised at their last exact evaluation, of strips that have moved on.
!>
!> The edges of a patch's strips lie at fixed parts of its width, so its influence coefficients are
!> homogeneous of degree one in all its lengths: where a patch grows as a whole they grow with it.
!> Kept are, of strips of half-lengths `l_s` in patches of widths `W`, the numbers `C_ks` on the
!> centre lines and `T_ks` at the tips, and their derivatives in `l_s` and in the place `x_k` of the
!> tip. Of strips that have moved on, with `sigma` the growth of the source's patch,
!>
!>     C'_ks = sigma (C + dl_s dC/dl),   T'_ks = sigma (T + dl_s dT/dl + dx_k dT/dx),
!>     dl_s = l'_s/sigma - l_s,          dx_k = l'_k/sigma - l_k.
!>
!> Two patches do not grow together. Of a strip and field points in another patch the distance `r`
!> changes besides: far strips act as points, as 1/r, and what the numbers of near ones do besides
!> is kept as a derivative too, by differences. Errors are of second order in what changes besides
!> the growth (`linear_change`).
module faststrip_normal_strip_linearised
    use faststrip_base_kinds, only: wp
    use faststrip_influence_center_column, only: center_influence_column, &
                                                 center_influence_column_gradient
    use faststrip_influence_tip, only: tip_influence_column, tip_influence_column_gradient
    use faststrip_normal_strip_equations, only: start_residual, start_jacobian, &
                                                add_column, end_jacobian
    use faststrip_normal_strip_patches, only: patches_t, max_patches, pass_strips_t
    use faststrip_normal_types, only: demand_t
    implicit none
    private

    public :: linearised_t, reserve_linearised, linearise_coefficients, is_linear_of, linear_change
    public :: linear_residual, linear_jacobian

    ! Tuned [1]: of a distance, for derivatives in it. Origin: half the digits of the tips' numbers.
    real(wp), parameter :: difference = 1.0e-4_wp

    !> Numbers of the last exact evaluation. Owned by the caller.
    type :: linearised_t
        logical :: known = .false.
        integer :: most = 0                      !! capacity, strips
        integer :: n = 0                         !! strips
        integer :: n_patches = 0
        integer :: n_strips(max_patches) = 0     !! of each patch
        real(wp) :: width(max_patches) = 0.0_wp  !! of each patch, mm
        real(wp), allocatable :: half_length(:)  !! mm
        real(wp), allocatable :: y(:)            !! centre lines, mm
        real(wp), allocatable :: center(:, :)    !! C, field points by sources, mm
        real(wp), allocatable :: center_l(:, :)  !! dC/dl
        real(wp), allocatable :: tip(:, :)       !! T, mm
        real(wp), allocatable :: tip_l(:, :)     !! dT/dl
        real(wp), allocatable :: tip_x(:, :)     !! dT/dx
        real(wp), allocatable :: center_y(:, :)  !! dC/dy + C/r of other patches, apart from 1/r
        real(wp), allocatable :: tip_y(:, :)     !! the same of T
        real(wp), allocatable :: work(:, :)      !! one column of C', dC'/dl, T', dT'/dl, dT'/dx
        real(wp), allocatable :: pressure(:)     !! of work, p0 H/D times the growth
        real(wp), allocatable :: longer(:)       !! of work, lengths beside the growth, mm
    end type linearised_t

contains

    !> Allocate for up to `capacity` strips; the only allocation. Where there is room, numbers stay.
    subroutine reserve_linearised(linear, capacity)
        type(linearised_t), intent(inout) :: linear !! sized
        integer, intent(in) :: capacity             !! strips, >= 1

        integer :: n

        n = capacity
        if (linear%most >= n) return
        linear%known = .false.
        if (linear%most > 0) &
            deallocate (linear%half_length, linear%y, linear%center, linear%center_l, &
                        linear%tip, linear%tip_l, linear%tip_x, linear%center_y, &
                        linear%tip_y, linear%work, linear%pressure, linear%longer)
        allocate (linear%half_length(n), linear%y(n), linear%center(n, n), &
                  linear%center_l(n, n), linear%tip(n, n), linear%tip_l(n, n), &
                  linear%tip_x(n, n), linear%center_y(n, n), linear%tip_y(n, n), &
                  linear%work(n, 5), linear%pressure(n), linear%longer(n), source=0.0_wp)
        linear%most = n
    end subroutine reserve_linearised

    !> Are the numbers those of patches like these?
    pure logical function is_linear_of(linear, patches)
        type(linearised_t), intent(in) :: linear
        type(patches_t), intent(in) :: patches !! shared into strips

        is_linear_of = linear%known .and. linear%n_patches == patches%n
        if (is_linear_of) &
            is_linear_of = all(linear%n_strips(:patches%n) == patches%at(:patches%n)%n_strips)
    end function is_linear_of

    !> Evaluate all numbers of the strips where they are, exactly.
    pure subroutine linearise_coefficients(linear, strips, patches)
        type(linearised_t), intent(inout) :: linear  !! known afterwards
        type(pass_strips_t), intent(inout) :: strips !! its centre lines are set, nothing else
        type(patches_t), intent(in) :: patches       !! those of the strips

        integer :: n, s, p, first

        n = strips%n
        linear%known = .true.
        linear%n = n
        linear%n_patches = patches%n
        first = 1
        do p = 1, patches%n
            linear%n_strips(p) = patches%at(p)%n_strips
            linear%width(p) = width_of(strips, first, patches%at(p)%n_strips)
            first = first + patches%at(p)%n_strips
        end do
        associate (y => linear%y(:n), half_length => linear%half_length(:n))
            y = 0.5_wp*(strips%y_left(:n) + strips%y_right(:n))
            half_length = strips%half_length(:n)
            do s = 1, n
                call center_influence_column_gradient(half_length(s), strips%y_left(s), &
                                                      strips%y_right(s), y, &
                                                      linear%center(:n, s), &
                                                      linear%center_l(:n, s))
                call tip_influence_column_gradient(half_length(s), strips%y_left(s), &
                                                   strips%y_right(s), half_length, y, &
                                                   linear%tip(:n, s), linear%tip_x(:n, s), &
                                                   linear%tip_l(:n, s))
            end do
        end associate
        if (patches%n == 1) return
        first = 1
        do p = 1, patches%n
            do s = first, first + patches%at(p)%n_strips - 1
                if (first > 1) call linearise_distance(linear, strips, s, 1, first - 1)
                call linearise_distance(linear, strips, s, first + patches%at(p)%n_strips, n)
            end do
            first = first + patches%at(p)%n_strips
        end do
    end subroutine linearise_coefficients

    !> Derivatives in the distance of a strip's numbers at field points of other patches, by
    !> differences.
    pure subroutine linearise_distance(linear, strips, s, from, to)
        type(linearised_t), intent(inout) :: linear
        type(pass_strips_t), intent(in) :: strips
        integer, intent(in) :: s, from, to

        real(wp) :: step, r, per_r2
        integer :: k

        if (to < from) return
        ! Of the nearest point's distance; the source moves away.
        step = -difference*min(abs(linear%y(from) - linear%y(s)), &
                               abs(linear%y(to) - linear%y(s)))
        if (from > s) step = -step
        associate (y => linear%y(from:to), x => linear%half_length(from:to), &
                   center => linear%center(from:to, s), tip => linear%tip(from:to, s), &
                   center_y => linear%center_y(from:to, s), tip_y => linear%tip_y(from:to, s))
            call center_influence_column(linear%half_length(s), strips%y_left(s) - step, &
                                         strips%y_right(s) - step, y, center_y)
            call tip_influence_column(linear%half_length(s), strips%y_left(s) - step, &
                                      strips%y_right(s) - step, x, y, tip_y)
            do k = 1, size(y)
                r = y(k) - linear%y(s)
                per_r2 = 1.0_wp/(r**2 + x(k)**2)
                center_y(k) = (center_y(k) - center(k))/step + center(k)/r
                tip_y(k) = (tip_y(k) - tip(k))/step + tip(k)*r*per_r2
            end do
        end associate
    end subroutine linearise_distance

    !> The largest relative change of a length, beside the growth of its patch, and of the distance
    !> between two patches beside theirs. Twice the numbers' relative error is about its square.
    pure real(wp) function linear_change(linear, strips) result(change)
        type(linearised_t), intent(in) :: linear  !! known
        type(pass_strips_t), intent(in) :: strips !! as many

        real(wp) :: sigma, apart, before
        integer :: p, k, first

        change = 0.0_wp
        first = 1
        do p = 1, linear%n_patches
            sigma = growth(linear, strips, p, first)
            do k = first, first + linear%n_strips(p) - 1
                change = max(change, abs(strips%half_length(k) &
                                         /(sigma*linear%half_length(k)) - 1.0_wp))
            end do
            if (first > 1) then
                ! Between the end strips of neighbouring patches.
                apart = 0.5_wp*(strips%y_left(first) + strips%y_right(first) &
                                - strips%y_left(first - 1) - strips%y_right(first - 1))
                before = linear%y(first) - linear%y(first - 1)
                change = max(change, abs(apart/(sigma*before) - 1.0_wp))
            end if
            first = first + linear%n_strips(p)
        end do
    end function linear_change

    !> As `strip_residual`, by linearised numbers.
    pure subroutine linear_residual(linear, strips, compliance, demand, residual)
        type(linearised_t), intent(inout) :: linear  !! known; its work changes, nothing else
        type(pass_strips_t), intent(inout) :: strips !! its work changes, nothing else
        real(wp), intent(in) :: compliance           !! H of eq. (4), 1/MPa
        type(demand_t), intent(in) :: demand         !! load or penetration
        real(wp), intent(inout), contiguous :: residual(:)       !! (2n + 1)

        real(wp) :: sigma, scale
        integer :: n, p, s, k, first, last

        n = strips%n
        scale = compliance/strips%penetration
        call start_residual(strips, demand, residual)
        last = 0
        do p = 1, linear%n_patches
            first = last + 1
            last = last + linear%n_strips(p)
            sigma = growth(linear, strips, p, first)
            do s = first, last
                linear%pressure(s) = scale*sigma*strips%p0(s)
                linear%longer(s) = strips%half_length(s)/sigma - linear%half_length(s)
            end do
            call displace(linear%n_strips(p), linear%most, linear%pressure(first), &
                          linear%longer(first), linear%center(first, first), &
                          linear%center_l(first, first), linear%tip(first, first), &
                          linear%tip_l(first, first), linear%tip_x(first, first), &
                          linear%work(first, 1))
            do k = first, last
                residual(k) = residual(k) - linear%work(k, 1)
                residual(n + k) = residual(n + k) &
                                  - (linear%work(k, 2) + linear%longer(k)*linear%work(k, 3))
            end do
            if (linear%n_patches == 1) return
            do s = first, last
                if (first > 1) call far_column(linear, strips, s, 1, first - 1, sigma)
                if (last < n) call far_column(linear, strips, s, last + 1, n, sigma)
                linear%work(first:last, 1) = 0.0_wp
                linear%work(first:last, 3) = 0.0_wp
                residual(:n) = residual(:n) - scale*strips%p0(s)*linear%work(:n, 1)
                residual(n + 1:2*n) = residual(n + 1:2*n) - scale*strips%p0(s)*linear%work(:n, 3)
            end do
        end do
    end subroutine linear_residual

    !> The displacements of a patch under its own pressures over the penetration: on its centre
    !> lines, at its tips where they were, and what a tip gets for each length that it is longer.
    !> Two sources at a time. The arrays come as arguments, which the compiler knows to be apart.
    pure subroutine displace(n, most, pressure, longer, center_of, center_l, tip_of, tip_l, tip_x, &
                             displaced)
        integer, intent(in) :: n    ! strips of the patch
        integer, intent(in) :: most ! rows of the numbers
        real(wp), intent(in) :: pressure(n), longer(n)
        real(wp), intent(in), dimension(most, *) :: center_of, center_l, tip_of, tip_l, tip_x
        real(wp), intent(inout) :: displaced(most, 3) ! (:n): centre lines, tips, and per length

        real(wp) :: p1, p2, q1, q2
        integer :: s, k

        if (mod(n, 2) == 1) then
            p1 = pressure(n)
            q1 = p1*longer(n)
            displaced(:n, 1) = p1*center_of(:n, n) + q1*center_l(:n, n)
            displaced(:n, 2) = p1*tip_of(:n, n) + q1*tip_l(:n, n)
            displaced(:n, 3) = p1*tip_x(:n, n)
        else
            displaced(:n, :) = 0.0_wp
        end if
        do s = 1, n - 1, 2
            p1 = pressure(s)
            q1 = p1*longer(s)
            p2 = pressure(s + 1)
            q2 = p2*longer(s + 1)
            !$omp simd
            do k = 1, n
                displaced(k, 1) = displaced(k, 1) + ((p1*center_of(k, s) + q1*center_l(k, s)) &
                                         + (p2*center_of(k, s + 1) + q2*center_l(k, s + 1)))
                displaced(k, 2) = displaced(k, 2) + ((p1*tip_of(k, s) + q1*tip_l(k, s)) &
                                   + (p2*tip_of(k, s + 1) + q2*tip_l(k, s + 1)))
                displaced(k, 3) = displaced(k, 3) + (p1*tip_x(k, s) + p2*tip_x(k, s + 1))
            end do
        end do
    end subroutine displace

    !> As `strip_jacobian`, by linearised numbers.
    pure subroutine linear_jacobian(linear, strips, compliance, demand, p_scale, jacobian, &
                                    residual)
        type(linearised_t), intent(inout) :: linear  !! known; its work changes, nothing else
        type(pass_strips_t), intent(inout) :: strips !! its work changes, nothing else
        real(wp), intent(in) :: compliance           !! H of eq. (4), 1/MPa
        type(demand_t), intent(in) :: demand         !! load or penetration
        real(wp), intent(in) :: p_scale              !! unit of the pressures' changes, MPa
        real(wp), intent(inout), contiguous :: jacobian(:, :)    !! first 2n + 1 rows and columns
        real(wp), intent(inout), contiguous :: residual(:)       !! (2n + 1)

        real(wp) :: sigma
        integer :: n, p, s, first, last

        n = strips%n
        call start_residual(strips, demand, residual)
        call start_jacobian(strips, jacobian)
        first = 1
        do p = 1, linear%n_patches
            last = first + linear%n_strips(p) - 1
            sigma = growth(linear, strips, p, first)
            do s = first, last
                call linear_column(linear, strips, s, first, last, sigma)
                call add_column(strips, s, linear%work, compliance/strips%penetration, p_scale, &
                                jacobian, residual)
            end do
            first = last + 1
        end do
        call end_jacobian(strips, demand, p_scale, jacobian)
    end subroutine linear_jacobian

    !> Column s of the numbers for the strips where they are, into `work`.
    pure subroutine linear_column(linear, strips, s, first, last, sigma)
        type(linearised_t), intent(inout) :: linear
        type(pass_strips_t), intent(in) :: strips ! their centre lines set
        integer, intent(in) :: s, first, last     ! the source, first and last strip of its patch
        real(wp), intent(in) :: sigma             ! growth of that patch

        real(wp) :: longer, per_sigma
        integer :: k

        per_sigma = 1.0_wp/sigma
        longer = strips%half_length(s)*per_sigma - linear%half_length(s)
        associate (center => linear%work(:, 1), center_l => linear%work(:, 2), &
                   tip => linear%work(:, 3), tip_l => linear%work(:, 4), &
                   tip_x => linear%work(:, 5))
            do k = first, last
                center(k) = sigma*(linear%center(k, s) + longer*linear%center_l(k, s))
                center_l(k) = linear%center_l(k, s)
                tip(k) = sigma*(linear%tip(k, s) + longer*linear%tip_l(k, s) &
                                + (strips%half_length(k)*per_sigma - linear%half_length(k)) &
                                *linear%tip_x(k, s))
                tip_l(k) = linear%tip_l(k, s)
                tip_x(k) = linear%tip_x(k, s)
            end do
        end associate
        if (first > 1) call far_column(linear, strips, s, 1, first - 1, sigma)
        if (last < linear%n) call far_column(linear, strips, s, last + 1, linear%n, sigma)
    end subroutine linear_column

    !> A part of column s whose field points are in other patches: besides the growth of the source
    !> their distance changes.
    pure subroutine far_column(linear, strips, s, from, to, sigma)
        type(linearised_t), intent(inout) :: linear
        type(pass_strips_t), intent(in) :: strips
        integer, intent(in) :: s, from, to
        real(wp), intent(in) :: sigma

        real(wp) :: longer, per_sigma, before, now, x, nearer
        integer :: k

        per_sigma = 1.0_wp/sigma
        longer = strips%half_length(s)*per_sigma - linear%half_length(s)
        do k = from, to
            before = linear%y(k) - linear%y(s)
            now = (strips%y(k) - strips%y(s))*per_sigma
            nearer = before/now
            linear%work(k, 1) = nearer*sigma*(linear%center(k, s) &
                                              + longer*linear%center_l(k, s) &
                                              + (now - before)*linear%center_y(k, s))
            linear%work(k, 2) = nearer*linear%center_l(k, s)
            x = strips%half_length(k)*per_sigma
            nearer = sqrt((before**2 + x**2)/(now**2 + x**2))
            linear%work(k, 3) = nearer*sigma*(linear%tip(k, s) &
                                              + longer*linear%tip_l(k, s) &
                                              + (x - linear%half_length(k))*linear%tip_x(k, s) &
                                              + (now - before)*linear%tip_y(k, s))
            linear%work(k, 4) = nearer*linear%tip_l(k, s)
            linear%work(k, 5) = nearer*linear%tip_x(k, s)
        end do
    end subroutine far_column

    !> By how much a patch has grown.
    pure real(wp) function growth(linear, strips, p, first)
        type(linearised_t), intent(in) :: linear
        type(pass_strips_t), intent(in) :: strips
        integer, intent(in) :: p, first ! the patch and its first strip

        growth = width_of(strips, first, linear%n_strips(p))/linear%width(p)
    end function growth

    pure real(wp) function width_of(strips, first, n)
        type(pass_strips_t), intent(in) :: strips
        integer, intent(in) :: first, n ! first strip of a patch, and how many

        width_of = strips%y_right(first + n - 1) - strips%y_left(first)
    end function width_of
end module faststrip_normal_strip_linearised
