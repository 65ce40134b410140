!> Creep forces on Hertz ellipses looked up in a table: no allocation, and any number of threads on
!> one table.
!>
!> With g = ln(a/b), c = sqrt(ab) and X = G ab/(mu N) (cksi, ceta, c cphi) the table holds forces
!> over x = scale(g) X (`faststrip_lookup_faces`), with `scale` Kalker's C11, C22 and C23 of the
!> nodes. For Coulomb friction and like materials forces over mu N are functions of g, X and nu
!> alone: nothing is lost by leaving out mu, N and the size.
module faststrip_lookup_hertz
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_kinds, only: wp
    use faststrip_base_limits, only: largest_size
    use faststrip_base_status, only: status_t, set_status, number_text, st_ok, &
                                     st_bad_argument, st_not_finite, st_out_of_range, st_bad_load
    use faststrip_lookup_axis, only: stencil_t, linear_stencil, cubic_stencil
    use faststrip_lookup_faces, only: faces_cell_t, find_faces_cell, sum_faces, finish_faces, &
                                      n_forces, lookup_linear, lookup_cubic
    use faststrip_lookup_table, only: lookup_t, lookup_kind_hertz
    implicit none
    private

    public :: look_up_hertz, n_lookup_state

    !> Numbers of a state: a, b (mm), N (N), mu, G (MPa), cksi, ceta, cphi (rad/mm).
    !> Given: what forces on an ellipse depend on.
    integer, parameter :: n_lookup_state = 8

contains

    !> Look forces up. Creepages may be of any size: at the end of the table all slides. a/b has to
    !> be within the table.
    pure subroutine look_up_hertz(lookup, order, state, forces, status, jacobian)
        type(lookup_t), intent(in) :: lookup           !! of `open_lookup`
        integer, intent(in) :: order                   !! `lookup_linear` or `lookup_cubic`
        real(wp), intent(in) :: state(n_lookup_state)  !! a, b, N, mu, G, cksi, ceta, cphi
        real(wp), intent(out) :: forces(n_forces)      !! Fx, Fy on the rail, N; Mz, N mm
        type(status_t), intent(inout) :: status
            !! `st_bad_argument` (no table, order; a, b, mu, G not above 0), `st_not_finite`,
            !! `st_bad_load` (N not above 0), `st_out_of_range` (a/b, creepages above 1e30)
        real(wp), intent(out), optional :: jacobian(n_forces, n_lookup_state)
            !! derivatives of the forces by the numbers of the state

        type(faces_cell_t) :: cell
        type(stencil_t) :: stencil
        real(wp) :: c, force, linear, x(3), scale(3), scale_slope(3), shape, phi(3, 4)
        real(wp) :: f(3), by_creepage(3, 3), w(0:1, 4), slope(3, 1)
        integer :: k, sets(4)

        status%code = st_ok
        forces = 0.0_wp
        if (present(jacobian)) jacobian = 0.0_wp
        if (.not. is_state(lookup, order, state)) then
            call refuse_state(lookup, order, state, status)
            return
        end if
        shape = log(state(1)/state(2))
        if (.not. (shape >= lookup%shape%x(1) .and. shape <= lookup%shape%x(lookup%shape%n))) then
            call refuse_shape(lookup, state(1)/state(2), status)
            return
        end if
        if (order == lookup_linear) then
            call linear_stencil(lookup%shape, shape, stencil)
        else
            call cubic_stencil(lookup%shape, shape, stencil)
        end if
        cell%width = merge(2, 4, order == lookup_linear)
        scale = 0.0_wp
        scale_slope = 0.0_wp
        do k = 1, cell%width
            scale = scale + stencil%w(k)*lookup%scale(:, stencil%first + k - 1)
            scale_slope = scale_slope + stencil%dw(k)*lookup%scale(:, stencil%first + k - 1)
        end do
        c = sqrt(state(1)*state(2))
        force = state(4)*state(3)
        linear = state(5)*c*c/force
        x = linear*[state(6), state(7), c*state(8)]
        scale_slope = scale_slope*x
        x = scale*x
        if (.not. maxval(abs(x)) <= largest_size) then
            call set_status(status, st_out_of_range, 'creepages beyond all proportion')
            return
        end if
        call find_faces_cell(lookup%q, lookup%ratio, order, x, cell)
        w(0, :) = stencil%w
        w(1, :) = stencil%dw
        sets = stencil%first + [0, 1, 2, 3]
        call sum_faces(lookup%values, sets(:cell%width), w(:, :cell%width), lookup%q%n, &
                       lookup%ratio%n, cell, phi, slope)
        call finish_faces(cell, phi, slope, f, by_creepage)
        forces = force*f
        forces(3) = c*forces(3)
        if (present(jacobian)) then
            slope(:, 1) = slope(:, 1) + times(by_creepage, scale_slope)
            call find_jacobian(state, c, force, linear*scale, x, f, by_creepage, slope(:, 1), &
                               jacobian)
        end if
    end subroutine look_up_hertz

    !> Derivatives of the forces by the state from those of f by x and by g.
    pure subroutine find_jacobian(state, c, force, linear, x, f, by_creepage, by_shape, jacobian)
        real(wp), intent(in) :: state(n_lookup_state)
        real(wp), intent(in) :: c, force, linear(3), x(3), f(3), by_creepage(3, 3), by_shape(3)
        real(wp), intent(out) :: jacobian(n_forces, n_lookup_state)

        real(wp) :: growth(3), by_size(3), unit(3)

        unit = [force, force, force*c]
        ! By ln(G/(mu N)): all creepages grow alike; by ln(ab) that of spin by half as much again,
        ! and so does c.
        growth = times(by_creepage, x)
        by_size = growth + 0.5_wp*by_creepage(:, 3)*x(3)
        by_size(3) = by_size(3) + 0.5_wp*f(3)
        jacobian(:, 1) = unit*(by_size + by_shape)*(1.0_wp/state(1))
        jacobian(:, 2) = unit*(by_size - by_shape)*(1.0_wp/state(2))
        jacobian(:, 3) = unit*(f - growth)*(1.0_wp/state(3))
        jacobian(:, 4) = unit*(f - growth)*(1.0_wp/state(4))
        jacobian(:, 5) = unit*growth*(1.0_wp/state(5))
        jacobian(:, 6) = unit*by_creepage(:, 1)*linear(1)
        jacobian(:, 7) = unit*by_creepage(:, 2)*linear(2)
        jacobian(:, 8) = unit*by_creepage(:, 3)*(linear(3)*c)
    end subroutine find_jacobian

    !> Matrix times vector.
    pure function times(matrix, vector) result(product)
        real(wp), intent(in) :: matrix(3, 3), vector(3)
        real(wp) :: product(3)

        product = matrix(:, 1)*vector(1) + matrix(:, 2)*vector(2) + matrix(:, 3)*vector(3)
    end function times

    !> Is there a table, an order of interpolation and a state? a/b may lie beyond the table.
    pure logical function is_state(lookup, order, state)
        type(lookup_t), intent(in) :: lookup
        integer, intent(in) :: order
        real(wp), intent(in) :: state(n_lookup_state)

        is_state = lookup%kind == lookup_kind_hertz .and. &
                   (order == lookup_linear .or. order == lookup_cubic) .and. &
                   all(ieee_is_finite(state))
        if (is_state) is_state = minval(state(:5)) > 0.0_wp
    end function is_state

    !> Say why there is none.
    pure subroutine refuse_state(lookup, order, state, status)
        type(lookup_t), intent(in) :: lookup
        integer, intent(in) :: order
        real(wp), intent(in) :: state(n_lookup_state)
        type(status_t), intent(inout) :: status

        if (lookup%kind /= lookup_kind_hertz) then
            call set_status(status, st_bad_argument, 'no lookup table of Hertz contacts')
        else if (order /= lookup_linear .and. order /= lookup_cubic) then
            call set_status(status, st_bad_argument, 'the order of interpolation must be 1 or 3')
        else if (.not. all(ieee_is_finite(state))) then
            call set_status(status, st_not_finite, 'a number of the state is not finite')
        else if (state(3) <= 0.0_wp) then
            call set_status(status, st_bad_load, 'the load must be above 0, got ' // &
                            number_text(state(3)))
        else
            call set_status(status, st_bad_argument, 'a, b, mu and G must be above 0')
        end if
    end subroutine refuse_state

    pure subroutine refuse_shape(lookup, ratio, status)
        type(lookup_t), intent(in) :: lookup
        real(wp), intent(in) :: ratio
        type(status_t), intent(inout) :: status

        call set_status(status, st_out_of_range, 'a/b must be within the table, ' // &
                        trim(number_text(exp(lookup%shape%x(1)))) // ' to ' // &
                        trim(number_text(exp(lookup%shape%x(lookup%shape%n)))) // ', got ' // &
                        number_text(ratio))
    end subroutine refuse_shape
end module faststrip_lookup_hertz
