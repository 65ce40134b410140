!> The rows of the F77 interface, as `faststrip_interop_f77` lists them, and what they are in
!> Fortran: nowhere else is it said which place is which component.
module faststrip_interop_f77_rows
    use, intrinsic :: iso_c_binding, only: c_int, c_double
    use faststrip_base_creepage, only: creepage_t
    use faststrip_base_friction, only: friction_t
    use faststrip_base_material, only: material_t
    use faststrip_base_kinds, only: wp
    use faststrip_contact_case, only: contact_case_t
    use faststrip_contact_figures, only: figure_area, figure_est_err_area, figure_est_err_fx, &
                                         figure_est_err_fy, figure_est_err_mz, &
                                         figure_est_err_penetration, figure_est_err_pmax, &
                                         figure_friction_power, figure_fx, figure_fy, figure_load, &
                                         figure_mz, figure_n_patches, figure_overlap_outside, &
                                         figure_penetration, figure_pmax, figure_residual_inside, &
                                         figure_stick_fraction, figure_strips_across, &
                                         figure_x_max, figure_y_max, figure_y_min, n_figures
    use faststrip_contact_figure_values, only: find_figures
    use faststrip_contact_methods, only: contact_methods_t
    use faststrip_contact_wanted, only: unknown_error
    use faststrip_interop_handle, only: handle_t
    implicit none
    private

    public :: n_iopt, n_par, n_res, n_err, n_ferr, n_takn, n_fric
    public :: default_rows, methods_of, fill_case, fill_friction
    public :: res_of, err_of, ferr_of, takn_of

    !> Lengths of the rows.
    !> Given: by the interface.
    integer, parameter :: n_iopt = 9, n_par = 9, n_res = 14, n_err = 7, n_ferr = 4, n_takn = 5, &
                          n_fric = 8

    !> Figures of the rows, place by place: the first of RES, ERR and FERR.
    integer, parameter :: res_figures(13) = [ &
        figure_load, figure_penetration, figure_area, figure_pmax, figure_y_min, figure_y_max, &
        figure_x_max, figure_fx, figure_fy, figure_mz, figure_friction_power, &
        figure_stick_fraction, figure_n_patches]
    integer, parameter :: err_figures(5) = [ &
        figure_est_err_penetration, figure_est_err_pmax, figure_est_err_area, &
        figure_residual_inside, figure_overlap_outside]
    integer, parameter :: ferr_figures(3) = [ &
        figure_est_err_fx, figure_est_err_fy, figure_est_err_mz]

contains

    !> Steel on steel, the methods of the project and nothing to solve.
    pure subroutine default_rows(iopt, par)
        integer(c_int), intent(out) :: iopt(n_iopt) !! choices
        real(c_double), intent(out) :: par(n_par)   !! numbers

        type(contact_case_t) :: case

        associate (methods => case%methods, material => case%material, creepage => case%creepage)
            iopt = [methods%normal, methods%tangential, methods%strips_per_patch, &
                    methods%points_per_strip, methods%fastsim_nx, methods%fastsim_ny, &
                    merge(1, 0, case%by_load), merge(1, 0, case%warm_start), 0]
            par = [material%e_wheel, material%e_rail, material%nu_wheel, material%nu_rail, &
                   case%mu, case%load, creepage%cksi, creepage%ceta, creepage%cphi]
        end associate
    end subroutine default_rows

    !> Methods and resolutions.
    pure type(contact_methods_t) function methods_of(iopt) result(methods)
        integer(c_int), intent(in) :: iopt(n_iopt) !! as the caller has them

        methods = contact_methods_t(iopt(1), iopt(2), iopt(3), iopt(4), iopt(5), iopt(6))
    end function methods_of

    !> All of a case but its gap, friction beside mu, how errors are estimated and what is wanted of
    !> auto, which stay.
    pure subroutine fill_case(iopt, par, case)
        integer(c_int), intent(in) :: iopt(n_iopt)  !! choices
        real(c_double), intent(in) :: par(n_par)    !! numbers
        type(contact_case_t), intent(inout) :: case !! not yet checked

        case%methods = methods_of(iopt)
        case%by_load = iopt(7) /= 0
        case%warm_start = iopt(8) /= 0
        case%asked%field = iopt(9) /= 0
        case%material = material_t(par(1), par(2), par(3), par(4))
        case%mu = par(5)
        case%load = par(6)
        case%penetration = par(6)
        case%creepage = creepage_t(par(7), par(8), par(9))
    end subroutine fill_case

    !> Friction beside mu, and the contact angle.
    pure subroutine fill_friction(kind, fric, friction, contact_angle)
        integer(c_int), intent(in) :: kind           !! as the caller has it
        real(c_double), intent(in) :: fric(n_fric)   !! the same
        type(friction_t), intent(inout) :: friction  !! not yet checked; what is hot stays
        real(c_double), intent(out) :: contact_angle !! rad; of a contact alone

        friction = friction_t(kind, fric(1), fric(2), fric(3), fric(4), fric(5), fric(6), fric(7), &
                              friction%hot_share, friction%cold_temperature, &
                              friction%hot_temperature)
        contact_angle = fric(8)
    end subroutine fill_friction

    !> The figures of the last contact.
    pure function res_of(handle) result(res)
        type(handle_t), intent(in) :: handle !! after a solution
        real(c_double) :: res(n_res)

        real(wp) :: values(n_figures)
        logical :: known(n_figures)

        call find_figures(handle%result, values, known)
        res = [values(res_figures), real(merge(handle%workspace%strips%n, 0, &
                                               handle%result%normal%n_patches > 0), c_double)]
    end function res_of

    !> The estimated errors of the last contact; zeros if there was none.
    pure function err_of(handle) result(err)
        type(handle_t), intent(in) :: handle !! after a solution
        real(c_double) :: err(n_err)

        real(wp) :: values(n_figures)
        logical :: known(n_figures)

        call find_figures(handle%result, values, known)
        err = [values(err_figures), merge(1.0_c_double, 0.0_c_double, &
                                          handle%result%is_estimated), &
               values(figure_strips_across)]
    end function err_of

    !> The estimated errors of the last contact's forces; zeros if they are not known.
    pure function ferr_of(handle) result(ferr)
        type(handle_t), intent(in) :: handle !! after a solution
        real(c_double) :: ferr(n_ferr)

        real(wp) :: values(n_figures)
        logical :: known(n_figures)

        call find_figures(handle%result, values, known)
        ferr = [values(ferr_figures), merge(1.0_c_double, 0.0_c_double, &
                                            handle%result%forces_are_estimated)]
    end function ferr_of

    !> What came of the last contact by auto; zeros if there was none.
    pure function takn_of(handle) result(takn)
        type(handle_t), intent(in) :: handle !! after a solution
        real(c_double) :: takn(n_takn)

        associate (last => handle%workspace%steps)
            takn = [real(last%n, c_double), real(last%best, c_double), &
                    merge(last%estimate, 0.0_c_double, last%estimate < unknown_error), &
                    merge(1.0_c_double, 0.0_c_double, last%estimate < unknown_error), &
                    merge(1.0_c_double, 0.0_c_double, last%is_met)]
        end associate
    end function takn_of
end module faststrip_interop_f77_rows
