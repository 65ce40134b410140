!> Where the grid of a gap h(y) + A(y) x^2 has to lie, and what pressures to start from.
!>
!> Middles of elements lie at odd multiples of half a side, x = 0 and y = 0 between elements, as
!> CONTACT's grids of the reference do. Displacements are positive, so that all contact is where the
!> undeformed gap is below the approach: these rows are all taken. Columns are taken as the start
!> has them, with room; whether they suffice is seen by the outermost.
module faststrip_normal_variational_place
    use faststrip_kinds, only: wp
    use faststrip_status, only: status_t, set_status, clear_status, is_error, number_text, &
                                st_no_contact, st_out_of_range
    use faststrip_influence_closed, only: strip_influence_edges
    use faststrip_profile_gap_curve, only: gap_curve_t, gap_at
    use faststrip_normal_strip_patches, only: patches_t
    use faststrip_normal_strip_start, only: goal_t, start_patches
    use faststrip_normal_strip_state, only: flattest
    use faststrip_normal_strips, only: contact_strips_t
    use faststrip_normal_variational_grid, only: contact_grid_t, size_grid, element_x, element_y
    implicit none
    private

    public :: extent_t, guess_extent, extent_of_strips, place_grid, rows_suffice
    public :: columns_suffice, reaches_end_of_data, guess_pressures

    !> What a grid has to hold.
    type :: extent_t
        real(wp) :: depth = 0.0_wp       !! approach above the lowest height, mm
        real(wp) :: half_length = 0.0_wp !! largest |x| in contact, mm
        real(wp) :: half_width = 0.0_wp  !! half the width of the contact along y, mm
        real(wp) :: level = 0.0_wp       !! height of the gap at the contact's ends, from the lowest
    end type extent_t

    real(wp), parameter :: depth_room = 1.02_wp  ! of the approach, for rows
    real(wp), parameter :: length_room = 1.15_wp ! of the half-length, for columns
    real(wp), parameter :: most_rows = 1.0e6_wp  ! along the gap's data

contains

    !> Extent of the ellipse that fits the gap's width, as the strips start.
    pure subroutine guess_extent(curve, compliance, goal, extent, status)
        type(gap_curve_t), intent(in) :: curve   !! a gap that was set
        real(wp), intent(in) :: compliance       !! H of eq. (4), 1/MPa
        type(goal_t), intent(in) :: goal         !! load or penetration
        type(extent_t), intent(out) :: extent    !! first guess
        type(status_t), intent(out) :: status    !! `st_no_contact`

        type(patches_t) :: patches
        real(wp) :: depth, h, a_lowest, a, y
        integer :: i

        call clear_status(status)
        call start_patches(curve, compliance, goal, patches, depth)
        if (patches%n < 1 .or. .not. depth > 0.0_wp) then
            call set_status(status, st_no_contact, 'no place where the bodies touch was found')
            return
        end if
        extent%depth = depth
        if (.not. goal%by_load) extent%depth = goal%penetration
        extent%level = patches%at(1)%seed_level
        extent%half_width = 0.5_wp*sum(patches%at(:patches%n)%y_to - patches%at(:patches%n)%y_from)
        ! A x^2 at the tip of the lowest place; further on A may be smaller, the gap is larger.
        call gap_at(curve, curve%y_lowest, h, a_lowest)
        a_lowest = max(a_lowest, flattest)
        extent%half_length = patches%at(1)%seed_length
        do i = 1, curve%n
            y = curve%y(i)
            call gap_at(curve, y, h, a)
            if (h - curve%h_lowest >= extent%level) cycle
            extent%half_length = max(extent%half_length, patches%at(1)%seed_length*sqrt( &
                (1.0_wp - (h - curve%h_lowest)/extent%level)*(a_lowest/max(a, flattest))))
        end do
    end subroutine guess_extent

    !> Extent of a strip solution.
    pure subroutine extent_of_strips(curve, compliance, strips, extent)
        type(gap_curve_t), intent(in) :: curve       !! a gap that was set
        real(wp), intent(in) :: compliance           !! H of eq. (4), 1/MPa
        type(contact_strips_t), intent(in) :: strips !! a solution with a strip at least
        type(extent_t), intent(inout) :: extent      !! a guess that is replaced where known better

        real(wp) :: h, a, y, u
        integer :: k, s

        k = maxloc(strips%p0(:strips%n), dim=1)
        y = 0.5_wp*(strips%y_left(k) + strips%y_right(k))
        call gap_at(curve, y, h, a)
        u = 0.0_wp
        do s = 1, strips%n
            u = u + compliance*strips%p0(s)*strips%half_length(s)*strip_influence_edges( &
                (strips%y_left(s) - y)/strips%half_length(s), &
                (strips%y_right(s) - y)/strips%half_length(s))
        end do
        extent%depth = h - curve%h_lowest + u
        extent%half_length = maxval(strips%half_length(:strips%n))
    end subroutine extent_of_strips

    !> Place a grid that holds an extent, as far as the gap has data, and take the heights.
    subroutine place_grid(curve, extent, dx, dy, most_elements, grid, status)
        type(gap_curve_t), intent(in) :: curve     !! a gap that was set
        type(extent_t), intent(in) :: extent       !! to be held
        real(wp), intent(in) :: dx, dy             !! sides of the elements, mm, > 0
        integer, intent(in) :: most_elements       !! refuse more
        type(contact_grid_t), intent(inout) :: grid !! placed; its pressures are of no meaning
        type(status_t), intent(out) :: status      !! `st_out_of_range`

        integer :: first, last, i, j
        real(wp) :: columns, rows, h, a

        call clear_status(status)
        call rows_below(curve, dy, depth_room*extent%depth, first, last, status)
        if (is_error(status)) return
        columns = 2.0_wp*(aint(length_room*extent%half_length/dx) + 2.0_wp)
        rows = real(last, wp) - first + 1.0_wp
        if (columns*rows > most_elements) then
            call set_status(status, st_out_of_range, 'the contact takes more elements than ' &
                            //'allowed: '//trim(number_text(columns))//' by ' &
                            //trim(number_text(rows)))
            return
        end if
        call size_grid(grid, nint(columns), last - first + 1)
        grid%dx = dx
        grid%dy = dy
        grid%x_first = -0.5_wp*(grid%nx - 1)*dx
        grid%y_first = (first + 0.5_wp)*dy
        do j = 1, grid%ny
            call gap_at(curve, element_y(grid, j), h, a)
            do i = 1, grid%nx
                grid%height(i, j) = h + a*element_x(grid, i)**2
            end do
        end do
    end subroutine place_grid

    !> The first and the last row, of middles (j + 1/2) dy, with a height below a level; where the
    !> elements are longer than what is below it, the row of the lowest place.
    pure subroutine rows_below(curve, dy, level, first, last, status)
        type(gap_curve_t), intent(in) :: curve
        real(wp), intent(in) :: dy, level ! mm, from the lowest height
        integer, intent(out) :: first, last
        type(status_t), intent(out) :: status

        integer :: from, to

        first = 0
        last = 0
        call rows_of_data(curve, dy, from, to, status)
        if (is_error(status)) return
        do first = from, to
            if (is_below(first)) exit
        end do
        if (first > to) first = min(max(floor(curve%y_lowest/dy), from), to)
        do last = to, first, -1
            if (is_below(last)) exit
        end do
        last = max(last, first)

    contains

        pure logical function is_below(j)
            integer, intent(in) :: j

            real(wp) :: h, a

            call gap_at(curve, (j + 0.5_wp)*dy, h, a)
            is_below = h - curve%h_lowest < level
        end function is_below
    end subroutine rows_below

    !> The rows whose middles the gap's points enclose.
    pure subroutine rows_of_data(curve, dy, from, to, status)
        type(gap_curve_t), intent(in) :: curve
        real(wp), intent(in) :: dy
        integer, intent(out) :: from, to
        type(status_t), intent(out) :: status

        real(wp), parameter :: slack = 1.0e-6_wp ! of a side
        real(wp) :: low, high

        call clear_status(status)
        from = 0
        to = -1
        low = curve%y(1)/dy
        high = curve%y(curve%n)/dy
        if (high - low > most_rows .or. max(abs(low), abs(high)) > 1.0e3_wp*most_rows) then
            call set_status(status, st_out_of_range, 'elements of '//trim(number_text(dy)) &
                            //' mm are too short for the gap''s points')
            return
        end if
        from = ceiling(low - 0.5_wp - slack)
        to = floor(high - 0.5_wp + slack)
        if (to < from) &
            call set_status(status, st_out_of_range, 'elements of '//trim(number_text(dy)) &
                            //' mm are longer than the gap')
    end subroutine rows_of_data

    !> Does the grid hold all rows that an approach can bring into contact?
    pure logical function rows_suffice(curve, depth, grid)
        type(gap_curve_t), intent(in) :: curve  !! the gap of the grid
        real(wp), intent(in) :: depth           !! approach above the lowest height, mm
        type(contact_grid_t), intent(in) :: grid !! placed by `place_grid`

        integer :: first, last, held
        type(status_t) :: status

        call rows_below(curve, grid%dy, depth, first, last, status)
        held = nint(grid%y_first/grid%dy - 0.5_wp)
        rows_suffice = first >= held .and. last <= held + grid%ny - 1
    end function rows_suffice

    !> Are the outermost columns free of contact?
    pure logical function columns_suffice(grid)
        type(contact_grid_t), intent(in) :: grid !! with pressures

        columns_suffice = .not. (any(grid%pressure(1, :) > 0.0_wp) &
                                 .or. any(grid%pressure(grid%nx, :) > 0.0_wp))
    end function columns_suffice

    !> Is the last row for which there are points of the gap in contact?
    pure logical function reaches_end_of_data(curve, grid) result(reaches)
        type(gap_curve_t), intent(in) :: curve   !! the gap of the grid
        type(contact_grid_t), intent(in) :: grid !! placed by `place_grid`, with pressures

        integer :: from, to, held
        type(status_t) :: status

        call rows_of_data(curve, grid%dy, from, to, status)
        held = nint(grid%y_first/grid%dy - 0.5_wp)
        reaches = .false.
        if (held == from) reaches = any(grid%pressure(:, 1) > 0.0_wp)
        if (held + grid%ny - 1 == to) reaches = reaches .or. any(grid%pressure(:, grid%ny) > 0.0_wp)
    end function reaches_end_of_data

    !> Pressures to start from: of the ellipse that fits the gap's width, falling off with the gap.
    !> Only their proportions count.
    pure subroutine guess_pressures(curve, extent, grid)
        type(gap_curve_t), intent(in) :: curve      !! the gap of the grid
        type(extent_t), intent(in) :: extent        !! as guessed
        type(contact_grid_t), intent(inout) :: grid !! placed; `pressure` is written

        real(wp) :: h, a, a_lowest, rise
        integer :: i, j

        call gap_at(curve, curve%y_lowest, h, a_lowest)
        rise = max(a_lowest, flattest)*extent%half_length**2
        do j = 1, grid%ny
            call gap_at(curve, element_y(grid, j), h, a)
            do i = 1, grid%nx
                grid%pressure(i, j) = sqrt(max(0.0_wp, 1.0_wp - (h - curve%h_lowest)/extent%level &
                                               - a*element_x(grid, i)**2/rise))
            end do
        end do
    end subroutine guess_pressures
end module faststrip_normal_variational_place
