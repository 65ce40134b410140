!> A wheelset on its track, what is prescribed, and the figures of its contacts.
module faststrip_wheelset_types
    use faststrip_base_creepage, only: creepage_t
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t
    use faststrip_contact_case, only: contact_case_t
    use faststrip_contact_method, only: contact_result_t, workspace_t
    use faststrip_geometry_contact_frame, only: frame_gap_t
    use faststrip_geometry_overlap, only: region_t, most_regions
    use faststrip_geometry_undeformed_gap, only: standard_gap_height
    use faststrip_geometry_wheel_on_rail, only: wheel_on_rail_t
    use faststrip_geometry_wheel_outline, only: outline_t
    use faststrip_geometry_wheelset_state, only: wheelset_state_t
    use faststrip_lookup_faces, only: lookup_cubic
    use faststrip_lookup_table, only: lookup_t
    use faststrip_tangential_force_errors, only: force_errors_t
    implicit none
    private

    public :: wheelset_model_t, wheelset_demand_t, wheel_contact_t, wheel_result_t
    public :: wheelset_result_t, wheel_workspace_t, wheelset_workspace_t, path_t
    public :: side_right, side_left, demand_position, demand_loads, demand_axle_load, demand_rest
    public :: most_contacts, standard_accuracy, standard_join, is_same_demand

    !> Given: places in arrays of both sides.
    integer, parameter :: side_right = 1
    integer, parameter :: side_left = 2

    !> z and roll are those of the state.
    !> Given: numbers of kinds.
    integer, parameter :: demand_position = 0
    !> Each wheel asked for has its own vertical force, with a z of its own; roll is the state's.
    !> Given: a number of kinds.
    integer, parameter :: demand_loads = 1
    !> Both wheels carry the axle load together; z, and roll if it is free, are found.
    !> Given: a number of kinds.
    integer, parameter :: demand_axle_load = 2

    !> Static equilibrium: both wheels carry the axle load, z and roll are found, nothing moves,
    !> whatever rates the state has, so that there are no friction forces.
    !> Given: a number of kinds.
    integer, parameter :: demand_rest = 3

    ! Regions nearer than this are one contact.
    ! Tuned [mm]. Origin: as CONTACT separates patches.
    real(wp), parameter :: standard_join = 8.0_wp
    ! From half as far again on they turn.
    real(wp), parameter :: standard_turn = standard_join + 0.5_wp*standard_join
    ! Gaps stand over their deepest point, not over a rigid contact: over ten times the usual
    ! penetration.
    real(wp), parameter :: standard_height = 0.5_wp*standard_gap_height

    !> How well the heights of profiles are known.
    !> Tuned [mm]. Origin: drawings and profilometers; `est_err_load` is in proportion.
    real(wp), parameter :: standard_accuracy = 0.5e-3_wp

    !> Most contacts of one wheel.
    integer, parameter :: most_contacts = most_regions

    !> Wheels, rails, and how contacts are solved; made once by `make_wheelset`, then only read.
    type :: wheelset_model_t
        type(wheel_on_rail_t) :: pair(2)        !! right; left, in a mirror
        real(wp) :: radius = 0.0_wp             !! mean of the nominal radii, mm
        type(contact_case_t) :: case            !! material, friction, methods; its load, gap and
                                                !! creepages are not used
        real(wp) :: join_distance = standard_join !! regions nearer than this are one contact, mm
        real(wp) :: turn_distance = standard_turn
            !! contacts nearer than this turn towards the angle they will have as one, slide in
            !! its plane and press each other's bodies in, mm
        real(wp) :: gap_height = standard_height  !! how high gaps are sampled, mm
        real(wp) :: damping = 0.0_wp
            !! share by which forces of a contact grow with its approach rate, s/mm; 0: none
        real(wp) :: speed_floor = 0.0_wp
            !! of rolling speeds, below which forces grow with the velocities, mm/s; 0: none
        real(wp) :: rail_stiffness(2) = 0.0_wp
            !! of the springs below each rail, along y and z, N/mm; 0: it does not give way
        real(wp) :: profile_accuracy = standard_accuracy
            !! of the heights of profiles, for `est_err_load`, mm
        type(lookup_t), pointer :: lookup => null()
            !! of `enter_lookup`, the caller's: answers within its ends, strips beyond, both before
            !! an end; null: none
        integer :: lookup_order = lookup_cubic    !! of its interpolation
    end type wheelset_model_t

    !> What is prescribed.
    type :: wheelset_demand_t
        integer :: kind = demand_loads                     !! one of the `demand_` numbers
        logical :: wants(2) = .true.                       !! which wheels: right, left
        real(wp) :: load(2) = 0.0_wp                       !! vertical force of each wheel, N
        real(wp) :: axle_load = 0.0_wp                     !! of both, N
        logical :: roll_is_free = .false.                  !! is the roll found?
        real(wp) :: roll_moment = 0.0_wp
            !! moment about the wheelset's centre along the track that the frame exerts on it, N mm
        logical :: axle_moment_is_given = .false.          !! is the pitch rate found?
        real(wp) :: axle_moment = 0.0_wp
            !! moment about the axle that a drive or brake exerts on the wheelset, and the contacts
            !! of the wheels asked for carry: negative drives ahead, as the pitch rate, N mm
        real(wp) :: tolerance = 0.0_wp
            !! of `demand_loads`: misfit of the load at which its height is found; 0: as near as it
            !! comes
        real(wp) :: bracket = 0.0_wp
            !! the same of the heights between which the force jumps over the load, over the larger
            !! approach
    end type wheelset_demand_t

    !> One contact of a wheel. Left and right have the same frame: x ahead, y to the right, turned
    !> about x by the contact angle.
    type :: wheel_contact_t
        type(status_t) :: status                    !! of its solution
        real(wp) :: place(3) = 0.0_wp               !! reference point in the track, mm
        real(wp) :: angle = 0.0_wp                  !! contact angle, rad
        real(wp) :: turn = 0.0_wp                   !! of its frame about y, on a roller, rad
        real(wp) :: lift = 0.0_wp                   !! as of its frame, mm
        real(wp) :: rail(2) = 0.0_wp                !! y, z of it on the rail's profile, mm
        real(wp) :: wheel(3) = 0.0_wp               !! x, y, z of it in the frame of the wheel's
                                                    !! profile, mm
        real(wp) :: radius = 0.0_wp                 !! rolling radius, mm
        real(wp) :: speed = 0.0_wp                  !! rolling speed, mm/s
        type(creepage_t) :: creepage                !! -, -, rad/mm
        real(wp) :: approach_rate = 0.0_wp          !! of wheel and rail along the normal, mm/s
        type(contact_result_t) :: figures           !! of the contact's solution
        real(wp) :: est_err_load = 0.0_wp
            !! by how much profiles as exact as the model says may move the normal force, over it
        real(wp) :: force(3) = 0.0_wp               !! on the rail, in the track, with damping, N
        real(wp) :: force_wheelset(3) = 0.0_wp      !! the same in the wheelset's frame, N
        real(wp) :: moment(3) = 0.0_wp
            !! of it about the wheelset's centre, with those of pressures and about the normal, N mm
    end type wheel_contact_t

    !> The contacts of one wheel.
    type :: wheel_result_t
        type(status_t) :: status                         !! the worst of its contacts
        integer :: n = 0                                 !! number of contacts
        type(wheel_contact_t) :: contact(most_contacts)  !! along y
        real(wp) :: z = 0.0_wp                           !! of the wheelset's centre, mm
        real(wp) :: roll = 0.0_wp                        !! rad
        real(wp) :: force(3) = 0.0_wp                    !! on the rail, in the track, N
        real(wp) :: force_wheelset(3) = 0.0_wp           !! the same in the wheelset's frame, N
        real(wp) :: moment(3) = 0.0_wp                   !! about the wheelset's centre, in the
                                                         !! track, N mm
        integer :: solutions = 0                         !! contact problems that were solved; 0 of
                                                         !! a wheel that a table alone answers for
    end type wheel_result_t

    !> Figures of a wheelset.
    type :: wheelset_result_t
        type(wheel_result_t) :: wheel(2) !! right, left; those that were asked for
        real(wp) :: pitch_rate = 0.0_wp  !! as given, of pure rolling, or found, rad/s
    end type wheelset_result_t

    !> Everything that one wheel's solutions need beside the model.
    type :: wheel_workspace_t
        type(outline_t) :: outline                    !! of the last state
        type(frame_gap_t) :: gap                      !! of the last contact
        type(workspace_t), allocatable :: contact(:)  !! one a contact
        integer :: n = 0                              !! contacts of the last solution, 0: none
        real(wp) :: approach = 0.0_wp                 !! of the last solution, from first touch, mm
        real(wp) :: slope = 0.0_wp
            !! of the force over the load, to the power 2/3, there; 0: not known, 1/mm
        type(region_t) :: region(most_contacts)       !! of the last solution
        real(wp) :: left_out(most_contacts) = 0.0_wp
            !! how far their gaps are from what strips take them for, over the overlap of the bodies
        real(wp) :: beside(most_contacts, most_contacts) = 0.0_wp
            !! what the load of the second contact presses in at the first, over that load, mm/N
        real(wp) :: strips_share(most_contacts) = 1.0_wp
            !! share of strips in their forces; of auto the rest is that of a Hertz ellipse
        type(force_errors_t) :: ellipse_errors(most_contacts) !! of such an ellipse
        logical :: is_guided = .false.
            !! is a height being looked for by strips, for another method to take?
        integer :: steps = 0 !! of the contacts' solver in this call
    end type wheel_workspace_t

    !> The last solutions for loads, and what changed between the last two.
    type :: path_t
        real(wp) :: place(4) = 0.0_wp  !! where, as lengths, mm
        real(wp) :: motion(4) = 0.0_wp !! from the one before, mm
        real(wp) :: found(3) = 0.0_wp
            !! approaches over the load to 2/3, right and left, mm/N**(2/3); roll, rad
        real(wp) :: change(3) = 0.0_wp !! of these
    end type path_t

    !> Everything that solutions need beside the model; owned by the caller, one per thread.
    type :: wheelset_workspace_t
        type(wheel_workspace_t) :: wheel(2)   !! right, left
        type(wheelset_state_t) :: last_state  !! of the last solution, with its z and roll
        logical :: has_last = .false.         !! was there one?
        logical :: is_reversed(2) = .false.   !! does each wheel roll backwards?
        type(path_t) :: path                  !! of the last solutions
        real(wp) :: stiffness(2, 2) = 0.0_wp
            !! of load and roll moment over z and roll at the last balance; 0: not known, N/mm, N,
            !! N, N mm
        real(wp) :: deflection(2, 2) = 0.0_wp
            !! of the rails at the last solution, y and z of right and left, mm
        type(wheel_result_t), allocatable :: near(:) !! (1) a neighbour, for derivatives
    end type wheelset_workspace_t

contains

    !> Do two demands ask the same?
    pure logical function is_same_demand(one, other) result(is_same)
        type(wheelset_demand_t), intent(in) :: one   !! a demand
        type(wheelset_demand_t), intent(in) :: other !! another one

        is_same = one%kind == other%kind .and. all(one%wants .eqv. other%wants) &
                  .and. (one%roll_is_free .eqv. other%roll_is_free) &
                  .and. (one%axle_moment_is_given .eqv. other%axle_moment_is_given) &
                  .and. all(one%load == other%load) .and. one%axle_load == other%axle_load &
                  .and. one%roll_moment == other%roll_moment &
                  .and. one%axle_moment == other%axle_moment &
                  .and. one%tolerance == other%tolerance .and. one%bracket == other%bracket
    end function is_same_demand
end module faststrip_wheelset_types
