!> The pressure that the residuals of a strip ask for: the terms of
!> `faststrip_normal_estimate_errors` for one strip.
module faststrip_normal_estimate_pressure
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_limits, only: largest_size
    use faststrip_geometry_gap_curve, only: gap_curve_t
    use faststrip_normal_estimate_samples, only: samples_t
    use faststrip_normal_estimate_longitudinal, only: inv2r_samples_t
    use faststrip_normal_strips, only: contact_strips_t, starts_patch, last_of_patch
    use faststrip_normal_estimate_unresolved, only: unresolved_pressure, &
                                                    unresolved_pressure_growth, most_nodes
    implicit none
    private

    public :: missing_pressure, section_load, inv2r_about, find_unresolved
    public :: unresolved_factor

    ! Tuned [1]: The maximum pressure's, of gaps at edges of strips. Origin: calibrated, see the
    ! module's head.
    real(wp), parameter :: edge_factor = 0.3_wp, slope_factor = 0.35_wp
    ! Tuned [1]: The maximum pressure's, of gaps in sections. Origin: calibrated, see the module's
    ! head.
    real(wp), parameter :: section_factor = 0.45_wp, section_change = 0.5_wp
    !> Tuned [1]. Origin: calibrated, see the head of `faststrip_normal_estimate_errors`.
    real(wp), parameter :: unresolved_factor = 1.1_wp !! of heights that a strip does not resolve
    ! Tuned [1]: The maximum pressure's, of waves. Origin: calibrated, see the head of
    ! `faststrip_normal_estimate_errors`.
    real(wp), parameter :: wave_factor = 0.012_wp

contains

    !> The pressure that the gaps sampled about a strip ask for beyond its own, MPa.
    pure real(wp) function missing_pressure(compliance, strips, depth, k, i, samples, unresolved) &
        result(pressure)
        real(wp), intent(in) :: compliance           !! H of eq. (4), 1/MPa
        type(contact_strips_t), intent(in) :: strips !! the solution
        real(wp), intent(in) :: depth                !! D - h_lowest, mm
        integer, intent(in) :: k, i                  !! the strip, and where its samples are
        type(samples_t), intent(in) :: samples       !! of its block
        real(wp), intent(in) :: unresolved           !! pressure of `find_unresolved`, MPa

        real(wp) :: edge, width, per_width, per_wave
        real(wp), dimension(-1:1) :: middle, slope
        logical :: has_left, has_right
        integer :: j

        edge = 0.5_wp*(samples%left(i) + samples%right(i))
        do j = -1, 1
            middle(j) = samples%middle(i + j)
            slope(j) = 0.5_wp*(samples%right(i + j) - samples%left(i + j))
        end do
        has_left = .not. starts_patch(strips, k)
        has_right = k < last_of_patch(strips, k)
        width = strips%y_right(k) - strips%y_left(k)
        per_width = depth/(2.0_wp*compliance*width)
        per_wave = per_width + depth/(2.0_wp*pi*compliance*strips%half_length(k) &
                                      *(1.0_wp + log(1.0_wp + width/strips%half_length(k))))
        pressure = per_wave*(edge_factor*abs(edge) &
                             + slope_factor*change(slope, has_left, has_right)) &
                   + per_width*section_change*change(middle, has_left, has_right) &
                   + section_factor*abs(middle(0))*depth/(compliance*strips%half_length(k)) &
                   + unresolved_factor*unresolved + wave_factor*pressure_wave(strips, k)
    end function missing_pressure

    !> Load per width that a section which is no semi-ellipse has too much or too little, over |m|,
    !> N/mm.
    pure real(wp) function section_load(compliance, depth)
        real(wp), intent(in) :: compliance !! H of eq. (4), 1/MPa
        real(wp), intent(in) :: depth      !! D - h_lowest, mm

        section_load = section_factor*depth/compliance
    end function section_load

    !> A about strip k, whose samples are number i.
    pure type(inv2r_samples_t) function inv2r_about(strips, k, i, samples) result(inv2r)
        type(contact_strips_t), intent(in) :: strips !! the solution
        integer, intent(in) :: k, i                  !! the strip, and where its samples are
        type(samples_t), intent(in) :: samples       !! of its block

        inv2r%middle = samples%inv2r(i)
        inv2r%right = samples%inv2r_right(i)
        inv2r%before = inv2r%middle
        inv2r%behind = inv2r%middle
        inv2r%left = inv2r%middle
        if (.not. starts_patch(strips, k)) then
            inv2r%before = samples%inv2r(i - 1)
            inv2r%left = samples%inv2r_right(i - 1)
        end if
        if (k < last_of_patch(strips, k)) then
            inv2r%behind = samples%inv2r(i + 1)
        else
            ! Nothing presses at the end of a patch: A there is of no matter, left or right.
            inv2r%right = inv2r%middle
        end if
    end function inv2r_about

    !> Second difference of the pressures at a strip, MPa; at an end of the patch nothing.
    pure real(wp) function pressure_bend(strips, k) result(bend)
        type(contact_strips_t), intent(in) :: strips
        integer, intent(in) :: k

        bend = 0.0_wp
        if (starts_patch(strips, k) .or. k == last_of_patch(strips, k)) return
        bend = (strips%p0(k - 1) - strips%p0(k)) + (strips%p0(k + 1) - strips%p0(k))
    end function pressure_bend

    !> Size of the fourth difference of the pressures at a strip, MPa; beside an end nothing.
    pure real(wp) function pressure_wave(strips, k) result(wave)
        type(contact_strips_t), intent(in) :: strips
        integer, intent(in) :: k

        wave = 0.0_wp
        if (starts_patch(strips, k) .or. k == last_of_patch(strips, k)) return
        if (starts_patch(strips, k - 1) .or. k + 1 == last_of_patch(strips, k)) return
        wave = abs((pressure_bend(strips, k - 1) - pressure_bend(strips, k)) &
                   + (pressure_bend(strips, k + 1) - pressure_bend(strips, k)))
    end function pressure_wave

    !> The pressure that heights in strip k ask for which it does not resolve, and how far a
    !> longitudinal term that it does not resolve raises the maximum pressure above its own. The
    !> smooth curve meets the gap where it is sampled: in its middle, at its edges and in its
    !> neighbours' middles.
    pure subroutine find_unresolved(curve, compliance, strips, k, pressure, rise)
        type(gap_curve_t), intent(in) :: curve       !! the gap that was solved
        real(wp), intent(in) :: compliance           !! H of eq. (4), 1/MPa
        type(contact_strips_t), intent(in) :: strips !! the solution
        integer, intent(in) :: k                     !! the strip
        real(wp), intent(out) :: pressure, rise      !! MPa

        real(wp) :: node(most_nodes), tip, half
        integer :: n

        associate (left => strips%y_left(:strips%n), right => strips%y_right(:strips%n))
            n = 3
            node(1) = left(k)
            node(2) = 0.5_wp*(left(k) + right(k))
            node(3) = right(k)
            if (.not. starts_patch(strips, k)) then
                n = n + 1
                node(n) = 0.5_wp*(left(k - 1) + right(k - 1))
            end if
            if (k < last_of_patch(strips, k)) then
                n = n + 1
                node(n) = 0.5_wp*(left(k + 1) + right(k + 1))
            end if
            ! At an end of the patch the neighbour's other edge serves instead.
            if (n == 4 .and. starts_patch(strips, k)) node(5) = right(k + 1)
            if (n == 4 .and. .not. starts_patch(strips, k)) node(5) = left(k - 1)
            if (n == 4) n = n + 1
            pressure = unresolved_pressure(curve, compliance, left(k), right(k), node(:n))
            tip = unresolved_pressure_growth(curve, compliance, left(k), right(k), node(:n)) &
                  *min(strips%half_length(k), largest_size)**2
        end associate
        half = 0.5_wp*max(strips%p0(k), 0.0_wp)
        rise = 0.0_wp
        if (tip > half) rise = tip*(1.0_wp - half/tip)**2
    end subroutine find_unresolved

    !> How far the middle one of three values is from the mean of the outer ones; at an end from the
    !> straight line on, which is nothing; alone its size.
    pure real(wp) function change(values, has_left, has_right)
        real(wp), intent(in) :: values(-1:1)
        logical, intent(in) :: has_left, has_right

        change = 0.0_wp
        if (has_left .and. has_right) then
            change = abs(values(0) - 0.5_wp*(values(-1) + values(1)))
        else if (.not. (has_left .or. has_right)) then
            change = abs(values(0))
        end if
    end function change
end module faststrip_normal_estimate_pressure
