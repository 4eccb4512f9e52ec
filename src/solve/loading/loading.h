#ifndef GB_SOLVE_LOADING_LOADING_H
#define GB_SOLVE_LOADING_LOADING_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/record.h"
#include "greenbody/params.h"
#include "greenbody/stage.h"
#include "greenbody/status.h"
#include "pack/cell/world.h"
#include "pack/die/bed.h"
#include "scene/loading_kind.h"
#include "scene/model.h"
#include "solve/event_queue.h"
#include "solve/step_outcome.h"
#include "solve/verlet.h"

/* A packing and the loading that it undergoes: one table of modes with the same functions
 * each, by enum gb_kind.  What a mode can be combined with is the row of the same index
 * in scene/loading_kind.h.
 *
 * A new mode is a file here (its struct begins with struct gb_loading), a row in
 * gb_loading_modes, and a row in gb_loading_kind_table. */
struct gb_loading {
    const struct gb_loading_mode *mode;
    const struct gb_params *params;
    const struct gb_model *model;
    struct gb_world *world; /* the packing in a periodic cell ... */
    struct gb_bed *bed;     /* ... or in a die; the other one is NULL */
    bool restored;          /* the last after_point went back to an earlier state */
    /* In every checkpoint, whatever the mode; zero in modes without strain steps. */
    double factor[3]; /* of the edges in the strain step under way, or the next one */
    bool strain_due;  /* it waits for the next slice, so that between slices after a
                       * point forces, positions and histories belong together */
};

enum gb_loading_stage {
    GB_LOADING_RELAX, /* before the load rises */
    GB_LOADING_LOAD,
    GB_LOADING_HOLD,
    /* of a die: */
    GB_LOADING_UNLOAD,
    GB_LOADING_CONFINED, /* in the die, without a punch */
    GB_LOADING_EJECT,
    GB_LOADING_EJECTED
};

/* What goes into a recorded point beside the measures of the packing.  Reduced units; NaN
 * where a mode has no such quantity. */
struct gb_loading_report {
    enum gb_loading_stage stage;
    int begun;     /* leg of loading.path, from 1; 0: none */
    int leg;       /* the same; 0 while held stresses are brought to their values */
    int unloading; /* k-th unloading branch; 0: none */
    int64_t iterations, evaluations; /* since the last point */
    double residual;                 /* of the force balance */
    double unrelaxed;                /* 1: above its tolerance; 0 else */
    double time_step;                /* last used, T */
    double time;                     /* simulated, T */
    double kinetic, work, absorbed;  /* E d^3 */
    /* of a die: */
    double pressure[3];     /* mean on the side wall in x and y, under the punch; E */
    double target_pressure; /* of the punch, E */
    double height, height0; /* of the powder, and before pressing; d */
    double floor_over_punch;
    double floor;         /* pressure on the floor, E */
    double drag;          /* axial force of the side on the powder, downward; E d^2 */
    double contact;       /* height of the powder against the side, d */
    double axial, radial; /* springback since the full pressure */
    double welded;        /* share of the cold welds that holds */
};

struct gb_loading_mode {
    size_t size;                           /* of its struct */
    const struct gb_loading_mode *by_path; /* takes its place under loading.path, or
                                              * NULL */
    /* Places the particles and prepares the first step.  cancelled (may be NULL) is
     * polled with data, true fails with GB_ERR_CANCELLED. */
    bool (*build)(struct gb_loading *loading, bool (*cancelled)(void *data), void *data,
                  struct gb_error *err);
    /* The same with the particles of a record, before `record` loads the rest. */
    bool (*build_from)(struct gb_loading *loading, struct gb_record *record,
                       struct gb_error *err);
    void (*finish)(struct gb_loading *loading); /* but for world and bed */
    /* At most max_evaluations evaluations of the forces. */
    enum gb_step_outcome (*advance)(struct gb_loading *loading, int64_t max_evaluations,
                                    struct gb_event_queue *events, struct gb_error *err);
    /* Right after GB_STEP_POINT, when the point is measured: what follows is decided.
     * MORE, DONE (nothing follows) or STOPPED (err). */
    enum gb_step_outcome (*after_point)(struct gb_loading *loading,
                                        struct gb_event_queue *events,
                                        struct gb_error *err);
    /* Decides anew what follows a point loaded from a record, under changed parameters;
     * outcomes as of after_point.  NULL where the kind has no `changes`. */
    enum gb_step_outcome (*decide_again)(struct gb_loading *loading,
                                         struct gb_error *err);
    /* The state at a recorded point into a record, or out of it after build_from: to the
     * last bit what it was.  Errors: GB_ERR_INPUT naming the member. */
    bool (*record)(struct gb_loading *loading, struct gb_record *record,
                   struct gb_error *err);
    struct gb_loading_report (*report)(const struct gb_loading *loading);
    /* Velocities and angular velocities of the particles of a periodic cell, as
     * struct gb_verlet has them.  NULL where a mode has no time, or a bed. */
    const struct gb_verlet *(*motion)(const struct gb_loading *loading);
    /* Share of the loading that is done, 0 to 1; pressure (E) and density of the last
     * recorded point. */
    double (*progress)(const struct gb_loading *loading, double pressure, double density);
    /* Goals that a loading which has ended never reached, or has exceeded by more than their
     * tolerance, as one line into text; false: none.  NULL where a mode ends exactly at its
     * goals or stops. */
    bool (*missed)(const struct gb_loading *loading, char *text, size_t size);
    /* Stage of the run and how far it has come, right after an evaluation; coordination and
     * height of the powder stay unknown where the mode does not measure them.  NULL where
     * a mode has no stages. */
    void (*stage)(const struct gb_loading *loading, struct gb_stage_report *report);
};

/* THE table, by enum gb_kind. */
extern const struct gb_loading_mode *const gb_loading_modes[GB_LOADING_KINDS];

/* params and model must outlive it.  Errors: as of the mode's build. */
bool gb_loading_create(struct gb_loading **out, const struct gb_params *params,
                       const struct gb_model *model, bool (*cancelled)(void *data),
                       void *data, struct gb_error *err);
/* From a record that gb_loading_record has filled with the same parameters and model. */
bool gb_loading_create_from(struct gb_loading **out, const struct gb_params *params,
                            const struct gb_model *model, struct gb_record *record,
                            struct gb_error *err);
void gb_loading_destroy(struct gb_loading *loading); /* NULL is fine */

/* Packing and mode into a record at a recorded point. */
bool gb_loading_record(struct gb_loading *loading, struct gb_record *record,
                       struct gb_error *err);

/* Of the forces, since the start. */
int64_t gb_loading_evaluations(const struct gb_loading *loading);

/* All NaN or zero: what a mode's report fills in. */
struct gb_loading_report gb_loading_empty_report(void);

extern const struct gb_loading_mode gb_loading_path; /* of loading.path */
extern const struct gb_loading_mode gb_loading_quasistatic, gb_loading_dynamic,
    gb_loading_die;

#endif
