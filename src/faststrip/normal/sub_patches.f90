!> The sub-patches of a contact patch with a neck: which strips hang together, and how firmly.
!>
!> Tractions pass hardly through a neck, and freely through what is nearly as long as the rest. How
!> open a strip is says its length over the longest strip to its left or to its right, whichever is
!> shorter. Strips more open than a level fall into runs, the sub-patches; those of a neck between
!> two sub-patches belong to both, in proportion to the width on the other side. No level is the
!> right one: what is wanted of the sub-patches is to be averaged over the levels from `all_parted`
!> to `all_joined` with the weights of `level_weight`. So sub-patches join and part gradually,
!> nothing depends on which strip of a neck is the shortest, and left and right count alike.
!>
!> In use: `find_openness`; `level = all_parted`; until the level is `all_joined`, `next_level`
!> ends the stretch of levels that give the same sub-patches, and `next_sub_patch` finds them one by
!> one.
module faststrip_normal_sub_patches
    use faststrip_base_kinds, only: wp
    use faststrip_normal_strips, only: contact_strips_t
    implicit none
    private

    public :: has_neck, find_openness, next_level, level_weight, next_sub_patch
    public :: all_parted, all_joined

    ! Round numbers about 0.3, the one level that sub-patches had before. Against TANG, on 72
    ! contacts of two humps that meet, the mean errors are 1.0, 0.7 and 0.6 % (Fx, Fy of mu N, Mz of
    ! mu N b) after 1.0, 0.9 and 0.7; the 20 contacts S1002/UIC60 have no strip so short. Higher
    ! bounds do better on smooth humps (0.2, 0.5 and 0.5 % from 0.3 to 0.8), but take the ragged
    ! strips of rough gaps for necks: with 0.2 to 0.6 a fifth more contacts, with 0.3 to 0.8 twice
    ! as many change their forces by over 3 % with 2 % of the load. The closer the bounds, the
    ! faster the forces change while a neck grows.
    ! Tuned [1]. Origin: as said with it.
    real(wp), parameter :: all_parted = 0.1_wp !! openness up to which a strip is a neck
    ! Tuned [1]. Origin: as said with all_parted.
    real(wp), parameter :: all_joined = 0.5_wp !! openness from which it is none

contains

    !> Is any strip of a patch a neck at any level?
    pure logical function has_neck(half_length)
        real(wp), intent(in) :: half_length(:) !! of the strips of one patch, mm

        real(wp) :: longest
        integer :: i, top

        has_neck = .true.
        top = maxloc(half_length, dim=1)
        longest = 0.0_wp
        do i = 1, top
            longest = max(longest, half_length(i))
            if (half_length(i) < all_joined*longest) return
        end do
        longest = 0.0_wp
        do i = size(half_length), top, -1
            longest = max(longest, half_length(i))
            if (half_length(i) < all_joined*longest) return
        end do
        has_neck = .false.
    end function has_neck

    !> How open the strips of a patch are, 0 to 1.
    pure subroutine find_openness(half_length, openness)
        real(wp), intent(in) :: half_length(:) !! of the strips of one patch, mm
        real(wp), intent(out) :: openness(:)   !! of each strip; 1 at the ends

        real(wp) :: longest
        integer :: i, top

        ! Up to the longest strip of all, what is to the left decides, and beyond, to the right.
        openness = 1.0_wp
        top = maxloc(half_length, dim=1)
        longest = 0.0_wp
        do i = 1, top
            longest = max(longest, half_length(i))
            if (longest > 0.0_wp) openness(i) = half_length(i)/longest
        end do
        longest = 0.0_wp
        do i = size(half_length), top, -1
            longest = max(longest, half_length(i))
            if (longest > 0.0_wp) openness(i) = half_length(i)/longest
        end do
    end subroutine find_openness

    !> Up to which level the sub-patches are those just above this one.
    pure real(wp) function next_level(openness, level)
        real(wp), intent(in) :: openness(:) !! of the strips of a patch
        real(wp), intent(in) :: level       !! from `all_parted`, below `all_joined`

        next_level = min(minval(openness, mask=openness > level), all_joined)
    end function next_level

    !> What the levels between two bounds count; all together, one.
    pure real(wp) function level_weight(from, to)
        real(wp), intent(in) :: from !! level, >= `all_parted`
        real(wp), intent(in) :: to   !! level, <= `all_joined`

        level_weight = weight_below(to) - weight_below(from)
    end function level_weight

    !> What the levels below this one count: rises smoothly from 0 to 1.
    pure real(wp) function weight_below(level)
        real(wp), intent(in) :: level

        real(wp) :: t

        t = (level - all_parted)/(all_joined - all_parted)
        weight_below = t*t*(3.0_wp - 2.0_wp*t)
    end function weight_below

    !> The next sub-patch of a patch at the levels just above one: which strips, with what share.
    pure subroutine next_sub_patch(strips, first, openness, level, begin, from, to, share)
        type(contact_strips_t), intent(in) :: strips !! checked strips
        integer, intent(in) :: first           !! first strip of the patch
        real(wp), intent(in) :: openness(first:) !! of the strips of the patch
        real(wp), intent(in) :: level          !! strips as open as that or less are necks
        integer, intent(inout) :: begin
            !! first strip of the sub-patch proper; then that of the next sub-patch, or beyond the
            !! patch
        integer, intent(out) :: from, to       !! strips, with those of the necks on either side
        real(wp), intent(inout) :: share(first:) !! set from `from` to `to`: 1, in necks less

        integer :: last

        last = begin
        do while (last < ubound(openness, 1))
            if (openness(last + 1) <= level) exit
            last = last + 1
        end do
        from = begin
        do while (from > first)
            if (openness(from - 1) > level) exit
            from = from - 1
        end do
        to = last
        do while (to < ubound(openness, 1))
            if (openness(to + 1) > level) exit
            to = to + 1
        end do
        share(begin:last) = 1.0_wp
        call share_neck(strips, begin - 1, from, share(from:begin - 1))
        call share_neck(strips, last + 1, to, share(last + 1:to))
        begin = to + 1
    end subroutine next_sub_patch

    !> What of the strips of a neck belongs to the sub-patch on one side.
    pure subroutine share_neck(strips, near, away, share)
        type(contact_strips_t), intent(in) :: strips
        integer, intent(in) :: near, away    ! strip next to the sub-patch, next to the other one
        real(wp), intent(inout) :: share(min(near, away):)

        real(wp) :: beyond, width
        integer :: i

        if (size(share) == 0) return
        beyond = 0.0_wp
        do i = away, near, sign(1, near - away)
            width = strips%y_right(i) - strips%y_left(i)
            share(i) = beyond + 0.5_wp*width
            beyond = beyond + width
        end do
        if (beyond > 0.0_wp) then
            share = share/beyond
        else
            share = 0.5_wp
        end if
    end subroutine share_neck
end module faststrip_normal_sub_patches
