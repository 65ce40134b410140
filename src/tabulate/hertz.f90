!> Lookup tables of creep forces on Hertz ellipses: over a/b and three normalised creepages.
module faststrip_tabulate_hertz
    use, intrinsic :: iso_fortran_env, only: int64, real32
    use faststrip_base_creepage, only: creepage_t
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_material, only: material_t
    use faststrip_base_status, only: status_t, is_error, clear_status
    use faststrip_contact_case, only: contact_case_t
    use faststrip_contact_method, only: workspace_t, contact_result_t
    use faststrip_contact_methods, only: normal_hertz
    use faststrip_contact_reserve, only: reserve_workspace
    use faststrip_contact_solve, only: set_contact_ellipse
    use faststrip_geometry_gap, only: min_gap_points
    use faststrip_kalker_methods, only: kalker_methods_t, add_kalker, release_kalker
    use faststrip_lookup_axis, only: lookup_axis_t
    use faststrip_lookup_faces, only: n_forces, n_faces, creepages_at, lookup_linear, lookup_cubic
    use faststrip_lookup_hertz, only: look_up_hertz, n_lookup_state
    use faststrip_lookup_table, only: lookup_t, lookup_kind_hertz
    use faststrip_normal_simple_hertz, only: hertz_t
    use faststrip_tabulate_family, only: family_t, sampled_axis_t, judged_t, keep_quiet
    use faststrip_tabulate_forces, only: choice_t, solve_forces
    use faststrip_tabulate_parts, only: forget_values
    use faststrip_tabulate_points, only: scattered_point
    use faststrip_tabulate_scatter, only: percentile
    use faststrip_tabulate_states, only: shape_scale, fresh_state, fresh_coordinates
    use faststrip_base_text, only: integer_text
    implicit none
    private

    public :: hertz_family_t, make_hertz_family, release_hertz_family
    public :: first_share, least_creepage, most_creepage

    ! Axes, by their numbers.
    ! Given: their order in a table.
    integer, parameter :: axis_q = 1, axis_ratio = 2, axis_shape = 3
    ! Tuned [places]: of the other coordinates, for each cell. Origin: cost.
    integer, parameter :: n_samples = 200
    ! Tuned [1]: Percentile of the errors of a cell. Origin: chosen; kinks of the method leave worse
    ! ones anywhere.
    real(wp), parameter :: judged_at = 95.0_wp
    ! Tuned [nodes]: of an axis to begin with. Origin: chosen.
    integer, parameter :: first_nodes = 5
    !> Part of the error asked for that each axis of creepages may make to begin with.
    !> Tuned [1]. Origin: measured on FASTSTRIP's tables, and on S1002 on 60E1.
    real(wp), parameter :: first_share = 0.6_wp
    !> Creepage of a node at which nothing slides, and all does: forces there are the limits to less
    !> than the numbers of a table tell.
    !> Tuned [1]. Origin: chosen.
    real(wp), parameter :: least_creepage = 1.0e-5_wp, most_creepage = 1.0e4_wp
    ! A contact to solve for a node. None of it matters.
    ! Given: units of a table.
    real(wp), parameter :: node_size = 6.0_wp, node_load = 1.0e5_wp, node_mu = 0.3_wp, &
                           node_shear = 82000.0_wp

    !> What solves ellipses in one thread.
    type :: ellipse_solver_t
        type(workspace_t) :: workspace
        type(kalker_methods_t) :: kalker
        type(contact_case_t) :: case
        type(contact_result_t) :: result
    end type ellipse_solver_t

    type :: solver_place_t
        type(ellipse_solver_t), pointer :: at => null()
    end type solver_place_t

    !> The family.
    type, extends(family_t) :: hertz_family_t
        real(wp) :: ends(2) = 0.0_wp !! least and largest ln(a/b)
        type(solver_place_t), allocatable, private :: solver(:)
    contains
        procedure :: start => start_hertz
        procedure :: sample => sample_hertz
        procedure :: cell_error => error_of_cell
        procedure :: nodes => nodes_of_hertz
        procedure :: begin => begin_hertz
        procedure :: jobs => jobs_of_shape
        procedure :: solve => solve_line
        procedure :: draw => draw_hertz
        procedure :: judge => judge_hertz
        procedure :: look_up => look_up_state
        procedure :: keep => keep_errors
        procedure :: describe => describe_hertz
    end type hertz_family_t

contains

    !> Make the family ready to solve.
    subroutine make_hertz_family(choice, threads, ends, family, status)
        type(choice_t), intent(in) :: choice               !! how forces are solved, checked
        integer, intent(in) :: threads                     !! that solve, >= 1
        real(wp), intent(in) :: ends(2)                    !! least and largest ln(a/b)
        type(hertz_family_t), intent(inout) :: family      !! for `release_hertz_family`; quiet
        type(status_t), intent(out) :: status              !! those of `reserve_workspace`

        integer :: i

        call clear_status(status)
        call keep_quiet(family)
        family%choice = choice
        family%threads = threads
        family%ends = ends
        family%n_axes = 3
        family%n_face_axes = 3
        family%n_numbers = n_lookup_state
        family%n_sums = n_forces
        family%n_errors = n_forces
        family%shares = first_share
        allocate (family%solver(threads))
        do i = 1, threads
            allocate (family%solver(i)%at)
            associate (solver => family%solver(i)%at)
                solver%case%methods%normal = normal_hertz
                solver%case%methods%strips_per_patch = choice%strips
                call add_kalker(solver%workspace, solver%kalker, status)
                if (.not. is_error(status)) &
                    call reserve_workspace(solver%workspace, solver%case%methods, min_gap_points, &
                                           status)
                if (is_error(status)) return
            end associate
        end do
    end subroutine make_hertz_family

    !> Give back what the family has.
    subroutine release_hertz_family(family)
        type(hertz_family_t), intent(inout) :: family !! serves no more

        integer :: i

        if (.not. allocated(family%solver)) return
        do i = 1, size(family%solver)
            if (.not. associated(family%solver(i)%at)) cycle
            call release_kalker(family%solver(i)%at%kalker)
            deallocate (family%solver(i)%at)
        end do
        deallocate (family%solver)
    end subroutine release_hertz_family

    !> Coarse axes.
    subroutine start_hertz(self, axis, axes)
        class(hertz_family_t), intent(in) :: self   !! its range of a/b
        type(sampled_axis_t), intent(inout) :: axis !! with its number; gets places and layout
        type(sampled_axis_t), intent(in) :: axes(:) !! do not matter

        integer, parameter :: places = 2*first_nodes - 1
        integer :: i

        axis%values = n_forces
        axis%samples = n_samples
        axis%jobs = n_samples
        axis%x = [(real(i - 1, wp)/(places - 1), i=1, places)]
        if (axis%kind == axis_shape) axis%x = self%ends(1) + (self%ends(2) - self%ends(1))*axis%x
    end subroutine start_hertz

    !> Forces over mu N of one sample at a place of an axis; along q Phi, which is what is
    !> interpolated there.
    subroutine sample_hertz(self, me, axis, place, job, status)
        class(hertz_family_t), intent(inout) :: self !! with its solvers
        integer, intent(in) :: me                    !! number of the thread
        type(sampled_axis_t), intent(inout) :: axis  !! gets the sample
        integer, intent(in) :: place                 !! of the axis
        integer, intent(in) :: job                   !! number of the sample
        type(status_t), intent(out) :: status        !! of the method

        real(wp) :: u(5), q, s, t, log_ratio, scale(3), f(n_forces)
        integer :: face

        u = scattered_point(job, axis%kind, 5)
        face = min(1 + int(n_faces*u(5)), n_faces)
        q = u(1)
        s = u(2)
        t = u(3)
        log_ratio = self%ends(1) + u(4)*(self%ends(2) - self%ends(1))
        associate (x => axis%x(place))
            select case (axis%kind)
            case (axis_q)
                q = x
            case (axis_ratio)
                if (modulo(job, 2) == 0) s = x
                if (modulo(job, 2) == 1) t = x
            case (axis_shape)
                log_ratio = x
            end select
        end associate
        scale = shape_scale(log_ratio, self%choice%nu, status)
        if (is_error(status)) return
        call phi_at(self, me, log_ratio, scale, face, q, s, t, f, status)
        if (is_error(status)) return
        if (axis%kind /= axis_q) f = q*f
        axis%f(:, job, place) = f
    end subroutine sample_hertz

    !> What linear interpolation misses in the middle of a cell: a high percentile of the samples.
    pure function error_of_cell(self, axis, middle) result(error)
        class(hertz_family_t), intent(in) :: self !! does not matter
        type(sampled_axis_t), intent(in) :: axis  !! sampled
        integer, intent(in) :: middle             !! place
        real(wp) :: error

        real(wp) :: errors(n_samples)
        integer :: i

        do i = 1, n_samples
            errors(i) = maxval(abs(axis%f(:, i, middle) - 0.5_wp*(axis%f(:, i, middle - 1) &
                                                                  + axis%f(:, i, middle + 1))))
        end do
        error = percentile(errors, judged_at)
        if (axis%kind == axis_q) error = axis%x(middle)*error
    end function error_of_cell

    !> Nodes of a table.
    pure function nodes_of_hertz(self, axes) result(nodes)
        class(hertz_family_t), intent(in) :: self !! does not matter
        type(lookup_axis_t), intent(in) :: axes(:) !! of q, the ratios, ln(a/b)
        real(wp) :: nodes

        nodes = n_faces*axes(axis_q)%n*real(axes(axis_ratio)%n, wp)**2*axes(axis_shape)%n
    end function nodes_of_hertz

    !> A table without values.
    subroutine begin_hertz(self, axes, lookup, status)
        class(hertz_family_t), intent(inout) :: self !! its Poisson's ratio
        type(lookup_axis_t), intent(in) :: axes(:)   !! of q, the ratios, ln(a/b)
        type(lookup_t), intent(out) :: lookup        !! to be filled
        type(status_t), intent(out) :: status        !! of Kalker's coefficients

        integer :: i

        call clear_status(status)
        lookup%kind = lookup_kind_hertz
        lookup%nu = self%choice%nu
        lookup%q = axes(axis_q)
        lookup%ratio = axes(axis_ratio)
        lookup%shape = axes(axis_shape)
        allocate (lookup%scale(n_forces, lookup%shape%n))
        do i = 1, lookup%shape%n
            lookup%scale(:, i) = shape_scale(lookup%shape%x(i), self%choice%nu, status)
            if (is_error(status)) return
        end do
        allocate (lookup%values(n_forces*nint(self%nodes(axes), int64)))
        call forget_values(lookup)
        lookup%text = self%words
    end subroutine begin_hertz

    !> The lines along q of an a/b.
    pure integer function jobs_of_shape(self, lookup) result(jobs)
        class(hertz_family_t), intent(in) :: self !! does not matter
        type(lookup_t), intent(in) :: lookup      !! begun

        jobs = n_faces*lookup%ratio%n**2
    end function jobs_of_shape

    !> Solve a line along q. Each node is a cold start: no bit depends on the threads.
    subroutine solve_line(self, me, unit, job, lookup, status)
        class(hertz_family_t), intent(inout) :: self !! with its solvers
        integer, intent(in) :: me                    !! number of the thread
        integer, intent(in) :: unit                  !! which a/b
        integer, intent(in) :: job                   !! which line
        type(lookup_t), intent(inout) :: lookup      !! begun; gets the line
        type(status_t), intent(out) :: status        !! of the method, at the first node that fails

        real(wp) :: phi(n_forces)
        integer(int64) :: at
        integer :: face, i, j, k

        face = 1 + (job - 1)/lookup%ratio%n**2
        k = 1 + modulo((job - 1)/lookup%ratio%n, lookup%ratio%n)
        j = 1 + modulo(job - 1, lookup%ratio%n)
        at = int(n_forces*lookup%q%n, int64)*((unit - 1)*int(self%jobs(lookup), int64) + job - 1)
        do i = 1, lookup%q%n
            call phi_at(self, me, lookup%shape%x(unit), lookup%scale(:, unit), face, &
                        lookup%q%x(i), lookup%ratio%x(j), lookup%ratio%x(k), phi, status)
            if (is_error(status)) return
            lookup%values(at + 1:at + n_forces) = real(phi, real32)
            at = at + n_forces
        end do
    end subroutine solve_line

    !> Fresh contacts.
    subroutine draw_hertz(self, lookup, n, seed, kind, states, status)
        class(hertz_family_t), intent(in) :: self           !! does not matter
        type(lookup_t), intent(in) :: lookup                !! begun
        integer, intent(in) :: n                            !! contacts
        integer, intent(in) :: seed                         !! which ones
        integer, intent(in) :: kind                         !! there is but one
        type(judged_t), allocatable, intent(out) :: states(:)
        type(status_t), intent(out) :: status               !! of Kalker's coefficients

        integer :: i

        call clear_status(status)
        allocate (states(n))
        do i = 1, n
            states(i)%state = fresh_state(scattered_point(i, seed, fresh_coordinates), &
                                          lookup%shape%x(1), lookup%shape%x(lookup%shape%n), &
                                          lookup%nu, status)
            if (is_error(status)) return
        end do
    end subroutine draw_hertz

    !> Forces of a contact, looked up by both orders and solved.
    subroutine judge_hertz(self, me, lookup, state, status)
        class(hertz_family_t), intent(inout) :: self !! with its solvers
        integer, intent(in) :: me                    !! number of the thread
        type(lookup_t), intent(in) :: lookup         !! filled
        type(judged_t), intent(inout) :: state       !! judged
        type(status_t), intent(out) :: status        !! of looking up, of the method

        integer, parameter :: orders(2) = [lookup_linear, lookup_cubic]
        integer :: i

        associate (sums => state%sums(:n_forces, :), numbers => state%state)
            do i = 1, size(orders)
                call look_up_hertz(lookup, orders(i), numbers, sums(:, i + 1), status)
                if (is_error(status)) return
            end do
            call solve_ellipse(self, me, numbers, sums(:, 1), status)
            if (is_error(status)) return
            state%n = 1
            state%is_solved = .true.
            do i = 1, size(orders)
                associate (off => state%off(:n_forces, i))
                    off = abs(sums(:, i + 1) - sums(:, 1))/(numbers(3)*numbers(4))
                    off(n_forces) = off(n_forces)/sqrt(numbers(1)*numbers(2))
                end associate
            end do
        end associate
    end subroutine judge_hertz

    !> Look a contact up, with derivatives.
    subroutine look_up_state(self, lookup, order, state, forces, status)
        class(hertz_family_t), intent(in) :: self !! does not matter
        type(lookup_t), intent(in) :: lookup      !! filled
        integer, intent(in) :: order              !! of interpolation
        type(judged_t), intent(in) :: state       !! drawn
        real(wp), intent(out) :: forces(n_forces) !! N, N mm
        type(status_t), intent(out) :: status     !! of `look_up_hertz`

        real(wp) :: jacobian(n_forces, n_lookup_state)

        call look_up_hertz(lookup, order, state%state, forces, status, jacobian)
    end subroutine look_up_state

    !> Put errors into a table.
    pure subroutine keep_errors(self, errors, tested, lookup)
        class(hertz_family_t), intent(in) :: self  !! does not matter
        real(wp), intent(in) :: errors(:, :, :, :) !! of Fx, Fy, Mz
        integer, intent(in) :: tested(:)           !! contacts
        type(lookup_t), intent(inout) :: lookup    !! filled

        lookup%errors = errors(:, :, :, 1)
        lookup%tested = tested(1)
    end subroutine keep_errors

    !> Nodes in a few words.
    subroutine describe_hertz(self, lookup, text)
        class(hertz_family_t), intent(in) :: self !! does not matter
        type(lookup_t), intent(in) :: lookup      !! begun
        character(len=:), allocatable, intent(out) :: text !! a few words

        text = integer_text(lookup%q%n) // ' x ' // integer_text(lookup%ratio%n) // '^2, a/b ' &
               // integer_text(lookup%shape%n)
    end subroutine describe_hertz

    ! Phi of a place, solved directly.
    subroutine phi_at(self, me, log_ratio, scale, face, q, s, t, phi, status)
        class(hertz_family_t), intent(inout) :: self
        integer, intent(in) :: me
        real(wp), intent(in) :: log_ratio     ! ln(a/b)
        real(wp), intent(in) :: scale(3)      ! of the creepages there
        integer, intent(in) :: face           ! see `faststrip_lookup_faces`
        real(wp), intent(in) :: q, s, t       ! the same
        real(wp), intent(out) :: phi(n_forces)
        type(status_t), intent(out) :: status

        real(wp) :: x(3), part, forces(n_forces), linear
        real(wp) :: state(n_lookup_state)

        part = max(q, least_creepage)
        x = creepages_at(face, part, s, t, most_creepage)
        state(1) = node_size*exp(0.5_wp*log_ratio)
        state(2) = node_size*exp(-0.5_wp*log_ratio)
        state(3:5) = [node_load, node_mu, node_shear]
        linear = node_shear*node_size**2/(node_mu*node_load)
        state(6:8) = x/(scale*linear*[1.0_wp, 1.0_wp, node_size])
        call solve_ellipse(self, me, state, forces, status)
        phi = forces/(node_mu*node_load*[1.0_wp, 1.0_wp, node_size])/part
    end subroutine phi_at

    ! Forces on the rail of a state, as `look_up_hertz` has them.
    subroutine solve_ellipse(self, me, state, forces, status)
        class(hertz_family_t), intent(inout) :: self
        integer, intent(in) :: me
        real(wp), intent(in) :: state(n_lookup_state) ! a, b, N, mu, G, cksi, ceta, cphi
        real(wp), intent(out) :: forces(n_forces)     ! Fx, Fy, N; Mz, N mm
        type(status_t), intent(out) :: status

        type(hertz_t) :: hertz
        real(wp) :: young

        forces = 0.0_wp
        hertz%a = state(1)
        hertz%b = state(2)
        hertz%load = state(3)
        hertz%area = pi*state(1)*state(2)
        hertz%pmax = 1.5_wp*hertz%load/hertz%area ! Given: Hertz
        young = 2.0_wp*state(5)*(1.0_wp + self%choice%nu)
        associate (solver => self%solver(me)%at)
            solver%case%material = material_t(young, young, self%choice%nu, self%choice%nu)
            solver%case%mu = state(4)
            solver%case%creepage = creepage_t(state(6), state(7), state(8))
            call set_contact_ellipse(solver%workspace, solver%case%methods, hertz, solver%result, &
                                     status)
            if (.not. is_error(status)) &
                call solve_forces(self%choice, solver%workspace, solver%case, solver%result, &
                                  forces, status)
        end associate
    end subroutine solve_ellipse
end module faststrip_tabulate_hertz
