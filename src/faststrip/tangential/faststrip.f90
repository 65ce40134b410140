!> TFASTSTRIP, the better one: marching in the strips of any contact patch.
!>
!> Each patch has a virtual ellipse (semi-axes a, b of its area and second moments), which gives
!> Kalker's coefficients; everything else is the strip's own: its length 2 xd, its pressure p0 and
!> its place y. The sub-patches of a patch with a neck have ellipses of their own, and where they
!> hang together a little (`sub_patches`), what their ellipses give is averaged strip by strip. A
!> strip is marched from its leading edge like in FASTSIM (Kalker 1982; the paper's eq. (25)-(48)
!> once corrected). What differs from the paper, and why:
!>
!> - **S1** **Flexibility** `L_i = l_i (xd/a)^gamma`, gamma = 3/8. FASTSIM has gamma = 0 (one
!>   flexibility for the patch), strip theory gamma = 1 (each strip is a half-plane of its own,
!>   Carter's); a patch whose strips hang together lies between. The factors l_i make the linear
!>   forces Kalker's on an ellipse for any gamma:
!>   `l1 = 2 a I1/(C11 G), l2 = 2 a I1/(C22 G), l3 = (2/3) a sqrt(a/b) I3/(C23 G)`.
!> - **S2** **Bound** `mu p0 k (1 - t^2)^m (1 - alpha t)`, t = x/xd, k from `sum = pi/2` over the
!>   points, so that each strip saturates at mu times its load and the contact at mu N exactly (the
!>   paper scales afterwards). With m = 1 and alpha = 1/3 marching at constant creepage gives
!>   Carter's force `1 - (1 - delta)^2` exactly at every creepage (the slope of the force over
!>   creepage is half the squared length of the adhesion zone in both; comparing them gives the
!>   bound), so alpha > 0 repairs what a linear traction in adhesion spoils. Measured best with
!>   this gamma: alpha = 0.15. With spin the traction in adhesion is symmetric and so is the bound:
!>   alpha falls to zero with the share of spin, and m from 1 towards 0.7 with saturation by spin,
!>   for the elliptic bound (m = 1/2) is the true one where all slides.
!> - **S3** **Spin in x**: the adhesion slope of `-y cphi`, y from the centroid of the patch, is
!>   the mean of the one that goes with L1 and the one that makes the linear moment C33. The motion
!>   of the centroid itself, `cksi - y_c cphi`, is longitudinal creepage like any other: forces do
!>   not depend on where the reference point lies.
!> - **S4** **Slip**: with three flexibilities scaling the elastic predictor back to the bound
!>   points the wrong way. The step is implicit in the slip s = -lambda p,
!>   `p_i = (K_i/h q_i - e_i)/(K_i/h + lambda)`, |p| = bound, q the traction one step ahead; e_i
!>   goes from `K_i` times the slope of adhesion (lambda = 0) to the rigid slip (lambda large) on
!>   the scale `sqrt(K1 K2)/xd`, a property of the strip and not of the grid.
!> - **S5** **Flexibility in slip**: K_i moves half way from L_i to L3 with the share of spin and
!>   falls by up to a third with saturation: the traction of a spinning patch turns within the
!>   patch, and short waves are stiffer than long ones.
!> - **S6** **Moment**: traction that grows linearly from the edge has its centre at -xd/3 and
!>   gives neither C32 = -C23 nor C33. The arms are stretched so that the linear moments are
!>   Kalker's; the stretch fades as a strip saturates.
!> - **S7** **Stick**: where S2 gives Carter's force, a strip sticks over the share s of
!>   its length in which Carter's sticks over s^2; the stick fraction counts s^2, with spin too.
!>   The states of the field are those of the marching.
!> - **S8** **Friction power**: what the creepages feed in, `-(Fx cksi + Fy ceta + Mz cphi)`, all
!>   of which turns into heat in steady rolling, whatever the elasticity. The sum over the elements
!>   of the implicit march falls short of it by what its steps damp away (a third with 15 points);
!>   the field takes the traction of each step at its middle, which leaves some percent, and its
!>   slip is scaled to give the power.
!> - **S9** **Full sliding**: the bound of S2 gives Carter's force, but its centre lies off the
!>   strip's; with the fourth power of what a strip uses of its bound the traction moves back to the
!>   middle, which leaves the forces alone. Far beyond saturation m goes to 1/2 and alpha to zero,
!>   and from 30 to 300 times mu N of linear force the integral of mu p against the rigid slip
!>   takes over (`saturation`), exact in x at any number of points.
!> - **S10** **Correction**, unless the march alone is asked for: what the march misses of the
!>   forces and the stick of a patch or sub-patch is a smooth function of the creepages, of a/b, of
!>   Poisson's ratio, of the patch's shape and of how finely it is cut. It was fitted to TANG
!>   on random contacts and is added (`force_correction`). No more than mu N is left of the force,
!>   and no power is fed in: of force and moment goes what the other does not take out
!>   (`fed_in`).
!> - **S11** **Other patches**, unless the march alone is asked for: the tractions of the other
!>   patches give a patch creepage and a moment (`patch_coupling`). They are found without it, once
!>   more with what follows from them, and then the forces.
!> - **S12** **Falling friction** (`faststrip_base_friction`): the coefficient of an element is that
!>   of the slip which there would be under the one of the element ahead, as FASTSIM's F2: nothing
!>   is iterated and there is one solution, reached from adhesion. What was tuned or fitted for
!>   constant friction (S2, S5, S6, S9, S10) takes its mean where the patch slides for the
!>   coefficient: a first march finds it. What patches do to each other (S11) takes the static one.
!>   Where it falls with temperature, that of an element follows from the heat of the elements ahead
!>   of it and its own (`faststrip_tangential_heat_sources`), of which it is the root in closed form
!>   (`hot_share`).
!> - **S13** **Friction across the rail** (`faststrip_base_friction_table`): each strip marches and
!>   saturates with the mean coefficient over its width. What was tuned or fitted for one (S2, S5,
!>   S6, S9 to S11) takes the mean of the patch by load.
!> - **S14** **Dissimilar materials**: pressures cause slip (`pressure_slip`), which each strip has
!>   besides the creepages; in adhesion over 1.3 to 1.4, for the springs of a bedding are too stiff
!>   for it. What it changes of the pressures (Goodman) and of S10 is left out and estimated.
!> - **S15** **Curved surface**: strips that have their own planes (`contact_strips_t`) have their
!>   own rigid slip and spin (`strip_slip`). A patch rolls with their mean by load, each strip has
!>   the rest besides; what other patches do (S11) is along the plane of the contact. Strips that
!>   do not stand side by side have the slip that spin gives them at their places along x.
!>
!> `patch_law` has what the ellipse says of the strips, `strip_march` the march.
!>
!> gamma, alpha, the range of m and the factors of S4 and S5 are tuned: round numbers near a broad
!> minimum of the errors against CONTACT on 161 Hertz cases and 40 S1002/UIC60 cases. Fitted to one
!> half of these, the method has on the other half the errors it has on the first (force vector on
!> the Hertz cases: 0.60 and 0.65 % of mu N, 0.62 and 0.61 with the halves exchanged). The 240
!> contacts of `reference/scenes`, of eight other kinds of gap, came later, and no constant was
!> fitted to them; the errors there stand in docs/validation.md.
module faststrip_tangential_faststrip
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_limits, only: nothing
    use faststrip_base_status, only: status_t, set_status, is_error, count_text, st_out_of_range
    use faststrip_base_material, only: material_t, check_material, combined_poisson_ratio
    use faststrip_base_creepage, only: creepage_t
    use faststrip_base_friction, only: friction_t, check_friction, falls, falls_when_hot
    use faststrip_base_friction_table, only: mu_at
    use faststrip_normal_strips, only: contact_strips_t, load_of, usual_strips
    use faststrip_normal_simple_patch_ellipse, only: patch_ellipse_t, patch_ellipse, patch_end, &
                                                     check_strips
    use faststrip_normal_sub_patches, only: has_neck, find_openness, next_level, level_weight, &
                                            next_sub_patch, all_parted, all_joined
    use faststrip_tangential_motion, only: check_motion
    use faststrip_tangential_force_correction, only: force_correction
    use faststrip_tangential_force_network, only: rolling_state_t
    use faststrip_tangential_patch_coupling, only: coupling_t, tractions_t, find_coupling, &
                                                   induced_motion, induced_moment, &
                                                   sum_tractions, approach, most_parts, &
                                                   coupling_passes
    use faststrip_tangential_patch_law, only: patch_law_t, find_law, add_law, mean_law, same_law, &
                                              lateral_stiffness
    use faststrip_tangential_patch_shape, only: patch_shape_t, patch_shape
    use faststrip_tangential_pressure_slip, only: slip_by_pressure
    use faststrip_tangential_strip_march, only: rolling_t, march_sums_t, march_strips, strip_mu, &
                                                most_hot_points
    use faststrip_tangential_strip_slip, only: patch_motion
    use faststrip_tangential_types, only: tangential_result_t, tangential_field_t, strip_forces_t, &
                                          empty_strip_forces, empty_field, match_power, &
                                          most_points, stick_share
    implicit none
    private

    public :: faststrip_tangential_solve, default_points, most_points

    !> Points along each strip by default: as many as strips.
    integer, parameter :: default_points = usual_strips

    ! Strips of a patch with a neck up to which nothing is allocated.
    ! Tuned [strips]. Origin: capacity: a quarter of the stack of a call.
    integer, parameter :: most_on_stack = 128

    !> How a patch rolls.
    type, extends(rolling_t) :: patch_rolling_t
        real(wp) :: mu_in_slip = 0.0_wp    ! mean coefficient where the patch slides (S12)
        real(wp) :: moment = 0.0_wp        ! what they give to the moment besides, N mm
        logical :: is_corrected = .true.   ! S10, S11?
    end type patch_rolling_t

contains

    !> Forces of any contact patches by marching in their strips; no allocation.
    !>
    !> The elements of `field` have the tractions of the march and, in proportion to their pressure,
    !> what S10 adds to the forces; their slip gives the friction power.
    !> The sums of `per_strip` add up to the result.
    pure subroutine faststrip_tangential_solve(strips, material, mu, creepage, points_per_strip, &
                                               result, status, field, per_strip, with_fit, &
                                               friction)
        type(contact_strips_t), intent(in) :: strips !! a normal solution
        type(material_t), intent(in) :: material     !! moduli in MPa
        real(wp), intent(in) :: mu                   !! coefficient of friction, >= 0
        type(creepage_t), intent(in) :: creepage     !! about the reference point, for all patches
        integer, intent(in) :: points_per_strip      !! 1 to `most_points`
        type(tangential_result_t), intent(out) :: result !! sums; zero when there is an error
        type(status_t), intent(out) :: status
            !! `st_bad_argument` (no strips, negative pressures or mu), `st_not_finite`,
            !! `st_bad_material`, `st_out_of_range` (creepages, mu, points),
            !! `st_workspace_too_small`
        type(tangential_field_t), intent(inout), optional :: field
            !! filled when present; needs capacity for n*points_per_strip elements
        type(strip_forces_t), intent(inout), optional :: per_strip
            !! filled when present; needs capacity for n strips
        logical, intent(in), optional :: with_fit !! corrected (S10)? default true
        type(friction_t), intent(in), optional :: friction
            !! how mu falls with slip and temperature (S12), and a table over y in place of mu,
            !! which is then its mean (S13); of its other parts only the factor of the initial
            !! slope, which the material has already, counts (S14)

        type(patch_rolling_t) :: rolling

        call check_motion(mu, creepage, status)
        if (is_error(status)) return
        if (present(friction)) call check_friction(friction, status)
        if (is_error(status)) return
        call check_material(material, status)
        if (is_error(status)) return
        call check_strips(strips, status)
        if (is_error(status)) return
        if (points_per_strip < 1 .or. points_per_strip > most_points) then
            call set_status(status, st_out_of_range, 'points per strip must be 1 to 1000, ' // &
                            'got ' // count_text(points_per_strip))
            return
        end if
        if (present(field)) then
            call empty_field(field, strips%n*points_per_strip, status)
            if (is_error(status)) return
        end if
        if (present(per_strip)) then
            call empty_strip_forces(per_strip, strips%n, status)
            if (is_error(status)) return
        end if

        rolling = patch_rolling_t(mu=mu, creepage=creepage, given=creepage, plane=creepage, &
                                  points=points_per_strip, mu_in_slip=mu, &
                                  pressure_slip=slip_by_pressure(material), &
                                  plane_counts=strips%is_curved .or. strips%has_places)
        if (present(with_fit)) rolling%is_corrected = with_fit
        if (present(friction)) then
            if (falls_when_hot(friction) .and. points_per_strip > most_hot_points) then
                call set_status(status, st_out_of_range, 'friction that falls with temperature ' &
                                // 'takes at most 128 points per strip, got ' // &
                                count_text(points_per_strip))
                return
            end if
            ! A softer surface is no softer under pressure.
            rolling%pressure_slip = rolling%pressure_slip*friction%slope_factor
            call roll(strips, material, rolling, friction, result, status, field, per_strip)
        else
            call roll(strips, material, rolling, friction_t(), result, status, field, per_strip)
        end if
    end subroutine faststrip_tangential_solve

    !> Roll all patches.
    pure subroutine roll(strips, material, rolling, friction, result, status, field, per_strip)
        type(contact_strips_t), intent(in) :: strips
        type(material_t), intent(in) :: material
        type(patch_rolling_t), intent(in) :: rolling
        type(friction_t), intent(in) :: friction
        type(tangential_result_t), intent(inout) :: result
        type(status_t), intent(inout) :: status
        type(tangential_field_t), intent(inout), optional :: field
        type(strip_forces_t), intent(inout), optional :: per_strip

        type(march_sums_t) :: sums
        type(coupling_t) :: coupling
        type(tractions_t) :: tractions(most_parts)
        integer :: pass

        coupling%n = 0
        if (rolling%is_corrected) then
            call find_coupling(strips, material, coupling)
            if (coupling%n > 1) then
                do pass = 1, coupling_passes
                    sums = march_sums_t()
                    call solve_patches(strips, material, rolling, friction, coupling, tractions, &
                                       sums, status)
                    if (is_error(status)) return
                end do
                sums = march_sums_t()
            end if
        end if
        call solve_patches(strips, material, rolling, friction, coupling, tractions, sums, &
                           status, field, per_strip)
        if (is_error(status)) return
        result = sums%result
        result%friction_power = max(result%friction_power, 0.0_wp)
        result%stick_fraction = stick_share(sums%stuck, sums%covered)
    end subroutine roll

    !> Add the forces of all patches that roll with the tractions of the others; what the tractions
    !> are then.
    pure subroutine solve_patches(strips, material, rolling, friction, coupling, tractions, sums, &
                                  status, field, per_strip)
        type(contact_strips_t), intent(in) :: strips
        type(material_t), intent(in) :: material
        type(patch_rolling_t), intent(in) :: rolling
        type(friction_t), intent(in) :: friction
        type(coupling_t), intent(in) :: coupling
        type(tractions_t), intent(inout) :: tractions(:) !! of its parts
        type(march_sums_t), intent(inout) :: sums
        type(status_t), intent(inout) :: status
        type(tangential_field_t), intent(inout), optional :: field
        type(strip_forces_t), intent(inout), optional :: per_strip

        type(tractions_t) :: found(most_parts)
        type(patch_rolling_t) :: induced
        type(march_sums_t) :: before
        type(patch_ellipse_t) :: ellipse
        type(patch_law_t) :: law
        real(wp) :: linear(3), tilt
        integer :: first, last, part, patch

        induced = rolling
        part = 0
        patch = 0
        last = 0
        do while (last < strips%n)
            first = last + 1
            last = patch_end(strips, first)
            induced%mu = patch_mu(strips, first, last, rolling, friction)
            induced%mu_in_slip = induced%mu
            if (rolling%plane_counts) then
                induced%given = patch_motion(strips, first, last, rolling%plane)
                induced%creepage = induced%given
            end if
            if (coupling%n > 1) then
                if (patch == 0) then
                    part = part + 1
                    patch = coupling%patches(part)
                end if
                call induced_motion(coupling, tractions, part, induced%given, &
                                    induced%creepage, tilt)
                patch = patch - 1
                ellipse = patch_ellipse(strips, first, last)
                call find_law(ellipse, material, induced%mu, induced%creepage, law, status, linear)
                if (is_error(status)) return
                induced%moment = 0.0_wp
                if (law%weight > 0.0_wp) &
                    induced%moment = induced_moment(tractions(part), tilt, &
                                                    lateral_stiffness(law, ellipse))
            end if
            before = sums
            if (falls(friction)) &
                induced%mu_in_slip = induced%mu*share_in_slip(strips, first, last, material, &
                                                              induced, friction)
            call solve_patch(strips, first, last, material, induced, friction, sums, status, &
                             field, per_strip)
            if (is_error(status)) return
            if (coupling%n > 1) call sum_tractions(sums%result%fx - before%result%fx, &
                                                   sums%result%fy - before%result%fy, &
                                                   induced%mu*ellipse%load, ellipse%a, linear, &
                                                   found(part))
        end do
        call approach(found(:coupling%n), tractions(:coupling%n))
    end subroutine solve_patches

    !> The static coefficient of a patch, the mean by load where it varies (S13).
    pure real(wp) function patch_mu(strips, first, last, rolling, friction) result(mu)
        type(contact_strips_t), intent(in) :: strips
        integer, intent(in) :: first, last
        type(patch_rolling_t), intent(in) :: rolling
        type(friction_t), intent(in) :: friction

        real(wp) :: load, part
        integer :: k

        mu = rolling%mu
        if (friction%table%n == 0) return
        load = 0.0_wp
        mu = 0.0_wp
        do k = first, last
            part = load_of(strips, k)
            load = load + part
            mu = mu + part*strip_mu(strips, k, rolling%mu, friction)
        end do
        if (load > 0.0_wp) mu = mu/load
    end function patch_mu

    !> What is left of the static coefficient where a patch slides, the mean by its bound; one where
    !> nothing slides.
    pure real(wp) function share_in_slip(strips, first, last, material, rolling, friction) &
        result(share)
        type(contact_strips_t), intent(in) :: strips
        integer, intent(in) :: first, last
        type(material_t), intent(in) :: material
        type(patch_rolling_t), intent(in) :: rolling
        type(friction_t), intent(in) :: friction

        type(march_sums_t) :: sums
        type(status_t) :: status

        call solve_patch(strips, first, last, material, rolling, friction, sums, status)
        share = 1.0_wp
        if (sums%slid_static > 0.0_wp) share = sums%slid/sums%slid_static
    end function share_in_slip

    !> Add the forces of strips `first` to `last`, one patch.
    pure subroutine solve_patch(strips, first, last, material, rolling, friction, sums, status, &
                                field, per_strip)
        type(contact_strips_t), intent(in) :: strips
        integer, intent(in) :: first, last
        type(material_t), intent(in) :: material
        type(patch_rolling_t), intent(in) :: rolling
        type(friction_t), intent(in) :: friction
        type(march_sums_t), intent(inout) :: sums
        type(status_t), intent(inout) :: status
        type(tangential_field_t), intent(inout), optional :: field
        type(strip_forces_t), intent(inout), optional :: per_strip

        type(patch_ellipse_t) :: ellipse
        type(patch_law_t) :: law
        type(march_sums_t) :: before
        real(wp) :: power, linear(3), missing(4)
        integer :: first_element

        before = sums
        missing = [0.0_wp, 0.0_wp, rolling%moment, 0.0_wp]
        first_element = 1
        if (present(field)) first_element = field%n + 1
        if (has_neck(strips%half_length(first:last))) then
            call march_sub_patches(strips, first, last, material, rolling, friction, sums, &
                                   missing, status, field, per_strip)
        else
            ellipse = patch_ellipse(strips, first, last)
            call find_law(ellipse, material, rolling%mu_in_slip, rolling%creepage, law, status, &
                          linear)
            call march_strips(law, strips, first, last, rolling%rolling_t, friction, sums, field, &
                              per_strip)
            if (rolling%is_corrected .and. law%weight > 0.0_wp) &
                call add_missing(patch_shape(strips, first, last, ellipse), ellipse, law, linear, &
                                 material, rolling, 1.0_wp, missing)
        end if
        if (is_error(status)) return
        if (rolling%is_corrected) call correct(strips, first, last, rolling, friction, before, &
                                                missing, first_element, sums, field, per_strip)
        power = work(before, sums, rolling%given)
        sums%result%friction_power = sums%result%friction_power + power
        power = max(power, 0.0_wp)
        if (present(field)) call match_power(power, first_element, field)
        if (present(per_strip)) then
            associate (share => per_strip%friction_power(first:last))
                if (sum(share) > 0.0_wp) share = share*(power/sum(share))
            end associate
        end if
    end subroutine solve_patch

    !> What the creepages, and the slip that pressures cause, feed into the forces that were
    !> added, N. Of a patch that others carry along it may be negative: they feed it.
    pure real(wp) function work(before, after, creepage)
        type(march_sums_t), intent(in) :: before, after
        type(creepage_t), intent(in) :: creepage

        associate (old => before%result, new => after%result)
            work = -((new%fx - old%fx)*creepage%cksi + (new%fy - old%fy)*creepage%ceta &
                     + (new%mz - old%mz)*creepage%cphi) - (after%pressed - before%pressed)
        end associate
    end function work

    !> Add what the march misses of a patch or a part of it (S10), with a weight.
    pure subroutine add_missing(shape, ellipse, law, linear, material, rolling, weight, missing)
        type(patch_shape_t), intent(in) :: shape
        type(patch_ellipse_t), intent(in) :: ellipse
        type(patch_law_t), intent(in) :: law
        real(wp), intent(in) :: linear(3) !! linear forces over mu N
        type(material_t), intent(in) :: material
        type(patch_rolling_t), intent(in) :: rolling
        real(wp), intent(in) :: weight
        real(wp), intent(inout) :: missing(4) !! N, N, N mm about the reference point, mm^2 of stick

        real(wp) :: part(4)

        associate (c => rolling%creepage)
            part = weight*force_correction(rolling_state_t( &
                linear, [c%cksi - ellipse%y*c%cphi, c%ceta, c%cphi], ellipse%a, ellipse%b, &
                combined_poisson_ratio(material), law%sliding, rolling%points), shape)
        end associate
        part(:3) = rolling%mu_in_slip*ellipse%load*part(:3)
        missing = missing + [part(1), part(2), &
                             part(3)*sqrt(ellipse%a*ellipse%b) - ellipse%y*part(1), &
                             pi*ellipse%a*ellipse%b*part(4)]
    end subroutine add_missing

    !> Add what is missing to the forces of a patch, of which no more than mu N is left and which
    !> feed no power in, and to its stick, which is no less than nothing and no more than all (S10);
    !> to the forces of its strips and elements in proportion to their loads.
    pure subroutine correct(strips, first, last, rolling, friction, before, missing, &
                            first_element, sums, field, per_strip)
        type(contact_strips_t), intent(in) :: strips
        integer, intent(in) :: first, last
        type(patch_rolling_t), intent(in) :: rolling
        type(friction_t), intent(in) :: friction
        type(march_sums_t), intent(in) :: before !! the sums without the patch
        real(wp), intent(in) :: missing(4)       !! N, N, N mm, mm^2
        integer, intent(in) :: first_element     !! of the patch
        type(march_sums_t), intent(inout) :: sums
        type(tangential_field_t), intent(inout), optional :: field
        type(strip_forces_t), intent(inout), optional :: per_strip

        real(wp) :: force(2), change(2), load, bound, limit, x, y, moment, taken(3)
        integer :: k

        load = 0.0_wp
        x = 0.0_wp
        y = 0.0_wp
        do k = first, last
            load = load + load_of(strips, k)
            y = y + load_of(strips, k)*0.5_wp*(strips%y_left(k) + strips%y_right(k))
            if (strips%has_places) x = x + load_of(strips, k)*strips%x0(k)
        end do
        bound = rolling%mu_in_slip*load
        if (bound <= nothing) return
        limit = bound
        associate (result => sums%result)
            force = [result%fx - before%result%fx, result%fy - before%result%fy]
            ! What sticks may carry more than friction has fallen to.
            if (falls(friction)) limit = max(bound, norm2(force))
            change = force + missing(:2)
            if (norm2(change) > limit) change = change*(limit/norm2(change))
            ! At the mean of the strips' places.
            x = x/load
            y = y/load
            associate (c => rolling%creepage)
                moment = result%mz - before%result%mz + missing(3) - x*force(2) + y*change(1)
                taken = fed_in([c%cksi - y*c%cphi, c%ceta], c%cphi, sums%pressed &
                               - before%pressed + x*force(2)*c%cphi, change, moment)
            end associate
            change = change - taken(:2) - force
            result%fx = result%fx + change(1)
            result%fy = result%fy + change(2)
            result%mz = result%mz + missing(3) - taken(3) + x*change(2) + y*taken(1)
            sums%pressed = sums%pressed - x*change(2)*rolling%plane%cphi
        end associate
        sums%stuck = min(max(sums%stuck + missing(4), before%stuck), &
                         before%stuck + sums%covered - before%covered)
        if (present(field)) call correct_field(change, first_element, rolling%mu, friction, field)
        if (.not. present(per_strip)) return
        do k = first, last
            associate (share => load_of(strips, k)*rolling%mu_in_slip/bound &
                                *strip_mu(strips, k, rolling%mu, friction)/rolling%mu)
                per_strip%fx(k) = per_strip%fx(k) + change(1)*share
                per_strip%fy(k) = per_strip%fy(k) + change(2)*share
            end associate
        end do
    end subroutine correct

    !> A contact takes power out. What is too much of a force, along the creepage, and of a moment
    !> that feed more in than is taken out; N, N, N mm. What slip by pressures feeds in may stay.
    pure function fed_in(creepage, spin, pressed, force, moment) result(taken)
        real(wp), intent(in) :: creepage(2) !! that the middle of the patch sees
        real(wp), intent(in) :: spin        !! rad/mm
        real(wp), intent(in) :: pressed     !! what slip besides them feeds in, N
        real(wp), intent(in) :: force(2)    !! N
        real(wp), intent(in) :: moment      !! about the middle, N mm
        real(wp) :: taken(3)

        real(wp) :: fed(2), too_much, size

        taken = 0.0_wp
        fed = [dot_product(force, creepage), moment*spin]
        too_much = sum(fed) + min(pressed, 0.0_wp)
        if (too_much <= 0.0_wp) return
        fed = max(fed, 0.0_wp)
        fed = fed*(too_much/sum(fed))
        size = norm2(creepage)
        if (fed(1) > 0.0_wp) taken(:2) = fed(1)/size*(creepage/size)
        if (fed(2) > 0.0_wp) taken(3) = fed(2)/spin
    end function fed_in

    !> Add forces to the elements of a patch in proportion to their loads and friction; where they
    !> slide, the slip turns with the traction.
    pure subroutine correct_field(change, first, mu, friction, field)
        real(wp), intent(in) :: change(2)                !! N
        integer, intent(in) :: first                     !! first element of the patch
        real(wp), intent(in) :: mu                       !! the patch's, > 0
        type(friction_t), intent(in) :: friction         !! its table
        type(tangential_field_t), intent(inout) :: field !! with the patch's elements last

        real(wp) :: per_bound(2), slip, bound
        integer :: i

        bound = 0.0_wp
        do i = first, field%n
            bound = bound + bound_of(i)*field%area(i)
        end do
        per_bound = change/bound
        do i = first, field%n
            slip = hypot(field%sx(i), field%sy(i))
            field%px(i) = field%px(i) + per_bound(1)*bound_of(i)
            field%py(i) = field%py(i) + per_bound(2)*bound_of(i)
            if (slip <= 0.0_wp) cycle
            slip = slip/max(hypot(field%px(i), field%py(i)), tiny(slip))
            field%sx(i) = -slip*field%px(i)
            field%sy(i) = -slip*field%py(i)
        end do

    contains

        !> The pressure, times what mu is there over the patch's.
        pure real(wp) function bound_of(i)
            integer, intent(in) :: i

            bound_of = field%pn(i)
            if (friction%table%n > 0) bound_of = &
                field%pn(i)*(mu_at(friction%table, mu, field%y(i))/mu)
        end function bound_of
    end subroutine correct_field

    !> March the strips of a patch with a neck; of more strips than the stack has room for, what is
    !> known of each is allocated.
    pure subroutine march_sub_patches(strips, first, last, material, rolling, friction, sums, &
                                      missing, status, field, per_strip)
        type(contact_strips_t), intent(in) :: strips
        integer, intent(in) :: first, last
        type(material_t), intent(in) :: material
        type(patch_rolling_t), intent(in) :: rolling
        type(friction_t), intent(in) :: friction
        type(march_sums_t), intent(inout) :: sums
        real(wp), intent(inout) :: missing(4) !! gets what the march misses; N, N, N mm, mm^2
        type(status_t), intent(inout) :: status
        type(tangential_field_t), intent(inout), optional :: field
        type(strip_forces_t), intent(inout), optional :: per_strip

        real(wp), dimension(most_on_stack) :: openness, share
        type(patch_law_t) :: mean(most_on_stack)

        if (last - first < most_on_stack) then
            call find_mean_laws(strips, first, last, material, rolling, missing, &
                                openness, share, mean, status)
            if (is_error(status)) return
            call march_by_means(strips, first, last, rolling%rolling_t, friction, mean, sums, &
                                field, per_strip)
        else
            call march_many(strips, first, last, material, rolling, friction, sums, missing, &
                            status, field, per_strip)
        end if
    end subroutine march_sub_patches

    !> The same of so many strips.
    pure subroutine march_many(strips, first, last, material, rolling, friction, sums, &
                               missing, status, field, per_strip)
        type(contact_strips_t), intent(in) :: strips
        integer, intent(in) :: first, last
        type(material_t), intent(in) :: material
        type(patch_rolling_t), intent(in) :: rolling
        type(friction_t), intent(in) :: friction
        type(march_sums_t), intent(inout) :: sums
        real(wp), intent(inout) :: missing(4)
        type(status_t), intent(inout) :: status
        type(tangential_field_t), intent(inout), optional :: field
        type(strip_forces_t), intent(inout), optional :: per_strip

        real(wp), dimension(first:last) :: openness, share
        type(patch_law_t) :: mean(first:last)

        call find_mean_laws(strips, first, last, material, rolling, missing, &
                            openness, share, mean, status)
        if (is_error(status)) return
        call march_by_means(strips, first, last, rolling%rolling_t, friction, mean, sums, field, &
                            per_strip)
    end subroutine march_many

    !> Of each strip of a patch with a neck the mean of the laws of its sub-patches.
    pure subroutine find_mean_laws(strips, first, last, material, rolling, missing, &
                                   openness, share, mean, status)
        type(contact_strips_t), intent(in) :: strips
        integer, intent(in) :: first, last
        type(material_t), intent(in) :: material
        type(patch_rolling_t), intent(in) :: rolling
        real(wp), intent(inout) :: missing(4) !! gets what the march misses; N, N, N mm, mm^2
        real(wp), dimension(first:last), intent(out) :: openness, share !! work
        type(patch_law_t), intent(inout) :: mean(first:last)            !! empty before
        type(status_t), intent(inout) :: status

        type(patch_ellipse_t) :: ellipse
        type(patch_law_t) :: law
        real(wp) :: level, weight, linear(3)
        integer :: begin, i, from, to

        call find_openness(strips%half_length(first:last), openness)
        level = all_parted
        do while (level < all_joined)
            begin = first
            do while (begin <= last)
                call next_sub_patch(strips, first, openness, level, begin, from, to, share)
                ! A sub-patch stays the same until one of its strips or of those next to it is a
                ! neck.
                associate (around => openness(max(first, from - 1):min(last, to + 1)))
                    if (level > all_parted .and. .not. any(around == level)) cycle
                    weight = level_weight(level, next_level(around, level))
                end associate
                ellipse = patch_ellipse(strips, from, to, share(from:to))
                call find_law(ellipse, material, rolling%mu_in_slip, rolling%creepage, law, &
                              status, linear)
                if (is_error(status)) return
                if (rolling%is_corrected .and. law%weight > 0.0_wp) &
                    call add_missing(patch_shape(strips, from, to, ellipse, share(from:to)), &
                                     ellipse, law, linear, material, rolling, weight, missing)
                do i = from, to
                    call add_law(weight*share(i)*law%weight, law, mean(i))
                end do
            end do
            level = next_level(openness, level)
        end do
    end subroutine find_mean_laws

    !> March the strips of a patch with a neck, each by its law.
    pure subroutine march_by_means(strips, first, last, rolling, friction, mean, sums, field, &
                                   per_strip)
        type(contact_strips_t), intent(in) :: strips
        integer, intent(in) :: first, last
        type(rolling_t), intent(in) :: rolling
        type(friction_t), intent(in) :: friction
        type(patch_law_t), intent(in) :: mean(first:last)
        type(march_sums_t), intent(inout) :: sums
        type(tangential_field_t), intent(inout), optional :: field
        type(strip_forces_t), intent(inout), optional :: per_strip

        integer :: begin, i

        begin = first
        do i = first + 1, last + 1
            if (i <= last) then
                if (same_law(mean(i), mean(begin))) cycle
            end if
            call march_strips(mean_law(mean(begin)), strips, begin, i - 1, rolling, friction, &
                              sums, field, per_strip)
            begin = i
        end do
    end subroutine march_by_means
end module faststrip_tangential_faststrip
