!> The tangential problem of one contact, by the method asked for.
module faststrip_app_tangential_stage
    use faststrip_kinds, only: wp
    use faststrip_status, only: status_t, set_status, st_bad_argument
    use faststrip_material, only: material_t
    use faststrip_creepage, only: creepage_t
    use faststrip_tangential_types, only: tangential_result_t, tangential_field_t, reserve_field
    use faststrip_tangential_fastsim, only: fastsim_solve, fastsim_strips_solve
    use faststrip_tangential_faststrip, only: faststrip_solve
    use faststrip_app_methods, only: methods_t
    use faststrip_app_normal_stage, only: normal_stage_t
    implicit none
    private

    public :: reserve_elements, solve_tangential

    integer, parameter :: most_patches = 16 ! each with its own ellipse

contains

    !> Make room for the elements of a tangential method.
    subroutine reserve_elements(normal, field, status)
        type(normal_stage_t), intent(in) :: normal       !! made beforehand
        type(tangential_field_t), intent(inout) :: field !! sized
        type(status_t), intent(out) :: status            !! from the library

        associate (methods => normal%methods)
            call reserve_field(field, max(size(normal%strips%p0)*methods%points_per_strip, &
                                          methods%fastsim_nx*methods%fastsim_ny*most_patches), &
                               status)
        end associate
    end subroutine reserve_elements

    !> Solve the tangential problem on a normal solution.
    subroutine solve_tangential(normal, material, mu, creepage, tangential, status, field)
        type(normal_stage_t), intent(in) :: normal   !! with a solution
        type(material_t), intent(in) :: material     !! moduli, MPa
        real(wp), intent(in) :: mu                   !! coefficient of friction
        type(creepage_t), intent(in) :: creepage     !! about y = 0
        type(tangential_result_t), intent(out) :: tangential !! figures
        type(status_t), intent(out) :: status        !! an error, or a named limitation
        type(tangential_field_t), intent(inout), optional :: field !! elements, if wanted

        associate (methods => normal%methods)
            select case (methods%tangential)
            case ('faststrip')
                call faststrip_solve(normal%strips, material, mu, creepage, &
                                     methods%points_per_strip, tangential, status, field)
            case ('fastsim')
                if (methods%normal == 'hertz') then
                    call fastsim_solve(normal%hertz, material, mu, creepage, methods%fastsim_nx, &
                                       methods%fastsim_ny, tangential, status, field)
                else
                    call fastsim_strips_solve(normal%strips, material, mu, creepage, &
                                              methods%fastsim_nx, methods%fastsim_ny, &
                                              tangential, status, field)
                end if
            case default
                call set_status(status, st_bad_argument, 'unknown tangential method: ' &
                                // trim(methods%tangential))
            end select
        end associate
    end subroutine solve_tangential
end module faststrip_app_tangential_stage
