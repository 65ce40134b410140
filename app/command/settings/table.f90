!> What can be set: one table of settings, which case files, options of the command line, tables of
!> states and of methods, their help and the documents read.
!>
!> A new setting is a row here, a line in `put_setting` (or in the rules of its group) and the
!> component that it sets.
module faststrip_command_settings_table
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_friction, only: friction_kind_names
    use faststrip_base_friction_table, only: most_places
    use faststrip_base_kinds, only: wp
    use faststrip_base_plausible, only: of_friction, of_contact_angle, of_gauge, of_gauge_depth, &
                                        of_inclination, of_noise, of_poisson_ratio, of_radius, &
                                        of_shift, of_slip_speed, of_speed, of_tread_line, of_yield
    use faststrip_base_status, only: message_length
    use faststrip_base_thermal, only: coldest
    use faststrip_base_text, only: lower_case, parse_real, parse_integer, integer_text, trim_blanks
    use faststrip_contact_methods, only: normal_table, tangential_table, most_strips, most_rows
    use faststrip_contact_wanted, only: target_names
    use faststrip_tangential_types, only: most_points
    implicit none
    private

    public :: setting_t, value_t, settings, row_friction, row_numerics, thermal_settings, n_state, &
              state_names
    public :: of_group
    public :: find_setting, read_value, kind_words, range_words, full_words, option_help, one_of
    public :: a_text, a_path, a_word, a_number, a_list, a_flag
    public :: no_fault, wrong_kind, out_of_range

    !> What a value is: a text, a file, one of some words, a whole number, a number, numbers, yes.
    !> Given: numbers of kinds.
    integer, parameter :: a_text = 1, a_path = 2, a_word = 3, a_whole = 4, a_number = 5, &
                          a_list = 6, a_flag = 7
    !> Where numbers must lie; all must be finite.
    !> Given: numbers of kinds.
    integer, parameter :: anywhere = 0, above_0 = 1, from_0 = 2, below_half = 3, up_to_1 = 4, &
                          a_slope = 5, from_coldest = 6
    !> What is wrong with a value: not of its kind, or not in its range.
    !> Given: numbers of kinds.
    integer, parameter :: no_fault = 0, wrong_kind = 1, out_of_range = 2

    !> What norm starts from, `start_coarse` and `start_strips`: a coarser grid, which gives errors
    !> too, or strips.
    character(len=6), parameter :: norm_starts(2) = [character(len=6) :: 'coarse', 'strips']
    ! What the user may ask for.
    ! Tuned [elements]. Origin: capacity: 10 GB of memory.
    integer, parameter :: most_elements = 20000000
    ! Tuned [shifts]: of a sweep. Origin: capacity.
    integer, parameter :: most_shifts = 1000

    character, parameter :: newline = new_line('a')

    !> One setting.
    type :: setting_t
        character(len=10) :: group = ''      !! of the case file; two that know it: `wheel rail`
        character(len=29) :: key = ''        !! its name there
        integer :: kind = a_number           !! one of the `a_` numbers
        character(len=160) :: help = ''      !! what it is; lines parted by line feeds
        integer :: range = anywhere          !! of numbers
        integer :: most = 0                  !! of whole numbers, from 1 on; of lists: numbers
        character(len=4) :: nought = ''      !! word for the whole number 0, if that is allowed
        character(len=24) :: words = ''      !! that it may be, parted by blanks; see `words_of`
        logical :: is_needed = .false.       !! must the group give it?
        integer :: quantity = 0              !! what it is in practice: place in `quantities`, or 0
        character(len=24) :: default = ''    !! what it is where nothing is said, for people
        character(len=20) :: option = ''     !! of the command line, with its dashes; or none
        character(len=8) :: value_name = ''  !! of the option's value, for its help
    end type setting_t

    !> A value that was given.
    type :: value_t
        logical :: is_given = .false.
        integer :: line = 0                   !! of the file
        character(len=:), allocatable :: text !! as it stands; texts and words without quotes
        real(wp) :: number = 0.0_wp           !! of numbers
        integer :: whole = 0                  !! of whole numbers
        logical :: flag = .false.             !! of yes and no
        real(wp), allocatable :: list(:)      !! of lists
    end type value_t

    type(setting_t), parameter :: of_contact(*) = [ &
        setting_t('contact', 'name', a_text, 'name of the case, in every row', default='case'), &
        setting_t('contact', 'gap_file', a_path, &
                  'a [gap](#gap-files), instead of the groups `wheel` and `rail`'), &
        setting_t('contact', 'load_N', a_number, 'normal force, or the vertical one', &
                  range=above_0), &
        setting_t('contact', 'penetration_mm', a_number, 'instead of the load'), &
        setting_t('contact', 'load_direction', a_word, &
                  'of the load: along the contact normal, or vertical', words='normal vertical', &
                  default='normal'), &
        setting_t('contact', 'shift_mm', a_number, &
                  'lateral displacement of the wheelset, to the right', quantity=of_shift, &
                  default='0', option='--shift', value_name='MM')]

    type(setting_t), parameter :: of_material(*) = [ &
        setting_t('material', 'E_wheel_MPa', a_number, "Young's modulus of the wheel", &
                  range=above_0, default='209920'), &
        setting_t('material', 'E_rail_MPa', a_number, "Young's modulus of the rail", &
                  range=above_0, default='209920'), &
        setting_t('material', 'nu_wheel', a_number, "Poisson's ratio of the wheel", &
                  range=below_half, quantity=of_poisson_ratio, default='0.28'), &
        setting_t('material', 'nu_rail', a_number, "Poisson's ratio of the rail", &
                  range=below_half, quantity=of_poisson_ratio, default='0.28'), &
        setting_t('material', 'mu', a_number, 'coefficient of friction, static; not needed with' &
                  // ' `mu_table`', range=from_0)]

    type(setting_t), parameter :: of_wheel(*) = [ &
        setting_t('wheel', 'profile', a_text, '`s1002`, `cone20`, `cone40` or a file'), &
        setting_t('wheel', 'profile_left', a_text, 'of the left wheel; `wheelset`, `conicity`', &
                  default='as the right one'), &
        setting_t('wheel', 'radius_mm', a_number, 'rolling radius at the nominal rolling circle', &
                  range=above_0, quantity=of_radius, default='460'), &
        setting_t('wheel', 'radius_left_mm', a_number, &
                  'of the left wheel; `wheelset`, `conicity`', range=above_0, &
                  quantity=of_radius, default='as the right one'), &
        setting_t('wheel', 'back_spacing_mm', a_number, 'flange back-to-back distance', &
                  range=above_0, quantity=of_gauge, default='from the gauge'), &
        setting_t('wheel', 'tread_line_mm', a_number, &
                  'nominal rolling circle from the flange back', range=above_0, &
                  quantity=of_tread_line, default='70')]

    type(setting_t), parameter :: of_rail(*) = [ &
        setting_t('rail', 'profile', a_text, '`uic60`, `60e1`, `54e1` or a file'), &
        setting_t('rail', 'profile_left', a_text, 'of the left rail; `wheelset`, `conicity`', &
                  default='as the right one'), &
        setting_t('rail', 'inclination', a_number, &
                  'tangent of the rail inclination, 0.025 for 1:40; of files it must be given', &
                  range=a_slope, quantity=of_inclination, default='0.025'), &
        setting_t('rail', 'cant', a_number, 'the older name of `inclination`', range=a_slope, &
                  quantity=of_inclination), &
        setting_t('rail', 'gauge_mm', a_number, 'track gauge', range=above_0, quantity=of_gauge, &
                  default='1435'), &
        setting_t('rail', 'gauge_depth_mm', a_number, &
                  'where it is measured, below the top of the rail', range=above_0, &
                  quantity=of_gauge_depth, default='14'), &
        setting_t('rail', 'rail_distance_mm', a_number, &
                  'of the origins of the rail profiles, instead of the gauge', range=above_0, &
                  quantity=of_gauge), &
        setting_t('rail', 'roller_radius_mm', a_number, 'of rollers in the place of rails, at' // &
                  ' the crown, or at z = 0 with `rail_distance_mm`; 0: rails', range=from_0, &
                  default='0')]

    ! How the file of a profile is to be read.
    type(setting_t), parameter :: of_profiles(*) = [ &
        setting_t('wheel rail', 'section', a_whole, 'which one, of a file with several', &
                  most=huge(1), option='--section', value_name='N'), &
        setting_t('wheel rail', 'side', a_word, 'right (default) or left, of a file with both', &
                  words='right left', default='right', option='--side', value_name='SIDE'), &
        setting_t('wheel rail', 'y_positive_to', a_word, &
                  'field or gauge: the sense of y in the file', words='field gauge', &
                  option='--y-positive-to', value_name='SIDE'), &
        setting_t('wheel rail', 'z_positive_to', a_word, 'down or up: the sense of z in the file', &
                  words='down up', option='--z-positive-to', value_name='SIDE'), &
        setting_t('wheel rail', 'unit', a_word, 'mm, m or in: the unit of the file', &
                  words='mm m in', option='--unit', value_name='UNIT'), &
        setting_t('wheel rail', 'any_count', a_flag, &
                  'take a number of points that the header denies', option='--any-count'), &
        setting_t('wheel rail', 'ignore_smoothing', a_flag, &
                  'pass over the smoothing a file asks for', option='--ignore-smoothing'), &
        setting_t('wheel', 'tape_circle_mm', a_number, &
                  'where the nominal rolling circle of a wheel is, in y of the file', &
                  option='--tape-circle', value_name='MM')]

    type(setting_t), parameter :: of_motion(*) = [ &
        setting_t('motion', 'creepage', a_word, 'as given here, or by formula: of rigid ' // &
                  'contact points, `(rR - rL)/(2 r0)`, 0, `-sin(gamma)/r0`', &
                  words='given formula', default='given'), &
        setting_t('motion', 'sign_set', a_word, 'signs of the formula', words='A B', default='B'), &
        setting_t('motion', 'cksi', a_number, 'longitudinal creepage', default='0'), &
        setting_t('motion', 'ceta', a_number, 'lateral creepage', default='0'), &
        setting_t('motion', 'cphi_rad_per_mm', a_number, 'spin creepage', default='0'), &
        setting_t('motion', 'speed_mm_s', a_number, &
                  'rolling speed, for friction that falls and temperatures', range=above_0, &
                  quantity=of_speed), &
        setting_t('motion', 'Fx_N', a_number, &
                  'longitudinal force on the rail, instead of `cksi`, which is found'), &
        setting_t('motion', 'Fy_N', a_number, &
                  'lateral force on the rail, instead of `ceta`, which is found')]

    type(setting_t), parameter :: of_friction_laws(*) = [ &
        setting_t('friction', 'kind', a_word, 'how friction falls with slip speed', &
                  default='constant'), &
        setting_t('friction', 'mu_kinetic', a_number, 'coefficient at large slip speed', &
                  range=above_0), &
        setting_t('friction', 'half_slip_speed_mm_s', a_number, &
                  'slip speed where half of the fall is done', range=above_0, &
                  quantity=of_slip_speed), &
        setting_t('friction', 'initial_slope_factor', a_number, &
                  'factor of the initial slope of forces over creepage', range=up_to_1, &
                  default='1'), &
        setting_t('friction', 'mu_flange', a_number, 'coefficient at the flange', range=from_0, &
                  quantity=of_friction), &
        setting_t('friction', 'tread_angle_rad', a_number, &
                  'contact angle up to which `mu` of `&material` counts', range=from_0, &
                  quantity=of_contact_angle), &
        setting_t('friction', 'flange_angle_rad', a_number, &
                  'contact angle from which `mu_flange` counts', quantity=of_contact_angle), &
        setting_t('friction', 'mu_hot', a_number, 'coefficient at high temperature', &
                  range=above_0), &
        setting_t('friction', 'cold_temperature_C', a_number, &
                  'temperature of the surfaces up to which friction is cold', range=from_coldest), &
        setting_t('friction', 'hot_temperature_C', a_number, &
                  'temperature of the surfaces from which `mu_hot` counts', range=from_coldest), &
        setting_t('friction', 'mu_y_mm', a_list, &
                  'where `mu_table` counts: y of the rail profile, increasing; of a gap file y of' &
                  // newline // 'the gap; not beside `mu_angle_rad`', most=most_places), &
        setting_t('friction', 'mu_angle_rad', a_list, &
                  'where `mu_table` counts: contact angles of either sign, increasing', &
                  range=from_0, most=most_places), &
        setting_t('friction', 'mu_table', a_list, &
                  'coefficients there, in place of `mu`: linear between, constant beyond', &
                  range=from_0, most=most_places)]

    !> Of the friction of a row: kind, coefficient, slip speed, factor of the slope; the speed; hot
    !> coefficient, both temperatures; places and coefficients of a table. With it rows of a batch
    !> look nothing up.
    type(setting_t), parameter :: row_friction(10) = [of_friction_laws(:4), of_motion(6), &
                                                      of_friction_laws(8:11), of_friction_laws(13)]

    !> What makes a contact warm. What is of both bodies stands before what is of one.
    type(setting_t), parameter :: thermal_settings(*) = [ &
        setting_t('thermal', 'conductivity_W_per_mK', a_number, 'thermal conductivity of both', &
                  range=above_0, default='50'), &
        setting_t('thermal', 'conductivity_wheel_W_per_mK', a_number, 'of the wheel', &
                  range=above_0), &
        setting_t('thermal', 'conductivity_rail_W_per_mK', a_number, 'of the rail', &
                  range=above_0), &
        setting_t('thermal', 'heat_capacity_J_per_kgK', a_number, 'heat capacity of both', &
                  range=above_0, default='450'), &
        setting_t('thermal', 'heat_capacity_wheel_J_per_kgK', a_number, 'of the wheel', &
                  range=above_0), &
        setting_t('thermal', 'heat_capacity_rail_J_per_kgK', a_number, 'of the rail', &
                  range=above_0), &
        setting_t('thermal', 'density_kg_per_m3', a_number, 'density of both', range=above_0, &
                  default='7850'), &
        setting_t('thermal', 'density_wheel_kg_per_m3', a_number, 'of the wheel', &
                  range=above_0), &
        setting_t('thermal', 'density_rail_kg_per_m3', a_number, 'of the rail', range=above_0), &
        setting_t('thermal', 'temperature_wheel_C', a_number, &
                  'of the wheel, away from the contact', range=from_coldest, default='20'), &
        setting_t('thermal', 'temperature_rail_C', a_number, &
                  'of the rail, away from the contact', range=from_coldest, default='20')]

    type(setting_t), parameter :: of_numerics(*) = [ &
        setting_t('numerics', 'normal', a_word, 'normal method, one of the above', &
                  default='strip', option='--normal', value_name='NAME'), &
        setting_t('numerics', 'tangential', a_word, &
                  'tangential method, one of the above', default='faststrip', &
                  option='--tangential', value_name='NAME'), &
        setting_t('numerics', 'strips_per_patch', a_whole, &
                  'strips across the largest patch, or auto', most=most_strips, &
                  nought='auto', default='15', option='--strips-per-patch', value_name='N'), &
        setting_t('numerics', 'points_per_strip', a_whole, &
                  'points along a strip, faststrip...', most=most_points, &
                  default='15', option='--points-per-strip', value_name='N'), &
        setting_t('numerics', 'fastsim_nx', a_whole, 'points along a row, fastsim...', &
                  most=most_rows, default='50', option='--fastsim-nx', value_name='N'), &
        setting_t('numerics', 'fastsim_ny', a_whole, 'rows, fastsim...', &
                  most=most_rows, default='50', option='--fastsim-ny', value_name='N'), &
        setting_t('numerics', 'element_dx_mm', a_number, &
                  'side of the elements along x, norm, tang (default 0.2,' // newline &
                  // 'less in small contacts)', range=above_0, default='0.2', &
                  option='--element-dx', value_name='MM'), &
        setting_t('numerics', 'element_dy_mm', a_number, &
                  'side of the elements along y, norm, tang (default 0.2,' // newline &
                  // 'less in small contacts)', range=above_0, default='0.2', &
                  option='--element-dy', value_name='MM'), &
        setting_t('numerics', 'error_target', a_number, &
                  'norm: choose the sides for this relative error', range=from_0, &
                  option='--error-target', value_name='E'), &
        setting_t('numerics', 'max_elements', a_whole, &
                  'norm, tang: no larger grids than that', most=most_elements, &
                  default='1000000', option='--max-elements', value_name='N'), &
        setting_t('numerics', 'resolution_limit', a_number, &
                  'status under_resolved above this est_err_...', range=above_0, &
                  default='0.1', option='--resolution-limit', value_name='E'), &
        setting_t('numerics', 'force_limit', a_number, &
                  'the same of est_err_Fx, _Fy, _Mz', range=above_0, default='0.1', &
                  option='--force-limit', value_name='E'), &
        setting_t('numerics', 'curved', a_flag, &
                  'each strip in a plane of its own', default='.false.', &
                  option='--curved'), &
        setting_t('numerics', 'subsurface', a_flag, &
                  'find the largest von Mises stress of the rail', default='.false.', &
                  option='--subsurface'), &
        setting_t('numerics', 'yield_MPa', a_number, &
                  'status beyond_yield where pmax is above (default none)', range=from_0, &
                  quantity=of_yield, option='--yield-MPa', value_name='MPA'), &
        setting_t('numerics', 'yield_shear_MPa', a_number, &
                  'yield stress in cyclic shear, for fatigue_index', range=from_0, &
                  quantity=of_yield, option='--yield-shear-MPa', value_name='MPA'), &
        setting_t('numerics', 'wear_file', a_path, &
                  'wear law, for wear_ug_per_m; faststrip, faststrip-plain', option='--wear', &
                  value_name='FILE.csv'), &
        setting_t('numerics', 'norm_start', a_word, &
                  'norm starts from a coarse grid (default) or strips', default='coarse', &
                  option='--norm-start', value_name='NAME'), &
        setting_t('numerics', 'smoothing_um', a_number, &
                  'smooth the gap for this noise of its heights, rms, in um', range=from_0, &
                  quantity=of_noise, option='--smooth', value_name='UM'), &
        setting_t('numerics', 'tolerance', a_number, 'auto: largest error wanted', &
                  range=above_0, default='0.02', option='--tolerance', value_name='E'), &
        setting_t('numerics', 'target', a_word, &
                  'auto: of forces (default), over mu N, pmax (default with' // newline &
                  // '--tangential none), penetration, area or power', default='forces', &
                  option='--target', value_name='NAME'), &
        setting_t('numerics', 'budget_us', a_number, &
                  'auto: the best in that time; goes before the default' // newline &
                  // 'tolerance; another run may end with other bytes', range=above_0, &
                  option='--budget-us', value_name='US'), &
        setting_t('numerics', 'gap_step_mm', a_number, 'sampling of the gap of two profiles', &
                  range=above_0, default='0.05'), &
        setting_t('numerics', 'gap_height_mm', a_number, 'largest gap that is sampled', &
                  range=above_0, default='0.6'), &
        setting_t('numerics', 'contact_damping_s_per_mm', a_number, &
                  'of a wheelset: share by which forces grow with the approach rate', &
                  range=from_0, default='0'), &
        setting_t('numerics', 'speed_floor_mm_s', a_number, &
                  'of a wheelset: rolling speed below which friction grows with slip velocities', &
                  range=from_0, default='0'), &
        setting_t('numerics', 'rail_stiffness_y_N_mm', a_number, &
                  'of a wheelset: of a spring below each rail, lateral; 0: rigid', &
                  range=from_0, default='0'), &
        setting_t('numerics', 'rail_stiffness_z_N_mm', a_number, &
                  'the same, vertical', range=from_0, default='0'), &
        setting_t('numerics', 'profile_accuracy_um', a_number, &
                  'of a wheelset: of heights of its profiles, for est_err_load', &
                  range=from_0, default='0.5')]

    type(setting_t), parameter :: of_sweep(*) = [ &
        setting_t('sweep', 'shifts_mm', a_list, 'lateral displacements; ' // &
                  'the same one several times, with creepages, for a creep-force curve', &
                  most=most_shifts, quantity=of_shift), &
        setting_t('sweep', 'load_N', a_list, 'normal forces, one a shift', most=most_shifts, &
                  range=above_0), &
        setting_t('sweep', 'cksi', a_list, 'longitudinal creepages, one a shift', &
                  most=most_shifts), &
        setting_t('sweep', 'ceta', a_list, 'lateral creepages, one a shift', most=most_shifts), &
        setting_t('sweep', 'cphi_rad_per_mm', a_list, 'spin creepages, one a shift', &
                  most=most_shifts)]

    !> How many numbers a state has.
    !> Given: as many as rows.
    integer, parameter :: n_state = 27

    !> What of it each row of a batch may have.
    type(setting_t), parameter :: row_numerics(1) = &
        [of_numerics(findloc(of_numerics%key, 'curved', dim=1))]

    ! The numbers of a state in the order of `take_state`, after the side.
    type(setting_t), parameter :: of_state(1 + n_state) = [ &
        setting_t('state', 'side', a_word, '`left`, `right`: that wheel alone; `both`', &
                  words='left right both', default='both'), &
        setting_t('state', 'y_mm', a_number, &
                  "lateral displacement of the wheelset's centre, to the right", &
                  is_needed=.true.), &
        setting_t('state', 'roll_rad', a_number, 'right wheel down; empty: it is found'), &
        setting_t('state', 'yaw_rad', a_number, 'nose to the right', is_needed=.true.), &
        setting_t('state', 'speed_mm_s', a_number, 'along the track; below 0 backwards', &
                  is_needed=.true.), &
        setting_t('state', 'pitch_rate_rad_s', a_number, &
                  'about the axle, negative for rolling ahead; not given: pure rolling at the' &
                  // ' mean nominal radius'), &
        setting_t('state', 'Fz_N', a_number, 'vertical force on the rail, normal and friction' &
                  // ' forces together: of the wheel, with `both` of the axle'), &
        setting_t('state', 'z_mm', a_number, 'instead of `Fz_N`, with a roll: height of the' &
                  // ' centre, down; 0: nominal rolling circles at the height of the crowns'), &
        setting_t('state', 'vy_mm_s', a_number, 'velocity to the right', default='0'), &
        setting_t('state', 'vz_mm_s', a_number, 'velocity down', default='0'), &
        setting_t('state', 'roll_rate_rad_s', a_number, 'rate of the roll', default='0'), &
        setting_t('state', 'yaw_rate_rad_s', a_number, 'rate of the yaw', default='0'), &
        setting_t('state', 'curve_radius_mm', a_number, &
                  'of the track, positive to the right; empty: straight'), &
        setting_t('state', 'roll_moment_Nmm', a_number, 'along the track, about the centre,' &
                  // ' from the frame: with `both` and a roll that is found', default='0'), &
        setting_t('state', 'rail_right_y_mm', a_number, &
                  'right rail beside its place in the design, to the right', default='0'), &
        setting_t('state', 'rail_right_z_mm', a_number, 'the same, down', default='0'), &
        setting_t('state', 'rail_right_roll_rad', a_number, &
                  'turned about the origin of its profile, right side down', default='0'), &
        setting_t('state', 'rail_right_vy_mm_s', a_number, &
                  'its velocity, in the creepages: to the right', default='0'), &
        setting_t('state', 'rail_right_vz_mm_s', a_number, 'the same, down', default='0'), &
        setting_t('state', 'rail_right_roll_rate_rad_s', a_number, 'rate of its roll', &
                  default='0'), &
        setting_t('state', 'rail_left_y_mm', a_number, &
                  'left rail, in the same frame: to the right', default='0'), &
        setting_t('state', 'rail_left_z_mm', a_number, 'the same, down', default='0'), &
        setting_t('state', 'rail_left_roll_rad', a_number, 'right side down', default='0'), &
        setting_t('state', 'rail_left_vy_mm_s', a_number, 'its velocity to the right', &
                  default='0'), &
        setting_t('state', 'rail_left_vz_mm_s', a_number, 'the same, down', default='0'), &
        setting_t('state', 'rail_left_roll_rate_rad_s', a_number, 'rate of its roll', &
                  default='0'), &
        setting_t('state', 'pitch_rate_difference_rad_s', a_number, &
                  'of wheels that rotate independently: left less right; the pitch rate is their' &
                  // ' mean', default='0'), &
        setting_t('state', 'axle_moment_Nmm', a_number, 'instead of `pitch_rate_rad_s`, with' &
                  // ' `both`: traction torque or braking moment about the axle on the' &
                  // ' wheelset, negative drives ahead; the pitch rate is found')]

    !> Their names, in tables and in the group `state`.
    character(len=29), parameter :: state_names(n_state) = of_state(2:)%key

    !> The table.
    type(setting_t), parameter :: settings(*) = [ &
        of_contact, of_wheel, of_rail, of_profiles, of_material, of_motion, of_friction_laws, &
        thermal_settings, of_numerics, of_state, of_sweep]

contains

    !> The rows of a group, as places in the table.
    pure function of_group(group) result(rows)
        character(len=*), intent(in) :: group !! of the case file, lower case
        integer, allocatable :: rows(:)

        integer :: i

        rows = pack([(i, i=1, size(settings))], [(knows(i), i=1, size(settings))])

    contains

        pure logical function knows(i)
            integer, intent(in) :: i

            knows = index(' ' // trim(settings(i)%group) // ' ', ' ' // group // ' ') > 0
        end function knows
    end function of_group

    !> The row of a name of a group, in capital letters or not; 0 if the group has none.
    pure integer function find_setting(group, key) result(at)
        character(len=*), intent(in) :: group !! of the case file, lower case
        character(len=*), intent(in) :: key   !! name in the group

        integer, allocatable :: rows(:)
        integer :: i

        rows = of_group(group)
        do i = 1, size(rows)
            at = rows(i)
            if (lower_case(trim(settings(at)%key)) == lower_case(key)) return
        end do
        at = 0
    end function find_setting

    !> The words that a setting may be.
    pure function words_of(setting) result(words)
        type(setting_t), intent(in) :: setting      !! of the kind `a_word`
        character(len=24), allocatable :: words(:)

        integer :: from, to

        select case (setting%key)
        case ('normal'); words = normal_table%name
        case ('tangential'); words = tangential_table%name
        case ('norm_start'); words = norm_starts
        case ('target'); words = target_names
        case ('kind'); words = friction_kind_names
        case default
            allocate (words(0))
            from = 1
            do while (from <= len_trim(setting%words))
                to = from + index(setting%words(from:) // ' ', ' ') - 2
                words = [character(len=24) :: words, setting%words(from:to)]
                from = to + 2
            end do
        end select
    end function words_of

    !> Read a value; the text is what stands there. Numbers of a list are added to those that it
    !> has: it may go over lines.
    pure subroutine read_value(setting, text, value, fault)
        type(setting_t), intent(in) :: setting !! its row
        character(len=*), intent(in) :: text   !! without quotes; blanks at the ends do not count
        type(value_t), intent(inout) :: value  !! its line stays
        integer, intent(out) :: fault          !! `no_fault`, or what is wrong

        logical :: is_read
        character(len=24), allocatable :: words(:)
        integer :: i

        value%is_given = .true.
        value%text = trim_blanks(text)
        fault = no_fault
        select case (setting%kind)
        case (a_text, a_path)
            value%text = text
        case (a_word)
            words = words_of(setting)
            do i = size(words), 1, -1
                if (lower_case(trim(words(i))) == lower_case(value%text)) exit
            end do
            value%whole = i
            if (value%whole == 0) fault = out_of_range
            if (value%whole > 0) value%text = trim(words(value%whole))
        case (a_whole)
            value%whole = 0
            if (setting%nought /= '' .and. lower_case(value%text) == setting%nought) return
            call parse_integer(value%text, value%whole, is_read)
            if (.not. is_read) then
                fault = wrong_kind
            else if (value%whole > setting%most .or. value%whole < 1 .and. &
                     .not. (value%whole == 0 .and. setting%nought /= '')) then
                fault = out_of_range
            end if
        case (a_number)
            call read_number(value%text, value%number, is_read)
            if (.not. is_read) then
                fault = wrong_kind
            else if (.not. is_within(setting%range, value%number)) then
                fault = out_of_range
            end if
        case (a_list)
            call add_numbers(value%text, setting%most, value%list, is_read)
            if (.not. is_read) then
                fault = wrong_kind
            else if (size(value%list) > setting%most .or. &
                     .not. all(is_within(setting%range, value%list))) then
                fault = out_of_range
            end if
        case (a_flag)
            call read_flag(value%text, value%flag, is_read)
            if (.not. is_read) fault = wrong_kind
        end select
    end subroutine read_value

    !> Is a number where it must lie?
    pure elemental logical function is_within(range, number)
        integer, intent(in) :: range
        real(wp), intent(in) :: number

        is_within = ieee_is_finite(number)
        if (.not. is_within) return
        select case (range)
        case (above_0); is_within = number > 0.0_wp
        case (from_0); is_within = number >= 0.0_wp
        case (below_half); is_within = number >= 0.0_wp .and. number < 0.5_wp
        case (up_to_1); is_within = number > 0.0_wp .and. number <= 1.0_wp
        case (a_slope); is_within = abs(number) <= 1.0_wp
        case (from_coldest); is_within = number >= coldest
        end select
    end function is_within

    !> A number, also one that is not finite: this is reported in other words.
    pure subroutine read_number(text, number, is_read)
        character(len=*), intent(in) :: text
        real(wp), intent(out) :: number
        logical, intent(out) :: is_read

        call parse_real(text, number, is_read)
        if (is_read) return
        if (text == '') return
        select case (lower_case(text(verify(text // ' ', '+-'):)))
        case ('nan', 'inf', 'infinity')
            read (text, *) number
            is_read = .true.
        end select
    end subroutine read_number

    !> Add numbers parted by commas and blanks to a list; `3*0.1` is a number three times. Behind
    !> the most that it may have, no more are read.
    pure subroutine add_numbers(text, most, list, is_read)
        character(len=*), intent(in) :: text
        integer, intent(in) :: most
        real(wp), allocatable, intent(inout) :: list(:)
        logical, intent(out) :: is_read

        character(len=*), parameter :: blanks = ' ' // achar(9)
        integer :: from, to, star, times
        real(wp) :: number

        if (.not. allocated(list)) allocate (list(0))
        is_read = .false.
        from = 1
        do while (from <= len(text) .and. size(list) <= most)
            to = from + scan(text(from:) // ',', ',' // blanks) - 2
            star = index(text(from:to), '*')
            times = 1
            if (star > 0) then
                call parse_integer(text(from:from + star - 2), times, is_read)
                if (.not. is_read .or. times < 1) then
                    is_read = .false.
                    return
                end if
            end if
            call read_number(text(from + star:to), number, is_read)
            if (.not. is_read) return
            list = [list, spread(number, 1, min(times, most + 1))]
            ! What parts it from the next one: blanks, with one comma at most.
            from = to + 1
            from = from + verify(text(from:) // 'x', blanks) - 1
            if (from > len(text)) exit
            if (text(from:from) == ',') from = from + 1
            from = from + verify(text(from:) // 'x', blanks) - 1
        end do
        is_read = size(list) > 0
    end subroutine add_numbers

    !> Yes or no, as Fortran writes them.
    pure subroutine read_flag(text, flag, is_read)
        character(len=*), intent(in) :: text
        logical, intent(out) :: flag, is_read

        flag = .false.
        is_read = .true.
        select case (lower_case(text))
        case ('.true.', 'true', '.t.', 't'); flag = .true.
        case ('.false.', 'false', '.f.', 'f')
        case default; is_read = .false.
        end select
    end subroutine read_flag

    !> What kind of value it must be, after `must be`.
    pure function kind_words(setting) result(words)
        type(setting_t), intent(in) :: setting
        character(len=message_length) :: words !! of fixed length: threads call it

        select case (setting%kind)
        case (a_whole); words = 'a whole number'
        case (a_number); words = 'a number'
        case (a_list); words = 'a list of numbers'
        case (a_flag); words = '.true. or .false.'
        case default; words = 'text in quotes'
        end select
    end function kind_words

    !> Where a value of the right kind must lie, after `must be`.
    pure function range_words(setting, number) result(words)
        type(setting_t), intent(in) :: setting
        real(wp), intent(in), optional :: number !! that lies elsewhere, for the end it is beyond
        character(len=message_length) :: words     !! of fixed length: threads call it

        words = ''
        select case (setting%kind)
        case (a_word)
            words = one_of(words_of(setting))
        case (a_whole)
            words = 'a whole number from 1 on'
            if (setting%most < huge(1)) &
                words = 'a whole number from 1 to ' // integer_text(setting%most)
            if (setting%nought /= '') words = trim(words) // ' or ' // setting%nought
        case (a_list)
            words = 'at most ' // integer_text(setting%most) // ' finite numbers'
            if (setting%range == above_0) words = trim(words) // ' above 0'
            if (setting%range == from_0) words = trim(words) // ' from 0 on'
        case (a_number)
            select case (setting%range)
            case (above_0); words = 'above 0'
            case (from_0); words = 'from 0 on'
            case (below_half); words = 'at least 0 and below 0.5'
            case (up_to_1)
                words = 'above 0 and at most 1'
                if (.not. present(number)) return
                words = 'above 0'
                if (number > 1.0_wp) words = 'at most 1'
            case (a_slope); words = 'the tangent of the rail inclination, -1 to 1'
            case (from_coldest); words = 'at least -273.15'
            end select
        end select
    end function range_words

    !> All that it must be, after `must be`, for who sees nothing but the words.
    pure function full_words(setting) result(words)
        type(setting_t), intent(in) :: setting
        character(len=message_length) :: words

        words = range_words(setting)
        select case (setting%kind)
        case (a_text); words = 'text'
        case (a_path); words = 'a file'
        case (a_flag); words = '.true. or .false.'
        case (a_word); words = with_or(words_of(setting))
        case (a_number)
            if (setting%range /= a_slope) words = 'a number ' // words
            if (setting%range == anywhere) words = 'a finite number'
        end select
    end function full_words

    !> What the help of an option says.
    pure function option_help(setting) result(text)
        type(setting_t), intent(in) :: setting
        character(len=message_length) :: text

        text = setting%help
        if (setting%default /= '' .and. index(text, 'default') == 0) &
            text = trim(text) // ' (default ' // trim(setting%default) // ')'
    end function option_help

    !> What one of some words must be, in files.
    pure function one_of(words) result(text)
        character(len=*), intent(in) :: words(:)
        character(len=message_length) :: text

        integer :: i

        if (size(words) < 3) then
            text = with_or(words)
            return
        end if
        text = 'one of ' // words(1)
        do i = 2, size(words)
            text = trim(text) // ', ' // words(i)
        end do
    end function one_of

    pure function with_or(words) result(text)
        character(len=*), intent(in) :: words(:)
        character(len=message_length) :: text

        integer :: i

        text = words(1)
        do i = 2, size(words)
            if (i < size(words)) text = trim(text) // ', ' // words(i)
            if (i == size(words)) text = trim(text) // ' or ' // words(i)
        end do
    end function with_or
end module faststrip_command_settings_table
