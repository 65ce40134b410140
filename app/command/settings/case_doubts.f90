!> What seems wrong in the case of one contact.
module faststrip_command_settings_case_doubts
    use, intrinsic :: iso_fortran_env, only: int64
    use faststrip_base_kinds, only: wp
    use faststrip_contact_plausible, only: doubts_t, case_names_t, gap_size_t, gap_size, &
                                           find_doubts, doubt_pressure
    use faststrip_command_settings_case_file, only: case_t
    use faststrip_command_settings_doubts, only: hold_doubts, hold_tally, count_doubts, tally_t
    use faststrip_command_contact_prepared_case, only: prepared_case_t, take_lists
    implicit none
    private

    public :: case_names, hold_case_doubts, hold_sweep_doubts, hold_pressure, count_pressure

contains

    !> Keep what is outside of practice in a case and in its gap file.
    subroutine hold_case_doubts(case, prepared, path)
        type(case_t), intent(in) :: case              !! as it was read
        type(prepared_case_t), intent(in) :: prepared !! load, creepages and gap of it
        character(len=*), intent(in) :: path          !! name of the case file

        type(doubts_t) :: doubts
        type(gap_size_t) :: size_of

        if (len(case%gap_file) > 0) then
            size_of = gap_size(prepared%gap%y, prepared%gap%h, prepared%gap%inv2r)
        else
            size_of%radius = case%bodies%wheelset%radius
        end if
        call find_doubts(prepared%contact_case_t, size_of, case_names(), doubts)
        if (len(case%gap_file) > 0) then
            call hold_doubts(doubts, case%gap_file // ', ' // path)
        else
            call hold_doubts(doubts, path)
        end if
    end subroutine hold_case_doubts

    !> Keep what is outside of practice in the loads and creepages of a sweep, a line each kind.
    subroutine hold_sweep_doubts(case, path)
        type(case_t), intent(in) :: case     !! as it was read
        character(len=*), intent(in) :: path !! name of the case file

        type(prepared_case_t) :: shifted
        type(tally_t) :: tally
        type(doubts_t) :: doubts
        type(gap_size_t) :: size_of
        integer :: i

        size_of%radius = case%bodies%wheelset%radius
        do i = 1, size(case%shifts)
            shifted%contact_case_t = case%contact_case_t
            shifted%shift = case%shifts(i)
            call take_lists(case, shifted)
            doubts%n = 0
            call find_doubts(shifted%contact_case_t, size_of, case_names(), doubts)
            call count_doubts(tally, doubts, int(i, int64), 0)
        end do
        call hold_tally(tally, path)
    end subroutine hold_sweep_doubts

    !> Count that the maximum pressure is beyond all steel.
    subroutine count_pressure(tally, pmax, i)
        type(tally_t), intent(inout) :: tally !! of the contacts so far
        real(wp), intent(in) :: pmax          !! MPa
        integer, intent(in) :: i              !! line of the table, or 0

        type(doubts_t) :: doubts

        call doubt_pressure('pmax_MPa', pmax, doubts)
        call count_doubts(tally, doubts, int(i, int64), i)
    end subroutine count_pressure

    !> What case files call the numbers.
    pure type(case_names_t) function case_names() result(names)
        names%e = [character(len=24) :: 'E_wheel_MPa', 'E_rail_MPa']
        names%load = 'load_N'
        names%penetration = 'penetration_mm'
        names%creepage(3) = 'cphi_rad_per_mm'
        ! The groups of motion and friction have told of these.
        names%speed = ''
        names%half_slip_speed = ''
        names%gap = [character(len=24) :: 'y_mm', 'h_mm', 'inv2R_per_mm']
    end function case_names

    !> Keep that the maximum pressure is beyond all steel.
    subroutine hold_pressure(pmax, path)
        real(wp), intent(in) :: pmax         !! MPa
        character(len=*), intent(in) :: path !! name of the case file

        type(doubts_t) :: doubts

        call doubt_pressure('pmax_MPa', pmax, doubts)
        call hold_doubts(doubts, path)
    end subroutine hold_pressure
end module faststrip_command_settings_case_doubts
