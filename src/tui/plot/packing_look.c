#include "tui/plot/packing_look.h"

#include <math.h>
#include <stdlib.h>

/* Share of the particles that the range covers. */
static const double covered = 0.95;

void gb_packing_look_rotate(struct gb_packing_look *look, double azimuth_deg,
                          double elevation_deg)
{
    look->azimuth_deg = fmod(look->azimuth_deg + azimuth_deg + 360.0, 360.0);
    look->elevation_deg =
        fmin(fmax(look->elevation_deg + elevation_deg, -90.0), 90.0);
}

const float *gb_packing_look_values(const struct gb_view_sample *sample,
                                    enum gb_packing_colour colour)
{
    switch (colour) {
    case GB_PACKING_COLOUR_CONTACTS:
        return sample->value[GB_VIEW_VALUE_CONTACTS];
    case GB_PACKING_COLOUR_PRESSURE:
        return sample->value[GB_VIEW_VALUE_PRESSURE];
    case GB_PACKING_COLOUR_DISPLACEMENT:
        return sample->value[GB_VIEW_VALUE_DISPLACEMENT];
    case GB_PACKING_COLOUR_DEPTH:
    case GB_PACKING_COLOURS:
        break;
    }
    return NULL;
}

static int compare(const void *a, const void *b)
{
    const float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

struct gb_packing_range gb_packing_look_range(const struct gb_view_sample *sample,
                                              enum gb_packing_colour colour)
{
    const float *value = gb_packing_look_values(sample, colour);
    float sorted[GB_VIEW_SAMPLE_POINTS];
    int count = 0;
    for (int i = 0; value != NULL && i < sample->count; i++) {
        if (isfinite(value[i])) {
            sorted[count++] = value[i];
        }
    }
    if (count == 0) {
        return (struct gb_packing_range){0.0, 1.0, false};
    }
    qsort(sorted, (size_t)count, sizeof *sorted, compare);
    const int at = (int)(covered * (count - 1));
    const double low = fmin((double)sorted[0], 0.0), high = (double)sorted[at];
    return (struct gb_packing_range){low, high > low ? high : low + 1.0,
                                     (double)sorted[count - 1] > high};
}

const char *gb_packing_look_name(enum gb_packing_colour colour)
{
    static const char *const names[GB_PACKING_COLOURS] = {
        [GB_PACKING_COLOUR_DEPTH] = "depth",
        [GB_PACKING_COLOUR_CONTACTS] = "coordination number",
        [GB_PACKING_COLOUR_PRESSURE] = "pressure, MPa",
        [GB_PACKING_COLOUR_DISPLACEMENT] = "displacement, d",
    };
    return names[colour];
}
