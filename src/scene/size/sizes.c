#include "scene/size/sizes.h"

#include <math.h>

#include "base/portable.h"
#include "scene/derived.h"
#include "scene/imported/imported.h"
#include "scene/loading_kind.h"
#include "scene/size/gaussian.h"
#include "scene/size/size_table.h"

/* Probability of a standard normal between a and b, without loss in either tail. */
static double between(double a, double b)
{
    return a > 0.0 ? gb_gaussian_above(a) - gb_gaussian_above(b)
                   : gb_gaussian_below(b) - gb_gaussian_below(a);
}

/* Shares by number, summed up.  A share of the volume is divided by that of one sphere.
 */
static void freeze_table(struct gb_sizes *sizes, const struct gb_sizetable *table)
{
    double sum = 0.0;
    sizes->rows = table->count;
    for (int i = 0; i < table->count; i++) {
        const struct gb_sizetable_row *row = &table->row[i];
        const double ratio = row->diameter_m / table->row[0].diameter_m;
        sum += table->by_volume ? row->fraction / (ratio * ratio * ratio) : row->fraction;
        sizes->diameter_m[i] = row->diameter_m;
        sizes->below[i] = sum;
    }
    for (int i = 0; i < table->count; i++) {
        sizes->below[i] /= sum;
    }
}

static double cut_at(const struct gb_sizes *sizes, double diameter_m, double uncut)
{
    return isnan(diameter_m)
               ? uncut
               : gb_portable_log(diameter_m / sizes->median_m) / sizes->sigma;
}

bool gb_sizes_polydisperse(const struct gb_params *params)
{
    const struct gb_imported *packing = gb_imported_of(params, NULL);
    return gb_loading_kind_of(params)->periodic_cell &&
           (packing ? !packing->one_size : params->distribution != GB_DISTRIBUTION_MONO);
}

bool gb_sizes_init(struct gb_sizes *sizes, const struct gb_params *params,
                   struct gb_error *err)
{
    if (!gb_size_table_check(&params->sizes, NULL, err) ||
        !gb_size_table_check_params(params, err)) {
        return false;
    }
    *sizes = (struct gb_sizes){.packing = gb_imported_of(params, NULL),
                               .distribution = params->distribution,
                               .median_m = params->diameter_m};
    if (params->distribution == GB_DISTRIBUTION_LOGNORMAL) {
        sizes->median_m = gb_derived_median_m(params);
        sizes->sigma = params->sigma;
        sizes->z_least = cut_at(sizes, params->diameter_min_m, -INFINITY);
        sizes->z_largest = cut_at(sizes, params->diameter_max_m, INFINITY);
    } else if (params->distribution == GB_DISTRIBUTION_TABLE) {
        freeze_table(sizes, &params->sizes);
    }
    return true;
}

/* Quantile of the cut law, as z; share from 0 to 1. */
static double quantile(const struct gb_sizes *sizes, double share)
{
    const double low = sizes->z_least, high = sizes->z_largest;
    const double mass = between(low, high);
    const double below = gb_gaussian_below(low) + share * mass;
    const double above = gb_gaussian_above(high) + (1.0 - share) * mass;
    const double z = below < 0.5 ? gb_gaussian_quantile_below(below)
                                 : gb_gaussian_quantile_above(above);
    return fmin(fmax(z, low), high);
}

/* The third moment between a and b over their probability, as a diameter. */
static double stratum_diameter(const struct gb_sizes *sizes, double a, double b,
                               double probability)
{
    const double s = sizes->sigma;
    const double third =
        gb_portable_exp(4.5 * s * s) * between(a - 3.0 * s, b - 3.0 * s) / probability;
    return sizes->median_m * fmin(fmax(gb_portable_cbrt(third), gb_portable_exp(s * a)),
                                  gb_portable_exp(s * b));
}

static void fill_lognormal(const struct gb_sizes *sizes, int64_t count,
                           double *diameter_m)
{
    const double n = (double)count;
    const double probability = between(sizes->z_least, sizes->z_largest) / n;
    double low = sizes->z_least;
    for (int64_t i = 0; i < count; i++) {
        const double high =
            i + 1 < count ? quantile(sizes, (double)(i + 1) / n) : sizes->z_largest;
        diameter_m[i] = stratum_diameter(sizes, low, high, probability);
        low = high;
    }
}

static void fill_table(const struct gb_sizes *sizes, int64_t count, double *diameter_m)
{
    int row = 0;
    for (int64_t i = 0; i < count; i++) {
        const double middle = ((double)i + 0.5) / (double)count;
        while (row + 1 < sizes->rows && sizes->below[row] < middle) {
            row++;
        }
        diameter_m[i] = sizes->diameter_m[row];
    }
}

void gb_sizes_fill(const struct gb_sizes *sizes, int64_t count, double *diameter_m)
{
    if (sizes->packing) {
        for (int64_t i = 0; i < count; i++) {
            diameter_m[i] = sizes->packing->diameter[i] * sizes->median_m;
        }
    } else if (sizes->distribution == GB_DISTRIBUTION_LOGNORMAL) {
        fill_lognormal(sizes, count, diameter_m);
    } else if (sizes->distribution == GB_DISTRIBUTION_TABLE) {
        fill_table(sizes, count, diameter_m);
    } else {
        for (int64_t i = 0; i < count; i++) {
            diameter_m[i] = sizes->median_m;
        }
    }
}

void gb_sizes_range(const struct gb_sizes *sizes, int64_t count, double *least,
                    double *largest)
{
    const double n = (double)count,
                 probability = between(sizes->z_least, sizes->z_largest) / n;
    *least = *largest = sizes->median_m;
    if (sizes->packing) {
        *least *= sizes->packing->least;
        *largest *= sizes->packing->largest;
    } else if (sizes->distribution == GB_DISTRIBUTION_LOGNORMAL) {
        const double low = quantile(sizes, 1.0 / n),
                     high = quantile(sizes, 1.0 - 1.0 / n);
        *least = stratum_diameter(sizes, sizes->z_least, low, probability);
        *largest = stratum_diameter(sizes, high, sizes->z_largest, probability);
    } else if (sizes->distribution == GB_DISTRIBUTION_TABLE) {
        *least = sizes->diameter_m[0];
        *largest = sizes->diameter_m[sizes->rows - 1];
    }
}

double gb_sizes_moment(const struct gb_sizes *sizes, int power)
{
    if (sizes->distribution == GB_DISTRIBUTION_TABLE) {
        double sum = 0.0;
        for (int i = 0; i < sizes->rows; i++) {
            const double share = sizes->below[i] - (i > 0 ? sizes->below[i - 1] : 0.0);
            sum += share * gb_portable_pow(sizes->diameter_m[i], power);
        }
        return sum;
    }
    const double mono = gb_portable_pow(sizes->median_m, power);
    if (sizes->packing) {
        return mono * sizes->packing->moment[power];
    }
    if (sizes->distribution == GB_DISTRIBUTION_MONO) {
        return mono;
    }
    const double shift = power * sizes->sigma;
    return mono * gb_portable_exp(0.5 * shift * shift) *
           between(sizes->z_least - shift, sizes->z_largest - shift) /
           between(sizes->z_least, sizes->z_largest);
}

double gb_sizes_mean_volume(const struct gb_sizes *sizes)
{
    return M_PI / 6.0 * gb_sizes_moment(sizes, 3);
}
