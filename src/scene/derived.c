#include "scene/derived.h"

#include <math.h>
#include <string.h>

#include "base/portable.h"
#include "law/law_storakers.h"
#include "scene/field/field.h"
#include "scene/imported/imported.h"
#include "scene/lattice.h"
#include "scene/loading_kind.h"
#include "scene/path/path.h"
#include "scene/size/sizes.h"

/* sigma_b at auto, in E.  With bridges: P1's set II.  Without bridges: no shear spring
 * carries a stress of E, so this is no limit.  P1 calls mu the only free parameter of
 * such scenes; with 0.018 E the strength, not mu, would limit the friction of the
 * finest powders (density differences at 100 MPa would be a fifth too small). */
static const double strength_bridged = 0.018, strength_unlimited = 1.0;

double gb_derived_bridge_length_m(const struct gb_params *params)
{
    return gb_field_absolute(gb_params_find("contact", "bridge_length"), params);
}

double gb_derived_shear_strength_pa(const struct gb_params *params)
{
    if (isnan(params->shear_strength.value)) {
        const bool bridges =
            gb_derived_bridge_length_m(params) < gb_derived_reference_m(params);
        return (bridges ? strength_bridged : strength_unlimited) * params->young_pa;
    }
    return gb_field_absolute(gb_params_find("contact", "shear_strength"), params);
}

double gb_derived_median_m(const struct gb_params *params)
{
    return isnan(params->median_m) ? params->diameter_m : params->median_m;
}

double gb_derived_hollomon_pa(const struct gb_params *params)
{
    return isnan(params->hollomon_pa)
               ? gb_law_storakers_hollomon(params->yield_pa, params->young_pa,
                                           params->hardening)
               : params->hollomon_pa;
}

static double lattice_density(const struct gb_params *params)
{
    const double particle = params->dimension == 2 ? M_PI / 4.0 : M_PI / 6.0;
    double edges[3];
    gb_derived_cell(params, edges);
    return (double)params->count * particle / (edges[0] * edges[1] * edges[2]);
}

double gb_derived_structure_density(const struct gb_params *params)
{
    const struct gb_imported *packing = gb_imported_of(params, NULL);
    if (packing) {
        return gb_imported_density(packing);
    }
    if (gb_lattice_of(params->structure)) {
        return lattice_density(params);
    }
    if (!isnan(params->structure_density)) {
        return params->structure_density;
    }
    return params->dimension == 2 ? 0.5 : 0.24;
}

double gb_derived_unit_time_s(const struct gb_params *params)
{
    return gb_derived_reference_m(params) *
           sqrt(M_PI * params->density_kg_m3 / (6.0 * params->young_pa));
}

double gb_derived_time_step_s(const struct gb_params *params)
{
    return gb_field_absolute(gb_params_find("numerics", "time_step"), params);
}

double gb_derived_reference_m(const struct gb_params *params)
{
    struct gb_sizes sizes;
    return gb_sizes_polydisperse(params) && gb_sizes_init(&sizes, params, NULL)
               ? gb_sizes_moment(&sizes, 1)
               : params->diameter_m;
}

/* Mean of (diameter/d)^3, or squared in 2D: proportional to the solid volume. */
static double mean_power(const struct gb_params *params)
{
    struct gb_sizes sizes;
    const int power = params->dimension;
    return gb_sizes_polydisperse(params) && gb_sizes_init(&sizes, params, NULL)
               ? gb_sizes_moment(&sizes, power) /
                     gb_portable_pow(gb_sizes_moment(&sizes, 1), (double)power)
               : 1.0;
}

/* Base of the initial cell in diameters. auto in 3D: P1's 18 d for 8000 particles at
 * density 0.24; other volumes keep this aspect ratio. */
static double base_edge(const struct gb_params *params, double volume)
{
    if (params->base.relative && params->base.value == 0.0) {
        const double share = (double)params->count * mean_power(params) / 8000.0 *
                             (0.24 / gb_derived_structure_density(params));
        return params->dimension == 2 ? sqrt(volume) : 18.0 * gb_portable_cbrt(share);
    }
    return params->base.relative ? params->base.value
                                 : params->base.value / gb_derived_reference_m(params);
}

void gb_derived_cell(const struct gb_params *params, double edges[3])
{
    const struct gb_imported *packing = gb_imported_of(params, NULL);
    const struct gb_lattice *lattice = gb_lattice_of(params->structure);
    if (packing) {
        memcpy(edges, packing->edges, sizeof packing->edges);
        return;
    }
    if (lattice) {
        gb_lattice_edges(lattice, params->count, params->overlap, edges);
        return;
    }
    const double particle = params->dimension == 2 ? M_PI / 4.0 : M_PI / 6.0;
    const double volume = (double)params->count * mean_power(params) * particle /
                          gb_derived_structure_density(params);
    const double base = base_edge(params, volume);
    edges[0] = base;
    edges[1] = params->dimension == 2 ? 1.0 : base;
    edges[2] = volume / (edges[0] * edges[1]);
}

int gb_derived_geometry(const struct gb_params *params)
{
    struct gb_path path;
    if (gb_loading_kind_follows_path(params) &&
        gb_path_parse(&path, params->path, params->dimension, NULL) && path.count > 0) {
        return gb_path_geometry(&path, params->dimension);
    }
    return params->geometry;
}
