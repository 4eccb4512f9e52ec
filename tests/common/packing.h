#ifndef GB_TESTS_PACKING_H
#define GB_TESTS_PACKING_H

#include <glib.h>
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "measure/structure.h"
#include "pack/cell/cell.h"
#include "pack/structure/chain_growth.h"

/* Equilibrium overlap of alumina at d = 9.7 nm, P1's parameters. */
static const double packing_h_eq = 1.568325077091e-2;

/* A grown packing without a model: cell and positions. */
struct packing {
    struct gb_chain_growth grow;
    struct gb_cell cell;
    double *position;
};

/* 3D: base x base, the height follows from the density.  2D: a square. */
static inline void packing_init(struct packing *packing, int dimension, int64_t count,
                                double base, double density, double h_eq, uint64_t seed)
{
    struct gb_chain_growth *grow = &packing->grow;
    struct gb_error err = {0};
    *grow = (struct gb_chain_growth){.dimension = dimension,
                                     .count = count,
                                     .r_eq = 1.0 - h_eq,
                                     .r_meso = 2.0,
                                     .seed = seed};
    const double solid = (dimension == 3 ? G_PI / 6.0 : G_PI / 4.0) * (double)count;
    grow->edges[0] = dimension == 3 ? base : sqrt(solid / density);
    grow->edges[1] = dimension == 3 ? base : 1.0;
    grow->edges[2] = solid / density / (grow->edges[0] * grow->edges[1]);
    gb_cell_init(&packing->cell, dimension, grow->edges);
    packing->position = gb_alloc_array((size_t)count, 3 * sizeof(double), &err);
    g_assert_nonnull(packing->position);
}

static inline void packing_make(struct packing *packing, int dimension, int64_t count,
                                double base, double density, double h_eq, uint64_t seed)
{
    struct gb_error err = {0};
    packing_init(packing, dimension, count, base, density, h_eq, seed);
    if (!gb_chain_growth_run(&packing->grow, packing->position, &err)) {
        g_error("%s", err.text);
    }
}

static inline void packing_finish(struct packing *packing)
{
    gb_alloc_free(packing->position);
}

/* Contacts: touching without adhesion, closer than d with it. */
static inline struct gb_connectivity packing_contacts(const struct packing *packing)
{
    struct gb_connectivity found;
    struct gb_error err = {0};
    const double reach = packing->grow.r_eq < 1.0 ? 1.0 : 1.0 + 1e-9;
    g_assert_true(gb_structure_connectivity(&packing->cell, packing->grow.count,
                                            packing->position, NULL, reach, &found,
                                            &err));
    return found;
}

/* Mean and standard error of repeated experiments. */
struct sample {
    int count;
    double sum, square;
};

static inline void sample_add(struct sample *sample, double value)
{
    sample->count++;
    sample->sum += value;
    sample->square += value * value;
}

static inline double sample_mean(const struct sample *sample)
{
    return sample->sum / sample->count;
}

static inline double sample_error(const struct sample *sample)
{
    const double mean = sample_mean(sample);
    const double spread = fmax(0.0, sample->square / sample->count - mean * mean);
    return sqrt(spread / (sample->count - 1));
}

#endif
