#ifndef GB_STUDY_CHART_QUANTITIES_H
#define GB_STUDY_CHART_QUANTITIES_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/params.h"
#include "many/pool.h"
#include "scene/field/keep_points.h"
#include "scene/model.h"

/* Every number that a study reports, and how one cell gives it with chosen numerics: the
 * table of `greenbody chart --quantity` and of the test that all of them have converged.
 *
 * A quantity is a row.  Quantities of one study share the measurement of a cell. */

enum {
    GB_QUANTITY_AXES = 4,
    GB_QUANTITY_FACTORS = 4,
    GB_QUANTITY_VALUES = 8,
};

/* A numerical choice of a study. */
struct gb_quantity_axis {
    const char *name; /* "group.key" of the preset, or a member of the study's options */
    int dimension;    /* enum gb_dimension */
    double factor[GB_QUANTITY_FACTORS]; /* of the default, tightest first; 0: no more */
    double effort;                      /* time of a cell ~ value^-effort, about */
    /* The default in SI; params and its frozen model. */
    double (*own)(const struct gb_params *params, const struct gb_model *model);
    void (*set)(struct gb_params *params, double value); /* NULL: an option */
};

/* One cell, as asked. */
struct gb_quantity_ask {
    struct gb_keep_point mark; /* where the study measures; unused without marks */
    double setting[GB_QUANTITY_AXES];
};

struct gb_quantity_study {
    const char *name; /* the command that reports its quantities */
    const char *at;   /* default mark; NULL: it has none */
    bool by_density;  /* marks are densities alone */
    int cells;        /* of the study by default; those of the interval */
    double runs;      /* time of a cell over that of pressing it, about */
    const struct gb_quantity_axis
        *axis; /* at most GB_QUANTITY_AXES; then one without name */
    /* Errors: GB_ERR_INPUT for scenes without these quantities. */
    bool (*check)(const struct gb_params *params, struct gb_error *err);
    /* value: by `index` of the rows, NaN where the cell gives none; path: of the cell
     * without ending, for files that the study keeps. */
    bool (*measure)(double value[GB_QUANTITY_VALUES], const struct gb_params *params,
                    const struct gb_quantity_ask *ask, const char *path,
                    const struct gb_pool_callbacks *callbacks, struct gb_error *err);
};

struct gb_quantity {
    const char *name, *unit, *meaning;
    const struct gb_quantity_study *study;
    int index; /* of its value among those of the study */
};

/* THE table; the last row has no name. */
const struct gb_quantity *gb_quantities(void);
/* Errors: GB_ERR_INPUT that lists the names. */
const struct gb_quantity *gb_quantities_find(const char *name, struct gb_error *err);

int gb_quantities_axes(const struct gb_quantity_study *study);
/* Name of an axis without its group: a column. */
const char *gb_quantities_column(const struct gb_quantity_axis *axis);

/* The lines of a question (study/compact/cells.h): study, mark, and the values. */
char *gb_quantities_question(const struct gb_quantity_study *study,
                             const struct gb_quantity_ask *ask);
/* Work of a pool: measures the cell of a question.  PATH.csv receives cpu_s, failed (1: a
 * guard has ended it) and a column for each quantity of the study. */
gb_pool_work gb_quantities_work;

#endif
