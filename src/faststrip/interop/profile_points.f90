!> From a wheel and a rail to the gap of their contact, for hosts: what the command line does with
!> profiles, guarded as the other calls without a workspace.
module faststrip_interop_profile_points
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, set_status, is_error, st_bad_argument, &
                                     st_workspace_too_small
    use faststrip_numerics_environment, only: environment_t, hold_environment, restore_environment
    use faststrip_geometry_gap, only: gap_t
    use faststrip_geometry_gauge_fit, only: find_back_spacing
    use faststrip_geometry_profile, only: profile_t, profile_at
    use faststrip_geometry_rigid_contact, only: wheelset_t, track_t, rigid_contact_t, &
                                                find_rigid_contact
    use faststrip_geometry_touchable, only: body_wheel, body_rail
    use faststrip_geometry_undeformed_gap, only: make_gap
    use faststrip_interop_wheelset_new, only: profile_source_t, make_profile
    implicit none
    private

    public :: gap_of_points, gap_of_profiles, copy_gap, draw_profile, n_setup, n_contact

    !> Numbers of the setup and of the contact.
    !> Given: lengths of the lists below.
    integer, parameter :: n_setup = 9, n_contact = 6

contains

    !> The gap of a wheel on a rail, both given by points along the curve, y to the field side, z
    !> down, of the wheel from the nominal rolling circle.
    subroutine gap_of_points(y_wheel, z_wheel, y_rail, z_rail, setup, gap, contact, status, &
                             roller_radius)
        real(wp), intent(in), target :: y_wheel(:), z_wheel(:) !! mm
        real(wp), intent(in), target :: y_rail(:), z_rail(:)   !! mm
        real(wp), intent(in) :: setup(n_setup)         !! as `gap_of_profiles`
        type(gap_t), intent(out) :: gap                !! mm, mm, 1/mm, rad
        real(wp), intent(inout) :: contact(n_contact)  !! as `gap_of_profiles`
        type(status_t), intent(out) :: status          !! those of `gap_of_profiles`
        real(wp), intent(in), optional :: roller_radius !! of a roller in the rail's place, mm

        call gap_of_profiles(profile_source_t(y=y_wheel, z=z_wheel), &
                             profile_source_t(y=y_rail, z=z_rail), setup, gap, contact, status, &
                             roller_radius)
    end subroutine gap_of_points

    !> The gap of a wheel on a rail, given by names or by points.
    subroutine gap_of_profiles(of_wheel, of_rail, setup, gap, contact, status, roller_radius)
        type(profile_source_t), intent(in) :: of_wheel !! as a right one
        type(profile_source_t), intent(in) :: of_rail  !! as a right one
        real(wp), intent(in) :: setup(n_setup)
            !! distance of the flange backs (0: as belongs to the gauge), flange back to nominal
            !! rolling circle, nominal radius, gauge, its depth below the crown, rail inclination,
            !! its tangent, or `unset_inclination`, shift to the right, spacing and height of the
            !! gap, lengths in mm
        type(gap_t), intent(out) :: gap                !! mm, mm, 1/mm, rad
        real(wp), intent(inout) :: contact(n_contact)
            !! contact angle, rad; rolling radius there, mm; y on the wheel and on the rail, mm;
            !! points that were left out of the wheel and of the rail
        type(status_t), intent(out) :: status
            !! those of `make_profile`, `find_rigid_contact`, `make_gap`
        real(wp), intent(in), optional :: roller_radius
            !! of a roller in the rail's place, at the crown, mm; 0: a rail

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
            type(wheelset_t) :: wheelset
            type(track_t) :: track
            type(rigid_contact_t) :: rigid
            integer :: n_out(2)

            call make_profile(of_wheel, body_wheel, 0.0_wp, wheel, n_out(1), status)
            if (is_error(status)) return
            call make_profile(of_rail, body_rail, setup(6), rail, n_out(2), status)
            if (is_error(status)) return
            contact(5:6) = n_out
            wheelset = wheelset_t(setup(1), setup(2), setup(3))
            if (.not. abs(setup(1)) > 0.0_wp) &
                call find_back_spacing(setup(4), 0.0_wp, wheelset%back_spacing, status)
            if (is_error(status)) return
            track = track_t(setup(4), setup(5))
            if (present(roller_radius)) track%roller_radius = roller_radius
            call find_rigid_contact(wheel, rail, wheelset, track, setup(7), rigid, status)
            if (is_error(status)) return
            contact(:4) = [rigid%gamma, rigid%radius, rigid%y_wheel, rigid%y_rail]
            call make_gap(wheel, rail, wheelset, rigid, setup(8), setup(9), gap, status)
        end subroutine solve_geometry
    end subroutine gap_of_profiles

    !> Points of a profile at equal distances of y, from end to end of what can be touched.
    subroutine draw_profile(source, body, inclination, y, z, status)
        type(profile_source_t), intent(in) :: source !! as a right one
        integer, intent(in) :: body                  !! `body_wheel`, `body_rail`
        real(wp), intent(in) :: inclination          !! of a rail, its tangent, or
                                                     !! `unset_inclination`; of a wheel 0
        real(wp), intent(inout) :: y(:)              !! to the field side, mm; at least two
        real(wp), intent(inout) :: z(:)              !! down, mm
        type(status_t), intent(out) :: status        !! `st_bad_argument`; those of `make_profile`

        type(environment_t) :: environment
        type(profile_t) :: profile
        real(wp) :: dz, d2z
        integer :: i, n, n_out

        n = size(y)
        if (n < 2) then
            call set_status(status, st_bad_argument, 'a profile must be drawn by at least 2 points')
            return
        end if
        call hold_environment(environment)
        call make_profile(source, body, inclination, profile, n_out, status)
        do i = 1, n
            if (is_error(status)) exit
            y(i) = profile%y_first + (profile%y_last - profile%y_first)*real(i - 1, wp) &
                   /real(n - 1, wp)
            y(i) = min(y(i), profile%y_last)
            call profile_at(profile, y(i), z(i), dz, d2z, status)
        end do
        call restore_environment(environment)
    end subroutine draw_profile

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
