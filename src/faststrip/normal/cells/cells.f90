!> Cells are strips whose edges stay where they are: ranges of y, each divided evenly.
module faststrip_normal_cells
    use faststrip_base_kinds, only: wp
    use faststrip_base_limits, only: rounding
    use faststrip_geometry_gap_curve, only: gap_curve_t, gap_at
    use faststrip_normal_overlap, only: most_at_once
    use faststrip_normal_strip_patches, only: fewest_strips, fewest_strips_small_patch
    use faststrip_normal_strips, only: contact_strips_t
    implicit none
    private

    public :: cells_t, reserve_cells, position_cells, start_lengths, next_run, record_strips
    public :: most_cells

    !> Most cells.
    !> Tuned [cells]. Origin: cost: it rises with its cube.
    integer, parameter :: most_cells = 80
    ! Added before a number of cells is cut to an integer: widths of ranges often are as small
    ! integers to each other, and a half would leave the number to the rounding.
    ! Tuned [cells]. Origin: chosen: no ratio of small whole numbers.
    real(wp), parameter :: cells_rounding = 0.5369_wp
    ! Tuned [1]: length of a cell over that of the undeformed overlap, to begin with. Origin: a
    ! round contact.
    real(wp), parameter :: first_share = 0.7_wp
    ! Tuned [1]. Origin: safeguard: no cell begins without length.
    real(wp), parameter :: least_overlap = 0.02_wp ! of the penetration, that gives a cell's length

    !> The cells, those that pressed when they lay elsewhere, and what their solution needs.
    type :: cells_t
        integer :: n = 0        !! cells
        integer :: n_old = 0    !! that pressed before
        integer :: n_ranges = 0 !! ranges of y, each divided into even cells
        real(wp) :: depth = 0.0_wp !! penetration above the lowest height that closes the gap, mm
        logical :: solved = .false. !! are there pressures?
        real(wp) :: y_from(most_at_once) = 0.0_wp, y_to(most_at_once) = 0.0_wp !! their ends, mm
        integer :: number(most_at_once) = 0 !! of cells in each
        real(wp), allocatable :: y_left(:), y_right(:), y(:) !! edges and middles of the cells, mm
        real(wp), allocatable :: height(:)      !! gap above its lowest place, mm
        real(wp), allocatable :: inv2r(:)       !! A = 1/(2R), 1/mm
        real(wp), allocatable :: p0(:)          !! pressure in the middle, MPa
        real(wp), allocatable :: half_length(:) !! mm
        real(wp), allocatable :: length(:)      !! half-lengths that the tips ask for, mm
        real(wp), allocatable :: old_y(:), old_half_length(:) !! of those that pressed before, mm
        real(wp), allocatable :: influence(:, :) !! of p0 on middles, mm
        real(wp), allocatable :: matrix(:, :)    !! that of the cells that press, factored
        real(wp), allocatable :: column(:, :)    !! (2) its right sides and solutions
        real(wp), allocatable :: edges(:, :)     !! (2) of the cells that press, mm
        integer, allocatable :: pivot(:), at(:)
        logical, allocatable :: presses(:)      !! does it carry any load?
    end type cells_t

contains

    !> Allocate, unless that is done.
    subroutine reserve_cells(cells)
        type(cells_t), intent(inout) :: cells !! sized

        integer, parameter :: m = most_cells

        if (allocated(cells%p0)) return
        allocate (cells%y_left(m), cells%y_right(m), cells%y(m), cells%height(m), cells%inv2r(m), &
                  cells%p0(m), cells%half_length(m), cells%length(m), cells%old_y(m), &
                  cells%old_half_length(m), cells%influence(m, m), cells%matrix(m, m), &
                  cells%column(m, 2), cells%edges(m, 2), source=0.0_wp)
        allocate (cells%pivot(m), cells%at(m), source=0)
        allocate (cells%presses(m), source=.false.)
    end subroutine reserve_cells

    !> Divide the ranges into even cells, and keep the lengths of those before.
    pure subroutine position_cells(cells, curve, wanted, most)
        type(cells_t), intent(inout) :: cells !! with its ranges
        type(gap_curve_t), intent(in) :: curve        !! a gap that was set
        integer, intent(in) :: wanted                 !! cells across the widest range
        integer, intent(in) :: most                   !! cells of all ranges together

        real(wp) :: h
        integer :: k

        call keep_lengths(cells)
        call join_nearest(cells, max(1, most/fewest_strips))
        call count_cells(cells, wanted, most)
        call cut_ranges(cells)
        do k = 1, cells%n
            cells%y(k) = 0.5_wp*(cells%y_left(k) + cells%y_right(k))
            call gap_at(curve, cells%y(k), h, cells%inv2r(k))
            cells%height(k) = h - curve%h_lowest
        end do
    end subroutine position_cells

    !> Keep places and lengths of the cells that press.
    pure subroutine keep_lengths(cells)
        type(cells_t), intent(inout) :: cells

        integer :: k, n

        n = 0
        do k = 1, cells%n
            if (.not. cells%presses(k)) cycle
            n = n + 1
            cells%old_y(n) = cells%y(k)
            cells%old_half_length(n) = cells%half_length(k)
        end do
        cells%n_old = n
    end subroutine keep_lengths

    !> Join ranges that are nearest to each other until they are not too many.
    pure subroutine join_nearest(cells, most)
        type(cells_t), intent(inout) :: cells
        integer, intent(in) :: most

        real(wp) :: nearest
        integer :: r, n

        associate (from => cells%y_from, to => cells%y_to, m => cells%n_ranges)
            do while (m > most)
                ! All that are as near to each other, or the order would count.
                nearest = (1.0_wp + rounding)*minval(from(2:m) - to(:m - 1))
                n = 1
                do r = 2, m
                    if (from(r) - to(r - 1) > nearest) then
                        n = n + 1
                        from(n) = from(r)
                    end if
                    to(n) = to(r)
                end do
                m = n
            end do
        end associate
    end subroutine join_nearest

    !> How many cells each range gets: by its width, but not less than a few.
    pure subroutine count_cells(cells, wanted, most)
        type(cells_t), intent(inout) :: cells
        integer, intent(in) :: wanted, most

        real(wp) :: widest
        integer :: r, fewest, share

        associate (from => cells%y_from, to => cells%y_to, m => cells%n_ranges)
            widest = maxval(to(:m) - from(:m))
            fewest = min(fewest_strips_small_patch, wanted)
            do share = wanted, 1, -1
                fewest = min(fewest, share)
                do r = 1, m
                    cells%number(r) = max(fewest, int(share*((to(r) - from(r))/widest) &
                                                      + cells_rounding))
                end do
                if (sum(cells%number(:m)) <= most) exit
            end do
        end associate
    end subroutine count_cells

    !> Cut the ranges into cells; neighbours have one edge.
    pure subroutine cut_ranges(cells)
        type(cells_t), intent(inout) :: cells

        real(wp) :: width
        integer :: r, k, i

        i = 0
        associate (from => cells%y_from, to => cells%y_to)
            do r = 1, cells%n_ranges
                width = (to(r) - from(r))/cells%number(r)
                do k = 1, cells%number(r)
                    i = i + 1
                    cells%y_left(i) = from(r) + (k - 1)*width
                    cells%y_right(i) = from(r) + k*width
                    if (k == cells%number(r)) cells%y_right(i) = to(r)
                    if (k > 1) cells%y_right(i - 1) = cells%y_left(i)
                end do
            end do
        end associate
        cells%n = i
    end subroutine cut_ranges

    !> Half-lengths to begin with: those of the cells before, or a part of the undeformed overlap's.
    pure subroutine start_lengths(cells)
        type(cells_t), intent(inout) :: cells !! positioned, with a depth

        real(wp) :: share
        integer :: k, i

        do k = 1, cells%n
            if (cells%n_old == 0) then
                cells%half_length(k) = first_share &
                                       *sqrt(max(cells%depth - cells%height(k), &
                                                 least_overlap*cells%depth)/cells%inv2r(k))
                cycle
            end if
            i = count(cells%old_y(:cells%n_old) <= cells%y(k))
            if (i == 0 .or. i == cells%n_old) then
                cells%half_length(k) = cells%old_half_length(max(i, 1))
            else
                share = (cells%y(k) - cells%old_y(i))/(cells%old_y(i + 1) - cells%old_y(i))
                cells%half_length(k) = (1.0_wp - share)*cells%old_half_length(i) &
                                       + share*cells%old_half_length(i + 1)
            end if
        end do
    end subroutine start_lengths

    !> The next cells side by side that press.
    pure subroutine next_run(cells, first, last)
        type(cells_t), intent(in) :: cells !! with the pressures found
        integer, intent(out) :: first      !! of the run, n + 1 if there is none
        integer, intent(inout) :: last     !! of the run before, 0 to begin with; of this one

        do first = last + 1, cells%n
            if (cells%presses(first)) exit
        end do
        do last = first, cells%n - 1
            if (.not. cells%presses(last + 1) .or. cells%y_left(last + 1) > cells%y_right(last)) &
                exit
        end do
    end subroutine next_run

    !> Hand over those that press.
    pure subroutine record_strips(cells, strips)
        type(cells_t), intent(in) :: cells              !! with the pressures found
        type(contact_strips_t), intent(inout) :: strips !! reserved

        integer :: first, last, n

        strips%n = 0
        strips%n_patches = 0
        last = 0
        do
            call next_run(cells, first, last)
            if (first > cells%n) exit
            strips%n_patches = strips%n_patches + 1
            n = strips%n + last - first + 1
            strips%y_left(strips%n + 1:n) = cells%y_left(first:last)
            strips%y_right(strips%n + 1:n) = cells%y_right(first:last)
            strips%half_length(strips%n + 1:n) = cells%half_length(first:last)
            strips%p0(strips%n + 1:n) = cells%p0(first:last)
            strips%patch(strips%n + 1:n) = strips%n_patches
            strips%n = n
        end do
    end subroutine record_strips
end module faststrip_normal_cells
