#include "pack/cell/cell.h"

#include <math.h>

#include "base/mat.h"

/* Rows and columns of the elements of `tilt`; those of `below` are mirrored. */
static const int tilt_row[3] = {0, 0, 1}, tilt_column[3] = {1, 2, 2};

void gb_cell_init(struct gb_cell *cell, int dimension, const double edge[3])
{
    *cell = (struct gb_cell){0};
    for (int k = 0; k < 3; k++) {
        const bool periodic = dimension == 3 || k != 1;
        cell->periodic[k] = periodic;
        cell->edge[k] = periodic ? edge[k] : 1.0;
    }
}

void gb_cell_matrix(const struct gb_cell *cell, double matrix[3][3])
{
    for (int k = 0; k < 3; k++) {
        matrix[k][k] = cell->edge[k];
        matrix[tilt_row[k]][tilt_column[k]] = cell->tilt[k];
        matrix[tilt_column[k]][tilt_row[k]] = cell->below[k];
    }
}

static void set_matrix(struct gb_cell *cell, const double matrix[3][3])
{
    for (int k = 0; k < 3; k++) {
        cell->edge[k] = matrix[k][k];
        cell->tilt[k] = matrix[tilt_row[k]][tilt_column[k]];
        cell->below[k] = matrix[tilt_column[k]][tilt_row[k]];
    }
}

void gb_cell_inverse(const struct gb_cell *cell, double inverse[3][3])
{
    double matrix[3][3];
    gb_cell_matrix(cell, matrix);
    gb_mat_inverse((const double(*)[3])matrix, inverse);
}

void gb_cell_fraction(const struct gb_cell *cell, const double x[3], double fraction[3])
{
    if (gb_cell_tilted(cell)) {
        double inverse[3][3];
        gb_cell_inverse(cell, inverse);
        gb_mat_apply((const double(*)[3])inverse, x, fraction);
        return;
    }
    for (int k = 0; k < 3; k++) {
        fraction[k] = x[k] / cell->edge[k];
    }
}

/* Subtracts whole edge vectors. */
static void subtract_edges(const struct gb_cell *cell, const double whole[3], double x[3])
{
    double matrix[3][3], shift[3];
    gb_cell_matrix(cell, matrix);
    gb_mat_apply((const double(*)[3])matrix, whole, shift);
    gb_vec_add(x, -1.0, shift);
}

static void nearest_tilted(const struct gb_cell *cell, double r[3])
{
    double whole[3];
    gb_cell_fraction(cell, r, whole);
    for (int k = 0; k < 3; k++) {
        whole[k] = cell->periodic[k] ? gb_cell_whole(whole[k]) : 0.0;
    }
    subtract_edges(cell, whole, r);
}

void gb_cell_nearest(const struct gb_cell *cell, double r[3])
{
    if (gb_cell_tilted(cell)) {
        nearest_tilted(cell, r);
        return;
    }
    for (int k = 0; k < 3; k++) {
        if (cell->periodic[k]) {
            r[k] -= cell->edge[k] * gb_cell_whole(r[k] / cell->edge[k]);
        }
    }
}

static void wrap_tilted(const struct gb_cell *cell, double x[3])
{
    double whole[3];
    gb_cell_fraction(cell, x, whole);
    for (int k = 0; k < 3; k++) {
        whole[k] = cell->periodic[k] ? floor(whole[k]) : 0.0;
    }
    subtract_edges(cell, whole, x);
}

void gb_cell_wrap(const struct gb_cell *cell, double x[3])
{
    if (gb_cell_tilted(cell)) {
        wrap_tilted(cell, x);
        return;
    }
    for (int k = 0; k < 3; k++) {
        if (!cell->periodic[k]) {
            continue;
        }
        x[k] -= cell->edge[k] * floor(x[k] / cell->edge[k]);
        /* Rounding: a tiny negative x lands on the far edge, and x just below a multiple
         * of the edge can divide to it and come out negative. */
        if (x[k] >= cell->edge[k] || x[k] < 0.0) {
            x[k] = 0.0;
        }
    }
}

double gb_cell_volume(const struct gb_cell *cell)
{
    if (gb_cell_tilted(cell)) {
        double matrix[3][3];
        gb_cell_matrix(cell, matrix);
        return gb_mat_determinant((const double(*)[3])matrix);
    }
    return cell->edge[0] * cell->edge[1] * cell->edge[2];
}

double gb_cell_spacing(const struct gb_cell *cell, int k)
{
    if (!gb_cell_tilted(cell)) {
        return cell->edge[k];
    }
    double inverse[3][3];
    gb_cell_inverse(cell, inverse);
    return 1.0 / gb_vec_length(inverse[k]);
}

double gb_cell_shortest(const struct gb_cell *cell)
{
    double shortest = INFINITY;
    for (int k = 0; k < 3; k++) {
        if (cell->periodic[k]) {
            shortest = fmin(shortest, gb_cell_spacing(cell, k));
        }
    }
    return shortest;
}

void gb_cell_deform(struct gb_cell *cell, const struct gb_deformation *deformation)
{
    double matrix[3][3], deformed[3][3];
    gb_cell_matrix(cell, matrix);
    gb_mat_product(deformation->f, (const double(*)[3])matrix, deformed);
    set_matrix(cell, (const double(*)[3])deformed);
    for (int k = 0; k < 3; k++) {
        cell->shear[k] += deformation->f[tilt_row[k]][tilt_column[k]] +
                          deformation->f[tilt_column[k]][tilt_row[k]];
    }
}

/* Before^-1 after is near a matrix N of whole numbers, the identity without a fold; the
 * edge vectors before the fold were those of after N^-1. */
struct gb_deformation gb_cell_motion(const struct gb_cell *before,
                                     const struct gb_cell *after)
{
    double inverse[3][3], now[3][3], ratio[3][3], unfolded[3][3];
    struct gb_deformation motion;
    gb_cell_inverse(before, inverse);
    gb_cell_matrix(after, now);
    gb_mat_product((const double(*)[3])inverse, (const double(*)[3])now, ratio);
    for (int k = 0; k < 3; k++) {
        for (int l = 0; l < 3; l++) {
            ratio[k][l] = k == l ? 1.0 : gb_cell_whole(ratio[k][l]);
        }
    }
    gb_mat_inverse((const double(*)[3])ratio, unfolded);
    gb_mat_product((const double(*)[3])now, (const double(*)[3])unfolded, ratio);
    gb_mat_product((const double(*)[3])ratio, (const double(*)[3])inverse, motion.f);
    return motion;
}

/* Subtracts whole edges from a tilt; returns how many. */
static double fold(double *tilt, double edge)
{
    const double whole = gb_cell_whole(*tilt / edge);
    *tilt -= whole * edge;
    return whole;
}

bool gb_cell_fold(struct gb_cell *cell)
{
    const double along_y = fold(&cell->tilt[2], cell->edge[1]);
    cell->tilt[1] -= along_y * cell->tilt[0]; /* c moved by whole vectors b */
    const double along_x = fold(&cell->tilt[1], cell->edge[0]);
    return fold(&cell->tilt[0], cell->edge[0]) != 0.0 || along_x != 0.0 || along_y != 0.0;
}
