#include "scene/quasistatic_scene.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "scene/size/sizes.h"
#include "scene/tolerances.h"

static bool attracts(const struct gb_params *params)
{
    return params->normal == GB_NORMAL_ROD && params->epsilon_j > 0.0 &&
           params->n_d0_cubed > 0.0;
}

/* Units of numerics.tolerance that a scene cannot have: without adhesion there is
 * neither an attraction nor d - r_eq; the stiffness that turns forces into
 * displacements assumes equal spheres; the tolerances of fidelity are in mean contact
 * forces. */
bool gb_quasistatic_scene_check(const struct gb_params *params, struct gb_error *err)
{
    if (params->tolerance_scale == GB_TOLERANCE_CONTACT) {
        return true;
    }
    const bool displacement = params->tolerance_scale == GB_TOLERANCE_DISPLACEMENT;
    const char *name = displacement ? "displacement" : "attraction";
    if (!attracts(params)) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "numerics.tolerance_scale = %s: must be contact in a powder "
                            "without attraction",
                            name);
    }
    if (displacement && gb_sizes_polydisperse(params)) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "numerics.tolerance_scale = displacement: must be contact or "
                            "attraction with more than one particle size");
    }
    return isfinite(params->tolerance) ||
           gb_error_set(err, GB_ERR_INPUT,
                        "numerics.tolerance = auto: must be a number with "
                        "numerics.tolerance_scale = %s",
                        name);
}

void gb_quasistatic_scene_freeze(struct gb_model *model, const struct gb_params *params)
{
    (void)model;
    (void)params;
}

static void note_relaxer(const struct gb_model *model, char *buffer, size_t size)
{
    static const char *const unit[] = {
        [GB_TOLERANCE_CONTACT] = "of the mean contact force",
        [GB_TOLERANCE_ATTRACTION] = "of the attraction at contact",
        [GB_TOLERANCE_DISPLACEMENT] = "of d - r_eq for the largest displacement",
    };
    const struct gb_numerics *numerics = &model->numerics;
    const bool lighter = numerics->tolerance_scale == GB_TOLERANCE_CONTACT &&
                         strcmp(numerics->relaxer, "predict") == 0;
    snprintf(
        buffer, size,
        "relaxer %s, strain steps in %d part%s, tolerance %g %s%s, at most %lld evaluations per part, %s precision",
        numerics->relaxer, numerics->parts, numerics->parts == 1 ? "" : "s",
        numerics->tolerance, unit[numerics->tolerance_scale],
        lighter ? " (less under light loads)" : "", (long long)numerics->max_evaluations,
        numerics->single ? "single" : "double");
}

/* Is the cell so high that the residual forces of the relaxer can add up to a pressure
 * that varies along its height? */
static bool is_column(const struct gb_model *model)
{
    const double *edges = model->edges;
    return model->numerics.tolerance_scale == GB_TOLERANCE_CONTACT &&
           edges[2] > GB_COLUMN_ASPECT * fmin(edges[0], edges[1]) &&
           edges[2] * model->numerics.tolerance > GB_COLUMN_UNBALANCED;
}

const char *gb_quasistatic_scene_note(const struct gb_model *model, int index,
                                      char *buffer, size_t size)
{
    if (index == 0) {
        note_relaxer(model, buffer, size);
    } else if (index == 1 && is_column(model)) {
        snprintf(
            buffer, size,
            "the cell is %.0f d high and %.0f d wide: at this tolerance its layers are "
            "not in equilibrium, densities too low; better structure.base = auto, or "
            "numerics.tolerance = %.1g",
            model->edges[2], fmin(model->edges[0], model->edges[1]),
            GB_COLUMN_UNBALANCED / model->edges[2]);
    } else {
        return NULL;
    }
    return buffer;
}
