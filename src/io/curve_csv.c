#include "io/curve_csv.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

#include "base/number.h"
#include "base/table.h"
#include "base/visible.h"
#include "io/point_columns.h"
#include "io/text_file.h"
#include "scene/derived.h"
#include "scene/path/path.h"

/* Appends ",value" with the fewest digits that read back the same; a number that is not
 * finite becomes an empty cell. */
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

static const char die_note[] =
    "# die: floor_MPa and wall_friction_mN are means since the last point, and while "
    "loading values at the point; wall_MPa is the radial pressure at the point, wall_low, "
    "wall_middle and wall_high the same on thirds of the powder's height; wall_friction_mN "
    "is the axial force of the wall on the powder, downward: the force of ejection; "
    "punch_work_J since pressing began; axial springback is the height over the height "
    "under the full pressure, radial springback the outer radius over the radius of the "
    "bore, each less 1; welded is the fraction of cold welds that hold\n";

static const char tensor_note[] =
    "# tensors: pxy, pxz, pyz of the pressure tensor; q its deviatoric part; asymmetry "
    "of its antisymmetric part over the mean pressure; exx, eyy, ezz logarithmic "
    "strains, positive in compression, gxy, gxz, gyz engineering shears, all since the start; fxx "
    "to fyz fabric of the contacts; anisotropies of the fabric of all, bridged, tensile "
    "contacts and weighted by force; leg of loading.path\n";

/* Comments at the head of curve.csv, by enum gb_curve_columns. */
static const struct {
    const char *scene, *columns;
} notes[] = {
    [GB_COLUMNS_COMMON] =
        {"# unrelaxed: 1 where the relaxation ended above its tolerance and was accepted: "
         "no equilibrium\n",
         tensor_note},
    [GB_COLUMNS_ENERGY] =
        {"# dynamic: time_ns is simulated time; kinetic, work (done by the moving cell), "
         "elastic and dissipated energy in J; energy_residual is relative to the work\n",
         tensor_note},
    [GB_COLUMNS_DIE] =
        {"# die: p and pz are what the powder carries under the punch, px and py the "
         "mean on the side wall; density is the whole specimen's, central_density "
         "a ball's in its middle; height_change is relative to the height before "
         "pressing; time_ns is simulated time, wanted_MPa the scheduled pressure, "
         "floor_over_punch a ratio of forces: not quasi-static outside 0.95 to 1.05\n",
         die_note},
};

/* Does the row of the table describe columns of this kind of scene? */
static bool has_columns(const struct gb_point_column *row, enum gb_curve_columns scene)
{
    return row->columns != NULL && (row->scenes >> scene & 1U) != 0;
}

GString *gb_curve_csv_head(const struct gb_params *params)
{
    GString *head = g_string_new("# greenbody " GB_VERSION "\n# preset: ");
    GString *title = g_string_new(NULL);
    gb_visible_add_cell(title, params->title, false);
    gb_text_file_add_line(head, title->str);
    g_string_free(title, TRUE);
    g_string_append_printf(head, "# seed: %" PRIu64 "\n", params->seed);
    g_string_append(
        head,
        "# units: pressures in MPa; density is the solid fraction of the volume; "
        "bridged is a fraction of the contacts, rattlers of the particles; residual is the rms force over the mean contact force or "
        "f_a(d), whichever is larger, in every numerics.tolerance_scale; seconds "
        "of wall time since the start\n");
    g_string_append_printf(
        head,
        "# p_MPa: mean pressure over the compressed axes (%s), positive "
        "in compression\n",
        compressed_axes(params));
    const enum gb_curve_columns scene = gb_loading_kind_of(params)->columns;
    g_string_append(head, notes[scene].scene);
    g_string_append(head, notes[scene].columns);
    const struct gb_point_column *row;
    for (size_t r = 0; (row = gb_point_columns_at(r)) != NULL; r++) {
        if (has_columns(row, scene)) {
            g_string_append_printf(head, "%s%s", r > 0 ? "," : "", row->columns);
        }
    }
    g_string_append_c(head, '\n');
    return head;
}

GString *gb_curve_csv_row(const struct gb_point *point, enum gb_curve_columns scene)
{
    char branch[GB_NUMBER_MAX];
    char text[G_ASCII_DTOSTR_BUF_SIZE];
    GString *line = g_string_new(gb_curve_branch_name(point, branch, sizeof branch));
    const struct gb_point_column *row;
    for (size_t r = 1; (row = gb_point_columns_at(r)) != NULL; r++) {
        for (size_t k = 0; has_columns(row, scene) && k < row->count; k++) {
            const double value = gb_point_columns_value(row, point, k);
            if (row->decimals > 0) {
                char format[8];
                g_snprintf(format, sizeof format, "%%.%df", row->decimals);
                g_string_append_printf(line, ",%s",
                                       g_ascii_formatd(text, sizeof text, format, value));
            } else if (row->type == 'q') {
                g_string_append_printf(line, ",%.0f", value);
            } else {
                append_number(line, value);
            }
        }
    }
    g_string_append_c(line, '\n');
    return line;
}

/* Finds a branch by its name in a row; the pressures of unloading branches come from
 * the preset. */
static bool find_branch(const char *name, const struct gb_params *params,
                        struct gb_point *point)
{
    for (int leg = 2; leg <= GB_PATH_LEGS_MAX; leg++) {
        char text[64];
        point->branch = GB_BRANCH_LEG - leg;
        point->branch_from_pa = 0.0;
        if (strcmp(gb_curve_branch_name(point, text, sizeof text), name) == 0) {
            return true;
        }
    }
    for (int branch = GB_BRANCH_LEAST; branch <= params->unload_count; branch++) {
        char text[64];
        point->branch = branch;
        point->branch_from_pa = branch > 0 ? params->unload_from_pa[branch - 1] : 0.0;
        if (strcmp(gb_curve_branch_name(point, text, sizeof text), name) == 0) {
            return true;
        }
    }
    return false;
}

/* A column of the file and the member of struct gb_point that it sets. */
struct column {
    const struct gb_point_column *row;
    size_t k;
    const double *values; /* by row of the file; NULL: no such column */
};

/* The columns of all members of a point; g_array_free. */
static GArray *find_columns(const struct gb_table *table)
{
    GArray *columns = g_array_new(FALSE, FALSE, sizeof(struct column));
    const struct gb_point_column *row;
    for (size_t r = 1; (row = gb_point_columns_at(r)) != NULL; r++) {
        char **names = g_strsplit(row->columns != NULL ? row->columns : "", ",", -1);
        for (size_t k = 0; names[k] != NULL; k++) {
            const struct column column = {row, k, gb_table_column(table, names[k], NULL)};
            g_array_append_val(columns, column);
        }
        g_strfreev(names);
    }
    return columns;
}

bool gb_curve_csv_read(const char *directory, const struct gb_params *params,
                       struct gb_curve *curve, struct gb_error *err)
{
    struct gb_table *table = NULL;
    char *path = g_build_filename(directory, "curve.csv", NULL);
    bool done = gb_table_read(&table, path, "branch", err);
    g_free(path);
    if (!done) {
        return false;
    }
    GArray *columns = find_columns(table);
    for (size_t at = gb_curve_count(curve); done && at < gb_table_rows(table); at++) {
        struct gb_point point = {0};
        for (guint c = 0; c < columns->len; c++) {
            const struct column *column = &g_array_index(columns, struct column, c);
            gb_point_columns_set(column->row, &point, column->k,
                                 column->values != NULL ? column->values[at]
                                                        : (double)NAN);
        }
        done = find_branch(gb_table_word(table, at), params, &point) ||
               gb_error_set(err, GB_ERR_INPUT, "%s/curve.csv: branch %s is not of %s",
                            directory, gb_table_word(table, at), "its preset");
        done = done && gb_curve_append(curve, &point, err);
    }
    g_array_free(columns, TRUE);
    gb_table_destroy(table);
    return done;
}
