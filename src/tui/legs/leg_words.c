#include "tui/legs/leg_words.h"

#include <glib.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "base/units.h"

static void add(char *text, const char *separator, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Appends to a member of struct gb_leg_words. */
static void add(char *text, const char *separator, const char *format, ...)
{
    char more[GB_LEG_WORDS];
    va_list list;
    va_start(list, format);
    vsnprintf(more, sizeof more, format, list);
    va_end(list);
    if (text[0] != '\0') {
        g_strlcat(text, separator, GB_LEG_WORDS);
    }
    g_strlcat(text, more, GB_LEG_WORDS);
}

static bool is_fixed(const struct gb_leg_component *component)
{
    return component->control == GB_LEG_STRAIN && component->value == 0.0;
}

/* "xz", or "-0.5 x" in proportion to the first. */
static void add_leading(const struct gb_leg *leg, int k, char *text)
{
    const double share = leg->component[k].value;
    const char *name = gb_path_component_name(k);
    if (share == 1.0) {
        add(text, ", ", "%s", name);
    } else {
        add(text, ", ", "%g %s", share, name);
    }
}

static void add_held(const struct gb_leg *leg, int k, char *text)
{
    const struct gb_leg_component *component = &leg->component[k];
    const char *name = gb_path_component_name(k);
    const char *of = component->of >= 0 ? gb_path_component_name(component->of) : "";
    char pressure[32];
    const bool known = isfinite(component->value);
    if (component->control == GB_LEG_STRESS && known) {
        gb_units_format_short(component->value, GB_DIM_PRESSURE, 4, pressure,
                              sizeof pressure);
        add(text, ", ", "%s at %s", name, pressure);
    } else if (component->control == GB_LEG_STRESS) {
        add(text, ", ", "%s as it is", name);
    } else if (component->control == GB_LEG_FOLLOW) {
        add(text, ", ", "%s changes by %g %s", name, component->value, of);
    } else if (known) {
        add(text, ", ", "%s = %g %s", name, component->value, of);
    } else {
        add(text, ", ", "%s in proportion to %s", name, of);
    }
}

static void add_end(const struct gb_leg *leg, const struct gb_leg_end *end, char *text)
{
    char value[32];
    const char *separator = leg->cycles > 0 ? " and " : " or ";
    switch (end->kind) {
    case GB_LEG_END_STEPS:
        add(text, separator, "after %g point%s", end->value,
            end->value == 1.0 ? "" : "s");
        return;
    case GB_LEG_END_STRAIN:
        add(text, separator, "at strain %g %% of %s", 100.0 * end->value,
            leg->leading >= 0 ? gb_path_component_name(leg->leading) : "-");
        return;
    case GB_LEG_END_DENSITY:
        add(text, separator, "at relative density %g", end->value);
        return;
    case GB_LEG_END_RATIO:
        add(text, separator, "at q/p = %g", end->value);
        return;
    default:
        break;
    }
    gb_units_format_short(end->value, GB_DIM_PRESSURE, 4, value, sizeof value);
    add(text, separator, "at %s = %s",
        end->kind == GB_LEG_END_PRESSURE ? "pressure"
        : end->kind == GB_LEG_END_MEAN   ? "p"
        : end->kind == GB_LEG_END_Q      ? "q"
                                         : gb_path_component_name(end->of),
        value);
}

void gb_leg_words_write(const struct gb_leg *leg, int dimension,
                        struct gb_leg_words *words)
{
    *words = (struct gb_leg_words){.leads = ""};
    for (int k = 0; k < GB_PATH_COMPONENTS; k++) {
        const struct gb_leg_component *component = &leg->component[k];
        if (!gb_path_has_component(dimension, k)) {
            continue;
        }
        if (component->control != GB_LEG_STRAIN) {
            add_held(leg, k, words->held);
        } else if (is_fixed(component)) {
            add(words->fixed, ", ", "%s", gb_path_component_name(k));
        } else {
            add_leading(leg, k, words->leads);
        }
    }
    for (int e = 0; e < leg->end_count; e++) {
        add_end(leg, &leg->end[e], words->ends);
    }
    if (leg->cycles > 0) {
        char between[GB_LEG_WORDS];
        g_strlcpy(between, words->ends, sizeof between);
        snprintf(words->ends, sizeof words->ends, "%d time%s there and back: %.120s",
                 leg->cycles, leg->cycles == 1 ? "" : "s", between);
    }
    if (leg->leading < 0) {
        g_strlcpy(words->leads, "nothing: stresses are held", sizeof words->leads);
    }
}
