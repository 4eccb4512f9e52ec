#include "pack/structure/chain_ray.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "pack/structure/random.h"
#include "pack/structure/roll.h"

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
    gb_grid_search_ray_init(&ray, growth->grid, origin, direction, roll->r_eq,
                            ray_length(growth, origin, direction));
    while (count < growth->room && gb_grid_search_ray_next(&ray, &hit)) {
        const double across = fmax(0.0, hit.square - hit.along * hit.along);
        const double touch = gb_roll_contact_distance(roll, hit.index);
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
    gb_grid_search_ball_init(&ball, growth->grid, position,
                             fmax(meso, gb_roll_clearance(roll)));
    while (count < enough && gb_grid_search_ball_next(&ball, &hit)) {
        if (gb_roll_overlaps_hit(roll, &hit)) {
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

bool gb_chain_ray_try(struct gb_chain_ray *growth, int64_t origin)
{
    const struct gb_roll roll = next_one(growth);
    double start[3], direction[3], position[3];
    memcpy(start, growth->grid->position + 3 * origin, sizeof(start));
    random_direction(growth, direction);
    growth->rays++;
    if (growth->grid->count == 1) {
        /* Nothing to roll onto: the second particle just touches the first. */
        for (int k = 0; k < 3; k++) {
            position[k] = start[k] + gb_roll_contact_distance(&roll, 0) * direction[k];
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
    } else if (!gb_roll_onto(&roll, best->j, best->offset, position)) {
        return false;
    }
    gb_grid_insert(growth->grid, position);
    return true;
}
