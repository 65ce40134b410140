!> The contacts on which claims are judged: contact `number` of a kind is always the same one.
!> Most are drawn; ellipses are those of `reference/contact/hertz_creep.csv`, by their rows.
!>
!> Loads, friction and materials are round numbers, so that they stand in the table of references as
!> they are solved; creepages are drawn when the patch is known.
module faststrip_lab_claims_contacts
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, &
                                     number_text, count_text, st_out_of_range
    use faststrip_base_text, only: parse_real
    use faststrip_base_creepage, only: creepage_t
    use faststrip_base_material, only: material_t, normal_compliance, combined_shear_modulus, &
                                       combined_poisson_ratio
    use faststrip_contact_case, only: contact_case_t
    use faststrip_normal_simple_patch_ellipse, only: patch_ellipse_t
    use faststrip_normal_strips, only: contact_strips_t
    use faststrip_tangential_kalker, only: kalker_coefficients_t, kalker_coefficients
    use faststrip_lab_grid_cases, only: bench_case_t
    use faststrip_lab_pressures, only: largest_patch
    use faststrip_lab_random_numbers, only: random_t, start_random, uniform, log_uniform, chance
    use faststrip_lab_random_claim_gaps, only: draw_claim_gap, gap_kinds
    use faststrip_lab_claims_wheelsets, only: draw_wheelset_gap
    implicit none
    private

    public :: claim_contact_t, find_claim_contact, draw_claim_creepages
    public :: claim_kinds, states_drawn

    !> What the kinds of contacts are called.
    character(len=12), parameter :: claim_kinds(3 + size(gap_kinds)) = &
        [[character(len=12) :: 'ellipse', 'new_wheel', 'worn_wheel'], gap_kinds]
    !> Creepages of one contact.
    integer, parameter :: states_drawn = 2

    ! Far from the seeds of the data that is fitted.
    integer, parameter :: seed = 20260101
    real(wp), parameter :: youngs = 2.1e5_wp, steel = 0.28_wp ! MPa, -

    !> One contact.
    type, extends(contact_case_t) :: claim_contact_t
        integer :: kind = 0             !! index of `claim_kinds`
        integer :: number = 0           !! of the kind, from 1
        type(random_t) :: random        !! for the creepages
        logical :: has_motion = .false. !! is `creepage` that of a wheelset?
    end type claim_contact_t

contains

    !> A contact, if it is drawn but for its creepages.
    subroutine find_claim_contact(ellipses, kind, number, contact, status)
        type(bench_case_t), intent(in) :: ellipses(:)   !! of CONTACT
        integer, intent(in) :: kind                     !! index of `claim_kinds`
        integer, intent(in) :: number                   !! from 1
        type(claim_contact_t), intent(out) :: contact !! gap, load, material, friction
        type(status_t), intent(out) :: status           !! `st_out_of_range`: no such number

        call clear_status(status)
        contact%kind = kind
        contact%number = number
        if (claim_kinds(kind) /= 'ellipse') then
            call draw_contact(contact)
        else if (number > size(ellipses)) then
            call set_status(status, st_out_of_range, 'there is no ellipse ' &
                            // count_text(number))
        else
            contact%contact_case_t = ellipses(number)%contact_case_t
        end if
    end subroutine find_claim_contact

    subroutine draw_contact(contact)
        type(claim_contact_t), intent(inout) :: contact ! kind and number

        real(wp) :: poisson

        call start_random(seed + contact%kind, contact%number, contact%random)
        contact%load = rounded(log_uniform(contact%random, 1.0e4_wp, 1.5e5_wp))
        contact%mu = rounded(uniform(contact%random, 0.1_wp, 0.6_wp))
        poisson = steel
        if (chance(contact%random, 0.3_wp)) &
            poisson = rounded(uniform(contact%random, 0.2_wp, 0.35_wp))
        contact%material = material_t(youngs, youngs, poisson, poisson)
        associate (kind => claim_kinds(contact%kind))
            contact%has_motion = index(kind, 'wheel') > 0
            if (contact%has_motion) then
                call draw_wheelset_gap(contact%random, kind == 'worn_wheel', contact%gap, &
                                       contact%creepage)
            else
                call draw_claim_gap(contact%random, kind, normal_compliance(contact%material), &
                                      contact%load, contact%gap)
            end if
        end associate
    end subroutine draw_contact

    !> Draw creepages: linear forces of the largest patch between a twentieth of mu N and a
    !> hundred times that, one state about the onset of sliding, the other from there to full
    !> sliding; in two of three states with spin. The first state of a wheelset is that of its
    !> motion.
    subroutine draw_claim_creepages(contact, strips, creepages, status)
        type(claim_contact_t), intent(inout) :: contact !! drawn
        type(contact_strips_t), intent(in) :: strips      !! its normal solution
        type(creepage_t), intent(out) :: creepages(states_drawn) !! about y = 0
        type(status_t), intent(out) :: status             !! from `kalker_coefficients`

        type(patch_ellipse_t) :: ellipse
        type(kalker_coefficients_t) :: c
        real(wp) :: unit, size_of, direction, spin
        integer :: i

        ellipse = largest_patch(strips)
        call kalker_coefficients(ellipse%a/ellipse%b, combined_poisson_ratio(contact%material), c, &
                                 status)
        if (is_error(status)) return
        unit = contact%mu*ellipse%load &
               /(combined_shear_modulus(contact%material)*ellipse%a*ellipse%b)
        do i = 1, states_drawn
            associate (creepage => creepages(i))
                if (i == 1) then
                    size_of = log_uniform(contact%random, 0.05_wp, 3.0_wp)
                else
                    size_of = log_uniform(contact%random, 0.5_wp, 100.0_wp)
                end if
                direction = uniform(contact%random, -pi, pi)
                spin = uniform(contact%random, -1.0_wp, 1.0_wp)
                if (chance(contact%random, 1.0_wp/3.0_wp)) spin = 0.0_wp
                creepage%cphi = rounded(size_of*spin*unit/(c%c23*sqrt(ellipse%a*ellipse%b)))
                size_of = size_of*sqrt(1.0_wp - spin**2)
                ! What the spin makes of longitudinal creepage at the patch is no part of the draw.
                creepage%cksi = rounded(size_of*cos(direction)*unit/c%c11 &
                                        + ellipse%y*creepage%cphi)
                creepage%ceta = rounded(size_of*sin(direction)*unit/c%c22)
            end associate
        end do
        if (.not. contact%has_motion) return
        creepages(1) = creepage_t(rounded(contact%creepage%cksi), rounded(contact%creepage%ceta), &
                                  rounded(contact%creepage%cphi))
    end subroutine draw_claim_creepages

    !> The number as a table of results has it: six digits.
    real(wp) function rounded(value)
        real(wp), intent(in) :: value !! a finite number

        logical :: is_valid

        call parse_real(trim(number_text(value)), rounded, is_valid)
    end function rounded
end module faststrip_lab_claims_contacts
