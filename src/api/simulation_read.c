/* Read access to a simulation: points, arrays, states; and loading and saving a state. */
#include <math.h>
#include <string.h>

#include <glib.h>

#include "api/arguments.h"
#include "api/parameters_private.h"
#include "api/simulation_private.h"
#include "base/alloc.h"
#include "hdf/hdf_record.h"
#include "io/state.h"
#include "io/state_record.h"
#include "run/checkpoint.h"

size_t gb_simulation_points(const struct gb_simulation *simulation)
{
    return simulation ? gb_curve_count(simulation->curve) : 0;
}

const struct gb_point *gb_simulation_point(const struct gb_simulation *simulation,
                                           size_t index)
{
    return index < gb_simulation_points(simulation)
               ? gb_curve_at(simulation->curve, index)
               : NULL;
}

double gb_simulation_progress(const struct gb_simulation *simulation)
{
    const struct gb_experiment *experiment =
        simulation ? simulation->loop.experiment : NULL;
    const double share = experiment ? gb_experiment_progress(experiment) : 0.0;
    return isfinite(share) ? share : 0.0;
}

bool gb_simulation_parameters(const struct gb_simulation *simulation,
                              struct gb_parameters **out, struct gb_error *err)
{
    return gb_arguments_given(simulation, "simulation", err) &&
           gb_arguments_given(out, "out", err) &&
           gb_parameters_wrap(out, &simulation->params, err);
}

static bool has_packing(const struct gb_simulation *simulation, const char *what,
                        struct gb_error *err)
{
    return simulation->loop.experiment != NULL ||
           gb_error_set(err, GB_ERR_INPUT,
                        "%.40s: no packing yet; the first advance builds it", what);
}

bool gb_simulation_array(struct gb_simulation *simulation, const char *name,
                         struct gb_array *array, struct gb_error *err)
{
    return gb_simulation_usable(simulation, true, err) &&
           gb_arguments_given(name, "name", err) && has_packing(simulation, name, err) &&
           gb_array_find(&simulation->packing, name, array, err);
}

/* Copies the arrays of the engine that the list of contacts lacks. */
static bool copy_optional(struct gb_array_source *packing, struct gb_state *state,
                          struct gb_error *err)
{
    double **const members[] = {&state->velocity, &state->spin, &state->force,
                                &state->torque};
    static const char *const names[] = {"velocity", "spin", "force", "torque"};
    for (size_t k = 0; k < G_N_ELEMENTS(members); k++) {
        struct gb_array array = {.size = sizeof array};
        struct gb_error none = {0};
        if (!gb_array_find(packing, names[k], &array, &none)) {
            if (none.code == GB_ERR_INPUT) {
                continue; /* a scene without time */
            }
            return gb_error_set(err, none.code, "%s", none.text);
        }
        if (!gb_state_optional_allocate(state, members[k], err)) {
            return false;
        }
        for (int64_t i = 0; i < state->count; i++) {
            memcpy(*members[k] + 3 * i, (const char *)array.data + i * array.stride[0],
                   3 * sizeof(double));
        }
    }
    return true;
}

bool gb_simulation_state(struct gb_simulation *simulation, struct gb_saved_state **out,
                         struct gb_error *err)
{
    if (!gb_simulation_usable(simulation, true, err) ||
        !gb_arguments_given(out, "out", err) || !has_packing(simulation, "state", err)) {
        return false;
    }
    struct gb_saved_state *saved = gb_alloc_array(1, sizeof *saved, err);
    if (!saved ||
        !gb_experiment_state(simulation->loop.experiment, &saved->packing.state, err) ||
        !copy_optional(&simulation->packing, saved->packing.state, err)) {
        gb_saved_state_destroy(saved);
        return false;
    }
    saved->packing.state->second_per_time =
        gb_array_second_per_time(&simulation->packing);
    *out = saved;
    return true;
}

static bool write(struct gb_simulation *simulation, struct gb_record *record,
                  const char *path, struct gb_error *err)
{
    struct gb_state *state = NULL;
    struct gb_experiment *experiment = simulation->loop.experiment;
    const bool done = gb_checkpoint_take(experiment, record, err) &&
                      gb_state_record(&state, record, gb_experiment_params(experiment),
                                      gb_experiment_model(experiment), err) &&
                      gb_state_write(state, record, path, err);
    gb_state_destroy(state);
    return done;
}

bool gb_simulation_save(struct gb_simulation *simulation, const char *path,
                        struct gb_error *err)
{
    if (!gb_simulation_usable(simulation, true, err) ||
        !gb_arguments_given(path, "path", err)) {
        return false;
    }
    const enum gb_step_outcome last = simulation->loop.last;
    if (gb_simulation_points(simulation) == 0 ||
        (last != GB_STEP_POINT && last != GB_STEP_DONE)) {
        return gb_error_set(
            err, GB_ERR_INPUT,
            "%s: the packing is between two recorded points; a state belongs "
            "to a point",
            path);
    }
    struct gb_record *record = gb_alloc_array(1, sizeof *record, err);
    const bool done = record && write(simulation, record, path, err);
    if (record) {
        gb_record_finish(record);
    }
    gb_alloc_free(record);
    return done;
}

/* Resumes the experiment of a record instead of building a packing. */
static bool load(struct gb_simulation *simulation, struct gb_record *record,
                 const char *path, struct gb_error *err)
{
    struct gb_error why = {0};
    struct gb_experiment *experiment = NULL;
    if (!gb_hdf_record_read(record, path, err)) {
        return false;
    }
    if (!gb_experiment_resume(&experiment, &simulation->params, record, &why)) {
        return gb_error_set(err, why.code, "%s: %s", path, why.text);
    }
    simulation->origin = GB_SIMULATION_LOADED;
    gb_run_loop_attach(&simulation->loop, experiment);
    simulation->packing.experiment = experiment;
    return gb_curve_append(simulation->curve, gb_experiment_point(experiment), err);
}

bool gb_simulation_load(struct gb_simulation **out,
                        const struct gb_parameters *parameters, const char *path,
                        struct gb_error *err)
{
    struct gb_simulation *simulation = NULL;
    if (!gb_arguments_given(out, "out", err) || !gb_arguments_given(path, "path", err) ||
        !gb_simulation_create(&simulation, parameters, err)) {
        return false;
    }
    struct gb_record *record = gb_alloc_array(1, sizeof *record, err);
    const bool done = record && load(simulation, record, path, err);
    if (record) {
        gb_record_finish(record);
    }
    gb_alloc_free(record);
    if (!done) {
        gb_simulation_destroy(simulation);
        return false;
    }
    simulation->loop.last = GB_STEP_POINT;
    *out = simulation;
    return true;
}
