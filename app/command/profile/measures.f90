!> What `faststrip profile` tells of one file.
module faststrip_command_profile_measures
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error, status_word
    use faststrip_geometry_arc_spline, only: find_kinks
    use faststrip_geometry_touchable, only: body_wheel, body_rail
    use faststrip_geometry_wear, only: rail_wear_t
    use faststrip_files_csv, only: csv_writer_t, put_header, put_cell, put_cells, put_empty_cells, &
                                   end_row
    use faststrip_files_profile_taken, only: taken_profile_t
    use faststrip_command_program_console, only: printable
    implicit none
    private

    public :: measures_t, measure_profile, put_measures_header, put_measures

    !> Names of the columns.
    character(len=*), parameter :: columns(33) = [character(len=21) :: &
        'file', 'format', 'kind', 'points', 'y_min_mm', 'y_max_mm', 'z_min_mm', 'z_max_mm', &
        'Sd_mm', 'Sh_mm', 'qR_mm', 'length_mm', 'spacing_min_mm', 'spacing_max_mm', &
        'y_of_widest_gap_mm', 'y_positive_to', 'z_positive_to', 'runs_to', 'unit_mm', 'sections', &
        'kinks', 'touchable_points', 'touchable_y_min_mm', 'touchable_y_max_mm', &
        'curvature_min_per_mm', 'curvature_max_per_mm', 'wear_top_mm', 'wear_side_mm', &
        'wear_corner_mm', 'wear_max_mm', 'curation', 'status', 'message']

    !> Tuned [mm]: half the length over which a curvature is taken. Origin: chosen.
    real(wp), parameter :: reach = 1.0_wp

    !> One profile, and how it ended.
    type, extends(taken_profile_t) :: measures_t
        character(len=:), allocatable :: path      !! name of the file
        type(rail_wear_t) :: wear                  !! of a rail against a nominal one
        real(wp) :: largest_wear = 0.0_wp          !! mm
        logical :: has_wear = .false.              !! was there a nominal profile?
        logical, allocatable :: is_kink(:)         !! at the points
        real(wp), allocatable :: curvature(:)      !! at the touchable points, 1/mm
        type(status_t) :: status                   !! of reading or cleaning it
    end type measures_t

contains

    !> Measure what was taken.
    subroutine measure_profile(kink_angle, measures)
        real(wp), intent(in) :: kink_angle             !! turn from which a point is a kink, rad
        type(measures_t), intent(inout) :: measures    !! its profile is taken

        associate (y => measures%points%y, z => measures%points%z)
            allocate (measures%is_kink(size(y)), source=.false.)
            call find_kinks(y, z, kink_angle, measures%is_kink)
            measures%curvature = curvatures(y(measures%part%point), z(measures%part%point))
        end associate
    end subroutine measure_profile

    !> Curvature of the circles through points a millimetre apart, positive where the curve bends
    !> down.
    pure function curvatures(y, z) result(curvature)
        real(wp), intent(in) :: y(:), z(:)
        real(wp) :: curvature(size(y))

        real(wp) :: a(2), b(2), c(2)
        integer :: i, before, after, n

        n = size(y)
        curvature = 0.0_wp
        before = 1
        after = 1
        do i = 1, n
            do while (before < i .and. hypot(y(i) - y(before), z(i) - z(before)) > reach)
                before = before + 1
            end do
            before = max(before - 1, 1)
            after = max(after, i)
            do while (after < n .and. hypot(y(after) - y(i), z(after) - z(i)) < reach)
                after = after + 1
            end do
            if (before == i .or. after == i) cycle
            a = [y(i) - y(before), z(i) - z(before)]
            b = [y(after) - y(i), z(after) - z(i)]
            c = a + b
            curvature(i) = 2.0_wp*(a(1)*b(2) - a(2)*b(1))/(norm2(a)*norm2(b)*norm2(c))
        end do
        if (n > 2) curvature([1, n]) = curvature([2, n - 1])
    end function curvatures

    !> The names of the columns.
    subroutine put_measures_header(writer)
        type(csv_writer_t), intent(inout) :: writer !! an open file

        call put_header(writer, columns)
    end subroutine put_measures_header

    !> One row.
    subroutine put_measures(writer, measures)
        type(csv_writer_t), intent(inout) :: writer  !! an open file
        type(measures_t), intent(in) :: measures     !! one file

        call put_cell(writer, printable(measures%path))
        if (is_error(measures%status)) then
            call put_cell(writer, trim(measures%points%format))
            call put_cell(writer, kind_word(measures%points%kind))
            ! Given: behind three, before the last two.
            call put_empty_cells(writer, size(columns) - 5)
            call put_cell(writer, trim(status_word(measures%status%code)))
            call put_cell(writer, printable(trim(measures%status%message)))
        else
            call put_known(writer, measures)
            call put_cell(writer, trim(status_word(measures%status%code)))
            call put_cell(writer, printable(measures%words))
        end if
        call end_row(writer)
    end subroutine put_measures

    subroutine put_known(writer, measures)
        type(csv_writer_t), intent(inout) :: writer
        type(measures_t), intent(in) :: measures

        real(wp), allocatable :: chord(:)
        integer :: n

        associate (points => measures%points, y => measures%points%y, z => measures%points%z)
            n = size(y)
            chord = hypot(y(2:) - y(:n - 1), z(2:) - z(:n - 1))
            call put_cell(writer, trim(points%format))
            call put_cell(writer, kind_word(points%kind))
            call put_cell(writer, n)
            call put_cells(writer, [minval(y), maxval(y), minval(z), maxval(z)])
            call put_cell(writer, measures%flange%sd, is_known=measures%flange%is_known)
            call put_cell(writer, measures%flange%sh, is_known=measures%flange%is_known)
            call put_cell(writer, measures%flange%qr, is_known=measures%flange%is_known)
            call put_cells(writer, [sum(chord), minval(chord), maxval(chord), &
                                    y(maxloc(chord, dim=1))])
            call put_cell(writer, trim(merge('field', 'gauge', points%y_sense > 0)))
            call put_cell(writer, trim(merge('down', 'up  ', points%z_sense > 0)))
            call put_cell(writer, trim(merge('gauge', 'field', points%is_reversed)))
            call put_cell(writer, points%unit_mm)
            call put_cells(writer, [points%n_sections, count(measures%is_kink), &
                                    size(measures%part%point)])
            call put_cell(writer, measures%profile%y_first, is_known=points%kind > 0)
            call put_cell(writer, measures%profile%y_last, is_known=points%kind > 0)
            call put_cell(writer, minval(measures%curvature), is_known=size(measures%curvature) > 0)
            call put_cell(writer, maxval(measures%curvature), is_known=size(measures%curvature) > 0)
            call put_cell(writer, measures%wear%top, is_known=measures%wear%is_known(1))
            call put_cell(writer, measures%wear%side, is_known=measures%wear%is_known(2))
            call put_cell(writer, measures%wear%corner, is_known=measures%wear%is_known(3))
            call put_cell(writer, measures%largest_wear, is_known=measures%has_wear)
            call put_cell(writer, measures%done)
        end associate
    end subroutine put_known

    pure function kind_word(kind) result(word)
        integer, intent(in) :: kind
        character(len=:), allocatable :: word

        word = 'unknown'
        if (kind == body_wheel) word = 'wheel'
        if (kind == body_rail) word = 'rail'
    end function kind_word
end module faststrip_command_profile_measures
