!> `faststrip merge`: the parts of a batch joined.
module faststrip_command_batch_merge
    use faststrip_base_status, only: status_t, first_error
    use faststrip_files_csv, only: csv_text_t
    use faststrip_command_program_console, only: fail, fail_on_error, exit_bad_input
    use faststrip_command_program_files, only: take_input, clear_leftovers
    use faststrip_command_batch_joined, only: joined_t, check_parts, put_parts
    use faststrip_command_batch_manifest, only: counted, number_text_of
    use faststrip_command_program_options, only: command_t, option_t, parse_command, given, &
                                                 option_text, any_number
    use faststrip_command_batch_store, only: store_t, take_store, open_store, finish_store, &
                                             manifest_path
    implicit none
    private

    public :: run_merge

contains

    !> Run the subcommand from the command line.
    subroutine run_merge()
        type(command_t) :: command
        type(csv_text_t), allocatable :: names(:)
        type(joined_t) :: joined
        type(store_t) :: store
        type(status_t) :: status
        integer :: i

        command%name = 'merge'
        command%usage = 'PART.csv...'
        command%about = &
            'Join what batch --part 1/K to K/K have written, in any order, to the bytes that one' &
            // new_line('a') // 'run would have written. Their manifests, PART.csv.manifest, must' &
            // ' lie beside them:' // new_line('a') // 'all parts must be there, whole, and of' &
            // ' one input with the same options by the' // new_line('a') // 'same program. The' &
            // ' exit code is 1 if a contact failed, as that of one run.' // new_line('a')
        command%options = [option_t('-o', 'FILE', 'write the CSV there (default stdout), NetCDF' &
                                    // new_line('a') // 'to FILE.nc', writes=.true.)]
        call parse_command(command, 1, any_number)
        allocate (names(size(command%arguments)))
        do i = 1, size(names)
            names(i)%text = command%arguments(i)%text
            call take_input(manifest_path(names(i)%text))
        end do
        if (given(command, '-o')) &
            call take_store(option_text(command, '-o', '-'), '-o', .false., .false.)
        call check_parts(names, joined, status)
        call fail_on_error(status)
        call open_store(store, option_text(command, '-o', '-'), .false., .false., status)
        call fail_on_error(status)
        call put_parts(joined, store, status)
        call fail_on_error(status)
        call finish_store(store, status)
        call fail_on_error(status)
        call clear_leftovers()
        if (counted(joined%counts, first_error) > 0) &
            call fail(exit_bad_input, number_text_of(counted(joined%counts, first_error)) &
                      // ' of ' // number_text_of(counted(joined%counts, 0)) // ' contacts failed')
    end subroutine run_merge
end module faststrip_command_batch_merge
