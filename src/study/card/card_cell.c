#include "study/card/card_cell.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "scene/path/path.h"
#include "study/compact/offset_probe.h"

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
        good = follow(loose, gb_card_options_paths[k].leg, loose->params.strain_step,
                      &record, callbacks, NULL, err);
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
    const struct gb_offset_probe_steps steps = {.step = options->step,
                                                .strain_most = options->strain_most,
                                                .enough = options->offset};
    for (int k = 0; k < options->directions; k++) {
        struct gb_offset_probe probe = {.state = NULL};
        struct gb_yield_point point;
        const bool good =
            gb_offset_probe_run(&probe, inside, gb_card_options_direction(options, k),
                                elastic, &steps, callbacks, err);
        if (good && gb_offset_probe_point(&probe, options->offset, 1.0, &point)) {
            point.replica = replica;
            point.density = density;
            point.p_error_pa = point.q_error_pa = (double)NAN;
            g_array_append_val(cell->point, point);
        }
        gb_offset_probe_finish(&probe);
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
    const char *leg = gb_card_options_paths[options->path].leg;
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

bool gb_card_cell_scout(struct gb_card_options *options, const struct gb_params *preset,
                        int levels, const struct gb_pool_callbacks *callbacks,
                        struct gb_error *err)
{
    struct gb_compact loose = {0}, low = {0}, high = {0};
    struct record first = {NULL, 0.99, lowest_share * options->pressure_pa, -INFINITY};
    struct record last = {NULL, 0.99, options->pressure_pa, -INFINITY};
    const char *path = gb_card_options_paths[options->path].leg;
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
