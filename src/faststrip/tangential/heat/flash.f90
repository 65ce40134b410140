!> Temperatures of both surfaces by the heat of friction, from the elements of any tangential
!> method.
!>
!> In each row of elements heat flows in depth only (`faststrip_tangential_heat_sources`), into both
!> bodies by their effusivities beta, and both have one temperature where they touch:
!>
!>     T = (beta_w T_w + beta_r T_r)/(beta_w + beta_r)
!>         + 1/((beta_w + beta_r) sqrt(pi V)) int q/sqrt(s - s') ds'
!>
!> q being traction times slip velocity. Behind the contact, of length L, they part: the heat goes
!> on as it is, and their temperatures away from the contact return,
!>
!>     T_r + (T_w - T_r) beta_w/(beta_w + beta_r) (2/pi) asin sqrt(L/s),
!>
!> and of the wheel likewise. Elements are those of one row where they follow each other with one y;
!> all of a row have one length.
module faststrip_tangential_heat_flash
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_limits, only: rounding
    use faststrip_base_status, only: status_t, set_status, clear_status, count_text, &
                                     st_out_of_range
    use faststrip_base_thermal, only: heating_t
    use faststrip_tangential_heat_sources, only: most_along, rise_ahead, weight_of_itself
    use faststrip_tangential_types, only: tangential_field_t, field_power
    implicit none
    private

    public :: flash_t, find_temperatures, surface_temperatures

    !> Figures of the temperatures of a contact.
    type :: flash_t
        real(wp) :: rise = 0.0_wp        !! largest rise by the heat of friction, K
        real(wp) :: temperature = 0.0_wp !! largest, with that of the bodies, C
        real(wp) :: x = 0.0_wp           !! where, mm
        real(wp) :: y = 0.0_wp           !! the same across
    end type flash_t

    !> A row of elements, the leading edge first.
    type :: row_t
        integer :: first = 1, last = 0 ! elements
        real(wp) :: length = 0.0_wp    ! of each along x, mm
        real(wp) :: area = 0.0_wp      ! of each, mm^2
    end type row_t

contains

    !> Find the temperatures of all elements, at their middles, and the largest of them.
    pure subroutine find_temperatures(field, heat, flash, status)
        type(tangential_field_t), intent(inout) :: field !! of a solution; gets its temperatures
        type(heating_t), intent(in) :: heat              !! of its bodies and speed
        type(flash_t), intent(out) :: flash              !! the largest; zeros without elements
        type(status_t), intent(out) :: status            !! `st_out_of_range`: too many in a row

        type(row_t) :: row
        real(wp) :: power(most_along), rise
        integer :: i, n

        call clear_status(status)
        flash%rise = -1.0_wp
        do while (row%last < field%n)
            call next_row(field, row)
            ! Rows of a grid may have holes, without heat.
            n = nint((field%x(row%first) - field%x(row%last))/row%length) + 1
            if (n > most_along) then
                call set_status(status, st_out_of_range, 'temperatures take at most ' // &
                                trim(count_text(most_along)) // ' elements along a row, got ' // &
                                count_text(n))
                return
            end if
            power(:n) = 0.0_wp
            do i = row%first, row%last
                n = nint((field%x(row%first) - field%x(i))/row%length) + 1
                power(n) = max(field_power(field, i), 0.0_wp)
                rise = heat%gain*sqrt(row%length)* &
                    (rise_ahead(power(:n - 1)) + weight_of_itself*power(n))
                field%temperature(i) = heat%shared + rise
                if (.not. rise > flash%rise) cycle
                flash = flash_t(rise, field%temperature(i), field%x(i), field%y(i))
            end do
        end do
        flash%rise = max(flash%rise, 0.0_wp)
    end subroutine find_temperatures

    !> Temperatures of both surfaces anywhere: in the rows of elements, behind them, and ahead of
    !> them or beside them as they are away from the contact. Within an element its heat counts as
    !> far as it is ahead.
    pure function surface_temperatures(field, heat, x, y) result(temperature)
        type(tangential_field_t), intent(in) :: field !! of a solution
        type(heating_t), intent(in) :: heat           !! of its bodies and speed
        real(wp), intent(in) :: x, y                  !! place, mm
        real(wp) :: temperature(2)                    !! of wheel and rail, C

        type(row_t) :: row
        real(wp) :: edge, behind, part
        integer :: i

        temperature = heat%away
        do while (row%last < field%n)
            call next_row(field, row)
            if (abs(y - field%y(row%first)) > (0.5_wp + rounding)*row%area/row%length) cycle
            edge = field%x(row%first) + 0.5_wp*row%length
            if (x >= edge) return
            ! Of the other body's temperature what is left.
            behind = (field%x(row%last) - 0.5_wp*row%length - x)/(edge - x)
            part = 1.0_wp
            if (behind > 0.0_wp) part = 2.0_wp/pi*asin(sqrt(1.0_wp - behind))
            temperature = temperature + part*(heat%shared - temperature)
            do i = row%first, row%last
                edge = field%x(i) + 0.5_wp*row%length - x
                if (edge <= 0.0_wp) return
                temperature = temperature + heat%gain*max(field_power(field, i), 0.0_wp)* &
                    (2.0_wp*min(edge, row%length)/(sqrt(edge) + sqrt(max(edge - row%length, &
                                                                         0.0_wp))))
            end do
            return
        end do
    end function surface_temperatures

    !> The row behind another. A row of one element is as long as those of the row before, if it is
    !> as large, and square without one.
    pure subroutine next_row(field, row)
        type(tangential_field_t), intent(in) :: field
        type(row_t), intent(inout) :: row ! the one before

        real(wp) :: length, area
        integer :: i

        length = row%length
        area = row%area
        row%first = row%last + 1
        row%last = row%first
        row%area = field%area(row%first)
        row%length = 0.0_wp
        do i = row%first + 1, field%n
            if (abs(field%y(i) - field%y(row%first)) > 0.0_wp &
                .or. field%x(i) >= field%x(i - 1)) exit
            if (i == row%first + 1) row%length = field%x(i - 1) - field%x(i)
            row%length = min(row%length, field%x(i - 1) - field%x(i))
            row%last = i
        end do
        if (row%last > row%first) return
        row%length = sqrt(row%area)
        if (abs(area - row%area) <= rounding*area) row%length = length
    end subroutine next_row
end module faststrip_tangential_heat_flash
