!> The table of a wheel on a rail as bytes: what stands behind the header that all kinds share.
module faststrip_lookup_wheel_bytes
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use, intrinsic :: iso_fortran_env, only: int8, int32, int64
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, set_status, is_error, st_file_format, &
                                     st_workspace_too_small
    use faststrip_lookup_axis, only: lookup_axis_t, least_nodes, most_nodes
    use faststrip_lookup_faces, only: n_faces, n_forces
    use faststrip_lookup_table, only: lookup_t, n_contact_numbers, most_slots, n_wheel_errors, &
                                      at_load, at_radius, at_area, set_rise
    use faststrip_lookup_words, only: take_axis, take_doubles, take_values, take_text, word_at, &
                                      put_word, put_doubles, of_double, of_word, of_header, &
                                      n_counts
    implicit none
    private

    public :: take_wheel, put_wheel, wheel_counts, check_wheel_counts

    ! Whole numbers behind those of the header: nodes of yaw and load, slots, contacts with faces.
    integer, parameter :: n_more = 4
    ! Numbers about the table: nu, G, what was promised, two counts of tests; mean, 99th percentile
    ! and worst of each error, by two orders, of two kinds of states. Older files have none of z.
    integer, parameter :: n_before = 5, of_error = 12, least_errors = n_wheel_errors - 1
    ! Tuned [bytes]: the largest table. Origin: safeguard: its size fits 64 bits.
    real(wp), parameter :: most_bytes = 1.0e15_wp

contains

    !> The whole numbers of the header, and how many bytes the table has.
    pure subroutine wheel_counts(lookup, counts, length)
        type(lookup_t), intent(in) :: lookup              !! of a wheel
        integer(int32), intent(inout) :: counts(n_counts) !! the last three are set
        integer(int64), intent(out) :: length             !! bytes

        counts(6) = int(lookup%wheel%y%n, int32)
        counts(7) = int(n_before + of_error*lookup%wheel%n_errors, int32)
        associate (wheel => lookup%wheel)
            length = length_of(counts, int([wheel%yaw%n, wheel%load%n, wheel%slots, wheel%sets], &
                                           int32))
        end associate
    end subroutine wheel_counts

    !> Are the whole numbers those of a table, and how many bytes does it have?
    pure subroutine check_wheel_counts(bytes, counts, are_counts, length)
        integer(int8), intent(in), contiguous :: bytes(:) !! a header at least
        integer(int32), intent(in) :: counts(n_counts)    !! its whole numbers
        logical, intent(out) :: are_counts                !! are they?
        integer(int64), intent(out) :: length             !! bytes; 0 if they are not

        integer(int32) :: more(n_more)

        length = 0
        are_counts = .false.
        if (size(bytes, kind=int64) < of_header + of_word*n_more) return
        call read_more(bytes, more)
        if (any(counts(4:6) < least_nodes) .or. any(counts(4:6) > most_nodes)) return
        if (more(1) < 1 .or. more(1) > most_nodes .or. more(2) < least_nodes) return
        if (more(2) > most_nodes .or. more(3) < 1 .or. more(3) > most_slots) return
        if (more(4) < 1) return
        if (all(counts(7) /= n_before + of_error*[least_errors, n_wheel_errors])) return
        if (real(counts(4), wp)*real(counts(5), wp)**2*real(more(4), wp)*n_faces*n_forces &
            + real(counts(6), wp)*real(more(1), wp)*real(more(2), wp) > most_bytes) return
        are_counts = .true.
        length = length_of(counts, more)
    end subroutine check_wheel_counts

    pure subroutine read_more(bytes, more)
        integer(int8), intent(in), contiguous :: bytes(:)
        integer(int32), intent(out) :: more(n_more)

        integer :: i

        do i = 1, n_more
            more(i) = word_at(bytes, of_header + int(of_word*(i - 1), int64))
        end do
    end subroutine read_more

    pure integer(int64) function length_of(counts, more) result(length)
        integer(int32), intent(in) :: counts(n_counts), more(n_more)

        associate (places => int(counts(6), int64)*more(1)*more(2)*more(3))
            length = of_header + of_word*n_more &
                     + of_double*(sum(int(counts(4:7), int64)) + more(1) + more(2) &
                                  + n_contact_numbers*places) &
                     + of_word*(places + values_of(counts, more)) + counts(8) + of_word
        end associate
    end function length_of

    pure integer(int64) function values_of(counts, more) result(n)
        integer(int32), intent(in) :: counts(n_counts), more(n_more)

        n = 2*n_forces*n_faces*int(counts(4), int64)*int(counts(5), int64)**2*more(4)
    end function values_of

    !> A table behind its header.
    subroutine take_wheel(bytes, counts, lookup, status)
        integer(int8), intent(in), contiguous :: bytes(:) !! of a table whose counts are right
        integer(int32), intent(in) :: counts(n_counts)    !! of its header
        type(lookup_t), intent(inout) :: lookup           !! gets all but its kind
        type(status_t), intent(inout) :: status
            !! `st_file_format`: numbers that no table has; `st_workspace_too_small`: not enough
            !! memory

        integer(int32) :: more(n_more)
        real(wp) :: parameters(counts(7))
        integer(int64) :: at, nodes, i
        integer :: j, failure

        call read_more(bytes, more)
        at = of_header + of_word*n_more
        nodes = int(counts(6), int64)*more(1)*more(2)
        call take_doubles(bytes, at, parameters)
        call take_axis(bytes, at, counts(4), lookup%q)
        call take_axis(bytes, at, counts(5), lookup%ratio)
        associate (wheel => lookup%wheel)
            call take_axis(bytes, at, counts(6), wheel%y)
            call take_axis(bytes, at, more(1), wheel%yaw)
            call take_axis(bytes, at, more(2), wheel%load)
            call set_rise(wheel)
            wheel%slots = more(3)
            wheel%sets = more(4)
            allocate (wheel%contacts(n_contact_numbers, wheel%slots, nodes), stat=failure)
            if (failure == 0) allocate (wheel%set(wheel%slots, nodes), stat=failure)
            if (failure /= 0) then
                call set_status(status, st_workspace_too_small, 'not enough memory for a lookup ' &
                                // 'table')
                return
            end if
            do i = 1, nodes
                do j = 1, wheel%slots
                    call take_doubles(bytes, at, wheel%contacts(:, j, i))
                end do
            end do
            do i = 1, nodes
                do j = 1, wheel%slots
                    wheel%set(j, i) = word_at(bytes, at)
                    at = at + of_word
                end do
            end do
            call take_values(bytes, at, values_of(counts, more), lookup%values, status)
            if (is_error(status)) return
            call take_text(bytes, at, counts(n_counts), lookup%text)
            lookup%nu = parameters(1)
            wheel%shear = parameters(2)
            lookup%promised = parameters(3)
            wheel%tested = nint(min(abs(parameters(4:5)), real(huge(1), wp)))
            wheel%n_errors = (counts(7) - n_before)/of_error
            wheel%errors(:wheel%n_errors, :, :, :) = &
                reshape(parameters(n_before + 1:), [wheel%n_errors, 3, 2, 2])
        end associate
        call check_parts(lookup, parameters, status)
    end subroutine take_wheel

    !> Refuse numbers that no table has, though its checksum is right.
    subroutine check_parts(lookup, parameters, status)
        type(lookup_t), intent(in) :: lookup
        real(wp), intent(in) :: parameters(:)
        type(status_t), intent(inout) :: status

        associate (wheel => lookup%wheel)
            if (min(lookup%q%n, lookup%ratio%n, wheel%y%n, wheel%yaw%n, wheel%load%n) < 1) then
                call set_status(status, st_file_format, 'a lookup table with an axis whose nodes ' &
                                // 'do not increase')
            else if (.not. (goes_to_one(lookup%q) .and. goes_to_one(lookup%ratio))) then
                call set_status(status, st_file_format, 'a lookup table with an axis of creepage ' &
                                // 'that does not go from 0 to 1')
            else if (.not. (all(ieee_is_finite(parameters)) .and. &
                            all(ieee_is_finite(wheel%contacts)))) then
                call set_status(status, st_file_format, 'a lookup table with numbers that are ' // &
                                'not finite')
            else if (any(parameters < 0.0_wp) .or. any(parameters > 1.0e9_wp) .or. &
                     parameters(1) >= 0.5_wp .or. & ! Given: Poisson's ratio
                     .not. wheel%shear > 0.0_wp .or. .not. wheel%load%x(1) > 0.0_wp .or. &
                     wheel%rise%n < 1 .or. &
                     any(abs(wheel%contacts) > 1.0e12_wp) .or. &
                     any(wheel%contacts(at_load, :, :) < 0.0_wp) .or. &
                     any(wheel%contacts(at_area:, :, :) <= 0.0_wp) .or. &
                     any(wheel%contacts(at_radius, :, :) <= 0.0_wp) .or. &
                     any(wheel%set < 1) .or. any(wheel%set > wheel%sets)) then
                call set_status(status, st_file_format, 'a lookup table with numbers out of range')
            end if
        end associate
    end subroutine check_parts

    pure logical function goes_to_one(axis)
        type(lookup_axis_t), intent(in) :: axis

        goes_to_one = abs(axis%x(1)) <= 0.0_wp .and. abs(axis%x(axis%n) - 1.0_wp) <= 0.0_wp
    end function goes_to_one

    !> Write what stands between the header and the values.
    subroutine put_wheel(lookup, at, bytes)
        type(lookup_t), intent(in) :: lookup     !! of a wheel, all of it set
        integer(int64), intent(inout) :: at      !! bytes before it; after it
        integer(int8), intent(inout) :: bytes(:) !! of the table

        integer :: i, j

        associate (wheel => lookup%wheel)
            call put_word(int(wheel%yaw%n, int32), at, bytes)
            call put_word(int(wheel%load%n, int32), at, bytes)
            call put_word(int(wheel%slots, int32), at, bytes)
            call put_word(int(wheel%sets, int32), at, bytes)
            call put_doubles([lookup%nu, wheel%shear, lookup%promised, real(wheel%tested, wp), &
                              reshape(wheel%errors(:wheel%n_errors, :, :, :), &
                                      [of_error*wheel%n_errors])], at, bytes)
            call put_doubles(lookup%q%x, at, bytes)
            call put_doubles(lookup%ratio%x, at, bytes)
            call put_doubles(wheel%y%x, at, bytes)
            call put_doubles(wheel%yaw%x, at, bytes)
            call put_doubles(wheel%load%x, at, bytes)
            do i = 1, size(wheel%set, 2)
                do j = 1, wheel%slots
                    call put_doubles(wheel%contacts(:, j, i), at, bytes)
                end do
            end do
            do i = 1, size(wheel%set, 2)
                do j = 1, wheel%slots
                    call put_word(int(wheel%set(j, i), int32), at, bytes)
                end do
            end do
        end associate
    end subroutine put_wheel
end module faststrip_lookup_wheel_bytes
