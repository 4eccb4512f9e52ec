#include "io/state_record.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include "base/alloc.h"
#include "base/record.h"
#include "base/vec.h"
#include "hdf/hdf.h"
#include "io/point_columns.h"
#include "io/state.h"
#include "law/law_unequal.h"
#include "pack/cell/cell.h"
#include "pack/die/die.h"
#include "pack/die/filling.h"
#include "pack/structure/assign_sizes.h"
#include "scene/loading_kind.h"
#include "scene/model.h"

/* States from the record of a run, for cells and dies.  A state that is only written
 * takes its pairs from a source, which computes the rows when they are written;
 * otherwise all arrays are filled.
 *
 * Contact radii, d.  Periodic cell: a = sqrt(d' h)/2, where 1/d' is the mean of 1/d_i
 * and 1/d_j; for a bridge a_ch = sqrt(d' h_min)/2 or its printed form.  P1 II.A and
 * law/law_unequal.h.  Die: Hertz' a^2 = R* h; for a contact that has flowed, Storakers'
 * radius at its deepest overlap, which does not shrink on unloading.  P3 (2), (17). */

/* Overlap of a pair in a die, d. */
static double overlap_of(const struct gb_state *state, int64_t k)
{
    const int64_t i = state->pair[2 * k], j = state->pair[2 * k + 1];
    const double *a = state->position + 3 * i, *b = state->position + 3 * j;
    double r[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    const struct gb_cell cell = gb_state_cell(state);
    gb_cell_nearest(&cell, r);
    return state->radius[i] + state->radius[j] - gb_vec_length(r);
}

/* Contact radius of a pair in a periodic cell. distance: of the centres, d; deepest >
 * 0: deepest overlap of its bridge. */
static double state_radius_of(const struct gb_state *state, const struct gb_model *model,
                              const int32_t pair[2], double distance, double deepest)
{
    const double a = state->radius[pair[0]], b = state->radius[pair[1]];
    const double overlap = a + b - distance;
    const double first = 2.0 * a, second = 2.0 * b, mean = 0.5 * (first + second);
    const struct gb_law_unequal law = {.mean_diameter = mean,
                                       .diameter_ratio = first * second / (mean * mean)};
    const double bridge =
        model->bridge.radius_current ? overlap + mean * model->bridge.length : deepest;
    return gb_law_unequal_radius(&law, deepest > 0.0 ? bridge : overlap);
}

/* Contact radius of a pair in a die.  A contact that has flowed uses `deepest`, an
 * elastic one `overlap`. */
static double bed_radius(const struct gb_state *state, const struct gb_bed_law *law,
                         int64_t k, double overlap, double deepest)
{
    const double star = gb_law_hertz_radius(state->radius[state->pair[2 * k]],
                                            state->radius[state->pair[2 * k + 1]]);
    const bool flowed =
        law->storakers && (law->normal.printed ||
                           deepest > gb_law_storakers_transition(&law->normal, star));
    return gb_bed_batch_radius(law, star, flowed ? deepest : fmax(overlap, 0.0));
}

/* Fills the contact radii of a die from its record.  Errors: GB_ERR_MEMORY,
 * GB_ERR_INPUT for a missing item. */
static bool state_source_state_radius_fill(struct gb_state *state,
                                           const struct gb_record *record,
                                           const struct gb_params *params,
                                           struct gb_error *err)
{
    static const char name[] = "bed/deepest";
    const struct gb_record_item *item = gb_record_find(record, name);
    if (item == NULL || item->type != GB_RECORD_DOUBLE ||
        item->rows != state->pair_count) {
        return gb_error_set(err, GB_ERR_INPUT, "%s: is missing or of another shape",
                            name);
    }
    if (!gb_state_optional_allocate(state, &state->contact_radius, err)) {
        return false;
    }
    const struct gb_bed_law law = gb_filling_compaction_law(params);
    for (int64_t k = 0; k < state->pair_count; k++) {
        state->contact_radius[k] =
            bed_radius(state, &law, k, overlap_of(state, k), gb_record_number(item, k));
    }
    return true;
}

enum { ROW_MAX = 3 * sizeof(double) };

struct gb_state_source {
    const struct gb_record *record;
    const struct gb_model *model;
    const struct gb_record_item *pair, *force;
    const struct gb_record_item *history; /* first number of a row: deepest overlap */
    struct gb_cell cell;
    void *slab;
};

/* The item if it has this shape; else NULL and err. */
static const struct gb_record_item *item_of(const struct gb_record *record,
                                            const char *name, enum gb_record_type type,
                                            int64_t rows, int columns,
                                            struct gb_error *err)
{
    const struct gb_record_item *item = gb_record_find(record, name);
    if (!item || item->type != type || item->rows != rows ||
        (columns > 0 && item->columns != columns)) {
        gb_error_set(err, GB_ERR_INPUT, "%s: is missing or of another shape", name);
        return NULL;
    }
    return item;
}

/* Creates the source of a state whose count, pair_count, cell, positions and radii are
 * set; record and model must outlive it.  Errors: GB_ERR_MEMORY, GB_ERR_INPUT for an
 * item that is missing or has another shape. */
static bool state_source_create(struct gb_state *state, const struct gb_record *record,
                                const struct gb_model *model, struct gb_error *err)
{
    const int64_t pairs = state->pair_count;
    struct gb_state_source *source = gb_alloc_array(1, sizeof *source, err);
    if (!source) {
        return false;
    }
    state->source = source;
    source->record = record;
    source->model = model;
    source->cell = gb_state_cell(state);
    source->slab = gb_alloc_array(GB_HDF_SLAB + ROW_MAX, 1, err);
    source->pair = item_of(record, "world/pair", GB_RECORD_INT32, pairs, 2, err);
    source->force = source->pair ? item_of(record, "world/pair_force", GB_RECORD_DOUBLE,
                                           pairs, 3, err)
                                 : NULL;
    source->history =
        source->force ? item_of(record, "world/history", GB_RECORD_DOUBLE, pairs, 0, err)
                      : NULL;
    return source->slab && source->history && gb_state_optional_check(state, record, err);
}

void gb_state_record_destroy(struct gb_state_source *source)
{
    if (source) {
        gb_alloc_free(source->slab);
        gb_alloc_free(source);
    }
}

static const int32_t *pair_at(const struct gb_state_source *source, int64_t k)
{
    return (const int32_t *)source->pair->data + 2 * k;
}

/* Branch vector of pair k. */
static void branch_of(const struct gb_state *state, int64_t k, double r[3])
{
    const struct gb_state_source *source = state->source;
    const int32_t *pair = pair_at(source, k);
    const double *a = state->position + 3 * (int64_t)pair[0];
    const double *b = state->position + 3 * (int64_t)pair[1];
    for (int c = 0; c < 3; c++) {
        r[c] = a[c] - b[c];
    }
    gb_cell_nearest(&source->cell, r);
}

static void fill_pairs(const struct gb_state *state, int64_t begin, int64_t end, void *to)
{
    if (end > begin) {
        memcpy(to, pair_at(state->source, begin),
               (size_t)(end - begin) * 2 * sizeof(int32_t));
    }
}

static void fill_forces(const struct gb_state *state, int64_t begin, int64_t end,
                        void *to)
{
    gb_record_numbers(state->source->force, 3 * begin, 3 * (end - begin), to);
}

static void fill_normals(const struct gb_state *state, int64_t begin, int64_t end,
                         void *to)
{
    double *normal = to;
    for (int64_t k = begin; k < end; k++) {
        double r[3], force[3];
        branch_of(state, k, r);
        gb_record_numbers(state->source->force, 3 * k, 3, force);
        normal[k - begin] = gb_vec_dot(force, r) / gb_vec_length(r);
    }
}

static double deepest_of(const struct gb_state_source *source, int64_t k)
{
    return gb_record_number(source->history, k * source->history->columns);
}

static void fill_bridged(const struct gb_state *state, int64_t begin, int64_t end,
                         void *to)
{
    uint8_t *bridged = to;
    for (int64_t k = begin; k < end; k++) {
        bridged[k - begin] = deepest_of(state->source, k) > 0.0;
    }
}

static void fill_radii(const struct gb_state *state, int64_t begin, int64_t end, void *to)
{
    const struct gb_state_source *source = state->source;
    double *radius = to;
    for (int64_t k = begin; k < end; k++) {
        double r[3];
        branch_of(state, k, r);
        radius[k - begin] = state_radius_of(state, source->model, pair_at(source, k),
                                            gb_vec_length(r), deepest_of(source, k));
    }
}

static const struct {
    size_t member;
    void (*fill)(const struct gb_state *state, int64_t begin, int64_t end, void *to);
} arrays[] = {
    {offsetof(struct gb_state, pair), fill_pairs},
    {offsetof(struct gb_state, pair_force), fill_forces},
    {offsetof(struct gb_state, pair_normal), fill_normals},
    {offsetof(struct gb_state, pair_bridged), fill_bridged},
    {offsetof(struct gb_state, contact_radius), fill_radii},
};
enum { ARRAYS = sizeof arrays / sizeof arrays[0] };

/* Index of an array in the table; ARRAYS: an array of the particles. */
static int row_of(size_t member)
{
    int k = 0;
    while (k < ARRAYS && arrays[k].member != member) {
        k++;
    }
    return k;
}

bool gb_state_record_has(const struct gb_state_source *source, size_t member)
{
    return source &&
           (row_of(member) < ARRAYS || gb_state_optional_has(source->record, member));
}

/* Computes rows begin .. end - 1 of an array that the source has. */
static void state_source_fill(const struct gb_state *state, size_t member, int64_t begin,
                              int64_t end, void *to)
{
    const struct gb_state_source *source = state->source;
    const int k = row_of(member);
    if (k < ARRAYS) {
        arrays[k].fill(state, begin, end, to);
    } else {
        gb_state_optional_fill(state, source->record, member, begin, end, to);
    }
}

const void *gb_state_record_rows(const struct gb_state *state, size_t member,
                                 int64_t begin, int64_t end)
{
    state_source_fill(state, member, begin, end, state->source->slab);
    return state->source->slab;
}

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

/* Sets the members of the point that this kind of scene measures. */
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
                            "world/pair: is missing or has the wrong type or shape");
    }
    const int32_t *particle = item->data;
    for (int64_t k = 0; k < 2 * state->pair_count; k++) {
        state->contacts[particle[k]]++;
    }
    return true;
}

/* T of a scene with time; NaN otherwise. */
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

/* Copies the spheres of a bed, with their own radii, into the box of the die. */
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

/* Sets the die from the record.  It has no funnel, because points are recorded after
 * filling. */
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

/* Sets the total forces of walls on particles. */
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

/* Adds normal and shear parts to total forces. */
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

/* Sets a die state from the items of gb_bed_record. */
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
                      state_source_state_radius_fill(state, record, params, err);
    gb_alloc_free(work);
    if (!done) {
        gb_state_destroy(state);
        return false;
    }
    fill_header(state, params, model);
    *out = state;
    return true;
}

/* Sets the particles of a periodic cell and creates the source of its pairs. */
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
    return state_source_create(state, record, model, err);
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

/* Copies all arrays of the source to memory. */
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
    } parts[] = {
        {offsetof(struct gb_state, pair), state->pair},
        {offsetof(struct gb_state, pair_force), state->pair_force},
        {offsetof(struct gb_state, pair_normal), state->pair_normal},
        {offsetof(struct gb_state, pair_bridged), state->pair_bridged},
        {offsetof(struct gb_state, contact_radius), state->contact_radius},
    };
    for (size_t k = 0; k < sizeof parts / sizeof parts[0]; k++) {
        state_source_fill(state, parts[k].member, 0, state->pair_count, parts[k].array);
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
    gb_state_record_destroy((*out)->source);
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
