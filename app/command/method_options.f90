!> The options by which several subcommands choose methods and resolutions.
module faststrip_command_method_options
    use faststrip_normal_strip, only: strips_auto
    use faststrip_command_options, only: command_t, option_t, option_text, option_integer, &
                                         option_number, option_word
    use faststrip_command_methods, only: methods_t, normal_methods, tangential_methods, &
                                         norm_starts, targets, most_strips, most_points, &
                                         most_points_per_strip, most_elements
    implicit none
    private

    public :: method_options, take_method_options

    !> For the table of a subcommand.
    type(option_t), parameter :: method_options(15) = [ &
        option_t('--normal', 'NAME', 'strip (default), hertz, equal_area, equal_moments, norm;' &
                 // new_line('a') // 'auto: both methods, the cheapest expected to do'), &
        option_t('--tangential', 'NAME', 'faststrip (default), faststrip-paper,' &
                 // ' faststrip-corrected,' // new_line('a') // 'fastsim, fastsim-elliptic,' &
                 // ' fastsim-weighted,' // new_line('a') // 'linear, she, polach, tang, none'), &
        option_t('--strips-per-patch', 'N', 'across the largest patch (default 15), or auto'), &
        option_t('--points-per-strip', 'N', 'points along a strip, faststrip... (default 15)'), &
        option_t('--fastsim-nx', 'N', 'points along a row, fastsim... (default 50)'), &
        option_t('--fastsim-ny', 'N', 'rows, fastsim... (default 50)'), &
        option_t('--element-dx', 'MM', 'side of the elements along x, norm, tang (default 0.2)'), &
        option_t('--element-dy', 'MM', 'side of the elements along y, norm, tang (default 0.2)'), &
        option_t('--error-target', 'E', 'norm: choose the sides for this relative error'), &
        option_t('--max-elements', 'N', 'norm, tang: no larger grids than that (default' &
                 // ' 1000000)'), &
        option_t('--resolution-limit', 'E', 'status under_resolved above this est_err_...' &
                 // ' (default 0.1)'), &
        option_t('--norm-start', 'NAME', 'norm starts from a coarse grid (default) or strips'), &
        option_t('--smooth', 'UM', 'smooth the gap for this noise of its heights, rms, in um'), &
        option_t('--tolerance', 'E', 'auto: largest error wanted (default 0.02)'), &
        option_t('--target', 'NAME', 'auto: of forces (default), over mu N, pmax or penetration')]

contains

    !> Let the options that were given replace what was chosen before; a usage error if one is
    !> out of range.
    subroutine take_method_options(command, methods)
        type(command_t), intent(in) :: command   !! parsed, with `method_options` in its table
        type(methods_t), intent(inout) :: methods !! defaults or those of a case file

        methods%normal = option_word(command, '--normal', trim(methods%normal), normal_methods)
        methods%tangential = option_word(command, '--tangential', trim(methods%tangential), &
                                         tangential_methods)
        if (option_text(command, '--strips-per-patch', '') == 'auto') then
            methods%strips_per_patch = strips_auto
        else
            methods%strips_per_patch = option_integer(command, '--strips-per-patch', &
                methods%strips_per_patch, least=1, most=most_strips, or='auto')
        end if
        methods%points_per_strip = option_integer(command, '--points-per-strip', &
            methods%points_per_strip, least=1, most=most_points_per_strip)
        methods%fastsim_nx = option_integer(command, '--fastsim-nx', methods%fastsim_nx, &
                                            least=1, most=most_points)
        methods%fastsim_ny = option_integer(command, '--fastsim-ny', methods%fastsim_ny, &
                                            least=1, most=most_points)
        methods%max_elements = option_integer(command, '--max-elements', methods%max_elements, &
                                              least=1, most=most_elements)
        methods%smoothing_um = option_number(command, '--smooth', methods%smoothing_um, &
                                             least=0)
        methods%tolerance = option_number(command, '--tolerance', methods%tolerance, above=0)
        methods%target = option_word(command, '--target', trim(methods%target), targets)
        methods%element_dx = option_number(command, '--element-dx', methods%element_dx, &
                                           above=0)
        methods%element_dy = option_number(command, '--element-dy', methods%element_dy, &
                                           above=0)
        methods%error_target = option_number(command, '--error-target', methods%error_target, &
                                             least=0)
        methods%resolution_limit = option_number(command, '--resolution-limit', &
                                                 methods%resolution_limit, above=0)
        methods%norm_start = option_word(command, '--norm-start', trim(methods%norm_start), &
                                         norm_starts)
    end subroutine take_method_options
end module faststrip_command_method_options
