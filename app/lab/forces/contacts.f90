!> The contacts of `faststrip-lab force-data`: contact `number` of a seed is always the same one.
module faststrip_lab_forces_contacts
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error
    use faststrip_base_creepage, only: creepage_t
    use faststrip_base_material, only: material_t, normal_compliance, combined_shear_modulus, &
                                       combined_poisson_ratio
    use faststrip_contact_case, only: contact_case_t
    use faststrip_normal_simple_patch_ellipse, only: patch_ellipse_t, patch_ellipse
    use faststrip_normal_strips, only: contact_strips_t
    use faststrip_tangential_kalker, only: kalker_coefficients_t, kalker_coefficients
    use faststrip_lab_random_numbers, only: random_t, start_random, uniform, chance, normal
    use faststrip_lab_random_force_gaps, only: draw_force_gap, force_family
    implicit none
    private

    public :: force_contact_t, draw_force_contact, draw_force_creepages

    ! Strips across the patch, as a user has them.
    integer, parameter :: strips_across = 15
    real(wp), parameter :: youngs = 2.1e5_wp ! MPa
    ! Chance that a creepage is zero.
    real(wp), parameter :: none = 0.12_wp
    ! Powers of ten between which linear forces over mu N lie, and for one state of each contact.
    real(wp), parameter :: least = -1.0_wp, most = 1.3_wp, most_of_one = 2.0_wp

    !> One contact; its creepages are drawn when its strips are known.
    type, extends(contact_case_t) :: force_contact_t
        integer :: seed = 0      !! of the series
        integer :: number = 0    !! from 1
        integer :: family = 0    !! index of `force_families`
        type(random_t) :: random !! for the creepages
    end type force_contact_t

contains

    !> Draw a contact.
    subroutine draw_force_contact(seed, number, contact, family)
        integer, intent(in) :: seed                   !! >= 0
        integer, intent(in) :: number                 !! from 1
        type(force_contact_t), intent(out) :: contact !! drawn
        integer, intent(in) :: family                 !! index of `force_families`; 0: in turn

        real(wp) :: poisson

        call start_random(seed, number, contact%random)
        contact%seed = seed
        contact%number = number
        contact%family = force_family(number)
        if (family > 0) contact%family = family
        contact%load = 10.0_wp**uniform(contact%random, 3.7_wp, 5.2_wp)
        contact%mu = uniform(contact%random, 0.1_wp, 0.6_wp)
        poisson = uniform(contact%random, 0.2_wp, 0.35_wp)
        contact%material = material_t(youngs, youngs, poisson, poisson)
        contact%methods%strips_per_patch = strips_across
        contact%estimate = .false.
        call draw_force_gap(contact%random, contact%family, normal_compliance(contact%material), &
                            contact%load, contact%gap)
    end subroutine draw_force_contact

    !> Draw creepages of any direction about the centroid of a patch, in units of those whose
    !> linear forces on its ellipse are mu N; they are given about y = 0.
    subroutine draw_force_creepages(contact, strips, creepages, status)
        type(force_contact_t), intent(inout) :: contact !! drawn
        type(contact_strips_t), intent(in) :: strips    !! its normal solution, one patch
        type(creepage_t), intent(out) :: creepages(:)
        type(status_t), intent(out) :: status           !! from `kalker_coefficients`

        type(patch_ellipse_t) :: ellipse
        type(kalker_coefficients_t) :: c
        real(wp) :: unit, u(3)
        integer :: i

        ellipse = patch_ellipse(strips, 1, strips%n)
        call kalker_coefficients(ellipse%a/ellipse%b, combined_poisson_ratio(contact%material), c, &
                                 status)
        if (is_error(status)) return
        unit = contact%mu*contact%load/(combined_shear_modulus(contact%material) &
                                        *ellipse%a*ellipse%b)
        do i = 1, size(creepages)
            call draw_direction(contact%random, u)
            u = u*10.0_wp**uniform(contact%random, least, &
                                   merge(most_of_one, most, i == size(creepages)))
            creepages(i)%cphi = u(3)*unit/(c%c23*sqrt(ellipse%a*ellipse%b))
            creepages(i)%ceta = u(2)*unit/c%c22
            creepages(i)%cksi = u(1)*unit/c%c11 + ellipse%y*creepages(i)%cphi
        end do
    end subroutine draw_force_creepages

    !> A direction in space, now and then in a plane or along an axis.
    subroutine draw_direction(random, u)
        type(random_t), intent(inout) :: random
        real(wp), intent(out) :: u(3) ! length 1

        integer :: i

        do
            do i = 1, 3
                u(i) = normal(random)
                if (chance(random, none)) u(i) = 0.0_wp
            end do
            if (any(u /= 0.0_wp)) exit
        end do
        u = u/norm2(u)
    end subroutine draw_direction
end module faststrip_lab_forces_contacts
