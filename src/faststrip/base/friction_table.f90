!> Friction that varies across the rail: a lubricated gauge corner, a dry running band, sand.
!>
!> The coefficient is given at places, is linear between them and constant beyond the first and the
!> last. A place is the y of the rail's profile, a contact angle of either sign, or the y of one
!> contact. Methods take the last: `faststrip_contact_method_friction` makes it of the others where
!> the contact lies. Without places one coefficient counts everywhere.
module faststrip_base_friction_table
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, number_text, &
                                     count_text, st_bad_argument, st_not_finite
    implicit none
    private

    public :: friction_table_t, make_friction_table, check_friction_table
    public :: mu_at, mean_mu_between
    public :: over_contact, over_rail, over_angle, most_places

    !> What the places are: y of the contact, y of the rail's profile, angle of the surfaces.
    !> Given: numbers of kinds.
    integer, parameter :: over_contact = 0, over_rail = 1, over_angle = 2

    !> The most places.
    !> Tuned [places]. Origin: capacity: a quarter of a kilobyte.
    integer, parameter :: most_places = 16

    !> The coefficient of friction at places.
    type :: friction_table_t
        integer :: n = 0                      !! places; 0: friction does not vary
        integer :: over = over_contact        !! one of the `over_` numbers
        real(wp) :: at(most_places) = 0.0_wp  !! increasing, mm; angles in rad, from 0 on
        real(wp) :: mu(most_places) = 0.0_wp  !! static coefficient there, >= 0
        real(wp) :: y_rail = 0.0_wp           !! y of the rail's profile at the contact's y = 0, mm
        real(wp) :: angle = 0.0_wp            !! contact angle there, rad
    end type friction_table_t

contains

    !> A table of arrays.
    pure subroutine make_friction_table(over, at, mu, table, status)
        integer, intent(in) :: over               !! one of the `over_` numbers
        real(wp), intent(in) :: at(:)             !! places, increasing, mm or rad
        real(wp), intent(in) :: mu(:)             !! coefficient at each, >= 0
        type(friction_table_t), intent(out) :: table !! empty with an error
        type(status_t), intent(out) :: status
            !! `st_bad_argument` (too many, unlike numbers), those of `check_friction_table`

        if (size(at) /= size(mu)) then
            call set_status(status, st_bad_argument, 'each place of a table of friction needs ' // &
                            'one coefficient, got ' // trim(count_text(size(at))) // &
                            ' places and ' // trim(count_text(size(mu))) // ' coefficients')
            return
        else if (size(at) < 1 .or. size(at) > most_places) then
            call set_status(status, st_bad_argument, 'a table of friction has 1 to ' // &
                            trim(count_text(most_places)) // ' places, got ' // &
                            count_text(size(at)))
            return
        end if
        table%n = size(at)
        table%over = over
        table%at(:table%n) = at
        table%mu(:table%n) = mu
        call check_friction_table(table, status)
        if (is_error(status)) table = friction_table_t()
    end subroutine make_friction_table

    !> Refuse a table that is none; one without places is fine.
    pure subroutine check_friction_table(table, status)
        type(friction_table_t), intent(in) :: table !! as the caller set it
        type(status_t), intent(out) :: status       !! `st_bad_argument`, `st_not_finite`

        integer :: i

        call clear_status(status)
        if (table%n == 0) return
        if (table%n < 0 .or. table%n > most_places) then
            call set_status(status, st_bad_argument, 'a table of friction has at most ' // &
                            trim(count_text(most_places)) // ' places, got ' // &
                            count_text(table%n))
            return
        else if (table%over < over_contact .or. table%over > over_angle) then
            call set_status(status, st_bad_argument, 'no such kind of places of friction: ' // &
                            count_text(table%over))
            return
        end if
        associate (n => table%n)
            if (.not. all(ieee_is_finite(table%at(:n)) .and. ieee_is_finite(table%mu(:n)))) then
                call set_status(status, st_not_finite, 'a number of the table of friction is ' // &
                                'not finite')
            else if (any(table%mu(:n) < 0.0_wp)) then
                call set_status(status, st_bad_argument, 'coefficients of a table of friction ' // &
                                'must not be negative, got ' // number_text(minval(table%mu(:n))))
            else if (table%over == over_angle .and. table%at(1) < 0.0_wp) then
                call set_status(status, st_bad_argument, 'contact angles of a table of ' // &
                                'friction must not be negative, got ' // number_text(table%at(1)))
            else
                do i = 2, n
                    if (table%at(i) > table%at(i - 1)) cycle
                    call set_status(status, st_bad_argument, 'places of a table of friction ' // &
                                    'must increase, got ' // trim(number_text(table%at(i - 1))) &
                                    // ' and ' // number_text(table%at(i)))
                    return
                end do
            end if
        end associate
    end subroutine check_friction_table

    !> The coefficient at a place.
    pure real(wp) function mu_at(table, mu, place)
        type(friction_table_t), intent(in) :: table !! checked
        real(wp), intent(in) :: mu                  !! where the table has no places
        real(wp), intent(in) :: place               !! as the table's, mm or rad

        integer :: i

        mu_at = mu
        if (table%n == 0) return
        mu_at = table%mu(1)
        if (place <= table%at(1)) return
        do i = 2, table%n
            if (place > table%at(i)) cycle
            mu_at = table%mu(i - 1) + (table%mu(i) - table%mu(i - 1)) &
                    *((place - table%at(i - 1))/(table%at(i) - table%at(i - 1)))
            return
        end do
        mu_at = table%mu(table%n)
    end function mu_at

    !> The mean coefficient between two places.
    pure real(wp) function mean_mu_between(table, mu, left, right) result(mean)
        type(friction_table_t), intent(in) :: table !! checked
        real(wp), intent(in) :: mu                  !! where the table has no places
        real(wp), intent(in) :: left, right         !! places, left <= right

        real(wp) :: from, to, mu_from, mu_to, area
        integer :: i

        mean = mu
        if (table%n == 0) return
        from = left
        mu_from = mu_at(table, mu, left)
        area = 0.0_wp
        do i = 1, table%n + 1
            to = right
            if (i <= table%n) to = min(max(table%at(i), left), right)
            mu_to = mu_at(table, mu, to)
            area = area + 0.5_wp*(mu_from + mu_to)*(to - from)
            from = to
            mu_from = mu_to
        end do
        mean = mu_from
        if (right > left) mean = area/(right - left)
    end function mean_mu_between
end module faststrip_base_friction_table
