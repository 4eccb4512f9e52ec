#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include <glib.h>
#include <json-glib/json-glib.h>

#include "base/alloc.h"
#include "cli/commands.h"
#include "cli/options.h"
#include "measure/structure.h"
#include "pack/cell.h"
#include "run/experiment.h"
#include "run/preset.h"
#include "run/rundir.h"
#include "run/state.h"

/* g(r) is taken in bins of about this width, d: it shows the peak of touching particles
 * and the edges at sqrt(3) and 2 apart. */
static const double bin_width = 0.05;

/* Beyond this distance (d) g(r) costs more than the packing itself and is 1. */
static const double farthest = 12.0;

/* Without adhesion touching particles are at r = d but for rounding. */
static const double touch = 1e-9;

struct pack {
    char *directory;
    bool force;
    struct gb_preset *preset;
    struct gb_model model;
    struct gb_rundir dir;
    struct gb_state *state;
    struct gb_connectivity connectivity;
    double reach; /* of a contact, d */
    double r_max; /* of g, d */
    int bins;
    double *g;
    double g_end; /* over the last diameter before r_max */
};

static const struct gb_params *params_of(const struct pack *pack)
{
    return gb_preset_params(pack->preset);
}

/* Everything that can be known to be wrong before the packing is grown. */
static bool prepare(struct pack *pack, char **words, char **sets, struct gb_error *err)
{
    if (pack->directory == NULL) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "pack needs --out DIR, a directory for the packing");
    }
    return gb_options_scene(&pack->preset, words, sets, true, err) &&
           gb_model_init(&pack->model, params_of(pack), err) &&
           gb_rundir_check(pack->directory, pack->force, err);
}

/* The packing exactly as `run` would start from it. */
static bool grow(struct pack *pack, struct gb_error *err)
{
    struct gb_experiment *experiment = NULL;
    const bool grown =
        gb_experiment_create(&experiment, params_of(pack), NULL, NULL, err) &&
        gb_experiment_state(experiment, &pack->state, err);
    gb_experiment_destroy(experiment);
    return grown;
}

/* Mean of g over the last diameter, each bin by its volume. */
static double mean_at_end(const struct pack *pack)
{
    const double power = pack->state->dimension - 1;
    double sum = 0.0;
    double weight = 0.0;
    for (int k = 0; k < pack->bins; k++) {
        const double r = (k + 0.5) * pack->r_max / pack->bins;
        if (r > pack->r_max - 1.0) {
            sum += pack->g[k] * pow(r, power);
            weight += pow(r, power);
        }
    }
    return sum / weight;
}

static bool measure(struct pack *pack, struct gb_error *err)
{
    const struct gb_state *state = pack->state;
    struct gb_cell cell;
    gb_cell_init(&cell, state->dimension, state->cell);
    pack->reach = pack->model.h_eq > 0.0 ? 1.0 : 1.0 + touch;
    pack->r_max = fmin(0.5 * gb_cell_shortest(&cell), farthest);
    pack->bins = (int)ceil(pack->r_max / bin_width);
    pack->g = gb_alloc_array((size_t)pack->bins, sizeof *pack->g, err);
    if (pack->g == NULL ||
        !gb_structure_rdf(&cell, state->count, state->position, pack->r_max, pack->bins,
                          pack->g, err) ||
        !gb_structure_connectivity(&cell, state->count, state->position, pack->reach,
                                   &pack->connectivity, err)) {
        return false;
    }
    pack->g_end = mean_at_end(pack);
    return true;
}

static void append_number(GString *text, double value, char end)
{
    char digits[G_ASCII_DTOSTR_BUF_SIZE];
    g_string_append(text, g_ascii_dtostr(digits, sizeof digits, value));
    g_string_append_c(text, end);
}

static void append_title(GString *text, const char *title)
{
    g_string_append(text, "# greenbody " GB_VERSION "\n# preset: ");
    for (const char *c = title; *c != '\0'; c++) {
        g_string_append_c(text, g_ascii_iscntrl(*c) ? '?' : *c);
    }
    g_string_append_c(text, '\n');
}

static GString *packing_text(const struct pack *pack)
{
    const struct gb_state *state = pack->state;
    GString *text = g_string_new(NULL);
    append_title(text, state->preset);
    g_string_append_printf(text, "# seed: %" PRIu64 "\n# diameter d, m: ", state->seed);
    append_number(text, state->metre_per_length, '\n');
    g_string_append(text, "# periodic cell, d: ");
    append_number(text, state->cell[0], ' ');
    append_number(text, state->cell[1], ' ');
    append_number(text, state->cell[2], '\n');
    g_string_append(text, "x_d,y_d,z_d\n");
    for (int64_t i = 0; i < state->count; i++) {
        append_number(text, state->position[3 * i], ',');
        append_number(text, state->position[3 * i + 1], ',');
        append_number(text, state->position[3 * i + 2], '\n');
    }
    return text;
}

static GString *g_text(const struct pack *pack)
{
    GString *text = g_string_new(NULL);
    append_title(text, pack->state->preset);
    g_string_append(text, "# radial distribution function; r_d is the middle of a bin\n");
    g_string_append(text, "r_d,g\n");
    for (int k = 0; k < pack->bins; k++) {
        append_number(text, (k + 0.5) * pack->r_max / pack->bins, ',');
        append_number(text, pack->g[k], '\n');
    }
    return text;
}

static void add_number(JsonBuilder *builder, const char *name, double value)
{
    json_builder_set_member_name(builder, name);
    json_builder_add_double_value(builder, value);
}

static void add_integer(JsonBuilder *builder, const char *name, int64_t value)
{
    json_builder_set_member_name(builder, name);
    json_builder_add_int_value(builder, value);
}

static void add_connectivity(JsonBuilder *builder, const struct gb_connectivity *found)
{
    add_number(builder, "coordination", found->coordination);
    json_builder_set_member_name(builder, "histogram");
    json_builder_begin_array(builder);
    for (size_t k = 0; k < G_N_ELEMENTS(found->histogram); k++) {
        json_builder_add_int_value(builder, found->histogram[k]);
    }
    json_builder_end_array(builder);
    add_integer(builder, "clusters", found->clusters);
    add_integer(builder, "largest_cluster", found->largest);
    json_builder_set_member_name(builder, "percolates_xyz");
    json_builder_begin_array(builder);
    for (int k = 0; k < 3; k++) {
        json_builder_add_boolean_value(builder, found->percolates[k]);
    }
    json_builder_end_array(builder);
}

static GString *structure_text(const struct pack *pack)
{
    const struct gb_state *state = pack->state;
    JsonBuilder *builder = json_builder_new();
    json_builder_begin_object(builder);
    json_builder_set_member_name(builder, "preset");
    json_builder_add_string_value(builder, state->preset);
    /* JSON numbers are doubles to most readers; a seed has 64 bits */
    char seed[32];
    snprintf(seed, sizeof seed, "%" PRIu64, state->seed);
    json_builder_set_member_name(builder, "seed");
    json_builder_add_string_value(builder, seed);
    add_integer(builder, "dimension", state->dimension);
    add_integer(builder, "particles", state->count);
    /* nm, to 1e-6 nm: json-glib writes 1e-08 as "1e-08.0", which no reader takes */
    add_number(builder, "diameter_nm", rint(state->metre_per_length * 1e15) / 1e6);
    add_number(builder, "density", state->point.density);
    add_number(builder, "touching_distance_d", 1.0 - pack->model.h_eq);
    add_number(builder, "contact_reach_d", pack->reach);
    add_connectivity(builder, &pack->connectivity);
    add_number(builder, "g_end", pack->g_end);
    add_number(builder, "g_end_from_d", fmax(0.0, pack->r_max - 1.0));
    add_number(builder, "g_end_to_d", pack->r_max);
    json_builder_end_object(builder);
    JsonNode *root = json_builder_get_root(builder);
    char *json = json_to_string(root, TRUE);
    GString *text = g_string_new(json);
    g_string_append_c(text, '\n');
    g_free(json);
    json_node_unref(root);
    g_object_unref(builder);
    return text;
}

/* Writes one file atomically and durably; takes text. */
static bool write_file(const struct pack *pack, const char *name, GString *text,
                       struct gb_error *err)
{
    char *path = g_build_filename(pack->directory, name, NULL);
    GError *failure = NULL;
    const bool written = g_file_set_contents_full(
        path, text->str, (gssize)text->len,
        G_FILE_SET_CONTENTS_CONSISTENT | G_FILE_SET_CONTENTS_DURABLE, 0666, &failure);
    if (!written) {
        gb_error_set(err, GB_ERR_MACHINE, "%s: cannot be written: %s", path,
                     failure->message);
        g_error_free(failure);
    }
    g_string_free(text, TRUE);
    g_free(path);
    return written;
}

/* A complete preset written without a file before it names the program's version. */
static bool write_preset(const struct pack *pack, struct gb_error *err)
{
    struct gb_preset *preset = NULL;
    if (!gb_preset_create(&preset, err)) {
        return false;
    }
    *gb_preset_params(preset) = *params_of(pack);
    char *path = g_build_filename(pack->directory, "preset.ini", NULL);
    const bool written = gb_preset_save(preset, path, true, err);
    g_free(path);
    gb_preset_destroy(preset);
    return written;
}

static bool write_all(struct pack *pack, struct gb_error *err)
{
    if (!gb_rundir_make(&pack->dir, pack->directory, pack->force, err)) {
        return false;
    }
    char *state = g_build_filename(pack->directory, "state.h5", NULL);
    const bool written = write_preset(pack, err) &&
                         write_file(pack, "packing.csv", packing_text(pack), err) &&
                         write_file(pack, "g.csv", g_text(pack), err) &&
                         write_file(pack, "structure.json", structure_text(pack), err) &&
                         gb_state_write(pack->state, state, err);
    g_free(state);
    if (written) {
        gb_rundir_finish(&pack->dir);
    } else {
        gb_rundir_unmake(&pack->dir);
    }
    return written;
}

static void print_contacts(const struct gb_connectivity *found, int64_t count)
{
    enum { BINS = sizeof found->histogram / sizeof found->histogram[0] };
    printf("coordination   %.6g\n", found->coordination);
    for (int k = 0; k < BINS; k++) {
        if (found->histogram[k] > 0) {
            printf("  %2d%s contacts %8" PRId64 "  %6.2f %%\n", k,
                   k == BINS - 1 ? "+" : " ", found->histogram[k],
                   100.0 * (double)found->histogram[k] / (double)count);
        }
    }
}

static void print_summary(const struct pack *pack)
{
    const struct gb_state *state = pack->state;
    const struct gb_connectivity *found = &pack->connectivity;
    const bool planar = state->dimension == 2;
    const char *const axes[] = {"x ", "y ", "z "};
    printf("particles      %" PRId64 ", seed %" PRIu64 "\n", state->count, state->seed);
    if (planar) {
        printf("cell           %.5g x %.5g d\n", state->cell[0], state->cell[2]);
    } else {
        printf("cell           %.5g x %.5g x %.5g d\n", state->cell[0], state->cell[1],
               state->cell[2]);
    }
    printf("density        %.6g\n", state->point.density);
    print_contacts(found, state->count);
    printf("clusters       %" PRId64 ", the largest of %" PRId64 " particles\n",
           found->clusters, found->largest);
    printf("spans along    ");
    bool any = false;
    for (int k = 0; k < 3; k++) {
        fputs(found->percolates[k] ? axes[k] : "", stdout);
        any = any || found->percolates[k];
    }
    puts(any ? "" : "no axis");
    printf("mean g(r)      %.5g for r = %.4g to %.4g d\n", pack->g_end,
           fmax(0.0, pack->r_max - 1.0), pack->r_max);
    printf("written to     %s\n", pack->directory);
}

int gb_cmd_pack(int argc, char **argv)
{
    static const struct gb_options_page page = {
        "PRESET [group.key=value]...",
        "The initial structure alone: its particles (packing.csv), g(r) (g.csv), "
        "contacts\n"
        "and clusters (structure.json), and state.h5 for greenbody snapshot.",
        NULL};
    struct pack pack = {0};
    struct gb_error err = {0};
    char **sets = NULL;
    char **words = NULL;
    gboolean force = FALSE;
    int status = 0;
    const GOptionEntry entries[] = {GB_OPTIONS_SET(&sets),
                                    {"out", 'o', 0, G_OPTION_ARG_FILENAME,
                                     &pack.directory, "directory of the packing", "DIR"},
                                    {"force", 'f', 0, G_OPTION_ARG_NONE, &force,
                                     "replace what an earlier command left in DIR", NULL},
                                    {0}};
    if (gb_options_parse(&page, entries, argc, argv, &words, &status)) {
        pack.force = force;
        if (prepare(&pack, words, sets, &err) && grow(&pack, &err) &&
            measure(&pack, &err) && write_all(&pack, &err)) {
            print_summary(&pack);
        } else {
            status = gb_options_fail(&err);
        }
    }
    gb_alloc_free(pack.g);
    gb_state_destroy(pack.state);
    gb_preset_destroy(pack.preset);
    g_free(pack.directory);
    g_strfreev(words);
    g_strfreev(sets);
    return status;
}
