!> The part of `faststrip-lab bench speed` on a wheelset: the states of the example, each from
!> nothing and from the state before.
module faststrip_lab_studies_speed_states
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error
    use faststrip_files_csv, only: csv_table_t, read_csv, cell_text
    use faststrip_geometry_wheelset_state, only: wheelset_state_t
    use faststrip_wheelset_types, only: wheelset_model_t, wheelset_workspace_t, &
                                        wheelset_demand_t, wheelset_result_t
    use faststrip_wheelset_model, only: reserve_wheelset
    use faststrip_wheelset_solve, only: solve_wheelset
    use faststrip_lab_checkout, only: in_checkout
    use faststrip_command_program_clock, only: cpu_microseconds
    use faststrip_command_program_console, only: fail_on_error
    use faststrip_command_wheelset_case, only: wheelset_case_t, read_wheelset_case, make_model
    use faststrip_command_wheelset_states, only: given_state_t, state_columns_t, &
                                                 find_state_columns, read_state_row, take_state
    implicit none
    private

    public :: states_t, read_states, time_states, state_methods

    !> How a state is solved.
    character(len=*), parameter :: state_methods(2) = [character(len=21) :: &
        'cold start', 'from the state before']

    !> States of a wheelset, and what they took.
    type :: states_t
        type(wheelset_model_t) :: model
        type(wheelset_state_t), allocatable :: state(:)
        type(wheelset_demand_t), allocatable :: demand(:)
        character(len=16), allocatable :: name(:)
        real(wp), allocatable :: us(:, :)         !! by `state_methods`, least so far
        type(status_t), allocatable :: status(:, :)
    end type states_t

contains

    !> Read the states of the example, one for each place of the wheelset.
    subroutine read_states(quick, states, workspace)
        logical, intent(in) :: quick               !! the first few only
        type(states_t), intent(inout) :: states
        type(wheelset_workspace_t), intent(inout) :: workspace !! reserved for them

        ! Tuned [rows]: of the quick bench. Origin: chosen: five states.
        integer, parameter :: few_rows = 10
        type(wheelset_case_t) :: case
        type(csv_table_t) :: table
        type(state_columns_t) :: columns
        type(given_state_t) :: given
        type(status_t) :: status
        integer :: row, n

        call read_wheelset_case(in_checkout('example/wheelset_states.nml'), case)
        call make_model(in_checkout('example/wheelset_states.nml'), case, states%model)
        call reserve_wheelset(workspace, states%model, status)
        call fail_on_error(status)
        call read_csv(in_checkout('example/wheelset_states.csv'), table, status)
        call fail_on_error(status)
        call find_state_columns(table, columns, status)
        call fail_on_error(status)
        allocate (states%state(table%n_rows), states%demand(table%n_rows), &
                  states%name(table%n_rows))
        n = 0
        do row = 1, merge(min(few_rows, table%n_rows), table%n_rows, quick)
            call read_state_row(table, row, columns, given, status)
            call fail_on_error(status)
            ! The other wheel of the same place follows.
            if (given%side == 'right') cycle
            n = n + 1
            call take_state(given, states%model, states%state(n), states%demand(n), status)
            call fail_on_error(status)
            states%name(n) = 'state_' // cell_text(table, row, columns%case)
        end do
        states%name = states%name(:n)
        allocate (states%us(size(state_methods), n), source=huge(1.0_wp))
        allocate (states%status(size(state_methods), n))
    end subroutine read_states

    !> Time all states once; of each the least is kept.
    subroutine time_states(states, workspace)
        type(states_t), intent(inout) :: states                !! read
        type(wheelset_workspace_t), intent(inout) :: workspace !! reserved for them

        type(wheelset_result_t) :: result
        real(wp) :: from
        integer :: i, k

        do k = 1, size(state_methods)
            do i = 1, size(states%name)
                if (k == 1 .or. i == 1) workspace%has_last = .false.
                from = cpu_microseconds()
                call solve_wheelset(states%model, workspace, states%state(i), &
                                    states%demand(i), result, states%status(k, i))
                ! The first state has none before it.
                if (is_error(states%status(k, i)) .or. (k == 2 .and. i == 1)) cycle
                states%us(k, i) = min(states%us(k, i), cpu_microseconds() - from)
            end do
        end do
    end subroutine time_states
end module faststrip_lab_studies_speed_states
