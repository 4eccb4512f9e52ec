#include "measure/elastic.h"

#include <math.h>
#include <string.h>

enum { SIZE = 6 };

static void symmetric_part(const double c[6][6], double out[6][6])
{
    for (int m = 0; m < SIZE; m++) {
        for (int n = 0; n < SIZE; n++) {
            out[m][n] = 0.5 * (c[m][n] + c[n][m]);
        }
    }
}

/* Row of the largest element of a column, from its diagonal on. */
static int pivot_row(const double a[6][6], int column)
{
    int row = column;
    for (int m = column; m < SIZE; m++) {
        row = fabs(a[m][column]) > fabs(a[row][column]) ? m : row;
    }
    return row;
}

static void exchange(double a[6][6], int m, int n)
{
    double row[6];
    memcpy(row, a[m], sizeof row);
    memcpy(a[m], a[n], sizeof row);
    memcpy(a[n], row, sizeof row);
}

/* a[m] -= factor a[n] */
static void subtract(double a[6][6], int m, double factor, int n)
{
    for (int k = 0; k < SIZE; k++) {
        a[m][k] -= factor * a[n][k];
    }
}

/* Gauss and Jordan's elimination; a is used up.  False for a singular matrix. */
static bool invert(double a[6][6], double inverse[6][6])
{
    for (int m = 0; m < SIZE; m++) {
        for (int n = 0; n < SIZE; n++) {
            inverse[m][n] = m == n ? 1.0 : 0.0;
        }
    }
    for (int column = 0; column < SIZE; column++) {
        const int row = pivot_row((const double(*)[6])a, column);
        const double pivot = a[row][column];
        if (!(fabs(pivot) > 0.0)) {
            return false;
        }
        exchange(a, row, column);
        exchange(inverse, row, column);
        for (int k = 0; k < SIZE; k++) {
            a[column][k] /= pivot;
            inverse[column][k] /= pivot;
        }
        for (int m = 0; m < SIZE; m++) {
            const double factor = a[m][column];
            if (m != column) {
                subtract(a, m, factor, column);
                subtract(inverse, m, factor, column);
            }
        }
    }
    return true;
}

/* Sums of the diagonal of normal components, of the elements beside it, of the shears. */
struct sums {
    double normal, cross, shear;
};

static struct sums sums_of(const double c[6][6])
{
    return (struct sums){c[0][0] + c[1][1] + c[2][2], c[0][1] + c[0][2] + c[1][2],
                         c[3][3] + c[4][4] + c[5][5]};
}

struct gb_elastic_averages gb_elastic_average(const double c[6][6])
{
    double stiffness[6][6], work[6][6], compliance[6][6];
    const double none = (double)NAN;
    symmetric_part(c, stiffness);
    memcpy(work, stiffness, sizeof work);
    if (!invert(work, compliance)) {
        return (struct gb_elastic_averages){none, none, none, none,
                                            none, none, none, none};
    }
    const struct sums k = sums_of((const double(*)[6])stiffness);
    const struct sums s = sums_of((const double(*)[6])compliance);
    struct gb_elastic_averages out = {
        .bulk_voigt = (k.normal + 2.0 * k.cross) / 9.0,
        .bulk_reuss = 1.0 / (s.normal + 2.0 * s.cross),
        .shear_voigt = (k.normal - k.cross + 3.0 * k.shear) / 15.0,
        .shear_reuss = 15.0 / (4.0 * (s.normal - s.cross) + 3.0 * s.shear),
    };
    out.bulk = 0.5 * (out.bulk_voigt + out.bulk_reuss);
    out.shear = 0.5 * (out.shear_voigt + out.shear_reuss);
    out.young = 9.0 * out.bulk * out.shear / (3.0 * out.bulk + out.shear);
    out.poisson =
        (3.0 * out.bulk - 2.0 * out.shear) / (2.0 * (3.0 * out.bulk + out.shear));
    return out;
}

/* Squared norm of the fourth-rank tensor of a matrix: a shear index stands for two
 * equal components. */
static double norm2(const double c[6][6])
{
    double sum = 0.0;
    for (int m = 0; m < SIZE; m++) {
        for (int n = 0; n < SIZE; n++) {
            sum += (m < 3 ? 1.0 : 2.0) * (n < 3 ? 1.0 : 2.0) * c[m][n] * c[m][n];
        }
    }
    return sum;
}

static double misfit(const double c[6][6], const struct gb_elastic_axial *of)
{
    const double c66 = 0.5 * (of->c11 - of->c12);
    double left[6][6] = {{of->c11, of->c12, of->c13, 0, 0, 0},
                         {of->c12, of->c11, of->c13, 0, 0, 0},
                         {of->c13, of->c13, of->c33, 0, 0, 0},
                         {0, 0, 0, of->c44, 0, 0},
                         {0, 0, 0, 0, of->c44, 0},
                         {0, 0, 0, 0, 0, c66}};
    for (int k = 0; k < SIZE * SIZE; k++) {
        left[k / SIZE][k % SIZE] -= c[k / SIZE][k % SIZE];
    }
    return sqrt(norm2((const double(*)[6])left) / norm2(c));
}

struct gb_elastic_axial gb_elastic_project(const double c[6][6])
{
    double k[6][6];
    symmetric_part(c, k);
    const double sum = k[0][0] + k[1][1];
    struct gb_elastic_axial out = {
        .c11 = 0.375 * sum + 0.25 * k[0][1] + 0.5 * k[5][5],
        .c12 = 0.125 * sum + 0.75 * k[0][1] - 0.5 * k[5][5],
        .c13 = 0.5 * (k[0][2] + k[1][2]),
        .c33 = k[2][2],
        .c44 = 0.5 * (k[3][3] + k[4][4]),
    };
    out.misfit = misfit((const double(*)[6])k, &out);
    return out;
}

/* Pressures by a strain of the normal components: both change sign together. */
static void press(const double c[6][6], const double strain[3], double slope[2])
{
    double p[3] = {0.0, 0.0, 0.0};
    for (int m = 0; m < 3; m++) {
        for (int n = 0; n < 3; n++) {
            p[m] += c[m][n] * strain[n];
        }
    }
    slope[0] = (p[0] + p[1] + p[2]) / 3.0;
    slope[1] = p[2] - 0.5 * (p[0] + p[1]);
}

void gb_elastic_plane(const double c[6][6], double by_volume[2], double by_shear[2])
{
    static const double volume[3] = {1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0};
    static const double shear[3] = {-0.5, -0.5, 1.0};
    press(c, volume, by_volume);
    press(c, shear, by_shear);
}

struct gb_elastic_waves gb_elastic_wave_speeds(const struct gb_elastic_axial *axial,
                                               double density_kg_m3)
{
    return (struct gb_elastic_waves){
        .p_along = sqrt(axial->c33 / density_kg_m3),
        .p_across = sqrt(axial->c11 / density_kg_m3),
        .s_along = sqrt(axial->c44 / density_kg_m3),
        .s_across = sqrt(0.5 * (axial->c11 - axial->c12) / density_kg_m3),
    };
}
