!> Files through the C library: its streams tell how much was read, and report every failed write,
!> also one that shows only when the buffer is emptied, where FLUSH and CLOSE may stay silent.
module faststrip_files_stdio
    use, intrinsic :: iso_c_binding, only: c_char, c_int, c_long, c_ptr, c_size_t
    implicit none
    private

    public :: c_open_input, c_fopen, c_fdopen, c_fread, c_fwrite, c_ferror, c_fclose, c_fseek
    public :: c_rename, c_remove

    interface
        !> Open a file, or a pipe, for reading; no stream if that fails.
        function c_open_input(path) bind(c, name='files_open_input') result(stream)
            import :: c_char, c_ptr
            character(kind=c_char), intent(in) :: path(*) !! with a null behind it
            type(c_ptr) :: stream                         !! to be closed by `c_fclose`
        end function c_open_input

        !> Open a file; no stream if that fails.
        function c_fopen(path, mode) bind(c, name='fopen') result(stream)
            import :: c_char, c_ptr
            character(kind=c_char), intent(in) :: path(*) !! with a null behind it
            character(kind=c_char), intent(in) :: mode(*) !! the same
            type(c_ptr) :: stream                         !! to be closed by `c_fclose`
        end function c_fopen

        !> A stream of an open file.
        function c_fdopen(descriptor, mode) bind(c, name='fdopen') result(stream)
            import :: c_char, c_int, c_ptr
            integer(c_int), value :: descriptor           !! of the file
            character(kind=c_char), intent(in) :: mode(*) !! with a null behind it
            type(c_ptr) :: stream                         !! to be closed by `c_fclose`
        end function c_fdopen

        !> Read; how many items there were.
        function c_fread(to, size, count, stream) bind(c, name='fread') result(n)
            import :: c_char, c_ptr, c_size_t
            character(kind=c_char), intent(inout) :: to(*) !! with room for all
            integer(c_size_t), value :: size               !! of an item, bytes
            integer(c_size_t), value :: count              !! items, at most
            type(c_ptr), value :: stream                   !! opened for reading
            integer(c_size_t) :: n
        end function c_fread

        !> Write; how many items went.
        function c_fwrite(from, size, count, stream) bind(c, name='fwrite') result(n)
            import :: c_char, c_ptr, c_size_t
            character(kind=c_char), intent(in) :: from(*) !! all of them
            integer(c_size_t), value :: size              !! of an item, bytes
            integer(c_size_t), value :: count             !! items
            type(c_ptr), value :: stream                  !! opened for writing
            integer(c_size_t) :: n
        end function c_fwrite

        !> Not 0 if anything failed.
        function c_ferror(stream) bind(c, name='ferror') result(code)
            import :: c_int, c_ptr
            type(c_ptr), value :: stream !! an open one
            integer(c_int) :: code
        end function c_ferror

        !> Go to a place of a stream; not 0 if that fails.
        function c_fseek(stream, offset, from) bind(c, name='fseek') result(code)
            import :: c_int, c_long, c_ptr
            type(c_ptr), value :: stream      !! an open one
            integer(c_long), value :: offset  !! bytes
            integer(c_int), value :: from     !! 0 is from the beginning on
            integer(c_int) :: code
        end function c_fseek

        !> Close a stream; not 0 if that fails.
        function c_fclose(stream) bind(c, name='fclose') result(code)
            import :: c_int, c_ptr
            type(c_ptr), value :: stream !! an open one
            integer(c_int) :: code
        end function c_fclose

        !> Give a file another name; not 0 if that fails.
        function c_rename(old, new) bind(c, name='rename') result(code)
            import :: c_char, c_int
            character(kind=c_char), intent(in) :: old(*) !! with a null behind it
            character(kind=c_char), intent(in) :: new(*) !! the same
            integer(c_int) :: code
        end function c_rename

        !> Remove a file; not 0 if that fails.
        function c_remove(path) bind(c, name='remove') result(code)
            import :: c_char, c_int
            character(kind=c_char), intent(in) :: path(*) !! with a null behind it
            integer(c_int) :: code
        end function c_remove
    end interface
end module faststrip_files_stdio
