!> The picture of a profile: its points and what of them can be touched, the curvature, and the wear
!> against a nominal profile along the arc.
module faststrip_command_profile_picture
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error
    use faststrip_files_csv, only: csv_writer_t, open_csv, close_csv
    use faststrip_command_program_console, only: printable
    use faststrip_command_profile_measures, only: measures_t
    use faststrip_command_profile_svg, only: panel_t, begin_svg, end_svg, put_panel, put_curve, &
                                             put_dots, panel_height, space, panel_width
    implicit none
    private

    public :: draw_profile, nominal_t

    !> A nominal profile, and the wear against it along its arc.
    type :: nominal_t
        logical :: is_given = .false.             !! is there one?
        real(wp), allocatable :: y(:)             !! mm, along the curve
        real(wp), allocatable :: z(:)             !! mm
        real(wp), allocatable :: depth(:)         !! of wear, mm
        logical, allocatable :: is_known(:)       !! is it?
    end type nominal_t

    ! Between panels, above the first; the least height of one, which is at most as high as it is
    ! wide; pixels.
    real(wp), parameter :: between = 3.0_wp*space, first_top = 0.5_wp*between, &
                           low = 0.25_wp*panel_width
    ! Tuned [1/mm]: a curvature of this is drawn at the edge of the panel. Origin: chosen: a
    ! picture.
    real(wp), parameter :: largest_curvature = 0.12_wp
    ! Tuned [mm]: range of wear that is shown at least. Origin: chosen: a picture.
    real(wp), parameter :: least_wear = 0.1_wp
    ! Margin beside a range, over it.
    real(wp), parameter :: share_of_margin = space/panel_width

contains

    !> Draw it.
    subroutine draw_profile(path, measures, nominal, status)
        character(len=*), intent(in) :: path           !! of the picture
        type(measures_t), intent(in) :: measures       !! of the profile
        type(nominal_t), intent(in) :: nominal         !! where there is one
        type(status_t), intent(out) :: status          !! `st_file_write`

        type(csv_writer_t) :: writer
        type(panel_t) :: panel

        call open_csv(writer, path, status)
        if (is_error(status)) return
        associate (y => measures%points%y, z => measures%points%z, part => measures%part%point)
            panel%top = first_top
            panel%x = padded([minval(y), maxval(y)])
            ! Down is down.
            panel%y = padded([maxval(z), minval(z)])
            panel%height = min(max(panel_height(panel), low), panel_width)
            if (panel_height(panel) < low) panel%y = 0.5_wp*sum(panel%y) &
                + (panel%y - 0.5_wp*sum(panel%y))*(low/panel_height(panel))
            panel%x_name = 'y to the field side, mm'
            panel%y_name = 'z (down), mm'
            call begin_svg(writer, panel%top + panel%height + between + (low + between) &
                           *merge(2.0_wp, 1.0_wp, nominal%is_given), title(measures))
            call put_panel(writer, panel)
            if (nominal%is_given) &
                call put_curve(writer, panel, nominal%y, nominal%z, '#d62728', .true.)
            call put_curve(writer, panel, y, z, '#999999', .false.)
            call put_curve(writer, panel, y(part), z(part), '#1f77b4', .false.)
            call put_dots(writer, panel, pack(y, measures%is_kink), pack(z, measures%is_kink), &
                          '#d62728')
            call next_panel(panel, 'curvature, 1/mm', [-largest_curvature, largest_curvature])
            call put_panel(writer, panel)
            call put_curve(writer, panel, y(part), min(max(measures%curvature, &
                           -largest_curvature), largest_curvature), '#1f77b4', .false.)
        end associate
        if (nominal%is_given) call draw_wear(writer, nominal, panel)
        call end_svg(writer)
        call close_csv(writer, status)
    end subroutine draw_profile

    subroutine draw_wear(writer, nominal, panel)
        type(csv_writer_t), intent(inout) :: writer
        type(nominal_t), intent(in) :: nominal
        type(panel_t), intent(inout) :: panel

        real(wp), allocatable :: s(:), depth(:)
        integer :: i, first, last

        allocate (s(size(nominal%y)), source=0.0_wp)
        do i = 2, size(s)
            s(i) = s(i - 1) + hypot(nominal%y(i) - nominal%y(i - 1), &
                                    nominal%z(i) - nominal%z(i - 1))
        end do
        depth = pack(nominal%depth, nominal%is_known)
        if (size(depth) == 0) depth = [0.0_wp]
        panel%x = padded([s(1), s(size(s))])
        panel%x_name = 'arc length of the nominal profile from the gauge side, mm'
        call next_panel(panel, 'wear depth, mm', padded([min(minval(depth), -least_wear), &
                                                         max(maxval(depth), least_wear)]))
        call put_panel(writer, panel)
        first = 1
        do while (first <= size(s))
            if (.not. nominal%is_known(first)) then
                first = first + 1
                cycle
            end if
            last = first
            do while (last < size(s))
                if (.not. nominal%is_known(last + 1)) exit
                last = last + 1
            end do
            call put_curve(writer, panel, s(first:last), nominal%depth(first:last), '#d62728', &
                           .false.)
            first = last + 1
        end do
    end subroutine draw_wear

    pure subroutine next_panel(panel, name, range)
        type(panel_t), intent(inout) :: panel
        character(len=*), intent(in) :: name
        real(wp), intent(in) :: range(2)

        panel%top = panel%top + panel%height + between
        panel%height = low
        panel%y = range
        panel%y_name = name
    end subroutine next_panel

    function title(measures) result(text)
        type(measures_t), intent(in) :: measures
        character(len=:), allocatable :: text

        text = measures%path(index(measures%path, '/', back=.true.) + 1:)
        if (len(measures%words) > 0) text = text // ': ' // measures%words
        text = printable(text)
    end function title

    !> A range with a margin.
    pure function padded(range) result(wider)
        real(wp), intent(in) :: range(2)
        real(wp) :: wider(2)

        real(wp) :: margin

        margin = share_of_margin*max(abs(range(2) - range(1)), least_wear)
        wider = range + [-margin, margin]*merge(1.0_wp, -1.0_wp, range(2) >= range(1))
    end function padded
end module faststrip_command_profile_picture
