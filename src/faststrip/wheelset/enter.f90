!> A lookup table for a wheelset: it is that of its wheels and rails, or it is refused.
module faststrip_wheelset_enter
    use faststrip_base_friction, only: friction_constant
    use faststrip_base_kinds, only: wp
    use faststrip_base_limits, only: rounding
    use faststrip_base_material, only: combined_shear_modulus, combined_poisson_ratio
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, number_text, &
                                     st_bad_argument
    use faststrip_geometry_wheelset_state, only: wheelset_state_t, resting_state
    use faststrip_lookup_faces, only: lookup_linear, lookup_cubic
    use faststrip_lookup_table, only: lookup_t, lookup_kind_wheel, n_wheel_errors, at_height
    use faststrip_wheelset_guide, only: needs_guide
    use faststrip_wheelset_solve, only: solve_wheelset
    use faststrip_wheelset_types, only: wheelset_model_t, wheelset_workspace_t, &
                                        wheelset_result_t, wheelset_demand_t, demand_position, &
                                        side_right, side_left
    implicit none
    private

    public :: enter_lookup

    ! Tuned [1]: of the load, by which a table may be off at its own nodes: by other numbers of
    ! strips. Origin: chosen: a height that is 1.4 um off.
    real(wp), parameter :: near_enough = 0.03_wp
    ! Tuned [1]: of the moduli, by which materials may differ. Origin: rounding.
    real(wp), parameter :: same_material = 1.0e4_wp*rounding

contains

    !> Let a table answer for both wheels: of states within its ends, by its interpolation; those
    !> beyond are left to strips. The table stays the caller's. Three of its nodes are compared with
    !> strips.
    subroutine enter_lookup(model, workspace, lookup, order, result, status)
        type(wheelset_model_t), intent(inout) :: model         !! made; as before if refused
        type(wheelset_workspace_t), intent(inout) :: workspace !! reserved for it
        type(lookup_t), pointer, intent(in) :: lookup          !! of `open_lookup`; null: no more
        integer, intent(in) :: order                           !! `lookup_linear`, `lookup_cubic`
        type(wheelset_result_t), intent(inout) :: result       !! for use in between
        type(status_t), intent(out) :: status
            !! `st_bad_argument`: no table of a wheel, of another one, of other materials, of an
            !! older file, which has no promise of z; both wheels or rails not alike; friction that
            !! falls with slip; another normal method than strips

        type(lookup_t), pointer :: before
        real(wp) :: stiffness(2)
        integer :: i

        call clear_status(status)
        before => model%lookup
        stiffness = model%rail_stiffness
        model%lookup => null()
        workspace%has_last = .false.
        if (.not. associated(lookup)) return
        ! Nodes are those of rails that do not give way.
        model%rail_stiffness = 0.0_wp
        call check_kind(model, lookup, order, status)
        do i = 1, 3
            if (.not. is_error(status)) &
                call check_node(model, workspace, lookup, 1 + (i - 1)*(lookup%wheel%y%n - 1)/2, &
                                result, status)
        end do
        workspace%has_last = .false.
        model%rail_stiffness = stiffness
        model%lookup => before
        if (is_error(status)) return
        model%lookup => lookup
        model%lookup_order = order
    end subroutine enter_lookup

    subroutine check_kind(model, lookup, order, status)
        type(wheelset_model_t), intent(in) :: model
        type(lookup_t), intent(in) :: lookup
        integer, intent(in) :: order
        type(status_t), intent(inout) :: status

        real(wp) :: g, nu

        g = combined_shear_modulus(model%case%material)
        nu = combined_poisson_ratio(model%case%material)
        if (lookup%kind /= lookup_kind_wheel) then
            call refuse('no lookup table of a wheel on a rail')
        else if (order /= lookup_linear .and. order /= lookup_cubic) then
            call refuse('the order of interpolation must be 1 or 3')
        else if (lookup%wheel%n_errors < n_wheel_errors) then
            call refuse('a lookup table of an older version, without errors of z: make it again')
        else if (abs(g - lookup%wheel%shear) > same_material*g .or. &
                 abs(nu - lookup%nu) > same_material) then
            call refuse('the lookup table is of other materials: G ' // &
                        trim(number_text(lookup%wheel%shear)) // ' MPa, nu ' // &
                        number_text(lookup%nu))
        else if (abs(model%pair(side_right)%mark - model%pair(side_left)%mark) > 0.0_wp) then
            call refuse('a lookup table is for two wheels and rails that are alike')
        else if (any(model%pair%roller_radius > 0.0_wp)) then
            call refuse('a lookup table is for rails, not for rollers')
        else if (model%case%friction%kind /= friction_constant .or. &
                 model%case%friction%slope_factor < 1.0_wp .or. &
                 model%case%friction%table%n > 0) then
            call refuse('a lookup table is for Coulomb friction')
        else if (model%case%curved) then
            call refuse('a lookup table has no contacts on a curved surface')
        else if (needs_guide(model%case)) then
            call refuse('beyond its ends a lookup table needs strips: take normal method strip')
        end if

    contains

        subroutine refuse(text)
            character(len=*), intent(in) :: text

            call set_status(status, st_bad_argument, text)
        end subroutine refuse
    end subroutine check_kind

    ! Strips at the height of a node have to carry its load.
    subroutine check_node(model, workspace, lookup, node, result, status)
        type(wheelset_model_t), intent(in) :: model
        type(wheelset_workspace_t), intent(inout) :: workspace
        type(lookup_t), intent(in) :: lookup
        integer, intent(in) :: node ! of y
        type(wheelset_result_t), intent(inout) :: result
        type(status_t), intent(out) :: status

        type(wheelset_state_t) :: state
        type(wheelset_demand_t) :: demand
        real(wp) :: load

        associate (wheel => lookup%wheel, middle => (lookup%wheel%load%n + 1)/2)
            load = wheel%load%x(middle)
            state%y = wheel%y%x(node)
            state%yaw = wheel%yaw%x(1)
            state%z = wheel%contacts(at_height, 1, node + wheel%y%n*wheel%yaw%n*(middle - 1))
        end associate
        demand%kind = demand_position
        demand%wants = [.true., .false.]
        call solve_wheelset(model, workspace, resting_state(state), demand, result, status)
        if (is_error(status)) return
        call clear_status(status)
        associate (found => result%wheel(side_right)%force(3))
            if (.not. abs(found - load) <= near_enough*load) &
                call set_status(status, st_bad_argument, 'the lookup table is of another wheel ' &
                                // 'or rail: at y ' // trim(number_text(state%y)) // ' mm it has ' &
                                // trim(number_text(load)) // ' N where there are ' &
                                // trim(number_text(found)) // ' N')
        end associate
    end subroutine check_node
end module faststrip_wheelset_enter
