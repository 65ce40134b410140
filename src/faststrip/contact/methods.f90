!> Which methods a contact is solved by, and how finely: numbers for programs, names for people.
module faststrip_contact_methods
    use faststrip_base_status, only: status_t, set_status, clear_status, count_text, st_bad_argument
    use faststrip_normal_strip, only: strips_auto
    use faststrip_tangential_types, only: most_points
    implicit none
    private

    public :: contact_methods_t, check_contact_methods, normal_method, tangential_method
    public :: normal_method_name, tangential_method_name, method_name_length
    public :: normal_strip, normal_hertz, normal_equal_area, normal_equal_moments
    public :: tangential_none, tangential_faststrip, tangential_fastsim
    public :: tangential_faststrip_paper, tangential_faststrip_corrected
    public :: tangential_fastsim_elliptic, tangential_fastsim_weighted
    public :: tangential_linear, tangential_she, tangential_polach
    public :: gives_elements, gives_stick
    public :: most_strips, most_rows

    integer, parameter :: normal_strip = 1         !! strips
    integer, parameter :: normal_hertz = 2         !! the Hertz ellipse where the gap is lowest
    integer, parameter :: normal_equal_area = 3    !! the strips' patches as ellipses of their area,
                                                   !! proportions of Hertz
    integer, parameter :: normal_equal_moments = 4 !! the same, proportions of the second moments

    integer, parameter :: tangential_none = 0      !! no forces
    integer, parameter :: tangential_faststrip = 1 !! marching in the strips
    integer, parameter :: tangential_fastsim = 2   !! Kalker's, on the patches' ellipses
    integer, parameter :: tangential_faststrip_paper = 3     !! TFASTSTRIP as printed
    integer, parameter :: tangential_faststrip_corrected = 4 !! TFASTSTRIP as corrected
    integer, parameter :: tangential_fastsim_elliptic = 5    !! FASTSIM with the elliptic bound
    integer, parameter :: tangential_fastsim_weighted = 6    !! FASTSIM with a single flexibility
    integer, parameter :: tangential_linear = 7 !! Kalker's linear theory; forces only, like
    integer, parameter :: tangential_she = 8    !! Shen, Hedrick and Elkins, and
    integer, parameter :: tangential_polach = 9 !! Polach

    !> Length of a method's name, characters.
    integer, parameter :: method_name_length = 24
    character(len=method_name_length), parameter :: normal_names(4) = &
        [character(len=method_name_length) :: 'strip', 'hertz', 'equal_area', 'equal_moments']
    character(len=method_name_length), parameter :: tangential_names(0:9) = &
        [character(len=method_name_length) :: 'none', 'faststrip', 'fastsim', &
         'faststrip-paper', 'faststrip-corrected', 'fastsim-elliptic', 'fastsim-weighted', &
         'linear', 'she', 'polach']

    !> Most strips per patch.
    integer, parameter :: most_strips = 1000
    !> Most rows, and most points along a row, of FASTSIM.
    integer, parameter :: most_rows = 10000

    !> Methods and resolutions.
    type :: contact_methods_t
        integer :: normal = normal_strip             !! one of the `normal_` numbers
        integer :: tangential = tangential_faststrip !! one of the `tangential_` numbers
        integer :: strips_per_patch = 15 !! strips across the largest patch, or `strips_auto`
        integer :: points_per_strip = 15 !! points along a strip, faststrip...
        integer :: fastsim_nx = 50       !! points along a row, fastsim...
        integer :: fastsim_ny = 50       !! rows, fastsim...
    end type contact_methods_t

contains

    !> Refuse methods that do not exist and resolutions out of range.
    pure subroutine check_contact_methods(methods, status)
        type(contact_methods_t), intent(in) :: methods !! as the caller set them
        type(status_t), intent(out) :: status          !! `st_bad_argument`

        call clear_status(status)
        if (methods%normal < 1 .or. methods%normal > size(normal_names)) then
            call set_status(status, st_bad_argument, 'no such normal method: ' // &
                            count_text(methods%normal))
        else if (methods%tangential < 0 .or. methods%tangential > ubound(tangential_names, 1)) then
            call set_status(status, st_bad_argument, 'no such tangential method: ' // &
                            count_text(methods%tangential))
        else if ((methods%strips_per_patch < 1 .and. &
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
    end subroutine check_contact_methods

    !> The number of the normal method of this name; -1 if there is none.
    pure integer function normal_method(name)
        character(len=*), intent(in) :: name !! lower case, trailing blanks do not matter

        normal_method = position(name, normal_names)
        if (normal_method == 0) normal_method = -1
    end function normal_method

    !> The number of the tangential method of this name; -1 if there is none.
    pure integer function tangential_method(name)
        character(len=*), intent(in) :: name !! lower case, trailing blanks do not matter

        tangential_method = position(name, tangential_names) - 1
    end function tangential_method

    !> The name of a normal method; blank if there is none.
    pure function normal_method_name(method) result(name)
        integer, intent(in) :: method            !! one of the `normal_` numbers
        character(len=method_name_length) :: name !! blank-padded

        name = ''
        if (method >= 1 .and. method <= size(normal_names)) name = normal_names(method)
    end function normal_method_name

    !> The name of a tangential method; blank if there is none.
    pure function tangential_method_name(method) result(name)
        integer, intent(in) :: method            !! one of the `tangential_` numbers
        character(len=method_name_length) :: name !! blank-padded

        name = ''
        if (method >= 0 .and. method <= ubound(tangential_names, 1)) &
            name = tangential_names(method)
    end function tangential_method_name

    !> Does a tangential method know tractions, or forces only?
    elemental logical function gives_elements(method)
        integer, intent(in) :: method !! one of the `tangential_` numbers

        gives_elements = method /= tangential_linear .and. method /= tangential_she &
                         .and. method /= tangential_polach
    end function gives_elements

    !> Does a tangential method know how much of the contact sticks?
    elemental logical function gives_stick(method)
        integer, intent(in) :: method !! one of the `tangential_` numbers

        gives_stick = gives_elements(method) .or. method == tangential_linear
    end function gives_stick

    pure integer function position(name, names)
        character(len=*), intent(in) :: name, names(:)

        do position = size(names), 1, -1
            if (names(position) == name) return
        end do
    end function position
end module faststrip_contact_methods
