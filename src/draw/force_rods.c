#include "draw/force_rods.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/alloc.h"
#include "pack/cell/cell.h"

/* Radius of the thickest rods and of the thinnest, d. */
static const double thickest = 0.17;
static const double thinnest = 0.006;
/* Forces above this share of all are drawn as thick as it. */
static const double thickest_share = 0.99;

static const struct gb_picture_style_swatch by_sign[2] = {{"pressed", {38, 96, 160}},
                                                          {"pulled", {222, 104, 24}}};
static const struct gb_picture_style_swatch by_bridge[2] = {
    {"over a bridge", {150, 78, 132}}, {"without bridge", {86, 160, 211}}};

static int compare(const void *a, const void *b)
{
    const double x = *(const double *)a;
    const double y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Force that is drawn thickest, E d^2; 1 when there is none. */
static bool find_reference(const struct gb_state *state, double *reference,
                           struct gb_error *err)
{
    const size_t count = (size_t)state->pair_count;
    double *size = gb_alloc_array(count + 1, sizeof *size, err);
    if (size == NULL) {
        return false;
    }
    for (size_t k = 0; k < count; k++) {
        size[k] = fabs(state->pair_normal[k]);
    }
    qsort(size, count, sizeof *size, compare);
    *reference =
        count > 0 ? size[(size_t)ceil(thickest_share * (double)(count - 1))] : 0.0;
    *reference = *reference > 0.0 ? *reference : 1.0;
    gb_alloc_free(size);
    return true;
}

static void put_rod(struct gb_picture_style *dress, const double *from,
                    const double span[3], double share, double radius,
                    const uint8_t rgb[3])
{
    float *rod = &dress->rod[7 * dress->rods];
    for (int k = 0; k < 3; k++) {
        rod[k] = (float)from[k];
        rod[3 + k] = (float)(from[k] + share * span[k]);
    }
    rod[6] = (float)radius;
    memcpy(&dress->rod_colour[3 * dress->rods], rgb, 3);
    dress->rods++;
}

/* Both ends of a contact; whole where it does not cross a wall. */
static void put_contact(struct gb_picture_style *dress, const struct gb_state *state,
                        const struct gb_cell *cell, int64_t pair, double radius,
                        const uint8_t rgb[3])
{
    const int32_t *ends = &state->pair[2 * pair];
    const double *a = &state->position[3 * ends[0]];
    const double *b = &state->position[3 * ends[1]];
    const double plain[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    double span[3] = {plain[0], plain[1], plain[2]};
    gb_cell_nearest(cell, span);
    const bool inside =
        fabs(span[0] - plain[0]) + fabs(span[1] - plain[1]) + fabs(span[2] - plain[2]) <
        1e-9;
    if (inside) {
        put_rod(dress, a, span, 1.0, radius, rgb);
        return;
    }
    const double back[3] = {-span[0], -span[1], -span[2]};
    put_rod(dress, a, span, 0.5, radius, rgb);
    put_rod(dress, b, back, 0.5, radius, rgb);
}

bool gb_force_rods_make(struct gb_picture_style *dress, const struct gb_state *state,
                        const struct gb_picture_style_request *request,
                        struct gb_error *err)
{
    const bool signs = request->force != GB_PICTURE_STYLE_BRIDGED;
    const size_t most = 2 * (size_t)state->pair_count + 1;
    double reference = 1.0;
    struct gb_cell cell;
    gb_cell_init(&cell, state->dimension, state->cell);
    dress->rod = gb_alloc_array(most, 7 * sizeof *dress->rod, err);
    dress->rod_colour = gb_alloc_array(most, 3, err);
    if (dress->rod == NULL || dress->rod_colour == NULL ||
        !find_reference(state, &reference, err)) {
        return false;
    }
    const double newton =
        state->pascal_per_stress * state->metre_per_length * state->metre_per_length;
    reference = request->thickest_n > 0.0 ? request->thickest_n / newton : reference;
    memcpy(dress->swatch, signs ? by_sign : by_bridge, sizeof dress->swatch);
    dress->swatches = 2;
    dress->thickest_n = reference * newton;
    for (int64_t k = 0; k < state->pair_count; k++) {
        const int32_t *ends = &state->pair[2 * k];
        if (dress->hidden[ends[0]] != 0 || dress->hidden[ends[1]] != 0) {
            continue;
        }
        const double share = fmin(fabs(state->pair_normal[k]) / reference, 1.0);
        const bool first =
            signs ? state->pair_normal[k] >= 0.0 : state->pair_bridged[k] != 0;
        put_contact(dress, state, &cell, k, fmax(thickest * share, thinnest),
                    dress->swatch[first ? 0 : 1].rgb);
    }
    return true;
}
