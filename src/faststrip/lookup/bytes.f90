!> Lookup tables as bytes, what files hold: docs/formats.md has the layout.
!>
!> Bytes that are damaged, cut, or of another version are told; what they say of sizes is held
!> against their number before anything is allocated.
module faststrip_lookup_bytes
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use, intrinsic :: iso_fortran_env, only: int8, int32, int64, real32
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, count_text, &
                                     number_text, st_file_format, st_workspace_too_small
    use faststrip_lookup_axis, only: lookup_axis_t, make_axis, least_nodes, most_nodes
    use faststrip_lookup_checksum, only: crc32
    use faststrip_lookup_faces, only: n_faces, n_forces
    use faststrip_lookup_table, only: lookup_t, lookup_kind_hertz
    implicit none
    private

    public :: open_lookup, pack_lookup, lookup_version

    !> Version of the layout.
    !> Given: number of the file format.
    integer, parameter :: lookup_version = 1
    ! FSLT, and bytes that a transfer as text would change.
    integer(int8), parameter :: magic(8) = int([70, 83, 76, 84, 13, 10, 26, 10], int8)
    ! Reads otherwise where the bytes of a number stand in another order.
    integer(int32), parameter :: order_mark = 16909060
    integer(int32), parameter :: other_order = 67305985
    ! Whole numbers behind the magic; bytes of a header; of a double.
    integer, parameter :: n_counts = 8, header = 8 + 4*n_counts, of_double = 8, of_word = 4
    ! Numbers about the table: nu, what was promised, how many were tested, 18 errors.
    integer, parameter :: n_parameters = 21
    ! Tuned [bytes]: the longest text. Origin: capacity.
    integer, parameter :: most_text = 65536

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
        real(wp) :: parameters(n_parameters)
        real(wp), allocatable :: scales(:)
        integer(int64) :: length, n_values, at

        call read_header(bytes, counts, length, status)
        if (is_error(status)) return
        associate (n_q => counts(4), n_ratio => counts(5), n_shape => counts(6), &
                   n_text => counts(8))
            at = header
            call take_doubles(bytes, at, parameters)
            call take_axis(bytes, at, n_q, lookup%q)
            call take_axis(bytes, at, n_ratio, lookup%ratio)
            call take_axis(bytes, at, n_shape, lookup%shape)
            allocate (scales(n_forces*n_shape))
            call take_doubles(bytes, at, scales)
            n_values = values_of(counts)
            call take_values(bytes, at, n_values, lookup%values, status)
            if (is_error(status)) return
            call take_text(bytes, at, n_text, lookup%text)
            call check_parts(lookup, parameters, scales, status)
            if (.not. is_error(status)) call check_values(lookup%values, may_lack, status)
            if (is_error(status)) then
                call forget(lookup)
                return
            end if
            lookup%scale = reshape(scales, [n_forces, int(n_shape)])
        end associate
        lookup%nu = parameters(1)
        lookup%promised = parameters(2)
        lookup%tested = nint(parameters(3))
        lookup%errors = reshape(parameters(4:), shape(lookup%errors))
        lookup%kind = counts(3)
    end subroutine open_lookup

    !> The bytes of a table.
    subroutine pack_lookup(lookup, bytes)
        type(lookup_t), intent(in) :: lookup              !! all of it set
        integer(int8), allocatable, intent(out) :: bytes(:) !! a multiple of four

        integer(int32) :: counts(n_counts)
        integer(int64) :: at, i
        integer :: n_text

        n_text = 4*((len(lookup%text) + 3)/4)
        counts = int([order_mark, lookup_version, lookup%kind, lookup%q%n, lookup%ratio%n, &
                      lookup%shape%n, n_parameters, n_text], int32)
        allocate (bytes(length_of(counts)))
        bytes(:8) = magic
        at = 8
        do i = 1, n_counts
            call put_word(counts(i), at, bytes)
        end do
        call put_doubles([lookup%nu, lookup%promised, real(lookup%tested, wp), &
                          reshape(lookup%errors, [size(lookup%errors)])], at, bytes)
        call put_doubles(lookup%q%x, at, bytes)
        call put_doubles(lookup%ratio%x, at, bytes)
        call put_doubles(lookup%shape%x, at, bytes)
        call put_doubles(reshape(lookup%scale, [size(lookup%scale)]), at, bytes)
        do i = 1, size(lookup%values, kind=int64)
            call put_word(transfer(lookup%values(i), 0_int32), at, bytes)
        end do
        do i = 1, n_text
            at = at + 1
            bytes(at) = iachar(' ', int8)
            if (i <= len(lookup%text)) bytes(at) = iachar(lookup%text(i:i), int8)
        end do
        call put_word(crc32(bytes(:at)), at, bytes)
    end subroutine pack_lookup

    !> Refuse bytes that are no table, before anything of them is believed.
    subroutine read_header(bytes, counts, length, status)
        integer(int8), intent(in), contiguous :: bytes(:)
        integer(int32), intent(out) :: counts(n_counts)
        integer(int64), intent(out) :: length
        type(status_t), intent(out) :: status

        integer :: i

        call clear_status(status)
        counts = 0
        length = size(bytes, kind=int64)
        if (length < header) then
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
        else if (any(counts(4:6) < least_nodes) .or. any(counts(4:6) > most_nodes) .or. &
                 counts(3) /= lookup_kind_hertz .or. counts(7) /= n_parameters .or. &
                 counts(8) < 0 .or. counts(8) > most_text .or. counts(1) /= order_mark) then
            call set_status(status, st_file_format, 'a lookup table whose header is damaged')
        else if (length_of(counts) /= length) then
            call set_status(status, st_file_format, 'a lookup table must have as many ' // &
                            'bytes as its header says, ' // &
                            trim(number_text(real(length_of(counts), wp))) // ', got ' // &
                            number_text(real(length, wp)))
        else if (crc32(bytes(:length - of_word)) /= word_at(bytes, length - of_word)) then
            call set_status(status, st_file_format, 'a lookup table that is damaged: its ' // &
                            'checksum is another one')
        end if
    end subroutine read_header

    !> Bytes of a table of so many nodes. The counts are below 1e4: it fits 64 bits.
    pure integer(int64) function length_of(counts) result(length)
        integer(int32), intent(in) :: counts(n_counts)

        length = header + of_double*(int(n_parameters, int64) + counts(4) + counts(5) &
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
                 any(parameters < 0.0_wp) .or. any(parameters > 1.0e9_wp)) then
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

    subroutine take_axis(bytes, at, n, axis)
        integer(int8), intent(in), contiguous :: bytes(:)
        integer(int64), intent(inout) :: at
        integer(int32), intent(in) :: n
        type(lookup_axis_t), intent(out) :: axis

        real(wp) :: nodes(n)

        call take_doubles(bytes, at, nodes)
        call make_axis(nodes, axis)
    end subroutine take_axis

    subroutine take_doubles(bytes, at, numbers)
        integer(int8), intent(in), contiguous :: bytes(:)
        integer(int64), intent(inout) :: at
        real(wp), intent(out) :: numbers(:)

        integer :: i

        do i = 1, size(numbers)
            numbers(i) = transfer(bytes(at + 1:at + of_double), 0.0_wp)
            at = at + of_double
        end do
    end subroutine take_doubles

    subroutine take_values(bytes, at, n, values, status)
        integer(int8), intent(in), contiguous :: bytes(:)
        integer(int64), intent(inout) :: at
        integer(int64), intent(in) :: n
        real(real32), allocatable, intent(out) :: values(:)
        type(status_t), intent(inout) :: status

        integer(int64) :: i
        integer :: failure

        allocate (values(n), stat=failure)
        if (failure /= 0) then
            call set_status(status, st_workspace_too_small, 'not enough memory for a lookup table')
            return
        end if
        do i = 1, n
            values(i) = transfer(bytes(at + 1:at + of_word), 0.0_real32)
            at = at + of_word
        end do
    end subroutine take_values

    subroutine take_text(bytes, at, n, text)
        integer(int8), intent(in), contiguous :: bytes(:)
        integer(int64), intent(inout) :: at
        integer(int32), intent(in) :: n
        character(len=:), allocatable, intent(out) :: text

        integer :: i

        allocate (character(len=n) :: text)
        do i = 1, n
            text(i:i) = achar(iand(int(bytes(at + i)), 255))
        end do
        at = at + n
    end subroutine take_text

    pure integer(int32) function word_at(bytes, at)
        integer(int8), intent(in), contiguous :: bytes(:)
        integer(int64), intent(in) :: at ! bytes before it

        word_at = transfer(bytes(at + 1:at + of_word), 0_int32)
    end function word_at

    pure subroutine put_word(word, at, bytes)
        integer(int32), intent(in) :: word
        integer(int64), intent(inout) :: at
        integer(int8), intent(inout) :: bytes(:)

        bytes(at + 1:at + of_word) = transfer(word, bytes(:1), of_word)
        at = at + of_word
    end subroutine put_word

    pure subroutine put_doubles(numbers, at, bytes)
        real(wp), intent(in) :: numbers(:)
        integer(int64), intent(inout) :: at
        integer(int8), intent(inout) :: bytes(:)

        integer :: i

        do i = 1, size(numbers)
            bytes(at + 1:at + of_double) = transfer(numbers(i), bytes(:1), of_double)
            at = at + of_double
        end do
    end subroutine put_doubles
end module faststrip_lookup_bytes
