!> The paper's Table 1: polynomials for the influence integral, as published, read correctly.
!>
!> `E(L) = a6 L^6 + ... + a0`, `L = log10 b`, and `10**E` approximates HALF of the integral for the
!> strip distance n whose column is headed |s - k| = 2n (erratum: printed as the integral and the
!> distance themselves). Against the exact integral the rows err by 0.5 to 2.2 % at most (row 4
!> worst) on -2 <= L <= 1, and are useless outside: -60 % at L = -3.
module faststrip_influence_polynomial
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_kinds, only: wp, log_10
    use faststrip_base_status, only: status_t, set_status, clear_status, number_text, &
                                     message_length, st_not_finite, st_out_of_range
    implicit none
    private

    public :: table_influence, published_coefficients, table_last_distance

    !> The largest strip distance n of the table.
    !> Given: the published table.
    integer, parameter :: table_last_distance = 20

    !> Coefficients as printed, `published_coefficients(k, n)`: power 6 - k of L, strip distance n
    !> (the printed column 2n).
    !> Given: the published table.
    real(wp), parameter :: published_coefficients(0:6, 0:table_last_distance) = reshape([ &
    -0.002505_wp, -0.001497_wp, 0.022573_wp, 0.009238_wp, -0.16037_wp, 0.467393_wp, 0.483852_wp, &
    -0.007560_wp, -0.026714_wp, 0.015249_wp, 0.105083_wp, -0.14821_wp, 0.079591_wp, -0.08251_wp, &
    0.003839_wp, -0.008085_wp, -0.029310_wp, 0.068803_wp, -0.04814_wp, 0.015369_wp, -0.39959_wp, &
    0.007608_wp, 0.004252_wp, -0.037180_wp, 0.037078_wp, -0.0153_wp, 0.005056_wp, -0.5794_wp, &
    0.007902_wp, 0.009316_wp, -0.035130_wp, 0.019712_wp, -0.0027_wp, 0.00233_wp, -0.7058_wp, &
    0.007030_wp, 0.010980_wp, -0.030570_wp, 0.010126_wp, 0.00236_wp, 0.001448_wp, -0.80338_wp, &
    0.005830_wp, 0.011066_wp, -0.025740_wp, 0.004737_wp, 0.004248_wp, 0.001116_wp, -0.88289_wp, &
    0.004628_wp, 0.010462_wp, -0.021300_wp, 0.001656_wp, 0.004707_wp, 0.000973_wp, -0.95_wp, &
    0.003549_wp, 0.009613_wp, -0.017440_wp, -0.000140_wp, 0.004506_wp, 0.000906_wp, -1.00807_wp, &
    0.002611_wp, 0.008678_wp, -0.014150_wp, -0.001150_wp, 0.004019_wp, 0.000859_wp, -1.05925_wp, &
    0.001806_wp, 0.007735_wp, -0.011380_wp, -0.001650_wp, 0.003431_wp, 0.000813_wp, -1.10502_wp, &
    0.001127_wp, 0.006837_wp, -0.009070_wp, -0.001860_wp, 0.002834_wp, 0.000765_wp, -1.1464_wp, &
    0.000534_wp, 0.005942_wp, -0.007140_wp, -0.001820_wp, 0.002282_wp, 0.000698_wp, -1.18418_wp, &
    0.000064_wp, 0.005204_wp, -0.005510_wp, -0.001740_wp, 0.001758_wp, 0.000651_wp, -1.21892_wp, &
    -0.000320_wp, 0.004550_wp, -0.004170_wp, -0.001640_wp, 0.001302_wp, 0.000611_wp, -1.25109_wp, &
    -0.000630_wp, 0.003985_wp, -0.003050_wp, -0.001520_wp, 0.0009_wp, 0.000577_wp, -1.28104_wp, &
    -0.000870_wp, 0.003496_wp, -0.002100_wp, -0.001390_wp, 0.000545_wp, 0.000544_wp, -1.30905_wp, &
    -0.001020_wp, 0.003193_wp, -0.001320_wp, -0.001410_wp, 0.000223_wp, 0.000551_wp, -1.33537_wp, &
    -0.001280_wp, 0.002579_wp, -0.000640_wp, -0.000970_wp, -0.00002_wp, 0.000445_wp, -1.36018_wp, &
    -0.001400_wp, 0.002248_wp, -0.000073_wp, -0.000830_wp, -0.00026_wp, 0.000409_wp, -1.38364_wp, &
    -0.001510_wp, 0.001912_wp, 0.0003340_wp, -0.000690_wp, -0.0004_wp, 0.000389_wp, -1.40591_wp], &
        [7, table_last_distance + 1])

contains

    !> i_n(b) by the published polynomial.
    pure subroutine table_influence(n, b, value, status)
        integer, intent(in) :: n              !! distance of the strips in strips, sign ignored
        real(wp), intent(in) :: b             !! half-width over half-length, in [0.01, 10]
        real(wp), intent(out) :: value        !! influence over the half-length; 0 on error
        type(status_t), intent(out) :: status !! `st_not_finite`, `st_out_of_range`

        ! Given: the published range.
        real(wp), parameter :: b_least = 0.01_wp, b_most = 10.0_wp
        real(wp) :: l, e
        integer :: k, row
        character(len=message_length) :: words

        call clear_status(status)
        value = 0.0_wp
        if (.not. ieee_is_finite(b)) then
            call set_status(status, st_not_finite, 'b = yd/xd must be a finite number, got ' // &
                            trim(number_text(b)))
            return
        end if
        if (n < -table_last_distance .or. n > table_last_distance) then
            write (words, '(ss, a, i0)') 'the table ends at strip distance 20: ', n
            call set_status(status, st_out_of_range, words)
            return
        end if
        if (b < b_least .or. b > b_most) then
            call set_status(status, st_out_of_range, 'b = yd/xd must be 0.01 to 10 for the '// &
                            'table, got ' // trim(number_text(b)))
            return
        end if
        row = abs(n)
        l = log10(b)
        e = published_coefficients(0, row)
        do k = 1, 6 ! Given: degree of the polynomial
            e = e*l + published_coefficients(k, row)
        end do
        value = 2.0_wp*exp(log_10*e)
    end subroutine table_influence
end module faststrip_influence_polynomial
