#include "pack/cell/f32_state.h"

#include "base/alloc.h"
#include "pack/kernel/sweep.h"

static bool outward_init(struct gb_f32_state_outward *out, int64_t count,
                         struct gb_error *err)
{
    const size_t blocks = (size_t)gb_sweep_blocks(count);
    out->start = gb_alloc_array(blocks + 1, sizeof *out->start, err);
    out->source = gb_alloc_array(blocks, sizeof *out->source, err);
    out->in_start = gb_alloc_array((size_t)count + 1, sizeof *out->in_start, err);
    return out->start && out->source && out->in_start;
}

static void outward_drop_rows(struct gb_f32_state_outward *out)
{
    gb_alloc_free(out->in_row);
    gb_alloc_free(out->row);
    out->in_row = NULL;
    out->row = NULL;
    out->room = 0;
}

static void outward_finish(struct gb_f32_state_outward *out)
{
    gb_alloc_free(out->start);
    gb_alloc_free(out->source);
    gb_alloc_free(out->in_start);
    outward_drop_rows(out);
}

bool gb_f32_state_init(struct gb_f32_state *single, const struct gb_model *model,
                       struct gb_error *err)
{
    const size_t n = (size_t)model->count;
    single->kernel = gb_batch_f32_pick(model, 0);
    single->spot = gb_alloc_array(n, sizeof *single->spot, err);
    single->total = gb_alloc_array(n, sizeof *single->total, err);
    single->velocity = gb_alloc_array(3 * n + 1, sizeof *single->velocity, err);
    single->spin = gb_alloc_array(3 * n + 1, sizeof *single->spin, err);
    single->built = gb_alloc_array(3 * n, sizeof *single->built, err);
    single->travel = gb_alloc_array((n + GB_F32_STATE_FLOCK - 1) / GB_F32_STATE_FLOCK,
                                    sizeof *single->travel, err);
    return single->spot && single->total && single->velocity && single->spin &&
           single->built && single->travel &&
           outward_init(&single->near, model->count, err) &&
           outward_init(&single->far, model->count, err);
}

void gb_f32_state_finish(struct gb_f32_state *single)
{
    gb_alloc_free(single->spot);
    gb_alloc_free(single->total);
    gb_alloc_free(single->velocity);
    gb_alloc_free(single->spin);
    gb_alloc_free(single->built);
    gb_alloc_free(single->travel);
    outward_finish(&single->near);
    outward_finish(&single->far);
    *single = (struct gb_f32_state){0};
}

/* Counts the rows, block by block and by the particle that collects them. */
static void count_rows(struct gb_f32_state_outward *out, const struct gb_pair_list *list,
                       int64_t count)
{
    int64_t rows = 0;
    memset(out->in_start, 0, ((size_t)count + 1) * sizeof *out->in_start);
    for (int64_t b = 0; b < gb_sweep_blocks(count); b++) {
        const int64_t begin = gb_sweep_block_begin(count, b),
                      end = gb_sweep_block_end(count, b);
        out->start[b] = rows;
        out->source[b] = b;
        for (int64_t k = list->start[begin]; k < list->start[end]; k++) {
            const int32_t j = list->other[k];
            const bool leaves = j >= end;
            out->in_start[j + 1] += leaves;
            rows += leaves;
        }
    }
    out->start[gb_sweep_blocks(count)] = rows;
    for (int64_t j = 0; j < count; j++) {
        out->in_start[j + 1] += out->in_start[j];
    }
}

/* Who collects which row; leaves in_start as it was. */
static void deal_rows(struct gb_f32_state_outward *out, const struct gb_pair_list *list,
                      int64_t count)
{
    const int64_t size = gb_sweep_block_size(count);
    int32_t row = 0, *in = out->in_start;
    for (int64_t b = 0; b < gb_sweep_blocks(count); b++) {
        const int64_t begin = gb_sweep_block_begin(count, b),
                      end = gb_sweep_block_end(count, b);
        for (int64_t k = list->start[begin]; k < list->start[end]; k++) {
            if (list->other[k] >= end) {
                int64_t *source = &out->source[list->other[k] / size];
                *source = b < *source ? b : *source;
                out->in_row[in[list->other[k]]++] = row++;
            }
        }
    }
    for (int64_t j = count; j > 0; j--) {
        in[j] = in[j - 1];
    }
    in[0] = 0;
}

static bool outward_take(struct gb_f32_state_outward *out,
                         const struct gb_pair_list *list, int64_t count, int width,
                         struct gb_error *err)
{
    count_rows(out, list, count);
    const int64_t rows = out->start[gb_sweep_blocks(count)];
    if (rows >= out->room) {
        const size_t room = (size_t)(rows + rows / 16 + 64);
        outward_drop_rows(out);
        out->in_row = gb_alloc_array(room + GB_F32_STATE_SLACK, sizeof *out->in_row, err);
        out->row = gb_alloc_array(room * (size_t)width, sizeof *out->row, err);
        if (!out->in_row || !out->row) {
            outward_drop_rows(out);
            return false;
        }
        out->room = (int64_t)room;
    }
    deal_rows(out, list, count);
    return true;
}

/* Places at the build. */
static void take_built(struct gb_f32_state *single, const struct gb_neighbour_list *pairs)
{
    double units[3];
    for (int c = 0; c < 3; c++) {
        units[c] = 0x1p32 / pairs->built_edge[c];
    }
    for (int64_t i = 0; i < pairs->count; i++) {
        for (int c = 0; c < 3; c++) {
            single->built[3 * i + c] =
                (uint32_t)gb_f32_state_place(pairs->built_at[3 * i + c], units[c]);
        }
    }
}

bool gb_f32_state_amend(struct gb_f32_state *single,
                        const struct gb_neighbour_list *pairs, bool near, bool far,
                        struct gb_error *err)
{
    return (!near || outward_take(&single->near, &pairs->near, pairs->count,
                                  GB_F32_STATE_WRENCH, err)) &&
           (!far || outward_take(&single->far, &pairs->far, pairs->count,
                                 GB_F32_STATE_PULL, err));
}

bool gb_f32_state_take_lists(struct gb_f32_state *single,
                             const struct gb_neighbour_list *pairs, struct gb_error *err)
{
    take_built(single, pairs);
    return gb_f32_state_amend(single, pairs, true, true, err);
}

void gb_f32_state_arm(const struct gb_cell *cell, const double xi[3], const double xj[3],
                      double r[3])
{
    for (int c = 0; c < 3; c++) {
        const double units = gb_f32_state_units(cell, c);
        const uint32_t a = (uint32_t)gb_f32_state_place(xi[c], units);
        const uint32_t b = (uint32_t)gb_f32_state_place(xj[c], units);
        const uint32_t wide = a - b;
        int32_t difference;
        memcpy(&difference, &wide, sizeof difference);
        r[c] = (double)((float)difference * (float)gb_f32_state_d(cell, c));
    }
}
