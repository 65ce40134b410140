!> The strips of a contact: what the normal solution hands to the tangential one.
module faststrip_normal_strips
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_status, only: status_t, set_status, clear_status, count_text, &
                                     st_bad_argument
    use faststrip_numerics_reversal, only: reverse, reverse_exchanged, reverse_negated
    implicit none
    private

    public :: contact_strips_t, reserve_strips, copy_strips, mirror_strips
    public :: strip_load, strips_load, load_of, middle_of
    public :: starts_patch, ends_patch, last_of_patch
    public :: usual_strips, usual_strip_tolerance

    !> Strips across a patch where nobody says how many, and points along each.
    !> Tuned [strips]. Origin: chosen: errors against CONTACT below 2 %.
    integer, parameter :: usual_strips = 15
    !> Relative size of Newton's last step where nobody says which.
    !> Tuned [1]. Origin: far below the errors of any number of strips.
    real(wp), parameter :: usual_strip_tolerance = 1.0e-6_wp

    !> Contact patches cut into strips along the rolling direction x, each with the pressure
    !> `p(x) = p0 sqrt(1 - (x/xd)^2)` (eq. (1)). Strips are ordered by y, patches too; the first
    !> `n` entries count.
    type :: contact_strips_t
        integer :: n = 0         !! number of strips
        integer :: n_patches = 0 !! number of patches, numbered 1, 2, ... along y
        real(wp), allocatable :: y_left(:)      !! left edge, mm
        real(wp), allocatable :: y_right(:)     !! right edge, mm
        real(wp), allocatable :: half_length(:) !! xd, half-length along x, mm
        real(wp), allocatable :: p0(:)          !! pressure on the centre line, MPa
        integer, allocatable :: patch(:)        !! number of the patch the strip belongs to
        logical :: is_curved = .false.          !! has each strip its own plane?
        real(wp) :: pitch = 0.0_wp !! if so: how rail and wheel turn against each other about y,
                                   !! over the rolling speed, rad/mm
        logical :: follow_outline = .false. !! if so: are their middles where the bodies do not
                                            !! part, beside x = 0 under yaw?
        real(wp), allocatable :: inclination(:) !! of that plane, if it has, rad
        real(wp), allocatable :: depth(:)       !! of the middle below the plane of the contact, mm
        logical :: has_places = .false.         !! do they not stand side by side?
        real(wp), allocatable :: x0(:)          !! if so: where their middles are along x, mm
    end type contact_strips_t

contains

    !> Allocate for strips; the only allocation, to be done before the first solution.
    subroutine reserve_strips(strips, capacity, status)
        type(contact_strips_t), intent(inout) :: strips !! emptied and sized
        integer, intent(in) :: capacity                 !! largest number of strips, >= 1
        type(status_t), intent(out) :: status           !! `st_bad_argument`

        call clear_status(status)
        strips%n = 0
        strips%n_patches = 0
        strips%is_curved = .false.
        strips%has_places = .false.
        if (capacity < 1) then
            call set_status(status, st_bad_argument, 'capacity for strips must be at least ' &
                            // '1, got ' // count_text(capacity))
            return
        end if
        if (allocated(strips%p0)) then
            if (size(strips%p0) == capacity) return
            deallocate (strips%y_left, strips%y_right, strips%half_length, strips%p0, &
                        strips%patch, strips%inclination, strips%depth, strips%x0)
        end if
        allocate (strips%y_left(capacity), strips%y_right(capacity), &
                  strips%half_length(capacity), strips%p0(capacity), &
                  strips%inclination(capacity), strips%depth(capacity), strips%x0(capacity), &
                  source=0.0_wp)
        allocate (strips%patch(capacity), source=0)
    end subroutine reserve_strips

    !> Copy strips into others that have the capacity; as strips of one plane, side by side.
    pure subroutine copy_strips(from, to)
        type(contact_strips_t), intent(in) :: from  !! a normal solution
        type(contact_strips_t), intent(inout) :: to !! reserved for as many strips

        associate (n => from%n)
            to%n = n
            to%n_patches = from%n_patches
            to%is_curved = .false.
            to%has_places = .false.
            to%y_left(:n) = from%y_left(:n)
            to%y_right(:n) = from%y_right(:n)
            to%half_length(:n) = from%half_length(:n)
            to%p0(:n) = from%p0(:n)
            to%patch(:n) = from%patch(:n)
        end associate
    end subroutine copy_strips

    !> Mirror strips, y to -y.
    pure subroutine mirror_strips(strips)
        type(contact_strips_t), intent(inout) :: strips !! a normal solution

        associate (n => strips%n)
            call reverse_exchanged(strips%y_left(:n), strips%y_right(:n))
            call reverse(strips%half_length(:n))
            call reverse(strips%p0(:n))
            call reverse(strips%patch(:n))
            strips%patch(:n) = strips%n_patches + 1 - strips%patch(:n)
            if (strips%is_curved) call reverse_negated(strips%inclination(:n))
            if (strips%is_curved) call reverse(strips%depth(:n))
            if (strips%has_places) call reverse(strips%x0(:n))
        end associate
    end subroutine mirror_strips

    !> Load of one strip, N: integral of its pressure, `(pi/2) p0 xd w`.
    elemental real(wp) function strip_load(p0, half_length, width)
        real(wp), intent(in) :: p0          !! pressure on the centre line, MPa
        real(wp), intent(in) :: half_length !! xd, mm
        real(wp), intent(in) :: width       !! right edge less left edge, mm

        strip_load = 0.5_wp*pi*p0*half_length*width
    end function strip_load

    !> Load of all strips, N.
    pure real(wp) function strips_load(strips)
        type(contact_strips_t), intent(in) :: strips !! a normal solution

        strips_load = sum(strip_load(strips%p0(:strips%n), strips%half_length(:strips%n), &
                                     strips%y_right(:strips%n) - strips%y_left(:strips%n)))
    end function strips_load

    !> Load of one of them, N.
    pure real(wp) function load_of(strips, k)
        type(contact_strips_t), intent(in) :: strips !! a normal solution
        integer, intent(in) :: k                     !! one of its strips

        load_of = strip_load(strips%p0(k), strips%half_length(k), &
                             strips%y_right(k) - strips%y_left(k))
    end function load_of

    !> Where the middle of a strip is across, mm.
    pure real(wp) function middle_of(strips, k)
        type(contact_strips_t), intent(in) :: strips !! a normal solution
        integer, intent(in) :: k                     !! one of its strips

        middle_of = 0.5_wp*(strips%y_left(k) + strips%y_right(k))
    end function middle_of

    !> Is a strip the first of its patch?
    pure logical function starts_patch(strips, k)
        type(contact_strips_t), intent(in) :: strips !! a normal solution
        integer, intent(in) :: k                     !! one of its strips

        starts_patch = k == 1
        if (k > 1) starts_patch = strips%patch(k) /= strips%patch(k - 1)
    end function starts_patch

    !> Is a strip the last of its patch?
    pure logical function ends_patch(strips, k)
        type(contact_strips_t), intent(in) :: strips !! a normal solution
        integer, intent(in) :: k                     !! one of its strips

        ends_patch = k == strips%n
        if (k < strips%n) ends_patch = strips%patch(k + 1) /= strips%patch(k)
    end function ends_patch

    !> The last strip of the patch that strip `first` belongs to.
    pure integer function last_of_patch(strips, first) result(last)
        type(contact_strips_t), intent(in) :: strips !! a normal solution
        integer, intent(in) :: first                 !! a strip of the patch

        do last = first, strips%n - 1
            if (starts_patch(strips, last + 1)) return
        end do
        last = strips%n
    end function last_of_patch
end module faststrip_normal_strips
