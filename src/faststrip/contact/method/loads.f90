!> What a contact loads the rail with, rectangle by rectangle, for stresses below the surface.
!>
!> Tractions are those of the elements of the tangential method, whichever it is; without one there
!> are pressures alone. Elements of a method that marches have the pressure in their middle, of a
!> semi-ellipse over each row: its mean over the element takes its place, so that the row carries
!> its load.
module faststrip_contact_method_loads
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, &
                                     st_bad_argument, st_workspace_too_small
    use faststrip_contact_case, only: contact_case_t
    use faststrip_contact_method, only: workspace_t, contact_result_t
    use faststrip_contact_methods, only: tangential_none, tangential_tang
    use faststrip_stress_loads, only: put_load
    use faststrip_stress_peak, only: find_peak
    implicit none
    private

    public :: take_loads, find_stress_peak

contains

    !> The loads of the last contact, into the workspace's `loads`: of its elements, if there are
    !> any, else of its strips in as many parts as points along a strip.
    subroutine take_loads(workspace, status)
        type(workspace_t), intent(inout) :: workspace !! solved; see `reserve_contact_loads`
        type(status_t), intent(out) :: status
            !! `st_bad_argument`: no solution, no elements; `st_workspace_too_small`

        integer :: n

        call clear_status(status)
        workspace%loads%n = 0
        associate (tangential => workspace%methods%tangential, field => workspace%field, &
                   points => workspace%methods%points_per_strip)
            n = field%n
            if (n == 0) n = workspace%strips%n*points
            if (workspace%solved_by == 0) then
                call set_status(status, st_bad_argument, 'stresses need a contact that was solved')
            else if (field%n == 0 .and. tangential /= tangential_none) then
                call set_status(status, st_bad_argument, 'stresses need the elements of the ' // &
                                'contact, which were not kept')
            else if (.not. allocated(workspace%loads%x)) then
                call set_status(status, st_workspace_too_small, &
                                'no workspace was reserved for loads')
            else if (size(workspace%loads%x) < n) then
                call set_status(status, st_workspace_too_small, 'too little capacity for loads')
            else if (field%n == 0) then
                call put_strips(workspace, points)
            else
                call put_elements(workspace, tangential /= tangential_none &
                                             .and. tangential /= tangential_tang)
            end if
        end associate
    end subroutine take_loads

    !> The largest von Mises stress of a contact that was solved. What the pressures are estimated
    !> to be wrong by counts in its error too.
    subroutine find_stress_peak(workspace, case, result, status)
        type(workspace_t), intent(inout) :: workspace   !! with the solution; gets the loads
        type(contact_case_t), intent(in) :: case        !! what was solved
        type(contact_result_t), intent(inout) :: result !! gets `stress_peak`
        type(status_t), intent(inout) :: status         !! those of `take_loads`, unless an error

        type(status_t) :: taken

        if (is_error(status)) return
        call take_loads(workspace, taken)
        if (is_error(taken)) then
            status = taken
            return
        end if
        call find_peak(workspace%loads, case%material%nu_rail, result%stress_peak)
        if (result%is_estimated) result%stress_peak%est_err = result%stress_peak%est_err &
                                                              + result%normal_errors%est_err_pmax
    end subroutine find_stress_peak

    !> Strips in equal parts, each with its mean pressure.
    pure subroutine put_strips(workspace, points)
        type(workspace_t), intent(inout) :: workspace
        integer, intent(in) :: points ! parts of a strip

        integer :: i, k

        associate (strips => workspace%strips)
            do k = 1, strips%n
                associate (half => strips%half_length(k), left => strips%y_left(k), &
                           right => strips%y_right(k))
                    do i = 1, points
                        call put_load(workspace%loads, half*middle(i, points), &
                                      0.5_wp*(left + right), 2.0_wp*half/points, right - left, &
                                      [strips%p0(k)*mean_height(i, points), 0.0_wp, 0.0_wp])
                    end do
                end associate
            end do
        end associate
    end subroutine put_strips

    !> Elements as they are, or those of rows with their mean pressures.
    pure subroutine put_elements(workspace, are_rows)
        type(workspace_t), intent(inout) :: workspace
        logical, intent(in) :: are_rows ! whole rows, with pressures of semi-ellipses?

        real(wp) :: share
        integer :: i, first, last

        associate (field => workspace%field)
            first = 1
            last = 0
            share = 1.0_wp
            do i = 1, field%n
                if (are_rows .and. i > last) then
                    first = i
                    last = end_of_row(field%y(:field%n), i)
                end if
                if (are_rows) share = mean_height(i - first + 1, last - first + 1) &
                                      /height(middle(i - first + 1, last - first + 1))
                call put_load(workspace%loads, field%x(i), field%y(i), field%dx(i), &
                              field%area(i)/field%dx(i), &
                              [share*field%pn(i), field%px(i), field%py(i)])
            end do
        end associate
    end subroutine put_elements

    !> The last element with the y of one.
    pure integer function end_of_row(y, i) result(last)
        real(wp), intent(in) :: y(:)
        integer, intent(in) :: i

        do last = i, size(y) - 1
            if (abs(y(last + 1) - y(i)) > 0.0_wp) return
        end do
        last = size(y)
    end function end_of_row

    !> Middle of a part of a strip, from the leading edge, over its half-length.
    elemental real(wp) function middle(i, parts)
        integer, intent(in) :: i, parts

        middle = real(parts - 2*i + 1, wp)/parts
    end function middle

    !> sqrt(1 - t^2): a semi-ellipse.
    elemental real(wp) function height(t)
        real(wp), intent(in) :: t

        height = sqrt(max((1.0_wp - t)*(1.0_wp + t), 0.0_wp))
    end function height

    !> Its mean over a part of a strip.
    elemental real(wp) function mean_height(i, parts)
        integer, intent(in) :: i, parts

        real(wp) :: t(2), upto(2)

        t = real(parts - 2*[i, i - 1], wp)/parts
        upto = 0.5_wp*(t*height(t) + asin(t))
        mean_height = (upto(2) - upto(1))/(t(2) - t(1))
    end function mean_height
end module faststrip_contact_method_loads
