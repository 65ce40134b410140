!> Runs the tests that the translator found, counts them and says what failed.
module funit_runner
    use, intrinsic :: iso_fortran_env, only: output_unit
    use funit, only: clearAll, exception_text, getNumExceptions
    implicit none
    private

    public :: start_run, start_module, is_wanted, end_test, skip_test, end_module, end_run

    character(len=:), allocatable, save :: filter, left_out, claims, module_name
    logical, save :: is_ours = .true. ! does this process run the module?
    integer, save :: passed = 0, failed = 0, skipped = 0
    integer, save :: module_passed = 0, module_failed = 0, module_skipped = 0

contains

    !> Take from the command line the filter, a part of `room/module::test`; modules to be left out,
    !> `room/module,room/module`; and a folder that several processes share the modules by: the one
    !> that makes a module's file there runs it.
    subroutine start_run()
        filter = argument(1)
        left_out = ',' // argument(2) // ','
        claims = argument(3)
    end subroutine start_run

    function argument(i) result(text)
        integer, intent(in) :: i !! 1 for the first
        character(len=:), allocatable :: text

        integer :: length

        call get_command_argument(i, length=length)
        allocate (character(len=length) :: text)
        if (length > 0) call get_command_argument(i, text)
    end function argument

    subroutine start_module(name)
        character(len=*), intent(in) :: name !! `room/module`

        module_name = name
        is_ours = is_claimed(name)
        module_passed = 0
        module_failed = 0
        module_skipped = 0
    end subroutine start_module

    logical function is_wanted(name)
        character(len=*), intent(in) :: name !! of the test

        is_wanted = is_ours .and. index(module_name // '::' // name, filter) > 0 &
                    .and. index(left_out, ',' // module_name // ',') == 0
    end function is_wanted

    !> Is this process the first that comes to a module?
    logical function is_claimed(name)
        character(len=*), intent(in) :: name !! `room/module`

        character(len=len(name)) :: file
        integer :: unit, code, i

        is_claimed = len(claims) == 0
        if (is_claimed) return
        file = name
        do i = 1, len(file)
            if (file(i:i) == '/') file(i:i) = '_'
        end do
        open (newunit=unit, file=claims // '/' // file, status='new', iostat=code)
        is_claimed = code == 0
        if (is_claimed) close (unit)
    end function is_claimed

    !> Count a test that ran; tell its failures and forget them.
    subroutine end_test(name)
        character(len=*), intent(in) :: name

        integer :: i

        if (getNumExceptions() == 0) then
            module_passed = module_passed + 1
            return
        end if
        module_failed = module_failed + 1
        write (output_unit, '(a)') 'FAILED ' // module_name // '::' // name
        do i = 1, getNumExceptions()
            write (output_unit, '(a)') '    ' // exception_text(i)
        end do
        flush (output_unit)
        call clearAll()
    end subroutine end_test

    subroutine skip_test(name)
        character(len=*), intent(in) :: name

        module_skipped = module_skipped + 1
        write (output_unit, '(a)') 'skipped ' // module_name // '::' // name // ': disabled there'
    end subroutine skip_test

    subroutine end_module()
        if (module_passed + module_failed + module_skipped > 0) then
            call tell(module_name, module_passed, module_failed, module_skipped)
        end if
        passed = passed + module_passed
        failed = failed + module_failed
        skipped = skipped + module_skipped
    end subroutine end_module

    !> Say how many passed and failed; end in error if any failed or none ran.
    subroutine end_run()
        call tell('all modules together:', passed, failed, skipped)
        if (failed > 0) error stop 1
        ! Of several processes one may have come too late for any.
        if (passed == 0 .and. len(claims) == 0) then
            write (output_unit, '(a)') 'no test ran'
            flush (output_unit)
            error stop 1
        end if
    end subroutine end_run

    subroutine tell(name, n_passed, n_failed, n_skipped)
        character(len=*), intent(in) :: name
        integer, intent(in) :: n_passed, n_failed, n_skipped

        character(len=max(len(name) + 1, 44)) :: label

        label = name
        write (output_unit, '(a, i0, a, i0, a)', advance='no') label, &
            n_passed, ' passed, ', n_failed, ' failed'
        if (n_skipped > 0) write (output_unit, '(a, i0, a)', advance='no') ', ', n_skipped, &
            ' skipped'
        write (output_unit, '()')
        flush (output_unit)
    end subroutine tell
end module funit_runner
