#include <math.h>
#include <string.h>

#include "study/bench/bench.h"
#include "study/bench/bench_packing.h"

enum { ROUND_BATCHES = 7 };

/* Changes of the contact law, as bits. */
enum change {
    NO_BRIDGES = 1,
    NO_FRICTION = 2, /* a friction law without friction has no bridges */
    NO_ATTRACTION = 4,
    NO_COHESION = 8 /* Hertz, Mindlin and Coulomb only */
};

/* What a packing is timed without. */
struct variant {
    const char *name;
    unsigned changes; /* enum change */
};

static const struct variant variants[GB_BENCH_TERMS] = {
    {"all terms", 0},
    {"without bridges", NO_BRIDGES},
    {"without friction and bridges", NO_BRIDGES | NO_FRICTION},
    {"without attraction", NO_ATTRACTION},
    {"grains without cohesion", NO_BRIDGES | NO_ATTRACTION | NO_COHESION},
    {"elastic spheres only", NO_BRIDGES | NO_FRICTION | NO_ATTRACTION},
};

static bool keeps(const struct variant *variant, enum change change)
{
    return (variant->changes & change) == 0;
}

static bool leave_out(struct gb_params *params, const struct variant *variant,
                      struct gb_error *err)
{
    return (keeps(variant, NO_COHESION) ||
            gb_params_assign(params, "contact.normal=hertz", err)) &&
           (keeps(variant, NO_BRIDGES) ||
            gb_params_assign(params, "contact.bridge_length=1 d", err)) &&
           (keeps(variant, NO_FRICTION) ||
            (gb_params_assign(params, "contact.mu=0", err) &&
             gb_params_assign(params, "contact.mu_pivot=0", err))) &&
           (keeps(variant, NO_ATTRACTION) ||
            gb_params_assign(params, "material.epsilon=0 kB", err));
}

/* The packing as pressed, under another law; the median of a round, NaN without such a
 * term. */
static bool time_variant(const struct gb_world *pressed, const struct gb_params *params,
                         const struct variant *variant, double *median,
                         struct gb_error *err)
{
    struct gb_params changed = *params;
    struct gb_model model;
    struct gb_world *world = NULL;
    struct gb_relax *relax = NULL;
    changed.threads = 1;
    if (!leave_out(&changed, variant, err) || !gb_model_init(&model, &changed, err)) {
        return false;
    }
    const struct gb_terms *carried = &gb_world_model(pressed)->terms;
    if ((!keeps(variant, NO_BRIDGES) && !carried->bridges) ||
        (!keeps(variant, NO_FRICTION) && !carried->friction) ||
        (!keeps(variant, NO_ATTRACTION) && !carried->attraction)) {
        *median = NAN;
        return true;
    }
    memcpy(model.edges, gb_world_cell(pressed)->edge, sizeof model.edges);
    const bool done = gb_world_create(&world, &model, gb_world_position(pressed), err) &&
                      gb_relax_create(&relax, &model, err) &&
                      gb_bench_packing_time(world, relax, ROUND_BATCHES, median, err);
    gb_relax_destroy(relax);
    gb_world_destroy(world);
    return done;
}

bool gb_bench_terms(struct gb_bench_term term[GB_BENCH_TERMS],
                    const struct gb_params *params, double coordination,
                    struct gb_error *err)
{
    struct gb_bench_packing pressed;
    double seconds[GB_BENCH_TERMS][GB_BENCH_ROUNDS];
    bool done = gb_bench_packing_press(&pressed, params, coordination, err);
    for (int round = 0; round < GB_BENCH_ROUNDS; round++) {
        for (int i = 0; i < GB_BENCH_TERMS && done; i++) {
            done = time_variant(pressed.world, params, &variants[i], &seconds[i][round],
                                err);
        }
    }
    for (int i = 0; i < GB_BENCH_TERMS && done; i++) {
        term[i].name = variants[i].name;
        term[i].evaluation = gb_bench_figure_of(seconds[i], GB_BENCH_ROUNDS);
    }
    gb_bench_packing_finish(&pressed);
    return done;
}
