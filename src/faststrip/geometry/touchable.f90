!> What of a profile can be touched: of a rail what is seen from above, of a wheel what is seen from
!> below.
!>
!> A profile is a curve, a list of points by arc length: it may overhang, stand upright, fold back.
!> The contact search wants z(y). From the highest place of a rail (the lowest of a wheel) the curve
!> is followed to both sides as long as it goes on outwards. Points that fold back, a zig-zag, are
!> passed over where the curve goes on beyond them right away; where it does not, at an overhang or
!> an upright side, the rest of that side is clipped. A point that lies where the one before does is
!> that one written twice, and no fold. Nothing is moved, and what was left out is reported.
module faststrip_geometry_touchable
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: add_words, number_text, count_text
    implicit none
    private

    public :: touchable_t, find_touchable, touchable_words
    public :: body_wheel, body_rail, same_place, upright

    !> What a profile is of.
    !> Given: numbers of kinds.
    integer, parameter :: body_wheel = 1
    !> The other one.
    !> Given: numbers of kinds.
    integer, parameter :: body_rail = 2

    !> Length of `touchable_words`, characters.
    !> Given: a line of a message.
    integer, parameter :: words_length = 200

    !> The part of a curve that can be touched.
    type :: touchable_t
        integer, allocatable :: point(:)    !! numbers of its points, y increasing
        integer :: n_folded = 0             !! points passed over between them
        integer :: n_clipped(2) = 0         !! clipped at the first and at the last y
        real(wp) :: y_clipped(2) = 0.0_wp   !! where, mm
        real(wp) :: deepest(2) = 0.0_wp     !! largest z of what was clipped there, mm
    end type touchable_t

    !> Steeper is upright, in any frame: 89.7 degrees.
    !> Tuned [1]. Origin: the flank of a rail 1:20, canted 1:40, has a slope of 40, and noise of
    !> 10 um over points 2 mm apart this.
    real(wp), parameter :: upright = 200.0_wp

    !> Points no farther apart are one that was written twice.
    !> Tuned [mm]. Origin: a tenth of the last of four printed decimals, far below the noise of any
    !> measurement.
    real(wp), parameter :: same_place = 1.0e-5_wp

    ! A fold, or a dent, after which the curve goes on farther off than this is none.
    ! Tuned [mm]. Origin: dents and zig-zags of measured profiles are 0.1 to 1.5 mm long.
    real(wp), parameter :: bridge = 2.0_wp
    ! Where points are far apart anyway, the next one may be so many times as far as they are.
    ! Tuned [1]. Origin: chosen: points along a profile are mostly even.
    real(wp), parameter :: usual_step = 2.0_wp

    ! The field side's top of a rail counts as its highest place if it is lower by no more.
    ! Tuned [mm]. Origin: a guard rail beside the head may be a little higher.
    real(wp), parameter :: as_high = 1.0_wp

contains

    !> Follow a curve from its outermost place to both sides. The curve runs from small y to
    !> large y.
    pure subroutine find_touchable(y, z, body, part)
        real(wp), intent(in) :: y(:)            !! mm, along the curve
        real(wp), intent(in) :: z(:)            !! down, mm, as many
        integer, intent(in) :: body             !! `body_wheel` or `body_rail`
        type(touchable_t), intent(out) :: part  !! which points, and what was left out

        integer :: left(size(y)), right(size(y)), n_left, n_right, start, n

        n = size(y)
        start = outermost(z, body)
        call follow(-1, left, n_left, part)
        call follow(1, right, n_right, part)
        part%point = [left(n_left:1:-1), start, right(:n_right)]

    contains

        !> The points to one side of the start.
        pure subroutine follow(side, kept, n_kept, part)
            integer, intent(in) :: side
            integer, intent(out) :: kept(:), n_kept
            type(touchable_t), intent(inout) :: part

            integer :: i, last, end_point, folded, at
            real(wp) :: step, steps
            logical :: is_near

            n_kept = 0
            folded = 0
            last = start
            steps = 0.0_wp
            end_point = merge(n, 1, side > 0)
            do i = start + side, end_point, side
                step = hypot(y(i) - y(last), z(i) - z(last))
                if (folded == 0 .and. step <= same_place) then
                    if (i == end_point) last = i
                    cycle
                end if
                is_near = step <= bridge
                if (goes_on(last, i, side) .and. (is_near .or. folded == 0 &
                                                  .or. step <= usual_step*steps)) then
                    n_kept = n_kept + 1
                    kept(n_kept) = i
                    last = i
                    steps = step
                    part%n_folded = part%n_folded + folded
                    folded = 0
                else
                    folded = folded + 1
                    if (.not. is_near) exit
                end if
            end do
            if (last == end_point) return
            at = merge(2, 1, side > 0)
            part%n_clipped(at) = abs(end_point - last)
            part%y_clipped(at) = y(last)
            part%deepest(at) = maxval(z(min(last, end_point):max(last, end_point)))
        end subroutine follow

        !> Does the curve go on outwards from one point to another?
        pure logical function goes_on(from, to, side)
            integer, intent(in) :: from, to, side

            real(wp) :: dy

            dy = side*(y(to) - y(from))
            goes_on = dy > 0.0_wp .and. abs(z(to) - z(from)) <= upright*dy
        end function goes_on
    end subroutine find_touchable

    !> The highest place of a rail, the lowest of a wheel.
    pure integer function outermost(z, body) result(at)
        real(wp), intent(in) :: z(:)
        integer, intent(in) :: body

        if (body == body_wheel) then
            at = maxloc(z, dim=1)
        else
            at = minloc(z, dim=1)
            at = last_summit(z, z(at) + as_high)
        end if
    end function outermost

    !> Of the stretches above a level the summit of the last one.
    pure integer function last_summit(z, level) result(at)
        real(wp), intent(in) :: z(:), level

        integer :: i

        at = 0
        do i = size(z), 1, -1
            if (z(i) > level) then
                if (at > 0) return
            else if (at == 0) then
                at = i
            else if (z(i) < z(at)) then
                at = i
            end if
        end do
    end function last_summit

    !> What was left out, in words; blank where nothing was.
    pure function touchable_words(part) result(words)
        type(touchable_t), intent(in) :: part      !! from `find_touchable`
        character(len=words_length) :: words       !! one line

        integer :: i

        words = ''
        do i = 1, 2
            if (part%n_clipped(i) == 0) cycle
            if (words /= '') call add_words(words, ',')
            call add_words(words, ' '//count_text(part%n_clipped(i)))
            call add_words(words, ' points clipped '//merge('below ', 'beyond', i == 1))
            call add_words(words, ' y = '//number_text(part%y_clipped(i)))
            call add_words(words, ' mm')
        end do
        if (part%n_folded > 0) then
            if (words /= '') call add_words(words, ',')
            call add_words(words, ' '//count_text(part%n_folded))
            call add_words(words, ' points that fold back passed over')
        end if
        words = adjustl(words)
    end function touchable_words
end module faststrip_geometry_touchable
