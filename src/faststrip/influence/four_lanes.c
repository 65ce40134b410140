/* Sums of the influence columns with four field points side by side, by AVX2 and FMA.

   Fortran has no way to compile a loop for a processor that is not every processor's; C has.
   faststrip_influence_four_lanes says what goes in and out. Without AVX2 and FMA, or where they
   are not known, influence_has_four_lanes is 0, and the loops in Fortran serve.

   Each point stays in its lane: what comes out does not depend on the points beside it. Arrays
   are read and written up to the next multiple of four. Nothing here raises a floating-point
   exception for arguments that the Fortran side lets through. */

#if defined(__x86_64__) && defined(__GNUC__)

/* fpm passes no flags to C but those of a profile. */
#ifndef __clang__
#pragma GCC optimize ("O3", "fp-contract=off")
#endif

#include <immintrin.h>

#define LANES 4
#define AVX2 __attribute__((target("avx2,fma")))
#define INSIDE AVX2 static inline __attribute__((always_inline))

typedef __m256d lanes;

int influence_has_four_lanes(void)
{
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
}

INSIDE lanes all(double x) { return _mm256_set1_pd(x); }
INSIDE lanes at(const double *x) { return _mm256_loadu_pd(x); }
INSIDE void put(double *place, lanes x) { _mm256_storeu_pd(place, x); }
/* a b + c, a b - c and c - a b, rounded once */
INSIDE lanes add(lanes a, lanes b, lanes c) { return _mm256_fmadd_pd(a, b, c); }
INSIDE lanes less(lanes a, lanes b, lanes c) { return _mm256_fmsub_pd(a, b, c); }
INSIDE lanes from(lanes c, lanes a, lanes b) { return _mm256_fnmadd_pd(a, b, c); }

/* ln x of normal numbers x > 0, to 1 unit in the last place: x = 2^k (1 + f) with 1 + f between
   sqrt(1/2) and sqrt(2), s = f/(2 + f), ln(1 + f) = f - f^2/2 + s (f^2/2 + R(s^2)), R as in
   Sun's fdlibm. */
INSIDE lanes ln(lanes x)
{
    const __m256i bits = _mm256_castpd_si256(x);
    /* Bits of 1 less those of sqrt(1/2), cut: adding them carries into the exponent. */
    const __m256i shifted = _mm256_add_epi64(bits, _mm256_set1_epi64x(0x00095f6400000000LL));
    const __m256i exponent = _mm256_srli_epi64(shifted, 52);
    const __m256i fraction = _mm256_and_si256(shifted, _mm256_set1_epi64x(0x000fffffffffffffLL));
    const __m256i whole = _mm256_or_si256(exponent, _mm256_set1_epi64x(0x4330000000000000LL));
    const lanes k = _mm256_castsi256_pd(whole) - all(0x1p52 + 1023.0);
    const lanes f = _mm256_castsi256_pd(_mm256_add_epi64(
        fraction, _mm256_set1_epi64x(0x3fe6a09c00000000LL))) - all(1.0);
    const lanes s = f / (all(2.0) + f);
    const lanes z = s * s;
    const lanes half = all(0.5) * f * f;
    lanes r = all(1.479819860511658591e-01);
    r = add(r, z, all(1.531383769920937332e-01));
    r = add(r, z, all(1.818357216161805012e-01));
    r = add(r, z, all(2.222219843214978396e-01));
    r = add(r, z, all(2.857142874366239149e-01));
    r = add(r, z, all(3.999999999940941908e-01));
    r = add(r, z, all(6.666666666666735130e-01));
    r = r * z;
    /* ln 2 in two parts; the first has so few bits that its product with k is exact. */
    return less(k, all(6.93147180369123816490e-01),
                (half - add(s, half + r, k * all(1.90821492927058770002e-10))) - f);
}

/* As in faststrip_numerics_logarithm. */
INSIDE lanes ln_1p(lanes d)
{
    const lanes one_d = all(1.0) + d;

    return ln(one_d) + (d - (one_d - all(1.0))) / one_d;
}

/* Centre lines, as in faststrip_influence_center_column. */

AVX2 void influence_near_center(int n, double least, const double *width, const double *near,
                                const double *far, const double *a, const double *b,
                                double *value, double *slope)
{
    for (int i = 0; i < n; i += LANES) {
        const lanes w = at(width + i), cl = at(near + i), cr = at(far + i);
        const lanes xl = cl * cl, xr = cr * cr;
        lanes bl = add(all(b[20]), xl, all(b[19])), br = add(all(b[20]), xr, all(b[19]));
        lanes db = all(b[20]), dbl = db, dbr = db;
        lanes al = all(a[19]), ar = al, da = all(0.0), dal = da, dar = da;

        for (int k = 18; k >= 0; k--) {
            const lanes ak = all(a[k]), bk = all(b[k]);
            da = add(da, xr, al);
            dal = add(dal, xl, al);
            dar = add(dar, xr, ar);
            al = add(al, xl, ak);
            ar = add(ar, xr, ak);
            db = add(db, xr, bl);
            dbl = add(dbl, xl, bl);
            dbr = add(dbr, xr, br);
            bl = add(bl, xl, bk);
            br = add(br, xr, bk);
        }
        const lanes ratio = ln_1p(w / _mm256_max_pd(cl, all(least) * cr));
        const lanes log_r = ln(cr);
        const lanes d = cr * (cr + cl);
        put(value + i, less(w, from(add(d, da, al), log_r, add(d, db, bl)), cl * ratio * bl));
        const lanes right = cr * less(all(2.0) * xr, from(dar, log_r, dbr), br);
        const lanes left = cl * less(all(2.0) * xl, from(dal, log_r - ratio, dbl), bl);
        put(slope + i, left - right);
    }
}

AVX2 void influence_near_center_value(int n, double least, const double *width,
                                      const double *near, const double *far, const double *a,
                                      const double *b, double *value)
{
    for (int i = 0; i < n; i += LANES) {
        const lanes w = at(width + i), cl = at(near + i), cr = at(far + i);
        const lanes xl = cl * cl, xr = cr * cr;
        lanes bl = add(all(b[20]), xl, all(b[19])), db = all(b[20]);
        lanes al = all(a[19]), da = all(0.0);

        for (int k = 18; k >= 0; k--) {
            da = add(da, xr, al);
            al = add(al, xl, all(a[k]));
            db = add(db, xr, bl);
            bl = add(bl, xl, all(b[k]));
        }
        const lanes ratio = ln_1p(w / _mm256_max_pd(cl, all(least) * cr));
        const lanes d = cr * (cr + cl);
        put(value + i, less(w, from(add(d, da, al), ln(cr), add(d, db, bl)), cl * ratio * bl));
    }
}

AVX2 void influence_far_center(int n, double half_pi, double centre, const double *width,
                               const double *near, const double *far, const double *r,
                               double *value, double *slope)
{
    for (int i = 0; i < n; i += LANES) {
        const lanes cl = at(near + i);
        const lanes ul = all(1.0) / cl, ur = all(1.0) / at(far + i);
        const lanes wl = ul * ul, wr = ur * ur;
        const lanes xl = less(ul, ul, all(centre)), xr = less(ur, ur, all(centre));
        lanes rl = all(r[26]), rr = rl, dr = all(0.0), drl = dr, drr = dr;

        for (int k = 25; k >= 0; k--) {
            const lanes rk = all(r[k]);
            dr = add(dr, xr, rl);
            drl = add(drl, xl, rl);
            drr = add(drr, xr, rr);
            rl = add(rl, xl, rk);
            rr = add(rr, xr, rk);
        }
        const lanes d = at(width + i) * ul;
        const lanes part = d * add(cl, ur, all(1.0)) * ul * ur;
        const lanes sum = less(all(half_pi), ln_1p(d), part * add(wr, dr, rl));
        put(value + i, sum);
        put(slope + i, add(all(2.0), less(wr, add(wr, drr, rr), wl * add(wl, drl, rl)), sum));
    }
}

AVX2 void influence_far_center_value(int n, double half_pi, double centre, const double *width,
                                     const double *near, const double *far, const double *r,
                                     double *value)
{
    for (int i = 0; i < n; i += LANES) {
        const lanes cl = at(near + i);
        const lanes ul = all(1.0) / cl, ur = all(1.0) / at(far + i), wr = ur * ur;
        const lanes xl = less(ul, ul, all(centre)), xr = less(ur, ur, all(centre));
        lanes rl = all(r[26]), dr = all(0.0);

        for (int k = 25; k >= 0; k--) {
            dr = add(dr, xr, rl);
            rl = add(rl, xl, all(r[k]));
        }
        const lanes d = at(width + i) * ul;
        const lanes part = d * add(cl, ur, all(1.0)) * ul * ur;
        put(value + i, less(all(half_pi), ln_1p(d), part * add(wr, dr, rl)));
    }
}

/* Off the centre line, as far_sums and near_sums in faststrip_influence_angle_sums: four nodes of
   one field point side by side. */

/* Which lanes hold one of the `left` nodes that are still to do. */
INSIDE lanes among(int left)
{
    return _mm256_castsi256_pd(_mm256_cmpgt_epi64(_mm256_set1_epi64x(left),
                                                  _mm256_setr_epi64x(0, 1, 2, 3)));
}

/* c[0] + c[1] y + ... + c[last] y^last; last is 4, 8, 12, 15 or 16. */
INSIDE lanes powers(int last, const double *c, lanes y)
{
    const lanes y2 = y * y, y4 = y2 * y2;
    lanes sum = all(c[last == 15 ? 12 : last]);

    if (last == 15)
        sum = add(y2, add(y, all(c[15]), all(c[14])), add(y, all(c[13]), sum));
    for (int k = (last == 15 ? 12 : last) - 4; k >= 0; k -= 4)
        sum = add(y4, sum, add(y2, add(y, all(c[k + 3]), all(c[k + 2])),
                               add(y, all(c[k + 1]), all(c[k]))));
    return sum;
}

INSIDE double total(lanes x)
{
    const __m128d two = _mm_add_pd(_mm256_castpd256_pd128(x), _mm256_extractf128_pd(x, 1));

    return _mm_cvtsd_f64(_mm_add_sd(two, _mm_unpackhi_pd(two, two)));
}

/* As many as there are: 0 for those of a rule's last nodes that are not there. */
INSIDE lanes some(const double *x, int left, lanes on)
{
    return left >= LANES ? at(x) : _mm256_maskload_pd(x, _mm256_castpd_si256(on));
}

INSIDE void far_rule(int last, int n, const double *cosine, double place, double left,
                     double right, const double *c, double *s)
{
    const lanes x = all(place), cl2 = all(left * left), cr2 = all(right * right);
    const lanes middle = all(0.25 * (left + right) * (left + right)), width = all(right - left);
    lanes s0 = all(0.0), s1 = s0, s2 = s0;

    for (int j = 0; j < n; j += LANES) {
        const lanes on = among(n - j), u = some(cosine + j, n - j, on), delta = u - x;
        lanes r, y;

        if (last == 15) {
            r = all(1.0) / (_mm256_sqrt_pd(add(delta, delta, cl2))
                            + _mm256_sqrt_pd(add(delta, delta, cr2)));
            y = width * r;
            y = y * y;
        } else {
            r = all(1.0) / _mm256_sqrt_pd(add(delta, delta, middle));
            y = middle * (r * r);
        }
        const lanes kernel = _mm256_and_pd(r * powers(last, c, y), on);
        s0 = s0 + kernel;
        s1 = add(u, kernel, s1);
        s2 = add(u * u, kernel, s2);
    }
    s[0] = total(s0 - s2);
    s[1] = total(s1);
    s[2] = total(s2);
}

INSIDE void near_rule(int last, int n, const double *p, const double *q, const double *dp,
                      const double *dq, double place, double left, double right, const double *c,
                      double *s)
{
    const lanes x = all(place), cl2 = all(left * left), cr2 = all(right * right);
    const lanes middle = all(0.25 * (left + right) * (left + right)), width = all(right - left);
    lanes s0 = all(0.0), s1 = s0, s2 = s0;

    for (int j = 0; j < n; j += LANES) {
        const lanes on = among(n - j);
        const lanes rest = from(some(q + j, n - j, on), x, some(p + j, n - j, on));
        const lanes u = all(1.0) - rest, delta = (all(1.0) - x) - rest;
        const lanes root2 = _mm256_blendv_pd(all(1.0), rest * (all(2.0) - rest), on);
        lanes r, y;

        if (last == 15) {
            const lanes root = _mm256_sqrt_pd(root2);
            r = all(1.0) / (root * (_mm256_sqrt_pd(add(delta, delta, cl2))
                                    + _mm256_sqrt_pd(add(delta, delta, cr2))));
            y = width * root * r;
            y = y * y;
        } else {
            r = all(1.0) / _mm256_sqrt_pd(root2 * add(delta, delta, middle));
            y = middle * root2 * (r * r);
        }
        /* The weight of a node that is not there is 0. */
        const lanes weight = from(some(dq + j, n - j, on), x, some(dp + j, n - j, on));
        const lanes kernel = weight * r * powers(last, c, y);
        s0 = add(root2, kernel, s0);
        s1 = add(u, kernel, s1);
        s2 = add(u * u, kernel, s2);
    }
    s[0] = total(s0);
    s[1] = total(s1);
    s[2] = total(s2);
}

AVX2 void influence_far_rule(int last, int n, const double *cosine, double x, double cl,
                             double cr, const double *c, double *s)
{
    switch (last) {
    case 4: far_rule(4, n, cosine, x, cl, cr, c, s); break;
    case 8: far_rule(8, n, cosine, x, cl, cr, c, s); break;
    case 12: far_rule(12, n, cosine, x, cl, cr, c, s); break;
    case 15: far_rule(15, n, cosine, x, cl, cr, c, s); break;
    default: far_rule(16, n, cosine, x, cl, cr, c, s);
    }
}

AVX2 void influence_near_rule(int last, int n, const double *p, const double *q, const double *dp,
                              const double *dq, double x, double cl, double cr, const double *c,
                              double *s)
{
    switch (last) {
    case 4: near_rule(4, n, p, q, dp, dq, x, cl, cr, c, s); break;
    case 8: near_rule(8, n, p, q, dp, dq, x, cl, cr, c, s); break;
    case 12: near_rule(12, n, p, q, dp, dq, x, cl, cr, c, s); break;
    case 15: near_rule(15, n, p, q, dp, dq, x, cl, cr, c, s); break;
    default: near_rule(16, n, p, q, dp, dq, x, cl, cr, c, s);
    }
}

#else

int influence_has_four_lanes(void)
{
    return 0;
}

/* They are named by the Fortran side, and called by none. */
void influence_near_center(void) {}
void influence_near_center_value(void) {}
void influence_far_center(void) {}
void influence_far_center_value(void) {}
void influence_far_rule(void) {}
void influence_near_rule(void) {}

#endif
