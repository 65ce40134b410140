!> Rigid slip of strips that have their own: on a curved surface, or at places along x (S15 of
!> `faststrip_tangential_faststrip`).
!>
!> A patch rolls with the mean by load of its strips' motion; its strips or rows have the rest
!> besides. Rows and elements stand between the middles of strips, linearly.
module faststrip_tangential_strip_slip
    use faststrip_base_kinds, only: wp
    use faststrip_base_limits, only: nothing
    use faststrip_base_creepage, only: creepage_t
    use faststrip_normal_strips, only: contact_strips_t, load_of, middle_of
    implicit none
    private

    public :: strip_slip, patch_motion, curved_motion, rest_of_slip, slip_between, add_between

contains

    !> What a strip on a curved surface has of slip, at its middle, and of spin beside the plane of
    !> the contact.
    !>
    !> The rail moves over the wheel with the creepages and the spin at the reference point, and
    !> turns about y at `pitch`. At the depth z that adds `pitch z` along x. Of the lateral creepage
    !> the part along a strip inclined by a is `ceta cos a`; of the turning the part along its
    !> normal is its spin, `cphi cos a - pitch sin a`. Bodies of a wheelset that yaws touch where
    !> they do not part, beside x = 0 by `-vy tan a/pitch`, vy the lateral velocity there, and
    !> strips lie there: the slip has no part along the normal and is, along the strip,
    !>
    !>     ceta/(cos a + cphi/pitch sin a)
    !>
    !> In one plane spin adds `cphi x0` across at a place x0 ahead of the others.
    pure type(creepage_t) function strip_slip(strips, k, plane) result(own)
        type(contact_strips_t), intent(in) :: strips !! laid on a curved surface, or with places
        integer, intent(in) :: k                     !! one of them
        type(creepage_t), intent(in) :: plane        !! of the contact, about y = 0

        real(wp) :: sine, cosine, lost

        if (strips%has_places .and. .not. (strips%is_curved .and. strips%follow_outline)) &
            own%ceta = plane%cphi*strips%x0(k)
        if (.not. strips%is_curved) return
        sine = sin(strips%inclination(k))
        ! 1 - cos a
        lost = 2.0_wp*sin(0.5_wp*strips%inclination(k))**2
        own%cksi = strips%pitch*strips%depth(k)
        own%cphi = -plane%cphi*lost - strips%pitch*sine
        if (strips%follow_outline) then
            cosine = cos(strips%inclination(k)) + plane%cphi/strips%pitch*sine
            own%ceta = own%ceta + plane%ceta*((1.0_wp - cosine)/max(cosine, 0.25_wp))
        else
            own%ceta = own%ceta - plane%ceta*lost
        end if
    end function strip_slip

    !> The motion of a patch, about the reference point: the mean by load of its strips' own.
    pure type(creepage_t) function patch_motion(strips, first, last, plane) result(mean)
        type(contact_strips_t), intent(in) :: strips !! with slip of their own
        integer, intent(in) :: first, last           !! of the patch
        type(creepage_t), intent(in) :: plane        !! of the contact, about y = 0

        type(creepage_t) :: own
        real(wp) :: load, part, arm
        integer :: k

        load = 0.0_wp
        arm = 0.0_wp
        mean = creepage_t()
        do k = first, last
            part = load_of(strips, k)
            own = strip_slip(strips, k, plane)
            load = load + part
            arm = arm + part*middle_of(strips, k)
            mean = creepage_t(mean%cksi + part*own%cksi, mean%ceta + part*own%ceta, &
                              mean%cphi + part*own%cphi)
        end do
        load = max(load, nothing)
        mean = creepage_t(plane%cksi + (mean%cksi + mean%cphi/load*arm)/load, &
                          plane%ceta + mean%ceta/load, plane%cphi + mean%cphi/load)
    end function patch_motion

    !> The same of methods that have no places along x: in the plane that of the contact.
    pure type(creepage_t) function curved_motion(strips, first, last, plane) result(motion)
        type(contact_strips_t), intent(in) :: strips !! laid
        integer, intent(in) :: first, last           !! of the patch
        type(creepage_t), intent(in) :: plane        !! of the contact, about y = 0

        motion = plane
        if (strips%is_curved) motion = patch_motion(strips, first, last, plane)
    end function curved_motion

    !> What is left of the slip of a strip, a row or an element beside the motion of its patch.
    pure type(creepage_t) function rest_of_slip(own, y, plane, motion) result(rest)
        type(creepage_t), intent(in) :: own    !! beside the plane
        real(wp), intent(in) :: y              !! its place, mm
        type(creepage_t), intent(in) :: plane  !! of the contact
        type(creepage_t), intent(in) :: motion !! of the patch

        rest%cksi = own%cksi - (motion%cksi - plane%cksi) + y*(motion%cphi - plane%cphi)
        rest%ceta = own%ceta - (motion%ceta - plane%ceta)
        rest%cphi = own%cphi - (motion%cphi - plane%cphi)
    end function rest_of_slip

    !> `strip_slip` at a place across.
    pure type(creepage_t) function slip_between(strips, first, last, y, plane) result(own)
        type(contact_strips_t), intent(in) :: strips !! with slip of their own
        integer, intent(in) :: first, last           !! of those that count
        real(wp), intent(in) :: y                    !! the place, mm
        type(creepage_t), intent(in) :: plane        !! of the contact, about y = 0

        type(creepage_t) :: left, right
        real(wp) :: share
        integer :: k, next

        call find_between(strips, first, last, y, k, next, share)
        left = strip_slip(strips, k, plane)
        right = strip_slip(strips, next, plane)
        own%cksi = left%cksi + share*(right%cksi - left%cksi)
        own%ceta = left%ceta + share*(right%ceta - left%ceta)
        own%cphi = left%cphi + share*(right%cphi - left%cphi)
    end function slip_between

    !> Share a force at a place across between the strips about it.
    pure subroutine add_between(strips, first, last, y, force, fx, fy)
        type(contact_strips_t), intent(in) :: strips !! laid
        integer, intent(in) :: first, last           !! of those that count
        real(wp), intent(in) :: y                    !! the place, mm
        real(wp), intent(in) :: force(2)             !! along x and y, N
        real(wp), intent(inout) :: fx(:), fy(:)      !! of each strip, N

        real(wp) :: share
        integer :: k, next

        call find_between(strips, first, last, y, k, next, share)
        fx(k) = fx(k) + (1.0_wp - share)*force(1)
        fy(k) = fy(k) + (1.0_wp - share)*force(2)
        fx(next) = fx(next) + share*force(1)
        fy(next) = fy(next) + share*force(2)
    end subroutine add_between

    !> The strips whose middles a place lies between, and how far on the way from one to the next;
    !> beyond their edges as there.
    pure subroutine find_between(strips, first, last, y, k, next, share)
        type(contact_strips_t), intent(in) :: strips
        integer, intent(in) :: first, last
        real(wp), intent(in) :: y
        integer, intent(out) :: k, next
        real(wp), intent(out) :: share ! 0 at the middle of k, 1 at that of the next

        next = min(first + 1, last)
        do k = first, last - 2
            if (y < middle_of(strips, next)) exit
            next = next + 1
        end do
        share = 0.0_wp
        if (next == k) return
        share = (y - middle_of(strips, k))/(middle_of(strips, next) - middle_of(strips, k))
        share = 0.5_wp + max(-1.0_wp, min(share - 0.5_wp, 1.0_wp))
    end subroutine find_between
end module faststrip_tangential_strip_slip
