!> What the next solution of a wheelset depends on of those before, as bytes: they outlive the
!> program. The solution that follows has the bits of the one that had not been interrupted. What
!> is asked of the last solution, its contacts and their strips, is not among them, and nor is what
!> the caller sets.
!>
!> The bytes begin with words of eight: a mark, the order of bytes, the version of the layout, the
!> number of bytes, what tells wheelsets apart; they end with a checksum.
module faststrip_wheelset_memory
    use, intrinsic :: iso_fortran_env, only: int8, int64
    use faststrip_base_kinds, only: wp
    use faststrip_base_material, only: combined_shear_modulus, combined_poisson_ratio
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, count_text, &
                                     st_file_format, st_workspace_too_small
    use faststrip_contact_method, only: workspace_t
    use faststrip_lookup_checksum, only: crc32
    use faststrip_normal_strip_memory, only: exchange_solver, exchange_strips
    use faststrip_numerics_byte_stream, only: byte_stream_t, exchange, exchange_count, of_word
    use faststrip_wheelset_types, only: wheelset_model_t, wheelset_workspace_t, &
                                        wheel_workspace_t, most_contacts, side_right, side_left
    implicit none
    private

    public :: save_wheelset, restore_wheelset

    ! Given: FSWM, and bytes that a transfer as text would change.
    integer(int64), parameter :: mark = transfer(int([70, 83, 87, 77, 13, 10, 26, 10], int8), &
                                                 0_int64)
    ! Given: reads otherwise where the bytes of a number stand in another order.
    integer(int64), parameter :: order_mark = 72623859790382856_int64
    ! Given: number of the layout, of all that is exchanged.
    integer(int64), parameter :: version = 4_int64
    ! Given: numbers of a header, and that tell one wheelset from another.
    integer, parameter :: n_header = 4, n_marks = 9

contains

    !> Write the memory of a wheelset.
    subroutine save_wheelset(model, workspace, bytes, n, status)
        type(wheelset_model_t), intent(in) :: model                !! made
        type(wheelset_workspace_t), intent(inout) :: workspace     !! reserved for it; as before
        integer(int8), intent(inout), target, contiguous :: bytes(:) !! the first n are written
        integer(int64), intent(out) :: n                           !! how many there are
        type(status_t), intent(out) :: status
            !! `st_workspace_too_small`: they are more than fit, and none is written

        type(byte_stream_t) :: stream
        integer(int64) :: header(n_header)
        integer :: i

        header = [mark, order_mark, version, 0_int64]
        do i = 1, 2
            ! Counted, then written.
            stream%at = 0
            call exchange_words(stream, header)
            call exchange_marks(stream, model)
            call exchange_memory(stream, workspace)
            n = stream%at + of_word
            call check_room(workspace, n, i == 1 .and. size(bytes, kind=int64) < n, status)
            if (is_error(status)) return
            header(n_header) = n
            stream%bytes => bytes(:n)
        end do
        call put_checksum(stream)
    end subroutine save_wheelset

    !> Take the memory of a wheelset over: a workspace is afterwards as the one that was saved.
    subroutine restore_wheelset(model, workspace, bytes, status)
        type(wheelset_model_t), intent(in) :: model               !! made as the one that was saved
        type(wheelset_workspace_t), intent(inout) :: workspace    !! reserved for it
        integer(int8), intent(in), target, contiguous :: bytes(:) !! of `save_wheelset`, all of them
        type(status_t), intent(out) :: status
            !! `st_file_format`: cut, damaged, of another version, order of bytes or wheelset, and
            !! the workspace stays as it is

        type(byte_stream_t) :: stream

        call check_room(workspace, 0_int64, .false., status)
        if (.not. is_error(status)) call check_bytes(model, bytes, status)
        if (is_error(status)) return
        call read_from(stream, bytes, int((n_header + n_marks)*of_word, int64))
        call exchange_memory(stream, workspace)
        if (stream%fits) return
        workspace%has_last = .false.
        call refuse('damaged', status)
    end subroutine restore_wheelset

    subroutine check_room(workspace, n, is_short, status)
        type(wheelset_workspace_t), intent(in) :: workspace
        integer(int64), intent(in) :: n
        logical, intent(in) :: is_short
        type(status_t), intent(out) :: status

        call clear_status(status)
        if (is_short) then
            call set_status(status, st_workspace_too_small, 'the memory of a wheelset takes ' &
                            // trim(count_text(int(n))) // ' bytes')
        else if (.not. allocated(workspace%wheel(side_right)%contact)) then
            call set_status(status, st_workspace_too_small, &
                            'no workspace was reserved for this wheelset')
        end if
    end subroutine check_room

    ! Bytes are not changed by what reads.
    subroutine read_from(stream, bytes, at)
        type(byte_stream_t), intent(out) :: stream
        integer(int8), intent(in), target, contiguous :: bytes(:)
        integer(int64), intent(in) :: at

        stream%bytes => bytes
        stream%at = at
        stream%is_read = .true.
    end subroutine read_from

    subroutine check_bytes(model, bytes, status)
        type(wheelset_model_t), intent(in) :: model
        integer(int8), intent(in), target, contiguous :: bytes(:)
        type(status_t), intent(inout) :: status

        type(byte_stream_t) :: stream
        integer(int64) :: header(n_header), checksum
        real(wp) :: marks(n_marks)

        call read_from(stream, bytes, 0_int64)
        call exchange_words(stream, header)
        call exchange(stream, marks)
        if (.not. stream%fits) then
            call refuse('cut', status)
        else if (header(1) /= mark) then
            call refuse('none', status)
        else if (header(2) /= order_mark) then
            call refuse('of another order of bytes', status)
        else if (header(3) /= version) then
            call refuse('of another version', status)
        else if (header(4) /= size(bytes, kind=int64)) then
            call refuse('cut', status)
        else if (any(abs(marks - marks_of(model)) > 0.0_wp)) then
            call refuse('of another wheelset', status)
        end if
        if (is_error(status)) return
        stream%at = size(bytes, kind=int64) - of_word
        checksum = crc32(bytes(:stream%at))
        header(1) = checksum
        call exchange(stream, header(1))
        if (header(1) /= checksum) call refuse('damaged', status)
    end subroutine check_bytes

    subroutine refuse(what, status)
        character(len=*), intent(in) :: what
        type(status_t), intent(inout) :: status

        call set_status(status, st_file_format, 'the memory of a wheelset is ' // what)
    end subroutine refuse

    subroutine put_checksum(stream)
        type(byte_stream_t), intent(inout) :: stream

        integer(int64) :: checksum

        checksum = crc32(stream%bytes(:stream%at))
        call exchange(stream, checksum)
    end subroutine put_checksum

    subroutine exchange_words(stream, words)
        type(byte_stream_t), intent(inout) :: stream
        integer(int64), intent(inout) :: words(:)

        integer :: i

        do i = 1, size(words)
            call exchange(stream, words(i))
        end do
    end subroutine exchange_words

    subroutine exchange_marks(stream, model)
        type(byte_stream_t), intent(inout) :: stream
        type(wheelset_model_t), intent(in) :: model

        real(wp) :: marks(n_marks)

        marks = marks_of(model)
        call exchange(stream, marks)
    end subroutine exchange_marks

    ! What memory may not be taken over from one wheelset to another without.
    pure function marks_of(model) result(marks)
        type(wheelset_model_t), intent(in) :: model
        real(wp) :: marks(n_marks)

        associate (case => model%case, methods => model%case%methods)
            marks = [model%pair%mark, model%radius, combined_shear_modulus(case%material), &
                     combined_poisson_ratio(case%material), real(methods%normal, wp), &
                     real(methods%tangential, wp), real(methods%strips_per_patch, wp), &
                     merge(1.0_wp, 0.0_wp, case%curved)]
        end associate
    end function marks_of

    subroutine exchange_memory(stream, workspace)
        type(byte_stream_t), intent(inout) :: stream
        type(wheelset_workspace_t), intent(inout) :: workspace

        integer :: side

        call exchange(stream, workspace%has_last)
        if (.not. workspace%has_last) return
        call exchange(stream, workspace%is_reversed)
        call exchange(stream, workspace%stiffness)
        call exchange(stream, workspace%deflection)
        call exchange_state(stream, workspace)
        do side = side_right, side_left
            call exchange_wheel(stream, workspace%wheel(side))
        end do
    end subroutine exchange_memory

    ! The last state, and the path: real numbers alone.
    subroutine exchange_state(stream, workspace)
        type(byte_stream_t), intent(inout) :: stream
        type(wheelset_workspace_t), intent(inout) :: workspace

        real(wp) :: state(storage_size(workspace%last_state)/storage_size(1.0_wp)), &
            path(storage_size(workspace%path)/storage_size(1.0_wp))

        state = transfer(workspace%last_state, state)
        path = transfer(workspace%path, path)
        call exchange(stream, state)
        call exchange(stream, path)
        workspace%last_state = transfer(state, workspace%last_state)
        workspace%path = transfer(path, workspace%path)
    end subroutine exchange_state

    subroutine exchange_wheel(stream, wheel)
        type(byte_stream_t), intent(inout) :: stream
        type(wheel_workspace_t), intent(inout) :: wheel

        integer :: i

        call exchange_count(stream, wheel%n, most_contacts)
        call exchange(stream, wheel%approach)
        call exchange(stream, wheel%slope)
        do i = 1, wheel%n
            call exchange_contact(stream, wheel%contact(i))
        end do
        ! It follows of the state.
        if (stream%is_read) wheel%outline%has_state = .false.
    end subroutine exchange_wheel

    subroutine exchange_contact(stream, contact)
        type(byte_stream_t), intent(inout) :: stream
        type(workspace_t), intent(inout) :: contact

        call exchange(stream, contact%first_strips)
        call exchange_solver(stream, contact%solver)
        call exchange_strips(stream, contact%strips)
        ! Nothing can be asked of its solution.
        if (stream%is_read) contact%solved_by = 0
    end subroutine exchange_contact
end module faststrip_wheelset_memory
