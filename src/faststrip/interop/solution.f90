!> What a workspace holds of its last solution, copied into a caller's arrays for the C and F77
!> interfaces: strips, elements, steps of auto. Of a wheelset's contact they are as they are, not as
!> in the mirror that it was solved in.
module faststrip_interop_solution
    use, intrinsic :: iso_c_binding, only: c_int, c_double
    use faststrip_contact_method, only: workspace_t
    use faststrip_contact_wanted, only: unknown_error
    use faststrip_numerics_reversal, only: reverse, reverse_negated
    use faststrip_wheelset_field, only: mirror_elements
    implicit none
    private

    public :: mirror_t, strip_count, read_strips, read_elements, read_steps
    public :: read_strip_forces, read_strip_wear

    !> What a solution was mirrored in.
    type :: mirror_t
        logical :: y = .false. !! in y, as a left wheel
        logical :: x = .false. !! in x, as a wheelset that rolls backwards
    end type mirror_t

    !> What stands for an estimated error that is not known.
    !> Given: no estimate is negative.
    real(c_double), parameter :: not_known = -1.0_c_double

contains

    !> Strips of the last contact.
    pure integer function strip_count(workspace)
        type(workspace_t), intent(in) :: workspace !! solved or not

        strip_count = merge(workspace%strips%n, 0, workspace%solved_by > 0)
    end function strip_count

    !> Copy the first strips of the last contact, as many as the arrays are long.
    pure subroutine read_strips(workspace, mirror, y_left, y_right, half_length, p0, patch)
        type(workspace_t), intent(in) :: workspace             !! with so many strips
        type(mirror_t), intent(in) :: mirror                   !! that it was solved in
        real(c_double), intent(inout) :: y_left(:), y_right(:) !! edges, mm
        real(c_double), intent(inout) :: half_length(:)        !! mm
        real(c_double), intent(inout) :: p0(:)                 !! on the centre line, MPa
        integer(c_int), intent(inout) :: patch(:)              !! number of the patch

        associate (strips => workspace%strips, n => size(patch))
            half_length = strips%half_length(:n)
            p0 = strips%p0(:n)
            if (mirror%y) then
                y_left = strips%y_right(:n)
                y_right = strips%y_left(:n)
                call reverse_negated(y_left)
                call reverse_negated(y_right)
                call reverse(half_length)
                call reverse(p0)
                patch = strips%n_patches + 1 - strips%patch(n:1:-1)
            else
                y_left = strips%y_left(:n)
                y_right = strips%y_right(:n)
                patch = strips%patch(:n)
            end if
        end associate
    end subroutine read_strips

    !> Copy the first elements of the last contact, as many as the arrays are long.
    subroutine read_elements(workspace, mirror, x, y, area, pn, px, py, sx, sy, state)
        type(workspace_t), intent(in) :: workspace    !! with so many elements
        type(mirror_t), intent(in) :: mirror          !! that it was solved in
        real(c_double), intent(inout) :: x(:), y(:)   !! middle of the element, mm
        real(c_double), intent(inout) :: area(:)      !! mm^2
        real(c_double), intent(inout) :: pn(:)        !! pressure, MPa
        real(c_double), intent(inout) :: px(:), py(:) !! traction on the rail, MPa
        real(c_double), intent(inout) :: sx(:), sy(:) !! slip over rolling speed
        integer(c_int), intent(inout) :: state(:)     !! 1 adhesion, 2 slip

        associate (field => workspace%field, n => size(state))
            x = field%x(:n)
            y = field%y(:n)
            area = field%area(:n)
            pn = field%pn(:n)
            px = field%px(:n)
            py = field%py(:n)
            sx = field%sx(:n)
            sy = field%sy(:n)
            state = field%state(:n)
        end associate
        call mirror_elements([mirror%x, mirror%y], x, y, area, pn, px, py, sx, sy, state)
    end subroutine read_elements

    !> Copy what the first strips of the last contact transmit, as many as the arrays are long.
    pure subroutine read_strip_forces(workspace, mirror, fx, fy, power)
        type(workspace_t), intent(in) :: workspace    !! with forces of so many strips
        type(mirror_t), intent(in) :: mirror          !! that it was solved in
        real(c_double), intent(inout) :: fx(:), fy(:) !! on the rail, N
        real(c_double), intent(inout) :: power(:)     !! friction power over rolling speed, N

        associate (forces => workspace%strip_forces, n => size(fx))
            fx = forces%fx(:n)
            fy = forces%fy(:n)
            power = forces%friction_power(:n)
        end associate
        if (mirror%x) fx = -fx
        if (.not. mirror%y) return
        call reverse(fx)
        call reverse_negated(fy)
        call reverse(power)
    end subroutine read_strip_forces

    !> Copy the wear of the first strips of the last contact, as many as the arrays are long.
    pure subroutine read_strip_wear(workspace, mirror, density, mass, pass_depth)
        type(workspace_t), intent(in) :: workspace     !! with wear of so many strips
        type(mirror_t), intent(in) :: mirror           !! that it was solved in
        real(c_double), intent(inout) :: density(:)    !! T gamma/A, N/mm^2
        real(c_double), intent(inout) :: mass(:)       !! ug per metre rolled
        real(c_double), intent(inout) :: pass_depth(:) !! depth when rolled over once, mm

        associate (wear => workspace%strip_wear, n => size(mass))
            density = wear%t_gamma_per_area(:n)
            mass = wear%mass(:n)
            pass_depth = wear%pass_depth(:n)
        end associate
        if (.not. mirror%y) return
        call reverse(density)
        call reverse(mass)
        call reverse(pass_depth)
    end subroutine read_strip_wear

    !> Copy the first steps of the last contact by auto, as many as the arrays are long.
    pure subroutine read_steps(workspace, normal, tangential, strips, points, estimate, normal_us, &
                               tangential_us)
        type(workspace_t), intent(in) :: workspace                !! with so many steps
        integer(c_int), intent(inout) :: normal(:), tangential(:) !! methods
        integer(c_int), intent(inout) :: strips(:), points(:)
            !! strips across the widest patch, points along a strip
        real(c_double), intent(inout) :: estimate(:)
            !! of the target's error; `not_known`
        real(c_double), intent(inout) :: normal_us(:), tangential_us(:)
            !! time of the pressures and of the forces, with their estimates, us

        integer :: i

        do i = 1, size(normal)
            associate (step => workspace%steps%steps(i))
                normal(i) = step%methods%normal
                tangential(i) = step%methods%tangential
                strips(i) = step%methods%strips_per_patch
                points(i) = step%methods%points_per_strip
                estimate(i) = merge(step%estimate, not_known, step%estimate < unknown_error)
                normal_us(i) = step%normal_us
                tangential_us(i) = step%tangential_us
            end associate
        end do
    end subroutine read_steps
end module faststrip_interop_solution
