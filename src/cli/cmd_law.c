#include <stdio.h>
#include <string.h>

#include <glib.h>

#include "base/listing.h"
#include "base/number.h"
#include "base/visible.h"
#include "cli/commands.h"
#include "cli/options.h"
#include "io/material.h"
#include "study/law_table.h"

/* The options of the command line. */
struct request {
    struct gb_law_table_request rows;
    char *vary;
};

enum { VALUES_MAX = 64 };

/* The table and the value of the varied key, or NULL. */
struct filling {
    struct gb_listing *listing;
    const char *varied;
};

static bool add_row(const double *value, int columns, void *data, struct gb_error *err)
{
    const struct filling *filling = data;
    (void)err;
    if (filling->varied != NULL) {
        gb_listing_text(filling->listing, filling->varied);
    }
    for (int k = 0; k < columns; k++) { /* an infinite time step is not a missing value */
        char number[GB_NUMBER_MAX];
        g_snprintf(number, sizeof number, "%.17g", value[k]);
        gb_listing_text(filling->listing, number);
    }
    return true;
}

/* The scenes of --vary group.key=A,B,..., in order. */
struct variation {
    char **pair;   /* key, values */
    char **values; /* NULL-terminated */
};

static bool parse_variation(struct variation *variation, const char *text,
                            struct gb_error *err)
{
    variation->pair = g_strsplit(text, "=", 2);
    const char *values = variation->pair[0] ? variation->pair[1] : NULL;
    variation->values = g_strsplit(values ? values : "", ",", VALUES_MAX);
    for (int i = 0; variation->values[i] != NULL; i++) {
        g_strstrip(variation->values[i]);
    }
    return (variation->values[0] && variation->values[0][0]) ||
           gb_error_set(err, GB_ERR_INPUT, "--vary %.80s: expected group.key=A,B,...",
                        text);
}

static bool set_varied(struct gb_params *scene, const struct variation *variation, int i,
                       struct gb_error *err)
{
    char *assignment = g_strdup_printf("%s=%s", variation->pair[0], variation->values[i]);
    const bool good = gb_material_assign(scene, assignment, err);
    g_free(assignment);
    return good;
}

/* Fills the table.  Checks all scenes before the first row. */
static bool fill_scenes(struct gb_listing *listing, const struct request *request,
                        const struct gb_params *params, const struct variation *variation,
                        struct gb_error *err)
{
    for (int i = 0; variation->values[i] != NULL; i++) {
        struct gb_params scene = *params;
        if (!set_varied(&scene, variation, i, err) ||
            !gb_law_table_check(&request->rows, &scene, err)) {
            return false;
        }
    }
    gb_listing_columns(listing, "%s", variation->pair[0]);
    gb_listing_columns(listing, "%.17g", request->rows.law->header);
    for (int i = 0; variation->values[i] != NULL; i++) {
        struct gb_params scene = *params;
        struct filling filling = {listing, variation->values[i]};
        if (!set_varied(&scene, variation, i, err) ||
            !gb_law_table_compute(&request->rows, &scene, add_row, &filling, err)) {
            return false;
        }
    }
    return true;
}

static bool fill_varied(struct gb_listing *listing, const struct request *request,
                        const struct gb_params *params, struct gb_error *err)
{
    struct variation variation;
    const bool good = parse_variation(&variation, request->vary, err) &&
                      fill_scenes(listing, request, params, &variation, err);
    g_strfreev(variation.values);
    g_strfreev(variation.pair);
    return good;
}

static bool fill(struct gb_listing *listing, const struct request *request,
                 const struct gb_params *params, struct gb_error *err)
{
    if (request->vary) {
        return fill_varied(listing, request, params, err);
    }
    if (!gb_law_table_check(&request->rows, params, err)) {
        return false;
    }
    struct filling filling = {listing, NULL};
    gb_listing_columns(listing, "%.17g", request->rows.law->header);
    return gb_law_table_compute(&request->rows, params, add_row, &filling, err);
}

static bool find_law(const char *name, const struct gb_law_table_law **out,
                     struct gb_error *err)
{
    size_t count = 0;
    const struct gb_law_table_law *laws = gb_law_table_laws(&count);
    *out = name != NULL ? gb_law_table_find(name) : NULL;
    if (*out != NULL) {
        return true;
    }
    GString *names = g_string_new(NULL);
    for (size_t i = 0; i < count; i++) {
        g_string_append_printf(names, "%s%s", i > 0 ? ", " : "", laws[i].name);
    }
    gb_error_set(err, GB_ERR_INPUT, "law %.40s: expected %s",
                 name ? name : "without name", names->str);
    g_string_free(names, TRUE);
    return false;
}

static bool find_lattice(const char *name, struct request *request, struct gb_error *err)
{
    const char *law = request->rows.law->name;
    if ((strcmp(law, "lattice") == 0) != (name != NULL)) {
        return gb_error_set(err, GB_ERR_INPUT, "law %s: %s", law,
                            name ? "--lattice is for law lattice"
                                 : "needs --lattice sc, fcc, bcc or diamond");
    }
    request->rows.lattice = name != NULL ? gb_law_table_find_lattice(name) : NULL;
    return name == NULL || request->rows.lattice != NULL ||
           gb_error_set(err, GB_ERR_INPUT,
                        "--lattice %.40s: expected sc, fcc, bcc or diamond", name);
}

static bool run(struct request *request, const char *lattice, char **words, char **sets,
                struct gb_error *err)
{
    if (!find_law(words[0], &request->rows.law, err) ||
        !find_lattice(lattice, request, err)) {
        return false;
    }
    struct gb_preset *preset = NULL;
    if (!gb_options_preset(&preset, words + 1, sets, GB_OPTIONS_PRESET_OPTIONAL, err)) {
        return false;
    }
    struct gb_listing *listing = gb_listing_new();
    const bool good = fill(listing, request, gb_preset_params(preset), err) &&
                      gb_options_print(gb_listing_print(listing, GB_LISTING_CSV), err);
    gb_listing_free(listing);
    gb_preset_destroy(preset);
    return good;
}

static const char summary[] =
    "Values of a contact law as CSV, with 17 digits.\n"
    "Laws of P1, for particles of one size, are in reduced units: overlap h and\n"
    "distance r in particle diameters d, force in E d^2, stiffness in E d (E d^3 for\n"
    "pivot and roll), moments in E d^3.  Laws of P3, for two bodies of any size and\n"
    "material, are in SI units.";

static const char examples[] =
    "The two bodies are contact.radius_i and radius_j ('wall': flat and fixed) of\n"
    "material.young, poisson, yield, hardening, with young_j ... where the second\n"
    "differs.  Their overlap is given as h_m=2e-8 in metres, as a length (h=20nm), or\n"
    "over the diameter of the smaller body (h/2R=0.001, or h=0.001).\n\n"
    "--path visits overlaps in fine steps with the history of one contact: bridges\n"
    "form and break (normal and bridge); storakers unloads elastically below the\n"
    "deepest overlap, which is reset where the contact opens:\n"
    "  greenbody law storakers p3-pair --path 0,200nm,150nm,250nm,0\n\n"
    "Figure 1 of P1 (contact of 16 nm particles: A-B-C-D, then to C' and open):\n"
    "  greenbody law normal p1-set2-16nm --path=-0.02,0.0081,-0.01,0.02,-0.01\n"
    "Figure 2 of P1 (strength of bridges of three lengths):\n"
    "  greenbody law bridge-strength --range h=0:0.05:101 \\\n"
    "    --vary \"contact.bridge_length=0.005 d,0.01 d,0.015 d\"\n"
    "Figure 10 of P3 (two spheres of 10 um; the hertz column is the same in all):\n"
    "  greenbody law models p3-pair --range h_m=0:200nm:101 \\\n"
    "    --vary material.hardening=0,0.05,0.1,0.2\n"
    "Figure 11 of P3 (a sphere of 2 um between two of 10 um; both contacts are equal,\n"
    "and h is the overlap of one: the outer two have come closer by 2 h):\n"
    "  greenbody law models p3-line --range h_m=0:600nm:101 \\\n"
    "    --vary material.hardening=0,0.05,0.1,0.2\n"
    "Figure 12 of P3 (critical time step, no damping):\n"
    "  greenbody law critical-step p3-pair --range h_m=0:200nm:101 \\\n"
    "    --vary material.hardening=0,0.05,0.1,0.2";

/* Appends the laws in reduced units, or the laws of a pair. */
static void append_laws(GString *text, bool pair)
{
    size_t count = 0;
    const struct gb_law_table_law *laws = gb_law_table_laws(&count);
    for (size_t i = 0; i < count; i++) {
        if (laws[i].pair != pair) {
            continue;
        }
        char **lines = g_strsplit(laws[i].doc, "\n", -1);
        for (int k = 0; lines[k] != NULL; k++) {
            g_string_append_printf(text, "%-17s%s\n", k == 0 ? laws[i].name : "",
                                   lines[k]);
        }
        g_strfreev(lines);
    }
    g_string_append_c(text, '\n');
}

static char *describe_laws(void)
{
    GString *text = g_string_new(NULL);
    append_laws(text, false);
    append_laws(text, true);
    g_string_append(text, examples);
    return g_string_free(text, FALSE);
}

int gb_cmd_law(int argc, char **argv)
{
    struct request request = {0};
    char *lattice = NULL;
    char **sets = NULL, **words = NULL;
    const GOptionEntry entries[] = {
        {"at", 0, 0, G_OPTION_ARG_STRING_ARRAY, &request.rows.at,
         "one point; may be repeated", "h=0.01"},
        {"range", 0, 0, G_OPTION_ARG_STRING, &request.rows.range,
         "from, to, number of points", "h=0:0.1:101"},
        {"path", 0, 0, G_OPTION_ARG_STRING, &request.rows.path, "overlaps to visit",
         "0,0.02,-0.01"},
        {"vary", 0, 0, G_OPTION_ARG_STRING, &request.vary,
         "values of a key, one after the other, in a first column", "group.key=A,B,..."},
        {"lattice", 0, 0, G_OPTION_ARG_STRING, &lattice, "sc, fcc, bcc or diamond",
         "NAME"},
        gb_options_set(&sets),
        {0},
    };
    char *description = describe_laws();
    const struct gb_options_page page = {
        .usage = "NAME [PRESET] [group.key=value]...",
        .summary = summary,
        .description = description,
    };
    int status = 0;
    if (gb_options_parse(&page, entries, argc, argv, &words, &status)) {
        struct gb_error err = {0};
        if (!run(&request, lattice, words, sets, &err)) {
            status = gb_options_fail(&err);
        }
    }
    g_strfreev(request.rows.at);
    g_free(request.rows.range);
    g_free(request.rows.path);
    g_free(request.vary);
    g_free(lattice);
    g_free(description);
    g_strfreev(sets);
    g_strfreev(words);
    return status;
}
