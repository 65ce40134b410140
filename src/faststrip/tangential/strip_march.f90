!> The march in the strips of a patch, from the leading edge to the trailing one: several strips
!> side by side, as lanes of the processor's vectors. The steps S2, S4, S6 to S9 and S12 to S15 are
!> those of `faststrip_tangential_faststrip`.
module faststrip_tangential_strip_march
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_limits, only: nothing
    use faststrip_base_creepage, only: creepage_t
    use faststrip_base_friction, only: friction_t, falls, falls_when_hot, falling_share, hot_share
    use faststrip_base_friction_table, only: mean_mu_between
    use faststrip_normal_strips, only: contact_strips_t, strip_load, usual_strips
    use faststrip_tangential_heat_sources, only: rise_by_steps, own_weight
    use faststrip_tangential_patch_law, only: patch_law_t
    use faststrip_tangential_pressure_slip, only: find_pressure_slip, node_weights, bed_factor, &
                                                  n_nodes
    use faststrip_tangential_saturation, only: saturate
    use faststrip_tangential_strip_slip, only: strip_slip, rest_of_slip
    use faststrip_tangential_types, only: tangential_result_t, tangential_field_t, strip_forces_t, &
                                          put_element, most_points, state_adhesion, state_slip
    implicit none
    private

    public :: rolling_t, march_sums_t, march_strips, strip_mu, most_hot_points

    ! Tuned [1]. Origin: errors against CONTACT, see `faststrip_tangential_faststrip`.
    real(wp), parameter :: slip_onset = 2.0_wp      ! S4

    !> What all strips of a contact share.
    type :: rolling_t
        real(wp) :: mu = 0.0_wp      !! coefficient of friction, static; a mean, if it varies
        type(creepage_t) :: creepage !! about the reference point
        type(creepage_t) :: given    !! the same without what other patches do
        type(creepage_t) :: plane    !! of all of a contact whose strips have their own (S15)
        integer :: points = 0        !! along each strip, at most `most_points`
        real(wp) :: pressure_slip = 0.0_wp !! by unit pressure, of dissimilar materials, 1/MPa
        logical :: plane_counts = .false.  !! have strips their own slip (S15)?
    end type rolling_t

    !> Sums over the strips that were marched.
    type :: march_sums_t
        type(tangential_result_t) :: result !! forces, N, and their friction power
        real(wp) :: stuck = 0.0_wp   !! area that sticks, mm^2
        real(wp) :: covered = 0.0_wp !! area, mm^2
        real(wp) :: pressed = 0.0_wp !! tractions times the slip that pressures cause, N
        real(wp) :: slid = 0.0_wp    !! bound where it slides, N; zero unless friction falls
        real(wp) :: slid_static = 0.0_wp !! the same without the fall, N
    end type march_sums_t

    ! What the number of strips marched side by side is rounded up to.
    ! Tuned [strips]. Origin: chosen for the time: the width of vector units.
    integer, parameter :: lane_step = 2
    ! Strips marched side by side: a patch of the usual ones at once.
    integer, parameter :: most_lanes = usual_strips + modulo(-usual_strips, lane_step)

    !> Points along a strip where friction falls with temperature: the heat of the steps stands on
    !> the stack, of one strip at a time.
    !> Tuned [points]. Origin: capacity.
    integer, parameter :: most_hot_points = 128

    ! Strips of dissimilar materials marched side by side: what pressures do to them stands on the
    ! stack.
    ! Tuned [strips]. Origin: capacity: a hundredth of the stack of a call.
    integer, parameter :: pressed_lanes = 2*lane_step

    ! Added to what is divided by where it may be nothing; changes no digit.
    real(wp), parameter :: least = tiny(1.0_wp)

    !> The traction bound along a strip (S2).
    type :: bound_t
        integer :: n = 0               !! elements of a strip
        real(wp) :: alpha = 0.0_wp     !! of the law
        real(wp) :: factor = 1.0_wp    !! that makes its sum pi/4 n
        real(wp) :: thickness(most_points/2 + 1) !! (1 - t^2)^m at the first half of the elements
    end type bound_t

    !> Strips side by side.
    type :: block_t
        integer :: n = 0                  !! strips
        integer :: lanes = 0              !! the same, with idle lanes
        integer :: strip(most_lanes) = 0  !! their numbers
        real(wp), dimension(most_lanes) :: y, half_length !! mm
        real(wp), dimension(most_lanes) :: cell           !! area of an element, mm^2
        real(wp), dimension(most_lanes) :: peak_bound, inverse_peak_bound !! mu p0, MPa
        real(wp), dimension(most_lanes) :: slope_x, slope_y0, slope_y1 !! of adhesion, MPa/mm
        real(wp), dimension(most_lanes) :: rigid_x, rigid_y !! rigid slip, without spin across
        real(wp), dimension(most_lanes) :: spin           !! rad/mm
        real(wp), dimension(most_lanes) :: k1, k2         !! flexibilities in slip, mm/MPa
        real(wp), dimension(most_lanes) :: onset          !! scale of 1/lambda, MPa
        real(wp), dimension(most_lanes) :: px, py         !! of the last element, MPa
        real(wp), dimension(most_lanes) :: f, step         !! lambda times step, mm/MPa; step, mm
        real(wp), dimension(most_lanes) :: excess         !! |p|^2 over the squared bound, MPa^2
        real(wp), dimension(most_lanes) :: extra_y        !! what adhesion has beyond rigid slip
        real(wp), dimension(most_lanes) :: pressed        !! tractions times slip by pressures
        real(wp), dimension(most_lanes) :: sum_x, sum_y, arm_x, sticking !! over the elements
    end type block_t

    !> What pressures of dissimilar materials add in strips side by side (S14).
    type :: pressed_t
        real(wp), dimension(n_nodes, pressed_lanes) :: node_x, node_y !! slip at the nodes
        real(wp), dimension(pressed_lanes) :: own            !! slip by p0
        real(wp), dimension(pressed_lanes) :: slip_x, slip_y !! at the element
        real(wp), dimension(pressed_lanes) :: slope_x, slope_y, rigid_x, rigid_y !! without them
        real(wp), dimension(pressed_lanes) :: bed_x, bed_y   !! slopes of adhesion by slip, MPa/mm
    end type pressed_t

    !> What falls in strips side by side.
    type :: fall_t
        real(wp), dimension(most_lanes) :: static_bound   !! mu p0, MPa
        real(wp), dimension(most_lanes) :: left           !! of the static coefficient
        real(wp), dimension(most_lanes) :: bound          !! over mu p0, sum over the elements
        real(wp) :: heat(most_hot_points) !! of the steps of its strip, if there is one, N/mm^2
    end type fall_t

contains

    !> March strips under one law and add their forces.
    pure subroutine march_strips(law, strips, first, last, rolling, friction, sums, field, &
                                 per_strip)
        type(patch_law_t), intent(in) :: law         !! of the patch
        type(contact_strips_t), intent(in) :: strips !! a normal solution
        integer, intent(in) :: first, last           !! of its strips
        type(rolling_t), intent(in) :: rolling       !! what all strips share
        type(friction_t), intent(in) :: friction
            !! how it falls with slip and temperature; its table over y
        type(march_sums_t), intent(inout) :: sums    !! are added to
        type(tangential_field_t), intent(inout), optional :: field !! gets the elements
        type(strip_forces_t), intent(inout), optional :: per_strip !! gets the strips' sums

        type(block_t) :: block
        type(pressed_t) :: pressed
        type(bound_t) :: bound
        real(wp) :: t, off_centre, all
        integer :: i, points, lanes

        if (law%weight <= 0.0_wp) return
        points = rolling%points
        bound%n = points
        bound%alpha = law%alpha
        ! A vector of powers has other digits than each of them.
        !GCC$ NOVECTOR
        do i = 1, (points + 1)/2
            t = real(points - 2*i + 1, wp)/points
            bound%thickness(i) = (1.0_wp - t*t)**law%exponent
        end do
        all = 0.0_wp
        do i = 1, points
            all = all + bound_at(bound, i, real(points - 2*i + 1, wp)/points)
        end do
        bound%factor = 0.25_wp*pi*points/all
        off_centre = 0.0_wp
        do i = 1, points/2
            t = real(points - 2*i + 1, wp)/points
            off_centre = off_centre + t*(bound_at(bound, i, t) &
                                         - bound_at(bound, points + 1 - i, -t))
        end do
        off_centre = off_centre/(0.25_wp*pi*points)
        lanes = most_lanes
        if (is_pressed(rolling)) lanes = pressed_lanes
        if (falls_when_hot(friction)) lanes = 1
        do i = first, last, lanes
            call fill_block(law, strips, i, min(i + lanes - 1, last), rolling, friction, block)
            if (is_pressed(rolling)) call find_pressed(law, strips, rolling, block, pressed)
            if (falls(friction)) then
                call march_falling(block, bound, strips, rolling, friction, pressed, sums, field)
            else
                call march(block, bound, strips, rolling, pressed, field)
            end if
            call add_block(law, strips, block, off_centre, rolling, sums, per_strip)
        end do
    end subroutine march_strips

    !> The bound at the middle of an element, over mu p0.
    pure real(wp) function bound_at(bound, i, t)
        type(bound_t), intent(in) :: bound
        integer, intent(in) :: i  ! from the leading edge on
        real(wp), intent(in) :: t ! its place over half-length

        bound_at = bound%thickness(min(i, bound%n + 1 - i))*(1.0_wp - bound%alpha*t)*bound%factor
    end function bound_at

    !> March all strips of a block side by side, and note the elements if they are wanted.
    pure subroutine march(block, bound, strips, rolling, pressed, field)
        type(block_t), intent(inout) :: block
        type(bound_t), intent(in) :: bound
        type(contact_strips_t), intent(in) :: strips
        type(rolling_t), intent(in) :: rolling
        type(pressed_t), intent(inout) :: pressed
        type(tangential_field_t), intent(inout), optional :: field

        real(wp), dimension(most_lanes) :: ahead_x, ahead_y
        real(wp) :: t, step
        integer :: i, n

        n = bound%n
        do i = 1, n
            t = real(n - 2*i + 1, wp)/n
            ! Half a step from the edge to the middle of the first element.
            step = merge(1.0_wp, 2.0_wp, i == 1)/n
            if (present(field)) then
                ahead_x = block%px
                ahead_y = block%py
            end if
            if (is_pressed(rolling)) call press(block, t + 0.5_wp*step, pressed)
            call advance(block, t, step, bound_at(bound, i, t))
            if (is_pressed(rolling)) call note_pressed(block, pressed)
            if (present(field)) call note_elements(block, strips, ahead_x, ahead_y, i, n, field)
        end do
        if (present(field)) field%n = field%n + n*block%n
    end subroutine march

    !> March as `march` does, with a bound that falls with slip (S12); afterwards the bound of the
    !> block is the mean of what it was.
    pure subroutine march_falling(block, bound, strips, rolling, friction, pressed, sums, field)
        type(block_t), intent(inout) :: block
        type(bound_t), intent(in) :: bound
        type(contact_strips_t), intent(in) :: strips
        type(rolling_t), intent(in) :: rolling
        type(friction_t), intent(in) :: friction
        type(pressed_t), intent(inout) :: pressed
        type(march_sums_t), intent(inout) :: sums
        type(tangential_field_t), intent(inout), optional :: field

        type(fall_t) :: fall
        real(wp), dimension(most_lanes) :: ahead_x, ahead_y
        real(wp) :: t, step, all
        integer :: i, k, n

        n = bound%n
        all = 0.0_wp
        do k = 1, block%lanes
            fall%static_bound(k) = block%peak_bound(k)
            fall%left(k) = 1.0_wp
            fall%bound(k) = 0.0_wp
        end do
        do i = 1, n
            t = real(n - 2*i + 1, wp)/n
            step = merge(1.0_wp, 2.0_wp, i == 1)/n
            ahead_x = block%px
            ahead_y = block%py
            if (is_pressed(rolling)) call press(block, t + 0.5_wp*step, pressed)
            call advance(block, t, step, bound_at(bound, i, t))
            all = all + bound_at(bound, i, t)
            call follow_slip(block, rolling, friction, i, bound_at(bound, i, t), ahead_x, &
                             ahead_y, fall, sums)
            if (is_pressed(rolling)) call note_pressed(block, pressed)
            if (present(field)) call note_elements(block, strips, ahead_x, ahead_y, i, n, field)
        end do
        if (present(field)) field%n = field%n + n*block%n
        do k = 1, block%lanes
            block%peak_bound(k) = fall%static_bound(k)*fall%bound(k)/all
        end do
    end subroutine march_falling

    !> Let the bound of an element fall to that of its slip and temperature, and what lies on it
    !> with it (S12).
    pure subroutine follow_slip(block, rolling, friction, i, bound, ahead_x, ahead_y, fall, sums)
        type(block_t), intent(inout) :: block
        type(rolling_t), intent(in) :: rolling
        type(friction_t), intent(in) :: friction
        integer, intent(in) :: i      !! element
        real(wp), intent(in) :: bound !! over mu p0
        real(wp), intent(in) :: ahead_x(:), ahead_y(:) !! traction of the element ahead, MPa
        type(fall_t), intent(inout) :: fall
        type(march_sums_t), intent(inout) :: sums

        real(wp) :: slip, share, part, static, t
        logical :: is_hot
        integer :: k

        t = real(rolling%points - 2*i + 1, wp)/rolling%points
        is_hot = falls_when_hot(friction)
        do k = 1, block%lanes
            if (is_hot) fall%heat(i) = 0.0_wp
            if (block%excess(k) > 0.0_wp) then
                slip = block%f(k)*hypot(block%px(k), block%py(k))/block%step(k)
                share = falling_share(friction, slip)
                if (is_hot) share = share*hot_share_of(friction, fall%heat(:i - 1), &
                    2.0_wp*block%half_length(k)/rolling%points, &
                    share/fall%left(k)*heat_of(block, k, ahead_x(k), ahead_y(k)))
                part = share/fall%left(k)
                fall%left(k) = part*fall%left(k)
                block%peak_bound(k) = fall%left(k)*fall%static_bound(k)
                block%inverse_peak_bound(k) = 1.0_wp/block%peak_bound(k)
                block%sum_x(k) = block%sum_x(k) - (1.0_wp - part)*block%px(k)
                block%sum_y(k) = block%sum_y(k) - (1.0_wp - part)*block%py(k)
                block%arm_x(k) = block%arm_x(k) - (1.0_wp - part)*block%half_length(k)*t &
                                                  *block%py(k)
                block%px(k) = part*block%px(k)
                block%py(k) = part*block%py(k)
                block%f(k) = block%f(k)/part
                if (is_hot) fall%heat(i) = heat_of(block, k, ahead_x(k), ahead_y(k))
                if (k <= block%n) then
                    static = block%cell(k)*fall%static_bound(k)*bound
                    sums%slid = sums%slid + fall%left(k)*static
                    sums%slid_static = sums%slid_static + static
                end if
            end if
            fall%bound(k) = fall%bound(k) + fall%left(k)*bound
        end do
    end subroutine follow_slip

    !> The share of the coefficient that is left of an element by its temperature.
    pure real(wp) function hot_share_of(friction, ahead, length, heat) result(share)
        type(friction_t), intent(in) :: friction
        real(wp), intent(in) :: ahead(:) ! heat of the steps before, N/mm^2
        real(wp), intent(in) :: length   ! of an element, mm
        real(wp), intent(in) :: heat     ! of this one, if it were cold

        real(wp) :: gain

        gain = friction%heat%gain*sqrt(length)
        share = hot_share(friction, friction%heat%shared + gain*rise_by_steps(ahead), &
                          gain*own_weight(size(ahead) + 1)*heat)
    end function hot_share_of

    !> Heat of the step to an element that slides, over its area, as `note_elements` has it, N/mm^2.
    pure real(wp) function heat_of(block, k, ahead_x, ahead_y) result(heat)
        type(block_t), intent(in) :: block
        integer, intent(in) :: k                 ! lane
        real(wp), intent(in) :: ahead_x, ahead_y ! traction of the element ahead, MPa

        heat = 0.5_wp*block%f(k)*(block%px(k)*(block%px(k) + ahead_x) &
                                  + block%py(k)*(block%py(k) + ahead_y))
        heat = max(heat, 0.0_wp)/block%step(k)
    end function heat_of

    !> Put element `i` of every strip of a block into the field.
    !>
    !> The slip of the implicit step is that of the step from the element ahead, where the traction
    !> is the mean of both; what goes into the field at the element itself gives the same heat
    !> (S8). The last element has also the half step to the trailing edge, on which the
    !> traction falls to nothing.
    pure subroutine note_elements(block, strips, ahead_x, ahead_y, i, n, field)
        type(block_t), intent(in) :: block
        type(contact_strips_t), intent(in) :: strips
        real(wp), intent(in) :: ahead_x(:), ahead_y(:) !! traction of the element ahead, MPa
        integer, intent(in) :: i, n                    !! element, elements of a strip
        type(tangential_field_t), intent(inout) :: field

        real(wp) :: t, x, place, length, heat, lambda
        integer :: k, state

        t = real(n - 2*i + 1, wp)/n
        place = 0.0_wp
        do k = 1, block%n
            if (strips%has_places) place = strips%x0(block%strip(k))
            associate (px => block%px(k), py => block%py(k))
                x = block%half_length(k)*t
                length = 2.0_wp*block%half_length(k)/n
                state = state_adhesion
                lambda = 0.0_wp
                if (block%excess(k) > 0.0_wp) then
                    state = state_slip
                    heat = 0.5_wp*block%f(k)*(px*(px + ahead_x(k)) + py*(py + ahead_y(k)))
                    if (i == n) heat = heat + 0.5_wp*(block%k1(k)*px**2 + block%k2(k)*py**2) &
                                       - 0.25_wp*length*(block%rigid_x(k)*px &
                                                         + (block%rigid_y(k) + x*block%spin(k))*py)
                    lambda = max(heat, 0.0_wp)/(length*(px*px + py*py))
                end if
                call put_element(field, field%n + (k - 1)*n + i, x + place, block%y(k), &
                                 [length, block%cell(k)], &
                                 strips%p0(block%strip(k))*sqrt(1.0_wp - t*t), px, py, &
                                 -lambda*px, -lambda*py, state)
            end associate
        end do
    end subroutine note_elements

    !> Add the sums of a block.
    pure subroutine add_block(law, strips, block, off_centre, rolling, sums, per_strip)
        type(patch_law_t), intent(in) :: law
        type(contact_strips_t), intent(in) :: strips
        type(block_t), intent(in) :: block
        real(wp), intent(in) :: off_centre !! centre of the bound over half-length
        type(rolling_t), intent(in) :: rolling
        type(march_sums_t), intent(inout) :: sums
        type(strip_forces_t), intent(inout), optional :: per_strip

        type(tangential_result_t) :: full
        type(creepage_t) :: creepage, own
        real(wp) :: used, area, fx, fy, mz, place
        integer :: k

        creepage = rolling%creepage
        place = 0.0_wp
        associate (result => sums%result, points => rolling%points)
            do k = 1, block%n
                if (rolling%plane_counts) then
                    if (strips%has_places) place = strips%x0(block%strip(k))
                    own = rest_of_slip(strip_slip(strips, block%strip(k), rolling%plane), &
                                       block%y(k), rolling%plane, rolling%given)
                    creepage = creepage_t( &
                        rolling%creepage%cksi + own%cksi + block%y(k)*own%cphi, &
                        rolling%creepage%ceta + own%ceta, rolling%creepage%cphi + own%cphi)
                end if
                used = min(sqrt(block%sum_x(k)**2 + block%sum_y(k)**2) &
                           /(0.25_wp*pi*points*block%peak_bound(k)), 1.0_wp)
                fx = block%cell(k)*block%sum_x(k)
                fy = block%cell(k)*block%sum_y(k)
                mz = block%cell(k)*((1.0_wp + law%stretch_x*(1.0_wp - used))*block%arm_x(k) &
                     - used**4*off_centre*block%half_length(k)*block%sum_y(k)) &
                     - (block%y(k) + law%stretch_y*(1.0_wp - used)*(block%y(k) - law%y))*fx
                if (law%sliding > 0.0_wp .and. .not. is_pressed(rolling)) then
                    call saturate(0.25_wp*pi*points*block%cell(k)*block%peak_bound(k), &
                                     block%half_length(k), block%y(k), creepage, full%fx, &
                                     full%fy, full%mz)
                    fx = fx + law%sliding*(full%fx - fx)
                    fy = fy + law%sliding*(full%fy - fy)
                    mz = mz + law%sliding*(full%mz - mz)
                end if
                result%fx = result%fx + fx
                result%fy = result%fy + fy
                result%mz = result%mz + mz + place*fy
                area = points*block%cell(k)
                sums%covered = sums%covered + area
                sums%pressed = sums%pressed + block%cell(k)*block%pressed(k)
                if (rolling%plane_counts) sums%pressed = sums%pressed &
                    + fx*(own%cksi + block%y(k)*own%cphi) &
                    + fy*(own%ceta - place*rolling%plane%cphi) + mz*own%cphi
                sums%stuck = sums%stuck + area*(block%sticking(k)/points)**2
                if (.not. present(per_strip)) cycle
                associate (i => block%strip(k))
                    per_strip%fx(i) = fx
                    per_strip%fy(i) = fy
                    per_strip%friction_power(i) = max(-(fx*creepage%cksi + fy*creepage%ceta &
                                                        + mz*creepage%cphi) &
                                                      - block%cell(k)*block%pressed(k), 0.0_wp)
                end associate
            end do
        end associate
    end subroutine add_block

    !> The static coefficient of a strip.
    pure real(wp) function strip_mu(strips, k, mu, friction)
        type(contact_strips_t), intent(in) :: strips !! a normal solution
        integer, intent(in) :: k                     !! of its strips
        real(wp), intent(in) :: mu                   !! where there is no table
        type(friction_t), intent(in) :: friction     !! its table

        strip_mu = mu
        if (friction%table%n > 0) strip_mu = mean_mu_between(friction%table, mu, &
                                                             strips%y_left(k), strips%y_right(k))
    end function strip_mu

    !> The strip numbers `first` to `last` as lanes; those without load or capacity are left out.
    pure subroutine fill_block(law, strips, first, last, rolling, friction, block)
        type(patch_law_t), intent(in) :: law
        type(contact_strips_t), intent(in) :: strips
        integer, intent(in) :: first, last
        type(rolling_t), intent(in) :: rolling
        type(friction_t), intent(in) :: friction
        type(block_t), intent(out) :: block

        real(wp) :: flexibility, stiffness, offset, cksi, mu
        integer :: i, k

        ! At the centroid.
        cksi = rolling%creepage%cksi - law%y*rolling%creepage%cphi
        block%n = 0
        do i = first, last
            associate (p0 => strips%p0(i), xd => strips%half_length(i), &
                       width => strips%y_right(i) - strips%y_left(i))
                mu = rolling%mu
                if (friction%table%n > 0) mu = strip_mu(strips, i, mu, friction)
                if (mu*strip_load(p0, xd, width) <= nothing) cycle
                k = block%n + 1
                block%n = k
                block%strip(k) = i
                block%half_length(k) = xd
                block%y(k) = 0.5_wp*(strips%y_left(i) + strips%y_right(i))
                block%peak_bound(k) = mu*p0
                block%cell(k) = 2.0_wp*xd/rolling%points*width
            end associate
        end do
        ! Idle lanes repeat the last one and are not counted.
        block%lanes = min(lane_step*((block%n + lane_step - 1)/lane_step), most_lanes)
        do k = block%n + 1, block%lanes
            block%half_length(k) = block%half_length(block%n)
            block%y(k) = block%y(block%n)
            block%peak_bound(k) = block%peak_bound(block%n)
        end do
        !$omp simd private(flexibility, stiffness, offset)
        do k = 1, block%lanes
            ! To the power of gamma_length.
            flexibility = sqrt(sqrt(block%half_length(k)/law%a))
            flexibility = flexibility*sqrt(flexibility)
            stiffness = 1.0_wp/flexibility
            offset = block%y(k) - law%y
            block%slope_x(k) = (cksi/law%l1 - offset*rolling%creepage%cphi*law%spin_slope) &
                               *stiffness
            block%slope_y0(k) = rolling%creepage%ceta/law%l2*stiffness
            block%slope_y1(k) = rolling%creepage%cphi/law%l3*stiffness
            block%rigid_x(k) = rolling%creepage%cksi - block%y(k)*rolling%creepage%cphi
            block%k1(k) = law%k1*flexibility
            block%k2(k) = law%k2*flexibility
            block%onset(k) = slip_onset/sqrt(law%k1*law%k2)*block%half_length(k)*stiffness
            block%inverse_peak_bound(k) = 1.0_wp/block%peak_bound(k)
            block%px(k) = 0.0_wp
            block%py(k) = 0.0_wp
            block%f(k) = 0.0_wp
            block%sum_x(k) = 0.0_wp
            block%sum_y(k) = 0.0_wp
            block%arm_x(k) = 0.0_wp
            block%sticking(k) = 0.0_wp
            block%rigid_y(k) = rolling%creepage%ceta
            block%spin(k) = rolling%creepage%cphi
            block%pressed(k) = 0.0_wp
        end do
        if (rolling%plane_counts) call add_own_slip(law, strips, rolling, block)
    end subroutine fill_block

    !> Give strips of a block what each has of slip beside that of the patch (S15).
    pure subroutine add_own_slip(law, strips, rolling, block)
        type(patch_law_t), intent(in) :: law
        type(contact_strips_t), intent(in) :: strips
        type(rolling_t), intent(in) :: rolling
        type(block_t), intent(inout) :: block

        type(creepage_t) :: own
        real(wp) :: stiffness
        integer :: k

        do k = 1, block%lanes
            own = rest_of_slip(strip_slip(strips, block%strip(min(k, block%n)), rolling%plane), &
                               block%y(k), rolling%plane, rolling%given)
            ! (a/xd)^gamma_length
            stiffness = sqrt(sqrt(law%a/block%half_length(k)))
            stiffness = stiffness*sqrt(stiffness)
            block%slope_x(k) = block%slope_x(k) + own%cksi/law%l1*stiffness
            block%slope_y0(k) = block%slope_y0(k) + own%ceta/law%l2*stiffness
            block%slope_y1(k) = block%slope_y1(k) + own%cphi/law%l3*stiffness
            block%rigid_x(k) = block%rigid_x(k) + own%cksi
            block%rigid_y(k) = block%rigid_y(k) + own%ceta
            block%spin(k) = block%spin(k) + own%cphi
        end do
    end subroutine add_own_slip

    !> Do pressures of dissimilar materials cause slip?
    pure logical function is_pressed(rolling)
        type(rolling_t), intent(in) :: rolling

        is_pressed = abs(rolling%pressure_slip) > 0.0_wp
    end function is_pressed

    !> What pressures of dissimilar materials will do in the strips of a block (S14).
    pure subroutine find_pressed(law, strips, rolling, block, pressed)
        type(patch_law_t), intent(in) :: law
        type(contact_strips_t), intent(in) :: strips
        type(rolling_t), intent(in) :: rolling
        type(block_t), intent(in) :: block
        type(pressed_t), intent(out) :: pressed

        real(wp) :: stiffness, factor
        integer :: k, at

        factor = bed_factor(law%a, law%b, &
                            2.0_wp*abs(rolling%pressure_slip)*law%a/(law%l1*rolling%mu))
        do k = 1, block%lanes
            at = block%strip(min(k, block%n))
            call find_pressure_slip(strips, at, rolling%pressure_slip, pressed%node_x(:, k), &
                                    pressed%node_y(:, k))
            pressed%own(k) = 2.0_wp*rolling%pressure_slip*strips%p0(at)
            ! (a/xd)^gamma_length
            stiffness = sqrt(sqrt(law%a/block%half_length(k)))
            stiffness = stiffness*sqrt(stiffness)/factor
            pressed%bed_x(k) = stiffness/law%l1
            pressed%bed_y(k) = stiffness/law%l2
            pressed%slope_x(k) = block%slope_x(k)
            pressed%slope_y(k) = block%slope_y0(k)
            pressed%rigid_x(k) = block%rigid_x(k)
            pressed%rigid_y(k) = block%rigid_y(k)
        end do
    end subroutine find_pressed

    !> Give the next step the slip that pressures cause half way.
    pure subroutine press(block, t, pressed)
        type(block_t), intent(inout) :: block
        real(wp), intent(in) :: t !! half way over half-length
        type(pressed_t), intent(inout) :: pressed

        real(wp) :: weights(n_nodes), root
        integer :: k

        weights = node_weights(t)
        root = sqrt(1.0_wp - t*t)
        do k = 1, block%lanes
            pressed%slip_x(k) = sum(weights*pressed%node_x(:, k)) + root*pressed%own(k)
            pressed%slip_y(k) = sum(weights*pressed%node_y(:, k))
            block%slope_x(k) = pressed%slope_x(k) + pressed%bed_x(k)*pressed%slip_x(k)
            block%slope_y0(k) = pressed%slope_y(k) + pressed%bed_y(k)*pressed%slip_y(k)
            block%rigid_x(k) = pressed%rigid_x(k) + pressed%slip_x(k)
            block%rigid_y(k) = pressed%rigid_y(k) + pressed%slip_y(k)
        end do
    end subroutine press

    !> Add what tractions do on the slip that pressures cause, which is no friction power.
    pure subroutine note_pressed(block, pressed)
        type(block_t), intent(inout) :: block
        type(pressed_t), intent(in) :: pressed

        integer :: k

        do k = 1, block%lanes
            block%pressed(k) = block%pressed(k) + block%px(k)*pressed%slip_x(k) &
                               + block%py(k)*pressed%slip_y(k)
        end do
    end subroutine note_pressed

    !> One element further in all lanes, from the leading edge to the trailing one: in adhesion the
    !> traction grows by the slope of adhesion; where that leaves the bound, it slides.
    pure subroutine advance(block, t, step_per_length, bound)
        type(block_t), intent(inout) :: block
        real(wp), intent(in) :: t              !! place of the element over half-length
        real(wp), intent(in) :: step_per_length !! from the last point on, over half-length
        real(wp), intent(in) :: bound          !! bound over mu p0

        real(wp) :: slope_y, mean_x
        integer :: k, first

        mean_x = t + 0.5_wp*step_per_length
        !$omp simd private(slope_y)
        do k = 1, block%lanes
            block%step(k) = block%half_length(k)*step_per_length
            slope_y = block%slope_y0(k) + block%half_length(k)*mean_x*block%slope_y1(k)
            block%extra_y(k) = block%step(k)*(block%k2(k)*slope_y &
                                             - (block%rigid_y(k) &
                                                + block%half_length(k)*t*block%spin(k)))
            block%px(k) = block%px(k) - block%step(k)*block%slope_x(k)
            block%py(k) = block%py(k) - block%step(k)*slope_y
            block%excess(k) = block%px(k)*block%px(k) + block%py(k)*block%py(k) &
                              - (block%peak_bound(k)*bound)**2
        end do
        do first = 1, block%lanes, lane_step
            if (any(block%excess(first:first + lane_step - 1) > 0.0_wp)) then
                call slide(block, first, bound)
            else
                block%f(first:first + lane_step - 1) = 0.0_wp
            end if
        end do
        !$omp simd
        do k = 1, block%lanes
            block%sum_x(k) = block%sum_x(k) + block%px(k)
            block%sum_y(k) = block%sum_y(k) + block%py(k)
            block%arm_x(k) = block%arm_x(k) + block%half_length(k)*t*block%py(k)
            block%sticking(k) = block%sticking(k) + (0.5_wp - sign(0.5_wp, block%excess(k)))
        end do
    end subroutine advance

    !> Bring those of a few lanes that left the bound back to it.
    !>
    !> The step is implicit in the slip (S4): with f = lambda times the step,
    !>
    !>     p_i = (K_i q_i - step e_i)/(K_i + f),   |p| = bound.
    !>
    !> What e_i has of adhesion comes from the lambda of the element ahead and, once more, from the
    !> estimate of f that follows, exact for K1 = K2; then one step of Newton's method on 1/|p|,
    !> which is nearly linear in f. The traction is scaled onto the bound at the end, so that what
    !> is left of the residual costs no force. No tests of convergence: all lanes do the same.
    pure subroutine slide(block, first, bound)
        type(block_t), intent(inout) :: block
        integer, intent(in) :: first  !! first of the lanes
        real(wp), intent(in) :: bound !! bound over mu p0

        real(wp) :: k1, k2, extra_x, push_x, push_y, fade, ax, ay, squared, f, u, v, px, py, r
        real(wp) :: inverse_bound, inverse_limit, slides, grip
        integer :: k

        inverse_bound = 1.0_wp/bound
        !$omp simd private(k1, k2, extra_x, push_x, push_y, fade, ax, ay, squared, f, u, v, px, &
        !$omp& py, r, inverse_limit, slides, grip)
        do k = first, first + lane_step - 1
            k1 = block%k1(k)
            k2 = block%k2(k)
            grip = block%onset(k)/block%step(k)
            inverse_limit = block%inverse_peak_bound(k)*inverse_bound
            extra_x = block%step(k)*(k1*block%slope_x(k) - block%rigid_x(k))
            push_x = k1*block%px(k) + extra_x
            push_y = k2*block%py(k) + block%extra_y(k)
            fade = 1.0_wp/(1.0_wp + grip*block%f(k))
            ax = push_x - extra_x*fade
            ay = push_y - block%extra_y(k)*fade
            r = 1.0_wp/sqrt(ax*ax + ay*ay + least)
            ax = ax*r
            ay = ay*r
            f = inverse_limit/r - (k1*ax*ax + k2*ay*ay)
            f = 0.5_wp*(f + abs(f))

            fade = 1.0_wp/(1.0_wp + grip*f)
            ax = push_x - extra_x*fade
            ay = push_y - block%extra_y(k)*fade
            u = k1 + f
            v = k2 + f
            px = ax*v
            py = ay*u
            squared = px*px + py*py + least
            f = f + (sqrt(squared)*inverse_limit - u*v)*squared/(px*px*v + py*py*u + least)
            f = 0.5_wp*(f + abs(f))

            px = ax*(k2 + f)
            py = ay*(k1 + f)
            r = 1.0_wp/(sqrt(px*px + py*py + least)*inverse_limit)
            slides = 0.5_wp + sign(0.5_wp, block%excess(k))
            block%f(k) = slides*f
            block%px(k) = slides*(px*r) + (1.0_wp - slides)*block%px(k)
            block%py(k) = slides*(py*r) + (1.0_wp - slides)*block%py(k)
        end do
    end subroutine slide
end module faststrip_tangential_strip_march
