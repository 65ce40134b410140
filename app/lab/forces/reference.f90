!> One contact of `faststrip-lab force-data`: NORM's and TANG's creep forces on two grids, one with
!> elements twice as long and wide.
module faststrip_lab_forces_reference
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error, status_word, st_ok
    use faststrip_base_creepage, only: creepage_t
    use faststrip_contact_method, only: workspace_t, contact_result_t
    use faststrip_kalker_normal, only: norm_options_t, norm_workspace_t
    use faststrip_kalker_tangential, only: tang_options_t, tang_workspace_t, tang_solve, &
                                           edges_of_norm
    use faststrip_normal_types, only: normal_result_t
    use faststrip_tangential_types, only: tangential_result_t
    use faststrip_lab_pressures, only: solve_pressures, solve_by_norm
    use faststrip_lab_forces_contacts, only: force_contact_t, draw_force_creepages
    use faststrip_lab_random_force_gaps, only: force_families
    use faststrip_lab_forces_record, only: force_record_t, most_states
    implicit none
    private

    public :: reference_workspaces_t, solve_reference

    ! Residuals, far below the errors of any grid.
    real(wp), parameter :: norm_tolerance = 1.0e-7_wp, tang_tolerance = 1.0e-5_wp

    !> What the reference works in, one for each grid.
    type :: grid_t
        type(norm_workspace_t) :: norm
        type(tang_workspace_t) :: tang
    end type grid_t

    !> What the solvers work in.
    type :: reference_workspaces_t
        type(workspace_t) :: strips
        type(grid_t) :: coarse
        type(grid_t) :: fine
    end type reference_workspaces_t

contains

    !> Solve a contact for some creepages. One that has several patches or a named limitation is
    !> left out: the record's status says why, its lists are empty. Creepages for which TANG does
    !> not converge are left out, too.
    subroutine solve_reference(work, contact, across, record)
        type(reference_workspaces_t), intent(inout) :: work !! grown as needed
        type(force_contact_t), intent(inout) :: contact     !! drawn
        integer, intent(in) :: across                       !! finer elements across, each way
        type(force_record_t), intent(out) :: record

        type(contact_result_t) :: result
        type(creepage_t) :: creepages(most_states)
        real(wp) :: sides(2)
        type(status_t) :: status

        record%seed = contact%seed
        record%number = contact%number
        record%family = trim(force_families(contact%family))
        record%load = contact%load
        record%mu = contact%mu
        record%material = contact%material
        call solve_pressures(work%strips, contact, result, status)
        if (is_left_out(status, result%normal, record)) return
        call draw_force_creepages(contact, work%strips%strips, creepages, status)
        if (is_left_out(status, result%normal, record)) return

        associate (strips => result%normal)
            sides = [2.0_wp*strips%x_max, strips%y_max - strips%y_min]/across
        end associate
        if (has_no_pressures(work, contact, 2.0_wp*sides, work%coarse, record)) return
        if (has_no_pressures(work, contact, sides, work%fine, record)) return
        call solve_states(work, contact, creepages, record)
    end subroutine solve_reference

    !> Solve the normal problem by NORM.
    logical function has_no_pressures(work, contact, sides, grid, record)
        type(reference_workspaces_t), intent(in) :: work ! with a solution by strips
        type(force_contact_t), intent(in) :: contact
        real(wp), intent(in) :: sides(2)                 ! of the elements, mm
        type(grid_t), intent(inout) :: grid
        type(force_record_t), intent(inout) :: record

        type(norm_options_t) :: options
        type(normal_result_t) :: norm
        type(status_t) :: status

        options%dx = sides(1)
        options%dy = sides(2)
        options%two_levels = .false.
        options%tolerance = norm_tolerance
        call solve_by_norm(grid%norm, contact, options, norm, status, work%strips%strips)
        has_no_pressures = is_left_out(status, norm, record)
    end function has_no_pressures

    !> Is a contact no use, and why?
    logical function is_left_out(status, normal, record)
        type(status_t), intent(in) :: status
        type(normal_result_t), intent(in) :: normal
        type(force_record_t), intent(inout) :: record

        record%status = trim(status_word(status%code))
        if (status%code == st_ok .and. normal%n_patches > 1) record%status = 'several_patches'
        is_left_out = status%code /= st_ok .or. normal%n_patches > 1
    end function is_left_out

    !> Forces of all creepages on NORM's grids. They have little in common: from the tractions of
    !> the state before, Newton's method takes a quarter more steps than from none.
    subroutine solve_states(work, contact, creepages, record)
        type(reference_workspaces_t), intent(inout) :: work
        type(force_contact_t), intent(in) :: contact
        type(creepage_t), intent(in) :: creepages(:)
        type(force_record_t), intent(inout) :: record

        type(tang_options_t) :: options
        type(status_t) :: status
        integer :: i

        options%edges = edges_of_norm
        options%tolerance = tang_tolerance
        do i = 1, size(creepages)
            associate (state => record%states(record%n_states + 1))
                state%creepage = creepages(i)
                call solve_forces(work%coarse, state%coarse)
                if (is_error(status)) cycle
                call solve_forces(work%fine, state%forces)
                if (is_error(status)) cycle
                state%steps = work%fine%tang%steps
                state%residual = work%fine%tang%residual
            end associate
            record%n_states = record%n_states + 1
        end do
        record%elements = work%fine%tang%elements

    contains

        subroutine solve_forces(grid, forces)
            type(grid_t), intent(inout) :: grid
            type(tangential_result_t), intent(out) :: forces

            call tang_solve(grid%tang, grid%norm%grid, contact%material, contact%mu, creepages(i), &
                            options, forces, status)
        end subroutine solve_forces
    end subroutine solve_states
end module faststrip_lab_forces_reference
