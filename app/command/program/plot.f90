!> Pictures of results: what the program writes is drawn by a script that is installed with it.
module faststrip_command_program_plot
    use, intrinsic :: iso_c_binding, only: c_null_char
    use faststrip_base_status, only: status_t
    use faststrip_base_text, only: lower_case
    use faststrip_files_csv, only: csv_writer_t, open_csv, put_text
    use faststrip_command_program_console, only: fail, fail_on_error, usage_error, exit_bad_input, &
                                                 end_table
    use faststrip_command_program_options, only: command_t, option_t, given, option_text
    use faststrip_command_program_system, only: file_kind, kind_file, program_folder, run_program, &
                                                new_folder, remove_folder, keep_in_mind, &
                                                forget_file, set_progress
    implicit none
    private

    public :: plot_option, prepare_plot, keep_for_plot, plot_file, draw_plot

    !> The option of the subcommands that draw.
    type(option_t), parameter :: plot_option = option_t('--plot', 'FILE', 'draw the result there:' &
        // ' .png, .svg, .pdf;' // new_line('a') // 'needs python3 with matplotlib and numpy', &
        writes=.true.)

    character(len=*), parameter :: endings(3) = ['.png', '.svg', '.pdf']
    character(len=*), parameter :: script = 'plot.py'

    ! Where scripts are, who runs them, and where the files are that they draw from, once there are.
    character(len=:), allocatable :: script_path, python, folder

    !> A file that is drawn from.
    type :: kept_t
        character(len=:), allocatable :: path
    end type kept_t

    type(kept_t), allocatable :: kept(:)

contains

    !> Look, before anything is solved, whether what was asked for can be drawn.
    subroutine prepare_plot(command)
        type(command_t), intent(in) :: command !! with `plot_option`

        character(len=:), allocatable :: path, own

        if (.not. given(command, '--plot')) return
        path = option_text(command, '--plot', '')
        if (len(path) <= len(endings) .or. &
            all(endings /= lower_case(path(max(len(path) - 3, 1):)))) &
            call usage_error('--plot must end with .png, .svg or .pdf, got ' // path, command%name)
        own = program_folder()
        script_path = own // '/../share/faststrip/plots/' // script
        python = 'python3'
        if (file_kind(script_path) /= kind_file) then
            script_path = own // '/../plots/' // script
            if (file_kind(own // '/../.venv/bin/python') == kind_file) &
                python = own // '/../.venv/bin/python'
        end if
        if (file_kind(script_path) /= kind_file) &
            call fail(exit_bad_input, '--plot needs the scripts installed with the program, got ' &
                      // 'none in ' // own // '/../share/faststrip/plots')
        if (run_python('-c' // c_null_char // 'import matplotlib, numpy' // c_null_char, 2, &
                       .true.) /= 0) &
            call fail(exit_bad_input, '--plot needs python3 with matplotlib and numpy: install ' &
                      // 'them, as by: apt install python3-matplotlib, or pip install matplotlib')
    end subroutine prepare_plot

    !> Name of a file that is drawn from.
    function plot_file(name) result(path)
        character(len=*), intent(in) :: name !! as the script knows it
        character(len=:), allocatable :: path

        type(kept_t), allocatable :: longer(:)

        if (.not. allocated(folder)) then
            folder = new_folder()
            if (len(folder) == 0) call fail(exit_bad_input, '--plot needs a folder for its files ' &
                                            // 'in TMPDIR or /tmp, and none can be made there')
            allocate (kept(0))
        end if
        path = folder // '/' // name
        call keep_in_mind(path)
        allocate (longer(size(kept) + 1))
        longer(:size(kept)) = kept
        longer(size(longer))%path = path
        call move_alloc(longer, kept)
    end function plot_file

    !> Write a table that is drawn from.
    subroutine keep_for_plot(name, text)
        character(len=*), intent(in) :: name !! of the file, as the script knows it
        character(len=*), intent(in) :: text !! all of it

        type(csv_writer_t) :: writer
        type(status_t) :: status

        call open_csv(writer, plot_file(name), status)
        call fail_on_error(status)
        call put_text(writer, text)
        call end_table(writer)
    end subroutine keep_for_plot

    !> Draw, if that was asked for; ends the program if it cannot be.
    subroutine draw_plot(command)
        type(command_t), intent(in) :: command !! with `plot_option`

        character(len=:), allocatable :: path
        integer :: i, code

        if (.not. given(command, '--plot')) return
        path = option_text(command, '--plot', '')
        call set_progress(command%name // ': drawing ' // path)
        code = run_python(script_path // c_null_char // command%name // c_null_char // folder &
                          // c_null_char // path // c_null_char, 4, .false.)
        do i = 1, size(kept)
            call forget_file(kept(i)%path)
        end do
        call remove_folder(folder)
        if (code /= 0) call fail(exit_bad_input, '--plot: nothing was drawn: ' // path)
    end subroutine draw_plot

    ! The exit code of Python with some words, each with its closing zero.
    integer function run_python(words, n, is_quiet)
        character(len=*), intent(in) :: words
        integer, intent(in) :: n         ! of words
        logical, intent(in) :: is_quiet

        run_python = run_program(python // c_null_char // words, n + 1, is_quiet)
    end function run_python
end module faststrip_command_program_plot
