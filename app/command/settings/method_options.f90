!> Options of subcommands that are settings: their table, their help, what they set.
module faststrip_command_settings_method_options
    use faststrip_contact_methods, only: method_t, normal_table, tangential_table
    use faststrip_command_program_options, only: command_t, option_t, option_text, refuse_value, &
                                                 given
    use faststrip_command_settings_methods, only: settings_t, put_setting, settle_wanted
    use faststrip_command_settings_table, only: settings, value_t, of_group, read_value, &
                                                full_words, option_help, a_path, a_flag, no_fault
    implicit none
    private

    public :: setting_options, read_option, method_options, method_notes, take_method_options

    character(len=*), parameter :: newline = new_line('a')

contains

    !> The options of a group of settings, for the table of a subcommand.
    function setting_options(group) result(options)
        character(len=*), intent(in) :: group        !! of the case file
        type(option_t), allocatable :: options(:)

        integer, allocatable :: rows(:)
        integer :: i

        rows = of_group(group)
        rows = pack(rows, settings(rows)%option /= '')
        allocate (options(size(rows)))
        do i = 1, size(rows)
            associate (setting => settings(rows(i)))
                options(i)%name = setting%option
                options(i)%value_name = setting%value_name
                options(i)%help = option_help(setting)
                options(i)%reads = setting%kind == a_path
            end associate
        end do
    end function setting_options

    !> The value of an option that is a setting; a usage error if the table does not allow it.
    subroutine read_option(command, row, value)
        type(command_t), intent(in) :: command !! parsed
        integer, intent(in) :: row             !! of the table of settings
        type(value_t), intent(out) :: value    !! not given if the option is not

        integer :: fault

        associate (setting => settings(row))
            if (.not. given(command, trim(setting%option))) return
            if (setting%kind == a_flag) then
                value%is_given = .true.
                value%flag = .true.
                return
            end if
            call read_value(setting, option_text(command, trim(setting%option), ''), value, fault)
            if (fault /= no_fault) &
                call refuse_value(command, trim(setting%option), trim(full_words(setting)))
        end associate
    end subroutine read_option

    !> For the table of a subcommand that solves contacts; `method_notes` explain the names.
    function method_options() result(options)
        type(option_t), allocatable :: options(:)

        options = setting_options('numerics')
    end function method_options

    !> The names of the methods and what they are, one a line.
    function method_notes() result(text)
        character(len=:), allocatable :: text !! lines

        text = newline // 'normal methods:' // newline // lines(normal_table) // newline &
               // 'tangential methods:' // newline // lines(tangential_table)
    end function method_notes

    function lines(table) result(text)
        type(method_t), intent(in) :: table(:)
        character(len=:), allocatable :: text

        integer :: i

        text = ''
        do i = 1, size(table)
            text = text // '  ' // table(i)%name // trim(table(i)%help)
            if (.not. table(i)%gives_elements) text = text // '; no elements'
            text = text // newline
        end do
    end function lines

    !> Let the options that were given replace what was chosen before; a usage error if one is
    !> out of range.
    subroutine take_method_options(command, case)
        type(command_t), intent(in) :: command   !! parsed, with `method_options` in its table
        class(settings_t), intent(inout) :: case !! defaults or those of a case file

        type(value_t) :: value
        integer, allocatable :: rows(:)
        integer :: i

        rows = of_group('numerics')
        do i = 1, size(rows)
            if (settings(rows(i))%option == '') cycle
            call read_option(command, rows(i), value)
            if (value%is_given) call put_setting(case, trim(settings(rows(i))%key), value)
        end do
        call settle_wanted(case)
    end subroutine take_method_options
end module faststrip_command_settings_method_options
