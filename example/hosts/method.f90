!> Methods of one's own: springs side by side (Winkler), on any gap, under a load; and saturation.
!>
!> A type that extends `on_gap_t` or `tangential_method_t`, its `solve`, a number that the list does
!> not have, and a line that enters it: after that `solve_contact` takes it like its own, with any
!> method of the other kind.
module own_methods
    use faststrip
    use faststrip_normal_strips, only: strips_load
    use faststrip_normal_types, only: normal_result_t
    use faststrip_contact_methods, only: method_t
    implicit none
    private

    public :: springs_t, sliding_t

    integer, parameter :: most_steps = 100

    !> Springs of one stiffness.
    type, extends(on_gap_t) :: springs_t
        real(wp) :: stiffness = 2.0e3_wp !! pressure over depth, MPa/mm
    contains
        procedure :: solve
    end type springs_t

    !> All of the contact slides, whatever the spin.
    type, extends(tangential_method_t) :: sliding_t
    contains
        procedure :: solve => slide
    end type sliding_t

contains

    !> Find the depth that carries the load, by halving; each strip is as long as the parabola along
    !> x is deep.
    subroutine solve(self, workspace, case, normal, status)
        class(springs_t), intent(in) :: self          !! how stiff they are
        type(workspace_t), intent(inout) :: workspace !! its strips are filled
        type(contact_case_t), intent(in) :: case      !! load or penetration, strips
        type(normal_result_t), intent(out) :: normal  !! figures
        type(status_t), intent(out) :: status         !! `st_ok`

        real(wp) :: below, above
        integer :: step

        status = status_t()
        normal%penetration = case%penetration
        if (case%by_load) then
            below = workspace%solver%curve%h_lowest
            above = below + 1.0_wp
            do step = 1, most_steps
                normal%penetration = 0.5_wp*(below + above)
                call press(self, workspace, normal)
                if (normal%load < case%load) then
                    below = normal%penetration
                else
                    above = normal%penetration
                end if
            end do
        end if
        call press(self, workspace, normal)
        associate (strips => workspace%strips, n => workspace%strips%n)
            normal%pmax = maxval(strips%p0(:n))
            normal%x_max = maxval(strips%half_length(:n))
            normal%y_min = strips%y_left(1)
            normal%y_max = strips%y_right(n)
            normal%n_patches = strips%n_patches
        end associate
    end subroutine solve

    !> Strips between the points of the gap that lie below the penetration.
    subroutine press(self, workspace, normal)
        class(springs_t), intent(in) :: self
        type(workspace_t), intent(inout) :: workspace
        type(normal_result_t), intent(inout) :: normal ! its penetration is given

        real(wp) :: depth
        integer :: i

        associate (strips => workspace%strips, curve => workspace%solver%curve)
            strips%n = 0
            strips%n_patches = 1
            normal%area = 0.0_wp
            do i = 1, curve%n - 1
                depth = normal%penetration - 0.5_wp*(curve%h(i) + curve%h(i + 1))
                if (depth <= 0.0_wp .or. strips%n == size(strips%p0)) cycle
                associate (k => strips%n)
                    k = k + 1
                    strips%patch(k) = 1
                    strips%y_left(k) = curve%y(i)
                    strips%y_right(k) = curve%y(i + 1)
                    strips%p0(k) = self%stiffness*depth
                    strips%half_length(k) = sqrt(depth/curve%inv2r(i))
                    normal%area = normal%area + 2.0_wp*strips%half_length(k) &
                                                *(curve%y(i + 1) - curve%y(i))
                end associate
            end do
            normal%load = 0.0_wp
            if (strips%n > 0) normal%load = strips_load(strips)
        end associate
    end subroutine press

    !> Coulomb's force against the creepage.
    subroutine slide(self, workspace, case, result, status)
        class(sliding_t), intent(in) :: self                  !! nothing of its own
        type(workspace_t), intent(inout), target :: workspace !! with a normal solution
        type(contact_case_t), intent(in) :: case              !! friction, creepages
        type(contact_result_t), intent(inout) :: result       !! gets the forces
        type(status_t), intent(out) :: status                 !! `st_ok`

        real(wp) :: size

        status = status_t()
        associate (creepage => case%creepage, forces => result%tangential)
            size = hypot(creepage%cksi, creepage%ceta)
            forces%friction_power = case%mu*result%normal%load*size
            if (.not. size > 0.0_wp) return
            forces%fx = -case%mu*result%normal%load*creepage%cksi/size
            forces%fy = -case%mu*result%normal%load*creepage%ceta/size
        end associate
    end subroutine slide
end module own_methods

!> They beside strips and FASTSTRIP.
program method
    use faststrip
    use faststrip_contact_methods, only: method_t
    use own_methods, only: springs_t, sliding_t
    implicit none

    integer, parameter :: points = 301
    type(springs_t), target :: springs
    type(sliding_t), target :: sliding
    type(contact_case_t) :: case
    type(workspace_t) :: workspace
    type(contact_result_t) :: result
    type(status_t) :: status
    real(wp) :: y(points)
    integer :: i, normal(3), tangential(3)

    springs%about = method_t(101, 'springs', help='springs side by side')
    sliding%about = method_t(102, 'sliding', help='all of the contact slides')
    call enter_normal_method(workspace, springs, status)
    call enter_tangential_method(workspace, sliding, status)
    y = [(-15.0_wp + 0.1_wp*(i - 1), i=1, points)]
    case%load = 8.0e4_wp
    case%creepage = creepage_t(1.0e-3_wp, -5.0e-4_wp, 1.0e-4_wp)
    case%methods%strips_per_patch = 200
    normal = [normal_strip, springs%about%number, normal_strip]
    tangential = [tangential_faststrip, tangential_faststrip, sliding%about%number]
    do i = 1, size(normal)
        case%methods%normal = normal(i)
        case%methods%tangential = tangential(i)
        case%methods%strips_per_patch = merge(15, 200, normal(i) == normal_strip)
        call reserve_workspace(workspace, case%methods, points, status)
        call set_contact_gap(workspace, y, 2.0e-3_wp*y*y, spread(1.0_wp/920.0_wp, 1, points), &
                             status)
        call solve_contact(workspace, case, result, status)
        if (is_error(status)) error stop 'no solution'
        print '(a, i4, 4(a, f0.3))', 'method', workspace%solved_by, '  N ', result%normal%load, &
            '  pmax ', result%normal%pmax, '  Fx ', result%tangential%fx, '  Fy ', &
            result%tangential%fy
    end do
end program method
