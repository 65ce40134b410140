!> Temperatures in the F77 interface, of workspaces of FSINIT and of FSWNEW alike; they need
!> elements, IOPT(9) = 1.
!>
!> ```
!> HEAT(1), HEAT(2) conductivity of wheel and rail, W/(m K)
!> HEAT(3), HEAT(4) heat capacity, J/(kg K)            HEAT(5), HEAT(6) density, kg/m^3
!> HEAT(7), HEAT(8) temperature away from the contact, C
!> HEAT(9) hot over cold friction, 1e-6 to 1; 1: friction does not fall with temperature
!> HEAT(10), HEAT(11) temperatures up to which the cold value counts and from which the hot one, C
!> FLASH(1) largest rise by the heat of friction, K    FLASH(2) largest temperature, C
!> FLASH(3), FLASH(4) its place, x and y, mm
!> ```
module faststrip_interop_f77_heat
    use, intrinsic :: iso_c_binding, only: c_int, c_double
    use faststrip_base_status, only: is_error
    use faststrip_base_thermal, only: thermal_t
    use faststrip_contact_case, only: contact_case_t
    use faststrip_contact_method, only: contact_result_t
    use faststrip_interop_f77, only: n_iwork, find_either
    use faststrip_interop_handle, only: handle_t
    use faststrip_interop_heat, only: n_flash, contact_flash, contact_temperatures
    use faststrip_interop_solution, only: mirror_t
    use faststrip_interop_wheelset_handle, only: wheelset_handle_t, find_contact, contact_mirror
    implicit none
    private

    public :: fsheat, fsflsh, fstemp

    ! Given: by the interface.
    integer, parameter :: n_heat = 11, at_density = 5, at_hot = 9

contains

    !> CALL FSHEAT(IWORK, LTEMP, HEAT, INFO)
    !>
    !> Set for all further calls of FSSOLV or FSWSLV whether there are temperatures (LTEMP 1) or not
    !> (0), and what makes a contact warm; these calls refuse what is none. The rolling speed is
    !> FRIC(3) of FSFRIC, to be called before. Figures of the last solution are forgotten.
    subroutine fsheat(iwork, wanted, heat, info) bind(c, name='fsheat_')
        integer(c_int), intent(in) :: iwork(n_iwork) !! made by FSINIT or FSWNEW
        integer(c_int), intent(in) :: wanted         !! as above
        real(c_double), intent(in) :: heat(n_heat)   !! as above
        integer(c_int), intent(out) :: info          !! status

        type(handle_t), pointer :: handle
        type(wheelset_handle_t), pointer :: wheelset

        call find_either(iwork, handle, wheelset, info)
        if (associated(handle)) then
            call fill_heat(wanted, heat, handle%case)
            handle%result = contact_result_t()
        else if (associated(wheelset)) then
            call fill_heat(wanted, heat, wheelset%model%case)
            wheelset%has = .false.
        end if
    end subroutine fsheat

    !> CALL FSFLSH(IWORK, K, FLASH, INFO)
    !>
    !> Largest rise and temperature of the last solution; of a wheelset those of contact K, column K
    !> of CONT.
    subroutine fsflsh(iwork, k, flash, info) bind(c, name='fsflsh_')
        integer(c_int), intent(in) :: iwork(n_iwork)   !! with a solution
        integer(c_int), intent(in) :: k                !! contact; of FSINIT's it does not count
        real(c_double), intent(out) :: flash(n_flash)  !! as above; zero when there is an error
        integer(c_int), intent(out) :: info            !! status

        type(handle_t), pointer :: handle
        type(wheelset_handle_t), pointer :: wheelset
        integer :: side, i

        flash = 0.0_c_double
        call find_either(iwork, handle, wheelset, info)
        if (associated(handle)) then
            call contact_flash(handle%result, flash, handle%status)
            info = handle%status%code
        else if (associated(wheelset)) then
            call find_contact(wheelset, k, side, i)
            if (.not. is_error(wheelset%status)) &
                call contact_flash(wheelset%result%wheel(side)%contact(i)%figures, flash, &
                                   wheelset%status)
            info = wheelset%status%code
        end if
    end subroutine fsflsh

    !> CALL FSTEMP(IWORK, K, N, X, Y, TWHEEL, TRAIL, INFO)
    !>
    !> Temperatures of both surfaces at N places of the last solution, in the contact, behind it or
    !> beside it, C; of a wheelset those of contact K, in the frame of FSWELM.
    subroutine fstemp(iwork, k, n, x, y, wheel, rail, info) bind(c, name='fstemp_')
        integer(c_int), intent(in) :: iwork(n_iwork)       !! with a solution
        integer(c_int), intent(in) :: k                    !! contact; of FSINIT's it does not count
        integer(c_int), intent(in) :: n                    !! number of places
        real(c_double), intent(in) :: x(*), y(*)           !! places, mm
        real(c_double), intent(inout) :: wheel(*), rail(*) !! C
        integer(c_int), intent(out) :: info                !! status

        type(handle_t), pointer :: handle
        type(wheelset_handle_t), pointer :: wheelset
        integer :: side, i

        call find_either(iwork, handle, wheelset, info)
        if (associated(handle)) then
            call contact_temperatures(handle%workspace, handle%result, mirror_t(), x(:n), y(:n), &
                                      wheel(:n), rail(:n), handle%status)
            info = handle%status%code
        else if (associated(wheelset)) then
            call find_contact(wheelset, k, side, i)
            if (.not. is_error(wheelset%status)) &
                call contact_temperatures(wheelset%workspace%wheel(side)%contact(i), &
                                          wheelset%result%wheel(side)%contact(i)%figures, &
                                          contact_mirror(wheelset, side), x(:n), y(:n), &
                                          wheel(:n), rail(:n), wheelset%status)
            info = wheelset%status%code
        end if
    end subroutine fstemp

    ! What makes a contact warm.
    pure subroutine fill_heat(wanted, heat, case)
        integer(c_int), intent(in) :: wanted
        real(c_double), intent(in) :: heat(n_heat)
        type(contact_case_t), intent(inout) :: case

        case%asked%temperatures = wanted /= 0
        case%thermal = thermal_t(heat(:2), heat(3:4), heat(at_density:at_density + 1), &
                                 heat(at_density + 2:at_density + 3))
        associate (friction => case%friction)
            friction%hot_share = heat(at_hot)
            friction%cold_temperature = heat(at_hot + 1)
            friction%hot_temperature = heat(at_hot + 2)
        end associate
    end subroutine fill_heat
end module faststrip_interop_f77_heat
