/* Chain growth: an initial structure of touching particles, connected and of low density.
 * Source: P1, section III.
 *
 * From a particle of the structure a ray leaves in a random direction.  Candidates for a new
 * particle are the positions on the ray that touch one other particle.  The free candidate with
 * the fewest neighbours wins; the new particle then rolls over the one it touches until it
 * touches a second one, if any is near.  New origins follow until the density is reached.
 *
 *   roll    closest position that touches two particles, on their distances of contact
 *   ray     candidates along one random ray, and the choice among them
 *   growth  rays until all particles are placed */

#include "pack/structure/chain_growth.h"

#include <gsl/gsl_rng.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base/alloc.h"
#include "greenbody/status.h"
#include "pack/structure/assign_sizes.h"
#include "pack/structure/grid.h"
#include "pack/structure/random.h"
#include "scene/imported/imported.h"
#include "scene/lattice.h"
#include "scene/model.h"
#include "scene/unequal_pair.h"

/* ---- Roll ---- */

double gb_chain_growth_contact_distance(const struct gb_roll *roll, int64_t j)
{
    struct gb_law_unequal law;
    if (!roll->diameter) {
        return roll->r_eq;
    }
    gb_unequal_pair_init(&law, roll->model, roll->own, roll->diameter[j]);
    return law.mean_diameter - gb_law_unequal_equilibrium(&law);
}

/* What is farther from the new particle does not overlap it, d. */
static double roll_clearance(const struct gb_roll *roll)
{
    return (1.0 - GB_ROLL_TOLERANCE) * roll->r_eq;
}

/* True if it overlaps the particle hit. */
static bool roll_overlaps_hit(const struct gb_roll *roll, const struct gb_grid_hit *hit)
{
    const double apart =
        (1.0 - GB_ROLL_TOLERANCE) * gb_chain_growth_contact_distance(roll, hit->index);
    return roll->diameter ? hit->square < apart * apart : hit->square <= apart * apart;
}

/* True if a particle at this position overlaps an existing one. */
static bool roll_overlaps(const struct gb_roll *roll, const double position[3])
{
    struct gb_grid_ball ball;
    struct gb_grid_hit hit;
    gb_grid_ball_init(&ball, roll->grid, position, roll_clearance(roll));
    while (gb_grid_ball_next(&ball, &hit)) {
        if (roll_overlaps_hit(roll, &hit)) {
            return true;
        }
    }
    return false;
}

static double square_of_difference(const double a[3], const double b[3])
{
    const double x = a[0] - b[0];
    const double y = a[1] - b[1];
    const double z = a[2] - b[2];
    return x * x + y * y + z * z;
}

/* The second particle to be touched: its position relative to j, and the distance of
 * contact. */
struct partner {
    double r[3];
    double touch;
};

/* The particle nearest to the start at `offset` from j, among those whose distance to j
 * leaves room for a particle that touches both. */
static bool nearest_partner(const struct gb_roll *roll, double reach, const double j[3],
                            const double offset[3], struct partner *partner)
{
    struct gb_grid_ball ball;
    struct gb_grid_hit hit;
    double nearest = INFINITY;
    gb_grid_ball_init(&ball, roll->grid, j, reach + roll->r_eq);
    while (gb_grid_ball_next(&ball, &hit)) {
        const double distance = square_of_difference(hit.r, offset);
        if (hit.square > 0.0 && distance < nearest) {
            const double touch = gb_chain_growth_contact_distance(roll, hit.index);
            if (roll->diameter && hit.square > (reach + touch) * (reach + touch)) {
                continue;
            }
            nearest = distance;
            partner->touch = touch;
            memcpy(partner->r, hit.r, sizeof(hit.r));
        }
    }
    return nearest < INFINITY;
}

/* The point nearest to `offset` at `reach` from j (the origin here) and touching k: on
 * the circle where two spheres meet.  False when offset lies on the line through j and k,
 * where no point of the circle is nearer than another. */
static bool touch_two(double reach, const double offset[3], const struct partner *partner,
                      double found[3])
{
    const double *k = partner->r, touch = partner->touch;
    const double square = k[0] * k[0] + k[1] * k[1] + k[2] * k[2];
    const double middle = 0.5 + 0.5 * (reach * reach - touch * touch) / square;
    const double radius_square = fmax(0.0, reach * reach - middle * middle * square);
    const double share =
        (offset[0] * k[0] + offset[1] * k[1] + offset[2] * k[2]) / square;
    double across[3];
    double length_square = 0.0;
    for (int a = 0; a < 3; a++) {
        across[a] = offset[a] - share * k[a];
        length_square += across[a] * across[a];
    }
    if (length_square < 1e-24 * reach * reach) {
        return false;
    }
    const double scale = sqrt(radius_square / length_square);
    for (int a = 0; a < 3; a++) {
        found[a] = middle * k[a] + scale * across[a];
    }
    return true;
}

/* Rolls a new particle around particle j until it touches one more, k, as well.
 * k is the particle nearest to the start among those that can be touched together with j;
 * the position is the nearest to the start that touches both.
 *
 * offset    from j to the start; as long as they touch
 * position  result
 * False when there is no such k, or when it would overlap a third particle. */
/* P1 leaves open which k is meant by "another, already placed one".  Taking the k whose
 * circle comes first on the way from the start (no other particle can overlap then) gives
 * a coordination number of 4.0037 at d = 9.7 nm, against P1's 4.0062 +- 0.0007; the
 * nearest particle gives 4.0062 +- 0.0002.  g(r) is the same within its scatter. */
static bool roll_onto(const struct gb_roll *roll, int64_t j, const double offset[3],
                      double position[3])
{
    const double *centre = roll->grid->position + 3 * j;
    const double reach = gb_chain_growth_contact_distance(roll, j);
    struct partner partner = {.touch = roll->r_eq};
    double found[3];
    if (!nearest_partner(roll, reach, centre, offset, &partner) ||
        !touch_two(reach, offset, &partner, found)) {
        return false;
    }
    for (int k = 0; k < 3; k++) {
        position[k] = centre[k] + found[k];
    }
    return !roll_overlaps(roll, position);
}

/* ---- Ray ---- */

/* Small particles of unequal sizes have more candidates.  Their number is limited to this
 * factor times the number above; the last ones found are ignored. */
enum { GB_CHAIN_RAY_SIZED = 8 };

/* P1 follows a ray through the nearest images of the cell.  Rays are also cut at this
 * length (in r_eq), or the cost would grow faster than the count.  In 3D the cut leaves
 * P1's cell as it is, and 100,000 particles still have g(L/2) = 1 (cut at 40: 1.001).
 * P1 gives no number for 2D, where the length matters more: 1000 discs at density 0.5
 * have k = 4.45, 4.42, 4.36 and 4.35 for rays of 34, 40, 60 and without a cut. */
static const double ray_longest_3d = 60.0;

static const double ray_longest_2d = 40.0;

/* What is shorter by this share is so for certain, whatever the rounding on a ray of that
 * length. */
static const double clear = 2.0 * GB_ROLL_TOLERANCE;

/* The next particle to be placed. */
static struct gb_roll next_one(const struct gb_chain_ray *growth)
{
    struct gb_roll roll = {.grid = growth->grid, .r_eq = growth->grow->r_eq};
    if (growth->diameter) {
        roll.model = growth->grow->model;
        roll.diameter = growth->diameter;
        roll.own = growth->diameter[growth->grid->count];
        roll.r_eq = 0.5 * (roll.own + roll.model->diameter_max);
    }
    return roll;
}

static void random_direction(struct gb_chain_ray *growth, double direction[3])
{
    if (growth->grow->dimension == 3) {
        gb_random_direction_3d(&growth->rng, direction);
    } else {
        gb_random_direction_2d(&growth->rng, &direction[0], &direction[2]);
        direction[1] = 0.0;
    }
}

/* Length of the ray to the boundary of the block of nearest images, or to the cut. */
static double ray_length(const struct gb_chain_ray *growth, const double origin[3],
                         const double direction[3])
{
    const struct gb_cell *cell = &growth->grid->cell;
    const bool planar = growth->grow->dimension == 2;
    double length = (planar ? ray_longest_2d : ray_longest_3d) * growth->grow->r_eq;
    for (int k = 0; k < 3; k++) {
        if (!cell->periodic[k] || direction[k] == 0.0) {
            continue;
        }
        const double border = direction[k] > 0.0 ? 2.0 * cell->edge[k] : -cell->edge[k];
        length = fmin(length, (border - origin[k]) / direction[k]);
    }
    return length;
}

/* Farthest first. */
static int compare_candidates(const void *left, const void *right)
{
    const struct gb_chain_ray_candidate *a = left;
    const struct gb_chain_ray_candidate *b = right;
    if (a->along != b->along) {
        return a->along > b->along ? -1 : 1;
    }
    return (a->j > b->j) - (a->j < b->j);
}

/* All positions on the far side of the particles that the ray passes within r_eq;
 * overlaps are not checked yet.  Returns their number. */
static int collect_candidates(struct gb_chain_ray *growth, const struct gb_roll *roll,
                              const double origin[3], const double direction[3])
{
    struct gb_grid_ray ray;
    struct gb_grid_hit hit;
    int count = 0;
    gb_grid_ray_init(&ray, growth->grid, origin, direction, roll->r_eq,
                     ray_length(growth, origin, direction));
    while (count < growth->room && gb_grid_ray_next(&ray, &hit)) {
        const double across = fmax(0.0, hit.square - hit.along * hit.along);
        const double touch = gb_chain_growth_contact_distance(roll, hit.index);
        if (growth->diameter && across >= touch * touch) {
            continue; /* the ray does not meet it */
        }
        struct gb_chain_ray_candidate *candidate = &growth->candidates[count++];
        candidate->j = hit.index;
        candidate->along = hit.along + sqrt(touch * touch - across);
        candidate->touch = touch;
        candidate->foot = hit.along;
        candidate->across = across;
        for (int k = 0; k < 3; k++) {
            candidate->offset[k] = candidate->along * direction[k] - hit.r[k];
        }
    }
    qsort(growth->candidates, (size_t)count, sizeof(*growth->candidates),
          compare_candidates);
    return count;
}

static void position_of(const struct gb_chain_ray *growth,
                        const struct gb_chain_ray_candidate *candidate,
                        double position[3])
{
    const double *j = growth->grid->position + 3 * candidate->j;
    for (int k = 0; k < 3; k++) {
        position[k] = j[k] + candidate->offset[k];
    }
}

/* Neighbours within r_meso, 1 at least; stops counting at enough, or there where the new
 * particle overlaps one. */
static int count_neighbours(const struct gb_chain_ray *growth, const struct gb_roll *roll,
                            const double position[3], int enough)
{
    const double meso = growth->grow->r_meso;
    struct gb_grid_ball ball;
    struct gb_grid_hit hit;
    int count = 0;
    gb_grid_ball_init(&ball, growth->grid, position, fmax(meso, roll_clearance(roll)));
    while (count < enough && gb_grid_ball_next(&ball, &hit)) {
        if (roll_overlaps_hit(roll, &hit)) {
            return enough;
        }
        count += hit.square <= meso * meso;
    }
    return count > 1 ? count : 1;
}

/* Neighbours of candidate i among the particles that the ray passes; INT32_MAX where one
 * of them is overlapped for certain.  The candidates are sorted. */
static int least_neighbours(const struct gb_chain_ray *growth, int count, int i,
                            double longest_touch)
{
    const struct gb_chain_ray_candidate *candidate = growth->candidates;
    const double at = candidate[i].along;
    const double meso = (1.0 - clear) * growth->grow->r_meso;
    const double reach = fmax(meso, longest_touch);
    int first = i, neighbours = 0;
    while (first > 0 && candidate[first - 1].along <= at + reach + longest_touch) {
        first--;
    }
    for (int k = first; k < count && candidate[k].along >= at - reach; k++) {
        const double apart = at - candidate[k].foot;
        const double square = apart * apart + candidate[k].across;
        const double touch = (1.0 - clear) * candidate[k].touch;
        if (square < touch * touch) {
            return INT32_MAX;
        }
        neighbours += square <= meso * meso;
    }
    return neighbours;
}

/* The candidate with the fewest known neighbours, the farthest of several. */
static int most_promising(const struct gb_chain_ray *growth, int count)
{
    int found = 0;
    for (int i = 1; i < count; i++) {
        if (growth->candidates[i].least < growth->candidates[found].least) {
            found = i;
        }
    }
    return found;
}

/* The free position with the fewest neighbours, the farthest of several; NULL when the
 * ray has none.  The neighbours that are known of give the order in which the positions are
 * tried, and its end. */
static const struct gb_chain_ray_candidate *
choose_candidate(const struct gb_chain_ray *growth, const struct gb_roll *roll, int count)
{
    struct gb_chain_ray_candidate *const candidate = growth->candidates;
    int best = count, fewest = INT32_MAX - 1;
    for (int i = 0; i < count; i++) {
        candidate[i].least = least_neighbours(growth, count, i, roll->r_eq);
    }
    while (count > 0) {
        const int i = most_promising(growth, count);
        double position[3];
        if (candidate[i].least > fewest || (candidate[i].least == fewest && i > best)) {
            break;
        }
        candidate[i].least = INT32_MAX;
        position_of(growth, &candidate[i], position);
        const int neighbours = count_neighbours(growth, roll, position, fewest + 1);
        if (neighbours < fewest || (neighbours == fewest && i < best)) {
            fewest = neighbours;
            best = i;
        }
    }
    return best < count ? &candidate[best] : NULL;
}

/* True for a particle that keeps one contact. */
static bool stays(struct gb_chain_ray *growth)
{
    const double share = growth->grow->single_contact;
    return share > 0.0 && gsl_rng_uniform(&growth->rng) >= 1.0 - share;
}

bool gb_chain_growth_try(struct gb_chain_ray *growth, int64_t origin)
{
    const struct gb_roll roll = next_one(growth);
    double start[3], direction[3], position[3];
    memcpy(start, growth->grid->position + 3 * origin, sizeof(start));
    random_direction(growth, direction);
    growth->rays++;
    if (growth->grid->count == 1) {
        /* Nothing to roll onto: the second particle just touches the first. */
        for (int k = 0; k < 3; k++) {
            position[k] =
                start[k] + gb_chain_growth_contact_distance(&roll, 0) * direction[k];
        }
        gb_grid_insert(growth->grid, position);
        return true;
    }
    const int count = collect_candidates(growth, &roll, start, direction);
    const struct gb_chain_ray_candidate *best = choose_candidate(growth, &roll, count);
    if (!best) {
        return false;
    }
    if (stays(growth)) {
        position_of(growth, best, position);
    } else if (!roll_onto(&roll, best->j, best->offset, position)) {
        return false;
    }
    gb_grid_insert(growth->grid, position);
    return true;
}

/* ---- Growth ---- */

/* Rays that find no position: after the first number another particle becomes the origin;
 * after the second, in a row, the structure counts as full. */
enum { FAILURES_PER_ORIGIN = 64, FAILURES_MOST = 64 * 64 };

/* The cancel flag is polled once in this many rays. */
enum { RAYS_PER_POLL = 64 };

/* Grid cells for searches, in r_eq: from 0.7 to 1 the time changes by a tenth. */
static const double grid_size = 0.85;

static double density(const struct gb_chain_ray *growth, int64_t count)
{
    const struct gb_chain_growth *grow = growth->grow;
    const double one = grow->dimension == 3 ? M_PI / 6.0 : M_PI / 4.0;
    const double mean = grow->model ? grow->model->mean_power : 1.0;
    return one * mean * (double)count / gb_cell_volume(&growth->grid->cell);
}

static bool fill(struct gb_chain_ray *growth, struct gb_error *err)
{
    const struct gb_chain_growth *grow = growth->grow;
    struct gb_grid *grid = growth->grid;
    int64_t origin = 0;
    int failures = 0;
    while (grid->count < grow->count) {
        if (growth->rays % RAYS_PER_POLL == 0 && grow->cancelled &&
            grow->cancelled(grow->data)) {
            return gb_error_set(err, GB_ERR_CANCELLED, "packing cancelled");
        }
        if (gb_chain_growth_try(growth, origin)) {
            origin = grid->count - 1;
            failures = 0;
            continue;
        }
        failures++;
        if (failures == FAILURES_MOST) {
            return gb_error_set(err, GB_ERR_INPUT,
                                "structure.density = %.4g: not reached, stopped at %.3g "
                                "(%lld of %lld particles; no room was found from there)",
                                density(growth, grow->count),
                                density(growth, grid->count), (long long)grid->count,
                                (long long)grow->count);
        }
        if (failures % FAILURES_PER_ORIGIN == 0) {
            origin =
                (int64_t)gsl_rng_uniform_int(&growth->rng, (unsigned long)grid->count);
        }
    }
    return true;
}

static bool check(const struct gb_chain_growth *grow, const struct gb_cell *cell,
                  struct gb_error *err)
{
    if (grow->count < 1) {
        return gb_error_set(err, GB_ERR_INPUT, "particles.count = %lld: 1 or more",
                            (long long)grow->count);
    }
    if (!(grow->r_eq > 0.0) || !(grow->r_meso > 0.0) || !isfinite(grow->r_meso)) {
        return gb_error_set(err, GB_ERR_INPUT, "structure.r_meso = %g d: above 0 d",
                            grow->r_meso);
    }
    /* Below two diameters a particle would touch its own images. */
    if (!(gb_cell_shortest(cell) > 2.0 * grow->r_eq)) {
        return gb_error_set(
            err, GB_ERR_INPUT,
            "structure.base: a cell of %g x %g x %g d is too small, every "
            "edge is above 2 d",
            grow->edges[0], grow->edges[1], grow->edges[2]);
    }
    return true;
}

static void insert_first(struct gb_chain_ray *growth)
{
    double position[3];
    for (int k = 0; k < 3; k++) {
        const double edge = growth->grid->cell.edge[k];
        position[k] =
            growth->grid->cell.periodic[k] ? edge * gsl_rng_uniform(&growth->rng) : 0.0;
    }
    gb_grid_insert(growth->grid, position);
}

struct gb_chain_growth gb_chain_growth_from_model(const struct gb_model *model)
{
    return (struct gb_chain_growth){
        .dimension = model->dimension,
        .count = model->count,
        .edges = {model->edges[0], model->edges[1], model->edges[2]},
        .r_eq = model->polydisperse ? model->diameter_max : 1.0 - model->h_eq,
        .model = model->polydisperse ? model : NULL,
        .r_meso = model->r_meso,
        .single_contact = model->single_contact,
        .seed = model->seed,
    };
}

static bool assign_diameters(struct gb_chain_ray *growth, struct gb_error *err)
{
    if (!growth->grow->model) {
        return true;
    }
    growth->diameter =
        gb_alloc_array((size_t)growth->grow->count, sizeof *growth->diameter, err);
    return growth->diameter &&
           gb_assign_sizes_model(growth->grow->model, growth->diameter, err);
}

bool gb_chain_growth_run(const struct gb_chain_growth *grow, double *position,
                         struct gb_error *err)
{
    struct gb_chain_ray growth = {.grow = grow};
    struct gb_cell cell;
    bool done = false;
    gb_cell_init(&cell, grow->dimension, grow->edges);
    if (!check(grow, &cell, err)) {
        return false;
    }
    if (!gb_random_open(&growth.rng, grow->seed, GB_RANDOM_POSITIONS, err)) {
        return false;
    }
    if (!assign_diameters(&growth, err)) {
        goto close_rng;
    }
    growth.room = GB_CHAIN_RAY_CANDIDATES * (growth.diameter ? GB_CHAIN_RAY_SIZED : 1);
    growth.candidates =
        gb_alloc_array((size_t)growth.room, sizeof(struct gb_chain_ray_candidate), err);
    if (!growth.candidates) {
        goto close_rng;
    }
    if (!gb_grid_create(&growth.grid, &cell, grid_size * grow->r_eq, grow->count, err)) {
        goto free_candidates;
    }
    insert_first(&growth);
    done = fill(&growth, err);
    if (done) {
        memcpy(position, growth.grid->position,
               (size_t)grow->count * 3 * sizeof(*position));
    }
    gb_grid_destroy(growth.grid);
free_candidates:
    gb_alloc_free(growth.candidates);
close_rng:
    gb_alloc_free(growth.diameter);
    gb_random_close(&growth.rng);
    return done;
}

/* Particle p of the unit cell at `at`. */
static void fill_point(const struct gb_model *model, const struct gb_lattice *lattice,
                       const int64_t cells[3], const int64_t at[3], int p, double x[3])
{
    for (int k = 0; k < 3; k++) {
        const double share = ((double)at[k] + lattice->point[p][k]) / (double)cells[k];
        x[k] = lattice->cell[k] > 0.0 ? model->edges[k] * share : 0.0;
    }
}

/* Positions of a packing of whole unit cells: count x 3, d, inside the cell of the model.
 * The model's structure is a lattice and its count fits (scene/lattice.h). */
static void unit_cells_fill(const struct gb_model *model, double *position)
{
    const struct gb_lattice *lattice = gb_lattice_of(model->structure);
    int64_t cells[3], at[3];
    (void)gb_lattice_block(lattice, model->count, cells);
    for (at[2] = 0; at[2] < cells[2]; at[2]++) {
        for (at[1] = 0; at[1] < cells[1]; at[1]++) {
            for (at[0] = 0; at[0] < cells[0]; at[0]++) {
                for (int p = 0; p < lattice->particles; p++, position += 3) {
                    fill_point(model, lattice, cells, at, p, position);
                }
            }
        }
    }
}

bool gb_chain_growth_fill(const struct gb_model *model, bool (*cancelled)(void *data),
                          void *data, double *position, struct gb_error *err)
{
    if (model->packing) {
        memcpy(position, model->packing->position,
               3 * (size_t)model->count * sizeof *position);
        return true;
    }
    if (model->structure != GB_STRUCTURE_GROWN) {
        unit_cells_fill(model, position);
        return true;
    }
    struct gb_chain_growth growth = gb_chain_growth_from_model(model);
    growth.cancelled = cancelled;
    growth.data = data;
    return gb_chain_growth_run(&growth, position, err);
}
