#ifndef GB_SCENE_NORMAL_LAW_H
#define GB_SCENE_NORMAL_LAW_H

#include <stdbool.h>

#include "greenbody/params.h"

struct gb_model;

/* The normal laws of contact.normal: one row per enum gb_normal.  Other code, except
 * the force sweeps (pack/kernel), tests these properties and not the law.  Which kinds
 * of scenes support a law is a property of the kind (loading_kind.h). */
struct gb_normal_law {
    const char *name; /* as in contact.normal */
    bool one_size;    /* particles of one size only */
    bool pair;        /* also for two bodies of any sizes, in SI: scene/contact_pair.h */
    /* Adjusts the model of a periodic cell after the constants of the rod law are set;
     * NULL: nothing to do. */
    void (*freeze)(struct gb_model *model, const struct gb_params *params);
    /* Force (E d^2) without attraction of a contact on loading, and its slope (E d), at
     * overlap h (d); both 0 for h <= 0.  NULL: not a law of periodic cells. */
    double (*force)(const struct gb_model *model, double h);
    double (*stiffness)(const struct gb_model *model, double h);
};

/* The row of a law (enum gb_normal); the row of the scene with these parameters. */
const struct gb_normal_law *gb_normal_law_at(int normal);
const struct gb_normal_law *gb_normal_law_of(const struct gb_params *params);

/* Force and slope of the law of a model, as in its row. */
double gb_normal_law_force(const struct gb_model *model, double h);
double gb_normal_law_stiffness(const struct gb_model *model, double h);

#endif
