!> Methods whose forces do not follow the height of a wheel smoothly, or are dear: the height is
!> found by strips, the contacts there are solved by what was asked for, and the load is corrected.
!>
!> The strips' force and that of the method are in nearly the same proportion at all heights, so
!> strips under the load times the proportion lead to the height at which the method carries it.
module faststrip_wheelset_guide
    use faststrip_base_kinds, only: wp
    use faststrip_contact_case, only: contact_case_t, asked_t
    use faststrip_contact_derivatives, only: stays_the_same
    use faststrip_contact_methods, only: normal_table, tangential_table, is_in_core, &
                                         normal_strip, normal_auto, tangential_faststrip
    implicit none
    private

    public :: needs_guide, take_guide

contains

    !> Does a case need one: auto, methods outside the core, gaps that are smoothed one by one?
    pure logical function needs_guide(case)
        type(contact_case_t), intent(in) :: case !! methods, smoothing

        needs_guide = .not. stays_the_same(case)
    end function needs_guide

    !> The case that finds the height.
    pure subroutine take_guide(case)
        type(contact_case_t), intent(inout) :: case !! gets strips, FASTSTRIP, nothing besides

        if (.not. is_in_core(normal_table, case%methods%normal) &
            .or. case%methods%normal == normal_auto) case%methods%normal = normal_strip
        if (.not. is_in_core(tangential_table, case%methods%tangential)) &
            case%methods%tangential = tangential_faststrip
        case%smoothing = 0.0_wp
        case%asked = asked_t()
        case%wear_law%n = 0
    end subroutine take_guide
end module faststrip_wheelset_guide
