#ifndef GB_SCENE_MODEL_H
#define GB_SCENE_MODEL_H

#include <stdbool.h>
#include <stdint.h>

#include "greenbody/params.h"
#include "law/law_bridge.h"
#include "law/law_dispersion.h"
#include "law/law_rod.h"
#include "law/law_slip.h"
#include "scene/path/path.h"
#include "scene/size/sizes.h"

struct gb_imported;

/* Terms of the force sweep of this scene.  The sweep computes only these. */
struct gb_terms {
    bool attraction;
    bool bridges;
    bool friction; /* shear and pivoting caps above zero, or bridges */
    bool plain;    /* a cohesionless law: normal force and shear friction only */
};

/* The keys of [numerics] after fidelity has set the automatic ones. */
struct gb_numerics {
    char relaxer[24];
    double tolerance;    /* residual, in units of tolerance_scale, of a relaxed step */
    int tolerance_scale; /* enum gb_tolerance_scale */
    int parts;           /* equal parts of a strain step */
    double cutoff;       /* d; no attraction beyond */
    double skin;         /* d; margin of the neighbour list */
    int threads;
    bool single;             /* single precision in the sweep */
    int64_t max_evaluations; /* per strain step */
};

/* What a dynamic scene has in addition to a quasi-static one.  The reduced unit of time
 * sqrt(m/(E d)) is P2's T. */
struct gb_dynamics {
    double viscous;         /* A over T; 0: no viscous forces */
    double viscous_shear;   /* 1, or 0 if shear*/
    double viscous_rolling; /* 1, or 0 if rolling and pivoting have no viscous force */
    double rate;            /* (1/rho) d rho/dt per reduced time */
    double relax, hold;     /* reduced times */
    double time_step;       /* reduced; 0: auto */
    double step_error;      /* error that auto allows, as a fraction */
    double record_density;  /* relative growth of density between recorded points */
    double record_time;     /* reduced time between recorded points of relax and hold */
    double second_per_time; /* T in s */
    double inertia;         /* J, m d^2 */
};

/* A die and the stages of its run, in reduced units: time in the T of dynamic scenes,
 * lengths in d.  Source: P3 section 5. */
struct gb_die_scene {
    double radius;         /* of the cylinder */
    double height;         /* at which the funnel begins */
    double outlet;         /* radius of the funnel's opening */
    double angle;          /* between the wall of the funnel and the axis, rad */
    double loose_density;  /* density of the powder placed in the funnel */
    double fill_gravity;   /* while pouring */
    double gravity;        /* while resting and pressing */
    double gravity_ramp;   /* time from one to the other */
    double flatten_travel; /* of the punch, from its first contact */
    double ramp_time;      /* of the pressure */
    double pressure;       /* at its end */
    bool quadratic;        /* p = p_max (t/T)^2 instead of p_max t/T */
    double record;         /* pressure between recorded points */
    double punch_mass;     /* in masses of the bed */
    bool full_cycle;       /* after the ramp: unloading, ejection and rest */
    double unload_time;    /* of the pressure, down to 0 */
    double rest_time;      /* in the die, and after ejection */
    double eject_speed;
    double weld_strength; /* of cold welds; 0: none */
    double safety;        /* of the time step */
    double time_step;     /* 0: from the critical time step */
    double inertia_scale;
    double central_radius; /* of the sphere that measures the central density */
    double second_per_time;
};

/* The model of a run: all constants derived from gb_params, in reduced units (length d,
 * stress E, mass m).  Constant during a run. */
struct gb_model {
    int kind;   /* enum gb_kind */
    int normal; /* enum gb_normal */
    int dimension;
    int64_t count;
    uint64_t seed;
    double edges[3]; /* initial cell, d */
    double start_density;
    int structure;                     /* enum gb_structure */
    const struct gb_imported *packing; /* in place of the structure; NULL: none */
    double r_meso;
    double single_contact; /* fraction of particles that begin with one contact */
    bool polydisperse;     /* more than one size; if false, the next four are 0 or 1 */
    struct gb_sizes sizes; /* in m */
    double diameter_min, diameter_max; /* d; 1 */
    double mean_power;                 /* of diameters, d^3, or d^2 in 2D; 1 */
    /* Components of contact records: 3, or 2 for discs of one size, which have a sweep
     * of their own.  Discs of unequal sizes use the laws of spheres with y = 0. */
    int record_dimension;
    struct gb_terms terms;
    bool cohesionless; /* no attraction, bridges or rods: contact.normal = hertz */
    struct gb_law_rod rod;
    struct gb_law_bridge bridge;
    struct gb_law_dispersion dispersion;
    struct gb_law_slip slip;
    double h_eq; /* equilibrium overlap of an unbridged pair, d; 0 without attraction */
    double adhesion;    /* f_a(d), E d^2 */
    double force_floor; /* least force scale of the stopping rule, E d^2 */
    struct gb_numerics numerics;
    bool sheared; /* the cell is or will be tilted: double precision */
    struct gb_path
        path; /* loading path, stresses over E; without legs the next members apply */
    bool collapse_strains; /* continue by strain if a stress cannot be held */
    int geometry;          /* enum gb_geometry */
    double strain_step;
    double until_pressure; /* E; infinity if a density ends the run */
    double until_density;  /* 1 if a pressure ends the run */
    double unload_from[GB_UNLOAD_MAX];
    int unload_count;
    struct gb_dynamics dynamics; /* zero in scenes without a given rate */
    struct gb_die_scene die;     /* zero in a periodic cell */
    double pascal_per_stress;    /* E in Pa */
    double metre_per_length;     /* d in m */
    double newton_per_force;     /* E d^2 in N */
};

/* Sets the model from checked params.  Errors: GB_ERR_INPUT naming the key. */
bool gb_model_init(struct gb_model *model, const struct gb_params *params,
                   struct gb_error *err);

/* Describes what the scene leaves out and what fidelity picked: line `index` (0, 1,
 * ...); NULL after the last.  The text is in buffer. */
const char *gb_model_note(const struct gb_model *model, int index, char *buffer,
                          size_t size);

#endif
