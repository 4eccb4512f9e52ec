#include "io/status/stage_text.h"

#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#include "base/units.h"

static const char *const names[GB_STAGES] = {
    [GB_STAGE_NONE] = "",
    [GB_STAGE_FILLING] = "filling",
    [GB_STAGE_SETTLING] = "settling",
    [GB_STAGE_EASING] = "easing gravity",
    [GB_STAGE_RESETTLING] = "settling",
    [GB_STAGE_FLATTENING] = "flattening",
    [GB_STAGE_LIFTING] = "lifting punch",
    [GB_STAGE_RESTING] = "coming to rest",
    [GB_STAGE_PRESS] = "pressing",
    [GB_STAGE_UNLOADING] = "unloading",
    [GB_STAGE_WITHDRAWAL] = "punch off",
    [GB_STAGE_CONFINED] = "rest in die",
    [GB_STAGE_EJECTION] = "ejection",
    [GB_STAGE_EJECTED] = "rest outside",
};

/* Quantity, and the unit of value and goal; GB_DIM_NONE: a multiple of a limit. */
static const struct {
    const char *quantity;
    enum gb_dimension dimension;
    const char *limit;
} measures[GB_STAGE_MEASURES] = {
    [GB_STAGE_MEASURE_NONE] = {"", GB_DIM_NONE, ""},
    [GB_STAGE_MEASURE_POURED] = {"particles poured", GB_DIM_NONE, ""},
    [GB_STAGE_MEASURE_KINETIC] = {"kinetic energy", GB_DIM_NONE, "limit"},
    [GB_STAGE_MEASURE_UNBALANCED] = {"unbalanced force", GB_DIM_NONE, "limit"},
    [GB_STAGE_MEASURE_GRAVITY] = {"gravity", GB_DIM_NONE, "final"},
    [GB_STAGE_MEASURE_TRAVEL] = {"travel", GB_DIM_LENGTH, ""},
    [GB_STAGE_MEASURE_PRESSURE] = {"pressure", GB_DIM_PRESSURE, ""},
    [GB_STAGE_MEASURE_TIME] = {"simulated time", GB_DIM_TIME, ""},
};

const char *gb_stage_text_name(enum gb_stage stage)
{
    return names[stage];
}

const char *gb_stage_text_quantity(enum gb_stage_measure measure)
{
    return measures[measure].quantity;
}

enum gb_stage gb_stage_text_find(const char *name)
{
    for (int k = 0; k < GB_STAGES; k++) {
        if (strcmp(names[k], name) == 0) {
            return (enum gb_stage)k;
        }
    }
    return GB_STAGE_NONE;
}

enum gb_stage_measure gb_stage_text_find_quantity(const char *quantity)
{
    for (int k = 0; k < GB_STAGE_MEASURES; k++) {
        if (strcmp(measures[k].quantity, quantity) == 0) {
            return (enum gb_stage_measure)k;
        }
    }
    return GB_STAGE_MEASURE_NONE;
}

/* "0.4", "35", "48k", "1.2M". */
static void write_multiple(double value, char *text, size_t size)
{
    const char *prefix = value >= 999.5e3 ? "M" : value >= 999.5 ? "k" : "";
    const double scaled = value >= 999.5e3 ? 1e-6 * value
                          : value >= 999.5 ? 1e-3 * value
                                           : value;
    snprintf(text, size, scaled < 9.95 ? "%.1f%s" : "%.0f%s", scaled, prefix);
}

char *gb_stage_text_value(const struct gb_stage_report *report, char *text, size_t size)
{
    const enum gb_dimension dimension = measures[report->measure].dimension;
    char value[48], goal[48];
    text[0] = '\0';
    if (report->measure == GB_STAGE_MEASURE_POURED) {
        snprintf(text, size, "%.0f of %.0f", report->value, report->goal);
    } else if (dimension != GB_DIM_NONE) {
        gb_units_format_short(report->value, dimension, 3, value, sizeof value);
        gb_units_format_short(report->goal, dimension, 3, goal, sizeof goal);
        snprintf(text, size, "%s of %s", value, goal);
        if (!(report->goal > 0.0)) { /* it falls to none */
            snprintf(text, size, "%s", value);
        }
    } else if (report->measure != GB_STAGE_MEASURE_NONE) {
        write_multiple(report->value, value, sizeof value);
        snprintf(text, size, "%s x %s", value, measures[report->measure].limit);
    }
    return text;
}

char *gb_stage_text_line(const struct gb_stage_report *report, char *text, size_t size)
{
    char value[112];
    gb_stage_text_value(report, value, sizeof value);
    const bool named = measures[report->measure].dimension == GB_DIM_NONE &&
                       value[0] != '\0'; /* a unit names the quantity */
    snprintf(text, size, "%s%s%s%s%s", gb_stage_text_name(report->stage),
             value[0] != '\0' ? ": " : "",
             named ? gb_stage_text_quantity(report->measure) : "", named ? " " : "",
             value);
    return text;
}
