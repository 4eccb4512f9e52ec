#ifndef GB_STUDY_CARD_H
#define GB_STUDY_CARD_H

#include <glib.h>
#include <stdbool.h>
#include <stddef.h>

#include "greenbody/params.h"
#include "greenbody/status.h"
#include "many/pool.h"
#include "measure/cap.h"
#include "measure/cap_fit.h"
#include "measure/fit.h"
#include "measure/yield_point.h"
#include "study/compact.h"

/* A Drucker-Prager cap card of a powder: parameters against density from the yield points
 * of replicas, each with its 95 % interval (jackknife over the replicas, Student's t), and
 * the card's prediction of both paths of pressing. */

/* --- what is measured ----------------------------------------------------------------- */

/* What is measured for a card. */
enum { GB_CARD_LEVELS_MAX = 16, GB_CARD_DIRECTIONS_MAX = 72 };

/* How compacts are pressed, and the paths a card is compared with. */
enum gb_card_path { GB_CARD_UNIAXIAL, GB_CARD_ISOTROPIC, GB_CARD_PATHS };

struct gb_card_path_row {
    const char *name, *leg;
    double direction_from,
        direction_to; /* of the probes of its compacts, rad in (p, q) */
};

extern const struct gb_card_path_row gb_card_paths[GB_CARD_PATHS];

/* Errors: GB_ERR_INPUT. */
bool gb_card_path_of(enum gb_card_path *path, const char *name, struct gb_error *err);

struct gb_card_options {
    double density[GB_CARD_LEVELS_MAX]; /* of the compacts, ascending */
    int levels;
    enum gb_card_path path;
    double
        pressure_pa; /* mean pressure to which the scouting run of the first cell goes */
    int replicas;    /* cells, from structure.seed on */
    int directions;  /* of probes, evenly spaced */
    double inside;   /* pressure at which probes begin, over that of the compact */
    double offset;   /* plastic strain at yield */
    double step;     /* strain step of a probe */
    double strain_most;     /* at which a probe is given up */
    double press_tolerance; /* numerics.tolerance of pressing ... */
    double tolerance;       /* ... and of unloading and probes */
    double transition;      /* a of the surface */
    double flow;            /* weight of the directions of flow (measure/cap_fit.h) */
};

void gb_card_options_init(struct gb_card_options *options);

/* Errors: GB_ERR_INPUT naming the option and what is expected. */
bool gb_card_options_check(const struct gb_card_options *options, struct gb_error *err);

/* Direction of probe `index`, rad. */
double gb_card_direction(const struct gb_card_options *options, int index);

/* --- one cell ------------------------------------------------------------------------- */

/* The compact of one density. */
struct gb_card_level {
    double density;
    double p_pa, q_pa;          /* at which it was pressed */
    double inside_pa;           /* mean pressure at which its probes begin */
    double bulk, shear_modulus; /* K and G there, Pa */
};

struct gb_card_pressed {
    double density, px_pa, pz_pa; /* px: mean of x and y */
};

struct gb_card_cell {
    struct gb_card_level level[GB_CARD_LEVELS_MAX];
    GArray *point; /* of struct gb_yield_point: density as in the options */
    GArray *curve[GB_CARD_PATHS]; /* of struct gb_card_pressed, density ascending */
};

/* gb_card_cell_finish is due, also after an error.  A probe that a guard stops, or that does
 * not reach the offset, leaves no point.  Errors: GB_ERR_GUARD when pressing ends early. */
bool gb_card_cell_measure(struct gb_card_cell *cell, const struct gb_params *preset,
                          int replica, const struct gb_card_options *options,
                          const struct gb_pool_callbacks *callbacks,
                          struct gb_error *err);

void gb_card_cell_finish(struct gb_card_cell *cell); /* zeroed is fine */

/* --- the card ------------------------------------------------------------------------- */

/* A Drucker-Prager cap card of a powder: parameters against density from the yield points
 * of replicas, each with its 95 % interval (jackknife over the replicas, Student's t), and
 * the card's prediction of both paths of pressing. */
enum gb_card_quantity {
    GB_CARD_D,    /* Pa */
    GB_CARD_BETA, /* rad */
    GB_CARD_R,
    GB_CARD_P_A,     /* Pa */
    GB_CARD_P_B,     /* Pa */
    GB_CARD_PLASTIC, /* volumetric plastic strain since the first density */
    GB_CARD_YOUNG,   /* Pa */
    GB_CARD_POISSON,
    GB_CARD_QUANTITIES
};

/* A row of the table of quantities: names, unit and factor to that unit. */
struct gb_card_quantity_row {
    const char *name, *symbol, *unit;
    double factor;
};
extern const struct gb_card_quantity_row gb_card_rows[GB_CARD_QUANTITIES];

enum { GB_CARD_POINTS_MAX = GB_CARD_LEVELS_MAX * GB_CARD_DIRECTIONS_MAX };

/* The card of one set of cells. */
struct gb_card_values {
    double density[GB_CARD_LEVELS_MAX], pressed_pa[GB_CARD_LEVELS_MAX];
    double value[GB_CARD_LEVELS_MAX][GB_CARD_QUANTITIES];
    double rms[GB_CARD_LEVELS_MAX]; /* of the points from the surface, Pa */
    struct gb_cap_fit_misses misses[GB_CARD_LEVELS_MAX][2]; /* of shear failure and cap */
    double start_density; /* of the unloaded first compact */
};

/* Means over the cells but `without` (-1: all): a point per level and direction that half of
 * them reached.  Standard errors of p and q; replica 0.  Returns their number. */
size_t gb_card_fit_points(const struct gb_card_cell *cells, int count, int without,
                          const struct gb_card_options *options,
                          struct gb_yield_point *points);

/* The card of the cells but `without`.  points: of gb_card_fit_points. */
bool gb_card_fit_values(struct gb_card_values *card, const struct gb_card_cell *cells,
                        int count, int without, const struct gb_card_options *options,
                        const struct gb_yield_point *points, size_t size,
                        struct gb_error *err);

/* The card as a material.  rows: room for GB_CARD_LEVELS_MAX. */
struct gb_cap_material gb_card_fit_material(const struct gb_card_values *card, int levels,
                                            double transition, struct gb_cap_row *rows);

enum { GB_CARD_CURVE_POINTS = 60 };

/* Pressing along a path, simulated and predicted, at one density. */
struct gb_card_compared {
    double density;
    struct gb_fit_value simulated_ratio, simulated_pz; /* p_x/p_z; Pa */
    struct gb_fit_value predicted_ratio, predicted_pz;
};

struct gb_card_misfit {
    double ratio;    /* rms of predicted less simulated p_x/p_z */
    double pressure; /* rms of predicted over simulated p_z, less 1 */
    double density;  /* rms of predicted less simulated density at the same p_z */
    double ratio_most, density_most; /* largest of either sign */
};

/* Of the points of a curve from a density on that are simulated and predicted. */
void gb_card_misfit_measure(struct gb_card_misfit *misfit,
                            const struct gb_card_compared curve[GB_CARD_CURVE_POINTS],
                            double from);

struct gb_card_study {
    struct gb_card_options options;
    int levels;
    struct gb_card_values card;
    struct gb_fit_value quantity[GB_CARD_LEVELS_MAX][GB_CARD_QUANTITIES];
    struct gb_yield_point point[GB_CARD_POINTS_MAX]; /* means over the cells */
    size_t points;
    struct gb_card_compared curve[GB_CARD_PATHS][GB_CARD_CURVE_POINTS];
    double compared_from; /* density at which the prediction has left its elastic start */
    struct gb_card_misfit misfit[GB_CARD_PATHS];
    double seconds;
};

struct gb_card_callbacks {
    bool (*cancelled)(void *data);
    void (*progress)(void *data, int done, int replicas);
    void *data;
};

/* Measures the cells, `jobs` at a time (0: one per processor), and fits.  Results depend on
 * preset and options alone.  Errors: GB_ERR_INPUT, GB_ERR_GUARD, GB_ERR_CANCELLED,
 * GB_ERR_MEMORY, GB_ERR_NOT_CONVERGED. */
bool gb_card_run(struct gb_card_study *study, const struct gb_params *preset, int jobs,
                 const struct gb_card_callbacks *callbacks, struct gb_error *err);

/* A line for each density and side on which the surface is further from its own points (rms)
 * than their 95 % intervals (rms of the standard errors, Student's t); empty where it is
 * not.  card.csv and card.inp have them as comments. */
GString *gb_card_files_misses(const struct gb_card_study *study);

/* card.csv: a row per density, each parameter with its 95 % interval (_low, _high). */
GString *gb_card_files_card(const struct gb_card_study *study, const char *comment);

/* card_points.csv: the yield points, means over the cells with standard errors; `side` is
 * shear, cap or tension. */
GString *gb_card_files_points(const struct gb_card_study *study, const char *comment);

/* card_uniaxial.csv, card_isotropic.csv: pressing along a path, simulated and predicted,
 * with 95 % intervals. */
GString *gb_card_files_path(const struct gb_card_study *study, enum gb_card_path path,
                            const char *comment);

/* card.inp: *MATERIAL with *ELASTIC, *CAP PLASTICITY and *CAP HARDENING for Abaqus, in mm,
 * N, MPa, tonne.  The first field variable is the relative density.
 *
 * mass_density  of the solid, kg/m3 */
GString *gb_card_files_abaqus(const struct gb_card_study *study, const char *comment,
                              double mass_density);

#endif
