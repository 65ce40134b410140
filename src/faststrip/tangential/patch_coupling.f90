!> What the tractions of patches do to each other: they move the surfaces at the others, which
!> rolling turns into creepage. The step S11 of `faststrip_tangential_faststrip`.
!>
!> On the half-space (Cerruti; G and nu combined, r the distance)
!>
!>     u_x = 1/(pi G) int [(1 - nu)/r + nu x^2/r^3] p_x + [nu x y/r^3] p_y dA,
!>
!> u_y alike, and the slip of a point is its creepage less du/dx. A part of the contact is a few
!> lines along x with tractions linear in x. The slip that others give to a line is linear in x,
!> too: a mean, and a tilt, its slope times the half-length a. A line's force follows from the slip
!> at a point ahead of the middle: by reciprocity slip counts with the traction of rolling the other
!> way, which in strip theory is proportional to sqrt((a + x)/(a - x)), with its centre at a/2; as
!> far behind the middle is the centre of the traction itself. Where the rear slides it lies farther
!> ahead. The moment of a tilt is another than that of the creepage in its place.
module faststrip_tangential_patch_coupling
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_limits, only: nothing, half_digits
    use faststrip_base_creepage, only: creepage_t
    use faststrip_base_material, only: material_t, combined_shear_modulus, combined_poisson_ratio
    use faststrip_normal_strips, only: contact_strips_t, strip_load, last_of_patch
    implicit none
    private

    public :: coupling_t, tractions_t, find_coupling, induced_motion, induced_moment, &
              sum_tractions, approach
    public :: most_parts, coupling_passes

    !> Most parts of a contact; with more patches, neighbours are one part, and nothing is coupled
    !> within it.
    !> Tuned [parts]. Origin: chosen for the stack; odd, so that left and right count alike.
    integer, parameter :: most_parts = 9
    !> Times that forces of several patches are found before those that count.
    !> Tuned [1]. Origin: measured: one less errs by half as much again, one more changes next to
    !> nothing.
    integer, parameter :: coupling_passes = 2
    ! Tuned [lines]: Most lines of a part. Origin: measured on 182 contacts of several patches: as
    ! good as all strips; odd as the parts.
    integer, parameter :: most_lines = 7
    ! Given: three points of Gauss's rule from -1 to 1, weights of sum 1.
    real(wp), parameter :: node = sqrt(0.6_wp), weights(3) = [5.0_wp, 8.0_wp, 5.0_wp]/18.0_wp
    ! Tuned [1]: Where slip counts ahead of the middle, and the centre of a traction behind it, over
    ! the half-length, without slip; as long is the arm that the moment of a tilt lacks. Origin: 336
    ! contacts of several patches by TANG, five families of `force-data`: 0.5, of strip theory,
    ! gives weak forces a third more than they lose; of the arm it is better with spin, 0.3 without.
    real(wp), parameter :: centre = 0.35_wp
    ! Tuned [1]: How much farther ahead slip counts where all slides. Origin: the same contacts: 0.3
    ! and 0.5 are as good.
    real(wp), parameter :: farther = 0.4_wp
    ! Tuned [1]: Largest moment that a tilt lacks, over mu N a. Origin: the same contacts: without
    ! it some are far off.
    real(wp), parameter :: most_moment = 0.15_wp

    !> Forces of a part and what more counts of its tractions.
    type :: tractions_t
        real(wp) :: fx = 0.0_wp, fy = 0.0_wp !! N
        real(wp) :: ax = 0.0_wp, ay = 0.0_wp
            !! moments int x p dA of both, each over the half-length of its line, N
        real(wp) :: bound = 0.0_wp           !! mu N, N
        real(wp) :: a = 0.0_wp               !! half-length of the longest ellipse, mm
    end type tractions_t

    !> How the parts of a contact act on each other.
    type :: coupling_t
        ! Without a first value, for that of all would be copied.
        integer :: n                     !! parts; one or none: nothing is coupled
        integer :: patches(most_parts)   !! in each part
        real(wp), dimension(4, most_parts, most_parts) :: slip_x, slip_y
            !! mean slips of the third by each of the tractions of the second, 1/N
        real(wp), dimension(4, most_parts, most_parts) :: tilt_x, tilt_y !! tilts of both, 1/N
    end type coupling_t

    !> Strips that count together.
    type :: line_t
        real(wp) :: y = 0.0_wp      ! centre of load, mm
        real(wp) :: a = 0.0_wp      ! half-length, mm
        real(wp) :: share = 0.0_wp  ! of the part's load, and of its force
    end type line_t

    !> The lines of a part.
    type :: part_t
        integer :: n = 0
        type(line_t) :: lines(most_lines)
    end type part_t

contains

    !> How the patches of a contact act on each other.
    pure subroutine find_coupling(strips, material, coupling)
        type(contact_strips_t), intent(in) :: strips !! a normal solution, checked
        type(material_t), intent(in) :: material     !! moduli in MPa
        type(coupling_t), intent(inout) :: coupling  !! of its patches

        coupling%n = 0
        if (strips%patch(1) /= strips%patch(strips%n)) call couple_parts(strips, material, coupling)
    end subroutine find_coupling

    pure subroutine couple_parts(strips, material, coupling)
        type(contact_strips_t), intent(in) :: strips
        type(material_t), intent(in) :: material
        type(coupling_t), intent(inout) :: coupling

        type(part_t) :: parts(most_parts)
        real(wp) :: g, nu
        integer :: patches, last, first, k, j

        patches = 0
        last = 0
        do while (last < strips%n)
            last = last_of_patch(strips, last + 1)
            patches = patches + 1
        end do
        coupling%n = min(patches, most_parts)
        coupling%patches = 0
        do k = 1, patches
            j = share_out(k, patches, coupling%n)
            coupling%patches(j) = coupling%patches(j) + 1
        end do
        last = 0
        do k = 1, coupling%n
            first = last + 1
            do j = 1, coupling%patches(k)
                last = last_of_patch(strips, last + 1)
            end do
            call find_lines(strips, first, last, parts(k))
        end do
        g = combined_shear_modulus(material)
        nu = combined_poisson_ratio(material)
        do k = 1, coupling%n
            do j = 1, coupling%n
                if (j /= k) call couple(parts(j), parts(k), g, nu, coupling%slip_x(:, j, k), &
                                        coupling%slip_y(:, j, k), coupling%tilt_x(:, j, k), &
                                        coupling%tilt_y(:, j, k))
            end do
        end do
    end subroutine couple_parts

    !> In which of so many groups the i-th of some is; with an odd number of groups the same from
    !> both ends.
    elemental integer function share_out(i, n, groups)
        integer, intent(in) :: i, n, groups

        share_out = 1 + ((2*i - 1)*groups)/(2*n)
    end function share_out

    !> Strips `first` to `last` as lines.
    pure subroutine find_lines(strips, first, last, part)
        type(contact_strips_t), intent(in) :: strips
        integer, intent(in) :: first, last
        type(part_t), intent(out) :: part

        real(wp) :: load
        integer :: i, k

        part%n = min(last - first + 1, most_lines)
        do i = first, last
            k = share_out(i - first + 1, last - first + 1, part%n)
            associate (line => part%lines(k), width => strips%y_right(i) - strips%y_left(i))
                load = strip_load(strips%p0(i), strips%half_length(i), width)
                line%share = line%share + load
                line%y = line%y + 0.5_wp*load*(strips%y_left(i) + strips%y_right(i))
                line%a = line%a + load*strips%half_length(i)
            end associate
        end do
        load = sum(part%lines(:part%n)%share)
        if (load <= nothing) then
            part%n = 0
            return
        end if
        do k = 1, part%n
            associate (line => part%lines(k))
                if (line%share <= nothing) then
                    line = line_t()
                    cycle
                end if
                line%y = line%y/line%share
                line%a = line%a/line%share
                line%share = line%share/load
            end associate
        end do
    end subroutine find_lines

    !> What the tractions of one part do to another.
    pure subroutine couple(from, to, g, nu, slip_x, slip_y, tilt_x, tilt_y)
        type(part_t), intent(in) :: from, to
        real(wp), intent(in) :: g, nu
        real(wp), intent(out) :: slip_x(4), slip_y(4), tilt_x(4), tilt_y(4)

        real(wp), dimension(4) :: ux, uy, front_x, front_y, rear_x, rear_y, mean_x, mean_y
        real(wp) :: weight, total, factor
        integer :: i, j, k

        slip_x = 0.0_wp
        slip_y = 0.0_wp
        tilt_x = 0.0_wp
        tilt_y = 0.0_wp
        total = 0.0_wp
        do j = 1, to%n
            associate (a => to%lines(j)%a)
                if (a <= 0.0_wp) cycle
                front_x = 0.0_wp
                front_y = 0.0_wp
                rear_x = 0.0_wp
                rear_y = 0.0_wp
                mean_x = 0.0_wp
                mean_y = 0.0_wp
                do i = 1, from%n
                    associate (line => from%lines(i), d => to%lines(j)%y - from%lines(i)%y)
                        ! Lines upon each other are none of two patches.
                        if (line%a <= 0.0_wp .or. abs(d) <= half_digits*(line%a + a)) cycle
                        call displacements(line%a, a, d, nu, ux, uy)
                        front_x = front_x + line%share*ux
                        front_y = front_y + line%share*uy
                        call displacements(line%a, -a, d, nu, ux, uy)
                        rear_x = rear_x + line%share*ux
                        rear_y = rear_y + line%share*uy
                        do k = 1, size(weights)
                            call displacements(line%a, (k - 2)*node*a, d, nu, ux, uy)
                            mean_x = mean_x + line%share*weights(k)*ux
                            mean_y = mean_y + line%share*weights(k)*uy
                        end do
                    end associate
                end do
                ! The mean of du/dx, and its slope times a.
                weight = to%lines(j)%share
                factor = weight/(2.0_wp*a)
                total = total + weight
                slip_x = slip_x - factor*(front_x - rear_x)
                slip_y = slip_y - factor*(front_y - rear_y)
                tilt_x = tilt_x - 3.0_wp*factor*(front_x + rear_x - 2.0_wp*mean_x)
                tilt_y = tilt_y - 3.0_wp*factor*(front_y + rear_y - 2.0_wp*mean_y)
            end associate
        end do
        if (total <= 0.0_wp) return
        factor = 1.0_wp/(total*pi*g)
        slip_x = factor*slip_x
        slip_y = factor*slip_y
        tilt_x = factor*tilt_x
        tilt_y = factor*tilt_y
    end subroutine couple

    !> Displacements times pi G at x, y by a line of half-length a along y = 0 whose tractions have
    !> the force 1 in x, or in y, or the moment `int x p dx = a` of one of both and no force.
    pure subroutine displacements(a, x, y, nu, ux, uy)
        real(wp), intent(in) :: a, x, y, nu !! mm; a above 0, y not 0
        real(wp), intent(out) :: ux(4), uy(4)

        real(wp) :: behind, ahead, r_behind, r_ahead, l, turn, inverse, part, along, cross, across

        behind = x - a
        ahead = x + a
        r_behind = sqrt(behind*behind + y*y)
        r_ahead = sqrt(ahead*ahead + y*y)
        ! Differences over the line of asinh(X/|y|), X/r, 1/r and r, X = x - x'.
        l = logarithm(ahead, r_ahead, behind, r_behind)
        turn = ahead/r_ahead - behind/r_behind
        inverse = 1.0_wp/r_ahead - 1.0_wp/r_behind
        part = r_ahead - r_behind
        along = l - nu*turn
        cross = -nu*y*inverse
        across = (1.0_wp - nu)*l + nu*turn
        ux(1) = along
        ux(2) = cross
        uy(1) = cross
        uy(2) = across
        ! The same times 3 x'/a, x' = x - X.
        ux(3) = 3.0_wp/a*(x*along - (part + nu*y*y*inverse))
        ux(4) = 3.0_wp/a*(x*cross - nu*y*(l - turn))
        uy(3) = ux(4)
        uy(4) = 3.0_wp/a*(x*across - ((1.0_wp - nu)*part - nu*y*y*inverse))
        ux = ux/(2.0_wp*a)
        uy = uy/(2.0_wp*a)
    end subroutine displacements

    !> asinh(ahead/|y|) - asinh(behind/|y|) without cancellation.
    pure real(wp) function logarithm(ahead, r_ahead, behind, r_behind) result(l)
        real(wp), intent(in) :: ahead, r_ahead, behind, r_behind

        if (ahead + behind < 0.0_wp) then
            l = log((r_behind - behind)/(r_ahead - ahead))
        else
            l = log((r_ahead + ahead)/(r_behind + behind))
        end if
    end function logarithm

    !> What the other parts do to one.
    pure subroutine induced_motion(coupling, tractions, part, creepage, induced, tilt)
        type(coupling_t), intent(in) :: coupling      !! of the contact
        type(tractions_t), intent(in) :: tractions(:) !! of its parts
        integer, intent(in) :: part                   !! which
        type(creepage_t), intent(in) :: creepage      !! without the others
        type(creepage_t), intent(out) :: induced      !! with them
        real(wp), intent(out) :: tilt                 !! of the lateral slip

        real(wp) :: t(4), ahead
        integer :: k

        induced = creepage
        tilt = 0.0_wp
        ahead = ahead_of(tractions(part))
        do k = 1, coupling%n
            if (k == part) cycle
            associate (one => tractions(k), slip_x => coupling%slip_x(:, k, part), &
                       slip_y => coupling%slip_y(:, k, part), &
                       tilt_x => coupling%tilt_x(:, k, part), &
                       tilt_y => coupling%tilt_y(:, k, part))
                t = [one%fx, one%fy, one%ax, one%ay]
                induced%cksi = induced%cksi + dot_product(slip_x + ahead*tilt_x, t)
                induced%ceta = induced%ceta + dot_product(slip_y + ahead*tilt_y, t)
                tilt = tilt + dot_product(tilt_y, t)
            end associate
        end do
    end subroutine induced_motion

    !> What a tilt gives to the moment of a patch beyond the creepage in its place, N mm.
    pure real(wp) function induced_moment(tractions, tilt, stiffness) result(moment)
        type(tractions_t), intent(in) :: tractions !! of the patch, before
        real(wp), intent(in) :: tilt               !! of the lateral slip
        real(wp), intent(in) :: stiffness          !! linear lateral force by a creepage of one, N

        real(wp) :: most

        moment = 0.0_wp
        most = most_moment*tractions%a*tractions%bound
        if (most <= 0.0_wp) return
        moment = -centre*tractions%a*stiffness*ahead_of(tractions)*sticking(tractions)*tilt
        moment = moment/sqrt(1.0_wp + (moment/most)**2)
    end function induced_moment

    !> Where slip counts, ahead of the middle over the half-length.
    pure real(wp) function ahead_of(tractions)
        type(tractions_t), intent(in) :: tractions

        ahead_of = centre + farther*(1.0_wp - sticking(tractions))
    end function ahead_of

    !> What of mu N is left.
    pure real(wp) function sticking(tractions)
        type(tractions_t), intent(in) :: tractions

        sticking = 1.0_wp
        if (tractions%bound > 0.0_wp) &
            sticking = max(1.0_wp - hypot(tractions%fx, tractions%fy)/tractions%bound, 0.0_wp)
    end function sticking

    !> Add the tractions of a patch to those of its part.
    pure subroutine sum_tractions(fx, fy, bound, a, linear, tractions)
        real(wp), intent(in) :: fx, fy    !! forces of the patch, N
        real(wp), intent(in) :: bound     !! mu N, N
        real(wp), intent(in) :: a         !! half-length of its ellipse, mm
        real(wp), intent(in) :: linear(3) !! linear forces over mu N, with the signs of creepages
        type(tractions_t), intent(inout) :: tractions !! of the part

        type(tractions_t) :: patch

        if (bound <= 0.0_wp) return
        patch%fx = fx
        patch%fy = fy
        patch%bound = bound
        ! Where all slides, and by spin, the centre is in the middle.
        associate (behind => centre*sticking(patch))
            tractions%ax = tractions%ax - behind*fx
            tractions%ay = tractions%ay + behind*bound*linear(2)/sqrt(1.0_wp + sum(linear**2))
        end associate
        tractions%fx = tractions%fx + fx
        tractions%fy = tractions%fy + fy
        tractions%bound = tractions%bound + bound
        tractions%a = max(tractions%a, a)
    end subroutine sum_tractions

    !> Go half way to tractions that were found with others, if there are others: so patches that
    !> act much on each other converge.
    pure elemental subroutine approach(found, tractions)
        type(tractions_t), intent(in) :: found        !! by those others
        type(tractions_t), intent(inout) :: tractions !! the others; no bound: none

        type(tractions_t) :: before

        before = tractions
        tractions = found
        if (before%bound <= 0.0_wp) return
        tractions%fx = 0.5_wp*(before%fx + found%fx)
        tractions%fy = 0.5_wp*(before%fy + found%fy)
        tractions%ax = 0.5_wp*(before%ax + found%ax)
        tractions%ay = 0.5_wp*(before%ay + found%ay)
    end subroutine approach
end module faststrip_tangential_patch_coupling
