!> The structs of the C interface, `faststrip_case` and `faststrip_result` of the header, and what
!> they are in Fortran: nowhere else is it said which member is which component.
!>
!> `size` of a case says which header the caller was compiled with; another one than that of this
!> library is refused.
module faststrip_interop_c_structs
    use, intrinsic :: iso_c_binding, only: c_int, c_double, c_size_t, c_ptr, c_associated, &
                                           c_f_pointer, c_null_ptr, c_sizeof
    use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, count_text, &
                                     st_bad_argument
    use faststrip_base_creepage, only: creepage_t
    use faststrip_base_friction, only: friction_t
    use faststrip_base_friction_table, only: friction_table_t, most_places
    use faststrip_base_material, only: material_t
    use faststrip_base_thermal, only: thermal_t, of_wheel, of_rail
    use faststrip_contact_case, only: contact_case_t, given_forces_t
    use faststrip_contact_methods, only: contact_methods_t
    use faststrip_contact_wanted, only: wanted_t, unknown_error
    use faststrip_interop_handle, only: handle_t
    implicit none
    private

    public :: c_case_t, c_result_t
    public :: default_case, find_case, check_size, methods_of, with_elements, fill_case
    public :: fill_result

    !> `faststrip_case` of the header.
    type, bind(c) :: c_case_t
        integer(c_size_t) :: size
        integer(c_int) :: normal, tangential, strips_per_patch, points_per_strip, fastsim_nx, &
                          fastsim_ny, by_load, warm_start, with_elements
        real(c_double) :: e_wheel, e_rail, nu_wheel, nu_rail, mu, load, penetration, cksi, ceta, &
                          cphi
        integer(c_int) :: estimate
        real(c_double) :: resolution_limit, force_limit
        integer(c_int) :: target
        real(c_double) :: tolerance, budget_us
        integer(c_int) :: friction
        real(c_double) :: kinetic_share, half_slip_speed, speed, slope_factor, flange_share, &
                          tread_angle, flange_angle, contact_angle
        integer(c_int) :: n_mu = 0, mu_over = 0
        type(c_ptr) :: mu_at = c_null_ptr, mu_table = c_null_ptr
        real(c_double) :: rail_y = 0
        integer(c_int) :: fx_is_given, fy_is_given
        real(c_double) :: given_fx, given_fy
        real(c_double) :: hot_share, cold_temperature, hot_temperature
        integer(c_int) :: with_temperatures
        real(c_double) :: conductivity_wheel, conductivity_rail, heat_capacity_wheel, &
                          heat_capacity_rail, density_wheel, density_rail, temperature_wheel, &
                          temperature_rail
        integer(c_int) :: curved
    end type c_case_t

    !> `faststrip_result` of the header; zeros unless there is one.
    type, bind(c) :: c_result_t
        integer(c_size_t) :: size = 0
        real(c_double) :: load = 0, penetration = 0, area = 0, pmax = 0, y_min = 0, y_max = 0, &
                          x_max = 0, cksi = 0, ceta = 0, fx = 0, fy = 0, mz = 0, &
                          friction_power = 0, stick_fraction = 0
        integer(c_int) :: n_patches = 0, n_strips = 0, n_elements = 0, iterations = 0, &
                          is_estimated = 0, strips_across = 0
        real(c_double) :: est_err_penetration = 0, est_err_pmax = 0, est_err_area = 0, &
                          residual_inside = 0, overlap_outside = 0
        integer(c_int) :: forces_are_estimated = 0, limitations = 0
        real(c_double) :: est_err_fx = 0, est_err_fy = 0, est_err_mz = 0, est_err_cksi = 0, &
                          est_err_ceta = 0
        integer(c_int) :: n_steps = 0, best_step = 0, target_is_known = 0, target_is_met = 0
        real(c_double) :: est_err_target = 0
        integer(c_int) :: temperatures_are_known = 0
        real(c_double) :: flash_temperature = 0, temperature_max = 0, temperature_x = 0, &
                          temperature_y = 0
    end type c_result_t

contains

    !> Steel on steel, the methods of the project and nothing to solve.
    type(c_case_t) function default_case() result(fields)
        type(contact_case_t) :: case

        fields%size = c_sizeof(fields)
        associate (methods => case%methods)
            fields%normal = methods%normal
            fields%tangential = methods%tangential
            fields%strips_per_patch = methods%strips_per_patch
            fields%points_per_strip = methods%points_per_strip
            fields%fastsim_nx = methods%fastsim_nx
            fields%fastsim_ny = methods%fastsim_ny
        end associate
        fields%by_load = merge(1, 0, case%by_load)
        fields%warm_start = merge(1, 0, case%warm_start)
        fields%with_elements = 0
        associate (material => case%material)
            fields%e_wheel = material%e_wheel
            fields%e_rail = material%e_rail
            fields%nu_wheel = material%nu_wheel
            fields%nu_rail = material%nu_rail
        end associate
        fields%mu = case%mu
        fields%load = case%load
        fields%penetration = case%penetration
        fields%cksi = case%creepage%cksi
        fields%ceta = case%creepage%ceta
        fields%cphi = case%creepage%cphi
        fields%estimate = merge(1, 0, case%estimate)
        fields%resolution_limit = case%resolution_limit
        fields%force_limit = case%force_limit
        fields%target = case%wanted%target
        fields%tolerance = case%wanted%tolerance
        fields%budget_us = case%wanted%budget_us
        associate (friction => case%friction)
            fields%friction = friction%kind
            fields%kinetic_share = friction%kinetic_share
            fields%half_slip_speed = friction%half_slip_speed
            fields%speed = friction%speed
            fields%slope_factor = friction%slope_factor
            fields%flange_share = friction%flange_share
            fields%tread_angle = friction%tread_angle
            fields%flange_angle = friction%flange_angle
            fields%hot_share = friction%hot_share
            fields%cold_temperature = friction%cold_temperature
            fields%hot_temperature = friction%hot_temperature
        end associate
        fields%contact_angle = 0
        fields%fx_is_given = 0
        fields%fy_is_given = 0
        fields%given_fx = 0
        fields%given_fy = 0
        fields%with_temperatures = 0
        associate (thermal => case%thermal)
            fields%conductivity_wheel = thermal%conductivity(of_wheel)
            fields%conductivity_rail = thermal%conductivity(of_rail)
            fields%heat_capacity_wheel = thermal%heat_capacity(of_wheel)
            fields%heat_capacity_rail = thermal%heat_capacity(of_rail)
            fields%density_wheel = thermal%density(of_wheel)
            fields%density_rail = thermal%density(of_rail)
            fields%temperature_wheel = thermal%temperature(of_wheel)
            fields%temperature_rail = thermal%temperature(of_rail)
        end associate
        fields%curved = 0
    end function default_case

    !> A caller's case, if it is one.
    subroutine find_case(address, fields, status)
        type(c_ptr), intent(in) :: address             !! of a `faststrip_case`, or null
        type(c_case_t), pointer, intent(out) :: fields !! where it is; null if there is none
        type(status_t), intent(out) :: status          !! `st_bad_argument`

        fields => null()
        call check_size('the case', 'faststrip_default_case', address, c_sizeof(fields), status)
        if (.not. is_error(status)) call c_f_pointer(address, fields)
    end subroutine find_case

    !> Is there a struct, of the size that this library knows?
    subroutine check_size(words, setter, address, known, status, length)
        character(len=*), intent(in) :: words               !! what it is
        character(len=*), intent(in) :: setter              !! function that sets its size
        type(c_ptr), intent(in) :: address                  !! of the struct, or null
        integer(c_size_t), intent(in) :: known              !! bytes
        type(status_t), intent(out) :: status               !! `st_bad_argument`
        integer(c_size_t), intent(in), optional :: length   !! bytes; unless given its first member

        integer(c_size_t), pointer :: member
        integer(c_size_t) :: bytes
        character(len=20) :: got

        call clear_status(status)
        if (.not. c_associated(address)) then
            call set_status(status, st_bad_argument, words // ' is missing')
            return
        end if
        call c_f_pointer(address, member)
        if (present(length)) then
            bytes = length
        else
            bytes = member
        end if
        if (bytes == known) return
        write (got, '(ss, i0)') bytes
        call set_status(status, st_bad_argument, words // ' must have the ' // &
                        trim(count_text(int(known))) // ' bytes that ' // setter // ' sets, got ' &
                        // trim(got) // merge(': the header is newer', ': the header is older', &
                                              bytes > known))
    end subroutine check_size

    !> Methods and resolutions of a case.
    pure type(contact_methods_t) function methods_of(fields) result(methods)
        type(c_case_t), intent(in) :: fields !! not yet checked

        methods = contact_methods_t(fields%normal, fields%tangential, fields%strips_per_patch, &
                                    fields%points_per_strip, fields%fastsim_nx, fields%fastsim_ny)
    end function methods_of

    !> Does a case need elements?
    pure logical function with_elements(fields)
        type(c_case_t), intent(in) :: fields !! not yet checked

        with_elements = fields%with_elements /= 0 .or. fields%with_temperatures /= 0
    end function with_elements

    !> All of a case but its gap.
    subroutine fill_case(fields, case, contact_angle)
        type(c_case_t), intent(in) :: fields           !! as the caller has it
        type(contact_case_t), intent(inout) :: case    !! not yet checked
        real(c_double), intent(out) :: contact_angle   !! of a contact alone, rad

        case%methods = methods_of(fields)
        case%by_load = fields%by_load /= 0
        case%warm_start = fields%warm_start /= 0
        case%asked%field = fields%with_elements /= 0
        case%material = material_t(fields%e_wheel, fields%e_rail, fields%nu_wheel, fields%nu_rail)
        case%mu = fields%mu
        case%load = fields%load
        case%penetration = fields%penetration
        case%creepage = creepage_t(fields%cksi, fields%ceta, fields%cphi)
        case%estimate = fields%estimate /= 0
        case%resolution_limit = fields%resolution_limit
        case%force_limit = fields%force_limit
        case%wanted = wanted_t(target=fields%target, tolerance=fields%tolerance, &
                               budget_us=fields%budget_us)
        case%friction = friction_t(fields%friction, fields%kinetic_share, fields%half_slip_speed, &
                                   fields%speed, fields%slope_factor, fields%flange_share, &
                                   fields%tread_angle, fields%flange_angle, fields%hot_share, &
                                   fields%cold_temperature, fields%hot_temperature)
        case%asked%temperatures = fields%with_temperatures /= 0
        case%thermal = thermal_t([fields%conductivity_wheel, fields%conductivity_rail], &
                                 [fields%heat_capacity_wheel, fields%heat_capacity_rail], &
                                 [fields%density_wheel, fields%density_rail], &
                                 [fields%temperature_wheel, fields%temperature_rail])
        case%curved = fields%curved /= 0
        contact_angle = fields%contact_angle
        call fill_table(fields, case%friction%table)
        case%given = given_forces_t([fields%fx_is_given, fields%fy_is_given] /= 0, &
                                    [fields%given_fx, fields%given_fy])
    end subroutine fill_case

    ! Arrays that are missing are not finite.
    subroutine fill_table(fields, table)
        type(c_case_t), intent(in) :: fields
        type(friction_table_t), intent(inout) :: table ! not yet checked

        real(c_double), pointer :: numbers(:)

        table%n = fields%n_mu
        table%over = fields%mu_over
        table%y_rail = fields%rail_y
        table%angle = fields%contact_angle
        if (table%n < 1 .or. table%n > most_places) return
        table%at(:table%n) = ieee_value(table%at, ieee_quiet_nan)
        if (.not. c_associated(fields%mu_at) .or. .not. c_associated(fields%mu_table)) return
        call c_f_pointer(fields%mu_at, numbers, [table%n])
        table%at(:table%n) = numbers
        call c_f_pointer(fields%mu_table, numbers, [table%n])
        table%mu(:table%n) = numbers
    end subroutine fill_table

    !> The figures of a handle's last contact; zeros if there was none.
    pure subroutine fill_result(handle, fields)
        type(handle_t), intent(in) :: handle    !! after a solution
        type(c_result_t), intent(out) :: fields !! all of them

        fields%size = c_sizeof(fields)
        associate (normal => handle%result%normal, tangential => handle%result%tangential, &
                   normal_errors => handle%result%normal_errors, &
                   forces => handle%result%force_errors, workspace => handle%workspace, &
                   steps => handle%workspace%steps)
            fields%load = normal%load
            fields%penetration = normal%penetration
            fields%area = normal%area
            fields%pmax = normal%pmax
            fields%y_min = normal%y_min
            fields%y_max = normal%y_max
            fields%x_max = normal%x_max
            fields%cksi = handle%result%creepage%cksi
            fields%ceta = handle%result%creepage%ceta
            fields%fx = tangential%fx
            fields%fy = tangential%fy
            fields%mz = tangential%mz
            fields%friction_power = tangential%friction_power
            fields%stick_fraction = tangential%stick_fraction
            fields%n_patches = normal%n_patches
            fields%n_strips = merge(workspace%strips%n, 0, normal%n_patches > 0)
            fields%n_elements = workspace%field%n
            fields%iterations = normal%iterations
            fields%is_estimated = merge(1, 0, handle%result%is_estimated)
            fields%strips_across = normal%strips_across
            fields%est_err_penetration = normal_errors%est_err_penetration
            fields%est_err_pmax = normal_errors%est_err_pmax
            fields%est_err_area = normal_errors%est_err_area
            fields%residual_inside = normal_errors%residual_inside
            fields%overlap_outside = normal_errors%overlap_outside
            fields%forces_are_estimated = merge(1, 0, handle%result%forces_are_estimated)
            fields%limitations = handle%limitations
            fields%est_err_fx = forces%fx
            fields%est_err_fy = forces%fy
            fields%est_err_mz = forces%mz
            fields%est_err_cksi = handle%result%creepage_errors(1)
            fields%est_err_ceta = handle%result%creepage_errors(2)
            fields%n_steps = steps%n
            fields%best_step = steps%best
            fields%target_is_known = merge(1, 0, steps%estimate < unknown_error)
            fields%target_is_met = merge(1, 0, steps%is_met)
            if (steps%estimate < unknown_error) fields%est_err_target = steps%estimate
        end associate
        if (.not. handle%result%knows_temperatures) return
        fields%temperatures_are_known = 1
        associate (flash => handle%result%flash)
            fields%flash_temperature = flash%rise
            fields%temperature_max = flash%temperature
            fields%temperature_x = flash%x
            fields%temperature_y = flash%y
        end associate
    end subroutine fill_result
end module faststrip_interop_c_structs
