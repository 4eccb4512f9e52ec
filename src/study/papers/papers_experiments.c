#include "study/papers/papers_experiments.h"

#include <string.h>

#include <glib.h>

#include "io/preset.h"

#define SMALL_CELL "particles.count=1000", "structure.base=auto"
#define SHORT_HOLD "loading.relax=2 ns", "loading.hold=10 ns"

static const struct gb_papers_experiment table[] = {
    {"P1-fig5", "four powders with bridges, P1 Figs. 5, 6, 8", "p1-set2-9.7nm",
     .change = {"output.snapshots_at=1 GPa"},
     .axis = "particles.diameter=9.7;16;21;38 nm",
     .extent = {{.cells = 10}, {.cells = 16, .change = {SMALL_CELL}}}},
    {"P1-fig6", "four powders by friction alone, P1 Fig. 6", "p1-nobridge-9.7nm",
     .change = {"loading.until=105 MPa", "loading.unload_from=100 MPa"},
     .axis = "particles.diameter=9.7;16;21;38 nm",
     .extent = {{.cells = 10}, {.cells = 16, .change = {SMALL_CELL}}}},
    {"P1-fig12", "three geometries of loading, P1 Figs. 11 to 14", "p1-set1-uniaxial",
     .axis = "loading.geometry=uniaxial;biaxial;isotropic",
     .extent = {{.cells = 10}, {.cells = 16, .change = {SMALL_CELL}}}},
    {"P1-fig3", "structure of 600 discs on 30 d, P1 Fig. 3", "p1-fig3",
     .change = {"structure.seed=1", "loading.until=density=0.53", "loading.unload_from="},
     .extent = {{.cells = 100}, {.cells = 20}}},
    {"P2-v1", "discs at 6.8e8 1/s, P2 Figs. 2 to 4, Table 1", "p2-v1",
     .extent = {{.cells = 30}, {.cells = 16, .change = {SHORT_HOLD}}}},
    {"P2-v2", "discs at 6.8e7 1/s", "p2-v2",
     .extent = {{.cells = 30}, {.cells = 16, .change = {SHORT_HOLD}}}},
    {"P2-v3", "discs at 6.8e6 1/s", "p2-v3",
     .extent = {{.cells = 16}, {.cells = 6, .change = {SHORT_HOLD}}}},
    {"P2-v4", "discs at 6.8e5 1/s", "p2-v4", .extent = {{.cells = 4}, {.cells = 0}}},
    {"P2-v5", "discs at 6.8e4 1/s", "p2-v5", .extent = {{.cells = 1}, {.cells = 0}}},
    {"P2-full", "the same with both options that P2's text leaves open", "p2-v1",
     .change = {"contact.bridge_radius=current", "contact.relative_motion=full"},
     .axis = "loading.rate=6.8e8;6.8e7;6.8e6 1/s",
     .extent = {{.cells = 10}, {.cells = 0}}},
    {"P3-hertz", "frictionless Hertz in P3's die, P3 Figs. 16 to 18", "p3-hertz-mu0",
     .extent = {{.cells = 3}, {.cells = 3, .change = {"numerics.fidelity=fast"}}}},
    {"P3-storakers", "frictionless Storakers, P3 Figs. 17, 18", "p3-storakers-m0.2-mu0",
     .axis = "material.hardening=0;0.1;0.2", .extent = {{.cells = 3}, {.cells = 0}}},
    {"P3-friction", "Hertz with friction, P3 Fig. 19", "p3-hertz-mu0.01",
     .axis = "contact.mu=0.01;0.02;0.05", .extent = {{.cells = 3}, {.cells = 0}}},
    {"P3-storakers-friction", "Storakers with friction, P3 Fig. 20",
     "p3-storakers-m0.2-mu0.01", .axis = "contact.mu=0.01;0.02;0.05",
     .extent = {{.cells = 3}, {.cells = 0}}},
    {0},
};

const struct gb_papers_experiment *gb_papers_experiments_table(void)
{
    return table;
}

size_t gb_papers_experiments_count(void)
{
    return G_N_ELEMENTS(table) - 1;
}

size_t gb_papers_experiments_index(const char *name)
{
    size_t k = 0;
    while (table[k].name != NULL && strcmp(table[k].name, name) != 0) {
        k++;
    }
    return k;
}

static bool apply(struct gb_params *params, const char *const change[GB_PAPERS_CHANGES],
                  struct gb_error *err)
{
    for (int k = 0; k < GB_PAPERS_CHANGES && change[k] != NULL; k++) {
        if (!gb_params_assign(params, change[k], err)) {
            return false;
        }
    }
    return true;
}

bool gb_papers_experiments_axes(const struct gb_papers_experiment *experiment,
                                struct gb_axes *axes, struct gb_error *err)
{
    *axes = (struct gb_axes){0};
    return experiment->axis == NULL || gb_axes_add(axes, experiment->axis, err);
}

bool gb_papers_experiments_params(const struct gb_papers_experiment *experiment,
                                  enum gb_papers_size size, size_t point,
                                  struct gb_params *params, struct gb_error *err)
{
    struct gb_preset *preset = NULL;
    struct gb_axes axes = {0};
    bool good = gb_preset_load(&preset, experiment->preset, err);
    if (good) {
        *params = *gb_preset_params(preset);
        good = apply(params, experiment->change, err) &&
               (size == GB_PAPERS_SIZES ||
                apply(params, experiment->extent[size].change, err)) &&
               gb_papers_experiments_axes(experiment, &axes, err) &&
               gb_axes_apply(&axes, point, params, err);
    }
    gb_axes_finish(&axes);
    gb_preset_destroy(preset);
    return good;
}
