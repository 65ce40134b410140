!> A workspace of the program with Kalker's methods: it grows with the contacts that it solves.
module faststrip_command_contact_solver
    use, intrinsic :: iso_fortran_env, only: int64
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, clear_status, is_error, number_text
    use faststrip_base_text, only: integer_text
    use faststrip_base_material, only: check_material
    use faststrip_numerics_environment, only: environment_t, hold_environment, restore_environment
    use faststrip_geometry_gap, only: gap_t, check_gap
    use faststrip_geometry_gap_curve, only: gap_curve_t, reserve_gap_curve, set_gap_curve
    use faststrip_geometry_gap_smoothing, only: smooth_gap
    use faststrip_contact_case, only: contact_case_t, keeps_elements
    use faststrip_contact_method, only: workspace_t, contact_result_t
    use faststrip_contact_methods, only: contact_methods_t
    use faststrip_contact_reserve, only: reserve_workspace, reserve_contact_field, &
                                         reserve_contact_loads
    use faststrip_contact_solve, only: solve_contact, set_contact_curve
    use faststrip_kalker_grid, only: contact_grid_t
    use faststrip_kalker_methods, only: kalker_methods_t, add_kalker, release_kalker
    use faststrip_command_program_system, only: set_detail
    implicit none
    private

    public :: solver_t, new_solver, free_solver, solve
    public :: ready_gap_t, make_ready

    !> A workspace and what it has capacity for.
    type :: solver_t
        type(workspace_t) :: workspace                !! with the last contact
        type(kalker_methods_t), private :: kalker
        integer(int64), private :: gap_id = 0         ! number of the gap in it; 0: it has none
        integer, private :: points = 0                ! of a gap that it has capacity for
        type(contact_methods_t), private :: methods   ! that it has capacity for
        logical, private :: has_field = .false.       ! has it capacity for elements?
        logical, private :: has_loads = .false.       ! and for loads?
    end type solver_t

    !> A gap that is ready for many contacts.
    type :: ready_gap_t
        integer(int64) :: id = 0          !! number that no other gap of the run has, above 0
        type(gap_curve_t) :: curve        !! smoothed if that was asked for
        real(wp) :: change = 0.0_wp       !! rms change by that, mm
    end type ready_gap_t

contains

    !> Make one in memory of its own: where an array of workspaces is made gfortran 12 writes out
    !> how each part of them begins, for a minute.
    subroutine new_solver(solver, status)
        type(solver_t), pointer, intent(out) :: solver !! for `free_solver`
        type(status_t), intent(out) :: status          !! those of `add_kalker`

        allocate (solver)
        call add_kalker(solver%workspace, solver%kalker, status, tell_of_grid, tell_of_elements)
    end subroutine new_solver

    !> Give one back with all it has.
    subroutine free_solver(solver)
        type(solver_t), pointer, intent(inout) :: solver !! null afterwards, as it may be before

        if (.not. associated(solver)) return
        call release_kalker(solver%kalker)
        deallocate (solver)
    end subroutine free_solver

    !> Solve one contact.
    subroutine solve(solver, case, result, status, ready)
        type(solver_t), intent(inout) :: solver      !! made beforehand
        class(contact_case_t), intent(in) :: case    !! what to solve
        type(contact_result_t), intent(out) :: result !! figures
        type(status_t), intent(out) :: status        !! an error, or a named limitation
        type(ready_gap_t), intent(in), optional :: ready !! its gap; the case has none then

        call check_material(case%material, status)
        if (is_error(status)) return
        if (present(ready)) then
            call make_room(solver, case, ready%curve%n, status)
            if (.not. is_error(status) .and. solver%gap_id /= ready%id) &
                call set_contact_curve(solver%workspace, ready%curve, status)
            solver%gap_id = merge(0_int64, ready%id, is_error(status))
        else
            solver%gap_id = 0
            call check_gap(case%gap, status)
            if (.not. is_error(status)) call make_room(solver, case, size(case%gap%y), status)
        end if
        if (is_error(status)) return
        call solve_contact(solver%workspace, case, result, status)
        if (present(ready)) result%gap_change = ready%change
    end subroutine solve

    !> Room in the workspace for the contact and its methods, outside the time that is measured.
    !> Where there is enough the last solution stays, for the next one to start from.
    subroutine make_room(solver, case, points, status)
        type(solver_t), intent(inout) :: solver
        class(contact_case_t), intent(in) :: case
        integer, intent(in) :: points         ! of its gap
        type(status_t), intent(out) :: status ! those of `reserve_workspace`

        call clear_status(status)
        associate (methods => case%methods)
            if (points > solver%points .or. methods%normal /= solver%methods%normal .or. &
                methods%strips_per_patch /= solver%methods%strips_per_patch) then
                solver%points = max(solver%points, points)
                solver%gap_id = 0
                call reserve_workspace(solver%workspace, methods, solver%points, status)
                solver%has_field = .false.
                solver%has_loads = .false.
            end if
            if (.not. is_error(status) .and. keeps_elements(case) .and. .not. solver%has_field) then
                call reserve_contact_field(solver%workspace, methods, status)
                solver%has_field = .true.
            end if
            if (.not. is_error(status) .and. case%asked%subsurface &
                .and. .not. solver%has_loads) then
                call reserve_contact_loads(solver%workspace, methods, status)
                solver%has_loads = .true.
            end if
            solver%methods = methods
        end associate
        if (is_error(status)) solver%points = 0
    end subroutine make_room

    !> Make a gap ready for many contacts: smoothed if that is asked for, and a curve.
    subroutine make_ready(smoothing, gap, ready, status)
        real(wp), intent(in) :: smoothing           !! noise it is smoothed for, mm; 0: not at all
        type(gap_t), intent(in) :: gap              !! as it was read
        type(ready_gap_t), intent(inout) :: ready   !! its number is the caller's
        type(status_t), intent(out) :: status       !! those of `smooth_gap` and `check_gap`

        type(environment_t) :: environment
        type(gap_t) :: smooth

        if (smoothing > 0.0_wp) then
            call smooth_gap(gap, smoothing, smooth, ready%change, status)
        else
            call check_gap(gap, status)
        end if
        if (.not. is_error(status)) call reserve_gap_curve(ready%curve, size(gap%y), status)
        if (is_error(status)) return
        call hold_environment(environment)
        if (allocated(smooth%y)) then
            call set_gap_curve(ready%curve, smooth, status)
        else
            call set_gap_curve(ready%curve, gap, status)
        end if
        call restore_environment(environment)
    end subroutine make_ready

    !> For who waits: which grid is being solved by NORM.
    subroutine tell_of_grid(grid)
        type(contact_grid_t), intent(in) :: grid

        call set_detail('norm: ' // integer_text(grid%nx) // ' by ' // integer_text(grid%ny) &
                  // ' elements of ' // trim(number_text(grid%dx)) // ' by ' &
                  // trim(number_text(grid%dy)) // ' mm')
    end subroutine tell_of_grid

    !> The same by TANG.
    subroutine tell_of_elements(elements, with_norm)
        integer, intent(in) :: elements
        logical, intent(in) :: with_norm

        call set_detail(trim(merge('norm and tang', 'tang         ', with_norm)) // ': ' &
                        // integer_text(elements) // ' elements in contact')
    end subroutine tell_of_elements
end module faststrip_command_contact_solver
