!> What the values of a case file must be; ends the program with one line at one that is not.
module faststrip_command_settings_case_values
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_value, ieee_quiet_nan
    use faststrip_base_kinds, only: wp
    use faststrip_base_plausible, only: likely_mistake, of_poisson_ratio
    use faststrip_base_status, only: number_text
    use faststrip_base_text, only: integer_text
    use faststrip_command_settings_namelist, only: namelist_file_t, group_t, refuse
    implicit none
    private

    public :: unset, need_finite, need_positive, need_poisson
    public :: not_given, take_list, need_as_many, case_groups

    !> What stands in a list where the file gives no number.
    real(wp), parameter :: not_given = -huge(1.0_wp)

    !> The groups of a case file.
    character(len=*), parameter :: case_groups(*) = [character(len=8) :: &
        'contact', 'material', 'wheel', 'rail', 'motion', 'friction', 'numerics', 'sweep']

contains

    !> What a number is before the file sets it.
    pure real(wp) function unset()
        unset = ieee_value(unset, ieee_quiet_nan)
    end function unset

    !> It must be there, and a finite number.
    subroutine need_finite(content, group, name, value)
        type(namelist_file_t), intent(in) :: content !! a case file
        type(group_t), intent(in) :: group           !! a group of it
        character(len=*), intent(in) :: name         !! name in the group
        real(wp), intent(in) :: value                !! what the group gave it

        if (.not. ieee_is_finite(value)) &
            call refuse(content, group, name, 'must be given, a finite number', &
                        number_text(value))
    end subroutine need_finite

    !> It must be above 0.
    subroutine need_positive(content, group, name, value)
        type(namelist_file_t), intent(in) :: content !! a case file
        type(group_t), intent(in) :: group           !! a group of it
        character(len=*), intent(in) :: name         !! name in the group
        real(wp), intent(in) :: value                !! what the group gave it

        call need_finite(content, group, name, value)
        if (value <= 0.0_wp) &
            call refuse(content, group, name, 'must be above 0', number_text(value))
    end subroutine need_positive

    !> It must be a Poisson's ratio.
    subroutine need_poisson(content, group, name, value)
        type(namelist_file_t), intent(in) :: content !! a case file
        type(group_t), intent(in) :: group           !! a group of it
        character(len=*), intent(in) :: name         !! name in the group
        real(wp), intent(in) :: value                !! what the group gave it

        call need_finite(content, group, name, value)
        if (value < 0.0_wp .or. value >= 0.5_wp) &
            call refuse(content, group, name, 'must be at least 0 and below 0.5', &
                        trim(number_text(value)) // likely_mistake(of_poisson_ratio, value))
    end subroutine need_poisson

    !> The numbers a list was given, which must be its first ones without a hole.
    subroutine take_list(content, group, name, list, values)
        type(namelist_file_t), intent(in) :: content    !! a case file
        type(group_t), intent(in) :: group              !! a group of it
        character(len=*), intent(in) :: name            !! name in the group
        real(wp), intent(in) :: list(:)                 !! `not_given` where there is none
        real(wp), allocatable, intent(out) :: values(:) !! the numbers

        integer :: i, n

        n = count(list /= not_given)
        do i = 1, n
            if (list(i) == not_given) call refuse(content, group, name, 'must have a number at ' &
                // 'position ' // integer_text(i), 'none')
            if (.not. ieee_is_finite(list(i))) &
                call refuse(content, group, name, 'must be a finite number at position ' &
                            // integer_text(i), number_text(list(i)))
        end do
        values = list(:n)
    end subroutine take_list

    !> There must be as many numbers as shifts.
    subroutine need_as_many(content, group, name, given, wanted)
        type(namelist_file_t), intent(in) :: content !! a case file
        type(group_t), intent(in) :: group           !! a group of it
        character(len=*), intent(in) :: name         !! name in the group
        integer, intent(in) :: given, wanted         !! how many

        if (given /= wanted) &
            call refuse(content, group, name, 'must have as many numbers as shifts, ' &
                        // integer_text(wanted), integer_text(given))
    end subroutine need_as_many
end module faststrip_command_settings_case_values
