!> What a contact has that is outside of all practice: mostly a unit. Nothing is refused here, and
!> no figure changes.
module faststrip_contact_plausible
    use faststrip_base_friction, only: friction_constant
    use faststrip_base_kinds, only: wp
    use faststrip_base_plausible, only: is_plausible, doubt_about, quantities, stiffness, &
                                        of_friction, of_radius, of_gap_radius, of_load, &
                                        of_penetration, of_creepage, of_spin, of_gap_width, &
                                        of_gap_height, of_speed, of_slip_speed, of_pressure
    use faststrip_base_status, only: message_length, add_words
    use faststrip_contact_case, only: contact_case_t
    implicit none
    private

    public :: doubts_t, add_doubt, find_doubts, doubt_material, doubt_pressure
    public :: gap_size_t, gap_size, case_names_t

    !> Most words about one contact or one state of a wheelset: one of each quantity.
    integer, parameter :: most_doubts = size(quantities)

    !> What there is to say.
    type :: doubts_t
        integer :: n = 0
        integer :: quantity(most_doubts)                !! of these, places in the table
        character(len=message_length) :: words(most_doubts) !! one line each
    end type doubts_t

    !> What a gap tells of its units.
    type :: gap_size_t
        logical :: is_known = .false. !! else only the radius counts
        logical :: is_round = .false. !! is inv2r the same all over, as of a wheel without angle?
        real(wp) :: radius = 0.0_wp   !! 1/(2 inv2r) where the gap is lowest, mm; 0: not known
        real(wp) :: width = 0.0_wp    !! from the first to the last point, mm
        real(wp) :: steepness = 0.0_wp !! from the lowest to the highest point, over the width
        real(wp) :: lowest = 0.0_wp   !! height from which penetrations count, mm
    end type gap_size_t

    !> What the caller calls the numbers of a contact; one without a name is not looked at.
    type :: case_names_t
        character(len=24) :: e(2) = [character(len=24) :: 'e_wheel', 'e_rail']
        character(len=24) :: mu = 'mu'
        character(len=24) :: load = 'load'
        character(len=24) :: penetration = 'penetration'
        character(len=24) :: creepage(3) = [character(len=24) :: 'cksi', 'ceta', 'cphi']
        character(len=24) :: speed = 'speed'
        character(len=24) :: half_slip_speed = 'half_slip_speed'
        character(len=24) :: gap(3) = [character(len=24) :: 'y', 'h', 'inv2r']
    end type case_names_t

contains

    !> Keep words about a number, if there are any. Nothing is allocated, whatever it is.
    pure subroutine add_doubt(doubts, quantity, name, value, radius, before, behind)
        type(doubts_t), intent(inout) :: doubts  !! one more
        integer, intent(in) :: quantity          !! place in the table of quantities
        character(len=*), intent(in) :: name     !! as the caller knows it, with or without blanks
        real(wp), intent(in) :: value            !! in the unit of the table
        real(wp), intent(in), optional :: radius !! rolling radius, mm; 0: not known
        character(len=*), intent(in), optional :: before !! words in front of the name
        character(len=*), intent(in), optional :: behind !! words after it

        character(len=message_length) :: words
        integer :: n

        ! The numbers first: words take longer than a Hertz contact.
        if (is_plausible(quantity, value, radius)) return
        if (doubts%n == most_doubts .or. name == '') return
        words = ''
        n = 0
        if (present(before)) then
            words = before
            n = len(before)
        end if
        words(n + 1:) = name
        if (present(behind)) call add_words(words, behind)
        call add_words(words, doubt_about(quantity, '', value, radius))
        doubts%n = doubts%n + 1
        doubts%quantity(doubts%n) = quantity
        doubts%words(doubts%n) = words
    end subroutine add_doubt

    !> All that is outside of practice in a contact, and in the gap that it is solved on.
    pure subroutine find_doubts(case, size, names, doubts)
        type(contact_case_t), intent(in) :: case   !! checked or not; its gap does not count
        type(gap_size_t), intent(in) :: size       !! of the gap, or a rolling radius alone
        type(case_names_t), intent(in) :: names    !! what the caller calls the numbers
        type(doubts_t), intent(inout) :: doubts    !! more of them

        real(wp) :: radius

        if (size%is_known) call doubt_gap(size, names, doubts)
        radius = size%radius
        call doubt_material(case, names, doubts)
        ! What is not above 0 is an error, or no contact.
        if (case%by_load) then
            if (case%load > 0.0_wp) &
                call add_doubt(doubts, of_load, names%load, case%load, radius)
        else if (case%penetration > size%lowest) then
            call add_doubt(doubts, of_penetration, names%penetration, &
                           case%penetration - size%lowest, radius)
        end if
        call add_doubt(doubts, of_creepage, names%creepage(1), case%creepage%cksi)
        call add_doubt(doubts, of_creepage, names%creepage(2), case%creepage%ceta)
        call add_doubt(doubts, of_spin, names%creepage(3), case%creepage%cphi, radius)
        if (case%friction%kind == friction_constant) return
        call add_doubt(doubts, of_speed, names%speed, case%friction%speed)
        call add_doubt(doubts, of_slip_speed, names%half_slip_speed, &
                       case%friction%half_slip_speed)
    end subroutine find_doubts

    !> What is outside of practice in the bodies and their friction.
    pure subroutine doubt_material(case, names, doubts)
        type(contact_case_t), intent(in) :: case   !! checked or not
        type(case_names_t), intent(in) :: names    !! what the caller calls the numbers
        type(doubts_t), intent(inout) :: doubts    !! more of them

        associate (material => case%material)
            call add_doubt(doubts, stiffness(material%nu_wheel), names%e(1), material%e_wheel)
            call add_doubt(doubts, stiffness(material%nu_rail), names%e(2), material%e_rail)
        end associate
        call add_doubt(doubts, of_friction, names%mu, case%mu)
    end subroutine doubt_material

    !> Is the maximum pressure beyond what any steel carries?
    pure subroutine doubt_pressure(name, pmax, doubts)
        character(len=*), intent(in) :: name    !! as the caller knows it
        real(wp), intent(in) :: pmax            !! MPa
        type(doubts_t), intent(inout) :: doubts !! one more

        call add_doubt(doubts, of_pressure, name, pmax)
    end subroutine doubt_pressure

    pure subroutine doubt_gap(size, names, doubts)
        type(gap_size_t), intent(in) :: size
        type(case_names_t), intent(in) :: names
        type(doubts_t), intent(inout) :: doubts

        ! Under a contact angle inv2r is smaller, and not the same all over.
        call add_doubt(doubts, merge(of_radius, of_gap_radius, size%is_round .and. &
                                     size%radius > quantities(of_radius)%least), &
                       names%gap(3), size%radius, before='1/(2 ', behind=')')
        call add_doubt(doubts, of_gap_width, names%gap(1), size%width, size%radius, &
                       before='the width of ')
        call add_doubt(doubts, of_gap_height, names%gap(2), size%steepness, &
                       before='the range of ', behind=' over the width')
    end subroutine doubt_gap

    !> What a gap tells of its units.
    pure type(gap_size_t) function gap_size(y, h, inv2r) result(size_of)
        real(wp), intent(in) :: y(:)     !! lateral coordinate, rising, mm
        real(wp), intent(in) :: h(:)     !! gap, mm
        real(wp), intent(in) :: inv2r(:) !! 1/(2 R), 1/mm

        ! Given: of the digits that files are printed with.
        real(wp), parameter :: rounding = 1.0e-4_wp
        integer :: lowest

        if (size(y) < 2 .or. size(h) /= size(y) .or. size(inv2r) /= size(y)) return
        lowest = minloc(h, dim=1)
        size_of%width = y(size(y)) - y(1)
        if (.not. size_of%width > 0.0_wp) return
        size_of%is_known = .true.
        size_of%lowest = h(lowest)
        size_of%steepness = (maxval(h) - h(lowest))/size_of%width
        if (.not. inv2r(lowest) > 0.0_wp) return
        size_of%radius = 0.5_wp/inv2r(lowest)
        size_of%is_round = maxval(abs(inv2r - inv2r(lowest))) <= rounding*inv2r(lowest)
    end function gap_size
end module faststrip_contact_plausible
