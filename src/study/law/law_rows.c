#include "study/law/law_rows.h"

#include <math.h>
#include <string.h>

#include <glib.h>

#include "scene/loading_kind.h"
#include "scene/normal_law.h"
#include "study/law/law_points.h"

/* Points between two corners of a path. */
enum { PATH_STEPS = 200 };

size_t gb_law_rows_of_path(size_t corners)
{
    return corners > 0 ? 1 + (corners - 1) * PATH_STEPS : 0;
}

/* A request for one scene. */
struct rows {
    const struct gb_law_rows_request *request;
    const struct gb_law_table_law *law;
    struct gb_law_table_input input;
    double diameter;        /* in units of the variable: 1, or m for a pair */
    double metre;           /* 1 m in units of the variable */
    gb_law_rows_take *take; /* NULL: only check */
    void *data;
};

/* The variable from a typed number: pure numbers are multiples of the diameter, except
 * where the name of the variable is in m. */
static double to_variable(const struct rows *rows, const char *name,
                          struct gb_law_points_number number)
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

static bool take_row(struct rows *rows, double x, struct gb_error *err)
{
    double value[GB_LAW_TABLE_COLUMNS];
    if (rows->take == NULL) {
        return true;
    }
    rows->input.x = x;
    rows->law->values(&rows->input, value);
    return rows->take(value, gb_law_table_columns(rows->law), rows->data, err);
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
    struct gb_law_points_at at;
    if (!gb_law_points_at(&at, text, err)) {
        return false;
    }
    const struct gb_law_table_law *law = rows->law;
    *x = NAN;
    rows->input.h_min = NAN;
    for (int i = 0; i < MIN(at.count, GB_LAW_POINTS_FIXED); i++) {
        const struct gb_law_points_value *item = &at.item[i];
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

static bool take_points(struct rows *rows, struct gb_error *err)
{
    for (int i = 0; rows->request->at[i]; i++) {
        double x = NAN;
        if (!read_at(rows, rows->request->at[i], &x, err)) {
            return false;
        }
        if (isnan(x)) {
            return missing_variable(rows->law, err);
        }
        if (!check_value(rows, x, err) || !take_row(rows, x, err)) {
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
    struct gb_law_points_range range;
    if (!gb_law_points_range(&range, text, err) || !read_fixed(rows, err)) {
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
        return gb_law_points_refuse_range(text, err);
    }
    if (!isnan(rows->input.h_min) && ends[1] > rows->input.h_min) {
        return gb_error_set(err, GB_ERR_INPUT, "--range %.80s: accepted h up to h_min",
                            text);
    }
    return true;
}

static bool take_range(struct rows *rows, struct gb_error *err)
{
    double ends[2] = {0.0, 0.0};
    int64_t count = 0;
    if (!read_range(rows, ends, &count, err)) {
        return false;
    }
    if (!check_value(rows, ends[0], err) || !check_value(rows, ends[1], err)) {
        return false;
    }
    for (int64_t i = 0; rows->take != NULL && i < count; i++) {
        if (!take_row(rows, gb_law_points_between(ends[0], ends[1], count, i), err)) {
            return false;
        }
    }
    return true;
}

/* Follows the history of one contact through the corners. */
static bool follow(struct rows *rows, const double *corners, int count,
                   struct gb_error *err)
{
    const int columns = gb_law_table_columns(rows->law);
    double value[GB_LAW_TABLE_COLUMNS], deepest = 0.0;
    for (int leg = 0; leg < count; leg++) {
        const double from = corners[leg > 0 ? leg - 1 : 0];
        const int steps = leg > 0 ? PATH_STEPS : 1;
        for (int i = 1; i <= steps; i++) {
            rows->input.x = gb_law_points_between(from, corners[leg], steps + 1, i);
            rows->law->follow(&rows->input, &deepest, value);
            if (!rows->take(value, columns, rows->data, err)) {
                return false;
            }
        }
    }
    return true;
}

/* The corners in units of the variable.  The range of the law is not checked along a path,
 * but the centres must not meet. */
static bool read_path(const struct rows *rows, double *corners, int *count,
                      struct gb_error *err)
{
    const char *text = rows->request->path;
    struct gb_law_points_path *path = g_new0(struct gb_law_points_path, 1);
    bool good = gb_law_points_path(path, text, err);
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

static bool take_path(struct rows *rows, struct gb_error *err)
{
    double *corners = g_new(double, GB_LAW_POINTS_CORNERS);
    int count = 0;
    const bool good = read_path(rows, corners, &count, err) &&
                      (rows->take == NULL || follow(rows, corners, count, err));
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

static bool take_rows(struct rows *rows, struct gb_error *err)
{
    if (!check_request(rows, err)) {
        return false;
    }
    if (!rows->law->variable) {
        return take_row(rows, NAN, err);
    }
    return rows->request->path    ? take_path(rows, err)
           : rows->request->range ? take_range(rows, err)
                                  : take_points(rows, err);
}

/* The laws of P3: two bodies, SI units. */
static bool take_pair(struct rows *rows, const struct gb_params *params,
                      struct gb_error *err)
{
    struct gb_contact_pair pair;
    if (!gb_params_check_fields(params, err) ||
        !gb_contact_pair_init(&pair, params, err)) {
        return false;
    }
    rows->input.pair = &pair;
    rows->diameter = pair.diameter;
    rows->metre = 1.0;
    return take_rows(rows, err);
}

/* The laws of P1 also show the constants of a die's powder. */
static bool has_law(const struct gb_model *model, int normal)
{
    return gb_loading_kind_at(model->kind)->periodic_cell ? model->normal == normal
                                                          : normal == GB_NORMAL_ROD;
}

/* Particles of one size, reduced units. */
static bool take_reduced(struct rows *rows, const struct gb_params *params,
                         struct gb_error *err)
{
    struct gb_model model;
    if (!gb_params_check(params, err) || !gb_model_init(&model, params, err)) {
        return false;
    }
    if (!has_law(&model, rows->law->normal)) {
        return gb_error_set(err, GB_ERR_INPUT, "law %s: accepted contact.normal = %s%s",
                            rows->law->name, gb_normal_law_at(rows->law->normal)->name,
                            model.normal == GB_NORMAL_HERTZ
                                ? "; law hertz is for grains without cohesion"
                                : "");
    }
    rows->input.model = &model;
    rows->diameter = 1.0;
    rows->metre = 1.0 / model.metre_per_length;
    return take_rows(rows, err);
}

bool gb_law_rows_compute(const struct gb_law_rows_request *request,
                         const struct gb_params *params, gb_law_rows_take *take,
                         void *data, struct gb_error *err)
{
    struct rows rows = {
        .request = request,
        .law = request->law,
        .input = {.lattice = request->lattice, .h_min = NAN},
        .take = take,
        .data = data,
    };
    return request->law->pair ? take_pair(&rows, params, err)
                              : take_reduced(&rows, params, err);
}

bool gb_law_rows_check(const struct gb_law_rows_request *request,
                       const struct gb_params *params, struct gb_error *err)
{
    return gb_law_rows_compute(request, params, NULL, NULL, err);
}
