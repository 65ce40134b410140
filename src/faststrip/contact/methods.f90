!> Which methods a contact is solved by, and how finely: numbers for programs, names for people.
module faststrip_contact_methods
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, count_text, &
                                     st_bad_argument
    use faststrip_normal_strip, only: strips_auto
    use faststrip_normal_strips, only: usual_strips
    use faststrip_tangential_types, only: most_points, most_rows
    implicit none
    private

    public :: contact_methods_t, normal_method, tangential_method
    public :: normal_method_name, tangential_method_name, method_name_length
    public :: method_t, normal_table, tangential_table, is_in_core
    public :: most_strips, most_rows, usual_rows, usual_side
    public :: check_normal_method, check_tangential_method, check_resolutions
    public :: start_strips, start_last

    !> Length of a method's name, characters.
    !> Given: the longest name fits.
    integer, parameter :: method_name_length = 24

    !> One method.
    type :: method_t
        integer :: number = -1                        !! for programs
        character(len=method_name_length) :: name = '' !! for people
        character(len=16) :: needs = ''               !! what it works on, or the library it needs
        character(len=96) :: help = ''                !! what it is, in one line
        logical :: in_core = .true.                   !! is it in the embeddable core?
        logical :: gives_elements = .true.            !! tractions, or forces only?
        logical :: gives_stick = .true.               !! how much of the contact sticks?
        logical :: takes_falling = .false.            !! friction that falls with slip?
        logical :: takes_hot = .false.                !! friction that falls with temperature?
    end type method_t

    ! Numbers of the methods, from the tables below; written by tools/generate/methods.py.
    ! BEGIN methods
    public :: normal_strip, normal_hertz, normal_equal_area, normal_equal_moments, normal_auto, &
              normal_kpec, normal_analyn, normal_kpec_strips
    integer, parameter :: normal_strip = 1
        !! strips, for any patch and any number of patches
    integer, parameter :: normal_hertz = 2
        !! the Hertz ellipse where the gap is lowest
    integer, parameter :: normal_equal_area = 3
        !! ellipses of equal area, proportions of Hertz
    integer, parameter :: normal_equal_moments = 4
        !! the same, proportions of the second moments
    integer, parameter :: normal_auto = 6
        !! both methods, as fine as estimated errors ask
    integer, parameter :: normal_kpec = 7
        !! Kik and Piotrowski with the elliptic correction
    integer, parameter :: normal_analyn = 8
        !! Sichani, Enblom and Berg, strips as local ellipses
    integer, parameter :: normal_kpec_strips = 9
        !! strips in the patch of KPEC, pressures their own
    integer, parameter, public :: normal_norm = 5
        !! NORM, Kalker's variational method: the reference
    public :: tangential_none, tangential_faststrip, tangential_fastsim, &
              tangential_faststrip_paper, tangential_faststrip_corrected, &
              tangential_fastsim_elliptic, tangential_fastsim_weighted, tangential_linear, &
              tangential_she, tangential_polach, tangential_faststrip_plain
    integer, parameter :: tangential_none = 0
        !! no forces
    integer, parameter :: tangential_faststrip = 1
        !! marching in the strips: the best fast one
    integer, parameter :: tangential_fastsim = 2
        !! Kalker's FASTSIM on the patches' ellipses
    integer, parameter :: tangential_faststrip_paper = 3
        !! TFASTSTRIP as printed
    integer, parameter :: tangential_faststrip_corrected = 4
        !! TFASTSTRIP as corrected
    integer, parameter :: tangential_fastsim_elliptic = 5
        !! FASTSIM with the elliptic traction bound
    integer, parameter :: tangential_fastsim_weighted = 6
        !! FASTSIM with a single flexibility
    integer, parameter :: tangential_linear = 7
        !! Kalker's linear theory; no elements
    integer, parameter :: tangential_she = 8
        !! Shen, Hedrick and Elkins; no elements
    integer, parameter :: tangential_polach = 9
        !! Polach; no elements
    integer, parameter :: tangential_faststrip_plain = 11
        !! FASTSTRIP without its correction
    integer, parameter, public :: tangential_tang = 10
        !! TANG, Kalker's variational method: the reference
    ! END methods

    ! The one list of the methods. From it come the names of the command line and its help; and,
    ! written by tools/generate/methods.py, the numbers above, what `use faststrip` gives, the
    ! enumerations of the C header, the comment of the F77 interface, Python's dictionaries, the
    ! README's tables. A number stays for ever: host programs know it.

    !> The normal methods, in the order that people see.
    type(method_t), parameter :: normal_table(*) = [ &
        method_t(1, 'strip', needs='LAPACK', &
                 help='strips, for any patch and any number of patches'), &
        method_t(2, 'hertz', needs='an ellipse', &
                 help='the Hertz ellipse where the gap is lowest'), &
        method_t(3, 'equal_area', needs='LAPACK', &
                 help='ellipses of equal area, proportions of Hertz'), &
        method_t(4, 'equal_moments', needs='LAPACK', &
                 help='the same, proportions of the second moments'), &
        method_t(7, 'kpec', needs='a convex gap', &
                 help='Kik and Piotrowski with the elliptic correction'), &
        method_t(9, 'kpec_strips', needs='a convex gap', &
                 help='strips in the patch of KPEC, pressures their own'), &
        method_t(8, 'analyn', needs='a smooth gap', &
                 help='Sichani, Enblom and Berg, strips as local ellipses'), &
        method_t(5, 'norm', needs='FFTW', in_core=.false., &
                 help='NORM, Kalker''s variational method: the reference'), &
        method_t(6, 'auto', needs='LAPACK', &
                 help='both methods, as fine as estimated errors ask')]

    !> The tangential methods, in the order that people see.
    type(method_t), parameter :: tangential_table(*) = [ &
        method_t(1, 'faststrip', needs='strips', takes_falling=.true., takes_hot=.true., &
                 help='marching in the strips: the best fast one'), &
        method_t(11, 'faststrip-plain', needs='strips', takes_falling=.true., takes_hot=.true., &
                 help='FASTSTRIP without its correction'), &
        method_t(3, 'faststrip-paper', needs='strips', help='TFASTSTRIP as printed'), &
        method_t(4, 'faststrip-corrected', needs='strips', help='TFASTSTRIP as corrected'), &
        method_t(2, 'fastsim', needs='ellipses', takes_falling=.true., takes_hot=.true., &
                 help='Kalker''s FASTSIM on the patches'' ellipses'), &
        method_t(5, 'fastsim-elliptic', needs='ellipses', takes_falling=.true., takes_hot=.true., &
                 help='FASTSIM with the elliptic traction bound'), &
        method_t(6, 'fastsim-weighted', needs='ellipses', takes_falling=.true., takes_hot=.true., &
                 help='FASTSIM with a single flexibility'), &
        method_t(7, 'linear', needs='ellipses', gives_elements=.false., &
                 help='Kalker''s linear theory'), &
        method_t(8, 'she', needs='ellipses', gives_elements=.false., gives_stick=.false., &
                 help='Shen, Hedrick and Elkins'), &
        method_t(9, 'polach', needs='ellipses', gives_elements=.false., gives_stick=.false., &
                 help='Polach'), &
        method_t(10, 'tang', needs='FFTW', in_core=.false., takes_falling=.true., &
                 help='TANG, Kalker''s variational method: the reference'), &
        method_t(0, 'none', takes_falling=.true., takes_hot=.true., help='no forces')]

    !> Most strips per patch: as many as points along one.
    integer, parameter :: most_strips = most_points

    !> Most elements of a grid of norm or tang, unless the user says otherwise.
    !> Tuned [elements]. Origin: capacity: solved within about five seconds on one core; the time
    !> grows with their number.
    integer, parameter :: standard_max_elements = 1000000

    !> Rows of FASTSIM where nobody says how many, and points along each.
    !> Tuned [rows]. Origin: chosen.
    integer, parameter :: usual_rows = 50
    !> Sides of elements of norm and tang where nobody says how long.
    !> Tuned [mm]. Origin: chosen: errors of some tenths of a percent on usual contacts.
    real(wp), parameter :: usual_side = 0.2_wp

    !> What norm starts from: a coarser grid, which gives errors too; strips; the strips that are in
    !> the workspace.
    !> Given: numbers of kinds.
    integer, parameter :: start_coarse = 1, start_strips = 2, start_last = 3

    !> Methods and resolutions.
    type :: contact_methods_t
        integer :: normal = normal_strip             !! one of the `normal_` numbers
        integer :: tangential = tangential_faststrip !! one of the `tangential_` numbers
        integer :: strips_per_patch = usual_strips
            !! strips across the largest patch, or `strips_auto`
        integer :: points_per_strip = usual_strips !! points along a strip, faststrip...
        integer :: fastsim_nx = usual_rows      !! points along a row, fastsim...
        integer :: fastsim_ny = usual_rows      !! rows, fastsim...
        real(wp) :: element_dx = usual_side     !! side of an element along x, norm, tang, mm
        real(wp) :: element_dy = usual_side     !! side of an element along y, norm, tang, mm
        logical :: dx_is_given = .false. !! else it is shorter where the contact is small
        logical :: dy_is_given = .false. !! the same along y
        real(wp) :: error_target = 0.0_wp
            !! of penetration and pmax, norm; sets the sides if positive
        integer :: max_elements = standard_max_elements !! of a grid, norm, tang
        integer :: norm_start = start_coarse !! what norm starts from: one of the `start_` numbers
    end type contact_methods_t

contains

    !> Refuse a number that is no normal method of the core.
    pure subroutine check_normal_method(number, status)
        integer, intent(in) :: number         !! as the caller set it
        type(status_t), intent(out) :: status !! `st_bad_argument`

        call clear_status(status)
        call check_method('normal', row_of(normal_table, number), number, status)
    end subroutine check_normal_method

    !> Refuse a number that is no tangential method of the core.
    pure subroutine check_tangential_method(number, status)
        integer, intent(in) :: number         !! as the caller set it
        type(status_t), intent(out) :: status !! `st_bad_argument`

        call clear_status(status)
        call check_method('tangential', row_of(tangential_table, number), number, status)
    end subroutine check_tangential_method

    !> Refuse resolutions out of range.
    pure subroutine check_resolutions(methods, status)
        type(contact_methods_t), intent(in) :: methods !! as the caller set them
        type(status_t), intent(inout) :: status        !! changed by an error, `st_bad_argument`

        if ((methods%strips_per_patch < 1 .and. &
             methods%strips_per_patch /= strips_auto) .or. &
            methods%strips_per_patch > most_strips) then
            call set_status(status, st_bad_argument, 'strips per patch must be 1 to 1000, or ' // &
                            '0 (left to the solver), got ' // &
                            count_text(methods%strips_per_patch))
        else if (methods%points_per_strip < 1 .or. methods%points_per_strip > most_points) then
            call set_status(status, st_bad_argument, 'points per strip must be 1 to 1000, got ' // &
                            count_text(methods%points_per_strip))
        else if (min(methods%fastsim_nx, methods%fastsim_ny) < 1 .or. &
                 max(methods%fastsim_nx, methods%fastsim_ny) > most_rows) then
            call set_status(status, st_bad_argument, 'points along a row of FASTSIM and rows ' // &
                            'must be 1 to 10000, got ' // &
                            trim(count_text(methods%fastsim_nx)) // ' and ' // &
                            count_text(methods%fastsim_ny))
        end if
    end subroutine check_resolutions

    !> Refuse a number that the table has no method of the core for.
    pure subroutine check_method(part, method, number, status)
        character(len=*), intent(in) :: part
        type(method_t), intent(in) :: method ! its row
        integer, intent(in) :: number
        type(status_t), intent(inout) :: status

        if (method%number < 0) then
            call set_status(status, st_bad_argument, &
                            part // ' method must be one of the list, got ' // &
                            count_text(number))
        else if (.not. method%in_core) then
            call set_status(status, st_bad_argument, 'no ' // part // ' method of the core: ' // &
                            trim(count_text(number)) // ', ' // method%name)
        end if
    end subroutine check_method

    !> The number of the normal method of this name; -1 if there is none.
    pure integer function normal_method(name)
        character(len=*), intent(in) :: name !! lower case, trailing blanks do not matter

        normal_method = number_of(normal_table, name)
    end function normal_method

    !> The number of the tangential method of this name; -1 if there is none.
    pure integer function tangential_method(name)
        character(len=*), intent(in) :: name !! lower case, trailing blanks do not matter

        tangential_method = number_of(tangential_table, name)
    end function tangential_method

    !> The name of a normal method; blank if there is none.
    pure function normal_method_name(method) result(name)
        integer, intent(in) :: method            !! one of the `normal_` numbers
        character(len=method_name_length) :: name !! blank-padded

        name = name_of(normal_table, method)
    end function normal_method_name

    !> The name of a tangential method; blank if there is none.
    pure function tangential_method_name(method) result(name)
        integer, intent(in) :: method            !! one of the `tangential_` numbers
        character(len=method_name_length) :: name !! blank-padded

        name = name_of(tangential_table, method)
    end function tangential_method_name

    !> Is it a method of the library's core?
    pure logical function is_in_core(table, number)
        type(method_t), intent(in) :: table(:) !! `normal_table` or `tangential_table`
        integer, intent(in) :: number          !! of the method

        is_in_core = any(table%number == number .and. table%in_core)
    end function is_in_core

    !> The row of a number; number -1 if there is none.
    pure type(method_t) function row_of(table, number) result(row)
        type(method_t), intent(in) :: table(:)
        integer, intent(in) :: number

        integer :: i

        do i = 1, size(table)
            if (table(i)%number == number) row = table(i)
        end do
    end function row_of

    pure function name_of(table, number) result(name)
        type(method_t), intent(in) :: table(:)
        integer, intent(in) :: number
        character(len=method_name_length) :: name

        integer :: i

        name = ''
        do i = 1, size(table)
            if (table(i)%number == number) name = table(i)%name
        end do
    end function name_of

    pure integer function number_of(table, name) result(number)
        type(method_t), intent(in) :: table(:)
        character(len=*), intent(in) :: name

        integer :: i

        number = -1
        do i = 1, size(table)
            if (table(i)%name == name) number = table(i)%number
        end do
    end function number_of
end module faststrip_contact_methods
