!> Names of files while they are being written.
module faststrip_files_temporary
    use, intrinsic :: iso_c_binding, only: c_char, c_int, c_null_char, c_size_t
    use faststrip_base_text, only: integer_text
    implicit none
    private

    public :: find_prefix, temporary_ending, most_temporaries, name_temporary
    public :: find_free_temporary, find_final_path

    !> What is written goes to a file of the name `faststrip_HOST_PROCESS_NUMBER.tmp` beside its
    !> place first; by host and process a file that a killed run left is known from that of a run
    !> which goes on.
    character(len=*), parameter :: temporary_ending = '.tmp'
    !> The numbers go up to this.
    integer, parameter :: most_temporaries = 8

    integer, parameter :: longest_path = 4096

    interface
        function c_readlink(path, target, capacity) bind(c, name='readlink') result(length)
            import :: c_char, c_size_t
            character(kind=c_char), intent(in) :: path(*)
            character(kind=c_char), intent(out) :: target(*)
            integer(c_size_t), value :: capacity
            integer(c_size_t) :: length
        end function c_readlink

        function c_gethostname(name, capacity) bind(c, name='gethostname') result(code)
            import :: c_char, c_int, c_size_t
            character(kind=c_char), intent(out) :: name(*)
            integer(c_size_t), value :: capacity
            integer(c_int) :: code
        end function c_gethostname

        function c_getpid() bind(c, name='getpid') result(number)
            import :: c_int
            integer(c_int) :: number
        end function c_getpid
    end interface

contains

    !> The beginning of the names of files being written on this host.
    subroutine find_prefix(prefix)
        character(len=:), allocatable, intent(out) :: prefix !! `faststrip_HOST_`
        character(kind=c_char) :: name(longest_path)
        integer :: i

        prefix = 'faststrip_'
        name = c_null_char
        if (c_gethostname(name, int(size(name) - 1, c_size_t)) /= 0) return
        do i = 1, size(name)
            if (name(i) == c_null_char) exit
            if (name(i) /= '/') prefix = prefix // name(i)
        end do
        prefix = prefix // '_'
    end subroutine find_prefix

    !> Where a file is written until it is whole.
    subroutine name_temporary(path, number, name)
        character(len=*), intent(in) :: path       !! name of the file
        integer, intent(in) :: number              !! 1 to `most_temporaries`
        character(len=:), allocatable, intent(out) :: name

        character(len=:), allocatable :: final, prefix

        call find_final_path(path, final)
        call find_prefix(prefix)
        name = final(:index(final, '/', back=.true.)) // prefix // integer_text(int(c_getpid())) &
               // '_' // integer_text(number) // temporary_ending
    end subroutine name_temporary

    !> A name of those of a file that nothing has yet; the last one if all are taken.
    subroutine find_free_temporary(path, name)
        character(len=*), intent(in) :: path !! name of the file
        character(len=:), allocatable, intent(out) :: name

        character(len=:), allocatable :: final
        integer :: number
        logical :: is_there

        do number = 1, most_temporaries
            call name_temporary(path, number, name)
            call find_final_path(name, final)
            inquire (file=final, exist=is_there)
            if (.not. is_there .and. final == name) return
        end do
    end subroutine find_free_temporary

    !> Where symbolic links lead to, also to what is not there yet.
    subroutine find_final_path(path, final)
        character(len=*), intent(in) :: path                !! name of a file
        character(len=:), allocatable, intent(out) :: final !! name of the file itself
        integer, parameter :: most_links = 40
        character(kind=c_char) :: target(longest_path)
        character(len=:), allocatable :: text
        integer :: i, step, length

        final = path
        do step = 1, most_links
            length = int(c_readlink(final // c_null_char, target, size(target, kind=c_size_t)))
            if (length < 1) return
            allocate (character(len=length) :: text)
            do i = 1, length
                text(i:i) = target(i)
            end do
            if (text(1:1) /= '/') text = final(:index(final, '/', back=.true.)) // text
            call move_alloc(text, final)
        end do
    end subroutine find_final_path
end module faststrip_files_temporary
