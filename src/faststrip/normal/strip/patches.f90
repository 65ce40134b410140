!> The patches of a strip solution while their ends are being sought, and the strips of one pass:
!> how many strips each patch gets, and how patches appear, meet, are cut and split.
module faststrip_normal_strip_patches
    use faststrip_base_kinds, only: wp
    use faststrip_base_limits, only: beyond_all
    implicit none
    private

    public :: patch_t, patches_t, max_patches, fewest_strips, fewest_strips_small_patch
    public :: pass_strips_t, reserve_pass_strips
    public :: share_strips, only_match, nearest_patch, take_in, sort_patches, join_met_patches
    public :: cut_leaving_strips, free_ends, drop_slivers, mirror_patches

    !> Most patches a contact may have at a time.
    !> Tuned [patches]. Origin: capacity.
    integer, parameter :: max_patches = 16
    !> Fewest strips a patch can be cut into.
    !> Given: its ends are extrapolated by a parabola through three.
    integer, parameter :: fewest_strips = 3
    !> A second patch gets fewer strips than the largest, in proportion to its width, but these.
    !> Tuned [strips]. Origin: chosen for the errors of small patches.
    integer, parameter :: fewest_strips_small_patch = 9

    !> One patch while its ends are sought.
    type :: patch_t
        real(wp) :: y_from = 0.0_wp, y_to = 0.0_wp ! ends, mm
        integer :: n_strips = 0
        ! How it starts, until it was solved once: length and pressure in its middle, falling off
        ! with the gap up to a level, or to its ends where that is zero; mm, MPa, mm.
        real(wp) :: seed_length = 0.0_wp, seed_pressure = 0.0_wp, seed_level = 0.0_wp
        ! Ends at which strips left: the true ends lie further in.
        real(wp) :: too_far_from = -beyond_all, too_far_to = beyond_all
        logical :: meets_next = .false. ! is its right end the left end of the next one?
    end type patch_t

    !> The patches of one pass, in the order of y.
    type :: patches_t
        integer :: n = 0
        type(patch_t) :: at(max_patches)
    end type patches_t

    !> Strips with given edges and their unknowns; the first `n` entries count. Owned by the caller.
    type :: pass_strips_t
        integer :: n = 0
        real(wp) :: penetration = 0.0_wp       !! D above the lowest height, mm
        real(wp), allocatable :: y_left(:)     !! left edges, mm
        real(wp), allocatable :: y_right(:)    !! right edges, mm
        real(wp), allocatable :: height(:)     !! h on the centre lines, above the lowest, mm
        real(wp), allocatable :: inv2r(:)      !! A on the centre lines, positive, 1/mm
        real(wp), allocatable :: p0(:)         !! pressures on the centre lines, MPa
        real(wp), allocatable :: half_length(:) !! xd, mm
        logical, allocatable :: leaves(:)      !! strips to be cut off
        ! Work of the equations.
        real(wp), allocatable :: y(:)          !! centre lines
    end type pass_strips_t

contains

    !> Allocate for up to `capacity` strips; the only allocation.
    subroutine reserve_pass_strips(strips, capacity)
        type(pass_strips_t), intent(inout) :: strips !! sized
        integer, intent(in) :: capacity              !! >= 1

        if (allocated(strips%p0)) then
            if (size(strips%p0) >= capacity) return
            deallocate (strips%y_left, strips%y_right, strips%height, strips%inv2r, strips%p0, &
                        strips%half_length, strips%leaves, strips%y)
        end if
        allocate (strips%y_left(capacity), strips%y_right(capacity), strips%height(capacity), &
                  strips%inv2r(capacity), strips%p0(capacity), strips%half_length(capacity), &
                  strips%y(capacity), source=0.0_wp)
        allocate (strips%leaves(capacity), source=.false.)
    end subroutine reserve_pass_strips

    !> Number of strips of each patch, in proportion to its width.
    pure subroutine share_strips(strips_per_patch, patches)
        integer, intent(in) :: strips_per_patch
        type(patches_t), intent(inout) :: patches

        real(wp) :: widest
        integer :: p, fewest

        widest = maxval(patches%at(:patches%n)%y_to - patches%at(:patches%n)%y_from)
        fewest = min(fewest_strips_small_patch, strips_per_patch)
        do p = 1, patches%n
            patches%at(p)%n_strips = max(fewest, nint(strips_per_patch &
                                      *(patches%at(p)%y_to - patches%at(p)%y_from)/widest))
        end do
    end subroutine share_strips

    !> The old patch that overlaps new patch p and no other new patch, if p overlaps no other; or 0.
    pure integer function only_match(old, patches, p) result(match)
        type(patches_t), intent(in) :: old, patches
        integer, intent(in) :: p

        integer :: q

        match = 0
        do q = 1, old%n
            if (.not. overlap(old, q, patches, p)) cycle
            if (match > 0) then
                match = 0
                return
            end if
            match = q
        end do
        if (match == 0) return
        do q = 1, patches%n
            if (q /= p .and. overlap(old, match, patches, q)) then
                match = 0
                return
            end if
        end do
    end function only_match

    pure logical function overlap(old, q, patches, p)
        type(patches_t), intent(in) :: old, patches
        integer, intent(in) :: q, p

        overlap = old%at(q)%y_from < patches%at(p)%y_to .and. old%at(q)%y_to > patches%at(p)%y_from
    end function overlap

    pure integer function nearest_patch(patches, y) result(nearest)
        type(patches_t), intent(in) :: patches
        real(wp), intent(in) :: y

        integer :: n

        n = patches%n
        nearest = minloc(max(patches%at(:n)%y_from - y, y - patches%at(:n)%y_to, 0.0_wp), dim=1)
    end function nearest_patch

    !> Add a stretch of overlap to the patches: to the neighbour it touches, or as a patch.
    pure subroutine take_in(seed, low, high, dy, patches, changed)
        type(patch_t), intent(in) :: seed    !! the stretch that overlaps, ready to be a patch
        real(wp), intent(in) :: low, high    !! the stretch that was scanned, mm
        real(wp), intent(in) :: dy           !! spacing of the scan, mm
        type(patches_t), intent(inout) :: patches !! extended, or with one more at the end
        logical, intent(inout) :: changed    !! set if there is anything to solve anew

        integer :: p
        logical :: touches, is_wide

        touches = .false.
        ! Of more than one place: it moves the end of the patch it touches.
        is_wide = nint((seed%y_to - seed%y_from)/dy) > 1
        do p = 1, patches%n
            if (seed%y_from < low + 0.5_wp*dy .and. patches%at(p)%y_from < low &
                .and. patches%at(p)%y_to > low - dy .and. patches%at(p)%y_to < seed%y_to) then
                touches = .true.
                if (is_wide) then
                    patches%at(p)%y_to = seed%y_to
                    changed = .true.
                end if
            else if (seed%y_to > high - 0.5_wp*dy .and. patches%at(p)%y_to > high &
                     .and. patches%at(p)%y_from < high + dy &
                     .and. patches%at(p)%y_from > seed%y_from) then
                touches = .true.
                if (is_wide) then
                    patches%at(p)%y_from = seed%y_from
                    changed = .true.
                end if
            else if (patches%at(p)%y_to >= seed%y_from .and. patches%at(p)%y_from <= seed%y_to) then
                touches = .true.
            end if
        end do
        if (touches .or. patches%n == max_patches) return
        changed = .true.
        patches%n = patches%n + 1
        patches%at(patches%n) = seed
    end subroutine take_in

    !> Put the patches in the order of y.
    pure subroutine sort_patches(patches)
        type(patches_t), intent(inout) :: patches

        type(patch_t) :: moved
        integer :: p, q

        do p = 2, patches%n
            do q = p, 2, -1
                if (patches%at(q - 1)%y_from <= patches%at(q)%y_from) exit
                moved = patches%at(q)
                patches%at(q) = patches%at(q - 1)
                patches%at(q - 1) = moved
            end do
        end do
    end subroutine sort_patches

    !> Merge patches that have met; if that is not allowed any more, let them share an end, in the
    !> middle.
    pure subroutine join_met_patches(may_merge, patches, changed)
        logical, intent(in) :: may_merge
        type(patches_t), intent(inout) :: patches
        logical, intent(inout) :: changed

        integer :: p, n
        real(wp) :: middle, clearance, width(max_patches)

        ! Of the strips before anything merges, so that left and right count alike.
        width(:patches%n) = (patches%at(:patches%n)%y_to - patches%at(:patches%n)%y_from) &
                            /patches%at(:patches%n)%n_strips
        n = min(1, patches%n)
        do p = 2, patches%n
            clearance = 0.25_wp*min(width(p - 1), width(p))
            if (patches%at(p)%y_from - patches%at(n)%y_to < clearance .and. may_merge) then
                patches%at(n)%y_to = max(patches%at(n)%y_to, patches%at(p)%y_to)
                patches%at(n)%too_far_to = patches%at(p)%too_far_to
                patches%at(n)%n_strips = patches%at(n)%n_strips + patches%at(p)%n_strips
                changed = .true.
            else
                patches%at(n)%meets_next = patches%at(p)%y_from <= patches%at(n)%y_to
                if (patches%at(n)%meets_next) then
                    middle = 0.5_wp*(patches%at(p)%y_from + patches%at(n)%y_to)
                    patches%at(n)%y_to = middle
                    patches%at(p)%y_from = middle
                end if
                n = n + 1
                patches%at(n) = patches%at(p)
            end if
        end do
        patches%n = n
        if (n > 0) patches%at(n)%meets_next = .false.
    end subroutine join_met_patches

    !> Cut strips that leave off their patch; one inside splits it, a patch of none is dropped.
    pure subroutine cut_leaving_strips(y_left, y_right, leaves, patches, splits)
        real(wp), intent(in) :: y_left(:), y_right(:) !! edges of all strips, mm
        logical, intent(in) :: leaves(:)              !! strips to be cut off
        type(patches_t), intent(inout) :: patches     !! cut
        integer, intent(inout) :: splits              !! increased by the patches split

        type(patches_t) :: cut
        integer :: p, first, last, i, from, pieces

        cut%n = 0
        last = 0
        do p = 1, patches%n
            first = last + 1
            last = last + patches%at(p)%n_strips
            from = 0
            pieces = 0
            do i = first, last + 1
                if (i <= last) then
                    if (.not. leaves(i)) then
                        if (from == 0) from = i
                        cycle
                    end if
                end if
                if (from > 0 .and. cut%n < max_patches) then
                    cut%n = cut%n + 1
                    pieces = pieces + 1
                    associate (piece => cut%at(cut%n))
                        piece = patches%at(p)
                        piece%y_from = y_left(from)
                        piece%y_to = y_right(i - 1)
                        piece%n_strips = i - from
                        if (from > first) piece%too_far_from = patches%at(p)%y_from
                        if (i <= last) piece%too_far_to = patches%at(p)%y_to
                    end associate
                end if
                from = 0
            end do
            splits = splits + max(pieces - 1, 0)
        end do
        do p = 1, cut%n
            if (p == cut%n) then
                cut%at(p)%meets_next = .false.
            else if (cut%at(p)%meets_next) then
                cut%at(p)%meets_next = cut%at(p + 1)%y_from <= cut%at(p)%y_to
            end if
        end do
        patches = cut
    end subroutine cut_leaving_strips

    !> Forget how far out ends were too far: everything else has changed.
    pure subroutine free_ends(patches)
        type(patches_t), intent(inout) :: patches !! their ends may move anywhere

        patches%at%too_far_from = -beyond_all
        patches%at%too_far_to = beyond_all
    end subroutine free_ends

    !> Mirror patches, y to -y.
    pure subroutine mirror_patches(patches)
        type(patches_t), intent(inout) :: patches !! in the order of y, before and after

        type(patches_t) :: seen
        integer :: p

        seen = patches
        do p = 1, patches%n
            associate (from => seen%at(patches%n + 1 - p), to => patches%at(p))
                to = from
                to%y_from = -from%y_to
                to%y_to = -from%y_from
                to%too_far_from = -from%too_far_to
                to%too_far_to = -from%too_far_from
                to%meets_next = .false.
                if (p < patches%n) to%meets_next = seen%at(patches%n - p)%meets_next
            end associate
        end do
    end subroutine mirror_patches

    !> Drop patches that have shrunk to nothing.
    pure subroutine drop_slivers(patches)
        type(patches_t), intent(inout) :: patches !! the others stay

        integer :: p, n

        n = 0
        do p = 1, patches%n
            if (patches%at(p)%y_to <= patches%at(p)%y_from) then
                if (n > 0) patches%at(n)%meets_next = .false.
                cycle
            end if
            n = n + 1
            patches%at(n) = patches%at(p)
        end do
        patches%n = n
    end subroutine drop_slivers
end module faststrip_normal_strip_patches
