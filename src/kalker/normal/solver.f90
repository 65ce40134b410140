!> The pressures of a grid that minimise the potential energy: conjugate gradients with bounds.
!>
!>     minimise 1/2 p.A p + (h - D).p  over p >= 0,   with D given, or with the sum of p given,
!>
!> A the influence of the elements. In contact the deformed gap h + A p - D vanishes, elsewhere it
!> is not negative.
!>
!> After Polonsky and Keer (Wear 231, 1999) and Vollebregt (J. Sci. Comput. 59, 2014): the pressures
!> move along a conjugate direction of the elements in contact; those that become negative are cut
!> off and leave, elements that overlap enter, and the iteration goes on with the Polak-Ribiere
!> formula, whose positive part restarts it where the set has changed too much. A load is kept by
!> directions without mean.
!>
!> The preconditioner is the inverse of A on the doubled, periodic grid, cut to the elements in
!> contact, and without its mean where the load is given. Its error is what the rim of the contact
!> does, so that the number of iterations hardly depends on the number of elements.
!>
!> All is in lengths: s = H p dx, mm, with A the potential of rectangles of the sides 1 and dy/dx.
module faststrip_kalker_normal_solver
    use faststrip_base_kinds, only: wp
    use faststrip_kalker_convolution, only: convolution_t, convolve
    use faststrip_normal_types, only: demand_t
    implicit none
    private

    public :: minimiser_t, size_minimiser, task_t, minimise, minimised_t
    public :: kernel_influence, kernel_inverse, usual_tolerance, most_iterations

    !> Numbers of the kernels in the convolution's workspace.
    !> Given: numbers of kinds.
    integer, parameter :: kernel_influence = 1, kernel_inverse = 2

    ! Tuned [1]: of the tolerance: an overlap below it is none. Origin: chosen: with all of it 2 of
    ! 180 contacts change in the tenth digit.
    real(wp), parameter :: let_in_share = 0.1_wp
    !> Largest |gap| in contact over the depth, unless another is asked for.
    !> Tuned [1]. Origin: far below the errors of any grid.
    real(wp), parameter :: usual_tolerance = 1.0e-9_wp
    !> Most iterations on one grid, unless others are asked for.
    !> Tuned [iterations]. Origin: safeguard.
    integer, parameter :: most_iterations = 300

    !> Room for one grid.
    type :: minimiser_t
        real(wp), allocatable, dimension(:, :) :: s      !! start and solution, mm
        real(wp), allocatable, dimension(:, :) :: inside !! 1 in contact, else 0
        real(wp), allocatable, dimension(:, :) :: g      !! h + A s, mm
        real(wp), allocatable, dimension(:, :), private :: r, r_old, z, v, av
    end type minimiser_t

    !> What is asked: a penetration above the lowest height of the grid, or a load, whose pressures
    !> have the sum `total`.
    type, extends(demand_t) :: task_t
        real(wp) :: total = 0.0_wp         !! sum of s, mm, > 0
        real(wp) :: tolerance = usual_tolerance !! largest |gap| in contact over the depth
        integer :: max_iterations = most_iterations !! at most
        logical :: preconditioned = .true. !! or plain conjugate gradients?
    end type task_t

    !> What was found.
    type :: minimised_t
        logical :: converged = .false.  !! is the tolerance met?
        integer :: iterations = 0       !! steps
        integer :: convolutions = 0     !! convolutions, the dear part
        real(wp) :: approach = 0.0_wp   !! D, mm
        real(wp) :: residual = 0.0_wp   !! largest |gap| in contact over D - lowest height
        real(wp) :: overlap = 0.0_wp    !! largest overlap elsewhere over the same, not negative
    end type minimised_t

contains

    !> Allocate for a grid.
    subroutine size_minimiser(minimiser, nx, ny)
        type(minimiser_t), intent(inout) :: minimiser !! sized
        integer, intent(in) :: nx, ny                 !! elements along x and y

        if (allocated(minimiser%s)) then
            if (all(shape(minimiser%s) == [nx, ny])) return
            deallocate (minimiser%s, minimiser%inside, minimiser%g, minimiser%r, minimiser%r_old, &
                        minimiser%z, minimiser%v, minimiser%av)
        end if
        allocate (minimiser%s(nx, ny), minimiser%inside(nx, ny), minimiser%g(nx, ny), &
                  minimiser%r(nx, ny), minimiser%r_old(nx, ny), minimiser%z(nx, ny), &
                  minimiser%v(nx, ny), minimiser%av(nx, ny), source=0.0_wp)
    end subroutine size_minimiser

    !> Minimise from the start in `minimiser%s`; allocates nothing. A start without any pressure
    !> becomes the lowest element (load) or all that overlap (approach).
    subroutine minimise(convolution, height, task, minimiser, found)
        type(convolution_t), intent(inout) :: convolution !! with both kernels set
        real(wp), intent(in) :: height(:, :)          !! undeformed gap, mm
        type(task_t), intent(in) :: task          !! load or approach, tolerance
        type(minimiser_t), intent(inout) :: minimiser !! start and solution
        type(minimised_t), intent(out) :: found       !! how it went

        real(wp) :: lowest, depth, slope, slope_old, step, beta
        logical :: changed, fresh, first

        lowest = minval(height)
        call set_start(convolution, height, task, minimiser, found)
        first = .true.
        fresh = .true.
        changed = .true.
        slope_old = 1.0_wp
        do
            call take_residual(task, minimiser, found%approach, found%residual)
            depth = found%approach - lowest
            found%residual = found%residual/depth
            if (found%residual <= task%tolerance) then
                found%converged = .true.
                if (fresh) exit
                ! The gap was carried along; the answer is judged by one that is computed.
                call deform(convolution, height, minimiser, found)
                fresh = .true.
                found%converged = .false.
                call set_approach(task, minimiser, found%approach)
                cycle
            end if
            if (found%iterations >= task%max_iterations) exit
            found%iterations = found%iterations + 1
            call precondition(convolution, task, minimiser, found)
            call dot_products(minimiser, slope, beta)
            if (.not. slope > 0.0_wp) exit
            beta = max(beta/slope_old, 0.0_wp)
            if (first) beta = 0.0_wp
            first = .false.
            slope_old = slope
            call turn_direction(task%by_load .and. changed, beta, minimiser)
            ! Elements that came and went spoil directions.
            if (.not. work_along(minimiser) > 0.0_wp) minimiser%v = minimiser%z
            call convolve(convolution, kernel_influence, minimiser%v, minimiser%av)
            found%convolutions = found%convolutions + 1
            call step_length(minimiser, step)
            if (.not. step > 0.0_wp) exit
            call move(step, minimiser, changed)
            fresh = .false.
            if (changed) then
                if (task%by_load) minimiser%s = minimiser%s*(task%total/sum(minimiser%s))
                call deform(convolution, height, minimiser, found)
                fresh = .true.
            end if
            call set_approach(task, minimiser, found%approach)
            call let_in(found%approach - let_in_share*task%tolerance*depth, minimiser, changed)
            if (changed) call set_approach(task, minimiser, found%approach)
        end do
        found%overlap = max(maxval(found%approach - minimiser%g, mask=minimiser%inside == 0.0_wp), &
                            0.0_wp)/depth
        if (task%by_load) minimiser%s = minimiser%s*(task%total/sum(minimiser%s))
    end subroutine minimise

    !> Scale the start to the task, and see which elements are in contact.
    subroutine set_start(convolution, height, task, minimiser, found)
        type(convolution_t), intent(inout) :: convolution
        real(wp), intent(in) :: height(:, :)
        type(task_t), intent(in) :: task
        type(minimiser_t), intent(inout) :: minimiser
        type(minimised_t), intent(inout) :: found

        real(wp) :: work, energy, factor
        integer :: place(2)
        logical :: changed

        associate (s => minimiser%s)
            if (.not. any(s > 0.0_wp)) then
                place = minloc(height)
                s(place(1), place(2)) = 1.0_wp
                if (.not. task%by_load) s = max(task%penetration - height, 0.0_wp)
            end if
            minimiser%inside = merge(1.0_wp, 0.0_wp, s > 0.0_wp)
            if (task%by_load) s = s*(task%total/sum(s))
            call convolve(convolution, kernel_influence, s, minimiser%av)
            found%convolutions = 1
            factor = 1.0_wp
            if (.not. task%by_load) then
                ! The multiple of the start with the least energy.
                work = sum(s*(task%penetration - height))
                energy = sum(s*minimiser%av)
                if (work > 0.0_wp .and. energy > 0.0_wp) then
                    factor = work/energy
                    s = factor*s
                end if
            end if
            minimiser%g = height + factor*minimiser%av
        end associate
        minimiser%v = 0.0_wp
        minimiser%r = 0.0_wp
        call set_approach(task, minimiser, found%approach)
        changed = .false.
        call let_in(found%approach, minimiser, changed)
        if (changed) call set_approach(task, minimiser, found%approach)
    end subroutine set_start

    !> The deformed gap of the pressures, without the approach.
    subroutine deform(convolution, height, minimiser, found)
        type(convolution_t), intent(inout) :: convolution
        real(wp), intent(in) :: height(:, :)
        type(minimiser_t), intent(inout) :: minimiser
        type(minimised_t), intent(inout) :: found

        call convolve(convolution, kernel_influence, minimiser%s, minimiser%g)
        minimiser%g = minimiser%g + height
        found%convolutions = found%convolutions + 1
    end subroutine deform

    !> D: given, or the mean of the gap in contact.
    pure subroutine set_approach(task, minimiser, approach)
        type(task_t), intent(in) :: task
        type(minimiser_t), intent(in) :: minimiser
        real(wp), intent(inout) :: approach

        real(wp) :: total, number
        integer :: i, j

        approach = task%penetration
        if (.not. task%by_load) return
        total = 0.0_wp
        number = 0.0_wp
        do j = 1, size(minimiser%g, 2)
            !$omp simd reduction(+:total, number)
            do i = 1, size(minimiser%g, 1)
                total = total + minimiser%inside(i, j)*minimiser%g(i, j)
                number = number + minimiser%inside(i, j)
            end do
        end do
        approach = total/number
    end subroutine set_approach

    !> The residual of the elements in contact, and its largest magnitude.
    pure subroutine take_residual(task, minimiser, approach, largest)
        type(task_t), intent(in) :: task
        type(minimiser_t), intent(inout) :: minimiser
        real(wp), intent(in) :: approach
        real(wp), intent(out) :: largest

        integer :: i, j

        largest = 0.0_wp
        do j = 1, size(minimiser%g, 2)
            !$omp simd reduction(max:largest)
            do i = 1, size(minimiser%g, 1)
                minimiser%r_old(i, j) = minimiser%r(i, j)
                minimiser%r(i, j) = minimiser%inside(i, j)*(approach - minimiser%g(i, j))
                largest = max(largest, abs(minimiser%r(i, j)))
            end do
        end do
        if (.not. task%preconditioned) minimiser%z = minimiser%r
    end subroutine take_residual

    !> z, the preconditioned residual, in contact, without its mean where the load is kept.
    subroutine precondition(convolution, task, minimiser, found)
        type(convolution_t), intent(inout) :: convolution
        type(task_t), intent(in) :: task
        type(minimiser_t), intent(inout) :: minimiser
        type(minimised_t), intent(inout) :: found

        if (task%preconditioned) then
            call convolve(convolution, kernel_inverse, minimiser%r, minimiser%z)
            found%convolutions = found%convolutions + 1
        end if
        call keep_inside(task%by_load, minimiser%inside, minimiser%z)
    end subroutine precondition

    !> Cut a field to the elements in contact, and take its mean over them away if asked.
    pure subroutine keep_inside(without_mean, inside, z)
        logical, intent(in) :: without_mean
        real(wp), intent(in) :: inside(:, :)
        real(wp), intent(inout) :: z(:, :)

        real(wp) :: total, number, mean
        integer :: i, j

        total = 0.0_wp
        number = 0.0_wp
        do j = 1, size(z, 2)
            !$omp simd reduction(+:total, number)
            do i = 1, size(z, 1)
                total = total + inside(i, j)*z(i, j)
                number = number + inside(i, j)
            end do
        end do
        mean = 0.0_wp
        if (without_mean) mean = total/number
        do j = 1, size(z, 2)
            !$omp simd
            do i = 1, size(z, 1)
                z(i, j) = inside(i, j)*(z(i, j) - mean)
            end do
        end do
    end subroutine keep_inside

    !> z.r and z.(r - r_old).
    pure subroutine dot_products(minimiser, slope, beta)
        type(minimiser_t), intent(in) :: minimiser
        real(wp), intent(out) :: slope, beta

        integer :: i, j

        slope = 0.0_wp
        beta = 0.0_wp
        do j = 1, size(minimiser%z, 2)
            !$omp simd reduction(+:slope, beta)
            do i = 1, size(minimiser%z, 1)
                slope = slope + minimiser%z(i, j)*minimiser%r(i, j)
                beta = beta + minimiser%z(i, j)*(minimiser%r(i, j) - minimiser%r_old(i, j))
            end do
        end do
    end subroutine dot_products

    !> The next direction; its mean is taken away again where the set of elements has changed.
    pure subroutine turn_direction(without_mean, beta, minimiser)
        logical, intent(in) :: without_mean
        real(wp), intent(in) :: beta
        type(minimiser_t), intent(inout) :: minimiser

        integer :: i, j

        do j = 1, size(minimiser%v, 2)
            !$omp simd
            do i = 1, size(minimiser%v, 1)
                minimiser%v(i, j) = minimiser%z(i, j) &
                                    + minimiser%inside(i, j)*(beta*minimiser%v(i, j))
            end do
        end do
        if (without_mean) call keep_inside(.true., minimiser%inside, minimiser%v)
    end subroutine turn_direction

    !> v.r
    pure real(wp) function work_along(minimiser) result(work)
        type(minimiser_t), intent(in) :: minimiser

        integer :: i, j

        work = 0.0_wp
        do j = 1, size(minimiser%v, 2)
            !$omp simd reduction(+:work)
            do i = 1, size(minimiser%v, 1)
                work = work + minimiser%v(i, j)*minimiser%r(i, j)
            end do
        end do
    end function work_along

    !> How far to the least energy along the direction; not positive at the end of the arithmetic.
    pure subroutine step_length(minimiser, step)
        type(minimiser_t), intent(in) :: minimiser
        real(wp), intent(out) :: step

        real(wp) :: work, energy
        integer :: i, j

        work = work_along(minimiser)
        energy = 0.0_wp
        do j = 1, size(minimiser%v, 2)
            !$omp simd reduction(+:energy)
            do i = 1, size(minimiser%v, 1)
                energy = energy + minimiser%v(i, j)*minimiser%av(i, j)
            end do
        end do
        step = 0.0_wp
        if (work > 0.0_wp .and. energy > 0.0_wp) step = work/energy
    end subroutine step_length

    !> Go there; elements whose pressure would be negative leave the contact.
    pure subroutine move(step, minimiser, changed)
        real(wp), intent(in) :: step
        type(minimiser_t), intent(inout) :: minimiser
        logical, intent(out) :: changed

        real(wp) :: lowest
        integer :: i, j

        lowest = 0.0_wp
        do j = 1, size(minimiser%s, 2)
            !$omp simd reduction(min:lowest)
            do i = 1, size(minimiser%s, 1)
                minimiser%s(i, j) = minimiser%s(i, j) + step*minimiser%v(i, j)
                minimiser%g(i, j) = minimiser%g(i, j) + step*minimiser%av(i, j)
                lowest = min(lowest, minimiser%s(i, j))
            end do
        end do
        changed = lowest < 0.0_wp
        if (.not. changed) return
        do j = 1, size(minimiser%s, 2)
            do i = 1, size(minimiser%s, 1)
                if (minimiser%s(i, j) >= 0.0_wp) cycle
                minimiser%s(i, j) = 0.0_wp
                minimiser%inside(i, j) = 0.0_wp
            end do
        end do
    end subroutine move

    !> Let the elements in whose gap is below a level; `changed` is set if there is one.
    pure subroutine let_in(level, minimiser, changed)
        real(wp), intent(in) :: level
        type(minimiser_t), intent(inout) :: minimiser
        logical, intent(inout) :: changed

        integer :: i, j

        do j = 1, size(minimiser%s, 2)
            do i = 1, size(minimiser%s, 1)
                if (minimiser%g(i, j) >= level .or. minimiser%inside(i, j) > 0.0_wp) cycle
                minimiser%inside(i, j) = 1.0_wp
                changed = .true.
            end do
        end do
    end subroutine let_in
end module faststrip_kalker_normal_solver
