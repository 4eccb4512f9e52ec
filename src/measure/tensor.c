#include "measure/tensor.h"

#include <math.h>

#include "base/mat.h"

static double counted(int k, int dimension)
{
    return dimension == 3 || k != 1 ? 1.0 : 0.0;
}

double gb_tensor_mean(const double tensor[3][3], int dimension)
{
    double sum = 0.0;
    for (int k = 0; k < 3; k++) {
        sum += counted(k, dimension) * tensor[k][k];
    }
    return sum / dimension;
}

/* Deviator of the symmetric part; returns s:s. */
static double deviator(const double tensor[3][3], int dimension, double s[3][3])
{
    const double mean = gb_tensor_mean(tensor, dimension);
    double square = 0.0;
    for (int k = 0; k < 3; k++) {
        for (int l = 0; l < 3; l++) {
            const double normal = k == l ? mean : 0.0;
            s[k][l] = counted(k, dimension) * counted(l, dimension) *
                      (0.5 * (tensor[k][l] + tensor[l][k]) - normal);
            square += s[k][l] * s[k][l];
        }
    }
    return square;
}

double gb_tensor_deviatoric(const double tensor[3][3], int dimension)
{
    double s[3][3];
    return sqrt((dimension == 3 ? 1.5 : 2.0) * deviator(tensor, dimension, s));
}

double gb_tensor_asymmetry(const double tensor[3][3], int dimension)
{
    const double xz = tensor[0][2] - tensor[2][0];
    const double xy = counted(1, dimension) * (tensor[0][1] - tensor[1][0]);
    const double yz = counted(1, dimension) * (tensor[1][2] - tensor[2][1]);
    const double mean = gb_tensor_mean(tensor, dimension);
    return mean != 0.0 ? sqrt(0.5 * (xy * xy + xz * xz + yz * yz)) / fabs(mean)
                       : (double)NAN;
}

/* The eigenvalues of a deviator in 3D are 2 sqrt(J2/3) cos(phi + 2 pi k/3), where
 * cos(3 phi) = (3 sqrt(3)/2) J3/J2^1.5. */
double gb_tensor_largest_deviator(const double tensor[3][3], int dimension)
{
    double s[3][3];
    const double j2 = 0.5 * deviator(tensor, dimension, s);
    if (dimension == 2 || j2 == 0.0) {
        return sqrt(j2);
    }
    const double j3 = gb_mat_determinant((const double(*)[3])s);
    const double cosine = 1.5 * sqrt(3.0) * j3 / (j2 * sqrt(j2));
    return 2.0 * sqrt(j2 / 3.0) * cos(acos(fmax(-1.0, fmin(1.0, cosine))) / 3.0);
}

/* Sum over weight; NaN without a weight. */
static void mean_tensor(const struct gb_fabric_sums *sums, int kind, double tensor[3][3])
{
    static const int component[3][3] = {{0, 3, 4}, {3, 1, 5}, {4, 5, 2}};
    for (int a = 0; a < 9; a++) {
        tensor[a / 3][a % 3] =
            sums->tensor[kind][component[a / 3][a % 3]] / sums->weight[kind];
    }
}

void gb_tensor_fabric(const struct gb_world *world, double pressure[3][3],
                      struct gb_fabric *fabric)
{
    const int dimension = gb_world_model(world)->dimension;
    struct gb_fabric_sums sums = {.weight = {0}};
    gb_world_tensors(world, pressure, &sums);
    for (int kind = 0; kind < GB_FABRIC_KINDS; kind++) {
        double tensor[3][3];
        mean_tensor(&sums, kind, tensor);
        fabric->anisotropy[kind] =
            (dimension == 3 ? 1.5 : 2.0) *
            gb_tensor_largest_deviator((const double(*)[3])tensor, dimension);
    }
    for (int k = 0; k < 6; k++) {
        fabric->all[k] = sums.tensor[GB_FABRIC_ALL][k] / sums.weight[GB_FABRIC_ALL];
    }
}
