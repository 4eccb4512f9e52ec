#include "pack/structure/random.h"

#include <Random123/philox.h>
#include <math.h>

#include "base/alloc.h"

/* A block of philox4x32 is two numbers of 64 bits. */
enum { PER_BLOCK = 2 };

struct philox {
    philox4x32_key_t key;
    philox4x32_ctr_t counter; /* index of the block in 0 and 1, stream in 2 and 3 */
    uint64_t number[PER_BLOCK];
    int used;
};

static void next_block(struct philox *philox)
{
    const philox4x32_ctr_t block = philox4x32(philox->counter, philox->key);
    for (int k = 0; k < PER_BLOCK; k++) {
        philox->number[k] = (uint64_t)block.v[2 * k + 1] << 32 | block.v[2 * k];
    }
    philox->used = 0;
    philox->counter.v[0]++;
    philox->counter.v[1] += philox->counter.v[0] == 0;
}

static uint64_t next_number(void *state)
{
    struct philox *philox = state;
    if (philox->used == PER_BLOCK) {
        next_block(philox);
    }
    return philox->number[philox->used++];
}

static unsigned long next_integer(void *state)
{
    return (unsigned long)(next_number(state) >> 32);
}

/* 53 bits, [0, 1). */
static double next_uniform(void *state)
{
    return (double)(next_number(state) >> 11) * 0x1p-53;
}

static void key_of(struct philox *philox, uint64_t seed, uint64_t stream)
{
    *philox = (struct philox){
        .key = {{(uint32_t)seed, (uint32_t)(seed >> 32)}},
        .counter = {{0, 0, (uint32_t)stream, (uint32_t)(stream >> 32)}},
        .used = PER_BLOCK,
    };
}

static void set_philox(void *state, unsigned long seed)
{
    key_of(state, seed, GB_RANDOM_POSITIONS);
}

static const gsl_rng_type philox_type = {
    .name = "philox4x32-10",
    .max = 0xffffffffu,
    .min = 0,
    .size = sizeof(struct philox),
    .set = set_philox,
    .get = next_integer,
    .get_double = next_uniform,
};

bool gb_random_open(gsl_rng *random, uint64_t seed, enum gb_random_stream stream,
                    struct gb_error *err)
{
    random->type = &philox_type;
    random->state = gb_alloc_array(1, random->type->size, err);
    if (!random->state) {
        return false;
    }
    key_of(random->state, seed, stream);
    return true;
}

void gb_random_close(gsl_rng *random)
{
    gb_alloc_free(random->state);
    random->state = NULL;
}

/* A point in the unit disc, not its centre; returns its squared radius. */
static double point_in_disc(const gsl_rng *random, double *u, double *v)
{
    double square;
    do {
        *u = 2.0 * gsl_rng_uniform(random) - 1.0;
        *v = 2.0 * gsl_rng_uniform(random) - 1.0;
        square = *u * *u + *v * *v;
    } while (square > 1.0 || square == 0.0);
    return square;
}

void gb_random_direction_3d(const gsl_rng *random, double direction[3])
{
    double u, v;
    const double square = point_in_disc(random, &u, &v);
    const double scale = 2.0 * sqrt(1.0 - square);
    direction[0] = scale * u;
    direction[1] = scale * v;
    direction[2] = 2.0 * square - 1.0;
}

/* The angle of the point, doubled. */
void gb_random_direction_2d(const gsl_rng *random, double *x, double *z)
{
    double u, v;
    const double square = point_in_disc(random, &u, &v);
    *x = (u * u - v * v) / square;
    *z = 2.0 * u * v / square;
}
