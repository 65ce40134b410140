!> Lists of strip distances as the command line gives them.
module faststrip_command_table_distances
    use faststrip_base_text, only: parse_integer, integer_text
    use faststrip_tables_refit, only: most_distance
    implicit none
    private

    public :: parse_distances

contains

    !> Read a list such as `0:20`, `3` or `0:3,10`: increasing distances.
    subroutine parse_distances(text, n, problem)
        character(len=*), intent(in) :: text                  !! parts separated by commas, each
                                                              !! a number or FIRST:LAST
        integer, allocatable, intent(out) :: n(:)             !! the distances
        character(len=:), allocatable, intent(out) :: problem !! what is wrong; empty: nothing

        integer :: start, comma, colon, first, last, i
        logical :: first_valid, last_valid

        problem = ''
        allocate (n(0))
        start = 1
        do
            comma = index(text(start:), ',')
            if (comma == 0) comma = len(text) - start + 2
            associate (part => text(start:start + comma - 2))
                colon = index(part, ':')
                if (colon == 0) then
                    call parse_integer(part, first, first_valid)
                    last = first
                    last_valid = .true.
                else
                    call parse_integer(part(:colon - 1), first, first_valid)
                    call parse_integer(part(colon + 1:), last, last_valid)
                end if
                if (.not. (first_valid .and. last_valid)) then
                    problem = 'a list of strip distances such as 0:20 or 0,1,5'
                else if (first < 0 .or. last > most_distance) then
                    problem = 'strip distances from 0 to ' // integer_text(most_distance)
                else if (last < first) then
                    problem = 'strip distances that increase'
                else if (size(n) > 0) then
                    if (first <= n(size(n))) &
                        problem = 'strip distances that increase'
                end if
            end associate
            if (len(problem) > 0) return
            n = [n, (i, i=first, last)]
            start = start + comma
            if (start > len(text) + 1) exit
        end do
    end subroutine parse_distances
end module faststrip_command_table_distances
