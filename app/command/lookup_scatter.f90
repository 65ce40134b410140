!> Errors of many contacts in a few numbers.
module faststrip_command_lookup_scatter
    use faststrip_base_kinds, only: wp
    implicit none
    private

    public :: percentile, scatter_of

contains

    !> Mean, 99th percentile and worst.
    pure function scatter_of(errors) result(scatter)
        real(wp), intent(in) :: errors(:) !! at least one
        real(wp) :: scatter(3)

        scatter = [sum(errors)/size(errors), percentile(errors, 99.0_wp), maxval(errors)]
    end function scatter_of

    !> The value that so many percent do not exceed.
    pure real(wp) function percentile(values, percent)
        real(wp), intent(in) :: values(:) !! at least one
        real(wp), intent(in) :: percent   !! above 0 to 100

        real(wp) :: sorted(size(values)), pivot, kept
        integer :: rank, low, high, i, j

        ! Hoare's selection: only as much is sorted as tells which value has the rank.
        sorted = values
        rank = min(max(ceiling(percent/100.0_wp*size(values)), 1), size(values))
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
        percentile = sorted(rank)
    end function percentile
end module faststrip_command_lookup_scatter
