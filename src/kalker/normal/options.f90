!> What the user of NORM chooses, and what it refuses.
module faststrip_kalker_normal_options
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_kinds, only: wp
    use faststrip_base_limits, only: nothing, too_large
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, number_text, &
                                     st_bad_argument, st_bad_load, st_no_contact, st_not_finite, &
                                     st_out_of_range
    use faststrip_base_material, only: check_compliance
    use faststrip_normal_types, only: demand_t
    use faststrip_contact_methods, only: usual_side
    use faststrip_kalker_normal_solver, only: usual_tolerance, most_iterations
    implicit none
    private

    public :: norm_options_t, norm_most_elements
    public :: check_options, check_numbers, check_load, check_heights, fitting_side
    public :: fewest_elements

    !> Most elements of a grid, in contact or not, unless the options say otherwise.
    !> Tuned [elements]. Origin: capacity.
    integer, parameter :: norm_most_elements = 4000000

    !> Fewest elements across half a contact, or all of a patch, that show its pressures.
    !> Tuned [elements]. Origin: chosen: pmax within 1 %.
    integer, parameter :: fewest_elements = 6

    !> What the user chooses.
    type :: norm_options_t
        real(wp) :: dx = usual_side       !! side of the elements along x, mm
        real(wp) :: dy = usual_side       !! side of the elements along y, mm
        logical :: fits_dx = .false.      !! is it shorter where the contact is small?
        logical :: fits_dy = .false.      !! see `fitting_side`
        real(wp) :: error_target = 0.0_wp !! estimated relative error of penetration and largest
                                          !! pressure; the sides are chosen if it is positive
        logical :: two_levels = .true.    !! solve with sides twice as long before: a better start
                                          !! and an estimate of the errors
        real(wp) :: tolerance = usual_tolerance !! largest |gap| in contact over the approach
        integer :: max_iterations = most_iterations !! of conjugate gradients on one grid
        logical :: warm_start = .false.   !! from the last solution of this workspace, if any
        logical :: preconditioned = .true. !! or plain conjugate gradients?
        integer :: most_elements = norm_most_elements !! of a grid
    end type norm_options_t

contains

    !> The side that was meant, if half the contact holds six of it; else a twelfth of that, for
    !> the area, which is counted.
    pure real(wp) function fitting_side(side, half)
        real(wp), intent(in) :: side !! that was meant, mm
        real(wp), intent(in) :: half !! half the contact's length or width, mm

        fitting_side = merge(side, half/(2*fewest_elements), half >= fewest_elements*side)
    end function fitting_side

    !> Refuse a compliance, sides, an error target or a tolerance that cannot be.
    pure subroutine check_options(compliance, options, status)
        real(wp), intent(in) :: compliance          !! H of eq. (4), 1/MPa
        type(norm_options_t), intent(in) :: options !! what was chosen
        type(status_t), intent(out) :: status       !! `st_bad_material`, `st_not_finite`,
                                                    !! `st_bad_argument`, `st_out_of_range`

        call check_numbers(compliance, options, status)
        if (is_error(status)) return
        if (.not. all(ieee_is_finite([options%dx, options%dy, options%error_target]))) then
            call set_status(status, st_not_finite, 'a side of the elements or the error target ' &
                            //'is not a finite number')
        else if (min(options%dx, options%dy) <= 0.0_wp) then
            call set_status(status, st_bad_argument, 'sides of the elements must be above 0, got ' &
                            //trim(number_text(options%dx))//' by ' &
                            //trim(number_text(options%dy))//' mm')
        else if (min(options%dx, options%dy) < nothing &
                 .or. max(options%dx, options%dy) > too_large) then
            call set_status(status, st_out_of_range, 'elements must be at most 1e60 mm long')
        else if (options%error_target < 0.0_wp) then
            call set_status(status, st_bad_argument, 'the error target must not be negative, got ' &
                            //number_text(options%error_target))
        end if
    end subroutine check_options

    !> The same without sides and error target.
    pure subroutine check_numbers(compliance, options, status)
        real(wp), intent(in) :: compliance          !! H of eq. (4), 1/MPa
        type(norm_options_t), intent(in) :: options !! what was chosen
        type(status_t), intent(out) :: status       !! `st_bad_material`, `st_not_finite`,
                                                    !! `st_bad_argument`, `st_out_of_range`

        call check_compliance(compliance, status)
        if (is_error(status)) return
        if (compliance < nothing .or. compliance > too_large) then
            call set_status(status, st_out_of_range, 'the compliance is beyond all proportion: ' &
                            //number_text(compliance))
        else if (.not. ieee_is_finite(options%tolerance)) then
            call set_status(status, st_not_finite, &
                            'the tolerance must be a finite number, got ' &
                            //number_text(options%tolerance))
        else if (options%tolerance <= 0.0_wp .or. options%tolerance >= 1.0_wp) then
            call set_status(status, st_bad_argument, &
                            'the tolerance must be between 0 and 1, got ' &
                            //number_text(options%tolerance))
        else if (options%max_iterations < 1 .or. options%most_elements < 1) then
            call set_status(status, st_bad_argument, 'no iterations or no elements allowed')
        end if
    end subroutine check_numbers

    !> Refuse a load that cannot be.
    pure subroutine check_load(load, status)
        real(wp), intent(in) :: load          !! N
        type(status_t), intent(out) :: status !! `st_not_finite`, `st_bad_load`, `st_out_of_range`

        call clear_status(status)
        if (.not. ieee_is_finite(load)) then
            call set_status(status, st_not_finite, &
                            'the load must be a finite number, got '//number_text(load))
        else if (load <= 0.0_wp) then
            call set_status(status, st_bad_load, &
                            'the load must be above 0, got '//trim(number_text(load))//' N')
        else if (load < nothing .or. load > too_large) then
            call set_status(status, st_out_of_range, 'the load is beyond all proportion: ' &
                            //trim(number_text(load))//' N')
        end if
    end subroutine check_load

    !> Refuse heights that cannot be, or on which the bodies do not meet.
    pure subroutine check_heights(height, demand, options, status)
        real(wp), intent(in) :: height(:, :)        !! undeformed gap at the elements' middles, mm
        type(demand_t), intent(in) :: demand        !! load, or penetration from zero height
        type(norm_options_t), intent(in) :: options !! with the most elements
        type(status_t), intent(out) :: status
            !! those of `check_load`, `st_bad_argument`, `st_no_contact`

        integer :: j

        call clear_status(status)
        if (min(size(height, 1), size(height, 2)) < 1) then
            call set_status(status, st_bad_argument, 'the grid has no elements, or without sides')
        else if (size(height, 1)*real(size(height, 2), wp) > options%most_elements) then
            call set_status(status, st_out_of_range, 'the grid has more elements than allowed')
        end if
        if (is_error(status)) return
        do j = 1, size(height, 2)
            if (all(ieee_is_finite(height(:, j)))) cycle
            call set_status(status, st_not_finite, 'a height of the grid is not a finite number')
            return
        end do
        if (demand%by_load) then
            call check_load(demand%load, status)
            if (is_error(status)) return
        else if (.not. ieee_is_finite(demand%penetration)) then
            call set_status(status, st_not_finite, 'the penetration must be a finite number, got ' &
                            //number_text(demand%penetration))
            return
        else if (demand%penetration <= minval(height)) then
            call set_status(status, st_no_contact, 'the bodies do not touch: penetration ' &
                            //trim(number_text(demand%penetration))//' mm, lowest gap ' &
                            //trim(number_text(minval(height)))//' mm')
            return
        end if
        if (maxval(abs(height)) > too_large) &
            call set_status(status, st_out_of_range, 'a height of the grid is beyond 1e60 mm')
    end subroutine check_heights
end module faststrip_kalker_normal_options
