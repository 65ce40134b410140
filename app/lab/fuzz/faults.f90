!> Errors planted in answers, to see that the checks of `faststrip-lab fuzz` find them.
!>
!> They are put in after the solution and before it is checked, into every answer, those that the
!> checks ask for by themselves among them: what a wrong solver would hand over.
module faststrip_lab_fuzz_faults
    use faststrip_base_kinds, only: wp
    use faststrip_normal_types, only: normal_result_t
    use faststrip_normal_strips, only: contact_strips_t
    use faststrip_tangential_types, only: tangential_result_t
    use faststrip_geometry_gap_curve, only: gap_curve_t
    implicit none
    private

    public :: plant_fault, plant_force_fault, fault_names

    !> What can be planted.
    character(len=20), parameter :: fault_names(30) = [character(len=20) :: &
        'penetration_low', 'penetration_high', 'penetration_slight', 'penetration_below', &
        'penetration_size', 'pmax_half', 'pmax_high', 'area_double', 'area_low', 'traded', &
        'traded_back', 'traded_all', 'pressures_high', 'pressures_uneven', 'lengths_uneven', &
        'shifted', 'widened', 'ends_exchanged', 'length_low', 'load_high', 'patch_lost', &
        'patches_wrong', 'force_high', 'force_half', 'fx_sign', 'fy_sign', 'mz_sign', &
        'fy_even', 'fx_offset', 'power_sign']

contains

    !> Spoil a normal solution; a name that is not about it changes nothing.
    pure subroutine plant_fault(name, curve, strips, result)
        character(len=*), intent(in) :: name             !! one of `fault_names`, or blank
        type(gap_curve_t), intent(in) :: curve           !! of the gap
        type(contact_strips_t), intent(inout) :: strips  !! of the solution
        type(normal_result_t), intent(inout) :: result   !! its figures

        real(wp) :: depth, middle, share
        integer :: k, n

        n = strips%n
        if (n < 1) return
        depth = result%penetration - curve%h_lowest
        associate (p0 => strips%p0(:n), xd => strips%half_length(:n), left => strips%y_left(:n), &
                   right => strips%y_right(:n))
            select case (name)
            case ('penetration_low')
                result%penetration = curve%h_lowest + 0.9_wp*depth
            case ('penetration_high')
                result%penetration = curve%h_lowest + 1.05_wp*depth
            case ('penetration_slight')
                result%penetration = curve%h_lowest + 1.002_wp*depth
            case ('penetration_below')
                result%penetration = curve%h_lowest - depth
            case ('penetration_size')
                result%penetration = result%penetration + 1.0e-6_wp
            case ('pmax_half')
                result%pmax = 0.5_wp*result%pmax
            case ('pmax_high')
                result%pmax = 1.1_wp*result%pmax
            case ('area_double')
                result%area = 2.0_wp*result%area
            case ('area_low')
                result%area = 0.8_wp*result%area
            case ('traded', 'traded_back', 'traded_all')
                share = merge(0.9_wp, 1.1_wp, name == 'traded_back')
                p0 = share*p0
                xd = xd/share
                if (name == 'traded_all') then
                    result%pmax = share*result%pmax
                    result%area = result%area/share
                    result%x_max = result%x_max/share
                end if
            case ('pressures_high')
                p0 = 1.03_wp*p0
                result%pmax = 1.03_wp*result%pmax
            case ('pressures_uneven', 'lengths_uneven')
                ! More on the left, less on the right.
                middle = 0.5_wp*(left(1) + right(n))
                do k = 1, n
                    share = 1.0_wp + 0.03_wp*(middle - 0.5_wp*(left(k) + right(k))) &
                            /(right(n) - left(1))
                    if (name == 'pressures_uneven') p0(k) = share*p0(k)
                    if (name == 'lengths_uneven') xd(k) = share*xd(k)
                end do
            case ('shifted')
                middle = 0.02_wp*(right(n) - left(1))
                left = left + middle
                right = right + middle
                result%y_min = result%y_min + middle
                result%y_max = result%y_max + middle
            case ('widened')
                middle = 0.5_wp*(left(1) + right(n))
                left = middle + 1.02_wp*(left - middle)
                right = middle + 1.02_wp*(right - middle)
                p0 = p0/1.02_wp
                result%y_min = left(1)
                result%y_max = right(n)
            case ('ends_exchanged')
                middle = result%y_min
                result%y_min = result%y_max
                result%y_max = middle
            case ('length_low')
                result%x_max = 0.97_wp*result%x_max
            case ('load_high')
                result%load = 1.001_wp*result%load
            case ('patch_lost')
                if (strips%n_patches > 1) &
                    strips%n = count(strips%patch(:n) < strips%n_patches)
            case ('patches_wrong')
                result%n_patches = result%n_patches + 1
            end select
        end associate
    end subroutine plant_fault

    !> Spoil creep forces; a name that is not about them changes nothing.
    pure subroutine plant_force_fault(name, forces)
        character(len=*), intent(in) :: name               !! one of `fault_names`, or blank
        type(tangential_result_t), intent(inout) :: forces

        select case (name)
        case ('force_high', 'force_half')
            forces%fx = merge(1.1_wp, 0.5_wp, name == 'force_high')*forces%fx
            forces%fy = merge(1.1_wp, 0.5_wp, name == 'force_high')*forces%fy
        case ('fx_sign')
            forces%fx = -forces%fx
        case ('fy_sign')
            forces%fy = -forces%fy
        case ('mz_sign')
            forces%mz = -forces%mz
        case ('fy_even')
            forces%fy = abs(forces%fy)
        case ('fx_offset')
            forces%fx = forces%fx - 1.0e-3_wp*abs(forces%fy)
        case ('power_sign')
            forces%friction_power = -forces%friction_power
        end select
    end subroutine plant_force_fault
end module faststrip_lab_fuzz_faults
