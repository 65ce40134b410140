!> Does a profile lie as its kind must? A file that is turned over, mirrored, in metres or with
!> another origin is refused with the option that helps: it would give a wrong contact silently.
module faststrip_files_profile_senses
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_status, only: status_t, clear_status, number_text, st_file_format, &
                                     st_too_few_points
    use faststrip_base_text, only: integer_text, set_place_status
    use faststrip_geometry_touchable, only: body_wheel, body_rail, same_place
    use faststrip_files_profile_points, only: profile_file_t, profile_options_t
    implicit none
    private

    public :: check_shape

    !> Fewest points of a profile.
    integer, parameter :: min_points = 5

    ! Lengths of profiles, along the points: shorter or longer ones are not in mm.
    real(wp), parameter :: shortest = 1.0_wp, longest = 3000.0_wp
    ! The same of a wheel or a rail, unless the user says the unit: those in inches are shorter.
    real(wp), parameter :: shortest_body = 10.0_wp
    ! The same where nothing tells the unit: those of inches or centimetres are shorter.
    real(wp), parameter :: shortest_without_unit = 30.0_wp
    ! A flange, or the face of a rim, is as high.
    real(wp), parameter :: flange_height = 15.0_wp
    ! A curve that comes back from its highest place by as much has a tip there.
    real(wp), parameter :: tip_height = 2.0_wp
    ! A tread is flatter and wider than a rounding of a rim.
    real(wp), parameter :: tread_slope = 0.3_wp, tread_width = 20.0_wp
    ! A head sags by less than this, mm.
    real(wp), parameter :: sag = 0.2_wp
    ! An end steeper than this is a side; its direction is that of a stretch of this length.
    real(wp), parameter :: side_slope = 1.0_wp, side_length = 2.0_wp
    ! Points that turn by more than this turn back; more of them than this have no order.
    real(wp), parameter :: turned_back = 5.0_wp/6.0_wp*pi, most_turned_back = 0.05_wp
    integer, parameter :: few = 5
    ! A curve that turns back by more has a point that does not belong there, mm.
    real(wp), parameter :: longest_fold = 2.0_wp

    ! What helps where a file is in another unit.
    character(len=*), parameter :: unit_remedy = &
        ' (--unit, or unit in a case file, says in what unit a file is)'

contains

    !> Check the points of a profile, in its final frame.
    subroutine check_shape(path, profile, options, status)
        character(len=*), intent(in) :: path           !! name of the file
        type(profile_file_t), intent(in) :: profile    !! final
        type(profile_options_t), intent(in) :: options !! what the user says
        type(status_t), intent(out) :: status          !! `st_too_few_points`, `st_file_format`

        call clear_status(status)
        call check_extent(path, profile, options%unit_mm > 0.0_wp, status)
        if (status%code /= 0) return
        if (profile%kind == body_wheel) call check_wheel(path, profile%y, profile%z, status)
        if (profile%kind == body_rail) call check_rail(path, profile, options%z_sense /= 0, status)
    end subroutine check_shape

    subroutine check_extent(path, profile, has_unit, status)
        character(len=*), intent(in) :: path
        type(profile_file_t), intent(in) :: profile
        logical, intent(in) :: has_unit
        type(status_t), intent(inout) :: status

        real(wp) :: length, chord, next
        integer :: i, before, n, n_back, at

        n = size(profile%y)
        if (n < min_points) then
            call set_place_status(status, st_too_few_points, 'a profile must have at least ' // &
                                  integer_text(min_points) // ' points', integer_text(n), path, 0)
            return
        end if
        length = 0.0_wp
        n_back = 0
        associate (y => profile%y, z => profile%z)
            before = 1
            do i = 2, n
                chord = hypot(y(i) - y(before), z(i) - z(before))
                if (chord <= same_place) cycle
                length = length + chord
                at = before
                before = i
                if (i == n) exit
                next = hypot(y(i + 1) - y(i), z(i + 1) - z(i))
                if (next <= same_place) cycle
                if (abs(atan2((y(i) - y(at))*(z(i + 1) - z(i)) &
                              - (z(i) - z(at))*(y(i + 1) - y(i)), &
                              (y(i) - y(at))*(y(i + 1) - y(i)) &
                              + (z(i) - z(at))*(z(i + 1) - z(i)))) <= turned_back) cycle
                n_back = n_back + 1
                ! The far end of the longer chord is the point that does not belong.
                at = merge(i + 1, i, next > chord)
                chord = max(chord, next)
                if (chord <= longest_fold) cycle
                call set_place_status(status, st_file_format, 'points must stand in order along' &
                                      // ' the profile, it turns back by ' // &
                                      trim(number_text(chord)) // ' mm', '', path, &
                                      profile%line(at))
                return
            end do
        end associate
        if (profile%kind > 0 .and. .not. (has_unit .or. profile%has_unit) .and. &
            length < shortest_without_unit) then
            call set_place_status(status, st_file_format, 'a profile in no unit must be 30 mm ' // &
                                  'long or more' // unit_remedy, &
                                  trim(number_text(length)) // ' mm', path, 0)
        else if (profile%kind > 0 .and. .not. has_unit .and. length < shortest_body) then
            call set_place_status(status, st_file_format, 'a profile of a wheel or a rail must' // &
                                  ' be 10 mm long or more' // unit_remedy, &
                                  trim(number_text(length)) // ' mm', path, 0)
        else if (.not. (length >= shortest .and. length <= longest)) then
            call set_place_status(status, st_file_format, 'a profile must be 1 to 3000 mm long' // &
                                  unit_remedy, &
                                  trim(number_text(length)) // ' mm', path, 0)
        else if (n_back > max(few, int(most_turned_back*n))) then
            call set_place_status(status, st_file_format, 'points must stand in order along' // &
                                  ' the profile, it turns back ' // integer_text(n_back) // &
                                  ' times', '', path, 0)
        end if
    end subroutine check_extent

    !> From the nominal rolling circle a flange goes down on the side of small y, and on the other
    !> side nothing does; where a rim has a face it goes up.
    subroutine check_wheel(path, y, z, status)
        character(len=*), intent(in) :: path
        real(wp), intent(in) :: y(:), z(:)
        type(status_t), intent(inout) :: status

        integer :: at, gauge, field
        real(wp) :: offset
        logical :: is_wrong

        at = tape_point(y)
        if (at == 0) then
            call set_place_status(status, st_file_format, 'the nominal rolling circle must be ' &
                                  // 'on a wheel: y is ' // trim(number_text(minval(y))) &
                                  // ' to ' // trim(number_text(maxval(y))) // &
                                  ' mm from it (--tape-circle, or tape_circle_mm in a ' // &
                                  'case file, says where it is)', '', path, 0)
            return
        end if
        gauge = first_height(z, at, -1)
        field = first_height(z, at, 1)
        ! Both sides may go up, of a roller, or down, of a wheel with two flanges.
        is_wrong = field > 0 .and. gauge <= 0
        if (field < 0 .and. gauge <= 0) is_wrong = has_tread_above(y, z, at)
        if (gauge < 0 .and. field == 0) is_wrong = returns(z, at)
        if (is_wrong) then
            offset = y(maxloc(z, dim=1))
            call set_place_status(status, st_file_format, 'the flange of a wheel must go down at ' &
                                  // 'y below 0, its deepest place is at y = ' // &
                                  trim(number_text(offset)) // ' mm (--tape-circle, ' // &
                                  '--y-positive-to, --z-positive-to, or in a case file ' // &
                                  'tape_circle_mm, y_positive_to, z_positive_to, say where ' // &
                                  'and how it lies)', '', path, 0)
        end if
    end subroutine check_wheel

    !> The point at y = 0, or the one before; 0: none.
    pure integer function tape_point(y) result(at)
        real(wp), intent(in) :: y(:)

        integer :: i

        at = 0
        ! From the field side: the tread is the first that is met.
        do i = size(y) - 1, 1, -1
            if (y(i)*y(i + 1) > 0.0_wp) cycle
            at = i
            return
        end do
    end function tape_point

    !> What comes first on one side of a point: a place lower by the height of a flange (1), one
    !> higher by it (-1), or neither (0).
    pure integer function first_height(z, at, side) result(sense)
        real(wp), intent(in) :: z(:)
        integer, intent(in) :: at, side

        integer :: i

        sense = 0
        i = at
        do while (i >= 1 .and. i <= size(z))
            if (abs(z(i) - z(at)) > flange_height) then
                sense = merge(1, -1, z(i) > z(at))
                return
            end if
            i = i + side
        end do
    end function first_height

    !> Is there beyond the steep side of a flange a flat stretch, the tread, on the field side of a
    !> point?
    pure logical function has_tread_above(y, z, at)
        real(wp), intent(in) :: y(:), z(:)
        integer, intent(in) :: at

        integer :: i, first

        has_tread_above = .false.
        first = at
        do i = at + 1, size(y)
            if (z(at) - z(first) < flange_height .or. &
                abs(z(i) - z(first)) > tread_slope*abs(y(i) - y(first))) then
                ! The longest stretch that begins where the one before ended.
                first = i
            else if (y(i) - y(first) > tread_width) then
                has_tread_above = .true.
                return
            end if
        end do
    end function has_tread_above

    !> Does the curve below a point turn down again from its highest place, as from a tip?
    pure logical function returns(z, at)
        real(wp), intent(in) :: z(:)
        integer, intent(in) :: at

        integer :: highest

        highest = minloc(z(:at), dim=1)
        returns = maxval(z(:highest)) - z(highest) > tip_height
    end function returns

    !> The ends of a rail go down where they are steep. In bare columns its middle is above the line
    !> through its ends, too, if the user does not say which way z points.
    subroutine check_rail(path, profile, is_sure, status)
        character(len=*), intent(in) :: path
        type(profile_file_t), intent(in) :: profile
        logical, intent(in) :: is_sure
        type(status_t), intent(inout) :: status

        associate (y => profile%y, z => profile%z)
            if (goes_up(y, z, 1) .or. goes_up(y, z, size(y))) then
                call refuse()
            else if (.not. (is_sure .or. profile%has_unit)) then
                if (sags(y, z)) call refuse()
            end if
        end associate

    contains

        subroutine refuse()
            call set_place_status(status, st_file_format, 'the sides of a rail must go down: ' // &
                                  'this one lies upside down (--z-positive-to, or ' // &
                                  'z_positive_to in a case file, says how it lies)', '', path, 0)
        end subroutine refuse
    end subroutine check_rail

    !> Is the middle of a curve below the line through its ends?
    pure logical function sags(y, z)
        real(wp), intent(in) :: y(:), z(:)

        integer :: middle, n

        n = size(y)
        middle = minloc(abs(y - 0.5_wp*(y(1) + y(n))), dim=1)
        sags = z(middle) > 0.5_wp*(z(1) + z(n)) + sag
    end function sags

    !> Does the curve go up steeply towards one of its ends?
    pure logical function goes_up(y, z, end_point)
        real(wp), intent(in) :: y(:), z(:)
        integer, intent(in) :: end_point

        integer :: i, side

        side = merge(1, -1, end_point == 1)
        i = end_point + side
        do while (i > 1 .and. i < size(y))
            if (hypot(y(i) - y(end_point), z(i) - z(end_point)) >= side_length) exit
            i = i + side
        end do
        i = min(max(i, 1), size(y))
        goes_up = z(i) - z(end_point) > side_slope*abs(y(i) - y(end_point))
    end function goes_up
end module faststrip_files_profile_senses
