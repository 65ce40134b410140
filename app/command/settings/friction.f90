!> Variable friction, of case files and of rows of a batch.
module faststrip_command_settings_friction
    use faststrip_base_friction, only: friction_t, friction_constant, friction_kind
    use faststrip_base_friction_table, only: make_friction_table, over_contact, over_rail, &
                                             over_angle
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, number_text, &
                                     st_bad_argument, st_file_format
    use faststrip_base_text, only: integer_text
    use faststrip_files_csv, only: csv_table_t, column_index, cell_text
    use faststrip_command_settings_group, only: case_text_t, group_t, read_group, is_set, &
                                                given_value, number_of, refuse, refuse_each
    use faststrip_command_settings_table, only: row_friction, setting_t, value_t, read_value, &
                                                kind_words, &
                                                range_words, no_fault, wrong_kind
    implicit none
    private

    public :: read_friction_group, read_row_friction, read_row_values, friction_columns

    !> The columns that a table may have for it.
    character(len=*), parameter :: friction_columns(10) = [character(len=20) :: &
        'friction_kind', row_friction(2:)%key]
    ! Given: of `friction_columns`.
    integer, parameter :: at_kind = 1, at_kinetic = 2, at_half = 3, at_slope = 4, at_speed = 5, &
                          at_mu_hot = 6, at_cold = 7, at_hot = 8, at_y = 9, at_table = 10

contains

    !> Read the group of a case file, if there is one.
    subroutine read_friction_group(content, mu, from_profiles, law)
        type(case_text_t), intent(in) :: content !! a case file
        real(wp), intent(inout) :: mu
            !! of `&material`, checked; where that has none the largest of the table
        logical, intent(in) :: from_profiles     !! is there a contact angle?
        type(friction_t), intent(inout) :: law   !! has the speed of `&motion`, 0 if not given

        type(group_t) :: group, material
        type(value_t) :: values(at_hot)
        character(len=:), allocatable :: what
        real(wp) :: mu_flange
        integer :: at

        call read_group(content, 'friction', group)
        call read_group(content, 'material', material)
        call read_table(group, from_profiles, law)
        if (.not. is_set(material, 'mu')) then
            if (law%table%n == 0) call refuse(material, 'mu', 'must be given, or &friction ' // &
                                              'mu_table', '')
            call refuse_each(group, [character(len=10) :: 'mu_kinetic', 'mu_hot'], &
                             'must not be given without &material mu')
            mu = maxval(law%table%mu)
        end if
        do at = 1, at_hot
            if (at /= at_speed) values(at) = given_value(group, trim(row_friction(at)%key))
        end do
        call set_falling(values(:at_slope), mu, [character(len=60) :: &
            'must not be given with kind constant', 'must be given', &
            'must be at most &material mu, the static value', &
            'must be constant without &motion speed_mm_s'], law, at, what)
        if (at == at_speed) at = at_kind
        if (at > 0) call refuse_value()
        call set_hot(values(at_mu_hot:at_hot), mu, [character(len=60) :: &
            'must not be given without mu_hot', 'must be given with mu_hot', &
            'must be at most &material mu, the cold value', &
            'must not be given without &motion speed_mm_s'], law, at, what)
        if (at > 0) call refuse_value()
        if (.not. is_set(group, 'mu_flange')) then
            call refuse_each(group, [character(len=20) :: 'tread_angle_rad', 'flange_angle_rad'], &
                             'must not be given without mu_flange')
            return
        end if
        mu_flange = number_of(group, 'mu_flange', 0.0_wp)
        if (.not. from_profiles) call refuse(group, 'mu_flange', 'must not be given with a gap ' &
                                             // 'file, which has no contact angle', &
                                             number_text(mu_flange))
        if (mu <= 0.0_wp) call refuse(group, 'mu_flange', 'must not be given with &material mu 0', &
                                      number_text(mu_flange))
        call need('tread_angle_rad')
        call need('flange_angle_rad')
        law%flange_share = mu_flange/mu
        law%tread_angle = number_of(group, 'tread_angle_rad', 0.0_wp)
        law%flange_angle = number_of(group, 'flange_angle_rad', 0.0_wp)
        if (law%flange_angle <= law%tread_angle) &
            call refuse(group, 'flange_angle_rad', 'must be above tread_angle_rad', &
                        number_text(law%flange_angle))

    contains

        subroutine refuse_value()
            associate (key => trim(row_friction(at)%key))
                if (values(at)%is_given) call refuse(group, key, what, values(at)%text)
                call refuse(group, key, what, '')
            end associate
        end subroutine refuse_value

        subroutine need(key)
            character(len=*), intent(in) :: key

            if (.not. is_set(group, key)) &
                call refuse(group, key, 'must be given with mu_flange', '')
        end subroutine need
    end subroutine read_friction_group

    !> The table of a case file, if there is one.
    subroutine read_table(group, from_profiles, law)
        type(group_t), intent(in) :: group
        logical, intent(in) :: from_profiles
        type(friction_t), intent(inout) :: law

        type(value_t) :: at, mu
        character(len=12) :: key
        character(len=:), allocatable :: what
        logical :: is_wrong_at
        integer :: over

        key = 'mu_y_mm'
        over = merge(over_rail, over_contact, from_profiles)
        if (is_set(group, 'mu_angle_rad')) then
            if (is_set(group, key)) call refuse(group, trim(key), 'must not be given with ' &
                                                // 'mu_angle_rad', '')
            key = 'mu_angle_rad'
            over = over_angle
            if (.not. from_profiles) call refuse(group, key, 'must not be given with a gap file, ' &
                                                 // 'which has no contact angle', '')
        end if
        at = given_value(group, key)
        mu = given_value(group, 'mu_table')
        if (mu%is_given .and. is_set(group, 'mu_flange')) &
            call refuse(group, 'mu_table', 'must not be given with mu_flange', '')
        call set_table(at, mu, over, law, what, is_wrong_at)
        if (len(what) == 0) return
        if (.not. is_wrong_at) key = 'mu_table'
        call refuse(group, trim(key), what, '')
    end subroutine read_table

    !> The table of a case file or a row.
    subroutine set_table(at, mu, over, law, what, is_wrong_at)
        type(value_t), intent(in) :: at, mu    ! each in its range, if it is given
        integer, intent(in) :: over            ! what the places are
        type(friction_t), intent(inout) :: law ! gets it
        character(len=:), allocatable, intent(out) :: what ! is wrong; empty: nothing
        logical, intent(out) :: is_wrong_at    ! with the places? or with the coefficients

        type(status_t) :: status

        what = ''
        is_wrong_at = mu%is_given
        if (.not. (at%is_given .or. mu%is_given)) return
        if (.not. at%is_given) then
            what = 'must be given with mu_table'
        else if (.not. mu%is_given) then
            what = 'must be given with places of it'
        else if (size(at%list) /= size(mu%list)) then
            what = 'must have as many numbers as mu_table, ' // integer_text(size(mu%list))
        else if (any(at%list(2:) <= at%list(:size(at%list) - 1))) then
            what = 'must increase'
        else
            call make_friction_table(over, at%list, mu%list, law%table, status)
            if (is_error(status)) what = trim(status%message)
        end if
    end subroutine set_table

    !> The friction of a row; an empty cell, or a column that is not there, is not given.
    subroutine read_row_friction(table, row, mu, law, status)
        type(csv_table_t), intent(in) :: table !! a table that was read
        integer, intent(in) :: row             !! of it
        real(wp), intent(in) :: mu             !! the static value
        type(friction_t), intent(inout) :: law !! gets what is given
        type(status_t), intent(out) :: status  !! `st_bad_argument`, `st_file_format`

        type(value_t) :: values(at_table)
        character(len=:), allocatable :: text, what
        integer :: at
        logical :: is_wrong_at

        call read_row_values(table, row, friction_columns, row_friction, values, status)
        if (is_error(status)) return
        if (values(at_speed)%is_given) law%speed = values(at_speed)%number
        call set_falling(values(:at_slope), mu, [character(len=60) :: &
            'must be empty with constant friction', 'must be given with falling friction', &
            'must be at most mu, the static value', 'must be given with falling friction'], law, &
            at, what)
        if (at == 0) call set_hot(values(at_mu_hot:at_hot), mu, [character(len=60) :: &
            'must be empty without mu_hot', 'must be given with mu_hot', &
            'must be at most mu, the cold value', 'must be empty without speed_mm_s'], law, at, &
            what)
        if (at == 0) then
            call set_table(values(at_y), values(at_table), over_contact, law, what, is_wrong_at)
            if (len(what) == 0) return
            at = merge(at_y, at_table, is_wrong_at)
        end if
        text = ''
        if (values(at)%is_given) text = values(at)%text
        call set_status(status, st_bad_argument, trim(friction_columns(at)) // ' ' // what // &
                        ", got '" // text // "'")
    end subroutine read_row_friction

    !> Some cells of a row; an empty one, or one of a column that is not there, is not given.
    subroutine read_row_values(table, row, columns, settings, values, status)
        type(csv_table_t), intent(in) :: table      !! a table that was read
        integer, intent(in) :: row                  !! of it
        character(len=*), intent(in) :: columns(:)  !! their names
        type(setting_t), intent(in) :: settings(:)  !! what they may be
        type(value_t), intent(inout) :: values(:)   !! what they are
        type(status_t), intent(out) :: status       !! `st_bad_argument`, `st_file_format`

        character(len=:), allocatable :: text
        integer :: at, fault

        call clear_status(status)
        do at = 1, size(columns)
            text = cell_text(table, row, column_index(table, trim(columns(at))))
            if (len(text) == 0) cycle
            call read_value(settings(at), text, values(at), fault)
            if (fault == no_fault) cycle
            if (fault == wrong_kind) then
                call refuse_cell(st_file_format, kind_words(settings(at)))
            else
                call refuse_cell(st_bad_argument, range_words(settings(at), values(at)%number))
            end if
            return
        end do

    contains

        subroutine refuse_cell(code, words)
            integer, intent(in) :: code
            character(len=*), intent(in) :: words

            call set_status(status, code, trim(columns(at)) // ' must be ' // trim(words) // &
                            ", got '" // text // "'")
        end subroutine refuse_cell
    end subroutine read_row_values

    !> What falls with slip speed.
    subroutine set_falling(values, mu, words, law, at, what)
        type(value_t), intent(in) :: values(at_slope) ! each in its range
        real(wp), intent(in) :: mu                    ! the static value
        character(len=*), intent(in) :: words(4)      ! not wanted, missing, too large, no speed
        type(friction_t), intent(inout) :: law        ! has the speed, 0 if it is not known
        integer, intent(out) :: at                    ! what is wrong; 0: nothing is
        character(len=:), allocatable, intent(out) :: what ! of `words`

        at = 0
        what = ''
        if (values(at_kind)%is_given) law%kind = friction_kind(values(at_kind)%text)
        if (values(at_slope)%is_given) law%slope_factor = values(at_slope)%number
        if (law%kind == friction_constant) then
            call blame(at_kinetic, values(at_kinetic)%is_given, words(1))
            call blame(at_half, values(at_half)%is_given, words(1))
            return
        end if
        call blame(at_kinetic, .not. values(at_kinetic)%is_given, words(2))
        call blame(at_half, .not. values(at_half)%is_given, words(2))
        call blame(at_kinetic, values(at_kinetic)%number > mu, words(3))
        call blame(at_speed, law%speed <= 0.0_wp, words(4))
        if (at > 0) return
        law%kinetic_share = values(at_kinetic)%number/mu
        law%half_slip_speed = values(at_half)%number

    contains

        subroutine blame(i, is_wrong, word)
            integer, intent(in) :: i
            logical, intent(in) :: is_wrong
            character(len=*), intent(in) :: word

            call blame_first(i, is_wrong, word, at, what)
        end subroutine blame
    end subroutine set_falling

    !> What falls with temperature.
    subroutine set_hot(values, mu, words, law, at, what)
        type(value_t), intent(in) :: values(at_mu_hot:at_hot) ! each in its range
        real(wp), intent(in) :: mu                      ! the cold value
        character(len=*), intent(in) :: words(4)        ! not wanted, missing, too large, no speed
        type(friction_t), intent(inout) :: law          ! has the speed, 0 if it is not known
        integer, intent(out) :: at                      ! what is wrong; 0: nothing is
        character(len=:), allocatable, intent(out) :: what ! of `words`, or more

        at = 0
        what = ''
        associate (is_hot => values(at_mu_hot)%is_given, value => values(at_mu_hot)%number, &
                   cold => values(at_cold), hot => values(at_hot))
            call blame_first(at_cold, cold%is_given .neqv. is_hot, &
                             merge(words(2), words(1), is_hot), at, what)
            call blame_first(at_hot, hot%is_given .neqv. is_hot, &
                             merge(words(2), words(1), is_hot), at, what)
            call blame_first(at_mu_hot, is_hot .and. value > mu, words(3), at, what)
            call blame_first(at_mu_hot, is_hot .and. law%speed <= 0.0_wp, words(4), at, what)
            call blame_first(at_hot, is_hot .and. hot%number <= cold%number, &
                             'must be above cold_temperature_C', at, what)
            if (at > 0 .or. .not. is_hot) return
            law%hot_share = value/mu
            law%cold_temperature = cold%number
            law%hot_temperature = hot%number
        end associate
    end subroutine set_hot

    !> Note what is wrong, if nothing was before.
    subroutine blame_first(i, is_wrong, word, at, what)
        integer, intent(in) :: i
        logical, intent(in) :: is_wrong
        character(len=*), intent(in) :: word
        integer, intent(inout) :: at
        character(len=:), allocatable, intent(inout) :: what

        if (.not. is_wrong .or. at > 0) return
        at = i
        what = trim(word)
    end subroutine blame_first
end module faststrip_command_settings_friction
