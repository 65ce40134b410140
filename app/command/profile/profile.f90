!> `faststrip profile`: reads profiles of every format, describes, cleans, draws and converts them.
module faststrip_command_profile
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, set_status, is_error, st_bad_argument
    use faststrip_base_text, only: integer_text
    use faststrip_files_csv, only: csv_text_t, csv_writer_t, put_comment
    use faststrip_files_profile, only: read_profile, profile_formats, profile_options_t, &
                                       profile_file_t, body_wheel, body_rail
    use faststrip_files_profile_writer, only: write_profile, check_profile_name
    use faststrip_geometry_wear, only: wear_depths, align_by_field_side, measure_rail_wear
    use faststrip_command_program_console, only: fail, fail_on_error, note, usage_error, &
                                                 version_text, printable, exit_bad_input, &
                                                 begin_table, end_table
    use faststrip_command_program_options, only: command_t, option_t, parse_command, given, &
                                                 option_text, option_word, any_number
    use faststrip_command_settings_method_options, only: setting_options, read_option
    use faststrip_command_settings_profiles, only: put_reading
    use faststrip_command_settings_table, only: settings, value_t, of_group
    use faststrip_files_profile_standard, only: standard_profile
    use faststrip_files_profile_cleaning, only: cleaning_t
    use faststrip_files_profile_taken, only: take_profile
    use faststrip_command_profile_cleaning, only: cleaning_options, take_cleaning
    use faststrip_command_profile_measures, only: measures_t, measure_profile, &
                                                  put_measures_header, put_measures
    use faststrip_command_profile_picture, only: draw_profile, nominal_t
    implicit none
    private

    public :: run_profile

contains

    !> Run the subcommand from the command line.
    subroutine run_profile()
        type(command_t) :: command
        type(profile_options_t) :: options
        type(cleaning_t) :: cleaning
        type(measures_t), allocatable :: measures(:)
        type(nominal_t) :: nominal
        character, parameter :: newline = new_line('a')
        integer :: i, n, n_failed

        command%name = 'profile'
        command%usage = 'FILE...'
        command%about = 'Read wheel and rail profiles: two-column text, CSV and files of' &
                        // newline
        do i = 1, size(profile_formats)
            command%about = command%about // '  ' // profile_formats(i)%name
            do n = 1, size(profile_formats(i)%endings)
                command%about = command%about // ' ' // trim(profile_formats(i)%endings(n))
            end do
            command%about = trim(command%about) // newline
        end do
        command%about = command%about // &
            'and standard ones by their names: s1002, cone20, cone40, uic60, 60e1, 54e1;' // &
            newline // 'a file of such a name is ./uic60.' // &
            newline // 'Rows of a CSV describe them: y to the field side, z down, mm. Nothing ' // &
            'is repaired' // newline // 'by default; options are applied in the order below.' // &
            newline
        command%options = [ &
            option_t('-o', 'FILE', 'write the profile there: .csv, .prw or .prr', writes=.true.), &
            option_t('--table', 'FILE', 'write the CSV of descriptions there (default stdout)', &
                     writes=.true.), &
            option_t('--draw', 'FILE.svg', 'draw the profile there', writes=.true.), &
            option_t('--nominal', 'NAME', 'wear against a standard profile or a file'), &
            option_t('--align', 'HOW', 'lay a rail on the nominal one: field (default), none'), &
            option_t('--kind', 'KIND', 'wheel or rail, where the file does not say'), &
            setting_options('wheel'), cleaning_options]
        call parse_command(command, 1, any_number)
        call take_reading(command, options)
        call take_cleaning(command, cleaning)
        n = size(command%arguments)
        if (n > 1 .and. given(command, '-o')) &
            call usage_error('-o takes one profile, got ' // integer_text(n), command%name)
        if (n > 1 .and. given(command, '--draw')) &
            call usage_error('--draw takes one profile, got ' // integer_text(n), command%name)
        allocate (measures(n))
        n_failed = 0
        do i = 1, n
            call describe(command%arguments(i)%text, options, cleaning, measures(i))
            if (given(command, '--nominal') .and. .not. is_error(measures(i)%status)) &
                call compare(command, measures(i), nominal)
            if (is_error(measures(i)%status)) then
                n_failed = n_failed + 1
                call note(trim(measures(i)%status%message))
                cycle
            end if
            if (n == 1 .and. measures(i)%points%kind == 0) &
                call note(measures(i)%path // ': wheel or rail is not known, and so how it lies ' &
                          // 'was not checked; --kind says it')
            if (len(measures(i)%words) > 0) &
                call note(measures(i)%path // ': ' // measures(i)%words)
        end do
        call write_table(option_text(command, '--table', '-'), measures)
        if (n_failed == 0 .and. given(command, '-o')) &
            call write_points(option_text(command, '-o', ''), measures(1))
        if (n_failed == 0 .and. given(command, '--draw')) &
            call draw(option_text(command, '--draw', ''), measures(1), nominal)
        if (n > 1 .and. n_failed > 0) call fail(exit_bad_input, integer_text(n_failed) // ' of ' &
                                                // integer_text(n) // ' profiles failed')
        if (n_failed > 0) stop exit_bad_input, quiet=.true.
    end subroutine run_profile

    !> What the options say about how a file is to be read.
    subroutine take_reading(command, options)
        type(command_t), intent(in) :: command
        type(profile_options_t), intent(out) :: options

        type(value_t) :: value
        integer, allocatable :: rows(:)
        integer :: i

        select case (option_word(command, '--kind', '', [character(len=5) :: 'wheel', 'rail']))
        case ('wheel'); options%kind = body_wheel
        case ('rail'); options%kind = body_rail
        end select
        rows = of_group('wheel')
        do i = 1, size(rows)
            if (settings(rows(i))%option == '') cycle
            call read_option(command, rows(i), value)
            call put_reading(options, trim(settings(rows(i))%key), value)
        end do
    end subroutine take_reading

    !> Take one file and measure it.
    subroutine describe(path, options, cleaning, measures)
        character(len=*), intent(in) :: path
        type(profile_options_t), intent(in) :: options
        type(cleaning_t), intent(in) :: cleaning
        type(measures_t), intent(out) :: measures

        measures%path = path
        call take_profile(path, options, cleaning, measures%taken_profile_t, measures%status)
        if (.not. is_error(measures%status)) call measure_profile(cleaning%kink_angle, measures)
    end subroutine describe

    !> Wear against a nominal profile.
    subroutine compare(command, measures, nominal)
        type(command_t), intent(in) :: command
        type(measures_t), intent(inout) :: measures
        type(nominal_t), intent(out) :: nominal

        real(wp), allocatable :: y(:), z(:)
        real(wp) :: motion(3)
        character(len=:), allocatable :: how

        how = option_word(command, '--align', 'field', [character(len=5) :: 'field', 'none'])
        if (measures%points%kind == 0) then
            call set_status(measures%status, st_bad_argument, 'the kind of a profile must be ' // &
                            'known for --nominal (--kind says it) (' // measures%path // ')')
            return
        end if
        call take_nominal(option_text(command, '--nominal', ''), measures%points%kind, nominal)
        y = measures%points%y
        z = measures%points%z
        motion = 0.0_wp
        if (measures%points%kind == body_rail .and. how == 'field') then
            call align_by_field_side(nominal%y, nominal%z, y, z, motion, measures%status)
            if (is_error(measures%status)) then
                measures%status%message = trim(measures%status%message) // ' (' // measures%path &
                                          // ')'
                return
            end if
        end if
        allocate (nominal%depth(size(nominal%y)), source=0.0_wp)
        allocate (nominal%is_known(size(nominal%y)), source=.false.)
        call wear_depths(nominal%y, nominal%z, y, z, &
                         merge(1.0_wp, -1.0_wp, measures%points%kind == body_rail), &
                         nominal%depth, nominal%is_known)
        measures%has_wear = any(nominal%is_known)
        if (measures%has_wear) &
            measures%largest_wear = maxval(nominal%depth, mask=nominal%is_known)
        if (measures%points%kind == body_rail) &
            call measure_rail_wear(nominal%y, nominal%z, y, z, measures%wear)
        ! For the picture the nominal profile goes to the measured one, which stays as it is.
        call move_back(motion, nominal%y, nominal%z)
        nominal%is_given = .true.
    end subroutine compare

    !> The motion undone: first the shift, then the turn.
    pure subroutine move_back(motion, y, z)
        real(wp), intent(in) :: motion(3)
        real(wp), intent(inout) :: y(:), z(:)

        real(wp) :: before(size(y))

        before = y - motion(1)
        z = z - motion(2)
        y = before*cos(motion(3)) + z*sin(motion(3))
        z = -before*sin(motion(3)) + z*cos(motion(3))
    end subroutine move_back

    !> The points of a nominal profile: a standard one by its name, or a file.
    subroutine take_nominal(name, kind, nominal)
        character(len=*), intent(in) :: name
        integer, intent(in) :: kind
        type(nominal_t), intent(out) :: nominal

        type(profile_options_t) :: options
        type(profile_file_t) :: points
        type(status_t) :: status
        logical :: is_standard

        call standard_profile(name, points, is_standard)
        if (.not. (is_standard .and. points%kind == kind)) then
            options%kind = kind
            call read_profile(name, options, points, status)
            call fail_on_error(status, '--nominal takes a standard profile or a file')
        end if
        nominal%y = points%y
        nominal%z = points%z
    end subroutine take_nominal

    subroutine write_table(path, measures)
        character(len=*), intent(in) :: path
        type(measures_t), intent(in) :: measures(:)

        type(csv_writer_t) :: writer
        integer :: i

        call begin_table(writer, path)
        do i = 1, size(measures)
            if (len(measures(i)%words) > 0) &
                call put_comment(writer, printable(measures(i)%path // ': ' // measures(i)%words))
        end do
        call put_measures_header(writer)
        do i = 1, size(measures)
            call put_measures(writer, measures(i))
        end do
        call end_table(writer)
    end subroutine write_table

    subroutine write_points(path, measures)
        character(len=*), intent(in) :: path
        type(measures_t), intent(in) :: measures

        type(csv_text_t) :: comments(4)
        type(status_t) :: status

        comments(1)%text = version_text()
        comments(2)%text = printable('from ' // measures%path // ' (' // &
                                     trim(measures%points%format) // ')')
        comments(3)%text = 'y to the field side, z down, mm'
        comments(4)%text = printable(measures%words)
        call check_profile_name(path, measures%points%kind, status)
        if (is_error(status)) call usage_error(trim(status%message), 'profile')
        call write_profile(path, measures%points%y, measures%points%z, measures%points%kind, &
                           comments(:merge(4, 3, len(measures%words) > 0)), status)
        call fail_on_error(status)
    end subroutine write_points

    subroutine draw(path, measures, nominal)
        character(len=*), intent(in) :: path
        type(measures_t), intent(in) :: measures
        type(nominal_t), intent(in) :: nominal

        type(status_t) :: status

        call draw_profile(path, measures, nominal, status)
        call fail_on_error(status)
    end subroutine draw
end module faststrip_command_profile
