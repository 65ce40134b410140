!> Capacity of a workspace: what methods that need a gap only, and those that need the strip solver,
!> have allocated for them.
module faststrip_contact_method_capacity
    use, intrinsic :: iso_fortran_env, only: int64
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, set_status, is_error, st_workspace_too_small
    use faststrip_geometry_gap_curve, only: reserve_gap_curve
    use faststrip_normal_strip, only: reserve_strip_workspace, strips_auto, strips_auto_most
    use faststrip_normal_strips, only: reserve_strips, usual_strips
    use faststrip_tangential_types, only: reserve_strip_forces
    use faststrip_contact_method, only: normal_method_t, workspace_t
    use faststrip_contact_methods, only: contact_methods_t, normal_auto
    implicit none
    private

    public :: on_gap_t, on_strips_t
    public :: per_point, per_strip, per_element
    public :: strip_capacity, check_capacity, ellipse_strips, reserve_for_strips, try_memory

    ! Tuned [strips]: capacity for those of further patches. Origin: capacity.
    integer, parameter :: spare_strips = 60
    !> Tuned [numbers]: memory of a workspace, tried before it is taken: of a point, a strip, an
    !> element. Origin: counted from the components of the workspaces, with a margin.
    integer(int64), parameter :: per_point = 36, per_strip = 200, per_element = 20
    ! Tuned [numbers]: the same of a pair of strips and of cells. Origin: counted.
    integer(int64), parameter :: per_pair = 12, at_least = 50000

    !> A normal method that needs the gap alone.
    type, abstract, extends(normal_method_t) :: on_gap_t
    contains
        procedure :: reserve => reserve_on_gap
    end type on_gap_t

    !> A normal method that needs the strip solver's workspace.
    type, abstract, extends(normal_method_t) :: on_strips_t
    contains
        procedure :: reserve => reserve_on_strips
    end type on_strips_t

contains

    !> Allocate for a gap.
    subroutine reserve_on_gap(self, workspace, methods, max_points, status)
        class(on_gap_t), intent(in) :: self            !! needs no more
        type(workspace_t), intent(inout) :: workspace  !! sized
        type(contact_methods_t), intent(in) :: methods !! resolutions
        integer, intent(in) :: max_points              !! of the gap
        type(status_t), intent(inout) :: status        !! those of `reserve_gap_curve`

        call reserve_gap_curve(workspace%solver%curve, max_points, status)
    end subroutine reserve_on_gap

    !> Allocate for a gap and the strip solver.
    subroutine reserve_on_strips(self, workspace, methods, max_points, status)
        class(on_strips_t), intent(in) :: self         !! needs no more
        type(workspace_t), intent(inout) :: workspace  !! sized
        type(contact_methods_t), intent(in) :: methods !! resolutions
        integer, intent(in) :: max_points              !! of the gap
        type(status_t), intent(inout) :: status
            !! those of `reserve_strip_workspace`; `st_workspace_too_small`, not enough memory

        integer(int64) :: capacity

        capacity = strip_capacity(methods)
        ! Tried as a whole: what the parts find missing would stop the program.
        if (workspace%solver%max_strips < capacity) &
            call try_memory(per_point*max_points + per_strip*capacity &
                            + per_pair*capacity*capacity + at_least, 'workspace', status)
        if (is_error(status)) return
        call reserve_strip_workspace(workspace%solver, int(capacity), max_points, status)
    end subroutine reserve_on_strips

    !> Allocate for strips, what each of them transmits and its wear.
    subroutine reserve_for_strips(workspace, capacity, status)
        type(workspace_t), intent(inout) :: workspace !! sized
        integer, intent(in) :: capacity               !! largest number of strips, >= 1
        type(status_t), intent(out) :: status         !! `st_bad_argument`

        call reserve_strips(workspace%strips, capacity, status)
        if (.not. is_error(status)) &
            call reserve_strip_forces(workspace%strip_forces, capacity, status)
        if (is_error(status)) return
        associate (wear => workspace%strip_wear)
            if (allocated(wear%mass)) then
                if (size(wear%mass) == capacity) return
                deallocate (wear%t_gamma_per_area, wear%mass, wear%pass_depth)
            end if
            allocate (wear%t_gamma_per_area(capacity), wear%mass(capacity), &
                      wear%pass_depth(capacity), source=0.0_wp)
        end associate
    end subroutine reserve_for_strips

    !> Is there so much memory? Tried as a whole and given back.
    subroutine try_memory(numbers, what, status)
        integer(int64), intent(in) :: numbers   !! double precision
        character(len=*), intent(in) :: what    !! that is to hold them
        type(status_t), intent(inout) :: status !! `st_workspace_too_small`: there is not

        real(wp), allocatable :: trial(:)
        integer :: failure

        allocate (trial(numbers), stat=failure)
        if (failure /= 0) call set_status(status, st_workspace_too_small, &
                                          'not enough memory for a ' // what)
    end subroutine try_memory

    !> Room for the strips of all patches together.
    pure integer function strip_capacity(methods)
        type(contact_methods_t), intent(in) :: methods !! number of strips

        strip_capacity = 2*methods%strips_per_patch + spare_strips
        if (methods%strips_per_patch == strips_auto .or. methods%normal == normal_auto) &
            strip_capacity = 2*strips_auto_most + spare_strips
    end function strip_capacity

    !> Refuse a workspace whose strip solver has too little capacity.
    pure subroutine check_capacity(workspace, methods, status)
        type(workspace_t), intent(in) :: workspace     !! reserved for some methods
        type(contact_methods_t), intent(in) :: methods !! what is asked of it
        type(status_t), intent(inout) :: status        !! `st_workspace_too_small`

        if (workspace%solver%max_strips < strip_capacity(methods)) &
            call set_status(status, st_workspace_too_small, &
                            'the workspace has capacity for fewer strips than the method may need')
    end subroutine check_capacity

    !> Strips of a patch that is an ellipse or known before its pressures.
    pure integer function ellipse_strips(methods) result(n)
        type(contact_methods_t), intent(in) :: methods !! their number, or `strips_auto`

        n = methods%strips_per_patch
        if (n == strips_auto) n = usual_strips
    end function ellipse_strips
end module faststrip_contact_method_capacity
