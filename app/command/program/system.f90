!> The operating system: which file a path means, signals, progress of long work, instructions.
module faststrip_command_program_system
    use, intrinsic :: iso_c_binding, only: c_char, c_int, c_long_long, c_null_char
    !$ use omp_lib, only: omp_in_parallel
    implicit none
    private

    public :: file_kind, name_kind, identity_t, identify, resolved, is_fed
    public :: keep_in_mind, forget_file
    public :: remove_leftovers, start_signals, set_progress, set_detail, set_speaker, is_printed
    public :: be_quiet, use_one_thread_each, become, run_program, program_folder
    public :: is_terminal, make_folders, new_folder, remove_folder, instructions
    public :: kind_none, kind_file, kind_folder, kind_pipe

    !> Kinds of files.
    !> Given: as `system.c` numbers them.
    integer, parameter :: kind_none = 0, kind_file = 1, kind_folder = 2, kind_pipe = 3
    ! Given: PATH_MAX of Linux.
    integer, parameter :: longest_path = 4096

    !> What tells a file from all others, whatever its name.
    type :: identity_t
        integer :: kind = kind_none              !! what there is
        integer(c_long_long) :: numbers(2) = 0   !! device and file, if there is one
        character(len=:), allocatable :: path    !! without links and dots; empty: no such place
    end type identity_t

    ! What is being done.
    character(len=:), allocatable :: present_work

    interface
        subroutine c_become(words, n) bind(c, name='faststrip_become')
            import :: c_char, c_int
            character(kind=c_char), intent(in) :: words(*)
            integer(c_int), value :: n
        end subroutine c_become

        function c_run(words, n, quiet) bind(c, name='faststrip_run') result(code)
            import :: c_char, c_int
            character(kind=c_char), intent(in) :: words(*)
            integer(c_int), value :: n, quiet
            integer(c_int) :: code
        end function c_run

        function c_is_terminal() bind(c, name='faststrip_is_terminal') result(answer)
            import :: c_int
            integer(c_int) :: answer
        end function c_is_terminal

        subroutine c_make_folders(path) bind(c, name='faststrip_make_folders')
            import :: c_char
            character(kind=c_char), intent(in) :: path(*)
        end subroutine c_make_folders

        function c_new_folder(out, capacity) bind(c, name='faststrip_new_folder') result(length)
            import :: c_char, c_int
            character(kind=c_char), intent(out) :: out(*)
            integer(c_int), value :: capacity
            integer(c_int) :: length
        end function c_new_folder

        subroutine c_remove_folder(path) bind(c, name='faststrip_remove_folder')
            import :: c_char
            character(kind=c_char), intent(in) :: path(*)
        end subroutine c_remove_folder

        function c_identify(path, numbers) bind(c, name='faststrip_identify') result(kind)
            import :: c_char, c_int, c_long_long
            character(kind=c_char), intent(in) :: path(*)
            integer(c_long_long), intent(out) :: numbers(2)
            integer(c_int) :: kind
        end function c_identify

        function c_name_kind(path) bind(c, name='faststrip_name_kind') result(kind)
            import :: c_char, c_int
            character(kind=c_char), intent(in) :: path(*)
            integer(c_int) :: kind
        end function c_name_kind

        function c_resolve(path, out, capacity) bind(c, name='faststrip_resolve') result(length)
            import :: c_char, c_int
            character(kind=c_char), intent(in) :: path(*)
            character(kind=c_char), intent(out) :: out(*)
            integer(c_int), value :: capacity
            integer(c_int) :: length
        end function c_resolve

        function c_is_fed(path, seconds) bind(c, name='faststrip_is_fed') result(answer)
            import :: c_char, c_int
            character(kind=c_char), intent(in) :: path(*)
            integer(c_int), value :: seconds
            integer(c_int) :: answer
        end function c_is_fed

        subroutine c_keep_in_mind(path) bind(c, name='faststrip_keep_in_mind')
            import :: c_char
            character(kind=c_char), intent(in) :: path(*)
        end subroutine c_keep_in_mind

        subroutine c_forget(path) bind(c, name='faststrip_forget')
            import :: c_char
            character(kind=c_char), intent(in) :: path(*)
        end subroutine c_forget

        !> Do not tell of long work.
        subroutine be_quiet() bind(c, name='faststrip_be_quiet')
        end subroutine be_quiet

        !> Let the library of linear algebra have one thread in each of ours.
        subroutine use_one_thread_each() bind(c, name='faststrip_use_one_thread_each')
        end subroutine use_one_thread_each

        subroutine c_remove_leftovers(folder, prefix, ending, spared, n) &
            bind(c, name='faststrip_remove_leftovers')
            import :: c_char, c_int, c_long_long
            character(kind=c_char), intent(in) :: folder(*), prefix(*), ending(*)
            integer(c_long_long), intent(in) :: spared(2, *)
            integer(c_int), value :: n
        end subroutine c_remove_leftovers

        subroutine c_start_signals(text) bind(c, name='faststrip_start_signals')
            import :: c_char
            character(kind=c_char), intent(in) :: text(*)
        end subroutine c_start_signals

        function c_print(line) bind(c, name='faststrip_print') result(code)
            import :: c_char, c_int
            character(kind=c_char), intent(in) :: line(*)
            integer(c_int) :: code
        end function c_print

        subroutine c_set_speaker(name) bind(c, name='faststrip_set_speaker')
            import :: c_char
            character(kind=c_char), intent(in) :: name(*)
        end subroutine c_set_speaker

        !> Instructions of the calling thread so far, from the first call on; -1: not to be had.
        function instructions() bind(c, name='faststrip_instructions') result(count)
            import :: c_long_long
            integer(c_long_long) :: count
        end function instructions

        subroutine c_set_progress(text) bind(c, name='faststrip_set_progress')
            import :: c_char
            character(kind=c_char), intent(in) :: text(*)
        end subroutine c_set_progress
    end interface

contains

    !> Become another program. Comes back only if there is none of this name.
    subroutine become(program)
        character(len=*), intent(in) :: program !! sought in PATH; gets what follows the subcommand

        character(len=:), allocatable :: words, word
        integer :: i, length

        words = program // c_null_char
        do i = 2, command_argument_count()
            call get_command_argument(i, length=length)
            word = repeat(' ', length)
            call get_command_argument(i, word)
            words = words // word // c_null_char
        end do
        call c_become(words, int(max(1, command_argument_count()), c_int))
    end subroutine become

    !> Run another program to its end, and give its exit code; below 0 if there is none of the name.
    integer function run_program(words, n, is_quiet) result(code)
        character(len=*), intent(in) :: words !! each with its closing zero, the program first
        integer, intent(in) :: n              !! how many
        logical, intent(in) :: is_quiet       !! is what it says thrown away?

        code = c_run(words, int(n, c_int), merge(1_c_int, 0_c_int, is_quiet))
    end function run_program

    !> The folder of this program, without links.
    function program_folder() result(folder)
        character(len=:), allocatable :: folder

        call resolve('/proc/self/exe', folder)
        folder = folder(:max(index(folder, '/', back=.true.) - 1, 0))
    end function program_folder

    !> Do people look at the standard output?
    logical function is_terminal()
        is_terminal = c_is_terminal() /= 0
    end function is_terminal

    !> Make the folders of a file that are not there. Whoever opens the file says if it failed.
    subroutine make_folders(path)
        character(len=*), intent(in) :: path !! of the file

        call c_make_folders(path // c_null_char)
    end subroutine make_folders

    !> A new folder for files that are soon gone; empty if there is none to be had.
    function new_folder() result(path)
        character(len=:), allocatable :: path

        character(kind=c_char) :: out(longest_path)
        integer :: i, length

        length = c_new_folder(out, int(size(out), c_int))
        allocate (character(len=length) :: path)
        do i = 1, length
            path(i:i) = out(i)
        end do
    end function new_folder

    !> Remove a folder and the files in it.
    subroutine remove_folder(path)
        character(len=*), intent(in) :: path !! of `new_folder`

        call c_remove_folder(path // c_null_char)
    end subroutine remove_folder

    !> What a path leads to.
    integer function file_kind(path)
        character(len=*), intent(in) :: path !! a name

        integer(c_long_long) :: numbers(2)

        file_kind = c_identify(path // c_null_char, numbers)
    end function file_kind

    !> What has a name: `kind_none` only if nothing has it, and a link is no file.
    integer function name_kind(path)
        character(len=*), intent(in) :: path !! a name

        name_kind = c_name_kind(path // c_null_char)
    end function name_kind

    !> Which file a path means, or would mean once it is written.
    function identify(path) result(identity)
        character(len=*), intent(in) :: path !! a name
        type(identity_t) :: identity

        identity%kind = c_identify(path // c_null_char, identity%numbers)
        call resolve(path, identity%path)
    end function identify

    !> A path without links and dots; empty if there is no such place.
    function resolved(path) result(text)
        character(len=*), intent(in) :: path !! a name
        character(len=:), allocatable :: text

        call resolve(path, text)
    end function resolved

    subroutine resolve(path, text)
        character(len=*), intent(in) :: path
        character(len=:), allocatable, intent(out) :: text

        character(kind=c_char) :: out(longest_path)
        integer :: i, length

        length = c_resolve(path // c_null_char, out, int(size(out), c_int))
        allocate (character(len=length) :: text)
        do i = 1, length
            text(i:i) = out(i)
        end do
    end subroutine resolve

    !> Does somebody write into a named pipe within some seconds?
    logical function is_fed(path, seconds)
        character(len=*), intent(in) :: path !! of the pipe
        integer, intent(in) :: seconds       !! to wait

        is_fed = c_is_fed(path // c_null_char, int(seconds, c_int)) /= 0
    end function is_fed

    !> Remove a file if the program ends before its time.
    subroutine keep_in_mind(path)
        character(len=*), intent(in) :: path !! of a file, there or not

        call c_keep_in_mind(path // c_null_char)
    end subroutine keep_in_mind

    !> Do not remove it any more.
    subroutine forget_file(path)
        character(len=*), intent(in) :: path !! as it was given to `keep_in_mind`

        call c_forget(path // c_null_char)
    end subroutine forget_file

    !> Remove what killed runs of this user left in a folder: files `PREFIX<process>_<number>ENDING`
    !> of processes that are gone, which have no other name.
    subroutine remove_leftovers(folder, prefix, ending, spared)
        character(len=*), intent(in) :: folder !! where
        character(len=*), intent(in) :: prefix !! names begin so
        character(len=*), intent(in) :: ending !! and end so
        integer(c_long_long), intent(in) :: spared(:, :) !! `numbers` of files that stay

        call c_remove_leftovers(folder // c_null_char, prefix // c_null_char, &
                                ending // c_null_char, spared, size(spared, 2, c_int))
    end subroutine remove_leftovers

    !> From now on a signal ends the program with one line and leaves no file half-written, and
    !> work that takes more than a second says on stderr how far it is.
    subroutine start_signals(text)
        character(len=*), intent(in) :: text !! what is being done

        present_work = text
        call c_start_signals(text // c_null_char)
    end subroutine start_signals

    !> Print a line on the standard output; was it written?
    logical function is_printed(line)
        character(len=*), intent(in) :: line !! without its end

        is_printed = c_print(line // c_null_char) == 0
    end function is_printed

    !> Say which of the programs speaks when a signal ends it or long work is reported.
    subroutine set_speaker(name)
        character(len=*), intent(in) :: name !! of the program

        call c_set_speaker(name // c_null_char)
    end subroutine set_speaker

    !> Say what is being done; it is reported only if it takes long.
    subroutine set_progress(text)
        character(len=*), intent(in) :: text !! a few words

        present_work = text
        call c_set_progress(text // c_null_char)
    end subroutine set_progress

    !> Say more about what is being done, until the next call. Of threads that work side by side
    !> nothing is said.
    subroutine set_detail(text)
        character(len=*), intent(in) :: text !! a few words

        !$ if (omp_in_parallel()) return
        call c_set_progress(present_work // ', ' // text // c_null_char)
    end subroutine set_detail
end module faststrip_command_program_system
