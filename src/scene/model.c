/* From the parameters to the model of a run: converts SI units to reduced units (length
 * d, stress E, mass m), sets the constants of the contact laws, and picks the numerics
 * that `fidelity` leaves to the program. gb_model_init calls the freeze functions of
 * the kind of scene (loading_kind.h) and of the normal law (normal_law.h) for their
 * parts. gb_model_note describes for the user what a scene leaves out and what was
 * picked. */
#include "scene/model.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/units.h"
#include "scene/derived.h"
#include "scene/imported/imported.h"
#include "scene/loading_kind.h"
#include "scene/normal_law.h"
#include "scene/tolerances.h"
#include "scene/unequal_pair.h"

static double by_fidelity(int fidelity, double fast, double balanced, double reference)
{
    switch (fidelity) {
    case GB_FIDELITY_FAST:
        return fast;
    case GB_FIDELITY_REFERENCE:
        return reference;
    default:
        return balanced;
    }
}

/* Tolerances and strain parts of predict differ from those of other relaxers. */
static void pick_for_predict(struct gb_numerics *numerics, const struct gb_params *params,
                             bool bridges, double *part)
{
    const int geometry = gb_derived_geometry(params);
    const int axes = geometry == GB_GEOMETRY_ISOTROPIC ? params->dimension
                     : geometry == GB_GEOMETRY_BIAXIAL ? 2
                                                       : 1;
    const bool fast = params->fidelity == GB_FIDELITY_FAST;
    *part = (fast ? GB_PREDICT_STRAIN_PART_FAST : GB_PREDICT_STRAIN_PART_BALANCED) /
            sqrt(axes);
    numerics->tolerance =
        bridges ? (fast ? GB_PREDICT_TOLERANCE_FAST : GB_PREDICT_TOLERANCE_BALANCED)
                : (fast ? GB_UNBRIDGED_TOLERANCE_FAST : GB_UNBRIDGED_TOLERANCE_BALANCED);
}

/* Picks the tolerance and the number of parts of a strain step. */
static void pick_relaxation(struct gb_model *model, const struct gb_params *params)
{
    struct gb_numerics *numerics = &model->numerics;
    double part = params->strain_step;
    if (params->fidelity == GB_FIDELITY_REFERENCE) {
        numerics->tolerance = GB_TOLERANCE_REFERENCE;
        part = GB_STRAIN_PART_REFERENCE;
    } else if (strcmp(numerics->relaxer, "predict") == 0) {
        pick_for_predict(numerics, params, model->terms.bridges, &part);
    } else {
        numerics->tolerance = params->fidelity == GB_FIDELITY_FAST
                                  ? GB_TOLERANCE_FAST
                                  : GB_TOLERANCE_BALANCED;
    }
    numerics->tolerance =
        isfinite(params->tolerance) ? params->tolerance : numerics->tolerance;
    numerics->tolerance_scale = params->tolerance_scale;
    const double most = isfinite(params->strain_part) ? params->strain_part : part;
    numerics->parts = (int)fmax(1.0, ceil(params->strain_step / most - 1e-9));
}

/* predict takes a third of the time of fire; fire serves as the reference. */
static const char *automatic_relaxer(const struct gb_params *params)
{
    return params->fidelity == GB_FIDELITY_REFERENCE ? "fire" : "predict";
}

/* Force sweeps in single precision exist for scenes without viscous forces, in 3D and
 * in cells that are never tilted. */
static bool has_single_sweep(const struct gb_model *model)
{
    return gb_loading_kind_at(model->kind)->single_precision && model->dimension == 3 &&
           !model->sheared;
}

/* Single precision halves memory and time.  P1's own relaxer stays as printed, in
 * double. */
static bool pick_precision(const struct gb_model *model, const struct gb_params *params)
{
    return params->precision == GB_PRECISION_SINGLE ||
           (params->precision == GB_PRECISION_AUTO && has_single_sweep(model) &&
            strcmp(model->numerics.relaxer, "steepest") != 0 &&
            model->numerics.tolerance >= GB_F32_TOLERANCE_MIN);
}

static void pick_numerics(struct gb_model *model, const struct gb_params *params)
{
    struct gb_numerics *numerics = &model->numerics;
    const bool named = params->relaxer[0] && strcmp(params->relaxer, "auto") != 0;
    snprintf(numerics->relaxer, sizeof numerics->relaxer, "%s",
             named ? params->relaxer : automatic_relaxer(params));
    pick_relaxation(model, params);
    numerics->single = pick_precision(model, params);
    const double share =
        by_fidelity(params->fidelity, GB_CUTOFF_FRACTION_FAST,
                    GB_CUTOFF_FRACTION_BALANCED, GB_CUTOFF_FRACTION_REFERENCE);
    const double given = params->cutoff.relative
                             ? params->cutoff.value
                             : params->cutoff.value / model->metre_per_length;
    numerics->cutoff = isfinite(given) && given > 0.0
                           ? given
                           : gb_law_dispersion_range(&model->dispersion, share);
    const bool contacts_only =
        !model->terms.attraction ||
        (model->structure != GB_STRUCTURE_GROWN && !model->packing);
    if (contacts_only && !(isfinite(given) && given > 0.0)) {
        numerics->cutoff = 1.0;
    }
    numerics->cutoff = fmax(numerics->cutoff, contacts_only ? 1.0 : GB_CUTOFF_MIN);
    numerics->skin =
        gb_loading_kind_at(model->kind)->follows_time ? GB_SKIN_DYNAMIC : GB_SKIN;
    numerics->max_evaluations =
        params->max_evaluations > 0 ? params->max_evaluations : GB_EVALUATIONS_MAX;
}

static void freeze_laws(struct gb_model *model, const struct gb_params *params)
{
    const double d = model->metre_per_length, young = params->young_pa;
    gb_law_rod_init(&model->rod, params->poisson);
    gb_law_dispersion_init(&model->dispersion, params->n_d0_cubed,
                           params->epsilon_j / (young * d * d * d), params->alpha,
                           params->d0_m / d);
    model->adhesion = model->dispersion.contact;
    model->bridge = (struct gb_law_bridge){
        .length = gb_derived_bridge_length_m(params) / d,
        .strength = gb_derived_shear_strength_pa(params) / young,
        .radius_current = params->bridge_radius == GB_BRIDGE_RADIUS_CURRENT,
    };
    const double mu_pivot = isfinite(params->mu_pivot) ? params->mu_pivot : params->mu;
    gb_law_slip_init(&model->slip, params->poisson, params->mu, mu_pivot,
                     model->bridge.strength,
                     params->relative_motion == GB_MOTION_FULL ? 1.0 : 0.5);
    const struct gb_normal_law *law = gb_normal_law_at(model->normal);
    if (gb_loading_kind_of(params)->periodic_cell && law->freeze) {
        law->freeze(model, params);
    }
    if (law->force) {
        model->force_floor =
            fmax(model->adhesion, law->force(model, GB_FORCE_FLOOR_OVERLAP));
    }
    model->terms.attraction = model->adhesion > 0.0;
    model->terms.bridges = model->bridge.length < 1.0;
    model->terms.friction =
        model->terms.bridges || params->mu > 0.0 || model->slip.mu_pivot > 0.0;
    model->terms.plain = model->cohesionless;
}

static void scale_leg(struct gb_leg *leg, double stress)
{
    for (int k = 0; k < GB_PATH_COMPONENTS; k++) {
        leg->component[k].value /=
            leg->component[k].control == GB_LEG_STRESS ? stress : 1.0;
    }
    for (int e = 0; e < leg->end_count; e++) {
        const enum gb_leg_end_kind kind = leg->end[e].kind;
        leg->end[e].value /= kind == GB_LEG_END_PRESSURE || kind == GB_LEG_END_STRESS ||
                                     kind == GB_LEG_END_MEAN || kind == GB_LEG_END_Q
                                 ? stress
                                 : 1.0;
    }
}

/* Sets the loading path, with stresses over E. */
static bool freeze_path(struct gb_model *model, const struct gb_params *params,
                        struct gb_error *err)
{
    if (!gb_loading_kind_follows_path(params)) {
        return true;
    }
    if (!gb_path_parse(&model->path, params->path, params->dimension, err)) {
        return false;
    }
    for (int l = 0; l < model->path.count; l++) {
        scale_leg(&model->path.leg[l], params->young_pa);
    }
    model->sheared = model->sheared || gb_path_sheared(&model->path);
    model->collapse_strains = params->on_collapse == GB_COLLAPSE_STRAIN;
    return true;
}

static void freeze_loading(struct gb_model *model, const struct gb_params *params)
{
    model->geometry = gb_derived_geometry(params);
    model->strain_step = params->strain_step;
    model->until_pressure = isfinite(params->until_pressure_pa)
                                ? params->until_pressure_pa / params->young_pa
                                : INFINITY;
    model->until_density = isfinite(params->until_density) ? params->until_density : 1.0;
    model->unload_count = params->unload_count;
    for (int i = 0; i < params->unload_count; i++) {
        model->unload_from[i] = params->unload_from_pa[i] / params->young_pa;
    }
}

/* Sets the sizes of the powder.  Scenes for which gb_sizes_polydisperse is false have
 * one size. */
static bool freeze_sizes(struct gb_model *model, const struct gb_params *params,
                         struct gb_error *err)
{
    const double d = model->metre_per_length;
    model->diameter_min = model->diameter_max = model->mean_power = 1.0;
    model->polydisperse = gb_sizes_polydisperse(params);
    model->record_dimension = model->polydisperse ? 3 : params->dimension;
    if (!model->polydisperse) {
        return true;
    }
    if (!gb_sizes_init(&model->sizes, params, err)) {
        return false;
    }
    model->mean_power = gb_sizes_moment(&model->sizes, params->dimension) /
                        (d * d * (params->dimension == 3 ? d : 1.0));
    gb_sizes_range(&model->sizes, params->count, &model->diameter_min,
                   &model->diameter_max);
    model->diameter_min /= d;
    model->diameter_max /= d;
    return true;
}

/* Largest equilibrium overlap by adhesion, over D, which a pair of the smallest
 * particles has.  NaN if adhesion is too strong for the laws to hold. */
static double largest_equilibrium(const struct gb_model *model)
{
    const double smallest = model->polydisperse ? model->diameter_min : 1.0;
    struct gb_law_unequal law;
    if (!(model->adhesion > 0.0)) {
        return 0.0;
    }
    gb_unequal_pair_init(&law, model, smallest, smallest);
    const double share = gb_law_unequal_equilibrium(&law) / law.mean_diameter;
    return share < GB_OVERLAP_MAX ? share : (double)NAN;
}

bool gb_model_init(struct gb_model *model, const struct gb_params *params,
                   struct gb_error *err)
{
    const double d = gb_derived_reference_m(params);
    *model = (struct gb_model){
        .kind = params->kind,
        .normal = params->normal,
        .dimension = params->dimension,
        .count = params->count,
        .seed = params->seed,
        .structure = params->structure,
        .packing = gb_imported_of(params, err),
        .single_contact = params->single_contact,
        .r_meso =
            params->r_meso.relative ? params->r_meso.value : params->r_meso.value / d,
        .numerics.threads = params->threads > 0 ? (int)params->threads : 0,
        .pascal_per_stress = params->young_pa,
        .metre_per_length = d,
        .newton_per_force = params->young_pa * d * d,
    };
    if (gb_imported_given(params) && !model->packing) {
        return false;
    }
    model->sheared = model->packing && gb_imported_tilted(model->packing);
    gb_loading_kind_of(params)->freeze(model, params);
    if (!freeze_sizes(model, params, err) || !freeze_path(model, params, err)) {
        return false;
    }
    if (params->precision == GB_PRECISION_SINGLE && !has_single_sweep(model)) {
        return gb_error_set(
            err, GB_ERR_INPUT,
            "numerics.precision = single: must be auto or double unless the scene is "
            "quasi-static, in 3D and without shear or tilts");
    }
    freeze_laws(model, params);
    if (!gb_loading_kind_of(params)->periodic_cell) {
        /* a die has no cell; its freeze function has set its laws */
        return true;
    }
    gb_derived_cell(params, model->edges);
    const double shape = params->dimension == 3 ? M_PI / 6.0 : M_PI / 4.0;
    model->start_density = (double)params->count * model->mean_power * shape /
                           (model->edges[0] * model->edges[1] * model->edges[2]);
    freeze_loading(model, params);
    model->h_eq = largest_equilibrium(model);
    if (!isfinite(model->h_eq)) {
        return gb_error_set(
            err, GB_ERR_INPUT,
            "contact.alpha = %g, particles.diameter = %g nm: the adhesion "
            "%.3g E d^2 presses pairs deeper than %g d; increase alpha or "
            "diameter, or decrease material.epsilon",
            params->alpha, 1e9 * d, model->adhesion, GB_OVERLAP_MAX);
    }
    pick_numerics(model, params);
    const double reach =
        model->numerics.cutoff + model->numerics.skin + model->diameter_max - 1.0;
    for (int k = 0; k < 3; k++) {
        const bool periodic = params->dimension == 3 || k != 1;
        const double width =
            model->packing ? gb_imported_spacing(model->packing, k) : model->edges[k];
        if (periodic && width < GB_EDGE_OVER_RANGE_MIN * reach) {
            return gb_error_set(
                err, GB_ERR_INPUT,
                "particles.count = %lld, structure.base: the cell is %.3g d "
                "wide along %c, less than twice the interaction range %.3g d; "
                "increase the count or change the base",
                (long long)params->count, width, "xyz"[k], reach);
        }
    }
    return true;
}

const char *gb_model_note(const struct gb_model *model, int index, char *buffer,
                          size_t size)
{
    const struct gb_numerics *numerics = &model->numerics;
    const struct gb_terms *terms = &model->terms;
    const struct gb_loading_kind *kind = gb_loading_kind_at(model->kind);
    if (!kind->periodic_cell) {
        return kind->note(model, index, buffer, size);
    }
    const char *law = gb_normal_law_at(model->normal)->name;
    switch (index) {
    case 0:
        if (model->cohesionless) {
            snprintf(buffer, size, "bridges: left out (contact.normal = %s)", law);
            return buffer;
        }
        snprintf(buffer, size, "bridges: %s",
                 terms->bridges
                     ? "carried"
                     : "left out (contact.bridge_length is a diameter or more)");
        return buffer;
    case 1:
        if (terms->friction && model->cohesionless) {
            snprintf(buffer, size,
                     "friction, pivoting and their history: carried, but for pivoting "
                     "(contact.normal = %s)",
                     law);
            return buffer;
        }
        snprintf(buffer, size, "friction, pivoting and their history: %s",
                 terms->friction ? "carried" : "left out (mu = 0, no bridges)");
        return buffer;
    case 2:
        if (model->cohesionless) {
            snprintf(buffer, size, "attraction: left out (contact.normal = %s)", law);
            return buffer;
        }
        snprintf(
            buffer, size,
            terms->attraction && numerics->cutoff <= 1.0
                ? "attraction: between touching particles only (a lattice without "
                  "numerics.cutoff)"
            : terms->attraction
                ? "attraction: carried to %.3f d, where it is %.1e of its contact value"
                : "attraction: left out (material.epsilon = 0)",
            numerics->cutoff,
            gb_law_dispersion_force(&model->dispersion, numerics->cutoff) /
                model->adhesion);
        return buffer;
    case 3:
        return kind->note(model, 0, buffer, size);
    case 4:
        if (model->dimension == 2) {
            snprintf(buffer, size, "third dimension: left out (scene.dimension = 2)");
            return buffer;
        }
        return kind->note(model, 1, buffer, size);
    default:
        return kind->note(model, index - (model->dimension == 2 ? 4 : 3), buffer, size);
    }
}
