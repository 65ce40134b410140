!> What a stress amounts to in any axes: principal values, von Mises' and Tresca's equivalent
!> stress.
module faststrip_stress_invariants
    use faststrip_base_kinds, only: wp
    use faststrip_base_limits, only: most_steps
    use faststrip_stress_rectangle, only: n_stresses
    implicit none
    private

    public :: von_mises, principal_stresses, tresca

contains

    !> Von Mises' equivalent stress, the yield stress in tension that a stress needs.
    pure real(wp) function von_mises(s)
        real(wp), intent(in) :: s(n_stresses) !! xx, yy, zz, xy, xz, yz

        von_mises = sqrt(0.5_wp*((s(1) - s(2))**2 + (s(2) - s(3))**2 + (s(3) - s(1))**2) &
                         + 3.0_wp*sum(s(4:)**2))
    end function von_mises

    !> Principal stresses, the largest first, by Jacobi's method: each has the error of a rounding
    !> of the largest, also where two are equal.
    pure function principal_stresses(s) result(values)
        real(wp), intent(in) :: s(n_stresses) !! xx, yy, zz, xy, xz, yz
        real(wp) :: values(3)

        ! Given: the three pairs of axes, and the axis that is left.
        integer, parameter :: first(3) = [1, 1, 2], second(3) = [2, 3, 3], other(3) = [3, 2, 1]
        real(wp) :: a(3, 3), angle, t, c, before(2)
        integer :: sweep, k

        a = reshape([s(1), s(4), s(5), s(4), s(2), s(6), s(5), s(6), s(3)], [3, 3])
        do sweep = 1, most_steps
            if (abs(a(1, 2)) + abs(a(1, 3)) + abs(a(2, 3)) <= tiny(c)) exit
            do k = 1, 3
                associate (i => first(k), j => second(k), o => other(k))
                    if (.not. abs(a(i, j)) > 0.0_wp) cycle
                    ! The smaller root of t^2 + 2 angle t - 1 = 0.
                    angle = 0.5_wp*(a(j, j) - a(i, i))/a(i, j)
                    t = sign(1.0_wp, angle)/(abs(angle) + hypot(1.0_wp, angle))
                    c = 1.0_wp/hypot(1.0_wp, t)
                    a(i, i) = a(i, i) - t*a(i, j)
                    a(j, j) = a(j, j) + t*a(i, j)
                    a(i, j) = 0.0_wp
                    a(j, i) = 0.0_wp
                    before = [a(o, i), a(o, j)]
                    a(o, i) = c*(before(1) - t*before(2))
                    a(o, j) = c*(before(2) + t*before(1))
                    a(i, o) = a(o, i)
                    a(j, o) = a(o, j)
                end associate
            end do
        end do
        values = [a(1, 1), a(2, 2), a(3, 3)]
        values = [maxval(values), max(min(values(1), values(2)), &
                                      min(max(values(1), values(2)), values(3))), minval(values)]
    end function principal_stresses

    !> Tresca's equivalent stress: the largest principal stress less the smallest.
    pure real(wp) function tresca(values)
        real(wp), intent(in) :: values(3) !! of `principal_stresses`

        tresca = values(1) - values(3)
    end function tresca
end module faststrip_stress_invariants
