#include "solve/loading/path/strain_tangent.h"

#include <gsl/gsl_linalg.h>
#include <math.h>
#include <string.h>

#include "base/portable.h"
#include "pack/cell/world.h"
#include "scene/tolerances.h"

enum { N = GB_PATH_COMPONENTS };

static const int shear_row[3] = {0, 0, 1}, shear_column[3] = {1, 2, 2};

struct gb_deformation gb_strain_tangent_deformation(const double strain[N])
{
    struct gb_deformation deformation = {{{0.0}}};
    for (int k = 0; k < 3; k++) {
        deformation.f[k][k] = gb_portable_exp(-strain[k]);
        deformation.f[shear_row[k]][shear_column[k]] = strain[3 + k];
    }
    return deformation;
}

void gb_strain_tangent_stress(const struct gb_world *world, double stress[N])
{
    double pressure[3][3];
    gb_world_pressure(world, pressure);
    for (int k = 0; k < 3; k++) {
        const int row = shear_row[k], column = shear_column[k];
        stress[k] = pressure[k][k];
        stress[3 + k] = -0.5 * (pressure[row][column] + pressure[column][row]);
    }
}

/* One column, from the strained packing. */
static bool measure_column(struct gb_strain_tangent *tangent, int column,
                           const double before[N], struct gb_world *world,
                           struct gb_error *err)
{
    double strain[N] = {0.0}, stress[N];
    strain[column] = GB_TANGENT_STRAIN;
    const struct gb_deformation small = gb_strain_tangent_deformation(strain);
    gb_world_deform(world, &small);
    if (!gb_world_evaluate(world, err)) {
        return false;
    }
    gb_strain_tangent_stress(world, stress);
    for (int row = 0; row < N; row++) {
        tangent->k[row][column] = (stress[row] - before[row]) / GB_TANGENT_STRAIN;
    }
    return true;
}

bool gb_strain_tangent_measure(struct gb_strain_tangent *tangent, struct gb_world *world,
                               struct gb_world_copy **good, struct gb_error *err)
{
    const struct gb_model *model = gb_world_model(world);
    double before[N];
    memset(tangent, 0, sizeof *tangent);
    gb_strain_tangent_stress(world, before);
    if (!gb_world_copy_save(world, good, err)) {
        return false;
    }
    for (int column = 0; column < N; column++) {
        tangent->k[column][column] = 1.0; /* stays where the component does not exist */
        if (gb_path_has_component(model->dimension, column) &&
            (column < 3 || model->sheared) &&
            (!measure_column(tangent, column, before, world, err) ||
             !gb_world_copy_restore(world, *good, err))) {
            return false;
        }
    }
    return true;
}

void gb_strain_tangent_learn(struct gb_strain_tangent *tangent, const double strain[N],
                             const double stress[N])
{
    double square = 0.0, missing[N];
    for (int row = 0; row < N; row++) {
        square += strain[row] * strain[row];
        missing[row] = stress[row];
        for (int column = 0; column < N; column++) {
            missing[row] -= tangent->k[row][column] * strain[column];
        }
    }
    for (int row = 0; row < N && square > 0.0; row++) {
        for (int column = 0; column < N; column++) {
            tangent->k[row][column] += missing[row] * strain[column] / square;
        }
    }
}

/* Element of the matrix of the conditions. */
static double element(const struct gb_strain_tangent *tangent,
                      const struct gb_stress_condition *condition, int column)
{
    const double based =
        condition->share != 0.0 ? tangent->k[condition->base][column] : 0.0;
    return tangent->k[condition->of][column] - condition->share * based;
}

/* False: singular. */
static bool solve_linear(double *matrix, double *right, double *solution, size_t count)
{
    gsl_matrix_view a = gsl_matrix_view_array(matrix, count, count);
    gsl_vector_view b = gsl_vector_view_array(right, count);
    gsl_vector_view x = gsl_vector_view_array(solution, count);
    bool finite = gsl_linalg_HH_solve(&a.matrix, &b.vector, &x.vector) == GSL_SUCCESS;
    for (size_t i = 0; i < count; i++) {
        finite = finite && isfinite(solution[i]);
    }
    return finite;
}

bool gb_strain_tangent_solve(const struct gb_strain_tangent *tangent,
                             const struct gb_stress_condition *condition, int count,
                             double strain[N])
{
    double matrix[N * N], right[N], solution[N], given[N];
    if (count == 0) {
        return true;
    }
    memcpy(given, strain, sizeof given);
    for (int i = 0; i < count; i++) {
        given[condition[i].of] = 0.0;
    }
    for (int i = 0; i < count; i++) {
        right[i] = condition[i].change;
        for (int column = 0; column < N; column++) {
            right[i] -= element(tangent, &condition[i], column) * given[column];
        }
        for (int j = 0; j < count; j++) {
            matrix[i * count + j] = element(tangent, &condition[i], condition[j].of);
        }
    }
    if (!solve_linear(matrix, right, solution, (size_t)count)) {
        return false;
    }
    for (int i = 0; i < count; i++) {
        strain[condition[i].of] = solution[i];
    }
    return true;
}
