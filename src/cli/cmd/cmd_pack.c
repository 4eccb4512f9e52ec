#include <inttypes.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>

#include <glib.h>

#include "base/alloc.h"
#include "base/text/visible.h"
#include "base/units.h"
#include "cli/commands.h"
#include "cli/options.h"
#include "cli/pack/pack_bed.h"
#include "cli/pack/pack_percolation.h"
#include "cli/signals.h"
#include "figures/report/packing.h"
#include "io/preset.h"
#include "io/rundir.h"
#include "measure/percolation.h"
#include "measure/structure.h"
#include "pack/cell/cell.h"
#include "run/experiment.h"
#include "scene/loading_kind.h"

/* Width of the bins of g(r), d: it resolves the peak of touching particles and the edges
 * at r = sqrt(3) and 2. */
static const double bin_width = 0.05;

/* Beyond this distance (d) g(r) is 1, and would cost more than the packing itself. */
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
        return gb_error_set(err, GB_ERR_INPUT, "--percolation %d: must be between 1 and %d cells",
                            pack->percolation, GB_PACK_PERCOLATION_CELLS);
    }
    if (searches && (pack->directory != NULL || pack->every != NULL)) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "--percolation writes a table to standard output; accepted "
                            "without --out and --every");
    }
    return searches || pack->directory != NULL ||
           gb_error_set(err, GB_ERR_INPUT,
                        "pack needs --out DIR, a directory for the packing");
}

/* --every is for dies, --percolation for periodic cells. */
static bool check_scene(struct pack *pack, struct gb_error *err)
{
    if (pack->every != NULL && !is_bed(pack)) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "--every keeps states while a die is filled; accepted for "
                            "scene.kind = die");
    }
    if (pack->every != NULL &&
        (!gb_units_parse(pack->every, GB_DIM_TIME, &pack->every_s, NULL) ||
         !(pack->every_s > 0.0))) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "--every %.80s: accepted a time above 0, as in '5 us'",
                            pack->every);
    }
    return pack->percolation == NOT_GIVEN ||
           gb_loading_kind_check_cell(&pack->packing.params, "--percolation", err);
}

/* All checks that are possible before the packing is grown. */
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

/* The initial packing of `run` with the same preset. */
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
    packing->reach = gb_percolation_reach(packing->r_eq);
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

/* Where not all files can be written, none is left. */
static bool write_packing(const struct pack *pack, struct gb_error *err)
{
    struct gb_rundir dir;
    if (!gb_rundir_make(&dir, pack->directory, pack->mode, err)) {
        return false;
    }
    if (!gb_packing_write(&pack->packing, pack->directory, err) ||
        !gb_pack_bed_write(&pack->bed, pack->directory, err)) {
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
        gb_pack_bed_fill(&pack->bed, &pack->packing.params, pack->every_s, err);
    pack->packing.state = pack->bed.state;
    if (!done || !write_packing(pack, err)) {
        return false;
    }
    gb_pack_bed_print(pack->packing.state);
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
        return gb_pack_percolation(&pack->packing.params, pack->percolation, err);
    }
    return is_bed(pack) ? pack_bed(pack, err) : pack_cell(pack, err);
}

static void finish(struct pack *pack)
{
    gb_alloc_free(pack->packing.g);
    gb_state_destroy(pack->packing.state);
    gb_pack_bed_finish(&pack->bed);
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
        gb_signals_install(GB_SIGNALS_HANGUP_ENDS);
        pack.mode = force ? GB_RUNDIR_REPLACE : GB_RUNDIR_KEEP;
        if (!prepare(&pack, words, sets, &err) || !run(&pack, &err)) {
            gb_options_fail(&err);
            status = gb_signals_exit_status(&err);
        }
    }
    finish(&pack);
    g_strfreev(words);
    g_strfreev(sets);
    return status;
}
