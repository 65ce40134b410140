!> Parts of one work joined: checked by their manifests, and to the bytes that one run would write.
module faststrip_command_batch_joined
    use, intrinsic :: iso_c_binding, only: c_associated, c_int, c_long, c_null_char, c_ptr, c_size_t
    use, intrinsic :: iso_fortran_env, only: int64
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, &
                                     st_bad_argument, st_file_missing
    use faststrip_base_text, only: integer_text
    use faststrip_files_csv, only: csv_text_t
    use faststrip_files_stdio, only: c_open_input, c_fread, c_ferror, c_fclose, c_fseek
    use faststrip_command_batch_gap_digests, only: gap_digests_t, take_digests, put_digests
    use faststrip_command_batch_manifest, only: manifest_t, set_value, value_of, number_of, &
                                                unlike_value, status_counts_t, add_counts, &
                                                put_counts, read_manifest
    use faststrip_command_batch_store, only: store_t, append_to_store, is_made, manifest_path, &
                                             piece_length
    implicit none
    private

    public :: joined_t, check_parts, put_parts

    !> Parts that make one work.
    type :: joined_t
        type(csv_text_t), allocatable :: names(:) !! of the parts, in their order
        type(manifest_t) :: manifest              !! of all of it
        type(status_counts_t) :: counts           !! of all items
        integer(int64), private :: header = 0     ! bytes of each part's header
    end type joined_t

contains

    !> Check that files are the parts of one work, each once and none missing, and that they are
    !> whole.
    subroutine check_parts(names, joined, status)
        type(csv_text_t), intent(in) :: names(:) !! of the parts, in any order, one at least
        type(joined_t), intent(out) :: joined    !! the parts in order
        type(status_t), intent(out) :: status    !! `st_bad_argument`, `st_file_missing`: what is
                                                 !! wrong with which file

        type(manifest_t) :: manifest
        type(gap_digests_t) :: digests
        character(len=:), allocatable :: unlike, changed
        integer(int64) :: part
        integer :: i
        logical :: is_there

        call clear_status(status)
        do i = 1, size(names)
            associate (name => names(i)%text)
                call read_manifest(manifest_path(name), manifest, status)
                if (is_error(status)) return
                call is_made(name, manifest, is_there)
                if (.not. is_there) then
                    call set_status(status, st_file_missing, 'the file is not what its manifest ' &
                                    // 'says: ' // name)
                    return
                end if
                if (i == 1) call start(manifest)
                if (is_error(status)) return
                unlike = unlike_value(joined%manifest, manifest, but_for='part')
                part = number_of(manifest, 'part')
                call take_digests(digests, manifest, changed)
                if (len(unlike) > 0) then
                    call refuse(unlike // ' of ' // names(1)%text // ' is ' &
                                // value_of(joined%manifest, unlike) // ', of ' // name // ' ' &
                                // value_of(manifest, unlike))
                else if (len(changed) > 0) then
                    call refuse('the gap file ' // changed // ' was another one for ' // name)
                else if (number_of(manifest, 'header_bytes') /= joined%header) then
                    call refuse('columns of ' // names(1)%text // ' and ' // name // ' differ')
                else if (part < 1 .or. part > size(joined%names)) then
                    call refuse('no such part: ' // value_of(manifest, 'part') // ' (' // name &
                                // ')')
                else if (allocated(joined%names(part)%text)) then
                    call refuse('part ' // value_of(manifest, 'part') // ' is there twice: ' &
                                // joined%names(part)%text // ' and ' // name)
                end if
                if (is_error(status)) return
                joined%names(part)%text = name
                call add_counts(joined%counts, manifest)
            end associate
        end do
        do i = 1, size(joined%names)
            if (allocated(joined%names(i)%text)) cycle
            call refuse('part ' // integer_text(i) // ' of ' &
                        // integer_text(size(joined%names)) // ' is missing')
            return
        end do
        call set_value(joined%manifest, 'part', 1_int64)
        call set_value(joined%manifest, 'parts', 1_int64)
        call set_value(joined%manifest, 'first', 1_int64)
        call set_value(joined%manifest, 'to_do', number_of(joined%manifest, 'items'))
        call set_value(joined%manifest, 'done', number_of(joined%manifest, 'items'))
        call put_counts(joined%manifest, joined%counts)
        call put_digests(digests, joined%manifest)

    contains

        subroutine start(first)
            type(manifest_t), intent(in) :: first

            integer(int64) :: parts

            joined%manifest = first
            joined%header = number_of(first, 'header_bytes')
            parts = number_of(first, 'parts')
            ! More files than that are not looked for.
            if (parts < 1 .or. parts > huge(i)) then
                call refuse('the manifest names no parts: ' // names(1)%text)
            else
                allocate (joined%names(parts))
            end if
        end subroutine start

        subroutine refuse(words)
            character(len=*), intent(in) :: words

            call set_status(status, st_bad_argument, words)
        end subroutine refuse
    end subroutine check_parts

    !> Copy the parts, one behind the other, with one header.
    subroutine put_parts(joined, store, status)
        type(joined_t), intent(inout) :: joined !! of `check_parts`
        type(store_t), intent(inout) :: store   !! opened
        type(status_t), intent(out) :: status   !! `st_file_write`, `st_file_missing`

        integer :: i

        do i = 1, size(joined%names)
            call put_file(joined%names(i)%text, merge(0_int64, joined%header, i == 1), &
                          joined%manifest, store, status)
            if (is_error(status)) return
        end do
    end subroutine put_parts

    ! Copy a file from a place on.
    subroutine put_file(name, from, manifest, store, status)
        character(len=*), intent(in) :: name
        integer(int64), intent(in) :: from ! bytes
        type(manifest_t), intent(inout) :: manifest
        type(store_t), intent(inout) :: store
        type(status_t), intent(out) :: status

        character(len=:), allocatable :: piece
        type(c_ptr) :: stream
        integer(c_size_t) :: n
        integer(c_int) :: code

        call clear_status(status)
        stream = c_open_input(name // c_null_char)
        if (c_associated(stream)) then
            allocate (character(len=piece_length) :: piece)
            code = c_fseek(stream, int(from, c_long), 0_c_int)
            do while (code == 0)
                n = c_fread(piece, 1_c_size_t, int(piece_length, c_size_t), stream)
                if (n == 0) exit
                call append_to_store(store, piece(:n), manifest, status)
                if (is_error(status)) exit
            end do
            if (code == 0) code = c_ferror(stream)
            if (c_fclose(stream) /= 0) code = 1
            if (code == 0) return
        end if
        call set_status(status, st_file_missing, 'cannot read the file: ' // name)
    end subroutine put_file
end module faststrip_command_batch_joined
