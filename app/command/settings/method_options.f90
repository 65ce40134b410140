!> The options by which several subcommands choose methods and resolutions.
module faststrip_command_settings_method_options
    use faststrip_base_kinds, only: wp
    use faststrip_normal_strip, only: strips_auto
    use faststrip_command_program_options, only: command_t, option_t, option_text, option_integer, &
                                                 option_number, option_word, given
    use faststrip_contact_methods, only: method_t, normal_table, tangential_table, normal_method, &
                                         tangential_method, normal_method_name, &
                                         tangential_method_name
    use faststrip_contact_wanted, only: target_number, target_names
    use faststrip_command_settings_methods, only: settings_t, settle_wanted, norm_starts, &
                                                  most_strips, most_points, most_points_per_strip, &
                                                  most_elements
    use faststrip_command_rows_wear_figures, only: take_wear_law
    implicit none
    private

    public :: method_options, method_notes, take_method_options

    character(len=*), parameter :: newline = new_line('a')

    !> For the table of a subcommand; the names are told by `method_notes`.
    type(option_t), parameter :: method_options(20) = [ &
        option_t('--normal', 'NAME', 'normal method, one of the above (default strip)'), &
        option_t('--tangential', 'NAME', &
                 'tangential method, one of the above (default faststrip)'), &
        option_t('--strips-per-patch', 'N', 'across the largest patch (default 15), or auto'), &
        option_t('--points-per-strip', 'N', 'points along a strip, faststrip... (default 15)'), &
        option_t('--fastsim-nx', 'N', 'points along a row, fastsim... (default 50)'), &
        option_t('--fastsim-ny', 'N', 'rows, fastsim... (default 50)'), &
        option_t('--element-dx', 'MM', 'side of the elements along x, norm, tang (default 0.2,' &
                 // new_line('a') // 'less in small contacts)'), &
        option_t('--element-dy', 'MM', 'side of the elements along y, norm, tang (default 0.2,' &
                 // new_line('a') // 'less in small contacts)'), &
        option_t('--error-target', 'E', 'norm: choose the sides for this relative error'), &
        option_t('--max-elements', 'N', 'norm, tang: no larger grids than that (default' &
                 // ' 1000000)'), &
        option_t('--resolution-limit', 'E', 'status under_resolved above this est_err_...' &
                 // ' (default 0.1)'), &
        option_t('--force-limit', 'E', 'the same of est_err_Fx, _Fy, _Mz (default 0.1)'), &
        option_t('--yield-MPa', 'MPA', 'status beyond_yield where pmax is above (default none)'), &
        option_t('--yield-shear-MPa', 'MPA', 'yield stress in cyclic shear, for fatigue_index'), &
        option_t('--wear', 'FILE.csv', 'wear law, for wear_ug_per_m; faststrip, faststrip-plain', &
                 reads=.true.), &
        option_t('--norm-start', 'NAME', 'norm starts from a coarse grid (default) or strips'), &
        option_t('--smooth', 'UM', 'smooth the gap for this noise of its heights, rms, in um'), &
        option_t('--tolerance', 'E', 'auto: largest error wanted (default 0.02)'), &
        option_t('--target', 'NAME', &
                 'auto: of forces (default), over mu N, pmax (default with' // newline &
                 // '--tangential none), penetration, area or power'), &
        option_t('--budget-us', 'US', 'auto: the best in that time; goes before the default' &
                 // newline // 'tolerance; another run may end with other bytes')]

contains

    !> The names of the methods and what they are, one a line.
    function method_notes() result(text)
        character(len=:), allocatable :: text !! lines

        text = newline // 'normal methods:' // newline // lines(normal_table) // newline &
               // 'tangential methods:' // newline // lines(tangential_table)
    end function method_notes

    function lines(table) result(text)
        type(method_t), intent(in) :: table(:)
        character(len=:), allocatable :: text

        integer :: i

        text = ''
        do i = 1, size(table)
            text = text // '  ' // table(i)%name // trim(table(i)%help)
            if (.not. table(i)%gives_elements) text = text // '; no elements'
            text = text // newline
        end do
    end function lines

    !> Let the options that were given replace what was chosen before; a usage error if one is
    !> out of range.
    subroutine take_method_options(command, case)
        type(command_t), intent(in) :: command    !! parsed, with `method_options` in its table
        class(settings_t), intent(inout) :: case !! defaults or those of a case file

        case%methods%normal = normal_method(option_word( &
            command, '--normal', trim(normal_method_name(case%methods%normal)), normal_table%name))
        case%methods%tangential = tangential_method(option_word( &
            command, '--tangential', trim(tangential_method_name(case%methods%tangential)), &
            tangential_table%name))
        if (option_text(command, '--strips-per-patch', '') == 'auto') then
            case%methods%strips_per_patch = strips_auto
        else
            case%methods%strips_per_patch = option_integer(command, '--strips-per-patch', &
                case%methods%strips_per_patch, least=1, most=most_strips, or='auto')
        end if
        case%methods%points_per_strip = option_integer(command, '--points-per-strip', &
            case%methods%points_per_strip, least=1, most=most_points_per_strip)
        case%methods%fastsim_nx = option_integer(command, '--fastsim-nx', case%methods%fastsim_nx, &
                                            least=1, most=most_points)
        case%methods%fastsim_ny = option_integer(command, '--fastsim-ny', case%methods%fastsim_ny, &
                                            least=1, most=most_points)
        case%methods%max_elements = option_integer(command, '--max-elements', &
            case%methods%max_elements, least=1, most=most_elements)
        if (given(command, '--smooth')) &
            case%smoothing = 1.0e-3_wp*option_number(command, '--smooth', 0.0_wp, least=0)
        case%wanted%tolerance = option_number(command, '--tolerance', &
                                                  case%wanted%tolerance, above=0)
        if (given(command, '--tolerance')) case%tolerance_is_given = .true.
        case%wanted%target = target_number(option_word( &
            command, '--target', trim(target_names(case%wanted%target)), target_names))
        if (given(command, '--target')) case%target_is_given = .true.
        case%wanted%budget_us = option_number(command, '--budget-us', &
                                                  case%wanted%budget_us, above=0)
        case%methods%element_dx = option_number(command, '--element-dx', case%methods%element_dx, &
                                           above=0)
        case%methods%element_dy = option_number(command, '--element-dy', case%methods%element_dy, &
                                           above=0)
        if (given(command, '--element-dx')) case%methods%dx_is_given = .true.
        if (given(command, '--element-dy')) case%methods%dy_is_given = .true.
        case%methods%error_target = option_number(command, '--error-target', &
            case%methods%error_target, least=0)
        case%resolution_limit = option_number(command, '--resolution-limit', &
                                                 case%resolution_limit, above=0)
        case%force_limit = option_number(command, '--force-limit', case%force_limit, above=0)
        case%yield = option_number(command, '--yield-MPa', case%yield, least=0)
        case%yield_shear = option_number(command, '--yield-shear-MPa', &
                                                      case%yield_shear, least=0)
        if (given(command, '--wear')) &
            call take_wear_law(option_text(command, '--wear', ''), case)
        case%methods%norm_start = findloc(norm_starts == option_word( &
            command, '--norm-start', trim(norm_starts(case%methods%norm_start)), norm_starts), &
            .true., dim=1)
        call settle_wanted(case)
    end subroutine take_method_options
end module faststrip_command_settings_method_options
