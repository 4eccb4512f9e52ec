#ifndef GB_FIGURES_LAWS_HARDENING_MODELS_H
#define GB_FIGURES_LAWS_HARDENING_MODELS_H

#include "greenbody/params.h"

/* Hardening of P3 section 4.  sigma_0 passes through the yield point by P3's rule (1049 MPa
 * for m = 0.05); the last row has the 1480 MPa that P3 prints for m = 0.05, which does not.
 */
struct gb_hardening_model {
    double exponent;    /* m */
    double strength_pa; /* sigma_0; NaN: by the rule */
    const char *label;  /* Pango markup */
    const char *name;   /* in a column of numbers */
};

enum { GB_HARDENING_MODELS = 5 };

extern const struct gb_hardening_model gb_hardening_models[GB_HARDENING_MODELS];

/* A scene with the hardening of a row.  material.hollomon of the scene stays where the row
 * has no sigma_0. */
struct gb_params gb_hardening_models_scene(const struct gb_params *scene, int row);

#endif
