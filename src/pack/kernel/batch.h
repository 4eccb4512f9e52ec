#ifndef GB_PACK_KERNEL_BATCH_H
#define GB_PACK_KERNEL_BATCH_H

#include <stdbool.h>
#include <stdint.h>

#include "scene/model.h"
#include "greenbody/status.h"

/* Contact histories of the near pairs, structure of arrays, so that a batch of them runs
 * through the laws in vector registers.  In 2D (x-z plane) vectors in the plane have two
 * components (0: x, 1: z), springs and turns one.
 *
 * Members named after a quantity are the number of its array; in 2D and in scenes at rest
 * some have none. */
struct gb_contacts {
    int64_t room;
    int planes;  /* arrays in use ... */
    int kept;    /* ... of which the first ones are the history; the arms follow from the
                  * positions in a copy made right after an evaluation */
    bool single; /* of float instead of double */
    void *plane[15];
    int deepest;  /* h_min; 0: touching without a bridge; < 0: not touching */
    int shear[3]; /* delta, in the tangent plane; 2D: along (n_z, -n_x) */
    int roll[3];  /* theta_r, likewise; 2D: about y */
    int pivot;    /* theta_p, about the normal; 3D only */
    int arm[3];   /* r_ij at the last evaluation */
    /* Viscous scenes: normal force without its viscous part and stiffnesses of shear,
     * roll and pivot at the last evaluation, for the work that contacts take up. */
    int last_normal, last_shear, last_roll, last_pivot;
};

/* single: for scenes in 3D that are not viscous. */
bool gb_contacts_init(struct gb_contacts *contacts, int dimension, bool viscous,
                      bool single, int64_t room, struct gb_error *err);
void gb_contacts_finish(struct gb_contacts *contacts);
/* Marks a pair as not touching. */
void gb_contacts_clear(struct gb_contacts *contacts, int64_t slot);

/* One number of a history, whatever its precision. */
static inline double gb_contacts_value(const struct gb_contacts *contacts, int plane,
                                       int64_t slot)
{
    return contacts->single ? (double)((const float *)contacts->plane[plane])[slot]
                            : ((const double *)contacts->plane[plane])[slot];
}

static inline void gb_contacts_put(struct gb_contacts *contacts, int plane, int64_t slot,
                                   double value)
{
    if (contacts->single) {
        ((float *)contacts->plane[plane])[slot] = (float)value;
    } else {
        ((double *)contacts->plane[plane])[slot] = value;
    }
}

static inline double gb_contacts_deepest(const struct gb_contacts *contacts, int64_t slot)
{
    return gb_contacts_value(contacts, contacts->deepest, slot);
}

static inline bool gb_contacts_touch(const struct gb_contacts *contacts, int64_t slot)
{
    return gb_contacts_deepest(contacts, slot) >= 0.0;
}

/* What a sweep counts beside the forces, summed in a fixed order. */
struct gb_tally {
    int64_t contacts;  /* pairs with r < d */
    int64_t sliding;   /* of these: shear spring at its cap */
    double normal_sum; /* sum of |f_n| over contacts */
    double deepest;    /* largest overlap */
    /* dynamic scenes: */
    double absorbed;  /* work the pairs took up since the last evaluation */
    double virial[3]; /* sum of f_k r_k over pairs, axis by axis (x, y, z) */
};

enum { GB_BATCH = 128, GB_LANES = 8 };

/* A batch of pairs on its way through the laws, in double or single precision. */
#define GB_BATCH_OF(name, real)                                                            \
    struct name {                                                                          \
        int n;                                                                             \
        real cutoff2; /* squared reach of the attraction */                                \
        real damp;    /* viscous time A over time step; used by viscous scenes only */     \
        /* in: r_ij, sum and difference of the turns of i and j since the last           \
         * evaluation */ \
        _Alignas(64) real r[3][GB_BATCH];                                                  \
        real turn_sum[3][GB_BATCH], turn_difference[3][GB_BATCH];                          \
        /* out: force on i (the opposite acts on j), torques on i and on j */              \
        real force[3][GB_BATCH], torque_i[3][GB_BATCH], torque_j[3][GB_BATCH];             \
        real normal[GB_BATCH];   /* |f_n| of contacts, 0 elsewhere */                      \
        real overlap[GB_BATCH];  /* h */                                                   \
        real sliding[GB_BATCH];  /* 1: shear spring at its cap */                          \
        real absorbed[GB_BATCH]; /* work taken up in this step; viscous scenes */          \
        /* between the two halves */                                                       \
        real loose; /* how many touch without a bridge */                                  \
        real unit[3][GB_BATCH], distance[GB_BATCH], moment[GB_BATCH];                      \
        real rate[8][GB_BATCH]; /* increments of what the springs see; 7: of h */          \
    };
GB_BATCH_OF(gb_batch, double)
GB_BATCH_OF(gb_batch_f32, float)
#undef GB_BATCH_OF

/* Advances contacts [slot, slot + batch->n) and fills the outputs.
 *
 * The increment of relative motion is r minus the stored arm, so the affine motion of the
 * cell counts.  Stored vectors are turned into the current tangent plane keeping their
 * length before the increment is added.  Source: P1 (1)-(12); viscous partners P2 (3). */
struct gb_batch_kernel {
    void (*advance)(const struct gb_model *model, struct gb_batch *batch,
                    struct gb_contacts *contacts, int64_t slot);
    /* Adds a batch to a tally: lane by lane, then the lanes, whatever the vector width.
     */
    void (*tally)(struct gb_batch *batch, const struct gb_contacts *contacts,
                  int64_t slot, struct gb_tally *tally);
    /* Pairs across a gap: fills the forces.  In viscous scenes also takes and leaves
     * distances and pulls (0: none yet) and adds work and virial to the tally. */
    void (*attract)(const struct gb_model *model, struct gb_batch *batch,
                    double *last_distance, double *last_pull, struct gb_tally *tally);
};

/* The same in single precision, for scenes in 3D at rest. */
struct gb_batch_f32_kernel {
    void (*advance)(const struct gb_model *model, struct gb_batch_f32 *batch,
                    struct gb_contacts *contacts, int64_t slot);
    void (*tally)(struct gb_batch_f32 *batch, const struct gb_contacts *contacts,
                  int64_t slot, struct gb_tally *tally);
    void (*attract)(const struct gb_model *model, struct gb_batch_f32 *batch);
    /* Arms and forces on the first particles as the last `advance` left them; nothing
     * changes. */
    void (*recall)(const struct gb_model *model, struct gb_batch_f32 *batch,
                   const struct gb_contacts *contacts, int64_t slot);
};

/* The variant for this scene and this processor; no variant pays for terms it leaves out.
 * widest: 0 picks by processor, 128, 256 or 512 limits the vectors (tests). */
struct gb_batch_kernel gb_batch_pick(const struct gb_model *model, int widest);
struct gb_batch_f32_kernel gb_batch_f32_pick(const struct gb_model *model, int widest);

#endif
