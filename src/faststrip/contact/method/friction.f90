!> Friction of a contact whose pressures are known: a table over the rail or the contact angle made
!> one over the contact, and the mean coefficient.
!>
!> Each strip, row or element has the coefficient of its place where the method marches or solves
!> element by element; what has one coefficient for a contact takes the mean by load.
module faststrip_contact_method_friction
    use faststrip_base_friction, only: falls_when_hot
    use faststrip_base_friction_table, only: friction_table_t, mean_mu_between, over_contact, &
                                             over_rail, over_angle, most_places
    use faststrip_base_kinds, only: wp
    use faststrip_base_thermal, only: heating
    use faststrip_geometry_gap_curve, only: gap_curve_t, gap_inclination
    use faststrip_normal_strips, only: contact_strips_t, load_of
    use faststrip_contact_case, only: contact_case_t
    use faststrip_contact_method, only: workspace_t
    implicit none
    private

    public :: take_friction

    ! Of the angle of a surface; steeper ones count as this steep.
    ! Tuned [1]. Origin: safeguard: places of a flank that stands upright are none of its rail.
    real(wp), parameter :: least_cosine = 0.05_wp
    ! Tuned [steps]: to a place on the rail. Origin: each leaves less than a fifth of the error.
    integer, parameter :: most_steps = 8

contains

    !> Put the friction that methods take into a workspace.
    subroutine take_friction(workspace, case)
        type(workspace_t), intent(inout) :: workspace !! with a normal solution
        type(contact_case_t), intent(in) :: case      !! its friction is checked

        real(wp) :: load, mu, squares, all
        integer :: k

        workspace%mu = case%mu
        workspace%mu_spread = 0.0_wp
        workspace%friction = case%friction
        if (case%asked%temperatures .or. falls_when_hot(case%friction)) &
            workspace%friction%heat = heating(case%thermal, case%friction%speed)
        if (case%friction%table%n == 0) return
        call place_table(workspace%solver%curve, workspace%strips, workspace%friction%table)
        workspace%mu = 0.0_wp
        squares = 0.0_wp
        all = 0.0_wp
        associate (strips => workspace%strips)
            do k = 1, strips%n
                load = load_of(strips, k)
                mu = mean_mu_between(workspace%friction%table, case%mu, strips%y_left(k), &
                                     strips%y_right(k))
                all = all + load
                workspace%mu = workspace%mu + load*mu
                squares = squares + load*mu**2
            end do
        end associate
        if (all <= 0.0_wp) return
        workspace%mu = workspace%mu/all
        if (workspace%mu > 0.0_wp) workspace%mu_spread = &
            sqrt(max(squares/all - workspace%mu**2, 0.0_wp))/workspace%mu
    end subroutine take_friction

    !> Make a table over the rail or the angle one over the contact.
    pure subroutine place_table(curve, strips, table)
        type(gap_curve_t), intent(in) :: curve         ! without points surfaces are flat
        type(contact_strips_t), intent(in) :: strips   ! where the contact is
        type(friction_table_t), intent(inout) :: table

        if (table%over == over_rail) call place_by_rail(curve, table)
        if (table%over == over_angle) call place_by_angle(curve, strips, table)
        table%over = over_contact
    end subroutine place_table

    !> Places on the rail as the contact's. A chord of the mean of both surfaces has turned half as
    !> far as the surfaces at its end, i: dy(rail) = y cos(angle + i/2)/cos(i/2).
    pure subroutine place_by_rail(curve, table)
        type(gap_curve_t), intent(in) :: curve
        type(friction_table_t), intent(inout) :: table

        real(wp) :: aside, y, turned, least
        integer :: i, step

        least = -huge(least)
        do i = 1, table%n
            aside = table%at(i) - table%y_rail
            y = aside/max(cos(table%angle), least_cosine)
            do step = 1, most_steps
                turned = 0.5_wp*gap_inclination(curve, y)
                y = aside*cos(turned)/max(cos(table%angle + turned), least_cosine)
            end do
            table%at(i) = max(y, least)
            least = table%at(i) + spacing(table%at(i))
        end do
    end subroutine place_by_rail

    !> A table over angles as one over the middles of strips, or of groups of them.
    pure subroutine place_by_angle(curve, strips, table)
        type(gap_curve_t), intent(in) :: curve
        type(contact_strips_t), intent(in) :: strips
        type(friction_table_t), intent(inout) :: table

        type(friction_table_t) :: angles
        real(wp) :: ends(2)
        integer :: group, first, last

        angles = table
        group = (strips%n + most_places - 1)/most_places
        table%n = 0
        do first = 1, strips%n, group
            last = min(first + group - 1, strips%n)
            ends(1) = abs(angles%angle + gap_inclination(curve, strips%y_left(first)))
            ends(2) = abs(angles%angle + gap_inclination(curve, strips%y_right(last)))
            table%n = table%n + 1
            table%at(table%n) = 0.5_wp*(strips%y_left(first) + strips%y_right(last))
            table%mu(table%n) = mean_mu_between(angles, 0.0_wp, minval(ends), maxval(ends))
        end do
    end subroutine place_by_angle
end module faststrip_contact_method_friction
