!> Which gap files a long run has read, by the SHA-256 of each: in its journal and its manifest, so
!> that no result is joined from gaps that were changed meanwhile.
!>
!> Of many files only the first ones are listed.
module faststrip_command_batch_gap_digests
    use faststrip_files_csv, only: csv_text_t
    use faststrip_files_digest, only: digest_of_file, digest_length
    use faststrip_command_program_files, only: spare_input
    use faststrip_command_batch_manifest, only: manifest_t, set_value, value_of, names_with
    use faststrip_command_program_system, only: file_kind, kind_file
    implicit none
    private

    public :: gap_digests_t, wants_digest, add_digest, digest_of_gap, take_digests, put_digests
    public :: changed_file, most_gaps

    !> Most gap files that a run keeps in mind.
    !> Tuned [files]. Origin: chosen: 100 kB in a journal, 60 ms to read them; a table of some
    !> profiles and shifts.
    integer, parameter :: most_gaps = 1024
    !> What a manifest calls them, before the name of the file.
    character(len=*), parameter :: digest_prefix = 'gap_sha256 '

    !> Names of files and their digests, by name.
    type :: gap_digests_t
        private
        type(csv_text_t), allocatable :: names(:), values(:)
        integer :: n = 0
    end type gap_digests_t

contains

    !> SHA-256 of a file that can be read twice; blank if it is none.
    function digest_of_gap(path) result(digest)
        character(len=*), intent(in) :: path   !! name of the file
        character(len=digest_length) :: digest

        digest = ''
        call spare_input(path)
        if (file_kind(path) == kind_file) digest = digest_of_file(path)
    end function digest_of_gap

    !> Is a file listed, or is there room for it?
    pure logical function wants_digest(digests, path) result(wants)
        type(gap_digests_t), intent(in) :: digests !! any
        character(len=*), intent(in) :: path       !! name of the file

        integer :: i

        wants = digests%n < most_gaps
        if (.not. wants) call find(digests, path, i, wants)
    end function wants_digest

    !> List a file; or is it listed with another digest?
    subroutine add_digest(digests, path, digest, is_like)
        type(gap_digests_t), intent(inout) :: digests !! gets it, if there is room
        character(len=*), intent(in) :: path          !! name of the file
        character(len=*), intent(in) :: digest        !! its SHA-256; blank: none is known
        logical, intent(out) :: is_like               !! is it not listed, or with this digest?

        integer :: i, k
        logical :: is_there

        is_like = .true.
        call find(digests, path, i, is_there)
        if (is_there) then
            is_like = digests%values(i)%text == digest
        else if (digests%n < most_gaps .and. digest /= '') then
            if (.not. allocated(digests%names)) &
                allocate (digests%names(most_gaps), digests%values(most_gaps))
            do k = digests%n, i, -1
                call move_alloc(digests%names(k)%text, digests%names(k + 1)%text)
                call move_alloc(digests%values(k)%text, digests%values(k + 1)%text)
            end do
            digests%names(i)%text = path
            digests%values(i)%text = digest
            digests%n = digests%n + 1
        end if
    end subroutine add_digest

    !> List what a manifest has.
    subroutine take_digests(digests, manifest, unlike)
        type(gap_digests_t), intent(inout) :: digests !! gets them
        type(manifest_t), intent(in) :: manifest      !! any
        character(len=:), allocatable, intent(out) :: unlike
            !! the first file that was listed with another digest; empty: none

        type(csv_text_t), allocatable :: names(:)
        integer :: i
        logical :: is_like

        unlike = ''
        names = names_with(manifest, digest_prefix)
        do i = 1, size(names)
            associate (name => names(i)%text)
                call add_digest(digests, name(len(digest_prefix) + 1:), value_of(manifest, name), &
                                is_like)
                if (.not. is_like .and. len(unlike) == 0) unlike = name(len(digest_prefix) + 1:)
            end associate
        end do
    end subroutine take_digests

    !> Tell a manifest what it does not have yet.
    subroutine put_digests(digests, manifest)
        type(gap_digests_t), intent(in) :: digests  !! any
        type(manifest_t), intent(inout) :: manifest !! gets them

        integer :: i

        if (size(names_with(manifest, digest_prefix)) == digests%n) return
        do i = 1, digests%n
            call set_value(manifest, digest_prefix // digests%names(i)%text, &
                           digests%values(i)%text)
        end do
    end subroutine put_digests

    !> The first file whose digest is another one now, or that is gone; empty: none.
    function changed_file(digests) result(path)
        type(gap_digests_t), intent(in) :: digests !! any
        character(len=:), allocatable :: path

        integer :: i

        do i = 1, digests%n
            path = digests%names(i)%text
            if (digest_of_gap(path) /= digests%values(i)%text) return
        end do
        path = ''
    end function changed_file

    ! Where a name is, or would be.
    pure subroutine find(digests, path, i, is_there)
        type(gap_digests_t), intent(in) :: digests
        character(len=*), intent(in) :: path
        integer, intent(out) :: i
        logical, intent(out) :: is_there

        integer :: last, middle

        i = 1
        last = digests%n
        do while (i <= last)
            middle = (i + last)/2
            if (lle(path, digests%names(middle)%text)) then
                last = middle - 1
            else
                i = middle + 1
            end if
        end do
        is_there = .false.
        if (i <= digests%n) is_there = digests%names(i)%text == path
    end subroutine find
end module faststrip_command_batch_gap_digests
