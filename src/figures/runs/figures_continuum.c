#include "figures/figures_compute.h"

#include <math.h>

#include "base/alloc.h"
#include "figures/figures_label.h"
#include "measure/fit/average.h"
#include "measure/hardening.h"

/* Points of a theoretical curve. */
enum { THEORY_POINTS = 400 };

/* Pressures of the densities in the notes, as in P1; MPa. */
static const double compared_mpa[] = {100.0, 200.0};

static const struct geometry {
    int geometry;
    const char *name;
} geometries[] = {{GB_GEOMETRY_UNIAXIAL, "uniaxial"},
                  {GB_GEOMETRY_BIAXIAL, "biaxial"},
                  {GB_GEOMETRY_ISOTROPIC, "isotropic"}};

/* First uniaxial group, the source of the hardening law. */
static bool find_uniaxial(const struct gb_runset *set, size_t *group,
                          struct gb_error *err)
{
    for (*group = 0; *group < set->groups; (*group)++) {
        if (gb_runset_first(set, *group)->params.geometry == GB_GEOMETRY_UNIAXIAL) {
            return true;
        }
    }
    return gb_error_set(err, GB_ERR_INPUT,
                        "continuum: the hardening law is taken from uniaxial pressing; "
                        "accepted runs of which one has loading.geometry = uniaxial");
}

/* Hardening law from the mean curve of a group where it is defined. */
static bool fit_law(struct gb_hardening *law, const struct gb_series_sample *sample,
                    const struct gb_runset *set, size_t group, struct gb_error *err)
{
    double *density = g_new(double, sample->size + 1);
    double *pressure = g_new(double, sample->size + 1);
    double *error = g_new(double, sample->size + 1);
    size_t count = 0;
    bool good = gb_series_mean(sample, set, group, pressure, error, err);
    for (size_t i = 0; i < sample->size && good; i++) {
        if (isfinite(pressure[i])) {
            density[count] = sample->grid[i];
            pressure[count++] = 1e6 * pressure[i];
        }
    }
    good = good &&
           gb_hardening_init(law, GB_GEOMETRY_UNIAXIAL, density, pressure, count, err);
    g_free(density);
    g_free(pressure);
    g_free(error);
    return good;
}

/* Theoretical densities at the compared pressures. */
static void note_densities(struct gb_series *series, const char *name,
                           const double *density, const double *mpa)
{
    const struct gb_average_curve curve = {mpa, density, THEORY_POINTS};
    for (size_t k = 0; k < G_N_ELEMENTS(compared_mpa); k++) {
        const double at = gb_average_crossing(&curve, compared_mpa[k], NULL);
        if (isfinite(at)) {
            gb_series_note(series, "continuum theory, %s: density %.4f at %g MPa", name,
                           at, compared_mpa[k]);
        }
    }
}

static void draw_theory(struct gb_series *series, const struct gb_hardening *law,
                        size_t groups)
{
    for (size_t g = 0; g < G_N_ELEMENTS(geometries); g++) {
        const int geometry = geometries[g].geometry;
        const double end = gb_hardening_density_max(law, geometry);
        double *density =
            gb_series_column(series, "density_theory_%s", geometries[g].name);
        double *mpa = gb_series_column(series, "theory_%s_MPa", geometries[g].name);
        for (size_t i = 0; i < THEORY_POINTS; i++) {
            density[i] =
                law->start + (end - law->start) * (double)i / (THEORY_POINTS - 1);
            mpa[i] = 1e-6 * gb_hardening_pressure(law, geometry, density[i]);
        }
        note_densities(series, geometries[g].name, density, mpa);
        if (geometry == GB_GEOMETRY_UNIAXIAL) {
            continue; /* the source of the law */
        }
        char *label = g_strdup_printf("theory, %s", geometries[g].name);
        gb_series_draw(series, density, mpa, NULL, GB_FIGURE_LINE, (int)(groups + g),
                       label);
        g_free(label);
    }
}

bool gb_figures_continuum(struct gb_series *series, const struct gb_figures_input *input,
                          struct gb_error *err)
{
    const struct gb_runset *set = input->set;
    struct gb_series_sample sample;
    struct gb_hardening law = {0};
    size_t uniaxial = 0;
    if (!find_uniaxial(set, &uniaxial, err) ||
        !gb_series_sample(&sample, set, "load", "density", "p_MPa", err)) {
        return false;
    }
    gb_series_init(series, sample.size > THEORY_POINTS ? sample.size : THEORY_POINTS);
    gb_figures_label_note(series, set);
    gb_series_note(series, "continuum theory: P1 (18)-(23), hardening law of group %zu",
                   uniaxial + 1);
    const double *grid = gb_series_sample_grid(series, &sample, "density");
    bool good = gb_figures_label_means(series, &sample, set, grid, "mean", "_MPa", err) &&
                fit_law(&law, &sample, set, uniaxial, err);
    if (good) {
        draw_theory(series, &law, set->groups);
    }
    gb_hardening_finish(&law);
    gb_series_sample_finish(&sample);
    return good;
}
