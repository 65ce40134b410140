!> Extremes of the tangential problem: creepages and spin from 0 to 10, friction from none
!> to 2, Poisson's ratio to 0.5, by every method there is.
!>
!> What is measured, of mu N: the size of the force, which must not exceed 1; what a millionth
!> more creepage changes (continuity: about a millionth); what the opposite creepages leave of it
!> (0, forces are odd); friction power of the wrong sign (0). Without friction, of N.
module faststrip_lab_extremes_tangential
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error
    use faststrip_files_csv, only: csv_writer_t
    use faststrip_base_material, only: material_t
    use faststrip_base_creepage, only: creepage_t
    use faststrip_normal_types, only: normal_result_t
    use faststrip_tangential_types, only: tangential_result_t
    use faststrip_lab_grid_ellipse, only: make_ellipse
    use faststrip_lab_extremes_rows, only: row_t, put_row, put_value, status_of
    use faststrip_command_program_console, only: progress
    use faststrip_contact_case, only: contact_case_t
    use faststrip_contact_method, only: workspace_t, contact_result_t
    use faststrip_contact_methods, only: method_t
    use faststrip_contact_solve, only: solve_contact_forces
    use faststrip_lab_force_laws, only: force_laws
    use faststrip_lab_pressures, only: solve_pressures
    implicit none
    private

    public :: tangential_extremes

    real(wp), parameter :: sizes(8) = [0.0_wp, 1.0e-6_wp, 1.0e-4_wp, 1.0e-3_wp, 1.0e-2_wp, &
                                       0.1_wp, 1.0_wp, 10.0_wp]
    real(wp), parameter :: frictions(4) = [0.0_wp, 0.05_wp, 0.3_wp, 2.0_wp]
    real(wp), parameter :: poisson(3) = [0.0_wp, 0.28_wp, 0.5_wp]
    character(len=*), parameter :: motions(4) = [character(len=4) :: 'cksi', 'ceta', 'cphi', 'all']
    real(wp), parameter :: ratio = 1.5_wp, load = 1.0e5_wp ! a/b, N
    integer, parameter :: points = 401
    real(wp), parameter :: small = 1.0e-6_wp

contains

    !> Measure and write.
    subroutine tangential_extremes(quick, writer)
        logical, intent(in) :: quick                !! few points
        type(csv_writer_t), intent(inout) :: writer !! an open file

        integer :: method, i

        do method = 1, size(force_laws)
            do i = 1, size(poisson), merge(2, 1, quick)
                call progress('tangential methods', method, size(force_laws))
                call one_method(force_laws(method), poisson(i), quick, writer)
            end do
        end do
    end subroutine tangential_extremes

    subroutine one_method(method, nu, quick, writer)
        type(method_t), intent(in) :: method
        real(wp), intent(in) :: nu
        logical, intent(in) :: quick
        type(csv_writer_t), intent(inout) :: writer

        type(workspace_t) :: workspace
        type(contact_result_t) :: result
        type(contact_case_t) :: contact
        type(normal_result_t) :: known
        type(status_t) :: status
        type(row_t) :: row
        integer :: m, c, k

        associate (below => min(nu, nearest(0.5_wp, -1.0_wp)))
            contact%material = material_t(nu_wheel=below, nu_rail=below)
        end associate
        contact%load = load
        call make_ellipse(ratio, points, contact, known)
        contact%methods%tangential = method%number
        call solve_pressures(workspace, contact, result, status)
        contact%estimate = .false.
        do m = 1, size(motions)
            do c = 1, size(sizes), merge(2, 1, quick)
                do k = 1, size(frictions), merge(3, 1, quick)
                    row = row_t(chapter='tangential', method=method%name, x_name='creepage', &
                                x=sizes(c), y_name='mu', y=frictions(k))
                    write (row%case, '(2a, f0.2)') trim(motions(m)), ' nu = 0', nu
                    if (is_error(status)) then
                        row%quantity = 'force'
                        call status_of(status, row)
                        call put_row(writer, row)
                        cycle
                    end if
                    call one_motion(workspace, contact, trim(motions(m)), row, writer)
                end do
            end do
        end do
    end subroutine one_method

    !> The rows of one creepage and friction, which are the row's x and y.
    subroutine one_motion(workspace, solved, motion, row, writer)
        type(workspace_t), intent(inout) :: workspace
        type(contact_case_t), intent(in) :: solved
        character(len=*), intent(in) :: motion
        type(row_t), intent(inout) :: row
        type(csv_writer_t), intent(inout) :: writer

        type(contact_case_t) :: contact
        type(tangential_result_t) :: here, next, opposite
        type(status_t) :: status
        real(wp) :: unit

        unit = load
        if (row%y > 0.0_wp) unit = row%y*load
        contact = solved
        contact%mu = row%y
        contact%creepage = creepage_of(motion, row%x)
        call find(here)
        call status_of(status, row)
        call put_value(writer, row, 'force', hypot(here%fx, here%fy)/unit)
        call put_value(writer, row, 'negative_power', max(0.0_wp, -here%friction_power)/unit)
        if (.not. row%has_value) return
        contact%creepage = creepage_of(motion, -row%x)
        call find(opposite)
        call status_of(status, row)
        call put_value(writer, row, 'oddness', &
                       hypot(here%fx + opposite%fx, here%fy + opposite%fy)/unit)
        contact%creepage = creepage_of(motion, (1.0_wp + small)*max(row%x, small**2))
        call find(next)
        call status_of(status, row)
        call put_value(writer, row, 'step', hypot(here%fx - next%fx, here%fy - next%fy)/unit)

    contains

        subroutine find(forces)
            type(tangential_result_t), intent(out) :: forces

            type(contact_result_t) :: result

            call solve_contact_forces(workspace, contact, result, status)
            forces = result%tangential
        end subroutine find
    end subroutine one_motion

    pure type(creepage_t) function creepage_of(motion, size_)
        character(len=*), intent(in) :: motion
        real(wp), intent(in) :: size_

        creepage_of = creepage_t(0.0_wp, 0.0_wp, 0.0_wp)
        if (motion == 'cksi' .or. motion == 'all') creepage_of%cksi = size_
        if (motion == 'ceta' .or. motion == 'all') creepage_of%ceta = size_
        if (motion == 'cphi' .or. motion == 'all') creepage_of%cphi = size_
    end function creepage_of
end module faststrip_lab_extremes_tangential
