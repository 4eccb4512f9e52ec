/* Compacts in memory: pressed once, then followed along other paths on copies. */
#include "study/compact.h"

#include <glib.h>
#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include "measure/elastic.h"
#include "measure/yield_point.h"
#include "run/checkpoint.h"
#include "run/experiment.h"
#include "scene/field/changes.h"
#include "scene/path/path.h"
#include "scene/tolerances.h"
#include "solve/moduli/moduli.h"

/* --- pressing, and paths of copies ---------------------------------------------------- */

/* Force evaluations between two looks at whether to stop. */
enum { SLICE = 2000 };

/* Strain step of unloading: that of the preset is one of loading. */
static const double hold_step = 5e-4;

static bool is_cancelled(const struct gb_pool_callbacks *callbacks)
{
    return callbacks != NULL && callbacks->cancelled != NULL &&
           callbacks->cancelled(callbacks->data);
}

/* Advances to the point at which the walk has enough. */
static enum gb_compact_outcome advance(struct gb_experiment *experiment,
                                       const struct gb_compact_walk *walk,
                                       struct gb_error *err)
{
    for (;;) {
        if (is_cancelled(walk->callbacks)) {
            gb_error_set(err, GB_ERR_CANCELLED, "stopped on request");
            return GB_COMPACT_FAILED;
        }
        switch (gb_experiment_advance(experiment, SLICE, err)) {
        case GB_STEP_MORE:
            break;
        case GB_STEP_POINT:
            if (!walk->take(walk->data, gb_experiment_point(experiment))) {
                return GB_COMPACT_TAKEN;
            }
            break;
        case GB_STEP_DONE:
            return GB_COMPACT_ENDED;
        case GB_STEP_STOPPED:
            return err->code == GB_ERR_GUARD || err->code == GB_ERR_NOT_CONVERGED
                       ? GB_COMPACT_STOPPED
                       : GB_COMPACT_FAILED;
        }
    }
}

static bool keep(struct gb_compact *to, struct gb_experiment *experiment,
                 struct gb_error *err)
{
    to->params = *gb_experiment_params(experiment);
    to->point = *gb_experiment_point(experiment);
    to->tolerance = (double)NAN;
    return gb_checkpoint_take(experiment, &to->record, err);
}

/* Neither attraction nor bridges: no strength, and no pressure below random packing. */
static bool check_cohesion(const struct gb_params *params, struct gb_error *err)
{
    struct gb_model model;
    return gb_model_init(&model, params, err) &&
           (model.terms.attraction || model.terms.bridges ||
            gb_error_set(err, GB_ERR_INPUT,
                         "material.epsilon, contact.bridge_length: without attraction "
                         "(rod law, epsilon above 0) and bridges (below 1 d) a compact "
                         "does not hold together: must have one of them"));
}

bool gb_compact_params(struct gb_params *params, const struct gb_params *preset,
                       struct gb_error *err)
{
    if (preset->kind != GB_KIND_QUASISTATIC || preset->dimension != 3) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "scene.kind and scene.dimension: must be quasistatic and 3: "
                            "yield and strength are measured in a periodic cell");
    }
    if (!check_cohesion(preset, err)) {
        return false;
    }
    *params = *preset;
    params->changes[0] = '\0';
    params->unload_count = 0;
    return true;
}

/* The geometry as a path beyond the mark, so that the run has not ended there. */
static void set_path(struct gb_params *params, const struct gb_keep_point *mark,
                     bool sheared)
{
    static const char *const words[] = {[GB_GEOMETRY_UNIAXIAL] = "uniaxial",
                                        [GB_GEOMETRY_BIAXIAL] = "biaxial",
                                        [GB_GEOMETRY_ISOTROPIC] = "isotropic"};
    const char *word = words[params->geometry];
    if (params->path[0] != '\0') {
        g_strlcat(params->path, sheared ? "; shear xz to 1 %" : "", sizeof params->path);
        return;
    }
    if (mark->by_density) {
        snprintf(params->path, sizeof params->path,
                 "%s to density %.9g; %s to density 0.99", word, mark->value, word);
    } else {
        snprintf(params->path, sizeof params->path, "%s to %.9g MPa; %s to density 0.99",
                 word, 1e-6 * mark->value, word);
    }
    g_strlcat(params->path, sheared ? "; shear xz to 1 %" : "", sizeof params->path);
}

static bool before_mark(void *data, const struct gb_point *point)
{
    const struct gb_keep_point *mark = data;
    return mark->by_density ? point->density < mark->value * (1.0 - 1e-6)
                            : point->p_pa < mark->value * (1.0 - GB_PATH_END_SHARE);
}

static bool refuse(enum gb_compact_outcome outcome, const struct gb_keep_point *mark,
                   struct gb_error *err)
{
    const struct gb_error why = *err;
    const double value = mark->by_density ? mark->value : 1e-6 * mark->value;
    if (outcome == GB_COMPACT_FAILED) {
        return false;
    }
    return gb_error_set(err, GB_ERR_GUARD, "pressing ends before %s %g%s%s%.200s",
                        mark->by_density ? "density" : "pressure", value,
                        mark->by_density ? "" : " MPa",
                        outcome == GB_COMPACT_STOPPED ? ": " : "",
                        outcome == GB_COMPACT_STOPPED ? why.text : "");
}

bool gb_compact_press(struct gb_compact *compact, const struct gb_params *params,
                      const struct gb_keep_point *mark,
                      const struct gb_pool_callbacks *callbacks, struct gb_error *err)
{
    struct gb_experiment *experiment = NULL;
    struct gb_keep_point wanted = *mark;
    const struct gb_compact_walk walk = {before_mark, &wanted, callbacks};
    struct gb_params own = *params;
    set_path(&own, mark, compact->sheared);
    if (!gb_experiment_create(&experiment, &own,
                              callbacks != NULL ? callbacks->cancelled : NULL,
                              callbacks != NULL ? callbacks->data : NULL, err)) {
        return false;
    }
    const enum gb_compact_outcome outcome = advance(experiment, &walk, err);
    const bool good = outcome == GB_COMPACT_TAKEN ? keep(compact, experiment, err)
                                                  : refuse(outcome, mark, err);
    gb_experiment_destroy(experiment);
    return good;
}

/* The parameters of the compact, then the legs. */
static bool set_legs(struct gb_params *params, const struct gb_compact *from,
                     const char *path, double step, struct gb_error *err)
{
    char text[sizeof params->changes];
    gb_changes_effective(&from->params, from->point.step, params);
    params->changes[0] = '\0';
    if (isfinite(from->tolerance)) {
        params->tolerance = from->tolerance;
        params->tolerance_scale = GB_TOLERANCE_CONTACT;
    }
    snprintf(text, sizeof text, "loading.path=%s%s; loading.step=%.9g", path,
             from->sheared ? " then shear xz to 1 %" : "", step);
    return gb_changes_add(params, from->point.step, text, err);
}

enum gb_compact_outcome gb_compact_follow(struct gb_compact *from, const char *path,
                                          double step, const struct gb_compact_walk *walk,
                                          struct gb_compact *to, struct gb_error *err)
{
    struct gb_experiment *experiment = NULL;
    struct gb_params params;
    if (!set_legs(&params, from, path, step, err) ||
        !gb_experiment_resume(&experiment, &params, &from->record, err)) {
        return GB_COMPACT_FAILED;
    }
    enum gb_compact_outcome outcome = advance(experiment, walk, err);
    if (outcome == GB_COMPACT_TAKEN && to != NULL) {
        outcome = keep(to, experiment, err) ? outcome : GB_COMPACT_FAILED;
        to->tolerance = from->tolerance;
        to->sheared = from->sheared;
    }
    gb_experiment_destroy(experiment);
    return outcome;
}

/* The leg along which axial and lateral pressure (p_x = p_y) change in proportion: the axis
 * that changes more is strained, the other follows.  end: of that axis, as "3 %" or
 * "50 MPa".  Returns buffer. */
static char *leg_of(double axial, double lateral, const char *end, char *buffer,
                    size_t size)
{
    if (fabs(axial) >= fabs(lateral)) {
        snprintf(buffer, size, "strain z = 1 to %s at x = y by %.12f z", end,
                 lateral / axial);
    } else {
        snprintf(buffer, size, "strain x = 1, y = 1 to %s at z by %.12f x", end,
                 axial / lateral);
    }
    return buffer;
}

/* Every point is taken until the second leg. */
static bool before_second_leg(void *data, const struct gb_point *point)
{
    (void)data;
    return !(point->leg >= 2.0);
}

/* The leg of one attempt at unloading and its strain step; false behind the last.  The
 * first is by equal strains, where no stress has to be held. */
static bool unloading(const struct gb_point *at, double pressure_pa, int attempt,
                      char *leg, size_t size, double *step)
{
    static const double steps[] = {1.0, 2.0, 4.0, 0.5};
    static const double nearly_equal = 0.1;
    char end[64];
    const struct gb_compact_state state = gb_compact_state_of(at);
    const double axial = pressure_pa - at->pz_pa;
    const double lateral = pressure_pa - 0.5 * (at->px_pa + at->py_pa);
    if (attempt < 0 && fabs(state.q) < nearly_equal * state.p) {
        snprintf(leg, size, "isotropic to %.9g MPa", 1e-6 * pressure_pa);
        *step = hold_step;
        return true;
    }
    attempt = attempt < 0 ? 0 : attempt;
    snprintf(end, sizeof end, "%s = %.9g MPa", fabs(axial) >= fabs(lateral) ? "z" : "x",
             1e-6 * pressure_pa);
    leg_of(axial, lateral, end, leg, size);
    *step = hold_step * steps[attempt < 4 ? attempt : 0];
    return attempt < 4;
}

static bool at_once(void *data, const struct gb_point *point)
{
    (void)data;
    (void)point;
    return false;
}

/* A copy at rest at the tolerance of copies: the stresses of a compact that was pressed at a
 * looser one fall, and a way to unload it begins at those that are left. */
static bool relax(struct gb_compact *from, const struct gb_pool_callbacks *callbacks,
                  struct gb_compact *rest, struct gb_error *err)
{
    static const double nothing = 1e-6; /* strain */
    const struct gb_compact_walk walk = {at_once, NULL, callbacks};
    const enum gb_compact_outcome outcome =
        gb_compact_follow(from, "strain z = 1 to 0.01 %", nothing, &walk, rest, err);
    return outcome == GB_COMPACT_TAKEN ||
           (outcome == GB_COMPACT_ENDED &&
            gb_error_set(err, GB_ERR_GUARD, "a pressed compact does not come to rest"));
}

/* Follows one way after the other until one gets there. */
static bool unload(struct gb_compact *from, double pressure_pa,
                   const struct gb_pool_callbacks *callbacks, struct gb_compact *to,
                   struct gb_error *err)
{
    char leg[GB_LEG_TEXT], path[2 * GB_LEG_TEXT];
    const struct gb_compact_walk walk = {before_second_leg, NULL, callbacks};
    struct gb_error why = {0};
    double step;
    for (int attempt = -1;
         unloading(&from->point, pressure_pa, attempt, leg, sizeof leg, &step);
         attempt++) {
        snprintf(path, sizeof path, "%s then hold 100 times", leg);
        const enum gb_compact_outcome outcome =
            gb_compact_follow(from, path, step, &walk, to, &why);
        if (outcome == GB_COMPACT_TAKEN) {
            return true;
        }
        if (outcome == GB_COMPACT_FAILED) {
            return gb_error_set(err, why.code, "%s", why.text);
        }
    }
    return gb_error_set(err, GB_ERR_GUARD, "unloading to %g MPa: %.200s",
                        1e-6 * pressure_pa, why.text);
}

bool gb_compact_unload(struct gb_compact *from, double pressure_pa,
                       const struct gb_pool_callbacks *callbacks, struct gb_compact *to,
                       struct gb_error *err)
{
    struct gb_compact rest = {0};
    if (!isfinite(from->tolerance)) {
        return unload(from, pressure_pa, callbacks, to, err);
    }
    const bool good = relax(from, callbacks, &rest, err) &&
                      unload(&rest, pressure_pa, callbacks, to, err);
    gb_compact_finish(&rest);
    return good;
}

bool gb_compact_elastic(struct gb_compact_elastic *elastic, struct gb_compact *compact,
                        const struct gb_pool_callbacks *callbacks, struct gb_error *err)
{
    const struct gb_moduli_options options = {
        .cancelled = callbacks != NULL ? callbacks->cancelled : NULL,
        .data = callbacks != NULL ? callbacks->data : NULL};
    struct gb_experiment *experiment = NULL;
    struct gb_error why = {0};
    struct gb_moduli moduli;
    double by_volume[2], by_shear[2];
    if (!gb_experiment_resume(&experiment, &compact->params, &compact->record, err)) {
        return false;
    }
    const bool good =
        gb_moduli_measure(&moduli, gb_experiment_world(experiment), &options, &why);
    gb_experiment_destroy(experiment);
    if (!good) {
        return gb_error_set(err, why.code == GB_ERR_INPUT ? GB_ERR_GUARD : why.code,
                            "elastic constants at density %.4f: %.300s",
                            compact->point.density, why.text);
    }
    for (int k = 0; k < 36; k++) {
        moduli.c[k / 6][k % 6] *= compact->params.young_pa;
    }
    const struct gb_elastic_averages mean =
        gb_elastic_average((const double(*)[6])moduli.c);
    elastic->bulk = mean.bulk;
    elastic->shear_modulus = mean.shear;
    gb_elastic_plane((const double(*)[6])moduli.c, by_volume, by_shear);
    if (!(mean.bulk > 0.0) || !(mean.shear > 0.0) ||
        !gb_yield_point_elastic(&elastic->plane, by_volume, by_shear)) {
        return gb_error_set(err, GB_ERR_GUARD, "the compact of density %.4f is not stiff",
                            compact->point.density);
    }
    return true;
}

void gb_compact_finish(struct gb_compact *compact)
{
    gb_record_finish(&compact->record);
    memset(compact, 0, sizeof *compact);
}

struct gb_compact_state gb_compact_state_of(const struct gb_point *point)
{
    const double *e = point->strain;
    return (struct gb_compact_state){
        .p = (point->px_pa + point->py_pa + point->pz_pa) / 3.0,
        .q = point->pz_pa - 0.5 * (point->px_pa + point->py_pa),
        .volume = e[0] + e[1] + e[2],
        .shear = 2.0 / 3.0 * (e[2] - 0.5 * (e[0] + e[1])),
    };
}

/* --- probes --------------------------------------------------------------------------- */

/* What the growing probe is compared with at each point. */
struct growing {
    struct gb_compact_probe *probe;
    double enough;
};

/* e_z = v/3 + w and e_x = e_y = v/3 - w/2. */
char *gb_compact_probe_leg(double volume, double shear, double strain_most, char *buffer,
                           size_t size)
{
    const double axial = volume / 3.0 + shear, lateral = volume / 3.0 - 0.5 * shear;
    if (fabs(axial) >= fabs(lateral)) {
        snprintf(buffer, size, "strain z = 1, x = %.12f, y = %.12f to %.9g %%",
                 lateral / axial, lateral / axial, 100.0 * copysign(strain_most, axial));
    } else {
        snprintf(buffer, size, "strain x = 1, y = 1, z = %.12f to %.9g %%",
                 axial / lateral, 100.0 * copysign(strain_most, lateral));
    }
    return buffer;
}

/* Columns of the states, for g_free. */
static double *columns_of(const struct gb_compact_probe *probe,
                          struct gb_yield_path *path)
{
    const size_t count = probe->state->len;
    double *column = g_new(double, 4 * count);
    for (size_t i = 0; i < count; i++) {
        const struct gb_compact_state *state =
            &g_array_index(probe->state, struct gb_compact_state, i);
        column[i] = state->p;
        column[count + i] = state->q;
        column[2 * count + i] = state->volume;
        column[3 * count + i] = state->shear;
    }
    *path = (struct gb_yield_path){
        column, column + count,  column + 2 * count, column + 3 * count,
        count,  probe->direction};
    return column;
}

bool gb_compact_probe_point(const struct gb_compact_probe *probe, double offset,
                            double flow_end, struct gb_yield_point *point)
{
    struct gb_yield_path path;
    double *columns = columns_of(probe, &path);
    const bool reached =
        gb_yield_point_find(&path, &probe->elastic, offset, flow_end, point);
    g_free(columns);
    return reached;
}

static bool take(void *data, const struct gb_point *point)
{
    const struct growing *growing = data;
    struct gb_yield_point ignored;
    const struct gb_compact_state state = gb_compact_state_of(point);
    g_array_append_val(growing->probe->state, state);
    return !gb_compact_probe_point(growing->probe, growing->enough, 1.0, &ignored);
}

bool gb_compact_probe_run(struct gb_compact_probe *probe, struct gb_compact *inside,
                          double direction, const struct gb_yield_elastic *elastic,
                          const struct gb_compact_probe_steps *steps,
                          const struct gb_pool_callbacks *callbacks, struct gb_error *err)
{
    char leg[GB_LEG_TEXT];
    const double(*compliance)[2] = elastic->compliance;
    const double p = cos(direction), q = sin(direction);
    struct growing growing = {probe, steps->enough};
    const struct gb_compact_walk walk = {take, &growing, callbacks};
    const struct gb_compact_state start = gb_compact_state_of(&inside->point);
    probe->direction = direction;
    probe->elastic = *elastic;
    probe->state = g_array_new(FALSE, FALSE, sizeof(struct gb_compact_state));
    g_array_append_val(probe->state, start);
    gb_compact_probe_leg(compliance[0][0] * p + compliance[0][1] * q,
                         compliance[1][0] * p + compliance[1][1] * q, steps->strain_most,
                         leg, sizeof leg);
    probe->outcome =
        gb_compact_follow(inside, leg, steps->step, &walk, NULL, &probe->why);
    return probe->outcome != GB_COMPACT_FAILED ||
           gb_error_set(err, probe->why.code, "%s", probe->why.text);
}

void gb_compact_probe_finish(struct gb_compact_probe *probe)
{
    if (probe->state != NULL) {
        g_array_unref(probe->state);
    }
    probe->state = NULL;
}
