#include <math.h>

#include "figures/figures_compute.h"
#include "figures/figures_label.h"

/* The ratio is left out while the axial stress is below this fraction of its maximum: the
 * quotient of two small stresses is noise. */
static const double min_fraction = 0.01;

/* Replaces p_x of every run by p_x / p_z. */
static void divide(struct gb_series_sample *lateral, const struct gb_series_sample *axial,
                   size_t runs)
{
    for (size_t i = 0; i < runs; i++) {
        double *x = lateral->rows + i * lateral->size;
        const double *z = axial->rows + i * axial->size;
        double max = 0.0;
        for (size_t k = 0; k < lateral->size; k++) {
            max = isnan(z[k]) ? max : fmax(max, z[k]);
        }
        bool large = true; /* from here to the end of loading */
        for (size_t k = lateral->size; k > 0; k--) {
            large = large && !(z[k - 1] <= min_fraction * max);
            x[k - 1] = large ? x[k - 1] / z[k - 1] : NAN;
        }
    }
}

bool gb_figures_lateral(struct gb_series *series, const struct gb_figures_input *input,
                        struct gb_error *err)
{
    struct gb_series_sample lateral;
    struct gb_series_sample axial = {0};
    const struct gb_runset *set = input->set;
    if (!gb_series_sample(&lateral, set, "load", "density", "px_MPa", err)) {
        return false;
    }
    bool good = gb_series_sample(&axial, set, "load", "density", "pz_MPa", err);
    if (good) {
        divide(&lateral, &axial, set->count);
        gb_series_init(series, lateral.size);
        gb_figures_label_note(series, set);
        gb_series_note(series, "left out below %g of the maximum of pz", min_fraction);
        const double *grid = gb_series_sample_grid(series, &lateral, "density");
        good = gb_figures_label_means(series, &lateral, set, grid, "ratio", "", err);
    }
    gb_series_sample_finish(&axial);
    gb_series_sample_finish(&lateral);
    return good;
}
