#include "figures/report/packing.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>

#include <glib.h>
#include <json-glib/json-glib.h>

#include "base/file.h"
#include "base/listing.h"
#include "io/preset.h"
#include "io/status_json.h"

static void append_number(GString *text, double value, char end)
{
    char digits[G_ASCII_DTOSTR_BUF_SIZE];
    g_string_append(text, g_ascii_dtostr(digits, sizeof digits, value));
    g_string_append_c(text, end);
}

/* Comment lines: the version and the preset. */
static GString *head_of(const char *title)
{
    GString *text = g_string_new("greenbody " GB_VERSION "\npreset: ");
    for (const char *c = title; *c != '\0'; c++) {
        g_string_append_c(text, g_ascii_iscntrl(*c) ? '?' : *c);
    }
    g_string_append_c(text, '\n');
    return text;
}

static bool is_bed(const struct gb_packing *packing)
{
    return packing->state->die_radius > 0.0;
}

static struct gb_listing *packing_listing(const struct gb_packing *packing)
{
    const struct gb_state *state = packing->state;
    GString *text = head_of(state->preset);
    g_string_append_printf(text, "seed: %" PRIu64 "\ndiameter d, m: ", state->seed);
    append_number(text, state->metre_per_length, '\n');
    g_string_append(text, is_bed(packing) ? "box of the die, d: " : "periodic cell, d: ");
    append_number(text, state->cell[0], ' ');
    append_number(text, state->cell[1], ' ');
    append_number(text, state->cell[2], '\n');
    if (state->tilt[0] != 0.0 || state->tilt[1] != 0.0 || state->tilt[2] != 0.0) {
        g_string_append(text, "tilts xy xz yz, d: ");
        append_number(text, state->tilt[0], ' ');
        append_number(text, state->tilt[1], ' ');
        append_number(text, state->tilt[2], '\n');
    }
    struct gb_listing *listing = gb_listing_new();
    gb_listing_comment(listing, text->str);
    g_string_free(text, TRUE);
    gb_listing_columns(listing, "%.17g",
                       is_bed(packing) ? "x_d,y_d,z_d,radius_d" : "x_d,y_d,z_d");
    for (int64_t i = 0; i < state->count; i++) {
        gb_listing_numbers(listing, &state->position[3 * i], 3);
        if (is_bed(packing)) {
            gb_listing_number(listing, state->radius[i]);
        }
    }
    return listing;
}

static struct gb_listing *g_listing(const struct gb_packing *packing)
{
    GString *text = head_of(packing->state->preset);
    struct gb_listing *listing = gb_listing_new();
    gb_listing_comment(listing, text->str);
    gb_listing_comment(listing,
                       "radial distribution function; r_d is the middle of a bin");
    gb_listing_columns(listing, "%.17g", "r_d,g");
    for (int k = 0; k < packing->bins; k++) {
        gb_listing_number(listing, (k + 0.5) * packing->r_max / packing->bins);
        gb_listing_number(listing, packing->g[k]);
    }
    g_string_free(text, TRUE);
    return listing;
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

static GString *structure_text(const struct gb_packing *packing)
{
    const struct gb_state *state = packing->state;
    JsonBuilder *builder = json_builder_new();
    json_builder_begin_object(builder);
    json_builder_set_member_name(builder, "preset");
    json_builder_add_string_value(builder, state->preset);
    /* most readers take JSON numbers as doubles; a seed has 64 bits */
    char seed[32];
    snprintf(seed, sizeof seed, "%" PRIu64, state->seed);
    json_builder_set_member_name(builder, "seed");
    json_builder_add_string_value(builder, seed);
    add_integer(builder, "dimension", state->dimension);
    add_integer(builder, "particles", state->count);
    /* nm, rounded to 1e-6 nm */
    add_number(builder, "diameter_nm", rint(state->metre_per_length * 1e15) / 1e6);
    add_number(builder, "density", state->point.density);
    add_number(builder, "touching_distance_d", packing->r_eq);
    add_number(builder, "contact_reach_d", packing->reach);
    add_connectivity(builder, &packing->connectivity);
    add_number(builder, "g_end", packing->g_end);
    add_number(builder, "g_end_from_d", fmax(0.0, packing->r_max - 1.0));
    add_number(builder, "g_end_to_d", packing->r_max);
    json_builder_end_object(builder);
    JsonNode *root = json_builder_get_root(builder);
    char *json = gb_status_json_print(root);
    GString *text = g_string_new(json);
    g_string_append_c(text, '\n');
    g_free(json);
    json_node_unref(root);
    g_object_unref(builder);
    return text;
}

/* Writes one file atomically and durably; takes text. */
static bool write_file(const char *directory, const char *name, GString *text,
                       struct gb_error *err)
{
    char *path = g_build_filename(directory, name, NULL);
    const bool written = gb_file_replace(path, text->str, text->len, err);
    g_string_free(text, TRUE);
    g_free(path);
    return written;
}

/* A complete preset written without a file before it names the program's version. */
static bool write_preset(const struct gb_packing *packing, const char *directory,
                         struct gb_error *err)
{
    struct gb_preset *preset = NULL;
    if (!gb_preset_create(&preset, err)) {
        return false;
    }
    *gb_preset_params(preset) = packing->params;
    char *path = g_build_filename(directory, "preset.ini", NULL);
    const bool written = gb_preset_save(preset, path, GB_PRESET_ALL_KEYS, err);
    g_free(path);
    gb_preset_destroy(preset);
    return written;
}

bool gb_packing_write(const struct gb_packing *packing, const char *directory,
                      struct gb_error *err)
{
    char *state = g_build_filename(directory, "state.h5", NULL);
    const bool written =
        write_preset(packing, directory, err) &&
        gb_listing_store(packing_listing(packing), directory, "packing.csv", err) &&
        (is_bed(packing) ||
         (gb_listing_store(g_listing(packing), directory, "g.csv", err) &&
          write_file(directory, "structure.json", structure_text(packing), err))) &&
        gb_state_write(packing->state, NULL, state, err);
    g_free(state);
    return written;
}
