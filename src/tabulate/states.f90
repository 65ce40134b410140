!> States of Hertz contacts for lookup tables: those of nodes, and fresh ones that tables are judged
!> by.
module faststrip_tabulate_states
    use faststrip_base_kinds, only: wp, pi, log_10
    use faststrip_base_status, only: status_t
    use faststrip_lookup_hertz, only: n_lookup_state
    use faststrip_tangential_kalker, only: kalker_coefficients_t, kalker_coefficients
    implicit none
    private

    public :: shape_scale, fresh_state, fresh_coordinates, drawn_creepages, most_slender

    !> Coordinates of a point that make a fresh state.
    !> Given: what it draws.
    integer, parameter :: fresh_coordinates = 8

    !> Most slender ellipse of a table, a/b or b/a.
    !> Tuned [1]. Origin: capacity: far from any contact's.
    real(wp), parameter :: most_slender = 1.0e3_wp

contains

    !> What creepages of a table are scaled by: Kalker's C11 and C22, and for spin C22 times the
    !> mean distance of the ellipse's ends from its middle over c. So spin counts as much as the
    !> lateral creepage where its pole enters the patch, which is where forces turn; the linear
    !> theory's C23 would have this happen at a ratio of 0.05 for a/b = 0.1.
    function shape_scale(log_ratio, nu, status) result(scale)
        real(wp), intent(in) :: log_ratio     !! ln(a/b)
        real(wp), intent(in) :: nu            !! Poisson's ratio
        type(status_t), intent(out) :: status !! of `kalker_coefficients`
        real(wp) :: scale(3)

        type(kalker_coefficients_t) :: c

        call kalker_coefficients(exp(log_ratio), nu, c, status)
        scale = [c%c11, c%c22, c%c22*cosh(0.5_wp*log_ratio)]
    end function shape_scale

    !> Normalised creepages of any direction, a hundredth to a hundred times what makes mu N by the
    !> linear theory; two of five lack one of them, one of five two.
    pure function drawn_creepages(point) result(x)
        real(wp), intent(in) :: point(4) !! from 0 to 1
        real(wp) :: x(3)

        real(wp) :: height, angle

        height = 2.0_wp*point(2) - 1.0_wp
        angle = 2.0_wp*pi*point(3)
        x = [height, sqrt(1.0_wp - height**2)*cos(angle), sqrt(1.0_wp - height**2)*sin(angle)]
        select case (int(15.0_wp*point(4))) ! Given: of fifteen
        case (0, 1, 2); x(3) = 0.0_wp
        case (3, 4, 5); x(1) = 0.0_wp ! Given: three more
        case (6); x(2:3) = 0.0_wp ! Given: one each
        case (7); x([1, 3]) = 0.0_wp ! Given: the same
        case (8); x(1:2) = 0.0_wp ! Given: the same
        end select
        x = x*exp(log_10*(4.0_wp*point(1) - 2.0_wp))
    end function drawn_creepages

    !> A fresh contact: a/b, size, load evenly in their logarithms, friction evenly; creepages that
    !> were drawn. Of these size, load and friction scale all there is, and make no error.
    function fresh_state(point, first, last, nu, status) result(state)
        real(wp), intent(in) :: point(fresh_coordinates) !! from 0 to 1
        real(wp), intent(in) :: first, last   !! least and largest ln(a/b)
        real(wp), intent(in) :: nu            !! Poisson's ratio
        type(status_t), intent(out) :: status !! of `shape_scale`
        real(wp) :: state(n_lookup_state)

        real(wp) :: log_ratio, x(3), c

        log_ratio = first + point(1)*(last - first)
        x = drawn_creepages(point(2:5))
        c = exp(log_10*point(6))
        state(1) = c*exp(0.5_wp*log_ratio)
        state(2) = c*exp(-0.5_wp*log_ratio)
        state(3) = exp(log_10*(3.0_wp + 3.0_wp*point(7)))
        state(4) = 1.0_wp - point(8)
        state(5) = 82000.0_wp ! Given: steel, MPa
        state(6:8) = x*state(4)*state(3) &
                     /(state(5)*c**2*shape_scale(log_ratio, nu, status)*[1.0_wp, 1.0_wp, c])
    end function fresh_state
end module faststrip_tabulate_states
