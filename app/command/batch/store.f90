!> An output that grows piece by piece and is never lost: what a killed run has written, another one
!> takes up.
!>
!> Beside the output OUT stand, while it is being made, OUT.lock (which process makes it), and from
!> the first piece on OUT.journal (a manifest of what there is, renamed into place after each piece)
!> and OUT.partial (what there is; the first piece of it is named behind the journal). At the end
!> OUT.partial becomes OUT, and OUT.journal OUT.manifest or nothing. An output that is to be NetCDF
!> is made of OUT.partial and has no manifest. Whatever lies between two of these steps is found by
!> the next run.
!>
!> None of these names is ever taken from somebody else: what has it must be none of the run's
!> inputs, no link, and what a run has left there, which its words or its digest tell; or the output
!> is refused.
module faststrip_command_batch_store
    use, intrinsic :: iso_c_binding, only: c_char, c_int, c_int64_t, c_null_char
    use, intrinsic :: iso_fortran_env, only: int64
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, message_length, &
                                     st_file_write
    use faststrip_files_csv, only: csv_writer_t, open_csv, put_text, close_csv, failure_words, &
                                   find_final_path, find_free_temporary
    use faststrip_files_digest, only: hash_file
    use faststrip_files_lines, only: is_folder
    use faststrip_files_sha256, only: sha256_t, sha256_start, sha256_add, sha256_digest
    use faststrip_files_stdio, only: c_rename, c_remove
    use faststrip_command_program_files, only: take_beside, check_beside
    use faststrip_command_batch_manifest, only: manifest_t, set_value, value_of, number_of, &
                                                write_manifest, read_manifest, unlike_value
    use faststrip_command_program_netcdf_file, only: is_netcdf, write_netcdf
    use faststrip_command_program_system, only: keep_in_mind, forget_file, name_kind, kind_none, &
                                                kind_file
    implicit none
    private

    public :: store_t, open_store, resume_store, append_to_store, finish_store, release_store
    public :: take_store, check_store_of_part, is_made, manifest_path, remove_made
    public :: most_lost, piece_length

    !> Words of the names beside an output.
    character(len=*), parameter :: lock_word = '.lock', partial_word = '.partial', &
                                   journal_word = '.journal', manifest_word = '.manifest'
    !> What a run may lose that is killed, or whose machine fails: how long a piece of work takes,
    !> and how much of it is not yet brought to the disk.
    !> Tuned [s]. Origin: chosen: bringing to the disk takes some 10 ms.
    real(wp), parameter :: most_lost = 1.0_wp
    !> Characters that are read, copied or written at once.
    !> Tuned [characters]. Origin: chosen: 10 MB in memory with all that is made of them.
    integer, parameter :: piece_length = 1048576
    ! What `faststrip_lock` gives where something lies that is no lock.
    ! Given: a number in C.
    integer(c_int), parameter :: lock_of_others = -3

    !> An output being made.
    type :: store_t
        private
        character(len=:), allocatable :: path  ! as it was given
        character(len=:), allocatable :: final ! where links lead to
        logical :: is_kept = .false.           ! can another run take it up?
        logical :: with_manifest = .false.     ! does a manifest of it stay?
        character(len=:), allocatable :: temporary ! name of `file` until the journal is there
        logical :: is_begun = .false.          ! is `file` or `writer` open?
        type(csv_writer_t) :: writer           ! if not kept
        integer(c_int) :: file = -1, lock = -1
        type(sha256_t) :: hash                 ! of what was written
        integer(int64) :: bytes = 0            ! the same
        integer(int64) :: synchronised = 0     ! when that was, clock
    end type store_t

    interface
        function c_lock(path, temporary, holder, capacity) bind(c, name='faststrip_lock') &
            result(file)
            import :: c_char, c_int
            character(kind=c_char), intent(in) :: path(*), temporary(*)
            character(kind=c_char), intent(out) :: holder(*)
            integer(c_int), value :: capacity
            integer(c_int) :: file
        end function c_lock

        subroutine c_unlock(file, path) bind(c, name='faststrip_unlock')
            import :: c_char, c_int
            integer(c_int), value :: file
            character(kind=c_char), intent(in) :: path(*)
        end subroutine c_unlock

        function c_create(path) bind(c, name='faststrip_create') result(file)
            import :: c_char, c_int
            character(kind=c_char), intent(in) :: path(*)
            integer(c_int) :: file
        end function c_create

        function c_name_new(old, new) bind(c, name='faststrip_name_new') result(code)
            import :: c_char, c_int
            character(kind=c_char), intent(in) :: old(*), new(*)
            integer(c_int) :: code
        end function c_name_new

        function c_open_behind(path, bytes) bind(c, name='faststrip_open_behind') result(file)
            import :: c_char, c_int, c_int64_t
            character(kind=c_char), intent(in) :: path(*)
            integer(c_int64_t), value :: bytes
            integer(c_int) :: file
        end function c_open_behind

        function c_write(file, text, length) bind(c, name='faststrip_write') result(code)
            import :: c_char, c_int, c_int64_t
            integer(c_int), value :: file
            character(kind=c_char), intent(in) :: text(*)
            integer(c_int64_t), value :: length
            integer(c_int) :: code
        end function c_write

        function c_close(file, synchronise) bind(c, name='faststrip_close') result(code)
            import :: c_int
            integer(c_int), value :: file, synchronise
            integer(c_int) :: code
        end function c_close

        function c_synchronise(file) bind(c, name='faststrip_synchronise') result(code)
            import :: c_int
            integer(c_int), value :: file
            integer(c_int) :: code
        end function c_synchronise

        function c_length(path) bind(c, name='faststrip_length') result(bytes)
            import :: c_char, c_int64_t
            character(kind=c_char), intent(in) :: path(*)
            integer(c_int64_t) :: bytes
        end function c_length
    end interface

contains

    !> Note the files that a store will need beside its output, before any is opened. Ends the
    !> program with a usage error if one of them is an input or an output.
    subroutine take_store(path, option, can_resume, with_manifest)
        character(len=*), intent(in) :: path     !! name of the output
        character(len=*), intent(in) :: option   !! that names it
        logical, intent(in) :: can_resume, with_manifest !! as for `open_store`

        character(len=:), allocatable :: final

        if (is_stream(path)) return
        call find_final_path(path, final)
        call take_beside(final // lock_word, option)
        if (.not. can_resume) return
        call take_beside(final // journal_word, option)
        call take_beside(final // partial_word, option)
        if (with_manifest) call take_beside(manifest_path(path), option)
    end subroutine take_store

    !> The same for a part that may be made, whose names are noted as a beginning: by another name,
    !> too, nothing that is there may be an input.
    subroutine check_store_of_part(path, option)
        character(len=*), intent(in) :: path   !! name of the part
        character(len=*), intent(in) :: option !! that names the output

        call check_beside(path, option)
        call check_beside(path // lock_word, option)
        call check_beside(path // journal_word, option)
        call check_beside(path // partial_word, option)
        call check_beside(path // manifest_word, option)
    end subroutine check_store_of_part

    !> Take hold of an output. Nothing is written yet.
    subroutine open_store(store, path, can_resume, with_manifest, status, is_busy, is_part)
        type(store_t), intent(out) :: store   !! to be ended by `finish_store` or `release_store`
        character(len=*), intent(in) :: path  !! name of the file, `-`, or `/dev/...`
        logical, intent(in) :: can_resume     !! can another run go on? Else, and of what is no
                                              !! file, what is written is gone if the run is ended
        logical, intent(in) :: with_manifest  !! shall a manifest stay beside what is kept?
        type(status_t), intent(out) :: status !! `st_file_write`: another run has it, its folder
                                              !! cannot be written to, or something lies there that
                                              !! no run has left
        logical, intent(out), optional :: is_busy !! has another run it? Then this is no error
        logical, intent(in), optional :: is_part  !! is it itself a file beside an output, in the
                                                  !! place of which nothing else may be?

        character(len=:), allocatable :: holder
        logical :: is_beside

        call clear_status(status)
        if (present(is_busy)) is_busy = .false.
        store%path = path
        call find_final_path(path, store%final)
        store%with_manifest = with_manifest
        is_beside = .false.
        if (present(is_part)) is_beside = is_part
        if (is_beside) store%final = path
        if (is_stream(path)) then
            call open_csv(store%writer, path, status)
            store%is_begun = .true.
            return
        end if
        store%is_kept = can_resume
        if (is_folder(path)) then
            call set_status(status, st_file_write, 'cannot write the file: ' // path &
                            // ': Is a directory')
            return
        end if
        call hold_lock(store%final // lock_word, store%lock, holder, status)
        if (store%lock == lock_of_others) then
            call refuse_place(store, lock_word, status)
        else if (is_error(status)) then
            call set_status(status, st_file_write, 'cannot write the file: ' // path // ': ' &
                            // status%message)
        else if (store%lock < 0 .and. present(is_busy)) then
            is_busy = .true.
            return
        else if (store%lock < 0) then
            call set_status(status, st_file_write, 'another run is writing the file: ' // path &
                            // ': ' // holder)
        end if
        if (is_error(status)) return
        if (store%is_kept) then
            call check_places(store, is_beside, status)
            if (is_error(status)) call release_store(store)
            return
        end if
        call open_csv(store%writer, path, status)
        store%is_begun = .true.
    end subroutine open_store

    !> Is an output written directly, or without a name?
    logical function is_stream(path)
        character(len=*), intent(in) :: path

        character(len=:), allocatable :: final

        call find_final_path(path, final)
        is_stream = path == '-' .or. index(path, '/dev/') == 1 .or. index(final, '/dev/') == 1 &
                    .or. len_trim(path) == 0
    end function is_stream

    !> What lies where this run will write must be what a run has left.
    subroutine check_places(store, is_beside, status)
        type(store_t), intent(in) :: store
        logical, intent(in) :: is_beside       ! is the output itself such a place?
        type(status_t), intent(inout) :: status

        character(len=:), allocatable :: journal, manifest

        journal = store%final // journal_word
        manifest = store%final // manifest_word
        if (.not. is_left(journal, is_manifest(journal))) then
            call refuse_place(store, journal_word, status)
        else if (.not. is_left(store%final // partial_word, is_manifest(journal))) then
            call refuse_place(store, partial_word, status)
        else if (store%with_manifest .and. .not. is_left(manifest, is_manifest(manifest))) then
            call refuse_place(store, manifest_word, status)
        else if (is_beside) then
            if (.not. is_left(store%final, is_manifest(journal) .or. is_manifest(manifest))) &
                call refuse_place(store, '', status)
        end if
    end subroutine check_places

    !> Has nothing a name, or a file that a run has left there?
    logical function is_left(path, is_ours)
        character(len=*), intent(in) :: path
        logical, intent(in) :: is_ours ! if it is a file

        is_left = name_kind(path) == kind_none .or. name_kind(path) == kind_file .and. is_ours
    end function is_left

    !> Is there a manifest by that very name?
    logical function is_manifest(path)
        character(len=*), intent(in) :: path

        type(manifest_t) :: manifest
        type(status_t) :: status

        is_manifest = name_kind(path) == kind_file
        if (.not. is_manifest) return
        call read_manifest(path, manifest, status)
        is_manifest = .not. is_error(status)
    end function is_manifest

    subroutine refuse_place(store, word, status)
        type(store_t), intent(in) :: store
        character(len=*), intent(in) :: word ! of the place
        type(status_t), intent(out) :: status

        call set_status(status, st_file_write, 'cannot write the file: ' // store%path &
                        // ': in its way is what no run has left there: ' // store%final // word)
    end subroutine refuse_place

    !> Take a lock, a file that goes with the run.
    subroutine hold_lock(path, lock, holder, status)
        character(len=*), intent(in) :: path   !! name of the file
        integer(c_int), intent(out) :: lock    !! for `let_go`; negative if another process has it,
                                               !! `lock_of_others` if it is no lock
        character(len=:), allocatable, intent(out) :: holder !! which one; empty if not known
        type(status_t), intent(out) :: status  !! `st_file_write`: the words of the system

        character(kind=c_char) :: words(message_length)
        character(len=:), allocatable :: temporary
        integer :: i

        call clear_status(status)
        holder = ''
        call find_free_temporary(path, temporary)
        lock = c_lock(path // c_null_char, temporary // c_null_char, words, &
                      int(message_length, c_int))
        if (lock >= 0) then
            call keep_in_mind(path)
        else if (lock == lock_of_others) then
            return
        else if (lock < -1) then
            call set_status(status, st_file_write, trim(failure_words()))
        else
            do i = 1, message_length
                if (words(i) == c_null_char) exit
                holder = holder // words(i)
            end do
        end if
    end subroutine hold_lock

    !> Give a lock back.
    subroutine let_go(path, lock)
        character(len=*), intent(in) :: path     !! name of the file
        integer(c_int), intent(inout) :: lock    !! of `hold_lock`; negative: nothing happens

        if (lock < 0) return
        call c_unlock(lock, path // c_null_char)
        call forget_file(path)
        lock = -1
    end subroutine let_go

    !> Go on where a run before was ended, if there was one that did the same work.
    subroutine resume_store(store, work, found, is_whole, status, by_length)
        type(store_t), intent(inout) :: store     !! opened
        type(manifest_t), intent(inout) :: work   !! what is to be done; becomes the journal
        logical, intent(out) :: found             !! is there anything?
        logical, intent(out) :: is_whole          !! is it all there is to do? Then it is finished
        type(status_t), intent(out) :: status     !! `st_file_write`: it is other work, or broken
        logical, intent(in), optional :: by_length !! as of `is_made`

        type(manifest_t) :: journal
        character(len=:), allocatable :: unlike
        integer(int64) :: bytes

        call clear_status(status)
        found = .false.
        is_whole = .false.
        if (.not. store%is_kept) return
        if (c_length(store%final // journal_word // c_null_char) < 0) then
            if (store%with_manifest) call find_made(store%final, work, is_whole, by_length)
            found = is_whole
            return
        end if
        call read_manifest(store%final // journal_word, journal, status)
        if (is_error(status)) return
        unlike = unlike_value(journal, work)
        if (len(unlike) > 0) then
            call set_status(status, st_file_write, 'cannot resume ' // store%path // ': ' &
                            // unlike // ' was ' // value_of(journal, unlike) // ', is ' &
                            // value_of(work, unlike))
            return
        end if
        bytes = number_of(journal, 'bytes')
        if (c_length(store%final // partial_word // c_null_char) < 0) then
            ! Ended after the file had got its name, or before the first piece had one.
            if (number_of(journal, 'done') == number_of(journal, 'to_do')) &
                call check_bytes(store%final, bytes, value_of(journal, 'sha256'), found)
            is_whole = found
            if (.not. found) return
            work = journal
            call name_journal(store, status)
            return
        end if
        call check_partial(store, journal, found)
        if (found) then
            store%file = c_open_behind(store%final // partial_word // c_null_char, bytes)
            found = store%file >= 0
        end if
        if (.not. found) then
            call set_status(status, st_file_write, 'cannot resume ' // store%path // ': ' &
                            // store%path // partial_word // ' is not what ' // store%path &
                            // journal_word // ' says')
            return
        end if
        store%is_begun = .true.
        store%bytes = bytes
        work = journal
    end subroutine resume_store

    !> Does what there is begin as the journal says? Then `hash` is of that.
    subroutine check_partial(store, journal, is_right)
        type(store_t), intent(inout) :: store
        type(manifest_t), intent(in) :: journal
        logical, intent(out) :: is_right

        integer(int64) :: there

        call hash_file(store%final // partial_word, number_of(journal, 'bytes'), store%hash, &
                       is_right, there)
        if (is_right) is_right = there == number_of(journal, 'bytes') .and. &
                                 sha256_digest(store%hash) == value_of(journal, 'sha256')
    end subroutine check_partial

    !> Is an output there, whole, and of this work? Then its manifest is taken.
    subroutine find_made(path, work, is_there, by_length)
        character(len=*), intent(in) :: path
        type(manifest_t), intent(inout) :: work
        logical, intent(out) :: is_there
        logical, intent(in), optional :: by_length

        type(manifest_t) :: manifest

        call is_made(path, manifest, is_there, by_length)
        if (is_there) is_there = len(unlike_value(manifest, work)) == 0
        if (is_there) work = manifest
    end subroutine find_made

    !> Is an output with a manifest there, and is it what the manifest says?
    subroutine is_made(path, manifest, is_there, by_length)
        character(len=*), intent(in) :: path      !! name of the output
        type(manifest_t), intent(out) :: manifest !! of it
        logical, intent(out) :: is_there
        logical, intent(in), optional :: by_length
            !! is it enough that it is as long? Many processes must not read all of it, each

        character(len=:), allocatable :: final
        type(status_t) :: status

        is_there = name_kind(manifest_path(path)) == kind_file
        if (.not. is_there) return
        call read_manifest(manifest_path(path), manifest, status)
        is_there = .not. is_error(status)
        if (.not. is_there) return
        call find_final_path(path, final)
        if (present(by_length)) then
            if (by_length) then
                is_there = c_length(final // c_null_char) == number_of(manifest, 'bytes')
                return
            end if
        end if
        call check_bytes(final, number_of(manifest, 'bytes'), &
                         value_of(manifest, 'sha256'), is_there)
    end subroutine is_made

    !> Name of the manifest of an output.
    function manifest_path(path) result(name)
        character(len=*), intent(in) :: path !! name of the output
        character(len=:), allocatable :: name

        call find_final_path(path, name)
        name = name // manifest_word
    end function manifest_path

    !> Remove an output with its manifest, if it is no link and as long as that says.
    subroutine remove_made(path)
        character(len=*), intent(in) :: path !! name of the output

        type(manifest_t) :: manifest
        integer(c_int) :: code
        logical :: is_there

        if (all(name_kind(path) /= [kind_none, kind_file])) return
        call is_made(path, manifest, is_there, by_length=.true.)
        if (is_there) code = c_remove(path // c_null_char)
        ! What has a manifest of its own is nobody else's: the manifest goes last.
        if (name_kind(path) == kind_none .and. is_manifest(path // manifest_word)) &
            code = c_remove(path // manifest_word // c_null_char)
    end subroutine remove_made

    !> Add a piece, and let the journal tell of it. The first piece makes the files.
    subroutine append_to_store(store, text, journal, status)
        type(store_t), intent(inout) :: store      !! opened
        character(len=*), intent(in) :: text       !! whole lines
        type(manifest_t), intent(inout) :: journal !! what is done with this piece; `bytes` and
                                                   !! `sha256` are set
        type(status_t), intent(out) :: status      !! `st_file_write`

        integer(int64) :: now, rate
        integer(c_int) :: code

        call clear_status(status)
        if (.not. store%is_kept) then
            call put_text(store%writer, text)
            return
        end if
        if (.not. store%is_begun) call begin(store, status)
        if (is_error(status)) return
        if (c_write(store%file, text, len(text, c_int64_t)) /= 0) then
            call refuse(store, status)
            return
        end if
        call sha256_add(store%hash, text)
        store%bytes = store%bytes + len(text, int64)
        call system_clock(now, rate)
        code = 0
        if (now - store%synchronised > most_lost*rate) then
            code = c_synchronise(store%file)
            store%synchronised = now
        end if
        if (code /= 0) then
            call refuse(store, status)
            return
        end if
        call set_value(journal, 'bytes', store%bytes)
        call set_value(journal, 'sha256', sha256_digest(store%hash))
        if (is_left(store%final // journal_word, .true.)) then
            call write_manifest(store%final // journal_word, journal, status)
        else
            call refuse_place(store, journal_word, status)
        end if
        if (.not. is_error(status) .and. allocated(store%temporary)) &
            call name_partial(store, status)
    end subroutine append_to_store

    subroutine begin(store, status)
        type(store_t), intent(inout) :: store
        type(status_t), intent(inout) :: status

        call drop_leftover(store, status)
        if (is_error(status)) return
        call find_free_temporary(store%final, store%temporary)
        store%file = c_create(store%temporary // c_null_char)
        if (store%file < 0) call refuse(store, status)
        if (is_error(status)) return
        call keep_in_mind(store%temporary)
        call sha256_start(store%hash)
        store%bytes = 0
        store%is_begun = .true.
    end subroutine begin

    !> Remove what is there of a run that is not taken up.
    subroutine drop_leftover(store, status)
        type(store_t), intent(inout) :: store
        type(status_t), intent(inout) :: status

        type(manifest_t) :: journal
        integer(c_int) :: code
        logical :: is_right

        if (name_kind(store%final // journal_word) == kind_none) return
        call read_manifest(store%final // journal_word, journal, status)
        if (is_error(status)) return
        if (name_kind(store%final // partial_word) /= kind_none) then
            call check_partial(store, journal, is_right)
            if (is_right) is_right = c_remove(store%final // partial_word // c_null_char) == 0
            if (.not. is_right) call refuse_place(store, partial_word, status)
            if (is_error(status)) return
        end if
        code = c_remove(store%final // journal_word // c_null_char)
        if (code /= 0) call refuse(store, status)
    end subroutine drop_leftover

    !> Let the first piece have its name, now that the journal tells of it.
    subroutine name_partial(store, status)
        type(store_t), intent(inout) :: store
        type(status_t), intent(inout) :: status

        integer(c_int) :: code

        if (c_name_new(store%temporary // c_null_char, &
                       store%final // partial_word // c_null_char) /= 0) then
            call refuse_place(store, partial_word, status)
            code = c_remove(store%final // journal_word // c_null_char)
            code = c_remove(store%temporary // c_null_char)
        end if
        deallocate (store%temporary)
    end subroutine name_partial

    subroutine refuse(store, status)
        type(store_t), intent(in) :: store
        type(status_t), intent(out) :: status

        call set_status(status, st_file_write, 'cannot write the file: ' // store%path // ': ' &
                        // trim(failure_words()))
    end subroutine refuse

    !> Give the output its name.
    subroutine finish_store(store, status)
        type(store_t), intent(inout) :: store  !! all of it was appended
        type(status_t), intent(out) :: status  !! `st_file_write`

        integer(c_int) :: code

        call clear_status(status)
        if (store%is_kept) then
            code = c_close(store%file, 1_c_int)
            store%file = -1
            if (code /= 0) then
                call refuse(store, status)
            else if (is_netcdf(store%path)) then
                call write_netcdf(store%final // partial_word, store%path, status)
            else if (c_rename(store%final // partial_word // c_null_char, &
                              store%final // c_null_char) /= 0) then
                call refuse(store, status)
            end if
            if (is_netcdf(store%path) .and. .not. is_error(status)) &
                code = c_remove(store%final // partial_word // c_null_char)
            if (.not. is_error(status)) call name_journal(store, status)
        else
            call close_csv(store%writer, status)
        end if
        call release_store(store)
    end subroutine finish_store

    !> The last step: the journal becomes the manifest, or nothing.
    subroutine name_journal(store, status)
        type(store_t), intent(in) :: store
        type(status_t), intent(inout) :: status

        integer(c_int) :: code

        if (.not. store%with_manifest) then
            code = c_remove(store%final // journal_word // c_null_char)
        else if (is_left(store%final // manifest_word, &
                         is_manifest(store%final // manifest_word))) then
            code = c_rename(store%final // journal_word // c_null_char, &
                            store%final // manifest_word // c_null_char)
        else
            call refuse_place(store, manifest_word, status)
            return
        end if
        if (code /= 0) call refuse(store, status)
    end subroutine name_journal

    !> Let go of an output; what was appended stays for who resumes.
    subroutine release_store(store)
        type(store_t), intent(inout) :: store !! opened

        integer(c_int) :: code

        if (store%file >= 0) code = c_close(store%file, 0_c_int)
        store%file = -1
        if (store%lock >= 0) call let_go(store%final // lock_word, store%lock)
    end subroutine release_store

    !> Is a file so long, and is that its digest?
    subroutine check_bytes(path, bytes, wanted, is_right)
        character(len=*), intent(in) :: path
        integer(int64), intent(in) :: bytes
        character(len=*), intent(in) :: wanted
        logical, intent(out) :: is_right

        type(sha256_t) :: hash

        is_right = c_length(path // c_null_char) == bytes
        if (is_right) call hash_file(path, bytes, hash, is_right)
        if (is_right) is_right = sha256_digest(hash) == wanted
    end subroutine check_bytes
end module faststrip_command_batch_store
