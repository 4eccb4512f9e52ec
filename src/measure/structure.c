/* Structure of a packing: pair distribution, clusters and their percolation. */
#include "measure/structure.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "base/alloc.h"
#include "pack/structure/chain_growth.h"
#include "pack/structure/grid.h"

/* A grid finer than this share of the reach makes a search visit more cells than it
 * saves points. */
static const double cells_per_reach = 4.0;

/* A grid over the positions; the caller destroys it. */
static bool sort_positions(struct gb_grid **out, const struct gb_cell *cell,
                           int64_t count, const double *position, double reach,
                           struct gb_error *err)
{
    struct gb_grid *grid;
    *out = NULL;
    for (int64_t i = 0; i < 3 * count; i++) {
        if (!isfinite(position[i])) {
            return gb_error_set(err, GB_ERR_INPUT,
                                "position of particle %lld: not a finite number",
                                (long long)(i / 3));
        }
    }
    if (!gb_grid_create(&grid, cell, reach / cells_per_reach, count, err)) {
        return false;
    }
    for (int64_t i = 0; i < count; i++) {
        gb_grid_insert(grid, position + 3 * i);
    }
    *out = grid;
    return true;
}

/* Pairs by distance, each counted once. */
static void count_pairs(const struct gb_grid *grid, double r_max, int bins, double *pairs)
{
    for (int64_t i = 0; i < grid->count; i++) {
        struct gb_grid_ball ball;
        struct gb_grid_hit hit;
        gb_grid_ball_init(&ball, grid, grid->position + 3 * i, r_max);
        while (gb_grid_ball_next(&ball, &hit)) {
            const int bin = (int)(sqrt(hit.square) / r_max * bins);
            if (hit.index > i && bin < bins) {
                pairs[bin] += 1.0;
            }
        }
    }
}

bool gb_structure_rdf(const struct gb_cell *cell, int64_t count, const double *position,
                      double r_max, int bins, double *g, struct gb_error *err)
{
    const double half = 0.5 * gb_cell_shortest(cell);
    if (!(r_max > 0.0) || r_max > half * (1.0 + 1e-12) || bins < 1 || count < 1) {
        return gb_error_set(
            err, GB_ERR_INPUT,
            "g(r) up to %g d in %d bins: from 0 to half the cell, %g d, in "
            "one bin or more",
            r_max, bins, half);
    }
    memset(g, 0, (size_t)bins * sizeof(*g));
    struct gb_grid *grid;
    if (!sort_positions(&grid, cell, count, position, r_max, err)) {
        return false;
    }
    count_pairs(grid, r_max, bins, g);
    gb_grid_destroy(grid);
    /* (14) with dM twice the pairs and v0 / rho = V / N; the shell's exact volume instead
     * of 4 pi r^2 dr, so that an ideal gas gives 1 in wide bins too. */
    const bool planar = !cell->periodic[1];
    const double ideal = (double)count * (double)count / gb_cell_volume(cell);
    for (int k = 0; k < bins; k++) {
        const double a = k * r_max / bins;
        const double b = (k + 1) * r_max / bins;
        const double shell =
            planar ? M_PI * (b * b - a * a) : 4.0 / 3.0 * M_PI * (b * b * b - a * a * a);
        g[k] *= 2.0 / (ideal * shell);
    }
    return true;
}

/* Mean of g over [from, to), each bin by its volume. */
static double mean_between(int dimension, double width, int bins, const double *g,
                           double from, double to)
{
    double sum = 0.0, weight = 0.0;
    for (int k = 0; k < bins; k++) {
        const double r = (k + 0.5) * width;
        if (r > from && r <= to) {
            sum += g[k] * pow(r, dimension - 1);
            weight += pow(r, dimension - 1);
        }
    }
    return sum / weight;
}

double gb_structure_rdf_end(int dimension, double r_max, int bins, const double *g,
                            double *ripple)
{
    const double width = r_max / bins;
    double squares = 0.0;
    for (int q = 0; q < 4; q++) {
        const double from = r_max - 1.0 + 0.25 * q;
        const double off =
            mean_between(dimension, width, bins, g, from, from + 0.25) - 1.0;
        squares += 0.25 * off * off;
    }
    if (ripple != NULL) {
        *ripple = sqrt(squares);
    }
    return mean_between(dimension, width, bins, g, r_max - 1.0, r_max);
}

/* Union-find over particles.  Each node stores the image of the cell, relative to its
 * own, in which its parent lies; a loop of contacts that closes at another image of its
 * start shows that the cluster joins its own image. */
struct node {
    int32_t parent;
    int32_t size;  /* of the cluster; of a root */
    int image[3];  /* of the parent */
    bool joins[3]; /* its own image; of a root */
};

/* Root of i and its image seen from i; points all nodes on the way at the root. */
static int32_t find_root(struct node *nodes, int32_t i, int image[3])
{
    int total[3] = {0, 0, 0};
    int32_t root = i;
    while (nodes[root].parent != root) {
        for (int k = 0; k < 3; k++) {
            total[k] += nodes[root].image[k];
        }
        root = nodes[root].parent;
    }
    memcpy(image, total, sizeof(total));
    while (nodes[i].parent != root && i != root) {
        const struct node old = nodes[i];
        nodes[i].parent = root;
        memcpy(nodes[i].image, total, sizeof(total));
        for (int k = 0; k < 3; k++) {
            total[k] -= old.image[k];
        }
        i = old.parent;
    }
    return root;
}

/* Joins particle i to the given image of particle j. */
static void join(struct node *nodes, int32_t i, int32_t j, const int image[3])
{
    int from_i[3], from_j[3], apart[3];
    int32_t a = find_root(nodes, i, from_i);
    int32_t b = find_root(nodes, j, from_j);
    /* Image of b seen from a: back to i, over to j, on to b. */
    for (int k = 0; k < 3; k++) {
        apart[k] = image[k] + from_j[k] - from_i[k];
    }
    if (a == b) {
        for (int k = 0; k < 3; k++) {
            nodes[a].joins[k] = nodes[a].joins[k] || apart[k] != 0;
        }
        return;
    }
    if (nodes[a].size > nodes[b].size) {
        const int32_t swap = a;
        a = b;
        b = swap;
        for (int k = 0; k < 3; k++) {
            apart[k] = -apart[k];
        }
    }
    nodes[a].parent = b;
    nodes[b].size += nodes[a].size;
    for (int k = 0; k < 3; k++) {
        nodes[a].image[k] = apart[k];
        nodes[b].joins[k] = nodes[b].joins[k] || nodes[a].joins[k];
    }
}

/* Distance below the reach; with two sizes, below the reach times the sum of radii. */
static bool is_neighbour(const struct gb_grid_hit *hit, int32_t i, double reach,
                         const double *radius)
{
    const double span = radius ? reach * (radius[i] + radius[hit->index]) : reach;
    return !radius || hit->square < span * span;
}

static double largest_of(const double *radius, int64_t count)
{
    double largest = 0.5;
    for (int64_t i = 0; radius && i < count; i++) {
        largest = fmax(largest, radius[i]);
    }
    return largest;
}

/* Joins all pairs within reach and counts neighbours on the way. */
static void join_neighbours(const struct gb_grid *grid, double reach,
                            const double *radius, struct node *nodes,
                            struct gb_connectivity *out)
{
    const double most = 2.0 * largest_of(radius, grid->count) * reach;
    enum { LAST = sizeof(out->histogram) / sizeof(out->histogram[0]) - 1 };
    int64_t contacts = 0;
    for (int32_t i = 0; i < grid->count; i++) {
        struct gb_grid_ball ball;
        struct gb_grid_hit hit;
        int neighbours = 0;
        gb_grid_ball_init(&ball, grid, grid->position + 3 * (int64_t)i, most);
        while (gb_grid_ball_next(&ball, &hit)) {
            const bool self = hit.index == i && hit.image[0] == 0 && hit.image[1] == 0 &&
                              hit.image[2] == 0;
            if (!self && is_neighbour(&hit, i, reach, radius)) {
                neighbours++;
                join(nodes, i, (int32_t)hit.index, hit.image);
            }
        }
        contacts += neighbours;
        out->histogram[neighbours < LAST ? neighbours : LAST]++;
    }
    out->coordination = (double)contacts / (double)grid->count;
}

static void count_clusters(const struct node *nodes, int64_t count,
                           struct gb_connectivity *out)
{
    for (int32_t i = 0; i < count; i++) {
        if (nodes[i].parent != i) {
            continue;
        }
        out->clusters++;
        if (nodes[i].size > out->largest) {
            out->largest = nodes[i].size;
            memcpy(out->percolates, nodes[i].joins, sizeof(out->percolates));
        }
    }
}

bool gb_structure_connectivity(const struct gb_cell *cell, int64_t count,
                               const double *position, const double *radius, double reach,
                               struct gb_connectivity *out, struct gb_error *err)
{
    memset(out, 0, sizeof(*out));
    if (!(reach > 0.0) || !isfinite(reach) || count < 1) {
        return gb_error_set(
            err, GB_ERR_INPUT,
            "contacts within %g d of %lld particles: a length above 0 and "
            "one particle or more",
            reach, (long long)count);
    }
    struct gb_grid *grid;
    if (!sort_positions(&grid, cell, count, position, reach, err)) {
        return false;
    }
    struct node *nodes = gb_alloc_array((size_t)count, sizeof(*nodes), err);
    if (!nodes) {
        gb_grid_destroy(grid);
        return false;
    }
    for (int32_t i = 0; i < count; i++) {
        nodes[i].parent = i;
        nodes[i].size = 1;
    }
    join_neighbours(grid, reach, radius, nodes, out);
    count_clusters(nodes, count, out);
    gb_alloc_free(nodes);
    gb_grid_destroy(grid);
    return true;
}

/* Without adhesion touching particles are at r = d except for rounding. */
static const double rounding = 1e-9;

/* More particles where a structure does not percolate. */
static const double growth_factor = 1.1;

double gb_structure_reach(double r_eq)
{
    return r_eq < 1.0 ? 1.0 : 1.0 + rounding;
}

/* Whether the first `count` particles span every axis of the cell. */
static bool percolates(const struct gb_chain_growth *grow, const double *position,
                       int64_t count, bool *spans, struct gb_error *err)
{
    struct gb_connectivity found;
    struct gb_cell cell;
    gb_cell_init(&cell, grow->dimension, grow->edges);
    if (!gb_structure_connectivity(&cell, count, position, NULL,
                                   gb_structure_reach(grow->r_eq), &found, err)) {
        return false;
    }
    *spans = true;
    for (int k = 0; k < 3; k++) {
        *spans = *spans && (found.percolates[k] || !cell.periodic[k]);
    }
    return true;
}

/* By bisection: a particle more never parts a cluster. */
static bool find_least(const struct gb_chain_growth *grow, const double *position,
                       int64_t *particles, struct gb_error *err)
{
    int64_t low = 0; /* does not percolate */
    int64_t high = grow->count;
    while (high - low > 1) {
        const int64_t middle = low + (high - low) / 2;
        bool spans = false;
        if (!percolates(grow, position, middle, &spans, err)) {
            return false;
        }
        *(spans ? &high : &low) = middle;
    }
    *particles = high;
    return true;
}

/* What became of a structure of a length. */
enum growth { FULL, LOOSE, SPANNING, FAILED };

/* Grows a structure and, where it spans the cell, finds the least number. */
static enum growth grow_once(const struct gb_chain_growth *grow, int64_t *particles,
                             struct gb_error *err)
{
    struct gb_error cause = {0};
    bool spans = false;
    double *position = gb_alloc_array((size_t)grow->count * 3, sizeof *position, err);
    if (position == NULL) {
        return FAILED;
    }
    enum growth outcome = FAILED;
    if (!gb_chain_growth_run(grow, position, &cause)) {
        outcome = cause.code == GB_ERR_INPUT ? FULL : FAILED;
        gb_error_set(err, cause.code, "%s", cause.text);
    } else if (percolates(grow, position, grow->count, &spans, err) &&
               (!spans || find_least(grow, position, particles, err))) {
        outcome = spans ? SPANNING : LOOSE;
    }
    gb_alloc_free(position);
    return outcome;
}

/* Longer and longer structures; below a length that finds no room, by bisection. */
bool gb_structure_percolation(const struct gb_chain_growth *grow, int64_t *particles,
                              struct gb_error *err)
{
    struct gb_chain_growth longer = *grow;
    int64_t loose = 0; /* longest that does not span */
    int64_t full = 0;  /* shortest that finds no room; 0: none yet */
    if (grow->model != NULL) {
        return gb_error_set(
            err, GB_ERR_INPUT,
            "particles.distribution: the percolation of a growing cluster "
            "is sought for mono");
    }
    for (;;) {
        const enum growth outcome = grow_once(&longer, particles, err);
        if (outcome == SPANNING || outcome == FAILED) {
            return outcome == SPANNING;
        }
        *(outcome == FULL ? &full : &loose) = longer.count;
        if (full > 0 && full - loose <= 1) {
            return false; /* err says where it was full */
        }
        longer.count = full > 0 ? loose + (full - loose) / 2
                                : (int64_t)((double)loose * growth_factor) + 1;
    }
}
