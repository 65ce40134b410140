!> A lookup table of creep forces in memory.
module faststrip_lookup_table
    use, intrinsic :: iso_fortran_env, only: real32
    use faststrip_base_kinds, only: wp
    use faststrip_lookup_axis, only: lookup_axis_t
    implicit none
    private

    public :: lookup_t, lookup_kind_hertz, lookup_scatter_mean, lookup_scatter_percentile, &
              lookup_scatter_worst

    !> Kinds of tables.
    !> Given: numbers of the file format.
    integer, parameter :: lookup_kind_hertz = 1

    !> Second index of `errors`: mean, 99th percentile and worst.
    !> Given: numbers of the file format.
    integer, parameter :: lookup_scatter_mean = 1, lookup_scatter_percentile = 2, &
                          lookup_scatter_worst = 3

    !> A table, made by `open_lookup`. It is not changed by looking up: all threads may share one.
    type :: lookup_t
        integer :: kind = 0           !! `lookup_kind_hertz`; 0: none was opened
        real(wp) :: nu = 0.0_wp       !! Poisson's ratio that it is for
        real(wp) :: promised = 0.0_wp !! 99th percentile of the errors it was made for, over mu N
        integer :: tested = 0         !! fresh contacts on which the errors were found; 0: none
        real(wp) :: errors(3, 3, 2) = 0.0_wp
            !! of Fx, Fy over mu N, Mz over mu N c; mean, 99th percentile, worst; linear, cubic
        type(lookup_axis_t) :: q      !! share of creepage, see `faststrip_lookup_faces`
        type(lookup_axis_t) :: ratio  !! of the other creepages to the largest
        type(lookup_axis_t) :: shape  !! ln(a/b)
        real(wp), allocatable :: scale(:, :)      !! (3, shapes) creepages: x = scale X
        real(real32), allocatable :: values(:)    !! Phi over force, q, ratio, ratio, face, shape
        character(len=:), allocatable :: text     !! how it was made, lines of words
    end type lookup_t
end module faststrip_lookup_table
