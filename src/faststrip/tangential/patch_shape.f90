!> How a contact patch differs from the ellipse of its area and second moments: a few numbers that
!> are zero for an ellipse with Hertz's pressure.
!>
!> With eta = (y - yc)/b and xi = x/a of that ellipse, A and P the shares of the area and of the
!> load: moments of third to sixth order of A, of first and second order of P. All vary
!> continuously when strips without length join a patch. Those called odd change sign when left and
!> right are exchanged, those called even stay.
module faststrip_tangential_patch_shape
    use faststrip_base_kinds, only: wp
    use faststrip_normal_strips, only: contact_strips_t
    use faststrip_normal_simple_patch_ellipse, only: patch_ellipse_t
    implicit none
    private

    public :: patch_shape_t, patch_shape, n_even, n_odd

    !> Numbers of a shape that stay and that change sign when left and right are exchanged.
    !> Given: as listed with them.
    integer, parameter :: n_even = 5, n_odd = 5

    !> What a patch has beyond its ellipse, without units.
    type :: patch_shape_t
        real(wp) :: even(n_even) = 0.0_wp
            !! A eta^4 - 1/8, P eta^2 - 1/5, P xi^2 - 4/5, A xi^4 - 5/8, A eta^6 - 5/64
        real(wp) :: odd(n_odd) = 0.0_wp
            !! A eta^3, P eta, A eta xi^2, P eta xi^2 - (P eta)(P xi^2), A eta^5
        real(wp) :: width = 0.0_wp
            !! of its strips over b, the root of the mean square over the area: not of the patch but
            !! of how finely it is cut
    end type patch_shape_t

contains

    !> The shape of strips `first` to `last`, those in a neck in part.
    pure type(patch_shape_t) function patch_shape(strips, first, last, ellipse, share) result(shape)
        type(contact_strips_t), intent(in) :: strips !! checked strips
        integer, intent(in) :: first, last           !! of the patch or sub-patch
        type(patch_ellipse_t), intent(in) :: ellipse !! theirs, with a load
        real(wp), intent(in), optional :: share(first:) !! what of each strip counts, 0 to 1

        real(wp) :: area, load, width, eta, xi, part, spread, p_eta, p_xi, p_both
        integer :: i

        area = 0.0_wp
        load = 0.0_wp
        p_eta = 0.0_wp
        p_xi = 0.0_wp
        p_both = 0.0_wp
        do i = first, last
            width = (strips%y_right(i) - strips%y_left(i))/ellipse%b
            eta = (0.5_wp*(strips%y_left(i) + strips%y_right(i)) - ellipse%y)/ellipse%b
            xi = (strips%half_length(i)/ellipse%a)**2
            ! Given: mean square of a width about its middle.
            spread = width*width/12.0_wp
            part = width*strips%half_length(i)/ellipse%a
            if (present(share)) part = share(i)*part
            area = area + part
            shape%width = shape%width + part*width*width
            ! Given: moments over a width, the fourth with its own.
            shape%even(1) = shape%even(1) + part*(eta**4 + 6.0_wp*eta**2*spread &
                                                  + 1.8_wp*spread**2)
            shape%odd(1) = shape%odd(1) + part*eta*(eta**2 + 3.0_wp*spread)
            shape%even(4) = shape%even(4) + part*xi*xi
            ! Given: moments over a width
            shape%even(5) = shape%even(5) + part*(eta**6 + 15.0_wp*eta**4*spread &
                                                  + 27.0_wp*eta**2*spread**2 &
                                                  + 27.0_wp/7.0_wp*spread**3)
            ! Given: moments over a width
            shape%odd(5) = shape%odd(5) + part*eta*(eta**4 + 10.0_wp*eta**2*spread &
                                                    + 9.0_wp*spread**2)
            shape%odd(3) = shape%odd(3) + part*eta*xi
            part = part*strips%p0(i)
            load = load + part
            p_eta = p_eta + part*eta
            shape%even(2) = shape%even(2) + part*(eta**2 + spread)
            p_xi = p_xi + part*xi
            p_both = p_both + part*eta*xi
        end do
        p_eta = p_eta/load
        p_xi = p_xi/load
        shape%width = sqrt(shape%width/area)
        ! Given: an ellipse's own moments.
        shape%even(1) = shape%even(1)/area - 0.125_wp
        ! Given: an ellipse's own moments.
        shape%even(2) = shape%even(2)/load - p_eta**2 - 0.2_wp
        ! Given: an ellipse's own moments.
        shape%even(3) = p_xi - 0.8_wp
        ! Given: an ellipse's own moments.
        shape%even(4) = shape%even(4)/area - 0.625_wp
        ! Given: an ellipse's own moments.
        shape%even(5) = shape%even(5)/area - 5.0_wp/64.0_wp
        shape%odd(1) = shape%odd(1)/area
        shape%odd(5) = shape%odd(5)/area
        shape%odd(2) = p_eta
        shape%odd(3) = shape%odd(3)/area
        shape%odd(4) = p_both/load - p_eta*p_xi
    end function patch_shape
end module faststrip_tangential_patch_shape
