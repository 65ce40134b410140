!> TFASTSTRIP, the better one: marching in the strips of any contact patch.
!>
!> Each patch has a virtual ellipse (semi-axes a, b of its area and second moments), which gives
!> Kalker's coefficients; everything else is the strip's own: its length 2 xd, its pressure p0 and
!> its place y. A strip is marched from its leading edge like in FASTSIM (Kalker 1982; the paper's
!> eq. (25)-(48) once corrected). What differs from the paper, and why:
!>
!>  1. **Flexibility** `L_i = l_i (xd/a)^gamma`, gamma = 0.4. FASTSIM has gamma = 0 (one flexibility
!>     for the patch), strip theory gamma = 1 (each strip is a half-plane of its own, Carter's);
!>     a patch whose strips hang together lies between. The factors l_i make the linear forces
!>     Kalker's on an ellipse for any gamma (`strip_moments`):
!>     l1 = 2 a I1/(C11 G), l2 = 2 a I1/(C22 G), l3 = (2/3) a sqrt(a/b) I3/(C23 G).
!>  2. **Bound** `mu p0 k (1 - t^2)^m (1 - alpha t)`, t = x/xd, k from `sum = pi/2` over the points,
!>     so that each strip saturates at mu times its load and the contact at mu N exactly (the paper
!>     scales afterwards). With m = 1 and alpha = 1/3 marching at constant creepage gives Carter's
!>     force `1 - (1 - delta)^2` exactly at every creepage (the slope of the force over creepage is
!>     half the squared length of the adhesion zone in both; comparing them gives the bound), so
!>     alpha > 0 repairs what a linear traction in adhesion spoils. Measured best with gamma = 0.4:
!>     alpha = 0.15. With spin the traction in adhesion is symmetric and so is the bound: alpha
!>     falls to zero with the share of spin, and m from 1 towards 0.7 with saturation by spin, for
!>     the elliptic bound (m = 1/2) is the true one where all slides.
!>  3. **Spin in x**: the adhesion slope of `-y cphi`, y from the centroid of the patch, is the mean
!>     of the one that goes with L1 and the one that makes the linear moment C33. The motion of
!>     the centroid itself, `cksi - y_c cphi`, is longitudinal creepage like any other: forces do
!>     not depend on where the reference point lies.
!>  4. **Slip**: with three flexibilities scaling the elastic predictor back to the bound points the
!>     wrong way. The step is implicit in the slip s = -lambda p,
!>     `p_i = (K_i/h q_i - e_i)/(K_i/h + lambda)`, |p| = bound, q the traction one step ahead; e_i
!>     goes from `K_i` times the slope of adhesion (lambda = 0) to the rigid slip (lambda large)
!>     on the scale `sqrt(K1 K2)/xd`, a property of the strip and not of the grid.
!>  5. **Flexibility in slip**: K_i moves half way from L_i to L3 with the share of spin and falls
!>     by up to a third with saturation: the traction of a spinning patch turns within the patch,
!>     and short waves are stiffer than long ones.
!>  6. **Moment**: traction that grows linearly from the edge has its centre at -xd/3 and gives
!>     neither C32 = -C23 nor C33. The arms are stretched so that the linear moments are
!>     Kalker's; the stretch fades as a strip saturates.
!>  7. **Stick**: where deviation 2 gives Carter's force, a strip sticks over the share s of its
!>     length in which Carter's sticks over s^2; the stick fraction counts s^2 (s with spin alone).
!>     The states of the field are those of the marching.
!>
!> gamma, alpha, the range of m and the factors of 4 and 5 are tuned: round numbers near a broad
!> minimum of the errors against CONTACT on 161 Hertz cases and 40 S1002/UIC60 cases. Fitted to one
!> half of these, the method has on the other half the errors it has on the first (force vector on
!> the Hertz cases: 0.60 and 0.65 % of mu N, 0.62 and 0.61 with the halves exchanged).
module faststrip_tangential_faststrip
    use faststrip_kinds, only: wp, pi
    use faststrip_status, only: status_t, set_status, is_error, st_out_of_range
    use faststrip_material, only: material_t, check_material, combined_shear_modulus, &
                                  combined_poisson_ratio
    use faststrip_creepage, only: creepage_t
    use faststrip_normal_strips, only: contact_strips_t, strip_load
    use faststrip_tangential_kalker, only: kalker_coefficients_t, kalker_coefficients
    use faststrip_tangential_motion, only: check_motion
    use faststrip_normal_patch_ellipse, only: patch_ellipse_t, patch_ellipse, patch_end, check_strips
    use faststrip_tangential_types, only: tangential_result_t, tangential_field_t, empty_field, &
                                          add_element, most_points, state_adhesion, state_slip
    implicit none
    private

    public :: faststrip_solve, default_points, most_points

    !> Points along each strip unless told otherwise.
    integer, parameter :: default_points = 15

    ! The constants of the list above.
    real(wp), parameter :: gamma_length = 0.4_wp    ! 1
    real(wp), parameter :: asymmetry = 0.15_wp      ! 2, alpha without spin
    real(wp), parameter :: flattening = 0.3_wp      ! 2, m = 1 - flattening at most
    real(wp), parameter :: longitudinal_part = 0.5_wp ! 3
    real(wp), parameter :: slip_onset = 2.0_wp      ! 4
    real(wp), parameter :: spin_part = 0.5_wp       ! 5
    real(wp), parameter :: stiffening = 0.5_wp      ! 5
    real(wp), parameter :: half_saturation = 2.0_wp ! linear force over mu N at saturation 1/2

    ! int_{-1}^{1} (1 - s^2)^e ds for e = (2 - gamma)/2 and (3 - gamma)/2; of s^2 (1 - s^2)^e1.
    real(wp), parameter :: e1 = 0.5_wp*(2.0_wp - gamma_length)
    real(wp), parameter :: e3 = 0.5_wp*(3.0_wp - gamma_length)
    real(wp), parameter :: root_pi = 1.772453850905516027298167483341145183_wp
    real(wp), parameter :: i1 = root_pi*gamma(e1 + 1.0_wp)/gamma(e1 + 1.5_wp)
    real(wp), parameter :: i3 = root_pi*gamma(e3 + 1.0_wp)/gamma(e3 + 1.5_wp)
    real(wp), parameter :: j1 = 0.5_wp*root_pi*gamma(e1 + 1.0_wp)/gamma(e1 + 2.5_wp)

    ! A patch that can carry less than this, N, carries nothing.
    real(wp), parameter :: smallest_force = 1.0e-60_wp

    !> What one patch's strips share.
    type :: patch_law_t
        real(wp) :: a            !! semi-axis of the virtual ellipse along x, mm
        real(wp) :: y            !! centroid, mm
        real(wp) :: l1, l2, l3   !! flexibilities of a strip of length 2a, mm/MPa
        real(wp) :: k1, k2       !! the same in slip, mm/MPa
        real(wp) :: spin_slope   !! slope of px in adhesion per y cphi, strip of length 2a, MPa/mm
        real(wp) :: cksi         !! longitudinal creepage at the centroid
        real(wp) :: stretch_x    !! arms in x are longer by this part where nothing slides
        real(wp) :: stretch_y    !! arms in y, from the centroid
        real(wp) :: stick_power  !! power of a strip's share of adhesion
    end type patch_law_t

contains

    !> Forces of any contact patches by marching in their strips; no allocation.
    pure subroutine faststrip_solve(strips, material, mu, creepage, points_per_strip, result, &
                                    status, field)
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
            !! filled when present; needs room for n*points_per_strip elements

        real(wp) :: stuck, covered
        integer :: first, last

        call check_motion(mu, creepage, status)
        if (is_error(status)) return
        call check_material(material, status)
        if (is_error(status)) return
        call check_strips(strips, status)
        if (is_error(status)) return
        if (points_per_strip < 1 .or. points_per_strip > most_points) then
            call set_status(status, st_out_of_range, 'points per strip outside 1 to 1000')
            return
        end if
        if (present(field)) then
            call empty_field(field, strips%n*points_per_strip, status)
            if (is_error(status)) return
        end if

        stuck = 0.0_wp
        covered = 0.0_wp
        last = 0
        do while (last < strips%n)
            first = last + 1
            last = patch_end(strips, first)
            call solve_patch(strips, first, last, material, mu, creepage, points_per_strip, &
                             result, stuck, covered, status, field)
            if (is_error(status)) then
                result = tangential_result_t()
                return
            end if
        end do
        if (covered > 0.0_wp) result%stick_fraction = stuck/covered
    end subroutine faststrip_solve

    !> Add the forces of strips `first` to `last`, one patch.
    pure subroutine solve_patch(strips, first, last, material, mu, creepage, points, result, &
                                stuck, covered, status, field)
        type(contact_strips_t), intent(in) :: strips
        integer, intent(in) :: first, last, points
        type(material_t), intent(in) :: material
        real(wp), intent(in) :: mu
        type(creepage_t), intent(in) :: creepage
        type(tangential_result_t), intent(inout) :: result
        real(wp), intent(inout) :: stuck, covered !! areas, mm^2
        type(status_t), intent(inout) :: status
        type(tangential_field_t), intent(inout), optional :: field

        type(patch_ellipse_t) :: ellipse
        type(kalker_coefficients_t) :: c
        type(patch_law_t) :: law
        real(wp) :: g, ab, force, along, across, turning, spin_share, saturation, exponent, alpha
        real(wp) :: fading, bound(most_points), t
        integer :: i

        ellipse = patch_ellipse(strips, first, last)
        force = mu*ellipse%load
        if (force <= smallest_force) return
        call kalker_coefficients(ellipse%a/ellipse%b, combined_poisson_ratio(material), c, status)
        if (is_error(status)) return
        g = combined_shear_modulus(material)
        ab = ellipse%a*ellipse%b
        law%a = ellipse%a
        law%y = ellipse%y
        law%cksi = creepage%cksi - ellipse%y*creepage%cphi

        ! Linear forces over mu N, and from them how far the patch slides and how far by spin.
        along = linear_share(c%c11*g*ab*law%cksi, force)
        across = linear_share(c%c22*g*ab*creepage%ceta, force)
        turning = linear_share(c%c23*g*ab*sqrt(ab)*creepage%cphi, force)
        saturation = along**2 + across**2 + turning**2
        spin_share = 0.0_wp
        if (saturation > 0.0_wp) spin_share = turning**2/saturation
        saturation = sqrt(saturation)
        saturation = saturation/(saturation + half_saturation)

        law%l1 = 2.0_wp*law%a*i1/(c%c11*g)
        law%l2 = 2.0_wp*law%a*i1/(c%c22*g)
        law%l3 = 2.0_wp/3.0_wp*law%a*sqrt(ellipse%a/ellipse%b)*i3/(c%c23*g)
        law%k1 = in_slip(law%l1, law%l3, spin_share, saturation)
        law%k2 = in_slip(law%l2, law%l3, spin_share, saturation)
        ! The slope that gives C33: int 2 y^2 xd^2 (a/xd)^gamma dy slope = C33 G (ab)^2.
        t = c%c33*g/(2.0_wp*ellipse%b*j1)
        law%spin_slope = longitudinal_part/law%l1 + (1.0_wp - longitudinal_part)*t
        fading = 1.0_wp - saturation**4
        law%stretch_x = fading*(c%c23*sqrt(ellipse%b/ellipse%a)*g*law%l2*1.5_wp/(law%a*i3) &
                                - 1.0_wp)
        law%stretch_y = fading*(t/law%spin_slope - 1.0_wp)

        law%stick_power = 2.0_wp - spin_share
        exponent = 1.0_wp - flattening*saturation*spin_share
        alpha = asymmetry*(1.0_wp - spin_share)
        do i = 1, points
            t = real(points - 2*i + 1, wp)/points
            bound(i) = (1.0_wp - t*t)**exponent*(1.0_wp - alpha*t)
        end do
        bound(:points) = bound(:points)*(0.25_wp*pi*points/sum(bound(:points)))

        do i = first, last
            call march(law, strips%half_length(i), strips%p0(i), strips%y_left(i), &
                       strips%y_right(i), mu, creepage, bound(:points), result, stuck, covered, field)
        end do
    end subroutine solve_patch

    !> |linear force|/(mu N), cut where it is beyond all slip.
    elemental real(wp) function linear_share(linear, force)
        real(wp), intent(in) :: linear, force

        linear_share = min(abs(linear)/force, 1.0e30_wp)
    end function linear_share

    !> Flexibility where the patch slides (deviation 5).
    elemental real(wp) function in_slip(l, l3, spin_share, saturation)
        real(wp), intent(in) :: l, l3, spin_share, saturation

        in_slip = (l + (l3 - l)*spin_part*spin_share) &
                  /(1.0_wp + stiffening*saturation*spin_share)
    end function in_slip

    !> March through one strip and add its forces.
    pure subroutine march(law, half_length, p0, y_left, y_right, mu, creepage, bound, result, &
                          stuck, covered, field)
        type(patch_law_t), intent(in) :: law
        real(wp), intent(in) :: half_length, p0, y_left, y_right, mu
        type(creepage_t), intent(in) :: creepage
        real(wp), intent(in) :: bound(:) !! over mu p0, at the middles of the elements
        type(tangential_result_t), intent(inout) :: result
        real(wp), intent(inout) :: stuck, covered
        type(tangential_field_t), intent(inout), optional :: field

        real(wp) :: y, width, h, x, step, softness, limit, cell, top, strength
        real(wp) :: slope_x, slope_y, slope_y0, slope_y1, rigid_x, rigid_y
        real(wp) :: px, py, ahead_x, ahead_y, lambda, slip, sum_x, sum_y, arm_x, used
        integer :: i, n, held, state

        n = size(bound)
        width = y_right - y_left
        top = mu*p0
        strength = mu*strip_load(p0, half_length, width)
        if (strength <= smallest_force) return
        y = 0.5_wp*(y_left + y_right)
        h = 2.0_wp*half_length/n
        cell = h*width
        softness = (half_length/law%a)**gamma_length
        slope_x = (law%cksi/law%l1 - (y - law%y)*creepage%cphi*law%spin_slope)/softness
        slope_y0 = creepage%ceta/(law%l2*softness)
        slope_y1 = creepage%cphi/(law%l3*softness)
        rigid_x = creepage%cksi - y*creepage%cphi
        px = 0.0_wp
        py = 0.0_wp
        sum_x = 0.0_wp
        sum_y = 0.0_wp
        arm_x = 0.0_wp
        held = 0
        lambda = 0.0_wp
        do i = 1, n
            x = half_length*real(n - 2*i + 1, wp)/n
            ! Half a step from the edge to the middle of the first element.
            step = merge(0.5_wp*h, h, i == 1)
            slope_y = slope_y0 + (x + 0.5_wp*step)*slope_y1
            ahead_x = px
            ahead_y = py
            px = px - step*slope_x
            py = py - step*slope_y
            limit = top*bound(i)
            if (px*px + py*py <= limit*limit) then
                state = state_adhesion
                held = held + 1
            else
                state = state_slip
                rigid_y = creepage%ceta + x*creepage%cphi
                call slide(law%k1*softness, law%k2*softness, half_length, step, ahead_x, ahead_y, &
                           slope_x, slope_y, rigid_x, rigid_y, limit, px, py, lambda)
                result%friction_power = result%friction_power + cell*lambda*limit**2
            end if
            sum_x = sum_x + px
            sum_y = sum_y + py
            arm_x = arm_x + x*py
            if (present(field)) then
                slip = merge(lambda, 0.0_wp, state == state_slip)
                call add_element(field, x, y, cell, p0*sqrt(1.0_wp - (x/half_length)**2), px, py, &
                                 -slip*px, -slip*py, state)
            end if
        end do
        used = min(cell*sqrt(sum_x**2 + sum_y**2)/strength, 1.0_wp)
        result%fx = result%fx + cell*sum_x
        result%fy = result%fy + cell*sum_y
        result%mz = result%mz + cell*((1.0_wp + law%stretch_x*(1.0_wp - used))*arm_x &
                                      - (y + law%stretch_y*(1.0_wp - used)*(y - law%y))*sum_x)
        covered = covered + n*cell
        stuck = stuck + n*cell*(real(held, wp)/n)**law%stick_power
    end subroutine march

    !> Traction of an element that slides: the implicit step of deviation 4.
    !>
    !> One equation for lambda, |p(lambda)| = limit. 1/|p| is nearly linear in lambda, so Newton's
    !> method on it needs two or three steps from the last element's lambda; a bracket keeps it
    !> safe. The traction is scaled onto the bound at the end, so that what is left of the residual
    !> costs no force.
    pure subroutine slide(k1, k2, half_length, step, ahead_x, ahead_y, slope_x, slope_y, &
                          rigid_x, rigid_y, limit, px, py, lambda)
        real(wp), intent(in) :: k1, k2           !! flexibilities in slip, mm/MPa
        real(wp), intent(in) :: half_length      !! xd, mm
        real(wp), intent(in) :: step             !! way since the last point, mm
        real(wp), intent(in) :: ahead_x, ahead_y !! traction there, MPa
        real(wp), intent(in) :: slope_x, slope_y !! adhesion slopes, MPa/mm
        real(wp), intent(in) :: rigid_x, rigid_y !! rigid slip
        real(wp), intent(in) :: limit            !! bound, MPa, below the size of (px, py)
        real(wp), intent(inout) :: px, py        !! in: the elastic predictor; out: the traction
        real(wp), intent(inout) :: lambda        !! slip per traction, 1/MPa; in: a guess, >= 0

        real(wp), parameter :: tolerance = 1.0e-9_wp
        integer, parameter :: most_steps = 60
        real(wp) :: kx, ky, push_x, push_y, extra_x, extra_y, scale, fade, size, slope, low, high
        real(wp) :: guess
        integer :: i

        kx = k1/step
        ky = k2/step
        push_x = kx*ahead_x - rigid_x
        push_y = ky*ahead_y - rigid_y
        ! What e_i has beyond the rigid slip where nothing slides.
        extra_x = k1*slope_x - rigid_x
        extra_y = k2*slope_y - rigid_y
        scale = slip_onset*half_length/sqrt(k1*k2)
        low = 0.0_wp
        high = huge(1.0_wp)
        do i = 1, most_steps
            fade = 1.0_wp/(1.0_wp + scale*lambda)
            px = (push_x - extra_x*fade)/(kx + lambda)
            py = (push_y - extra_y*fade)/(ky + lambda)
            size = sqrt(px*px + py*py)
            if (abs(size - limit) <= tolerance*limit) exit
            if (size > limit) then
                low = lambda
            else
                high = lambda
            end if
            ! d|p|^2/2/dlambda
            slope = px*(extra_x*scale*fade*fade - px)/(kx + lambda) &
                    + py*(extra_y*scale*fade*fade - py)/(ky + lambda)
            guess = -1.0_wp
            if (slope < 0.0_wp) guess = lambda - (size - limit)/limit*size*(size/slope)
            if (guess <= low .or. guess >= high) then
                if (high < huge(1.0_wp)) then
                    guess = 0.5_wp*(low + high)
                else
                    guess = 4.0_wp*low + max(kx, ky)
                end if
            end if
            lambda = guess
        end do
        if (size > 0.0_wp) then
            px = px*(limit/size)
            py = py*(limit/size)
        end if
    end subroutine slide
end module faststrip_tangential_faststrip
