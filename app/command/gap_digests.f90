!> Which gap files a long run has read, by the SHA-256 of each: in its journal and its manifest, so
!> that no result is joined from gaps that were changed meanwhile.
!>
!> Of many files only the first ones are listed.
module faststrip_command_gap_sums
    use faststrip_files_csv, only: csv_text_t
    use faststrip_files_digest, only: digest_of_file
    use faststrip_command_manifest, only: manifest_t, set_value, value_of, names_with
    use faststrip_command_system, only: file_kind, kind_file
    implicit none
    private

    public :: gap_sums_t, add_sum, sum_of_file, take_sums, put_sums, changed_file

    !> Tuned [files]: most of them. Origin: chosen: 100 kB in a journal, 60 ms to add them up.
    integer, parameter :: most_sums = 1000
    !> What a manifest calls them, before the name of the file.
    character(len=*), parameter :: sum_prefix = 'gap_sha256 '

    !> Names and sums, by name.
    type :: gap_sums_t
        private
        type(csv_text_t), allocatable :: names(:), sums(:)
        integer :: n = 0
    end type gap_sums_t

contains

    !> SHA-256 of a file that can be read twice; empty if it is none.
    function sum_of_file(path) result(sum)
        character(len=*), intent(in) :: path !! name of the file
        character(len=:), allocatable :: sum

        sum = ''
        if (file_kind(path) == kind_file) sum = digest_of_file(path)
    end function sum_of_file

    !> List a file; or is it listed with another sum?
    subroutine add_sum(sums, path, sum, is_like)
        type(gap_sums_t), intent(inout) :: sums !! gets it, if there is room
        character(len=*), intent(in) :: path    !! name of the file
        character(len=*), intent(in) :: sum     !! its SHA-256; empty: none is known
        logical, intent(out) :: is_like         !! is it not listed, or with this sum?

        integer :: i, k
        logical :: is_there

        is_like = .true.
        call find(sums, path, i, is_there)
        if (is_there) then
            is_like = sums%sums(i)%text == sum
        else if (sums%n < most_sums .and. len(sum) > 0) then
            if (.not. allocated(sums%names)) &
                allocate (sums%names(most_sums), sums%sums(most_sums))
            do k = sums%n, i, -1
                call move_alloc(sums%names(k)%text, sums%names(k + 1)%text)
                call move_alloc(sums%sums(k)%text, sums%sums(k + 1)%text)
            end do
            sums%names(i)%text = path
            sums%sums(i)%text = sum
            sums%n = sums%n + 1
        end if
    end subroutine add_sum

    !> List what a manifest has.
    subroutine take_sums(sums, manifest, unlike)
        type(gap_sums_t), intent(inout) :: sums   !! gets them
        type(manifest_t), intent(in) :: manifest  !! any
        character(len=:), allocatable, intent(out) :: unlike
            !! the first file that was listed with another sum; empty: none

        type(csv_text_t), allocatable :: names(:)
        integer :: i
        logical :: is_like

        unlike = ''
        names = names_with(manifest, sum_prefix)
        do i = 1, size(names)
            associate (name => names(i)%text)
                call add_sum(sums, name(len(sum_prefix) + 1:), value_of(manifest, name), is_like)
                if (.not. is_like .and. len(unlike) == 0) unlike = name(len(sum_prefix) + 1:)
            end associate
        end do
    end subroutine take_sums

    !> Tell a manifest what it does not have yet.
    subroutine put_sums(sums, manifest)
        type(gap_sums_t), intent(in) :: sums         !! any
        type(manifest_t), intent(inout) :: manifest  !! gets them

        integer :: i

        if (size(names_with(manifest, sum_prefix)) == sums%n) return
        do i = 1, sums%n
            call set_value(manifest, sum_prefix // sums%names(i)%text, sums%sums(i)%text)
        end do
    end subroutine put_sums

    !> The first file whose sum is another one now, or that is gone; empty: none.
    function changed_file(sums) result(path)
        type(gap_sums_t), intent(in) :: sums !! any
        character(len=:), allocatable :: path

        integer :: i

        do i = 1, sums%n
            path = sums%names(i)%text
            if (sum_of_file(path) /= sums%sums(i)%text) return
        end do
        path = ''
    end function changed_file

    ! Where a name is, or would be.
    pure subroutine find(sums, path, i, is_there)
        type(gap_sums_t), intent(in) :: sums
        character(len=*), intent(in) :: path
        integer, intent(out) :: i
        logical, intent(out) :: is_there

        integer :: last, middle

        i = 1
        last = sums%n
        do while (i <= last)
            middle = (i + last)/2
            if (lle(path, sums%names(middle)%text)) then
                last = middle - 1
            else
                i = middle + 1
            end if
        end do
        is_there = .false.
        if (i <= sums%n) is_there = sums%names(i)%text == path
    end subroutine find
end module faststrip_command_gap_sums
