!> The values of a case, a result and a field as the C and F77 faces hand them over: in rows, and
!> nowhere else is it said which place is which component.
!>
!> The rows are the members of `faststrip_case` and `faststrip_result` in the order of the header;
!> of the F77 face `IOPT` is the first, and `PAR`, `RES`, `ERR` are made of the others.
!>
!> ```
!> choices  1 normal method         2 tangential method    3 strips per patch
!>          4 points per strip      5, 6 points and rows of FASTSIM
!>          7 by load? 8 warm start? 9 elements wanted? (0: no)
!> numbers  1, 2 Young's modulus of wheel and rail, MPa     3, 4 Poisson's ratio of both
!>          5 coefficient of friction    6 load, N          7 penetration, mm
!>          8, 9, 10 creepages, -, -, rad/mm
!> figures  1 load, N               2 penetration, mm      3 area, mm^2
!>          4 largest pressure, MPa 5, 6 ends, mm          7 largest half-length, mm
!>          8, 9, 10 Fx, Fy, Mz on the rail, N, N, N mm
!>          11 friction power over rolling speed, N        12 share in adhesion
!> counts   1 patches   2 strips   3 elements   4 steps    5 are errors estimated? (1: yes)
!>          6 strips across
!> errors   1, 2, 3 estimated error of penetration, largest pressure and area, relative
!>          4 residual inside       5 overlap outside, relative
!> forces   1, 2 estimated error of Fx and Fy over mu N    3 of Mz over mu N c
!> taken    1 steps of auto         2 the best of them
!>          3 is the estimated error of the target known?  4 is it met? (1: yes)
!> friction (beside its kind, 0 constant, 2 linear, 3 rational, 4 exponential)
!>          1 kinetic over static value                    2 slip speed of half of the fall, mm/s
!>          3 rolling speed, mm/s   4 factor of the initial slope
!>          5 mu on the flange over that on the tread      6, 7 contact angles up to which the
!>          tread's mu counts and from which the flange's, rad      8 contact angle, rad
!> ```
module faststrip_interop_flat
    use, intrinsic :: iso_c_binding, only: c_int, c_double
    use faststrip_base_friction, only: friction_t
    use faststrip_base_material, only: material_t
    use faststrip_base_creepage, only: creepage_t
    use faststrip_contact_methods, only: contact_methods_t
    use faststrip_contact_case, only: contact_case_t
    use faststrip_contact_wanted, only: unknown_error
    use faststrip_interop_handle, only: handle_t
    implicit none
    private

    public :: n_choices, n_numbers, n_figures, n_counts, n_errors, n_forces, n_taken, &
              n_friction
    public :: flat_friction, fill_friction
    public :: flat_default, flat_methods, flat_material, wants_elements, fill_case
    public :: read_result, read_force_errors, read_taken, read_steps
    public :: strip_count, read_strips, read_elements

    !> Lengths of the rows.
    !> Given: by the faces.
    integer, parameter :: n_choices = 9, n_numbers = 10, n_figures = 12, n_counts = 6, &
                          n_errors = 5, n_forces = 3, n_taken = 4, n_friction = 8

    !> What stands for an estimated error that is not known.
    !> Given: no estimate is negative.
    real(c_double), parameter :: not_known = -1.0_c_double

contains

    !> Steel on steel, the methods of the project and nothing to solve.
    pure subroutine flat_default(choices, numbers)
        integer(c_int), intent(out) :: choices(n_choices) !! methods, resolutions, switches
        real(c_double), intent(out) :: numbers(n_numbers) !! material, what is prescribed, motion

        type(contact_case_t) :: case

        associate (methods => case%methods)
            choices = [methods%normal, methods%tangential, methods%strips_per_patch, &
                       methods%points_per_strip, methods%fastsim_nx, methods%fastsim_ny, &
                       merge(1, 0, case%by_load), merge(1, 0, case%warm_start), 0]
        end associate
        associate (material => case%material, creepage => case%creepage)
            numbers = [material%e_wheel, material%e_rail, material%nu_wheel, material%nu_rail, &
                       case%mu, case%load, case%penetration, &
                       creepage%cksi, creepage%ceta, creepage%cphi]
        end associate
    end subroutine flat_default

    !> Methods and resolutions.
    pure type(contact_methods_t) function flat_methods(choices) result(methods)
        integer(c_int), intent(in) :: choices(n_choices) !! as the caller has them

        methods = contact_methods_t(choices(1), choices(2), choices(3), choices(4), choices(5), &
                                    choices(6))
    end function flat_methods

    !> Two moduli and two of Poisson's ratios.
    pure type(material_t) function flat_material(numbers) result(material)
        real(c_double), intent(in) :: numbers(4) !! wheel, rail, MPa; wheel, rail

        material = material_t(numbers(1), numbers(2), numbers(3), numbers(4))
    end function flat_material

    !> Friction that is one number.
    pure subroutine flat_friction(kind, numbers)
        integer(c_int), intent(out) :: kind                !! how it falls with slip
        real(c_double), intent(out) :: numbers(n_friction) !! as above

        type(friction_t) :: friction

        kind = friction%kind
        numbers = [friction%kinetic_share, friction%half_slip_speed, friction%speed, &
                   friction%slope_factor, friction%flange_share, friction%tread_angle, &
                   friction%flange_angle, 0.0_c_double]
    end subroutine flat_friction

    !> Friction and the contact angle.
    pure subroutine fill_friction(kind, numbers, friction, contact_angle)
        integer(c_int), intent(in) :: kind                !! as the caller has it
        real(c_double), intent(in) :: numbers(n_friction) !! the same
        type(friction_t), intent(out) :: friction         !! not yet checked
        real(c_double), intent(out) :: contact_angle      !! rad; of a contact alone

        friction = friction_t(kind, numbers(1), numbers(2), numbers(3), numbers(4), numbers(5), &
                              numbers(6), numbers(7))
        contact_angle = numbers(8)
    end subroutine fill_friction

    !> Are the elements wanted?
    pure logical function wants_elements(choices)
        integer(c_int), intent(in) :: choices(n_choices) !! as the caller has them

        wants_elements = choices(9) /= 0
    end function wants_elements

    !> All of a case but its gap, friction beside mu and how errors are estimated, which stay.
    pure subroutine fill_case(choices, numbers, case)
        integer(c_int), intent(in) :: choices(n_choices) !! methods, resolutions, switches
        real(c_double), intent(in) :: numbers(n_numbers) !! material, what is prescribed, motion
        type(contact_case_t), intent(inout) :: case      !! not yet checked

        case%methods = flat_methods(choices)
        case%by_load = choices(7) /= 0
        case%warm_start = choices(8) /= 0
        case%material = flat_material(numbers(:4))
        case%mu = numbers(5)
        case%load = numbers(6)
        case%penetration = numbers(7)
        case%creepage = creepage_t(numbers(8), numbers(9), numbers(10))
    end subroutine fill_case

    !> The figures of the last contact; zeros if there was none.
    pure subroutine read_result(handle, figures, counts, errors)
        type(handle_t), intent(in) :: handle              !! after a solution
        real(c_double), intent(out) :: figures(n_figures) !! of the contact
        integer(c_int), intent(out) :: counts(n_counts)   !! numbers of things
        real(c_double), intent(out) :: errors(n_errors)   !! estimates, zero if not estimated

        associate (normal => handle%result%normal, tangential => handle%result%tangential, &
                   certificate => handle%result%certificate)
            figures = [normal%load, normal%penetration, normal%area, normal%pmax, normal%y_min, &
                       normal%y_max, normal%x_max, tangential%fx, tangential%fy, tangential%mz, &
                       tangential%friction_power, tangential%stick_fraction]
            counts = [normal%n_patches, &
                      merge(handle%workspace%strips%n, 0, normal%n_patches > 0), &
                      handle%workspace%field%n, normal%iterations, &
                      merge(1, 0, handle%result%is_estimated), normal%strips_across]
            errors = [certificate%est_err_penetration, certificate%est_err_pmax, &
                      certificate%est_err_area, certificate%residual_inside, &
                      certificate%overlap_outside]
        end associate
    end subroutine read_result

    !> The estimated errors of the last contact's forces; zeros if they are not known.
    pure subroutine read_force_errors(handle, are_known, errors)
        type(handle_t), intent(in) :: handle             !! after a solution
        integer(c_int), intent(out) :: are_known         !! 1 if they are
        real(c_double), intent(out) :: errors(n_forces)  !! estimates

        are_known = merge(1, 0, handle%result%forces_are_estimated)
        associate (forces => handle%result%force_errors)
            errors = [forces%fx, forces%fy, forces%mz]
        end associate
    end subroutine read_force_errors

    !> What came of the last contact by auto; zeros if there was none.
    pure subroutine read_taken(handle, taken, estimate)
        type(handle_t), intent(in) :: handle          !! after a solution
        integer(c_int), intent(out) :: taken(n_taken) !! steps, best, is it known, is it met
        real(c_double), intent(out) :: estimate       !! of the target's error; zero if not known

        associate (last => handle%workspace%steps)
            taken = [last%n, last%best, merge(1, 0, last%estimate < unknown_error), &
                     merge(1, 0, last%is_met)]
            estimate = merge(last%estimate, 0.0_c_double, last%estimate < unknown_error)
        end associate
    end subroutine read_taken

    !> Copy the first steps of the last contact by auto, as many as the arrays are long.
    pure subroutine read_steps(handle, normal, tangential, strips, points, estimate, normal_us, &
                               tangential_us)
        type(handle_t), intent(in) :: handle                     !! with so many steps
        integer(c_int), intent(inout) :: normal(:), tangential(:) !! methods
        integer(c_int), intent(inout) :: strips(:), points(:)
            !! strips across the widest patch, points along a strip
        real(c_double), intent(inout) :: estimate(:)
            !! of the target's error; `not_known`
        real(c_double), intent(inout) :: normal_us(:), tangential_us(:)
            !! time of the pressures and of the forces, with their estimates, us

        integer :: i

        do i = 1, size(normal)
            associate (step => handle%workspace%steps%steps(i))
                normal(i) = step%methods%normal
                tangential(i) = step%methods%tangential
                strips(i) = step%methods%strips_per_patch
                points(i) = step%methods%points_per_strip
                estimate(i) = merge(step%estimate, not_known, step%estimate < unknown_error)
                normal_us(i) = step%normal_us
                tangential_us(i) = step%tangential_us
            end associate
        end do
    end subroutine read_steps

    !> Strips of the last contact.
    pure integer function strip_count(handle)
        type(handle_t), intent(in) :: handle !! solved or not

        strip_count = merge(handle%workspace%strips%n, 0, handle%workspace%solved_by > 0)
    end function strip_count

    !> Copy the first strips of the last contact, as many as the arrays are long.
    pure subroutine read_strips(handle, y_left, y_right, half_length, p0, patch)
        type(handle_t), intent(in) :: handle                   !! with so many strips
        real(c_double), intent(inout) :: y_left(:), y_right(:) !! edges, mm
        real(c_double), intent(inout) :: half_length(:)        !! mm
        real(c_double), intent(inout) :: p0(:)                 !! on the centre line, MPa
        integer(c_int), intent(inout) :: patch(:)              !! number of the patch

        associate (strips => handle%workspace%strips, n => size(patch))
            y_left = strips%y_left(:n)
            y_right = strips%y_right(:n)
            half_length = strips%half_length(:n)
            p0 = strips%p0(:n)
            patch = strips%patch(:n)
        end associate
    end subroutine read_strips

    !> Copy the first elements of the last contact, as many as the arrays are long, at least one.
    pure subroutine read_elements(handle, x, y, area, pn, px, py, sx, sy, state)
        type(handle_t), intent(in) :: handle         !! with so many elements
        real(c_double), intent(inout) :: x(:), y(:)  !! middle of the element, mm
        real(c_double), intent(inout) :: area(:)     !! mm^2
        real(c_double), intent(inout) :: pn(:)       !! pressure, MPa
        real(c_double), intent(inout) :: px(:), py(:) !! traction on the rail, MPa
        real(c_double), intent(inout) :: sx(:), sy(:) !! slip over rolling speed
        integer(c_int), intent(inout) :: state(:)    !! 1 adhesion, 2 slip

        associate (field => handle%workspace%field, n => size(state))
            x = field%x(:n)
            y = field%y(:n)
            area = field%area(:n)
            pn = field%pn(:n)
            px = field%px(:n)
            py = field%py(:n)
            sx = field%sx(:n)
            sy = field%sy(:n)
            state = field%state(:n)
        end associate
    end subroutine read_elements
end module faststrip_interop_flat
