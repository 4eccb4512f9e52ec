#include "io/state/state_record.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include "base/alloc.h"
#include "base/vec.h"
#include "io/point_columns.h"
#include "io/state/state_optional.h"
#include "io/state/state_radius.h"
#include "io/state/state_source.h"
#include "pack/cell/cell.h"
#include "pack/die/die.h"
#include "pack/structure/assign_sizes.h"
#include "scene/loading_kind.h"

/* Copies an item of the record. */
static bool take(const struct gb_record *record, const char *name,
                 enum gb_record_type type, int64_t rows, int columns, void *data,
                 struct gb_error *err)
{
    const struct gb_record_item *item = gb_record_find(record, name);
    if (!item || item->type != type || item->rows != rows || item->columns != columns) {
        return gb_error_set(err, GB_ERR_INPUT, "%s: is missing or of another shape",
                            name);
    }
    if (item->f32) {
        gb_record_numbers(item, 0, rows * columns, data);
    } else if (rows > 0) {
        memcpy(data, item->data, gb_record_bytes(item));
    }
    return true;
}

/* The members of the point that this kind of scene measures. */
static bool take_point(const struct gb_record *record, const struct gb_model *model,
                       struct gb_state *state, struct gb_error *err)
{
    return gb_point_columns_load(&state->point, "shown",
                                 gb_loading_kind_at(model->kind)->columns, record, err);
}

/* Coordination numbers. */
static bool count_contacts(struct gb_state *state, const struct gb_record *record,
                           struct gb_error *err)
{
    const struct gb_record_item *item = gb_record_find(record, "world/pair");
    if (!item || item->type != GB_RECORD_INT32 || item->columns != 2 ||
        item->rows != state->pair_count) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "world/pair: is missing or of another shape");
    }
    const int32_t *particle = item->data;
    for (int64_t k = 0; k < 2 * state->pair_count; k++) {
        state->contacts[particle[k]]++;
    }
    return true;
}

/* T of a scene with time. */
static double second_per_time(const struct gb_model *model)
{
    const double second =
        fmax(model->dynamics.second_per_time, model->die.second_per_time);
    return second > 0.0 ? second : (double)NAN;
}

static void fill_header(struct gb_state *state, const struct gb_params *params,
                        const struct gb_model *model)
{
    state->dimension = model->dimension;
    state->metre_per_length = model->metre_per_length;
    state->pascal_per_stress = model->pascal_per_stress;
    state->second_per_time = second_per_time(model);
    gb_state_record_model(state, model);
    state->seed = model->seed;
    snprintf(state->preset, sizeof state->preset, "%s", params->title);
    snprintf(state->version, sizeof state->version, "%s", GB_VERSION);
}

void gb_state_record_model(struct gb_state *state, const struct gb_model *model)
{
    const bool all = model->geometry == GB_GEOMETRY_ISOTROPIC;
    state->pressed[0] = all ? 1.0 : 0.0;
    state->pressed[1] = all || model->geometry == GB_GEOMETRY_BIAXIAL ? 1.0 : 0.0;
    state->pressed[2] = 1.0;
    state->attraction_strength = model->dispersion.strength;
    state->attraction_shift = model->dispersion.shift;
    state->attraction_cutoff = model->terms.attraction ? model->numerics.cutoff : 0.0;
}

double gb_state_record_half_width(const double (*position)[4], int64_t count,
                                  const struct gb_die *die)
{
    const bool outside = die->funnel || die->bore != GB_DIE_BORE_ENDLESS;
    double half = die->radius;
    for (int64_t i = 0; i < count && outside; i++) {
        const double *x = position[i];
        half = fmax(half, fmax(fabs(x[0]), fabs(x[1])) + x[3]);
    }
    return half;
}

void gb_state_record_walls(struct gb_state *state, const struct gb_die *die)
{
    state->die_radius = die->radius;
    state->die_top = die->bore == GB_DIE_BORE_ENDLESS ? (double)NAN
                     : die->bore == GB_DIE_BORE_OPEN  ? die->top
                                                      : 0.0;
    state->punch_height = die->punch ? die->punch_position : (double)NAN;
    state->funnel_height = die->funnel ? die->height : 0.0;
    state->funnel_outlet = die->funnel ? die->outlet : 0.0;
    state->funnel_slope = die->funnel ? die->sine / die->cosine : 0.0;
}

/* Spheres of a bed in the box of the die, with their own radii. */
static void copy_spheres(struct gb_state *state, const double (*position)[4],
                         const struct gb_die *die)
{
    const double half = gb_state_record_half_width(position, state->count, die);
    gb_state_record_walls(state, die);
    state->cell[0] = state->cell[1] = 2.0 * half;
    for (int64_t i = 0; i < state->count; i++) {
        for (int k = 0; k < 3; k++) {
            state->position[3 * i + k] = position[i][k] + (k < 2 ? half : 0.0);
        }
        state->radius[i] = position[i][3];
        state->cell[2] = fmax(state->cell[2], position[i][2] + position[i][3]);
    }
}

/* The die of the record, without a funnel, as points come after it. */
static bool take_die(const struct gb_record *record, const struct gb_model *model,
                     struct gb_die *die, struct gb_error *err)
{
    *die = (struct gb_die){.radius = model->die.radius, .punch = true};
    int32_t bore = GB_DIE_BORE_ENDLESS;
    if (!take(record, "bed/punch_place", GB_RECORD_DOUBLE, 1, 1, &die->punch_position,
              err) ||
        !take(record, "bed/bore", GB_RECORD_INT32, 1, 1, &bore, err) ||
        !take(record, "bed/top", GB_RECORD_DOUBLE, 1, 1, &die->top, err) ||
        !take(record, "bed/punch", GB_RECORD_BOOL, 1, 1, &die->punch, err)) {
        return false;
    }
    die->bore = (enum gb_die_bore)bore;
    return true;
}

/* Whole forces of the walls on particles. */
static bool take_walls(struct gb_state *state, const struct gb_record *record,
                       const double (*position)[4], const struct gb_die *die,
                       struct gb_error *err)
{
    static const char *const names[3] = {"walls/shear_x", "walls/shear_y",
                                         "walls/shear_z"};
    const struct gb_record_item *normal = gb_record_find(record, "walls/normal");
    const int64_t n = normal ? normal->rows : 0;
    double *value = gb_alloc_array((size_t)n + 1, sizeof *value, err);
    int32_t *index = gb_alloc_array((size_t)n + 1, sizeof *index, err);
    bool done = value && index && gb_state_allocate_walls(state, n, err);
    for (int end = 0; done && end < 2; end++) {
        done = take(record, end == 0 ? "walls/first" : "walls/wall", GB_RECORD_INT32, n,
                    1, index, err);
        for (int64_t k = 0; done && k < n; k++) {
            state->wall[2 * k + end] = index[k];
        }
    }
    for (int c = 0; done && c < 3; c++) {
        done = take(record, names[c], GB_RECORD_DOUBLE, n, 1, value, err);
        for (int64_t k = 0; done && k < n; k++) {
            state->wall_force[3 * k + c] = value[k];
        }
    }
    done = done && take(record, "walls/normal", GB_RECORD_DOUBLE, n, 1, value, err);
    for (int64_t k = 0; done && k < n; k++) {
        const int32_t i = state->wall[2 * k];
        double unit[3] = {0.0, 0.0, 0.0};
        if (i < 0 || i >= state->count) {
            done = gb_error_set(err, GB_ERR_INPUT, "walls/first: is out of range");
            break;
        }
        gb_die_overlap(die, (enum gb_die_wall)state->wall[2 * k + 1], position[i],
                       position[i][3], unit);
        gb_vec_add(state->wall_force + 3 * k, value[k], unit);
    }
    gb_alloc_free(index);
    gb_alloc_free(value);
    return done;
}

/* Whole forces from normal and shear parts. */
static void join_forces(struct gb_state *state, double *const shear[3])
{
    for (int64_t k = 0; k < state->pair_count; k++) {
        const int32_t i = state->pair[2 * k], j = state->pair[2 * k + 1];
        const double *a = state->position + 3 * (int64_t)i;
        const double *b = state->position + 3 * (int64_t)j;
        double r[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
        gb_vec_scale(r, state->pair_normal[k] / gb_vec_length(r));
        for (int c = 0; c < 3; c++) {
            state->pair_force[3 * k + c] = r[c] + shear[c][k];
        }
        state->contacts[i]++;
        state->contacts[j]++;
    }
}

/* The items of gb_bed_record that a picture needs. */
static bool fill_die(struct gb_state *state, const struct gb_record *record,
                     const struct gb_model *model, double *work, struct gb_error *err)
{
    static const char *const names[3] = {"bed/shear_x", "bed/shear_y", "bed/shear_z"};
    const int64_t n = state->pair_count;
    double(*position)[4] = (double(*)[4])work;
    double *const shear[3] = {work + 4 * state->count, work + 4 * state->count + n,
                              work + 4 * state->count + 2 * n};
    int32_t *index = (int32_t *)(void *)shear[0];
    struct gb_die die;
    if (!take_die(record, model, &die, err) ||
        !take(record, "bed/place", GB_RECORD_DOUBLE, state->count, 4, position, err) ||
        !take(record, "bed/normal", GB_RECORD_DOUBLE, n, 1, state->pair_normal, err) ||
        !take_point(record, model, state, err)) {
        return false;
    }
    for (int end = 0; end < 2; end++) {
        if (!take(record, end == 0 ? "bed/first" : "bed/second", GB_RECORD_INT32, n, 1,
                  index, err)) {
            return false;
        }
        for (int64_t k = 0; k < n; k++) {
            state->pair[2 * k + end] = index[k];
        }
    }
    for (int c = 0; c < 3; c++) {
        if (!take(record, names[c], GB_RECORD_DOUBLE, n, 1, shear[c], err)) {
            return false;
        }
    }
    state->cell[2] = die.punch ? die.punch_position : 0.0;
    copy_spheres(state, (const double(*)[4])position, &die);
    join_forces(state, shear);
    return take_walls(state, record, (const double(*)[4])position, &die, err);
}

static bool die_state(struct gb_state **out, const struct gb_record *record,
                      const struct gb_params *params, const struct gb_model *model,
                      struct gb_error *err)
{
    const struct gb_record_item *normal = gb_record_find(record, "bed/normal");
    const int64_t pairs = normal ? normal->rows : 0;
    const size_t size = 4 * (size_t)model->count + 3 * (size_t)pairs + 1;
    struct gb_state *state = NULL;
    double *work = gb_alloc_array(size, sizeof *work, err);
    const bool done = work && gb_state_create(&state, model->count, pairs, err) &&
                      fill_die(state, record, model, work, err) &&
                      gb_state_optional_take(state, record, err) &&
                      gb_state_radius_fill(state, record, params, err);
    gb_alloc_free(work);
    if (!done) {
        gb_state_destroy(state);
        return false;
    }
    fill_header(state, params, model);
    *out = state;
    return true;
}

/* The particles of a periodic cell; everything of its pairs by a source. */
static bool fill_cell(struct gb_state *state, const struct gb_record *record,
                      const struct gb_params *params, const struct gb_model *model,
                      struct gb_error *err)
{
    const int64_t count = model->count;
    if (!take(record, "world/edge", GB_RECORD_DOUBLE, 1, 3, state->cell, err) ||
        !take(record, "world/position", GB_RECORD_DOUBLE, count, 3, state->position,
              err) ||
        !gb_assign_sizes_model(model, state->radius, err) ||
        !take_point(record, model, state, err) ||
        (gb_record_find(record, "world/tilt") &&
         !take(record, "world/tilt", GB_RECORD_DOUBLE, 1, 3, state->tilt, err)) ||
        !count_contacts(state, record, err)) {
        return false;
    }
    state->dimension = model->dimension;
    const struct gb_cell cell = gb_state_cell(state);
    for (int64_t i = 0; i < count; i++) {
        gb_cell_wrap(&cell, state->position + 3 * i);
        state->radius[i] *= 0.5;
    }
    fill_header(state, params, model);
    return gb_state_source_create(state, record, model, err);
}

static bool cell_state(struct gb_state **out, const struct gb_record *record,
                       const struct gb_params *params, const struct gb_model *model,
                       struct gb_error *err)
{
    const struct gb_record_item *history = gb_record_find(record, "world/history");
    struct gb_state *state = NULL;
    if (!history) {
        return gb_error_set(err, GB_ERR_INPUT, "world/history: is missing");
    }
    if (!gb_state_create_particles(&state, model->count, history->rows, err)) {
        return false;
    }
    if (!fill_cell(state, record, params, model, err)) {
        gb_state_destroy(state);
        return false;
    }
    *out = state;
    return true;
}

/* All arrays of the source in memory. */
static bool take_pairs(struct gb_state *state, const struct gb_record *record,
                       struct gb_error *err)
{
    if (!gb_state_allocate_pairs(state, err) ||
        !gb_state_optional_allocate(state, &state->contact_radius, err)) {
        return false;
    }
    const struct {
        size_t member;
        void *array;
    } arrays[] = {
        {offsetof(struct gb_state, pair), state->pair},
        {offsetof(struct gb_state, pair_force), state->pair_force},
        {offsetof(struct gb_state, pair_normal), state->pair_normal},
        {offsetof(struct gb_state, pair_bridged), state->pair_bridged},
        {offsetof(struct gb_state, contact_radius), state->contact_radius},
    };
    for (size_t k = 0; k < sizeof arrays / sizeof arrays[0]; k++) {
        gb_state_source_fill(state, arrays[k].member, 0, state->pair_count,
                             arrays[k].array);
    }
    return gb_state_optional_take(state, record, err);
}

bool gb_state_record(struct gb_state **out, const struct gb_record *record,
                     const struct gb_params *params, const struct gb_model *model,
                     struct gb_error *err)
{
    if (!gb_loading_kind_at(model->kind)->periodic_cell) {
        return die_state(out, record, params, model, err);
    }
    if (!cell_state(out, record, params, model, err)) {
        return false;
    }
    const bool done = take_pairs(*out, record, err);
    gb_state_source_destroy((*out)->source);
    (*out)->source = NULL;
    if (!done) {
        gb_state_destroy(*out);
        *out = NULL;
    }
    return done;
}

bool gb_state_record_to_write(struct gb_state **out, const struct gb_record *record,
                              const struct gb_params *params,
                              const struct gb_model *model, struct gb_error *err)
{
    return gb_loading_kind_at(model->kind)->periodic_cell
               ? cell_state(out, record, params, model, err)
               : die_state(out, record, params, model, err);
}
