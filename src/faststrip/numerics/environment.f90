!> The host's floating-point environment: its flags, traps and rounding, set aside for a call.
!>
!> Fortran's own intrinsic module cannot do this from a procedure of its own: halting and rounding
!> modes return to what they were when the procedure ends. These are C's functions of `fenv.h`.
module faststrip_numerics_environment
    use, intrinsic :: iso_c_binding, only: c_int, c_long
    implicit none
    private

    public :: environment_t, hold_environment, restore_environment

    !> Room for C's `fenv_t`, at most 32 bytes on the systems at hand.
    type :: environment_t
        private
        integer(c_long) :: content(16) = 0
    end type environment_t

    ! Given: the C library's number.
    integer(c_int), parameter :: to_nearest = 0 ! FE_TONEAREST, wherever IEEE 754 is in hardware

    interface
        !> Save the environment, clear its flags and switch its traps off.
        integer(c_int) function feholdexcept(content) bind(c)
            import :: c_int, c_long
            integer(c_long), intent(out) :: content(*)
        end function feholdexcept

        integer(c_int) function fesetenv(content) bind(c)
            import :: c_int, c_long
            integer(c_long), intent(in) :: content(*)
        end function fesetenv

        integer(c_int) function fegetround() bind(c)
            import :: c_int
        end function fegetround

        integer(c_int) function fesetround(mode) bind(c)
            import :: c_int
            integer(c_int), value :: mode
        end function fesetround
    end interface

contains

    !> Set the host's environment aside; from here on nothing traps and rounding is to nearest.
    subroutine hold_environment(saved)
        type(environment_t), intent(out) :: saved !! for `restore_environment`

        integer(c_int) :: ignored

        ignored = feholdexcept(saved%content)
        if (fegetround() /= to_nearest) ignored = fesetround(to_nearest)
    end subroutine hold_environment

    !> Give the host its flags, traps and rounding back.
    subroutine restore_environment(saved)
        type(environment_t), intent(in) :: saved !! of `hold_environment`

        integer(c_int) :: ignored

        ignored = fesetenv(saved%content)
    end subroutine restore_environment
end module faststrip_numerics_environment
