!> Solve the contacts of wheelset.txt again by `use faststrip`, and count where a bit differs.
program replay
    use faststrip
    implicit none
    type(contact_case_t) :: case
    type(contact_result_t) :: result
    type(tangential_result_t) :: forces
    type(workspace_t) :: workspace
    type(kalker_coefficients_t) :: c
    type(hertz_t) :: hertz
    type(status_t) :: status
    real(wp) :: x, y, f(3), g
    integer :: method, unit, ended, i, rows(2), different(2)

    case%gap%y = [(-15.0_wp + 0.1_wp*i, i=0, 300)]
    case%gap%h = 0.5_wp*case%gap%y**2/300.0_wp
    case%gap%inv2r = [(0.5_wp/460.0_wp, i=0, 300)]
    case%methods%strips_per_patch = 7
    case%warm_start = .true.
    call reserve_workspace(workspace, case%methods, 301, status)
    call hertz_solve(normal_compliance(case%material), 0.5_wp/460.0_wp, 0.5_wp/300.0_wp, 8.0e4_wp, &
                     hertz, status)
    call kalker_coefficients(hertz%a/hertz%b, case%material%nu_wheel, c, status)
    g = case%material%e_wheel/(2.0_wp*(1.0_wp + case%material%nu_wheel))
    rows = 0
    different = 0
    open (newunit=unit, file='wheelset.txt', status='old', action='read')
    do
        read (unit, *, iostat=ended) method, x, y, case%load, case%creepage%cksi, &
            case%creepage%ceta, case%creepage%cphi, f
        if (ended /= 0) exit
        if (method == 1) then
            call solve_contact(workspace, case, result, status)
            forces = result%tangential
        else
            hertz%load = case%load
            call fastsim_coefficients_solve(hertz, g, c, case%mu, case%creepage, 15, 15, forces, &
                                            status)
        end if
        rows(method) = rows(method) + 1
        if (any([forces%fx, forces%fy, forces%mz] /= f)) different(method) = different(method) + 1
    end do
    close (unit)
    print '(a, 1x, i0)', 'rows', rows(1), 'rows', rows(2), 'different', different(1), &
        'different', different(2)
end program replay
