!> Do the points of two profiles resolve their contact? It is solved again, by strips and FASTSTRIP,
!> with every second point of the profiles that came from files, twice: from the first and from the
!> second on. Where pressures or forces change by more than a limit they hang on single points, as
!> at a kink, a dent or noise in the contact.
module faststrip_command_contact_point_spacing
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error, add_limitation, number_text, &
                                     st_under_resolved
    use faststrip_geometry_profile, only: thin_profile, profile_curve
    use faststrip_normal_limitations, only: default_resolution
    use faststrip_contact_methods, only: normal_strip, tangential_faststrip
    use faststrip_command_settings_case_file, only: case_t
    use faststrip_contact_case, only: asked_t
    use faststrip_contact_method, only: contact_result_t
    use faststrip_contact_wanted, only: usual_tolerance
    use faststrip_command_contact_prepared_case, only: prepared_case_t, prepare_case
    use faststrip_command_contact_solver, only: solver_t, new_solver, free_solver, solve
    implicit none
    private

    public :: point_spacing_t, judge_spacing, name_spacing

    ! Changes that are named: of pmax half of the error that is, of forces over mu N half of that
    ! which auto is asked for.
    real(wp), parameter :: pmax_limit = 0.5_wp*default_resolution, &
                           force_limit = 0.5_wp*usual_tolerance

    ! Given: the unit.
    real(wp), parameter :: percent = 100.0_wp

    !> What every second point changes.
    type :: point_spacing_t
        logical :: is_known = .false.    !! are there points, and a contact?
        logical :: is_solved = .true.    !! has the contact a solution without them?
        logical :: is_there = .true.     !! is it there then?
        real(wp) :: pmax = 0.0_wp        !! largest relative change of pmax
        real(wp) :: forces = 0.0_wp      !! largest change of the forces over mu N
    end type point_spacing_t

contains

    !> Solve a contact again with every second point of its profiles.
    subroutine judge_spacing(case, prepared, spacing)
        type(case_t), intent(in) :: case               !! with profiles, or a gap file
        type(prepared_case_t), intent(in) :: prepared  !! one contact of it
        type(point_spacing_t), intent(out) :: spacing  !! not known for standard profiles and gaps

        type(case_t) :: thinned
        type(prepared_case_t) :: contact
        type(prepared_case_t) :: whole
        type(solver_t), pointer :: solver
        type(contact_result_t) :: given, result
        type(status_t) :: status
        integer :: first

        if (len(case%gap_file) > 0) return
        if (all([case%bodies%wheel%profile%kind, case%bodies%rail%profile%kind] &
                /= profile_curve)) return
        whole = prepared
        call choose(whole)
        call new_solver(solver, status)
        if (.not. is_error(status)) call solve(solver, whole, given, status)
        if (.not. is_error(status)) then
            spacing%is_known = .true.
            thinned = case
            do first = 1, 2
                call thin_profile(case%bodies%wheel%profile, first, &
                                  thinned%bodies%wheel%profile, status)
                if (.not. is_error(status)) &
                    call thin_profile(case%bodies%rail%profile, first, &
                                      thinned%bodies%rail%profile, status)
                if (.not. is_error(status)) &
                    call prepare_case(thinned, prepared%shift, prepared%listed, contact, status)
                call choose(contact)
                if (.not. is_error(status)) call solve(solver, contact, result, status)
                if (is_error(status)) then
                    spacing%is_solved = .false.
                else
                    call compare(prepared, given, result, spacing)
                end if
            end do
        end if
        call free_solver(solver)
    end subroutine judge_spacing

    ! Strips and FASTSTRIP, and nothing else.
    subroutine choose(contact)
        type(prepared_case_t), intent(inout) :: contact

        contact%methods%normal = normal_strip
        contact%methods%tangential = tangential_faststrip
        contact%asked = asked_t()
        contact%estimate = .false.
        contact%wear_law%n = 0
    end subroutine choose

    subroutine compare(prepared, given, result, spacing)
        type(prepared_case_t), intent(in) :: prepared
        type(contact_result_t), intent(in) :: given, result
        type(point_spacing_t), intent(inout) :: spacing

        real(wp) :: change

        spacing%pmax = max(spacing%pmax, abs(result%normal%pmax - given%normal%pmax) &
                           /given%normal%pmax)
        change = hypot(result%tangential%fx - given%tangential%fx, &
                       result%tangential%fy - given%tangential%fy) &
                 /(prepared%mu*given%normal%load)
        if (ieee_is_finite(change)) spacing%forces = max(spacing%forces, change)
    end subroutine compare

    !> Add to a status that the points do not resolve the contact.
    subroutine name_spacing(spacing, status)
        type(point_spacing_t), intent(in) :: spacing !! of the contact
        type(status_t), intent(inout) :: status      !! limitations so far, no error

        character(len=:), allocatable :: words

        if (.not. spacing%is_known) return
        words = ''
        if (.not. spacing%is_solved) then
            words = 'there is no solution'
        else if (.not. spacing%is_there) then
            words = 'it is not there'
        else if (spacing%pmax > pmax_limit) then
            words = 'pmax changes by ' // trim(number_text(percent*spacing%pmax)) // ' %'
        else if (spacing%forces > force_limit) then
            words = 'the forces change by ' // trim(number_text(percent*spacing%forces)) // &
                    ' % of mu N'
        end if
        if (len(words) > 0) &
            call add_limitation(status, st_under_resolved, 'the points of the profiles do not ' // &
                                'resolve the contact: with every second one ' // words)
    end subroutine name_spacing
end module faststrip_command_contact_point_spacing
