!> What every tangential method gives: forces, friction power, and on demand a field.
module faststrip_tangential_types
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, set_status, clear_status, count_text, &
                                     st_bad_argument, st_workspace_too_small
    implicit none
    private

    public :: strip_forces_t, reserve_strip_forces, empty_strip_forces, copy_strip_forces
    public :: tangential_result_t, tangential_field_t, reserve_field, empty_field, add_element, &
              put_element, field_power, match_power, stick_share
    public :: state_adhesion, state_slip, most_points, most_rows

    !> State of an element, the numbers CONTACT uses.
    !> Given: CONTACT's numbers.
    integer, parameter :: state_adhesion = 1
    integer, parameter :: state_slip = 2

    !> The most points along a strip.
    !> Tuned [points]. Origin: capacity.
    integer, parameter :: most_points = 1000
    !> Most rows, and most points along a row, of FASTSIM.
    !> Tuned [rows]. Origin: capacity.
    integer, parameter :: most_rows = 10000

    !> Sums over the contact; forces act on the rail.
    type :: tangential_result_t
        real(wp) :: fx = 0.0_wp !! longitudinal force, N
        real(wp) :: fy = 0.0_wp !! lateral force, N
        real(wp) :: mz = 0.0_wp !! moment about the reference point, int(x py - y px), N mm
        real(wp) :: friction_power = 0.0_wp
            !! frictional work per distance rolled (T gamma), -int(p . s), s = slip over rolling
            !! speed, N; never negative
        real(wp) :: stick_fraction = 0.0_wp !! share of the contact area in adhesion, 0 to 1
    end type tangential_result_t

    !> Tractions and slip element by element; the caller owns it and its size (`reserve_field`).
    !> The first `n` entries count.
    type :: tangential_field_t
        integer :: n = 0                 !! number of elements
        real(wp), allocatable :: x(:)    !! middle of the element, mm
        real(wp), allocatable :: y(:)    !! middle of the element, mm
        real(wp), allocatable :: dx(:)   !! side of the element along x, mm
        real(wp), allocatable :: area(:) !! area of the element, mm^2
        real(wp), allocatable :: pn(:)   !! pressure, MPa
        real(wp), allocatable :: px(:)   !! traction on the rail along x, MPa
        real(wp), allocatable :: py(:)   !! traction on the rail along y, MPa
        real(wp), allocatable :: sx(:)   !! slip (rail less wheel) over rolling speed along x, -
        real(wp), allocatable :: sy(:)   !! slip (rail less wheel) over rolling speed along y, -
        integer, allocatable :: state(:) !! `state_adhesion` or `state_slip`
        real(wp), allocatable :: temperature(:) !! of both surfaces there, C; if `has_temperature`
        logical :: has_temperature = .false.    !! was it asked for?
    end type tangential_field_t

    !> Sums over each strip; the caller owns it and its size (`reserve_strip_forces`). The first
    !> `n` entries count, in the order of the strips.
    type :: strip_forces_t
        integer :: n = 0                           !! number of strips
        real(wp), allocatable :: fx(:)             !! longitudinal force, N
        real(wp), allocatable :: fy(:)             !! lateral force, N
        real(wp), allocatable :: friction_power(:) !! frictional work per distance, N
    end type strip_forces_t

contains

    !> Allocate for the sums of strips; the only allocation, to be done before the first solution.
    subroutine reserve_strip_forces(forces, capacity, status)
        type(strip_forces_t), intent(inout) :: forces !! emptied and sized
        integer, intent(in) :: capacity               !! largest number of strips, >= 1
        type(status_t), intent(out) :: status         !! `st_bad_argument`

        call clear_status(status)
        forces%n = 0
        if (capacity < 1) then
            call set_status(status, st_bad_argument, 'capacity for strips must be at least ' &
                            // '1, got ' // count_text(capacity))
            return
        end if
        if (allocated(forces%fx)) then
            if (size(forces%fx) == capacity) return
            deallocate (forces%fx, forces%fy, forces%friction_power)
        end if
        allocate (forces%fx(capacity), forces%fy(capacity), forces%friction_power(capacity), &
                  source=0.0_wp)
    end subroutine reserve_strip_forces

    !> Copy sums over strips into others that have the capacity.
    pure subroutine copy_strip_forces(from, to)
        type(strip_forces_t), intent(in) :: from  !! of a solution, or none
        type(strip_forces_t), intent(inout) :: to !! reserved for as many strips

        associate (n => from%n)
            to%n = n
            if (n == 0) return
            to%fx(:n) = from%fx(:n)
            to%fy(:n) = from%fy(:n)
            to%friction_power(:n) = from%friction_power(:n)
        end associate
    end subroutine copy_strip_forces

    !> Empty the sums of strips that are about to be filled, if they have the capacity.
    pure subroutine empty_strip_forces(forces, n, status)
        type(strip_forces_t), intent(inout) :: forces !! reserved beforehand
        integer, intent(in) :: n                      !! number of strips
        type(status_t), intent(inout) :: status       !! changed by `st_workspace_too_small`

        integer :: capacity

        capacity = 0
        if (allocated(forces%fx)) capacity = size(forces%fx)
        forces%n = 0
        if (capacity < n) then
            call set_status(status, st_workspace_too_small, &
                            'too little capacity for the strips'' sums')
            return
        end if
        forces%n = n
        forces%fx(:n) = 0.0_wp
        forces%fy(:n) = 0.0_wp
        forces%friction_power(:n) = 0.0_wp
    end subroutine empty_strip_forces

    !> Allocate for a field; the only allocation, to be done before the first solution.
    subroutine reserve_field(field, capacity, status)
        type(tangential_field_t), intent(inout) :: field !! emptied and sized
        integer, intent(in) :: capacity                  !! largest number of elements, >= 1
        type(status_t), intent(out) :: status            !! `st_bad_argument`

        call clear_status(status)
        field%n = 0
        if (capacity < 1) then
            call set_status(status, st_bad_argument, 'capacity for elements must be at ' &
                            // 'least 1, got ' // count_text(capacity))
            return
        end if
        if (allocated(field%x)) then
            if (size(field%x) == capacity) return
            deallocate (field%x, field%y, field%dx, field%area, field%pn, field%px, field%py, &
                        field%sx, field%sy, field%state, field%temperature)
        end if
        allocate (field%x(capacity), field%y(capacity), field%dx(capacity), &
                  field%area(capacity), field%pn(capacity), field%px(capacity), &
                  field%py(capacity), field%sx(capacity), field%sy(capacity), &
                  field%temperature(capacity), source=0.0_wp)
        allocate (field%state(capacity), source=0)
    end subroutine reserve_field

    !> Empty a field that is about to be filled, if it has the capacity.
    pure subroutine empty_field(field, elements, status)
        type(tangential_field_t), intent(inout) :: field !! reserved beforehand
        integer, intent(in) :: elements                  !! number of elements to come
        type(status_t), intent(out) :: status            !! `st_workspace_too_small`

        call clear_status(status)
        field%n = 0
        if (.not. allocated(field%x)) then
            call set_status(status, st_workspace_too_small, &
                            'no workspace was reserved for the field')
        else if (size(field%x) < elements) then
            call set_status(status, st_workspace_too_small, 'too little capacity for the field')
        end if
    end subroutine empty_field

    !> Put one more element into a field that has the capacity.
    pure subroutine add_element(field, x, y, size, pn, px, py, sx, sy, state)
        type(tangential_field_t), intent(inout) :: field !! emptied by `empty_field`
        real(wp), intent(in) :: x, y   !! middle of the element, mm
        real(wp), intent(in) :: size(2) !! side along x, mm, and area, mm^2
        real(wp), intent(in) :: pn     !! pressure, MPa
        real(wp), intent(in) :: px, py !! traction on the rail, MPa
        real(wp), intent(in) :: sx, sy !! slip over rolling speed
        integer, intent(in) :: state   !! `state_adhesion` or `state_slip`

        field%n = field%n + 1
        call put_element(field, field%n, x, y, size, pn, px, py, sx, sy, state)
    end subroutine add_element

    !> Put an element into a place of a field.
    pure subroutine put_element(field, i, x, y, size, pn, px, py, sx, sy, state)
        type(tangential_field_t), intent(inout) :: field !! with the capacity
        integer, intent(in) :: i       !! place, 1 to n
        real(wp), intent(in) :: x, y   !! middle of the element, mm
        real(wp), intent(in) :: size(2) !! side along x, mm, and area, mm^2
        real(wp), intent(in) :: pn     !! pressure, MPa
        real(wp), intent(in) :: px, py !! traction on the rail, MPa
        real(wp), intent(in) :: sx, sy !! slip over rolling speed
        integer, intent(in) :: state   !! `state_adhesion` or `state_slip`

        field%x(i) = x
        field%y(i) = y
        field%dx(i) = size(1)
        field%area(i) = size(2)
        field%pn(i) = pn
        field%px(i) = px
        field%py(i) = py
        field%sx(i) = sx
        field%sy(i) = sy
        field%state(i) = state
    end subroutine put_element

    !> Share of an area in adhesion. Both are sums of the same areas, in different orders: rounding
    !> makes no share of more than all.
    pure real(wp) function stick_share(stuck, covered)
        real(wp), intent(in) :: stuck   !! area in adhesion, mm^2
        real(wp), intent(in) :: covered !! all of it, mm^2

        stick_share = 0.0_wp
        if (covered > 0.0_wp) stick_share = min(stuck/covered, 1.0_wp)
    end function stick_share

    !> Friction power density of an element, MPa: heat per area and distance rolled,
    !> `-(px sx + py sy)`; times the rolling speed the heat flux.
    pure real(wp) function field_power(field, i)
        type(tangential_field_t), intent(in) :: field !! filled
        integer, intent(in) :: i                      !! 1 to n

        field_power = -(field%px(i)*field%sx(i) + field%py(i)*field%sy(i))
    end function field_power

    !> Scale the slip of elements so that they give the friction power; by a factor of two at most,
    !> for where next to nothing slides the heat is in no element.
    pure subroutine match_power(power, first, field)
        real(wp), intent(in) :: power                    !! N
        integer, intent(in) :: first                     !! first of the elements
        type(tangential_field_t), intent(inout) :: field !! with the elements last

        real(wp) :: heat, factor
        integer :: i

        heat = 0.0_wp
        do i = first, field%n
            heat = heat + field%area(i)*field_power(field, i)
        end do
        if (heat <= 0.0_wp) return
        factor = min(max(power/heat, 0.5_wp), 2.0_wp)
        field%sx(first:field%n) = factor*field%sx(first:field%n)
        field%sy(first:field%n) = factor*field%sy(first:field%n)
    end subroutine match_power
end module faststrip_tangential_types
