!> The cells of a lattice: ranges of y, each divided evenly, and how far each cell goes along x.
module faststrip_normal_cells
    use faststrip_base_kinds, only: wp
    use faststrip_geometry_gap_curve, only: gap_curve_t, gap_at
    use faststrip_normal_strip_patches, only: fewest_strips_small_patch
    use faststrip_normal_strips, only: contact_strips_t
    implicit none
    private

    public :: lattice_cells_t, reserve_cells, position_cells, set_reach, record_strips
    public :: max_ranges, same

    ! Tuned [ranges]: Most ranges. Origin: capacity.
    integer, parameter :: max_ranges = 64
    ! Tuned [1]. Origin: chosen: far below the error of a length.
    real(wp), parameter :: same = 1.0e-6_wp      ! lengths that differ by less, relatively

    ! Tuned [cells]. Origin: chosen.
    integer, parameter :: range_cells = 3        ! across a range, or neighbours are joined
    ! Added before a number of cells is cut to an integer: widths of ranges often are as small
    ! integers to each other, and a half would leave the number to the rounding.
    ! Tuned [cells]. Origin: chosen: no ratio of small whole numbers.
    real(wp), parameter :: cells_rounding = 0.5369_wp
    ! Tuned [1]. Origin: chosen: lengths hardly grow more from one lattice to the next.
    real(wp), parameter :: reach_margin = 1.3_wp ! of a cell, over the length found last
    ! Tuned [1]. Origin: chosen.
    real(wp), parameter :: depth_margin = 1.05_wp ! the penetration may still rise by
    ! Tuned [1]. Origin: chosen: keeps cells at the rim from being needles.
    real(wp), parameter :: least_reach = 0.02_wp ! penetration, of all, that gives a cell's length

    !> The cells, and of the lattice before those that pressed.
    type :: lattice_cells_t
        integer :: capacity = 0 !! most cells
        integer :: n = 0        !! cells
        integer :: n_old = 0    !! that pressed on the lattice before
        integer :: n_ranges = 0 !! ranges of y, each divided into even cells
        real(wp) :: y_from(max_ranges) = 0.0_wp, y_to(max_ranges) = 0.0_wp !! their ends, mm
        integer :: number(max_ranges) = 0 !! of cells in each
        real(wp), allocatable :: y_left(:), y_right(:), y(:) !! edges and middles of the cells, mm
        real(wp), allocatable :: height(:)      !! gap above its lowest place, mm
        real(wp), allocatable :: inv2r(:)       !! A = 1/(2R), 1/mm
        real(wp), allocatable :: p0(:)          !! pressure in the middle, MPa
        real(wp), allocatable :: half_length(:) !! of the strip that stands for it, mm
        real(wp), allocatable :: reach(:)       !! how far its elements go along x, mm
        real(wp), allocatable :: old_y(:), old_half_length(:) !! of the lattice before, mm
        logical, allocatable :: presses(:)      !! does it carry any load?
    end type lattice_cells_t

contains

    !> Allocate for so many cells, unless there is capacity already.
    subroutine reserve_cells(cells, capacity)
        type(lattice_cells_t), intent(inout) :: cells !! sized
        integer, intent(in) :: capacity               !! cells of all ranges together

        if (cells%capacity >= capacity) return
        if (allocated(cells%p0)) deallocate ( &
            cells%y_left, cells%y_right, cells%y, cells%height, cells%inv2r, cells%p0, &
            cells%half_length, cells%reach, cells%old_y, cells%old_half_length, cells%presses)
        allocate (cells%y_left(capacity), cells%y_right(capacity), cells%y(capacity), &
                  cells%height(capacity), cells%inv2r(capacity), cells%p0(capacity), &
                  cells%half_length(capacity), cells%reach(capacity), cells%old_y(capacity), &
                  cells%old_half_length(capacity), source=0.0_wp)
        allocate (cells%presses(capacity), source=.false.)
        cells%capacity = capacity
    end subroutine reserve_cells

    !> Divide the ranges into even cells, and keep the lengths of the lattice before.
    pure subroutine position_cells(cells, curve, wanted, most)
        type(lattice_cells_t), intent(inout) :: cells !! with its ranges
        type(gap_curve_t), intent(in) :: curve        !! a gap that was set
        integer, intent(in) :: wanted                 !! cells across the widest range
        integer, intent(in) :: most                   !! cells of all ranges together

        real(wp) :: h
        integer :: k

        call keep_lengths(cells)
        call join_nearest(cells, max(1, most/range_cells))
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
        type(lattice_cells_t), intent(inout) :: cells

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
        type(lattice_cells_t), intent(inout) :: cells
        integer, intent(in) :: most

        real(wp) :: nearest
        integer :: r, n

        associate (from => cells%y_from, to => cells%y_to, m => cells%n_ranges)
            do while (m > most)
                ! All that are as near to each other, or the order would count.
                nearest = (1.0_wp + same)*minval(from(2:m) - to(:m - 1))
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
        type(lattice_cells_t), intent(inout) :: cells
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
        type(lattice_cells_t), intent(inout) :: cells

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

    !> How far the cells go along x, mm: to where the undeformed gap is the penetration, but not
    !> far beyond the lengths of the lattice before.
    pure subroutine set_reach(cells, depth)
        type(lattice_cells_t), intent(inout) :: cells !! positioned
        real(wp), intent(in) :: depth !! penetration above the lowest height, mm

        real(wp) :: length, share
        integer :: k, i

        do k = 1, cells%n
            cells%reach(k) = sqrt(max(depth_margin*depth - cells%height(k), &
                                          least_reach*depth)/cells%inv2r(k))
            if (cells%n_old == 0) cycle
            i = count(cells%old_y(:cells%n_old) <= cells%y(k))
            if (i == 0 .or. i == cells%n_old) then
                length = cells%old_half_length(max(i, 1))
            else
                share = (cells%y(k) - cells%old_y(i)) &
                        /(cells%old_y(i + 1) - cells%old_y(i))
                length = (1.0_wp - share)*cells%old_half_length(i) &
                         + share*cells%old_half_length(i + 1)
            end if
            cells%reach(k) = min(cells%reach(k), reach_margin*length)
        end do
    end subroutine set_reach

    !> Hand over the strips that press.
    pure subroutine record_strips(cells, strips)
        type(lattice_cells_t), intent(in) :: cells !! with the pressures found
        type(contact_strips_t), intent(inout) :: strips !! reserved

        integer :: k, n

        n = 0
        strips%n_patches = 0
        do k = 1, cells%n
            if (.not. cells%presses(k)) cycle
            n = n + 1
            strips%y_left(n) = cells%y_left(k)
            strips%y_right(n) = cells%y_right(k)
            strips%half_length(n) = cells%half_length(k)
            strips%p0(n) = cells%p0(k)
            if (n == 1) then
                strips%n_patches = 1
            else if (strips%y_left(n) > strips%y_right(n - 1)) then
                strips%n_patches = strips%n_patches + 1
            end if
            strips%patch(n) = strips%n_patches
        end do
        strips%n = n
    end subroutine record_strips
end module faststrip_normal_cells
