#include "pack/f32/f32_state.h"

#include "base/alloc.h"
#include "pack/list/blocks.h"

bool gb_f32_state_init(struct gb_f32_state *f32, const struct gb_model *model,
                       struct gb_error *err)
{
    const size_t n = (size_t)model->count;
    const size_t groups = (n + GB_F32_STATE_GROUP - 1) / GB_F32_STATE_GROUP;
    f32->kernel = gb_batch_f32_pick(model, 0);
    f32->particle = gb_alloc_array(n, sizeof *f32->particle, err);
    f32->velocity = gb_alloc_array(n, sizeof *f32->velocity, err);
    f32->bound = gb_alloc_array(groups, sizeof *f32->bound, err);
    f32->speed2 =
        gb_alloc_array((size_t)gb_blocks_count(model->count), sizeof *f32->speed2, err);
    return f32->particle && f32->velocity && f32->bound && f32->speed2 &&
           gb_wrench_rows_init(&f32->rows, model->count, err);
}

void gb_f32_state_finish(struct gb_f32_state *f32)
{
    gb_alloc_free(f32->particle);
    gb_alloc_free(f32->velocity);
    gb_alloc_free(f32->bound);
    gb_alloc_free(f32->speed2);
    gb_wrench_rows_finish(&f32->rows);
    *f32 = (struct gb_f32_state){0};
}
