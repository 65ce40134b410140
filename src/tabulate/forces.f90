!> Forces of a table's contacts, on pressures that are there: by the method that was chosen.
module faststrip_tabulate_forces
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error, set_status, number_text, &
                                     st_no_convergence, st_bad_argument
    use faststrip_contact_case, only: contact_case_t
    use faststrip_contact_grids, only: least_across
    use faststrip_contact_method, only: workspace_t, contact_result_t
    use faststrip_contact_methods, only: contact_methods_t, tangential_faststrip, &
                                         tangential_fastsim, tangential_tang
    use faststrip_contact_solve, only: solve_contact_forces
    use faststrip_contact_wanted, only: usual_tolerance
    use faststrip_lookup_faces, only: n_forces
    use faststrip_normal_strips, only: usual_strips
    implicit none
    private

    public :: choice_t, solve_forces
    public :: force_methods, by_fastsim, most_across

    !> Methods, by their numbers.
    !> Given: places in the list of names.
    integer, parameter :: by_faststrip = 1, by_fastsim = 2, by_tang = 3, by_auto = 4
    character(len=9), parameter :: force_methods(4) = [character(len=9) :: &
        'faststrip', 'fastsim', 'tang', 'auto']

    !> Most elements of TANG along each axis.
    !> Tuned [elements]. Origin: cost: a contact of so many takes seconds.
    integer, parameter :: most_across = 400

    !> What a table's forces are solved by.
    type :: choice_t
        integer :: method = by_faststrip
        integer :: strips = usual_strips !! of FASTSTRIP; elements of FASTSIM's side
        integer :: points = usual_strips !! along a strip, or elements along x
        ! Tuned [elements]. Origin: chosen: errors of some tenths of a percent.
        integer :: across = 36   !! elements of TANG along each axis, the least of auto
        real(wp) :: tolerance = usual_tolerance !! of auto, over mu N and mu N c
        ! Given: steel.
        real(wp) :: nu = 0.28_wp !! Poisson's ratio of both bodies
    end type choice_t

contains

    !> Forces on the rail of the pressures in a workspace, which knows Kalker's methods if they are
    !> asked for. FASTSIM is for ellipses only.
    subroutine solve_forces(choice, workspace, case, result, forces, status)
        type(choice_t), intent(in) :: choice            !! method and resolutions
        type(workspace_t), intent(inout) :: workspace   !! with a normal solution
        type(contact_case_t), intent(inout) :: case     !! material, mu, creepages; gets the method
        type(contact_result_t), intent(inout) :: result !! of that solution; gets the forces
        real(wp), intent(out) :: forces(n_forces)       !! Fx, Fy, N; Mz, N mm
        type(status_t), intent(out) :: status
            !! of the method; `st_bad_argument`: FASTSIM without an ellipse; `st_no_convergence`:
            !! auto

        forces = 0.0_wp
        if (choice%method == by_fastsim .and. .not. workspace%is_ellipse) then
            call set_status(status, st_bad_argument, 'fastsim is for ellipses only')
            return
        end if
        case%estimate = choice%method == by_auto
        associate (methods => case%methods)
            select case (choice%method)
            case (by_fastsim)
                methods%tangential = tangential_fastsim
                methods%fastsim_nx = choice%points
                methods%fastsim_ny = choice%strips
            case (by_tang)
                call choose_elements(workspace, choice%across, methods)
            case default
                methods%tangential = tangential_faststrip
                methods%points_per_strip = choice%points
            end select
        end associate
        call solve_contact_forces(workspace, case, result, status)
        if (.not. is_error(status) .and. choice%method == by_auto) then
            if (.not. worst_error(result) <= choice%tolerance) &
                call refine(choice, workspace, case, result, status)
        end if
        if (is_error(status)) return
        forces = [result%tangential%fx, result%tangential%fy, result%tangential%mz]
    end subroutine solve_forces

    ! By TANG with more and more elements, until its error, as estimated, is within the tolerance.
    subroutine refine(choice, workspace, case, result, status)
        type(choice_t), intent(in) :: choice
        type(workspace_t), intent(inout) :: workspace
        type(contact_case_t), intent(inout) :: case
        type(contact_result_t), intent(inout) :: result
        type(status_t), intent(inout) :: status

        integer :: across

        across = max(choice%across, least_across)
        do
            call choose_elements(workspace, across, case%methods)
            call solve_contact_forces(workspace, case, result, status)
            if (is_error(status)) return
            if (worst_error(result) <= choice%tolerance) return
            across = 2*across
            if (across > most_across) exit
        end do
        call set_status(status, st_no_convergence, 'the tolerance was not met with ' // &
                        'so many elements: the error is estimated as ' // &
                        number_text(worst_error(result)))
    end subroutine refine

    ! So many elements along each axis of the patch.
    pure subroutine choose_elements(workspace, across, methods)
        type(workspace_t), intent(in) :: workspace
        integer, intent(in) :: across
        type(contact_methods_t), intent(inout) :: methods

        methods%tangential = tangential_tang
        methods%dx_is_given = .true.
        methods%dy_is_given = .true.
        methods%max_elements = 4*across**2
        if (workspace%is_ellipse) then
            methods%element_dx = 2.0_wp*workspace%hertz%a/across
            methods%element_dy = 2.0_wp*workspace%hertz%b/across
        else
            associate (strips => workspace%strips)
                methods%element_dx = 2.0_wp*maxval(strips%half_length(:strips%n))/across
                methods%element_dy = (strips%y_right(strips%n) - strips%y_left(1))/across
            end associate
        end if
    end subroutine choose_elements

    ! The worst of the estimated errors; very large where they are not known.
    pure real(wp) function worst_error(result)
        type(contact_result_t), intent(in) :: result

        worst_error = huge(1.0_wp)
        if (result%forces_are_estimated) worst_error = &
            max(result%force_errors%fx, result%force_errors%fy, result%force_errors%mz)
    end function worst_error
end module faststrip_tabulate_forces
