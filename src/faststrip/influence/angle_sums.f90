!> Influence columns off the centre line by rules whose nodes are constants.
!>
!> The integrals are those of faststrip_influence_offcentre. A node costs one square root and one
!> division, or two or three roots where the strip is wide for its distance. How many nodes, and
!> whether a thin strip's kernel is expanded, the accuracy says.
!>
!> With the accuracy `coarse` the tip moves along with the half-length at the strip's own tip, where
!> its influence depends on one ratio only. With `kappa = w/(4 xd)`
!>
!>     I(xd; xd, -w/2, w/2) = 2 xd G(1, 2 kappa),   dG/dkappa = 2 g(kappa),
!>     g = 2 int_0^1 sqrt(s (1 - s))/sqrt(s^2 + kappa^2) ds
!>       = pi + sum_m B_m kappa^(m + 1/2),          kappa < 1,
!>     B_m = (-1)^m binom(1/2, m) Gamma(-m/2 - 1/4) Gamma(m/2 + 3/4)/sqrt(pi),
!>
!> the residues of the integral's Mellin transform.
module faststrip_influence_angle_sums
    use faststrip_base_kinds, only: wp, pi
    use faststrip_influence_angle_rules, only: fine, coarse, column_size, column_limit, &
                                               column_node
    use faststrip_influence_closed_coefficients, only: atanh_column, column_last
    use faststrip_influence_four_lanes, only: lanes_for, column_t, off_center_lanes
    use faststrip_influence_offcentre_rules, only: for_gradient
    use faststrip_influence_plain_sizes, only: largest_plain
    implicit none
    private

    public :: angle_column

    integer :: k_
    ! The series of a strip's own tip, up to a largest kappa.
    ! Tuned [1]. Origin: chosen: strips of a patch seldom pass it; errors of 4e-12 there.
    real(wp), parameter :: own_kappa = 0.35_wp
    ! Its last power: of half of the digits.
    ! Given: what the lanes take.
    integer, parameter :: last_own = 19
    ! Given: the binomial series.
    real(wp), parameter :: binomial(0:last_own) = &
        [((-1.0_wp)**k_*gamma(1.5_wp)/(gamma(k_ + 1.0_wp)*gamma(1.5_wp - k_)) &
          *gamma(-0.5_wp*k_ - 0.25_wp)*gamma(0.5_wp*k_ + 0.75_wp)/sqrt(pi), k_=0, last_own)]
    ! Given: the integral of a power.
    real(wp), parameter :: own(2, 0:last_own) = reshape( &
        [(binomial(k_)/(k_ + 1.5_wp), binomial(k_), k_=0, last_own)], [2, last_own + 1])

    ! Largest narrowness, half-width over distance, of a kernel in nine powers; negative: not used.
    ! Tuned [1]. Origin: errors within the accuracy, see faststrip_influence_angle_rules.
    real(wp), parameter :: thin_last(fine:coarse) = [-1.0_wp, 0.2_wp]
    ! What the lanes take of each accuracy: limits of the rules; the largest narrowness of both
    ! forms; the largest X and distance of an edge in half-lengths: beyond, differences lose more
    ! than derivatives may, and scalar procedures less; the own tip's largest half-width; series.
    real(wp), parameter :: table(105, fine:coarse) = reshape( &
        [column_limit(:, fine, :), thin_last(fine), column_last, for_gradient%loss, -1.0_wp, &
         2.0_wp*atanh_column, own, &
         column_limit(:, coarse, :), thin_last(coarse), column_last, for_gradient%loss, &
         2.0_wp*own_kappa, 2.0_wp*atanh_column, own], [105, 2])

contains

    !> Influence of a strip on any points, its derivatives in x and in the half-length, as in
    !> faststrip_influence_offcentre; the value is 0 where no rule serves. Relative error
    !> exp(-digits) of the accuracy.
    pure subroutine angle_column(accuracy, half_length, y_left, y_right, x, y, value, d_x, &
                                 d_half_length, portable, found)
        integer, intent(in) :: accuracy           !! `fine` or `coarse`
        real(wp), intent(in) :: half_length       !! xd of the strip with the pressure, mm
        real(wp), intent(in) :: y_left            !! its left edge, mm
        real(wp), intent(in) :: y_right           !! its right edge, mm
        real(wp), intent(in) :: x(:)              !! field points along the strip, (n), mm
        real(wp), intent(in) :: y(:)              !! field points across, (n), mm
        real(wp), intent(inout) :: value(:)       !! influence I, (n), mm
        real(wp), intent(inout) :: d_x(:)         !! dI/dx, (n)
        real(wp), intent(inout) :: d_half_length(:) !! dI/dxd, (n)
        logical, intent(in), optional :: portable !! by what any processor has; default: if need be
        integer, intent(out) :: found             !! 1 if all of them

        integer :: by

        by = lanes_for(portable)
        found = -1
        if (by > 0) then
            call off_center_lanes(column_t(by, size(y), largest_plain, half_length, y_left, &
                                           y_right), x, y, column_size, table(1, accuracy), &
                                  column_node(1, accuracy, 1), value, d_x, d_half_length, found)
        end if
        if (found < 0) value = 0.0_wp
    end subroutine angle_column
end module faststrip_influence_angle_sums
