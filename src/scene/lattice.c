#include "scene/lattice.h"

#include <inttypes.h>
#include <math.h>
#include <stddef.h>

#include "scene/size/sizes.h"

#define ROOT_2      1.4142135623730951 /* sqrt 2 */
#define ROOT_3      1.7320508075688772 /* sqrt 3 */
#define TWO_ROOT_3  1.1547005383792515 /* 2 / sqrt 3 */
#define FOUR_ROOT_3 2.3094010767585031 /* 4 / sqrt 3 */

/* Points avoid the faces of the cell, where rounding would decide on their periodic
 * image. */
static const struct gb_lattice table[] = {
    [GB_STRUCTURE_SC] = {3, 1, {1.0, 1.0, 1.0}, {{0.5, 0.5, 0.5}}},
    [GB_STRUCTURE_FCC] = {3,
                          4,
                          {ROOT_2, ROOT_2, ROOT_2},
                          {{0.25, 0.25, 0.25},
                           {0.25, 0.75, 0.75},
                           {0.75, 0.25, 0.75},
                           {0.75, 0.75, 0.25}}},
    [GB_STRUCTURE_BCC] = {3,
                          2,
                          {TWO_ROOT_3, TWO_ROOT_3, TWO_ROOT_3},
                          {{0.25, 0.25, 0.25}, {0.75, 0.75, 0.75}}},
    [GB_STRUCTURE_DIAMOND] = {3,
                              8,
                              {FOUR_ROOT_3, FOUR_ROOT_3, FOUR_ROOT_3},
                              {{0.125, 0.125, 0.125},
                               {0.125, 0.625, 0.625},
                               {0.625, 0.125, 0.625},
                               {0.625, 0.625, 0.125},
                               {0.375, 0.375, 0.375},
                               {0.375, 0.875, 0.875},
                               {0.875, 0.375, 0.875},
                               {0.875, 0.875, 0.375}}},
    [GB_STRUCTURE_SQUARE] = {2, 1, {1.0, 0.0, 1.0}, {{0.5, 0.0, 0.5}}},
    [GB_STRUCTURE_HEXAGONAL] = {2,
                                2,
                                {1.0, 0.0, ROOT_3},
                                {{0.25, 0.0, 0.25}, {0.75, 0.0, 0.75}}},
};

/* Longest over shortest edge of a block. */
static const double ratio_max = 2.0;

const struct gb_lattice *gb_lattice_of(int structure)
{
    return structure > GB_STRUCTURE_GROWN &&
                   structure < (int)(sizeof table / sizeof table[0])
               ? &table[structure]
               : NULL;
}

static double edge_ratio(const struct gb_lattice *lattice, const int64_t cells[3])
{
    double least = INFINITY, most = 0.0;
    for (int k = 0; k < 3; k++) {
        const double edge = (double)cells[k] * lattice->cell[k];
        if (edge > 0.0) {
            least = fmin(least, edge);
            most = fmax(most, edge);
        }
    }
    return most / least;
}

/* Keeps the better of two blocks. */
static void consider(const struct gb_lattice *lattice, int64_t x, int64_t y, int64_t z,
                     double *best, int64_t cells[3])
{
    const int64_t block[3] = {x, y, z};
    const double ratio = edge_ratio(lattice, block);
    if (ratio < *best) {
        *best = ratio;
        for (int k = 0; k < 3; k++) {
            cells[k] = block[k];
        }
    }
}

bool gb_lattice_block(const struct gb_lattice *lattice, int64_t count, int64_t cells[3])
{
    const int64_t all = count / lattice->particles;
    double best = INFINITY;
    cells[0] = cells[1] = 1;
    cells[2] = all > 0 ? all : 1;
    for (int64_t x = 1; lattice->dimension == 2 && x <= all; x++) {
        if (all % x == 0) {
            consider(lattice, x, 1, all / x, &best, cells);
        }
    }
    for (int64_t x = 1; lattice->dimension == 3 && x * x * x <= all; x++) {
        for (int64_t y = x; all % x == 0 && y * y <= all / x; y++) {
            if (all / x % y ==
                0) { /* cubic unit cells: one order of the edges is enough */
                consider(lattice, x, y, all / x / y, &best, cells);
            }
        }
    }
    return all > 0 && all * lattice->particles == count && best <= ratio_max;
}

void gb_lattice_edges(const struct gb_lattice *lattice, int64_t count, double overlap,
                      double edges[3])
{
    int64_t cells[3];
    (void)gb_lattice_block(lattice, count, cells);
    for (int k = 0; k < 3; k++) {
        edges[k] = lattice->cell[k] > 0.0
                       ? (double)cells[k] * lattice->cell[k] * (1.0 - overlap)
                       : 1.0;
    }
}

/* The nearest count that fits, searching downwards (step = -1) or upwards. */
static int64_t nearest(const struct gb_lattice *lattice, int64_t count, int step)
{
    int64_t cells[3];
    while (count > 0 && !gb_lattice_block(lattice, count, cells)) {
        count += step;
    }
    return count;
}

int64_t gb_lattice_count_below(const struct gb_lattice *lattice, int64_t count)
{
    return nearest(lattice, count, -1);
}

static bool check_count(const struct gb_lattice *lattice, const char *name, int64_t count,
                        struct gb_error *err)
{
    int64_t cells[3];
    return gb_lattice_block(lattice, count, cells) ||
           gb_error_set(err, GB_ERR_INPUT,
                        "particles.count = %" PRId64
                        ": structure.kind = %s: expected whole "
                        "unit cells of %d particles, in a block whose edges differ by a "
                        "factor of at most %g: %" PRId64 " and %" PRId64 " fit",
                        count, name, lattice->particles, ratio_max,
                        nearest(lattice, count, -1), nearest(lattice, count, 1));
}

bool gb_lattice_check(const struct gb_params *params, struct gb_error *err)
{
    const struct gb_lattice *lattice = gb_lattice_of(params->structure);
    if (!lattice) {
        return true;
    }
    const char *name = gb_params_find("structure", "kind")->choices[params->structure];
    if (lattice->dimension != params->dimension) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "structure.kind = %s: must be %s with scene.dimension = %d",
                            name,
                            params->dimension == 2 ? "grown, square or hexagonal"
                                                   : "grown, sc, fcc, bcc or diamond",
                            params->dimension);
    }
    if (params->distribution != GB_DISTRIBUTION_MONO) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "particles.distribution: must be mono with structure.kind = "
                            "%s",
                            name);
    }
    return check_count(lattice, name, params->count, err);
}
