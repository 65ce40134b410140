!> Profile files in the F77 interface.
!>
!> ```
!> PATH     CHARACTER*(*), name of the file; blanks at its end do not count
!> KIND     1: of a wheel, 2: of a rail, 0: the file or the end of its name says it
!> NMAX     length of Y and Z                      N points of the profile, also if there are more
!> Y, Z     to the field side, of a wheel from the nominal rolling circle, and down, mm, as FSWNEW
!>          takes them
!> TEXT     CHARACTER*(*), what is wrong, with file, line and value, or what was left out
!> INFO     status: 0; 110, NMAX is too small; 120, no such file; 121 and others, what is in it
!> ```
module faststrip_files_profile_f77
    use, intrinsic :: iso_c_binding, only: c_char, c_double, c_int, c_size_t
    use faststrip_base_status, only: status_t, set_status, is_error, count_text, &
                                     st_workspace_too_small
    use faststrip_numerics_environment, only: environment_t, hold_environment, restore_environment
    use faststrip_files_printable, only: printable
    use faststrip_files_profile, only: profile_options_t
    use faststrip_files_profile_cleaning, only: cleaning_t
    use faststrip_files_profile_taken, only: taken_profile_t, take_profile
    implicit none
    private

    public :: fsrdpr

contains

    !> CALL FSRDPR(PATH, KIND, NMAX, N, Y, Z, TEXT, INFO)
    !>
    !> Read a profile of any format, as `faststrip profile` does without options.
    subroutine fsrdpr(path, kind, capacity, n, y, z, text, info, path_length, text_length) &
        bind(c, name='fsrdpr_')
        character(kind=c_char), intent(in) :: path(*)  !! as above
        integer(c_int), intent(in) :: kind             !! as above
        integer(c_int), intent(in) :: capacity         !! as above
        integer(c_int), intent(out) :: n               !! as above
        real(c_double), intent(inout) :: y(*), z(*)    !! mm
        character(kind=c_char), intent(out) :: text(*) !! as above
        integer(c_int), intent(out) :: info            !! as above
        integer(c_size_t), value :: path_length        !! passed by the compiler
        integer(c_size_t), value :: text_length        !! passed by the compiler

        type(environment_t) :: environment
        type(taken_profile_t) :: taken
        type(status_t) :: status
        character(len=path_length) :: name
        character(len=text_length) :: words
        integer(c_size_t) :: i

        do i = 1, path_length
            name(i:i) = path(i)
        end do
        n = 0
        call hold_environment(environment)
        call take_profile(trim(name), profile_options_t(kind=kind), cleaning_t(), taken, status)
        call restore_environment(environment)
        if (.not. is_error(status)) then
            n = size(taken%points%y)
            if (n > capacity) call set_status(status, st_workspace_too_small, 'the profile has ' &
                                              // 'more points than the arrays: ' // count_text(n))
        end if
        if (is_error(status)) then
            words = printable(trim(status%message))
        else
            words = printable(taken%words)
            y(:n) = taken%points%y
            z(:n) = taken%points%z
        end if
        do i = 1, text_length
            text(i) = words(i:i)
        end do
        info = status%code
    end subroutine fsrdpr
end module faststrip_files_profile_f77
