!> Creep forces over three normalised creepages, as lookup tables hold them.
!>
!> The creepages x1 (longitudinal), x2 (lateral), x3 (spin) are scaled so that each alone would give
!> mu N by the linear theory at 1. For Coulomb friction and like materials forces keep to two
!> mirrors, x1 to -x1 with Fx to -Fx, and (x2, x3) to (-x2, -x3) with (Fy, Mz) to (-Fy, -Mz): tables
!> hold x1, x3 >= 0. All of them fit on six faces, of which creepage is the largest and which sign
!> x2 has: with r the largest and s and t the other two over it,
!>
!>     q = r/(1 + r),  f = q Phi(q, s, t),
!>
!> q from 0, nothing slides, to 1, all slides, whatever the creepages. Phi, which is tabled, is the
!> linear theory's force at q = 0 and that of saturation at q = 1; where forces are linear in the
!> creepages it is linear in s and t. f is (Fx, Fy, Mz/c) over mu N, c a length of the patch.
module faststrip_lookup_faces
    use, intrinsic :: iso_fortran_env, only: real32, int64
    use faststrip_base_kinds, only: wp
    use faststrip_lookup_axis, only: lookup_axis_t, stencil_t, linear_stencil, cubic_stencil
    implicit none
    private

    public :: faces_cell_t, find_faces_cell, sum_faces, finish_faces, creepages_at
    public :: n_faces, n_forces, lookup_linear, lookup_cubic

    !> Faces of a table, and forces at each node.
    !> Given: three creepages, one of them of either sign; Fx, Fy, Mz.
    integer, parameter :: n_faces = 6, n_forces = 3

    !> Orders of interpolation.
    !> Given: the degrees.
    integer, parameter :: lookup_linear = 1, lookup_cubic = 3

    ! Forces over mu N by which the bend to their bound begins before it, and ends behind it.
    ! Tuned [1]. Origin: chosen: a quarter of it is far below the errors of tables.
    real(wp), parameter :: bend = 2.0e-4_wp
    ! The two creepages that are not the largest.
    integer, parameter :: others(2, 3) = reshape([2, 3, 1, 3, 1, 2], [2, 3])

    !> Where creepages lie on the faces, and the weights of the nodes about them.
    type :: faces_cell_t
        integer :: face = 1               !! 1 to `n_faces`
        integer :: largest = 1            !! which creepage
        integer :: width = 2              !! of the stencils, nodes
        real(wp) :: q = 0.0_wp            !! r/(1 + r)
        real(wp) :: s = 0.0_wp, t = 0.0_wp !! the others over the largest
        real(wp) :: sign_of(3) = 1.0_wp   !! of the creepages, that of x2 after the mirror
        type(stencil_t) :: in_q, in_s, in_t
    end type faces_cell_t

contains

    !> Where creepages lie. No number may be infinite.
    pure subroutine find_faces_cell(q_axis, ratio_axis, order, x, cell)
        type(lookup_axis_t), intent(in) :: q_axis     !! from 0 to 1
        type(lookup_axis_t), intent(in) :: ratio_axis !! from 0 to 1
        integer, intent(in) :: order                  !! `lookup_linear` or `lookup_cubic`
        real(wp), intent(in) :: x(3)                  !! normalised creepages
        type(faces_cell_t), intent(inout) :: cell     !! found

        real(wp) :: size_of(3), r, per_r

        cell%sign_of(1) = sign(1.0_wp, x(1))
        cell%sign_of(3) = sign(1.0_wp, x(3))
        cell%sign_of(2) = sign(1.0_wp, x(2)*cell%sign_of(3))
        size_of = abs(x)
        cell%largest = 1
        if (size_of(2) > size_of(1)) cell%largest = 2
        if (size_of(3) > size_of(cell%largest)) cell%largest = 3
        cell%face = 2*cell%largest - 1
        if (cell%sign_of(2) < 0.0_wp) cell%face = cell%face + 1
        r = size_of(cell%largest)
        cell%q = r/(1.0_wp + r)
        cell%s = 0.0_wp
        cell%t = 0.0_wp
        if (r > 0.0_wp) then
            per_r = 1.0_wp/r
            ! At most 1, also where rounding would have more.
            cell%s = min(size_of(others(1, cell%largest))*per_r, 1.0_wp)
            cell%t = min(size_of(others(2, cell%largest))*per_r, 1.0_wp)
        end if
        if (order == lookup_linear) then
            cell%width = 2
            call linear_stencil(q_axis, cell%q, cell%in_q)
            call linear_stencil(ratio_axis, cell%s, cell%in_s)
            call linear_stencil(ratio_axis, cell%t, cell%in_t)
        else
            cell%width = 4
            call cubic_stencil(q_axis, cell%q, cell%in_q)
            call cubic_stencil(ratio_axis, cell%s, cell%in_s)
            call cubic_stencil(ratio_axis, cell%t, cell%in_t)
        end if
    end subroutine find_faces_cell

    !> Phi on some sets of faces, weighted: with its derivatives by q, s, t, and by the coordinates
    !> along which the sets lie.
    pure subroutine sum_faces(values, sets, w, n_q, n_ratio, cell, phi, slopes)
        real(real32), intent(in), contiguous :: values(:) !! all values of a table
        integer, intent(in) :: sets(:)           !! numbers of the sets of faces, from 1
        real(wp), intent(in), contiguous :: w(0:, :)
            !! weights of the sets: in Phi, in its derivative by each coordinate
        integer, intent(in) :: n_q, n_ratio      !! nodes of the axes
        type(faces_cell_t), intent(in) :: cell   !! of `find_faces_cell`
        real(wp), intent(out) :: phi(3, 4)       !! Phi; its derivatives by q, s, t
        real(wp), intent(out) :: slopes(n_forces, ubound(w, 1))
            !! its derivatives by the coordinates

        integer(int64) :: first, row, sheet

        row = n_forces*int(n_q, int64)
        sheet = n_ratio*row
        first = (cell%face - 1)*n_ratio*sheet + (cell%in_t%first - 1)*sheet &
                + (cell%in_s%first - 1)*row + n_forces*(cell%in_q%first - 1)
        if (cell%width == 2) then
            call sum_linear(values, sets, w, first, row, sheet, n_faces*n_ratio*sheet, cell, phi, &
                            slopes)
        else
            call sum_cubic(values, sets, w, first, row, sheet, n_faces*n_ratio*sheet, cell, phi, &
                           slopes)
        end if
    end subroutine sum_faces

    ! From the eight nodes of a cell of each set: their mean over the sets has the derivatives by
    ! q, s, t; the derivatives by the coordinates need each set's own Phi.
    pure subroutine sum_linear(values, sets, w, first, row, sheet, set, cell, phi, slopes)
        real(real32), intent(in), contiguous :: values(:)
        integer, intent(in) :: sets(:)
        real(wp), intent(in), contiguous :: w(0:, :)
        integer(int64), intent(in) :: first            ! numbers before the cell's first node
        integer(int64), intent(in) :: row, sheet, set  ! numbers from one of them to the next
        type(faces_cell_t), intent(in) :: cell
        real(wp), intent(out) :: phi(3, 4), slopes(n_forces, ubound(w, 1))

        ! Both nodes along q; rows, sheets.
        real(wp) :: mean(2*n_forces, 4), node(2*n_forces), own(2*n_forces), at_st(4)
        real(wp) :: by_q(4), one, two
        integer(int64) :: at, of_node(4)
        integer :: i, k, m

        of_node = [0_int64, row, sheet, sheet + row]
        at_st = [cell%in_s%w(1)*cell%in_t%w(1), cell%in_s%w(2)*cell%in_t%w(1), &
                 cell%in_s%w(1)*cell%in_t%w(2), cell%in_s%w(2)*cell%in_t%w(2)]
        mean = 0.0_wp
        slopes = 0.0_wp
        do i = 1, size(sets)
            own = 0.0_wp
            do k = 1, 4
                at = first + (sets(i) - 1)*set + of_node(k)
                node = values(at + 1:at + 2*n_forces)
                mean(:, k) = mean(:, k) + w(0, i)*node
                own = own + at_st(k)*node
            end do
            own(:3) = own(:3) + cell%in_q%w(2)*(own(4:) - own(:3))
            do m = 1, ubound(w, 1)
                slopes(:, m) = slopes(:, m) + w(m, i)*own(:3)
            end do
        end do
        do i = 1, n_forces
            by_q = mean(i + n_forces, :) - mean(i, :)
            associate (mean => mean(i, :) + cell%in_q%w(2)*by_q)
                one = mean(1) + cell%in_s%w(2)*(mean(2) - mean(1))
                two = mean(3) + cell%in_s%w(2)*(mean(4) - mean(3))
                phi(i, 1) = one + cell%in_t%w(2)*(two - one)
                phi(i, 4) = cell%in_t%dw(2)*(two - one)
                phi(i, 3) = cell%in_s%dw(2)*(mean(2) - mean(1) + cell%in_t%w(2)*(mean(4) &
                                             - mean(3) - (mean(2) - mean(1))))
            end associate
            one = by_q(1) + cell%in_s%w(2)*(by_q(2) - by_q(1))
            two = by_q(3) + cell%in_s%w(2)*(by_q(4) - by_q(3))
            phi(i, 2) = cell%in_q%dw(2)*(one + cell%in_t%w(2)*(two - one))
        end do
    end subroutine sum_linear

    ! The same from 64 nodes of each set.
    pure subroutine sum_cubic(values, sets, w, first, row, sheet, set, cell, phi, slopes)
        real(real32), intent(in), contiguous :: values(:)
        integer, intent(in) :: sets(:)
        real(wp), intent(in), contiguous :: w(0:, :)
        integer(int64), intent(in) :: first            ! numbers before the first node
        integer(int64), intent(in) :: row, sheet, set  ! numbers from one of them to the next
        type(faces_cell_t), intent(in) :: cell
        real(wp), intent(out) :: phi(3, 4), slopes(n_forces, ubound(w, 1))

        ! Four nodes along q; rows; sheets.
        real(wp) :: mean(4*n_forces, 4, 4), node(4*n_forces), own(4*n_forces)
        real(wp) :: plane(4*n_forces), plane_s(4*n_forces), along_q(4*n_forces), along_s(4*n_forces)
        real(wp) :: along_t(4*n_forces)
        integer(int64) :: at
        integer :: i, j, k, m

        mean = 0.0_wp
        slopes = 0.0_wp
        do i = 1, size(sets)
            own = 0.0_wp
            do k = 1, 4
                do j = 1, 4
                    at = first + (sets(i) - 1)*set + (k - 1)*sheet + (j - 1)*row
                    node = values(at + 1:at + 4*n_forces)
                    mean(:, j, k) = mean(:, j, k) + w(0, i)*node
                    own = own + cell%in_s%w(j)*cell%in_t%w(k)*node
                end do
            end do
            own(:3) = along(own, cell%in_q%w)
            do m = 1, ubound(w, 1)
                slopes(:, m) = slopes(:, m) + w(m, i)*own(:3)
            end do
        end do
        along_q = 0.0_wp
        along_s = 0.0_wp
        along_t = 0.0_wp
        do k = 1, 4
            plane = 0.0_wp
            plane_s = 0.0_wp
            do j = 1, 4
                plane = plane + cell%in_s%w(j)*mean(:, j, k)
                plane_s = plane_s + cell%in_s%dw(j)*mean(:, j, k)
            end do
            along_q = along_q + cell%in_t%w(k)*plane
            along_s = along_s + cell%in_t%w(k)*plane_s
            along_t = along_t + cell%in_t%dw(k)*plane
        end do
        phi(:, 1) = along(along_q, cell%in_q%w)
        phi(:, 2) = along(along_q, cell%in_q%dw)
        phi(:, 3) = along(along_s, cell%in_q%w)
        phi(:, 4) = along(along_t, cell%in_q%w)
    end subroutine sum_cubic

    ! Forces of four nodes along q, weighted.
    pure function along(nodes, w) result(forces)
        real(wp), intent(in) :: nodes(4*n_forces), w(4)
        real(wp) :: forces(n_forces)

        forces = w(1)*nodes(1:3) + w(2)*nodes(4:6) + w(3)*nodes(7:9) + w(4)*nodes(10:12)
    end function along

    !> Forces over mu N and their derivatives from Phi and its derivatives, within the bound.
    pure subroutine finish_faces(cell, phi, slopes, f, by_creepage)
        type(faces_cell_t), intent(in) :: cell
        real(wp), intent(in) :: phi(3, 4)            !! of `sum_faces`
        real(wp), intent(inout) :: slopes(:, :)
            !! of `sum_faces`; then the forces' derivatives by the same coordinates
        real(wp), intent(out) :: f(3)                !! Fx, Fy, Mz/c over mu N
        real(wp), intent(out) :: by_creepage(3, 3)   !! derivative of the first by the second

        real(wp) :: rest, signs(3)
        integer :: one, two, k

        rest = 1.0_wp - cell%q
        one = others(1, cell%largest)
        two = others(2, cell%largest)
        signs = force_signs(cell)
        f = cell%q*phi(:, 1)*signs
        ! dq/dr = (1 - q)^2 and q/r = 1 - q: nothing is divided by r, which may be zero.
        by_creepage(:, one) = rest*phi(:, 3)
        by_creepage(:, two) = rest*phi(:, 4)
        by_creepage(:, cell%largest) = rest*(rest*(phi(:, 1) + cell%q*phi(:, 2)) &
                                             - cell%s*phi(:, 3) - cell%t*phi(:, 4))
        by_creepage(:, 1) = by_creepage(:, 1)*signs*cell%sign_of(1)
        by_creepage(:, 2) = by_creepage(:, 2)*signs*cell%sign_of(2)*cell%sign_of(3)
        by_creepage(:, 3) = by_creepage(:, 3)*signs*cell%sign_of(3)
        do k = 1, size(slopes, 2)
            slopes(:, k) = cell%q*slopes(:, k)*signs
        end do
        call bound_force(f, by_creepage, slopes)
    end subroutine finish_faces

    !> Hold the force in the plane to mu N: between nodes an interpolation may pass it by its error.
    !> A force of the size m over mu N gets m - (m - (1 - d))^2/(4 d) from 1 - d to 1 + d, with d
    !> the `bend`, and 1 beyond: derivatives stay continuous, and nothing that is not above moves by
    !> more than d/4.
    pure subroutine bound_force(f, by_creepage, slopes)
        real(wp), intent(inout) :: f(3), by_creepage(3, 3), slopes(:, :)

        real(wp) :: m, over, share, slope, along(2)
        integer :: k

        if (f(1)*f(1) + f(2)*f(2) <= (1.0_wp - bend)**2) return
        m = hypot(f(1), f(2))
        along = f(:2)/m
        over = min(m - (1.0_wp - bend), 2.0_wp*bend)
        ! By some roundings less, which the sums after it may add.
        share = (1.0_wp - 8.0_wp*epsilon(m))*(1.0_wp - bend + over - over*over/(4.0_wp*bend))/m
        slope = 1.0_wp - over/(2.0_wp*bend)
        f(:2) = share*f(:2)
        do k = 1, 3
            call turn(by_creepage(:2, k))
        end do
        do k = 1, size(slopes, 2)
            call turn(slopes(:2, k))
        end do

    contains

        !> Derivatives of what is bounded from those of what is not.
        pure subroutine turn(by)
            real(wp), intent(inout) :: by(2)

            by = share*by + (slope - share)*along*(along(1)*by(1) + along(2)*by(2))
        end subroutine turn
    end subroutine bound_force

    !> What the mirrors do to Fx, Fy and Mz.
    pure function force_signs(cell) result(signs)
        type(faces_cell_t), intent(in) :: cell
        real(wp) :: signs(3)

        signs = [cell%sign_of(1), cell%sign_of(3), cell%sign_of(3)]
    end function force_signs

    !> The creepages of a place on a face; where all slides, of such a size.
    pure function creepages_at(face, q, s, t, most) result(x)
        integer, intent(in) :: face       !! 1 to `n_faces`
        real(wp), intent(in) :: q, s, t   !! 0 to 1
        real(wp), intent(in) :: most      !! the largest r
        real(wp) :: x(3)                  !! normalised creepages

        real(wp) :: r
        integer :: largest

        largest = (face + 1)/2
        r = most
        if (q < most*(1.0_wp - q)) r = q/(1.0_wp - q)
        x(largest) = r
        x(others(1, largest)) = s*r
        x(others(2, largest)) = t*r
        if (modulo(face, 2) == 0) x(2) = -x(2)
    end function creepages_at
end module faststrip_lookup_faces
