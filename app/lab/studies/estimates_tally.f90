!> Estimates beside true errors, counted and summed up in a table.
module faststrip_lab_studies_estimates_tally
    use faststrip_base_kinds, only: wp
    use faststrip_base_text, only: integer_text
    use faststrip_command_program_console, only: say
    implicit none
    private

    public :: tally_t, start_tally, count_in, count_out, print_tally, figures, n_figures

    integer, parameter :: n_figures = 3

    !> What is estimated.
    character(len=*), parameter :: figures(n_figures) = [character(len=11) :: 'penetration', &
                                                         'pmax', 'area']

    real(wp), parameter :: greatest = 999.0_wp ! that fits into the table
    real(wp), parameter :: low_quantile = 0.05_wp

    !> Estimated over true errors of one estimator and family, by solution and figure.
    type :: ratios_t
        integer :: n = 0
        integer :: left_out = 0
        real(wp), allocatable :: values(:)
    end type ratios_t

    !> All that were counted.
    type :: tally_t
        type(ratios_t), allocatable :: ratios(:, :, :) !! family, solution, figure
    end type tally_t

contains

    !> Allocate for so many families and solutions; nothing is counted.
    subroutine start_tally(tally, n_families, n_solutions)
        type(tally_t), intent(out) :: tally
        integer, intent(in) :: n_families, n_solutions

        integer :: f, s, q

        allocate (tally%ratios(n_families, n_solutions, n_figures))
        do q = 1, n_figures
            do s = 1, n_solutions
                do f = 1, n_families
                    allocate (tally%ratios(f, s, q)%values(0))
                end do
            end do
        end do
    end subroutine start_tally

    !> Count an estimate and the error that it is of.
    subroutine count_in(tally, family, solution, figure, estimate, error)
        type(tally_t), intent(inout) :: tally
        integer, intent(in) :: family, solution, figure
        real(wp), intent(in) :: estimate, error !! relative, not negative

        associate (ratios => tally%ratios(family, solution, figure))
            ratios%n = ratios%n + 1
            ratios%values = [ratios%values, estimate/max(error, epsilon(1.0_wp))]
        end associate
    end subroutine count_in

    !> Count an error that is not known well enough.
    subroutine count_out(tally, family, solution, figure)
        type(tally_t), intent(inout) :: tally
        integer, intent(in) :: family, solution, figure

        associate (ratios => tally%ratios(family, solution, figure))
            ratios%left_out = ratios%left_out + 1
        end associate
    end subroutine count_out

    !> For each figure, family and solution: how many, how many of them are bounded, in percent,
    !> and of the estimated over the true errors the median and the 5 % quantile.
    subroutine print_tally(tally, name, families, solutions)
        type(tally_t), intent(in) :: tally
        character(len=*), intent(in) :: name         !! of the estimator
        character(len=*), intent(in) :: families(:), solutions(:)

        character(len=25*(size(solutions) + 2)) :: line
        real(wp), allocatable :: of_family(:), of_all(:), of_solution(:)
        integer :: f, s, q, left_out

        do q = 1, n_figures
            call say('')
            call say(trim(name) // ', ' // trim(figures(q)) // ': contacts, coverage in %, ' &
                     // 'median and 5 % quantile of estimated/true')
            line = 'family'
            do s = 1, size(solutions)
                line(14 + 22*(s - 1):) = adjustr(solutions(s))
            end do
            line(14 + 22*size(solutions):) = '               all   left out'
            call say(trim(line))
            allocate (of_all(0))
            do f = 1, size(families)
                allocate (of_family(0))
                line = families(f)
                left_out = 0
                do s = 1, size(solutions)
                    associate (ratios => tally%ratios(f, s, q))
                        line(14 + 22*(s - 1):) = cell(ratios%values)
                        of_family = [of_family, ratios%values]
                        left_out = left_out + ratios%left_out
                    end associate
                end do
                line(14 + 22*size(solutions):) = cell(of_family) // '   ' // integer_text(left_out)
                if (size(of_family) + left_out > 0) call say(trim(line))
                of_all = [of_all, of_family]
                deallocate (of_family)
            end do
            line = 'all'
            do s = 1, size(solutions)
                allocate (of_solution(0))
                do f = 1, size(families)
                    of_solution = [of_solution, tally%ratios(f, s, q)%values]
                end do
                line(14 + 22*(s - 1):) = cell(of_solution)
                deallocate (of_solution)
            end do
            line(14 + 22*size(solutions):) = cell(of_all)
            call say(trim(line))
            deallocate (of_all)
        end do
    end subroutine print_tally

    !> Four numbers in 22 characters.
    function cell(ratios) result(text)
        real(wp), intent(in) :: ratios(:)
        character(len=22) :: text

        text = ''
        if (size(ratios) == 0) return
        write (text, '(i5,i5,2f6.1)') size(ratios), &
            int(100.0_wp*count(ratios >= 1.0_wp)/size(ratios)), &
            min(quantile(ratios, 0.5_wp), greatest), min(quantile(ratios, low_quantile), greatest)
    end function cell

    !> The smallest value that a share of all values does not exceed.
    pure real(wp) function quantile(values, share)
        real(wp), intent(in) :: values(:) !! at least one
        real(wp), intent(in) :: share

        integer :: i, wanted

        wanted = max(1, ceiling(share*size(values)))
        quantile = maxval(values)
        do i = 1, size(values)
            if (values(i) < quantile .and. count(values <= values(i)) >= wanted) &
                quantile = values(i)
        end do
    end function quantile
end module faststrip_lab_studies_estimates_tally
