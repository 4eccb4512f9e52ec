#include "cli/law/law_rows.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cli/law/points.h"
#include "cli/options.h"

/* Points between two corners of a path. */
enum { PATH_STEPS = 200 };

/* The rows of one scene under way. */
struct rows {
    const struct gb_law_rows_request *request;
    const struct gb_law_table_law *law;
    struct gb_law_table_input input;
    double diameter; /* in units of the variable: 1, or m for a pair */
    double metre;    /* the same of 1 m */
    bool dry;
};

/* The variable from what was typed: pure numbers are multiples of the diameter, except
 * where the name says m. */
static double to_variable(const struct rows *rows, const char *name,
                          struct gb_points_number number)
{
    if (number.length) {
        return number.value * rows->metre;
    }
    const bool metres = rows->law->pair && strcmp(name, rows->law->variable) == 0;
    return number.value * (metres ? rows->metre : rows->diameter);
}

/* A pair's overlap may also be given as h or h/2R. */
static bool names_variable(const struct gb_law_table_law *law, const char *name)
{
    return strcmp(name, law->variable) == 0 ||
           (law->pair && (strcmp(name, "h") == 0 || strcmp(name, "h/2R") == 0));
}

static bool check_value(const struct rows *rows, double value, struct gb_error *err)
{
    const struct gb_law_table_law *law = rows->law;
    const double room = law->bridged ? rows->input.model->bridge.length : 0.0;
    const double low = law->low * rows->diameter;
    const double high = (law->high - room) * rows->diameter;
    if (value >= low && value < high) {
        return true;
    }
    return gb_error_set(err, GB_ERR_INPUT, "%s = %g: accepted %g up to below %g for %s",
                        law->variable, value, low, high, law->name);
}

static void print_column(const struct rows *rows)
{
    if (rows->request->column) {
        printf("%s,", rows->request->column);
    }
}

/* One row; false when the reader has gone or the disk is full. */
static bool print_row(struct rows *rows, double x, struct gb_error *err)
{
    if (!check_value(rows, x, err)) {
        return false;
    }
    if (rows->dry) {
        return true;
    }
    rows->input.x = x;
    print_column(rows);
    rows->law->print(&rows->input);
    return !ferror(stdout) || gb_options_output_failed(err);
}

static bool set_h_min(struct rows *rows, double value, struct gb_error *err)
{
    if (!(value > 0.0 && value < 1.0)) {
        return gb_error_set(err, GB_ERR_INPUT, "h_min = %g: accepted above 0 and below 1",
                            value);
    }
    rows->input.h_min = value;
    return true;
}

/* Reads the variables of one --at; *x stays NaN when only h_min is there. */
static bool read_at(struct rows *rows, const char *text, double *x, struct gb_error *err)
{
    struct gb_points_at at;
    if (!gb_points_at(&at, text, err)) {
        return false;
    }
    const struct gb_law_table_law *law = rows->law;
    *x = NAN;
    rows->input.h_min = NAN;
    for (int i = 0; i < MIN(at.count, GB_POINTS_FIXED); i++) {
        const struct gb_points_value *item = &at.item[i];
        const double value = to_variable(rows, item->name, item->number);
        const bool h_min = law->h_min && strcmp(item->name, "h_min") == 0;
        if (h_min && isnan(rows->input.h_min)) {
            if (!set_h_min(rows, value, err)) {
                return false;
            }
        } else if (!h_min && names_variable(law, item->name) && isnan(*x)) {
            *x = value;
        } else {
            return gb_error_set(err, GB_ERR_INPUT, "--at %.80s: accepted %s%s, each once",
                                text, law->variable,
                                law->h_min  ? " and h_min"
                                : law->pair ? ", h or h/2R"
                                            : "");
        }
    }
    if (!isnan(*x) && !isnan(rows->input.h_min) && *x > rows->input.h_min) {
        return gb_error_set(err, GB_ERR_INPUT, "--at %.80s: accepted h up to h_min",
                            text);
    }
    return true;
}

static bool missing_variable(const struct gb_law_table_law *law, struct gb_error *err)
{
    return gb_error_set(
        err, GB_ERR_INPUT, "law %s needs --at %s=VALUE or --range %s=FROM:TO:COUNT%s",
        law->name, law->variable, law->variable, law->follow ? " or --path H,H,..." : "");
}

static bool print_points(struct rows *rows, struct gb_error *err)
{
    for (int i = 0; rows->request->at[i]; i++) {
        double x = NAN;
        if (!read_at(rows, rows->request->at[i], &x, err)) {
            return false;
        }
        if (isnan(x)) {
            return missing_variable(rows->law, err);
        }
        if (!print_row(rows, x, err)) {
            return false;
        }
    }
    return true;
}

/* Beside --range one --at may hold h_min. */
static bool read_fixed(struct rows *rows, struct gb_error *err)
{
    char **at = rows->request->at;
    double x = NAN;
    if (!at) {
        return true;
    }
    if (!read_at(rows, at[0], &x, err)) {
        return false;
    }
    return (isnan(x) && !at[1]) ||
           gb_error_set(err, GB_ERR_INPUT,
                        "--at %.80s: %s is in --range already; accepted one --at h_min=H",
                        at[0], rows->law->variable);
}

static bool read_range(struct rows *rows, double ends[2], int64_t *count,
                       struct gb_error *err)
{
    const char *text = rows->request->range;
    struct gb_points_range range;
    if (!gb_points_range(&range, text, err) || !read_fixed(rows, err)) {
        return false;
    }
    if (!names_variable(rows->law, range.name)) {
        return gb_error_set(err, GB_ERR_INPUT, "--range %.80s: accepted %s for law %s",
                            text, rows->law->variable, rows->law->name);
    }
    ends[0] = to_variable(rows, range.name, range.from);
    ends[1] = to_variable(rows, range.name, range.to);
    *count = range.count;
    if (!(ends[0] < ends[1] || (ends[0] == ends[1] && range.count == 1))) {
        return gb_points_refuse_range(text, err);
    }
    if (!isnan(rows->input.h_min) && ends[1] > rows->input.h_min) {
        return gb_error_set(err, GB_ERR_INPUT, "--range %.80s: accepted h up to h_min",
                            text);
    }
    return true;
}

static bool print_range(struct rows *rows, struct gb_error *err)
{
    double ends[2];
    int64_t count = 0;
    if (!read_range(rows, ends, &count, err)) {
        return false;
    }
    const int64_t stride = rows->dry && count > 1 ? count - 1 : 1;
    for (int64_t i = 0; i < count; i += stride) {
        if (!print_row(rows, gb_points_between(ends[0], ends[1], count, i), err)) {
            return false;
        }
    }
    return true;
}

/* Follows the history of one contact through the corners. */
static bool follow(struct rows *rows, const double *corners, int count,
                   struct gb_error *err)
{
    double deepest = 0.0;
    for (int leg = 0; leg < count; leg++) {
        const double from = corners[leg > 0 ? leg - 1 : 0];
        const int steps = leg > 0 ? PATH_STEPS : 1;
        for (int i = 1; i <= steps; i++) {
            rows->input.x = gb_points_between(from, corners[leg], steps + 1, i);
            print_column(rows);
            rows->law->follow(&rows->input, &deepest);
            if (ferror(stdout)) {
                return gb_options_output_failed(err);
            }
        }
    }
    return true;
}

/* The corners in units of the variable; the ends of what the law describes are its own
 * affair, but centres do not meet. */
static bool read_path(const struct rows *rows, double *corners, int *count,
                      struct gb_error *err)
{
    const char *text = rows->request->path;
    struct gb_points_path *path = g_new0(struct gb_points_path, 1);
    bool good = gb_points_path(path, text, err);
    if (good && path->name[0] && !names_variable(rows->law, path->name)) {
        good = gb_error_set(err, GB_ERR_INPUT, "--path %.80s: accepted %s for law %s",
                            text, rows->law->variable, rows->law->name);
    }
    for (int i = 0; good && i < path->count; i++) {
        corners[i] = to_variable(rows, path->name, path->corner[i]);
        if (!(corners[i] > -1e6 * rows->diameter && corners[i] < rows->diameter)) {
            good = gb_error_set(err, GB_ERR_INPUT, "--path %.80s: accepted %s below %g",
                                text, rows->law->variable, rows->diameter);
        }
    }
    *count = path->count;
    g_free(path);
    return good;
}

static bool print_path(struct rows *rows, struct gb_error *err)
{
    double *corners = g_new(double, GB_POINTS_CORNERS);
    int count = 0;
    const bool good = read_path(rows, corners, &count, err) &&
                      (rows->dry || follow(rows, corners, count, err));
    g_free(corners);
    return good;
}

/* Which options this law takes, and that the scene has what it describes. */
static bool check_request(const struct rows *rows, struct gb_error *err)
{
    const struct gb_law_rows_request *request = rows->request;
    const struct gb_law_table_law *law = rows->law;
    const int given = (request->path ? 1 : 0) + (request->range || request->at ? 1 : 0);
    if (law->bridged && !rows->input.model->terms.bridges) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "law %s: the scene has no bridges; accepted "
                            "contact.bridge_length below 1 d",
                            law->name);
    }
    if ((request->path && !law->follow) || given > 1 || (!law->variable && given > 0)) {
        return gb_error_set(err, GB_ERR_INPUT, "law %s: accepted %s", law->name,
                            !law->variable ? "no --at, --range or --path"
                            : law->follow  ? "--at, --range or --path alone"
                                           : "--at or --range");
    }
    return !law->variable || given > 0 || missing_variable(law, err);
}

static bool print_rows(struct rows *rows, struct gb_error *err)
{
    if (!check_request(rows, err)) {
        return false;
    }
    if (!rows->law->variable) {
        if (!rows->dry) {
            print_column(rows);
            rows->law->print(&rows->input);
        }
        return true;
    }
    return rows->request->path    ? print_path(rows, err)
           : rows->request->range ? print_range(rows, err)
                                  : print_points(rows, err);
}

bool gb_law_rows_print(const struct gb_law_rows_request *request,
                       const struct gb_params *params, bool dry, struct gb_error *err)
{
    struct gb_model model;
    struct gb_contact_pair pair;
    struct rows rows = {
        .request = request,
        .law = request->law,
        .input = {.lattice = request->lattice, .h_min = NAN},
        .dry = dry,
    };
    if (request->law->pair) {
        if (!gb_params_check_fields(params, err) ||
            !gb_contact_pair_init(&pair, params, err)) {
            return false;
        }
        rows.input.pair = &pair;
        rows.diameter = pair.diameter;
        rows.metre = 1.0;
    } else {
        if (!gb_params_check(params, err) || !gb_model_init(&model, params, err)) {
            return false;
        }
        if (model.cohesionless) {
            return gb_error_set(err, GB_ERR_INPUT,
                                "law %s: accepted contact.normal = rod; law hertz is "
                                "that of dry grains",
                                request->law->name);
        }
        rows.input.model = &model;
        rows.diameter = 1.0;
        rows.metre = 1.0 / model.metre_per_length;
    }
    return print_rows(&rows, err);
}
