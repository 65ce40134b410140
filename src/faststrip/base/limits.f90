!> Limits that searches and checks of all rooms share; none of them decides a digit of an answer.
module faststrip_base_limits
    use faststrip_base_kinds, only: wp
    implicit none
    private

    public :: most_steps, most_halvings, smallest_size, largest_size, nothing, beyond_all
    public :: too_large, largest_ratio, rounding, half_digits, equal_within
    public :: most_points, largest_place

    !> Most steps of a search that goes on until it is there.
    !> Tuned [steps]. Origin: safeguard: Newton's and secant steps take three to ten, a bracket that
    !> is halved has all digits after 60.
    integer, parameter :: most_steps = 100
    !> Halvings of an interval to its last digit.
    !> Tuned [halvings]. Origin: 53 binary digits, and some for a wide interval.
    integer, parameter :: most_halvings = 60
    !> Lengths, pressures, ratios and numbers outside are refused, or count as these.
    !> Tuned [mm, MPa, 1]. Origin: safeguard: fourth powers of them are still numbers.
    real(wp), parameter :: smallest_size = 1.0e-30_wp, largest_size = 1.0e30_wp
    !> Lengths, areas and loads below carry nothing.
    !> Tuned [mm, mm2, N, MPa]. Origin: safeguard: products of them do not underflow.
    real(wp), parameter :: nothing = 1.0e-60_wp
    !> Numbers above stand for infinite ones, or are refused.
    !> Tuned [1]. Origin: safeguard: squares cannot overflow.
    real(wp), parameter :: beyond_all = 1.0e100_wp
    !> Lengths, and numbers given as decimals, that differ by less are the same.
    !> Tuned [mm, 1]. Origin: a hundredth of an atom, ten thousand roundings of a radius; below what
    !> anybody writes.
    real(wp), parameter :: rounding = 1.0e-9_wp
    !> Lengths, loads and compliances above are refused: products of them do not overflow.
    real(wp), parameter :: too_large = 1.0_wp/nothing
    !> Proportions of lengths, coefficients of friction and creepages (spin in rad/mm) beyond this
    !> are refused, or count as this.
    !> Tuned [1, rad/mm]. Origin: safeguard: no contact has a thousandth of it.
    real(wp), parameter :: largest_ratio = 1.0e6_wp
    !> Places this near to each other, over an element's side, are one, and pressures of this part
    !> of the largest none: half of the digits.
    real(wp), parameter :: half_digits = sqrt(epsilon(1.0_wp))
    !> Most points that are made of one curve, or samples of one gap.
    !> Tuned [points]. Origin: safeguard: memory; 10 m in steps of 0.01 mm.
    integer, parameter :: most_points = 1000000
    !> Coordinates and displacements beyond are refused: they are not in mm.
    !> Tuned [mm]. Origin: safeguard: 10 m.
    real(wp), parameter :: largest_place = 1.0e4_wp
    !> Coordinates, and numbers over their size, that differ by less agree as far as they can.
    !> Tuned [mm, 1]. Origin: some roundings of a place in the track, and of sums over some hundred.
    real(wp), parameter :: equal_within = 1.0e-12_wp
end module faststrip_base_limits
