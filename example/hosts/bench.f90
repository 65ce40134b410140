!> What a call costs through each compiled interface: the same contact by `use faststrip`, the C
!> interface and the F77 interface, in turn, the least time of many rounds. CSV: what,face,ns.
program bench
    use, intrinsic :: iso_c_binding
    use, intrinsic :: iso_fortran_env, only: int64
    use faststrip
    use faststrip_normal_simple_hertz, only: hertz_t
    use faststrip_tangential_types, only: tangential_result_t
    use faststrip_tangential_kalker, only: kalker_coefficients_t, kalker_coefficients
    use faststrip_tangential_fastsim, only: fastsim_coefficients_solve
    implicit none

    integer, parameter :: rounds = 41, points = 301
    real(wp), parameter :: a = 6.0_wp, b = 5.0_wp, g = 82000.0_wp, load = 1.0e5_wp

    !> `faststrip_case` of the header.
    type, bind(c) :: c_case_t
        integer(c_size_t) :: size
        integer(c_int) :: normal, tangential, strips_per_patch, points_per_strip
        integer(c_int) :: fastsim_nx, fastsim_ny, by_load, warm_start, with_elements
        real(c_double) :: e_wheel, e_rail, nu_wheel, nu_rail, mu, load, penetration
        real(c_double) :: cksi, ceta, cphi
    end type c_case_t

    interface
        integer(c_int) function faststrip_default_case(case, length) bind(c)
            import :: c_int, c_case_t, c_size_t
            type(c_case_t), intent(out) :: case
            integer(c_size_t), value :: length
        end function faststrip_default_case
        integer(c_int) function faststrip_new(case, max_points, workspace) bind(c)
            import :: c_int, c_case_t, c_ptr
            type(c_case_t), intent(in) :: case
            integer(c_int), value :: max_points
            type(c_ptr), intent(out) :: workspace
        end function faststrip_new
        integer(c_int) function faststrip_set_gap(workspace, n, y, h, inv2r, inclination) bind(c)
            import :: c_int, c_ptr, c_double
            type(c_ptr), value :: workspace
            integer(c_int), value :: n
            real(c_double), intent(in) :: y(*), h(*), inv2r(*)
            type(c_ptr), value :: inclination
        end function faststrip_set_gap
        integer(c_int) function c_solve(workspace, case, result) &
            bind(c, name='faststrip_solve')
            import :: c_int, c_ptr, c_case_t, c_double
            type(c_ptr), value :: workspace
            type(c_case_t), intent(in) :: case
            real(c_double), intent(out) :: result(*)
        end function c_solve
        integer(c_int) function faststrip_fastsim(a, b, g, c11, c22, c23, cksi, ceta, cphi, mu, &
                                                  load, nx, ny, forces) bind(c)
            import :: c_int, c_double
            real(c_double), value :: a, b, g, c11, c22, c23, cksi, ceta, cphi, mu, load
            integer(c_int), value :: nx, ny
            real(c_double), intent(out) :: forces(3)
        end function faststrip_fastsim
    end interface

    external :: fsdflt, fsinit, fsgap, fssolv, fstsim
    type(workspace_t) :: workspace
    type(contact_case_t) :: case
    type(contact_result_t) :: result
    type(tangential_result_t) :: forces
    type(kalker_coefficients_t) :: c
    type(status_t) :: status
    type(c_case_t) :: c_case
    type(c_ptr) :: c_workspace
    real(wp) :: y(points), h(points), inv2r(points), par(9), res(20), fx, fy, mz, f(3), total
    integer :: iopt(9), iwork(8), info, i

    y = [(-15.0_wp + 0.1_wp*i, i=0, points - 1)]
    h = 2.0e-3_wp*y**2
    inv2r = 1.0_wp/920.0_wp
    total = 0.0_wp
    call reserve_workspace(workspace, case%methods, points, status)
    call set_contact_gap(workspace, y, h, inv2r, status)
    case%load = load
    case%creepage = creepage_t(1.0e-3_wp, 5.0e-4_wp, 1.0e-4_wp)
    info = faststrip_default_case(c_case, c_sizeof(c_case))
    info = faststrip_new(c_case, points, c_workspace)
    info = faststrip_set_gap(c_workspace, points, y, h, inv2r, c_null_ptr)
    call fsdflt(iopt, par)
    call fsinit(iopt, points, iwork, 8, info)
    call fsgap(iwork, points, y, h, inv2r, info)
    call kalker_coefficients(a/b, 0.28_wp, c, status)

    call time_contact('hertz', normal_hertz, tangential_none, .false., 20000)
    call time_contact('hertz + faststrip', normal_hertz, tangential_faststrip, .false., 400)
    call time_contact('strips + faststrip, warm', normal_strip, tangential_faststrip, .true., 10)
    call time_fastsim('fastsim 1 x 1', 1, 20000)
    call time_fastsim('fastsim 10 x 10', 10, 2000)
    if (total == 0.0_wp) print '(a)', '# nothing was computed'

contains

    subroutine time_contact(what, normal, tangential, warm, calls)
        character(len=*), intent(in) :: what
        integer, intent(in) :: normal, tangential, calls
        logical, intent(in) :: warm

        real(wp) :: least(3)
        integer(int64) :: from
        integer :: round, k

        case%methods%normal = normal
        case%methods%tangential = tangential
        case%warm_start = warm
        c_case%normal = normal
        c_case%tangential = tangential
        c_case%warm_start = merge(1, 0, warm)
        c_case%cksi = case%creepage%cksi
        c_case%ceta = case%creepage%ceta
        c_case%cphi = case%creepage%cphi
        iopt(1:2) = [normal, tangential]
        iopt(8) = merge(1, 0, warm)
        par(7:9) = [case%creepage%cksi, case%creepage%ceta, case%creepage%cphi]
        least = huge(least)
        do round = 1, rounds
            call system_clock(from)
            do k = 1, calls
                case%load = load*(1.0_wp + 0.01_wp*modulo(k, 2))
                call solve_contact(workspace, case, result, status)
                total = total + result%normal%penetration
            end do
            least(1) = min(least(1), since(from)/calls)
            call system_clock(from)
            do k = 1, calls
                c_case%load = load*(1.0_wp + 0.01_wp*modulo(k, 2))
                info = c_solve(c_workspace, c_case, res)
                total = total + res(3)
            end do
            least(2) = min(least(2), since(from)/calls)
            call system_clock(from)
            do k = 1, calls
                par(6) = load*(1.0_wp + 0.01_wp*modulo(k, 2))
                call fssolv(iwork, iopt, par, res, info)
                total = total + res(2)
            end do
            least(3) = min(least(3), since(from)/calls)
        end do
        call put(what, least)
    end subroutine time_contact

    subroutine time_fastsim(what, n, calls)
        character(len=*), intent(in) :: what
        integer, intent(in) :: n, calls

        real(wp) :: least(3), cksi
        integer(int64) :: from
        integer :: round, k

        least = huge(least)
        do round = 1, rounds
            call system_clock(from)
            do k = 1, calls
                cksi = 1.0e-3_wp + 1.0e-9_wp*k
                call fastsim_coefficients_solve(hertz_t(a=a, b=b, load=load), g, c, 0.3_wp, &
                    creepage_t(cksi, 5.0e-4_wp, 1.0e-4_wp), n, n, forces, status)
                total = total + forces%fx
            end do
            least(1) = min(least(1), since(from)/calls)
            call system_clock(from)
            do k = 1, calls
                cksi = 1.0e-3_wp + 1.0e-9_wp*k
                info = faststrip_fastsim(a, b, g, c%c11, c%c22, c%c23, cksi, 5.0e-4_wp, &
                                         1.0e-4_wp, 0.3_wp, load, n, n, f)
                total = total + f(1)
            end do
            least(2) = min(least(2), since(from)/calls)
            call system_clock(from)
            do k = 1, calls
                cksi = 1.0e-3_wp + 1.0e-9_wp*k
                call fstsim(a, b, g, c%c11, c%c22, c%c23, cksi, 5.0e-4_wp, 1.0e-4_wp, 0.3_wp, &
                            load, n, n, fx, fy, mz, info)
                total = total + fx
            end do
            least(3) = min(least(3), since(from)/calls)
        end do
        call put(what, least)
    end subroutine time_fastsim

    !> Nanoseconds since a count of the clock.
    real(wp) function since(from)
        integer(int64), intent(in) :: from
        integer(int64) :: now, rate

        call system_clock(now, rate)
        since = real(now - from, wp)/real(rate, wp)*1.0e9_wp
    end function since

    subroutine put(what, least)
        character(len=*), intent(in) :: what
        real(wp), intent(in) :: least(3)
        character(len=7), parameter :: faces(3) = ['fortran', 'c      ', 'f77    ']
        integer :: k

        do k = 1, 3
            print '(4a, f0.1)', '"' // what // '"', ',', trim(faces(k)), ',', least(k)
        end do
    end subroutine put
end program bench
