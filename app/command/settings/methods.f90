!> Which methods a contact is solved by, and how finely.
module faststrip_command_settings_methods
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: number_text
    use faststrip_base_text, only: integer_text
    use faststrip_normal_strip, only: strips_auto
    use faststrip_tangential_types, only: most_points_per_strip => most_points
    use faststrip_contact_case, only: contact_case_t
    use faststrip_contact_methods, only: method_t, tangential_none, method_name_length, &
                                         most_strips, most_points => most_rows
    use faststrip_contact_wanted, only: target_pmax
    implicit none
    private

    public :: settings_t, check_settings, settle_wanted, one_of, in_core
    public :: most_strips, most_points, most_points_per_strip, most_elements
    public :: word_length, norm_starts

    !> Length of a word of the case file, characters.
    integer, parameter :: word_length = method_name_length
    !> What norm starts from, `start_coarse` and `start_strips`: a coarser grid, which gives errors
    !> too, or strips.
    character(len=word_length), parameter :: norm_starts(2) = [character(len=word_length) :: &
        'coarse', 'strips']
    !> What the user may ask for: 10 GB of memory.
    integer, parameter :: most_elements = 20000000

    !> A contact's case with what only people give, or need to be told.
    type, extends(contact_case_t) :: settings_t
        character(len=:), allocatable :: wear_file   !! of the wear law; or not allocated
        character(len=:), allocatable :: wear_source !! what the file names as its source
        logical :: tolerance_is_given = .false. !! else it does not count beside a budget
        logical :: target_is_given = .false. !! else it is pmax where no forces are asked for
    end type settings_t

contains

    !> Find the first name that is out of range; `what` is empty if there is none. The methods are
    !> numbers of the list.
    subroutine check_settings(case, smoothing_um, what, range, value)
        class(settings_t), intent(in) :: case               !! as the user gave them
        real(wp), intent(in) :: smoothing_um                !! the same, um
        character(len=:), allocatable, intent(out) :: what  !! name of the culprit
        character(len=:), allocatable, intent(out) :: range !! what it must be
        character(len=:), allocatable, intent(out) :: value !! its value

        what = ''
        range = ''
        value = ''
        associate (methods => case%methods)
            if (methods%strips_per_patch /= strips_auto) &
                call check('strips_per_patch', methods%strips_per_patch, 1, most_strips)
            call check('points_per_strip', methods%points_per_strip, 1, most_points_per_strip)
            call check('fastsim_nx', methods%fastsim_nx, 1, most_points)
            call check('fastsim_ny', methods%fastsim_ny, 1, most_points)
            call check('max_elements', methods%max_elements, 1, most_elements)
            call check_real('element_dx_mm', methods%element_dx, .false.)
            call check_real('element_dy_mm', methods%element_dy, .false.)
            call check_real('error_target', methods%error_target, .true.)
        end associate
        call check_real('yield_MPa', case%yield, .true.)
        call check_real('yield_shear_MPa', case%yield_shear, .true.)
        call check_real('smoothing_um', smoothing_um, .true.)
        call check_real('tolerance', case%wanted%tolerance, case%wanted%budget_us > 0.0_wp)
        call check_real('budget_us', case%wanted%budget_us, .true.)

    contains

        subroutine check(name, number, least, most)
            character(len=*), intent(in) :: name
            integer, intent(in) :: number, least, most

            if (number >= least .and. number <= most) return
            if (len(what) > 0) return
            what = name
            range = 'a whole number from ' // integer_text(least) // ' to ' // integer_text(most)
            value = integer_text(number)
        end subroutine check

        subroutine check_real(name, number, may_be_zero)
            character(len=*), intent(in) :: name
            real(wp), intent(in) :: number
            logical, intent(in) :: may_be_zero

            if (len(what) > 0) return
            if (ieee_is_finite(number)) then
                if (number > 0.0_wp .or. may_be_zero .and. number >= 0.0_wp) return
            end if
            what = name
            range = 'a number above 0'
            if (may_be_zero) range = 'a number from 0 on'
            value = trim(number_text(number))
        end subroutine check_real
    end subroutine check_settings

    !> What a word must be.
    pure function one_of(words) result(text)
        character(len=*), intent(in) :: words(:)
        character(len=len('one of ') + sum(len_trim(words)) + len(', ')*(size(words) - 1)) :: text

        integer :: i, filled

        text = 'one of ' // trim(words(1))
        filled = len('one of ') + len_trim(words(1))
        do i = 2, size(words)
            text(filled + 1:) = ', ' // trim(words(i))
            filled = filled + len(', ') + len_trim(words(i))
        end do
    end function one_of

    !> Is it a method of the embeddable core?
    pure logical function in_core(table, number)
        type(method_t), intent(in) :: table(:) !! `normal_table` or `tangential_table`
        integer, intent(in) :: number          !! of the method

        in_core = any(table%number == number .and. table%in_core)
    end function in_core

    !> Settle what auto is asked for, when all is given: pmax, where neither a target nor forces are
    !> asked for; a budget alone, where no tolerance is given beside it.
    subroutine settle_wanted(case)
        class(settings_t), intent(inout) :: case !! as the user gave it

        if (.not. case%target_is_given .and. case%methods%tangential == tangential_none) &
            case%wanted%target = target_pmax
        if (case%wanted%budget_us > 0.0_wp .and. .not. case%tolerance_is_given) &
            case%wanted%tolerance = 0.0_wp
    end subroutine settle_wanted
end module faststrip_command_settings_methods
