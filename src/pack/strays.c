#include "pack/strays.h"

#include <math.h>

#include "pack/world_private.h"

/* Some may stray, and one of so many particles: looking at them costs a little of a sweep
 * then.  In one block of them more, as one spot may be busier than all others. */
enum { STRAYS_ANYWAY = 16 };
enum { STRAYS_SHARE = 128, STRAYS_SHARE_BLOCK = 8 };

/* Pairs count as touching, or within the cutoff, this much too early (d): a sweep in
 * single precision sees distances to a little less. */
static const double hair = 1e-6;

/* What two particles at the cutoff may still come nearer, or apart, before one list or
 * the other misses them. */
static double margin_of(const struct gb_world *world, double *reach)
{
    const struct gb_numerics *numerics = &world->model->numerics;
    *reach = world->pairs.largest - 1.0 + numerics->cutoff;
    return numerics->skin - *reach * world->pairs.strain - 2.0 * hair;
}

/* Two at the reach now were at most reach (1 + strain) + both ways apart; nearer than
 * reach + skin they are in a list. */
static double half_margin(const struct gb_world *world)
{
    double reach;
    return 0.5 * margin_of(world, &reach);
}

/* Whoever has not come further than this is found, by a stray that looks for him, in the
 * grid cells beside the one that it would have been in itself at the build; up to `far`,
 * in the next ones but one. */
struct sight {
    double near, far;
};

static struct sight sight_of(const struct gb_world *world)
{
    double reach;
    const double margin = margin_of(world, &reach), strain = 1.0 + world->pairs.strain;
    const double wide = reach + world->model->numerics.skin;
    return (struct sight){margin / strain, (margin + wide) / strain};
}

enum gb_strays_list gb_strays_judge(const struct gb_world *world, double travel)
{
    if (travel < half_margin(world)) {
        return GB_STRAYS_FRESH;
    }
    return travel < sight_of(world).far ? GB_STRAYS_DOUBTED : GB_STRAYS_STALE;
}

/* In the list, and with the image that is the nearest one now. */
static bool holds(const struct gb_world *world, const struct gb_pair_list *list,
                  int64_t i, int64_t j, double squared)
{
    const int64_t low = i < j ? i : j, high = i < j ? j : i;
    for (int64_t k = list->start[low]; k < list->start[low + 1]; k++) {
        double r[3];
        if (list->other[k] == high) {
            return gb_world_arm_of(world, list, low, k, r) <= squared + hair;
        }
    }
    return false;
}

/* Squared distance of nearest images. */
static double nearest2(const struct gb_cell *cell, const double *xi, const double *xj)
{
    double squared = 0.0;
    for (int k = 0; k < 3; k++) {
        const double r = xi[k] - xj[k], edge = cell->edge[k];
        const double way = cell->periodic[k] ? r - edge * gb_cell_whole(r / edge) : r;
        squared += way * way;
    }
    return squared;
}

static void note(struct gb_strays_missing *missing, int64_t i, int64_t j, bool near)
{
    if (missing->count == GB_STRAYS_MISSING) {
        missing->many = true;
        return;
    }
    missing->pair[missing->count++] =
        (struct gb_strays_pair){(int32_t)(i < j ? i : j), (int32_t)(i < j ? j : i), near};
}

/* Is the pair in the list that its distance asks for? */
static void look_at_pair(const struct gb_world *world, int64_t i, int64_t j,
                         struct gb_strays_missing *missing)
{
    const double *d = world->diameter;
    const double touch = (d ? 0.5 * (d[i] + d[j]) : 1.0) + hair;
    const double reach = touch + world->model->numerics.cutoff - 1.0;
    const double squared =
        nearest2(&world->cell, world->position + 3 * i, world->position + 3 * j);
    const bool touches = squared < touch * touch;
    if (squared < reach * reach && !holds(world, &world->pairs.near, i, j, squared) &&
        (touches || !holds(world, &world->pairs.far, i, j, squared))) {
        note(missing, i, j, touches);
    }
}

/* Where particle i would have been at the build had only the cell been strained since. */
static void home_at_build(const struct gb_world *world, int64_t i, int home[3])
{
    struct gb_cell built = world->cell;
    double x[3];
    for (int k = 0; k < 3; k++) {
        built.edge[k] = world->pairs.built_edge[k];
        x[k] = world->position[3 * i + k] / world->pairs.stretch[k];
    }
    gb_cell_wrap(&built, x);
    gb_pairs_grid_home(&world->pairs.grid, x, home);
}

static void look_into_cell(const struct gb_world *world, int64_t i, const int home[3],
                           struct gb_strays_missing *missing)
{
    const struct gb_pairs *pairs = &world->pairs;
    const int cell = gb_pairs_grid_index(&pairs->grid, home);
    for (int32_t k = pairs->head[cell]; k < pairs->head[cell + 1]; k++) {
        const int64_t j = pairs->next[k];
        if (j != i) {
            look_at_pair(world, i, j, missing);
        }
    }
}

/* Those in `span` grid cells each way. */
static void look_around(const struct gb_world *world, int64_t i, int span,
                        struct gb_strays_missing *missing)
{
    const struct gb_pairs_grid *grid = &world->pairs.grid;
    int home[3], at[3], low[3], high[3];
    home_at_build(world, i, home);
    for (int k = 0; k < 3; k++) { /* all of them once, where there are few */
        low[k] = grid->n[k] > 2 * span ? -span : 0;
        high[k] = grid->n[k] > 2 * span ? span : grid->n[k] - 1;
    }
    const int row = high[0] - low[0] + 1, plane = row * (high[1] - low[1] + 1);
    for (int c = 0; c < plane * (high[2] - low[2] + 1); c++) {
        const int step[3] = {c % row, c % plane / row, c / plane};
        for (int k = 0; k < 3; k++) {
            at[k] = (home[k] + low[k] + step[k] + grid->n[k]) % grid->n[k];
        }
        look_into_cell(world, i, at, missing);
    }
}

/* Squared way of particle i since the build, beside the affine motion. */
static double way2(const struct gb_pairs *pairs, const double *position, int64_t i)
{
    double square = 0.0;
    for (int k = 0; k < 3; k++) {
        const double way =
            position[3 * i + k] - pairs->built_at[3 * i + k] * pairs->stretch[k];
        square += way * way;
    }
    return square;
}

/* Does a flock begin here of which nobody strayed? */
static bool flock_stays(const struct gb_world *world, int64_t i, double fresh)
{
    return world->single.driven && i % GB_SINGLE_FLOCK == 0 &&
           (double)world->single.travel2[i / GB_SINGLE_FLOCK] < fresh * fresh;
}

void gb_strays_look(const struct gb_world *world, int64_t begin, int64_t end,
                    struct gb_strays_missing *missing)
{
    const double fresh = half_margin(world), near = sight_of(world).near;
    *missing = (struct gb_strays_missing){0};
    for (int64_t i = begin; i < end && !missing->many; i++) {
        if (flock_stays(world, i, fresh)) {
            i += GB_SINGLE_FLOCK - 1;
            continue;
        }
        const double square = way2(&world->pairs, world->position, i);
        if (square < fresh * fresh) {
            continue;
        }
        missing->strays++;
        missing->many =
            STRAYS_SHARE_BLOCK * (missing->strays - STRAYS_ANYWAY) > end - begin;
        /* two that went far are found by each other, others by the one that did */
        look_around(world, i, square < near * near ? 1 : 2, missing);
    }
}

bool gb_strays_too_many(int64_t strays, int64_t particles)
{
    return STRAYS_SHARE * (strays - STRAYS_ANYWAY) > particles;
}
