#include "tui/view/views.h"

#include <string.h>

#include "scene/loading_kind.h"

static bool has_rod_law(const struct gb_params *params)
{
    return params->normal == GB_NORMAL_ROD;
}

/* Scenes whose parameters may change are those that record tensors. */
static bool has_tensors(const struct gb_params *params)
{
    return gb_loading_kind_of(params)->changes;
}

static bool has_cell(const struct gb_params *params)
{
    return gb_loading_kind_of(params)->periodic_cell;
}

/* The first row is the view at the start, and the one that shows insets. */
static const struct gb_plot_view views[] = {
    {
        .key = "1",
        .help = "pressure against relative density",
        .title = "Pressure against relative density",
        .hint = "Left and Right move a cursor along the points; L log or linear",
        .abscissa = GB_VIEW_DENSITY,
        .options = GB_VIEW_PRESSURE_AXIS,
        .draw = gb_view_curve_draw,
    },
    {
        .key = "2",
        .help = "distribution of the coordination number",
        .title = "Distribution of the coordination number",
        .hint = "share of particles with 0, 1, 2 ... contacts (r < d)",
        .draw = gb_view_structure_histogram,
    },
    {
        .key = "3",
        .help = "contact force against direction",
        .title = "Mean normal force by direction",
        .hint = "mean force of contacts by the angle to z; a circle when all directions "
                "carry the same load",
        .need = GB_VIEW_NEEDS_CONTACTS,
        .draw = gb_view_structure_rose,
    },
    {
        .key = "4",
        .help = "pressure against time, or against step",
        .title = "Pressure against time",
        .title_by_step = "Pressure against step",
        .hint = "Left and Right move a cursor along the points; L log or linear",
        .abscissa = GB_VIEW_ELAPSED,
        .options = GB_VIEW_PRESSURE_AXIS,
        .draw = gb_view_curve_draw,
    },
    {
        .key = "5",
        .help = "radial distribution function",
        .title = "Radial distribution function g(r)",
        .hint = "density of particles at a distance over the mean density; 1 without "
                "order",
        .need = GB_VIEW_NEEDS_SAMPLE,
        .draw = gb_view_structure_distances,
    },
    {
        .key = "6",
        .help = "lateral-to-axial stress ratio",
        .title = "Lateral-to-axial stress ratio px/pz",
        .hint = "px/pz against relative density, 1 for a fluid; Left and Right move a "
                "cursor",
        .need = GB_VIEW_NEEDS_POINTS,
        .abscissa = GB_VIEW_DENSITY,
        .draw = gb_view_curve_ratio,
    },
    {
        .key = "7",
        .help = "contact law: normal force",
        .title = "Normal force of two particles",
        .hint = "contact law of the parameters shown, + and - change the focused one; "
                "dim: law of the run",
        .options = GB_VIEW_INSET,
        .draw = gb_view_law_force,
    },
    {
        .key = "8",
        .help = "contact law: bridge strength",
        .title = "Bridge strength",
        .hint =
            "bridge strength: normal stress of partial failure, at h = 0 of full failure; "
            "dim: law of the run",
        .options = GB_VIEW_INSET,
        .draw = gb_view_law_strength,
        .applies = has_rod_law,
        .excluded = "no bridges in this scene",
    },
    {
        .key = "9",
        .help = "the packing itself",
        .title = "Packing",
        .hint =
            "darker with depth; Tab to this pane: arrows turn it, Home to the front; F "
            "colours it",
        .need = GB_VIEW_NEEDS_SAMPLE,
        .draw = gb_view_packing_draw,
        .navigate = gb_view_packing_navigate,
    },
    {
        .key = "0",
        .help = "accuracy against cost: X, or a chart.csv",
        .title = "Accuracy against cost",
        .hint = "error and cost of each setting; Left and Right move a cursor, Enter "
                "applies; T: stability of the methods",
        .need = GB_VIEW_NEEDS_CHART,
        .abscissa = GB_VIEW_SETTINGS,
        .draw = gb_view_chart_draw,
    },
    {
        .key = "T",
        .help = "stability of the methods of this scene: X",
        .title = "Stability of the methods",
        .hint =
            "longest stable step over the step taken, by pressure; below 1: unstable; "
            "Left and Right, Enter applies",
        .need = GB_VIEW_NEEDS_STABILITY,
        .abscissa = GB_VIEW_SETTINGS,
        .draw = gb_view_chart_stability,
        .applies = has_cell,
        .excluded = "stability needs a periodic cell",
    },
    {
        .key = "K",
        .help = "density differences to the run, over pressure",
        .title = "Density difference to the run",
        .hint =
            "each curve minus the run at equal pressure; band: twice the scatter of a "
            "difference; L log or linear",
        .options = GB_VIEW_PRESSURE_ACROSS,
        .draw = gb_view_difference_draw,
    },
    {
        .key = "E",
        .help = "equations of compaction fitted to the curve",
        .title = "Equations of compaction",
        .hint = "best fits by AICc from 1 % of the highest pressure on, Heckel on its "
                "straightest stretch; L log or linear",
        .need = GB_VIEW_NEEDS_POINTS,
        .abscissa = GB_VIEW_DENSITY,
        .options = GB_VIEW_PRESSURE_AXIS,
        .draw = gb_view_fit_draw,
    },
    {
        .key = "S",
        .help = "stiffness: elastic moduli against density",
        .title = "Elastic moduli",
        .hint = "averages of Hill, constants of the axis z in GPa; Y measures the stored "
                "states of the run, Y again stops",
        .draw = gb_view_moduli_draw,
        .applies = has_cell,
        .excluded = "moduli need a periodic cell",
    },
    {
        .key = "P",
        .help = "stress path: q against mean pressure, by leg",
        .title = "Stress path: q against p",
        .hint =
            "deviatoric stress against mean pressure; a number ends each leg; Left and "
            "Right move a cursor",
        .need = GB_VIEW_NEEDS_POINTS,
        .abscissa = GB_VIEW_OWN,
        .draw = gb_view_curve_stress_path,
        .applies = has_tensors,
        .excluded = "pressure tensors are recorded in quasi-static scenes",
    },
    {
        .key = "Q",
        .help = "deviatoric stress against strain, by leg",
        .title = "Deviatoric stress q against strain",
        .hint = "q against the shear or axial strain of the legs; Left and Right move a "
                "cursor",
        .need = GB_VIEW_NEEDS_POINTS,
        .abscissa = GB_VIEW_OWN,
        .draw = gb_view_curve_stress_strain,
        .applies = has_tensors,
        .excluded = "strains are recorded in quasi-static scenes",
    },
    {
        .key = "U",
        .help = "volume strain against strain, by leg",
        .title = "Volume strain against strain",
        .hint =
            "volume strain (positive: denser) against the shear or axial strain of the "
            "legs",
        .need = GB_VIEW_NEEDS_POINTS,
        .abscissa = GB_VIEW_OWN,
        .draw = gb_view_curve_volume_strain,
        .applies = has_tensors,
        .excluded = "strains are recorded in quasi-static scenes",
    },
};

enum { VIEWS = sizeof views / sizeof views[0] };

size_t gb_views_count(void)
{
    return VIEWS;
}

const struct gb_plot_view *gb_views_at(size_t index)
{
    return &views[index];
}

const struct gb_plot_view *gb_views_find(const char *key)
{
    for (size_t i = 0; i < VIEWS; i++) {
        if (strcmp(views[i].key, key) == 0) {
            return &views[i];
        }
    }
    return NULL;
}

const struct gb_plot_view *gb_views_with(enum gb_view_need need)
{
    for (size_t i = 0; i < VIEWS; i++) {
        if (views[i].need == need) {
            return &views[i];
        }
    }
    return &views[0];
}

static bool excluded(const struct gb_plot_view *view, const struct gb_params *params)
{
    return view->applies != NULL && !view->applies(params);
}

const struct gb_plot_view *gb_views_step(const struct gb_plot_view *view, int step,
                                         const struct gb_params *params)
{
    size_t at = (size_t)(view - views);
    do {
        at = (at + (size_t)(VIEWS + step)) % VIEWS;
    } while (excluded(&views[at], params));
    return &views[at];
}

int gb_views_curve_ink(int colour)
{
    return colour > 0 ? GB_PLOT_INK_SERIES + colour : GB_PLOT_INK_DIM;
}

const char *gb_views_missing(const struct gb_plot_view *view,
                             const struct gb_session *session,
                             const struct gb_params *edited)
{
    const struct gb_session_shown shown = gb_session_shown(session);
    if (excluded(view, edited)) {
        return view->excluded;
    }
    switch (view->need) {
    case GB_VIEW_NEEDS_NOTHING:
        return NULL;
    case GB_VIEW_NEEDS_POINTS:
        return shown.points < 2 ? "no points yet" : NULL;
    case GB_VIEW_NEEDS_CONTACTS:
        return !shown.now->now_valid ? "no contacts yet" : NULL;
    case GB_VIEW_NEEDS_SAMPLE:
        return shown.sample == NULL || !shown.sample->valid ? "no packing yet" : NULL;
    case GB_VIEW_NEEDS_CHART:
        return session->chart != NULL ? NULL
               : gb_job_chart_runs(&session->child)
                   ? "measuring; the points follow the reference\n"
                     "progress among the events, X stops"
                   : "no chart yet: X measures this scene,\n"
                     "e loads a chart.csv of greenbody chart";
    case GB_VIEW_NEEDS_STABILITY:
        return session->stability != NULL ? NULL
               : gb_job_chart_runs(&session->child)
                   ? "measuring; progress among the events,\nX stops"
                   : "no stability yet: X measures the methods\nof this scene";
    }
    return NULL;
}
