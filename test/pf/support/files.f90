!> Files that tests write, and remove.
module files
    implicit none
    private

    public :: write_lines, delete_file

contains

    !> Lines without the blanks at their ends.
    subroutine write_lines(path, lines)
        character(len=*), intent(in) :: path, lines(:)
        integer :: unit, i

        open (newunit=unit, file=path, status='replace')
        write (unit, '(a)') (trim(lines(i)), i=1, size(lines))
        close (unit)
    end subroutine write_lines

    !> Remove a file, if it is there.
    subroutine delete_file(path)
        character(len=*), intent(in) :: path
        integer :: unit, code

        open (newunit=unit, file=path, status='old', iostat=code)
        if (code == 0) close (unit, status='delete')
    end subroutine delete_file
end module files
