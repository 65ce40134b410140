!> A lookup table of creep forces in memory.
module faststrip_lookup_table
    use, intrinsic :: iso_fortran_env, only: real32
    use faststrip_base_kinds, only: wp
    use faststrip_lookup_axis, only: lookup_axis_t, make_axis
    implicit none
    private

    public :: lookup_t, wheel_part_t, lookup_kind_hertz, lookup_kind_wheel
    public :: n_contact_numbers, most_slots, n_wheel_errors, rise_power, set_rise
    public :: at_load, at_angle, at_rail_y, at_rail_z, at_ahead, at_wheel_y, at_radius, at_height, &
              at_area, at_pmax, at_length, at_creep, at_spin

    !> Kinds of tables.
    !> Given: numbers of the file format.
    integer, parameter :: lookup_kind_hertz = 1, lookup_kind_wheel = 2

    !> Numbers of a contact of a wheel: normal force, N; contact angle, rad; y, z on the rail's
    !> profile, mm; place ahead of the wheelset's centre, mm; y on the wheel's profile, mm; rolling
    !> radius, mm; height of the wheelset's centre, mm; area, mm2; maximum pressure, MPa; length c
    !> of the moment, mm; two squared lengths of cksi and ceta, mm2, and a cubed one of cphi, mm3:
    !> over mu N and times G they normalise the creepages.
    !> Given: numbers of the file format.
    integer, parameter :: n_contact_numbers = 14
    integer, parameter :: at_load = 1, at_angle = 2, at_rail_y = 3, at_rail_z = 4, at_ahead = 5, &
                          at_wheel_y = 6, at_radius = 7, at_height = 8, at_area = 9, &
                          at_pmax = 10, at_length = 11, at_creep = 12, at_spin = 14
    !> The most contacts of a wheel in a table.
    !> Tuned [contacts]. Origin: capacity.
    integer, parameter :: most_slots = 6
    !> Errors of a wheel's table: creep forces ahead and across, their moment, all over mu times the
    !> normal forces; the lateral part of the normal forces, over them; the height z, as the load
    !> that it makes by Hertz' law, over the load.
    !> Given: numbers of the file format.
    integer, parameter :: n_wheel_errors = 5

    !> Power of the load that penetration grows with, and so the height.
    !> Given: Hertz' law.
    real(wp), parameter :: rise_power = 2.0_wp/3.0_wp

    !> What the table of a wheel on a rail has beside the faces.
    type :: wheel_part_t
        type(lookup_axis_t) :: y     !! of the wheelset over the rail, mm
        type(lookup_axis_t) :: yaw   !! rad; of one node where it does not vary
        type(lookup_axis_t) :: load  !! vertical part of the normal forces, N
        type(lookup_axis_t) :: rise  !! its nodes to the power 2/3: between them z has its place
        real(wp) :: shear = 0.0_wp   !! modulus of both bodies, MPa
        integer :: slots = 0         !! contacts that there can be
        integer :: sets = 0          !! sets of faces, two to each contact that was solved
        real(wp), allocatable :: contacts(:, :, :)
            !! numbers, slots, nodes: y fastest, then yaw. Of N the number itself; area, pmax and
            !! the lengths are over those powers of N that Hertz' law has: 2/3, 1/3; 1/3, 2/3, 2/3,
            !! 1
        integer, allocatable :: set(:, :) !! slots, nodes: number of the contact whose faces count
        integer :: tested(2) = 0     !! fresh states: all; those in cells where contacts appear
        integer :: n_errors = n_wheel_errors !! that are known: the first four in older files
        real(wp) :: errors(n_wheel_errors, 3, 2, 2) = 0.0_wp
            !! mean, 99th percentile, worst; linear, cubic; as `tested`
    end type wheel_part_t

    !> A table, made by `open_lookup`. It is not changed by looking up: all threads may share one.
    type :: lookup_t
        integer :: kind = 0           !! one of the kinds; 0: none was opened
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
        type(wheel_part_t) :: wheel               !! of a wheel on a rail; then without `shape`
        character(len=:), allocatable :: text     !! how it was made, lines of words
    end type lookup_t

contains

    !> The axis along which z is interpolated between loads.
    pure subroutine set_rise(wheel)
        type(wheel_part_t), intent(inout) :: wheel
            !! with its loads; without nodes where a load is not above 0

        call make_axis([real(wp) ::], wheel%rise)
        if (wheel%load%n < 1) return
        if (wheel%load%x(1) > 0.0_wp) call make_axis(wheel%load%x**rise_power, wheel%rise)
    end subroutine set_rise
end module faststrip_lookup_table
