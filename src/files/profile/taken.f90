!> A profile as users take it from a file: read, cleaned as they ask, and judged: what can be
!> touched of it, the measures of its flange, and words for what was left out or done.
module faststrip_files_profile_taken
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, set_status, is_error, st_bad_argument
    use faststrip_geometry_flange, only: flange_t, measure_flange
    use faststrip_geometry_profile, only: profile_t, make_curve_profile
    use faststrip_geometry_touchable, only: touchable_t, touchable_words, body_wheel, body_rail
    use faststrip_files_profile, only: read_profile, profile_file_t, profile_options_t
    use faststrip_files_profile_standard, only: standard_profile
    use faststrip_files_profile_cleaning, only: cleaning_t, check_cleaning, clean
    implicit none
    private

    public :: taken_profile_t, take_profile

    !> A profile, and what is known of it.
    type :: taken_profile_t
        type(profile_file_t) :: points         !! as read and cleaned
        type(profile_t) :: profile             !! what can be touched, where the kind is known
        type(touchable_t) :: part              !! the same
        type(flange_t) :: flange               !! of a wheel
        character(len=:), allocatable :: done  !! by cleaning; empty: nothing
        character(len=:), allocatable :: words !! what was noticed or done; empty: nothing
    end type taken_profile_t

contains

    !> Take a profile from a file, or a standard one.
    subroutine take_profile(path, options, cleaning, taken, status)
        character(len=*), intent(in) :: path           !! name of the file, or of the profile
        type(profile_options_t), intent(in) :: options !! what the user says about it
        type(cleaning_t), intent(in) :: cleaning       !! what is to be done
        type(taken_profile_t), intent(out) :: taken    !! the profile
        type(status_t), intent(out) :: status          !! those of `read_profile`, `clean`,
                                                       !! `make_curve_profile`, with the file;
                                                       !! `st_bad_argument`: a standard profile
                                                       !! that is described like a file

        logical :: is_standard

        taken%words = ''
        taken%done = ''
        allocate (taken%part%point(0))
        call check_cleaning(cleaning, status)
        if (is_error(status)) return
        call standard_profile(path, taken%points, is_standard)
        if (.not. is_standard) then
            call read_profile(path, options, taken%points, status)
        else if (describes_file(options, taken%points%kind)) then
            call set_status(status, st_bad_argument, path // ' is a standard profile: what ' // &
                            'tells how a file is read is for ./' // path)
        end if
        if (is_error(status)) return
        call clean(cleaning, taken%points, taken%done, status)
        if (.not. is_error(status)) call judge(cleaning, taken, status)
        if (is_error(status)) status%message = trim(status%message) // ' (' // path // ')'
        if (len(taken%done) == 0) return
        if (len(taken%words) > 0) taken%words = '; ' // taken%words
        taken%words = taken%done // taken%words
    end subroutine take_profile

    ! Is something said that counts of files only?
    pure logical function describes_file(options, kind)
        type(profile_options_t), intent(in) :: options
        integer, intent(in) :: kind ! of the standard profile

        type(profile_options_t), parameter :: usual = profile_options_t()

        describes_file = options%any_count .or. options%ignore_smoothing &
            .or. options%has_tape_circle .or. abs(options%unit_mm) > 0.0_wp &
            .or. all(options%kind /= [usual%kind, kind]) &
            .or. any([options%section, options%side, options%y_sense, options%z_sense] &
                     /= [usual%section, usual%side, usual%y_sense, usual%z_sense])
    end function describes_file

    subroutine judge(cleaning, taken, status)
        type(cleaning_t), intent(in) :: cleaning
        type(taken_profile_t), intent(inout) :: taken
        type(status_t), intent(inout) :: status

        character(len=:), allocatable :: clipped

        associate (y => taken%points%y, z => taken%points%z, kind => taken%points%kind)
            if (kind == body_wheel) &
                call measure_flange(y, z, taken%points%flange_back, taken%flange)
            if (kind == body_wheel .or. kind == body_rail) &
                call make_curve_profile(y, z, kind, 0.0_wp, cleaning%kink_angle, taken%profile, &
                                        taken%part, status)
        end associate
        if (is_error(status)) return
        clipped = trim(touchable_words(taken%part))
        taken%words = trim(taken%points%notes)
        if (len(taken%words) > 0 .and. len(clipped) > 0) taken%words = taken%words // '; '
        taken%words = taken%words // clipped
    end subroutine judge
end module faststrip_files_profile_taken
