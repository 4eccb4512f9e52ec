#ifndef GB_SCENE_LOADING_KIND_H
#define GB_SCENE_LOADING_KIND_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/params.h"
#include "greenbody/status.h"

struct gb_model;

/* Properties of each scene.kind, one row per kind.  Other code tests these properties
 * and never the kind.  The functions that advance a scene are the rows of
 * solve/loading/loading.h, with the same index. */

/* Columns of curve.csv in addition to those of all runs. */
enum gb_curve_columns {
    GB_COLUMNS_COMMON,
    GB_COLUMNS_ENERGY, /* simulated time and energies */
    GB_COLUMNS_DIE     /* simulated time, height, forces on the punch and the floor */
};

struct gb_loading_kind {
    const char *name; /* as in scene.kind */
    const char *doc;
    unsigned normals; /* bits of enum gb_normal: possible values of contact.normal */
    enum gb_curve_columns columns;
    bool periodic_cell;      /* a periodic cell; else a die with walls */
    bool plane;              /* also 2D, scene.dimension = 2 */
    bool single_precision;   /* the force sweep exists in single precision */
    bool viscous_contacts;   /* viscous contact forces in a periodic cell */
    bool follows_time;       /* Newton's equations; else a sequence of equilibria */
    bool given_rate;         /* relax, compress at loading.rate, hold; the number of time
                              * steps is known beforehand, points belong to stages */
    bool changes;            /* loading.changes, and what-if runs that start from it */
    bool unloading_branches; /* loading.unload_from */
    bool paths;              /* loading.path */
    /* Checks the requirements of the kind beyond the ranges of its keys.  Errors:
     * GB_ERR_INPUT naming the keys. */
    bool (*check)(const struct gb_params *params, struct gb_error *err);
    /* Sets the part of the model that belongs to the kind, in reduced units. */
    void (*freeze)(struct gb_model *model, const struct gb_params *params);
    /* Line `index` of the description of a scene, as gb_model_note. */
    const char *(*note)(const struct gb_model *model, int index, char *buffer,
                        size_t size);
};

/* By enum gb_kind. */
enum { GB_LOADING_KINDS = 3 };
extern const struct gb_loading_kind gb_loading_kind_table[GB_LOADING_KINDS];

/* The row of a kind (enum gb_kind); the row of the scene with these parameters. */
const struct gb_loading_kind *gb_loading_kind_at(int kind);
const struct gb_loading_kind *gb_loading_kind_of(const struct gb_params *params);

/* Does the scene follow loading.path instead of loading.geometry, until and
 * unload_from? */
bool gb_loading_kind_follows_path(const struct gb_params *params);

/* Fails with GB_ERR_INPUT if the kind does not support the value of contact.normal. */
bool gb_loading_kind_check_normal(const struct gb_params *params, struct gb_error *err);

/* Fails with GB_ERR_INPUT for scenes without a periodic cell. what: the purpose, for
 * the message. */
bool gb_loading_kind_check_cell(const struct gb_params *params, const char *what,
                                struct gb_error *err);

/* Writes the names of the kinds with a property, "quasistatic or dynamic".  Returns
 * buffer. */
char *gb_loading_kind_names(bool (*has)(const struct gb_loading_kind *kind), char *buffer,
                            size_t size);

#endif
