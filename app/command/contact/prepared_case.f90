!> From a case to the gap, load and creepages of one contact.
module faststrip_command_contact_prepared_case
    use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
    use faststrip_base_kinds, only: wp
    use faststrip_base_limits, only: rounding
    use faststrip_base_status, only: status_t, clear_status, is_error, number_text
    use faststrip_base_creepage, only: creepage_t
    use faststrip_base_friction, only: friction_at_angle
    use faststrip_files_csv, only: csv_writer_t, put_comment, put_header, put_cell, put_cells, &
                                   end_row
    use faststrip_geometry_profile, only: profile_t, profile_at
    use faststrip_geometry_gap_curve, only: gap_curve_t
    use faststrip_files_gap, only: read_gap_file
    use faststrip_geometry_rigid_contact, only: rigid_contact_t, find_rigid_contacts, &
                                                contact_force, shift_creepage
    use faststrip_geometry_undeformed_gap, only: make_gap
    use faststrip_contact_case, only: contact_case_t
    use faststrip_command_program_console, only: put_origin
    use faststrip_command_settings_case_file, only: case_t
    implicit none
    private

    public :: prepared_case_t, prepare_case, take_lists, put_gap, put_profiles

    !> One contact, ready to be solved: gap, normal force, creepages about the rigid contact point.
    type, extends(contact_case_t) :: prepared_case_t
        type(rigid_contact_t) :: rigid_contact !! first point of contact, if there are profiles
        real(wp) :: shift = 0.0_wp             !! lateral shift of the wheelset, mm
        integer :: listed = 0                  !! number in the lists whose values count, 0: none
    end type prepared_case_t

contains

    !> Shift the wheelset and make the gap, or read it. A shift the case's sweep lists gets the
    !> load and the creepages listed with it.
    subroutine prepare_case(case, shift, listed, prepared, status)
        type(case_t), intent(in) :: case               !! a case that was read
        real(wp), intent(in) :: shift                  !! lateral shift, unused with a gap file, mm
        integer, intent(in) :: listed                  !! number of it in the lists, 0: the first
                                                       !! one that is as large, if there is any
        type(prepared_case_t), intent(out) :: prepared !! ready to be solved
        type(status_t), intent(out) :: status          !! from the library

        type(rigid_contact_t) :: left

        call clear_status(status)
        prepared%shift = shift
        prepared%listed = listed
        if (listed == 0) &
            prepared%listed = findloc(abs(case%shifts - shift) < rounding, .true., dim=1)
        prepared%contact_case_t = case%contact_case_t
        if (len(case%gap_file) > 0) then
            call read_gap_file(case%gap_file, prepared%gap, status)
            return
        end if
        associate (bodies => case%bodies)
            call find_rigid_contacts(bodies%wheel%profile, bodies%rail%profile, bodies%wheelset, &
                                     bodies%track, shift, prepared%rigid_contact, left, status)
        end associate
        if (is_error(status)) then
            call clear_rigid_contact(case, prepared)
            return
        end if
        prepared%mu = friction_at_angle(case%friction, case%mu, prepared%rigid_contact%gamma)
        prepared%friction%table%y_rail = prepared%rigid_contact%y_rail
        prepared%friction%table%angle = prepared%rigid_contact%gamma
        if (case%load_is_vertical) &
            prepared%load = contact_force(case%load, prepared%rigid_contact%gamma)
        if (case%creepage_by_formula) prepared%creepage = &
            shift_creepage(case%bodies%wheelset, prepared%rigid_contact, left, case%creepage_signs)
        ! In place of those by formula a force is given.
        if (case%given%is_given(1)) prepared%creepage%cksi = 0.0_wp
        if (case%given%is_given(2)) prepared%creepage%ceta = 0.0_wp
        call take_lists(case, prepared)
        call make_gap(case%bodies%wheel%profile, case%bodies%rail%profile, case%bodies%wheelset, &
                      prepared%rigid_contact, case%gap_step, case%gap_height, prepared%gap, status)
    end subroutine prepare_case

    !> Load and creepages that the sweep of the case lists for this shift.
    subroutine take_lists(case, prepared)
        type(case_t), intent(in) :: case                 !! that was read
        type(prepared_case_t), intent(inout) :: prepared !! with its shift

        associate (i => prepared%listed)
            if (i == 0) return
            if (size(case%shift_loads) > 0) prepared%load = case%shift_loads(i)
            if (size(case%shift_cksi) > 0) prepared%creepage = creepage_t( &
                case%shift_cksi(i), case%shift_ceta(i), case%shift_cphi(i))
        end associate
    end subroutine take_lists

    !> Without a contact point there is no contact angle, nor what follows from one.
    subroutine clear_rigid_contact(case, prepared)
        type(case_t), intent(in) :: case
        type(prepared_case_t), intent(inout) :: prepared

        real(wp) :: unknown

        unknown = ieee_value(unknown, ieee_quiet_nan)
        prepared%rigid_contact%gamma = unknown
        if (case%load_is_vertical) prepared%load = unknown
        if (case%creepage_by_formula) prepared%creepage = creepage_t(unknown, unknown, unknown)
    end subroutine clear_rigid_contact

    !> The gap, one row a point.
    subroutine put_gap(writer, gap, smoothing, curved)
        type(csv_writer_t), intent(inout) :: writer !! an open file
        type(gap_curve_t), intent(in) :: gap        !! as it was solved, mm, mm, 1/mm, rad
        real(wp), intent(in) :: smoothing           !! noise it was smoothed for, mm; 0: it was not
        logical, intent(in) :: curved               !! with the inclination of its surfaces?

        character(len=15), parameter :: names(4) = [character(len=15) :: &
            'y_mm', 'h_mm', 'inv2R_per_mm', 'inclination_rad']
        integer :: i, columns

        call put_origin(writer)
        ! Given: um.
        if (smoothing > 0.0_wp) &
            call put_comment(writer, 'smoothed for a noise of ' // &
                             trim(number_text(1.0e3_wp*smoothing)) // ' um, rms')
        columns = merge(4, 3, curved)
        call put_header(writer, names(:columns))
        do i = 1, gap%n
            call put_cells(writer, [gap%y(i), gap%h(i), gap%inv2r(i)])
            if (curved) call put_cell(writer, gap%inclination(i))
            call end_row(writer)
        end do
    end subroutine put_gap

    !> Both profiles in contact, in the frame of the rail, one row a point.
    subroutine put_profiles(writer, case, prepared)
        type(csv_writer_t), intent(inout) :: writer   !! an open file
        type(case_t), intent(in) :: case              !! with profiles
        type(prepared_case_t), intent(in) :: prepared !! where they touch

        call put_origin(writer)
        call put_header(writer, [character(len=4) :: 'body', 'y_mm', 'z_mm'])
        call put_profile(writer, 'wheel', case%bodies%wheel%profile, &
                         prepared%rigid_contact%y_rail - prepared%rigid_contact%y_wheel, &
                         prepared%rigid_contact%z_rail - prepared%rigid_contact%z_wheel)
        call put_profile(writer, 'rail', case%bodies%rail%profile, 0.0_wp, 0.0_wp)
    end subroutine put_profiles

    subroutine put_profile(writer, name, profile, y_offset, z_offset)
        type(csv_writer_t), intent(inout) :: writer
        character(len=*), intent(in) :: name
        type(profile_t), intent(in) :: profile
        real(wp), intent(in) :: y_offset, z_offset

        ! Tuned [points]: of a profile that is drawn. Origin: chosen.
        integer, parameter :: n_points = 801
        type(status_t) :: status
        real(wp) :: y, z, dz, d2z
        integer :: i

        do i = 0, n_points - 1
            y = profile%y_first + (profile%y_last - profile%y_first)*i/(n_points - 1)
            call profile_at(profile, y, z, dz, d2z, status)
            if (is_error(status)) cycle
            call put_cell(writer, name)
            call put_cells(writer, [y + y_offset, z + z_offset])
            call end_row(writer)
        end do
    end subroutine put_profile
end module faststrip_command_contact_prepared_case
