#include "pack/single.h"

#include "base/alloc.h"

bool gb_single_init(struct gb_single *single, const struct gb_model *model,
                    struct gb_error *err)
{
    const size_t n = (size_t)model->count;
    single->kernel = gb_batch_single_pick(model, 0);
    single->spot = gb_alloc_array(n, sizeof *single->spot, err);
    single->total = gb_alloc_array(n, sizeof *single->total, err);
    return single->spot && single->total;
}

void gb_single_finish(struct gb_single *single)
{
    gb_alloc_free(single->spot);
    gb_alloc_free(single->total);
    gb_alloc_free(single->row);
    gb_alloc_free(single->pull);
    *single = (struct gb_single){0};
}

bool gb_single_reserve_near(struct gb_single *single, int64_t room, struct gb_error *err)
{
    gb_alloc_free(single->row);
    single->row = gb_alloc_array((size_t)room, sizeof *single->row, err);
    return single->row != NULL;
}

bool gb_single_reserve_far(struct gb_single *single, int64_t room, struct gb_error *err)
{
    gb_alloc_free(single->pull);
    single->pull = gb_alloc_array((size_t)room, sizeof *single->pull, err);
    return single->pull != NULL;
}

void gb_single_arm(const struct gb_cell *cell, const double xi[3], const double xj[3],
                   double r[3])
{
    for (int c = 0; c < 3; c++) {
        const double units = gb_single_units(cell, c);
        const uint32_t a = (uint32_t)gb_single_place(xi[c], units);
        const uint32_t b = (uint32_t)gb_single_place(xj[c], units);
        const uint32_t wide = a - b;
        int32_t difference;
        memcpy(&difference, &wide, sizeof difference);
        r[c] = (double)((float)difference * (float)(cell->edge[c] * 0x1p-32));
    }
}
