!> Error estimates of the creep forces of FASTSTRIP and FASTSIM: they bound the error in 95 of 100
!> contacts.
!>
!> A network that was fitted to the errors of forces on contacts that the correction of FASTSTRIP
!> did not know (`tools/generate/fit_forces.py`); its inputs are those of the correction, how large
!> that is, and what is estimated of the normal solution. Where a patch rolls less or more than what
!> was fitted, its errors go with the creepages or stay what they are at the end; of shapes beyond,
!> they grow as the correction fades.
module faststrip_tangential_force_errors
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_creepage, only: creepage_t
    use faststrip_base_material, only: material_t, combined_poisson_ratio
    use faststrip_base_status, only: status_t, is_error
    use faststrip_normal_estimate_errors, only: normal_errors_t
    use faststrip_normal_simple_patch_ellipse, only: patch_ellipse_t, patch_ellipse
    use faststrip_normal_strips, only: contact_strips_t, last_of_patch
    use faststrip_normal_sub_patches, only: has_neck
    use faststrip_tangential_force_correction, only: force_correction
    use faststrip_tangential_force_network, only: rolling_state_t, network_inputs, &
                                                  evaluate_network, shape_measure, share_seen
    use faststrip_tangential_force_weights, only: &
        n_ellipse_inputs, n_shape_inputs, n_error_inputs, n_errors, error_hidden, error_first, &
        error_first_bias, error_second, error_second_bias, error_third, error_third_bias, &
        error_safety, smallest_error, largest_estimate
    use faststrip_tangential_patch_coupling, only: coupling_t, tractions_t, find_coupling, &
                                                   induced_motion, sum_tractions, approach, &
                                                   most_parts, coupling_passes
    use faststrip_tangential_patch_law, only: patch_law_t, find_law
    use faststrip_tangential_patch_shape, only: patch_shape_t, patch_shape
    implicit none
    private

    public :: force_errors_t, estimate_force_errors, errors_of_march, errors_of_fitted, &
              errors_of_fastsim

    !> Estimated errors of the forces, not negative.
    type :: force_errors_t
        real(wp) :: fx = 0.0_wp !! of Fx over mu N
        real(wp) :: fy = 0.0_wp !! of Fy over mu N
        real(wp) :: mz = 0.0_wp !! of Mz about the reference point over mu N c, c = sqrt(area/pi)
        real(wp) :: arm = 0.0_wp
            !! what of `mz` comes from Fx and how far the reference point lies beside the patches
    end type force_errors_t

    ! Given: numbers of kinds.
    integer, parameter :: errors_of_march = 1   !! FASTSTRIP without its correction
    integer, parameter :: errors_of_fitted = 2  !! with it
    integer, parameter :: errors_of_fastsim = 3 !! FASTSIM on the patches' ellipses

    ! Linear forces over mu N between which errors were fitted.
    ! Tuned [1]. Origin: as the contacts were drawn.
    real(wp), parameter :: weakest = 0.1_wp, strongest = 100.0_wp
    ! Tuned [1]: How much of a shape or proportion counts as seen at least: estimates grow to five
    ! times what they are. Origin: chosen.
    real(wp), parameter :: least_seen = 0.2_wp
    ! Tuned [1]: Least estimates of penetration, maximum pressure and area of the ellipses that
    ! were fitted, over the squared width of their strips. Origin: measured on them.
    real(wp), parameter :: least_estimates(3) = [0.02_wp, 0.07_wp, 0.16_wp]

    ! Tuned [1]: Least errors of Fx, Fy, Mz where nearly all slides: the directions of slip are
    ! wrong by parts of the elastic one, which falls as rolling grows; where the network was fitted
    ! most states roll askew. Origin: 420 contacts with creepage along or across, up to five times
    ! what slides in the linear law, by TANG; 203 others up to thirty times are bounded in 97 of
    ! 100.
    real(wp), parameter :: least_sliding(3) = [0.0_wp, 0.004_wp, 0.009_wp], &
                           sliding_share(3) = [0.0_wp, 0.018_wp, 0.06_wp]

    ! Tuned [1]: Error of Fx, Fy, Mz by what other patches change in Fx, Fy and, times half the
    ! length, Fy. Origin: 336 contacts of several patches by TANG, as `patch_coupling`; they are
    ! bounded in 95 of 100 contacts.
    real(wp), parameter :: coupling_share(3) = [0.4_wp, 1.0_wp, 0.4_wp]

contains

    !> Estimate the errors of the forces that a method gives of strips.
    pure subroutine estimate_force_errors(strips, material, mu, creepage, method, points, &
                                          normal_errors, errors, status, finer)
        type(contact_strips_t), intent(in) :: strips     !! a normal solution, checked
        type(material_t), intent(in) :: material         !! moduli in MPa
        real(wp), intent(in) :: mu                       !! coefficient of friction
        type(creepage_t), intent(in) :: creepage         !! about the reference point
        integer, intent(in) :: method                    !! one of the `errors_of_` numbers
        integer, intent(in) :: points                    !! along a strip
        type(normal_errors_t), intent(in) :: normal_errors   !! of the normal solution
        type(force_errors_t), intent(out) :: errors      !! of the sums over all patches
        type(status_t), intent(inout) :: status          !! that of `kalker_coefficients`
        real(wp), intent(in), optional :: finer
            !! what would be estimated of so many times as many strips, with `points` along each and
            !! these estimates; default 1

        type(patch_ellipse_t) :: ellipse
        type(patch_law_t) :: law
        type(patch_shape_t) :: shape
        type(rolling_state_t) :: state
        type(coupling_t) :: coupling
        type(tractions_t) :: apart(most_parts), tractions(most_parts)
        type(creepage_t) :: induced
        real(wp) :: part(3), total(4), load, area, u(3), times, tilt
        integer :: first, last, k, patch

        times = 1.0_wp
        if (present(finer)) times = finer
        total = 0.0_wp
        load = 0.0_wp
        area = 0.0_wp
        call find_coupling(strips, material, coupling)
        if (coupling%n > 1) then
            call expect_tractions(strips, material, mu, creepage, coupling, apart, status)
            if (is_error(status)) return
            tractions = apart
            do k = 1, coupling_passes
                call expect_tractions(strips, material, mu, creepage, coupling, tractions, status)
                if (is_error(status)) return
            end do
        end if
        induced = creepage
        last = 0
        k = 0
        patch = 0
        do while (last < strips%n)
            first = last + 1
            last = last_of_patch(strips, first)
            ellipse = patch_ellipse(strips, first, last)
            if (coupling%n > 1) then
                if (patch == 0) then
                    k = k + 1
                    patch = coupling%patches(k)
                    call induced_motion(coupling, tractions, k, creepage, induced, tilt)
                end if
                patch = patch - 1
            end if
            call find_law(ellipse, material, mu, induced, law, status, u)
            if (is_error(status)) return
            if (law%weight <= 0.0_wp) cycle
            shape = patch_shape(strips, first, last, ellipse)
            shape%width = shape%width/times
            state = rolling_state_t(u, [induced%cksi - ellipse%y*induced%cphi, induced%ceta, &
                                        induced%cphi], ellipse%a, ellipse%b, &
                                    combined_poisson_ratio(material), law%sliding, points)
            part = ellipse%load*errors_of_patch(state, shape, method, normal_errors, &
                                                has_neck(strips%half_length(first:last)))
            if (coupling%n > 1) part = part + ellipse%load*coupling_errors(apart(k), tractions(k), &
                                                                           ellipse)
            total = total + [part(1), part(2), &
                             part(3)*sqrt(ellipse%a*ellipse%b) + abs(ellipse%y)*part(1), &
                             abs(ellipse%y)*part(1)]
            load = load + ellipse%load
            area = area + pi*ellipse%a*ellipse%b
        end do
        if (load <= 0.0_wp) return
        errors = force_errors_t(total(1)/load, total(2)/load, total(3)/(load*sqrt(area/pi)), &
                                total(4)/(load*sqrt(area/pi)))
    end subroutine estimate_force_errors

    !> Tractions of all parts as they are expected to be with those of the others, by a plain law of
    !> saturation.
    pure subroutine expect_tractions(strips, material, mu, creepage, coupling, tractions, status)
        type(contact_strips_t), intent(in) :: strips
        type(material_t), intent(in) :: material
        real(wp), intent(in) :: mu
        type(creepage_t), intent(in) :: creepage
        type(coupling_t), intent(in) :: coupling
        type(tractions_t), intent(inout) :: tractions(:)
        type(status_t), intent(inout) :: status

        type(tractions_t) :: found(most_parts)
        type(patch_ellipse_t) :: ellipse
        type(patch_law_t) :: law
        type(creepage_t) :: induced
        real(wp) :: u(3), bound, tilt
        integer :: first, last, k, patch

        last = 0
        do k = 1, coupling%n
            call induced_motion(coupling, tractions, k, creepage, induced, tilt)
            do patch = 1, coupling%patches(k)
                first = last + 1
                last = last_of_patch(strips, first)
                ellipse = patch_ellipse(strips, first, last)
                call find_law(ellipse, material, mu, induced, law, status, u)
                if (is_error(status)) return
                bound = mu*ellipse%load/sqrt(1.0_wp + sum(u**2))
                call sum_tractions(-bound*u(1), -bound*(u(2) + u(3)), mu*ellipse%load, ellipse%a, &
                                   u, found(k))
            end do
        end do
        call approach(found, tractions)
    end subroutine expect_tractions

    !> What is wrong with a patch by what others do to it, over mu N, as `errors_of_patch`: parts of
    !> what they change.
    pure function coupling_errors(apart, coupled, ellipse) result(errors)
        type(tractions_t), intent(in) :: apart, coupled !! of the patch without and with others
        type(patch_ellipse_t), intent(in) :: ellipse
        real(wp) :: errors(3)

        real(wp) :: change(2)

        errors = 0.0_wp
        if (apart%bound <= 0.0_wp) return
        change = abs([coupled%fx - apart%fx, coupled%fy - apart%fy])/apart%bound
        errors = coupling_share*[change(1), change(2), change(2)*sqrt(ellipse%a/ellipse%b)]
    end function coupling_errors

    !> Errors of one patch, the moment about its centroid over mu N sqrt(ab).
    pure function errors_of_patch(given, shape, method, normal_errors, is_necked) result(errors)
        type(rolling_state_t), intent(in) :: given
        type(patch_shape_t), intent(in) :: shape
        integer, intent(in) :: method
        type(normal_errors_t), intent(in) :: normal_errors
        logical, intent(in) :: is_necked
        real(wp) :: errors(3)

        type(rolling_state_t) :: state
        real(wp) :: x(n_error_inputs), c(n_errors), v(3), missing(4), rolling, unlike

        errors = 0.0_wp
        rolling = norm2(given%linear)
        if (rolling <= 0.0_wp) return
        state = given
        associate (scale => min(max(rolling, weakest), strongest)/rolling)
            state%linear = state%linear*scale
            state%creepage = state%creepage*scale
        end associate
        unlike = shape_measure(shape)
        missing = force_correction(state, shape)
        associate (n => n_ellipse_inputs + n_shape_inputs)
            call network_inputs(state, shape, x(:n), v)
            x(n + 1:) = [log([shape%width, real(state%points, wp), &
                              within([normal_errors%est_err_penetration, &
                                      normal_errors%est_err_pmax, normal_errors%est_err_area], &
                                     least_estimates*shape%width**2), &
                              abs(missing(:3)) + smallest_error, 1.0_wp + unlike]), &
                         merge(1.0_wp, 0.0_wp, is_necked)]
        end associate
        call evaluate_network(n_error_inputs, error_hidden, n_errors, error_first, &
                              error_first_bias, error_second, error_second_bias, error_third, &
                              error_third_bias, x, c)
        errors = error_safety*exp(c(3*method - 2:3*method))*min(rolling/weakest, 1.0_wp) &
                 /max(share_seen(state, unlike), least_seen)
        errors = max(errors, min(least_sliding*min(max(rolling - 1.0_wp, 0.0_wp), 1.0_wp), &
                                 sliding_share/rolling))
    end function errors_of_patch

    !> An estimate of the normal figures as those that were fitted.
    elemental real(wp) function within(estimate, least)
        real(wp), intent(in) :: estimate, least

        within = min(max(estimate, least), largest_estimate)
    end function within
end module faststrip_tangential_force_errors
