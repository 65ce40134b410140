!> The steps of auto in words, for the column `choice`.
module faststrip_command_rows_auto_words
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_word, st_ok
    use faststrip_base_text, only: integer_text
    use faststrip_contact_methods, only: normal_method_name, tangential_method_name, normal_norm, &
                                         tangential_none
    use faststrip_contact_wanted, only: auto_step_t, auto_steps_t, unknown_error
    implicit none
    private

    public :: words_of_steps

contains

    !> All steps: methods, estimated error of the target, time; empty if there was none. It is no
    !> function, for the length of whose result gfortran keeps a variable that all threads share.
    subroutine words_of_steps(steps, tells_times, text)
        type(auto_steps_t), intent(in) :: steps !! of a contact
        logical, intent(in) :: tells_times      !! else the words are those of any other run
        character(len=:), allocatable, intent(out) :: text !! for the CSV

        integer :: i

        text = ''
        do i = 1, steps%n
            if (i > 1) text = text // '; '
            call add_step(steps%steps(i), tells_times, text)
        end do
    end subroutine words_of_steps

    subroutine add_step(step, tells_time, text)
        type(auto_step_t), intent(in) :: step
        logical, intent(in) :: tells_time
        character(len=:), allocatable, intent(inout) :: text

        associate (methods => step%methods)
            text = text // trim(normal_method_name(methods%normal)) // ' ' &
                   // integer_text(step%across)
            if (methods%tangential /= tangential_none) then
                text = text // ' + ' // trim(tangential_method_name(methods%tangential))
                if (methods%normal /= normal_norm) &
                    text = text // ' ' // integer_text(methods%points_per_strip)
            end if
        end associate
        if (step%code /= st_ok) then
            text = text // ': ' // trim(status_word(step%code))
            return
        end if
        if (step%estimate < unknown_error) then
            text = text // ': ' // trim(short(step%estimate))
        else
            text = text // ': not known'
        end if
        if (tells_time) text = text // ' in ' &
                               // integer_text(nint(step%normal_us + step%tangential_us)) // ' us'
    end subroutine add_step

    !> A number of two digits that count.
    function short(value) result(text)
        real(wp), intent(in) :: value
        character(len=24) :: text

        ! Given: between which numbers people read them without exponent.
        real(wp), parameter :: least_plain = 1.0e-6_wp, most_plain = 10.0_wp
        character(len=24) :: buffer, form

        if (value >= least_plain .and. value < most_plain) then
            write (form, '(a, i0, a)') '(f12.', 1 - floor(log10(value)), ')'
        else
            form = '(es8.1)'
        end if
        write (buffer, form) value
        text = adjustl(buffer)
    end function short
end module faststrip_command_rows_auto_words
