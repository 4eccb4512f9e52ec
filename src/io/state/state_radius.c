#include "io/state/state_radius.h"

#include <math.h>

#include "base/vec.h"
#include "io/state/state_optional.h"
#include "law/law_unequal.h"
#include "pack/die/filling.h"

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

double gb_state_radius_of(const struct gb_state *state, const struct gb_model *model,
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

/* deepest: of a contact that has flowed, what it keeps; else the contact is elastic. */
static double bed_radius(const struct gb_state *state, const struct gb_bed_law *law,
                         int64_t k, double overlap, double deepest)
{
    const double star = gb_law_hertz_radius(state->radius[state->pair[2 * k]],
                                            state->radius[state->pair[2 * k + 1]]);
    const bool flowed =
        law->storakers && (law->normal.printed ||
                           deepest > gb_law_storakers_transition(&law->normal, star));
    return gb_bed_contacts_radius(law, star, flowed ? deepest : fmax(overlap, 0.0));
}

bool gb_state_radius_fill(struct gb_state *state, const struct gb_record *record,
                          const struct gb_params *params, struct gb_error *err)
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
