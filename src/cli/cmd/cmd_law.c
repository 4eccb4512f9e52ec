#include <stdio.h>
#include <string.h>

#include <glib.h>

#include "cli/commands.h"
#include "cli/options.h"
#include "study/law/law_rows.h"

/* The options of the command line. */
struct request {
    struct gb_law_rows_request rows;
    char *vary;
};

enum { VALUES_MAX = 64 };

/* Prints a row; data is the value of the varied key, or NULL. */
static bool print_row(const double *value, int columns, void *data, struct gb_error *err)
{
    if (data != NULL) {
        printf("%s,", (const char *)data);
    }
    for (int k = 0; k < columns; k++) {
        printf("%.17g%c", value[k], k + 1 < columns ? ',' : '\n');
    }
    return !ferror(stdout) || gb_options_output_failed(err);
}

/* The scenes of --vary group.key=A,B,..., one after the other. */
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
           gb_error_set(err, GB_ERR_INPUT, "--vary %.80s: accepted group.key=A,B,...",
                        text);
}

static bool set_varied(struct gb_params *scene, const struct variation *variation, int i,
                       struct gb_error *err)
{
    char *assignment = g_strdup_printf("%s=%s", variation->pair[0], variation->values[i]);
    const bool good = gb_params_assign(scene, assignment, err);
    g_free(assignment);
    return good;
}

/* All scenes are checked before the first row is printed. */
static bool print_scenes(const struct request *request, const struct gb_params *params,
                         const struct variation *variation, struct gb_error *err)
{
    for (int i = 0; variation->values[i] != NULL; i++) {
        struct gb_params scene = *params;
        if (!set_varied(&scene, variation, i, err) ||
            !gb_law_rows_check(&request->rows, &scene, err)) {
            return false;
        }
    }
    printf("%s,%s\n", variation->pair[0], request->rows.law->header);
    for (int i = 0; variation->values[i] != NULL; i++) {
        struct gb_params scene = *params;
        if (!set_varied(&scene, variation, i, err) ||
            !gb_law_rows_compute(&request->rows, &scene, print_row, variation->values[i],
                                 err)) {
            return false;
        }
    }
    return true;
}

static bool print_varied(const struct request *request, const struct gb_params *params,
                         struct gb_error *err)
{
    struct variation variation;
    const bool good = parse_variation(&variation, request->vary, err) &&
                      print_scenes(request, params, &variation, err);
    g_strfreev(variation.values);
    g_strfreev(variation.pair);
    return good;
}

static bool print_law(const struct request *request, const struct gb_params *params,
                      struct gb_error *err)
{
    if (request->vary) {
        return print_varied(request, params, err);
    }
    if (!gb_law_rows_check(&request->rows, params, err)) {
        return false;
    }
    puts(request->rows.law->header);
    return gb_law_rows_compute(&request->rows, params, print_row, NULL, err);
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
    gb_error_set(err, GB_ERR_INPUT, "law %.40s: accepted %s",
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
                        "--lattice %.40s: accepted sc, fcc, bcc or diamond", name);
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
    const bool good = print_law(request, gb_preset_params(preset), err);
    gb_preset_destroy(preset);
    return good;
}

static const struct gb_options_page page = {
    .usage = "NAME [PRESET] [group.key=value]...",
    .summary =
        "Values of a contact law as CSV, with 17 digits.\n"
        "Laws of P1, for particles of one size: rod, bridge, dispersion, normal, shear,\n"
        "pivot, roll, equilibrium, bridge-strength, lattice.  Reduced units: overlap h\n"
        "and distance r in particle diameters d, force in E d^2, stiffness in E d (E "
        "d^3\n"
        "for pivot and roll), moments in E d^3.\n"
        "Laws of P3, for two bodies of any size and material: hertz, storakers, "
        "mindlin,\n"
        "models, critical-step, yield.  SI units.",
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
        "hertz        elastic force and stiffness, P3 (2), (9)\n"
        "storakers    plastic loading, the lesser of Hertz and P3 (16); as printed, "
        "(16)\n"
        "             alone, with contact.storakers=printed\n"
        "mindlin      k_t of Hertz' contact, P3 (12), and its cap mu F\n"
        "models       the force by hertz, storakers and as printed, side by side\n"
        "critical-step  the critical time step of the two by each, P3 (27)-(29)\n"
        "yield        overlap and force at which the weaker body starts to flow, P3 "
        "(30)\n"
        "\n"
        "The two bodies are contact.radius_i and radius_j ('wall': flat and fixed) of\n"
        "material.young, poisson, yield, hardening, with young_j ... where the second\n"
        "differs.  Their overlap is given as h_m=2e-8 in metres, as a length (h=20nm), "
        "or\n"
        "over the diameter of the smaller body (h/2R=0.001, or h=0.001).\n"
        "\n"
        "--path visits overlaps in fine steps with the history of one contact: bridges\n"
        "form and break (normal and bridge); storakers unloads elastically below the\n"
        "deepest overlap, which is reset where the contact opens:\n"
        "  greenbody law storakers p3-pair --path 0,200nm,150nm,250nm,0\n"
        "\n"
        "Figure 1 of P1 (contact of 16 nm particles: A-B-C-D, then to C' and open):\n"
        "  greenbody law normal p1-set2-16nm --path=-0.02,0.0081,-0.01,0.02,-0.01\n"
        "Figure 2 of P1 (strength of bridges of three lengths):\n"
        "  greenbody law bridge-strength --range h=0:0.05:101 \\\n"
        "    --vary \"contact.bridge_length=0.005 d,0.01 d,0.015 d\"\n"
        "Figure 10 of P3 (two spheres of 10 um; the hertz column is the same in all):\n"
        "  greenbody law models p3-pair --range h_m=0:200nm:101 \\\n"
        "    --vary material.hardening=0,0.05,0.1,0.2\n"
        "Figure 11 of P3 (a sphere of 2 um between two of 10 um; both contacts are "
        "equal,\n"
        "and h is the overlap of one: the outer two have come closer by 2 h):\n"
        "  greenbody law models p3-line --range h_m=0:600nm:101 \\\n"
        "    --vary material.hardening=0,0.05,0.1,0.2\n"
        "Figure 12 of P3 (critical time step, no damping):\n"
        "  greenbody law critical-step p3-pair --range h_m=0:200nm:101 \\\n"
        "    --vary material.hardening=0,0.05,0.1,0.2",
};

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
    g_strfreev(sets);
    g_strfreev(words);
    return status;
}
