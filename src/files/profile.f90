!> Reading wheel and rail profiles from files into the frame of `faststrip_geometry_profile`: y to
!> the field side, z down, mm, y increasing. Nothing is repaired: points out of order, double points
!> and whatever is no number end the reading with the file, the line and the value.
module faststrip_files_profile
    use faststrip_base_kinds, only: wp
    use faststrip_geometry_sampled, only: min_profile_points
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, number_text, &
                                     st_bad_argument, st_file_format, st_not_increasing, &
                                     st_too_few_points
    use faststrip_base_text, only: trim_blanks, parse_real, integer_text, lower_case, &
                                   set_place_status
    use faststrip_files_lines, only: text_file_t, open_text, read_line, close_text
    implicit none
    private

    public :: read_points_file, read_simpack_file
    public :: simpack_rail, simpack_wheel

    !> The `type` in the header of a SIMPACK file.
    integer, parameter :: simpack_rail = 0
    integer, parameter :: simpack_wheel = 1

    ! Points as they are read, with the line each stands on.
    type :: points_t
        integer :: n = 0
        real(wp), allocatable :: y(:)
        real(wp), allocatable :: z(:)
        integer, allocatable :: line(:)
    end type points_t

    ! What a SIMPACK file says about its points.
    type :: simpack_t
        integer :: kind = -1
        real(wp) :: shift_y = 0.0_wp
        real(wp) :: shift_z = 0.0_wp
        real(wp) :: y_min = 1.0_wp
        real(wp) :: y_max = 0.0_wp
        real(wp) :: z_min = 1.0_wp
        real(wp) :: z_max = 0.0_wp
        real(wp) :: length_factor = 1000.0_wp
        logical :: mirror_y = .false.
        logical :: mirror_z = .false.
    end type simpack_t

    ! Largest coordinate, shift or bound that is read.
    real(wp), parameter :: largest = 1.0e9_wp

    character(len=*), parameter :: separators = ' ,;' // achar(9)

contains

    !> Read a list of points, two numbers a line, in mm.
    !>
    !> The numbers are separated by blanks, tabulators, a comma or a semicolon; `#` and `!` start
    !> comments; one line of two names may come before the points. The file's y has to increase
    !> from line to line.
    subroutine read_points_file(path, y_sense, z_sense, y, z, status)
        character(len=*), intent(in) :: path          !! name of the file
        integer, intent(in) :: y_sense                !! +1: the file's y points to the field
                                                      !! side; -1: to the flange or gauge side
        integer, intent(in) :: z_sense                !! +1: the file's z points down; -1: up
        real(wp), allocatable, intent(out) :: y(:)    !! increasing, to the field side, mm
        real(wp), allocatable, intent(out) :: z(:)    !! down, mm
        type(status_t), intent(out) :: status         !! `st_bad_argument`: a sense is not +-1;
                                                      !! `st_file_missing`, `st_file_format`,
                                                      !! `st_not_increasing`,
                                                      !! `st_too_few_points`
        type(points_t) :: points
        type(text_file_t) :: file
        character(len=:), allocatable :: line
        logical :: found, named

        allocate (y(0), z(0))
        call clear_status(status)
        if (abs(y_sense) /= 1 .or. abs(z_sense) /= 1) then
            call set_status(status, st_bad_argument, 'senses of y and z must be +1 or -1, got ' // &
                            integer_text(y_sense) // ', ' // integer_text(z_sense))
            return
        end if
        call open_text(path, file, status)
        if (is_error(status)) return
        named = .false.
        do
            call read_line(file, line, found, status)
            if (is_error(status) .or. .not. found) exit
            line = without_comment(line, '#!')
            if (len(line) == 0) cycle
            if (points%n == 0 .and. .not. named) then
                named = is_name_line(line)
                if (named) cycle
            end if
            call append_point(line, 2, path, file%line, points, status)
            if (is_error(status)) exit
        end do
        call close_text(file)
        if (.not. is_error(status)) call check_order(points, path, 1.0_wp, status)
        if (is_error(status)) return
        y = real(y_sense, wp)*points%y(:points%n)
        z = real(z_sense, wp)*points%z(:points%n)
        if (y_sense < 0) call reverse(y, z)
    end subroutine read_points_file

    !> Read a SIMPACK wheel (`.prw`) or rail (`.prr`) profile.
    !>
    !> The flags of the file are honoured in the order of the format: shift, bounds (where the
    !> lower is below the upper), mirror, inversion, unit of length (with which the shift and the
    !> bounds are given too). A weight in a third column is passed over: it counts only with
    !> smoothing. The list may run either way, as long as it keeps to it. A file that asks for a
    !> rotation, for smoothing or for a least distance of points is refused.
    subroutine read_simpack_file(path, kind, y, z, status)
        character(len=*), intent(in) :: path          !! name of the file
        integer, intent(in) :: kind                   !! `simpack_wheel` or `simpack_rail`
        real(wp), allocatable, intent(out) :: y(:)    !! increasing, to the field side, mm
        real(wp), allocatable, intent(out) :: z(:)    !! down, mm
        type(status_t), intent(out) :: status         !! `st_file_missing`; `st_file_format`: also
                                                      !! a wheel where a rail is asked or a flag
                                                      !! not supported; `st_not_increasing`,
                                                      !! `st_too_few_points`
        type(points_t) :: points
        type(simpack_t) :: header
        real(wp) :: direction
        integer :: i, n

        allocate (y(0), z(0))
        call read_simpack_lines(path, header, points, status)
        if (is_error(status)) return
        if (header%kind /= kind) then
            call set_place_status(status, st_file_format, &
                                  'the header type must be that of a ' // &
                                  trim(merge('wheel', 'rail ', kind == simpack_wheel)), &
                                  integer_text(header%kind), path, 0)
            return
        end if
        n = 0
        do i = 1, points%n
            points%y(i) = points%y(i) + header%shift_y
            points%z(i) = points%z(i) + header%shift_z
            if (header%y_min < header%y_max) then
                if (points%y(i) < header%y_min .or. points%y(i) > header%y_max) cycle
            end if
            if (header%z_min < header%z_max) then
                if (points%z(i) < header%z_min .or. points%z(i) > header%z_max) cycle
            end if
            n = n + 1
            points%y(n) = points%y(i)
            points%z(n) = points%z(i)
            points%line(n) = points%line(i)
        end do
        points%n = n
        direction = 1.0_wp
        if (n > 1) direction = sign(1.0_wp, points%y(n) - points%y(1))
        call check_order(points, path, direction, status)
        if (is_error(status)) return
        y = points%y(:n)*(1000.0_wp/header%length_factor)
        z = points%z(:n)*(1000.0_wp/header%length_factor)
        if (header%mirror_y) y = -y
        if (header%mirror_z) z = -z
        if (y(n) < y(1)) call reverse(y, z)
    end subroutine read_simpack_file

    subroutine read_simpack_lines(path, header, points, status)
        character(len=*), intent(in) :: path
        type(simpack_t), intent(out) :: header
        type(points_t), intent(out) :: points
        type(status_t), intent(out) :: status
        type(text_file_t) :: file
        character(len=:), allocatable :: line
        logical :: found, in_points, has_points

        call open_text(path, file, status)
        if (is_error(status)) return
        in_points = .false.
        has_points = .false.
        do
            call read_line(file, line, found, status)
            if (is_error(status) .or. .not. found) exit
            line = without_comment(line, '!')
            if (len(line) == 0) cycle
            select case (lower_case(line))
            case ('header.begin', 'header.end', 'spline.begin', 'spline.end')
                cycle
            case ('point.begin')
                if (has_points) call set_place_status(status, st_file_format, &
                                                      'points must stand in one list', line, path, &
                                                      file%line)
                in_points = .true.
                has_points = .true.
            case ('point.end')
                in_points = .false.
            case default
                if (in_points) then
                    call append_point(line, 3, path, file%line, points, status)
                else
                    call take_key(line, path, file%line, header, status)
                end if
            end select
            if (is_error(status)) exit
        end do
        call close_text(file)
        if (is_error(status)) return
        if (in_points .or. .not. has_points) then
            call set_place_status(status, st_file_format, &
                                  'no list between point.begin and point.end', '', path, 0)
        end if
    end subroutine read_simpack_lines

    subroutine take_key(line, path, number, header, status)
        character(len=*), intent(in) :: line, path
        integer, intent(in) :: number
        type(simpack_t), intent(inout) :: header
        type(status_t), intent(inout) :: status
        character(len=:), allocatable :: key, text, range
        real(wp) :: value
        integer :: equals
        logical :: valid

        equals = index(line, '=')
        if (equals == 0) then
            call set_place_status(status, st_file_format, &
                                  'a line must be "key = value"', line, path, &
                                  number)
            return
        end if
        key = lower_case(trim_blanks(line(:equals - 1)))
        text = trim_blanks(line(equals + 1:))
        call parse_real(text, value, valid)
        valid = valid .and. abs(value) <= largest
        range = 'a finite number within 1e9'
        select case (key)
        case ('type')
            range = '0 or 1'
            ! The header's comes first; the second, in the spline part, is the original file's.
            if (header%kind >= 0) return
            valid = valid .and. (value == 0.0_wp .or. value == 1.0_wp)
            if (valid) header%kind = nint(value)
        case ('shift.y')
            header%shift_y = value
        case ('shift.z')
            header%shift_z = value
        case ('bound.y.min')
            header%y_min = value
        case ('bound.y.max')
            header%y_max = value
        case ('bound.z.min')
            header%z_min = value
        case ('bound.z.max')
            header%z_max = value
        case ('mirror.y')
            range = '0 or 1'
            valid = valid .and. (value == 0.0_wp .or. value == 1.0_wp)
            header%mirror_y = value == 1.0_wp
        case ('mirror.z')
            range = '0 or 1'
            valid = valid .and. (value == 0.0_wp .or. value == 1.0_wp)
            header%mirror_z = value == 1.0_wp
        case ('inversion')
            range = '0 or 1'
            ! The order of the points in memory: here it is by increasing y in any case.
            valid = valid .and. (value == 0.0_wp .or. value == 1.0_wp)
        case ('units.len.f')
            range = '1e-6 to 1e9'
            valid = valid .and. value >= 1.0e-6_wp
            if (valid) header%length_factor = value
        case ('approx.smooth', 'rotate', 'point.dist.min')
            if (valid .and. abs(value) > 0.0_wp) then
                call set_place_status(status, st_file_format, key // ' must be 0', text, &
                                      path, number)
                return
            end if
        case default
            return
        end select
        if (.not. valid) then
            call set_place_status(status, st_file_format, key // ' must be ' // range, &
                                  "'" // text // "'", path, number)
        end if
    end subroutine take_key

    pure function without_comment(line, marks) result(text)
        character(len=*), intent(in) :: line, marks
        character(len=:), allocatable :: text
        integer :: i

        i = scan(line, marks)
        if (i == 0) i = len(line) + 1
        text = trim_blanks(line(:i - 1))
    end function without_comment

    ! Two words that start with a letter and are no name of a special number.
    pure logical function is_name_line(line)
        character(len=*), intent(in) :: line
        integer :: first(3), last(3), n, i

        call split_words(line, first, last, n)
        is_name_line = n == 2
        do i = 1, min(n, 2)
            select case (lower_case(line(first(i):first(i))))
            case ('a':'z')
                select case (lower_case(line(first(i):last(i))))
                case ('nan', 'inf', 'infinity')
                    is_name_line = .false.
                end select
            case default
                is_name_line = .false.
            end select
        end do
    end function is_name_line

    ! Places of the first words of a line; `n` counts all of them. Words are separated by blanks,
    ! or by one comma or semicolon with blanks around it: two in a row leave an empty word.
    pure subroutine split_words(line, first, last, n)
        character(len=*), intent(in) :: line
        integer, intent(out) :: first(:), last(:), n
        integer :: i, length

        first = 1
        last = 0
        n = 0
        i = 1
        do
            length = scan(line(i:), separators) - 1
            if (length < 0) length = len(line) - i + 1
            n = n + 1
            if (n <= size(first)) then
                first(n) = i
                last(n) = i + length - 1
            end if
            i = after_blanks(i + length)
            if (i > len(line)) exit
            if (scan(line(i:i), ',;') == 1) i = after_blanks(i + 1)
        end do

    contains

        pure integer function after_blanks(start)
            integer, intent(in) :: start

            after_blanks = verify(line(start:), ' ' // achar(9)) + start - 1
            if (after_blanks < start) after_blanks = len(line) + 1
        end function after_blanks
    end subroutine split_words

    subroutine append_point(line, most_words, path, number, points, status)
        character(len=*), intent(in) :: line, path
        integer, intent(in) :: most_words, number
        type(points_t), intent(inout) :: points
        type(status_t), intent(inout) :: status
        integer :: first(4), last(4), n, i
        real(wp) :: values(3)
        logical :: valid

        call split_words(line, first, last, n)
        if (n < 2 .or. n > most_words) then
            call set_place_status(status, st_file_format, &
                                  'a point must be two numbers', line, path, &
                                  number)
            return
        end if
        values = 0.0_wp
        do i = 1, n
            call parse_real(line(first(i):last(i)), values(i), valid)
            if (.not. valid .or. abs(values(i)) > largest) then
                call set_place_status(status, st_file_format, &
                                      'a coordinate must be a finite number within 1e9', &
                                      "'" // line(first(i):last(i)) // "'", path, number)
                return
            end if
        end do
        if (.not. allocated(points%y)) then
            allocate (points%y(256), points%z(256), source=0.0_wp)
            allocate (points%line(256), source=0)
        end if
        if (points%n == size(points%y)) then
            points%y = [points%y, spread(0.0_wp, 1, points%n)]
            points%z = [points%z, spread(0.0_wp, 1, points%n)]
            points%line = [points%line, spread(0, 1, points%n)]
        end if
        points%n = points%n + 1
        points%y(points%n) = values(1)
        points%z(points%n) = values(2)
        points%line(points%n) = number
    end subroutine append_point

    ! Enough points, each beyond the one before.
    subroutine check_order(points, path, direction, status)
        type(points_t), intent(in) :: points
        character(len=*), intent(in) :: path
        real(wp), intent(in) :: direction
        type(status_t), intent(inout) :: status
        integer :: i

        if (points%n < min_profile_points) then
            call set_place_status(status, st_too_few_points, 'a profile must have at least ' // &
                                  integer_text(min_profile_points) // ' points', &
                                  integer_text(points%n), path, 0)
            return
        end if
        do i = 2, points%n
            if (direction*(points%y(i) - points%y(i - 1)) <= 0.0_wp) then
                call set_place_status(status, st_not_increasing, &
                                      'y must be beyond that of the point before', &
                                      trim(number_text(points%y(i))), path, points%line(i))
                return
            end if
        end do
    end subroutine check_order

    pure subroutine reverse(y, z)
        real(wp), intent(inout) :: y(:), z(:)

        y = y(size(y):1:-1)
        z = z(size(z):1:-1)
    end subroutine reverse
end module faststrip_files_profile
