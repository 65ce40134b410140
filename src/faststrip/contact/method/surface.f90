!> A contact on a curved surface: each strip has its own place, normal and plane.
!>
!> A half-space has one plane. Where wheel and rail curve together, as in the root of a flange, each
!> strip presses along its own normal: the force of the contact is the sum of the strips' pressures
!> and tractions in their own planes,
!>
!>     F = sum N_k n_k + Fy_k t_k + Fx_k e_x,   n = (0, -sin a, cos a), t = (0, cos a, sin a),
!>
!> a the inclination of a strip, and its moment about the reference point has the arms of the
!> strips' places. Pressures and their own sums stay those of the plane.
module faststrip_contact_method_surface
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_material, only: combined_shear_modulus, material_t
    use faststrip_base_status, only: status_t, set_status, is_error, number_text, &
                                     st_bad_argument, st_out_of_range, st_under_resolved
    use faststrip_contact_case, only: contact_case_t
    use faststrip_geometry_gap_curve, only: gap_curve_t, gap_inclination, gap_inv2r, &
                                            first_point_from
    use faststrip_normal_limitations, only: turn_of_contact, lean_of_contact, &
                                            doubtful_inclination, &
                                            name_resolution, name_force_resolution
    use faststrip_normal_strips, only: contact_strips_t, strips_load, load_of, middle_of
    use faststrip_contact_method, only: workspace_t, contact_result_t
    use faststrip_contact_methods, only: tangential_faststrip, tangential_faststrip_plain
    use faststrip_tangential_types, only: strip_forces_t
    implicit none
    private

    public :: check_surface, lay_strips, flatten_load, turn_forces, find_lean, lateral_share
    public :: conformal_turn, add_pressure_errors, shift_pressure_errors, add_turn_errors
    public :: slip_of_adhesion

    ! What a half-space leaves out of a contact that turns by 2 theta, over theta^2; `conformal`
    ! begins at theta = 0.17.
    ! Tuned [1]. Origin: CONTACT's example of radii 10 in 10.2 mm, theta = 0.55, with influence
    ! numbers of the curved bodies: pmax 9 % off, the load at a penetration 3 %, forces by 4 % of mu
    ! N; areas by Li's grooves.
    real(wp), parameter :: lost_of_pmax = 0.35_wp, lost_of_area = 0.3_wp, &
        lost_of_penetration = 0.1_wp, lost_of_forces = 0.15_wp
    ! Tuned [1]: force of a small slip over G times the area. Origin: C11/pi of a round patch.
    real(wp), parameter :: stiffness = 1.4_wp

contains

    !> Refuse a gap that does not tell how its surfaces are inclined, or where they turn over.
    pure subroutine check_surface(curve, status)
        type(gap_curve_t), intent(in) :: curve  !! that was set
        type(status_t), intent(inout) :: status
            !! `st_bad_argument`, `st_out_of_range`; an error before stays

        real(wp) :: steepest

        if (.not. curve%inclination_is_known) then
            call set_status(status, st_bad_argument, 'a curved surface needs the inclination ' // &
                            'of the surfaces, which this gap does not have')
            return
        end if
        steepest = maxval(abs(curve%inclination(:curve%n)))
        if (steepest >= 0.5_wp*pi) &
            call set_status(status, st_out_of_range, 'the inclination of a curved surface must ' &
                            // 'be below pi/2, got ' // trim(number_text(steepest)) // &
                            ' rad: degrees?')
    end subroutine check_surface

    !> Lay strips on the curved surface in the middle between both bodies, or back on the plane.
    pure subroutine lay_strips(curve, case, strips)
        type(gap_curve_t), intent(in) :: curve          !! of the contact
        type(contact_case_t), intent(in) :: case        !! is its surface curved? Its pitch
        type(contact_strips_t), intent(inout) :: strips !! get their places

        real(wp) :: y, z
        integer :: k

        strips%is_curved = case%curved
        if (.not. strips%is_curved) return
        strips%pitch = case%pitch
        strips%follow_outline = case%pitch > 0.0_wp
        ! The radius along x, in the frame of the contact, is that of rolling.
        if (.not. strips%follow_outline) &
            strips%pitch = 2.0_wp*max(gap_inv2r(curve, 0.0_wp), 0.0_wp)
        y = 0.0_wp
        z = 0.0_wp
        do k = 1, strips%n
            call go_to_strip(curve, strips, k, y, z)
            strips%inclination(k) = gap_inclination(curve, y)
            strips%depth(k) = z
        end do
    end subroutine lay_strips

    !> From a place on the surface to the middle of a strip.
    pure subroutine go_to_strip(curve, strips, k, y, z)
        type(gap_curve_t), intent(in) :: curve
        type(contact_strips_t), intent(in) :: strips
        integer, intent(in) :: k
        real(wp), intent(inout) :: y, z ! across and below the plane of the contact, mm

        z = z + descent(curve, y, middle_of(strips, k))
        y = middle_of(strips, k)
    end subroutine go_to_strip

    !> By how much the surface lies deeper at one place than at another, mm.
    pure real(wp) function descent(curve, y_from, y_to)
        type(gap_curve_t), intent(in) :: curve
        real(wp), intent(in) :: y_from, y_to ! mm

        real(wp) :: y, next, slope, slope_next, last
        integer :: i

        descent = 0.0_wp
        y = min(y_from, y_to)
        last = max(y_from, y_to)
        slope = tan(gap_inclination(curve, y))
        do i = first_point_from(curve, y), curve%n + 1
            next = last
            if (i <= curve%n) next = min(curve%y(i), last)
            slope_next = tan(gap_inclination(curve, next))
            descent = descent + 0.5_wp*(slope + slope_next)*(next - y)
            if (next >= last) exit
            y = next
            slope = slope_next
        end do
        if (y_to < y_from) descent = -descent
    end function descent

    !> Add what a half-space leaves out of a contact whose surfaces turn so far that it is
    !> `conformal` to the estimated errors of its pressures.
    pure subroutine add_pressure_errors(turn, case, result, status)
        real(wp), intent(in) :: turn                    !! of `conformal_turn`, rad
        type(contact_case_t), intent(in) :: case        !! that was solved
        type(contact_result_t), intent(inout) :: result !! gets the errors, if it has some
        type(status_t), intent(inout) :: status         !! limitations so far; `st_under_resolved`

        if (is_error(status) .or. .not. turn > 0.0_wp) return
        call shift_pressure_errors(turn**2, result)
        associate (errors => result%normal_errors)
            if (.not. btest(status%limitations, st_under_resolved)) &
                call name_resolution(errors%est_err_penetration, errors%est_err_pmax, &
                                     errors%est_err_area, case%resolution_limit, status)
        end associate
    end subroutine add_pressure_errors

    !> Add it, or the negative to take it away, for estimates of forces that know nothing of it.
    pure subroutine shift_pressure_errors(squared, result)
        real(wp), intent(in) :: squared                 !! of `conformal_turn`, squared
        type(contact_result_t), intent(inout) :: result !! its errors are shifted

        associate (errors => result%normal_errors)
            errors%est_err_penetration = errors%est_err_penetration + lost_of_penetration*squared
            errors%est_err_pmax = errors%est_err_pmax + lost_of_pmax*squared
            errors%est_err_area = errors%est_err_area + lost_of_area*squared
        end associate
    end subroutine shift_pressure_errors

    !> The same of the forces: in the plane also what turning its pressures and the strips' own slip
    !> would change.
    pure subroutine add_turn_errors(workspace, turn, case, result, status)
        type(workspace_t), intent(in) :: workspace      !! with the solution
        real(wp), intent(in) :: turn                    !! of `conformal_turn`, rad
        type(contact_case_t), intent(in) :: case        !! that was solved
        type(contact_result_t), intent(inout) :: result !! gets the errors, if it has some
        type(status_t), intent(inout) :: status         !! limitations so far; `st_under_resolved`

        real(wp) :: lean, depth, bound, slip, added(2)

        if (is_error(status) .or. .not. (turn > 0.0_wp .and. result%forces_are_estimated)) return
        bound = workspace%mu*result%normal%load
        if (.not. bound > 0.0_wp) return
        lean = lean_of_contact(workspace%solver%curve, workspace%strips)
        depth = mean_depth(workspace%solver%curve, workspace%strips)
        added = lost_of_forces*turn**2
        if (.not. case%curved) then
            added(2) = added(2) + abs(lean)*result%normal%load/bound
            ! A little more slip, along x by the depth and across by the spin: what it adds to a
            ! force that does not slide, or turns of one that does.
            associate (c => sqrt(result%normal%area/pi), creepage => result%creepage, &
                       pitch => 2.0_wp*max(gap_inv2r(workspace%solver%curve, 0.0_wp), 0.0_wp))
                slip = norm2([creepage%cksi, creepage%ceta, 0.5_wp*c*creepage%cphi])
                added = added + pitch*hypot(depth, 0.5_wp*c*lean) &
                        /max(slip, slip_of_adhesion(bound, result%normal%area, case%material))
            end associate
        end if
        associate (errors => result%force_errors)
            errors%fx = errors%fx + added(1)
            errors%fy = errors%fy + added(2)
            errors%mz = errors%mz + maxval(added)
            if (.not. btest(status%limitations, st_under_resolved)) &
                call name_force_resolution(errors%fx, errors%fy, errors%mz - errors%arm, &
                                           case%force_limit, status)
        end associate
    end subroutine add_turn_errors

    !> The creepage at which the linear force of a round patch is mu N.
    pure real(wp) function slip_of_adhesion(bound, area, material) result(slip)
        real(wp), intent(in) :: bound            !! mu N, N
        real(wp), intent(in) :: area             !! of the patch, mm2
        type(material_t), intent(in) :: material !! moduli in MPa

        slip = bound/(stiffness*combined_shear_modulus(material)*area)
    end function slip_of_adhesion

    !> Do the forces of a method act at the strips' places along x?
    pure logical function acts_at_places(tangential)
        integer, intent(in) :: tangential !! number of the method

        acts_at_places = tangential == tangential_faststrip .or. &
                         tangential == tangential_faststrip_plain
    end function acts_at_places

    !> Mean by load of the strips' depth, mm.
    pure real(wp) function mean_depth(curve, strips) result(depth)
        type(gap_curve_t), intent(in) :: curve
        type(contact_strips_t), intent(in) :: strips

        real(wp) :: y, z
        integer :: k

        depth = 0.0_wp
        y = 0.0_wp
        z = 0.0_wp
        do k = 1, strips%n
            call go_to_strip(curve, strips, k, y, z)
            depth = depth + load_of(strips, k)*z
        end do
        depth = depth/max(strips_load(strips), tiny(depth))
    end function mean_depth

    !> Half of what the surfaces turn by, if that makes the contact `conformal` and errors are
    !> estimated, rad; else zero.
    pure real(wp) function conformal_turn(workspace, result) result(turn)
        type(workspace_t), intent(in) :: workspace   !! with the solution
        type(contact_result_t), intent(in) :: result !! its figures

        turn = 0.0_wp
        if (.not. result%is_estimated) return
        associate (curve => workspace%solver%curve)
            if (curve%n == 0 .or. .not. curve%inclination_is_known) return
            turn = turn_of_contact(curve, workspace%strips)
        end associate
        turn = merge(0.5_wp*turn, 0.0_wp, turn > doubtful_inclination)
    end function conformal_turn

    !> The load of pressures that were turned, as it is along the surface.
    pure subroutine flatten_load(result)
        type(contact_result_t), intent(inout) :: result !! of `turn_forces`, or of a plane

        if (result%is_curved) result%normal%load = result%along_load
        result%is_curved = .false.
    end subroutine flatten_load

    !> Of pressures in the frame of the contact the lateral force, and the mean cosine of their
    !> inclination by load. Of a plane none and one.
    pure subroutine find_lean(strips, load, lateral, cosine)
        type(contact_strips_t), intent(in) :: strips !! laid
        real(wp), intent(in) :: load                 !! along their own normals, N
        real(wp), intent(out) :: lateral             !! N
        real(wp), intent(out) :: cosine              !! 1 at most

        real(wp) :: share, all
        integer :: k

        lateral = 0.0_wp
        cosine = 1.0_wp
        all = strips_load(strips)
        if (.not. strips%is_curved .or. .not. all > 0.0_wp) return
        do k = 1, strips%n
            share = load_of(strips, k)/all
            lateral = lateral - share*load*sin(strips%inclination(k))
            cosine = cosine - share*2.0_wp*sin(0.5_wp*strips%inclination(k))**2
        end do
    end subroutine find_lean

    !> Of tractions the lateral force in the frame of the contact over the cosine of `find_lean`,
    !> that of a force shared by load along the surface, N.
    pure real(wp) function lateral_share(strips, forces, fy, cosine) result(lateral)
        type(contact_strips_t), intent(in) :: strips !! laid
        type(strip_forces_t), intent(in) :: forces   !! of the strips, or none
        real(wp), intent(in) :: fy                   !! along the surface, N
        real(wp), intent(in) :: cosine               !! of `find_lean`

        integer :: k

        lateral = fy
        if (.not. strips%is_curved .or. forces%n /= strips%n) return
        do k = 1, strips%n
            lateral = lateral - forces%fy(k)*2.0_wp*sin(0.5_wp*strips%inclination(k))**2
        end do
        lateral = lateral/cosine
    end function lateral_share

    !> The moment of a result's pressures about its reference point; on a curved surface make load,
    !> forces and moment those of the surface, in the frame of the contact. Forces of methods that
    !> have none of strips go in proportion to their loads.
    pure subroutine turn_forces(workspace, result)
        type(workspace_t), intent(in) :: workspace      !! its strips are laid
        type(contact_result_t), intent(inout) :: result !! along the surface; is turned

        real(wp) :: load, share, fx, fy, side, down, lost, sine, turned_y, turned_z, arm, lever, &
            lean, shortened, turned_m, place, centre(2)
        integer :: k

        associate (strips => workspace%strips, forces => workspace%strip_forces, &
                   normal => result%normal, tangential => result%tangential)
            result%is_curved = .false.
            result%moment = 0.0_wp
            load = strips_load(strips)
            if (.not. load > 0.0_wp) return
            place = 0.0_wp
            centre = 0.0_wp
            do k = 1, strips%n
                if (strips%has_places) place = strips%x0(k)
                centre = centre + load_of(strips, k)/load*[place, middle_of(strips, k)]
            end do
            result%moment = normal%load*[centre(2), -centre(1)]
            ! Forces that know nothing of places have the arm of the pressures.
            if (strips%has_places .and. .not. acts_at_places(workspace%methods%tangential)) &
                tangential%mz = tangential%mz + centre(1)*tangential%fy
            if (.not. strips%is_curved) return
            result%is_curved = .true.
            result%moment = 0.0_wp
            result%along_load = normal%load
            result%along = tangential
            turned_m = 0.0_wp
            turned_y = 0.0_wp
            turned_z = 0.0_wp
            arm = 0.0_wp
            lever = 0.0_wp
            lean = 0.0_wp
            shortened = 0.0_wp
            do k = 1, strips%n
                share = load_of(strips, k)/load
                if (strips%has_places) place = strips%x0(k)
                fx = share*tangential%fx
                fy = share*tangential%fy
                if (forces%n == strips%n) then
                    fx = forces%fx(k)
                    fy = forces%fy(k)
                end if
                sine = sin(strips%inclination(k))
                lost = 2.0_wp*sin(0.5_wp*strips%inclination(k))**2
                side = -fy*lost - share*normal%load*sine
                down = -share*normal%load*lost + fy*sine
                turned_y = turned_y + side
                turned_z = turned_z + down
                turned_m = turned_m + place*side
                associate (y => middle_of(strips, k), z => strips%depth(k))
                    result%moment(1) = result%moment(1) + y*(share*normal%load + down) &
                                       - z*(fy + side)
                    arm = arm + y*fx - place*fy
                    lever = lever + z*fx - place*(share*normal%load + down)
                end associate
                lean = lean + share*sine
                shortened = shortened + share*lost
            end do
            ! What tractions have about the strips' own places turns with their planes.
            result%moment(2) = lever - lean*(tangential%mz + arm)
            tangential%mz = tangential%mz - shortened*(tangential%mz + arm) + turned_m
            tangential%fy = tangential%fy + turned_y
            normal%load = normal%load + turned_z
        end associate
    end subroutine turn_forces
end module faststrip_contact_method_surface
