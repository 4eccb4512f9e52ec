/* Kept states: those of a run directory, and one of each run of a set; and the files of an
 * initial structure. */

#include "figures/states.h"

#include <glib.h>
#include <inttypes.h>
#include <json-glib/json-glib.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#include "base/alloc.h"
#include "base/file.h"
#include "base/listing.h"
#include "base/units.h"
#include "figures/figures.h"
#include "figures/series.h"
#include "greenbody/params.h"
#include "io/preset.h"
#include "io/state.h"
#include "io/status_json.h"
#include "measure/average.h"
#include "measure/structure.h"
#include "run/record/kept_states.h"

enum { BYTES_MAX = 1 << 24 };

static char *read_preset(const char *folder)
{
    char *text = NULL;
    size_t length = 0;
    char *file = g_build_filename(folder, "preset.ini", NULL);
    const bool good = gb_file_read(file, BYTES_MAX, &text, &length, NULL) &&
                      g_utf8_validate(text, -1, NULL);
    char *copy = good ? g_strdup(text) : NULL;
    gb_alloc_free(text);
    g_free(file);
    return copy;
}

char *gb_states_preset(const char *path)
{
    if (g_file_test(path, G_FILE_TEST_IS_DIR)) {
        return read_preset(path);
    }
    char *folder = g_path_get_dirname(path);
    char *parent = g_path_get_dirname(folder);
    char *text = read_preset(folder);
    if (text == NULL) {
        text = read_preset(parent);
    }
    g_free(parent);
    g_free(folder);
    return text;
}

bool gb_states_set_read(struct gb_states_set *states,
                        const struct gb_figures_input *input, struct gb_error *err)
{
    *states =
        (struct gb_states_set){.state = g_new0(struct gb_state *, input->set->count + 1)};
    for (size_t i = 0; i < input->set->count; i++) {
        if (!gb_states_read(&states->state[i], input->set->run[i].directory, input->at,
                            err)) {
            gb_states_set_finish(states);
            return false;
        }
        states->count++;
    }
    return true;
}

void gb_states_set_finish(struct gb_states_set *states)
{
    for (size_t i = 0; i < states->count; i++) {
        gb_state_destroy(states->state[i]);
    }
    g_free(states->state);
    *states = (struct gb_states_set){0};
}

void gb_states_set_means(struct gb_series *series, const struct gb_runset *set,
                         const double *rows, const double *x, const char *name)
{
    double *members = g_new(double, set->count * series->rows + 1);
    for (size_t g = 0; g < set->groups; g++) {
        size_t filled = 0;
        for (size_t i = 0; i < set->count; i++) {
            if (set->run[i].group == g) {
                memcpy(members + filled * series->rows, rows + i * series->rows,
                       series->rows * sizeof *members);
                filled++;
            }
        }
        double *mean = gb_series_column(series, "%s_%zu", name, g + 1);
        double *error = gb_series_column(series, "se_%zu", g + 1);
        char *label = gb_series_group_label(set, g, NULL);
        gb_average_rows(members, filled, series->rows, GB_AVERAGE_PRESENT, mean, error);
        gb_series_draw(series, x, mean, error, GB_FIGURE_LINE, (int)g, label);
        g_free(label);
    }
    g_free(members);
}

void gb_states_set_caption(struct gb_series *series, const struct gb_states_set *states)
{
    double low[2] = {INFINITY, INFINITY};
    double high[2] = {-INFINITY, -INFINITY};
    for (size_t i = 0; i < states->count; i++) {
        const struct gb_point *point = &states->state[i]->point;
        const double value[2] = {point->density, 1e-6 * point->p_pa};
        for (int k = 0; k < 2; k++) {
            low[k] = fmin(low[k], value[k]);
            high[k] = fmax(high[k], value[k]);
        }
    }
    gb_series_caption(series, "Relative density %.3g", low[0]);
    if (high[0] > low[0] * 1.002) {
        gb_series_caption(series, "to %.3g", high[0]);
    }
    if (isfinite(low[1]) && high[1] > 1.0) {
        gb_series_caption(series, "at %.4g", low[1]);
        if (high[1] > low[1] * 1.01) {
            gb_series_caption(series, "to %.4g", high[1]);
        }
        gb_series_caption(series, "MPa");
    }
    g_string_append_c(series->caption, '.');
}

/* Relative difference to the requested value beyond which a state does not match, unless it
 * was kept for this value: a loading step can skip over it. */
static const double tolerance = 0.05;

static bool parse_point(const char *text, struct gb_keep_point *point,
                        struct gb_error *err)
{
    char **sides = g_strsplit(text, "=", 2);
    bool good = sides[0] != NULL && sides[1] != NULL;
    if (good) {
        g_strstrip(sides[0]);
        g_strstrip(sides[1]);
        point->by_density = strcmp(sides[0], "density") == 0;
        good = (point->by_density || strcmp(sides[0], "p") == 0) &&
               gb_units_parse(sides[1], point->by_density ? GB_DIM_NONE : GB_DIM_PRESSURE,
                              &point->value, NULL) &&
               isfinite(point->value);
    }
    g_strfreev(sides);
    return good || gb_error_set(err, GB_ERR_INPUT,
                                "--at %.80s: expected a point as in \"p=100 MPa\" or "
                                "\"density=0.5\"",
                                text);
}

static double value_of(const struct gb_state *state, const struct gb_keep_point *point)
{
    return point->by_density ? state->point.density : state->point.p_pa;
}

/* Whether the name of the file is that of this point. */
static bool is_kept_for(const char *path, const struct gb_keep_point *point)
{
    char name[64];
    char *base = g_path_get_basename(path);
    gb_kept_states_name(point, name, sizeof name);
    const bool same =
        g_str_has_prefix(base, name) && strcmp(base + strlen(name), ".h5") == 0;
    g_free(base);
    return same;
}

static bool is_after_loading(const struct gb_point *point)
{
    return point->branch > 0 ||
           (point->branch < GB_BRANCH_HOLD && point->branch >= GB_BRANCH_LEAST);
}

/* Relative distance; states of unloading come after those of loading. */
static double distance(const struct gb_state *state, const struct gb_keep_point *point)
{
    const double relative =
        fabs(value_of(state, point) - point->value) / fmax(fabs(point->value), 1e-12);
    return isfinite(relative) ? relative + (is_after_loading(&state->point) ? 1e-6 : 0.0)
                              : INFINITY;
}

static void describe(GString *list, const struct gb_state *state,
                     const struct gb_keep_point *point)
{
    char value[48];
    if (point->by_density) {
        g_snprintf(value, sizeof value, "%.4g", state->point.density);
    } else {
        gb_units_format_short(state->point.p_pa, GB_DIM_PRESSURE, 4, value, sizeof value);
    }
    g_string_append_printf(list, "%s%s", list->len > 0 ? ", " : "", value);
}

static int by_name(const void *a, const void *b)
{
    return strcmp(*(char *const *)a, *(char *const *)b);
}

/* Paths of all states of a directory: state.h5, then the others by name. */
static GPtrArray *list_paths(const char *source)
{
    GPtrArray *paths = g_ptr_array_new_with_free_func(g_free);
    if (!g_file_test(source, G_FILE_TEST_IS_DIR)) {
        g_ptr_array_add(paths, g_strdup(source));
        return paths;
    }
    char *folder = g_build_filename(source, "snapshots", NULL);
    GDir *dir = g_dir_open(folder, 0, NULL);
    for (const char *name = dir ? g_dir_read_name(dir) : NULL; name != NULL;
         name = g_dir_read_name(dir)) {
        if (g_str_has_suffix(name, ".h5")) {
            g_ptr_array_add(paths, g_build_filename(folder, name, NULL));
        }
    }
    if (dir != NULL) {
        g_dir_close(dir);
    }
    g_free(folder);
    g_ptr_array_sort(paths, by_name);
    g_ptr_array_insert(paths, 0, g_build_filename(source, "state.h5", NULL));
    return paths;
}

/* which: index of the path. */
static bool read_nearest(struct gb_state **out, const GPtrArray *paths,
                         const struct gb_keep_point *point, GString *list, guint *which,
                         struct gb_error *err)
{
    double best = INFINITY;
    for (guint k = 0; k < paths->len; k++) {
        struct gb_state *state = NULL;
        if (!gb_state_read(&state, g_ptr_array_index(paths, k), err)) {
            return false;
        }
        describe(list, state, point);
        const char *path = g_ptr_array_index(paths, k);
        const double distance_to_point =
            is_kept_for(path, point) ? 0.0 : distance(state, point);
        if (distance_to_point < best) {
            struct gb_state *other = *out;
            *out = state;
            state = other;
            best = distance_to_point;
            *which = k;
        }
        gb_state_destroy(state);
    }
    return best <= tolerance;
}

bool gb_states_read(struct gb_state **out, const char *source, const char *at,
                    struct gb_error *err)
{
    struct gb_keep_point point = {0};
    guint which = 0;
    *out = NULL;
    if (at != NULL && !parse_point(at, &point, err)) {
        return false;
    }
    GPtrArray *paths = list_paths(source);
    if (!g_file_test(g_ptr_array_index(paths, 0), G_FILE_TEST_EXISTS)) {
        gb_error_set(err, GB_ERR_INPUT, "%.300s: no such file",
                     (const char *)g_ptr_array_index(paths, 0));
        g_ptr_array_unref(paths);
        return false;
    }
    if (at == NULL) {
        const bool good = gb_state_read(out, g_ptr_array_index(paths, 0), err);
        g_ptr_array_unref(paths);
        return good;
    }
    GString *list = g_string_new(NULL);
    struct gb_error cause = {0};
    const bool good = read_nearest(out, paths, &point, list, &which, &cause);
    if (!good) {
        gb_state_destroy(*out);
        *out = NULL;
        if (cause.code != GB_OK) {
            *err = cause;
        } else {
            gb_error_set(err, GB_ERR_INPUT, "--at %.80s: %.200s keeps states at %.150s",
                         at, source, list->str);
        }
    }
    g_string_free(list, TRUE);
    g_ptr_array_unref(paths);
    return good;
}

struct frame {
    int64_t step;
    char *path;
};

static int by_step(const void *a, const void *b)
{
    const struct frame *x = a;
    const struct frame *y = b;
    return (x->step > y->step) - (x->step < y->step);
}

/* Paths in the order of their steps, without repeated steps. */
static GPtrArray *sort_frames(GArray *frames)
{
    GPtrArray *sorted = g_ptr_array_new_with_free_func(g_free);
    g_array_sort(frames, by_step);
    for (guint k = 0; k < frames->len; k++) {
        const struct frame *frame = &g_array_index(frames, struct frame, k);
        if (k > 0 && g_array_index(frames, struct frame, k - 1).step == frame->step) {
            continue;
        }
        g_ptr_array_add(sorted, g_strdup(frame->path));
    }
    return sorted;
}

GPtrArray *gb_states_along(const char *source, struct gb_error *err)
{
    GPtrArray *paths = list_paths(source);
    GArray *frames = g_array_new(FALSE, FALSE, sizeof(struct frame));
    bool good = true;
    for (guint k = 0; k < paths->len && good; k++) {
        struct gb_state *state = NULL;
        char *path = g_ptr_array_index(paths, k);
        good = gb_state_read(&state, path, err);
        if (good) {
            const struct frame frame = {state->point.step, path};
            g_array_append_val(frames, frame);
        }
        gb_state_destroy(state);
    }
    GPtrArray *sorted = good ? sort_frames(frames) : NULL;
    g_array_unref(frames);
    g_ptr_array_unref(paths);
    return sorted;
}

/* Path of the state nearest to a point (g_free), or NULL. */
static char *find_nearest(const char *source, const GPtrArray *paths,
                          const struct gb_keep_point *point, struct gb_error *err)
{
    struct gb_state *state = NULL;
    struct gb_error cause = {0};
    GString *list = g_string_new(NULL);
    guint which = 0;
    const bool found = read_nearest(&state, paths, point, list, &which, &cause);
    if (!found && cause.code != GB_OK) {
        *err = cause;
    } else if (!found) {
        gb_error_set(err, GB_ERR_INPUT, "--at: %.200s keeps states at %.150s", source,
                     list->str);
    }
    gb_state_destroy(state);
    g_string_free(list, TRUE);
    return found ? g_strdup(g_ptr_array_index(paths, which)) : NULL;
}

GPtrArray *gb_states_select(const char *source, const struct gb_keep_points *points,
                            struct gb_error *err)
{
    GPtrArray *all = gb_states_along(source, err);
    if (all == NULL || points->count == 0) {
        return all;
    }
    GPtrArray *chosen = g_ptr_array_new_with_free_func(g_free);
    for (int k = 0; k < points->count && chosen != NULL; k++) {
        char *path = find_nearest(source, all, &points->point[k], err);
        if (path != NULL) {
            g_ptr_array_add(chosen, path);
        } else {
            g_ptr_array_unref(chosen);
            chosen = NULL;
        }
    }
    g_ptr_array_unref(all);
    return chosen;
}

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

bool gb_states_write_packing(const struct gb_packing *packing, const char *directory,
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
