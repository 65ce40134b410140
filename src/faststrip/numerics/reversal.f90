!> Arrays turned round in place: the last value first. Nothing is allocated.
module faststrip_numerics_reversal
    use faststrip_base_kinds, only: wp
    implicit none
    private

    public :: reverse, reverse_negated, reverse_exchanged

    !> Turn an array round.
    interface reverse
        module procedure reverse_reals, reverse_integers, reverse_logicals
    end interface reverse

contains

    pure subroutine reverse_reals(values)
        real(wp), intent(inout) :: values(:) !! turned round

        real(wp) :: kept
        integer :: i, n

        n = size(values)
        do i = 1, n/2
            kept = values(i)
            values(i) = values(n + 1 - i)
            values(n + 1 - i) = kept
        end do
    end subroutine reverse_reals

    pure subroutine reverse_integers(values)
        integer, intent(inout) :: values(:) !! turned round

        integer :: i, n, kept

        n = size(values)
        do i = 1, n/2
            kept = values(i)
            values(i) = values(n + 1 - i)
            values(n + 1 - i) = kept
        end do
    end subroutine reverse_integers

    pure subroutine reverse_logicals(values)
        logical, intent(inout) :: values(:) !! turned round

        integer :: i, n
        logical :: kept

        n = size(values)
        do i = 1, n/2
            kept = values(i)
            values(i) = values(n + 1 - i)
            values(n + 1 - i) = kept
        end do
    end subroutine reverse_logicals

    !> Turn coordinates round as a mirror does: `-values(n), ..., -values(1)`.
    pure subroutine reverse_negated(values)
        real(wp), intent(inout) :: values(:) !! turned round, signs changed

        real(wp) :: kept
        integer :: i, n

        n = size(values)
        do i = 1, (n + 1)/2
            kept = -values(i)
            values(i) = -values(n + 1 - i)
            values(n + 1 - i) = kept
        end do
    end subroutine reverse_negated

    !> Turn two arrays round as a mirror does with left and right edges: the left ones become
    !> `-right(n), ..., -right(1)`, the right ones `-left(n), ..., -left(1)`.
    pure subroutine reverse_exchanged(left, right)
        real(wp), intent(inout) :: left(:)  !! as many as right ones
        real(wp), intent(inout) :: right(:)

        real(wp) :: kept
        integer :: i, n

        n = size(left)
        do i = 1, n
            kept = left(i)
            left(i) = -right(n + 1 - i)
            right(n + 1 - i) = -kept
        end do
    end subroutine reverse_exchanged
end module faststrip_numerics_reversal
