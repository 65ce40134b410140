!> What influence coefficients cost inside the strip solver: columns of one strip, seen on the
!> centre lines or at the tips of all.
module faststrip_lab_grid_column_times
    use faststrip_base_kinds, only: wp
    use faststrip_command_program_clock, only: cpu_microseconds
    use faststrip_influence_center_column, only: center_influence_column, &
                                                 center_influence_column_gradient
    use faststrip_influence_tip, only: tip_influence_column, tip_influence_column_gradient
    use faststrip_normal_strips, only: contact_strips_t
    implicit none
    private

    public :: column_ns, column_names, centre, tip, centre_gradient, tip_gradient

    integer, parameter :: centre = 1, tip = 2, centre_gradient = 3, tip_gradient = 4
    !> What they are called.
    character(len=*), parameter :: column_names(4) = [character(len=23) :: &
        'centre', 'tip', 'centre with derivatives', 'tip with derivatives']

contains

    !> Time of one coefficient, ns.
    real(wp) function column_ns(kind, strips, fewest)
        integer, intent(in) :: kind                  !! which columns
        type(contact_strips_t), intent(in) :: strips !! of a solution
        integer, intent(in) :: fewest                !! coefficients that are timed at once

        real(wp), dimension(strips%n) :: y, value, d_x, d_half_length
        real(wp) :: from
        integer :: s, repetition, repetitions

        associate (n => strips%n, left => strips%y_left, right => strips%y_right, &
                   x => strips%half_length(:strips%n))
            y = 0.5_wp*(left(:n) + right(:n))
            repetitions = 1 + fewest/n**2
            from = cpu_microseconds()
            do repetition = 1, repetitions
                do s = 1, n
                    select case (kind)
                    case (centre)
                        call center_influence_column(x(s), left(s), right(s), y, value)
                    case (tip)
                        call tip_influence_column(x(s), left(s), right(s), x, y, value)
                    case (centre_gradient)
                        call center_influence_column_gradient(x(s), left(s), right(s), y, value, &
                                                              d_half_length)
                    case (tip_gradient)
                        call tip_influence_column_gradient(x(s), left(s), right(s), x, y, value, &
                                                           d_x, d_half_length)
                    end select
                end do
            end do
            column_ns = 1.0e3_wp*(cpu_microseconds() - from)/(repetitions*n**2)
        end associate
    end function column_ns
end module faststrip_lab_grid_column_times
