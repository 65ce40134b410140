!> Which methods a contact is solved by, and how finely.
module faststrip_command_methods
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: number_text
    use faststrip_base_text, only: integer_text
    use faststrip_normal_limitations, only: default_resolution
    use faststrip_normal_strip, only: strips_auto
    use faststrip_tangential_types, only: most_points_per_strip => most_points
    implicit none
    private

    public :: methods_t, check_methods
    public :: most_strips, most_points, most_points_per_strip, most_elements
    public :: word_length, normal_methods, tangential_methods, norm_starts, targets, n_force_laws

    !> Length of a method's name, characters.
    integer, parameter :: word_length = 24
    !> Names of the normal methods: strips; the Hertz ellipse of the contact point; the strips'
    !> patches as ellipses, with the proportions of Hertz or of the second moments; Kalker's
    !> variational method; auto: normal and tangential method by the error that is expected.
    character(len=word_length), parameter :: normal_methods(6) = [character(len=word_length) :: &
        'strip', 'hertz', 'equal_area', 'equal_moments', 'norm', 'auto']
    !> Names of the tangential methods: marching in the strips (the best, the paper's, the paper's
    !> corrected); FASTSIM on ellipses, with the parabolic bound and three flexibilities, the
    !> elliptic bound, or one flexibility; laws that know forces only;
    !> Kalker's variational method; none.
    !> The first `n_force_laws` work on strips or ellipses.
    character(len=word_length), parameter :: tangential_methods(11) = &
        [character(len=word_length) :: 'faststrip', 'faststrip-paper', 'faststrip-corrected', &
         'fastsim', 'fastsim-elliptic', 'fastsim-weighted', 'linear', 'she', 'polach', 'tang', &
         'none']
    integer, parameter :: n_force_laws = 9
    !> What Kalker's method starts from: a coarser grid, which gives errors too, or strips.
    character(len=word_length), parameter :: norm_starts(2) = [character(len=word_length) :: &
        'coarse', 'strips']
    !> Whose error the tolerance of auto is about.
    character(len=word_length), parameter :: targets(3) = [character(len=word_length) :: &
        'forces', 'pmax', 'penetration']
    !> Most strips per patch the program accepts.
    integer, parameter :: most_strips = 1000
    integer, parameter :: most_points = 10000 !! of FASTSIM, along either axis
    !> Most elements of a grid of norm or tang, unless the user says otherwise: solved within about
    !> five seconds on one core; the time grows with their number.
    integer, parameter :: standard_max_elements = 1000000
    !> What the user may ask for: 10 GB of memory.
    integer, parameter :: most_elements = 20000000

    !> Methods and resolutions.
    type :: methods_t
        character(len=word_length) :: normal = 'strip'         !! one of `normal_methods`
        character(len=word_length) :: tangential = 'faststrip' !! one of `tangential_methods`
        integer :: strips_per_patch = 15 !! strips across the largest patch, or `strips_auto`
        integer :: points_per_strip = 15 !! points along a strip, faststrip...
        integer :: fastsim_nx = 50       !! points along a row, fastsim...
        integer :: fastsim_ny = 50       !! rows, fastsim...
        real(wp) :: smoothing_um = 0.0_wp !! noise the gap is smoothed for, um; 0: not at all
        real(wp) :: element_dx = 0.2_wp  !! side of an element along x, norm, tang, mm
        real(wp) :: element_dy = 0.2_wp  !! side of an element along y, norm, tang, mm
        real(wp) :: error_target = 0.0_wp !! of penetration and pmax; sets the sides if positive
        integer :: max_elements = standard_max_elements !! of a grid, norm, tang
        character(len=word_length) :: norm_start = 'coarse' !! one of `norm_starts`
        real(wp) :: tolerance = 0.02_wp  !! largest error wanted of auto
        character(len=word_length) :: target = 'forces' !! one of `targets`
        real(wp) :: resolution_limit = default_resolution
            !! largest estimated error of a resolved contact
    end type methods_t

contains

    !> Find the first name that is out of range; `what` is empty if there is none.
    subroutine check_methods(methods, what, range, value)
        type(methods_t), intent(in) :: methods             !! as the user gave them
        character(len=:), allocatable, intent(out) :: what  !! name of the culprit
        character(len=:), allocatable, intent(out) :: range !! what it must be
        character(len=:), allocatable, intent(out) :: value !! its value

        what = ''
        range = ''
        value = ''
        call check_word('normal', methods%normal, normal_methods)
        call check_word('tangential', methods%tangential, tangential_methods)
        call check_word('norm_start', methods%norm_start, norm_starts)
        call check_word('target', methods%target, targets)
        if (methods%strips_per_patch /= strips_auto) &
            call check('strips_per_patch', methods%strips_per_patch, 1, most_strips)
        call check('points_per_strip', methods%points_per_strip, 1, most_points_per_strip)
        call check('fastsim_nx', methods%fastsim_nx, 1, most_points)
        call check('fastsim_ny', methods%fastsim_ny, 1, most_points)
        call check('max_elements', methods%max_elements, 1, most_elements)
        call check_real('element_dx_mm', methods%element_dx, .false.)
        call check_real('element_dy_mm', methods%element_dy, .false.)
        call check_real('error_target', methods%error_target, .true.)
        call check_real('smoothing_um', methods%smoothing_um, .true.)
        call check_real('tolerance', methods%tolerance, .false.)
        call check_real('resolution_limit', methods%resolution_limit, .false.)

    contains

        subroutine check_word(name, word, words)
            character(len=*), intent(in) :: name, word, words(:)

            integer :: i

            if (any(words == word) .or. len(what) > 0) return
            what = name
            range = trim(words(1))
            do i = 2, size(words)
                range = range // ', ' // trim(words(i))
            end do
            range = 'one of ' // range
            value = trim(word)
        end subroutine check_word

        subroutine check(name, number, least, most)
            character(len=*), intent(in) :: name
            integer, intent(in) :: number, least, most

            if (number >= least .and. number <= most) return
            if (len(what) > 0) return
            what = name
            range = 'a whole number from ' // integer_text(least) // ' to ' // integer_text(most)
            value = integer_text(number)
        end subroutine check

        subroutine check_real(name, number, may_be_zero)
            character(len=*), intent(in) :: name
            real(wp), intent(in) :: number
            logical, intent(in) :: may_be_zero

            if (len(what) > 0) return
            if (ieee_is_finite(number)) then
                if (number > 0.0_wp .or. may_be_zero .and. number >= 0.0_wp) return
            end if
            what = name
            range = 'a number above 0'
            if (may_be_zero) range = 'a number from 0 on'
            value = trim(number_text(number))
        end subroutine check_real
    end subroutine check_methods
end module faststrip_command_methods
