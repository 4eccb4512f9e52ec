#ifndef GB_SCENE_NORMAL_LAW_H
#define GB_SCENE_NORMAL_LAW_H

#include <stdbool.h>

#include "greenbody/params.h"

struct gb_model;

/* The normal laws of contact.normal: one row per enum gb_normal.  Everything but the rows
 * and the sweeps (pack/kernel) asks for the properties below and not for the law.  Which
 * kinds of scenes accept a law is a property of the kind (loading_kind.h). */
struct gb_normal_law {
    const char *name; /* as in contact.normal */
    bool one_size;    /* particles of one size only */
    bool pair;        /* two bodies of any sizes, in SI: scene/contact_pair.h */
    /* The law's part of the model of a periodic cell, after the constants of the rod law;
     * NULL: nothing else. */
    void (*freeze)(struct gb_model *model, const struct gb_params *params);
    /* Force of a contact that is loaded, without attraction (E d^2), and its slope (E d)
     * at overlap h (d); both 0 for h <= 0.  NULL: no law of periodic cells. */
    double (*force)(const struct gb_model *model, double h);
    double (*stiffness)(const struct gb_model *model, double h);
};

/* The row of a law (enum gb_normal), or of the scene of these parameters. */
const struct gb_normal_law *gb_normal_law_at(int normal);
const struct gb_normal_law *gb_normal_law_of(const struct gb_params *params);

/* The law of a model of a periodic cell, as in the row. */
double gb_normal_law_force(const struct gb_model *model, double h);
double gb_normal_law_stiffness(const struct gb_model *model, double h);

#endif
