!> `faststrip batch`: one contact a row of a CSV file, any number of rows.
!>
!> Rows are read and written in chunks. The rows of a chunk are solved by all threads, while one of
!> them writes the chunk before and reads the next one. A chain of rows is solved by one thread, the
!> first of them a cold start; so no bit depends on threads, chunks or parts.
module faststrip_command_batch
    use, intrinsic :: iso_fortran_env, only: int64
    !$ use omp_lib, only: omp_get_num_procs, omp_get_thread_num
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, clear_status, is_error, number_text, &
                                     message_length, first_error, st_file_format
    use faststrip_base_text, only: integer_text, set_place_status
    use faststrip_contact_case, only: contact_case_t
    use faststrip_files_csv, only: csv_stream_t, csv_scan_t, csv_writer_t, csv_text_t, &
                                   row_place_t, open_stream, find_row, row_place, go_to_row, &
                                   find_row_place, close_stream, scan_csv, collect_csv, collected, &
                                   collected_length, forget_collected, put_cell, end_row
    use faststrip_files_lines, only: place_t
    use faststrip_command_batch_rows, only: case_columns, penetration_column, given_columns, &
                                            row_columns_t, &
                                            find_columns, solve_row
    use faststrip_command_batch_worker, only: worker_t, make_workers, release_workers
    use faststrip_command_program_clock, only: microseconds
    use faststrip_command_program_console, only: fail, fail_on_error, note, put_origin, &
                                                 version_text, tell_held, usage_error, &
                                                 exit_bad_input, exit_usage
    use faststrip_command_settings_doubts, only: tally_t, add_tally, hold_tally
    use faststrip_command_program_files, only: trouble_t, take_beside, clear_leftovers
    use faststrip_command_batch_gap_cache, only: gap_cache_t, start_cache, tidy_cache
    use faststrip_command_batch_gap_digests, only: take_digests, put_digests, changed_file
    use faststrip_command_batch_joined, only: joined_t, check_parts, put_parts
    use faststrip_command_program_machine, only: compiler_name, compiler_flags
    use faststrip_command_batch_manifest, only: manifest_t, set_value, number_of, number_text_of, &
                                                status_counts_t, count_status, add_counts, &
                                                put_counts, counted, unlike_value, value_of
    use faststrip_command_settings_method_options, only: method_options, method_notes, &
                                                         take_method_options
    use faststrip_command_settings_methods, only: settings_t
    use faststrip_command_program_netcdf_file, only: is_netcdf, check_names, use_single_precision
    use faststrip_command_program_options, only: command_t, option_t, parse_command, option_text, &
                                                 option_integer, given, given_options, &
                                                 most_threads
    use faststrip_command_batch_parts, only: part_options, part_choice_t, take_part_options, &
                                             share_of, part_beginning, part_name, parts_t, &
                                             start_parts, next_part, mark_part, wait_for_others, &
                                             least_time
    use faststrip_command_rows_result_csv, only: result_columns, put_notes
    use faststrip_command_batch_store, only: store_t, take_store, open_store, resume_store, &
                                             append_to_store, finish_store, release_store, &
                                             is_made, remove_made, check_store_of_part, most_lost, &
                                             piece_length
    use faststrip_command_program_system, only: file_kind, kind_file, set_progress, be_quiet, &
                                                use_one_thread_each
    implicit none
    private

    public :: run_batch, case_columns

    !> Most rows of a chunk: what there is to say of them is no longer than a piece.
    integer, parameter :: most_rows = piece_length/message_length
    !> Tuned [chains]: of a thread in a chunk at least. Origin: chosen: what waits for the last one.
    integer, parameter :: least_chains = 4

    !> Rows that are read, or solved, together.
    type :: chunk_t
        integer :: n = 0                             ! rows
        integer(int64) :: first = 0                  ! number of the first
        character(len=:), allocatable :: text        ! lines, one behind the other
        integer, allocatable :: end_of(:)            ! where each ends, from 0 on
        integer, allocatable :: line(:)              ! number of each
        type(row_place_t) :: behind                  ! where the next row is read from
        integer, allocatable :: code(:)              ! how each ended
        type(csv_text_t), allocatable :: words(:)    ! what there is to say of each
        integer, allocatable :: worker(:), from(:), to(:) ! where the row of its results is
        character(len=:), allocatable :: results     ! rows of results, one behind the other
        integer :: length = 0                        ! of them
        logical :: is_written = .false.
    end type chunk_t

    !> What a run is about.
    type :: job_t
        type(command_t) :: command
        character(len=:), allocatable :: input       ! name of the table
        logical :: is_file = .false.                 ! can it be read twice?
        type(csv_scan_t) :: scan                     ! of it, if so
        type(csv_stream_t) :: stream
        type(row_columns_t) :: columns
        type(settings_t) :: options                  ! what counts for all rows
        type(part_choice_t) :: choice
        integer :: threads = 1
        integer :: chain = 1                         ! rows of a chain
        character(len=:), allocatable :: header      ! of the results
        type(gap_cache_t) :: cache
        type(worker_t), pointer :: workers(:) => null()
        integer :: wanted = 0                        ! rows of the next chunk
        integer(int64) :: resumed = 0                ! rows of the part that were done before
    end type job_t

    !> Why the run has to end, by the first row that says so.
    type, extends(trouble_t) :: first_trouble_t
        integer :: row = 0 ! of the chunk
    end type first_trouble_t

contains

    !> Run the subcommand from the command line.
    subroutine run_batch()
        type(job_t), allocatable :: job
        type(status_counts_t) :: counts
        type(tally_t) :: tally
        integer :: i

        allocate (job)
        call read_command(job)
        call take_table(job)
        call prepare(job)
        if (job%choice%is_shared) then
            call make_parts(job, counts)
        else
            call make_part(job, option_text(job%command, '-o', '-'), job%choice%part, &
                           job%choice%parts, job%choice%is_part, counts)
        end if
        call close_stream(job%stream)
        do i = 1, size(job%workers)
            call add_tally(tally, job%workers(i)%tally)
        end do
        call hold_tally(tally, job%input)
        call tell_held()
        call release_workers(job%workers)
        call clear_leftovers()
        if (counted(counts, first_error) > 0) &
            call fail(exit_bad_input, number_text_of(counted(counts, first_error)) // ' of ' &
                      // number_text_of(counted(counts, 0)) // ' contacts failed')
    end subroutine run_batch

    subroutine read_command(job)
        type(job_t), intent(inout) :: job

        character(len=:), allocatable :: path
        integer :: i

        associate (command => job%command)
            command%name = 'batch'
            command%usage = 'CASES.csv'
            command%about = &
                'Solve one contact per row of a CSV file with the columns' // new_line('a') &
                // 'case,gap_file,E_MPa,nu,mu,N_N,cksi,ceta,cphi_rad_per_mm (wheel and rail' &
                // ' alike;' // new_line('a') // 'gap_file relative to the CSV file). A row with' &
                // ' a number in the further column' // new_line('a') // penetration_column &
                // ' is solved for it; its N_N is then empty, and filled in. The same of' &
                // new_line('a') // given_columns(1) // ' and cksi, ' // given_columns(2) &
                // ' and ceta.' // new_line('a') &
                // 'Columns friction_kind, mu_kinetic, half_slip_speed_mm_s,' &
                // ' initial_slope_factor,' // new_line('a') // 'speed_mm_s: as in &friction and' &
                // ' &motion of a case file, mu being the static value;' // new_line('a') &
                // 'mu_hot, cold_temperature_C, hot_temperature_C and those of &thermal likewise:' &
                // new_line('a') // 'one of the last in a row asks for its temperatures.' &
                // new_line('a') &
                // 'Columns mu_y_mm, mu_table: places and coefficients of friction across the' &
                // ' contact,' // new_line('a') // 'in quotes: "-5, 0, 5".' // new_line('a') &
                // 'Column curved: .true. for rows whose gap file has inclination_rad, as' &
                // ' --curved.' // new_line('a') &
                // 'Other columns are carried through. A row that fails gets its status word and' &
                // new_line('a') // 'empty figures; the others go on, and the exit code is 1.' &
                // new_line('a')
            command%options = [ &
                option_t('-o', 'FILE', 'write the CSV there (default stdout), NetCDF to' &
                         // new_line('a') // 'FILE.nc', writes=.true.), &
                option_t('--single', '', 'numbers of FILE.nc in single precision'), &
                option_t('--threads', 'N', 'threads that solve rows (default: all cores)'), &
                option_t('--chain', 'N', 'start rows from the one before, in chains of N' &
                         // new_line('a') // '(default 1: each a cold start)'), &
                option_t('--times', '', 'fill the columns of times, never twice the same'), &
                option_t('--quiet', '', 'report no progress'), &
                part_options, method_options()]
            command%about = command%about // method_notes()
            call parse_command(command, 1)
            call take_method_options(command, job%options)
            if (given(command, '--quiet')) call be_quiet()
            job%threads = 1
            !$ job%threads = min(omp_get_num_procs(), most_threads)
            job%threads = option_integer(command, '--threads', job%threads, least=1, &
                                         most=most_threads)
            job%chain = option_integer(command, '--chain', 1, least=1, most=most_rows)
            job%choice = take_part_options(command)
            job%input = command%arguments(1)%text
            job%is_file = file_kind(job%input) == kind_file
            if (job%choice%is_part .or. job%choice%resumes) call check_kept(job)
            if (is_netcdf(option_text(command, '-o', ''))) then
                if (job%choice%is_part .or. job%choice%is_shared) &
                    call usage_error('parts are CSV, -o must not end with .nc: faststrip netcdf' &
                                     // ' makes it of the whole', command%name)
            else if (given(command, '--single')) then
                call usage_error('--single needs -o with a file that ends with .nc', command%name)
            end if
            if (given(command, '--single')) call use_single_precision()
            if (.not. given(command, '-o')) return
            call take_store(option_text(command, '-o', '-'), '-o', job%is_file, &
                            job%choice%is_part .or. job%choice%is_shared)
            if (.not. job%choice%is_shared) return
            path = option_text(command, '-o', '-')
            call take_beside(part_beginning(path), '-o', is_beginning=.true.)
            do i = 1, job%choice%parts
                call check_store_of_part(part_name(path, i, job%choice%parts), '-o')
            end do
        end associate
    end subroutine read_command

    !> Parts and what is gone on with must be files.
    subroutine check_kept(job)
        type(job_t), intent(in) :: job

        character(len=:), allocatable :: option

        option = '--resume'
        if (job%choice%is_part) option = '--part'
        if (job%choice%is_shared) option = '--parts'
        if (.not. given(job%command, '-o') .or. option_text(job%command, '-o', '-') == '-' .or. &
            index(option_text(job%command, '-o', '-'), '/dev/') == 1) &
            call usage_error(option // ' needs -o with a file', job%command%name)
        if (.not. job%is_file .and. file_kind(job%input) /= 0) &
            call usage_error(option // ' needs a file that can be read twice, got ' // job%input, &
                             job%command%name)
    end subroutine check_kept

    !> Look at the table: of a file all of it, of a pipe the names of its columns.
    subroutine take_table(job)
        type(job_t), intent(inout) :: job

        type(status_t) :: status

        call open_stream(job%input, job%stream, status)
        call fail_on_error(status)
        call find_columns(job%stream%table, job%columns, status)
        call fail_on_error(status)
        if (is_netcdf(option_text(job%command, '-o', ''))) &
            call check_names(job%stream%table%names, job%input, status)
        call fail_on_error(status)
        if (.not. job%is_file) return
        call set_progress('batch: reading ' // job%input)
        call scan_csv(job%input, job%scan, status)
        call fail_on_error(status)
    end subroutine take_table

    subroutine prepare(job)
        type(job_t), intent(inout) :: job

        type(csv_writer_t) :: writer
        type(status_t) :: status

        call use_one_thread_each()
        if (job%is_file) job%threads = int(min(int(job%threads, int64), &
                                               max(job%scan%rows, 1_int64)))
        call make_workers(job%threads, job%stream%table, &
                          given(job%command, '--times'), job%workers, status)
        call fail_on_error(status)
        call start_cache(job%cache)
        job%wanted = 4*least_chains*job%threads*job%chain
        call collect_csv(writer)
        call put_origin(writer)
        call put_notes(writer, job%options)
        call put_names(writer, job%stream%table%names)
        job%header = collected(writer, 1, collected_length(writer))
    end subroutine prepare

    subroutine put_names(writer, names)
        type(csv_writer_t), intent(inout) :: writer
        type(csv_text_t), intent(in) :: names(:)

        integer :: i

        do i = 1, size(names)
            call put_cell(writer, names(i)%text)
        end do
        do i = 1, size(result_columns)
            call put_cell(writer, trim(result_columns(i)))
        end do
        call end_row(writer)
    end subroutine put_names

    !> What a part is, for its manifest.
    type(manifest_t) function work_of(job, part, parts) result(work)
        type(job_t), intent(in) :: job
        integer, intent(in) :: part, parts

        integer(int64) :: first, last

        call share_of(job%scan%rows, job%chain, part, parts, first, last)
        call set_value(work, 'kind', 'batch')
        call set_value(work, 'revision', version_text())
        call set_value(work, 'compiler', compiler_name() // ', ' // compiler_flags())
        call set_value(work, 'options', given_options(job%command, [character(len=9) :: &
                       '-o', '--threads', '--quiet', '--part', '--parts', '--resume']))
        call set_value(work, 'input', job%input)
        call set_value(work, 'input_sha256', job%scan%digest)
        call set_value(work, 'items', job%scan%rows)
        call set_value(work, 'part', int(part, int64))
        call set_value(work, 'parts', int(parts, int64))
        call set_value(work, 'first', first)
        call set_value(work, 'to_do', last - first + 1)
        call set_value(work, 'done', 0_int64)
        call set_value(work, 'header_bytes', len(job%header, int64))
    end function work_of

    !> All parts, shared with whoever does the same, and joined.
    subroutine make_parts(job, counts)
        type(job_t), intent(inout) :: job
        type(status_counts_t), intent(out) :: counts

        type(csv_text_t), allocatable :: names(:)
        type(parts_t) :: parts
        type(store_t) :: store
        type(joined_t) :: joined
        type(manifest_t) :: work, made
        type(status_t) :: status
        character(len=:), allocatable :: path, unlike
        integer :: part, i
        logical :: is_busy, is_there, by_length

        path = option_text(job%command, '-o', '-')
        work = work_of(job, 1, 1)
        allocate (names(job%choice%parts))
        do i = 1, size(names)
            names(i)%text = part_name(path, i, size(names))
        end do
        call start_parts(parts, size(names))
        call is_made(path, made, is_there)
        ! A manifest that is not that of what is there: then length says nothing.
        by_length = len(value_of(made, 'bytes')) == 0
        if (.not. is_there) then
            ! What is in the way is reported before anything is solved.
            call open_store(store, path, .true., .true., status, is_busy)
            call fail_on_error(status)
            call release_store(store)
        end if
        do
            if (is_there) exit
            part = next_part(parts)
            if (part == 0) then
                call open_store(store, path, .true., .true., status, is_busy)
                call fail_on_error(status)
                if (.not. is_busy) exit
                ! Another process joins them.
                call wait_for_others()
            else
                call make_part(job, names(part)%text, part, size(names), .true., counts, is_busy)
                call mark_part(parts, part, is_busy)
            end if
            call is_made(path, made, is_there, by_length)
        end do
        ! Somebody else may have joined them between the two looks.
        if (.not. is_there) call is_made(path, made, is_there, by_length)
        if (is_there) then
            unlike = unlike_value(made, work)
            if (len(unlike) > 0) &
                call fail(exit_bad_input, path // ' is there, and its ' // unlike // ' was ' &
                          // value_of(made, unlike) // ', not ' // value_of(work, unlike) &
                          // ': remove ' // path // '.manifest to make it anew')
            call check_gaps(job, made, path // ' is there', 'remove ' // path // '.manifest to' &
                            // ' make it anew')
            counts = status_counts_t()
            call add_counts(counts, made)
        else
            call check_parts(names, joined, status)
            call fail_on_error(status)
            call put_parts(joined, store, status)
            call fail_on_error(status)
            call finish_store(store, status)
            call fail_on_error(status)
            counts = joined%counts
        end if
        do i = 1, size(names)
            call remove_made(names(i)%text)
        end do
        call release_store(store)
    end subroutine make_parts

    !> One part, or all of it.
    subroutine make_part(job, path, part, parts, with_manifest, counts, is_busy)
        type(job_t), intent(inout) :: job
        character(len=*), intent(in) :: path
        integer, intent(in) :: part, parts
        logical, intent(in) :: with_manifest
        type(status_counts_t), intent(out) :: counts
        logical, intent(out), optional :: is_busy ! has another process it, or all of them?

        type(store_t) :: store
        type(manifest_t) :: work, made
        type(row_place_t) :: place
        type(status_t) :: status
        type(chunk_t), allocatable :: chunks(:)
        integer(int64) :: first, last
        logical :: is_resumed, is_whole

        if (job%is_file) then
            call share_of(job%scan%rows, job%chain, part, parts, first, last)
            call find_row_place(job%scan, job%stream, first, place, status)
            call fail_on_error(status)
        else
            first = 1
            last = huge(last)
        end if
        work = work_of(job, part, parts)
        allocate (chunks(3))
        job%resumed = 0
        if (.not. job%choice%resumes) call read_chunk(job, chunks(1), last, status)
        if (.not. job%choice%resumes) call fail_on_error(status)
        call open_store(store, path, job%is_file, with_manifest, status, is_busy, &
                        is_part=job%choice%is_shared)
        call fail_on_error(status)
        if (present(is_busy)) then
            if (is_busy) return
        end if
        is_resumed = .false.
        is_whole = .false.
        if (job%choice%resumes) then
            call resume_store(store, work, is_resumed, is_whole, status, &
                              by_length=job%choice%is_shared)
            call fail_on_error(status)
            if (job%choice%is_shared .and. .not. (is_resumed .or. is_whole)) then
                ! It is gone if somebody has joined all parts meanwhile.
                call is_made(option_text(job%command, '-o', '-'), made, is_busy)
                if (is_busy) then
                    call release_store(store)
                    return
                end if
            end if
            call add_counts(counts, work)
            call check_gaps(job, work, 'cannot resume ' // path, 'without --resume all of it is' &
                            // ' made anew')
            if (is_resumed) job%resumed = number_of(work, 'done')
            if (job%resumed > 0 .and. .not. is_whole) then
                call go_to_row(job%stream, row_place_t(first - 1 + job%resumed, place_t( &
                               number_of(work, 'input_offset'), &
                               int(number_of(work, 'input_line')))), status)
                call fail_on_error(status)
            end if
        end if
        if (is_whole) then
            call release_store(store)
            return
        end if
        if (job%choice%resumes) call read_chunk(job, chunks(1), last, status)
        call fail_on_error(status)
        call make_rows(job, store, work, chunks, first, last, is_resumed, counts)
        call finish_store(store, status)
        call fail_on_error(status)
    end subroutine make_part

    !> End the program if a gap file is no longer what rows of a manifest were solved with, or what
    !> this run has read.
    subroutine check_gaps(job, work, what, way_out)
        type(job_t), intent(inout) :: job
        type(manifest_t), intent(in) :: work
        character(len=*), intent(in) :: what    ! cannot be had
        character(len=*), intent(in) :: way_out ! what the user may do

        character(len=:), allocatable :: changed

        call take_digests(job%cache%digests, work, changed)
        if (len(changed) == 0) changed = changed_file(job%cache%digests)
        if (len(changed) > 0) &
            call fail(exit_bad_input, what // ', but the gap file ' // changed &
                      // ' has changed: ' // way_out)
    end subroutine check_gaps

    !> Solve all rows from a chunk on.
    subroutine make_rows(job, store, work, chunks, first, last, is_resumed, counts)
        type(job_t), intent(inout) :: job
        type(store_t), intent(inout) :: store
        type(manifest_t), intent(inout) :: work
        type(chunk_t), intent(inout) :: chunks(3) ! the first one is read
        integer(int64), intent(in) :: first, last
        logical, intent(in) :: is_resumed         ! is the header written?
        type(status_counts_t), intent(inout) :: counts

        type(status_t) :: written
        type(first_trouble_t) :: trouble
        integer(int64) :: begun, from, to
        integer :: groups, g, me, now, next, before

        now = 1
        next = 2
        before = 3
        chunks(before)%first = first
        chunks(before)%behind = row_place(job%stream)
        chunks(before)%is_written = is_resumed .or. chunks(now)%n > 0
        if (.not. chunks(before)%is_written) call put_header(chunks(before))
        if (.not. is_resumed) call put_header(chunks(now))
        call system_clock(begun)
        do while (chunks(now)%n > 0)
            groups = (chunks(now)%n + job%chain - 1)/job%chain
            call system_clock(from)
            !$omp parallel num_threads(job%threads) default(shared) private(me)
            me = 1
            !$ me = omp_get_thread_num() + 1
            ! Only the first thread makes files: signals are handled in it.
            !$omp master
            call write_chunk(chunks(before), first, store, work, written)
            if (.not. is_error(written)) call read_chunk(job, chunks(next), last, written)
            !$omp end master
            !$omp do schedule(dynamic, 1)
            do g = 1, groups
                call solve_chain(job%workers(me), me, job%columns, job%cache, &
                                 job%options%contact_case_t, &
                                 job%chain, chunks(now), g, trouble)
            end do
            !$omp end do
            !$omp end parallel
            call system_clock(to)
            call fail_on_error(written)
            if (trouble%code == exit_usage) call usage_error(trouble%words, '')
            if (trouble%code /= 0) call fail(trouble%code, trouble%words)
            call collect_results(job, chunks(now), counts)
            call put_counts(work, counts)
            call put_digests(job%cache%digests, work)
            call tidy_cache(job%cache)
            call choose_size(job, chunks(now)%n, 1.0e-6_wp*microseconds(from, to)) ! Given: us
            call tell(job, work, first, chunks(now)%first + chunks(now)%n - 1, begun)
            before = now
            now = next
            next = 6 - before - now ! Given: the third of 1, 2, 3
        end do
        call write_chunk(chunks(before), first, store, work, written)
        call fail_on_error(written)

    contains

        ! Let the results of a chunk begin with the header.
        subroutine put_header(chunk)
            type(chunk_t), intent(inout) :: chunk

            chunk%results = job%header
            chunk%length = len(job%header)
        end subroutine put_header
    end subroutine make_rows

    !> Read the next rows, up to the last one of a part.
    subroutine read_chunk(job, chunk, last, status)
        type(job_t), intent(inout) :: job
        type(chunk_t), intent(inout) :: chunk
        integer(int64), intent(in) :: last
        type(status_t), intent(out) :: status

        character(len=:), allocatable :: longer
        integer :: from, to, length
        logical :: found

        call clear_status(status)
        if (.not. allocated(chunk%text)) call make_chunk(chunk)
        chunk%n = 0
        chunk%length = 0
        chunk%is_written = .false.
        chunk%first = job%stream%row + 1
        do while (job%stream%row < last)
            ! Chains stay together.
            if (modulo(chunk%n, job%chain) == 0 .and. &
                (chunk%n >= job%wanted .or. chunk%end_of(chunk%n) > piece_length)) exit
            call find_row(job%stream, from, to, found, status)
            if (.not. (is_error(status) .or. found) .and. job%is_file) &
                call set_place_status(status, st_file_format, 'the file has changed', '', &
                                      job%input, job%stream%file%line)
            if (is_error(status) .or. .not. found) exit
            length = chunk%end_of(chunk%n) + to - from + 1
            if (length > len(chunk%text)) then
                allocate (character(len=2*length) :: longer)
                longer(:chunk%end_of(chunk%n)) = chunk%text(:chunk%end_of(chunk%n))
                call move_alloc(longer, chunk%text)
            end if
            chunk%text(chunk%end_of(chunk%n) + 1:length) = job%stream%file%buffer(from:to)
            chunk%n = chunk%n + 1
            chunk%end_of(chunk%n) = length
            chunk%line(chunk%n) = job%stream%file%line
        end do
        chunk%behind = row_place(job%stream)
    end subroutine read_chunk

    subroutine make_chunk(chunk)
        type(chunk_t), intent(inout) :: chunk

        ! Room of the longest chain behind what is enough.
        integer, parameter :: most = 2*most_rows

        allocate (character(len=piece_length/4) :: chunk%text)
        allocate (chunk%end_of(0:most), chunk%line(most), chunk%code(most), chunk%words(most), &
                  chunk%worker(most), chunk%from(most), chunk%to(most))
        chunk%end_of(0) = 0
        if (.not. allocated(chunk%results)) chunk%results = ''
    end subroutine make_chunk

    !> Solve the rows of one chain of a chunk.
    subroutine solve_chain(worker, me, columns, cache, options, chain, chunk, number, trouble)
        type(worker_t), intent(inout) :: worker
        integer, intent(in) :: me                 ! number of the worker
        type(row_columns_t), intent(in) :: columns
        type(gap_cache_t), intent(inout) :: cache ! of all workers
        type(contact_case_t), intent(in) :: options
        integer, intent(in) :: chain              ! rows of a chain
        type(chunk_t), intent(inout) :: chunk     ! of all workers
        integer, intent(in) :: number             ! of the chain
        type(first_trouble_t), intent(inout) :: trouble ! of all workers

        type(trouble_t) :: own
        type(status_t) :: status
        integer :: i

        worker%can_go_on = .false.
        do i = (number - 1)*chain + 1, min(number*chain, chunk%n)
            chunk%worker(i) = me
            chunk%from(i) = collected_length(worker%writer) + 1
            call solve_row(worker, columns, cache, options, &
                           chunk%text(chunk%end_of(i - 1) + 1:chunk%end_of(i)), chunk%line(i), &
                           status, chunk%words(i)%text, own)
            chunk%to(i) = collected_length(worker%writer)
            chunk%code(i) = status%code
            if (own%code == 0) cycle
            !$omp critical (batch_trouble)
            if (trouble%code == 0 .or. i < trouble%row) then
                trouble%trouble_t = own
                trouble%row = i
            end if
            !$omp end critical (batch_trouble)
            return
        end do
    end subroutine solve_chain

    !> Put the rows of results in order, count them, and say what there is to say.
    subroutine collect_results(job, chunk, counts)
        type(job_t), intent(inout) :: job
        type(chunk_t), intent(inout) :: chunk
        type(status_counts_t), intent(inout) :: counts

        character(len=:), allocatable :: longer, row
        integer :: i, length

        do i = 1, chunk%n
            call count_status(counts, chunk%code(i))
            length = chunk%length + chunk%to(i) - chunk%from(i) + 1
            if (length > len(chunk%results)) then
                allocate (character(len=2*length + piece_length/4) :: longer)
                longer(:chunk%length) = chunk%results(:chunk%length)
                call move_alloc(longer, chunk%results)
            end if
            chunk%results(chunk%length + 1:length) = &
                collected(job%workers(chunk%worker(i))%writer, chunk%from(i), chunk%to(i))
            chunk%length = length
            if (.not. allocated(chunk%words(i)%text)) cycle
            row = 'row ' // number_text_of(chunk%first + i - 1)
            if (chunk%code(i) >= first_error) row = row // ' (' // job%input // ':' &
                                                    // integer_text(chunk%line(i)) // ')'
            call note(row // ': ' // chunk%words(i)%text)
        end do
        do i = 1, size(job%workers)
            call forget_collected(job%workers(i)%writer)
        end do
    end subroutine collect_results

    !> Write the results of a chunk, with a journal of what is done.
    subroutine write_chunk(chunk, first, store, work, status)
        type(chunk_t), intent(inout) :: chunk
        integer(int64), intent(in) :: first ! row of the part
        type(store_t), intent(inout) :: store
        type(manifest_t), intent(inout) :: work
        type(status_t), intent(out) :: status

        call clear_status(status)
        if (chunk%is_written) return
        call set_value(work, 'done', chunk%first + chunk%n - first)
        call set_value(work, 'input_offset', chunk%behind%place%offset)
        call set_value(work, 'input_line', int(chunk%behind%place%line, int64))
        call append_to_store(store, chunk%results(:chunk%length), work, status)
        chunk%is_written = .true.
    end subroutine write_chunk

    !> How many rows the next chunk shall have, from how long the last took.
    subroutine choose_size(job, n, seconds)
        type(job_t), intent(inout) :: job
        integer, intent(in) :: n
        real(wp), intent(in) :: seconds

        if (seconds < least_time .and. n >= job%wanted) job%wanted = 2*job%wanted
        if (seconds > most_lost) job%wanted = job%wanted/2
        job%wanted = min(most_rows, max(job%wanted, least_chains*job%threads*job%chain))
    end subroutine choose_size

    !> For the lines on stderr: how far the work is, how fast, and how long it will take.
    subroutine tell(job, work, first, row, begun)
        type(job_t), intent(in) :: job
        type(manifest_t), intent(in) :: work
        integer(int64), intent(in) :: first, row, begun

        character(len=:), allocatable :: text
        integer(int64) :: now, done, total
        real(wp) :: rate ! 1/s

        call system_clock(now)
        done = row - first + 1
        total = number_of(work, 'to_do')
        ! Given: us, and a ms at least.
        rate = real(done - job%resumed, wp)/max(1.0e-6_wp*microseconds(begun, now), 1.0e-3_wp)
        text = 'contacts ' // number_text_of(done)
        if (job%is_file) text = text // ' of ' // number_text_of(total)
        if (job%choice%is_shared .or. job%choice%is_part) text = text // ' of part ' &
            // value_of(work, 'part') // '/' // value_of(work, 'parts')
        text = text // ', ' // trim(number_text(rate)) // '/s'
        if (job%is_file) text = text // ', ' // time_text((total - done)/rate) // ' left'
        call set_progress(text)
    end subroutine tell

    !> A time in the unit that fits.
    function time_text(seconds) result(text)
        real(wp), intent(in) :: seconds
        character(len=:), allocatable :: text

        ! Given: seconds.
        real(wp), parameter :: minute = 60.0_wp, hour = 3600.0_wp

        if (seconds < 2.0_wp*minute) then
            text = integer_text(nint(seconds)) // ' s'
        else if (seconds < 2.0_wp*hour) then
            text = integer_text(nint(seconds/minute)) // ' min'
        else
            ! Given: an integer has no more.
            text = integer_text(nint(min(seconds/hour, 1.0e9_wp))) // ' h'
        end if
    end function time_text
end module faststrip_command_batch
