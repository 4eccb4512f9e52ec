/* Positions that rays of the chain growth choose, against all images of all particles: no
 * grid, no order, nothing left out. */
#include "base/vec.h"
#include "common/packing.h"
#include "common/unequal.h"
#include "pack/structure/assign_sizes.h"
#include "pack/structure/chain_growth.h"
#include "pack/structure/random.h"

/* Images of the cell on either side: as far as the longest ray and its particles. */
enum { IMAGES = 2 };

/* One of a ray's positions, from the start of the ray. */
struct candidate {
    double x[3], along;
    int neighbours; /* -1: overlaps a particle */
};

/* The growing structure before a ray, and the distances of contact of the next particle. */
struct before {
    const struct gb_chain_ray *growth;
    double start[3], touch[512];
};

/* Calls a function with the vector from the start to every image of every particle. */
static void each_image(const struct before *before,
                       void (*call)(int64_t j, const double r[3], void *data), void *data)
{
    const struct gb_grid *grid = before->growth->grid;
    const int rows = grid->cell.periodic[1] ? IMAGES : 0;
    for (int64_t j = 0; j < grid->count; j++) {
        for (int x = -IMAGES; x <= IMAGES; x++) {
            for (int y = -rows; y <= rows; y++) {
                for (int z = -IMAGES; z <= IMAGES; z++) {
                    const int image[3] = {x, y, z};
                    double r[3];
                    for (int k = 0; k < 3; k++) {
                        r[k] = grid->position[3 * j + k] + image[k] * grid->cell.edge[k] -
                               before->start[k];
                    }
                    call(j, r, data);
                }
            }
        }
    }
}

struct look {
    const struct before *before;
    struct candidate *candidate;
};

static void look_at(int64_t j, const double r[3], void *data)
{
    const struct look *look = data;
    double from[3] = {r[0], r[1], r[2]};
    gb_vec_add(from, -1.0, look->candidate->x);
    const double apart = gb_vec_length(from);
    if (apart < (1.0 - GB_ROLL_TOLERANCE) * look->before->touch[j]) {
        look->candidate->neighbours = -1;
    } else if (look->candidate->neighbours >= 0) {
        look->candidate->neighbours += apart <= look->before->growth->grow->r_meso;
    }
}

struct ray {
    const struct before *before;
    double direction[3], length;
    struct candidate best;
    int free; /* positions without overlap */
};

/* The position behind one image, kept where it is better than all before. */
static void candidate_behind(int64_t j, const double r[3], void *data)
{
    struct ray *ray = data;
    const double touch = ray->before->touch[j], foot = gb_vec_dot(r, ray->direction);
    const double across = gb_vec_dot(r, r) - foot * foot;
    if (foot < 0.0 || foot > ray->length || across >= touch * touch) {
        return;
    }
    struct candidate candidate = {.along =
                                      foot + sqrt(touch * touch - fmax(across, 0.0))};
    for (int k = 0; k < 3; k++) {
        candidate.x[k] = candidate.along * ray->direction[k];
    }
    struct look look = {ray->before, &candidate};
    each_image(ray->before, look_at, &look);
    if (candidate.neighbours < 0) {
        return;
    }
    candidate.neighbours = MAX(candidate.neighbours, 1); /* what is touched is one */
    if (ray->free == 0 || candidate.neighbours < ray->best.neighbours ||
        (candidate.neighbours == ray->best.neighbours &&
         candidate.along > ray->best.along)) {
        ray->best = candidate;
    }
    ray->free++;
}

/* To the boundary of the block of nearest images, and no longer than the longest ray. */
static double length_of(const struct before *before, const double direction[3])
{
    const struct gb_cell *cell = &before->growth->grid->cell;
    double length =
        (before->growth->grow->dimension == 2 ? 40.0 : 60.0) * before->growth->grow->r_eq;
    for (int k = 0; k < 3; k++) {
        if (cell->periodic[k] && direction[k] != 0.0) {
            const double border =
                direction[k] > 0.0 ? 2.0 * cell->edge[k] : -cell->edge[k];
            length = fmin(length, (border - before->start[k]) / direction[k]);
        }
    }
    return length;
}

static struct ray cast(const struct before *before, const gsl_rng *rng)
{
    struct ray ray = {.before = before};
    if (before->growth->grow->dimension == 3) {
        gb_random_direction_3d(rng, ray.direction);
    } else {
        gb_random_direction_2d(rng, &ray.direction[0], &ray.direction[2]);
    }
    ray.length = length_of(before, ray.direction);
    each_image(before, candidate_behind, &ray);
    return ray;
}

static struct before look_before(const struct gb_chain_ray *growth, int64_t origin)
{
    struct before before = {.growth = growth};
    struct gb_roll roll = {.grid = growth->grid, .r_eq = growth->grow->r_eq};
    if (growth->diameter) {
        roll.model = growth->grow->model;
        roll.diameter = growth->diameter;
        roll.own = growth->diameter[growth->grid->count];
    }
    memcpy(before.start, growth->grid->position + 3 * origin, sizeof before.start);
    g_assert_cmpint(growth->grid->count, <, G_N_ELEMENTS(before.touch));
    for (int64_t j = 0; j < growth->grid->count; j++) {
        before.touch[j] = gb_chain_growth_contact_distance(&roll, j);
    }
    return before;
}

/* A ray from particle `origin`; returns how many free positions it had. */
static int check_ray(struct gb_chain_ray *growth, gsl_rng *rng, int64_t origin)
{
    const struct before before = look_before(growth, origin);
    const int64_t count = growth->grid->count;
    gsl_rng_memcpy(rng, &growth->rng);
    const struct ray ray = cast(&before, rng);
    g_assert_true(gb_chain_growth_try(growth, origin) == (ray.free > 0));
    g_assert_cmpint(growth->grid->count, ==, count + (ray.free > 0));
    if (ray.free > 0) {
        double apart[3];
        for (int k = 0; k < 3; k++) {
            apart[k] =
                growth->grid->position[3 * count + k] - before.start[k] - ray.best.x[k];
        }
        gb_cell_nearest(&growth->grid->cell, apart);
        g_assert_cmpfloat(gb_vec_length(apart), <, 1e-9);
    }
    return ray.free;
}

/* Grows a structure whose particles stay where their ray put them. */
static void check(const struct gb_chain_growth *grow)
{
    struct gb_error err = {0};
    struct gb_chain_growth staying = *grow;
    struct gb_chain_ray growth = {.grow = &staying, .room = 8 * GB_CHAIN_RAY_CANDIDATES};
    struct gb_cell cell;
    gsl_rng rng;
    static const double first[3] = {0.3, 0.0, 0.6};
    int rays = 0, choices = 0;
    staying.single_contact = 1.0;
    gb_cell_init(&cell, grow->dimension, grow->edges);
    g_assert_true(gb_random_open(&growth.rng, grow->seed, GB_RANDOM_POSITIONS, &err) &&
                  gb_random_open(&rng, grow->seed, GB_RANDOM_POSITIONS, &err) &&
                  gb_grid_create(&growth.grid, &cell, grow->r_eq, grow->count, &err));
    growth.candidates =
        gb_alloc_array((size_t)growth.room, sizeof *growth.candidates, &err);
    if (grow->model) {
        growth.diameter = gb_alloc_array((size_t)grow->count, sizeof(double), &err);
        g_assert_true(gb_assign_sizes_model(grow->model, growth.diameter, &err));
    }
    gb_grid_insert(growth.grid, first);
    g_assert_true(gb_chain_growth_try(&growth, 0)); /* the second one has no choice */
    while (growth.grid->count < grow->count && rays < 2 * grow->count) {
        const int64_t origin = (7 * rays) % growth.grid->count;
        choices += check_ray(&growth, &rng, origin);
        rays++;
    }
    g_test_message("%dD, r_meso %g%s: %lld particles, %d rays, %d free positions",
                   grow->dimension, grow->r_meso, grow->model ? ", sizes" : "",
                   (long long)growth.grid->count, rays, choices);
    g_assert_cmpint(choices, >, 2 * growth.grid->count); /* there was a choice */
    gb_alloc_free(growth.diameter);
    gb_alloc_free(growth.candidates);
    gb_grid_destroy(growth.grid);
    gb_random_close(&rng);
    gb_random_close(&growth.rng);
}

/* r_meso below the distance of contact too, where a position has no neighbour at all. */
static const double r_meso[] = {0.7, 1.0, 1.3, 2.0, 3.5};

static void test_equal(void)
{
    for (size_t m = 0; m < G_N_ELEMENTS(r_meso); m++) {
        for (int dimension = 2; dimension <= 3; dimension++) {
            struct packing packing;
            packing_init(&packing, dimension, 150, 6.0, dimension == 2 ? 0.4 : 0.24,
                         packing_h_eq, m + 1);
            packing.grow.r_meso = r_meso[m];
            check(&packing.grow);
            packing_finish(&packing);
        }
    }
}

static void test_sizes(void)
{
    const struct gb_model model =
        unequal_model("particles.count=150", "structure.base=6 d");
    struct gb_chain_growth grow = gb_chain_growth_from_model(&model);
    for (size_t m = 0; m < G_N_ELEMENTS(r_meso); m++) {
        grow.r_meso = r_meso[m];
        grow.seed = m + 1;
        check(&grow);
    }
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/chain-ray/equal", test_equal);
    g_test_add_func("/chain-ray/sizes", test_sizes);
    return g_test_run();
}
