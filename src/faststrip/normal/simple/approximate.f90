!> What the approximate normal methods, KPEC and ANALYN, share: the checks of what is asked, the
!> search for the penetration of a load, and the strips they hand over.
!>
!> These methods give a contact for a penetration. The penetration of a load is searched for with
!> the logarithms of both, which a Hertz contact joins by a straight line.
module faststrip_normal_simple_approximate
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_limits, only: most_steps
    use faststrip_base_material, only: check_compliance
    use faststrip_base_status, only: status_t, set_status, add_limitation, is_error, number_text, &
                                     count_text, st_bad_argument, st_bad_load, st_not_finite, &
                                     st_no_contact, st_no_convergence, st_workspace_too_small, &
                                     st_under_resolved
    use faststrip_geometry_gap_curve, only: gap_curve_t
    use faststrip_normal_limitations, only: check_curvature, check_depth, check_lowest, &
                                            name_limitations, name_steps
    use faststrip_normal_strip_patches, only: max_patches, fewest_strips
    use faststrip_normal_strips, only: contact_strips_t, strips_load
    use faststrip_normal_types, only: demand_t, normal_result_t
    implicit none
    private

    public :: zone_t, check_approximate, finish_approximate, lowest_between, find_end
    public :: load_search_t, start_search, next_penetration
    public :: gauss_place, gauss_weight

    !> Most patches of a contact.
    integer, parameter, public :: most_zones = max_patches

    !> How near the load is to come; the pressures make up for the rest.
    !> Tuned [1]. Origin: chosen: far below the errors of the methods.
    real(wp), parameter, public :: close_enough = 1.0e-8_wp
    ! A change of the load by more is a jump: patches met or parted.
    ! Tuned [1]. Origin: chosen: far above close_enough.
    real(wp), parameter :: jump = 1.0e-5_wp
    ! The penetration tried first, over the square root of load times compliance: 0.1 mm at 100 kN
    ! on steel.
    ! Tuned [1]. Origin: 0.1 mm at 100 kN on steel.
    real(wp), parameter :: first_penetration = 0.2_wp
    ! The exponent of load over penetration.
    ! Given: Hertz.
    real(wp), parameter :: hertz_slope = 1.5_wp
    ! Tuned [1]: Exponents of a secant over it, or the reverse. Origin: safeguard: plane contacts
    ! have less than one, edges more than two.
    real(wp), parameter :: most_of_slope = 4.0_wp

    !> Gauss's rule of eight points on (0, 1).
    !> Given: Gauss
    real(wp), parameter :: gauss_place(8) = &
        0.5_wp + [-0.4801449282487681_wp, -0.3983332387068134_wp, -0.2627662049581645_wp, &
                  -0.0917173212478249_wp, 0.0917173212478249_wp, 0.2627662049581645_wp, &
                  0.3983332387068134_wp, 0.4801449282487681_wp], &
        gauss_weight(8) = [0.0506142681451881_wp, 0.1111905172266872_wp, 0.1568533229389437_wp, &
                           0.1813418916891810_wp, 0.1813418916891810_wp, 0.1568533229389437_wp, &
                           0.1111905172266872_wp, 0.0506142681451881_wp]
    ! Half the distance of the two points in a strip, over its width.
    ! Given: Gauss
    real(wp), parameter :: half_distance = 0.5_wp/sqrt(3.0_wp)
    ! Tuned [points]: where a patch's length is looked at for its area. Origin: chosen: with half
    ! area and pmax of ANALYN change by up to 2 % and 14 % in 20 contacts S1002/UIC60, with twice as
    ! many those of KPEC by 0.01 % and 0.7 %.
    integer, parameter :: area_points = 24
    ! Tuned [1]: how well an end is found, over the distance it is looked for in. Origin: chosen:
    ! far below the methods' errors.
    real(wp), parameter :: end_tolerance = 1.0e-9_wp
    ! Share of a value that a chord has to take off, or the middle is tried next.
    ! Tuned [1]. Origin: chosen for the time: half and double move forces in the tenth digit.
    real(wp), parameter :: creeping = 0.1_wp

    !> One patch, by a method that knows its length and pressure at every y.
    type, abstract :: zone_t
        real(wp) :: y_from = 0.0_wp, y_to = 0.0_wp !! ends, mm
        real(wp) :: y_low = 0.0_wp                 !! where the gap is lowest between them, mm
        real(wp) :: load = 0.0_wp                  !! N
    contains
        procedure(find_row), deferred :: row
    end type zone_t

    abstract interface
        !> The pressure along x at one y.
        pure subroutine find_row(zone, curve, y, left, square, p0)
            import :: zone_t, gap_curve_t, wp
            class(zone_t), intent(in) :: zone
            type(gap_curve_t), intent(in) :: curve !! the gap
            real(wp), intent(in) :: y              !! mm
            real(wp), intent(out) :: left          !! positive in the patch, zero at its ends, mm
            real(wp), intent(out) :: square        !! half-length squared; 0 outside; mm2
            real(wp), intent(out) :: p0            !! maximum pressure, MPa
        end subroutine find_row
    end interface

    !> The search for the penetration of a load, by secants within a bracket.
    type :: load_search_t
        real(wp) :: penetration = 0.0_wp !! to be tried next, above the lowest height, mm
        real(wp) :: load = 0.0_wp        !! wanted, N
        real(wp) :: tolerance = close_enough !! how near it is to come, relative
        integer :: steps = 0             !! tried so far
        ! ln(penetration) and ln(load over the wanted one), of the last try.
        real(wp) :: x = 0.0_wp, y = 0.0_wp
        ! ln(penetration) known to give too small a load, and too large a one.
        ! Given: nothing is known yet.
        real(wp) :: low = -huge(1.0_wp), high = huge(1.0_wp)
    end type load_search_t

contains

    !> Check what is asked, and find how deep the contact is to be.
    pure subroutine check_approximate(curve, compliance, demand, n, strips, depth, status)
        type(gap_curve_t), intent(in) :: curve       !! a gap that was set
        real(wp), intent(in) :: compliance           !! H of eq. (4), 1/MPa
        type(demand_t), intent(in) :: demand         !! load or penetration
        integer, intent(in) :: n                     !! strips of the widest patch
        type(contact_strips_t), intent(in) :: strips !! to be filled
        real(wp), intent(out) :: depth !! above the lowest height if that is given, else 0, mm
        type(status_t), intent(out) :: status
            !! `st_bad_argument` (n < 1), `st_not_finite`, `st_bad_load`, `st_bad_material`,
            !! `st_no_contact`, `st_no_finite_patch`, `st_workspace_too_small`

        real(wp) :: number

        depth = 0.0_wp
        call check_compliance(compliance, status)
        if (is_error(status)) return
        number = merge(demand%load, demand%penetration, demand%by_load)
        if (n < 1) then
            call set_status(status, st_bad_argument, 'strips per patch must be at least 1, got ' &
                            // count_text(n))
        else if (curve%n == 0) then
            call set_status(status, st_workspace_too_small, 'no gap was set')
        else if (.not. allocated(strips%p0)) then
            call set_status(status, st_workspace_too_small, 'no workspace was reserved for strips')
        else if (size(strips%p0) < max(n, most_zones)) then
            call set_status(status, st_workspace_too_small, 'too little capacity for the strips')
        else if (.not. ieee_is_finite(number)) then
            call set_status(status, st_not_finite, 'load or penetration must be a finite ' // &
                            'number, got ' // number_text(number))
        else if (demand%by_load) then
            if (demand%load <= 0.0_wp) &
                call set_status(status, st_bad_load, 'the load must be above 0, got ' // &
                                trim(number_text(demand%load)) // ' N')
        else
            depth = demand%penetration - curve%h_lowest
            if (depth <= 0.0_wp) then
                call set_status(status, st_no_contact, 'the bodies do not touch: penetration ' &
                                // trim(number_text(demand%penetration)) // ' mm, lowest gap ' &
                                // trim(number_text(curve%h_lowest)) // ' mm')
            else
                call check_depth(depth, status)
            end if
        end if
        if (.not. is_error(status)) call check_curvature(curve, status)
    end subroutine check_approximate

    !> Begin the search for the penetration of a load.
    pure subroutine start_search(compliance, load, tolerance, search)
        real(wp), intent(in) :: compliance         !! H of eq. (4), 1/MPa
        real(wp), intent(in) :: load               !! wanted, N
        real(wp), intent(in) :: tolerance          !! how near it is to come, relative
        type(load_search_t), intent(out) :: search !! with the first penetration

        search%load = load
        search%tolerance = tolerance
        search%penetration = first_penetration*sqrt(compliance)*sqrt(load)
    end subroutine start_search

    !> Take the load of the penetration that was tried, and say which to try next, if any.
    pure subroutine next_penetration(load, search, again)
        real(wp), intent(in) :: load                 !! of `search%penetration`, N
        type(load_search_t), intent(inout) :: search !! with the next penetration
        logical, intent(out) :: again                !! is that to be tried?

        real(wp) :: x, y, slope, guess

        x = log(search%penetration)
        y = -1.0_wp
        if (load > 0.0_wp) y = log(load/search%load)
        search%steps = search%steps + 1
        again = abs(y) > search%tolerance .and. search%steps < most_steps
        if (.not. again) return
        slope = hertz_slope
        if (search%steps > 1 .and. x /= search%x) &
            slope = max(hertz_slope/most_of_slope, &
                        min((y - search%y)/(x - search%x), hertz_slope*most_of_slope))
        guess = x - y/slope
        if (y < 0.0_wp) then
            search%low = max(search%low, x)
        else
            search%high = min(search%high, x)
        end if
        if (guess <= search%low .or. guess >= search%high) &
            guess = search%low + 0.5_wp*(search%high - search%low)
        search%x = x
        search%y = y
        ! Until no number lies between.
        again = guess > search%low .and. guess < search%high
        if (again) search%penetration = exp(guess)
    end subroutine next_penetration

    !> Where a gap is lowest between two places: at its lowest point, an end of its monotone pieces,
    !> or one of the places.
    pure subroutine lowest_between(curve, y_from, h_from, y_to, h_to, y, h)
        type(gap_curve_t), intent(in) :: curve !! a gap that was set
        real(wp), intent(in) :: y_from, h_from !! left place and the height there, mm
        real(wp), intent(in) :: y_to, h_to     !! right place and the height there, mm
        real(wp), intent(out) :: y, h          !! the lowest place and its height, mm

        integer :: i, above, middle

        y = curve%y_lowest
        h = curve%h_lowest
        if (y >= y_from .and. y <= y_to) return
        y = merge(y_from, y_to, h_from <= h_to)
        h = min(h_from, h_to)
        i = 0
        above = curve%n_pieces + 2
        do while (above - i > 1)
            middle = (i + above)/2
            if (curve%y_node(middle) < y_from) then
                i = middle
            else
                above = middle
            end if
        end do
        do i = above, curve%n_pieces + 1
            if (curve%y_node(i) > y_to) return
            if (curve%h_node(i) >= h) cycle
            y = curve%y_node(i)
            h = curve%h_node(i)
        end do
    end subroutine lowest_between

    !> The end of a patch between a place inside and one outside.
    pure real(wp) function find_end(curve, zone, y_inside, y_outside) result(y)
        type(gap_curve_t), intent(in) :: curve !! the gap
        class(zone_t), intent(in) :: zone      !! the patch; its ends do not count yet
        real(wp), intent(in) :: y_inside       !! where `left` is positive, mm
        real(wp), intent(in) :: y_outside      !! where it is not, mm

        real(wp) :: inside, outside, f_inside, f_outside, f, square, p0
        logical :: halve
        integer :: i

        inside = y_inside
        outside = y_outside
        call zone%row(curve, inside, f_inside, square, p0)
        call zone%row(curve, outside, f_outside, square, p0)
        halve = .false.
        y = outside
        do i = 1, most_steps
            if (abs(outside - inside) <= end_tolerance*abs(y_outside - y_inside)) exit
            y = 0.5_wp*(inside + outside)
            if (.not. halve) y = inside + (outside - inside)*(f_inside/(f_inside - f_outside))
            call zone%row(curve, y, f, square, p0)
            halve = .not. halve &
                    .and. abs(f) > creeping*merge(f_inside, abs(f_outside), f > 0.0_wp)
            if (f > 0.0_wp) then
                inside = y
                f_inside = f
            else
                outside = y
                f_outside = f
            end if
        end do
    end function find_end

    !> Strips of each patch, in proportion to its width.
    pure subroutine share_zones(strips_per_patch, capacity, widths, n_strips)
        integer, intent(in) :: strips_per_patch ! of the widest
        integer, intent(in) :: capacity         ! for all, at least one for each patch
        real(wp), intent(in) :: widths(:)       ! of the patches, mm
        integer, intent(out) :: n_strips(:)     ! of each

        n_strips = max(min(fewest_strips, strips_per_patch), &
                       nint(strips_per_patch*(widths/maxval(widths))))
        n_strips = min(n_strips, capacity/size(widths))
    end subroutine share_zones

    !> Cut the patches into strips of equal width, and fill area, maximum pressure and length.
    pure subroutine put_strips(curve, zones, strips_per_patch, strips, result)
        type(gap_curve_t), intent(in) :: curve
        class(zone_t), intent(in) :: zones(:) ! in the order of y
        integer, intent(in) :: strips_per_patch
        type(contact_strips_t), intent(inout) :: strips
        type(normal_result_t), intent(inout) :: result

        integer :: n_strips(most_zones), i, p
        real(wp) :: width

        strips%n = 0
        strips%n_patches = size(zones)
        if (size(zones) == 0) return
        call share_zones(strips_per_patch, size(strips%p0), zones%y_to - zones%y_from, &
                         n_strips(:size(zones)))
        do p = 1, size(zones)
            associate (zone => zones(p))
                width = (zone%y_to - zone%y_from)/n_strips(p)
                do i = 1, n_strips(p)
                    strips%n = strips%n + 1
                    strips%patch(strips%n) = p
                    strips%y_left(strips%n) = zone%y_from + (i - 1)*width
                    strips%y_right(strips%n) = merge(zone%y_to, zone%y_from + i*width, &
                                                     i == n_strips(p))
                    call mean_row(curve, zone, zone%y_from + (i - 0.5_wp)*width, width, &
                                  strips%half_length(strips%n), strips%p0(strips%n))
                end do
                call add_figures(curve, zone, result)
                result%strips_across = max(result%strips_across, n_strips(p))
            end associate
        end do
    end subroutine put_strips

    !> Length and pressure of a strip: the mean square of the length, and with it the mean load.
    pure subroutine mean_row(curve, zone, y, width, half_length, p0)
        type(gap_curve_t), intent(in) :: curve
        class(zone_t), intent(in) :: zone
        real(wp), intent(in) :: y, width ! middle and width of the strip, mm
        real(wp), intent(out) :: half_length, p0

        real(wp) :: left, square(2), peak(2)

        call zone%row(curve, y - half_distance*width, left, square(1), peak(1))
        call zone%row(curve, y + half_distance*width, left, square(2), peak(2))
        half_length = sqrt(0.5_wp*sum(square))
        p0 = 0.0_wp
        if (half_length > 0.0_wp) p0 = 0.5_wp*sum(peak*sqrt(square))/half_length
    end subroutine mean_row

    !> Area, maximum pressure and length of a patch.
    pure subroutine add_figures(curve, zone, result)
        type(gap_curve_t), intent(in) :: curve
        class(zone_t), intent(in) :: zone
        type(normal_result_t), intent(inout) :: result

        real(wp) :: middle, half_width, angle, left, square, p0
        integer :: i

        call zone%row(curve, zone%y_low, left, square, p0)
        result%pmax = max(result%pmax, p0)
        result%x_max = max(result%x_max, sqrt(square))
        middle = 0.5_wp*(zone%y_from + zone%y_to)
        half_width = 0.5_wp*(zone%y_to - zone%y_from)
        do i = 1, area_points
            ! Chebyshev's rule, exact for ellipses.
            angle = i*pi/(area_points + 1)
            call zone%row(curve, middle - half_width*cos(angle), left, square, p0)
            result%pmax = max(result%pmax, p0)
            result%x_max = max(result%x_max, sqrt(square))
            result%area = result%area &
                          + 2.0_wp*half_width*pi/(area_points + 1)*sin(angle)*sqrt(square)
        end do
    end subroutine add_figures

    !> Cut the patches into strips, bring the pressures to the load that was asked for, fill the
    !> figures, and name limitations: `st_under_resolved`, no penetration has the load, because
    !> patches meet or part there; those of `strip_solve`.
    pure subroutine finish_approximate(curve, demand, depth, zones, strips_per_patch, tolerance, &
                                       strips, result, status)
        type(gap_curve_t), intent(in) :: curve          !! the gap that was solved
        type(demand_t), intent(in) :: demand            !! load or penetration
        real(wp), intent(in) :: depth                   !! penetration above the lowest height, mm
        class(zone_t), intent(in) :: zones(:)           !! the patches, in the order of y
        integer, intent(in) :: strips_per_patch         !! of the widest patch
        real(wp), intent(in) :: tolerance               !! of the search for the load, relative
        type(contact_strips_t), intent(inout) :: strips !! filled
        type(normal_result_t), intent(inout) :: result  !! filled
        type(status_t), intent(inout) :: status !! `st_no_convergence`: nothing carries a load

        real(wp) :: load, factor

        call put_strips(curve, zones, strips_per_patch, strips, result)
        load = strips_load(strips)
        if (.not. (load > 0.0_wp .and. ieee_is_finite(load))) then
            call set_status(status, st_no_convergence, 'no contact found that carries a load')
            result = normal_result_t()
            return
        end if
        factor = 1.0_wp
        if (demand%by_load) then
            factor = demand%load/load
            if (abs(sum(zones%load)/demand%load - 1.0_wp) &
                > max(jump, 2.0_wp*tolerance)) &
                call add_limitation(status, st_under_resolved, 'no penetration has this load: ' // &
                                    'patches meet or part there, and the pressures were scaled')
        end if
        strips%p0(:strips%n) = strips%p0(:strips%n)*factor
        result%pmax = result%pmax*factor
        result%load = load*factor
        result%penetration = curve%h_lowest + depth
        result%y_min = strips%y_left(1)
        result%y_max = strips%y_right(strips%n)
        result%n_patches = strips%n_patches
        call name_limitations(curve, strips, status)
        if (.not. is_error(status)) call name_steps(curve, depth, strips, status)
        call check_lowest(curve, depth, status)
        if (is_error(status)) result = normal_result_t()
    end subroutine finish_approximate
end module faststrip_normal_simple_approximate
