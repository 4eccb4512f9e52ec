#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cli/commands.h"
#include "cli/lawtable.h"
#include "cli/options.h"
#include "cli/points.h"

/* Points between two corners of a path. */
enum { PATH_STEPS = 200 };

static const double far = 1e6; /* diameters; no law reaches there */

struct request {
    const struct gb_lawtable_law *law;
    struct gb_lawtable_input input;
    char **at;
    char *range;
    char *path;
    char *vary;
    const char *column; /* value of the varied key, printed before each row; or NULL */
    bool dry; /* check only: nothing is printed before all of the request is understood */
};

static bool check_value(const struct gb_lawtable_law *law, const struct gb_model *model,
                        double value, struct gb_error *err)
{
    const double room = law->bridged ? model->bridge.length : 0.0;
    if (value >= law->low && value + room < law->high) {
        return true;
    }
    return gb_error_set(err, GB_ERR_INPUT, "%s = %g: accepted %g up to below %g for %s",
                        law->variable, value, law->low, law->high - room, law->name);
}

static void print_column(const struct request *request)
{
    if (request->column) {
        printf("%s,", request->column);
    }
}

/* One row; false when the reader has gone or the disk is full. */
static bool print_row(struct request *request, double x, struct gb_error *err)
{
    if (!check_value(request->law, request->input.model, x, err)) {
        return false;
    }
    if (request->dry) {
        return true;
    }
    request->input.x = x;
    print_column(request);
    request->law->print(&request->input);
    return !ferror(stdout) || gb_options_output_failed(err);
}

static bool set_h_min(struct request *request, double value, struct gb_error *err)
{
    if (!(value > 0.0 && value < 1.0)) {
        return gb_error_set(err, GB_ERR_INPUT, "h_min = %g: accepted above 0 and below 1",
                            value);
    }
    request->input.h_min = value;
    return true;
}

/* Reads the variables of one --at; *x stays NaN when only h_min is there. */
static bool read_at(struct request *request, const char *text, double *x,
                    struct gb_error *err)
{
    struct gb_points_at at;
    if (!gb_points_at(&at, text, err)) {
        return false;
    }
    const struct gb_lawtable_law *law = request->law;
    *x = NAN;
    request->input.h_min = NAN;
    for (int i = 0; i < MIN(at.count, GB_POINTS_FIXED); i++) {
        const struct gb_points_value *item = &at.item[i];
        const bool h_min = law->h_min && strcmp(item->name, "h_min") == 0;
        if (h_min && isnan(request->input.h_min)) {
            if (!set_h_min(request, item->value, err)) {
                return false;
            }
        } else if (!h_min && strcmp(item->name, law->variable) == 0 && isnan(*x)) {
            *x = item->value;
        } else {
            return gb_error_set(err, GB_ERR_INPUT, "--at %.80s: accepted %s%s, each once",
                                text, law->variable, law->h_min ? " and h_min" : "");
        }
    }
    if (!isnan(*x) && !isnan(request->input.h_min) && *x > request->input.h_min) {
        return gb_error_set(err, GB_ERR_INPUT, "--at %.80s: accepted h up to h_min",
                            text);
    }
    return true;
}

static bool missing_variable(const struct gb_lawtable_law *law, struct gb_error *err)
{
    return gb_error_set(
        err, GB_ERR_INPUT, "law %s needs --at %s=VALUE or --range %s=FROM:TO:COUNT%s",
        law->name, law->variable, law->variable, law->path ? " or --path H,H,..." : "");
}

static bool print_points(struct request *request, struct gb_error *err)
{
    for (int i = 0; request->at[i]; i++) {
        double x = NAN;
        if (!read_at(request, request->at[i], &x, err)) {
            return false;
        }
        if (isnan(x)) {
            return missing_variable(request->law, err);
        }
        if (!print_row(request, x, err)) {
            return false;
        }
    }
    return true;
}

/* Beside --range one --at may hold h_min. */
static bool read_fixed(struct request *request, struct gb_error *err)
{
    double x = NAN;
    if (!request->at) {
        return true;
    }
    if (!read_at(request, request->at[0], &x, err)) {
        return false;
    }
    return (isnan(x) && !request->at[1]) ||
           gb_error_set(err, GB_ERR_INPUT,
                        "--at %.80s: %s is in --range already; accepted one --at h_min=H",
                        request->at[0], request->law->variable);
}

static bool print_range(struct request *request, struct gb_error *err)
{
    struct gb_points_range range;
    if (!gb_points_range(&range, request->range, err) || !read_fixed(request, err)) {
        return false;
    }
    if (strcmp(range.name, request->law->variable) != 0) {
        return gb_error_set(err, GB_ERR_INPUT, "--range %.80s: accepted %s for law %s",
                            request->range, request->law->variable, request->law->name);
    }
    if (!isnan(request->input.h_min) && range.to > request->input.h_min) {
        return gb_error_set(err, GB_ERR_INPUT, "--range %.80s: accepted h up to h_min",
                            request->range);
    }
    const int64_t stride = request->dry && range.count > 1 ? range.count - 1 : 1;
    for (int64_t i = 0; i < range.count; i += stride) {
        if (!print_row(request, gb_points_range_value(&range, i), err)) {
            return false;
        }
    }
    return true;
}

/* Follows the history of one contact through the corners. */
static bool follow(const struct request *request, const double *corners, int count,
                   struct gb_error *err)
{
    const struct gb_model *model = request->input.model;
    double h_min = 0.0;
    for (int leg = 0; leg < count; leg++) {
        const double to = corners[leg];
        const double from = leg > 0 ? corners[leg - 1] : to;
        const int steps = leg > 0 ? PATH_STEPS : 1;
        for (int i = 1; i <= steps; i++) {
            const double h = i == steps ? to : from + (to - from) * i / steps;
            h_min = model->terms.bridges ? gb_law_bridge_deepest(&model->bridge, h_min, h)
                                         : 0.0;
            print_column(request);
            gb_lawtable_print_contact(model, h, h_min);
            if (ferror(stdout)) {
                return gb_options_output_failed(err);
            }
        }
    }
    return true;
}

static bool print_path(const struct request *request, struct gb_error *err)
{
    double *corners = g_new(double, GB_POINTS_CORNERS);
    int count = 0;
    bool good = gb_points_path(corners, &count, request->path, err);
    for (int i = 0; i < count && good; i++) {
        if (!(corners[i] > -far && corners[i] < 1.0)) {
            good = gb_error_set(err, GB_ERR_INPUT, "--path %.80s: accepted h below 1",
                                request->path);
        }
    }
    good = good && (request->dry || follow(request, corners, count, err));
    g_free(corners);
    return good;
}

/* Which options this law takes, and that the scene has what it describes. */
static bool check_request(const struct request *request, struct gb_error *err)
{
    const struct gb_lawtable_law *law = request->law;
    const int given = (request->path ? 1 : 0) + (request->range || request->at ? 1 : 0);
    if (law->bridged && !request->input.model->terms.bridges) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "law %s: the scene has no bridges; accepted "
                            "contact.bridge_length below 1 d",
                            law->name);
    }
    if ((request->path && !law->path) || given > 1 || (!law->variable && given > 0)) {
        return gb_error_set(err, GB_ERR_INPUT, "law %s: accepted %s", law->name,
                            !law->variable ? "no --at, --range or --path"
                            : law->path    ? "--at, --range or --path alone"
                                           : "--at or --range");
    }
    return !law->variable || given > 0 || missing_variable(law, err);
}

static bool print_rows(struct request *request, struct gb_error *err)
{
    if (!request->law->variable) {
        if (!request->dry) {
            print_column(request);
            request->law->print(&request->input);
        }
        return true;
    }
    return request->path    ? print_path(request, err)
           : request->range ? print_range(request, err)
                            : print_points(request, err);
}

/* Checks or prints the rows of one scene. */
static bool scene_rows(struct request *request, const struct gb_params *params, bool dry,
                       struct gb_error *err)
{
    struct gb_model model;
    request->input.model = &model;
    request->input.h_min = NAN;
    request->dry = dry;
    return gb_params_check(params, err) && gb_model_init(&model, params, err) &&
           check_request(request, err) && print_rows(request, err);
}

/* The rows of every value of --vary group.key=A,B,..., one block after the other. */
static bool varied_rows(struct request *request, const struct gb_params *params,
                        const char *key, char **values, bool dry, struct gb_error *err)
{
    for (int i = 0; values[i]; i++) {
        struct gb_params scene = *params;
        char *assignment = g_strdup_printf("%s=%s", key, g_strstrip(values[i]));
        request->column = values[i];
        const bool good = gb_params_assign(&scene, assignment, err) &&
                          scene_rows(request, &scene, dry, err);
        g_free(assignment);
        if (!good) {
            return false;
        }
    }
    return true;
}

static bool print_varied(struct request *request, const struct gb_params *params,
                         struct gb_error *err)
{
    char **pair = g_strsplit(request->vary, "=", 2);
    char **values = g_strsplit(pair[0] && pair[1] ? pair[1] : "", ",", 64);
    bool good = values[0] && values[0][0];
    if (!good) {
        gb_error_set(err, GB_ERR_INPUT, "--vary %.80s: accepted group.key=A,B,...",
                     request->vary);
    }
    good = good && varied_rows(request, params, pair[0], values, true, err);
    if (good) {
        printf("%s,%s\n", pair[0], request->law->header);
        good = varied_rows(request, params, pair[0], values, false, err);
    }
    g_strfreev(values);
    g_strfreev(pair);
    return good;
}

static bool print_law(struct request *request, const struct gb_params *params,
                      struct gb_error *err)
{
    if (request->vary) {
        return print_varied(request, params, err);
    }
    if (!scene_rows(request, params, true, err)) {
        return false;
    }
    puts(request->law->header);
    return scene_rows(request, params, false, err);
}

static bool find_law(const char *name, const struct gb_lawtable_law **out,
                     struct gb_error *err)
{
    GString *names = g_string_new(NULL);
    *out = NULL;
    size_t count = 0;
    const struct gb_lawtable_law *laws = gb_lawtable_laws(&count);
    for (size_t i = 0; i < count; i++) {
        if (name && strcmp(laws[i].name, name) == 0) {
            *out = &laws[i];
        }
        g_string_append_printf(names, "%s%s", i > 0 ? ", " : "", laws[i].name);
    }
    if (!*out) {
        gb_error_set(err, GB_ERR_INPUT, "law %.40s: accepted %s",
                     name ? name : "without name", names->str);
    }
    g_string_free(names, TRUE);
    return *out != NULL;
}

static bool find_lattice(const char *name, struct request *request, struct gb_error *err)
{
    if ((strcmp(request->law->name, "lattice") == 0) != (name != NULL)) {
        return gb_error_set(err, GB_ERR_INPUT, "law %s: %s", request->law->name,
                            name ? "--lattice is for law lattice"
                                 : "needs --lattice sc, fcc, bcc or diamond");
    }
    size_t count = 0;
    const struct gb_lawtable_lattice *lattices = gb_lawtable_lattices(&count);
    for (size_t i = 0; name && i < count; i++) {
        if (strcmp(lattices[i].name, name) == 0) {
            request->input.lattice = &lattices[i];
        }
    }
    return !name || request->input.lattice ||
           gb_error_set(err, GB_ERR_INPUT,
                        "--lattice %.40s: accepted sc, fcc, bcc or diamond", name);
}

static bool run(struct request *request, const char *lattice, char **words, char **sets,
                struct gb_error *err)
{
    if (!find_law(words[0], &request->law, err) || !find_lattice(lattice, request, err)) {
        return false;
    }
    struct gb_preset *preset = NULL;
    if (!gb_options_scene(&preset, words + 1, sets, false, err)) {
        return false;
    }
    const bool good = print_law(request, gb_preset_params(preset), err);
    gb_preset_destroy(preset);
    return good;
}

static const struct gb_options_page page = {
    .usage = "NAME [PRESET] [group.key=value]...",
    .summary =
        "Values of a contact law as CSV, with 17 digits.  NAME is one of rod, bridge,\n"
        "dispersion, normal, shear, pivot, roll, equilibrium, bridge-strength, lattice.\n"
        "Reduced units: overlap h and distance r in particle diameters d, force in\n"
        "E d^2, stiffness in E d (E d^3 for pivot and roll), moments in E d^3.",
    .description =
        "rod          elastic force f_e of two spheres, P1 (1)\n"
        "dispersion   attraction f_a at distance r, P1 (3)\n"
        "normal       f_e - f_a without a bridge; h below 0 is a gap\n"
        "bridge       f_e - f_a of a bridged contact; h_min is its deepest overlap\n"
        "             (--at h_min=0.02,h=0.012), by default h + bridge_length\n"
        "shear, pivot stiffness per half of the relative motion, and cap, no bridge\n"
        "roll         the same for a bridge whose deepest overlap is h\n"
        "equilibrium  overlap where f_e = f_a, and the greatest attraction\n"
        "bridge-strength  normal stress that breaks a bridge at overlap h\n"
        "lattice      density and pressure of a perfect lattice, nearest neighbours\n"
        "\n"
        "--path visits overlaps one after the other in fine steps and keeps the history\n"
        "of one contact: bridges form and break on the way (normal and bridge).\n"
        "\n"
        "Figure 1 of P1 (contact of 16 nm particles: A-B-C-D, then to C' and open):\n"
        "  greenbody law normal p1-set2-16nm --path=-0.02,0.0081,-0.01,0.02,-0.01\n"
        "Figure 2 of P1 (strength of bridges of three lengths):\n"
        "  greenbody law bridge-strength --range h=0:0.05:101 \\\n"
        "    --vary \"contact.bridge_length=0.005 d,0.01 d,0.015 d\"",
};

int gb_cmd_law(int argc, char **argv)
{
    struct request request = {0};
    char *lattice = NULL;
    char **sets = NULL, **words = NULL;
    const GOptionEntry entries[] = {
        {"at", 0, 0, G_OPTION_ARG_STRING_ARRAY, &request.at, "one point; may be repeated",
         "h=0.01"},
        {"range", 0, 0, G_OPTION_ARG_STRING, &request.range, "from, to, number of points",
         "h=0:0.1:101"},
        {"path", 0, 0, G_OPTION_ARG_STRING, &request.path, "overlaps to visit",
         "0,0.02,-0.01"},
        {"vary", 0, 0, G_OPTION_ARG_STRING, &request.vary,
         "values of a key, one after the other, in a first column", "group.key=A,B,..."},
        {"lattice", 0, 0, G_OPTION_ARG_STRING, &lattice, "sc, fcc, bcc or diamond",
         "NAME"},
        GB_OPTIONS_SET(&sets),
        {0},
    };
    int status = 0;
    if (gb_options_parse(&page, entries, argc, argv, &words, &status)) {
        struct gb_error err = {0};
        if (!run(&request, lattice, words, sets, &err)) {
            status = gb_options_fail(&err);
        }
    }
    g_strfreev(request.at);
    g_free(request.range);
    g_free(request.path);
    g_free(request.vary);
    g_free(lattice);
    g_strfreev(sets);
    g_strfreev(words);
    return status;
}
