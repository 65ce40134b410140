!> Where the checkout is that the laboratory works in.
module faststrip_lab_checkout
    use faststrip_command_program_system, only: resolved
    implicit none
    private

    public :: in_checkout

contains

    !> Path of a file or folder of the checkout, wherever the program was started: as it is if it is
    !> below the present folder, else below the folder that holds the program's own folder.
    function in_checkout(name) result(path)
        character(len=*), intent(in) :: name !! for example `reference/contact`
        character(len=:), allocatable :: path

        character(len=:), allocatable :: program
        integer :: slash, i
        logical :: there

        path = name
        inquire (file=name, exist=there)
        if (there) return
        program = resolved('/proc/self/exe')
        do i = 1, 2
            slash = index(program, '/', back=.true.)
            if (slash < 2) return
            program = program(:slash - 1)
        end do
        inquire (file=program // '/' // name, exist=there)
        if (there) path = program // '/' // name
    end function in_checkout
end module faststrip_lab_checkout
