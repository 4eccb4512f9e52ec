#include "pack/f32/f32_state.h"

#include "base/alloc.h"
#include "pack/f32/fixed_position.h"
#include "pack/list/blocks.h"

bool gb_f32_state_init(struct gb_f32_state *f32, const struct gb_model *model,
                       struct gb_error *err)
{
    const size_t n = (size_t)model->count;
    const size_t groups = (n + GB_F32_STATE_GROUP - 1) / GB_F32_STATE_GROUP;
    f32->kernel = gb_batch_f32_pick(model, 0);
    f32->particle = gb_alloc_array(n, sizeof *f32->particle, err);
    f32->velocity = gb_alloc_array(n, sizeof *f32->velocity, err);
    f32->built = gb_alloc_array(3 * n, sizeof *f32->built, err);
    f32->bound = gb_alloc_array(groups, sizeof *f32->bound, err);
    f32->speed2 =
        gb_alloc_array((size_t)gb_blocks_count(model->count), sizeof *f32->speed2, err);
    return f32->particle && f32->velocity && f32->built && f32->bound && f32->speed2 &&
           gb_wrench_rows_init(&f32->rows, model->count, err);
}

void gb_f32_state_finish(struct gb_f32_state *f32)
{
    gb_alloc_free(f32->particle);
    gb_alloc_free(f32->velocity);
    gb_alloc_free(f32->built);
    gb_alloc_free(f32->bound);
    gb_alloc_free(f32->speed2);
    gb_wrench_rows_finish(&f32->rows);
    *f32 = (struct gb_f32_state){0};
}

bool gb_f32_state_use_lists(struct gb_f32_state *f32, struct gb_neighbour_list *list,
                            struct gb_error *err)
{
    for (int64_t i = 0; i < list->count; i++) {
        for (int c = 0; c < 3; c++) {
            f32->built[3 * i + c] =
                (uint32_t)gb_fixed_position_of(list->built_position[3 * i + c],
                                               gb_fixed_position_units(&list->built, c));
        }
    }
    return gb_wrench_rows_update(&f32->rows, list, err);
}
