!> Measures of a wheel's flange by EN 15313, from points, with straight lines between them.
!>
!> The height of the tread is that at the nominal rolling circle. The flange's height Sh goes from
!> there to its tip; its thickness Sd from the back's reference to the flank, 10 mm below the
!> tread's height in the frame of the wheel; qR from that point to the one 2 mm short of the tip,
!> along y.
module faststrip_geometry_flange
    use faststrip_base_kinds, only: wp
    implicit none
    private

    public :: flange_t, measure_flange

    !> The three measures; those that the points do not reach are not known.
    type :: flange_t
        logical :: is_known = .false.  !! is there a flange with a tread beside it?
        real(wp) :: sd = 0.0_wp        !! thickness, mm
        real(wp) :: sh = 0.0_wp        !! height, mm
        real(wp) :: qr = 0.0_wp        !! lateral distance on the flank, mm
    end type flange_t

    ! Given: EN 15313: where Sd is measured and where qR ends, mm.
    real(wp), parameter :: thickness_depth = 10.0_wp, short_of_tip = 2.0_wp

contains

    !> Measure the flange of a wheel.
    pure subroutine measure_flange(y, z, flange_back, flange)
        real(wp), intent(in) :: y(:)            !! to the field side, mm; 0: nominal rolling circle
        real(wp), intent(in) :: z(:)            !! down, mm, along the curve
        real(wp), intent(in) :: flange_back     !! y of the reference of the back, mm
        type(flange_t), intent(out) :: flange   !! the measures

        real(wp) :: tread, flank, end_of_qr
        integer :: tape, tip
        logical :: found(2)

        if (size(y) < 2) return
        do tape = size(y) - 1, 1, -1
            if (y(tape) <= 0.0_wp .and. y(tape + 1) > 0.0_wp) exit
        end do
        if (tape < 2) return
        tread = z(tape) + (z(tape + 1) - z(tape))*(-y(tape)/(y(tape + 1) - y(tape)))
        tip = maxloc(z(:tape), dim=1)
        call cross(tread + thickness_depth, flank, found(1))
        call cross(z(tip) - short_of_tip, end_of_qr, found(2))
        flange%is_known = all(found)
        if (.not. flange%is_known) return
        flange%sd = flank - flange_back
        flange%sh = z(tip) - tread
        flange%qr = flank - end_of_qr

    contains

        !> Where the flank, from the nominal rolling circle to the tip, first reaches a depth.
        pure subroutine cross(depth, at, is_found)
            real(wp), intent(in) :: depth
            real(wp), intent(out) :: at
            logical, intent(out) :: is_found

            integer :: i

            at = 0.0_wp
            is_found = .false.
            do i = tape, tip + 1, -1
                if (z(i) > depth .or. z(i - 1) < depth) cycle
                is_found = .true.
                at = y(i)
                if (z(i - 1) > z(i)) at = y(i) + (y(i - 1) - y(i)) &
                    *((depth - z(i))/(z(i - 1) - z(i)))
                return
            end do
        end subroutine cross
    end subroutine measure_flange
end module faststrip_geometry_flange
