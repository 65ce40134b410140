!> The rail heads UIC60, 60E1, 54E1: arcs R300, R80, R13 and a flank 1:20, each tangent to the next,
!> symmetric, 72 mm wide (54E1: 70 mm) where the flank begins; canted by a rotation.
!>
!> One number is free, the transition between R300 and R80, and two are in use (see
!> `uic60_transition` and `en60e1_transition`): the heads they give differ by up to 0.04 mm,
!> more than the approach of a contact under 10 kN. Results have to say which one was used.
module faststrip_geometry_rail_uic60
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_kinds, only: wp
    use faststrip_base_plausible, only: quantities, of_inclination
    use faststrip_base_status, only: status_t, set_status, clear_status, number_text, &
                                     st_bad_argument
    implicit none
    private

    public :: rail_head_t, make_rail_head, rail_head_at
    public :: uic60_transition, en60e1_transition, en54e1_transition
    public :: half_width_54

    !> Half of 21.000 mm: the `uic60` of the Manchester benchmark and multibody programs, mm.
    !> Given: dimensions, as said with it.
    real(wp), parameter :: uic60_transition = 10.5_wp

    !> Half of 20.456 mm: the `60e1` of EN 13674-1, mm.
    !> Given: dimensions, as said with it.
    real(wp), parameter :: en60e1_transition = 10.228_wp

    !> Half of 20.024 mm: the `54e1` of EN 13674-1, 70 mm wide, mm. By tangency R80 then ends at a
    !> width of 49.727 mm, as the standard is said to have it. Neither could be checked on paper.
    !> Given: dimensions, as said with it.
    real(wp), parameter :: en54e1_transition = 10.012_wp

    !> Half-widths where the flanks of `uic60` and `60e1` and that of `54e1` begin, mm.
    !> Given: dimensions of the heads.
    real(wp), parameter :: half_width_60 = 36.0_wp, half_width_54 = 35.0_wp

    ! Given: dimensions of the head: R300, R80, R13.
    real(wp), parameter :: radius(3) = [300.0_wp, 80.0_wp, 13.0_wp]

    ! How much wider the half of the head is where it ends (74.3 mm of 60E1), mm.
    ! Given: dimensions of the head; the flank is 20:1.
    real(wp), parameter :: flank_widening = 1.15_wp
    ! Given: dimensions of the head.
    real(wp), parameter :: flank_slope = 20.0_wp

    ! Where a canted gauge face becomes vertical the head is cut this far before, mm.
    ! Tuned [mm]. Origin: safeguard: slopes stay finite.
    real(wp), parameter :: vertical_margin = 1.0e-6_wp

    ! Larger cants are refused: they are outside of practice.
    real(wp), parameter :: largest_cant = quantities(of_inclination)%most

    !> A rail head: its own frame has the origin at the crown, y to the field side, z down. The
    !> canted frame is turned by the cant and has its origin at the highest point.
    type :: rail_head_t
        real(wp) :: cant = 0.0_wp     !! tangent of the angle by which the top leans inwards
        real(wp) :: half_width = half_width_60 !! where the flank begins, own frame, mm
        real(wp) :: y1 = 0.0_wp       !! transition R300/R80, own frame, mm
        real(wp) :: z1 = 0.0_wp       !! its depth, mm
        real(wp) :: y2 = 0.0_wp       !! transition R80/R13, own frame, mm
        real(wp) :: z2 = 0.0_wp       !! its depth, mm
        real(wp) :: z_flank = 0.0_wp  !! depth where the flank begins, mm
        real(wp) :: centre_y(3) = 0.0_wp !! centres of R300, R80, R13 on the field side, mm
        real(wp) :: centre_z(3) = 0.0_wp !! their depth, mm
        ! Canted frame: joints from the gauge to the field side (the ends first and last),
        ! centres of the five arcs between the flanks, a point and the slope of each flank.
        real(wp) :: joint(8) = 0.0_wp !! ends and joints in the canted frame, mm
        real(wp) :: arc_y(5) = 0.0_wp !! centres of the arcs R13, R80, R300, R80, R13, mm
        real(wp) :: arc_z(5) = 0.0_wp !! their depth, mm
        real(wp) :: flank_y(2) = 0.0_wp !! beginning of the flanks, mm
        real(wp) :: flank_z(2) = 0.0_wp !! their depth there, mm
        real(wp) :: flank_dz(2) = 0.0_wp !! slope dz/dy of the flanks
    end type rail_head_t

contains

    !> The head with a given R300/R80 transition, canted.
    !>
    !> From a cant of 1:20 on the gauge face is vertical or undercut and no longer a function of
    !> y: the head then ends there, on R13.
    pure subroutine make_rail_head(transition, cant, head, status, half_width)
        real(wp), intent(in) :: transition      !! y1, above 0 and where R80 has a length, mm
        real(wp), intent(in) :: cant            !! the inclination, e.g. 1/40; within +-0.1
        type(rail_head_t), intent(out) :: head  !! the head
        type(status_t), intent(out) :: status   !! `st_bad_argument`
        real(wp), intent(in), optional :: half_width !! where the flank begins, mm; 60E1's
        real(wp) :: largest
        logical :: valid

        call clear_status(status)
        if (present(half_width)) head%half_width = half_width
        ! There R300 would meet R13.
        largest = corner_y(head)/(1.0_wp - radius(3)/radius(1))
        valid = ieee_is_finite(transition)
        if (valid) valid = transition > 0.0_wp .and. transition < largest
        if (.not. valid) then
            call set_status(status, st_bad_argument, &
                            'transition R300/R80 must be above 0 and below ' // &
                            trim(number_text(largest)) // ' mm, got ' // number_text(transition))
            return
        end if
        valid = ieee_is_finite(cant)
        if (valid) valid = abs(cant) <= largest_cant
        if (.not. valid) then
            call set_status(status, st_bad_argument, 'rail inclination must be -0.1 to 0.1, ' // &
                            'got ' // number_text(cant))
            return
        end if

        head%cant = cant
        call join_arcs(transition, head)
        call turn_head(head)
    end subroutine make_rail_head

    !> The chain in its own frame: a tangent joint keeps the angle of the normal.
    pure subroutine join_arcs(transition, head)
        real(wp), intent(in) :: transition
        type(rail_head_t), intent(inout) :: head

        real(wp) :: angle_1, angle_2

        head%y1 = transition
        angle_1 = asin(transition/radius(1))
        head%z1 = radius(1)*(1.0_wp - cos(angle_1))
        head%centre_y(1) = 0.0_wp
        head%centre_z(1) = radius(1)
        head%centre_y(2) = head%y1 - radius(2)*sin(angle_1)
        head%centre_z(2) = head%z1 + radius(2)*cos(angle_1)
        head%centre_y(3) = corner_y(head)
        angle_2 = asin((head%centre_y(3) - head%centre_y(2))/(radius(2) - radius(3)))
        head%y2 = head%centre_y(2) + radius(2)*sin(angle_2)
        head%z2 = head%centre_z(2) - radius(2)*cos(angle_2)
        head%centre_z(3) = head%z2 + radius(3)*cos(angle_2)
        head%z_flank = head%centre_z(3) - radius(3)*cos(atan(flank_slope))
    end subroutine join_arcs

    !> Centre of R13 on the field side, own frame, mm.
    pure real(wp) function corner_y(head)
        type(rail_head_t), intent(in) :: head

        corner_y = head%half_width - radius(3)*sin(atan(flank_slope))
    end function corner_y

    !> The chain in the canted frame.
    pure subroutine turn_head(head)
        type(rail_head_t), intent(inout) :: head

        real(wp) :: cant_angle, crown_y, crown_z, y_end, z_end

        ! The highest point of the canted head: on R300, or on R80 for a large cant.
        cant_angle = atan(head%cant)
        if (abs(cant_angle) <= asin(head%y1/radius(1))) then
            call rotate(0.0_wp, radius(1), 0.0_wp, 0.0_wp, crown_y, crown_z)
            crown_z = crown_z - radius(1)
        else
            call rotate(sign(head%centre_y(2), cant_angle), head%centre_z(2), 0.0_wp, 0.0_wp, &
                        crown_y, crown_z)
            crown_z = crown_z - radius(2)
        end if

        call rotate(-head%centre_y(3), head%centre_z(3), crown_y, crown_z, &
                    head%arc_y(1), head%arc_z(1))
        call rotate(-head%centre_y(2), head%centre_z(2), crown_y, crown_z, &
                    head%arc_y(2), head%arc_z(2))
        call rotate(0.0_wp, radius(1), crown_y, crown_z, head%arc_y(3), head%arc_z(3))
        call rotate(head%centre_y(2), head%centre_z(2), crown_y, crown_z, &
                    head%arc_y(4), head%arc_z(4))
        call rotate(head%centre_y(3), head%centre_z(3), crown_y, crown_z, &
                    head%arc_y(5), head%arc_z(5))
        call rotate(-head%y2, head%z2, crown_y, crown_z, head%joint(3), z_end)
        call rotate(-head%y1, head%z1, crown_y, crown_z, head%joint(4), z_end)
        call rotate(head%y1, head%z1, crown_y, crown_z, head%joint(5), z_end)
        call rotate(head%y2, head%z2, crown_y, crown_z, head%joint(6), z_end)
        call turn_flank(-1.0_wp, head%flank_y(1), head%flank_z(1), head%flank_dz(1), y_end)
        head%joint(1) = y_end
        head%joint(2) = head%flank_y(1)
        call turn_flank(1.0_wp, head%flank_y(2), head%flank_z(2), head%flank_dz(2), y_end)
        head%joint(7) = head%flank_y(2)
        head%joint(8) = y_end

    contains

        ! A point of the own frame in the canted one: the top leans to negative y.
        pure subroutine rotate(y, z, origin_y, origin_z, y_canted, z_canted)
            real(wp), intent(in) :: y, z, origin_y, origin_z
            real(wp), intent(out) :: y_canted, z_canted

            y_canted = y*cos(cant_angle) + z*sin(cant_angle) - origin_y
            z_canted = -y*sin(cant_angle) + z*cos(cant_angle) - origin_z
        end subroutine rotate

        ! One flank in the canted frame, and the y where the head ends.
        pure subroutine turn_flank(side, y, z, slope, y_last)
            real(wp), intent(in) :: side
            real(wp), intent(out) :: y, z, slope, y_last
            real(wp) :: outward, depth, z_last

            call rotate(side*head%half_width, head%z_flank, crown_y, crown_z, y, z)
            outward = cos(cant_angle)/flank_slope + side*sin(cant_angle)
            if (outward > vertical_margin) then
                slope = side*(cos(cant_angle) - side*sin(cant_angle)/flank_slope)/outward
                depth = head%z_flank + flank_slope*flank_widening
                call rotate(side*(head%half_width + flank_widening), depth, crown_y, crown_z, &
                            y_last, z_last)
            else
                slope = 0.0_wp
                y_last = head%arc_y(merge(1, 5, side < 0.0_wp)) &
                         + side*(radius(3) - vertical_margin)
                y = y_last
            end if
        end subroutine turn_flank
    end subroutine turn_head

    !> The canted head and its first two derivatives; the origin is its highest point.
    pure subroutine rail_head_at(head, y, z, dz, d2z, is_there)
        type(rail_head_t), intent(in) :: head !! from `make_rail_head`
        real(wp), intent(in) :: y             !! lateral coordinate, to the field side, mm
        real(wp), intent(out) :: z            !! depth below the highest point, mm
        real(wp), intent(out) :: dz           !! slope dz/dy
        real(wp), intent(out) :: d2z          !! second derivative, 1/mm
        logical, intent(out) :: is_there      !! is y from head%joint(1) to head%joint(8)? If not:
                                              !! all zero
        ! Given: the five arcs' radii.
        integer, parameter :: radius_of(5) = [3, 2, 1, 2, 3]
        integer :: i
        real(wp) :: root

        z = 0.0_wp
        dz = 0.0_wp
        d2z = 0.0_wp
        is_there = ieee_is_finite(y)
        if (is_there) is_there = y >= head%joint(1) .and. y <= head%joint(8)
        if (.not. is_there) then
            return
        else if (y < head%joint(2)) then
            dz = head%flank_dz(1)
            z = head%flank_z(1) + dz*(y - head%flank_y(1))
        else if (y > head%joint(7)) then
            dz = head%flank_dz(2)
            z = head%flank_z(2) + dz*(y - head%flank_y(2))
        else
            i = 1
            do while (i < 5) ! Given: the five arcs
                if (y < head%joint(i + 2)) exit
                i = i + 1
            end do
            root = sqrt(radius(radius_of(i))**2 - (y - head%arc_y(i))**2)
            z = head%arc_z(i) - root
            dz = (y - head%arc_y(i))/root
            d2z = radius(radius_of(i))**2/root**3
        end if
    end subroutine rail_head_at
end module faststrip_geometry_rail_uic60
