#include <math.h>

#include <glib.h>

#include "base/units.h"
#include "scene/derived.h"
#include "scene/field/changes.h"
#include "scene/field/field.h"
#include "scene/field/keep_points.h"
#include "scene/imported/imported.h"
#include "scene/lattice.h"
#include "scene/loading_kind.h"
#include "scene/normal_law.h"
#include "scene/path/path.h"
#include "scene/size/size_table.h"
#include "scene/size/sizes.h"

/* Name of the choice stored in a member. */
static char *choice(const struct gb_params *params, const char *group, const char *key,
                    char *buffer, size_t size)
{
    return gb_field_write(gb_params_find(group, key), params, buffer, size);
}

/* Checks each value against its row, because the caller may have filled the struct
 * without gb_params_set. */
bool gb_params_check_fields(const struct gb_params *params, struct gb_error *err)
{
    size_t count = 0;
    const struct gb_field *fields = gb_params_fields(&count);
    for (size_t i = 0; i < count; i++) {
        if (!gb_field_valid(&fields[i], params)) {
            char value[256], accepted[256];
            gb_params_format(params, &fields[i], value, sizeof value);
            gb_field_accepted_sentence(&fields[i], accepted, sizeof accepted);
            return gb_error_set(err, GB_ERR_INPUT, "%s.%s = %.80s: must be %s",
                                fields[i].group, fields[i].key, value, accepted);
        }
    }
    return true;
}

/* Largest over mean particle diameter. */
static double largest_over_mean(const struct gb_params *params)
{
    struct gb_sizes sizes;
    double smallest = 1.0, largest = 1.0;
    if (!gb_sizes_polydisperse(params) || !gb_sizes_init(&sizes, params, NULL)) {
        return 1.0;
    }
    gb_sizes_range(&sizes, params->count, &smallest, &largest);
    return largest / gb_sizes_moment(&sizes, 1);
}

/* Minimum image convention: an edge must be at least twice the interaction range, else a
 * pair would interact through two images. */
static bool check_cell(const struct gb_params *params, struct gb_error *err)
{
    static const char axes[] = "xyz";
    double range = 1.5;
    if (!isnan(params->cutoff.value)) {
        const double cutoff =
            gb_field_absolute(gb_params_find("numerics", "cutoff"), params);
        range = fmax(range, cutoff / gb_derived_reference_m(params));
    }
    range += largest_over_mean(params) - 1.0;
    double edges[3];
    gb_derived_cell(params, edges);
    const struct gb_imported *packing = gb_imported_of(params, NULL);
    for (int k = 0; k < 3; k++) {
        edges[k] = packing ? gb_imported_spacing(packing, k) : edges[k];
        if ((params->dimension == 3 || k != 1) && !(edges[k] >= 2.0 * range)) {
            if (gb_imported_given(params)) {
                return gb_error_set(err, GB_ERR_INPUT,
                                    "structure.from = %.200s: a cell of %.3g d along %c: "
                                    "must be at least %g d",
                                    params->from.path, edges[k], axes[k], 2.0 * range);
            }
            return gb_error_set(err, GB_ERR_INPUT,
                                "particles.count = %" G_GINT64_FORMAT
                                " and structure.base give a cell of %.3g d along %c: "
                                "must be at least %g d",
                                params->count, edges[k], axes[k], 2.0 * range);
        }
    }
    return true;
}

static bool check_loading(const struct gb_params *params, struct gb_error *err)
{
    const double start = gb_derived_structure_density(params);
    if (params->geometry == GB_GEOMETRY_DIE) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "loading.geometry = die: must be uniaxial (a closed die), "
                            "biaxial or isotropic with scene.kind = %s",
                            gb_loading_kind_of(params)->name);
    }
    if (gb_loading_kind_follows_path(params)) {
        struct gb_path path;
        return gb_path_parse(&path, params->path, params->dimension, err);
    }
    if (!isnan(params->until_density) && !(params->until_density > start)) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "loading.until = density = %g: must be above %s %g",
                            params->until_density,
                            gb_imported_given(params) ? "the density of structure.from,"
                                                      : "structure.density =",
                            start);
    }
    if (!isnan(params->until_pressure_pa) && params->unload_count > 0) {
        char from[64], until[64];
        const double last = params->unload_from_pa[params->unload_count - 1];
        if (last > params->until_pressure_pa) {
            gb_units_format(last, GB_DIM_PRESSURE, from, sizeof from);
            gb_units_format(params->until_pressure_pa, GB_DIM_PRESSURE, until,
                            sizeof until);
            return gb_error_set(err, GB_ERR_INPUT,
                                "loading.unload_from = %s: must be at most "
                                "loading.until = %s",
                                from, until);
        }
    }
    if (params->dimension == 2 && params->geometry == GB_GEOMETRY_BIAXIAL) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "loading.geometry = biaxial: must be uniaxial or isotropic "
                            "with scene.dimension = 2, which has the axes x and z only");
    }
    return true;
}

static bool check_normal(const struct gb_params *params, struct gb_error *err)
{
    char distribution[32];
    const struct gb_normal_law *law = gb_normal_law_of(params);
    if (law->one_size && gb_sizes_polydisperse(params)) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "contact.normal = %s: must be rod with "
                            "particles.distribution = %s",
                            law->name,
                            choice(params, "particles", "distribution", distribution,
                                   sizeof distribution));
    }
    return gb_loading_kind_check_normal(params, err);
}

/* Checks the requirements of scenes in a periodic cell. */
static bool check_periodic(const struct gb_params *params, struct gb_error *err)
{
    return check_normal(params, err) &&
           (gb_imported_given(params) || gb_lattice_check(params, err)) &&
           check_cell(params, err) && check_loading(params, err);
}

bool gb_params_check(const struct gb_params *params, struct gb_error *err)
{
    struct gb_keep_points points;
    if (!gb_params_check_fields(params, err) ||
        !gb_size_table_check_params(params, err) ||
        !gb_imported_check_params(params, err) ||
        !gb_keep_points_parse(params->snapshots_at, &points, err)) {
        return false;
    }
    if (params->export_format != GB_LIVE_NONE && points.count == 0 && points.every == 0) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "output.export: writes only states that output.snapshots_at "
                            "keeps, which has no points; expected none, or points in "
                            "output.snapshots_at");
    }
    const struct gb_loading_kind *kind = gb_loading_kind_of(params);
    return (!kind->periodic_cell || check_periodic(params, err)) &&
           kind->check(params, err) && gb_changes_check(params, err);
}
