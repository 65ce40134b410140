!> Contacts of one wheel on its rail solved directly, for lookup tables and for judging them: first
!> the normal contacts of a place, then creep forces of each for any creepages.
!>
!> The load is the vertical part of the normal forces. Creep forces would move it, and with it the
!> contacts; so what a table holds of them depends on no creepage.
module faststrip_tabulate_contacts
    use faststrip_base_creepage, only: creepage_t
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_status, only: status_t, clear_status, is_error, number_text, st_ok
    use faststrip_contact_case, only: contact_case_t
    use faststrip_contact_method, only: contact_result_t
    use faststrip_geometry_wheelset_state, only: wheelset_state_t
    use faststrip_kalker_methods, only: kalker_methods_t, add_kalker, release_kalker
    use faststrip_lookup_faces, only: n_forces
    use faststrip_lookup_table, only: n_contact_numbers, at_load, at_angle, at_rail_y, at_rail_z, &
                                      at_ahead, at_wheel_y, at_radius, at_height, at_area, &
                                      at_pmax, at_length, at_creep, at_spin
    use faststrip_lookup_wheel, only: n_wheel_place
    use faststrip_tabulate_forces, only: choice_t, solve_forces
    use faststrip_tabulate_states, only: shape_scale, most_slender
    use faststrip_wheelset_model, only: reserve_wheelset
    use faststrip_wheelset_solve, only: solve_wheelset
    use faststrip_wheelset_types, only: wheelset_model_t, wheelset_workspace_t, wheelset_result_t, &
                                        wheelset_demand_t, wheel_contact_t, most_contacts, &
                                        side_right
    implicit none
    private

    public :: wheel_solver_t, found_contacts_t, make_wheel_solver, release_wheel_solver
    public :: solve_place, solve_creep

    ! Tuned [1]: vertical force that is found, of the load, and the bracket of the approach in which
    ! a force jumps over it. Origin: chosen: a thousandth of what tables interpolate.
    real(wp), parameter :: near_enough = 1.0e-6_wp
    ! Power of the penetration that N grows with.
    ! Given: Hertz' law.
    real(wp), parameter :: growth = 1.5_wp

    !> The contacts of a place.
    type :: found_contacts_t
        integer :: n = 0                                            !! how many
        real(wp) :: numbers(n_contact_numbers, most_contacts) = 0.0_wp
            !! of each, as `look_up_contacts` has them
        real(wp) :: length = 0.0_wp
            !! by which z would have to go down for as much load again as there is, if the force
            !! went on as it begins to by Hertz' law, mm
        integer :: code(most_contacts) = st_ok                      !! how each was solved
    end type found_contacts_t

    !> A wheel on its rail with all that solving needs, one for a thread.
    type :: wheel_solver_t
        private
        ! A pointer: code that copies and frees it takes the compiler as long as all else here.
        type(wheelset_workspace_t), pointer :: workspace => null()
        type(wheelset_result_t) :: result
        type(kalker_methods_t) :: kalker
        type(contact_case_t) :: case
        integer :: contact_of(most_contacts) = 0 ! of the solution: those that carry load
    end type wheel_solver_t

contains

    !> A solver of a wheel, in the memory that a pointer has.
    subroutine make_wheel_solver(model, solver, status)
        type(wheelset_model_t), intent(in) :: model           !! made; without creep forces
        type(wheel_solver_t), intent(inout), target :: solver !! ready
        type(status_t), intent(out) :: status                 !! of the library

        integer :: i

        solver%case = model%case
        allocate (solver%workspace)
        call reserve_wheelset(solver%workspace, model, status)
        if (is_error(status)) return
        associate (contacts => solver%workspace%wheel(side_right)%contact)
            do i = 1, size(contacts)
                call add_kalker(contacts(i), solver%kalker, status)
                if (is_error(status)) return
            end do
        end associate
    end subroutine make_wheel_solver

    !> Give back what the compiler does not.
    subroutine release_wheel_solver(solver)
        type(wheel_solver_t), intent(inout) :: solver !! serves no more

        call release_kalker(solver%kalker)
        if (associated(solver%workspace)) deallocate (solver%workspace)
    end subroutine release_wheel_solver

    !> The contacts of a place, by a cold start: no bit depends on what was solved before. The
    !> height need not be as exact as that of a wheelset: where the force jumps over the load that
    !> takes most of the steps.
    subroutine solve_place(model, solver, nu, place, found, status)
        type(wheelset_model_t), intent(in) :: model    !! made; without creep forces
        type(wheel_solver_t), intent(inout) :: solver  !! made for it
        real(wp), intent(in) :: nu                     !! combined Poisson's ratio
        real(wp), intent(in) :: place(n_wheel_place)   !! y, yaw, load
        type(found_contacts_t), intent(out) :: found   !! along y of the rail
        type(status_t), intent(out) :: status
            !! `st_no_contact`, `st_no_convergence`, which name the place

        type(wheelset_state_t) :: state
        type(wheelset_demand_t) :: demand
        real(wp) :: stiffness
        integer :: i

        state%y = place(1)
        state%yaw = place(2)
        demand%wants = [.true., .false.]
        demand%load(side_right) = place(3)
        demand%tolerance = near_enough
        demand%bracket = near_enough
        solver%workspace%has_last = .false.
        call solve_wheelset(model, solver%workspace, state, demand, solver%result, status)
        if (is_error(status)) then
            status%message = trim(status%message) // ' (y ' // trim(number_text(place(1))) &
                             // ' mm, yaw ' // trim(number_text(place(2))) // ' rad, load ' &
                             // trim(number_text(place(3))) // ' N)'
            return
        end if
        call clear_status(status)
        stiffness = 0.0_wp
        associate (wheel => solver%result%wheel(side_right))
            do i = 1, wheel%n
                if (.not. wheel%contact(i)%figures%normal%load > 0.0_wp) cycle
                found%n = found%n + 1
                solver%contact_of(found%n) = i
                call take_numbers(wheel%contact(i), wheel%z, nu, found%numbers(:, found%n), status)
                if (is_error(status)) return
                found%code(found%n) = wheel%contact(i)%status%code
                associate (normal => wheel%contact(i)%figures%normal)
                    stiffness = stiffness + growth*normal%load/normal%penetration &
                                *cos(wheel%contact(i)%angle)**2
                end associate
            end do
        end associate
        found%length = place(3)/stiffness
    end subroutine solve_place

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

    !> Creep forces on the rail of a contact of the place that was solved last.
    subroutine solve_creep(choice, solver, i, mu, creepages, forces, status)
        type(choice_t), intent(in) :: choice          !! how
        type(wheel_solver_t), intent(inout) :: solver !! with contacts
        integer, intent(in) :: i                      !! which one
        real(wp), intent(in) :: mu                    !! above 0
        real(wp), intent(in) :: creepages(3)          !! cksi, ceta, cphi; -, -, rad/mm
        real(wp), intent(out) :: forces(n_forces)     !! Fx, Fy, N; Mz, N mm
        type(status_t), intent(out) :: status         !! of the method

        type(contact_result_t) :: result

        associate (k => solver%contact_of(i))
            result%normal = solver%result%wheel(side_right)%contact(k)%figures%normal
            ! Errors of the forces are those of their method: pressures count as exact.
            result%is_estimated = .true.
            solver%case%mu = mu
            solver%case%creepage = creepage_t(creepages(1), creepages(2), creepages(3))
            call solve_forces(choice, solver%workspace%wheel(side_right)%contact(k), solver%case, &
                              result, forces, status)
        end associate
    end subroutine solve_creep
end module faststrip_tabulate_contacts
