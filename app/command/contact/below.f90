!> Stresses of the rail below a contact, on a grid of points: `faststrip contact CASE --below FILE`.
module faststrip_command_contact_below
    use faststrip_base_kinds, only: wp
    use faststrip_base_limits, only: half_digits, largest_place
    use faststrip_base_status, only: status_t, number_text
    use faststrip_base_text, only: parse_real, integer_text
    use faststrip_files_csv, only: csv_writer_t, put_comment, put_header, put_cells, end_row
    use faststrip_kalker_stresses, only: find_grid_stresses
    use faststrip_stress_invariants, only: von_mises, principal_stresses, tresca
    use faststrip_stress_loads, only: loads_t
    use faststrip_stress_rectangle, only: n_stresses
    use faststrip_command_program_console, only: put_origin, fail_on_error, usage_error
    use faststrip_command_program_options, only: command_t, option_t, given, option_text, &
                                                 refuse_value
    implicit none
    private

    public :: below_options, points_t, take_points, find_below, put_below

    !> The options that say where.
    character(len=*), parameter :: lists(3) = [character(len=9) :: &
        '--below-x', '--below-y', '--below-z']

    !> Names of the columns.
    character(len=*), parameter :: columns(*) = [character(len=13) :: &
        'x_mm', 'y_mm', 'z_mm', 'sxx_MPa', 'syy_MPa', 'szz_MPa', 'sxy_MPa', 'sxz_MPa', 'syz_MPa', &
        'von_mises_MPa', 'tresca_MPa', 's1_MPa', 's2_MPa', 's3_MPa']

    ! Tuned [points]: of all three lists together. Origin: capacity: 1 GB of memory.
    integer, parameter :: most_places = 10000000
    ! Tuned [points]: of a grid of the program's choice, about, across the contact, and in depth.
    ! Origin: chosen for pictures.
    integer, parameter :: usual_across = 20, usual_depths = 16
    ! Tuned [1]: part of the contact that such a grid goes beyond it on either side. Origin: chosen.
    real(wp), parameter :: beyond = 0.25_wp

    !> Places along one axis.
    type :: places_t
        real(wp), allocatable :: at(:) !! mm; not allocated: of the program's choice
    end type places_t

    !> Where stresses are asked for, and what they are.
    type :: points_t
        type(places_t) :: axis(3)                      !! along x, y and z
        real(wp), allocatable :: stresses(:, :, :, :)  !! of `find_below`, MPa
    end type points_t

contains

    !> The options that say where.
    function below_options() result(options)
        type(option_t), allocatable :: options(:)

        options = [option_t('--below', 'FILE', 'write stresses of the rail below the contact' &
                            // new_line('a') // 'there', writes=.true.), &
                   option_t(lists(1), 'LIST', 'at these x, in mm, as -9:9:0.1 or 0,1,2.5' &
                            // new_line('a') // '(default: a grid around the contact)'), &
                   option_t(lists(2), 'LIST', 'at these y'), &
                   option_t(lists(3), 'LIST', 'at these depths (default: from half a step on, for' &
                            // new_line('a') // 'on the surface stresses hold at middles of ' // &
                            'elements alone)')]
    end function below_options

    !> Read where stresses are asked for; a usage error if that is nowhere.
    subroutine take_points(command, points)
        type(command_t), intent(in) :: command  !! parsed
        type(points_t), intent(out) :: points   !! places that were given

        real(wp) :: n
        logical :: is_read
        integer :: k

        n = 1.0_wp
        do k = 1, size(lists)
            if (.not. given(command, lists(k))) cycle
            if (.not. given(command, '--below')) &
                call usage_error(lists(k) // ' needs --below', command%name)
            call read_list(option_text(command, lists(k), ''), points%axis(k)%at, is_read)
            if (.not. is_read) &
                call refuse_value(command, lists(k), 'numbers in mm, as 0:9:0.1 (from, to, ' // &
                                  'step) or 0,1,2.5')
            if (k == 3 .and. any(points%axis(k)%at < 0.0_wp)) &
                call refuse_value(command, lists(k), 'depths from 0 on')
            n = n*size(points%axis(k)%at)
        end do
        if (n > most_places) call usage_error('--below takes at most ' // &
            integer_text(most_places) // ' points, got ' // trim(number_text(n)), command%name)
    end subroutine take_points

    !> Numbers, parted by commas, or ranges of them, FROM:TO:STEP.
    subroutine read_list(text, numbers, is_read)
        character(len=*), intent(in) :: text
        real(wp), allocatable, intent(out) :: numbers(:)
        logical, intent(out) :: is_read

        real(wp), allocatable :: range(:)
        integer :: first, comma, i

        allocate (numbers(0))
        first = 1
        is_read = .true.
        do while (is_read .and. first <= len(text) + 1)
            comma = index(text(first:) // ',', ',') + first - 1
            call split(text(first:comma - 1), range, is_read)
            if (is_read) is_read = all(abs(range) <= largest_place)
            if (is_read .and. size(range) == 3) then
                is_read = range(3) > 0.0_wp .and. range(2) >= range(1)
                if (is_read) is_read = (range(2) - range(1))/range(3) < most_places
                if (is_read) range = [(range(1) + i*range(3), &
                                       i=0, floor((range(2) - range(1))/range(3) + half_digits))]
            else if (is_read) then
                is_read = size(range) == 1
            end if
            if (is_read) numbers = [numbers, range]
            first = comma + 1
        end do
    end subroutine read_list

    !> Numbers parted by colons.
    subroutine split(text, numbers, is_read)
        character(len=*), intent(in) :: text
        real(wp), allocatable, intent(out) :: numbers(:)
        logical, intent(out) :: is_read

        real(wp) :: number
        integer :: first, colon

        allocate (numbers(0))
        first = 1
        do
            colon = index(text(first:) // ':', ':') + first - 1
            call parse_real(text(first:colon - 1), number, is_read)
            if (.not. is_read) return
            numbers = [numbers, number]
            first = colon + 1
            if (first > len(text) + 1) return
        end do
    end subroutine split

    !> Find the stresses below a contact that was solved for them.
    subroutine find_below(loads, nu, points)
        type(loads_t), intent(in) :: loads        !! of the contact
        real(wp), intent(in) :: nu                !! Poisson's ratio of the rail
        type(points_t), intent(inout) :: points   !! gets places and stresses

        type(status_t) :: status
        real(wp) :: half_width
        integer :: i

        associate (n => loads%n, x => points%axis(1), y => points%axis(2), z => points%axis(3))
            if (.not. allocated(x%at)) call choose(loads%x(:n), loads%dx(:n), x%at)
            if (.not. allocated(y%at)) call choose(loads%y(:n), loads%dy(:n), y%at)
            if (.not. allocated(z%at)) then
                half_width = 0.5_wp*min(maxval(loads%x(:n)) - minval(loads%x(:n)) + loads%dx(1), &
                                        maxval(loads%y(:n)) - minval(loads%y(:n)) + loads%dy(1))
                z%at = [(2.0_wp*half_width*(i - 0.5_wp)/usual_depths, i=1, usual_depths)]
            end if
            allocate (points%stresses(n_stresses, size(x%at), size(y%at), size(z%at)), &
                      source=0.0_wp)
            call find_grid_stresses(loads, nu, x%at, y%at, z%at, points%stresses, status)
            call fail_on_error(status)
        end associate
    end subroutine find_below

    !> Places around the contact: middles of its elements, where these are equal, else evenly.
    pure subroutine choose(middles, sides, at)
        real(wp), intent(in) :: middles(:), sides(:)
        real(wp), allocatable, intent(out) :: at(:)

        real(wp) :: from, to, side
        integer :: n, more, i

        from = minval(middles)
        to = maxval(middles)
        side = (to - from + sides(1))/usual_across
        if (maxval(sides) - minval(sides) <= half_digits*sides(1)) &
            side = sides(1)*max(1, nint((to - from)/(sides(1)*usual_across)))
        n = nint((to - from)/side)
        more = nint(beyond*n) + 1
        at = [(from + i*side, i=-more, n + more)]
    end subroutine choose

    !> Write stresses and what they amount to, one row a point: x runs first, then y, then z.
    subroutine put_below(writer, points)
        type(csv_writer_t), intent(inout) :: writer !! an open file
        type(points_t), intent(in) :: points        !! of `find_below`

        real(wp) :: values(3)
        integer :: i, j, k

        call put_origin(writer)
        call put_comment(writer, 'stresses of the rail in the frame of the contact, z into the ' &
                         // 'rail; tension is positive')
        call put_header(writer, columns)
        do k = 1, size(points%axis(3)%at)
            do j = 1, size(points%axis(2)%at)
                do i = 1, size(points%axis(1)%at)
                    associate (stress => points%stresses(:, i, j, k))
                        values = principal_stresses(stress)
                        call put_cells(writer, [points%axis(1)%at(i), points%axis(2)%at(j), &
                                                points%axis(3)%at(k), stress, von_mises(stress), &
                                                tresca(values), values])
                    end associate
                    call end_row(writer)
                end do
            end do
        end do
    end subroutine put_below
end module faststrip_command_contact_below
