#include "io/curve_csv.h"

#include <inttypes.h>
#include <math.h>

#include "base/number.h"
#include "base/text/visible.h"
#include "io/line_file.h"
#include "io/point_columns.h"
#include "scene/derived.h"

/* ",value" with the fewest digits that read back the same; only "," where there is none.
 */
static void append_number(GString *row, double value)
{
    char text[GB_NUMBER_MAX];
    g_string_append_c(row, ',');
    if (isfinite(value)) {
        g_string_append(row, gb_number_write(value, text));
    }
}

static const char *compressed_axes(const struct gb_params *params)
{
    switch (gb_derived_geometry(params)) {
    case GB_GEOMETRY_UNIAXIAL:
    case GB_GEOMETRY_DIE:
        return "z";
    case GB_GEOMETRY_BIAXIAL:
        return "y and z";
    default:
        return params->dimension == 2 ? "x and z" : "x, y and z";
    }
}

static void append_columns(GString *row, const struct gb_point *point, size_t from,
                           size_t to)
{
    for (size_t k = from; k < to; k++) {
        append_number(row, gb_point_columns_value(point, k));
    }
}

static void append_nothing(GString *row, const struct gb_point *point)
{
    (void)row;
    (void)point;
}

static void append_energies(GString *row, const struct gb_point *point)
{
    const double values[] = {1e9 * point->time_s, point->kinetic,
                             point->work,         point->elastic,
                             point->dissipated,   point->energy_residual};
    for (size_t k = 0; k < G_N_ELEMENTS(values); k++) {
        append_number(row, values[k]);
    }
}

static void append_die(GString *row, const struct gb_point *point)
{
    const double values[] = {1e9 * point->time_s,     point->central,
                             1e6 * point->height_m,   point->height_change,
                             1e-6 * point->target_pa, point->floor_over_punch};
    for (size_t k = 0; k < G_N_ELEMENTS(values); k++) {
        append_number(row, values[k]);
    }
}

static const char die_note[] =
    "# die: floor_MPa and wall_friction_mN are means since the last point, while loading "
    "those of the point; wall_MPa is the radial pressure at the point, wall_low, "
    "wall_middle and wall_high that on the thirds of the powder's height; "
    "wall_friction_mN "
    "is the axial force of the wall on the powder, downward: the force of ejection; "
    "punch_work_J since pressing began; axial springback is the height over that under "
    "the full pressure, radial springback the outer radius over that of the bore, each "
    "less 1; welded is the share of the cold welds that holds\n";

static const char tensor_note[] =
    "# tensors: pxy, pxz, pyz of the pressure tensor; q its deviatoric part; asymmetry "
    "of its antisymmetric part over the mean pressure; exx, eyy, ezz logarithmic "
    "strains, positive in compression, gxy, gxz, gyz engineering shears, all since the start; fxx "
    "to fyz fabric of the contacts; anisotropies of the fabric of all, bridged, tensile "
    "contacts and weighted by force; leg of loading.path\n";

/* By enum gb_curve_columns: comments of the head of curve.csv, names of own columns, their
 * values, and the ranges of the table of columns that follow. */
static const struct column_set {
    const char *note, *names;
    void (*append)(GString *row, const struct gb_point *point);
    const char *table_note;
    struct {
        size_t from, to;
    } range[2];
} column_sets[] = {
    [GB_COLUMNS_COMMON] =
        {"# unrelaxed: 1 where the relaxation ended above its tolerance and was accepted: "
         "no equilibrium\n",
         "",
         append_nothing,
         tensor_note,
         {{0, GB_POINT_COLUMNS}, {GB_POINT_DIE_END, GB_POINT_ALL_COLUMNS}}},
    [GB_COLUMNS_ENERGY] =
        {"# dynamic: time_ns is simulated time; kinetic, work (done by the moving cell), "
         "elastic and dissipated energy in J; energy_residual is relative to the work\n",
         ",time_ns,kinetic,work,elastic,dissipated,energy_residual",
         append_energies,
         tensor_note,
         {{0, GB_POINT_COLUMNS}}},
    [GB_COLUMNS_DIE] =
        {"# die: p and pz are what the powder carries under the punch, px and py the "
         "mean on the side wall; density is that of the whole specimen, central_density "
         "that of a ball in its middle; height_change is relative to the height before "
         "pressing; time_ns is simulated time, wanted_MPa the scheduled pressure, "
         "floor_over_punch a ratio of forces: not quasi-static outside 0.95 to 1.05\n",
         ",time_ns,central_density,height_um,height_change,wanted_MPa,floor_over_punch",
         append_die,
         die_note,
         {{GB_POINT_COLUMNS, GB_POINT_DIE_END}}},
};

GString *gb_curve_csv_head(const struct gb_params *params)
{
    GString *head = g_string_new("# greenbody " GB_VERSION "\n# preset: ");
    GString *title = g_string_new(NULL);
    gb_visible_add_cell(title, params->title, false);
    gb_line_file_add_text(head, title->str);
    g_string_free(title, TRUE);
    g_string_append_printf(head, "# seed: %" PRIu64 "\n", params->seed);
    g_string_append(
        head, "# units: pressures in MPa; density is the share of the volume "
              "that is solid; bridged is a share of the contacts, rattlers of "
              "the particles; residual is the rms force over the mean contact force or "
              "f_a(d), whichever is larger, in every numerics.tolerance_scale; seconds "
              "of wall time since the start\n");
    g_string_append_printf(
        head,
        "# p_MPa: mean pressure over the compressed axes (%s), positive "
        "in compression\n",
        compressed_axes(params));
    const struct column_set *set = &column_sets[gb_loading_kind_of(params)->columns];
    g_string_append(head, set->note);
    g_string_append(head, set->table_note);
    g_string_append(head, "branch,step,density,px_MPa,py_MPa,pz_MPa,p_MPa,coordination,"
                          "bridged,rattlers,residual,iterations,evaluations,seconds");
    g_string_append(head, set->names);
    for (size_t r = 0; r < G_N_ELEMENTS(set->range); r++) {
        for (size_t k = set->range[r].from; k < set->range[r].to; k++) {
            g_string_append_printf(head, ",%s", gb_point_columns_name(k));
        }
    }
    g_string_append_c(head, '\n');
    return head;
}

GString *gb_curve_csv_row(const struct gb_point *point, enum gb_curve_columns columns)
{
    char branch[GB_NUMBER_MAX];
    char seconds[GB_NUMBER_MAX];
    GString *row = g_string_new(gb_curve_branch_name(point, branch, sizeof branch));
    g_string_append_printf(row, ",%" PRId64, point->step);
    const double before[] = {point->density,     point->px_pa / 1e6, point->py_pa / 1e6,
                             point->pz_pa / 1e6, point->p_pa / 1e6,  point->coordination,
                             point->bridged,     point->rattlers,    point->residual};
    for (size_t k = 0; k < G_N_ELEMENTS(before); k++) {
        append_number(row, before[k]);
    }
    g_string_append_printf(
        row, ",%" PRId64 ",%" PRId64 ",%s", point->iterations, point->evaluations,
        g_ascii_formatd(seconds, sizeof seconds, "%.3f", point->seconds));
    const struct column_set *set = &column_sets[columns];
    set->append(row, point);
    for (size_t r = 0; r < G_N_ELEMENTS(set->range); r++) {
        append_columns(row, point, set->range[r].from, set->range[r].to);
    }
    g_string_append_c(row, '\n');
    return row;
}
