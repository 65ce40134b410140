!> Pictures as SVG: panels one above the other with axes, lines and dots; no more than that.
module faststrip_command_profile_svg
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_kinds, only: wp
    use faststrip_files_csv, only: csv_writer_t, put_line
    implicit none
    private

    public :: panel_t, begin_svg, end_svg, put_panel, put_curve, put_dots, panel_height, space, &
              panel_width

    !> Where a panel lies, in pixels, and what it shows.
    type :: panel_t
        real(wp) :: top = 0.0_wp                  !! pixels
        real(wp) :: height = 0.0_wp               !! pixels
        ! Given: the unit interval.
        real(wp) :: x(2) = [0.0_wp, 1.0_wp]       !! range along x
        ! Given: the unit interval.
        real(wp) :: y(2) = [0.0_wp, 1.0_wp]       !! range along y, the lower end first
        character(len=60) :: x_name = ''          !! with its unit
        character(len=60) :: y_name = ''          !! with its unit
    end type panel_t

    !> Width of a picture, and the space between its parts.
    !> Tuned [pixels]. Origin: chosen: a column of a page; a line of its words.
    real(wp), parameter :: width = 900.0_wp, space = 20.0_wp
    ! Margins, ticks, and how far numbers and names of an axis are from it, pixels.
    real(wp), parameter :: left = 4.0_wp*space, right = space, tick = 0.25_wp*space, &
                           beside = tick, below = 3.0_wp*tick, far_below = 2.0_wp*below
    !> Width of a panel.
    real(wp), parameter :: panel_width = width - left - right
    ! Most ticks of an axis: their numbers need room.
    integer, parameter :: most_ticks = int(panel_width/left)
    ! Given: round steps are 1, 2, 5, 10.
    real(wp), parameter :: five = 5.0_wp, ten = 10.0_wp

contains

    !> Begin a picture.
    subroutine begin_svg(writer, height, title)
        type(csv_writer_t), intent(inout) :: writer  !! an open file
        real(wp), intent(in) :: height               !! pixels
        character(len=*), intent(in) :: title        !! one line

        call put_line(writer, '<svg xmlns="http://www.w3.org/2000/svg" width="' // pixel(width) &
                      // '" height="' // pixel(height) // '" viewBox="0 0 ' // pixel(width) // ' ' &
                      // pixel(height) // '" font-family="sans-serif" font-size="12">')
        call put_line(writer, '<rect width="100%" height="100%" fill="white"/>')
        call put_line(writer, '<text x="' // pixel(left) // '" y="18" font-size="14">' // &
                      escaped(title) // '</text>')
    end subroutine begin_svg

    !> End it.
    subroutine end_svg(writer)
        type(csv_writer_t), intent(inout) :: writer !! an open file

        call put_line(writer, '</svg>')
    end subroutine end_svg

    !> The height of a panel whose scales are one, pixels.
    pure real(wp) function panel_height(panel)
        type(panel_t), intent(in) :: panel !! its ranges

        panel_height = abs(panel%y(2) - panel%y(1))*panel_width/abs(panel%x(2) - panel%x(1))
    end function panel_height

    !> Frame, ticks and names.
    subroutine put_panel(writer, panel)
        type(csv_writer_t), intent(inout) :: writer  !! an open file
        type(panel_t), intent(in) :: panel           !! where and what

        real(wp) :: at, step
        integer :: i

        call put_line(writer, '<rect x="' // pixel(left) // '" y="' // pixel(panel%top) // &
                      '" width="' // pixel(panel_width) // '" height="' // &
                      pixel(panel%height) // '" fill="none" stroke="black"/>')
        step = tick_step(panel%x)
        at = step*ceiling(minval(panel%x)/step)
        do i = 1, most_ticks + 1
            if (at > maxval(panel%x)) exit
            call put_line(writer, line_of(across(panel, at), panel%top + panel%height, &
                                          across(panel, at), panel%top + panel%height - tick))
            call put_text(writer, across(panel, at), panel%top + panel%height + below, 'middle', &
                          short(at, step))
            at = at + step
        end do
        step = tick_step(panel%y)
        at = step*ceiling(minval(panel%y)/step)
        do i = 1, most_ticks + 1
            if (at > maxval(panel%y)) exit
            call put_line(writer, line_of(left, up(panel, at), left + tick, up(panel, at)))
            call put_text(writer, left - beside, up(panel, at) + 4.0_wp, 'end', short(at, step))
            at = at + step
        end do
        call put_text(writer, 0.5_wp*(left + width - right), panel%top + panel%height + far_below, &
                      'middle', trim(panel%x_name))
        call put_line(writer, '<text transform="translate(16,' // &
                      pixel(panel%top + 0.5_wp*panel%height) // &
                      ') rotate(-90)" text-anchor="middle">' // escaped(trim(panel%y_name)) // &
                      '</text>')
    end subroutine put_panel

    !> A line through points; it is interrupted where a point is not finite or far outside.
    subroutine put_curve(writer, panel, x, y, color, dashed)
        type(csv_writer_t), intent(inout) :: writer  !! an open file
        type(panel_t), intent(in) :: panel           !! where
        real(wp), intent(in) :: x(:), y(:)           !! in the units of the panel
        character(len=*), intent(in) :: color        !! of SVG
        logical, intent(in) :: dashed                !! else solid

        character(len=:), allocatable :: points
        integer :: i

        points = ''
        do i = 1, size(x)
            if (is_inside(panel, x(i), y(i))) then
                points = points // pixel(across(panel, x(i))) // ',' // pixel(up(panel, y(i))) &
                         // ' '
            else
                call flush_points()
            end if
        end do
        call flush_points()

    contains

        subroutine flush_points()
            character(len=:), allocatable :: dashes

            if (len(points) == 0) return
            dashes = '"'
            if (dashed) dashes = '" stroke-dasharray="6,4"'
            call put_line(writer, '<polyline fill="none" stroke="' // color // dashes // &
                          ' stroke-width="1.4" points="' // points // '"/>')
            points = ''
        end subroutine flush_points
    end subroutine put_curve

    !> Dots.
    subroutine put_dots(writer, panel, x, y, color)
        type(csv_writer_t), intent(inout) :: writer  !! an open file
        type(panel_t), intent(in) :: panel           !! where
        real(wp), intent(in) :: x(:), y(:)           !! in the units of the panel
        character(len=*), intent(in) :: color        !! of SVG

        integer :: i

        do i = 1, size(x)
            if (.not. is_inside(panel, x(i), y(i))) cycle
            call put_line(writer, '<circle cx="' // pixel(across(panel, x(i))) // '" cy="' // &
                          pixel(up(panel, y(i))) // '" r="4" fill="none" stroke="' // color // &
                          '"/>')
        end do
    end subroutine put_dots

    pure logical function is_inside(panel, x, y)
        type(panel_t), intent(in) :: panel
        real(wp), intent(in) :: x, y

        is_inside = ieee_is_finite(x) .and. ieee_is_finite(y)
        if (is_inside) is_inside = x >= minval(panel%x) .and. x <= maxval(panel%x) .and. &
                                   y >= minval(panel%y) .and. y <= maxval(panel%y)
    end function is_inside

    pure real(wp) function across(panel, x)
        type(panel_t), intent(in) :: panel
        real(wp), intent(in) :: x

        across = left + panel_width*(x - panel%x(1))/(panel%x(2) - panel%x(1))
    end function across

    pure real(wp) function up(panel, y)
        type(panel_t), intent(in) :: panel
        real(wp), intent(in) :: y

        up = panel%top + panel%height*(panel%y(2) - y)/(panel%y(2) - panel%y(1))
    end function up

    !> A step of 1, 2 or 5 with its power of ten.
    pure real(wp) function tick_step(range) result(step)
        real(wp), intent(in) :: range(2)

        real(wp) :: least
        integer :: power

        least = abs(range(2) - range(1))/most_ticks
        power = floor(log10(least))
        step = ten**power
        if (step*2.0_wp >= least) then
            if (step < least) step = 2.0_wp*step
        else if (step*five >= least) then
            step = five*step
        else
            step = ten*step
        end if
    end function tick_step

    subroutine put_text(writer, x, y, anchor, text)
        type(csv_writer_t), intent(inout) :: writer
        real(wp), intent(in) :: x, y
        character(len=*), intent(in) :: anchor, text

        call put_line(writer, '<text x="' // pixel(x) // '" y="' // pixel(y) // &
                      '" text-anchor="' // anchor // '">' // escaped(text) // '</text>')
    end subroutine put_text

    pure function line_of(x1, y1, x2, y2) result(text)
        real(wp), intent(in) :: x1, y1, x2, y2
        character(len=:), allocatable :: text

        text = '<line x1="' // pixel(x1) // '" y1="' // pixel(y1) // '" x2="' // pixel(x2) // &
               '" y2="' // pixel(y2) // '" stroke="black"/>'
    end function line_of

    pure function pixel(value) result(text)
        real(wp), intent(in) :: value
        character(len=:), allocatable :: text

        character(len=24) :: buffer

        write (buffer, '(f0.1)') value
        text = trim(buffer)
    end function pixel

    !> A number with as many digits as its step needs.
    pure function short(value, step) result(text)
        real(wp), intent(in) :: value, step
        character(len=:), allocatable :: text

        character(len=24) :: buffer, form
        real(wp) :: shown

        shown = value
        if (abs(value) < 0.5_wp*step) shown = 0.0_wp
        write (form, '(a,i0,a)') '(f20.', max(0, -floor(log10(step))), ')'
        write (buffer, form) shown
        text = trim(adjustl(buffer))
        if (text(len(text):) == '.') text = text(:len(text) - 1)
    end function short

    pure function escaped(text) result(safe)
        character(len=*), intent(in) :: text
        character(len=:), allocatable :: safe

        integer :: i

        safe = ''
        do i = 1, len(text)
            select case (text(i:i))
            case ('&'); safe = safe // '&amp;'
            case ('<'); safe = safe // '&lt;'
            case ('>'); safe = safe // '&gt;'
            case ('"'); safe = safe // '&quot;'
            case default; safe = safe // text(i:i)
            end select
        end do
    end function escaped
end module faststrip_command_profile_svg
