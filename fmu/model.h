/* A wheelset as a functional mock-up unit has it: variables by number, on the C interface. What
 * belongs to one version of FMI is in fmi2.c and fmi3.c, to both in both.h; the table of the
 * variables, `variables.h`, is written by tools/building/fmu.py. */
#ifndef MODEL_H
#define MODEL_H

#include <faststrip.h>

/* As both versions of FMI number them. */
enum { STATUS_OK, STATUS_WARNING, STATUS_DISCARD, STATUS_ERROR };

/* A COUNT is an int that is read as a real: in model exchange an integer may change at events only.
 */
enum kind { REAL, COUNT, INTEGER, BOOLEAN, STRING };
enum causality { INDEPENDENT, PARAMETER, INPUT, OUTPUT };

/* Contacts of a wheel that have variables of their own, and room for a name or path. */
enum { SHOWN = 3, PATH_LENGTH = 1024 };

/* One side: what its contacts come to, and the first of them. */
typedef struct side {
    int status;
    int n_contacts;
    double z;
    double force[3];
    double moment[3];
    faststrip_wheelset_contact contact[SHOWN];
} side;

/* All that has a variable; what a wheelset is made of from `profile` to before `demand`. */
typedef struct values {
    double time;
    int is_running; /* initialized: parameters stay */
    int is_solved;  /* do the outputs belong to the inputs? */
    char profile[4][PATH_LENGTH]; /* right and left wheel, right and left rail */
    faststrip_wheelset_setup setup;
    faststrip_case contact;
    faststrip_wheelset_demand demand;
    faststrip_wheelset_state state;
    double roll;
    side side[2];
} values;

typedef struct model {
    values now;
    faststrip_wheelset *wheelset; /* null: to be made of the parameters */
    /* Its last solution: that of the outputs, one to start from, or none. */
    enum { HERE, RESTORED, ELSEWHERE } last;
    enum { UNKNOWN, KNOWN, NONE } slopes_are;
    double slopes[2][6][9];       /* derivatives of the library at the last solution */
    int is_logging;
    char *resources;              /* folder, with a separator at its end */
    char *name;
    void *environment;            /* of the master, with its procedure for messages */
    void (*logger)(void);
} model;

/* Of fmi2.c or fmi3.c: a message for the master. */
void tell(model *m, int status, const char *text);

/* Null if the token is that of another unit or there is no memory; resources may be null. */
model *make_model(const char *name, const char *token, const char *resources);
void free_model(model *m);
void reset_model(model *m);

/* Parameters are final: make the wheelset of them. */
int start_model(model *m);

/* Solve for the inputs, unless that is done. */
int solve_model(model *m);

/* *value becomes the place of a variable of that kind, solved for if it is an output. */
int read_variable(model *m, unsigned int reference, enum kind kind, const void **value);
/* The real of a variable at its place. */
double real_at(unsigned int reference, const void *place);
int write_variable(model *m, unsigned int reference, enum kind kind, const void *value);

/* *state is made where it is null, and freed by free(). */
int keep_state(model *m, void **state);
int restore_state(model *m, const void *state);

/* The same as bytes. */
size_t state_size(const void *state);
int write_state(model *m, const void *state, void *bytes, size_t size);
int read_state(model *m, const void *bytes, size_t size, void **state);

/* Derivatives of n outputs along a direction, a seed of each of k inputs. */
int find_derivatives(model *m, const unsigned int *outputs, size_t n, const unsigned int *inputs,
                     size_t k, const double *seeds, double *derivatives);

#endif
