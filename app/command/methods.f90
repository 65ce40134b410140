!> Which methods a contact is solved by, and how finely.
module faststrip_command_methods
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: number_text
    use faststrip_base_text, only: integer_text
    use faststrip_normal_strip, only: strips_auto
    use faststrip_tangential_types, only: most_points_per_strip => most_points
    use faststrip_contact_methods, only: contact_methods_t, method_t, normal_table, &
                                         tangential_table, normal_strip, tangential_none, &
                                         method_name_length, most_strips, &
                                         most_points => most_rows
    use faststrip_contact_wanted, only: wanted_t
    use faststrip_command_wear_figures, only: wear_choice_t
    implicit none
    private

    public :: numerics_t, check_numerics, one_of, core_methods, in_core
    public :: most_strips, most_points, most_points_per_strip, most_elements
    public :: word_length, norm_starts

    !> Length of a word of the case file, characters.
    integer, parameter :: word_length = method_name_length
    !> What Kalker's method starts from: a coarser grid, which gives errors too, or strips.
    character(len=word_length), parameter :: norm_starts(2) = [character(len=word_length) :: &
        'coarse', 'strips']
    !> Most elements of a grid of norm or tang, unless the user says otherwise: solved within about
    !> five seconds on one core; the time grows with their number.
    integer, parameter :: standard_max_elements = 1000000
    !> What the user may ask for: 10 GB of memory.
    integer, parameter :: most_elements = 20000000

    !> Methods and resolutions: those of the core, and what norm, tang and auto need besides.
    type, extends(contact_methods_t) :: numerics_t
        real(wp) :: yield_mpa = 0.0_wp   !! pmax above is beyond_yield, MPa; 0: no limit
        real(wp) :: smoothing_um = 0.0_wp !! noise the gap is smoothed for, um; 0: not at all
        real(wp) :: element_dx = 0.2_wp  !! side of an element along x, norm, tang, mm
        real(wp) :: element_dy = 0.2_wp  !! side of an element along y, norm, tang, mm
        logical :: dx_is_given = .false. !! else it is shorter where the contact is small
        logical :: dy_is_given = .false. !! the same along y
        real(wp) :: error_target = 0.0_wp !! of penetration and pmax; sets the sides if positive
        integer :: max_elements = standard_max_elements !! of a grid, norm, tang
        character(len=word_length) :: norm_start = 'coarse' !! one of `norm_starts`
        type(wanted_t) :: wanted = wanted_t() !! of auto: target, tolerance, budget
        type(wear_choice_t) :: wear      !! wear law and yield stress in shear, if there are any
        logical :: tolerance_is_given = .false. !! else it does not count beside a budget
        logical :: target_is_given = .false. !! else it is pmax where no forces are asked for
    end type numerics_t

contains

    !> Find the first name that is out of range; `what` is empty if there is none. The methods are
    !> numbers of the list.
    subroutine check_numerics(numerics, what, range, value)
        type(numerics_t), intent(in) :: numerics            !! as the user gave them
        character(len=:), allocatable, intent(out) :: what  !! name of the culprit
        character(len=:), allocatable, intent(out) :: range !! what it must be
        character(len=:), allocatable, intent(out) :: value !! its value

        what = ''
        range = ''
        value = ''
        call check_word('norm_start', numerics%norm_start, norm_starts)
        if (numerics%strips_per_patch /= strips_auto) &
            call check('strips_per_patch', numerics%strips_per_patch, 1, most_strips)
        call check('points_per_strip', numerics%points_per_strip, 1, most_points_per_strip)
        call check('fastsim_nx', numerics%fastsim_nx, 1, most_points)
        call check('fastsim_ny', numerics%fastsim_ny, 1, most_points)
        call check('max_elements', numerics%max_elements, 1, most_elements)
        call check_real('element_dx_mm', numerics%element_dx, .false.)
        call check_real('element_dy_mm', numerics%element_dy, .false.)
        call check_real('error_target', numerics%error_target, .true.)
        call check_real('yield_MPa', numerics%yield_mpa, .true.)
        call check_real('yield_shear_MPa', numerics%wear%yield_shear_mpa, .true.)
        call check_real('smoothing_um', numerics%smoothing_um, .true.)
        call check_real('tolerance', numerics%wanted%tolerance, numerics%wanted%budget_us > 0.0_wp)
        call check_real('budget_us', numerics%wanted%budget_us, .true.)

    contains

        subroutine check_word(name, word, words)
            character(len=*), intent(in) :: name, word, words(:)

            if (any(words == word) .or. len(what) > 0) return
            what = name
            range = one_of(words)
            value = trim(word)
        end subroutine check_word

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
    end subroutine check_numerics

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

    !> The part of the core: strips where it has no such normal method, which stand for the rows of
    !> norm, and no forces where it has no such tangential method.
    pure type(contact_methods_t) function core_methods(numerics)
        type(numerics_t), intent(in) :: numerics !! checked

        core_methods = numerics%contact_methods_t
        if (.not. in_core(normal_table, core_methods%normal)) core_methods%normal = normal_strip
        if (.not. in_core(tangential_table, core_methods%tangential)) &
            core_methods%tangential = tangential_none
    end function core_methods
end module faststrip_command_methods
