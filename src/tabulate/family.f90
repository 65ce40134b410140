!> What a family of lookup tables is: axes that are refined, units that are solved, fresh states
!> that a table is judged by. `make` refines and fills tables of any family, `judge` finds their
!> errors; the members are `hertz` and `wheel`.
module faststrip_tabulate_family
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t
    use faststrip_lookup_axis, only: lookup_axis_t
    use faststrip_lookup_faces, only: n_forces, lookup_linear
    use faststrip_lookup_table, only: lookup_t
    use faststrip_tabulate_forces, only: choice_t
    implicit none
    private

    public :: family_t, sampled_axis_t, judged_t, note_failure, keep_quiet

    !> The most numbers of a state, sums of a state, errors of a table.
    !> Given: the largest of the families.
    integer, parameter, public :: most_numbers = 8, most_sums = 6, most_errors = 5
    !> Kinds of fresh states: over the whole table; only where contacts come or go.
    !> Given: places in arrays.
    integer, parameter, public :: states_all = 1, states_changing = 2

    !> An axis with what was solved along it: places 1, 3, 5, ... are nodes, those between them the
    !> middles of cells; one place where nothing varies.
    type :: sampled_axis_t
        integer :: kind = 0                 !! number of the axis in its family
        integer :: values = 0               !! of a sample
        integer :: samples = 0              !! of a place, of other coordinates
        integer :: jobs = 1                 !! of a place: as many samples are solved together
        ! Tuned [nodes]. Origin: capacity.
        integer :: most_nodes = 400         !! at which refining ends
        real(wp) :: least = 0.0_wp          !! cells that are not halved, in the unit of the axis
        real(wp), allocatable :: cells(:)   !! nodes of another axis, from whose cells samples are
        real(wp), allocatable :: x(:)       !! 2 n - 1 places
        real(wp), allocatable :: f(:, :, :) !! values, samples, places
    end type sampled_axis_t

    !> A fresh state and what came of it.
    type :: judged_t
        real(wp) :: state(most_numbers) = 0.0_wp    !! numbers, as they are looked up
        integer :: slot = 1                         !! contact that is looked up
        logical :: changes = .false.                !! do contacts come or go in its cell?
        logical :: is_solved = .false.              !! has it a direct solution?
        integer :: n = 0                            !! contacts of that
        real(wp) :: sums(most_sums, 0:2) = 0.0_wp   !! solved, linear, cubic
        real(wp) :: off(most_errors, 2) = 0.0_wp    !! errors, linear, cubic
    end type judged_t

    !> A family with what it takes to solve: one solver for each thread.
    type, abstract :: family_t
        type(choice_t) :: choice      !! how forces are solved
        integer :: threads = 1        !! that solve
        integer :: order = lookup_linear !! of the interpolation that axes are refined for
        integer :: n_axes = 0         !! axes of a table
        integer :: n_face_axes = 0    !! the first of them, of creepages; the others are of places
        integer :: n_numbers = 0      !! of a state
        integer :: n_sums = 0         !! of a state
        integer :: n_errors = 0       !! of a table
        integer :: n_kinds = 1        !! of fresh states
        real(wp) :: shares(2) = 0.0_wp
            !! parts of the error asked for that each axis may make to begin with: of creepages, of
            !! places
        real(wp) :: least_share = 0.0_wp !! the least part of an axis of creepages
        character(len=:), allocatable :: words !! how the table is made
        procedure(tell_progress), pointer, nopass :: progress => null() !! gets how far work is
        procedure(tell), pointer, nopass :: note => null()              !! gets what is of note
    contains
        !> First places of an axis, and the layout of its samples.
        procedure(start_i), deferred :: start
        !> Solve some samples at a place of an axis.
        procedure(sample_i), deferred :: sample
        !> What linear interpolation misses in the middle of a cell.
        procedure(cell_error_i), deferred :: cell_error
        !> Nodes of a table on such axes.
        procedure(nodes_i), deferred :: nodes
        !> A table without creep forces.
        procedure(begin_i), deferred :: begin
        !> In how many jobs a unit of the table is solved: threads share them.
        procedure(jobs_i), deferred :: jobs
        !> Solve one of the jobs of a unit.
        procedure(solve_i), deferred :: solve
        !> Fresh states.
        procedure(draw_i), deferred :: draw
        !> Solve a state and look it up.
        procedure(judge_i), deferred :: judge
        !> Look a state up, with derivatives.
        procedure(look_up_i), deferred :: look_up
        !> Put errors into a table.
        procedure(keep_i), deferred :: keep
        !> A table in a few words.
        procedure(describe_i), deferred :: describe
    end type family_t

    abstract interface
        subroutine tell_progress(what, done, total)
            character(len=*), intent(in) :: what ! is counted
            integer, intent(in) :: done, total
        end subroutine tell_progress

        subroutine tell(text)
            character(len=*), intent(in) :: text ! one line
        end subroutine tell

        subroutine start_i(self, axis, axes)
            import :: family_t, sampled_axis_t
            class(family_t), intent(in) :: self
            type(sampled_axis_t), intent(inout) :: axis ! with its number; gets places and layout
            type(sampled_axis_t), intent(in) :: axes(:) ! those before it are refined
        end subroutine start_i

        subroutine sample_i(self, me, axis, place, job, status)
            import :: family_t, sampled_axis_t, status_t
            class(family_t), intent(inout) :: self
            integer, intent(in) :: me                   ! number of the thread
            type(sampled_axis_t), intent(inout) :: axis ! its samples of the job are filled
            integer, intent(in) :: place, job
            type(status_t), intent(out) :: status
        end subroutine sample_i

        pure function cell_error_i(self, axis, middle) result(error)
            import :: family_t, sampled_axis_t, wp
            class(family_t), intent(in) :: self
            type(sampled_axis_t), intent(in) :: axis ! sampled
            integer, intent(in) :: middle            ! place
            real(wp) :: error
        end function cell_error_i

        pure function nodes_i(self, axes) result(nodes)
            import :: family_t, lookup_axis_t, wp
            class(family_t), intent(in) :: self
            type(lookup_axis_t), intent(in) :: axes(:)
            real(wp) :: nodes
        end function nodes_i

        subroutine begin_i(self, axes, lookup, status)
            import :: family_t, lookup_axis_t, lookup_t, status_t
            class(family_t), intent(inout) :: self
            type(lookup_axis_t), intent(in) :: axes(:) ! all of the family
            type(lookup_t), intent(out) :: lookup      ! its values are forgotten
            type(status_t), intent(out) :: status
        end subroutine begin_i

        pure integer function jobs_i(self, lookup) result(jobs)
            import :: family_t, lookup_t
            class(family_t), intent(in) :: self
            type(lookup_t), intent(in) :: lookup ! begun
        end function jobs_i

        subroutine solve_i(self, me, unit, job, lookup, status)
            import :: family_t, lookup_t, status_t
            class(family_t), intent(inout) :: self
            integer, intent(in) :: me, unit, job
            type(lookup_t), intent(inout) :: lookup ! begun; the values of the job are filled
            type(status_t), intent(out) :: status
        end subroutine solve_i

        subroutine draw_i(self, lookup, n, seed, kind, states, status)
            import :: family_t, lookup_t, judged_t, status_t
            class(family_t), intent(in) :: self
            type(lookup_t), intent(in) :: lookup
            integer, intent(in) :: n, seed, kind
            type(judged_t), allocatable, intent(out) :: states(:)
            type(status_t), intent(out) :: status
        end subroutine draw_i

        ! A state that has no direct solution is an error, or stays unsolved.
        subroutine judge_i(self, me, lookup, state, status)
            import :: family_t, lookup_t, judged_t, status_t
            class(family_t), intent(inout) :: self
            integer, intent(in) :: me
            type(lookup_t), intent(in) :: lookup
            type(judged_t), intent(inout) :: state
            type(status_t), intent(out) :: status
        end subroutine judge_i

        subroutine look_up_i(self, lookup, order, state, forces, status)
            import :: family_t, lookup_t, judged_t, status_t, wp, n_forces
            class(family_t), intent(in) :: self
            type(lookup_t), intent(in) :: lookup
            integer, intent(in) :: order
            type(judged_t), intent(in) :: state
            real(wp), intent(out) :: forces(n_forces)
            type(status_t), intent(out) :: status
        end subroutine look_up_i

        pure subroutine keep_i(self, errors, tested, lookup)
            import :: family_t, lookup_t, wp
            class(family_t), intent(in) :: self
            real(wp), intent(in) :: errors(:, :, :, :) ! errors; mean, percentile, worst; orders;
                                                       ! kinds of states
            integer, intent(in) :: tested(:)           ! states of each kind
            type(lookup_t), intent(inout) :: lookup
        end subroutine keep_i

        ! No function: for the length of its result gfortran keeps a variable that threads share.
        subroutine describe_i(self, lookup, text)
            import :: family_t, lookup_t
            class(family_t), intent(in) :: self
            type(lookup_t), intent(in) :: lookup
            character(len=:), allocatable, intent(out) :: text
        end subroutine describe_i
    end interface

contains

    !> Nothing is reported: neither how far work is nor what is of note.
    subroutine keep_quiet(family)
        class(family_t), intent(inout) :: family !! `progress` and `note` may be set afterwards

        family%progress => pass_over_progress
        family%note => pass_over_note
    end subroutine keep_quiet

    subroutine pass_over_progress(what, done, total)
        character(len=*), intent(in) :: what
        integer, intent(in) :: done, total
    end subroutine pass_over_progress

    subroutine pass_over_note(text)
        character(len=*), intent(in) :: text
    end subroutine pass_over_note

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
end module faststrip_tabulate_family
