!> Reading the clock while a contact is solved.
module faststrip_contact_clock
    use, intrinsic :: iso_fortran_env, only: int64
    use faststrip_base_kinds, only: wp
    implicit none
    private

    public :: now, since, lap_t, start_lap, add_lap

    ! Given: microseconds of a second.
    real(wp), parameter :: us_per_second = 1.0e6_wp

    !> When something began.
    type :: lap_t
        integer(int64) :: ticks = 0  !! of `system_clock`
        real(wp) :: cpu = 0.0_wp     !! of `cpu_time`, s
    end type lap_t

contains

    !> A reading of the clock.
    integer(int64) function now()
        call system_clock(now)
    end function now

    !> Microseconds since a reading of the clock.
    real(wp) function since(before)
        integer(int64), intent(in) :: before !! of `now`

        integer(int64) :: after, rate

        call system_clock(after, rate)
        since = us_per_second*real(after - before, wp)/real(rate, wp)
    end function since

    !> Something begins, if its time is asked for.
    subroutine start_lap(is_asked, lap)
        logical, intent(in) :: is_asked  !! else nothing is read
        type(lap_t), intent(out) :: lap  !! now

        if (.not. is_asked) return
        call cpu_time(lap%cpu)
        call system_clock(lap%ticks)
    end subroutine start_lap

    !> It ended: add its time.
    subroutine add_lap(is_asked, lap, us, cpu_us)
        logical, intent(in) :: is_asked     !! else nothing is read
        type(lap_t), intent(in) :: lap      !! of `start_lap`
        real(wp), intent(inout) :: us       !! wall-clock time, us
        real(wp), intent(inout) :: cpu_us   !! of the processor, us

        real(wp) :: cpu

        if (.not. is_asked) return
        us = us + since(lap%ticks)
        call cpu_time(cpu)
        cpu_us = cpu_us + us_per_second*(cpu - lap%cpu)
    end subroutine add_lap
end module faststrip_contact_clock
