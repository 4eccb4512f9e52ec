#ifndef GB_PACK_KERNEL_BED_BATCH_H
#define GB_PACK_KERNEL_BED_BATCH_H

#include <stdbool.h>
#include <stdint.h>

#include "greenbody/status.h"
#include "law/law_storakers.h"

/* Contact law of a bed: Hertz-Mindlin-Deresiewicz or Storakers, P3 (1)-(22),
 * the same law between particles and against walls, with its own friction there. */
struct gb_bed_law {
    bool storakers;
    struct gb_law_storakers normal; /* without storakers only normal.hertz is set */
    double shear;                   /* k_t over k_n */
    double damping;                 /* xi, share of critical */
    double mu, mu_wall;
};

/* Contacts that touch or nearly do, structure of arrays: constants of the two radii,
 * history, and the normal force of the last evaluation. */
struct gb_bed_contacts {
    int64_t room;
    double *slab;
    double *hertz;        /* (4/3) E* sqrt R*: force over h^1.5 */
    double *damping;      /* 2 xi sqrt m*: dashpot over the root of the stiffness */
    double *inverse_mass; /* one over the reduced mass m* */
    double *transition;   /* overlap at which Storakers' law becomes plastic */
    double *deepest, *permanent; /* h_max, and h0 where unloading ends; Storakers only */
    double *shear
        [3]; /* force on the first body, in the tangent plane of the last evaluation */
    double *normal; /* f_n of the last evaluation; -1: not touching */
};

enum { GB_BED_HISTORY = 5 }; /* arrays that are history, deepest to shear */

bool gb_bed_batch_init(struct gb_bed_contacts *contacts, int64_t room,
                       struct gb_error *err);

void gb_bed_batch_finish(struct gb_bed_contacts *contacts);

/* Radius of a contact that is loaded to this overlap, at effective radius R*: Hertz'
 * a^2 = R* h or gb_law_storakers_contact. */
double gb_bed_batch_radius(const struct gb_bed_law *law, double star, double overlap);

/* Constants of slot for a pair of radii and masses (INFINITY: a wall), no history. */
void gb_bed_batch_set(struct gb_bed_contacts *contacts, int64_t slot,
                      const struct gb_bed_law *law, const double radius[2],
                      const double mass[2]);

enum { GB_BED_BATCH = 64 };

/* Inputs and outputs of the laws for a batch of contacts. */
struct gb_bed_batch {
    int n;
    double step; /* time since the last evaluation, for the shear increments */
    double mu;
    /* branch vector x_i - x_j and R_i + R_j, from which those of the next line come */
    _Alignas(64) double branch[3][GB_BED_BATCH];
    double reach[GB_BED_BATCH];
    /* in: normal, overlap h, and distance of the contact point from the centres over R */
    double unit[3][GB_BED_BATCH], overlap[GB_BED_BATCH], lever[GB_BED_BATCH];
    double slip[3][GB_BED_BATCH]; /* in: v_i - v_j of the centres */
    double held[GB_BED_BATCH];    /* in: stiffness over mass, summed over both partners */
    double holds[GB_BED_BATCH];   /* out: stiffness that it adds to either */
    double roll[3][GB_BED_BATCH]; /* in, friction: sum of both rolls */
    /* out: force on i; moment on either */
    double force[3][GB_BED_BATCH], moment[3][GB_BED_BATCH];
    /* from loop to loop: h/h_x, the binary logarithm of the elastic part over h_x, and that
     * part; normal force, its stiffness and the rate of the overlap; of the shear springs
     * what they become longer by, their squares before and after they were rotated, and a
     * factor */
    double ratio[GB_BED_BATCH], logarithm[GB_BED_BATCH], loaded[GB_BED_BATCH];
    double along[GB_BED_BATCH], stiffness[GB_BED_BATCH], approach[GB_BED_BATCH];
    double rate[3][GB_BED_BATCH], square[2][GB_BED_BATCH], kept[GB_BED_BATCH];
    double stiffest, impact; /* those of gb_bed_tally so far; in and out */
};

/* Advances contacts [slot, slot + batch->n) to the present and fills the outputs. */
typedef void gb_bed_kernel(const struct gb_bed_law *law, struct gb_bed_batch *batch,
                           struct gb_bed_contacts *contacts, int64_t slot);

enum gb_bed_partner { GB_BED_PARTNER_PARTICLE, GB_BED_PARTNER_WALL };

/* The variant for a law, a kind of contact and this processor; it computes only the
 * terms of that law.  widest: 0 picks by processor; 128, 256 or 512 limits the vectors
 * (tests). */
gb_bed_kernel *gb_bed_batch_pick(const struct gb_bed_law *law,
                                 enum gb_bed_partner partner, int widest);

/* Rows of four doubles of the particles, so that a vector is one load. */
typedef double gb_bed_row[4];

/* The partners of a batch: rows first[k] and other[k] + from of contact k.  Without friction
 * neither roll nor moment is used.  Gather: branch vectors, relative velocities and sums
 * of radii into the batch; of pairs normals, overlaps and levers instead of branch vectors and
 * sums of radii.  Scatter: forces and moments back.  A wall is a row as well, at the origin
 * without radius, so that `branch` and `reach` are those of the particle. */
struct gb_bed_rows {
    const gb_bed_row *position, *velocity, *roll;
    gb_bed_row *force, *moment;
    const int32_t *first, *other;
    const int32_t *target; /* row that the force on the second is added to */
    int32_t from;          /* 0 for pairs */
    bool friction;
};
typedef void gb_bed_gather(const struct gb_bed_rows *rows, struct gb_bed_batch *batch);
typedef void gb_bed_scatter(const struct gb_bed_rows *rows,
                            const struct gb_bed_batch *batch);

/* The variant for this processor, widest as above; all give the same bits. */
struct gb_bed_transfer {
    gb_bed_gather *gather, *gather_pairs;
    gb_bed_scatter *scatter;
};
struct gb_bed_transfer gb_bed_transfer_pick(int widest);

/* Steady motion that began at `from` a time ago. */
struct gb_bed_motion_course {
    const gb_bed_row *from, *velocity;
    double time;
};

/* Central differences of positions x: x += step v.  Returns the sum of the squares of the
 * largest components of the new distance from a course, a bound of its squares that needs no
 * square of every particle. */
double gb_bed_batch_drift(gb_bed_row *x, const gb_bed_row *v, int64_t count, double step,
                          const struct gb_bed_motion_course *course);

/* What changes velocities and rolls (pack/die/bed.h). */
struct gb_bed_batch_kick {
    const gb_bed_row *force, *moment;
    const double *inverse_mass;
    double inertia; /* over m R^2 */
    double step;
    double gravity; /* along -z */
    double drag;    /* speed lost per time */
};

/* v += step force/m and roll += step moment/(m inertia).  Returns a bound of the
 * speed of the fastest particle, from the largest components. */
double gb_bed_batch_kick(gb_bed_row *v, gb_bed_row *roll, int64_t count,
                         const struct gb_bed_batch_kick *by);

/* to[particle[e]] += from[number[e]] for e below count, in that order; no row of `from` is one
 * of `to`. */
void gb_bed_batch_add_rows(gb_bed_row *to, const int32_t *particle,
                           const gb_bed_row *from, const int32_t *number, int64_t count);

#endif
