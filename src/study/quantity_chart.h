#ifndef GB_STUDY_QUANTITY_CHART_H
#define GB_STUDY_QUANTITY_CHART_H

#include <glib.h>
#include <stdbool.h>
#include <stddef.h>

#include "greenbody/params.h"
#include "many/pool.h"
#include "scene/field/keep_points.h"
#include "scene/model.h"
#include "study/cells.h"

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
    double own[GB_QUANTITY_AXES]; /* the default */
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
const struct gb_quantity *gb_quantity_chart_quantities(void);

/* Errors: GB_ERR_INPUT that lists the names. */
const struct gb_quantity *gb_quantity_chart_find(const char *name, struct gb_error *err);

int gb_quantity_chart_axes(const struct gb_quantity_study *study);

/* The deviation of a reported quantity from its value with the tightest numerics, cell by
 * cell, against the time that a cell takes.  Cells are kept in DIR/cells: a repeated chart,
 * also of another quantity of the same study, measures only what is missing. */

struct gb_quantity_setting {
    double value[GB_QUANTITY_AXES];
};

/* One cell with one setting. */
struct gb_quantity_cell {
    bool done, failed; /* failed: a guard has ended it */
    double cpu_s, value[GB_QUANTITY_VALUES];
};

struct gb_quantity_chart {
    const struct gb_quantity_study *study;
    struct gb_params params; /* the scene */
    struct gb_keep_point mark;
    int seeds;       /* params.seed, params.seed + 1, ... */
    GArray *setting; /* of struct gb_quantity_setting; [0] reference, [1] the default */
    struct gb_cells cells;         /* settings x seeds */
    struct gb_quantity_cell *cell; /* the same */
};

/* Plans a chart and reads what its directory holds.
 *
 * at         mark of the cells, as in output.snapshots_at; NULL: that of the study
 * vary       NULL-terminated "axis=a,b,c": all combinations; NULL: the factors of the axes,
 *            all combinations of two axes, of more one axis at a time; empty: the default
 *            and the reference alone
 * reference  NULL-terminated "axis=value"; the others are the tightest of their axis
 * gb_quantity_chart_finish must be called, also after an error.  Errors: GB_ERR_INPUT. */
bool gb_quantity_chart_init(struct gb_quantity_chart *chart,
                            const struct gb_quantity_study *study,
                            const struct gb_params *params, const char *at,
                            const char *const *vary, const char *const *reference,
                            int seeds, const char *directory, struct gb_error *err);
void gb_quantity_chart_finish(struct gb_quantity_chart *chart); /* zeroed is fine */

/* Reads the cells that have been measured meanwhile.  Errors: GB_ERR_INPUT for a damaged
 * file. */
bool gb_quantity_chart_read(struct gb_quantity_chart *chart, struct gb_error *err);

/* Processor time of the missing cells, s, by those that are there; without any within a
 * factor of three.  *missing: their number. */
double gb_quantity_chart_cost_s(const struct gb_quantity_chart *chart, size_t *missing);
/* Processor time of the cells that are there, s. */
double gb_quantity_chart_spent_s(const struct gb_quantity_chart *chart);

/* Measures the missing cells, `jobs` at a time (0: one per processor).  Errors: those of
 * gb_cells_work; what is there by then is read. */
bool gb_quantity_chart_work(struct gb_quantity_chart *chart, int jobs,
                            const struct gb_cells_callbacks *callbacks,
                            struct gb_error *err);

/* What the cells of a setting say of a quantity, in its unit. */
struct gb_quantity_result {
    struct gb_quantity_setting setting;
    int seeds, failed; /* cells; those without a value */
    double cpu_s;      /* of a cell; mean */
    double cost;       /* over that of the default */
    double value, scatter;
    double error, error_se; /* from the reference, cell by cell: mean, standard error */
    double error_95;        /* half of the 95 % interval of the mean (Student's t) */
    double bound;           /* |error| + error_95; NaN: not known */
    bool noise_limited;     /* the interval contains 0 */
    bool front;             /* no other row costs less and has a smaller bound */
    bool chosen;            /* the cheapest one with bound <= allowed */
};

struct gb_quantity_table {
    const struct gb_quantity *quantity;
    GArray *row;          /* of struct gb_quantity_result, in the order of the settings */
    double half_interval; /* half of the 95 % interval of a mean over as many cells as the
                           * study has by default; scatter pooled over the settings */
    double allowed;
};

/* allowed: limit of the bound; NaN: the half interval. */
void gb_quantity_chart_table_init(struct gb_quantity_table *table,
                                  const struct gb_quantity_chart *chart,
                                  const struct gb_quantity *quantity, double allowed);
void gb_quantity_chart_table_finish(struct gb_quantity_table *table); /* zeroed is fine */
const struct gb_quantity_result *
gb_quantity_chart_table_at(const struct gb_quantity_table *table, size_t row);
/* The recommended row, or NULL. */
const struct gb_quantity_result *
gb_quantity_chart_table_chosen(const struct gb_quantity_table *table);

/* As CSV, with '#' lines of comment in front, and as text with the advice.
 * g_string_free. */
GString *gb_quantity_chart_table_csv(const struct gb_quantity_table *table,
                                     const char *comment);
GString *gb_quantity_chart_table_text(const struct gb_quantity_table *table);

#endif
