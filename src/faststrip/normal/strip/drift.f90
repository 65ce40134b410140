!> What carried influence coefficients missed in the last step, and so will miss in the next one.
!>
!> A step of a history is solved by the numbers of the step before, which are evaluated anew where
!> that leads, and the solution goes on from there. What the second part adds is of second order in
!> the change, and hardly another from one step to the next that goes the same way, or back. So the
!> numbers are evaluated where the solution will be. A wrong guess costs an evaluation, no accuracy:
!> numbers may be evaluated anywhere near.
module faststrip_normal_strip_drift
    use faststrip_base_kinds, only: wp
    use faststrip_normal_strip_patches, only: patches_t, max_patches
    implicit none
    private

    public :: drift_t, reserve_drift, lead, learn

    ! Tuned [1]: of a change, what may be unlike the last one, and how many times that it may be.
    ! Origin: chosen: what is missed goes with the square.
    real(wp), parameter :: most_unlike = 0.5_wp, most_times = 3.0_wp
    ! Tuned [1]: largest logarithm of a length that a guess adds. Origin: safeguard.
    real(wp), parameter :: most_added = 0.1_wp

    !> One step. Owned by the caller.
    type :: drift_t
        logical :: known = .false.  !! was there a step of these patches?
        integer :: n = 0            !! strips
        real(wp), allocatable :: change(:)      !! of lengths, see `length_changes`
        real(wp), allocatable :: half_length(:) !! to which the old numbers led, mm
        real(wp), allocatable :: missed(:)      !! logarithms of lengths beyond these
        real(wp), dimension(max_patches) :: y_from, y_to !! ends to which the old numbers led, mm
        real(wp), dimension(max_patches) :: missed_from, missed_to !! beyond these, over the width
    end type drift_t

contains

    !> Allocate for up to `capacity` strips; the only allocation. Where there is room, it is kept.
    subroutine reserve_drift(drift, capacity)
        type(drift_t), intent(inout) :: drift !! sized
        integer, intent(in) :: capacity       !! strips, >= 1

        if (allocated(drift%change)) then
            if (size(drift%change) >= capacity) return
            drift%known = .false.
            deallocate (drift%change, drift%half_length, drift%missed)
        end if
        allocate (drift%change(capacity), drift%half_length(capacity), drift%missed(capacity), &
                  source=0.0_wp)
    end subroutine reserve_drift

    !> Lead lengths and ends from where the old numbers have led to where the new ones will, if the
    !> last step was like this one. Where they were is kept for `learn`.
    pure subroutine lead(drift, n, change, half_length, patches)
        type(drift_t), intent(inout) :: drift          !! of the last step; of this one
        integer, intent(in) :: n                       !! strips
        real(wp), intent(in) :: change(:)              !! of their lengths in this step, (n)
        real(wp), intent(inout) :: half_length(:)      !! (n), mm
        type(patches_t), intent(inout) :: patches      !! their ends move

        real(wp) :: times, width
        integer :: p

        times = 0.0_wp
        if (drift%known .and. drift%n == n) then
            associate (last => drift%change(:n))
                times = dot_product(last, change(:n))/max(dot_product(last, last), tiny(1.0_wp))
                if (abs(times) > most_times .or. &
                    norm2(change(:n) - times*last) > most_unlike*norm2(change(:n))) times = 0.0_wp
            end associate
        end if
        if (times**2*maxval(abs(drift%missed(:n))) > most_added) times = 0.0_wp
        drift%known = .false.
        drift%n = n
        drift%change(:n) = change(:n)
        drift%half_length(:n) = half_length(:n)
        half_length(:n) = half_length(:n)*exp(times**2*drift%missed(:n))
        do p = 1, patches%n
            associate (patch => patches%at(p))
                drift%y_from(p) = patch%y_from
                drift%y_to(p) = patch%y_to
                width = patch%y_to - patch%y_from
                if (.not. times**2 > 0.0_wp) cycle
                patch%y_from = patch%y_from + times**2*width*drift%missed_from(p)
                patch%y_to = patch%y_to + times**2*width*drift%missed_to(p)
            end associate
        end do
    end subroutine lead

    !> Learn from the solution what was missed where `lead` began.
    pure subroutine learn(drift, half_length, patches)
        type(drift_t), intent(inout) :: drift     !! as `lead` left it
        real(wp), intent(in) :: half_length(:)    !! of the solution, mm
        type(patches_t), intent(in) :: patches    !! and its ends

        real(wp) :: width
        integer :: p, n

        n = drift%n
        drift%known = .true.
        drift%missed(:n) = log(half_length(:n)/drift%half_length(:n))
        do p = 1, patches%n
            width = drift%y_to(p) - drift%y_from(p)
            drift%missed_from(p) = (patches%at(p)%y_from - drift%y_from(p))/width
            drift%missed_to(p) = (patches%at(p)%y_to - drift%y_to(p))/width
        end do
    end subroutine learn
end module faststrip_normal_strip_drift
