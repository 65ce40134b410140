!> From the points of a wheel and a rail to the gap of their contact, for hosts: what the command
!> line does with profile files, guarded as the other calls without a workspace.
module faststrip_interop_profile_points
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, set_status, is_error, st_bad_argument, &
                                     st_workspace_too_small
    use faststrip_numerics_environment, only: environment_t, hold_environment, restore_environment
    use faststrip_geometry_arc_spline, only: standard_kink_angle
    use faststrip_geometry_gap, only: gap_t
    use faststrip_geometry_profile, only: profile_t, make_curve_profile
    use faststrip_geometry_rigid_contact, only: wheelset_t, track_t, rigid_contact_t, &
                                                find_rigid_contact
    use faststrip_geometry_touchable, only: touchable_t, body_wheel, body_rail
    use faststrip_geometry_undeformed_gap, only: make_gap
    implicit none
    private

    public :: gap_of_points, copy_gap, n_setup, n_contact

    !> Numbers of the setup and of the contact.
    !> Given: lengths of the lists below.
    integer, parameter :: n_setup = 9, n_contact = 6

contains

    !> The gap of a wheel on a rail, both given by points along the curve, y to the field side, z
    !> down, of the wheel from the tape circle.
    subroutine gap_of_points(y_wheel, z_wheel, y_rail, z_rail, setup, gap, contact, status)
        real(wp), intent(in) :: y_wheel(:), z_wheel(:) !! mm
        real(wp), intent(in) :: y_rail(:), z_rail(:)   !! mm
        real(wp), intent(in) :: setup(n_setup)
            !! distance of the flange backs, flange back to tape circle, rolling radius, gauge, its
            !! depth below the crown, tangent of the cant, shift to the right, spacing of the gap,
            !! its height: mm, but for the cant
        type(gap_t), intent(out) :: gap                !! mm, mm, 1/mm, rad
        real(wp), intent(inout) :: contact(n_contact)
            !! contact angle, rad; rolling radius there, mm; y on the wheel and on the rail, mm;
            !! points that were left out of the wheel and of the rail
        type(status_t), intent(out) :: status
            !! those of `make_curve_profile`, `find_rigid_contact`, `make_gap`

        type(environment_t) :: environment

        call hold_environment(environment)
        contact = 0.0_wp
        if (all(ieee_is_finite(setup))) then
            call solve_geometry()
        else
            call set_status(status, st_bad_argument, 'the setup must be finite numbers')
        end if
        call restore_environment(environment)

    contains

        subroutine solve_geometry()
            type(profile_t) :: wheel, rail
            type(touchable_t) :: part
            type(wheelset_t) :: wheelset
            type(rigid_contact_t) :: rigid

            call make_curve_profile(y_wheel, z_wheel, body_wheel, 0.0_wp, standard_kink_angle, &
                                    wheel, part, status)
            if (is_error(status)) return
            contact(5) = size(y_wheel) - size(part%point)
            call make_curve_profile(y_rail, z_rail, body_rail, setup(6), standard_kink_angle, &
                                    rail, part, status)
            if (is_error(status)) return
            contact(6) = size(y_rail) - size(part%point)
            wheelset = wheelset_t(setup(1), setup(2), setup(3))
            call find_rigid_contact(wheel, rail, wheelset, track_t(setup(4), setup(5)), setup(7), &
                                    rigid, status)
            if (is_error(status)) return
            contact(:4) = [rigid%gamma, rigid%radius, rigid%y_wheel, rigid%y_rail]
            call make_gap(wheel, rail, wheelset, rigid, setup(8), setup(9), gap, status)
        end subroutine solve_geometry
    end subroutine gap_of_points

    !> A gap into a host's arrays.
    subroutine copy_gap(gap, y, h, inv2r, inclination, n, status)
        type(gap_t), intent(in) :: gap                !! of `gap_of_points`, if it was well
        real(wp), intent(inout) :: y(:), h(:)         !! mm, written up to n
        real(wp), intent(inout) :: inv2r(:)           !! 1/mm
        real(wp), intent(inout) :: inclination(:)     !! rad
        integer, intent(out) :: n                     !! points of the gap
        type(status_t), intent(inout) :: status       !! of `gap_of_points`;
                                                      !! `st_workspace_too_small`: nothing written

        n = 0
        if (is_error(status)) return
        n = size(gap%y)
        if (n > min(size(y), size(h), size(inv2r), size(inclination))) then
            call set_status(status, st_workspace_too_small, 'the gap has more points than the ' &
                            //'arrays')
            return
        end if
        y(:n) = gap%y
        h(:n) = gap%h
        inv2r(:n) = gap%inv2r
        inclination(:n) = gap%inclination
    end subroutine copy_gap
end module faststrip_interop_profile_points
