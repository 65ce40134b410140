!> Writing a profile as CSV or in SIMPACK's layout, so that it reads back as the same doubles.
module faststrip_files_profile_writer
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, st_file_write
    use faststrip_geometry_touchable, only: body_wheel, body_rail
    use faststrip_files_csv, only: csv_text_t, csv_writer_t, open_csv, put_comment, put_header, &
                                   put_cell, end_row, put_line, close_csv, real_text
    use faststrip_files_profile, only: ends_with
    implicit none
    private

    public :: write_profile, check_profile_name

    character(len=1), parameter :: quote = "'"

contains

    !> Can a profile of a kind be written under a name? `.csv`, `.prw` for wheels, `.prr` for rails.
    subroutine check_profile_name(path, kind, status)
        character(len=*), intent(in) :: path    !! name of the file
        integer, intent(in) :: kind             !! `body_wheel`, `body_rail`; 0: not known
        type(status_t), intent(out) :: status   !! `st_file_write`

        call clear_status(status)
        if (ends_with(path, '.csv')) return
        if (ends_with(path, '.prw') .and. kind == body_wheel) return
        if (ends_with(path, '.prr') .and. kind == body_rail) return
        call set_status(status, st_file_write, 'a profile can be written as .csv, a wheel as ' // &
                        '.prw, a rail as .prr, got ' // path)
    end subroutine check_profile_name

    !> Write a profile.
    subroutine write_profile(path, y, z, kind, comments, status)
        character(len=*), intent(in) :: path            !! ends with .csv, .prw or .prr
        real(wp), intent(in) :: y(:)                    !! to the field side, mm
        real(wp), intent(in) :: z(:)                    !! down, mm
        integer, intent(in) :: kind                     !! `body_wheel`, `body_rail`; 0: not known
        type(csv_text_t), intent(in) :: comments(:)     !! lines in front
        type(status_t), intent(out) :: status           !! `st_file_write`

        type(csv_writer_t) :: writer
        integer :: i

        call check_profile_name(path, kind, status)
        if (is_error(status)) return
        call open_csv(writer, path, status)
        if (is_error(status)) return
        if (ends_with(path, '.csv')) then
            do i = 1, size(comments)
                call put_comment(writer, comments(i)%text)
            end do
            call put_header(writer, [character(len=4) :: 'y_mm', 'z_mm'])
            do i = 1, size(y)
                call put_cell(writer, y(i))
                call put_cell(writer, z(i))
                call end_row(writer)
            end do
        else
            call put_simpack(writer, y, z, kind, comments)
        end if
        call close_csv(writer, status)
    end subroutine write_profile

    !> A wheel's points from the field side to the flange, a rail's from the gauge to the field
    !> side, as SIMPACK lists them.
    subroutine put_simpack(writer, y, z, kind, comments)
        type(csv_writer_t), intent(inout) :: writer
        real(wp), intent(in) :: y(:), z(:)
        integer, intent(in) :: kind
        type(csv_text_t), intent(in) :: comments(:)

        integer :: i, k

        do i = 1, size(comments)
            call put_line(writer, '! ' // comments(i)%text)
        end do
        call put_line(writer, 'header.begin')
        call put_line(writer, '  version = 1')
        call put_line(writer, '  type = ' // merge('1', '0', kind == body_wheel))
        call put_line(writer, 'header.end')
        call put_line(writer, 'spline.begin')
        call put_line(writer, '  approx.smooth = 0')
        call put_line(writer, '  comment = ' // quote // 'written by faststrip' // quote)
        call put_line(writer, '  units.len.f = 1000')
        call put_line(writer, '  units.ang.f = 1')
        call put_line(writer, '  point.begin')
        do i = 1, size(y)
            k = i
            if (kind == body_wheel) k = size(y) + 1 - i
            call put_line(writer, '    ' // real_text(y(k)) // ' ' // real_text(z(k)))
        end do
        call put_line(writer, '  point.end')
        call put_line(writer, 'spline.end')
    end subroutine put_simpack
end module faststrip_files_profile_writer
