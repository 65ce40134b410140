!> Errors of many contacts in a few numbers.
module faststrip_tabulate_scatter
    use faststrip_base_kinds, only: wp
    implicit none
    private

    public :: percentile, scatter_of, percentile_bound

    !> Contacts from which on the worst of them is above the 99th percentile of all, in 95 of 100
    !> draws: .99**299 is .05.
    !> Given: by the binomial distribution.
    integer, parameter, public :: least_drawn = 299

contains

    !> Mean, 99th percentile and worst.
    pure function scatter_of(errors) result(scatter)
        real(wp), intent(in) :: errors(:) !! at least one
        real(wp) :: scatter(3)

        ! Given: the 99th percentile.
        scatter = [sum(errors)/size(errors), percentile(errors, 99.0_wp), maxval(errors)]
    end function scatter_of

    !> What the 99th percentile of all contacts does not exceed in 95 of 100 draws of some of them,
    !> whatever its distribution: one of their errors, by the binomial distribution of how many are
    !> above the percentile. The worst if there are fewer than `least_drawn`.
    pure real(wp) function percentile_bound(errors) result(bound)
        real(wp), intent(in) :: errors(:) !! of contacts drawn at random, at least one

        ! Given: the 99th percentile, and 95 of 100 draws.
        real(wp), parameter :: above = 0.01_wp, doubt = 0.05_wp
        real(wp) :: log_chance, chances
        integer :: n, k

        n = size(errors)
        ! So many errors, or fewer, are above the percentile in 5 of 100 draws.
        log_chance = n*log(1.0_wp - above)
        chances = exp(log_chance)
        do k = 0, n - 2
            log_chance = log_chance + log(above/(1.0_wp - above)*real(n - k, wp)/real(k + 1, wp))
            chances = chances + exp(log_chance)
            if (chances > doubt) exit
        end do
        bound = ranked(errors, n - k)
    end function percentile_bound

    !> The value that so many percent do not exceed.
    pure real(wp) function percentile(values, percent)
        real(wp), intent(in) :: values(:) !! at least one
        real(wp), intent(in) :: percent   !! above 0 to 100

        ! Given: percent.
        percentile = ranked(values, min(max(ceiling(percent/100.0_wp*size(values)), 1), &
                                        size(values)))
    end function percentile

    ! The value that has a rank, from the least on.
    pure real(wp) function ranked(values, rank)
        real(wp), intent(in) :: values(:)
        integer, intent(in) :: rank

        real(wp) :: sorted(size(values)), pivot, kept
        integer :: low, high, i, j

        ! Hoare's selection: only as much is sorted as tells which value has the rank.
        sorted = values
        low = 1
        high = size(values)
        do while (low < high)
            pivot = sorted((low + high)/2)
            i = low
            j = high
            do while (i <= j)
                do while (sorted(i) < pivot)
                    i = i + 1
                end do
                do while (sorted(j) > pivot)
                    j = j - 1
                end do
                if (i > j) exit
                kept = sorted(i)
                sorted(i) = sorted(j)
                sorted(j) = kept
                i = i + 1
                j = j - 1
            end do
            if (rank <= j) then
                high = j
            else if (rank >= i) then
                low = i
            else
                exit
            end if
        end do
        ranked = sorted(rank)
    end function ranked
end module faststrip_tabulate_scatter
