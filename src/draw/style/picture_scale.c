#include "draw/style/picture_scale.h"

#include <math.h>
#include <stdlib.h>

#include "base/alloc.h"
#include "draw/style/round_number.h"

/* Quantiles in place of outliers, and the ratio of spans from which on they are used. */
static const double low_quantile = 0.02, high_quantile = 0.98;
static const double outlier_ratio = 1.5;
/* Values that differ by less than this fraction are one value. */
static const double one_value = 1e-9;
/* Ticks that a linear scale has about. */
static const double ticks = 6.0;

static int compare(const void *a, const void *b)
{
    const double x = *(const double *)a;
    const double y = *(const double *)b;
    return (x > y) - (x < y);
}

static bool is_one_value(const struct gb_picture_style_scale *scale)
{
    return !(scale->high - scale->low >
             one_value * fmax(fabs(scale->low), fabs(scale->high)));
}

/* Quantiles, or the ends of the sorted values. */
static void take_ends(struct gb_picture_style_scale *scale, const double *sorted,
                      size_t count)
{
    const double last = (double)(count - 1);
    const double low = sorted[0];
    const double high = sorted[count - 1];
    scale->low = sorted[(size_t)(low_quantile * last)];
    scale->high = sorted[(size_t)ceil(high_quantile * last)];
    const bool wide = scale->log ? log(high / low) > outlier_ratio *
                                                         log(scale->high / scale->low)
                                 : high - low > outlier_ratio * (scale->high - scale->low);
    if (!wide || is_one_value(scale)) { /* outliers may be the only other values */
        scale->low = low;
        scale->high = high;
    }
}

/* Outwards to ticks; a wider scale may have wider steps. */
static void round_ends(struct gb_picture_style_scale *scale)
{
    const double low = scale->low;
    const double high = scale->high;
    if (scale->log) {
        scale->low = gb_round_number_below(low);
        scale->high = gb_round_number_above(high);
        return;
    }
    for (int k = 0; k < 2; k++) {
        const double step = gb_round_number_step((scale->high - scale->low) / ticks);
        scale->low = step * floor(low / step + 1e-9);
        scale->high = step * ceil(high / step - 1e-9);
    }
}

static void fit_data(struct gb_picture_style_scale *scale, const double *sorted,
                     size_t count, enum gb_picture_scale_start start)
{
    take_ends(scale, sorted, count);
    if (start == GB_PICTURE_SCALE_FROM_ZERO && !scale->log) {
        scale->low = 0.0;
    }
    if (is_one_value(scale)) {
        scale->low = scale->high;
        return;
    }
    if (scale->map != NULL && scale->map->diverging && scale->low < 0.0 &&
        scale->high > 0.0) {
        scale->high = fmax(-scale->low, scale->high);
        scale->low = -scale->high;
    }
    round_ends(scale);
}

static bool is_ranged(const struct gb_picture_style_request *request)
{
    return request->high > request->low || request->ranged;
}

static void take_range(struct gb_picture_style_scale *scale,
                       const struct gb_picture_style_request *request, double per_si)
{
    const bool common = request->high > request->low;
    scale->low = common ? request->low : per_si * request->range_si[0];
    scale->high = common ? request->high : per_si * request->range_si[1];
}

static bool fit_sorted(struct gb_picture_style_scale *scale, const double *sorted,
                       size_t count, size_t first, enum gb_picture_scale_start start,
                       double per_si, const struct gb_picture_style_request *request,
                       struct gb_error *err)
{
    if (is_ranged(request)) {
        take_range(scale, request, per_si);
    } else if (first < count) {
        fit_data(scale, sorted + first, count - first, start);
    } else {
        return gb_error_set(err, GB_ERR_INPUT,
                            "--log: no value above 0; accepted with values above 0");
    }
    if (scale->log && !(scale->low > 0.0)) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "--range: accepted from above 0 with --log");
    }
    const double rounding = one_value * (scale->high - scale->low);
    scale->below = rounding > 0.0 && scale->low - sorted[0] > rounding;
    scale->above = rounding > 0.0 && sorted[count - 1] - scale->high > rounding;
    return true;
}

bool gb_picture_scale_fit(struct gb_picture_style_scale *scale, const double *value,
                          size_t count, enum gb_picture_scale_start start, double per_si,
                          const struct gb_picture_style_request *request,
                          struct gb_error *err)
{
    double *sorted = gb_alloc_array(count, sizeof *sorted, err);
    if (sorted == NULL) {
        return false;
    }
    for (size_t i = 0; i < count; i++) {
        sorted[i] = value[i];
    }
    qsort(sorted, count, sizeof *sorted, compare);
    size_t first = 0; /* of the values that the scale can have */
    while (request->log && first < count && !(sorted[first] > 0.0)) {
        first++;
    }
    scale->map = request->map;
    scale->log = request->log;
    const bool good =
        fit_sorted(scale, sorted, count, first, start, per_si, request, err);
    gb_alloc_free(sorted);
    return good;
}

bool gb_picture_scale_fit_whole(struct gb_picture_style_scale *scale,
                                const int32_t *number, size_t count,
                                const struct gb_picture_style_request *request,
                                struct gb_error *err)
{
    scale->whole = true;
    scale->map = request->map;
    scale->high = GB_PALETTE_CONTACTS;
    if (request->log) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "--log: whole numbers; accepted with --color pressure, size "
                            "or displacement");
    }
    if (is_ranged(request)) {
        take_range(scale, request, 1.0);
        scale->low = round(scale->low);
        scale->high = round(scale->high);
    }
    for (size_t i = 0; i < count; i++) {
        scale->below = scale->below || number[i] < scale->low;
        scale->above = scale->above || number[i] > scale->high;
    }
    return true;
}

void gb_picture_scale_colour(const struct gb_picture_style_scale *scale, double value,
                             uint8_t rgb[3])
{
    double share = 0.5;
    if (scale->high > scale->low) {
        share = !scale->log   ? (value - scale->low) / (scale->high - scale->low)
                : value > 0.0 ? log(value / scale->low) / log(scale->high / scale->low)
                              : 0.0;
    }
    gb_palette_value(scale->map, share, rgb);
}
