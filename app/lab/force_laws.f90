!> The tangential methods of the embeddable core: what the benches judge and time.
module faststrip_lab_force_laws
    use faststrip_contact_methods, only: method_t, tangential_table, tangential_none
    implicit none
    private

    public :: force_laws

    !> Their rows of the list of methods; TANG, outside the core, is what they are judged by.
    type(method_t), parameter :: force_laws(*) = pack(tangential_table, tangential_table%in_core &
        .and. tangential_table%number /= tangential_none)
end module faststrip_lab_force_laws
