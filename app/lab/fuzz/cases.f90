!> The cases of `faststrip-lab fuzz`: odd numbers have shapes drawn in units of their Hertz ellipse
!> (`faststrip_lab_random_gaps`), even ones gaps as the field hands them over
!> (`faststrip_lab_random_field_gaps`).
module faststrip_lab_fuzz_cases
    use faststrip_lab_random_gaps, only: fuzz_case_t, make_fuzz_case, family_names
    use faststrip_lab_random_field_gaps, only: make_field_case, field_family_names
    implicit none
    private

    public :: draw_case, all_families, fuzz_case_t

    integer, parameter :: n_shapes = size(family_names)

    !> What all families are called.
    character(len=12), parameter :: all_families(n_shapes + size(field_family_names)) = &
        [family_names, field_family_names]

contains

    !> Draw a case.
    subroutine draw_case(seed, number, case)
        integer, intent(in) :: seed            !! >= 0
        integer, intent(in) :: number          !! which case, >= 1
        type(fuzz_case_t), intent(out) :: case !! `family` is an index of `all_families`

        if (modulo(number, 2) == 1) then
            call make_fuzz_case(seed, 1 + number/2, case)
        else
            call make_field_case(seed, number/2, case)
            case%family = n_shapes + case%family
        end if
        case%number = number
    end subroutine draw_case
end module faststrip_lab_fuzz_cases
