!> How wrong the creep forces of FASTSTRIP and FASTSIM are expected to be: less than what is said in
!> 95 of 100 contacts.
module faststrip_tangential_force_errors
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_creepage, only: creepage_t
    use faststrip_base_material, only: material_t
    use faststrip_base_status, only: status_t, is_error
    use faststrip_normal_certificate, only: certificate_t
    use faststrip_normal_patch_ellipse, only: patch_ellipse_t, patch_ellipse
    use faststrip_normal_strips, only: contact_strips_t, last_of_patch
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
    end type force_errors_t

    ! Given: numbers of kinds.
    integer, parameter :: errors_of_march = 1   !! FASTSTRIP without its correction
    integer, parameter :: errors_of_fitted = 2  !! with it
    integer, parameter :: errors_of_fastsim = 3 !! FASTSIM on the patches' ellipses

contains

    !> Estimate the errors of the forces that a method gives of strips.
    pure subroutine estimate_force_errors(strips, material, mu, creepage, method, points, &
                                          certificate, errors, status, finer)
        type(contact_strips_t), intent(in) :: strips     !! a normal solution, checked
        type(material_t), intent(in) :: material         !! moduli in MPa
        real(wp), intent(in) :: mu                       !! coefficient of friction
        type(creepage_t), intent(in) :: creepage         !! about the reference point
        integer, intent(in) :: method                    !! one of the `errors_of_` numbers
        integer, intent(in) :: points                    !! along a strip
        type(certificate_t), intent(in) :: certificate   !! of the normal solution
        type(force_errors_t), intent(out) :: errors      !! of the sums over all patches
        type(status_t), intent(inout) :: status          !! that of `kalker_coefficients`
        real(wp), intent(in), optional :: finer
            !! what would be estimated of so many times as many strips, with `points` along each and
            !! this certificate; default 1

        type(patch_ellipse_t) :: ellipse
        type(patch_law_t) :: law
        real(wp) :: part(3), total(3), load, area, u(3), times
        integer :: first, last

        times = 1.0_wp
        if (present(finer)) times = finer
        total = 0.0_wp
        load = 0.0_wp
        area = 0.0_wp
        last = 0
        do while (last < strips%n)
            first = last + 1
            last = last_of_patch(strips, first)
            ellipse = patch_ellipse(strips, first, last)
            call find_law(ellipse, material, mu, creepage, law, status, u)
            if (is_error(status)) return
            if (law%weight <= 0.0_wp) cycle
            part = ellipse%load*errors_of_patch(patch_shape(strips, first, last, ellipse), u, &
                                                method, times*(last - first + 1), points, &
                                                certificate)
            total = total + [part(1), part(2), &
                             part(3)*sqrt(ellipse%a*ellipse%b) + abs(ellipse%y)*part(1)]
            load = load + ellipse%load
            area = area + pi*ellipse%a*ellipse%b
        end do
        if (load <= 0.0_wp) return
        errors = force_errors_t(total(1)/load, total(2)/load, total(3)/(load*sqrt(area/pi)))
    end subroutine estimate_force_errors

    !> Errors of one patch, the moment about its centroid over mu N sqrt(ab).
    pure function errors_of_patch(shape, u, method, strips, points, certificate) result(errors)
        type(patch_shape_t), intent(in) :: shape
        real(wp), intent(in) :: u(3)
        integer, intent(in) :: method, points
        real(wp), intent(in) :: strips ! as if there were so many
        type(certificate_t), intent(in) :: certificate
        real(wp) :: errors(3)

        real(wp) :: unlike

        unlike = norm2(shape%even) + norm2(shape%odd)
        errors = 0.01_wp*method + 0.05_wp*unlike + 1.0_wp/strips**2 + 1.0_wp/points**2 &
                 + 0.5_wp*certificate%est_err_pmax
        errors = errors*norm2(u)/(1.0_wp + norm2(u))
    end function errors_of_patch
end module faststrip_tangential_force_errors
