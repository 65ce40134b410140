!> The structs of the C face, `faststrip_case` and `faststrip_result` of the header, which grow from
!> release to release without a caller being compiled anew.
!>
!> `size` of a case says how much of it the caller's header knows. What that leaves out is as
!> `faststrip_default_case` would have it; a case larger than this library knows is refused. A
!> result has no size the caller must set: it is written as far as the header knows it that the case
!> is of. So a new member of either comes last, in pieces of eight bytes, and with one more column
!> in `releases`: where the result grows the case has to grow too.
module faststrip_interop_c_structs
    use, intrinsic :: iso_c_binding, only: c_int, c_double, c_size_t, c_ptr, c_loc, c_associated, &
                                           c_f_pointer
    use faststrip_base_status, only: status_t, set_status, clear_status, count_text, st_bad_argument
    use faststrip_contact_case, only: contact_case_t
    use faststrip_contact_wanted, only: wanted_t
    use faststrip_interop_flat, only: n_choices, n_numbers, n_figures, n_counts, n_errors, &
                                      n_forces, n_taken, n_friction, flat_default, &
                                      flat_friction
    implicit none
    private

    public :: c_case_t, c_result_t, releases
    public :: write_default_case, read_case, write_result, result_size

    !> `faststrip_case` of the header; members of one type that follow each other are one row.
    type, bind(c) :: c_case_t
        integer(c_size_t) :: size
        integer(c_int) :: choices(n_choices) !! `normal` to `with_elements`
        real(c_double) :: numbers(n_numbers) !! `e_wheel` to `cphi`
        integer(c_int) :: estimate
        real(c_double) :: resolution_limit
        real(c_double) :: force_limit
        integer(c_int) :: target
        real(c_double) :: tolerance
        real(c_double) :: budget_us
        integer(c_int) :: friction_kind
        real(c_double) :: friction(n_friction) !! `kinetic_share` to `contact_angle`
    end type c_case_t

    !> `faststrip_result` of the header, likewise.
    type, bind(c) :: c_result_t
        integer(c_size_t) :: size
        real(c_double) :: figures(n_figures) !! `load` to `stick_fraction`
        integer(c_int) :: counts(n_counts)   !! `n_patches` to `strips_across`
        real(c_double) :: errors(n_errors)   !! `est_err_penetration` to `overlap_outside`
        integer(c_int) :: forces_are_estimated
        integer(c_int) :: limitations        !! all, of which the status is the first
        real(c_double) :: force_errors(n_forces) !! `est_err_fx` to `est_err_mz`
        integer(c_int) :: taken(n_taken)     !! `n_steps` to `target_is_met`
        real(c_double) :: target_error       !! `est_err_target`
    end type c_result_t

    !> Bytes of case and result in every release that changed them, rising.
    integer(c_size_t), parameter :: releases(2, 5) = reshape([ &
        128_c_size_t, 120_c_size_t, &            ! first
        144_c_size_t, 168_c_size_t, &            ! with estimated errors
        152_c_size_t, 200_c_size_t, &            ! with those of the forces
        176_c_size_t, 224_c_size_t, &            ! with what is wanted of auto
        248_c_size_t, 224_c_size_t], [2, 5])     ! with friction that is not one number

    ! Members end at multiples of this; less than two pieces are no case.
    integer(c_size_t), parameter :: piece = 8, least_case = 2*piece

    interface
        !> C's own, because to Fortran's compiler bytes and members are not the same memory.
        type(c_ptr) function memcpy(target, source, length) bind(c)
            import :: c_ptr, c_size_t
            type(c_ptr), value :: target, source
            integer(c_size_t), value :: length
        end function memcpy
    end interface

contains

    !> Steel on steel, the methods of the project and nothing to solve, as far as it is known.
    subroutine write_default_case(address, length, status)
        type(c_ptr), intent(in) :: address      !! of a `faststrip_case`, or null
        integer(c_size_t), intent(in) :: length !! of what the caller's header knows
        type(status_t), intent(out) :: status   !! `st_bad_argument`: null, or no known size

        type(c_case_t), target :: fields
        type(c_ptr) :: ignored

        call check_case(address, length, status)
        if (status%code /= 0) return
        fields = default_case()
        fields%size = length
        ignored = memcpy(address, c_loc(fields), length)
    end subroutine write_default_case

    !> A caller's case, with defaults for what its header does not know.
    subroutine read_case(address, fields, status)
        type(c_ptr), intent(in) :: address            !! of a `faststrip_case`, or null
        type(c_case_t), intent(out), target :: fields !! with the caller's `size`
        type(status_t), intent(out) :: status         !! `st_bad_argument`: null, or no known size

        integer(c_size_t), pointer :: length
        type(c_ptr) :: ignored

        fields = default_case()
        length => fields%size
        if (c_associated(address)) call c_f_pointer(address, length)
        call check_case(address, length, status)
        if (status%code == 0) ignored = memcpy(c_loc(fields), address, length)
    end subroutine read_case

    !> Write a result, as far as the header of the case knows it.
    subroutine write_result(figures, case_size, address)
        type(c_result_t), intent(in) :: figures    !! without `size`
        integer(c_size_t), intent(in) :: case_size !! bytes
        type(c_ptr), intent(in) :: address         !! of a `faststrip_result`

        type(c_result_t), target :: written
        type(c_ptr) :: ignored

        written = figures
        written%size = result_size(case_size)
        ignored = memcpy(address, c_loc(written), written%size)
    end subroutine write_result

    !> Bytes of a result, as far as the header of the case knows it.
    pure integer(c_size_t) function result_size(case_size)
        integer(c_size_t), intent(in) :: case_size !! bytes

        result_size = releases(2, max(count(releases(1, :) <= case_size), 1))
    end function result_size

    !> Is there a case, and of a size whose end is one of a member this library knows?
    subroutine check_case(address, length, status)
        type(c_ptr), intent(in) :: address
        integer(c_size_t), intent(in) :: length
        type(status_t), intent(out) :: status

        integer(c_size_t), parameter :: known = releases(1, size(releases, 2))
        character(len=20) :: got

        call clear_status(status)
        if (.not. c_associated(address)) then
            call set_status(status, st_bad_argument, 'the case is missing')
        else if (length > known) then
            write (got, '(ss, i0)') length
            call set_status(status, st_bad_argument, 'the case must have at most the ' // &
                            trim(count_text(int(known))) // ' bytes that this library knows, ' // &
                            'got ' // trim(got) // ': the header is newer')
        else if (length < least_case .or. mod(length, piece) /= 0) then
            write (got, '(ss, i0)') length
            call set_status(status, st_bad_argument, 'the case must have the size that ' // &
                            'faststrip_default_case set, at most ' // &
                            trim(count_text(int(known))) // ' bytes, got ' // got)
        end if
    end subroutine check_case

    type(c_case_t) function default_case() result(fields)
        type(contact_case_t) :: defaults
        type(wanted_t) :: wanted

        fields%size = releases(1, size(releases, 2))
        call flat_default(fields%choices, fields%numbers)
        fields%estimate = merge(1, 0, defaults%estimate)
        fields%resolution_limit = defaults%resolution_limit
        fields%force_limit = defaults%force_limit
        fields%target = wanted%target
        fields%tolerance = wanted%tolerance
        fields%budget_us = wanted%budget_us
        call flat_friction(fields%friction_kind, fields%friction)
    end function default_case
end module faststrip_interop_c_structs
