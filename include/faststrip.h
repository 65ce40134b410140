/* faststrip: wheel/rail contact by the modified strip method, for C and C++.
 *
 * Units mm, N, MPa, rad. x is the rolling direction, y points to the right, z into the rail.
 * Creepages are the velocity of the rail surface relative to the wheel surface over the rolling
 * speed; forces act on the rail, Fx = -C11 G a b cksi, Fy = -C22 G a b ceta - C23 G (ab)^1.5 cphi.
 *
 * Every function returns a status: 0, all is well; below FASTSTRIP_FIRST_ERROR a result with a
 * named limitation; from there on no result, and the figures are zero. faststrip_message gives the
 * word of a status, faststrip_last_message says what was wrong with which value.
 *
 * A workspace serves one thread at a time; different workspaces are independent. A pointer to a
 * workspace is a number of this library's, not an address: one that was freed, or never made, is
 * rejected (100) in every function, however often, and its memory is not touched. Outside of
 * workspaces the library remembers which of them are in use, and nothing else. faststrip_new and
 * faststrip_copy allocate, faststrip_free frees, nothing else does (but the like of wheelsets,
 * faststrip_solve_many, faststrip_check_case, which tries, the words of an error, made with a
 * little memory of the Fortran run-time library, and the forces of a patch with a neck of more than
 * 128 strips, and faststrip_read_profile, the only one that reads a file). A call needs less than
 * 64 kB of stack. No function stops, prints, writes a file, changes the locale, or leaves
 * floating-point flags, traps or rounding other than it found them.
 *
 * Of structs with a size a function sets it, to that of the header the program was compiled with;
 * one of another header is refused (100). */
#ifndef FASTSTRIP_H
#define FASTSTRIP_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Version of this header; faststrip_version has that of the library. */
#define FASTSTRIP_VERSION "0.1.0"

/* Room for any text of this library, characters. */
#define FASTSTRIP_TEXT 257

/* How a call ended: 0, a result with a limitation, or, from 100 on, an error. */
enum faststrip_status {
    FASTSTRIP_OK = 0,            /* all is well */
    FASTSTRIP_FALLBACK_USED = 1, /* fixed cells gave the answer: patch ends did not settle */
    FASTSTRIP_EDGE_OF_DATA = 2,  /* the contact runs to the end of the gap's points */
    FASTSTRIP_FEWER_STRIPS = 3,  /* more strips did not settle */
    FASTSTRIP_OVERLAP_LEFT = 4,  /* a rough gap's valleys overlap beside the patches */
    FASTSTRIP_FLAT_ALONG_X = 5,  /* inv2r near zero in the contact, raised to be solved */
    FASTSTRIP_CONFORMAL = 6,     /* inclination changes much within it: half-space doubtful */
    FASTSTRIP_TARGET_MISSED = 7, /* auto: strips are not as good as the tolerance asks */
    FASTSTRIP_UNDER_RESOLVED = 8, /* an estimated error is above its limit */
    FASTSTRIP_MORE_STRIPS = 9,   /* more strips than were asked for gave the answer */
    FASTSTRIP_BEYOND_YIELD = 10, /* pmax is above a limit; the command line's, not given here */
    FASTSTRIP_NO_WAVE = 11,      /* a conicity: no motion about the equilibrium turns there */
    FASTSTRIP_NOT_UNIQUE = 12,   /* other creepages with more slip carry the given force, too */
    FASTSTRIP_FIRST_ERROR = 100, /* statuses below are results */
    FASTSTRIP_BAD_ARGUMENT = 100,        /* a setting that cannot be, a pointer to nothing */
    FASTSTRIP_NOT_FINITE = 101,          /* a number is NaN or infinite */
    FASTSTRIP_NOT_INCREASING = 102,      /* y does not increase from point to point */
    FASTSTRIP_TOO_FEW_POINTS = 103,      /* of a gap, a profile, a table */
    FASTSTRIP_BAD_MATERIAL = 104,        /* Young's modulus or Poisson's ratio out of range */
    FASTSTRIP_BAD_LOAD = 105,            /* the load is not above 0 */
    FASTSTRIP_NO_CONTACT = 106,          /* the bodies do not touch */
    FASTSTRIP_NO_HERTZ_ELLIPSE = 107,    /* relative curvature is not positive */
    FASTSTRIP_NO_CONVERGENCE = 108,      /* no answer within the bounded work, or none exists */
    FASTSTRIP_OUT_OF_RANGE = 109,        /* beyond what can be computed, or beyond a table */
    FASTSTRIP_WORKSPACE_TOO_SMALL = 110, /* less capacity than the call needs */
    FASTSTRIP_LINEAR_ALGEBRA = 111,      /* equations that double precision cannot solve */
    FASTSTRIP_NO_FINITE_PATCH = 113,     /* flat or hollow along x: the patch has no end */
    FASTSTRIP_BEYOND_ADHESION = 114,     /* a given force or moment above what adhesion carries */
    FASTSTRIP_FILE_MISSING = 120, /* of faststrip_read_profile: there is none, or none to be read */
    FASTSTRIP_FILE_FORMAT = 121          /* what stands in a file is not what should */
};

/* BEGIN methods, written by tools/generate/methods.py */
/* The normal methods. */
enum faststrip_normal {
    FASTSTRIP_NORMAL_STRIP = 1,         /* strips, for any patch and any number of patches */
    FASTSTRIP_NORMAL_HERTZ = 2,         /* the Hertz ellipse where the gap is lowest */
    FASTSTRIP_NORMAL_EQUAL_AREA = 3,    /* ellipses of equal area, proportions of Hertz */
    FASTSTRIP_NORMAL_EQUAL_MOMENTS = 4, /* the same, proportions of the second moments */
    FASTSTRIP_NORMAL_AUTO = 6,          /* both methods, as fine as estimated errors ask */
    FASTSTRIP_NORMAL_KPEC = 7,          /* Kik and Piotrowski with the elliptic correction */
    FASTSTRIP_NORMAL_ANALYN = 8,        /* Sichani, Enblom and Berg, strips as local ellipses */
    FASTSTRIP_NORMAL_KPEC_STRIPS = 9    /* strips in the patch of KPEC, pressures their own */
};

/* The tangential methods. */
enum faststrip_tangential {
    FASTSTRIP_TANGENTIAL_NONE = 0,                /* no forces */
    FASTSTRIP_TANGENTIAL_FASTSTRIP = 1,           /* marching in the strips: the best fast one */
    FASTSTRIP_TANGENTIAL_FASTSIM = 2,             /* Kalker's FASTSIM on the patches' ellipses */
    FASTSTRIP_TANGENTIAL_FASTSTRIP_PAPER = 3,     /* TFASTSTRIP as printed */
    FASTSTRIP_TANGENTIAL_FASTSTRIP_CORRECTED = 4, /* TFASTSTRIP as corrected */
    FASTSTRIP_TANGENTIAL_FASTSIM_ELLIPTIC = 5,    /* FASTSIM with the elliptic traction bound */
    FASTSTRIP_TANGENTIAL_FASTSIM_WEIGHTED = 6,    /* FASTSIM with a single flexibility */
    FASTSTRIP_TANGENTIAL_LINEAR = 7,              /* Kalker's linear theory; no elements */
    FASTSTRIP_TANGENTIAL_SHE = 8,                 /* Shen, Hedrick and Elkins; no elements */
    FASTSTRIP_TANGENTIAL_POLACH = 9,              /* Polach; no elements */
    FASTSTRIP_TANGENTIAL_FASTSTRIP_PLAIN = 11     /* FASTSTRIP without its correction */
};
/* END methods */

/* What FASTSTRIP_NORMAL_AUTO is to know as well as the tolerance asks. */
enum faststrip_target {
    FASTSTRIP_TARGET_FORCES = 1,      /* the worst of est_err_fx, est_err_fy, est_err_mz */
    FASTSTRIP_TARGET_PMAX = 2,        /* est_err_pmax */
    FASTSTRIP_TARGET_PENETRATION = 3, /* est_err_penetration */
    FASTSTRIP_TARGET_AREA = 4,        /* est_err_area */
    FASTSTRIP_TARGET_POWER = 5        /* friction power, relative */
};

/* How friction falls with the slip speed s: mu (k + (1 - k) f), k being kinetic_share, h
 * half_slip_speed. Refused (100) but of FASTSTRIP, FASTSTRIP_PLAIN and the three methods FASTSIM;
 * no errors of such forces are estimated (FASTSTRIP_UNDER_RESOLVED). */
enum faststrip_friction {
    FASTSTRIP_FRICTION_CONSTANT = 0,   /* f = 1 */
    FASTSTRIP_FRICTION_LINEAR = 2,     /* f = max(0, 1 - s/(2 h)) */
    FASTSTRIP_FRICTION_RATIONAL = 3,   /* f = 1/(1 + s/h) */
    FASTSTRIP_FRICTION_EXPONENTIAL = 4 /* f = 2^(-s/h) */
};

/* What the places of friction across the rail are. Methods without strips, rows or elements of
 * their own take the mean by load. */
enum faststrip_places {
    FASTSTRIP_OVER_CONTACT = 0, /* y of the contact, mm */
    FASTSTRIP_OVER_RAIL = 1,    /* y on the rail's profile, mm; needs rail_y */
    FASTSTRIP_OVER_ANGLE = 2    /* contact angle of either sign, rad; needs contact_angle */
};

/* One contact. Fill it in with faststrip_default_case first. */
typedef struct faststrip_case {
    size_t size;          /* of this struct; set by faststrip_default_case */
    int normal;           /* enum faststrip_normal */
    int tangential;       /* enum faststrip_tangential */
    int strips_per_patch; /* 1 to 1000 across the largest patch, or 0: left to the solver */
    int points_per_strip; /* 1 to 1000, FASTSTRIP */
    int fastsim_nx;       /* points along a row, FASTSIM */
    int fastsim_ny;       /* rows, FASTSIM */
    int by_load;          /* 1: the load is given; 0: the penetration */
    int warm_start;       /* 1: start from the workspace's last solution, if it has one */
    int with_elements;    /* 1: keep tractions and slip of every element */
    double e_wheel;       /* Young's modulus, MPa */
    double e_rail;        /* Young's modulus, MPa */
    double nu_wheel;      /* Poisson's ratio */
    double nu_rail;       /* Poisson's ratio */
    double mu;            /* coefficient of friction */
    double load;          /* N */
    double penetration;   /* from h = 0, mm */
    double cksi;          /* longitudinal creepage about y = 0 */
    double ceta;          /* lateral creepage */
    double cphi;          /* spin, rad/mm */
    int estimate;         /* 1: errors are estimated; of strips that costs about one step */
    double resolution_limit; /* FASTSTRIP_UNDER_RESOLVED: est_err_penetration, est_err_pmax or
                              * est_err_area is above this; > 0 */
    double force_limit;   /* the same for est_err_fx, est_err_fy, est_err_mz; > 0 */
    int target;           /* enum faststrip_target; this and the two below: FASTSTRIP_NORMAL_AUTO */
    double tolerance;     /* largest estimated error of the target; 0: the least in the budget */
    double budget_us;     /* time for it, us; 0: as long as it takes */
    int friction;         /* enum faststrip_friction: how friction falls with slip speed */
    double kinetic_share; /* kinetic over static friction, 1e-6 to 1; mu is the static one */
    double half_slip_speed; /* slip speed of half of the fall, mm/s; of friction that falls > 0 */
    double speed;         /* rolling speed, mm/s, likewise, and with temperatures; of wheelsets each
                           * contact has its own */
    double slope_factor;  /* of the initial slope (Kalker's reduction factor), above 0 to 1 */
    double flange_share;  /* mu on the flange over mu, that on the tread; 1: they are one */
    double tread_angle;   /* contact angle up to which the tread's mu counts, rad, >= 0 */
    double flange_angle;  /* from which the flange's counts, rad; between both linearly */
    double contact_angle; /* of this contact, of either sign, rad; of wheelsets it is found */
    int n_mu;             /* places of a table of mu across the rail, 1 to 16; 0: mu is the same */
    int mu_over;          /* enum faststrip_places: what the places are */
    const double *mu_at;  /* n_mu places, increasing, mm or rad; read in the call that is made */
    const double *mu_table; /* mu there, in place of mu: linear between, constant beyond */
    double rail_y;        /* y on the rail's profile at y = 0, mm; of wheelsets it is found */
    int fx_is_given;      /* 1: given_fx instead of cksi, which must be 0 and is found */
    int fy_is_given;      /* 1: given_fy instead of ceta, likewise; neither of wheelsets (100) */
    double given_fx;      /* longitudinal force on the rail, N */
    double given_fy;      /* lateral force on the rail, N; both together at most mu N (100) */
    double hot_share;     /* hot over cold friction, 1e-6 to 1, by the temperature of the surfaces
                           * there; 1: it does not fall. Of the same methods; speed > 0 */
    double cold_temperature; /* up to which the cold value, that is mu, counts, C */
    double hot_temperature; /* from which the hot one counts, C; between both linearly */
    int with_temperatures; /* 1: those of the surfaces, of all methods with elements; speed > 0 */
    double conductivity_wheel; /* of heat, W/(m K) */
    double conductivity_rail; /* the same */
    double heat_capacity_wheel; /* J/(kg K) */
    double heat_capacity_rail; /* the same */
    double density_wheel; /* kg/m^3 */
    double density_rail;  /* the same */
    double temperature_wheel; /* away from the contact, C */
    double temperature_rail; /* the same */
    int curved;           /* 1: strips lie on the curved surface, each with its own plane; needs the
                           * inclination of the gap; load is then the force along the normal of the
                           * contact, of pressures and tractions together */
} faststrip_case;

/* Figures of one contact. Estimated errors are not negative; the depth is the penetration less the
 * lowest height of the gap. */
typedef struct faststrip_result {
    size_t size;            /* of this struct; set by faststrip_solve */
    double load;            /* normal load, N */
    double penetration;     /* penetration, the approach from h = 0, mm */
    double area;            /* contact area, mm^2 */
    double pmax;            /* maximum pressure, MPa */
    double y_min;           /* least y of the contact, mm */
    double y_max;           /* largest y of the contact, mm */
    double x_max;           /* largest half-length of the contact, along x, mm */
    double cksi;            /* longitudinal creepage */
    double ceta;            /* lateral creepage */
    double fx;              /* longitudinal force on the rail, N */
    double fy;              /* lateral force on the rail, in the contact plane, N */
    double mz;              /* moment on the rail about the reference point, N mm */
    double friction_power;  /* frictional work per distance rolled, N */
    double stick_fraction;  /* share of the area in adhesion */
    int n_patches;          /* number of contact patches */
    int n_strips;           /* number of strips */
    int n_elements;         /* number of elements */
    int iterations;         /* steps of the normal solution */
    int is_estimated;       /* 1: the five below are known; 0: zero, not asked for or of ellipses
                             * in the strips' place */
    int strips_across;      /* strips across the patch that has most */
    double est_err_penetration; /* estimated error of the penetration over the depth */
    double est_err_pmax;    /* estimated relative error of pmax */
    double est_err_area;    /* estimated relative error of the area */
    double residual_inside; /* largest gap left inside, over the depth */
    double overlap_outside; /* largest overlap outside, over the depth */
    int forces_are_estimated; /* 1: the three below are known; 0: zero, not asked for, of a
                               * method without, or because is_estimated is 0 */
    int limitations;        /* all of them, of which the status is the first: 1 << status of
                             * each, added up */
    double est_err_fx;      /* estimated error of Fx over mu N */
    double est_err_fy;      /* estimated error of Fy over mu N */
    double est_err_mz;      /* estimated error of Mz over mu N sqrt(area/pi) */
    double est_err_cksi;    /* estimated error of cksi, 0 where it is given */
    double est_err_ceta;    /* estimated error of ceta, 0 where it is given */
    int n_steps;            /* steps that FASTSTRIP_NORMAL_AUTO took, of other methods 0 */
    int best_step;          /* the one whose solution this is, from 1 on; 0: none */
    int target_is_known;    /* 1: est_err_target is known; 0: zero */
    int target_is_met;      /* 1: est_err_target is within the tolerance */
    double est_err_target;  /* estimated error of the target of auto */
    int temperatures_are_known; /* 1: the four below are known; 0: zero, not asked for */
    double flash_temperature; /* largest rise by the heat of friction, K */
    double temperature_max; /* largest temperature of the surfaces in contact, C */
    double temperature_x;   /* x of the largest temperature, mm */
    double temperature_y;   /* y of the largest temperature, mm */
} faststrip_result;

/* Memory of one contact: capacity, gap, last solution. From faststrip_new. */
typedef struct faststrip_workspace faststrip_workspace;

/* The library's version, three numbers with points between. */
int faststrip_version(char *text, size_t length);

/* The word of a status, for example "no_contact". What does not fit is cut, with status 110. */
int faststrip_message(int status, char *text, size_t length);

/* What the workspace's last call had to say; empty when all was well. */
int faststrip_last_message(const faststrip_workspace *workspace, char *text, size_t length);

/* What is outside of practice in the last contact of a workspace, or in the last state of a
 * wheelset, which is handed over as a workspace: mostly a unit. The line number i, from 0 on, says
 * what should be, what was got, and the likely mistake; it is empty behind the last one. No status
 * and no figure depends on it. */
int faststrip_doubt(const faststrip_workspace *workspace, int i, char *text, size_t length);

/* Steel on steel, mu = 0.3, strips and FASTSTRIP, no load: to be filled in further.
 * length is sizeof(faststrip_case). */
int faststrip_default_case(faststrip_case *contact, size_t length);

/* What faststrip_new would return for the same case and capacity; text, if not null, says why. */
int faststrip_check_case(const faststrip_case *contact, int max_points, char *text, size_t length);

/* Make a workspace with capacity for the methods of a case, gaps of up to max_points points and, if
 * with_elements, the elements. *workspace is null when there is an error. */
int faststrip_new(const faststrip_case *contact, int max_points, faststrip_workspace **workspace);

/* Free a workspace; *workspace becomes null. One that is null already is left alone; one that was
 * freed through another pointer is rejected (100). */
int faststrip_free(faststrip_workspace **workspace);

/* Copy gap, solution and capacity of one workspace into another, for a step that may be taken
 * back. */
int faststrip_copy(const faststrip_workspace *from, faststrip_workspace *to);

/* The gap of the undeformed bodies that the next solutions are for: h(x, y) = h(y) + x^2 inv2r(y),
 * 5 to max_points points, y strictly increasing, mm, mm, 1/mm. inclination says how far the
 * surfaces have turned from the tangent plane at y = 0, rad, by which FASTSTRIP_CONFORMAL is known;
 * null: not known. All numbers must be finite; they are copied. With more points than there is
 * capacity for (110) nothing is read. With an error the workspace keeps the gap that it had. */
int faststrip_set_gap(faststrip_workspace *workspace, int n, const double *y, const double *h,
                      const double *inv2r, const double *inclination);

/* Solve one contact on the gap of the workspace.
 *
 * With FASTSTRIP_NORMAL_AUTO, of faststrip_new too, cheap steps come first and finer ones where
 * their estimated errors ask for them, until that of the target is within the tolerance or the
 * budget is spent; with FASTSTRIP_TARGET_MISSED the result is the best there is. strips_per_patch
 * and estimate do not count then; where the target needs forces, FASTSTRIP serves with as many
 * points as it takes, whatever tangential, which must not be none, and points_per_strip are. The
 * limits count only where the tolerance is 0. */
int faststrip_solve(faststrip_workspace *workspace, const faststrip_case *contact,
                    faststrip_result *result);

/* A gap of one of many contacts, as faststrip_set_gap takes it. */
typedef struct faststrip_gap {
    int n;                     /* points */
    const double *y;           /* strictly increasing, mm */
    const double *h;           /* mm */
    const double *inv2r;       /* 1/mm */
    const double *inclination; /* rad; null: not known */
} faststrip_gap;

/* Solve n contacts, each filled in with faststrip_default_case first, by so many threads of the
 * system at most, each with a workspace of its own; all have ended when the call returns. Contact i
 * is on gaps[gap_of[i]], from 0 on; where gap_of is null on gaps[i], or on the only one. results[i]
 * and statuses[i] become what faststrip_solve would have written and returned: the same bits for
 * any number of threads (but by a budget of time). A contact without a result costs only itself;
 * its figures are zero. text, if not null, becomes empty, or tells of the first one without: its
 * number and what was wrong.
 *
 * Methods and numbers of strips and points must not need more capacity than those of the first
 * contact. A contact with warm_start starts from the one before, if that has a result, but the
 * first of every chain contacts, which one thread solves one after the other; with chain 1 all
 * start from nothing.
 *
 * The call allocates the workspaces, and frees them. Its status is 0, or an error (100, 110: no
 * memory for a single workspace) with which nothing was solved and nothing written but text. */
int faststrip_solve_many(size_t n, const faststrip_case *contacts, int n_gaps,
                         const faststrip_gap *gaps, const int *gap_of, int chain, int threads,
                         faststrip_result *results, int *statuses, char *text, size_t length);

/* The strips of the last contact: edges and half-lengths in mm, pressure on the centre line in
 * MPa, number of the patch. capacity is the length of the arrays; *n becomes the number of strips
 * even if that is more. */
int faststrip_get_strips(faststrip_workspace *workspace, int capacity, int *n, double *y_left,
                         double *y_right, double *half_length, double *p0, int *patch);

/* The elements of the last contact, if with_elements asked for them: middle (mm), area (mm^2),
 * pressure and traction on the rail (MPa), slip over rolling speed, state (1 adhesion, 2 slip). */
int faststrip_get_elements(faststrip_workspace *workspace, int capacity, int *n, double *x,
                           double *y, double *area, double *pn, double *px, double *py,
                           double *sx, double *sy, int *state);

/* Stresses of the rail at n points below the last contact, if with_elements kept its elements or
 * there is no tangential method: x, y, and the depth z from 0 on (mm), in the frame of the contact.
 * stresses becomes 11 n numbers (MPa), of each point xx, yy, zz, xy, xz, yz with tension positive,
 * von Mises, Tresca, and the principal values, the largest first. On the surface they are good at
 * the middles of elements. */
int faststrip_get_stresses(faststrip_workspace *workspace, int n, const double *x,
                           const double *y, const double *z, double *stresses);

/* The largest von Mises stress below the last contact: figures becomes its value (MPa), where it
 * is, x, y, z (mm), and its estimated relative error; zeros with an error. */
int faststrip_get_stress_peak(faststrip_workspace *workspace, double figures[5]);

/* Derivatives at the last contact: derivatives[i][j] is that of load, Fx, Fy (N), Mz (N mm) over
 * penetration (mm), cksi, ceta (-), cphi (rad/mm), with the strips that were solved. Forces have
 * kinks where an element begins to slide: one side of it is given. 100: by auto, a reference or
 * with no contact solved; 108: patches or strips come or go there. */
int faststrip_get_derivatives(faststrip_workspace *workspace, double derivatives[4][4]);

/* The steps of the last contact, if by FASTSTRIP_NORMAL_AUTO: methods, strips across the widest
 * patch, points along a strip, estimated error of the target (-1: not known), time in us of the
 * pressures and of the forces with their estimates. */
int faststrip_get_steps(faststrip_workspace *workspace, int capacity, int *n, int *normal,
                        int *tangential, int *strips, int *points, double *estimate,
                        double *normal_us, double *tangential_us);

/* A law of wear by coefficients: in each regime of T gamma/A the wear rate is its constant and its
 * slope times T gamma/A. The library has none of its own. */
typedef struct faststrip_wear_law {
    int n;                 /* regimes, 1 to 32 */
    const double *regimes; /* 4 n numbers, of each: T gamma/A where it begins, as the one before
                            * ends, the first at 0, and where it ends, N/mm^2, of the last one
                            * infinity for nowhere; constant, ug/(m mm^2), and slope, ug/(m N),
                            * of its wear rate */
    double density;        /* of what is worn, kg/m^3 */
} faststrip_wear_law;

/* Wear and fatigue of the last contact. figures becomes T gamma = |fx cksi| + |fy ceta|, that with
 * |mz cphi| (N), the first over the area (N/mm^2); the surface-fatigue index,
 * sqrt(fx^2 + fy^2)/load - 2 area yield_shear/(3 load), with the yield stress in cyclic shear, MPa,
 * 0 where that is 0, not known; wear by the law in ug and in mm^3 per metre rolled, 0 where it is
 * null. A law needs the forces of strips, of FASTSTRIP and FASTSTRIP_PLAIN, and is refused of other
 * methods (100); one that ends below the T gamma/A of a strip is rejected (109). With an error all
 * figures are zero. */
int faststrip_get_wear(faststrip_workspace *workspace, const faststrip_wear_law *law,
                       double yield_shear, double figures[6]);

/* The same of each strip, in the order of faststrip_get_strips: forces on the rail, N, friction
 * power over rolling speed, N, over the area of the strip, N/mm^2; wear by the law, ug per metre
 * rolled, and the depth it leaves when rolled over once, mm (of a wheel 1e6/(2 pi radius) times as
 * much a kilometre), zero where the law is null. FASTSTRIP and FASTSTRIP_PLAIN only (100). */
int faststrip_get_strip_wear(faststrip_workspace *workspace, const faststrip_wear_law *law,
                             int capacity, int *n, double *fx, double *fy, double *friction_power,
                             double *t_gamma_per_area, double *wear, double *pass_depth);

/* Temperatures of the last contact: figures becomes the largest rise by the heat of friction, K,
 * the largest temperature of the surfaces in contact, C, and its place, x and y, mm. Refused (100)
 * but of a contact with with_temperatures. */
int faststrip_get_flash(faststrip_workspace *workspace, double figures[4]);

/* Temperatures of wheel and rail, C, at n places x, y, mm: in the contact, where both are one,
 * behind it, ahead of it and beside it. Errors as faststrip_get_flash. */
int faststrip_get_temperatures(faststrip_workspace *workspace, int n, const double *x,
                               const double *y, double *wheel, double *rail);

/* FASTSIM on an ellipse with semi-axes a along x and b along y, mm; g is the combined shear
 * modulus, MPa; c11, c22, c23 are Kalker's coefficients; nx points in each of ny rows. forces
 * becomes Fx, Fy (N), Mz (N mm). */
int faststrip_fastsim(double a, double b, double g, double c11, double c22, double c23, double cksi,
                      double ceta, double cphi, double mu, double load, int nx, int ny,
                      double forces[3]);

/* Hertz's contact of the gap inv2r_x x^2 + inv2r_y y^2. figures becomes a, b, penetration (mm),
 * pmax (MPa). */
int faststrip_hertz(double e_wheel, double e_rail, double nu_wheel, double nu_rail, double inv2r_x,
                    double inv2r_y, double load, double figures[4]);

/* Kalker's coefficients C11, C22, C23, C33 for any a/b; nu is the combined Poisson's ratio. */
int faststrip_kalker(double a_over_b, double nu, double coefficients[4]);

/* The gap of a wheel on a rail, both given by points along the curve, y to the field side, z down,
 * mm, of the wheel from the nominal rolling circle. What cannot be touched, overhanging and upright
 * sides, is left out. setup: distance of the flange backs (0: as belongs to the gauge), flange back
 * to that circle, rolling radius, gauge, its depth below the crown, rail inclination (below), shift
 * of the wheelset to the right, spacing of the gap and its largest height (mm but for the
 * inclination; 1360, 70, 460, 1435, 14, 0, 0, 0.05, 0.6 for standard gauge and a rail as in the
 * track). *n becomes the points of the gap, with 110 those that capacity lacks. contact becomes the
 * contact angle (rad), the rolling radius there, y on the wheel and on the rail (mm), and how many
 * points of the wheel and of the rail were left out. */
int faststrip_profile_gap(int n_wheel, const double *y_wheel, const double *z_wheel, int n_rail,
                          const double *y_rail, const double *z_rail, const double setup[9],
                          int capacity, int *n, double *y, double *h, double *inv2r,
                          double *inclination, double contact[6]);

/* A wheelset on a track: from its position and velocity to the forces of every contact. x ahead, y
 * to the right, z down, in the track, in the wheelset and in the contacts of both sides, which are
 * turned about x by their contact angle. A wheelset has the rules of a workspace: one thread at a
 * time, freed ones are rejected, faststrip_wheelset_new allocates, solutions do not. The setup's
 * size stands for all structs of wheelsets. */

/* The rail inclination is the tangent of the angle by which a rail leans to the track's centre:
 * 0.025 for 1:40, 0 for points that lie as in the track. This stands where none was said: rails by
 * name are then inclined by 1:40, of rails by points it is an error, FASTSTRIP_BAD_ARGUMENT. */
#define FASTSTRIP_INCLINATION_UNSET 999.0

/* Dimensions, mm. Fill it in with faststrip_default_wheelset first. A wheelset and a track that do
 * not fit, as the gauge 1435 and flange backs 1440 apart, are refused by name. */
typedef struct faststrip_wheelset_setup {
    size_t size;          /* of this struct; set by faststrip_default_wheelset */
    double radius_right;  /* nominal radius, at y = 0 of the wheel's profile */
    double radius_left;   /* the same of the left wheel */
    double back_spacing;  /* distance of the flange backs; 0: that which belongs to the gauge, 1360
                           * to 1435, 1440 to 1520 */
    double tread_line;    /* flange back to nominal rolling circle */
    double gauge;         /* distance of the gauge faces */
    double gauge_depth;   /* below the crown, where it is measured */
    double rail_distance; /* distance of the origins of the rails' profiles, not the gauge; 0: the
                           * gauge */
    double inclination;   /* of both rails */
    double roller_radius; /* of rollers in the rails' place, on one axis along y, at z = 0 of the
                           * track, the crown where the gauge counts; the state's speed is that of
                           * their surface there; 0: rails */
    double damping;       /* of contacts, s/mm: forces grow by this share of the approach rate, but
                           * never pull; that of Hunt and Crossley, 3/2 alpha; 0: none */
    double speed_floor;   /* of rolling speeds, mm/s: well below it friction grows with the slip
                           * velocities, so that it vanishes at rest; 0: none */
    double rail_stiffness_y; /* of springs below each rail, N/mm, 0: rigid: a rail without mass is
                           * displaced, beside where the state has it, by the force over it */
    double rail_stiffness_z; /* the same, down */
} faststrip_wheelset_setup;

/* A profile, also of a left wheel or rail as one of the right side: a name, of wheels s1002, cone20
 * (1:20), cone40, of rails uic60, 60e1, 54e1; or n points along the curve, y to the field side, z
 * down, mm, of the wheel from the nominal rolling circle, as faststrip_read_profile reads them from
 * a file. Names may have capital letters. A left one of neither is as the right one. */
typedef struct faststrip_profile {
    const char *name; /* null: by points */
    const double *y;  /* of the points, to the field side, mm */
    const double *z;  /* down, mm */
    int n;            /* number of points */
} faststrip_profile;

/* The gap of a right wheel on a right rail as faststrip_profile_gap gives it, of profiles by name,
 * too. text, if not null, says what is wrong. */
int faststrip_pair_gap(const faststrip_profile *wheel, const faststrip_profile *rail,
                       const double setup[9], int capacity, int *n, double *y, double *h,
                       double *inv2r, double *inclination, double contact[6], char *text,
                       size_t length);

/* The same on a roller in the rail's place: roller_radius, mm, is that at the crown; 0: a rail.
 * The spin of a contact on it is larger by the rolling radius over that of the roller. */
int faststrip_roller_gap(const faststrip_profile *wheel, const faststrip_profile *rail,
                         const double setup[9], double roller_radius, int capacity, int *n,
                         double *y, double *h, double *inv2r, double *inclination,
                         double contact[6], char *text, size_t length);

/* How a profile is read from a file, and what is done to its points then, in the order of the
 * members; nothing is repaired unasked. Fill it in with faststrip_default_reading first. */
typedef struct faststrip_reading {
    size_t size;          /* of this struct as the caller knows it */
    int kind;             /* 1: of a wheel, 2: of a rail, 0: the file or its name says it */
    int section;          /* which one of a file with several, from 1 on; 0: the only one */
    int side;             /* of a file with both sides 1: right, -1: left */
    int y_sense;          /* of y in the file, 1: to the field side, -1: to the gauge, 0: as its
                           * format has it */
    int z_sense;          /* of z in the file, 1: down, -1: up, 0: as its format has it */
    int any_count;        /* take a number of points that the header denies? */
    int ignore_smoothing; /* pass over the smoothing that a file asks for? */
    int has_tape_circle;  /* does tape_circle count? */
    int keeps;            /* does keep count? */
    int drops_folds;      /* drop points in which the profile turns back? */
    int mirrors;          /* mirror y? */
    int rounds_kinks;     /* smooth and resample over kinks? */
    double unit;          /* mm to a unit of the file; 0: as the file or its format has it */
    double tape_circle;   /* of a wheel: where it is, in y of the file, mm */
    double keep[2];       /* range of y of the points that are kept, mm */
    double drop_double;   /* drop points no farther from the one before, mm; below 0: none */
    double shift[2];      /* along y and z, mm */
    double turn;          /* about the origin, from y to z, rad; of a cant: -atan(cant) */
    double smooth_wavelength; /* halve waves of this length, remove shorter ones, mm; 0: none */
    double smooth_noise;  /* smooth for this standard deviation of the points, mm; 0: none */
    double resample;      /* points at this distance along the profile, mm; 0: those there are */
    double kink_angle;    /* what turns by more in one point is a kink, rad */
} faststrip_reading;

/* What a file says of its profile, and measures of a wheel's flange by EN 15313, on the points. */
typedef struct faststrip_profile_about {
    int kind;        /* 1: of a wheel, 2: of a rail, 0: not known */
    int has_flange;  /* are the next three known? */
    double sd;       /* thickness, mm */
    double sh;       /* height, mm */
    double qr;       /* steepness, mm */
    char format[16]; /* simpack, miniprof, vampire, gensys, text, csv; miniprof mpt */
} faststrip_profile_about;

/* Nothing is said about the file, nothing is done. length is sizeof reading. */
int faststrip_default_reading(faststrip_reading *reading, size_t length);

/* Read a profile of any format that `faststrip profile` knows: y to the field side, z down, mm, of
 * a wheel from the nominal rolling circle, in the order of a faststrip_profile. path is the file's
 * name, reading and about may be null, capacity is the length of y and z; *n becomes the points of
 * the profile, even if these are more (110). text, if not null, says what is wrong, with file, line
 * and value, or what was left out or done. This function reads a file, and allocates. */
int faststrip_read_profile(const char *path, const faststrip_reading *reading, int capacity, int *n,
                           double *y, double *z, faststrip_profile_about *about, char *text,
                           size_t length);

/* n points, at least two, of what can be touched of a profile, at equal distances of y: y to the
 * field side, z down, mm, of a rail with its inclination. */
int faststrip_draw_profile(const faststrip_profile *profile, int is_rail, double inclination, int n,
                           double *y, double *z, char *text, size_t length);

/* How a rail lies and moves beside its place, as irregularities of the track have it. */
typedef struct faststrip_rail_state {
    double y;         /* to the right, mm */
    double z;         /* down, mm */
    double roll;      /* right side down, about the origin of its profile, rad */
    double y_rate;    /* mm/s */
    double z_rate;    /* mm/s */
    double roll_rate; /* rad/s */
} faststrip_rail_state;

/* A pitch rate of 0: wheels that do not turn. */
#define FASTSTRIP_LOCKED_WHEELS 1e300

/* Position and velocity of a wheelset, and of the rails below it; all zero: in the middle, at rest.
 * Where nothing rolls but something slides all of the contact slides; where nothing moves there are
 * no friction forces. */
typedef struct faststrip_wheelset_state {
    double y;          /* lateral displacement, mm */
    double z;          /* vertical displacement of the centre, down, mm; where it is prescribed. 0
                        * where the rolling circles are as high as the crowns of the rails, which is
                        * not where the wheelset rests: FASTSTRIP_AT_REST gives that */
    double roll;       /* right wheel down, rad; where it is not free */
    double yaw;        /* nose to the right, rad */
    double speed;      /* along the track, mm/s; below 0 it rolls backwards */
    double y_rate;     /* mm/s */
    double z_rate;     /* mm/s */
    double roll_rate;  /* rad/s */
    double yaw_rate;   /* relative to the track, rad/s */
    double pitch_rate; /* about the axle, negative for rolling ahead, rad/s; 0, so left out, is pure
                        * rolling at the mean nominal radius: for wheels that do not turn say
                        * FASTSTRIP_LOCKED_WHEELS */
    double curvature;  /* of the track, positive to the right, 1/mm */
    faststrip_rail_state rail[2]; /* right, left */
    double pitch_rate_difference; /* of wheels that rotate independently: left less right, rad/s;
                                   * pitch_rate is the mean of both */
} faststrip_wheelset_state;

/* What a wheelset's height and roll follow from. */
enum faststrip_demand {
    FASTSTRIP_BY_POSITION = 0, /* z and roll are those of the state */
    FASTSTRIP_BY_LOADS = 1,    /* each wheel has a vertical force, and a z of its own unless the
                                * roll is free */
    FASTSTRIP_BY_AXLE_LOAD = 2, /* both wheels carry the axle load together; z is found */
    FASTSTRIP_AT_REST = 3      /* the same with z and roll at static equilibrium: rates and speed of
                                * the state do not count, and there are no friction forces */
};

/* Which wheels are solved; which one a contact is of. */
enum faststrip_wheels {
    FASTSTRIP_BOTH_WHEELS = 0, /* of a demand only */
    FASTSTRIP_RIGHT_WHEEL = 1, /* in y > 0 */
    FASTSTRIP_LEFT_WHEEL = 2   /* in y < 0 */
};

/* What is prescribed. */
typedef struct faststrip_wheelset_demand {
    int kind;           /* enum faststrip_demand */
    int wheels;         /* enum faststrip_wheels */
    int roll_is_free;   /* 1: the roll is found; of both wheels and their loads only */
    int warm_start;     /* 1: start from the last solution, if there is one, which is faster; the
                         * last digits then depend on it */
    double load_right;  /* vertical force of the right wheel, N */
    double load_left;   /* of the left wheel, N */
    double axle_load;   /* N */
    double roll_moment; /* about the wheelset's centre along the track, that the frame exerts on it;
                         * with an axle load and a free roll, N mm */
    double axle_moment; /* about the axle, that a drive or brake exerts on the wheelset and the
                         * wheels asked for carry together; negative drives ahead, N mm */
    int axle_moment_is_given; /* 1: the pitch rate is found, and must be 0 in the state; 0: it is
                               * that of the state */
} faststrip_wheelset_demand;

/* Contacts of both wheels at most. */
#define FASTSTRIP_MOST_CONTACTS 16

/* One contact. Forces and moments act on the rail. */
typedef struct faststrip_wheelset_contact {
    int side;              /* FASTSTRIP_RIGHT_WHEEL or FASTSTRIP_LEFT_WHEEL */
    int status;            /* of its solution, a named limitation or 0 */
    int n_patches;         /* these four as in faststrip_result */
    int strips_across;
    int is_estimated;
    int forces_are_estimated;
    double place[3];       /* of the reference point in the track, mm */
    double angle;          /* contact angle, rad */
    double rail[2];        /* y, z of it on the rail's profile, mm */
    double wheel[3];       /* x, y, z of it in the frame of the wheel's profile, mm */
    double radius;         /* rolling radius, mm */
    double speed;          /* rolling speed, mm/s */
    double cksi;           /* longitudinal creepage, from rigid-body kinematics */
    double ceta;           /* lateral creepage */
    double cphi;           /* spin, rad/mm */
    double load;           /* normal force, N */
    double penetration;    /* mm */
    double area;           /* contact area, mm^2 */
    double pmax;           /* maximum pressure, MPa */
    double y_min;          /* ends of the contact from the reference point, mm */
    double y_max;
    double x_max;          /* largest half-length along x, mm */
    double fx;             /* longitudinal force, N */
    double fy;             /* in the tangent plane, to the right, N */
    double mz;             /* about the normal, N mm */
    double friction_power; /* frictional work per distance rolled, N */
    double stick_fraction; /* share of the area in adhesion */
    double force[3];       /* in the track, N */
    double force_wheelset[3]; /* the same in the wheelset's frame, N */
    double moment[3];      /* about the wheelset's centre, in the track, N mm */
    double est_err_penetration; /* these six as in faststrip_result */
    double est_err_pmax;
    double est_err_area;
    double est_err_fx;
    double est_err_fy;
    double est_err_mz;
    double est_err_load;   /* by how much profiles that are .5 um wrong may move the load, over it;
                            * in proportion for others. One contact under a given load: 0 */
    int limitations;       /* these three as in faststrip_result */
    int n_strips;
    int n_elements;
} faststrip_wheelset_contact;

/* What the contacts of each wheel come to, right and left; zero for one that was not asked for. */
typedef struct faststrip_wheelset_result {
    int status[2];     /* the worst of its contacts */
    int n_contacts[2]; /* number of contacts */
    int n_solutions[2]; /* contact problems that were solved */
    double z[2];       /* of the wheelset's centre, mm */
    double roll;       /* rad */
    double force[2][3]; /* on the rail, in the track, N */
    double force_wheelset[2][3]; /* the same in the wheelset's frame, N */
    double moment[2][3]; /* about the wheelset's centre, in the track, N mm */
    double pitch_rate; /* as given, of pure rolling, or found, rad/s */
} faststrip_wheelset_result;

/* Profiles, memory and last solution of a wheelset. From faststrip_wheelset_new. */
typedef struct faststrip_wheelset faststrip_wheelset;

/* Standard gauge, wheels of 460 mm, FASTSTRIP_INCLINATION_UNSET. length is sizeof setup. */
int faststrip_default_wheelset(faststrip_wheelset_setup *setup, size_t length);

/* Make a wheelset of its profiles, right and left; of the case material, friction, methods,
 * estimates, what auto is to know, and with_elements count. With FASTSTRIP_NORMAL_AUTO strips find
 * the height, and the load is corrected until what auto takes carries it to 1e-4. *wheelset is null
 * when there is an error; text, if not null, says why. */
int faststrip_wheelset_new(const faststrip_wheelset_setup *setup,
                           const faststrip_profile wheels[2], const faststrip_profile rails[2],
                           const faststrip_case *contact, faststrip_wheelset **wheelset,
                           char *text, size_t length);

/* Free a wheelset, as faststrip_free. */
int faststrip_wheelset_free(faststrip_wheelset **wheelset);

/* Copy a wheelset with its last solution into another one that was made, for a step that may be
 * taken back. */
int faststrip_wheelset_copy(const faststrip_wheelset *from, faststrip_wheelset *to);

/* What the next solution depends on, as bytes that outlive the program: a wheelset that was made
 * alike takes them over, also elsewhere, and solves on with the bits of the one that was saved. Of
 * the last solution nothing can be asked afterwards; what the caller sets is not among them. *n
 * becomes the number of bytes, also with 110 where capacity is less: 0 asks for it. Bytes that are
 * cut, damaged, of another version, order of bytes or wheelset are refused (121). */
int faststrip_wheelset_save(faststrip_wheelset *wheelset, size_t capacity, size_t *n, void *bytes);
int faststrip_wheelset_restore(faststrip_wheelset *wheelset, size_t n, const void *bytes);

/* Solve the contacts, those of the right wheel first. *n becomes their number, with 110 those that
 * capacity lacks; FASTSTRIP_MOST_CONTACTS are enough. A limitation of any contact is the status. A
 * wheelset that is lifted off both rails, by its position, has no contacts and status 0. */
int faststrip_wheelset_solve(faststrip_wheelset *wheelset, const faststrip_wheelset_state *state,
                             const faststrip_wheelset_demand *demand, int capacity, int *n,
                             faststrip_wheelset_contact *contacts,
                             faststrip_wheelset_result *result);

/* Derivatives at the last solution: derivatives[wheel][i][j], right wheel first, is that of Fx, Fy,
 * Fz (N), Mx, My, Mz (N mm), as `force` and `moment` of the result, over y, z (mm), roll, yaw
 * (rad), y_rate, z_rate (mm/s), roll_rate, yaw_rate, pitch_rate (rad/s); all other things stay,
 * also where the height was found for a load. A pitch rate that was left out stays that of pure
 * rolling. Zeros of a wheel that was not asked for or is in the air, and over the rates at rest
 * without a floor of the speed. Errors as faststrip_get_derivatives; with 108 those of the wheel
 * whose patches come or go are NaN, those of the other one are there. */
int faststrip_wheelset_get_derivatives(faststrip_wheelset *wheelset,
                                       double derivatives[2][6][9]);

/* Strips, elements, wear and fatigue of a contact of the last solution, contacts[i], as
 * faststrip_get_strips, faststrip_get_elements, faststrip_get_wear and faststrip_get_strip_wear
 * have them; x and y from its reference point, in its tangent plane, ahead and to the right. */
int faststrip_wheelset_get_strips(faststrip_wheelset *wheelset, int i, int capacity, int *n,
                                  double *y_left, double *y_right, double *half_length, double *p0,
                                  int *patch);
int faststrip_wheelset_get_elements(faststrip_wheelset *wheelset, int i, int capacity, int *n,
                                    double *x, double *y, double *area, double *pn, double *px,
                                    double *py, double *sx, double *sy, int *state);
int faststrip_wheelset_get_wear(faststrip_wheelset *wheelset, int i, const faststrip_wear_law *law,
                                double yield_shear, double figures[6]);
int faststrip_wheelset_get_strip_wear(faststrip_wheelset *wheelset, int i,
                                      const faststrip_wear_law *law, int capacity, int *n,
                                      double *fx, double *fy, double *friction_power,
                                      double *t_gamma_per_area, double *wear, double *pass_depth);

/* Temperatures of a contact of the last solution, contacts[i], as faststrip_get_flash and
 * faststrip_get_temperatures have them, in the frame of faststrip_wheelset_get_elements. */
int faststrip_wheelset_get_flash(faststrip_wheelset *wheelset, int i, double figures[4]);
int faststrip_wheelset_get_temperatures(faststrip_wheelset *wheelset, int i, int n,
                                        const double *x, const double *y, double *wheel,
                                        double *rail);

/* The gap of contacts[i] of the last solution about its place, for faststrip_set_gap: capacity is
 * the length of the arrays; *n becomes the points of the gap, even if these are more (110). */
int faststrip_wheelset_get_gap(faststrip_wheelset *wheelset, int i, int capacity, int *n, double *y,
                               double *h, double *inv2r, double *inclination);

/* Contact geometry functions of a wheelset over n lateral shifts to the right, mm: each wheel comes
 * down on its rail by itself, as EN 15302:2008+A1:2010 has it, or, if with_roll, the wheelset rolls
 * until both touch. functions becomes 10 n numbers, of each shift: rolling radius difference, right
 * less left, rolling radius of the right and left wheel (mm), contact angle of both, roll (rad), y
 * of the contact on the right wheel and rail, and on the left ones in their mirror (mm). states
 * becomes the status of each shift, FASTSTRIP_NO_CONTACT with zeros where a wheel leaves its rail;
 * the call has that status if there is no contact at all. text, if not null, says what is wrong. */
int faststrip_contact_functions(const faststrip_wheelset_setup *setup,
                                const faststrip_profile wheels[2],
                                const faststrip_profile rails[2], int with_roll, int n,
                                const double *y, double *functions, int *states, char *text,
                                size_t length);

/* Equivalent conicity by EN 15302:2008+A1:2010 over m amplitudes, mm, from a rolling radius
 * difference, of the side to which y points less that of the other, at n rising shifts y, mm.
 * equilibrium becomes the place nearest to y = 0 where delta_r passes through zero, about which the
 * amplitudes are meant, and the largest amplitude that the table holds. conicities becomes 6 m
 * numbers, of each amplitude: tan gamma_e by Klingel's equation (Annex B) and by linear regression
 * (Annex C), both turning points, mm, and the nonlinearity of both, 1/mm. states becomes two
 * numbers of each: its status, with zeros where it is an error (100, no amplitude; 109, beyond the
 * table); 1, the nonlinearity is known. With FASTSTRIP_NO_WAVE delta_r falls through zero and no
 * motion turns: Klingel's is 0, and instead of turning points there are the ends of the straight
 * line; its conicity is below 0 where the wheelset leaves the equilibrium. */
int faststrip_conicity(int n, const double *y, const double *delta_r, int m,
                       const double *amplitudes, double equilibrium[2], double *conicities,
                       int *states, char *text, size_t length);

/* What the wheelset's last call had to say; empty when all was well. */
int faststrip_wheelset_last_message(const faststrip_wheelset *wheelset, char *text,
                                    size_t length);

/* A table of creep forces on Hertz ellipses, made by `faststrip lookup make`, or of the contacts of
 * a wheel on a rail, made by `faststrip lookup wheel`. It is not changed by looking up: all threads
 * may share one. */
typedef struct faststrip_lookup faststrip_lookup;

/* How a table is interpolated. */
enum faststrip_lookup_order {
    FASTSTRIP_LINEAR = 1, /* between its nodes, with kinks there */
    FASTSTRIP_CUBIC = 3   /* by cubic polynomials, smooth and mostly more accurate */
};

/* Open a table from the bytes of its file, which are copied and may go. What is damaged, cut or of
 * another version is rejected (121), in words too if text is not null. This allocates,
 * faststrip_lookup_free frees; a null table is left alone. */
int faststrip_lookup_open(const void *bytes, size_t length, faststrip_lookup **lookup, char *text,
                          size_t text_length);
int faststrip_lookup_free(faststrip_lookup **lookup);

/* 23 numbers about a table of ellipses (of a wheel: 100): Poisson's ratio; the 99th percentile of
 * the errors that it was made for; fresh contacts that it was judged by; least and most a/b; mean
 * of the errors of Fx, Fy (over mu N) and Mz (over mu N c) by linear interpolation, their 99th
 * percentiles, the worst; the same nine by cubic interpolation. */
int faststrip_lookup_about(const faststrip_lookup *lookup, double numbers[23]);

/* Look forces up, for Coulomb friction and like materials. states has eight numbers of each of n
 * states: semi-axes a (along the rolling direction) and b, mm, load, N, mu, shear modulus, MPa,
 * cksi, ceta, cphi (rad/mm). forces becomes fx, fy, N, mz, N mm, of each, about the middle of the
 * ellipse. jacobians, if not null, becomes 24 numbers of each: number 3 j + i is the derivative of
 * force i by number j of the state, from 0. Creepages may be of any size: the table ends where all
 * slides. a/b must be within the table (109). states' status goes to codes, if not null; one that
 * fails has zeros (a number that is not finite 101, a load not above 0 105, others not above 0
 * 100), the others go on, and the call has the status of the first. Nothing is allocated. */
int faststrip_lookup_forces(const faststrip_lookup *lookup, enum faststrip_lookup_order order,
                            int n, const double *states, double *forces, double *jacobians,
                            int *codes);

/* 60 numbers about the table of a wheel (of ellipses: 100): Poisson's ratio, shear modulus, MPa;
 * the 99th percentile of the errors that it was made for; fresh states that it was judged by, all,
 * and such in cells where contacts come or go; number of slots, contacts that there can be; first
 * and last y, mm, yaw, rad, and load, N; mean of the errors of Fx, Fy (over mu N), Mz (over mu N c)
 * and of the lateral part of the normal forces (over N) by linear interpolation, their 99th
 * percentiles, the worst; the same twelve by cubic interpolation; all these of states where
 * contacts come or go. */
int faststrip_lookup_wheel_about(const faststrip_lookup *lookup, double numbers[60]);

/* Errors of z, which the promise of a table covers, each as the load that it makes by Hertz' law
 * over the load: mean, 99th percentile, worst, by linear, then by cubic interpolation, of all fresh
 * states, then of those where contacts come or go. A table of an older version does not know them
 * (121). */
int faststrip_lookup_wheel_z_errors(const faststrip_lookup *lookup, double errors[12]);

/* Let the table of a wheel answer for a wheelset: for each wheel whose y, yaw and load are within
 * it, and that rolls by no more than 5e-4 rad over its rail, with n_solutions 0, its contacts,
 * forces and moments come from the table; strips solve the others, as without it. Both wheels and
 * rails must be alike, friction constant, and the table that of this wheel and rail and material,
 * which three of its nodes are solved for (100). It stays open: once it is freed, calls of the
 * wheelset fail (100). null: strips alone again. Contacts have load, penetration, area and pressure
 * but no ends, strips or estimates; derivatives are refused (100). */
int faststrip_wheelset_use_lookup(faststrip_wheelset *wheelset, const faststrip_lookup *lookup,
                                  enum faststrip_lookup_order order);

/* Look the contacts of a wheel up. places has three numbers of each of n places: y of the wheelset,
 * mm, yaw, rad, vertical part of the normal forces, N. contacts becomes 14 numbers of each slot, of
 * each place: normal force, N; contact angle, rad; y, z on the rail's profile, mm; x in the track,
 * mm; y on the wheel's profile, mm; rolling radius, mm; z of the wheelset, mm; area, mm2; largest
 * pressure, MPa; length c of the moment, mm; L1, L2, mm2, L3, mm3, which times G/(mu N) normalise
 * the creepages. A slot is the same contact at all places; all of it is 0 where there is none.
 * slopes, if not null, becomes their derivatives by y, by yaw, by load: 14 numbers of each slot,
 * three times, of each place. Places beyond the table, also another yaw than that of a table that
 * has one: 109. codes as of faststrip_lookup_forces. Nothing is allocated. */
int faststrip_lookup_wheel_contacts(const faststrip_lookup *lookup,
                                    enum faststrip_lookup_order order, int n,
                                    const double *places, double *contacts, double *slopes,
                                    int *codes);

/* Look the creep forces of a contact up. slots has which one, from 1, of each of n states; states
 * seven numbers of each: y, yaw, load as of a place, mu, cksi, ceta, cphi (rad/mm) in the frame of
 * the contact. forces becomes fx, fy, N, mz, N mm, of each; 0 where there is no contact. jacobians,
 * if not null, becomes 21 numbers of each, codes their status, as of faststrip_lookup_forces. */
int faststrip_lookup_wheel_forces(const faststrip_lookup *lookup,
                                  enum faststrip_lookup_order order, int n, const int *slots,
                                  const double *states, double *forces, double *jacobians,
                                  int *codes);

#ifdef __cplusplus
}
#endif

#endif
