!> Forces given: the creepages that carry them, by any tangential method.
!>
!> Sought are cksi, ceta or both, at a given spin; on the same pressures the tangential method is
!> solved again and again. Forces fall with creepage (their symmetric derivative is negative), so
!> with constant friction there is one answer. With spin every force below mu N is reached, at
!> creepages that grow as `cphi sqrt(<s^2>/(2 (1 - f)))`, f = |F|/(mu N), s the place along the
!> force and the mean that of the load; without, f = 1 is full sliding, which any larger creepage
!> gives too.
!>
!> The search runs over coordinates z of creepages in which unsaturated forces R are nearly z
!> (`faststrip_tangential_force_map`): secant steps `dz = A (R_given - R)`, A first that of the map
!> itself, then updated by Broyden's (1965) formula. A warm start begins with `z - R` and A of the
!> last search. What does not come nearer is halved.
!>
!> A lateral force on a curved surface is that in the frame of the contact, of pressures and
!> tractions. Sought is the force along the surface that, shared by load, gives what pressures leave
!> of it; what the method's own strips give is held against that.
!>
!> Where friction falls with slip, forces do not grow beyond a largest one, and behind it every
!> force down to that of the kinetic coefficient is met again: steps from adhesion end at the
!> answer with less slip.
module faststrip_contact_given_forces
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_creepage, only: creepage_t
    use faststrip_base_friction, only: falls, softened
    use faststrip_base_kinds, only: wp
    use faststrip_base_limits, only: rounding
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, &
                                     add_limitation, number_text, st_bad_argument, st_not_finite, &
                                     st_no_convergence, st_not_unique, st_beyond_adhesion
    use faststrip_contact_case, only: contact_case_t, given_forces_t
    use faststrip_contact_cut, only: solve_tried
    use faststrip_contact_method, only: contact_result_t, workspace_t, tangential_method_t, &
                                        found_motion_t
    use faststrip_contact_method_surface, only: lay_strips, find_lean, lateral_share, &
                                               slip_of_adhesion
    use faststrip_contact_methods, only: method_t, tangential_none, tangential_linear, &
                                         tangential_she, tangential_polach
    use faststrip_normal_limitations, only: name_creepage_resolution
    use faststrip_tangential_force_map, only: force_map_t, make_force_map, unsaturated, &
                                              find_creepages, solve_two, kappa
    use faststrip_tangential_laws, only: law_linear, law_shen_hedrick_elkins, law_polach
    implicit none
    private

    public :: check_given_forces, solve_given_forces, estimate_given_forces, jump_of_force

    ! Tuned [1]: of forces, over mu N. Origin: chosen: a thousandth of what methods differ by; a
    ! tenth of it takes one solution more.
    real(wp), parameter :: tolerance = 1.0e-5_wp
    ! Tuned [1]: mu N is held against so many times the given force and linear ones by what else is
    ! given, if these are less. Origin: chosen: what is small is as exact as its size.
    real(wp), parameter :: small = 3.0_wp
    ! Tuned [1]: longest step of coordinates; mu N is 3. Origin: safeguard: from adhesion to half of
    ! mu N.
    real(wp), parameter :: longest = 0.7_wp
    ! Tuned [1]: unsaturated force over mu N from which on methods are rough. Origin: chosen: 0.9 mu
    ! N.
    real(wp), parameter :: rough = 1.6_wp
    ! Tuned [solutions]: of a search. Origin: safeguard: three to twelve are taken.
    integer, parameter :: most_solutions = 40
    ! Tuned [solutions]: without coming nearer. Origin: safeguard: steps are then a 256th.
    integer, parameter :: most_in_vain = 8
    !> What forces, or moments, of methods jump by at a creepage, over their bound.
    !> Tuned [1]. Origin: measured: FASTSTRIP does by 1e-4 at some creepages.
    real(wp), parameter :: jump_of_force = 5.0e-4_wp
    ! Tuned [1]: change that is believed, over that of the slopes so far, at least and at most.
    ! Origin: safeguard.
    real(wp), parameter :: least_change = 0.1_wp, most_change = 4.0_wp

contains

    !> Refuse given forces that no creepages can be found for.
    pure subroutine check_given_forces(given, creepage, about, status)
        type(given_forces_t), intent(in) :: given !! one or both
        type(creepage_t), intent(in) :: creepage  !! of the case
        type(method_t), intent(in) :: about       !! the tangential method
        type(status_t), intent(inout) :: status   !! changed by an error: `st_bad_argument`,
                                                  !! `st_not_finite`

        character(len=*), parameter :: forces(2) = ['Fx', 'Fy']
        character(len=*), parameter :: creepages(2) = ['cksi', 'ceta']
        real(wp) :: c(2)
        integer :: k

        c = [creepage%cksi, creepage%ceta]
        if (about%number == tangential_none) call set_status(status, st_bad_argument, &
            'forces are given, but tangential method ' // trim(about%name) // ' gives none')
        do k = 1, 2
            if (is_error(status)) return
            if (.not. given%is_given(k)) cycle
            if (.not. ieee_is_finite(given%force(k))) then
                call set_status(status, st_not_finite, 'a given ' // forces(k) // &
                                ' must be a finite number, got ' // number_text(given%force(k)))
            else if (c(k) /= 0.0_wp) then
                call set_status(status, st_bad_argument, creepages(k) // ' must be 0 where ' // &
                                forces(k) // ' is given, which it follows from, got ' // &
                                number_text(c(k)))
            end if
        end do
    end subroutine check_given_forces

    !> Forces on the workspace's pressures that are as they are given; the result has the creepages
    !> that carry them.
    subroutine solve_given_forces(workspace, case, method, result, status)
        type(workspace_t), intent(inout) :: workspace    !! with a normal solution; remembers where
                                                         !! the search ended
        type(contact_case_t), intent(in) :: case         !! checked
        class(tangential_method_t), intent(in) :: method !! that of the case
        type(contact_result_t), intent(inout) :: result  !! gets its tangential part
        type(status_t), intent(out) :: status
            !! those of the method, of `check_given_forces`; `st_beyond_adhesion`: above mu N, or
            !! what the method gives here; `st_no_convergence`; limitation `st_not_unique`

        type(contact_case_t) :: tried
        type(force_map_t) :: map
        real(wp) :: forces(2), pressed, cosine

        call clear_status(status)
        call check_given_forces(case%given, case%creepage, method%about, status)
        if (is_error(status)) return
        map%is_sought = case%given%is_given
        select case (method%about%number)
        case (tangential_linear)
            map%law = law_linear
        case (tangential_she)
            map%law = law_shen_hedrick_elkins
        case (tangential_polach)
            map%law = law_polach
        end select
        map%material = softened(case%material, case%friction)
        map%mu = workspace%mu
        map%force = workspace%mu*result%normal%load
        forces = case%given%force
        call find_lean(workspace%strips, result%normal%load, pressed, cosine)
        forces(2) = (case%given%force(2) - pressed)/cosine
        call check_size(map, forces, workspace%strips%is_curved, status)
        if (is_error(status)) return
        tried%contact_terms_t = case%contact_terms_t
        tried%given = given_forces_t()
        call make_force_map(map, workspace%strips, case%creepage, status)
        if (is_error(status)) return
        if (workspace%found%is_known) &
            workspace%found%is_known = all(workspace%found%is_given .eqv. map%is_sought)
        call search(workspace, tried, method, map, forces, [pressed, cosine], result, status)
        if (.not. is_error(status)) call name_others(map, case, forces, status)
    end subroutine solve_given_forces

    !> Refuse what is above mu N.
    pure subroutine check_size(map, forces, is_curved, status)
        type(force_map_t), intent(in) :: map
        real(wp), intent(in) :: forces(2) ! along the surface, N
        logical, intent(in) :: is_curved  ! the surface
        type(status_t), intent(out) :: status

        character(len=52) :: along
        real(wp) :: asked

        call clear_status(status)
        asked = size_of(map, forces)
        if (map%force > 0.0_wp .and. (asked <= map%force*(1.0_wp + rounding) &
                                      .or. map%law == law_linear)) return
        along = ''
        if (is_curved .and. map%is_sought(2)) &
            along = ' along the curved surface, what pressures leave'
        call set_status(status, st_beyond_adhesion, 'a given force must not be above mu N, ' // &
                        trim(number_text(map%force)) // ' N, got ' // &
                        trim(number_text(asked)) // ' N' // along)
    end subroutine check_size

    !> Size of the forces that are given, N.
    pure real(wp) function size_of(map, forces)
        type(force_map_t), intent(in) :: map
        real(wp), intent(in) :: forces(2)

        size_of = norm2(merge(forces, 0.0_wp, map%is_sought))
    end function size_of

    !> Search the creepages.
    subroutine search(workspace, tried, method, map, forces, lean, result, status)
        type(workspace_t), intent(inout) :: workspace
        type(contact_case_t), intent(inout) :: tried ! without given forces; gets creepages
        class(tangential_method_t), intent(in) :: method
        type(force_map_t), intent(in) :: map
        real(wp), intent(in) :: forces(2)            ! given ones, along the surface, N
        real(wp), intent(in) :: lean(2)              ! of `find_lean`
        type(contact_result_t), intent(inout) :: result
        type(status_t), intent(out) :: status

        type(found_motion_t) :: now, best
        type(creepage_t) :: best_creepage
        real(wp) :: wanted(2), left, least, step(2), found(2), slopes(2, 2), of_map(2, 2)
        real(wp) :: largest, miss, got(2)
        integer :: i, in_vain
        logical :: is_flat, is_found

        wanted = unsaturated(map, forces)
        miss = tolerance*min(map%force, small*(size_of(map, forces) &
                                               + map%force*norm2(map%linear)))
        of_map = reshape([1.0_wp, 0.0_wp, 0.0_wp, 1.0_wp], [2, 2])
        if (map%law /= law_linear) of_map = (1.0_wp + kappa)*of_map
        now%slope = of_map
        if (workspace%found%is_known) now = workspace%found
        workspace%found%is_known = .false.
        now%z = now%z + product_of(now%slope, wanted - now%r)
        best = now
        least = huge(1.0_wp)
        largest = 0.0_wp
        in_vain = 0
        do i = 1, most_solutions
            call find_creepages(map, workspace%strips, now%z, tried%creepage, found, slopes, status)
            if (.not. is_error(status)) call solve_tried(workspace, tried, method, result, status)
            if (is_error(status)) return
            ! Tractions of dissimilar materials may have changed the pressures.
            call lay_strips(workspace%solver%curve, tried, workspace%strips)
            now%z = found
            got = forces_got(workspace, result, lean)
            now%r = unsaturated(map, got)
            largest = max(largest, size_of(map, got))
            is_found = size_of(map, got - forces) <= miss
            is_flat = .false.
            ! The last place, too: a warm start goes on with its slopes.
            if (i > 1) call learn(best, now, is_flat)
            if (is_found) exit
            left = norm2(wanted - now%r)
            if (left < least .or. is_on_the_way(best, now, wanted, falls(tried%friction))) then
                least = left
                best = now
                if (is_flat) best%slope = 2.0_wp*best%slope
                best_creepage = tried%creepage
                in_vain = 0
            else
                best%slope = now%slope
                in_vain = in_vain + 1
                if (in_vain > most_in_vain) exit
                ! What was learnt leads nowhere.
                if (in_vain == most_in_vain/2) best%slope = of_map
            end if
            step = product_of(best%slope, wanted - best%r)
            step = step*min(1.0_wp, longest/max(norm2(step), tiny(1.0_wp)))*0.5_wp**in_vain
            now%z = best%z + step
        end do
        if (.not. is_found) then
            ! Where forces jump, the nearer side.
            now = best
            tried%creepage = best_creepage
            call solve_tried(workspace, tried, method, result, status)
            if (is_error(status)) return
            call lay_strips(workspace%solver%curve, tried, workspace%strips)
            is_found = size_of(map, forces_got(workspace, result, lean) - forces) &
                       <= jump_of_force*map%force
        end if
        if (.not. is_found) then
            call refuse_search(method%about%name, size_of(map, forces), largest, status)
            return
        end if
        call clear_status(status)
        now%is_known = .true.
        now%is_given = map%is_sought
        call find_rates(map, forces, slopes, now)
        workspace%found = now
    end subroutine search

    !> Forces that a method found, along the surface, with what has changed of the pressures', N.
    pure function forces_got(workspace, result, lean) result(got)
        type(workspace_t), intent(in) :: workspace
        type(contact_result_t), intent(in) :: result
        real(wp), intent(in) :: lean(2) ! of `find_lean`, before
        real(wp) :: got(2)

        real(wp) :: pressed, cosine

        call find_lean(workspace%strips, result%normal%load, pressed, cosine)
        got = [result%tangential%fx, &
               lateral_share(workspace%strips, workspace%strip_forces, result%tangential%fy, &
                             lean(2)) + (pressed - lean(1))/lean(2)]
    end function forces_got

    !> Does a step near mu N lead on, however forces change over it? From above what is wanted to
    !> less slip, from below to more; this not where friction falls, for the largest force may be
    !> passed.
    pure logical function is_on_the_way(best, now, wanted, is_falling)
        type(found_motion_t), intent(in) :: best, now
        real(wp), intent(in) :: wanted(2)
        logical, intent(in) :: is_falling

        real(wp) :: size(2), goal

        size = [norm2(best%r), norm2(now%r)]
        goal = norm2(wanted)
        is_on_the_way = .false.
        if (goal < rough) return
        is_on_the_way = (all(size > goal) .and. norm2(now%z) < norm2(best%z)) .or. &
                        (all(size < goal) .and. norm2(now%z) > norm2(best%z) &
                         .and. .not. is_falling)
    end function is_on_the_way

    !> Broyden's update: the slopes of coordinates over unsaturated forces, so that they are right
    !> between the last place and the best one.
    pure subroutine learn(best, now, is_flat)
        type(found_motion_t), intent(in) :: best
        type(found_motion_t), intent(inout) :: now ! gets the slopes
        logical, intent(out) :: is_flat            ! has hardly anything changed?

        real(wp) :: dz(2), changed(2), along, square
        integer :: k

        dz = now%z - best%z
        changed = product_of(best%slope, now%r - best%r)
        along = dot_product(dz, changed)
        square = dot_product(dz, dz)
        is_flat = along <= least_change*square
        now%slope = best%slope
        if (along >= most_change*square) then
            now%slope = 0.5_wp*best%slope
        else if (.not. is_flat) then
            do k = 1, 2
                now%slope(:, k) = best%slope(:, k) &
                                  + (dz - changed)*(dot_product(dz, best%slope(:, k))/along)
            end do
        end if
    end subroutine learn

    !> Creepages over forces where a search ended, 1/N.
    pure subroutine find_rates(map, forces, slopes, now)
        type(force_map_t), intent(in) :: map
        real(wp), intent(in) :: forces(2)
        real(wp), intent(in) :: slopes(2, 2) ! of coordinates over linear forces over mu N
        type(found_motion_t), intent(inout) :: now

        real(wp) :: near(2), step, u(2)
        integer :: k

        step = tolerance*map%force
        do k = 1, 2
            near = forces
            ! Inwards: there is no force above mu N.
            near(k) = forces(k) - sign(step, forces(k))
            call solve_two(slopes, product_of(now%slope, unsaturated(map, near) &
                                              - unsaturated(map, forces)), u)
            now%rates(:, k) = merge(u/(map%slope*(near(k) - forces(k))), 0.0_wp, map%is_sought)
        end do
    end subroutine find_rates

    !> A matrix times a vector: without optimization the intrinsic one allocates.
    pure function product_of(a, x) result(y)
        real(wp), intent(in) :: a(2, 2), x(2)
        real(wp) :: y(2)

        y = a(:, 1)*x(1) + a(:, 2)*x(2)
    end function product_of

    !> Say that no creepages carry a force, and which one is possible.
    pure subroutine refuse_search(name, asked, largest, status)
        character(len=*), intent(in) :: name   ! of the method
        real(wp), intent(in) :: asked, largest ! N
        type(status_t), intent(out) :: status

        if (largest < asked) then
            call set_status(status, st_beyond_adhesion, trim(name) // ' gives a force of ' // &
                            trim(number_text(largest)) // ' N at most here, got a given one ' // &
                            'of ' // trim(number_text(asked)) // ' N')
        else
            call set_status(status, st_no_convergence, trim(name) // ' has no creepages that ' // &
                            'were found for a given force of ' // trim(number_text(asked)) // ' N')
        end if
    end subroutine refuse_search

    !> Name that other creepages carry the same forces.
    pure subroutine name_others(map, case, forces, status)
        type(force_map_t), intent(in) :: map
        type(contact_case_t), intent(in) :: case
        real(wp), intent(in) :: forces(2) ! along the surface, N
        type(status_t), intent(inout) :: status

        real(wp) :: share

        if (map%law == law_linear) return
        share = size_of(map, forces)/map%force
        if (falls(case%friction) .and. &
            share > case%friction%kinetic_share*case%friction%hot_share) then
            call add_limitation(status, st_not_unique, 'where friction falls, other ' // &
                                'creepages with more slip carry the given force, too')
        else if (share >= 1.0_wp - tolerance .and. case%creepage%cphi == 0.0_wp) then
            call add_limitation(status, st_not_unique, 'the given force is mu N: any larger ' // &
                                'creepage carries it, too')
        end if
    end subroutine name_others

    !> Error estimates of forces that were given: those of the method, and of the creepages found.
    subroutine estimate_given_forces(workspace, case, method, result, status)
        type(workspace_t), intent(in) :: workspace       !! with the solution
        type(contact_case_t), intent(in) :: case         !! what was solved
        class(tangential_method_t), intent(in) :: method !! that of the case
        type(contact_result_t), intent(inout) :: result  !! its figures; gets their error estimates
        type(status_t), intent(inout) :: status          !! limitations so far; `st_under_resolved`

        type(contact_case_t) :: found
        real(wp) :: scale

        found%contact_terms_t = case%contact_terms_t
        found%creepage = result%creepage
        call method%estimate(workspace, found, result, status)
        if (.not. result%forces_are_estimated) return
        associate (errors => result%force_errors)
            result%creepage_errors = workspace%mu*result%normal%load &
                                     *product_of(abs(workspace%found%rates), &
                                                 [errors%fx, errors%fy])
        end associate
        ! Over the creepage, or that at which nearly all would slide.
        associate (creepage => result%creepage)
            scale = max(hypot(creepage%cksi, creepage%ceta), &
                        slip_of_adhesion(workspace%mu*result%normal%load, result%normal%area, &
                                         case%material))
        end associate
        if (scale > 0.0_wp) &
            call name_creepage_resolution(result%creepage_errors(1)/scale, &
                                          result%creepage_errors(2)/scale, case%force_limit, &
                                          status)
    end subroutine estimate_given_forces
end module faststrip_contact_given_forces
