!> The gaps of the paper's wheelset, S1002 on UIC60, at any shift.
module faststrip_lab_grid_paper_gaps
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t
    use faststrip_geometry_gap, only: gap_t
    use faststrip_geometry_profile, only: profile_t, make_wheel_profile, make_rail_profile, &
                                          standard_inclination
    use faststrip_geometry_rigid_contact, only: wheelset_t, track_t, rigid_contact_t, &
                                                find_rigid_contact
    use faststrip_geometry_undeformed_gap, only: make_gap, standard_gap_step, standard_gap_height
    use faststrip_command_program_console, only: fail_on_error
    implicit none
    private

    public :: paper_profiles_t, make_paper_profiles, gap_of_shift

    !> The profiles.
    type :: paper_profiles_t
        type(profile_t) :: wheel
        type(profile_t) :: rail
    end type paper_profiles_t

contains

    !> Make the profiles.
    subroutine make_paper_profiles(profiles)
        type(paper_profiles_t), intent(out) :: profiles !! the rail's inclined as usual

        type(status_t) :: status

        call make_wheel_profile('s1002', profiles%wheel, status)
        call fail_on_error(status)
        call make_rail_profile('uic60', standard_inclination, profiles%rail, status)
        call fail_on_error(status)
    end subroutine make_paper_profiles

    !> The gap of a wheelset that was moved sideways.
    subroutine gap_of_shift(profiles, shift, gap)
        type(paper_profiles_t), intent(in) :: profiles !! made
        real(wp), intent(in) :: shift                  !! lateral shift, mm
        type(gap_t), intent(out) :: gap                !! at the rigid contact, mm

        type(rigid_contact_t) :: touching
        type(status_t) :: status

        call find_rigid_contact(profiles%wheel, profiles%rail, wheelset_t(), track_t(), shift, &
                                touching, status)
        call fail_on_error(status)
        call make_gap(profiles%wheel, profiles%rail, wheelset_t(), touching, standard_gap_step, &
                      standard_gap_height, gap, status)
        call fail_on_error(status)
    end subroutine gap_of_shift
end module faststrip_lab_grid_paper_gaps
