!> Takes the place of src/faststrip/base/kinds.f90 to build the kernels in single precision.
module faststrip_base_kinds
    use, intrinsic :: iso_fortran_env, only: real32
    implicit none
    private

    public :: wp, pi

    !> Working precision: IEEE binary32.
    integer, parameter :: wp = real32

    !> Ratio of a circle's circumference to its diameter.
    real(wp), parameter :: pi = 3.141592653589793238462643383279502884_wp
end module faststrip_base_kinds
