#include "tui/panel/panel_plot_ranges.h"

#include <glib.h>
#include <stdio.h>
#include <string.h>

#include "base/units.h"

/* Names of the quantities as they are typed. */
static const struct {
    const char *name;
    enum gb_dimension dimension;
    double least; /* lowest value that is accepted */
} quantity[GB_PLOT_RANGES] = {
    [GB_PLOT_RANGE_PRESSURE] = {"p", GB_DIM_PRESSURE, 0.0},
    [GB_PLOT_RANGE_DENSITY] = {"rho", GB_DIM_NONE, 0.0},
    [GB_PLOT_RANGE_TIME] = {"t", GB_DIM_NONE, 0.0},
    [GB_PLOT_RANGE_RATIO] = {"ratio", GB_DIM_NONE, 0.0},
    [GB_PLOT_RANGE_DIFFERENCE] = {"drho", GB_DIM_NONE, -1.0},
};

static const char accepted[] = "as p=10 MPa:500 MPa rho=0.3:0.6; p, rho, t, ratio, drho";

static int find(const char *name, size_t length)
{
    int of = 0;
    while (of < GB_PLOT_RANGES && (strlen(quantity[of].name) != length ||
                                   strncmp(quantity[of].name, name, length) != 0)) {
        of++;
    }
    return of;
}

/* An end; one without a unit has that of the other end. */
static bool parse_end(int of, const char *text, const char *other, double *value,
                      struct gb_error *err)
{
    char *end = NULL;
    char *unit = NULL;
    g_ascii_strtod(text, &end);
    g_ascii_strtod(other, &unit);
    char *whole = g_strconcat(text, end != text && *end == '\0' ? unit : "", NULL);
    struct gb_error reason = {0};
    const bool good = gb_units_parse(whole, quantity[of].dimension, value, &reason);
    g_free(whole);
    return good || gb_error_set(err, GB_ERR_INPUT, "%s: %s", quantity[of].name,
                                reason.text);
}

/* "10 MPa:500 MPa" */
static bool parse_range(struct gb_plot_range *range, int of, const char *text,
                        struct gb_error *err)
{
    char **ends = g_strsplit(text, ":", -1);
    bool good = g_strv_length(ends) == 2;
    if (good) {
        g_strstrip(ends[0]);
        g_strstrip(ends[1]);
        good = parse_end(of, ends[0], ends[1], &range->low, err) &&
               parse_end(of, ends[1], ends[0], &range->high, err);
    } else {
        gb_error_set(err, GB_ERR_INPUT, "%s=%s: two values are needed, %s",
                     quantity[of].name, text, accepted);
    }
    if (good && !(range->low < range->high && range->low >= quantity[of].least)) {
        good = gb_error_set(err, GB_ERR_INPUT,
                            "%s=%s: the first value must be below the second%s",
                            quantity[of].name, text,
                            quantity[of].least < 0.0 ? "" : " and not negative");
    }
    range->typed = good;
    g_strfreev(ends);
    return good;
}

/* Begin of the name in front of an equal sign; blanks between them do not count. */
static const char *name_before(const char *text, const char *equal, size_t *length)
{
    while (equal > text && equal[-1] == ' ') {
        equal--;
    }
    const char *end = equal;
    while (equal > text && g_ascii_isalnum(equal[-1])) {
        equal--;
    }
    *length = (size_t)(end - equal);
    return equal;
}

/* One "name=low:high" from *at on, which goes to the next one. */
static bool parse_next(struct gb_plot_ranges *ranges, const char **at,
                       struct gb_error *err)
{
    const char *equal = strchr(*at, '=');
    size_t length = 0;
    const char *name = equal != NULL ? name_before(*at, equal, &length) : *at;
    const int of = find(name, length);
    if (equal == NULL || name != *at || of == GB_PLOT_RANGES) {
        return gb_error_set(err, GB_ERR_INPUT, "%.60s: accepted are ranges %s", *at,
                            accepted);
    }
    const char *next = strchr(equal + 1, '=');
    const char *end =
        next != NULL ? name_before(equal + 1, next, &length) : equal + 1 + strlen(equal + 1);
    char *value = g_strndup(equal + 1, (size_t)(end - equal - 1));
    g_strdelimit(value, ",;", ' ');
    const bool good = parse_range(&ranges->of[of], of, g_strstrip(value), err);
    g_free(value);
    *at = end;
    return good;
}

bool gb_panel_plot_ranges_parse(struct gb_plot_ranges *ranges, const char *text,
                                struct gb_error *err)
{
    struct gb_plot_ranges fresh = {.of = {{.typed = false}}};
    char *copy = g_strstrip(g_strdup(text));
    const char *at = copy;
    bool good = true;
    while (good && *at != '\0') {
        good = parse_next(&fresh, &at, err);
    }
    g_free(copy);
    if (good) {
        *ranges = fresh;
    }
    return good;
}

void gb_panel_plot_ranges_write(const struct gb_plot_ranges *ranges, char *text,
                                size_t size)
{
    size_t n = 0;
    text[0] = '\0';
    for (int of = 0; of < GB_PLOT_RANGES && n < size; of++) {
        const struct gb_plot_range *range = &ranges->of[of];
        if (range->typed) {
            char low[48], high[48];
            gb_units_format(range->low, quantity[of].dimension, low, sizeof low);
            gb_units_format(range->high, quantity[of].dimension, high, sizeof high);
            n += (size_t)snprintf(text + n, size - n, "%s%s=%s:%s", n > 0 ? " " : "",
                                  quantity[of].name, low, high);
        }
    }
}

bool gb_panel_plot_ranges_any(const struct gb_plot_ranges *ranges)
{
    bool any = false;
    for (int of = 0; of < GB_PLOT_RANGES; of++) {
        any = any || ranges->of[of].typed;
    }
    return any;
}

bool gb_panel_plot_ranges_inside(const struct gb_plot_ranges *ranges,
                                 enum gb_plot_range_of of, double value)
{
    const struct gb_plot_range *range = &ranges->of[of];
    return !range->typed || (value >= range->low && value <= range->high);
}

static bool apply(const struct gb_plot_range *range, double unit, double ends[2])
{
    if (range->typed) {
        ends[0] = range->low / unit;
        ends[1] = range->high / unit;
    }
    return range->typed;
}

void gb_panel_plot_ranges_x(const struct gb_plot_ranges *ranges,
                            enum gb_plot_range_of of, double unit, struct gb_plot *plot,
                            double ends[2])
{
    plot->exact_x = apply(&ranges->of[of], unit, ends);
}

void gb_panel_plot_ranges_y(const struct gb_plot_ranges *ranges,
                            enum gb_plot_range_of of, double unit, struct gb_plot *plot,
                            double ends[2])
{
    plot->exact_y = apply(&ranges->of[of], unit, ends);
}
