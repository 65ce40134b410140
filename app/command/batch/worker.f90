!> Who solves rows of a batch: one for each thread, with all that must not be shared.
module faststrip_command_batch_worker
    use, intrinsic :: iso_fortran_env, only: int64
    use faststrip_base_status, only: status_t, is_error
    use faststrip_files_csv, only: csv_table_t, csv_writer_t, collect_csv
    use faststrip_contact_plausible, only: gap_size_t
    use faststrip_command_settings_doubts, only: tally_t
    use faststrip_command_batch_gap_cache, only: own_gap_t
    use faststrip_contact_method, only: contact_result_t
    use faststrip_command_contact_solver, only: solver_t, new_solver, free_solver
    implicit none
    private

    public :: worker_t, make_workers, release_workers

    !> Who solves rows: one for each thread.
    type :: worker_t
        type(solver_t), pointer :: solver => null() !! its workspace
        type(csv_table_t) :: table      !! with the names of the columns
        type(csv_writer_t) :: writer    !! collects rows
        type(own_gap_t) :: gap          !! that the cache had no room for
        type(contact_result_t) :: result !! of the last row
        logical :: can_go_on = .false.  !! is there a solution of this chain to start from?
        logical :: tells_times = .false. !! are times written?
        type(tally_t) :: tally          !! what seems wrong in the rows so far
        integer(int64) :: size_of_gap = 0 !! number of the gap last looked at
        type(gap_size_t) :: gap_size    !! what it tells of its units
    end type worker_t

contains

    !> Workers for some threads.
    subroutine make_workers(n, table, tells_times, workers, status)
        integer, intent(in) :: n                          !! how many
        type(csv_table_t), intent(in) :: table            !! with names
        logical, intent(in) :: tells_times                !! are times written?
        type(worker_t), pointer, intent(out) :: workers(:) !! for `release_workers`
        type(status_t), intent(out) :: status             !! those of `new_solver`

        integer :: i

        allocate (workers(n))
        do i = 1, n
            call new_solver(workers(i)%solver, status)
            if (is_error(status)) return
            workers(i)%tells_times = tells_times
            workers(i)%table = table
            call collect_csv(workers(i)%writer)
        end do
    end subroutine make_workers

    !> Give back what workers have.
    subroutine release_workers(workers)
        type(worker_t), pointer, intent(inout) :: workers(:) !! none afterwards

        integer :: i

        do i = 1, size(workers)
            call free_solver(workers(i)%solver)
        end do
        deallocate (workers)
    end subroutine release_workers
end module faststrip_command_batch_worker
