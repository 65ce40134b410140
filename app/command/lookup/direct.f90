!> Forces on a Hertz ellipse, or on strips, solved directly, for lookup tables and for judging them.
module faststrip_command_lookup_direct
    use faststrip_base_creepage, only: creepage_t
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_material, only: material_t
    use faststrip_base_status, only: status_t, clear_status, is_error, set_status, number_text, &
                                     st_no_convergence, st_bad_argument
    use faststrip_kalker_grid, only: contact_grid_t
    use faststrip_kalker_tangential, only: tang_options_t, tang_workspace_t, tang_solve, &
                                           release_tang, edges_sampled
    use faststrip_kalker_tangential_estimate, only: estimate_tang
    use faststrip_kalker_tangential_pressures, only: sample_ellipse, sample_strips
    use faststrip_lookup_faces, only: n_forces
    use faststrip_lookup_hertz, only: n_lookup_state
    use faststrip_normal_estimate_errors, only: normal_errors_t
    use faststrip_normal_simple_hertz, only: hertz_t, hertz_strips
    use faststrip_normal_strips, only: contact_strips_t, reserve_strips
    use faststrip_tangential_fastsim, only: fastsim_solve
    use faststrip_tangential_faststrip, only: faststrip_tangential_solve
    use faststrip_tangential_force_errors, only: force_errors_t, estimate_force_errors, &
                                                 errors_of_fitted
    use faststrip_tangential_types, only: tangential_result_t
    implicit none
    private

    public :: direct_choice_t, direct_t, make_workers, release_workers, note_failure
    public :: solve_direct, solve_strips
    public :: direct_methods, direct_faststrip, direct_fastsim, direct_tang, direct_auto

    !> Methods, by their numbers.
    !> Given: places in the list of names.
    integer, parameter :: direct_faststrip = 1, direct_fastsim = 2, direct_tang = 3, direct_auto = 4
    character(len=9), parameter :: direct_methods(4) = [character(len=9) :: &
        'faststrip', 'fastsim', 'tang', 'auto']

    ! Tuned [elements]: the most of TANG along each axis, for auto. Origin: cost.
    integer, parameter :: most_across = 160

    !> What a table's forces are solved by.
    type :: direct_choice_t
        integer :: method = direct_faststrip
        integer :: strips = 15   !! of FASTSTRIP, and points along each; elements of FASTSIM's side
        integer :: points = 15   !! along a strip, or elements along x
        integer :: across = 36   !! elements of TANG along each axis, the least of auto
        real(wp) :: tolerance = 0.005_wp !! of auto, over mu N and mu N c
        real(wp) :: nu = 0.28_wp !! Poisson's ratio of both bodies
    end type direct_choice_t

    !> The same with its workspace, one for a thread.
    type :: direct_t
        type(direct_choice_t) :: choice
        type(contact_strips_t) :: strips
        type(tang_workspace_t) :: tang
        type(contact_grid_t) :: grid
    end type direct_t

contains

    !> Workers of a choice, one for each thread.
    subroutine make_workers(choice, threads, workers, status)
        type(direct_choice_t), intent(in) :: choice               !! checked
        integer, intent(in) :: threads                            !! how many, >= 1
        type(direct_t), allocatable, intent(out) :: workers(:)    !! ready
        type(status_t), intent(out) :: status                     !! of the library

        integer :: i

        call clear_status(status)
        allocate (workers(threads))
        do i = 1, threads
            workers(i)%choice = choice
            call reserve_strips(workers(i)%strips, choice%strips, status)
            if (is_error(status)) return
        end do
    end subroutine make_workers

    !> Give back what the compiler does not.
    subroutine release_workers(workers)
        type(direct_t), intent(inout) :: workers(:) !! serve no more

        integer :: i

        do i = 1, size(workers)
            call release_tang(workers(i)%tang)
        end do
    end subroutine release_workers

    !> Keep the failure of the first of many solutions that threads share.
    subroutine note_failure(i, found, first, status)
        integer, intent(in) :: i                !! number of the solution
        type(status_t), intent(in) :: found     !! its error
        integer, intent(inout) :: first         !! the first that failed; beyond all: none
        type(status_t), intent(inout) :: status !! its error

        !$omp critical (lookup_failed)
        if (i < first) then
            first = i
            status = found
        end if
        !$omp end critical (lookup_failed)
    end subroutine note_failure

    !> Forces on the rail of a state, as `look_up_hertz` has them.
    subroutine solve_direct(direct, state, forces, status)
        type(direct_t), intent(inout) :: direct        !! made
        real(wp), intent(in) :: state(n_lookup_state)  !! a, b, N, mu, G, cksi, ceta, cphi
        real(wp), intent(out) :: forces(n_forces)      !! Fx, Fy, N; Mz, N mm
        type(status_t), intent(out) :: status          !! of the method

        type(hertz_t) :: hertz
        type(material_t) :: material
        type(creepage_t) :: creepage
        type(tangential_result_t) :: result
        real(wp) :: young
        logical :: is_good

        young = 2.0_wp*state(5)*(1.0_wp + direct%choice%nu)
        material = material_t(young, young, direct%choice%nu, direct%choice%nu)
        hertz%a = state(1)
        hertz%b = state(2)
        hertz%load = state(3)
        hertz%area = pi*state(1)*state(2)
        hertz%pmax = 1.5_wp*hertz%load/hertz%area ! Given: Hertz
        creepage = creepage_t(state(6), state(7), state(8))
        associate (choice => direct%choice)
            select case (choice%method)
            case (direct_fastsim)
                call fastsim_solve(hertz, material, state(4), creepage, choice%points, &
                                   choice%strips, result, status)
            case (direct_tang)
                call solve_by_tang(direct, material, state(4), creepage, choice%across, result, &
                                   status, hertz)
            case default
                call hertz_strips(hertz, choice%strips, direct%strips, status)
                if (.not. is_error(status)) &
                    call solve_by_strips(direct, material, state(4), creepage, result, is_good, &
                                         status)
                if (.not. is_error(status) .and. choice%method == direct_auto .and. .not. is_good) &
                    call refine_tang(direct, material, state(4), creepage, result, status, hertz)
            end select
        end associate
        forces = [result%fx, result%fy, result%mz]
    end subroutine solve_direct

    !> Forces on the rail of the strips in `direct%strips`; not by FASTSIM, which is for ellipses.
    subroutine solve_strips(direct, material, mu, creepage, forces, status)
        type(direct_t), intent(inout) :: direct     !! made; its strips are a normal solution
        type(material_t), intent(in) :: material    !! MPa
        real(wp), intent(in) :: mu                  !! friction, above 0
        type(creepage_t), intent(in) :: creepage    !! about the reference point; -, -, rad/mm
        real(wp), intent(out) :: forces(n_forces)   !! Fx, Fy, N; Mz, N mm
        type(status_t), intent(out) :: status       !! of the method; `st_bad_argument`: FASTSIM

        type(tangential_result_t) :: result
        logical :: is_good

        forces = 0.0_wp
        select case (direct%choice%method)
        case (direct_fastsim)
            call set_status(status, st_bad_argument, 'fastsim is for ellipses only')
        case (direct_tang)
            call solve_by_tang(direct, material, mu, creepage, direct%choice%across, result, status)
        case default
            call solve_by_strips(direct, material, mu, creepage, result, is_good, status)
            if (.not. is_error(status) .and. direct%choice%method == direct_auto .and. &
                .not. is_good) call refine_tang(direct, material, mu, creepage, result, status)
        end select
        if (.not. is_error(status)) forces = [result%fx, result%fy, result%mz]
    end subroutine solve_strips

    !> By FASTSTRIP; is its error, as estimated, within the tolerance?
    subroutine solve_by_strips(direct, material, mu, creepage, result, is_good, status)
        type(direct_t), intent(inout) :: direct ! with strips
        type(material_t), intent(in) :: material
        real(wp), intent(in) :: mu
        type(creepage_t), intent(in) :: creepage
        type(tangential_result_t), intent(out) :: result
        logical, intent(out) :: is_good
        type(status_t), intent(out) :: status

        type(force_errors_t) :: errors

        is_good = .true.
        call faststrip_tangential_solve(direct%strips, material, mu, creepage, &
                                        direct%choice%points, result, status)
        if (is_error(status) .or. direct%choice%method /= direct_auto) return
        call estimate_force_errors(direct%strips, material, mu, creepage, errors_of_fitted, &
                                   direct%choice%points, normal_errors_t(), errors, status)
        is_good = max(errors%fx, errors%fy, errors%mz) <= direct%choice%tolerance
    end subroutine solve_by_strips

    !> By TANG with more and more elements, until its error, as estimated, is within the tolerance.
    subroutine refine_tang(direct, material, mu, creepage, result, status, hertz)
        type(direct_t), intent(inout) :: direct
        type(material_t), intent(in) :: material
        real(wp), intent(in) :: mu
        type(creepage_t), intent(in) :: creepage
        type(tangential_result_t), intent(out) :: result
        type(status_t), intent(out) :: status
        type(hertz_t), intent(in), optional :: hertz ! else on the strips

        type(tangential_result_t) :: coarse
        type(force_errors_t) :: errors
        integer :: across

        across = max(direct%choice%across, 8)
        call solve_by_tang(direct, material, mu, creepage, across/2, coarse, status, hertz)
        do
            if (is_error(status)) return
            call solve_by_tang(direct, material, mu, creepage, across, result, status, hertz)
            if (is_error(status)) return
            errors = estimate_tang(direct%grid, mu, result, coarse, spread(0.0_wp, 1, 3))
            if (max(errors%fx, errors%fy, errors%mz) <= direct%choice%tolerance) return
            across = 2*across
            if (across > most_across) exit
            coarse = result
        end do
        call set_status(status, st_no_convergence, 'the tolerance was not met with ' // &
                        'so many elements: the error is estimated as ' // &
                        number_text(max(errors%fx, errors%fy, errors%mz)))
    end subroutine refine_tang

    subroutine solve_by_tang(direct, material, mu, creepage, across, result, status, hertz)
        type(direct_t), intent(inout) :: direct
        type(material_t), intent(in) :: material
        real(wp), intent(in) :: mu
        type(creepage_t), intent(in) :: creepage
        integer, intent(in) :: across
        type(tangential_result_t), intent(out) :: result
        type(status_t), intent(out) :: status
        type(hertz_t), intent(in), optional :: hertz ! else on the strips

        type(tang_options_t) :: options

        options%edges = edges_sampled
        if (present(hertz)) then
            call sample_ellipse(hertz%a, hertz%b, 0.0_wp, hertz%load, 2.0_wp*hertz%a/across, &
                                2.0_wp*hertz%b/across, 4*across**2, direct%grid, status)
        else
            associate (strips => direct%strips)
                call sample_strips(strips, 2.0_wp*maxval(strips%half_length(:strips%n))/across, &
                                   (strips%y_right(strips%n) - strips%y_left(1))/across, &
                                   4*across**2, direct%grid, status)
            end associate
        end if
        if (.not. is_error(status)) &
            call tang_solve(direct%tang, direct%grid, material, mu, creepage, options, result, &
                            status)
    end subroutine solve_by_tang
end module faststrip_command_lookup_direct
