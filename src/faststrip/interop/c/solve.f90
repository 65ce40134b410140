!> A gap and a case of the C interface, handed to a handle: for one contact and for many.
module faststrip_interop_c_solve
    use, intrinsic :: iso_c_binding, only: c_int, c_double, c_ptr, c_associated, c_f_pointer
    use faststrip_base_status, only: set_status, count_text, st_bad_argument
    use faststrip_interop_c_structs, only: c_case_t, c_result_t, fill_case, fill_result
    use faststrip_interop_handle, only: handle_t, handle_gap, handle_solve
    implicit none
    private

    public :: take_gap, solve_fields

contains

    !> Hand over the gap that the next solutions are for.
    subroutine take_gap(handle, n, y, h, inv2r, inclination)
        type(handle_t), intent(inout) :: handle !! its status tells how it ended
        integer(c_int), intent(in) :: n         !! number of points
        type(c_ptr), intent(in) :: y, h, inv2r  !! `n` numbers each, mm, mm, 1/mm
        type(c_ptr), intent(in) :: inclination  !! `n` numbers, rad, or null: not known

        real(c_double), pointer :: y_of(:), h_of(:), inv2r_of(:), inclination_of(:)

        if (n < 0) then
            call set_status(handle%status, st_bad_argument, 'the number of gap points must ' // &
                            'not be negative, got ' // count_text(n))
        else if (.not. (c_associated(y) .and. c_associated(h) .and. c_associated(inv2r))) then
            call set_status(handle%status, st_bad_argument, 'the gap must have y, h and inv2r')
        else
            call c_f_pointer(y, y_of, [n])
            call c_f_pointer(h, h_of, [n])
            call c_f_pointer(inv2r, inv2r_of, [n])
            inclination_of => null()
            if (c_associated(inclination)) call c_f_pointer(inclination, inclination_of, [n])
            ! A null pointer counts as an argument that is not present.
            call handle_gap(handle, y_of, h_of, inv2r_of, inclination_of)
        end if
    end subroutine take_gap

    !> Solve one contact on the gap of the handle.
    subroutine solve_fields(handle, fields, figures)
        type(handle_t), intent(inout) :: handle    !! its status tells how it ended
        type(c_case_t), intent(in) :: fields       !! not yet checked
        type(c_result_t), intent(inout) :: figures !! zeros with an error

        call fill_case(fields, handle%case, handle%contact_angle)
        call handle_solve(handle)
        call fill_result(handle, figures)
    end subroutine solve_fields
end module faststrip_interop_c_solve
