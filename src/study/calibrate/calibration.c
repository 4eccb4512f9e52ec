#include "study/calibrate/calibration.h"

#include <math.h>

#include "base/file.h"
#include "many/reading.h"

/* Cells of the coarse stage: this fraction of the particles, but not fewer. */
enum { COARSE_FRACTION = 8, COARSE_MIN = 200 };

const char *gb_calibration_name(const struct gb_free_key *key, char *buffer, size_t size)
{
    g_snprintf(buffer, (gulong)size, "%s.%s", key->field->group, key->field->key);
    return buffer;
}

/* A smaller cell of the same shape.  Errors: GB_ERR_INPUT for too few particles. */
static bool make_coarse(struct gb_params *params, struct gb_error *err)
{
    const int64_t count = params->count / COARSE_FRACTION;
    if (count < COARSE_MIN) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "a coarse cell of %lld particles: accepted %d at least",
                            (long long)count, (int)COARSE_MIN);
    }
    params->base.value *= cbrt((double)count / (double)params->count);
    params->count = count;
    return gb_params_check(params, err);
}

/* "coarse_1_mu-0.13_alpha-0.37_seed-2": depends on the parameters of the run only. */
static char *directory_of(const struct gb_calibration *calibration,
                          enum gb_calibrate_stage stage, size_t scene, const double *at,
                          uint64_t seed)
{
    GString *name = g_string_new(NULL);
    g_string_printf(name, "%s/runs/%s_%zu", calibration->directory,
                    stage == GB_CALIBRATE_COARSE ? "coarse" : "full", scene + 1);
    for (size_t k = 0; k < calibration->keys.count; k++) {
        g_string_append_printf(name, "_%s-%.10g", calibration->keys.key[k].field->key,
                               at[k]);
    }
    g_string_append_printf(name, "_seed-%" G_GUINT64_FORMAT, seed);
    return g_string_free(name, FALSE);
}

/* A batch of parameters as runs: point p of scene s is p x scenes + s. */
static bool fill(const struct gb_calibration *calibration, const double *parameters,
                 enum gb_calibrate_stage stage, struct gb_ensemble *ensemble,
                 struct gb_error *err)
{
    const size_t scenes = calibration->lab.scenes;
    for (size_t i = 0; i < ensemble->points * ensemble->replicas; i++) {
        struct gb_ensemble_run *run = &ensemble->run[i];
        const double *at = parameters + run->point / scenes * calibration->keys.count;
        const size_t scene = run->point % scenes;
        run->params = calibration->lab.scene[scene];
        run->params.seed += run->replica;
        run->params.threads = run->params.threads > 0 ? run->params.threads : 1;
        if (!gb_free_keys_apply(&calibration->keys, at, &run->params, err) ||
            (stage == GB_CALIBRATE_COARSE && !make_coarse(&run->params, err)) ||
            !gb_params_check(&run->params, err)) {
            return false;
        }
        run->directory = directory_of(calibration, stage, scene, at, run->params.seed);
    }
    return true;
}

/* Values of one run for the rows of its scene; NaN where it failed. */
static void read_values(const struct gb_calibration *calibration,
                        const struct gb_ensemble_run *run, double *out)
{
    const struct gb_labdata *lab = &calibration->lab;
    struct gb_table *curve = NULL;
    const bool good =
        run->error.code == GB_OK && gb_reading_open(&curve, run->directory, NULL);
    for (size_t i = 0; i < lab->count; i++) {
        const struct gb_labdata_row *row = &lab->row[i];
        if (row->scene != run->point % lab->scenes) {
            continue;
        }
        out[i] = good ? gb_labdata_simulated(row, curve) : (double)NAN;
    }
    gb_table_destroy(curve);
}

static bool simulate(const double *parameters, size_t points,
                     enum gb_calibrate_stage stage, double *out, void *context,
                     struct gb_error *err)
{
    struct gb_calibration *calibration = context;
    const size_t data = calibration->lab.count;
    const size_t scenes = calibration->lab.scenes;
    const size_t replicas = calibration->replicas;
    struct gb_ensemble ensemble;
    const bool good = gb_ensemble_init(&ensemble, points * scenes, replicas, err) &&
                      fill(calibration, parameters, stage, &ensemble, err) &&
                      gb_ensemble_find_done(&ensemble, err) &&
                      calibration->work(&ensemble, calibration->data, err);
    for (size_t i = 0; good && i < ensemble.points * replicas; i++) {
        const struct gb_ensemble_run *run = &ensemble.run[i];
        const size_t point = run->point / scenes;
        if (run->error.code == GB_ERR_MACHINE && calibration->machine.code == GB_OK) {
            calibration->machine = run->error;
        }
        read_values(calibration, run, out + (point * replicas + run->replica) * data);
    }
    gb_ensemble_finish(&ensemble);
    return good;
}

static void add_rounds_header(const struct gb_calibration *calibration)
{
    GString *text = calibration->rounds;
    char name[96];
    g_string_append(text, "cells,round");
    for (size_t k = 0; k < calibration->keys.count; k++) {
        gb_calibration_name(&calibration->keys.key[k], name, sizeof name);
        g_string_append_printf(text, ",%s,within_%s", name, name);
    }
    g_string_append_c(text, '\n');
}

/* A row of rounds.csv, for other programs that follow the fit; the fit continues when it
 * cannot be written. */
static void add_round(enum gb_calibrate_stage stage, int round, const double *best,
                      const double *half_width, void *context)
{
    struct gb_calibration *calibration = context;
    GString *text = calibration->rounds;
    g_string_append_printf(text, "%s,%d", stage == GB_CALIBRATE_COARSE ? "small" : "full",
                           round);
    for (size_t k = 0; k < calibration->keys.count; k++) {
        g_string_append_printf(text, ",%.5g,%.3g", best[k], half_width[k]);
    }
    g_string_append_c(text, '\n');
    char *path = g_build_filename(calibration->directory, "rounds.csv", NULL);
    (void)gb_file_replace(path, text->str, text->len, NULL);
    g_free(path);
    if (calibration->progress != NULL) {
        calibration->progress(calibration, stage, round, best, half_width,
                              calibration->data);
    }
}

static struct gb_calibrate_problem problem_of(struct gb_calibration *calibration)
{
    struct gb_calibrate_problem problem = {.free = calibration->keys.count,
                                           .data = calibration->lab.count,
                                           .value = calibration->lab.value,
                                           .error = calibration->lab.error,
                                           .weight = calibration->lab.weight,
                                           .replicas = calibration->replicas,
                                           .coarse_stage = true,
                                           .simulate = simulate,
                                           .progress = add_round,
                                           .context = calibration};
    for (size_t k = 0; k < calibration->keys.count; k++) {
        problem.low[k] = calibration->keys.key[k].low;
        problem.high[k] = calibration->keys.key[k].high;
        problem.from[k] = calibration->keys.key[k].from;
        problem.to[k] = calibration->keys.key[k].to;
    }
    for (size_t s = 0; s < calibration->lab.scenes; s++) {
        struct gb_params smaller = calibration->lab.scene[s];
        problem.coarse_stage = problem.coarse_stage && make_coarse(&smaller, NULL);
    }
    return problem;
}

bool gb_calibration_fit(struct gb_calibration *calibration, struct gb_error *err)
{
    const struct gb_calibrate_problem problem = problem_of(calibration);
    calibration->rounds = g_string_new(NULL);
    add_rounds_header(calibration);
    if (gb_calibrate_fit(&problem, &calibration->result, err)) {
        return true;
    }
    /* where runs are missing because of a full disk, that is the error */
    if (err->code == GB_ERR_GUARD && calibration->machine.code != GB_OK) {
        *err = calibration->machine;
    }
    return false;
}

void gb_calibration_finish(struct gb_calibration *calibration)
{
    gb_calibrate_finish(&calibration->result);
    gb_labdata_finish(&calibration->lab);
    if (calibration->rounds != NULL) {
        g_string_free(calibration->rounds, TRUE);
        calibration->rounds = NULL;
    }
}
