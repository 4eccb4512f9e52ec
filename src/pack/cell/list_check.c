#include "pack/cell/list_check.h"

#include <math.h>
#include <string.h>

#include "pack/cell/world_private.h"

/* Some may stray, and one of so many particles: looking at them costs a little of a sweep
 * then.  In one block of them more, as one spot may be busier than all others. */
enum { STRAYS_ANYWAY = 20 };
enum { STRAYS_SHARE = 256, STRAYS_SHARE_BLOCK = 8 };

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
double gb_list_check_fresh(const struct gb_world *world)
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

enum gb_list_check_list gb_list_check_judge(const struct gb_world *world, double travel)
{
    if (travel < gb_list_check_fresh(world)) {
        return GB_LIST_CHECK_FRESH;
    }
    return travel < sight_of(world).far ? GB_LIST_CHECK_DOUBTED : GB_LIST_CHECK_STALE;
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

static void note(struct gb_list_check_missing *missing, int64_t i, int64_t j, bool near)
{
    if (missing->count == GB_LIST_CHECK_MISSING) {
        missing->many = true;
        return;
    }
    missing->pair[missing->count++] = (struct gb_list_check_pair){
        (int32_t)(i < j ? i : j), (int32_t)(i < j ? j : i), near};
}

/* Those whom a stray may have met.  They lie anywhere in memory, which is asked for all
 * of them before it is waited for. */
enum { CROWD = 256 };
struct crowd {
    int count;
    int32_t who[CROWD];
};

/* Squared way between two places, the shortest one around the cell. */
static double place_way2(const struct gb_world *world, const int32_t from[3],
                         const int32_t to[3])
{
    double squared = 0.0;
    for (int k = 0; k < 3; k++) {
        const uint32_t wide = (uint32_t)to[k] - (uint32_t)from[k];
        int32_t units;
        memcpy(&units, &wide, sizeof units);
        const double way = (double)units * gb_f32_state_d(&world->cell, k);
        squared += way * way;
    }
    return squared;
}

/* Squared distance of nearest images. */
static double nearest2(const struct gb_world *world, int64_t i, int64_t j)
{
    const struct gb_cell *cell = &world->cell;
    const double *xi = world->position + 3 * i, *xj = world->position + 3 * j;
    double squared = 0.0;
    if (world->in_single) {
        return place_way2(world, world->single.spot[i].place,
                          world->single.spot[j].place);
    }
    for (int k = 0; k < 3; k++) {
        const double r = xi[k] - xj[k], edge = cell->edge[k];
        const double way = cell->periodic[k] ? r - edge * gb_cell_whole(r / edge) : r;
        squared += way * way;
    }
    return squared;
}

/* Leaves in the crowd who is near enough to be in a list of particle i. */
static void keep_near(const struct gb_world *world, int64_t i, struct crowd *crowd)
{
    const double reach =
        world->pairs.largest + hair + world->model->numerics.cutoff - 1.0;
    int kept = 0;
    for (int k = 0; k < crowd->count; k++) {
        const int32_t j = crowd->who[k];
        const double squared = nearest2(world, i, j);
        crowd->who[kept] = j;
        kept += squared < reach * reach && j != i;
    }
    crowd->count = kept;
}

static void ask_for_lists(const struct gb_world *world, int64_t i,
                          const struct crowd *crowd)
{
    const struct gb_neighbour_list *pairs = &world->pairs;
    for (int k = 0; k < crowd->count; k++) {
        const int64_t low = i < crowd->who[k] ? i : crowd->who[k];
        __builtin_prefetch(&pairs->near.start[low]);
        __builtin_prefetch(&pairs->far.start[low]);
    }
    for (int k = 0; k < crowd->count; k++) {
        const int64_t low = i < crowd->who[k] ? i : crowd->who[k];
        __builtin_prefetch(&pairs->near.other[pairs->near.start[low]]);
        __builtin_prefetch(&pairs->near.image[pairs->near.start[low]]);
    }
}

/* Is the pair in the list that its distance asks for? */
static void look_at_pair(const struct gb_world *world, int64_t i, int64_t j,
                         struct gb_list_check_missing *missing)
{
    const double *d = world->diameter;
    const double touch = (d ? 0.5 * (d[i] + d[j]) : 1.0) + hair;
    const double reach = touch + world->model->numerics.cutoff - 1.0;
    const double squared = nearest2(world, i, j);
    const bool touches = squared < touch * touch;
    if (squared < reach * reach && !holds(world, &world->pairs.near, i, j, squared) &&
        (touches || !holds(world, &world->pairs.far, i, j, squared))) {
        note(missing, i, j, touches);
    }
}

static void look_at_crowd(const struct gb_world *world, int64_t i, struct crowd *crowd,
                          struct gb_list_check_missing *missing)
{
    keep_near(world, i, crowd);
    ask_for_lists(world, i, crowd);
    for (int k = 0; k < crowd->count; k++) {
        look_at_pair(world, i, crowd->who[k], missing);
    }
    crowd->count = 0;
}

/* Where particle i would have been at the build had only the cell been strained since. */
static void home_at_build(const struct gb_world *world, int64_t i, int home[3])
{
    struct gb_cell built = world->cell;
    double x[3];
    gb_world_at(world, i, x);
    for (int k = 0; k < 3; k++) {
        built.edge[k] = world->pairs.built_edge[k];
        x[k] /= world->pairs.stretch[k];
    }
    gb_cell_wrap(&built, x);
    gb_neighbour_grid_home(&world->pairs.grid, x, home);
}

/* Grid cells beside each other along x: `next` holds their particles in one run. */
struct run {
    int first, last;
};

/* The runs of `span` grid cells each way around particle i: two where they wrap around.
 */
enum { SPAN_MOST = 2, RUNS = 2 * (2 * SPAN_MOST + 1) * (2 * SPAN_MOST + 1) };
static int find_runs(const struct gb_world *world, int64_t i, int span, struct run *run)
{
    const struct gb_neighbour_grid *grid = &world->pairs.grid;
    int home[3], low[3], count[3], runs = 0;
    home_at_build(world, i, home);
    for (int k = 0; k < 3; k++) { /* all of them once, where there are few */
        const bool all = grid->n[k] <= 2 * span + 1;
        low[k] = all ? 0 : home[k] - span + (home[k] < span ? grid->n[k] : 0);
        count[k] = all ? grid->n[k] : 2 * span + 1;
    }
    const int wrapped = low[0] + count[0] - grid->n[0];
    for (int r = 0; r < count[1] * count[2]; r++) {
        const int at[3] = {0, (low[1] + r % count[1]) % grid->n[1],
                           (low[2] + r / count[1]) % grid->n[2]};
        const int row = gb_neighbour_grid_index(grid, at);
        const int behind = wrapped > 0 ? grid->n[0] : low[0] + count[0];
        run[runs++] = (struct run){row + low[0], row + behind - 1};
        if (wrapped > 0) {
            run[runs++] = (struct run){row, row + wrapped - 1};
        }
    }
    return runs;
}

static void look_around(const struct gb_world *world, int64_t i, int span,
                        struct gb_list_check_missing *missing)
{
    const struct gb_neighbour_list *pairs = &world->pairs;
    struct run run[RUNS];
    struct crowd crowd = {.count = 0};
    const int runs = find_runs(world, i, span, run);
    for (int r = 0; r < runs; r++) {
        __builtin_prefetch(&pairs->head[run[r].first]);
    }
    for (int r = 0; r < runs; r++) {
        __builtin_prefetch(&pairs->next[pairs->head[run[r].first]]);
    }
    for (int r = 0; r < runs; r++) {
        const int32_t stop = pairs->head[run[r].last + 1];
        for (int32_t k = pairs->head[run[r].first]; k < stop; k++) {
            const int32_t j = pairs->next[k];
            __builtin_prefetch(world->in_single ? (const void *)&world->single.spot[j]
                                                : world->position + 3 * (int64_t)j);
            crowd.who[crowd.count++] = j;
            if (crowd.count == CROWD) {
                look_at_crowd(world, i, &crowd, missing);
            }
        }
    }
    look_at_crowd(world, i, &crowd, missing);
}

/* Squared way of particle i since the build, beside the affine motion. */
static double way2(const struct gb_world *world, int64_t i)
{
    const struct gb_neighbour_list *pairs = &world->pairs;
    double square = 0.0, x[3];
    gb_world_at(world, i, x);
    for (int k = 0; k < 3; k++) {
        const double way = x[k] - pairs->built_at[3 * i + k] * pairs->stretch[k];
        square += way * way;
    }
    return square;
}

/* Does a flock begin here of which nobody strayed? */
static bool flock_stays(const struct gb_world *world, int64_t i, double fresh)
{
    return world->single.driven && i % GB_F32_STATE_FLOCK == 0 &&
           (double)world->single.travel[i / GB_F32_STATE_FLOCK] < fresh;
}

void gb_list_check_look(const struct gb_world *world, int64_t begin, int64_t end,
                        struct gb_list_check_missing *missing)
{
    const double fresh = gb_list_check_fresh(world), near = sight_of(world).near;
    *missing = (struct gb_list_check_missing){0};
    for (int64_t i = begin; i < end && !missing->many; i++) {
        if (flock_stays(world, i, fresh)) {
            i += GB_F32_STATE_FLOCK - 1;
            continue;
        }
        const double square = way2(world, i);
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

bool gb_list_check_too_many(int64_t strays, int64_t particles)
{
    return STRAYS_SHARE * (strays - STRAYS_ANYWAY) > particles;
}
