/* Columns of influence coefficients with numbers side by side: four by AVX2 and FMA where the
   processor has them, two by what any processor has.

   Fortran has no way to compile a loop for a processor that is not every processor's; C has: this
   file includes itself once for each number of lanes. faststrip_influence_four_lanes says what
   goes in and out. Where GCC's vectors are not known influence_lanes is 0, and the scalar
   procedures in Fortran serve.

   What comes out for a point does not depend on the points beside it. Nothing here raises a
   floating-point exception for arguments that the Fortran side lets through. */

#ifndef LANES

#if defined(__GNUC__) && !defined(FASTSTRIP_NO_LANES)

/* fpm passes no flags to C but those of a profile. */
#ifndef __clang__
#pragma GCC optimize ("O3", "fp-contract=off")
#endif

#include <math.h>
#include <stdint.h>
#ifdef __x86_64__
#include <immintrin.h>
#endif

/* A strip, its field points and how many numbers stand side by side. */
struct column {
    int by, n;
    double largest, length, left, right;
};

/* Rules of an accuracy, and last powers of G and of the own tip: as the Fortran side has them. */
#define RULES 9
#define SMALL 20
#define LARGE 26
#define OWN 19

#define LANES 2
#define TARGET
#define NAME(x) x##_by_two
#include "four_lanes.c"

#ifdef __x86_64__
#undef LANES
#undef TARGET
#undef NAME
#define LANES 4
#define TARGET __attribute__((target("avx2,fma")))
#define NAME(x) x##_by_four
#include "four_lanes.c"
#endif

int influence_lanes(void)
{
#ifdef __x86_64__
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
        return 4;
#endif
    return 2;
}

void influence_center(const struct column *of, const double *y, const double *small,
                      const double *large, const double *middle, double *value, double *slope,
                      int *found)
{
#ifdef __x86_64__
    if (of->by == 4) {
        *found = center_by_four(of, y, small, large, *middle, value, slope);
        return;
    }
#endif
    *found = center_by_two(of, y, small, large, *middle, value, slope);
}

void influence_off_center(const struct column *of, const double *x, const double *y,
                          const int *size, const double *table, const double *node, double *value,
                          double *d_x, double *d_length, int *found)
{
#ifdef __x86_64__
    if (of->by == 4) {
        *found = off_center_by_four(of, x, y, size, table, node, value, d_x, d_length);
        return;
    }
#endif
    *found = off_center_by_two(of, x, y, size, table, node, value, d_x, d_length);
}

#else

int influence_lanes(void)
{
    return 0;
}

/* They are named by the Fortran side, and called by none. */
void influence_center(void) {}
void influence_off_center(void) {}

#endif

#else /* one number of lanes */

#define INSIDE TARGET static inline __attribute__((always_inline))

#define lanes NAME(lanes)
#define unaligned NAME(unaligned)
#define bits NAME(bits)
#define words NAME(words)
typedef double lanes __attribute__((vector_size(8 * LANES)));
typedef double unaligned __attribute__((vector_size(8 * LANES), aligned(8), may_alias));
typedef int64_t bits __attribute__((vector_size(8 * LANES)));
typedef uint64_t words __attribute__((vector_size(8 * LANES)));

#define all NAME(all)
#define add NAME(add)
#define less NAME(less)
#define root NAME(root)
#define pick NAME(pick)
#define larger NAME(larger)
#define smaller NAME(smaller)
#define any NAME(any)
#define totals NAME(totals)
#if LANES == 4

INSIDE lanes all(double x) { return _mm256_set1_pd(x); }
/* a b + c and c - a b, rounded once */
INSIDE lanes add(lanes a, lanes b, lanes c) { return _mm256_fmadd_pd(a, b, c); }
INSIDE lanes less(lanes c, lanes a, lanes b) { return _mm256_fnmadd_pd(a, b, c); }
INSIDE lanes root(lanes x) { return _mm256_sqrt_pd(x); }
INSIDE lanes pick(bits on, lanes a, lanes b) { return _mm256_blendv_pd(b, a, (lanes)on); }
INSIDE lanes larger(lanes a, lanes b) { return _mm256_max_pd(a, b); }
INSIDE lanes smaller(lanes a, lanes b) { return _mm256_min_pd(a, b); }
INSIDE int any(bits on) { return _mm256_movemask_pd((lanes)on); }

/* Of each of four the sum of its numbers. */
INSIDE lanes totals(const lanes *x)
{
    const lanes a = _mm256_hadd_pd(x[0], x[1]), b = _mm256_hadd_pd(x[2], x[3]);

    return _mm256_permute2f128_pd(a, b, 0x20) + _mm256_permute2f128_pd(a, b, 0x31);
}

#else

INSIDE lanes all(double x) { return (lanes){x, x}; }
INSIDE lanes add(lanes a, lanes b, lanes c) { return a * b + c; }
INSIDE lanes less(lanes c, lanes a, lanes b) { return c - a * b; }
#ifdef __x86_64__
INSIDE lanes root(lanes x) { return _mm_sqrt_pd(x); }
#else
INSIDE lanes root(lanes x) { return (lanes){sqrt(x[0]), sqrt(x[1])}; }
#endif
INSIDE lanes pick(bits on, lanes a, lanes b) { return (lanes)((on & (bits)a) | (~on & (bits)b)); }
INSIDE lanes larger(lanes a, lanes b) { return pick(a > b, a, b); }
INSIDE lanes smaller(lanes a, lanes b) { return pick(a < b, a, b); }
INSIDE int any(bits on) { return (on[0] | on[1]) != 0; }
INSIDE lanes totals(const lanes *x) { return (lanes){x[0][0] + x[0][1], x[1][0] + x[1][1]}; }

#endif

#define size_of NAME(size_of)
#define some NAME(some)
#define at NAME(at)
#define plain_where NAME(plain_where)
#define is_plain NAME(is_plain)
#define put NAME(put)
INSIDE lanes size_of(lanes x) { return (lanes)((bits)x & INT64_MAX); }
INSIDE lanes at(const double *x) { return *(const unaligned *)x; }

/* Where are numbers, and no larger than that? Comparing NaN raises an exception. */
INSIDE bits plain_where(lanes x, double largest) { return (bits)size_of(x) <= (bits)all(largest); }

INSIDE int is_plain(const struct column *of)
{
    return !any(~(plain_where(all(of->length), of->largest)
                  & plain_where(all(of->left), of->largest)
                  & plain_where(all(of->right), of->largest)))
           && of->length * of->largest >= 1.0;
}

/* Where a column ends its last point once more. */
INSIDE lanes some(const double *x, int left)
{
    lanes found;

    if (left >= LANES)
        return at(x);
    for (int i = 0; i < LANES; i++)
        found[i] = x[i < left ? i : left - 1];
    return found;
}

INSIDE void put(double *place, int left, lanes x)
{
    if (left >= LANES)
        *(unaligned *)place = x;
    else
        for (int i = 0; i < left; i++)
            place[i] = x[i];
}

/* ln x of normal numbers x > 0, to 1 unit in the last place: x = 2^k (1 + f) with 1 + f between
   sqrt(1/2) and sqrt(2), s = f/(2 + f), ln(1 + f) = f - f^2/2 + s (f^2/2 + R(s^2)), R as in
   Sun's fdlibm. */
#define ln NAME(ln)
INSIDE lanes ln(lanes x)
{
    /* Bits of 1 less those of sqrt(1/2), cut: adding them carries into the exponent. */
    const bits shifted = (bits)x + 0x00095f6400000000LL;
    const bits fraction = shifted & 0x000fffffffffffffLL;
    const bits exponent = (bits)((words)shifted >> 52);
    const lanes k = (lanes)(exponent | 0x4330000000000000LL) - (0x1p52 + 1023.0);
    const lanes f = (lanes)(fraction + 0x3fe6a09c00000000LL) - 1.0;
    const lanes s = f / (2.0 + f);
    const lanes z = s * s;
    const lanes half = 0.5 * f * f;
    lanes r = all(1.479819860511658591e-01);
    r = add(r, z, all(1.531383769920937332e-01));
    r = add(r, z, all(1.818357216161805012e-01));
    r = add(r, z, all(2.222219843214978396e-01));
    r = add(r, z, all(2.857142874366239149e-01));
    r = add(r, z, all(3.999999999940941908e-01));
    r = add(r, z, all(6.666666666666735130e-01));
    /* ln 2 in two parts; the first has so few bits that its product with k is exact. */
    return k * 6.93147180369123816490e-01
           - ((half - add(s, add(r, z, half), k * 1.90821492927058770002e-10)) - f);
}

/* Centre lines: G(c) of both edges and, if `rows` is 2, G - c G' behind it. */

#define near_center NAME(near_center)
INSIDE void near_center(int rows, const lanes *c, const lanes *log_c, const double *small,
                        lanes g[2][2])
{
    lanes p[4][2], x[2];

    for (int e = 0; e < 2; e++) {
        const lanes near = smaller(c[e], all(1.0));
        x[e] = near * near;
        for (int j = 0; j < 2 * rows; j++)
            p[j][e] = all(small[4 * SMALL + j]);
    }
    for (int k = SMALL - 1; k >= 0; k--)
        for (int j = 0; j < 2 * rows; j++)
            for (int e = 0; e < 2; e++)
                p[j][e] = add(p[j][e], x[e], all(small[4 * k + j]));
    for (int e = 0; e < 2; e++)
        for (int j = 0; j < rows; j++)
            g[j][e] = c[e] * less(p[2 * j][e], p[2 * j + 1][e], log_c[e]);
}

/* And `apart`, the difference of both, in which large logarithms do not cancel. */
#define far_center NAME(far_center)
INSIDE void far_center(int rows, const lanes *c, const lanes *log_c, lanes ratio,
                       const double *large, double middle, lanes g[2][2], lanes *apart)
{
    const lanes half_pi = all(1.5707963267948966);
    lanes even[2][2], odd[2][2], x[2], x2[2], w[2];

    for (int e = 0; e < 2; e++) {
        w[e] = 1.0 / larger(c[e], all(1.0));
        w[e] = w[e] * w[e];
        x[e] = w[e] - middle;
        x2[e] = x[e] * x[e];
        for (int j = 0; j < rows; j++) {
            even[j][e] = all(large[2 * LARGE + j]);
            odd[j][e] = all(0.0);
        }
    }
    for (int k = LARGE - 2; k >= 0; k -= 2)
        for (int j = 0; j < rows; j++)
            for (int e = 0; e < 2; e++) {
                even[j][e] = add(even[j][e], x2[e], all(large[2 * k + j]));
                odd[j][e] = add(odd[j][e], x2[e], all(large[2 * k + 2 + j]));
            }
    apart[0] = half_pi * ratio;
    for (int j = 0; j < rows; j++) {
        for (int e = 0; e < 2; e++) {
            even[j][e] = w[e] * add(x[e], odd[j][e], even[j][e]);
            /* ln 4 + 1/2 */
            g[j][e] = j == 0 ? add(half_pi, log_c[e] + 1.8862943611198906, even[j][e])
                             : g[0][e] - half_pi + even[j][e];
        }
        apart[j] = apart[0] + (even[j][1] - even[j][0]);
    }
}

#define center_points NAME(center_points)
INSIDE int center_points(int rows, const struct column *of, const double *y, const double *small,
                         const double *large, double middle, double *value, double *slope)
{
    const int n = of->n;
    const double left = of->left, right = of->right, length = of->length, per_length = 1.0 / length;
    const double unit[2] = {right < left ? -length : length, right < left ? -1.0 : 1.0};
    bits missing = {0};

    for (int i = 0; i < n; i += LANES) {
        lanes place = some(y + i, n - i);
        const bits plain = plain_where(place, of->largest);
        place = pick(plain, place, all(left));
        const lanes a = (left - place) * per_length, b = (right - place) * per_length;
        const bits inside = ((bits)a ^ (bits)b) & INT64_MIN;
        /* An edge that is nearer, c ln c, is below rounding. */
        const lanes near_edge = larger(smaller(size_of(a), size_of(b)), all(1e-100));
        const lanes c[2] = {near_edge, larger(larger(size_of(a), size_of(b)), near_edge)};
        const lanes ratio = ln(c[1] / c[0]), log_far = ln(c[1]);
        const lanes log_c[2] = {log_far - ratio, log_far};
        const bits is_near[2] = {c[0] <= 1.0, c[1] <= 1.0};
        lanes g[2][2] = {{{0}}}, far[2][2], apart[2], sum[2];

        if (any(is_near[0]))
            near_center(rows, c, log_c, small, g);
        for (int j = 0; j < rows; j++)
            sum[j] = g[j][1] - (lanes)((bits)g[j][0] ^ inside);
        if (any(~is_near[1])) {
            far_center(rows, c, log_c, ratio, large, middle, far, apart);
            for (int j = 0; j < rows; j++) {
                for (int e = 0; e < 2; e++)
                    g[j][e] = pick(is_near[e], g[j][e], far[j][e]);
                sum[j] = pick(is_near[0] | (inside != 0),
                              g[j][1] - (lanes)((bits)g[j][0] ^ inside), apart[j]);
            }
        }
        sum[0] = (lanes)((bits)sum[0] & plain);
        missing |= sum[0] == 0.0;
        put(value + i, n - i, unit[0] * sum[0]);
        if (rows == 2)
            put(slope + i, n - i, unit[1] * sum[1]);
    }
    return !any(missing);
}

TARGET static int NAME(center)(const struct column *of, const double *y, const double *small,
                               const double *large, double middle, double *value, double *slope)
{
    if (!is_plain(of))
        return -1;
    if (slope)
        return center_points(2, of, y, small, large, middle, value, slope);
    return center_points(1, of, y, small, large, middle, value, slope);
}

/* Off the centre line: nodes of a field point side by side. Four field points at a time, sorted by
   their rules, take longer: rules are many, and few points share one. */

/* c[0] + c[1] y + ... + c[last] y^last; those of a thin strip stand LANES apart. */
#define powers NAME(powers)
INSIDE lanes powers(int thin, const double *c, lanes y)
{
    const int by = thin ? LANES : 1;
    const lanes y2 = y * y, y4 = y2 * y2;
    lanes sum = all(c[thin ? 8 * by : 12]);

    if (!thin)
        sum = add(y2, add(y, all(c[15]), all(c[14])), add(y, all(c[13]), sum));
    for (int k = thin ? 4 : 8; k >= 0; k -= 4)
        sum = add(y4, sum, add(y2, add(y, all(c[(k + 3) * by]), all(c[(k + 2) * by])),
                               add(y, all(c[(k + 1) * by]), all(c[k * by]))));
    return sum;
}

/* Powers of a thin strip's kernel: with h its half-width, c the distance of its middle,
   s^2 = delta^2 + c^2, y = (c/s)^2 and t = (h/c)^2 it is
   (2h/s) sum_k (h/s)^(2k) P_2k(c/s)/(2k + 1) = (2h/s) sum_m C_m(t) y^m, k up to 4. */
#define expand NAME(expand)
INSIDE void expand(lanes t, lanes *c)
{
    const lanes t2 = t * t, t3 = t * t2, t4 = t2 * t2;

    c[0] = all(1.0);
    c[1] = t * (-1.0 / 6.0);
    c[2] = t * (0.5 + 0.075 * t);
    c[3] = -0.75 * t2 - 5.0 / 112.0 * t3;
    c[4] = 0.875 * t2 + 0.9375 * t3 + 35.0 / 1152.0 * t4;
    c[5] = -2.8125 * t3 - 1.09375 * t4;
    c[6] = 2.0625 * t3 + 6.015625 * t4;
    c[7] = -1001.0 / 96.0 * t4;
    c[8] = 5.5859375 * t4;
}

/* What the rules of a field point need; m are its sums. */
#define point_t NAME(point_t)
typedef struct {
    double x, cl2, cr2, middle2, width;
    lanes *m;
} point_t;

/* Trapezium rule in theta, u = cos(theta): the sums of sqrt(1 - u^2), u/sqrt(1 - u^2) and
   u^2/sqrt(1 - u^2) times the kernel. */
#define far_rule NAME(far_rule)
INSIDE void far_rule(int thin, int n, const double *cosine, point_t of, const double *c)
{
    const lanes x = all(of.x), cl2 = all(of.cl2), cr2 = all(of.cr2), width = all(of.width);
    const lanes middle2 = all(of.middle2);
    lanes m0 = all(0.0), m1 = m0, m2 = m0;

    for (int j = 0; j < n; j += LANES) {
        const lanes u = at(cosine + j), delta = u - x;
        lanes r, y;

        if (thin) {
            r = 1.0 / root(add(delta, delta, middle2));
            y = middle2 * (r * r);
        } else {
            r = 1.0 / (root(add(delta, delta, cl2)) + root(add(delta, delta, cr2)));
            y = width * r;
            y = y * y;
        }
        const lanes kernel = r * powers(thin, c, y);
        m0 = m0 + kernel;
        m1 = add(u, kernel, m1);
        m2 = add(u * u, kernel, m2);
    }
    of.m[0] = m0 - m2;
    of.m[LANES] = m1;
    of.m[2 * LANES] = m2;
}

/* Trapezium rule in phi, tau = H cos(phi), `rest` is 1 - u; the nodes of
   faststrip_influence_angle_rules. */
#define near_rule NAME(near_rule)
INSIDE void near_rule(int thin, int n, const double *p, int apart, point_t of, const double *c)
{
    const double *q = p + apart, *dp = q + apart, *dq = dp + apart;
    const lanes x = all(of.x), cl2 = all(of.cl2), cr2 = all(of.cr2), width = all(of.width);
    const lanes middle2 = all(of.middle2), one_x = 1.0 - x;
    lanes m0 = all(0.0), m1 = m0, m2 = m0;

    for (int j = 0; j < n; j += LANES) {
        const lanes rest = less(at(q + j), x, at(p + j)), root2 = rest * (2.0 - rest);
        const lanes u = 1.0 - rest, delta = one_x - rest;
        lanes r, y;

        if (thin) {
            r = 1.0 / root(root2 * add(delta, delta, middle2));
            y = middle2 * root2 * (r * r);
        } else {
            r = 1.0 / (root(root2 * add(delta, delta, cl2)) + root(root2 * add(delta, delta, cr2)));
            y = width * r;
            y = root2 * (y * y);
        }
        const lanes kernel = less(at(dq + j), x, at(dp + j)) * r * powers(thin, c, y);
        m0 = add(root2, kernel, m0);
        m1 = add(u, kernel, m1);
        m2 = add(u * u, kernel, m2);
    }
    of.m[0] = m0;
    of.m[LANES] = m1;
    of.m[2 * LANES] = m2;
}

/* The strip's own tip, the tip moving along: kappa is a quarter of the width. */
#define own_tip NAME(own_tip)
INSIDE void own_tip(lanes kappa, const double *own, lanes *value, lanes *slope)
{
    lanes p = all(own[2 * OWN]), q = all(own[2 * OWN + 1]);

    for (int k = OWN - 1; k >= 0; k--) {
        p = add(p, kappa, all(own[2 * k]));
        q = add(q, kappa, all(own[2 * k + 1]));
    }
    const lanes power = 4.0 * kappa * root(kappa);
    *value = add(all(12.566370614359172), kappa, power * p);
    *slope = power * (p - q);
}

TARGET static int NAME(off_center)(const struct column *of, const double *x, const double *y,
                                   const int *size, const double *table, const double *node,
                                   double *value, double *d_x, double *d_length)
{
    const int *start = size + RULES;
    /* Nodes of two accuracies stand side by side. */
    const int n = of->n, apart = 2 * (start[RULES - 1] + size[RULES - 1]);
    const double *limit = table, *n0 = limit + RULES, *n1 = n0 + RULES, *last_x = n1 + RULES;
    const double *weight = last_x + RULES, *form = weight + RULES, *atanh = form + 4;
    const double *own = atanh + 16;
    const double thin_last = form[0], wide_last = form[1];
    const lanes beyond = all(form[2]);
    bits missing = {0};

    if (!is_plain(of))
        return -1;
    const double left = of->left, right = of->right, length = of->length, per_length = 1.0 / length;
    for (int i = 0; i < n; i += LANES) {
        const lanes place = some(y + i, n - i), along = some(x + i, n - i);
        const bits plain = plain_where(place, of->largest) & plain_where(along, of->largest);
        const lanes across = pick(plain, place, all(left));
        const lanes xs = smaller(size_of(pick(plain, along, all(0.0))) * per_length, beyond);
        const lanes a = (left - across) * per_length, b = (right - across) * per_length;
        const bits outside = ((bits)a ^ (bits)b) >= 0;
        const lanes as = smaller(size_of(a), beyond), bs = smaller(size_of(b), beyond);
        const lanes cl = larger(smaller(as, bs), all(1e-300)), cr = larger(larger(as, bs), cl);
        const lanes before = xs - 1.0, behind = xs + 1.0, width = cr - cl;
        const lanes cl2 = cl * cl, cr2 = cr * cr, middle = 0.5 * (cl + cr);
        const lanes narrow = width / (larger(cr, before) + larger(cl, before));
        const lanes sigma = 0.5 * (root(add(before, before, cl2)) + root(add(behind, behind, cl2)));
        const bits serves = plain & outside & (b > a) & (smaller(as, bs) > 0.0) & (cr < beyond)
                            & (xs > 0.0) & (xs < beyond) & (narrow <= wide_last);
        const bits thin = narrow <= thin_last;
        const lanes half = 0.5 * width / middle, xx = xs * xs, middle2 = middle * middle;
        lanes c[9], m[3][LANES], factor = all(0.0);
        bits far = {0}, near = {0};

        expand(half * half, c);
        for (int k = 0; k < RULES; k++)
            far -= sigma < limit[k];
        for (int k = 0; k < RULES; k++)
            near -= less(all(n0[k]), xx, all(n1[k])) > cl2;
        for (int j = 0; j < LANES; j++) {
            const int other = (int)near[j];
            /* A node of these costs somewhat more. */
            const int is_near = other + 1 < far[j] && xs[j] <= last_x[other];
            const int rule = is_near ? other : (int)far[j];
            const point_t point = {xs[j], cl2[j], cr2[j], middle2[j], width[j], m[0] + j};

            if (j >= n - i || !serves[j] || rule == RULES) {
                m[0][j] = m[1][j] = m[2][j] = all(0.0);
                continue;
            }
            const double *first = node + start[rule];
            factor[j] = weight[rule];
            if (is_near && thin[j])
                near_rule(1, size[rule], first + apart, apart, point, (const double *)c + j);
            else if (is_near)
                near_rule(0, size[rule], first + apart, apart, point, atanh);
            else if (thin[j])
                far_rule(1, size[rule], first, point, (const double *)c + j);
            else
                far_rule(0, size[rule], first, point, atanh);
        }
        factor = factor * width;
        lanes sum[3] = {factor * totals(m[0]), factor * totals(m[1]), factor * totals(m[2])};
        const bits is_own = ~outside & (size_of(along) == length) & (cr <= form[3])
                            & (size_of(a + b) <= 0x1p-50 * (cr + size_of(across) * per_length));
        if (any(is_own)) {
            lanes g, d;
            own_tip(0.5 * cr, own, &g, &d);
            sum[0] = pick(is_own, g, sum[0]);
            sum[1] = pick(is_own, all(0.0), sum[1]);
            sum[2] = pick(is_own, d, sum[2]);
        }
        missing |= sum[0] == 0.0;
        put(value + i, n - i, length * sum[0]);
        put(d_x + i, n - i, (lanes)((bits)sum[1] ^ (~(bits)along & INT64_MIN)));
        put(d_length + i, n - i, sum[2]);
    }
    return !any(missing);
}

#undef INSIDE
#undef lanes
#undef unaligned
#undef bits
#undef words
#undef all
#undef add
#undef less
#undef root
#undef any
#undef totals
#undef pick
#undef larger
#undef smaller
#undef size_of
#undef some
#undef at
#undef plain_where
#undef is_plain
#undef put
#undef ln
#undef near_center
#undef far_center
#undef center_points
#undef powers
#undef expand
#undef point_t
#undef far_rule
#undef near_rule
#undef own_tip

#endif
