!> `faststrip lookup info`: what a table of creep forces holds.
module faststrip_command_lookup_info
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: number_text
    use faststrip_base_text, only: integer_text
    use faststrip_command_lookup_columns, only: error_names, state_kinds, orders
    use faststrip_command_program_console, only: say
    use faststrip_command_lookup_file, only: read_table
    use faststrip_command_program_options, only: command_t, parse_command
    use faststrip_lookup_faces, only: n_forces
    use faststrip_lookup_table, only: lookup_t, lookup_kind_wheel, n_wheel_errors, at_load
    implicit none
    private

    public :: run_lookup_info

contains

    !> Run the action from the command line.
    subroutine run_lookup_info()
        type(command_t) :: command
        type(lookup_t) :: lookup
        integer :: at, cut

        command%name = 'lookup info'
        command%n_words = 2
        command%usage = 'TABLE.fslt'
        command%about = 'Say what a table holds, how it was made, and its errors.' // new_line('a')
        allocate (command%options(0))
        call parse_command(command, 1)
        call read_table(command%arguments(1)%text, lookup)
        at = 1
        do while (at <= len_trim(lookup%text))
            cut = index(lookup%text(at:), new_line('a'))
            if (cut == 0) cut = len_trim(lookup%text(at:)) + 1
            call say(trim(lookup%text(at:at + cut - 2)))
            at = at + cut
        end do
        if (lookup%kind == lookup_kind_wheel) then
            call say_wheel(lookup)
            return
        end if
        call say('Hertz ellipses, nu ' // trim(number_text(lookup%nu)) // ', ' &
                 // trim(number_text(real(size(lookup%values)/n_forces, wp))) // ' nodes')
        call say_axis('q, creepage r/(1 + r)', lookup%q%x)
        call say_axis('ratios of creepages', lookup%ratio%x)
        call say_axis('a/b', exp(lookup%shape%x))
        if (lookup%promised > 0.0_wp) &
            call say_claim(lookup%promised, 'mu N and mu N c')
        if (lookup%tested == 0) return
        call say('errors on ' // integer_text(lookup%tested) // ' fresh contacts, over mu N and ' &
                 // 'mu N c: mean, 99th percentile, worst')
        call say_errors(lookup%errors)
    end subroutine run_lookup_info

    ! The table of a wheel.
    subroutine say_wheel(lookup)
        type(lookup_t), intent(in) :: lookup

        integer :: k, kind

        associate (wheel => lookup%wheel)
            call say('a wheel on a rail, nu ' // trim(number_text(lookup%nu)) // ', G ' &
                     // trim(number_text(wheel%shear)) // ' MPa, ' // integer_text(wheel%sets) &
                     // ' contacts, ' // trim(number_text(real(size(lookup%values)/n_forces, wp))) &
                     // ' nodes')
            call say_axis('q, creepage r/(1 + r)', lookup%q%x)
            call say_axis('ratios of creepages', lookup%ratio%x)
            call say_axis('y, mm', wheel%y%x)
            call say_axis('yaw, rad', wheel%yaw%x)
            call say_axis('load, N', wheel%load%x)
            do k = 1, wheel%slots
                call say('  slot ' // integer_text(k) // ': a contact at ' // integer_text( &
                         count(wheel%contacts(at_load, k, :) > 0.0_wp)) // ' of ' &
                         // integer_text(size(wheel%set, 2)) // ' places')
            end do
            call say('  shortest cell of y: ' // trim(number_text( &
                     minval(wheel%y%x(2:) - wheel%y%x(:wheel%y%n - 1)))) // ' mm')
            if (lookup%promised > 0.0_wp) &
                call say_claim(lookup%promised, 'mu N, mu N c, N, and of the load for z')
            do kind = 1, 2
                if (wheel%tested(kind) == 0) cycle
                call say('errors on ' // integer_text(wheel%tested(kind)) // ' fresh states' &
                         // trim(merge(' where contacts come or go', '                          ', &
                                       state_kinds(kind) == 'change')) &
                         // ', over mu N, mu N c, N: mean, 99th percentile, worst')
                call say_errors(wheel%errors(:wheel%n_errors, :, :, kind))
            end do
            if (wheel%n_errors < n_wheel_errors) then
                call say('an older table: errors of z are not known')
            else
                call say('an error of z counts as the load that it makes by Hertz'' law, over the' &
                         // ' load')
            end if
        end associate
    end subroutine say_wheel

    subroutine say_claim(promised, what)
        real(wp), intent(in) :: promised     ! over the unit
        character(len=*), intent(in) :: what ! its unit

        if (promised > 0.0_wp) &
            call say('made for a 99th percentile of ' // trim(number_text(promised)) // ' of ' &
                     // what)
    end subroutine say_claim

    subroutine say_errors(errors)
        real(wp), intent(in) :: errors(:, :, :) ! of each; mean, percentile, worst; orders

        integer :: order, k

        do order = 1, size(orders)
            do k = 1, size(errors, 1)
                call say('  ' // orders(order) // ' ' // error_names(k) // ' ' &
                         // number_text(errors(k, 1, order)) // number_text(errors(k, 2, order)) &
                         // trim(number_text(errors(k, 3, order))))
            end do
        end do
    end subroutine say_errors

    subroutine say_axis(name, nodes)
        character(len=*), intent(in) :: name
        real(wp), intent(in) :: nodes(:)

        call say('  ' // name // ': ' // integer_text(size(nodes)) // ' nodes, ' &
                 // trim(number_text(nodes(1))) // ' to ' // trim(number_text(nodes(size(nodes)))))
    end subroutine say_axis
end module faststrip_command_lookup_info
