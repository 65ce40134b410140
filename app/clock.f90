!> Measuring times in microseconds, and the median of many runs.
module faststrip_app_clock
    use, intrinsic :: iso_fortran_env, only: int64
    use faststrip_kinds, only: wp
    implicit none
    private

    public :: microseconds, cpu_microseconds, median

contains

    !> Time between two readings of `system_clock`, us.
    real(wp) function microseconds(from, to)
        integer(int64), intent(in) :: from !! earlier reading
        integer(int64), intent(in) :: to   !! later reading

        integer(int64) :: rate

        call system_clock(count_rate=rate)
        microseconds = 1.0e6_wp*real(to - from, wp)/real(rate, wp)
    end function microseconds

    !> Time the processor has spent on the program so far, us: what else runs on the machine does
    !> not count.
    real(wp) function cpu_microseconds() result(time)
        call cpu_time(time)
        time = 1.0e6_wp*time
    end function cpu_microseconds

    !> The middle value of a list, the mean of the middle two; zero for none.
    pure real(wp) function median(values)
        real(wp), intent(in) :: values(:) !! finite numbers in any order

        real(wp) :: sorted(size(values)), value
        integer :: i, j, n

        median = 0.0_wp
        n = size(values)
        if (n == 0) return
        sorted = values
        do i = 2, n
            value = sorted(i)
            do j = i - 1, 1, -1
                if (sorted(j) <= value) exit
                sorted(j + 1) = sorted(j)
            end do
            sorted(j + 1) = value
        end do
        median = 0.5_wp*(sorted((n + 1)/2) + sorted(n/2 + 1))
    end function median
end module faststrip_app_clock
