!> Contacts of one wheel on its rail solved directly, for lookup tables and for judging them: first
!> the normal contacts of a place, then creep forces of each for any creepages.
!>
!> The load is the vertical part of the normal forces. Creep forces would move it, and with it the
!> contacts; so what a table holds of them depends on no creepage.
module faststrip_command_lookup_wheel_solver
    use faststrip_base_creepage, only: creepage_t
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_material, only: material_t, combined_shear_modulus, combined_poisson_ratio
    use faststrip_base_status, only: status_t, clear_status, is_error, st_ok
    use faststrip_command_lookup_direct, only: direct_choice_t, direct_t, make_workers, &
                                               release_workers, solve_strips
    use faststrip_command_lookup_states, only: shape_scale
    use faststrip_contact_methods, only: tangential_none
    use faststrip_geometry_wheelset_state, only: wheelset_state_t
    use faststrip_lookup_faces, only: n_forces
    use faststrip_lookup_table, only: n_contact_numbers, at_load, at_angle, at_rail_y, at_rail_z, &
                                      at_ahead, at_wheel_y, at_radius, at_height, at_area, &
                                      at_pmax, at_length, at_creep, at_spin
    use faststrip_lookup_wheel, only: n_wheel_place
    use faststrip_normal_strips, only: reserve_strips, copy_strips
    use faststrip_numerics_environment, only: environment_t, hold_environment, restore_environment
    use faststrip_wheelset_approach, only: approach_search_t, start_search, take_force, is_near, &
                                           usual_approach
    use faststrip_wheelset_height, only: set_outline, try_height
    use faststrip_wheelset_loads, only: start_afresh, name_jump
    use faststrip_wheelset_solve, only: reserve_wheelset
    use faststrip_wheelset_types, only: wheelset_model_t, wheelset_workspace_t, wheelset_result_t, &
                                        wheel_contact_t, most_contacts, side_right
    implicit none
    private

    public :: wheel_solver_t, found_contacts_t, make_wheel_solvers, release_wheel_solvers
    public :: solve_place, take_contact, solve_creep

    ! Tuned [1]: vertical force that is found, of the load, and the bracket of the approach in which
    ! a force jumps over it. Origin: chosen: a thousandth of what tables interpolate.
    real(wp), parameter :: near_enough = 1.0e-6_wp, least_bracket = 1.0e-5_wp
    ! Tuned [1]: most slender ellipse whose coefficients scale creepages. Origin: safeguard: within
    ! the tables of the coefficients.
    real(wp), parameter :: most_slender = 20.0_wp

    !> The contacts of a place.
    type :: found_contacts_t
        integer :: n = 0                                            !! how many
        real(wp) :: numbers(n_contact_numbers, most_contacts) = 0.0_wp
            !! of each, as `look_up_contacts` has them
        integer :: code(most_contacts) = st_ok                      !! how each was solved
    end type found_contacts_t

    !> A wheel on its rail with all that solving needs, one for a thread.
    type :: wheel_solver_t
        type(wheelset_model_t) :: model
        type(wheelset_workspace_t) :: workspace
        type(wheelset_result_t) :: result
        type(direct_t), allocatable :: direct(:) !! one
        real(wp) :: shear = 0.0_wp               !! combined modulus, MPa
        real(wp) :: nu = 0.0_wp                  !! combined Poisson's ratio
        real(wp) :: tried = 0.0_wp               !! the last approach, mm
    end type wheel_solver_t

contains

    !> Solvers of a wheel, one for each thread.
    subroutine make_wheel_solvers(model, choice, threads, solvers, status)
        type(wheelset_model_t), intent(in) :: model        !! made; its right wheel counts
        type(direct_choice_t), intent(in) :: choice        !! checked: how forces are solved
        integer, intent(in) :: threads                     !! how many, >= 1
        type(wheel_solver_t), allocatable, intent(out) :: solvers(:) !! ready
        type(status_t), intent(out) :: status              !! of the library

        integer :: i

        call clear_status(status)
        allocate (solvers(threads))
        do i = 1, threads
            associate (solver => solvers(i))
                solver%model = model
                solver%model%case%methods%tangential = tangential_none
                solver%model%case%estimate = .false.
                solver%shear = combined_shear_modulus(model%case%material)
                solver%nu = combined_poisson_ratio(model%case%material)
                call reserve_wheelset(solver%workspace, solver%model, status)
                if (is_error(status)) return
                call make_workers(choice, 1, solver%direct, status)
                if (is_error(status)) return
                associate (wheel => solver%workspace%wheel(side_right))
                    call reserve_strips(solver%direct(1)%strips, size(wheel%contact(1)%strips%p0), &
                                        status)
                end associate
                if (is_error(status)) return
            end associate
        end do
    end subroutine make_wheel_solvers

    !> Give back what the compiler does not.
    subroutine release_wheel_solvers(solvers)
        type(wheel_solver_t), intent(inout) :: solvers(:) !! serve no more

        integer :: i

        do i = 1, size(solvers)
            call release_workers(solvers(i)%direct)
        end do
    end subroutine release_wheel_solvers

    !> The contacts of a place, by a cold start: no bit depends on what was solved before.
    subroutine solve_place(solver, place, found, status)
        type(wheel_solver_t), intent(inout) :: solver  !! made
        real(wp), intent(in) :: place(n_wheel_place)   !! y, yaw, load
        type(found_contacts_t), intent(out) :: found   !! along y of the rail
        type(status_t), intent(out) :: status          !! `st_no_contact`, `st_no_convergence`

        type(environment_t) :: environment
        integer :: i

        call hold_environment(environment)
        call find_height(solver, place, status)
        call restore_environment(environment)
        if (is_error(status)) return
        associate (wheel => solver%result%wheel(side_right))
            do i = 1, wheel%n
                if (.not. wheel%contact(i)%figures%normal%load > 0.0_wp) cycle
                found%n = found%n + 1
                call take_numbers(wheel%contact(i), wheel%z, solver%nu, found%numbers(:, found%n), &
                                  status)
                if (is_error(status)) return
                found%code(found%n) = wheel%contact(i)%status%code
                ! Where it stands among the contacts of the solution.
                solver%result%wheel(side_right)%contact(found%n) = wheel%contact(i)
                if (found%n < i) call copy_workspace(solver, i, found%n)
            end do
        end associate
    end subroutine solve_place

    ! The height at which the wheel carries its load. What a table interpolates needs it less
    ! exactly than `solve_wheelset` finds it; where the force jumps that takes most of the steps.
    subroutine find_height(solver, place, status)
        type(wheel_solver_t), intent(inout) :: solver
        real(wp), intent(in) :: place(n_wheel_place)
        type(status_t), intent(out) :: status

        type(wheelset_state_t) :: state
        type(approach_search_t) :: search
        real(wp) :: touch

        call clear_status(status)
        state%y = place(1)
        state%yaw = place(2)
        associate (wheel => solver%result%wheel(side_right))
            call start_afresh(solver%workspace)
            call set_outline(solver%model, solver%workspace, state, side_right, touch, status)
            if (is_error(status)) return
            call start_search(search, place(3), usual_approach(place(3)))
            do while (search%goes_on .and. search%misfit > near_enough .and. &
                      search%high - search%low > least_bracket*search%high)
                call try_height(solver%model, solver%workspace, state, side_right, &
                                touch + search%approach, wheel)
                if (is_error(wheel%status)) exit
                solver%tried = search%approach
                call take_force(search, wheel%force(3))
            end do
            if (.not. is_error(wheel%status) .and. abs(solver%tried - search%best) > 0.0_wp) &
                call try_height(solver%model, solver%workspace, state, side_right, &
                                touch + search%best, wheel)
            if (is_error(wheel%status)) then
                status = wheel%status
            else if (.not. is_near(search)) then
                call name_jump(search, status)
            end if
        end associate
    end subroutine find_height

    ! A contact without load before it leaves its place to the next one.
    subroutine copy_workspace(solver, from, to)
        type(wheel_solver_t), intent(inout) :: solver
        integer, intent(in) :: from, to

        associate (contact => solver%workspace%wheel(side_right)%contact)
            call copy_strips(contact(from)%strips, contact(to)%strips)
        end associate
    end subroutine copy_workspace

    !> Numbers of a contact.
    subroutine take_numbers(contact, height, nu, numbers, status)
        type(wheel_contact_t), intent(in) :: contact
        real(wp), intent(in) :: height, nu
        real(wp), intent(out) :: numbers(n_contact_numbers)
        type(status_t), intent(out) :: status

        real(wp) :: c, log_ratio, scale(3)

        associate (normal => contact%figures%normal)
            c = sqrt(normal%area/pi)
            log_ratio = log(min(max((normal%x_max/c)**2, 1.0_wp/most_slender), most_slender))
            scale = shape_scale(log_ratio, nu, status)
            numbers(at_load) = normal%load
            numbers(at_area) = normal%area
            numbers(at_pmax) = normal%pmax
        end associate
        numbers(at_angle) = contact%angle
        numbers(at_rail_y) = contact%rail(1)
        numbers(at_rail_z) = contact%rail(2)
        numbers(at_ahead) = contact%place(1)
        numbers(at_wheel_y) = contact%wheel(2)
        numbers(at_radius) = contact%radius
        numbers(at_height) = height
        numbers(at_length) = c
        numbers(at_creep:at_spin) = scale*[c**2, c**2, c**3]
    end subroutine take_numbers

    !> Take up one contact of the place that was solved last: creep forces are then its.
    subroutine take_contact(solver, i)
        type(wheel_solver_t), intent(inout) :: solver !! with contacts
        integer, intent(in) :: i                      !! which one

        call copy_strips(solver%workspace%wheel(side_right)%contact(i)%strips, &
                         solver%direct(1)%strips)
    end subroutine take_contact

    !> Creep forces on the rail of the contact that was taken up.
    subroutine solve_creep(solver, mu, creepages, forces, status)
        type(wheel_solver_t), intent(inout) :: solver !! with a contact
        real(wp), intent(in) :: mu                    !! above 0
        real(wp), intent(in) :: creepages(3)          !! cksi, ceta, cphi; -, -, rad/mm
        real(wp), intent(out) :: forces(n_forces)     !! Fx, Fy, N; Mz, N mm
        type(status_t), intent(out) :: status         !! of the method

        type(material_t) :: material

        material = solver%model%case%material
        call solve_strips(solver%direct(1), material, mu, &
                          creepage_t(creepages(1), creepages(2), creepages(3)), forces, status)
    end subroutine solve_creep
end module faststrip_command_lookup_wheel_solver
