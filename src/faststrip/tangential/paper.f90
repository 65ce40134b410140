!> TFASTSTRIP of the paper, eqs. (25)-(48), as printed and as corrected.
!>
!> Every strip of a patch is marched like a row of Kalker's FASTSIM, in coordinates of the patch's
!> ellipse: half-width b (26), semi-axis a from the area (27). With xe = x/a, ye = y/b, ae = xd/a,
!>
!>     ux = G C1 cksi/T0,  uy = G C2 ceta/T0,  fx = G C3 b cphi/T0,  fy = G C3 a cphi/T0    (35)
!>     C1 = 9 C11/32,  C2 = 9 C22/32,  C3 = (3/pi) sqrt(b/a) C23                            (30)
!>     dpx = -(ux - fx ye) dx,  dpy = -(uy + fy xe) dx;   |p| <= ae^2 - xe^2          (39)-(43)
!>     Tx = mu N/(pi/2) sum px dA                                                     (44)-(48)
!>
!> **As printed** (`paper_solve`): with T0 = mu p0_i of each strip (34), and only those corrections
!> without which it does not run or its moment is none:
!>
!> - **P1** (41) adds `s (ae - xe)` at every point, so that the traction at the n-th point is the
!>   sum of all distances from the edge so far, about n/3 times what it should be:
!>   `s (x_previous - xe)`.
!> - **P2** (44) gives a moment without lengths, of the other sign: `Mz = sum(x py - y px)` in mm.
!> - **P3** (31), nx = Int(8a), counts a in mm: the number of points is the caller's.
!> - **P4** Several patches: each has its own ellipse (26)-(29) and its own mu N in (46)-(48).
!>
!> Its linear forces are 3 pi/8 = 1.18 times Kalker's on an ellipse, and sliding it gives mu N only
!> there.
!>
!> **As corrected** (`corrected_solve`), in addition:
!>
!> - **P5** one T0 for the patch, with which (30), (42) and (46) belong together;
!> - **P6** (46)-(48) divide by the sum of the bounds instead of pi/2, its value on an ellipse, so
!>   that sliding gives mu N on any patch.
!>
!> It then is FASTSIM with strips for rows: equal to it on an ellipse.
!>
!> Slip is what scaling back leaves over of the elastic step, as in FASTSIM.
module faststrip_tangential_paper
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_limits, only: largest_ratio, nothing
    use faststrip_base_status, only: status_t, set_status, is_error, count_text, st_bad_argument, &
                                     st_out_of_range
    use faststrip_base_material, only: material_t, check_material, combined_shear_modulus, &
                                       combined_poisson_ratio
    use faststrip_base_creepage, only: creepage_t
    use faststrip_normal_simple_patch_ellipse, only: patch_end, check_strips
    use faststrip_normal_strips, only: contact_strips_t, strip_load
    use faststrip_tangential_kalker, only: kalker_coefficients_t, kalker_coefficients
    use faststrip_tangential_motion, only: check_motion
    use faststrip_tangential_types, only: tangential_result_t, tangential_field_t, empty_field, &
                                          add_element, most_points, match_power, stick_share, &
                                          state_adhesion, state_slip
    implicit none
    private

    public :: paper_solve, corrected_solve
    public :: march_reading_t, march_sum_t, printed_march

    !> Which of the paper's statements (25)-(48) are taken as printed.
    type :: march_reading_t
        logical :: bound_of_strip = .true. !! (34) T0 = mu p0_i; else one T0, mu max(p0)
        logical :: step_from_edge = .true. !! (41) adds s (ae - xe); else s times the last step
        logical :: bare_moment = .true.    !! (44) with coordinates of the ellipse; else in mm
        logical :: scaled = .true.         !! (46)-(48); else the sum of the tractions
        logical :: from_reference = .true. !! (32) y from the reference point; else from y0 (28)
        integer :: points = 0              !! points along a strip; 0: nx = Int(8a) of (31)
        logical :: true_sum = .false.      !! (46) with the sum of the bounds instead of pi/2
    end type march_reading_t

    !> What the march adds up.
    type :: march_sum_t
        real(wp) :: tx = 0.0_wp !! force along x, N
        real(wp) :: ty = 0.0_wp !! force along y, N
        real(wp) :: mz = 0.0_wp !! moment, N mm (bare: N)
        real(wp) :: a = 0.0_wp  !! semi-axis of the virtual ellipse (27), mm
        real(wp) :: b = 0.0_wp  !! semi-axis (26), mm
        integer :: points = 0   !! points along each strip
        real(wp) :: power = 0.0_wp   !! frictional work per distance rolled, N
        real(wp) :: stuck = 0.0_wp   !! area in adhesion, mm^2
        real(wp) :: covered = 0.0_wp !! area, mm^2
    end type march_sum_t

    !> What the strips of a patch share.
    type :: patch_t
        logical :: carries = .false.       !! anything at all?
        real(wp) :: y0 = 0.0_wp            !! its middle (28), mm
        real(wp) :: c1 = 0.0_wp, c2 = 0.0_wp, c3 = 0.0_wp !! (30)
        real(wp) :: shear_modulus = 0.0_wp !! G, MPa
        real(wp) :: mu = 0.0_wp            !! coefficient of friction
        real(wp) :: largest_p0 = 0.0_wp    !! MPa
        real(wp) :: stress = 0.0_wp        !! mu N over the sum of the bounds, N
        type(creepage_t) :: creepage       !! about y = 0
    end type patch_t

contains

    !> TFASTSTRIP as printed (P1 to P4).
    pure subroutine paper_solve(strips, material, mu, creepage, points_per_strip, result, status, &
                                field)
        type(contact_strips_t), intent(in) :: strips !! a normal solution
        type(material_t), intent(in) :: material     !! moduli in MPa
        real(wp), intent(in) :: mu                   !! coefficient of friction, >= 0
        type(creepage_t), intent(in) :: creepage     !! about y = 0, for all patches
        integer, intent(in) :: points_per_strip      !! 1 to `most_points`
        type(tangential_result_t), intent(out) :: result !! sums; zero when there is an error
        type(status_t), intent(out) :: status        !! those of `faststrip_tangential_solve`
        type(tangential_field_t), intent(inout), optional :: field
            !! filled when present; needs capacity for n*points_per_strip elements

        call solve_patches(strips, material, mu, creepage, points_per_strip, &
                           march_reading_t(step_from_edge=.false., bare_moment=.false., &
                                           points=points_per_strip), result, status, field)
    end subroutine paper_solve

    !> TFASTSTRIP as corrected (1 to 6): FASTSIM in strips.
    pure subroutine corrected_solve(strips, material, mu, creepage, points_per_strip, result, &
                                    status, field)
        type(contact_strips_t), intent(in) :: strips !! a normal solution
        type(material_t), intent(in) :: material     !! moduli in MPa
        real(wp), intent(in) :: mu                   !! coefficient of friction, >= 0
        type(creepage_t), intent(in) :: creepage     !! about y = 0, for all patches
        integer, intent(in) :: points_per_strip      !! 1 to `most_points`
        type(tangential_result_t), intent(out) :: result !! sums; zero when there is an error
        type(status_t), intent(out) :: status        !! those of `faststrip_tangential_solve`
        type(tangential_field_t), intent(inout), optional :: field
            !! filled when present; needs capacity for n*points_per_strip elements

        call solve_patches(strips, material, mu, creepage, points_per_strip, &
                           march_reading_t(bound_of_strip=.false., step_from_edge=.false., &
                                           bare_moment=.false., points=points_per_strip, &
                                           true_sum=.true.), result, status, field)
    end subroutine corrected_solve

    pure subroutine solve_patches(strips, material, mu, creepage, points, reading, result, &
                                  status, field)
        type(contact_strips_t), intent(in) :: strips
        type(material_t), intent(in) :: material
        real(wp), intent(in) :: mu
        type(creepage_t), intent(in) :: creepage
        integer, intent(in) :: points
        type(march_reading_t), intent(in) :: reading
        type(tangential_result_t), intent(out) :: result
        type(status_t), intent(out) :: status
        type(tangential_field_t), intent(inout), optional :: field

        type(march_sum_t) :: total
        real(wp) :: stuck, covered
        integer :: first, last

        call check_input(strips, material, mu, creepage, status)
        if (is_error(status)) return
        if (points < 1 .or. points > most_points) then
            call set_status(status, st_out_of_range, 'points per strip must be 1 to 1000, ' // &
                            'got ' // count_text(points))
            return
        end if
        if (present(field)) then
            call empty_field(field, strips%n*points, status)
            if (is_error(status)) return
        end if
        stuck = 0.0_wp
        covered = 0.0_wp
        last = 0
        do while (last < strips%n)
            first = last + 1
            last = patch_end(strips, first)
            call march_patch(strips, first, last, material, mu, creepage, reading, total, status, &
                             field)
            if (is_error(status)) then
                result = tangential_result_t()
                return
            end if
            result%fx = result%fx + total%tx
            result%fy = result%fy + total%ty
            result%mz = result%mz + total%mz
            result%friction_power = result%friction_power + total%power
            stuck = stuck + total%stuck
            covered = covered + total%covered
        end do
        result%stick_fraction = stick_share(stuck, covered)
        if (present(field)) call match_power(result%friction_power, 1, field)
    end subroutine solve_patches

    !> Eqs. (25)-(48) statement by statement on one patch, with the chosen ones as printed.
    pure subroutine printed_march(strips, material, mu, creepage, reading, total, status)
        type(contact_strips_t), intent(in) :: strips  !! one patch
        type(material_t), intent(in) :: material      !! moduli in MPa
        real(wp), intent(in) :: mu                    !! coefficient of friction, > 0
        type(creepage_t), intent(in) :: creepage      !! about y = 0
        type(march_reading_t), intent(in) :: reading  !! which statements as printed
        type(march_sum_t), intent(out) :: total       !! forces on the rail, moment as printed
        type(status_t), intent(out) :: status
            !! those of `check_motion`, `check_material`, `check_strips`; `st_bad_argument`

        call check_input(strips, material, mu, creepage, status)
        if (is_error(status)) return
        if (strips%n_patches /= 1 .or. mu <= 0.0_wp .or. reading%points < 0 &
            .or. minval(strips%half_length(:strips%n)) <= 0.0_wp &
            .or. minval(strips%p0(:strips%n)) <= 0.0_wp) then
            call set_status(status, st_bad_argument, 'one patch under pressure with friction only')
            return
        end if
        call march_patch(strips, 1, strips%n, material, mu, creepage, reading, total, status)
    end subroutine printed_march

    pure subroutine check_input(strips, material, mu, creepage, status)
        type(contact_strips_t), intent(in) :: strips
        type(material_t), intent(in) :: material
        real(wp), intent(in) :: mu
        type(creepage_t), intent(in) :: creepage
        type(status_t), intent(out) :: status

        call check_motion(mu, creepage, status)
        if (is_error(status)) return
        call check_material(material, status)
        if (is_error(status)) return
        call check_strips(strips, status)
    end subroutine check_input

    !> March through strips `first` to `last`, one patch; nothing where it carries nothing.
    pure subroutine march_patch(strips, first, last, material, mu, creepage, reading, total, &
                                status, field)
        type(contact_strips_t), intent(in) :: strips
        integer, intent(in) :: first, last
        type(material_t), intent(in) :: material
        real(wp), intent(in) :: mu
        type(creepage_t), intent(in) :: creepage
        type(march_reading_t), intent(in) :: reading
        type(march_sum_t), intent(out) :: total
        type(status_t), intent(inout) :: status
        type(tangential_field_t), intent(inout), optional :: field

        type(patch_t) :: patch
        integer :: i

        call scale_patch(strips, first, last, material, mu, reading, patch, total, status)
        if (is_error(status) .or. .not. patch%carries) return
        patch%creepage = creepage
        do i = first, last
            call march_strip(strips, i, patch, reading, total, field)
        end do
    end subroutine march_patch

    !> What the strips of a patch share: (26) to (31), (46).
    pure subroutine scale_patch(strips, first, last, material, mu, reading, patch, total, status)
        type(contact_strips_t), intent(in) :: strips
        integer, intent(in) :: first, last
        type(material_t), intent(in) :: material
        real(wp), intent(in) :: mu
        type(march_reading_t), intent(in) :: reading
        type(patch_t), intent(out) :: patch        ! but for its creepage
        type(march_sum_t), intent(inout) :: total  ! its axes and points
        type(status_t), intent(inout) :: status

        type(kalker_coefficients_t) :: c
        real(wp) :: ratio, area, load, width, sum_of_bounds
        integer :: i

        area = 0.0_wp
        load = 0.0_wp
        do i = first, last
            width = strips%y_right(i) - strips%y_left(i)
            area = area + 2.0_wp*strips%half_length(i)*width
            load = load + strip_load(strips%p0(i), strips%half_length(i), width)
        end do
        if (area <= nothing .or. mu*load <= nothing) return
        patch%carries = .true.
        total%b = 0.5_wp*(strips%y_right(last) - strips%y_left(first))       ! (26)
        total%a = area/(pi*total%b)                                          ! (27)
        patch%y0 = 0.5_wp*(strips%y_left(first) + strips%y_right(last))      ! (28)
        ratio = min(max(total%b/total%a, 1.0_wp/largest_ratio), largest_ratio) ! (29)
        call kalker_coefficients(1.0_wp/ratio, combined_poisson_ratio(material), c, status)
        if (is_error(status)) return
        ! Given: the paper's (30)
        patch%c1 = 9.0_wp/32.0_wp*c%c11                                      ! (30)
        patch%c2 = 9.0_wp/32.0_wp*c%c22 ! Given: the paper's (30)
        patch%c3 = 3.0_wp/pi*sqrt(ratio)*c%c23
        total%points = reading%points
        ! Given: the paper's (31)
        if (total%points == 0) total%points = max(int(8.0_wp*total%a), 1)    ! (31)
        patch%shear_modulus = combined_shear_modulus(material)
        patch%mu = mu
        patch%largest_p0 = maxval(strips%p0(first:last))
        sum_of_bounds = 0.5_wp*pi
        if (reading%true_sum) sum_of_bounds = bounds_of_patch(strips, first, last, total)
        ! (46)-(48) divide by the sum of the bounds and multiply by mu N.
        patch%stress = mu*load/sum_of_bounds
    end subroutine scale_patch

    !> March through one strip of a patch, from its leading edge: (32) to (45).
    pure subroutine march_strip(strips, i, patch, reading, total, field)
        type(contact_strips_t), intent(in) :: strips
        integer, intent(in) :: i
        type(patch_t), intent(in) :: patch
        type(march_reading_t), intent(in) :: reading
        type(march_sum_t), intent(inout) :: total
        type(tangential_field_t), intent(inout), optional :: field

        real(wp) :: t0, ux, uy, fx, fy, factor, y, width, ye, ae, spacing, step, xe, before, cell
        real(wp) :: sx, sy, px, py, p, stress, lever, ahead_x, ahead_y, slip_x, slip_y, x
        integer :: j, state

        y = 0.5_wp*(strips%y_left(i) + strips%y_right(i))
        width = strips%y_right(i) - strips%y_left(i)
        t0 = patch%mu*patch%largest_p0
        if (reading%bound_of_strip) t0 = patch%mu*strips%p0(i)               ! (34)
        if (t0*strips%half_length(i)*width <= nothing) return
        ye = y/total%b                                                       ! (32)
        if (.not. reading%from_reference) ye = (y - patch%y0)/total%b
        factor = patch%shear_modulus/t0                                      ! (35)
        ux = factor*patch%c1*patch%creepage%cksi
        uy = factor*patch%c2*patch%creepage%ceta
        fx = factor*patch%c3*total%b*patch%creepage%cphi
        fy = factor*patch%c3*total%a*patch%creepage%cphi
        ae = strips%half_length(i)/total%a                                   ! (36)
        spacing = 2.0_wp*ae/total%points                                     ! (37)
        cell = width/total%b*spacing                                         ! (33), (38)
        stress = patch%stress
        if (.not. reading%scaled) stress = total%a*total%b*t0
        sx = ux - fx*ye                                                      ! (39)
        px = 0.0_wp
        py = 0.0_wp
        before = ae
        do j = 1, total%points
            xe = ae - (j - 0.5_wp)*spacing
            step = ae - xe
            if (.not. reading%step_from_edge) step = before - xe
            sy = uy + fy*(xe + 0.5_wp*step)                                  ! (40)
            px = px - sx*step                                                ! (41)
            py = py - sy*step
            p = sqrt(px*px + py*py)                                          ! (42)
            state = state_adhesion
            slip_x = 0.0_wp
            slip_y = 0.0_wp
            if (p > ae*ae - xe*xe) then
                state = state_slip
                ahead_x = px
                ahead_y = py
                px = px*((ae*ae - xe*xe)/p)                                  ! (43)
                py = py*((ae*ae - xe*xe)/p)
                ! Slip over rolling speed: creepage per slope times the slope scaled back.
                slip_x = (px - ahead_x)/(step*factor*patch%c1)
                slip_y = (py - ahead_y)/(step*factor*patch%c2)
            else
                total%stuck = total%stuck + cell*total%a*total%b
            end if
            before = xe
            total%covered = total%covered + cell*total%a*total%b
            total%tx = total%tx + px*cell*stress                             ! (44), (45)
            total%ty = total%ty + py*cell*stress
            ! What motion feeds in, as in FASTSIM.
            total%power = total%power - (px*sx/patch%c1 + py*sy/patch%c2)/factor*cell*stress
            lever = px*ye - py*xe
            if (.not. reading%bare_moment) lever = py*xe*total%a - px*ye*total%b
            total%mz = total%mz + lever*cell*stress
            if (present(field)) then
                x = xe*total%a
                call add_element( &
                    field, x, y, [spacing*total%a, cell*total%a*total%b], &
                    strips%p0(i)*sqrt(max(1.0_wp - (x/strips%half_length(i))**2, 0.0_wp)), &
                    px*stress/(total%a*total%b), py*stress/(total%a*total%b), slip_x, slip_y, &
                    state)
            end if
        end do
    end subroutine march_strip

    !> Sum of `ae^2 - xe^2` over the elements of a patch: pi/2 on an ellipse with many.
    pure real(wp) function bounds_of_patch(strips, first, last, total) result(bounds)
        type(contact_strips_t), intent(in) :: strips
        integer, intent(in) :: first, last
        type(march_sum_t), intent(in) :: total !! with axes and points

        integer :: i

        bounds = 0.0_wp
        do i = first, last
            bounds = bounds + (strips%half_length(i)/total%a)**3 &
                     *(strips%y_right(i) - strips%y_left(i))/total%b
        end do
        bounds = bounds*(4.0_wp + 2.0_wp/real(total%points, wp)**2)/3.0_wp
    end function bounds_of_patch
end module faststrip_tangential_paper
