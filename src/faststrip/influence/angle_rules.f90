!> Midpoint rules in an angle: sizes, nodes, and which rule reaches which accuracy.
!>
!> A rule of N nodes puts them at `pi (i - 1/2)/N`, i = 1, ..., N. It serves in two ways:
!>
!> - far: `u = cos(angle)`. With a singularity of the kernel at distance sigma (half the sum of its
!>   distances from u = -1 and u = 1) the error is `exp(-2 (N - 1) acosh(sigma))`;
!> - near: `u = X + a sinh(t)`, `t = mid + H cos(angle)`, which moves the singularity to
!>   `Im t = pi/2` or farther. The error is `exp(-2 N asinh(pi/(2 H)))`.
!>
!> For an accuracy exp(-digits) a rule needs `sigma >= far_limit` or `H <= half_t`. The scalar
!> procedures choose mid and H for each field point (faststrip_influence_offcentre). The columns
!> fix H for each rule, and then mid follows:
!>
!>     u = X + a sinh(mid + tau) = X (1 - cosh(tau)/cosh(H)) + sinh(tau)/sinh(H),
!>     a^2 = 1/sinh(H)^2 - X^2/cosh(H)^2 <= cl^2,
!>
!> linear in X: the hyperbolic functions are constants. All lengths are in half-lengths of the
!> strip that carries the pressure.
module faststrip_influence_angle_rules
    use faststrip_base_kinds, only: wp, pi
    implicit none
    private

    public :: exact, fine, coarse, rule_size, rule_start, cosine, sine
    public :: far_limit, half_t
    public :: n_column_rules, near_a0, near_a1, near_last
    public :: one_cosh, one_sinh, d_cosh, d_sinh

    integer :: i_, j_, k_

    !> The accuracies: of scalar values, of derivatives and their columns, of columns at tips.
    integer, parameter :: exact = 1, fine = 2, coarse = 3
    real(wp), parameter :: digits(exact:coarse) = [36.5_wp, 27.0_wp, 17.5_wp]

    !> Nodes of each rule. Those up to 64 are close together, for the columns pay for each node.
    integer, parameter :: n_rules = 21
    integer, parameter :: rule_size(n_rules) = [4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 28, 32, &
                                                36, 40, 48, 56, 64, 96, 128, 192]
    !> The place of each rule's first node in the tables of nodes.
    integer, parameter :: rule_start(n_rules) = [(sum(rule_size(:i_)) - rule_size(i_) + 1, &
                                                  i_=1, n_rules)]
    integer, parameter :: n_nodes = sum(rule_size)
    real(wp), parameter :: angle(n_nodes) = &
        [((pi*(i_ - 0.5_wp)/rule_size(k_), i_=1, rule_size(k_)), k_=1, n_rules)]
    !> Of the nodes' angles.
    real(wp), parameter :: cosine(n_nodes) = cos(angle)
    !> The same.
    real(wp), parameter :: sine(n_nodes) = sin(angle)

    !> Least sigma of a far rule.
    real(wp), parameter :: far_limit(n_rules, exact:coarse) = reshape( &
        [((cosh(0.5_wp*digits(j_)/(rule_size(k_) - 1)), k_=1, n_rules), j_=exact, coarse)], &
        [n_rules, 3])
    !> Largest H of a near rule.
    real(wp), parameter :: half_t(n_rules, exact:coarse) = reshape( &
        [((0.5_wp*pi/sinh(0.5_wp*digits(j_)/rule_size(k_)), k_=1, n_rules), j_=exact, coarse)], &
        [n_rules, 3])

    ! What the columns need besides, of H = half_t.

    !> The columns have rules 1, ..., n_column_rules, and only the accuracies fine and coarse.
    integer, parameter :: n_column_rules = 18
    integer, parameter :: n_column_nodes = sum(rule_size(:n_column_rules))
    !> `a^2 = near_a0 - X^2 near_a1`.
    real(wp), parameter :: near_a0(n_rules, exact:coarse) = 1.0_wp/sinh(half_t)**2
    !> The same.
    real(wp), parameter :: near_a1(n_rules, exact:coarse) = 1.0_wp/cosh(half_t)**2
    ! From X = coth(H) on a^2 is negative, and u(tau) turns round at tanh(tau) = coth(H)/X. The
    ! mirror image of the end u = 1 is as harmless as the kernel's singularity up to this X.
    real(wp), parameter :: turn(n_rules, exact:coarse) = &
        0.5_wp*(half_t + sqrt(half_t**2 + 0.25_wp*pi**2))
    !> Largest X of a near rule.
    real(wp), parameter :: near_last(n_rules, exact:coarse) = 1.0_wp/(tanh(half_t)*tanh(turn))
    ! Digits, size of the rule and angle, for each node and accuracy.
    real(wp), parameter :: digits_node(n_column_nodes, fine:coarse) = reshape( &
        [((digits(j_), i_=1, n_column_nodes), j_=fine, coarse)], [n_column_nodes, 2])
    integer, parameter :: size_node(n_column_nodes, fine:coarse) = reshape( &
        [(((rule_size(k_), i_=1, rule_size(k_)), k_=1, n_column_rules), j_=fine, coarse)], &
        [n_column_nodes, 2])
    real(wp), parameter :: angle_node(n_column_nodes, fine:coarse) = reshape( &
        [((angle(i_), i_=1, n_column_nodes), j_=fine, coarse)], [n_column_nodes, 2])
    real(wp), parameter :: h_node(n_column_nodes, fine:coarse) = &
        0.5_wp*pi/sinh(0.5_wp*digits_node/size_node)
    real(wp), parameter :: tau(n_column_nodes, fine:coarse) = h_node*cos(angle_node)
    !> 1 - cosh(tau)/cosh(H) at the nodes.
    real(wp), parameter :: one_cosh(n_column_nodes, fine:coarse) = &
        2.0_wp*sinh(0.5_wp*(h_node + tau))*sinh(0.5_wp*(h_node - tau))/cosh(h_node)
    !> 1 - sinh(tau)/sinh(H).
    real(wp), parameter :: one_sinh(n_column_nodes, fine:coarse) = &
        2.0_wp*cosh(0.5_wp*(h_node + tau))*sinh(0.5_wp*(h_node - tau))/sinh(h_node)
    !> The derivative of cosh(tau)/cosh(H) in tau, times H sin(angle).
    real(wp), parameter :: d_cosh(n_column_nodes, fine:coarse) = &
        h_node*sin(angle_node)*sinh(tau)/cosh(h_node)
    !> The same of sinh(tau)/sinh(H).
    real(wp), parameter :: d_sinh(n_column_nodes, fine:coarse) = &
        h_node*sin(angle_node)*cosh(tau)/sinh(h_node)
end module faststrip_influence_angle_rules
