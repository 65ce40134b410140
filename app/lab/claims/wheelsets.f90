!> Random contacts of real profiles, on which claims are judged: S1002 wheels, new or worn, on
!> UIC60 and 60E1 rails of several inclinations, wheels of several sizes, gauges and shifts.
module faststrip_lab_claims_wheelsets
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error
    use faststrip_base_creepage, only: creepage_t
    use faststrip_geometry_gap, only: gap_t
    use faststrip_geometry_profile, only: profile_t, make_wheel_profile, make_rail_profile, &
                                          make_points_profile, profile_at
    use faststrip_geometry_rigid_contact, only: wheelset_t, track_t, rigid_contact_t, &
                                                find_rigid_contacts, shift_creepage, &
                                                creepage_set_b
    use faststrip_geometry_undeformed_gap, only: make_gap, standard_gap_height, standard_gap_step
    use faststrip_lab_random_numbers, only: random_t, uniform, chance
    implicit none
    private

    public :: draw_wheelset_gap

    ! A worn wheel is known at points, mm.
    real(wp), parameter :: worn_first = -50.0_wp, worn_step = 0.5_wp
    integer, parameter :: worn_points = 191
    ! Contact angles beyond are those of a flange that climbs, rad.
    real(wp), parameter :: steepest = 1.0_wp

contains

    !> Draw until wheel and rail touch.
    subroutine draw_wheelset_gap(random, is_worn, gap, creepage)
        type(random_t), intent(inout) :: random
        logical, intent(in) :: is_worn         !! or as new?
        type(gap_t), intent(out) :: gap        !! mm, mm, 1/mm
        type(creepage_t), intent(out) :: creepage
            !! of the shifted wheelset, with an angle of attack, now and then braked

        type(profile_t) :: wheel, rail
        type(wheelset_t) :: wheelset
        type(track_t) :: track
        type(rigid_contact_t) :: right, left
        type(status_t) :: status
        real(wp) :: cant, shift
        logical :: is_uic60

        do
            is_uic60 = chance(random, 0.5_wp)
            cant = uniform(random, 0.0_wp, 0.06_wp)
            wheelset%radius = uniform(random, 300.0_wp, 625.0_wp)
            track%gauge = uniform(random, 1431.0_wp, 1441.0_wp)
            shift = uniform(random, -8.0_wp, 8.0_wp)
            call make_rail_profile(trim(merge('uic60', '60e1 ', is_uic60)), cant, rail, status)
            if (is_error(status)) cycle
            if (is_worn) then
                call draw_worn_wheel(random, wheel, status)
            else
                call make_wheel_profile('s1002', wheel, status)
            end if
            if (is_error(status)) cycle
            call find_rigid_contacts(wheel, rail, wheelset, track, shift, right, left, status)
            if (is_error(status)) cycle
            if (abs(right%gamma) > steepest) cycle
            call make_gap(wheel, rail, wheelset, right, standard_gap_step, standard_gap_height, &
                          gap, status)
            if (.not. is_error(status)) exit
        end do
        creepage = shift_creepage(wheelset, right, left, creepage_set_b)
        creepage%ceta = uniform(random, -4.0e-3_wp, 4.0e-3_wp)
        if (chance(random, 0.3_wp)) creepage%ceta = 0.0_wp
        if (chance(random, 0.3_wp)) &
            creepage%cksi = creepage%cksi + uniform(random, -5.0e-3_wp, 5.0e-3_wp)
    end subroutine draw_wheelset_gap

    !> S1002 with a hollow of the tread and some wear of the flange's root.
    subroutine draw_worn_wheel(random, wheel, status)
        type(random_t), intent(inout) :: random
        type(profile_t), intent(out) :: wheel
        type(status_t), intent(out) :: status

        type(profile_t) :: new
        real(wp), dimension(worn_points) :: y, z
        real(wp) :: place, width, depth, root, dz, d2z
        integer :: i

        call make_wheel_profile('s1002', new, status)
        if (is_error(status)) return
        depth = uniform(random, 0.1_wp, 2.0_wp)
        place = uniform(random, -8.0_wp, 12.0_wp)
        width = uniform(random, 12.0_wp, 25.0_wp)
        root = uniform(random, 0.0_wp, 1.0_wp)
        do i = 1, worn_points
            y(i) = worn_first + worn_step*(i - 1)
            call profile_at(new, y(i), z(i), dz, d2z, status)
            if (is_error(status)) return
            z(i) = z(i) - depth*exp(-((y(i) - place)/width)**2) &
                   - root*exp(-((y(i) + 36.0_wp)/6.0_wp)**2)
        end do
        call make_points_profile(y, z, 0.0_wp, wheel, status)
    end subroutine draw_worn_wheel
end module faststrip_lab_claims_wheelsets
