#include "cli/commands.h"

#include <string.h>

#include <glib.h>

#include "base/visible.h"

static const char runs[] = "Runs", many[] = "Many runs", packings[] = "Packings",
                  results[] = "Results", numerics[] = "Numerics", lists[] = "Lists";

static const struct gb_commands_row rows[] = {
    {runs, "run", "one run without a screen; results in a directory", gb_cmd_run},
    {runs, "resume", "continues an interrupted run", gb_cmd_resume},
    {runs, "attach", "shows a running simulation, or takes it over", gb_cmd_attach},
    {runs, "runs", "lists live, detached and past runs", gb_cmd_runs},
    {runs, "verify", "repeats the last part of a run and compares", gb_cmd_verify},
    {many, "sweep", "a grid of parameters with replicas, in one table", gb_cmd_sweep},
    {many, "calibrate", "parameters fitted to measured densities, with intervals",
     gb_cmd_calibrate},
    {many, "yield", "yield surface and plastic flow of compacts, with errors",
     gb_cmd_yield},
    {many, "strength", "tension, compression and shear of unloaded compacts",
     gb_cmd_strength},
    {many, "card", "Drucker-Prager cap card for finite elements, with intervals",
     gb_cmd_card},
    {many, "papers", "the numbers and figures of the three papers, with verdicts",
     gb_cmd_papers},
    {packings, "pack", "the initial structure alone", gb_cmd_pack},
    {packings, "sizes", "log-normal law fitted to measured particle sizes", gb_cmd_sizes},
    {packings, "snapshot", "picture of a packing", gb_cmd_snapshot},
    {packings, "export", "states for OVITO, LAMMPS, ASE, ParaView", gb_cmd_export},
    {results, "moduli", "elastic moduli at states of a run, or of a lattice",
     gb_cmd_moduli},
    {results, "plot", "figures over one or more runs, and of contact laws", gb_cmd_plot},
    {results, "fit", "equations of compaction fitted to runs or measured points",
     gb_cmd_fit},
    {results, "report", "figures, pictures and tables of runs in one folder",
     gb_cmd_report},
    {results, "cycle", "springback and force of ejection of full die cycles",
     gb_cmd_cycle},
    {numerics, "chart", "accuracy against cost of the numerical settings of a scene",
     gb_cmd_chart},
    {numerics, "stability", "longest stable step of each method, and theory",
     gb_cmd_stability},
    {lists, "law", "values of a contact law as CSV", gb_cmd_law},
    {lists, "params", "every preset key: unit, range, default, meaning, source",
     gb_cmd_params},
};

const struct gb_commands_row *gb_commands_find(const char *name)
{
    for (size_t i = 0; i < G_N_ELEMENTS(rows); i++) {
        if (strcmp(rows[i].name, name) == 0) {
            return &rows[i];
        }
    }
    return NULL;
}

const struct gb_commands_row *gb_commands_at(size_t index)
{
    return index < G_N_ELEMENTS(rows) ? &rows[index] : NULL;
}

void gb_commands_print(FILE *to)
{
    for (size_t i = 0; i < G_N_ELEMENTS(rows); i++) {
        if (i == 0 || rows[i].group != rows[i - 1].group) {
            gb_visible_print(to, "  %s\n", rows[i].group);
        }
        gb_visible_print(to, "    %-10s %s\n", rows[i].name, rows[i].doc);
    }
}

void gb_commands_print_plain(FILE *to)
{
    for (size_t i = 0; i < G_N_ELEMENTS(rows); i++) {
        gb_visible_print(to, "%s %s\n", rows[i].name, rows[i].doc);
    }
}

char *gb_commands_names(void)
{
    GString *names = g_string_new(NULL);
    for (size_t i = 0; i < G_N_ELEMENTS(rows); i++) {
        g_string_append_printf(names, "%s%s", i > 0 ? ", " : "", rows[i].name);
    }
    return g_string_free(names, FALSE);
}
