/* A Drucker-Prager cap card.  Each cell is pressed to every density, unloaded to half
 * of its mean pressure and probed.  A surface is fitted to the mean yield points of the
 * cells at each density.  Repeating the fit without each cell in turn gives the
 * intervals (jackknife).  Finally, the pressing curves that the card predicts are
 * compared with the simulated ones. */

#include "study/card.h"

#include <glib.h>
#include <gsl/gsl_cdf.h>
#include <math.h>
#include <pthread.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "base/alloc.h"
#include "base/clock.h"
#include "base/listing.h"
#include "base/team.h"
#include "greenbody/params.h"
#include "greenbody/status.h"
#include "many/pool.h"
#include "measure/average.h"
#include "measure/cap.h"
#include "measure/cap_fit.h"
#include "measure/fit.h"
#include "measure/yield_point.h"
#include "scene/path/path.h"
#include "scene/seed.h"
#include "study/compact.h"

/* --- what is measured ----------------------------------------------------------------- */

/* What one cell (replica) gives a card: compacts pressed to a list of densities, the yield
 * points of each, their elastic constants, and the curves of pressing the same powder along
 * each path. */

/* Beyond 135 degrees it is tension.  The surface of a compact that was pressed uniaxially is
 * not the same in extension: only compression counts. */
const struct gb_card_path_row gb_card_paths[GB_CARD_PATHS] = {
    [GB_CARD_UNIAXIAL] = {"uniaxial", "uniaxial to density 0.99", 0.0, 0.75 * M_PI},
    [GB_CARD_ISOTROPIC] = {"isotropic", "isotropic to density 0.99", -0.75 * M_PI,
                           0.75 * M_PI},
};

bool gb_card_path_of(enum gb_card_path *path, const char *name, struct gb_error *err)
{
    for (int k = 0; k < GB_CARD_PATHS; k++) {
        if (strcmp(name, gb_card_paths[k].name) == 0) {
            *path = (enum gb_card_path)k;
            return true;
        }
    }
    return gb_error_set(err, GB_ERR_INPUT,
                        "--compacts '%.40s': expected uniaxial, isotropic", name);
}

void gb_card_options_init(struct gb_card_options *options)
{
    *options = (struct gb_card_options){.replicas = 8,
                                        .directions = 19,
                                        .inside = 0.5,
                                        .offset = 1e-2,
                                        .step = 1e-4,
                                        .strain_most = 0.06,
                                        .press_tolerance = 5e-3,
                                        .tolerance = 1e-3,
                                        .transition = GB_CAP_TRANSITION,
                                        .flow = 1.0};
}

double gb_card_direction(const struct gb_card_options *options, int index)
{
    const struct gb_card_path_row *row = &gb_card_paths[options->path];
    return row->direction_from +
           (row->direction_to - row->direction_from) * index / (options->directions - 1);
}

static bool refuse(struct gb_error *err, const char *name, double value,
                   const char *accepted)
{
    return gb_error_set(err, GB_ERR_INPUT, "--%s %g: expected %s", name, value, accepted);
}

bool gb_card_options_check(const struct gb_card_options *options, struct gb_error *err)
{
    if (options->replicas < 3 || options->replicas > 1000) {
        return refuse(err, "replicas", options->replicas, "3 to 1000");
    }
    if (options->directions < 15 || options->directions > GB_CARD_DIRECTIONS_MAX) {
        return refuse(err, "directions", options->directions, "15 to 72");
    }
    if (!(options->offset >= 1e-4 && options->offset <= 0.02)) {
        return refuse(err, "offset", 100.0 * options->offset, "0.01 to 2 %");
    }
    if (!(options->transition >= 0.0 && options->transition <= 0.1)) {
        return refuse(err, "transition", options->transition, "0 to 0.1");
    }
    if (!(options->flow >= 0.0 && options->flow <= 10.0)) {
        return refuse(err, "flow", options->flow, "0 to 10");
    }
    for (int k = 0; k < options->levels; k++) {
        const double density = options->density[k];
        if (!(density > 0.0 && density < 0.95) ||
            (k > 0 && density <= options->density[k - 1])) {
            return refuse(err, "densities", density, "0 to 0.95, ascending");
        }
    }
    return true;
}

/* --- one cell ------------------------------------------------------------------------- */

/* Share of the top pressure at which the lowest density of a card is pressed. */
static const double lowest_share = 0.05;

/* Strain step of unloading to the point inside. */
static const double unload_step = 5e-4;

/* A walk that records and ends at a density or a pressure. */
struct record {
    GArray *curve;                        /* NULL: not recorded */
    double density_most, p_most, p_least; /* that end it */
};

static bool take(void *data, const struct gb_point *point)
{
    const struct record *record = data;
    const double p = gb_compact_state_of(point).p;
    if (record->curve != NULL) {
        const struct gb_card_pressed row = {
            point->density, 0.5 * (point->px_pa + point->py_pa), point->pz_pa};
        g_array_append_val(record->curve, row);
    }
    return point->density < record->density_most && p < record->p_most &&
           p > record->p_least;
}

static bool follow(struct gb_compact *from, const char *path, double step,
                   struct record *record, const struct gb_pool_callbacks *callbacks,
                   struct gb_compact *to, struct gb_error *err)
{
    const struct gb_compact_walk walk = {take, record, callbacks};
    switch (gb_compact_follow(from, path, step, &walk, to, err)) {
    case GB_COMPACT_TAKEN:
        return true;
    case GB_COMPACT_ENDED:
        return gb_error_set(err, GB_ERR_GUARD, "card: '%s' ends before its density",
                            path);
    default:
        return false;
    }
}

/* The loose packing at its first recorded point. */
static bool start(struct gb_compact *loose, const struct gb_params *preset, int replica,
                  const struct gb_card_options *options,
                  const struct gb_pool_callbacks *callbacks, struct gb_error *err)
{
    struct gb_params params;
    const struct gb_keep_point at_once = {.by_density = true, .value = 0.0};
    if (!gb_compact_params(&params, preset, err)) {
        return false;
    }
    params.geometry = GB_GEOMETRY_ISOTROPIC;
    params.seed += (uint64_t)(replica - 1);
    params.threads = 1;
    params.tolerance = options->press_tolerance;
    params.tolerance_scale = GB_TOLERANCE_CONTACT;
    g_strlcpy(params.path, "isotropic to density 0.99", sizeof params.path);
    return gb_compact_press(loose, &params, &at_once, callbacks, err);
}

static bool record_curves(struct gb_card_cell *cell, struct gb_compact *loose,
                          const struct gb_card_options *options,
                          const struct gb_pool_callbacks *callbacks, struct gb_error *err)
{
    bool good = true;
    for (int k = 0; k < GB_CARD_PATHS && good; k++) {
        struct record record = {cell->curve[k], options->density[options->levels - 1],
                                INFINITY, -INFINITY};
        good = follow(loose, gb_card_paths[k].leg, loose->params.strain_step, &record,
                      callbacks, NULL, err);
    }
    return good;
}

/* A copy at `inside` of the pressure and q = 0.  An isotropic compact, which is nearly there,
 * unloads by equal strains. */
static bool unload(struct gb_compact *top, double inside_pa,
                   const struct gb_card_options *options,
                   const struct gb_pool_callbacks *callbacks, struct gb_compact *inside,
                   struct gb_error *err)
{
    struct record record = {NULL, INFINITY, INFINITY, inside_pa};
    char path[GB_LEG_TEXT];
    if (options->path != GB_CARD_ISOTROPIC) {
        return gb_compact_unload(top, inside_pa, callbacks, inside, err);
    }
    snprintf(path, sizeof path, "isotropic to %.9g MPa",
             -1e-6 * gb_compact_state_of(&top->point).p);
    return follow(top, path, unload_step, &record, callbacks, inside, err);
}

/* All directions.  The plastic strain of a probe is known as it grows: it ends at the offset,
 * and so does its flow. */
static bool probe_level(struct gb_card_cell *cell, struct gb_compact *inside, int replica,
                        double density, const struct gb_yield_elastic *elastic,
                        const struct gb_card_options *options,
                        const struct gb_pool_callbacks *callbacks, struct gb_error *err)
{
    const struct gb_compact_probe_steps steps = {.step = options->step,
                                                 .strain_most = options->strain_most,
                                                 .enough = options->offset};
    for (int k = 0; k < options->directions; k++) {
        struct gb_compact_probe probe = {.state = NULL};
        struct gb_yield_point point;
        const bool good =
            gb_compact_probe_run(&probe, inside, gb_card_direction(options, k), elastic,
                                 &steps, callbacks, err);
        if (good && gb_compact_probe_point(&probe, options->offset, 1.0, &point)) {
            point.replica = replica;
            point.density = density;
            point.p_error_pa = point.q_error_pa = (double)NAN;
            g_array_append_val(cell->point, point);
        }
        gb_compact_probe_finish(&probe);
        if (!good) {
            return false;
        }
    }
    return true;
}

/* Copies of the compact are relaxed more tightly than it was pressed. */
static bool measure_level(struct gb_card_cell *cell, int index, int replica,
                          struct gb_compact *top, const struct gb_card_options *options,
                          const struct gb_pool_callbacks *callbacks, struct gb_error *err)
{
    struct gb_card_level *level = &cell->level[index];
    const struct gb_compact_state state = gb_compact_state_of(&top->point);
    const double before = top->tolerance;
    struct gb_compact inside = {0};
    struct gb_compact_elastic elastic;
    level->density = top->point.density;
    level->p_pa = state.p;
    level->q_pa = state.q;
    top->tolerance = options->tolerance;
    bool good =
        unload(top, options->inside * state.p, options, callbacks, &inside, err) &&
        gb_compact_elastic(&elastic, &inside, callbacks, err);
    top->tolerance = before;
    if (good) {
        level->inside_pa = gb_compact_state_of(&inside.point).p;
        level->bulk = elastic.bulk;
        level->shear_modulus = elastic.shear_modulus;
        good = probe_level(cell, &inside, replica, options->density[index],
                           &elastic.plane, options, callbacks, err);
    }
    gb_compact_finish(&inside);
    return good;
}

bool gb_card_cell_measure(struct gb_card_cell *cell, const struct gb_params *preset,
                          int replica, const struct gb_card_options *options,
                          const struct gb_pool_callbacks *callbacks, struct gb_error *err)
{
    const char *leg = gb_card_paths[options->path].leg;
    struct gb_compact now = {0};
    cell->point = g_array_new(FALSE, FALSE, sizeof(struct gb_yield_point));
    for (int k = 0; k < GB_CARD_PATHS; k++) {
        cell->curve[k] = g_array_new(FALSE, FALSE, sizeof(struct gb_card_pressed));
    }
    bool good = start(&now, preset, replica, options, callbacks, err) &&
                record_curves(cell, &now, options, callbacks, err);
    for (int k = 0; k < options->levels && good; k++) {
        struct gb_compact top = {0};
        struct record record = {NULL, options->density[k], INFINITY, -INFINITY};
        good = follow(&now, leg, now.params.strain_step, &record, callbacks, &top, err);
        gb_compact_finish(&now);
        now = top;
        good = good && measure_level(cell, k, replica, &now, options, callbacks, err);
    }
    gb_compact_finish(&now);
    return good;
}

void gb_card_cell_finish(struct gb_card_cell *cell)
{
    if (cell->point != NULL) {
        g_array_free(cell->point, TRUE);
        for (int k = 0; k < GB_CARD_PATHS; k++) {
            g_array_free(cell->curve[k], TRUE);
        }
    }
    memset(cell, 0, sizeof *cell);
}

/* Fills densities, evenly spaced between those at 1/20 of and at pressure_pa, from the
 * pressing of the first cell. */
static bool card_cell_scout(struct gb_card_options *options,
                            const struct gb_params *preset, int levels,
                            const struct gb_pool_callbacks *callbacks,
                            struct gb_error *err)
{
    struct gb_compact loose = {0}, low = {0}, high = {0};
    struct record first = {NULL, 0.99, lowest_share * options->pressure_pa, -INFINITY};
    struct record last = {NULL, 0.99, options->pressure_pa, -INFINITY};
    const char *path = gb_card_paths[options->path].leg;
    bool good = start(&loose, preset, 1, options, callbacks, err);
    good = good &&
           follow(&loose, path, loose.params.strain_step, &first, callbacks, &low, err);
    good = good &&
           follow(&low, path, loose.params.strain_step, &last, callbacks, &high, err);
    options->levels = levels;
    for (int k = 0; k < levels && good; k++) {
        const double density =
            low.point.density +
            (high.point.density - low.point.density) * k / (levels - 1);
        options->density[k] = round(1e3 * density) / 1e3;
    }
    gb_compact_finish(&loose);
    gb_compact_finish(&low);
    gb_compact_finish(&high);
    return good;
}

/* --- cells on threads ----------------------------------------------------------------- */

/* The cells of a card, shared by the threads that measure them; the engine of each is its
 * own, and nothing depends on the order. */
struct card_threads {
    const struct gb_card_options *options;
    const struct gb_params *preset;
    const struct gb_card_callbacks *callbacks; /* called by one thread at a time */
    struct gb_card_cell *cell;                 /* of each replica */
    struct gb_error *error;                    /* of each replica */
    GMutex mutex;
    int next, done;
    bool stop;
};

enum { JOBS_MAX = 256 };

/* Room for the replicas.  card_threads_finish is due, also after an error. */
static bool card_threads_init(struct card_threads *threads, struct gb_error *err)
{
    const size_t replicas = (size_t)threads->options->replicas;
    g_mutex_init(&threads->mutex);
    threads->cell = gb_alloc_array(replicas, sizeof *threads->cell, err);
    threads->error = gb_alloc_array(replicas, sizeof *threads->error, err);
    return threads->cell && threads->error;
}

static void card_threads_finish(struct card_threads *threads)
{
    for (int c = 0; c < threads->options->replicas && threads->cell; c++) {
        gb_card_cell_finish(&threads->cell[c]);
    }
    g_mutex_clear(&threads->mutex);
    gb_alloc_free(threads->cell);
    gb_alloc_free(threads->error);
}

static bool is_stopped(void *data)
{
    struct card_threads *threads = data;
    const struct gb_card_callbacks *callbacks = threads->callbacks;
    g_mutex_lock(&threads->mutex);
    if (callbacks->cancelled != NULL && callbacks->cancelled(callbacks->data)) {
        threads->stop = true;
    }
    const bool stop = threads->stop;
    g_mutex_unlock(&threads->mutex);
    return stop;
}

static int take_next(struct card_threads *threads)
{
    g_mutex_lock(&threads->mutex);
    const int next = threads->stop || threads->next >= threads->options->replicas
                         ? -1
                         : threads->next++;
    g_mutex_unlock(&threads->mutex);
    return next;
}

static void report(struct card_threads *threads, bool good)
{
    const struct gb_card_callbacks *callbacks = threads->callbacks;
    g_mutex_lock(&threads->mutex);
    threads->done++;
    threads->stop = threads->stop || !good;
    if (good && callbacks->progress != NULL) {
        callbacks->progress(callbacks->data, threads->done, threads->options->replicas);
    }
    g_mutex_unlock(&threads->mutex);
}

static void *work(void *data)
{
    struct card_threads *threads = data;
    const struct gb_pool_callbacks polled = {.cancelled = is_stopped, .data = threads};
    for (int c = take_next(threads); c >= 0; c = take_next(threads)) {
        report(threads,
               gb_card_cell_measure(&threads->cell[c], threads->preset, c + 1,
                                    threads->options, &polled, &threads->error[c]));
    }
    return NULL;
}

/* The first error that is not the end of the others. */
static bool check_cells(const struct card_threads *threads, struct gb_error *err)
{
    const struct gb_error *first = NULL;
    for (int c = 0; c < threads->options->replicas; c++) {
        const struct gb_error *one = &threads->error[c];
        if (one->code != GB_OK && (first == NULL || first->code == GB_ERR_CANCELLED)) {
            first = one;
        }
    }
    if (first != NULL) {
        return gb_error_set(err, first->code, "%s", first->text);
    }
    return threads->done == threads->options->replicas ||
           gb_error_set(err, GB_ERR_CANCELLED, "stopped on request");
}

/* Measures all cells, `jobs` at a time (0: one per processor).  The first failure stops
 * the others and is the error. */
static bool card_threads_work(struct card_threads *threads, int jobs,
                              struct gb_error *err)
{
    pthread_t thread[JOBS_MAX];
    const int replicas = threads->options->replicas;
    const int wanted = jobs > 0 ? jobs : (int)sysconf(_SC_NPROCESSORS_ONLN);
    const int most = MIN(MIN(MAX(wanted, 1), JOBS_MAX), replicas);
    int started = 0;
    while (started < most && gb_team_start_thread(&thread[started], work, threads,
                                                  "a thread of the card", err)) {
        started++;
    }
    for (int t = 0; t < started; t++) {
        pthread_join(thread[t], NULL);
    }
    return started > 0 && check_cells(threads, err);
}

/* --- the card of a set of cells ------------------------------------------------------- */

/* From cells to a card. */

enum { REPLICAS_MAX = 1000 };

struct gb_cap_material gb_card_fit_material(const struct gb_card_values *card, int levels,
                                            double transition, struct gb_cap_row *rows)
{
    for (int k = 0; k < levels; k++) {
        const double *value = card->value[k];
        const double young = value[GB_CARD_YOUNG], poisson = value[GB_CARD_POISSON];
        rows[k] = (struct gb_cap_row){.density = card->density[k],
                                      .bulk = young / (3.0 * (1.0 - 2.0 * poisson)),
                                      .shear_modulus = young / (2.0 * (1.0 + poisson)),
                                      .cap = {.d = value[GB_CARD_D],
                                              .beta = value[GB_CARD_BETA],
                                              .r = value[GB_CARD_R],
                                              .p_a = value[GB_CARD_P_A],
                                              .a = transition},
                                      .p_b = value[GB_CARD_P_B],
                                      .plastic_volume = value[GB_CARD_PLASTIC]};
    }
    return (struct gb_cap_material){rows, (size_t)levels};
}

/* Points of one level and direction, a value per cell. */
struct gathered {
    double p[REPLICAS_MAX], q[REPLICAS_MAX], volume[REPLICAS_MAX], shear[REPLICAS_MAX];
    size_t count;
};

static void gather(struct gathered *to, const struct gb_card_cell *cells, int count,
                   int without, double density, double direction)
{
    to->count = 0;
    for (int c = 0; c < count; c++) {
        for (guint i = 0; c != without && i < cells[c].point->len; i++) {
            const struct gb_yield_point *point =
                &g_array_index(cells[c].point, struct gb_yield_point, i);
            if (point->density == density && point->direction == direction) {
                to->p[to->count] = point->p_pa;
                to->q[to->count] = point->q_pa;
                to->volume[to->count] = point->flow_volume;
                to->shear[to->count++] = point->flow_shear;
            }
        }
    }
}

static struct gb_yield_point mean_of(const struct gathered *from, double density,
                                     double direction)
{
    struct gb_yield_point mean = {.density = density, .direction = direction};
    double ignored;
    gb_average_values(from->p, from->count, &mean.p_pa, &mean.p_error_pa);
    gb_average_values(from->q, from->count, &mean.q_pa, &mean.q_error_pa);
    gb_average_values(from->volume, from->count, &mean.flow_volume, &ignored);
    gb_average_values(from->shear, from->count, &mean.flow_shear, &ignored);
    return mean;
}

size_t gb_card_fit_points(const struct gb_card_cell *cells, int count, int without,
                          const struct gb_card_options *options,
                          struct gb_yield_point *points)
{
    struct gathered gathered;
    const int used = count - (without >= 0);
    size_t size = 0;
    for (int k = 0; k < options->levels; k++) {
        for (int d = 0; d < options->directions; d++) {
            const double direction = gb_card_direction(options, d);
            gather(&gathered, cells, count, without, options->density[k], direction);
            if (2 * (int)gathered.count >= used && gathered.count >= 2) {
                points[size++] = mean_of(&gathered, options->density[k], direction);
            }
        }
    }
    return size;
}

/* Means over the cells of one level: density, pressure, K and G. */
static struct gb_card_level mean_level(const struct gb_card_cell *cells, int count,
                                       int without, int level)
{
    struct gb_card_level mean = {.density = 0.0};
    const double share = 1.0 / (count - (without >= 0));
    for (int c = 0; c < count; c++) {
        if (c != without) {
            const struct gb_card_level *one = &cells[c].level[level];
            mean.density += share * one->density;
            mean.p_pa += share * one->p_pa;
            mean.bulk += share * one->bulk;
            mean.shear_modulus += share * one->shear_modulus;
        }
    }
    return mean;
}

static bool fit_level(struct gb_card_values *card, int level, double density,
                      const struct gb_yield_point *points, size_t size,
                      const struct gb_card_options *options, struct gb_error *err)
{
    struct gb_yield_point own[GB_CARD_DIRECTIONS_MAX];
    struct gb_cap_fit fit;
    struct gb_error why = {0};
    size_t count = 0;
    for (size_t i = 0; i < size; i++) {
        if (points[i].density == density) {
            own[count++] = points[i];
        }
    }
    if (!gb_cap_fit(&fit, own, count, options->transition, options->flow, &why)) {
        return gb_error_set(err, why.code, "card, density %.4f: %.300s", density,
                            why.text);
    }
    double *value = card->value[level];
    value[GB_CARD_D] = fit.d.value;
    value[GB_CARD_BETA] = fit.beta.value;
    value[GB_CARD_R] = fit.r.value;
    value[GB_CARD_P_A] = fit.p_a.value;
    value[GB_CARD_P_B] = fit.p_b.value;
    card->rms[level] = fit.rms;
    memcpy(card->misses[level], fit.misses, sizeof fit.misses);
    return true;
}

/* Between two compacts the density grows by elastic and plastic strain; K is the mean of
 * both. */
static double plastic_growth(const struct gb_card_level *a, const struct gb_card_level *b)
{
    return log(b->density / a->density) -
           (b->p_pa - a->p_pa) / (0.5 * (a->bulk + b->bulk));
}

bool gb_card_fit_values(struct gb_card_values *card, const struct gb_card_cell *cells,
                        int count, int without, const struct gb_card_options *options,
                        const struct gb_yield_point *points, size_t size,
                        struct gb_error *err)
{
    struct gb_cap_row rows[GB_CARD_LEVELS_MAX];
    struct gb_card_level last = {.density = 0.0};
    for (int k = 0; k < options->levels; k++) {
        const struct gb_card_level level = mean_level(cells, count, without, k);
        const double bulk = level.bulk, shear = level.shear_modulus;
        double *value = card->value[k];
        card->density[k] = level.density;
        card->pressed_pa[k] = level.p_pa;
        value[GB_CARD_YOUNG] = 9.0 * bulk * shear / (3.0 * bulk + shear);
        value[GB_CARD_POISSON] =
            (3.0 * bulk - 2.0 * shear) / (2.0 * (3.0 * bulk + shear));
        value[GB_CARD_PLASTIC] =
            k == 0 ? 0.0
                   : card->value[k - 1][GB_CARD_PLASTIC] + plastic_growth(&last, &level);
        if (!fit_level(card, k, options->density[k], points, size, options, err)) {
            return false;
        }
        if (k == 0) {
            /* p_b is measured when the probes have flowed by the offset */
            card->start_density =
                level.density * exp(options->offset - level.p_pa / level.bulk);
        }
        last = level;
    }
    const struct gb_cap_material material =
        gb_card_fit_material(card, options->levels, options->transition, rows);
    return gb_cap_check(&material, err);
}

/* p_x/p_z and p_z (Pa) of pressing the unloaded first compact along a path, at densities
 * that ascend; NaN below its start. */
static bool card_fit_predict(const struct gb_card_values *card, int levels,
                             double transition, enum gb_card_path path,
                             const double *density, size_t size, double *ratio,
                             double *pz, struct gb_error *err)
{
    struct gb_cap_row rows[GB_CARD_LEVELS_MAX];
    const struct gb_cap_material material =
        gb_card_fit_material(card, levels, transition, rows);
    struct gb_cap_state state = {.density = card->start_density};
    for (size_t i = 0; i < size; i++) {
        double strain[6] = {0.0};
        ratio[i] = pz[i] = (double)NAN;
        if (density[i] <= card->start_density) {
            continue;
        }
        const double volume = log(density[i] / state.density);
        if (path == GB_CARD_ISOTROPIC) {
            strain[0] = strain[1] = strain[2] = volume / 3.0;
        } else {
            strain[2] = volume;
        }
        if (!gb_cap_strain(&material, &state, strain, err)) {
            return false;
        }
        ratio[i] = state.pressure[0] / state.pressure[2];
        pz[i] = state.pressure[2];
    }
    return true;
}

/* --- how well it predicts pressing ---------------------------------------------------- */

/* Density at which the predicted curve has the pressure; NaN outside. */
static double predicted_density(const struct gb_card_compared *at, double pz)
{
    double x[GB_CARD_CURVE_POINTS], y[GB_CARD_CURVE_POINTS];
    for (int i = 0; i < GB_CARD_CURVE_POINTS; i++) {
        x[i] = at[i].predicted_pz.value;
        y[i] = at[i].density;
    }
    const struct gb_average_curve curve = {x, y, GB_CARD_CURVE_POINTS};
    return gb_average_crossing(&curve, pz, NULL);
}

void gb_card_misfit_measure(struct gb_card_misfit *misfit,
                            const struct gb_card_compared curve[GB_CARD_CURVE_POINTS],
                            double from)
{
    int count = 0, densities = 0;
    *misfit = (struct gb_card_misfit){0};
    for (int i = 0; i < GB_CARD_CURVE_POINTS; i++) {
        const struct gb_card_compared *at = &curve[i];
        const double ratio = at->predicted_ratio.value - at->simulated_ratio.value;
        const double share = at->predicted_pz.value / at->simulated_pz.value - 1.0;
        if (at->density < from || !isfinite(ratio) || !isfinite(share)) {
            continue;
        }
        const double off = predicted_density(curve, at->simulated_pz.value) - at->density;
        misfit->ratio += ratio * ratio;
        misfit->pressure += share * share;
        misfit->ratio_most = fmax(misfit->ratio_most, fabs(ratio));
        count++;
        if (isfinite(off)) {
            misfit->density += off * off;
            misfit->density_most = fmax(misfit->density_most, fabs(off));
            densities++;
        }
    }
    misfit->ratio = sqrt(misfit->ratio / count);
    misfit->pressure = sqrt(misfit->pressure / count);
    misfit->density = sqrt(misfit->density / densities);
}

/* --- the card with its intervals ------------------------------------------------------ */

const struct gb_card_quantity_row gb_card_rows[GB_CARD_QUANTITIES] = {
    {"d_MPa", "d", "MPa", 1e-6},
    {"beta_deg", "beta", "degrees", 180.0 / M_PI},
    {"R", "R", "", 1.0},
    {"p_a_MPa", "p_a", "MPa", 1e-6},
    {"p_b_MPa", "p_b", "MPa", 1e-6},
    {"plastic_volume", "plastic volumetric strain", "", 1.0},
    {"E_GPa", "E", "GPa", 1e-9},
    {"nu", "nu", "", 1.0},
};

enum { DEFAULT_LEVELS = 6 };

/* A value with the interval of the jackknife. */
static struct gb_fit_value with_interval(double value, const double *without, int count)
{
    const double error = gb_average_jackknife(without, (size_t)count);
    const double half = error * gsl_cdf_tdist_Pinv(0.975, count - 1.0);
    return (struct gb_fit_value){value, error, value - half, value + half};
}

static struct gb_fit_value with_error(const double *values, int count)
{
    struct gb_fit_value mean;
    gb_average_values(values, (size_t)count, &mean.value, &mean.error);
    const double half = mean.error * gsl_cdf_tdist_Pinv(0.975, count - 1.0);
    mean.low = mean.value - half;
    mean.high = mean.value + half;
    return mean;
}

/* Cards, and predictions on the grid of the curve, of all cells but one. */
struct jackknife {
    struct gb_card_values *card;
    double *ratio, *pz; /* paths x replicas x GB_CARD_CURVE_POINTS */
    double *room;       /* replicas */
};

static bool jackknife_init(struct jackknife *jack, int replicas, struct gb_error *err)
{
    const size_t n = (size_t)replicas, curves = GB_CARD_PATHS * n;
    jack->card = gb_alloc_array(n, sizeof *jack->card, err);
    jack->ratio = gb_alloc_array(curves * GB_CARD_CURVE_POINTS, sizeof *jack->ratio, err);
    jack->pz = gb_alloc_array(curves * GB_CARD_CURVE_POINTS, sizeof *jack->pz, err);
    jack->room = gb_alloc_array(n, sizeof *jack->room, err);
    return jack->card && jack->ratio && jack->pz && jack->room;
}

static void jackknife_finish(struct jackknife *jack)
{
    gb_alloc_free(jack->card);
    gb_alloc_free(jack->ratio);
    gb_alloc_free(jack->pz);
    gb_alloc_free(jack->room);
}

/* Where the curve of all cells but one begins. */
static size_t curve_of(const struct gb_card_study *study, int path, int cell)
{
    return GB_CARD_CURVE_POINTS * (size_t)(path * study->options.replicas + cell);
}

static void set_grid(const struct gb_card_study *study, double *density)
{
    const double from = study->card.start_density;
    const double to = study->card.density[study->levels - 1];
    for (int i = 0; i < GB_CARD_CURVE_POINTS; i++) {
        density[i] = from + (to - from) * (i + 1.0) / GB_CARD_CURVE_POINTS;
    }
}

/* A point belongs to the same side of the surface as that of all cells: an interval that
 * contained changes of side would not be one of the parameters. */
static void keep_sides(const struct gb_card_study *study, struct gb_yield_point *points,
                       size_t size)
{
    for (size_t i = 0; i < size; i++) {
        for (size_t j = 0; j < study->points; j++) {
            const struct gb_yield_point *mean = &study->point[j];
            if (mean->density == points[i].density &&
                mean->direction == points[i].direction) {
                points[i].flow_volume = mean->flow_volume;
                points[i].flow_shear = mean->flow_shear;
            }
        }
    }
}

static bool fit_without(struct gb_card_study *study, struct jackknife *jack,
                        const struct gb_card_cell *cells, const double *grid,
                        struct gb_error *err)
{
    const struct gb_card_options *options = &study->options;
    struct gb_yield_point *points =
        gb_alloc_array(GB_CARD_POINTS_MAX, sizeof *points, err);
    bool good = points != NULL;
    for (int c = 0; c < options->replicas && good; c++) {
        const size_t size =
            gb_card_fit_points(cells, options->replicas, c, options, points);
        keep_sides(study, points, size);
        good = gb_card_fit_values(&jack->card[c], cells, options->replicas, c, options,
                                  points, size, err);
        for (int path = 0; path < GB_CARD_PATHS && good; path++) {
            const size_t at = curve_of(study, path, c);
            good = card_fit_predict(&jack->card[c], study->levels, options->transition,
                                    (enum gb_card_path)path, grid, GB_CARD_CURVE_POINTS,
                                    jack->ratio + at, jack->pz + at, err);
        }
    }
    gb_alloc_free(points);
    return good;
}

static void take_intervals(struct gb_card_study *study, const struct jackknife *jack)
{
    const int replicas = study->options.replicas;
    for (int k = 0; k < study->levels; k++) {
        for (int n = 0; n < GB_CARD_QUANTITIES; n++) {
            for (int c = 0; c < replicas; c++) {
                jack->room[c] = jack->card[c].value[k][n];
            }
            study->quantity[k][n] =
                with_interval(study->card.value[k][n], jack->room, replicas);
        }
    }
}

/* A curve of pressing at a density, linear between its points. */
static bool curve_at(const GArray *curve, double density, double *px, double *pz)
{
    const struct gb_card_pressed *row =
        (const struct gb_card_pressed *)(void *)curve->data;
    for (guint i = 1; i < curve->len; i++) {
        if (row[i].density >= density && row[i - 1].density < density) {
            const double share =
                (density - row[i - 1].density) / (row[i].density - row[i - 1].density);
            *px = row[i - 1].px_pa + share * (row[i].px_pa - row[i - 1].px_pa);
            *pz = row[i - 1].pz_pa + share * (row[i].pz_pa - row[i - 1].pz_pa);
            return true;
        }
    }
    return false;
}

/* Ratio of the mean pressures; its error by the jackknife.  NaN beyond the end of a cell. */
static void simulate(struct gb_card_compared *at, const struct gb_card_cell *cells,
                     int replicas, int path, double *room)
{
    double px = 0.0, pz = 0.0, one_x, one_z;
    for (int c = 0; c < replicas; c++) {
        const bool there = curve_at(cells[c].curve[path], at->density, &one_x, &one_z);
        room[c] = there ? one_z : (double)NAN;
        px += there ? one_x : (double)NAN;
        pz += room[c];
    }
    at->simulated_pz = isfinite(pz) ? with_error(room, replicas)
                                    : (struct gb_fit_value){NAN, NAN, NAN, NAN};
    for (int c = 0; c < replicas; c++) {
        const bool there = curve_at(cells[c].curve[path], at->density, &one_x, &one_z);
        room[c] = there ? (px - one_x) / (pz - one_z) : (double)NAN;
    }
    at->simulated_ratio = with_interval(px / pz, room, replicas);
}

static bool compare(struct gb_card_study *study, const struct jackknife *jack,
                    const struct gb_card_cell *cells, int path, const double *grid,
                    struct gb_error *err)
{
    const int replicas = study->options.replicas;
    double ratio[GB_CARD_CURVE_POINTS], pz[GB_CARD_CURVE_POINTS];
    if (!card_fit_predict(&study->card, study->levels, study->options.transition,
                          (enum gb_card_path)path, grid, GB_CARD_CURVE_POINTS, ratio, pz,
                          err)) {
        return false;
    }
    for (int i = 0; i < GB_CARD_CURVE_POINTS; i++) {
        struct gb_card_compared *at = &study->curve[path][i];
        at->density = grid[i];
        simulate(at, cells, replicas, path, jack->room);
        for (int c = 0; c < replicas; c++) {
            jack->room[c] = jack->ratio[curve_of(study, path, c) + (size_t)i];
        }
        at->predicted_ratio = with_interval(ratio[i], jack->room, replicas);
        for (int c = 0; c < replicas; c++) {
            jack->room[c] = jack->pz[curve_of(study, path, c) + (size_t)i];
        }
        at->predicted_pz = with_interval(pz[i], jack->room, replicas);
    }
    return true;
}

static bool fit(struct gb_card_study *study, const struct gb_card_cell *cells,
                struct gb_error *err)
{
    const struct gb_card_options *options = &study->options;
    struct jackknife jack = {.card = NULL};
    double grid[GB_CARD_CURVE_POINTS];
    study->points =
        gb_card_fit_points(cells, options->replicas, -1, options, study->point);
    bool good = gb_card_fit_values(&study->card, cells, options->replicas, -1, options,
                                   study->point, study->points, err) &&
                jackknife_init(&jack, options->replicas, err);
    if (good) {
        set_grid(study, grid);
        good = fit_without(study, &jack, cells, grid, err);
    }
    if (good) {
        take_intervals(study, &jack);
        study->compared_from = study->card.density[1];
    }
    for (int path = 0; path < GB_CARD_PATHS && good; path++) {
        good = compare(study, &jack, cells, path, grid, err);
        if (good) {
            gb_card_misfit_measure(&study->misfit[path], study->curve[path],
                                   study->compared_from);
        }
    }
    jackknife_finish(&jack);
    return good;
}

bool gb_card_run(struct gb_card_study *study, const struct gb_params *preset, int jobs,
                 const struct gb_card_callbacks *callbacks, struct gb_error *err)
{
    const double begin = gb_clock_s();
    struct card_threads threads = {
        .options = &study->options, .preset = preset, .callbacks = callbacks};
    const struct gb_pool_callbacks polled = {.cancelled = callbacks->cancelled,
                                             .data = callbacks->data};
    if (!gb_seed_check_cells(preset, (size_t)study->options.replicas, err)) {
        return false;
    }
    if (study->options.levels == 0 &&
        !card_cell_scout(&study->options, preset, DEFAULT_LEVELS, &polled, err)) {
        return false;
    }
    study->levels = study->options.levels;
    const bool good = card_threads_init(&threads, err) &&
                      card_threads_work(&threads, jobs, err) &&
                      fit(study, threads.cell, err);
    card_threads_finish(&threads);
    study->seconds = gb_clock_s() - begin;
    return good;
}

/* The tables of a card; stresses in MPa, angles in degrees, moduli in GPa. */

GString *gb_card_files_misses(const struct gb_card_study *study)
{
    static const char *const sides[] = {"shear failure", "cap"};
    const double quantile = gsl_cdf_tdist_Pinv(0.975, study->options.replicas - 1.0);
    GString *text = g_string_new(NULL);
    for (int k = 0; k < study->levels; k++) {
        for (int side = 0; side < 2; side++) {
            const struct gb_cap_fit_misses *misses = &study->card.misses[k][side];
            const double interval = quantile * misses->error;
            if (misses->distance > interval) {
                g_string_append_printf(
                    text,
                    "density %.3f, %s: the surface is %.3g MPa (rms) from its own points, "
                    "which are known to within %.2g MPa (95 %%)\n",
                    study->card.density[k], sides[side], misses->distance / 1e6,
                    interval / 1e6);
            }
        }
    }
    return text;
}

static void add_value(struct gb_listing *listing, const struct gb_fit_value *value,
                      double factor)
{
    gb_listing_number(listing, value->value * factor);
    gb_listing_number(listing, value->low * factor);
    gb_listing_number(listing, value->high * factor);
}

static void add_columns(struct gb_listing *listing, const char *name)
{
    gb_listing_column(listing, "%.8g", "%s", name);
    gb_listing_column(listing, "%.8g", "%s_low", name);
    gb_listing_column(listing, "%.8g", "%s_high", name);
}

GString *gb_card_files_card(const struct gb_card_study *study, const char *comment)
{
    struct gb_listing *listing = gb_listing_new();
    GString *misses = gb_card_files_misses(study);
    gb_listing_comment(listing, comment);
    gb_listing_comment(listing, misses->str);
    gb_listing_columns(listing, "%.6g", "density,pressed_MPa");
    for (int n = 0; n < GB_CARD_QUANTITIES; n++) {
        add_columns(listing, gb_card_rows[n].name);
    }
    gb_listing_columns(listing, "%g", "transition");
    gb_listing_columns(listing, "%.4g", "rms_MPa");
    for (int k = 0; k < study->levels; k++) {
        gb_listing_number(listing, study->card.density[k]);
        gb_listing_number(listing, study->card.pressed_pa[k] / 1e6);
        for (int n = 0; n < GB_CARD_QUANTITIES; n++) {
            add_value(listing, &study->quantity[k][n], gb_card_rows[n].factor);
        }
        gb_listing_number(listing, study->options.transition);
        gb_listing_number(listing, study->card.rms[k] / 1e6);
    }
    g_string_free(misses, TRUE);
    return gb_listing_end(listing, GB_LISTING_CSV);
}

GString *gb_card_files_points(const struct gb_card_study *study, const char *comment)
{
    static const char *const sides[] = {[GB_CAP_FIT_SHEAR] = "shear",
                                        [GB_CAP_FIT_CAP] = "cap",
                                        [GB_CAP_FIT_LEFT_OUT] = "tension"};
    struct gb_listing *listing = gb_listing_new();
    gb_listing_comment(listing, comment);
    gb_listing_columns(listing, "%.6g", "density");
    gb_listing_columns(listing, "%.4g", "direction_deg");
    gb_listing_columns(listing, "%.6g", "p_MPa");
    gb_listing_columns(listing, "%.3g", "p_MPa_error");
    gb_listing_columns(listing, "%.6g", "q_MPa");
    gb_listing_columns(listing, "%.3g", "q_MPa_error");
    gb_listing_columns(listing, "%.4g", "flow_volume,flow_shear");
    gb_listing_columns(listing, "%s", "side");
    for (size_t i = 0; i < study->points; i++) {
        const struct gb_yield_point *point = &study->point[i];
        const double number[] = {point->density,     point->direction * 180.0 / M_PI,
                                 point->p_pa / 1e6,  point->p_error_pa / 1e6,
                                 point->q_pa / 1e6,  point->q_error_pa / 1e6,
                                 point->flow_volume, point->flow_shear};
        gb_listing_numbers(listing, number, G_N_ELEMENTS(number));
        gb_listing_text(listing, sides[gb_cap_fit_side_of(point)]);
    }
    return gb_listing_end(listing, GB_LISTING_CSV);
}

GString *gb_card_files_path(const struct gb_card_study *study, enum gb_card_path path,
                            const char *comment)
{
    struct gb_listing *listing = gb_listing_new();
    gb_listing_comment(listing, comment);
    gb_listing_columns(listing, "%.6g", "density");
    add_columns(listing, "ratio");
    add_columns(listing, "card_ratio");
    add_columns(listing, "pz_MPa");
    add_columns(listing, "card_pz_MPa");
    for (int i = 0; i < GB_CARD_CURVE_POINTS; i++) {
        const struct gb_card_compared *at = &study->curve[path][i];
        if (!isfinite(at->simulated_ratio.value) ||
            !isfinite(at->predicted_ratio.value)) {
            continue;
        }
        gb_listing_number(listing, at->density);
        add_value(listing, &at->simulated_ratio, 1.0);
        add_value(listing, &at->predicted_ratio, 1.0);
        add_value(listing, &at->simulated_pz, 1e-6);
        add_value(listing, &at->predicted_pz, 1e-6);
    }
    return gb_listing_end(listing, GB_LISTING_CSV);
}

static void add_comment(GString *text, const char *comment)
{
    char **lines = g_strsplit(comment, "\n", 0);
    for (int i = 0; lines[i] != NULL; i++) {
        if (lines[i][0] != '\0') {
            g_string_append_printf(text, "** %s\n", lines[i]);
        }
    }
    g_strfreev(lines);
}

GString *gb_card_files_abaqus(const struct gb_card_study *study, const char *comment,
                              double mass_density)
{
    GString *text = g_string_new(NULL);
    GString *misses = gb_card_files_misses(study);
    add_comment(text, comment);
    add_comment(text, misses->str);
    g_string_free(misses, TRUE);
    g_string_append_printf(
        text,
        "** Units: mm, N, MPa, tonne.  Field variable 1: relative density of the "
        "powder,\n"
        "** to be updated by a user subroutine (USDFLD, VUSDFLD) as %.6g times\n"
        "** exp(-volumetric strain): that is its initial value.\n"
        "*MATERIAL, NAME=GREEN_BODY\n*DENSITY\n%.6g\n*ELASTIC, DEPENDENCIES=1\n"
        "** E, nu, temperature, relative density\n",
        study->card.start_density, study->card.start_density * mass_density * 1e-12);
    for (int k = 0; k < study->levels; k++) {
        const double *value = study->card.value[k];
        g_string_append_printf(text, "%.6g, %.5g, , %.6g\n", value[GB_CARD_YOUNG] / 1e6,
                               value[GB_CARD_POISSON], study->card.density[k]);
    }
    g_string_append(text, "*CAP PLASTICITY, DEPENDENCIES=1\n"
                          "** d, beta (degrees), R, initial plastic volumetric strain, "
                          "alpha, K, temperature,\n** relative density\n");
    for (int k = 0; k < study->levels; k++) {
        const double *value = study->card.value[k];
        g_string_append_printf(text, "%.6g, %.5g, %.5g, 0., %g, 1., , %.6g\n",
                               value[GB_CARD_D] / 1e6, value[GB_CARD_BETA] * 180.0 / M_PI,
                               value[GB_CARD_R], study->options.transition,
                               study->card.density[k]);
    }
    g_string_append(text, "*CAP HARDENING\n** p_b, plastic volumetric strain\n");
    for (int k = 0; k < study->levels; k++) {
        const double *value = study->card.value[k];
        g_string_append_printf(text, "%.6g, %.6g\n", value[GB_CARD_P_B] / 1e6,
                               value[GB_CARD_PLASTIC]);
    }
    return text;
}
