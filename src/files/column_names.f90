!> Names of columns that are nearly those of others: in other letters, in another unit, or with a
!> letter that is wrong. Where a column may be left out, such a name must not pass for none.
module faststrip_files_column_names
    use faststrip_base_text, only: lower_case, trim_blanks
    use faststrip_files_units, only: without_unit
    implicit none
    private

    public :: is_nearly

    ! One wrong letter is seen in names of so many letters, the unit aside: of shorter ones another
    ! letter is another quantity.
    ! Tuned [letters]. Origin: chosen: y and z, Fx and Fy, roll and yaw stay apart.
    integer, parameter :: least_letters = 5

contains

    !> Is a name, which is no known one, nearly this one?
    pure logical function is_nearly(name, known)
        character(len=*), intent(in) :: name  !! as it was given
        character(len=*), intent(in) :: known !! as it would be right

        character(len=:), allocatable :: one, other

        call fold(name, one)
        call fold(known, other)
        is_nearly = one == other
        if (is_nearly .or. len(one) == 0) return
        one = without_unit(one)
        other = without_unit(other)
        is_nearly = one == other
        if (.not. is_nearly .and. min(len(one), len(other)) >= least_letters) &
            is_nearly = differs_by_one(one, other) .or. differs_by_one(other, one)
    end function is_nearly

    ! Small letters; an underscore for what else may stand between words and around a unit.
    pure subroutine fold(name, text)
        character(len=*), intent(in) :: name
        character(len=:), allocatable, intent(out) :: text
        integer :: i

        text = ''
        do i = 1, len(trim_blanks(name))
            associate (letter => name(i:i))
                if (index(' -.([/', letter) > 0) then
                    text = text // '_'
                else if (index(')]', letter) == 0) then
                    text = text // lower_case(letter)
                end if
            end associate
        end do
        do
            i = index(text, '__')
            if (i == 0) exit
            text = text(:i) // text(i + 2:)
        end do
    end subroutine fold

    ! Are both the same but for one letter that is another one, is missing in the first, or has
    ! changed its place with the next?
    pure logical function differs_by_one(one, other) result(differs)
        character(len=*), intent(in) :: one, other
        integer :: i

        differs = .false.
        do i = 1, len(one)
            if (i > len(other)) return
            if (one(i:i) /= other(i:i)) exit
        end do
        if (len(other) == len(one) + 1) then
            differs = one(i:) == other(i + 1:)
        else if (len(other) == len(one) .and. i <= len(one)) then
            differs = one(i + 1:) == other(i + 1:)
            if (i < len(one) .and. .not. differs) &
                differs = one(i:) == other(i + 1:i + 1) // other(i:i) // other(i + 2:)
        end if
    end function differs_by_one
end module faststrip_files_column_names
