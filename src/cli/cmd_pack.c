/* `greenbody pack`: the initial packing of a run, without the run.  It grows a periodic
 * cell, or pours, settles and flattens the bed of a die, and writes it with its radial
 * distribution function. --percolation instead finds the number of particles at which
 * growing clusters percolate. */
#include <errno.h>
#include <glib.h>
#include <glib/gstdio.h>
#include <inttypes.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>

#include "base/alloc.h"
#include "base/listing.h"
#include "base/units.h"
#include "base/visible.h"
#include "cli/commands.h"
#include "cli/options.h"
#include "cli/progress.h"
#include "figures/states.h"
#include "greenbody/params.h"
#include "greenbody/status.h"
#include "io/preset.h"
#include "io/rundir.h"
#include "io/state.h"
#include "measure/average.h"
#include "measure/structure.h"
#include "pack/cell/cell.h"
#include "run/experiment.h"
#include "scene/loading_kind.h"
#include "scene/model.h"
#include "scene/seed.h"

/* `greenbody pack --percolation CELLS`: the number of particles at which the growing
 * cluster percolates.  The cells have ascending seeds, beginning with that of the
 * scene.  Prints CSV with mean, standard error and standard deviation on stdout. */

enum { GB_PACK_PERCOLATION_CELLS = 100000 }; /* upper limit */

/* Relative density of `count` particles in the cell of the model. */
static double density_of(const struct gb_model *model, double count)
{
    const double particle = model->dimension == 2 ? M_PI / 4.0 : M_PI / 6.0;
    return particle * count / (model->edges[0] * model->edges[1] * model->edges[2]);
}

static bool find(const struct gb_params *params, struct gb_model *model, double *count,
                 struct gb_error *err)
{
    int64_t particles = 0;
    if (!gb_model_init(model, params, err)) {
        return false;
    }
    struct gb_chain_growth grow = gb_chain_growth_from_model(model);
    grow.cancelled = gb_progress_cancelled;
    if (!gb_structure_percolation(&grow, &particles, err)) {
        return false;
    }
    *count = (double)particles;
    return true;
}

/* Adds the mean over the cells as a comment below their rows. */
static void add_mean(struct gb_listing *listing, const struct gb_model *model,
                     const double *count, int cells)
{
    double mean = NAN;
    double error = NAN;
    GString *text = g_string_new(NULL);
    gb_average_values(count, (size_t)cells, &mean, &error);
    g_string_printf(text, "mean %.6g particles, density %.4f", mean,
                    density_of(model, mean));
    if (cells > 1) {
        g_string_append_printf(
            text, "; standard error %.2g, %.1g; standard deviation %.3g", error,
            density_of(model, error), error * sqrt((double)cells));
    }
    g_string_append_printf(text, "; %d cell%s of %.5g x ", cells, cells > 1 ? "s" : "",
                           model->edges[0]);
    if (model->dimension == 3) {
        g_string_append_printf(text, "%.5g x ", model->edges[1]);
    }
    g_string_append_printf(text, "%.5g d", model->edges[2]);
    gb_listing_note(listing, text->str);
    g_string_free(text, TRUE);
}

/* Errors: GB_ERR_INPUT (lattices, stdout cannot be written); see gb_structure_percolation. */
static bool pack_percolation(const struct gb_params *params, int cells,
                             struct gb_error *err)
{
    struct gb_params scene = *params;
    struct gb_model model;
    double *count = g_new(double, (gsize)cells);
    struct gb_listing *listing = gb_listing_new();
    gb_listing_comment(listing,
                       "particles at which the growing cluster joins its images along "
                       "all axes, P1 section III");
    gb_listing_columns(listing, "%.0f", "seed,particles");
    gb_listing_columns(listing, "%.6f", "density");
    bool good = gb_seed_matters(params) ||
                gb_error_set(err, GB_ERR_INPUT,
                             "--percolation: expected structure.kind = grown and no "
                             "structure.from: other structures do not grow");
    for (int k = 0; k < cells && good; k++) {
        scene.seed = params->seed + (uint64_t)k;
        good = find(&scene, &model, &count[k], err);
        if (good) {
            gb_listing_whole(listing, model.seed);
            gb_listing_number(listing, count[k]);
            gb_listing_number(listing, density_of(&model, count[k]));
        }
    }
    if (good) {
        add_mean(listing, &model, count, cells);
        good = gb_options_print(gb_listing_print(listing, GB_LISTING_CSV), err);
    }
    gb_listing_free(listing);
    g_free(count);
    return good;
}

/* The bed of a die scene: poured, settled and flattened, as `run` begins to press it. */
struct gb_pack_bed {
    struct gb_state *state;
    GPtrArray *filling; /* struct gb_state while the powder falls, in order */
};

enum { GB_PACK_BED_STATES = 1000 };

/* Time steps between two checks of the time and of signals: about 0.1 s. */
static const int64_t slice = 500;

static void destroy_state(void *state)
{
    gb_state_destroy(state);
}

/* Takes a state.  States of the filling are numbered by the steps so far, since they
 * precede all recorded points. */
static bool take(const struct gb_experiment *experiment, struct gb_state **out,
                 struct gb_error *err)
{
    if (!gb_experiment_state(experiment, out, err)) {
        return false;
    }
    (*out)->point.step = gb_experiment_evaluations(experiment);
    return true;
}

/* Keeps a state if the point is one of the list. */
static bool keep(struct gb_pack_bed *bed, const struct gb_experiment *experiment,
                 double every_s, struct gb_error *err)
{
    struct gb_state *state = NULL;
    if (bed->filling->len >= GB_PACK_BED_STATES) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "--every: filling would keep more than %d states: expected a "
                            "longer time",
                            GB_PACK_BED_STATES);
    }
    if (!take(experiment, &state, err)) {
        return false;
    }
    if (state->point.time_s >= every_s * (bed->filling->len + 1)) {
        g_ptr_array_add(bed->filling, state);
    } else {
        gb_state_destroy(state);
    }
    return true;
}

/* Prints the events; true if all powder is in the die. */
static bool is_poured(struct gb_experiment *experiment)
{
    char text[GB_EVENT_TEXT];
    bool poured = false;
    while (gb_experiment_event(experiment, NULL, text, sizeof text)) {
        gb_visible_line(stderr, "  %s", text);
        poured = poured || g_str_has_prefix(text, "poured");
    }
    return poured;
}

static bool fill(struct gb_pack_bed *bed, struct gb_experiment *experiment,
                 double every_s, struct gb_error *err)
{
    bool keeping = every_s > 0.0;
    for (;;) {
        const enum gb_step_outcome outcome =
            gb_experiment_advance(experiment, slice, err);
        if (outcome == GB_STEP_STOPPED) {
            return false;
        }
        keeping = !is_poured(experiment) && keeping;
        if (outcome != GB_STEP_MORE) {
            return take(experiment, &bed->state, err);
        }
        if (gb_progress_cancelled(NULL)) {
            return gb_error_set(err, GB_ERR_CANCELLED, "filling cancelled");
        }
        if (keeping && !keep(bed, experiment, every_s, err)) {
            return false;
        }
    }
}

/* every_s   simulated time between kept states until all powder is poured; 0: none
 * Prints a line to stderr at the end of each stage.  Errors: GB_ERR_INPUT (more than
 * GB_PACK_BED_STATES states), errors of the run, GB_ERR_CANCELLED by a signal. */
static bool pack_bed_fill(struct gb_pack_bed *bed, const struct gb_params *params,
                          double every_s, struct gb_error *err)
{
    struct gb_experiment *experiment = NULL;
    *bed = (struct gb_pack_bed){.filling = g_ptr_array_new_with_free_func(destroy_state)};
    if (!gb_experiment_create(&experiment, params, gb_progress_cancelled, NULL, err)) {
        return false;
    }
    const bool filled = fill(bed, experiment, every_s, err);
    gb_experiment_destroy(experiment);
    return filled;
}

static void pack_bed_finish(struct gb_pack_bed *bed)
{
    if (bed->filling != NULL) {
        g_ptr_array_unref(bed->filling);
    }
    *bed = (struct gb_pack_bed){0};
}

/* Writes the states of the filling as DIRECTORY/snapshots/filling-000001.h5 ... */
static bool pack_bed_write(const struct gb_pack_bed *bed, const char *directory,
                           struct gb_error *err)
{
    char *folder = g_build_filename(directory, "snapshots", NULL);
    bool good = bed->filling == NULL || bed->filling->len == 0 ||
                g_mkdir(folder, 0777) == 0 || errno == EEXIST ||
                gb_error_set(err, GB_ERR_MACHINE, "%s: cannot be made: %s", folder,
                             g_strerror(errno));
    for (guint k = 0; good && bed->filling != NULL && k < bed->filling->len; k++) {
        char *path = g_strdup_printf("%s/filling-%06u.h5", folder, k + 1);
        good = gb_state_write(g_ptr_array_index(bed->filling, k), NULL, path, err);
        g_free(path);
    }
    g_free(folder);
    return good;
}

/* Prints particles, height, densities and coordination on stdout. */
static void pack_bed_print(const struct gb_state *state)
{
    const struct gb_point *point = &state->point;
    gb_visible_print(stdout, "particles      %" PRId64 ", seed %" PRIu64 "\n",
                     state->count, state->seed);
    gb_visible_print(stdout, "die            %.5g um wide, powder %.5g um high\n",
                     2e6 * state->die_radius * state->metre_per_length,
                     1e6 * point->height_m);
    gb_visible_print(stdout, "density        %.6g\n", point->density);
    gb_visible_print(stdout, "central        %.6g\n", point->central);
    gb_visible_print(stdout, "coordination   %.6g\n", point->coordination);
}

/* Width of the bins of g(r), d.  It resolves the peak of touching particles and the
 * edges at r = sqrt(3) and 2. */
static const double bin_width = 0.05;

/* Largest distance (d): beyond it g(r) is 1 and would cost more than the packing. */
static const double r_limit = 12.0;

enum { NOT_GIVEN = INT_MIN };

struct pack {
    char *directory;
    enum gb_rundir_mode mode;
    int percolation; /* cells; NOT_GIVEN: one packing */
    char *every;
    double every_s;
    struct gb_preset *preset;
    struct gb_packing packing;
    struct gb_pack_bed bed;
};

static bool is_bed(const struct pack *pack)
{
    return !gb_loading_kind_of(&pack->packing.params)->periodic_cell;
}

static bool check_options(const struct pack *pack, struct gb_error *err)
{
    const bool searches = pack->percolation != NOT_GIVEN;
    if (searches &&
        (pack->percolation < 1 || pack->percolation > GB_PACK_PERCOLATION_CELLS)) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "--percolation %d: must be between 1 and %d cells",
                            pack->percolation, GB_PACK_PERCOLATION_CELLS);
    }
    if (searches && (pack->directory != NULL || pack->every != NULL)) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "--percolation writes a table to standard output; expected "
                            "without --out and --every");
    }
    return searches || pack->directory != NULL ||
           gb_error_set(err, GB_ERR_INPUT,
                        "pack needs --out DIR, a directory for the packing");
}

/* Checks that --every is used for dies and --percolation for periodic cells. */
static bool check_scene(struct pack *pack, struct gb_error *err)
{
    if (pack->every != NULL && !is_bed(pack)) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "--every keeps states while a die is filled; expected for "
                            "scene.kind = die");
    }
    if (pack->every != NULL &&
        (!gb_units_parse(pack->every, GB_DIM_TIME, &pack->every_s, NULL) ||
         !(pack->every_s > 0.0))) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "--every %.80s: expected a time above 0, as in '5 us'",
                            pack->every);
    }
    return pack->percolation == NOT_GIVEN ||
           gb_loading_kind_check_cell(&pack->packing.params, "--percolation", err);
}

/* Makes all checks that are possible before the packing is grown. */
static bool prepare(struct pack *pack, char **words, char **sets, struct gb_error *err)
{
    if (!check_options(pack, err) ||
        !gb_options_scene(&pack->preset, words, sets, GB_OPTIONS_PRESET_NEEDED, err)) {
        return false;
    }
    pack->packing.params = *gb_preset_params(pack->preset);
    return check_scene(pack, err) &&
           (pack->directory == NULL || gb_rundir_check(pack->directory, pack->mode, err));
}

/* Grows the initial packing that `run` has with the same preset. */
static bool grow(struct gb_packing *packing, struct gb_error *err)
{
    struct gb_experiment *experiment = NULL;
    if (!gb_experiment_create(&experiment, &packing->params, NULL, NULL, err)) {
        return false;
    }
    packing->r_eq = 1.0 - gb_experiment_model(experiment)->h_eq;
    const bool grown = gb_experiment_state(experiment, &packing->state, err);
    gb_experiment_destroy(experiment);
    return grown;
}

static bool measure(struct gb_packing *packing, struct gb_error *err)
{
    const struct gb_state *state = packing->state;
    const struct gb_cell cell = gb_state_cell(state);
    packing->reach = gb_structure_reach(packing->r_eq);
    packing->r_max = fmin(0.5 * gb_cell_shortest(&cell), r_limit);
    packing->bins = (int)ceil(packing->r_max / bin_width);
    packing->g = gb_alloc_array((size_t)packing->bins, sizeof *packing->g, err);
    if (packing->g == NULL ||
        !gb_structure_rdf(&cell, state->count, state->position, packing->r_max,
                          packing->bins, packing->g, err) ||
        !gb_structure_connectivity(&cell, state->count, state->position, state->radius,
                                   packing->reach, &packing->connectivity, err)) {
        return false;
    }
    packing->g_end = gb_structure_rdf_end(state->dimension, packing->r_max, packing->bins,
                                          packing->g, NULL);
    return true;
}

/* Writes the files of the packing, or none of them. */
static bool write_packing(const struct pack *pack, struct gb_error *err)
{
    struct gb_rundir dir;
    if (!gb_rundir_make(&dir, pack->directory, pack->mode, err)) {
        return false;
    }
    if (!gb_states_write_packing(&pack->packing, pack->directory, err) ||
        !pack_bed_write(&pack->bed, pack->directory, err)) {
        gb_rundir_remove(&dir);
        return false;
    }
    gb_rundir_finish(&dir);
    return true;
}

static void print_contacts(const struct gb_connectivity *contacts, int64_t count)
{
    enum { BINS = sizeof contacts->histogram / sizeof contacts->histogram[0] };
    gb_visible_print(stdout, "coordination   %.6g\n", contacts->coordination);
    for (int k = 0; k < BINS; k++) {
        if (contacts->histogram[k] > 0) {
            gb_visible_print(stdout, "  %2d%s contacts %8" PRId64 "  %6.2f %%\n", k,
                             k == BINS - 1 ? "+" : " ", contacts->histogram[k],
                             100.0 * (double)contacts->histogram[k] / (double)count);
        }
    }
}

static void print_summary(const struct gb_packing *packing, const char *directory)
{
    const struct gb_state *state = packing->state;
    const struct gb_connectivity *contacts = &packing->connectivity;
    const bool planar = state->dimension == 2;
    const char *const axes[] = {"x ", "y ", "z "};
    gb_visible_print(stdout, "particles      %" PRId64 ", seed %" PRIu64 "\n",
                     state->count, state->seed);
    if (planar) {
        gb_visible_print(stdout, "cell           %.5g x %.5g d\n", state->cell[0],
                         state->cell[2]);
    } else {
        gb_visible_print(stdout, "cell           %.5g x %.5g x %.5g d\n", state->cell[0],
                         state->cell[1], state->cell[2]);
    }
    gb_visible_print(stdout, "density        %.6g\n", state->point.density);
    print_contacts(contacts, state->count);
    gb_visible_print(stdout,
                     "clusters       %" PRId64 ", the largest of %" PRId64 " particles\n",
                     contacts->clusters, contacts->largest);
    gb_visible_print(stdout, "spans along    ");
    bool any = false;
    for (int k = 0; k < 3; k++) {
        gb_visible_put(stdout, contacts->percolates[k] ? axes[k] : "");
        any = any || contacts->percolates[k];
    }
    gb_visible_put(stdout, any ? "\n" : "no axis\n");
    gb_visible_print(stdout, "mean g(r)      %.5g for r = %.4g to %.4g d\n",
                     packing->g_end, fmax(0.0, packing->r_max - 1.0), packing->r_max);
    gb_visible_print(stdout, "written to     %s\n", directory);
}

static bool pack_bed(struct pack *pack, struct gb_error *err)
{
    const bool done =
        pack_bed_fill(&pack->bed, &pack->packing.params, pack->every_s, err);
    pack->packing.state = pack->bed.state;
    if (!done || !write_packing(pack, err)) {
        return false;
    }
    pack_bed_print(pack->packing.state);
    if (pack->bed.filling->len > 0) {
        gb_visible_print(stdout, "filling        %u states\n", pack->bed.filling->len);
    }
    gb_visible_print(stdout, "written to     %s\n", pack->directory);
    return true;
}

static bool pack_cell(struct pack *pack, struct gb_error *err)
{
    if (!grow(&pack->packing, err) || !measure(&pack->packing, err) ||
        !write_packing(pack, err)) {
        return false;
    }
    print_summary(&pack->packing, pack->directory);
    return true;
}

static bool run(struct pack *pack, struct gb_error *err)
{
    if (pack->percolation != NOT_GIVEN) {
        return pack_percolation(&pack->packing.params, pack->percolation, err);
    }
    return is_bed(pack) ? pack_bed(pack, err) : pack_cell(pack, err);
}

static void finish(struct pack *pack)
{
    gb_alloc_free(pack->packing.g);
    gb_state_destroy(pack->packing.state);
    pack_bed_finish(&pack->bed);
    gb_preset_destroy(pack->preset);
    g_free(pack->directory);
    g_free(pack->every);
}

int gb_cmd_pack(int argc, char **argv)
{
    static const struct gb_options_page page = {
        "PRESET [group.key=value]...",
        "The initial structure alone: its particles (packing.csv), g(r) (g.csv),\n"
        "contacts and clusters (structure.json), and state.h5 for greenbody snapshot.\n"
        "Of a die: the bed, poured, settled and flattened, with its densities.",
        "Structure of P1 Fig. 3, and the number of particles at which it percolates:\n"
        "  greenbody pack p1-fig3 --out fig3\n"
        "  greenbody snapshot fig3 -o fig3.png\n"
        "  greenbody pack p1-fig3 structure.seed=1 --percolation 400\n"
        "Powder that falls into the die, P3 Fig. 13:\n"
        "  greenbody pack p3-hertz-mu0 --every '5 us' --out bed\n"
        "  greenbody snapshot bed/snapshots/filling-000003.h5 -o fig13a.png"};
    struct pack pack = {.percolation = NOT_GIVEN};
    struct gb_error err = {0};
    char **sets = NULL;
    char **words = NULL;
    gboolean force = FALSE;
    int status = 0;
    const GOptionEntry entries[] = {
        gb_options_set(&sets),
        {"out", 'o', 0, G_OPTION_ARG_FILENAME, &pack.directory,
         "directory of the packing", "DIR"},
        {"force", 'f', 0, G_OPTION_ARG_NONE, &force, "replace a packing in DIR", NULL},
        {"percolation", 0, 0, G_OPTION_ARG_INT, &pack.percolation,
         "instead of a packing: the least number of particles whose cluster joins its "
         "images, of so many cells",
         "CELLS"},
        {"every", 0, 0, G_OPTION_ARG_STRING, &pack.every,
         "keep a state so often while powder falls into a die, as '5 us'", "TIME"},
        {0}};
    if (gb_options_parse(&page, entries, argc, argv, &words, &status)) {
        gb_progress_catch_signals(GB_SIGNALS_HANGUP_ENDS);
        pack.mode = force ? GB_RUNDIR_REPLACE : GB_RUNDIR_KEEP;
        if (!prepare(&pack, words, sets, &err) || !run(&pack, &err)) {
            gb_options_fail(&err);
            status = gb_progress_exit_status(&err);
        }
    }
    finish(&pack);
    g_strfreev(words);
    g_strfreev(sets);
    return status;
}
