!> A lookup table as NetCDF-4: its axes as coordinates, what was solved over them, the contacts of a
!> wheel, and the errors.
!>
!> The numbers of a wheel's contacts are physical ones, with the fill value where there is no
!> contact. What stands in the file of the table there is that of the nearest node with one.
module faststrip_netcdf_lookup
    use, intrinsic :: iso_fortran_env, only: int8
    use netcdf, only: nf90_create, nf90_def_dim, nf90_def_var, nf90_put_att, nf90_enddef, &
                      nf90_put_var, nf90_close, nf90_strerror, nf90_noerr, nf90_netcdf4, &
                      nf90_classic_model, nf90_noclobber, nf90_global, nf90_int, nf90_float, &
                      nf90_double
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, clear_status, is_error, set_status, st_file_write
    use faststrip_files_bytes, only: read_bytes
    use faststrip_lookup_bytes, only: open_lookup
    use faststrip_lookup_faces, only: n_faces, n_forces
    use faststrip_lookup_table, only: lookup_t, lookup_kind_wheel, n_contact_numbers, &
                                      at_load, at_area
    use faststrip_netcdf_columns, only: fill_number
    use faststrip_netcdf_file, only: deflate_level
    implicit none
    private

    public :: write_lookup

    !> A file being written.
    type :: file_t
        integer :: id = 0
        character(len=:), allocatable :: name
        type(status_t) :: status
    end type file_t

    !> A dimension and its variable.
    type :: axis_t
        integer :: dimension = 0, variable = 0
    end type axis_t

    !> A number of a wheel's contacts.
    type :: number_t
        character(len=24) :: name
        character(len=64) :: long_name
        character(len=8) :: unit
        integer :: thirds !! the table has it over N to so many thirds
    end type number_t

    type(number_t), parameter :: numbers(n_contact_numbers) = [ &
        number_t('normal_force', 'normal force', 'N', 0), &
        number_t('contact_angle', 'contact angle', 'rad', 0), &
        number_t('y_rail', 'y of the contact on the profile of the rail', 'mm', 0), &
        number_t('z_rail', 'z of the contact on the profile of the rail', 'mm', 0), &
        number_t('x_track', 'x of the contact in the track', 'mm', 0), &
        number_t('y_wheel', 'y of the contact on the profile of the wheel', 'mm', 0), &
        number_t('rolling_radius', 'rolling radius', 'mm', 0), &
        number_t('z_wheelset', 'z of the centre of the wheelset', 'mm', 0), &
        number_t('area', 'area of the contact', 'mm2', 2), &
        number_t('pmax', 'maximum pressure', 'MPa', 1), &
        number_t('c', 'length of the moment', 'mm', 1), &
        number_t('l1', 'squared length of the longitudinal creepage', 'mm2', 2), &
        number_t('l2', 'squared length of the lateral creepage', 'mm2', 2), &
        number_t('l3', 'cubed length of the spin creepage', 'mm3', 3)]

    character(len=*), parameter :: face_words = 'x1_x2_positive x1_x2_negative x2_positive ' // &
                                                'x2_negative x3_x2_positive x3_x2_negative'

contains

    !> Write the file.
    subroutine write_lookup(source, target, name, writer, status)
        character(len=*), intent(in) :: source  !! the table's file
        character(len=*), intent(in) :: target  !! the file to be made, which must not be there
        character(len=*), intent(in) :: name    !! what messages call that
        character(len=*), intent(in) :: writer  !! name, version and revision of the program
        type(status_t), intent(out) :: status   !! of the table; `st_file_write`

        type(lookup_t) :: lookup
        type(file_t) :: file
        integer(int8), allocatable :: bytes(:)
        integer :: code

        call read_bytes(source, bytes, status)
        if (is_error(status)) return
        call open_lookup(bytes, lookup, status)
        if (is_error(status)) return
        file%name = name
        call clear_status(file%status)
        call note(file, nf90_create(target, ior(ior(nf90_netcdf4, nf90_classic_model), &
                                                nf90_noclobber), file%id))
        status = file%status
        if (is_error(status)) return
        call describe_file(file, lookup, writer)
        if (lookup%kind == lookup_kind_wheel) then
            call write_wheel(file, lookup)
        else
            call write_hertz(file, lookup)
        end if
        code = nf90_close(file%id)
        call note(file, code)
        status = file%status
    end subroutine write_lookup

    ! What holds for the whole file.
    subroutine describe_file(file, lookup, writer)
        type(file_t), intent(inout) :: file
        type(lookup_t), intent(in) :: lookup
        character(len=*), intent(in) :: writer

        character(len=:), allocatable :: title

        title = 'lookup table of creep forces on Hertz ellipses'
        if (lookup%kind == lookup_kind_wheel) &
            title = 'lookup table of a wheel on a rail: contacts and creep forces'
        call note(file, nf90_put_att(file%id, nf90_global, 'Conventions', 'CF-1.8'))
        call note(file, nf90_put_att(file%id, nf90_global, 'title', title))
        call note(file, nf90_put_att(file%id, nf90_global, 'source', trim(lookup%text)))
        call note(file, nf90_put_att(file%id, nf90_global, 'history', 'written as NetCDF by ' &
                                     // writer))
        call note(file, nf90_put_att(file%id, nf90_global, 'poisson_ratio', lookup%nu))
        call note(file, nf90_put_att(file%id, nf90_global, 'promised_error', lookup%promised))
        call note(file, nf90_put_att(file%id, nf90_global, 'comment', 'x is scale X, X = G (ab, ' &
                  // 'ab, (ab)^1.5)/(mu N) times the creepages (of a wheel, l1, l2, l3 for scale' &
                  // ' and ab); r is the largest of |x|, q = r/(1 + r), ratios those of the ' &
                  // 'others to it; Fx, Fy and Mz/c over mu N are q phi'))
    end subroutine describe_file

    ! The table of Hertz ellipses.
    subroutine write_hertz(file, lookup)
        type(file_t), intent(inout) :: file
        type(lookup_t), intent(in) :: lookup

        type(axis_t) :: q, ratio(2), face, shape, force, creepage, statistic, order
        integer :: phi, scale, errors

        call define_faces(file, lookup, q, ratio, face, force)
        call define_axis(file, 'a_over_b', 'a/b, a along the rolling direction', '1', &
                         lookup%shape%n, nf90_double, shape)
        call define_axis(file, 'creepage', 'longitudinal, lateral, spin', '1', n_forces, nf90_int, &
                         creepage)
        call define_errors(file, statistic, order)
        call define(file, 'scale', 'scale of the creepages', '1', nf90_double, &
                    [creepage%dimension, shape%dimension], scale)
        call define(file, 'phi', 'Fx, Fy, Mz/c over mu N and q', '1', nf90_float, &
                    [force%dimension, q%dimension, ratio%dimension, face%dimension, &
                     shape%dimension], phi)
        call define(file, 'error', 'error of the interpolation', '1', nf90_double, &
                    [force%dimension, statistic%dimension, order%dimension], errors)
        call note(file, nf90_put_att(file%id, errors, 'tested', lookup%tested))
        call note(file, nf90_enddef(file%id))
        call put_faces(file, lookup, q, ratio, face, force)
        call put(file, shape%variable, exp(lookup%shape%x), [lookup%shape%n])
        call put_counts(file, creepage%variable, n_forces)
        call put_counts(file, statistic%variable, 3)
        call note(file, nf90_put_var(file%id, order%variable, [1, 3]))
        call put(file, scale, reshape(lookup%scale, [size(lookup%scale)]), shape_of(lookup%scale))
        call note(file, nf90_put_var(file%id, phi, lookup%values, start=[1, 1, 1, 1, 1, 1], &
                                     count=[n_forces, lookup%q%n, lookup%ratio%n, lookup%ratio%n, &
                                            n_faces, lookup%shape%n]))
        call put(file, errors, reshape(lookup%errors, [size(lookup%errors)]), [3, 3, 2])
    end subroutine write_hertz

    ! The table of a wheel on a rail.
    subroutine write_wheel(file, lookup)
        type(file_t), intent(inout) :: file
        type(lookup_t), intent(in) :: lookup

        type(axis_t) :: q, ratio(2), face, force, statistic, order, y, yaw, load, slot, contact, &
                        side, what, states
        integer :: phi, errors, set, of(n_contact_numbers), k, sizes(4)

        call define_faces(file, lookup, q, ratio, face, force)
        associate (wheel => lookup%wheel)
            call define_axis(file, 'y', 'lateral displacement of the wheelset', 'mm', wheel%y%n, &
                             nf90_double, y)
            call define_axis(file, 'yaw', 'yaw of the wheelset', 'rad', wheel%yaw%n, nf90_double, &
                             yaw)
            call define_axis(file, 'load', 'vertical part of the normal forces', 'N', &
                             wheel%load%n, nf90_double, load)
            call define_axis(file, 'slot', 'number of a contact, the same at all places', '1', &
                             wheel%slots, nf90_int, slot)
            call define_axis(file, 'contact', 'number of a contact that was solved', '1', &
                             wheel%sets, nf90_int, contact)
            call define_axis(file, 'side', '1: of the contact, 2: of its mirror image', '1', 2, &
                             nf90_int, side)
            call define_axis(file, 'compared', 'Fx, Fy, Mz over mu N and c, lateral part of the ' &
                             // 'normal forces over N, z as the load that it makes over the load', &
                             '1', wheel%n_errors, nf90_int, what)
            call define_axis(file, 'states', '1: all, 2: where contacts come or go', '1', 2, &
                             nf90_int, states)
            call define_errors(file, statistic, order)
            sizes = [wheel%slots, wheel%y%n, wheel%yaw%n, wheel%load%n]
            associate (places => [slot%dimension, y%dimension, yaw%dimension, load%dimension])
                do k = 1, n_contact_numbers
                    call define(file, trim(numbers(k)%name), trim(numbers(k)%long_name), &
                                trim(numbers(k)%unit), nf90_double, places, of(k))
                    call note(file, nf90_put_att(file%id, of(k), '_FillValue', fill_number))
                end do
                call define(file, 'contact_of', 'number of the contact whose phi counts', '1', &
                            nf90_int, places, set)
            end associate
            call define(file, 'phi', 'Fx, Fy, Mz/c over mu N and q', '1', nf90_float, &
                        [force%dimension, q%dimension, ratio%dimension, face%dimension, &
                         side%dimension, contact%dimension], phi)
            call define(file, 'error', 'error of the interpolation', '1', nf90_double, &
                        [what%dimension, statistic%dimension, order%dimension, &
                         states%dimension], errors)
            call note(file, nf90_put_att(file%id, errors, 'tested', wheel%tested))
            call note(file, nf90_put_att(file%id, nf90_global, 'shear_modulus_MPa', wheel%shear))
            call note(file, nf90_enddef(file%id))
            call put_faces(file, lookup, q, ratio, face, force)
            call put(file, y%variable, wheel%y%x, [wheel%y%n])
            call put(file, yaw%variable, wheel%yaw%x, [wheel%yaw%n])
            call put(file, load%variable, wheel%load%x, [wheel%load%n])
            call put_counts(file, slot%variable, wheel%slots)
            call put_counts(file, contact%variable, wheel%sets)
            call put_counts(file, side%variable, 2)
            call put_counts(file, what%variable, wheel%n_errors)
            call put_counts(file, states%variable, 2)
            call put_counts(file, statistic%variable, 3)
            call note(file, nf90_put_var(file%id, order%variable, [1, 3]))
            do k = 1, n_contact_numbers
                call put(file, of(k), physical(lookup, k), sizes)
            end do
            call note(file, nf90_put_var(file%id, set, reshape(wheel%set, [size(wheel%set)]), &
                                         start=[1, 1, 1, 1], count=sizes))
            call note(file, nf90_put_var(file%id, phi, lookup%values, start=[1, 1, 1, 1, 1, 1, 1], &
                                         count=[n_forces, lookup%q%n, lookup%ratio%n, &
                                                lookup%ratio%n, n_faces, 2, wheel%sets]))
            call put(file, errors, reshape(wheel%errors(:wheel%n_errors, :, :, :), &
                                           [wheel%n_errors*size(wheel%errors(1, :, :, :))]), &
                     [wheel%n_errors, 3, 2, 2])
        end associate
    end subroutine write_wheel

    ! A number of all contacts; the fill value where there is none.
    function physical(lookup, k) result(values)
        type(lookup_t), intent(in) :: lookup
        integer, intent(in) :: k
        real(wp), allocatable :: values(:)

        real(wp), allocatable :: load(:)

        associate (contacts => lookup%wheel%contacts)
            allocate (load(size(contacts(k, :, :))))
            load = reshape(contacts(at_load, :, :), [size(load)])
            values = reshape(contacts(k, :, :), [size(load)])
            if (k >= at_area) values = values*load**(numbers(k)%thirds/3.0_wp)
            where (.not. load > 0.0_wp) values = fill_number
        end associate
    end function physical

    ! Axes of the creepages and forces.
    subroutine define_faces(file, lookup, q, ratio, face, force)
        type(file_t), intent(inout) :: file
        type(lookup_t), intent(in) :: lookup
        type(axis_t), intent(out) :: q, ratio(2), face, force

        call define_axis(file, 'q', 'share of creepage, 0 nothing slides, 1 all', '1', lookup%q%n, &
                         nf90_double, q)
        call define_axis(file, 'ratio_1', 'first other creepage over the largest', '1', &
                         lookup%ratio%n, nf90_double, ratio(1))
        call define_axis(file, 'ratio_2', 'second other creepage over the largest', '1', &
                         lookup%ratio%n, nf90_double, ratio(2))
        call define_axis(file, 'face', 'which creepage is the largest, and the sign of x2', '1', &
                         n_faces, nf90_int, face)
        call note(file, nf90_put_att(file%id, face%variable, 'flag_values', [1, 2, 3, 4, 5, 6]))
        call note(file, nf90_put_att(file%id, face%variable, 'flag_meanings', face_words))
        call define_axis(file, 'force', 'which force', '1', n_forces, nf90_int, force)
        call note(file, nf90_put_att(file%id, force%variable, 'flag_values', [1, 2, 3]))
        call note(file, nf90_put_att(file%id, force%variable, 'flag_meanings', 'Fx Fy Mz'))
    end subroutine define_faces

    subroutine put_faces(file, lookup, q, ratio, face, force)
        type(file_t), intent(inout) :: file
        type(lookup_t), intent(in) :: lookup
        type(axis_t), intent(in) :: q, ratio(2), face, force

        call put(file, q%variable, lookup%q%x, [lookup%q%n])
        call put(file, ratio(1)%variable, lookup%ratio%x, [lookup%ratio%n])
        call put(file, ratio(2)%variable, lookup%ratio%x, [lookup%ratio%n])
        call put_counts(file, face%variable, n_faces)
        call put_counts(file, force%variable, n_forces)
    end subroutine put_faces

    ! Axes of the errors.
    subroutine define_errors(file, statistic, order)
        type(file_t), intent(inout) :: file
        type(axis_t), intent(out) :: statistic, order

        call define_axis(file, 'statistic', 'which figure of the errors', '1', 3, nf90_int, &
                         statistic)
        call note(file, nf90_put_att(file%id, statistic%variable, 'flag_values', [1, 2, 3]))
        call note(file, nf90_put_att(file%id, statistic%variable, 'flag_meanings', &
                                     'mean percentile_99 worst'))
        call define_axis(file, 'order', 'of the interpolation', '1', 2, nf90_int, order)
    end subroutine define_errors

    subroutine define_axis(file, name, long_name, unit, n, kind, axis)
        type(file_t), intent(inout) :: file
        character(len=*), intent(in) :: name, long_name, unit
        integer, intent(in) :: n, kind
        type(axis_t), intent(out) :: axis

        if (is_error(file%status)) return
        call note(file, nf90_def_dim(file%id, name, n, axis%dimension))
        call define(file, name, long_name, unit, kind, [axis%dimension], axis%variable)
    end subroutine define_axis

    subroutine define(file, name, long_name, unit, kind, dimensions, variable)
        type(file_t), intent(inout) :: file
        character(len=*), intent(in) :: name, long_name, unit
        integer, intent(in) :: kind, dimensions(:)
        integer, intent(out) :: variable

        variable = 0
        if (is_error(file%status)) return
        call note(file, nf90_def_var(file%id, name, kind, dimensions, variable, shuffle=.true., &
                                     deflate_level=deflate_level))
        if (is_error(file%status)) return
        call note(file, nf90_put_att(file%id, variable, 'long_name', long_name))
        call note(file, nf90_put_att(file%id, variable, 'units', unit))
    end subroutine define

    subroutine put(file, variable, values, sizes)
        type(file_t), intent(inout) :: file
        integer, intent(in) :: variable, sizes(:)
        real(wp), intent(in) :: values(:)

        integer :: first(size(sizes))

        if (is_error(file%status)) return
        first = 1
        call note(file, nf90_put_var(file%id, variable, values, start=first, count=sizes))
    end subroutine put

    subroutine put_counts(file, variable, n)
        type(file_t), intent(inout) :: file
        integer, intent(in) :: variable, n

        integer :: i

        if (is_error(file%status)) return
        call note(file, nf90_put_var(file%id, variable, [(i, i=1, n)]))
    end subroutine put_counts

    pure function shape_of(array) result(sizes)
        real(wp), intent(in) :: array(:, :)
        integer :: sizes(2)

        sizes = shape(array)
    end function shape_of

    ! Keep the first failure.
    subroutine note(file, code)
        type(file_t), intent(inout) :: file
        integer, intent(in) :: code

        if (code == nf90_noerr .or. is_error(file%status)) return
        call set_status(file%status, st_file_write, 'cannot write the file: ' // file%name // ': ' &
                        // trim(nf90_strerror(code)))
    end subroutine note
end module faststrip_netcdf_lookup
