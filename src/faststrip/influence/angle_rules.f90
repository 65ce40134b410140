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

    public :: exact, fine, coarse, n_rules, rule_size, rule_start, cosine, sine
    public :: far_limit, half_t
    public :: column_size, column_limit, column_node

    integer :: i_, j_, k_

    !> The accuracies: of scalar values, of derivatives and their columns, of columns at tips.
    integer, parameter :: exact = 1, fine = 2, coarse = 3
    real(wp), parameter :: digits(exact:coarse) = [36.5_wp, 27.0_wp, 17.5_wp]

    !> How many rules there are.
    integer, parameter :: n_rules = 13
    !> Nodes of each rule. Scalar procedures take 1.13 times as long with every other of them.
    integer, parameter :: rule_size(n_rules) = [4, 6, 8, 12, 16, 20, 24, 32, 48, 64, 96, 128, 192]
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

    ! The columns have the rules up to 64 nodes whose nodes fill four lanes.
    integer, parameter :: n_column_rules = 9
    integer, parameter :: column_rule(n_column_rules) = [1, (k_, k_=3, n_column_rules + 1)]
    integer, parameter :: size_(n_column_rules) = rule_size(column_rule)
    ! Nodes of all of them.
    integer, parameter :: n_column_nodes = sum(size_)
    !> Nodes of each, and nodes before them.
    integer, parameter :: column_size(n_column_rules, 2) = reshape( &
        [size_, [(sum(size_(:k_)) - size_(k_), k_=1, n_column_rules)]], [n_column_rules, 2])
    real(wp), parameter :: h(n_column_rules, fine:coarse) = half_t(column_rule, fine:coarse)
    ! From X = coth(H) on a^2 is negative, and u(tau) turns round at tanh(tau) = coth(H)/X. The
    ! mirror image of the end u = 1 is as harmless as the kernel's singularity up to an X.
    real(wp), parameter :: turn(n_column_rules, fine:coarse) = &
        0.5_wp*(h + sqrt(h**2 + 0.25_wp*pi**2))
    !> Of each rule and accuracy: the least sigma of the far rule; of the near one n0 and n1 in
    !> `a^2 = n0 - X^2 n1`, and the largest X; pi over the nodes.
    real(wp), parameter :: column_limit(n_column_rules, fine:coarse, 5) = reshape( &
        [far_limit(column_rule, fine:coarse), 1.0_wp/sinh(h)**2, 1.0_wp/cosh(h)**2, &
         1.0_wp/(tanh(h)*tanh(turn)), spread(pi/size_, 2, 2)], &
        [n_column_rules, 2, 5])
    ! Angle of each node, and H for each node and accuracy.
    real(wp), parameter :: angle_node(n_column_nodes, fine:coarse) = spread( &
        [((pi*(i_ - 0.5_wp)/size_(k_), i_=1, size_(k_)), k_=1, n_column_rules)], 2, 2)
    real(wp), parameter :: h_node(n_column_nodes, fine:coarse) = reshape( &
        [((h(k_, fine), i_=1, size_(k_)), k_=1, n_column_rules), &
         ((h(k_, coarse), i_=1, size_(k_)), k_=1, n_column_rules)], [n_column_nodes, 2])
    real(wp), parameter :: tau(n_column_nodes, fine:coarse) = h_node*cos(angle_node)
    !> At the nodes: cos(angle); 1 - cosh(tau)/cosh(H), 1 - sinh(tau)/sinh(H); the derivatives of
    !> cosh(tau)/cosh(H) and of sinh(tau)/sinh(H) in tau, times H sin(angle).
    real(wp), parameter :: column_node(n_column_nodes, fine:coarse, 5) = reshape( &
        [cos(angle_node), &
         2.0_wp*sinh(0.5_wp*(h_node + tau))*sinh(0.5_wp*(h_node - tau))/cosh(h_node), &
         2.0_wp*cosh(0.5_wp*(h_node + tau))*sinh(0.5_wp*(h_node - tau))/sinh(h_node), &
         h_node*sin(angle_node)*sinh(tau)/cosh(h_node), &
         h_node*sin(angle_node)*cosh(tau)/sinh(h_node)], &
        [n_column_nodes, 2, 5])
end module faststrip_influence_angle_rules
