#include "study/stability/stability_scene.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/vec.h"
#include "pack/structure/chain_growth.h"
#include "solve/moduli/probe.h"
#include "solve/relax/relax.h"

/* Disturbances in d: far below every overlap, far above rounding. */
static const double small = 1e-8;
/* Residual at which a grown packing is at rest: what is left moves no particle by as much
 * as a disturbance. */
static const double rest = 1e-11;
enum { CHAIN = 8, LATTICE = 4, ITERATIONS_MOST = 4000, EVALUATIONS_MOST = 100000 };

static bool make_params(struct gb_params *params, enum gb_stability_law law,
                        struct gb_error *err)
{
    static const char *const assignment[][3] = {
        [GB_STABILITY_ROD] = {"contact.mu=0", "contact.bridge_length=1 d"},
        [GB_STABILITY_FRICTION] = {"contact.mu=1", "contact.bridge_length=1 d"},
        [GB_STABILITY_BRIDGE] = {"contact.mu=0.1", "contact.bridge_length=0.008 d"},
    };
    gb_params_init(params);
    return gb_params_assign(params, "scene.kind=dynamic", err) &&
           gb_params_assign(params, "particles.diameter=9.7 nm", err) &&
           gb_params_assign(params, "particles.count=200", err) &&
           gb_params_assign(params, "loading.until=density = 0.6", err) &&
           gb_params_assign(params, "contact.viscosity=0 Pa s", err) &&
           gb_params_assign(params, "numerics.threads=1", err) &&
           gb_params_assign(params, "numerics.relaxer=fire", err) &&
           gb_params_assign(params, assignment[law][0], err) &&
           gb_params_assign(params, assignment[law][1], err);
}

/* Room for `along` particles in a row at the equilibrium distance r. */
static void set_row(struct gb_model *model, double r, int along, double *position)
{
    model->count = along;
    model->edges[0] = along == 2 ? 8.0 : along * r;
    model->edges[1] = model->edges[2] = 8.0;
    for (int i = 0; i < along; i++) {
        position[3 * i] = 1.0 + i * r;
        position[3 * i + 1] = position[3 * i + 2] = 4.0;
    }
}

static void set_lattice(struct gb_model *model, double r, double *position)
{
    model->count = LATTICE * LATTICE * LATTICE;
    for (int i = 0; i < LATTICE * LATTICE * LATTICE; i++) {
        position[3 * i] = r * (i % LATTICE + 0.5);
        position[3 * i + 1] = r * (i / LATTICE % LATTICE + 0.5);
        position[3 * i + 2] = r * (i / LATTICE / LATTICE + 0.5);
    }
    for (int k = 0; k < 3; k++) {
        model->edges[k] = LATTICE * r;
    }
}

static bool set_positions(struct gb_stability_scene *scene,
                          enum gb_stability_packing packing, double *position,
                          struct gb_error *err)
{
    const double r = 1.0 - scene->model.h_eq;
    switch (packing) {
    case GB_STABILITY_PAIR:
        set_row(&scene->model, r, 2, position);
        return true;
    case GB_STABILITY_CHAIN:
        set_row(&scene->model, r, CHAIN, position);
        return true;
    case GB_STABILITY_LATTICE:
        set_lattice(&scene->model, r, position);
        return true;
    default:
        break;
    }
    const struct gb_chain_growth grow = gb_chain_growth_from_model(&scene->model);
    return gb_chain_growth_run(&grow, position, err);
}

bool gb_stability_scene_reset(struct gb_stability_scene *scene, struct gb_error *err)
{
    return gb_world_copy_restore(scene->world, scene->rest, err) &&
           gb_world_evaluate(scene->world, err);
}

double gb_stability_scene_root(const struct gb_stability_scene *scene, int64_t k)
{
    const int64_t n = 3 * scene->model.count;
    const double mass = scene->mass ? scene->mass[k % n / 3] : 1.0;
    return sqrt(k < n ? mass : mass * scene->inertia);
}

void gb_stability_scene_move(const struct gb_stability_scene *scene, const double *mode,
                             double by)
{
    const struct gb_bodies b = gb_world_bodies(scene->world);
    const int64_t n = 3 * b.count;
    for (int64_t i = 0; i < n; i++) {
        b.position[i] += by * mode[i] / gb_stability_scene_root(scene, i);
        b.rotation[i] += by * mode[n + i] / gb_stability_scene_root(scene, n + i);
    }
}

/* Mass-weighted: lengths, and turns times the root of the inertia. */
static double unit_length(double *vector, int64_t n)
{
    double square = 0.0;
    for (int64_t i = 0; i < n; i++) {
        square += vector[i] * vector[i];
    }
    const double length = sqrt(square);
    for (int64_t i = 0; i < n && length > 0.0; i++) {
        vector[i] /= length;
    }
    return length;
}

/* image = M^(-1/2) K M^(-1/2) mode, from the forces of a small move.  The springs carry a
 * history: every product starts from the packing at rest. */
static bool multiply(struct gb_stability_scene *scene, const double *force_at_rest,
                     const double *mode, double *image, struct gb_error *err)
{
    if (!gb_stability_scene_reset(scene, err)) {
        return false;
    }
    const struct gb_bodies b = gb_world_bodies(scene->world);
    const int64_t n = 3 * b.count;
    gb_stability_scene_move(scene, mode, small);
    if (!gb_world_evaluate(scene->world, err)) {
        return false;
    }
    for (int64_t i = 0; i < n; i++) {
        image[i] = (force_at_rest[i] - b.force[i]) / small;
        image[n + i] = (force_at_rest[n + i] - b.torque[i]) / small;
    }
    for (int64_t k = 0; k < 2 * n; k++) {
        image[k] /= gb_stability_scene_root(scene, k);
    }
    return true;
}

/* The largest eigenvalue is that of the stiffest mode; K + shift would only be needed if
 * a negative one were larger, which a packing at rest does not have. */
static bool find_mode(struct gb_stability_scene *scene, struct gb_error *err)
{
    const int64_t n = 3 * scene->model.count;
    double *work = gb_alloc_array(4 * (size_t)n, sizeof *work, err);
    scene->mode = gb_alloc_array(2 * (size_t)n, sizeof *scene->mode, err);
    bool done = work && scene->mode && gb_stability_scene_reset(scene, err);
    if (done) {
        const struct gb_bodies b = gb_world_bodies(scene->world);
        memcpy(work + 2 * n, b.force, (size_t)n * sizeof *work);
        memcpy(work + 3 * n, b.torque, (size_t)n * sizeof *work);
        for (int64_t i = 0; i < 2 * n; i++) { /* no symmetry, the same every time */
            const bool moves = scene->model.dimension == 3 || (i % 3 == 1) == (i >= n);
            scene->mode[i] = moves ? sin(1.0 + 12.9898 * (double)i) : 0.0;
        }
        unit_length(scene->mode, 2 * n);
    }
    double last = 0.0;
    for (int i = 0; i < ITERATIONS_MOST && done; i++) {
        done = multiply(scene, work + 2 * n, scene->mode, work, err);
        const double value = unit_length(work, 2 * n);
        memcpy(scene->mode, work, 2 * (size_t)n * sizeof *work);
        scene->frequency = sqrt(value);
        if (i > 20 && fabs(value - last) < 1e-7 * value) {
            break;
        }
        last = value;
    }
    gb_alloc_free(work);
    return done;
}

/* Pairs grown a little farther apart than at equilibrium pull each other. */
static bool settle(struct gb_stability_scene *scene, struct gb_error *err)
{
    struct gb_relax *relax = NULL;
    bool done = gb_relax_create(&relax, &scene->model, err);
    if (done) {
        relax->tolerance = rest;
        relax->scale = GB_TOLERANCE_CONTACT;
        relax->max_evaluations = EVALUATIONS_MOST;
        gb_relax_start(relax, scene->world);
        const enum gb_relax_outcome outcome =
            gb_relax_advance(relax, scene->world, EVALUATIONS_MOST, err);
        done = outcome == GB_RELAX_DONE ||
               (outcome != GB_RELAX_FAILED &&
                gb_error_set(err, GB_ERR_NOT_CONVERGED, "the packing does not settle"));
    }
    gb_relax_destroy(relax);
    return done;
}

bool gb_stability_scene_init(struct gb_stability_scene *scene,
                             enum gb_stability_packing packing, enum gb_stability_law law,
                             double inertia, struct gb_error *err)
{
    struct gb_params params;
    *scene = (struct gb_stability_scene){.inertia = inertia};
    if (!make_params(&params, law, err) || !gb_model_init(&scene->model, &params, err)) {
        return false;
    }
    /* attraction across gaps would leave no scene at rest */
    scene->model.numerics.cutoff = 1.0;
    double *position =
        gb_alloc_array(3 * (size_t)scene->model.count, sizeof *position, err);
    bool done = position && set_positions(scene, packing, position, err) &&
                gb_world_create(&scene->world, &scene->model, position, err);
    gb_alloc_free(position);
    if (done) {
        gb_world_set_step(scene->world, 1.0);
        done = settle(scene, err) &&
               gb_world_copy_save(scene->world, &scene->rest, err) &&
               find_mode(scene, err);
    }
    return done;
}

static bool assign_masses(struct gb_stability_scene *scene, int power,
                          struct gb_error *err)
{
    const double *diameter = gb_world_diameters(scene->world);
    if (diameter == NULL) {
        return true;
    }
    scene->mass = gb_alloc_array((size_t)scene->model.count, sizeof *scene->mass, err);
    for (int64_t i = 0; scene->mass && i < scene->model.count; i++) {
        scene->mass[i] = 1.0;
        for (int k = 0; k < power; k++) {
            scene->mass[i] *= diameter[i];
        }
    }
    return scene->mass != NULL;
}

bool gb_stability_scene_copy(struct gb_stability_scene *scene,
                             const struct gb_world *world, double inertia, int power,
                             struct gb_error *err)
{
    struct gb_probe *probe = NULL;
    *scene = (struct gb_stability_scene){.model = *gb_world_model(world),
                                         .inertia = inertia};
    const double viscous = scene->model.dynamics.viscous;
    scene->model.dynamics.viscous = 0.0;
    scene->model.numerics.single = false;
    bool done = gb_probe_create(&probe, world, NULL, NULL, err) &&
                gb_world_create(&scene->world, &scene->model,
                                gb_world_position(probe->world), err) &&
                gb_world_copy_save(probe->world, &scene->rest, err) &&
                assign_masses(scene, power, err);
    gb_probe_destroy(probe);
    if (done) {
        gb_world_set_step(scene->world, 1.0);
        done = find_mode(scene, err);
    }
    scene->model.dynamics.viscous = viscous;
    return done;
}

void gb_stability_scene_finish(struct gb_stability_scene *scene)
{
    gb_world_destroy(scene->world);
    gb_world_copy_destroy(scene->rest);
    gb_alloc_free(scene->mode);
    gb_alloc_free(scene->mass);
    *scene = (struct gb_stability_scene){0};
}

double gb_stability_scene_exact(const struct gb_stability_scene *scene,
                                enum gb_stability_packing packing,
                                enum gb_stability_law law)
{
    const struct gb_model *model = &scene->model;
    const double h = model->h_eq;
    const double normal = gb_law_rod_stiffness(&model->rod, h);
    if (packing == GB_STABILITY_CHAIN && law == GB_STABILITY_ROD) {
        return sqrt(4.0 * normal);
    }
    if (packing != GB_STABILITY_PAIR) {
        return NAN;
    }
    /* two masses, and two inertias on levers of half a distance */
    const double r = 1.0 - h;
    const double shear =
        model->slip.motion * gb_law_slip_shear_stiffness(&model->slip, 0.5 * sqrt(h));
    return law == GB_STABILITY_ROD ? sqrt(2.0 * normal)
                                   : sqrt(shear * (2.0 + 0.5 * r * r / scene->inertia));
}
