!> What a method of a contact is: abstract normal and tangential methods, the workspace that they
!> work in and the result that they fill. Types only: who computes stands elsewhere.
!>
!> A method is its solver, its object (a type that extends one of these), a row of the list in
!> `faststrip_contact_methods` and a line that enters it: `faststrip_contact_method_core` for those
!> of the core, `enter_normal_method` and `enter_tangential_method` for others. An object of the
!> core is a constant: one serves all threads. One that needs memory points to it, and serves the
!> thread whose memory it is.
module faststrip_contact_method
    use faststrip_base_creepage, only: creepage_t
    use faststrip_base_friction, only: friction_t
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, set_status, clear_status, count_text, &
                                     st_bad_argument
    use faststrip_normal_estimate_errors, only: normal_errors_t
    use faststrip_normal_simple_hertz, only: hertz_t
    use faststrip_normal_strip, only: strip_workspace_t
    use faststrip_normal_strips, only: contact_strips_t
    use faststrip_normal_types, only: normal_result_t, demand_t
    use faststrip_stress_loads, only: loads_t
    use faststrip_stress_peak, only: peak_t
    use faststrip_tangential_force_errors, only: force_errors_t
    use faststrip_tangential_heat_flash, only: flash_t
    use faststrip_tangential_types, only: tangential_result_t, tangential_field_t, strip_forces_t
    use faststrip_tangential_wear_law, only: wear_t
    use faststrip_contact_case, only: contact_case_t
    use faststrip_contact_methods, only: contact_methods_t, method_t, normal_table, tangential_table
    use faststrip_contact_wanted, only: auto_steps_t, others_t
    implicit none
    private

    public :: contact_result_t, workspace_t, times_t, wear_figures_t, strip_wear_t, found_motion_t
    public :: normal_method_t, tangential_method_t
    public :: enter_normal_method, enter_tangential_method, normal_method_of, tangential_method_of
    public :: demand_of

    !> Most methods of a kind in a workspace: twice those of the list.
    integer, parameter :: most_methods = 2*max(size(normal_table), size(tangential_table))

    !> Time of a solution, without error estimates but those that auto steers by.
    type :: times_t
        real(wp) :: normal_us = 0.0_wp         !! wall-clock time of the normal problem, us
        real(wp) :: tangential_us = 0.0_wp     !! of the tangential problem, us
        real(wp) :: normal_cpu_us = 0.0_wp     !! the same of the processor, us
        real(wp) :: tangential_cpu_us = 0.0_wp !! the same of the processor, us
    end type times_t

    !> What forces do to the surfaces.
    type :: wear_figures_t
        real(wp) :: t_gamma = 0.0_wp          !! |Fx cksi| + |Fy ceta|, N
        real(wp) :: t_gamma_spin = 0.0_wp     !! the same with |Mz cphi|, N
        real(wp) :: t_gamma_per_area = 0.0_wp !! without spin, N/mm^2
        real(wp) :: fatigue_index = 0.0_wp    !! if `knows_fatigue`
        logical :: knows_fatigue = .false.    !! was the yield stress in shear given?
        type(wear_t) :: wear                  !! if `knows_wear`
        logical :: knows_wear = .false.
            !! is there a law, does it go as far, and has the method forces of strips?
    end type wear_figures_t

    !> Figures of one contact.
    type :: contact_result_t
        type(normal_result_t) :: normal = normal_result_t()
            !! load, penetration, area, maximum pressure, ...
        type(normal_errors_t) :: normal_errors = normal_errors_t() !! their error estimates
        logical :: is_estimated = .false.
            !! is that known? Not of ellipses in the strips' place
        logical :: has_residuals = .false.
            !! are residuals of the error estimates known? Of strips, Hertz and norm
        type(creepage_t) :: creepage
            !! that the forces were solved for: the case's, found where forces are given
        real(wp) :: creepage_errors(2) = 0.0_wp
            !! estimated errors of those found, cksi and ceta, if `forces_are_estimated`
        type(tangential_result_t) :: tangential = tangential_result_t()
            !! forces on the rail, friction power, stick
        logical :: is_curved = .false.
            !! are load, Fx, Fy and Mz those of a curved surface, in the frame of the contact?
        real(wp) :: along_load = 0.0_wp  !! if so, the sum of pressures along their own normals, N
        type(tangential_result_t) :: along = tangential_result_t()
            !! if so, forces and moment along the surface
        real(wp) :: moment(2) = 0.0_wp
            !! of its pressures, and on a curved surface of its tractions, too, about x and y of the
            !! contact, N mm
        real(wp) :: mu = 0.0_wp          !! their coefficient of friction, static; the mean by load
        logical :: has_forces = .false.  !! are these known?
        logical :: knows_stick = .false. !! is the stick fraction known?
        type(force_errors_t) :: force_errors = force_errors_t() !! error estimates of the forces
        logical :: forces_are_estimated = .false.
            !! is that known? Of FASTSTRIP and FASTSIM, where the normal errors are
        type(wear_figures_t) :: wear     !! if there are forces
        type(flash_t) :: flash           !! temperatures of the surfaces
        logical :: knows_temperatures = .false. !! are they known? If they were asked for
        type(peak_t) :: stress_peak      !! largest von Mises stress of the rail, if asked for
        real(wp) :: gap_change = 0.0_wp  !! rms change of the gap by smoothing, mm
        type(times_t) :: times           !! if the case asks for them
    end type contact_result_t

    !> A normal method that was entered; never owned, never copied deep.
    type :: normal_entry_t
        class(normal_method_t), pointer :: method => null()
    end type normal_entry_t

    !> A tangential method that was entered.
    type :: tangential_entry_t
        class(tangential_method_t), pointer :: method => null()
    end type tangential_entry_t

    !> Wear of the strips; the first that the sums over strips have.
    type :: strip_wear_t
        real(wp), allocatable :: t_gamma_per_area(:) !! N/mm^2
        real(wp), allocatable :: mass(:)             !! ug per metre rolled
        real(wp), allocatable :: pass_depth(:)       !! depth when rolled over once, mm
    end type strip_wear_t

    !> Where a search of creepages for given forces ended.
    type :: found_motion_t
        logical :: is_known = .false.         !! is there one to start from?
        logical :: is_given(2) = .false.      !! were Fx, Fy given?
        real(wp) :: z(2) = 0.0_wp             !! coordinates of the creepages, see `force_map`
        real(wp) :: r(2) = 0.0_wp             !! unsaturated forces there, over mu N
        real(wp) :: slope(2, 2) = 0.0_wp      !! of z over r
        real(wp) :: rates(2, 2) = 0.0_wp      !! of cksi, ceta over Fx, Fy, 1/N
    end type found_motion_t

    !> Everything a solution needs beside the case; owned by the caller, one per thread.
    type :: workspace_t
        type(strip_workspace_t) :: solver
            !! the gap (`solver%curve`) and the strip solver's workspace
        type(contact_strips_t) :: strips  !! of the last contact
        type(hertz_t) :: hertz            !! of the last contact, if `is_ellipse`
        logical :: is_ellipse = .false.   !! is its patch the Hertz ellipse?
        integer :: solved_by = 0          !! normal method of the last contact; 0: none was solved
        real(wp) :: mu = 0.0_wp           !! coefficient of friction of its forces; the mean by load
        real(wp) :: mu_spread = 0.0_wp    !! standard deviation over it, by load
        type(friction_t) :: friction
            !! of its forces; a table is one over the contact, `heat` is known where it counts
        type(tangential_field_t) :: field !! its elements, if asked for; see `reserve_contact_field`
        type(strip_forces_t) :: strip_forces !! sums over its strips, if asked for
        type(loads_t) :: loads            !! what its stresses follow from; see `take_loads`
        type(status_t) :: wear_status
            !! why there is no wear of the last contact in spite of a law; or ok
        type(strip_wear_t) :: strip_wear  !! of the last contact, if there is a law
        type(found_motion_t) :: found      !! of the last contact, if forces were given
        type(contact_methods_t) :: methods !! that the last contact was solved by
        type(auto_steps_t) :: steps        !! of the last contact, if by auto
        real(wp) :: load_factor = 1.0_wp   !! of pressures over the case's load, see `demand_of`
        type(contact_strips_t) :: best_strips !! of the best step so far of auto
        integer :: first_strips = 0
            !! strips that the last contact of auto needed, 0: there was none
        integer, private :: n_normal = 0, n_tangential = 0
        type(normal_entry_t), private :: normal_methods(most_methods)
        type(tangential_entry_t), private :: tangential_methods(most_methods)
    end type workspace_t

    !> A way to the pressures.
    type, abstract :: normal_method_t
        type(method_t) :: about !! number, name, needs, help
    contains
        !> Allocate what a solution needs in the workspace: the only allocation.
        procedure(reserve_i), deferred :: reserve
        !> Pressures and strips on the gap in the workspace (`solver%curve`).
        procedure(solve_normal_i), deferred :: solve
        !> Error estimates; not known, unless a method has some.
        procedure :: estimate => no_normal_estimate
        !> What auto may expect of it for a target; nothing, unless a method says so.
        procedure :: expected => nothing_expected
    end type normal_method_t

    !> A way to the creep forces.
    type, abstract :: tangential_method_t
        type(method_t) :: about !! number, name, needs, help, what it gives and takes
        logical :: cuts_creepages = .true.
            !! are creepages beyond what methods take (`cut_creepage`) cut before it sees them?
        logical :: gives_strip_forces = .true.
            !! are forces of strips its own? Else they serve to turn a curved surface's alone
    contains
        !> Forces on the workspace's strips, or on its ellipse.
        procedure(solve_tangential_i), deferred :: solve
        !> Error estimates; not known, unless a method has some.
        procedure :: estimate => no_force_estimate
    end type tangential_method_t

    abstract interface
        subroutine reserve_i(self, workspace, methods, max_points, status)
            import :: normal_method_t, workspace_t, contact_methods_t, status_t
            class(normal_method_t), intent(in) :: self
            type(workspace_t), intent(inout) :: workspace  ! sized
            type(contact_methods_t), intent(in) :: methods ! resolutions
            integer, intent(in) :: max_points              ! of a gap
            type(status_t), intent(inout) :: status        ! changed by an error
        end subroutine reserve_i

        subroutine solve_normal_i(self, workspace, case, normal, status)
            import :: normal_method_t, workspace_t, contact_case_t, normal_result_t, status_t
            class(normal_method_t), intent(in) :: self
            type(workspace_t), intent(inout) :: workspace ! its strips are filled
            type(contact_case_t), intent(in) :: case      ! checked; its gap does not count
            type(normal_result_t), intent(out) :: normal  ! figures
            type(status_t), intent(out) :: status
        end subroutine solve_normal_i

        ! With an error nothing counts. `case%asked` is met, as far as the method has it.
        subroutine solve_tangential_i(self, workspace, case, result, status)
            import :: tangential_method_t, workspace_t, contact_case_t, contact_result_t, status_t
            class(tangential_method_t), intent(in) :: self
            type(workspace_t), intent(inout), target :: workspace ! with a normal solution
            type(contact_case_t), intent(in) :: case         ! checked
            type(contact_result_t), intent(inout) :: result  ! gets the forces
            type(status_t), intent(out) :: status
        end subroutine solve_tangential_i
    end interface

contains

    !> What pressures have to be: on a curved surface their sum is not the load, but what has it as
    !> its force along the normal of the contact.
    pure type(demand_t) function demand_of(workspace, case) result(demand)
        type(workspace_t), intent(in) :: workspace !! that is solved in
        type(contact_case_t), intent(in) :: case   !! load or penetration

        demand = case%demand_t
        demand%load = workspace%load_factor*demand%load
    end function demand_of

    !> Enter a normal method: `solve_contact` takes it where a case asks for its number, in place of
    !> one of the core with the same number.
    subroutine enter_normal_method(workspace, method, status)
        type(workspace_t), intent(inout) :: workspace         !! knows the method afterwards
        class(normal_method_t), intent(in), target :: method  !! lives longer than the workspace
        type(status_t), intent(out) :: status                 !! `st_bad_argument`: too many

        integer :: i

        call clear_status(status)
        do i = 1, workspace%n_normal
            if (workspace%normal_methods(i)%method%about%number == method%about%number) exit
        end do
        if (i > most_methods) then
            call refuse_method(status)
            return
        end if
        workspace%normal_methods(i)%method => method
        workspace%n_normal = max(workspace%n_normal, i)
    end subroutine enter_normal_method

    !> Enter a tangential method, likewise.
    subroutine enter_tangential_method(workspace, method, status)
        type(workspace_t), intent(inout) :: workspace            !! knows the method afterwards
        class(tangential_method_t), intent(in), target :: method !! lives longer than the workspace
        type(status_t), intent(out) :: status                    !! `st_bad_argument`: too many

        integer :: i

        call clear_status(status)
        do i = 1, workspace%n_tangential
            if (workspace%tangential_methods(i)%method%about%number == method%about%number) exit
        end do
        if (i > most_methods) then
            call refuse_method(status)
            return
        end if
        workspace%tangential_methods(i)%method => method
        workspace%n_tangential = max(workspace%n_tangential, i)
    end subroutine enter_tangential_method

    subroutine refuse_method(status)
        type(status_t), intent(inout) :: status

        call set_status(status, st_bad_argument, 'a workspace takes ' // &
                        trim(count_text(most_methods)) // ' methods of a kind, not more')
    end subroutine refuse_method

    !> The normal method of this number in a workspace; not associated if there is none.
    function normal_method_of(workspace, number) result(method)
        type(workspace_t), intent(in) :: workspace !! with methods
        integer, intent(in) :: number              !! of the list, or of a method of the host's
        class(normal_method_t), pointer :: method

        integer :: i

        method => null()
        do i = 1, workspace%n_normal
            if (workspace%normal_methods(i)%method%about%number /= number) cycle
            method => workspace%normal_methods(i)%method
            return
        end do
    end function normal_method_of

    !> The tangential method of this number in a workspace; not associated if there is none.
    function tangential_method_of(workspace, number) result(method)
        type(workspace_t), intent(in) :: workspace !! with methods
        integer, intent(in) :: number              !! of the list, or of a method of the host's
        class(tangential_method_t), pointer :: method

        integer :: i

        method => null()
        do i = 1, workspace%n_tangential
            if (workspace%tangential_methods(i)%method%about%number /= number) cycle
            method => workspace%tangential_methods(i)%method
            return
        end do
    end function tangential_method_of

    !> Nothing is known of the errors of a normal solution.
    subroutine no_normal_estimate(self, workspace, case, result, status)
        class(normal_method_t), intent(in) :: self      !! has no estimate of its own
        type(workspace_t), intent(in) :: workspace      !! with its solution
        type(contact_case_t), intent(in) :: case        !! what was solved
        type(contact_result_t), intent(inout) :: result !! its figures; gets their error estimates
        type(status_t), intent(inout) :: status         !! limitations so far; `st_under_resolved`
    end subroutine no_normal_estimate

    !> Auto does not take it.
    pure type(others_t) function nothing_expected(self, target) result(others)
        class(normal_method_t), intent(in) :: self !! no reference
        integer, intent(in) :: target              !! one of the `target_` numbers

        others = others_t()
    end function nothing_expected

    !> Nothing is known of the errors of forces.
    subroutine no_force_estimate(self, workspace, case, result, status, finer)
        class(tangential_method_t), intent(in) :: self  !! has no estimate of its own
        type(workspace_t), intent(in) :: workspace      !! with its solution
        type(contact_case_t), intent(in) :: case        !! what was solved
        type(contact_result_t), intent(inout) :: result !! its figures; gets their error estimates
        type(status_t), intent(inout) :: status         !! limitations so far; `st_under_resolved`
        real(wp), intent(in), optional :: finer
            !! what would be estimated of so many times as many strips; see `estimate_force_errors`
    end subroutine no_force_estimate
end module faststrip_contact_method
