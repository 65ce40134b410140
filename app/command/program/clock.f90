!> Measuring times in microseconds, and the median, 95th percentile and worst of many runs.
!>
!> Columns say which time they hold: `cpu_us_...` that of the processor.
module faststrip_command_program_clock
    use, intrinsic :: iso_fortran_env, only: int64
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: number_text
    implicit none
    private

    public :: microseconds, cpu_microseconds, median, spread_of, spread_text
    public :: spread_names, cpu_columns

    !> What is reported of many runs, and the columns for it.
    character(len=*), parameter :: spread_names(3) = [character(len=6) :: 'median', 'p95', 'worst']
    character(len=*), parameter :: cpu_columns(3) = 'cpu_us_' // spread_names

contains

    !> Time between two readings of `system_clock`, us.
    real(wp) function microseconds(from, to)
        integer(int64), intent(in) :: from !! earlier reading
        integer(int64), intent(in) :: to   !! later reading

        integer(int64) :: rate

        call system_clock(count_rate=rate)
        ! Given: us.
        microseconds = 1.0e6_wp*real(to - from, wp)/real(rate, wp)
    end function microseconds

    !> Time the processor has spent on the program so far, us: what else runs on the machine does
    !> not count.
    real(wp) function cpu_microseconds() result(time)
        call cpu_time(time)
        time = 1.0e6_wp*time ! Given: us
    end function cpu_microseconds

    !> The middle value of a list, the mean of the middle two; zero for none.
    pure real(wp) function median(values)
        real(wp), intent(in) :: values(:) !! finite numbers in any order

        real(wp) :: sorted(size(values))
        integer :: n

        median = 0.0_wp
        n = size(values)
        if (n == 0) return
        sorted = in_order(values)
        median = 0.5_wp*(sorted((n + 1)/2) + sorted(n/2 + 1))
    end function median

    !> Median, 95th percentile and worst of a list, in the order of `spread_names`; zeros for none.
    !> The percentile is the smallest value that 95 % of the list do not exceed: of fewer than 20
    !> values the worst.
    pure function spread_of(values) result(figures)
        real(wp), intent(in) :: values(:) !! finite numbers in any order
        real(wp) :: figures(size(spread_names))

        real(wp) :: sorted(size(values))
        integer :: n

        figures = 0.0_wp
        n = size(values)
        if (n == 0) return
        sorted = in_order(values)
        figures = [median(values), sorted((95*n + 99)/100), sorted(n)]
    end function spread_of

    !> `spread_of` in words: three numbers and slashes between them, and whose the worst is.
    function spread_text(values, names) result(text)
        real(wp), intent(in) :: values(:)                   !! finite numbers in any order
        character(len=*), intent(in), optional :: names(:) !! of these, as many
        character(len=:), allocatable :: text

        real(wp) :: figures(size(spread_names))

        figures = spread_of(values)
        text = trim(number_text(figures(1))) // '/' // trim(number_text(figures(2))) // '/' &
               // trim(number_text(figures(3)))
        if (present(names) .and. size(values) > 0) &
            text = text // ' (' // trim(names(maxloc(values, 1))) // ')'
    end function spread_text

    pure function in_order(values) result(sorted)
        real(wp), intent(in) :: values(:)
        real(wp) :: sorted(size(values))

        real(wp) :: value
        integer :: i, j

        sorted = values
        do i = 2, size(values)
            value = sorted(i)
            do j = i - 1, 1, -1
                if (sorted(j) <= value) exit
                sorted(j + 1) = sorted(j)
            end do
            sorted(j + 1) = value
        end do
    end function in_order
end module faststrip_command_program_clock
