!> The catalogue of columns: what each column of a table holds and means, and what interfaces call
!> it. Those of the figures of a contact are rows of `faststrip_contact_figures`. NetCDF, the
!> command `faststrip columns` and, by `tools/generate/columns.py`, documents and Python read it.
module faststrip_files_columns
    use faststrip_base_text, only: lower_case
    use faststrip_contact_figures, only: figures, n_figures
    implicit none
    private

    public :: column_t, columns, column_group, known_column, is_variable_name
    public :: holds_anything, holds_text, holds_counts, holds_numbers

    !> What a column may hold; of one that is not known its cells tell.
    integer, parameter :: holds_anything = 0, holds_text = 1, holds_counts = 2, holds_numbers = 3

    !> A column.
    type :: column_t
        character(len=31) :: name = ''      !! its unit stands at the end
        integer :: holds = holds_anything
        character(len=64) :: long_name = '' !! what it is, in a few words
        character(len=23) :: member = ''    !! name in interfaces; empty: they have none
        character(len=14) :: needs = ''     !! what must be there for it to be known; or empty
    end type column_t

    ! What is solved.
    type(column_t), parameter :: of_cases(*) = [ &
        column_t('case', holds_text, 'name of the case'), &
        column_t('gap_file', holds_text, 'file of the undeformed gap'), &
        column_t('normal', holds_text, 'method of the normal contact'), &
        column_t('tangential', holds_text, 'method of the creep forces'), &
        column_t('E_MPa', holds_numbers, "Young's modulus"), &
        column_t('nu', holds_numbers, "Poisson's ratio"), &
        column_t('mu', holds_numbers, 'coefficient of friction'), &
        column_t('friction_kind', holds_text, 'kind of the friction law'), &
        column_t('mu_kinetic', holds_numbers, 'coefficient of friction at large slip'), &
        column_t('half_slip_speed_mm_s', holds_numbers, 'slip speed of the middle of friction'), &
        column_t('initial_slope_factor', holds_numbers, 'factor of the initial slope'), &
        column_t('speed_mm_s', holds_numbers, 'rolling speed'), &
        column_t('mu_hot', holds_numbers, 'coefficient of friction at high temperature'), &
        column_t('cold_temperature_C', holds_numbers, 'temperature up to which friction is cold'), &
        column_t('hot_temperature_C', holds_numbers, 'temperature from which friction is hot'), &
        column_t('conductivity_W_per_mK', holds_numbers, 'thermal conductivity'), &
        column_t('conductivity_wheel_W_per_mK', holds_numbers, 'conductivity of the wheel'), &
        column_t('conductivity_rail_W_per_mK', holds_numbers, 'conductivity of the rail'), &
        column_t('heat_capacity_J_per_kgK', holds_numbers, 'heat capacity'), &
        column_t('heat_capacity_wheel_J_per_kgK', holds_numbers, 'heat capacity of the wheel'), &
        column_t('heat_capacity_rail_J_per_kgK', holds_numbers, 'heat capacity of the rail'), &
        column_t('density_kg_per_m3', holds_numbers, 'density'), &
        column_t('density_wheel_kg_per_m3', holds_numbers, 'density of the wheel'), &
        column_t('density_rail_kg_per_m3', holds_numbers, 'density of the rail'), &
        column_t('temperature_wheel_C', holds_numbers, 'temperature of the wheel, away'), &
        column_t('temperature_rail_C', holds_numbers, 'temperature of the rail, away'), &
        column_t('given_penetration_mm', holds_numbers, 'penetration that was given'), &
        column_t('given_Fx_N', holds_numbers, 'longitudinal force that was given'), &
        column_t('given_Fy_N', holds_numbers, 'lateral force that was given'), &
        column_t('yw_mm', holds_numbers, 'lateral shift of the wheel'), &
        column_t('gamma_rad', holds_numbers, 'contact angle'), &
        column_t('cksi', holds_numbers, 'longitudinal creepage', 'cksi'), &
        column_t('ceta', holds_numbers, 'lateral creepage', 'ceta'), &
        column_t('cphi_rad_per_mm', holds_numbers, 'spin creepage', 'cphi')]

    ! What every contact has.
    type(column_t), parameter :: of_results(*) = [ &
        column_t('status', holds_text, 'ok, a limitation of the result, or an error'), &
        column_t('limitations', holds_text, 'all limitations of the result', 'limitations'), &
        column_t('message', holds_text, 'what there is to say about the status'), &
        column_t('choice', holds_text, 'the steps of the automatic solution'), &
        column_t('n_strips', holds_counts, 'number of strips', 'n_strips'), &
        column_t('n_elements', holds_counts, 'number of elements', 'n_elements'), &
        column_t('est_err_target', holds_numbers, &
                 'estimated error of the target of auto', 'est_err_target', 'target')]

    ! Strips, elements, gaps.
    type(column_t), parameter :: of_parts(*) = [ &
        column_t('patch', holds_counts, 'number of the patch', 'patch'), &
        column_t('strip', holds_counts, 'number of the strip'), &
        column_t('x_mm', holds_numbers, 'x, along the rolling direction', 'x'), &
        column_t('y_mm', holds_numbers, 'y, across the rolling direction', 'y'), &
        column_t('y_left_mm', holds_numbers, 'left edge of the strip', 'y_left'), &
        column_t('y_right_mm', holds_numbers, 'right edge of the strip', 'y_right'), &
        column_t('half_length_mm', holds_numbers, 'half-length of the strip', 'half_length'), &
        column_t('p0_MPa', holds_numbers, 'maximum pressure of the strip', 'p0'), &
        column_t('load_N', holds_numbers, 'load of the strip'), &
        column_t('wear_depth_mm_per_pass', holds_numbers, 'wear depth per pass', 'pass_depth'), &
        column_t('wear_depth_mm_per_km', holds_numbers, 'wear depth per distance rolled'), &
        column_t('state', holds_counts, 'state of the element: 1 adhesion, 2 slip', 'state'), &
        column_t('pn_MPa', holds_numbers, 'pressure', 'pn'), &
        column_t('px_MPa', holds_numbers, 'longitudinal traction', 'px'), &
        column_t('py_MPa', holds_numbers, 'lateral traction', 'py'), &
        column_t('sx', holds_numbers, 'longitudinal slip over the rolling speed', 'sx'), &
        column_t('sy', holds_numbers, 'lateral slip over the rolling speed', 'sy'), &
        column_t('power_MPa', holds_numbers, 'frictional work per area and distance rolled'), &
        column_t('surface_wheel_C', holds_numbers, 'temperature of the wheel at the element'), &
        column_t('surface_rail_C', holds_numbers, 'temperature of the rail at the element'), &
        column_t('sxx_MPa', holds_numbers, 'stress of the rail, along x', 'sxx'), &
        column_t('syy_MPa', holds_numbers, 'stress of the rail, along y', 'syy'), &
        column_t('szz_MPa', holds_numbers, 'stress of the rail, in depth', 'szz'), &
        column_t('sxy_MPa', holds_numbers, 'shear stress of the rail', 'sxy'), &
        column_t('sxz_MPa', holds_numbers, 'shear stress of the rail', 'sxz'), &
        column_t('syz_MPa', holds_numbers, 'shear stress of the rail', 'syz'), &
        column_t('von_mises_MPa', holds_numbers, 'von Mises equivalent stress', 'von_mises'), &
        column_t('tresca_MPa', holds_numbers, 'Tresca equivalent stress, s1 - s3', 'tresca'), &
        column_t('s1_MPa', holds_numbers, 'largest principal stress', 's1'), &
        column_t('s2_MPa', holds_numbers, 'principal stress between', 's2'), &
        column_t('s3_MPa', holds_numbers, 'smallest principal stress', 's3'), &
        column_t('h_mm', holds_numbers, 'undeformed gap', 'h'), &
        column_t('inv2R_per_mm', holds_numbers, '1/(2R) along the rolling direction', 'inv2r'), &
        column_t('inclination_rad', holds_numbers, 'inclination of the surfaces', 'inclination')]

    ! Wheelsets.
    type(column_t), parameter :: of_wheelsets(*) = [ &
        column_t('side', holds_text, 'left or right'), &
        column_t('contact', holds_counts, 'number of the contact of the wheel, 0: none'), &
        column_t('solution', holds_counts, 'number of the solution beside a jump'), &
        column_t('x_track_mm', holds_numbers, 'x of the contact in the track', 'place_x'), &
        column_t('y_track_mm', holds_numbers, 'y of the contact in the track', 'place_y'), &
        column_t('z_track_mm', holds_numbers, 'z of the contact in the track, down', 'place_z'), &
        column_t('contact_angle_rad', holds_numbers, 'contact angle', 'contact_angle'), &
        column_t('Fs_N', holds_numbers, 'lateral force on the rail, in the contact plane'), &
        column_t('Fx_track_N', holds_numbers, &
                 'force on the rail along x of the track', 'force_x'), &
        column_t('Fy_track_N', holds_numbers, &
                 'force on the rail along y of the track', 'force_y'), &
        column_t('Fz_track_N', holds_numbers, &
                 'force on the rail along z of the track', 'force_z'), &
        column_t('Fx_wheelset_N', holds_numbers, &
                 'force on the rail along x of the wheelset', 'force_wheelset_x'), &
        column_t('Fy_wheelset_N', holds_numbers, &
                 'force on the rail along y of the wheelset', 'force_wheelset_y'), &
        column_t('Fz_wheelset_N', holds_numbers, &
                 'force on the rail along z of the wheelset', 'force_wheelset_z'), &
        column_t('z_mm', holds_numbers, 'z, down', 'z'), &
        column_t('roll_rad', holds_numbers, 'roll of the wheelset', 'roll'), &
        column_t('y_rail_mm', holds_numbers, 'y on the profile of the rail', 'rail_y'), &
        column_t('z_rail_mm', holds_numbers, 'z on the profile of the rail', 'rail_z'), &
        column_t('x_wheel_mm', holds_numbers, 'x on the wheel', 'wheel_x'), &
        column_t('y_wheel_mm', holds_numbers, 'y on the profile of the wheel', 'wheel_y'), &
        column_t('z_wheel_mm', holds_numbers, 'z on the profile of the wheel', 'wheel_z'), &
        column_t('radius_mm', holds_numbers, 'rolling radius', 'radius'), &
        column_t('rolling_speed_mm_s', holds_numbers, 'rolling speed', 'speed'), &
        column_t('pitch_rate_rad_s', holds_numbers, 'pitch rate of the wheelset'), &
        column_t('est_err_load', holds_numbers, &
                 'share of N that the accuracy of the profiles may move', 'est_err_load'), &
        column_t('body', holds_text, 'wheel or rail'), &
        column_t('y_profile_mm', holds_numbers, 'y on the profile'), &
        column_t('z_profile_mm', holds_numbers, 'z on the profile'), &
        column_t('Mx_track_Nmm', holds_numbers, &
                 'moment about x of the track, about the centre of the wheelset', 'moment_x'), &
        column_t('My_track_Nmm', holds_numbers, &
                 'moment about y of the track, about the centre of the wheelset', 'moment_y'), &
        column_t('Mz_track_Nmm', holds_numbers, &
                 'moment about z of the track, about the centre of the wheelset', 'moment_z')]

    ! Conicity and contact functions.
    type(column_t), parameter :: of_conicity(*) = [ &
        column_t('amplitude_mm', holds_numbers, 'amplitude of the lateral motion', 'amplitude'), &
        column_t('tan_gamma_e', holds_numbers, 'equivalent conicity', 'tan_gamma_e'), &
        column_t('y_min_mm', holds_numbers, 'least y'), &
        column_t('y_max_mm', holds_numbers, 'largest y'), &
        column_t('regression', holds_numbers, &
                 'equivalent conicity by linear regression', 'regression'), &
        column_t('nonlinearity_per_mm', holds_numbers, &
                 'nonlinearity of the conicity', 'nonlinearity'), &
        column_t('method', holds_text, 'method of the conicity'), &
        column_t('delta_r_mm', holds_numbers, &
                 'rolling radius difference, right less left', 'delta_r'), &
        column_t('radius_right_mm', holds_numbers, &
                 'rolling radius of the right wheel', 'radius_right'), &
        column_t('radius_left_mm', holds_numbers, &
                 'rolling radius of the left wheel', 'radius_left'), &
        column_t('gamma_right_rad', holds_numbers, &
                 'contact angle of the right wheel', 'angle_right'), &
        column_t('gamma_left_rad', holds_numbers, &
                 'contact angle of the left wheel', 'angle_left'), &
        column_t('y_wheel_right_mm', holds_numbers, &
                 'y on the profile of the right wheel', 'y_wheel_right'), &
        column_t('y_rail_right_mm', holds_numbers, &
                 'y on the profile of the right rail', 'y_rail_right'), &
        column_t('y_wheel_left_mm', holds_numbers, &
                 'y on the profile of the left wheel', 'y_wheel_left'), &
        column_t('y_rail_left_mm', holds_numbers, &
                 'y on the profile of the left rail', 'y_rail_left'), &
        column_t('nonlinearity_regression_per_mm', holds_numbers, &
                 'nonlinearity of the conicity by linear regression', 'nonlinearity_regression')]

    ! Descriptions of profiles.
    type(column_t), parameter :: of_profiles(*) = [ &
        column_t('file', holds_text, 'name of the file'), &
        column_t('format', holds_text, 'format of the file'), &
        column_t('kind', holds_text, 'wheel or rail'), &
        column_t('points', holds_counts, 'number of points'), &
        column_t('z_min_mm', holds_numbers, 'least z'), &
        column_t('z_max_mm', holds_numbers, 'largest z'), &
        column_t('Sd_mm', holds_numbers, 'flange thickness'), &
        column_t('Sh_mm', holds_numbers, 'flange height'), &
        column_t('qR_mm', holds_numbers, 'flange gradient'), &
        column_t('length_mm', holds_numbers, 'length along the points'), &
        column_t('spacing_min_mm', holds_numbers, 'least distance of two points'), &
        column_t('spacing_max_mm', holds_numbers, 'largest distance of two points'), &
        column_t('y_of_widest_gap_mm', holds_numbers, 'y of the largest distance'), &
        column_t('y_positive_to', holds_text, 'sense of y in the file'), &
        column_t('z_positive_to', holds_text, 'sense of z in the file'), &
        column_t('runs_to', holds_text, 'where the points run to'), &
        column_t('unit_mm', holds_numbers, 'unit of length of the file'), &
        column_t('sections', holds_counts, 'number of sections'), &
        column_t('kinks', holds_counts, 'number of kinks'), &
        column_t('touchable_points', holds_counts, 'number of points that can be touched'), &
        column_t('touchable_y_min_mm', holds_numbers, 'least y that can be touched'), &
        column_t('touchable_y_max_mm', holds_numbers, 'largest y that can be touched'), &
        column_t('curvature_min_per_mm', holds_numbers, 'least curvature'), &
        column_t('curvature_max_per_mm', holds_numbers, 'largest curvature'), &
        column_t('wear_top_mm', holds_numbers, 'wear of the top of the rail'), &
        column_t('wear_side_mm', holds_numbers, 'wear of the side of the rail'), &
        column_t('wear_corner_mm', holds_numbers, 'wear of the corner of the rail'), &
        column_t('wear_max_mm', holds_numbers, 'largest wear'), &
        column_t('curation', holds_text, 'what was changed of the points')]

    ! Given: NC_MAX_NAME of NetCDF.
    integer, parameter :: longest_name = 256

    integer :: k
    type(column_t), parameter :: of_contacts(*) = &
        [(column_t(figures(k)%column, merge(holds_counts, holds_numbers, figures(k)%counts), &
                   figures(k)%meaning, figures(k)%name, figures(k)%needs), k=1, n_figures)]

    !> All of them, group by group.
    type(column_t), parameter :: columns(*) = [of_cases, of_results, of_contacts, of_parts, &
                                               of_wheelsets, of_conicity, of_profiles]

    ! What the groups are of, and how many columns they have.
    character(len=*), parameter :: groups(7) = [character(len=9) :: &
        'case', 'result', 'contact', 'part', 'wheelset', 'conicity', 'profile']
    integer, parameter :: sizes(7) = [size(of_cases), size(of_results), size(of_contacts), &
                                      size(of_parts), size(of_wheelsets), size(of_conicity), &
                                      size(of_profiles)]

contains

    !> What the group of a column is of.
    pure function column_group(i) result(group)
        integer, intent(in) :: i !! row of `columns`
        character(len=len(groups)) :: group
        integer :: j

        do j = 1, size(groups)
            group = groups(j)
            if (i <= sum(sizes(:j))) return
        end do
    end function column_group

    !> What is known of the column of that name. Of one that is not known only the words of which
    !> the name is made, for the long name.
    pure function known_column(name) result(column)
        character(len=*), intent(in) :: name !! of a column
        type(column_t) :: column
        integer :: i

        do i = 1, size(columns)
            if (columns(i)%name /= name) cycle
            column = columns(i)
            return
        end do
        column%long_name = name
        do i = 1, len(column%long_name)
            if (column%long_name(i:i) == '_') column%long_name(i:i) = ' '
        end do
    end function known_column

    !> Can a column's name be that of a NetCDF variable? UTF-8 is not looked at.
    pure logical function is_variable_name(name)
        character(len=*), intent(in) :: name !! of a column
        integer :: i

        is_variable_name = .false.
        if (len(name) == 0 .or. len(name) > longest_name) return
        do i = 1, len(name)
            ! Control characters, and what parts groups.
            if (iachar(name(i:i)) < iachar(' ') .or. name(i:i) == '/' &
                .or. iachar(name(i:i)) == 127) return ! Given: DEL
        end do
        is_variable_name = index('0123456789abcdefghijklmnopqrstuvwxyz_', &
                                 lower_case(name(1:1))) > 0
        if (iachar(name(1:1)) > 127) is_variable_name = .true. ! Given: ASCII
    end function is_variable_name
end module faststrip_files_columns
