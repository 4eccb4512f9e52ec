#include "io/state/state_source.h"

#include <stddef.h>
#include <string.h>

#include "base/alloc.h"
#include "base/vec.h"
#include "hdf/hdf.h"
#include "io/state/state_optional.h"
#include "io/state/state_radius.h"

enum { ROW_MAX = 3 * sizeof(double) };

struct gb_state_source {
    const struct gb_record *record;
    const struct gb_model *model;
    const struct gb_record_item *pair, *force;
    const struct gb_record_item *history; /* the first number of a row is the deepest */
    struct gb_cell cell;
    void *slab;
};

/* An item of that shape, or NULL. */
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

bool gb_state_source_create(struct gb_state *state, const struct gb_record *record,
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

void gb_state_source_destroy(struct gb_state_source *source)
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
        radius[k - begin] = gb_state_radius_of(state, source->model, pair_at(source, k),
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

/* ARRAYS: it is an array of the particles. */
static int row_of(size_t member)
{
    int k = 0;
    while (k < ARRAYS && arrays[k].member != member) {
        k++;
    }
    return k;
}

bool gb_state_source_has(const struct gb_state_source *source, size_t member)
{
    return source &&
           (row_of(member) < ARRAYS || gb_state_optional_has(source->record, member));
}

void gb_state_source_fill(const struct gb_state *state, size_t member, int64_t begin,
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

const void *gb_state_source_rows(const struct gb_state *state, size_t member,
                                 int64_t begin, int64_t end)
{
    gb_state_source_fill(state, member, begin, end, state->source->slab);
    return state->source->slab;
}
