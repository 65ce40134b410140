!> From forces back to creepages: coordinates in which the creep forces of every method are nearly
!> linear, and nearly the same.
!>
!> The law of Shen, Hedrick and Elkins (1983) backwards is closed: a force f mu N is the saturated
!> one of a linear force `tau(f) mu N`, `tau = 3 (1 - (1 - f)^(1/3))`. Unsaturated forces
!> `R = tau(f) F/|F|` of two methods differ by some percent at any creepage, spin and slip. So a
!> cheap method, FASTSIM with few elements on the patches' ellipses, maps creepages c to
!>
!>     z(c) = R(F_FASTSIM(c)) + kappa u(c),   u = Kalker's linear forces over mu N,
!>
!> and a search for forces of a dear one runs over z, in which its own R is near z. The term with
!> kappa makes the map unbounded where FASTSIM slides all over. A creep force law maps by itself,
!> the linear one, which has no bound, to z = u. What is not sought, a force or a creepage that is
!> given, has the coordinate 0.
module faststrip_tangential_force_map
    use faststrip_base_creepage, only: creepage_t
    use faststrip_base_kinds, only: wp
    use faststrip_base_limits, only: largest_ratio, rounding
    use faststrip_base_material, only: material_t
    use faststrip_base_status, only: status_t, is_error
    use faststrip_normal_strips, only: contact_strips_t
    use faststrip_tangential_fastsim, only: fastsim_strips_solve
    use faststrip_tangential_laws, only: law_strips_solve, law_linear
    use faststrip_tangential_types, only: tangential_result_t
    implicit none
    private

    public :: force_map_t, make_force_map, unsaturated, find_creepages, solve_two, kappa

    !> Share of the linear forces in the coordinates.
    !> Tuned [1]. Origin: chosen: a tenth takes half as many solutions again near mu N, a hundredth
    !> of a tenth none less.
    real(wp), parameter :: kappa = 0.005_wp
    ! Tuned [1]: force over mu N at which slopes would have no bound. Origin: chosen: what methods
    ! are rough by near mu N is not blown up.
    real(wp), parameter :: most = 1.0_wp + 1.0e-4_wp
    ! Tuned [elements]: of FASTSIM along a row, and rows. Origin: chosen for the time: twice as many
    ! save no solution.
    integer, parameter :: points = 10, rows = 9
    ! Tuned [1]: step of differences, over mu N, of linear forces. Origin: chosen: slopes need two
    ! digits.
    real(wp), parameter :: step = 1.0e-4_wp
    ! Tuned [1]: part of the way within which a place is found. Origin: chosen: what is left is no
    ! error, for a search takes the place that was found.
    real(wp), parameter :: near_enough = 1.0e-3_wp
    ! Tuned [steps]: of Newton's method. Origin: safeguard: two to six are taken.
    integer, parameter :: most_steps = 40
    ! Tuned [halvings]: of a step. Origin: safeguard: a thousandth.
    integer, parameter :: most_halvings = 10

    !> A contact whose forces are sought.
    type :: force_map_t
        logical :: is_sought(2) = .false.  !! cksi, ceta
        integer :: law = 0                 !! that maps; 0: FASTSIM
        type(material_t) :: material       !! with its initial slope
        real(wp) :: mu = 0.0_wp            !! coefficient of friction, static
        real(wp) :: force = 0.0_wp         !! mu N, N
        real(wp) :: linear(2) = 0.0_wp     !! Kalker's forces over mu N without the creepages sought
        real(wp) :: slope(2) = 0.0_wp      !! the same over the creepage sought, below 0
    end type force_map_t

contains

    !> Prepare the map of a contact.
    pure subroutine make_force_map(map, strips, creepage, status)
        type(force_map_t), intent(inout) :: map      !! what is sought, material, mu, mu N above 0;
                                                     !! gets its linear forces
        type(contact_strips_t), intent(in) :: strips !! a normal solution
        type(creepage_t), intent(in) :: creepage     !! given ones; 0 where it is sought
        type(status_t), intent(out) :: status        !! those of `law_strips_solve`

        type(tangential_result_t) :: without, with
        type(creepage_t) :: unit

        call law_strips_solve(law_linear, strips, map%material, map%mu, creepage, without, status)
        if (is_error(status)) return
        ! By Kalker cksi makes no lateral force, ceta no longitudinal one.
        unit = creepage_t(1.0_wp, 1.0_wp, 0.0_wp)
        call law_strips_solve(law_linear, strips, map%material, map%mu, unit, with, status)
        map%linear = [without%fx, without%fy]/map%force
        map%slope = [with%fx, with%fy]/map%force
    end subroutine make_force_map

    !> The unsaturated forces over mu N, of those that are given; 0 of others.
    pure function unsaturated(map, forces) result(r)
        type(force_map_t), intent(in) :: map  !! made
        real(wp), intent(in) :: forces(2)     !! N
        real(wp) :: r(2)

        real(wp) :: f, held

        r = merge(forces/map%force, 0.0_wp, map%is_sought)
        if (map%law == law_linear) return
        f = hypot(r(1), r(2))
        if (f <= rounding) return
        ! A little beyond mu N by a method's own sums it goes on growing.
        held = min(f, 1.0_wp)
        r = r*((3.0_wp*(most**(1.0_wp/3.0_wp) - (most - held)**(1.0_wp/3.0_wp)) + (f - held))/f)
    end function unsaturated

    !> Find the creepages of coordinates, from some that are near; they become those that were
    !> found, with their coordinates and the slopes of these there.
    pure subroutine find_creepages(map, strips, wanted, creepage, z, slopes, status)
        type(force_map_t), intent(in) :: map          !! made
        type(contact_strips_t), intent(in) :: strips  !! the same
        real(wp), intent(in) :: wanted(2)             !! coordinates
        type(creepage_t), intent(inout) :: creepage   !! those sought: from where, and found
        real(wp), intent(out) :: z(2)                 !! coordinates of it, nearly those wanted
        real(wp), intent(out) :: slopes(2, 2)         !! of z over the linear forces over mu N
        type(status_t), intent(out) :: status         !! those of `fastsim_strips_solve`

        real(wp) :: u(2), tried(2), z_tried(2), move(2), there(2), left, part
        integer :: i, k

        u = linear_of(map, creepage)
        call coordinates(map, strips, u, creepage, z, status)
        part = near_enough*norm2(wanted - z)
        do i = 1, most_steps
            if (is_error(status)) return
            do k = 1, 2
                slopes(:, k) = 0.0_wp
                slopes(k, k) = 1.0_wp
                if (.not. map%is_sought(k) .or. map%law == law_linear) cycle
                there = u
                ! Outwards, where there is less curvature.
                there(k) = u(k) + sign(step*(1.0_wp + abs(u(k))), u(k))
                call coordinates(map, strips, there, creepage, tried, status)
                if (is_error(status)) return
                slopes(:, k) = (tried - z)/(there(k) - u(k))
            end do
            call put_creepages(map, u, creepage)
            left = norm2(wanted - z)
            if (left <= max(part, rounding)) return
            call solve_two(slopes, wanted - z, move)
            do k = 1, most_halvings
                tried = u + move
                call coordinates(map, strips, tried, creepage, z_tried, status)
                if (is_error(status)) return
                if (norm2(wanted - z_tried) < left) exit
                move = 0.5_wp*move
                ! At a kink nothing comes nearer; slopes are about 1.
                if (k == most_halvings - 1) move = wanted - z
            end do
            u = tried
            z = z_tried
            if (k > most_halvings) exit
        end do
        call put_creepages(map, u, creepage)
    end subroutine find_creepages

    !> The linear forces over mu N of the creepages sought; 0 of others.
    pure function linear_of(map, creepage) result(u)
        type(force_map_t), intent(in) :: map
        type(creepage_t), intent(in) :: creepage
        real(wp) :: u(2)

        u = merge(map%linear + map%slope*[creepage%cksi, creepage%ceta], 0.0_wp, map%is_sought)
    end function linear_of

    !> The coordinates of linear forces, whose creepages are put into their places.
    pure subroutine coordinates(map, strips, u, creepage, z, status)
        type(force_map_t), intent(in) :: map
        type(contact_strips_t), intent(in) :: strips
        real(wp), intent(in) :: u(2)
        type(creepage_t), intent(inout) :: creepage
        real(wp), intent(out) :: z(2)
        type(status_t), intent(out) :: status

        type(tangential_result_t) :: forces

        call put_creepages(map, u, creepage)
        status = status_t()
        z = u
        if (map%law == law_linear) return
        if (map%law == 0) then
            call fastsim_strips_solve(strips, map%material, map%mu, creepage, points, rows, &
                                      forces, status)
        else
            call law_strips_solve(map%law, strips, map%material, map%mu, creepage, forces, status)
        end if
        z = unsaturated(map, [forces%fx, forces%fy]) + kappa*linear_of(map, creepage)
    end subroutine coordinates

    !> The creepages of linear forces over mu N.
    pure subroutine put_creepages(map, u, creepage)
        type(force_map_t), intent(in) :: map
        real(wp), intent(in) :: u(2)
        type(creepage_t), intent(inout) :: creepage ! gets those that are sought

        real(wp) :: c(2)

        c = (u - map%linear)/map%slope
        c = max(min(c, largest_ratio), -largest_ratio)
        if (map%is_sought(1)) creepage%cksi = c(1)
        if (map%is_sought(2)) creepage%ceta = c(2)
    end subroutine put_creepages

    !> Solve two equations; where they are singular, none.
    pure subroutine solve_two(a, b, x)
        real(wp), intent(in) :: a(2, 2) !! matrix
        real(wp), intent(in) :: b(2)    !! right-hand side
        real(wp), intent(out) :: x(2)   !! solution; `b` where there is none

        real(wp) :: determinant

        determinant = a(1, 1)*a(2, 2) - a(1, 2)*a(2, 1)
        x = b
        if (abs(determinant) <= tiny(1.0_wp)) return
        x = [a(2, 2)*b(1) - a(1, 2)*b(2), a(1, 1)*b(2) - a(2, 1)*b(1)]/determinant
    end subroutine solve_two
end module faststrip_tangential_force_map
