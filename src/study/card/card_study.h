#ifndef GB_STUDY_CARD_CARD_STUDY_H
#define GB_STUDY_CARD_CARD_STUDY_H

#include <stdbool.h>
#include <stddef.h>

#include "measure/cap/cap_fit.h"
#include "measure/cap/cap_path.h"
#include "measure/fit/fit.h"
#include "study/card/card_cell.h"
#include "study/card/card_misfit.h"

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
extern const struct gb_card_quantity_row gb_card_study_rows[GB_CARD_QUANTITIES];

enum { GB_CARD_POINTS_MAX = GB_CARD_LEVELS_MAX * GB_CARD_DIRECTIONS_MAX };

/* The card of one set of cells. */
struct gb_card_values {
    double density[GB_CARD_LEVELS_MAX], pressed_pa[GB_CARD_LEVELS_MAX];
    double value[GB_CARD_LEVELS_MAX][GB_CARD_QUANTITIES];
    double rms[GB_CARD_LEVELS_MAX]; /* of the points from the surface, Pa */
    struct gb_cap_fit_misses misses[GB_CARD_LEVELS_MAX][2]; /* of shear failure and cap */
    double start_density; /* of the unloaded first compact */
};

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
bool gb_card_study_run(struct gb_card_study *study, const struct gb_params *preset,
                       int jobs, const struct gb_card_callbacks *callbacks,
                       struct gb_error *err);

#endif
