!> The points of standard profiles, by their names.
module faststrip_files_profile_standard
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error
    use faststrip_geometry_arc_spline, only: standard_kink_angle
    use faststrip_geometry_cleaning, only: resample
    use faststrip_geometry_profile, only: profile_t, make_wheel_profile, make_rail_profile, &
                                          profile_at
    use faststrip_files_profile, only: profile_file_t, body_wheel, body_rail
    implicit none
    private

    public :: standard_profile

    ! Tuned [points]: along y, before they are spread out. Origin: chosen.
    integer, parameter :: many = 4001
    ! Tuned [mm]: distance of the points along the arc. Origin: chosen.
    real(wp), parameter :: step = 0.2_wp

contains

    !> The points of a standard profile, as if they were read from a file.
    subroutine standard_profile(name, points, is_one)
        character(len=*), intent(in) :: name       !! as of `&wheel` or `&rail`
        type(profile_file_t), intent(inout) :: points !! not changed unless it is one
        logical, intent(out) :: is_one             !! is it the name of a standard profile?

        type(profile_t) :: profile
        type(status_t) :: status
        real(wp) :: dz, d2z
        integer :: kind, i

        kind = body_wheel
        call make_wheel_profile(name, profile, status)
        if (is_error(status)) then
            kind = body_rail
            call make_rail_profile(name, 0.0_wp, profile, status)
        end if
        is_one = .not. is_error(status)
        if (.not. is_one) return
        points = profile_file_t(format='standard', kind=kind, &
                                y=[(profile%y_first + (profile%y_last - profile%y_first)*(i - 1) &
                                    /(many - 1), i=1, many)])
        allocate (points%z(many), points%line(0), points%keys(0))
        do i = 1, many
            call profile_at(profile, points%y(i), points%z(i), dz, d2z, status)
        end do
        call resample(points%y, points%z, step, standard_kink_angle, status)
    end subroutine standard_profile
end module faststrip_files_profile_standard
