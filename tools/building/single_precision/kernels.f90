!> Values of the kernels in the working precision they were built with, on inputs that single
!> precision holds exactly: what tools/building/single_precision.py compares. CSV on stdout.
program kernels
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use, intrinsic :: iso_fortran_env, only: real64
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error, status_word
    use faststrip_base_creepage, only: creepage_t
    use faststrip_influence_closed, only: strip_influence
    use faststrip_influence_offcentre, only: strip_influence_at, strip_influence_gradient
    use faststrip_influence_offcentre_column, only: influence_column_gradient
    use faststrip_base_material, only: material_t, normal_compliance
    use faststrip_geometry_gap, only: gap_t
    use faststrip_normal_simple_hertz, only: hertz_t, hertz_solve
    use faststrip_normal_strip, only: strip_options_t, strip_workspace_t, &
                                      reserve_strip_workspace, set_strip_gap, strip_solve
    use faststrip_normal_strips, only: contact_strips_t, reserve_strips
    use faststrip_tangential_faststrip, only: faststrip_tangential_solve
    use faststrip_tangential_types, only: tangential_result_t
    use faststrip_normal_types, only: normal_result_t
    implicit none

    print '(a)', 'case,method,x_name,x,y_name,y,quantity,value,status'
    call influence_values()
    call strip_values()

contains

    subroutine influence_values()
        integer, parameter :: distances(5) = [0, 1, 10, 1000, 100000]
        real(wp), parameter :: places(4) = [0.875_wp, 1.0_wp, 1.125_wp, 3.0_wp]
        real(wp) :: b, cl, cr, value, d_x, d_length, column(3, 1)
        character(len=12) :: case
        integer :: k, i, j

        do k = -40, 40
            b = scale(1.375_wp, k)
            do i = 1, size(distances)
                write (case, '(a, i0)') 'n = ', distances(i)
                call put(case, 'strip_influence', 'b', b, 'X', 0.0_wp, 'value', &
                         strip_influence(distances(i), b))
                ! Edges of farther strips are no single precision numbers.
                if (distances(i) > 10) cycle
                cl = (2*distances(i) - 1)*b
                cr = (2*distances(i) + 1)*b
                do j = 1, size(places)
                    call put(case, 'strip_influence_at', 'b', b, 'X', places(j), 'value', &
                             strip_influence_at(places(j), cl, cr))
                    call strip_influence_gradient(places(j), 1.0_wp, cl, cr, value, d_x, d_length)
                    call put(case, 'gradient', 'b', b, 'X', places(j), 'd_x', d_x)
                    call put(case, 'gradient', 'b', b, 'X', places(j), 'd_half_length', d_length)
                    call influence_column_gradient(1.0_wp, cl, cr, places(j:j), [0.0_wp], &
                                                   column(1, :), column(2, :), column(3, :))
                    call put(case, 'column_gradient', 'b', b, 'X', places(j), 'value', column(1, 1))
                end do
            end do
        end do
    end subroutine influence_values

    !> Strips on Hertz ellipses, then rolling with some creepage.
    subroutine strip_values()
        integer, parameter :: strip_counts(3) = [5, 15, 31], points = 401
        type(strip_workspace_t) :: workspace
        type(contact_strips_t) :: strips
        type(strip_options_t) :: options
        type(normal_result_t) :: result
        type(tangential_result_t) :: forces
        type(hertz_t) :: hertz
        type(gap_t) :: gap
        type(status_t) :: status
        real(wp) :: inv2r(2), ratio, load, compliance
        character(len=12) :: case
        integer :: i, j, k, l

        compliance = normal_compliance(material_t())
        call reserve_strips(strips, 122, status)
        call reserve_strip_workspace(workspace, 122, points, status)
        allocate (gap%y(points), gap%h(points), gap%inv2r(points))
        do i = -12, 12, 2
            inv2r = scale(1.0_wp, [min(i, 0), min(-i, 0)] - 10)
            ratio = inv2r(1)/inv2r(2)
            do j = -20, 30, 5
                load = scale(1.0_wp, j)
                call hertz_solve(compliance, inv2r(1), inv2r(2), load, hertz, status)
                call put('exact', 'hertz', 'A/B', ratio, 'load_N', load, 'penetration', &
                         hertz%penetration, status)
                call put('exact', 'hertz', 'A/B', ratio, 'load_N', load, 'pmax', &
                         hertz%pmax, status)
                call put('exact', 'hertz', 'A/B', ratio, 'load_N', load, 'area', &
                         hertz%area, status)
                gap%y = [(2.0_wp*hertz%b*(2*l - 1 - points)/(points - 1), l=1, points)]
                gap%h = inv2r(2)*gap%y**2
                gap%inv2r = inv2r(1)
                do k = 1, size(strip_counts)
                    options = strip_options_t(strips_per_patch=strip_counts(k), tolerance=1.0e-4_wp)
                    call set_strip_gap(workspace, gap, status)
                    if (.not. is_error(status)) call strip_solve( &
                        workspace, compliance, load, options, strips, result, status)
                    write (case, '(a, i0)') 'N = ', strip_counts(k)
                    call put(case, 'strips', 'A/B', ratio, 'load_N', load, 'penetration', &
                             result%penetration, status)
                    call put(case, 'strips', 'A/B', ratio, 'load_N', load, 'pmax', &
                             result%pmax, status)
                    call put(case, 'strips', 'A/B', ratio, 'load_N', load, 'area', &
                             result%area, status)
                    if (is_error(status)) cycle
                    call faststrip_tangential_solve(strips, material_t(), 0.25_wp, &
                                         creepage_t(scale(1.0_wp, -10), scale(1.0_wp, -11), &
                                                    0.0_wp), 15, forces, status)
                    call put(case, 'faststrip', 'A/B', ratio, 'load_N', load, 'Fx', &
                             forces%fx, status)
                    call put(case, 'faststrip', 'A/B', ratio, 'load_N', load, 'Fy', &
                             forces%fy, status)
                end do
            end do
        end do
    end subroutine strip_values

    subroutine put(case, method, x_name, x, y_name, y, quantity, value, status)
        character(len=*), intent(in) :: case, method, x_name, y_name, quantity
        real(wp), intent(in) :: x, y, value
        type(status_t), intent(in), optional :: status

        character(len=20) :: word
        character(len=24) :: text

        word = 'ok'
        if (present(status)) word = status_word(status%code)
        text = ''
        if (present(status)) then
            if (is_error(status)) text = 'none'
        end if
        if (text == 'none') then
            text = ''
        else if (ieee_is_finite(value)) then
            write (text, '(es24.16e3)') value
        else
            word = 'not_finite'
        end if
        print '(*(a))', trim(case), ',', method, ',', x_name, ',', trim(real_text(x)), ',', &
            y_name, ',', trim(real_text(y)), ',', quantity, ',', trim(adjustl(text)), ',', &
            trim(word)
    end subroutine put

    function real_text(value) result(text)
        real(wp), intent(in) :: value
        character(len=24) :: text

        write (text, '(es24.16e3)') real(value, real64)
        text = adjustl(text)
    end function real_text
end program kernels
