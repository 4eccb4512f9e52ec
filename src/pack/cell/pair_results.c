#include "pack/cell/pair_results.h"

#include <string.h>

#include "base/alloc.h"

void gb_pair_results_init(struct gb_pair_results *results, const struct gb_model *model)
{
    results->width = model->record_dimension == 3 ? 6 : 3;
}

void gb_pair_results_finish(struct gb_pair_results *results)
{
    gb_alloc_free(results->wrench);
    gb_alloc_free(results->pull);
    gb_alloc_free(results->far_distance);
    gb_alloc_free(results->far_pull);
    *results = (struct gb_pair_results){0};
}

bool gb_pair_results_resize_near(struct gb_pair_results *results, int64_t capacity,
                                 struct gb_error *err)
{
    gb_alloc_free(results->wrench);
    results->wrench = gb_alloc_array((size_t)capacity * (size_t)results->width,
                                     sizeof *results->wrench, err);
    return results->wrench != NULL;
}

bool gb_pair_results_resize_far(struct gb_pair_results *results, int64_t capacity,
                                enum gb_real real, enum gb_pair_results_far content,
                                struct gb_error *err)
{
    gb_alloc_free(results->far_distance);
    gb_alloc_free(results->far_pull);
    results->far_capacity = 0;
    results->far_distance = results->far_pull = NULL;
    if (real == GB_REAL_F64) {
        gb_alloc_free(results->pull);
        results->pull = gb_alloc_array(3 * (size_t)capacity, sizeof *results->pull, err);
        if (!results->pull) {
            return false;
        }
    }
    if (content == GB_PAIR_RESULTS_FAR_WORK) {
        results->far_distance = gb_alloc_array((size_t)capacity, sizeof(double), err);
        results->far_pull = gb_alloc_array((size_t)capacity, sizeof(double), err);
        if (!results->far_distance || !results->far_pull) {
            return false;
        }
    }
    results->far_capacity = capacity;
    return true;
}

void gb_pair_results_reset_far(struct gb_pair_results *results, int64_t pairs)
{
    if (results->far_distance) {
        memset(results->far_distance, 0, (size_t)pairs * sizeof *results->far_distance);
    }
}

void gb_pair_results_set_force(struct gb_pair_results *results, int64_t k,
                               const double force[3])
{
    double *row = results->wrench + (int64_t)results->width * k;
    if (gb_pair_results_planar(results)) {
        row[0] = force[0];
        row[1] = force[2];
    } else {
        memcpy(row, force, 3 * sizeof *row);
    }
}
