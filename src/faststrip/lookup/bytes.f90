!> Lookup tables as bytes, what files hold: docs/formats.md has the layout.
!>
!> Bytes that are damaged, cut, or of another version are refused; what they say of sizes is held
!> against their number before anything is allocated.
module faststrip_lookup_bytes
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use, intrinsic :: iso_fortran_env, only: int8, int32, int64, real32
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, count_text, &
                                     number_text, st_file_format
    use faststrip_lookup_axis, only: least_nodes, most_nodes
    use faststrip_lookup_checksum, only: crc32
    use faststrip_lookup_faces, only: n_faces, n_forces
    use faststrip_lookup_table, only: lookup_t, lookup_kind_hertz, lookup_kind_wheel
    use faststrip_lookup_wheel_bytes, only: take_wheel, put_wheel, wheel_counts, check_wheel_counts
    use faststrip_lookup_words, only: take_axis, take_doubles, take_values, take_text, word_at, &
                                      put_word, put_doubles, put_values, put_text, of_double, &
                                      of_word, of_header, n_counts, most_text
    implicit none
    private

    public :: open_lookup, pack_lookup

    !> Version of the layout.
    !> Given: number of the file format.
    integer, parameter :: lookup_version = 1
    ! FSLT, and bytes that a transfer as text would change.
    integer(int8), parameter :: magic(8) = int([70, 83, 76, 84, 13, 10, 26, 10], int8)
    ! Reads otherwise where the bytes of a number stand in another order.
    integer(int32), parameter :: order_mark = 16909060
    integer(int32), parameter :: other_order = 67305985
    ! Numbers about the table: nu, what was promised, how many were tested, 18 errors.
    integer, parameter :: n_parameters = 21

contains

    !> A table from its bytes.
    subroutine open_lookup(bytes, lookup, status, may_lack)
        integer(int8), intent(in), contiguous :: bytes(:) !! as a file has them
        type(lookup_t), intent(out) :: lookup             !! ready; none when there is an error
        type(status_t), intent(out) :: status
            !! `st_file_format`: no table, of another version or byte order, cut, damaged;
            !! `st_workspace_too_small`: not enough memory
        logical, intent(in), optional :: may_lack !! may values be NaN, those not yet solved?

        integer(int32) :: counts(n_counts)
        integer(int64) :: length

        call read_header(bytes, counts, length, status)
        if (is_error(status)) return
        if (counts(3) == lookup_kind_wheel) then
            call take_wheel(bytes, counts, lookup, status)
        else
            call take_hertz(bytes, counts, lookup, status)
        end if
        if (.not. is_error(status)) call check_values(lookup%values, may_lack, status)
        if (is_error(status)) then
            call forget(lookup)
            return
        end if
        lookup%kind = counts(3)
    end subroutine open_lookup

    !> A table of Hertz ellipses behind its header.
    subroutine take_hertz(bytes, counts, lookup, status)
        integer(int8), intent(in), contiguous :: bytes(:)
        integer(int32), intent(in) :: counts(n_counts)
        type(lookup_t), intent(inout) :: lookup
        type(status_t), intent(inout) :: status

        real(wp) :: parameters(n_parameters)
        real(wp), allocatable :: scales(:)
        integer(int64) :: at

        associate (n_q => counts(4), n_ratio => counts(5), n_shape => counts(6), &
                   n_text => counts(8))
            at = of_header
            call take_doubles(bytes, at, parameters)
            call take_axis(bytes, at, n_q, lookup%q)
            call take_axis(bytes, at, n_ratio, lookup%ratio)
            call take_axis(bytes, at, n_shape, lookup%shape)
            allocate (scales(n_forces*n_shape))
            call take_doubles(bytes, at, scales)
            call take_values(bytes, at, values_of(counts), lookup%values, status)
            if (is_error(status)) return
            call take_text(bytes, at, n_text, lookup%text)
            call check_parts(lookup, parameters, scales, status)
            if (is_error(status)) return
            lookup%scale = reshape(scales, [n_forces, int(n_shape)])
        end associate
        lookup%nu = parameters(1)
        lookup%promised = parameters(2)
        lookup%tested = nint(parameters(3))
        lookup%errors = reshape(parameters(4:), shape(lookup%errors))
    end subroutine take_hertz

    !> The bytes of a table.
    subroutine pack_lookup(lookup, bytes)
        type(lookup_t), intent(in) :: lookup              !! all of it set
        integer(int8), allocatable, intent(out) :: bytes(:) !! a multiple of four

        integer(int32) :: counts(n_counts)
        integer(int64) :: at, length
        integer :: i

        counts = int([order_mark, lookup_version, lookup%kind, lookup%q%n, lookup%ratio%n, &
                      lookup%shape%n, n_parameters, 4*((len(lookup%text) + 3)/4)], int32)
        if (lookup%kind == lookup_kind_wheel) then
            call wheel_counts(lookup, counts, length)
        else
            length = length_of(counts)
        end if
        allocate (bytes(length))
        bytes(:8) = magic
        at = 8
        do i = 1, n_counts
            call put_word(counts(i), at, bytes)
        end do
        if (lookup%kind == lookup_kind_wheel) then
            call put_wheel(lookup, at, bytes)
        else
            call put_doubles([lookup%nu, lookup%promised, real(lookup%tested, wp), &
                              reshape(lookup%errors, [size(lookup%errors)])], at, bytes)
            call put_doubles(lookup%q%x, at, bytes)
            call put_doubles(lookup%ratio%x, at, bytes)
            call put_doubles(lookup%shape%x, at, bytes)
            call put_doubles(reshape(lookup%scale, [size(lookup%scale)]), at, bytes)
        end if
        call put_values(lookup%values, at, bytes)
        call put_text(lookup%text, int(counts(n_counts)), at, bytes)
        call put_word(crc32(bytes(:at)), at, bytes)
    end subroutine pack_lookup

    !> Refuse bytes that are no table, before anything of them is believed.
    subroutine read_header(bytes, counts, length, status)
        integer(int8), intent(in), contiguous :: bytes(:)
        integer(int32), intent(out) :: counts(n_counts)
        integer(int64), intent(out) :: length
        type(status_t), intent(out) :: status

        integer(int64) :: asked
        integer :: i
        logical :: are_counts

        call clear_status(status)
        counts = 0
        length = size(bytes, kind=int64)
        if (length < of_header) then
            call set_status(status, st_file_format, 'no lookup table: too few bytes, ' // &
                            count_text(int(length)))
            return
        end if
        if (any(bytes(:8) /= magic)) then
            call set_status(status, st_file_format, 'no lookup table: it does not begin as one')
            return
        end if
        do i = 1, n_counts
            counts(i) = word_at(bytes, 8 + 4_int64*(i - 1))
        end do
        if (counts(1) == other_order) then
            call set_status(status, st_file_format, 'a lookup table of a machine with another ' // &
                            'order of bytes')
        else if (counts(1) == order_mark .and. counts(2) /= lookup_version) then
            call set_status(status, st_file_format, 'a lookup table must be of version ' // &
                            trim(count_text(lookup_version)) // ', got ' // count_text(counts(2)))
        end if
        if (is_error(status)) return
        are_counts = counts(1) == order_mark .and. counts(8) >= 0 .and. counts(8) <= most_text
        asked = 0
        if (are_counts .and. counts(3) == lookup_kind_wheel) then
            call check_wheel_counts(bytes, counts, are_counts, asked)
        else if (are_counts) then
            are_counts = counts(3) == lookup_kind_hertz .and. counts(7) == n_parameters .and. &
                         all(counts(4:6) >= least_nodes) .and. all(counts(4:6) <= most_nodes)
            if (are_counts) asked = length_of(counts)
        end if
        if (.not. are_counts) then
            call set_status(status, st_file_format, 'a lookup table whose header is damaged')
        else if (asked /= length) then
            call set_status(status, st_file_format, 'a lookup table must have as many ' // &
                            'bytes as its header says, ' // trim(number_text(real(asked, wp))) // &
                            ', got ' // number_text(real(length, wp)))
        else if (crc32(bytes(:length - of_word)) /= word_at(bytes, length - of_word)) then
            call set_status(status, st_file_format, 'a lookup table that is damaged: its ' // &
                            'checksum is another one')
        end if
    end subroutine read_header

    !> Bytes of a table of so many nodes. The counts are below 1e4: it fits 64 bits.
    pure integer(int64) function length_of(counts) result(length)
        integer(int32), intent(in) :: counts(n_counts)

        length = of_header + of_double*(int(n_parameters, int64) + counts(4) + counts(5) &
                                     + (1 + n_forces)*int(counts(6), int64)) &
                 + of_word*values_of(counts) + counts(8) + of_word
    end function length_of

    pure integer(int64) function values_of(counts) result(n)
        integer(int32), intent(in) :: counts(n_counts)

        n = n_forces*n_faces*int(counts(4), int64)*int(counts(5), int64)**2*counts(6)
    end function values_of

    !> Refuse numbers that no table has, though its checksum is right.
    subroutine check_parts(lookup, parameters, scales, status)
        type(lookup_t), intent(in) :: lookup
        real(wp), intent(in) :: parameters(:), scales(:)
        type(status_t), intent(inout) :: status

        if (min(lookup%q%n, lookup%ratio%n, lookup%shape%n) < least_nodes) then
            call set_status(status, st_file_format, 'a lookup table with an axis whose nodes do ' &
                            // 'not increase')
        else if (any([lookup%q%x(1), lookup%ratio%x(1)] /= 0.0_wp) .or. &
                 any([lookup%q%x(lookup%q%n), lookup%ratio%x(lookup%ratio%n)] /= 1.0_wp)) then
            call set_status(status, st_file_format, 'a lookup table with an axis of creepage ' // &
                            'that does not go from 0 to 1')
        else if (.not. (all(ieee_is_finite(parameters)) .and. all(ieee_is_finite(scales)))) then
            call set_status(status, st_file_format, 'a lookup table with numbers that are not ' // &
                            'finite')
        else if (any(scales <= 0.0_wp) .or. any(scales > 1.0e9_wp) .or. &
                 any(parameters < 0.0_wp) .or. any(parameters > 1.0e9_wp) .or. &
                 parameters(1) >= 0.5_wp) then ! Given: Poisson's ratio
            call set_status(status, st_file_format, 'a lookup table with numbers out of range')
        end if
    end subroutine check_parts

    !> Refuse values that are none.
    subroutine check_values(values, may_lack, status)
        real(real32), intent(in) :: values(:)
        logical, intent(in), optional :: may_lack
        type(status_t), intent(inout) :: status

        if (present(may_lack)) then
            if (may_lack) return
        end if
        if (.not. all(ieee_is_finite(values))) &
            call set_status(status, st_file_format, 'a lookup table with values that are not ' // &
                            'finite, or are not yet solved')
    end subroutine check_values

    !> Leave nothing of a table that is none.
    subroutine forget(lookup)
        type(lookup_t), intent(out) :: lookup

        lookup%kind = 0
    end subroutine forget
end module faststrip_lookup_bytes
