/* Times one evaluation with its move on one core, with and without terms of the contact
 * laws: the same pressed packing, in turn.
 * Usage: time_terms [group.key=value]...
 * Rows without a term that the scene lacks are left out. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include <glib.h>

#include "bench.h"

enum { BATCHES = 7 };

/* Terms that are left out, as bits. */
enum change {
    NO_BRIDGES = 1,
    NO_FRICTION = 2, /* a friction law without friction has no bridges */
    NO_ATTRACTION = 4,
    NO_COHESION = 8 /* Hertz, Mindlin and Coulomb only */
};

static const struct variant {
    const char *name;
    unsigned changes; /* enum change */
} variants[] = {
    {"all terms", 0},
    {"without bridges", NO_BRIDGES},
    {"without friction and bridges", NO_BRIDGES | NO_FRICTION},
    {"without attraction", NO_ATTRACTION},
    {"grains without cohesion", NO_BRIDGES | NO_ATTRACTION | NO_COHESION},
    {"elastic spheres only", NO_BRIDGES | NO_FRICTION | NO_ATTRACTION},
};

static bool leave_out(struct gb_params *params, unsigned changes, struct gb_error *err)
{
    static const struct {
        enum change change;
        const char *assignment;
    } how[] = {{NO_COHESION, "contact.normal=hertz"},
               {NO_BRIDGES, "contact.bridge_length=1 d"},
               {NO_FRICTION, "contact.mu=0"},
               {NO_FRICTION, "contact.mu_pivot=0"},
               {NO_ATTRACTION, "material.epsilon=0 kB"}};
    for (size_t i = 0; i < G_N_ELEMENTS(how); i++) {
        if ((changes & how[i].change) &&
            !gb_params_assign(params, how[i].assignment, err)) {
            return false;
        }
    }
    return true;
}

/* The packing as pressed, with another law.  NaN if the scene has no such term. */
static bool time_variant(const struct packing *packing, const struct gb_params *params,
                         unsigned changes, double *median, struct gb_error *err)
{
    const struct gb_terms *terms = &packing->model.terms;
    struct gb_params changed = *params;
    struct gb_model model;
    struct gb_world *world = NULL;
    struct gb_relax *relax = NULL;
    if (((changes & NO_BRIDGES) && !terms->bridges) ||
        ((changes & NO_FRICTION) && !terms->friction) ||
        ((changes & NO_ATTRACTION) && !terms->attraction)) {
        *median = NAN;
        return true;
    }
    changed.threads = 1;
    if (!leave_out(&changed, changes, err) || !gb_model_init(&model, &changed, err)) {
        return false;
    }
    memcpy(model.edges, gb_world_cell(packing->world)->edge, sizeof model.edges);
    const bool good =
        gb_world_create(&world, &model, gb_world_position(packing->world), err) &&
        gb_relax_create(&relax, &model, err) &&
        packing_time(world, relax, BATCHES, median, err);
    gb_relax_destroy(relax);
    gb_world_destroy(world);
    return good;
}

int main(int argc, char **argv)
{
    struct gb_error err = {0};
    struct gb_params params;
    struct packing packing = {0};
    double seconds[G_N_ELEMENTS(variants)][ROUNDS];
    (void)argc;
    g_set_prgname("time_terms");
    bool good =
        make_scene(&params, argv + 1, &err) && packing_press(&packing, &params, &err);
    for (int round = 0; round < ROUNDS; round++) {
        for (size_t i = 0; i < G_N_ELEMENTS(variants) && good; i++) {
            good = time_variant(&packing, &params, variants[i].changes,
                                &seconds[i][round], &err);
        }
    }
    for (size_t i = 0; i < G_N_ELEMENTS(variants) && good; i++) {
        print_figure(variants[i].name, figure_of(seconds[i]), 1e6 / (double)params.count,
                     "us per particle");
    }
    packing_finish(&packing);
    return finish(good, &err);
}
