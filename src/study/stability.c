/* The longest stable step of each method.  A small disturbance of a packing at rest grows when
 * the step is longer than a bound.  Theory: from the highest frequency of the linearised
 * packing, which power iteration finds.  Measurement: the method itself runs, and the step is
 * bisected. */
#include "study/stability.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "base/alloc.h"
#include "base/listing.h"
#include "base/vec.h"
#include "greenbody/params.h"
#include "law/critical_step.h"
#include "pack/cell/world.h"
#include "pack/structure/chain_growth.h"
#include "run/record/kept_states.h"
#include "scene/loading_kind.h"
#include "scene/model.h"
#include "solve/loading/loading_dynamic.h"
#include "solve/moduli/probe.h"
#include "solve/relax/relax.h"
#include "solve/relax/relax_fire.h"
#include "solve/verlet.h"

/* --- packings at rest ----------------------------------------------------------------- */

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

/* By what a component of the mode is divided for a motion, and an elastic force for a
 * component: the root of the mass, for turns (k from 3 x count on) of the inertia. */
static double stability_scene_root(const struct gb_stability_scene *scene, int64_t k)
{
    const int64_t n = 3 * scene->model.count;
    const double mass = scene->mass ? scene->mass[k % n / 3] : 1.0;
    return sqrt(k < n ? mass : mass * scene->inertia);
}

/* Moves the particles by `by` times the mode. */
static void stability_scene_move(const struct gb_stability_scene *scene,
                                 const double *mode, double by)
{
    const struct gb_bodies b = gb_world_bodies(scene->world);
    const int64_t n = 3 * b.count;
    for (int64_t i = 0; i < n; i++) {
        b.position[i] += by * mode[i] / stability_scene_root(scene, i);
        b.rotation[i] += by * mode[n + i] / stability_scene_root(scene, n + i);
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
    stability_scene_move(scene, mode, small);
    if (!gb_world_evaluate(scene->world, err)) {
        return false;
    }
    for (int64_t i = 0; i < n; i++) {
        image[i] = (force_at_rest[i] - b.force[i]) / small;
        image[n + i] = (force_at_rest[n + i] - b.torque[i]) / small;
    }
    for (int64_t k = 0; k < 2 * n; k++) {
        image[k] /= stability_scene_root(scene, k);
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

/* A copy of a world right after an evaluation, brought to rest, its mode without viscous
 * forces.  power: masses are the diameters to this power.  Errors: those of
 * gb_probe_create. */
static bool stability_scene_copy(struct gb_stability_scene *scene,
                                 const struct gb_world *world, double inertia, int power,
                                 struct gb_error *err)
{
    struct gb_probe *probe = NULL;
    *scene =
        (struct gb_stability_scene){.model = *gb_world_model(world), .inertia = inertia};
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

/* The frequency in closed form: normal or rotational-tangential mode of a pair, normal
 * mode of a chain; NaN for other scenes. */
static double stability_scene_exact(const struct gb_stability_scene *scene,
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

/* --- the methods ---------------------------------------------------------------------- */

/* A disturbance is this small (d) and has grown when it is a thousand times larger: far
 * from where contacts open, slide or break. */
static const double disturbance = 1e-10, grown = 1e3;
/* Steps watched: 1 % above the bound it grows within a hundred. */
enum { STEPS = 500, BISECTIONS = 14 };
/* The search begins between these shares of the theoretical bound. */
static const double share_low = 0.05, share_high = 4.0;

static const char *const scenes[] = {"pair", "chain", "lattice", "packing"};
static const char *const laws[] = {"rod", "friction", "bridge"};
enum { SCENES = 4, LAWS = 3 };

/* A method: how it moves with a given step, and where theory bounds it. */
struct method {
    const char *name;
    double inertia;
    int power; /* masses of unequal particles are their diameters to this power */
    double damping;
    double (*bound)(double frequency, double damping);
    /* Continues a disturbed scene; its largest disturbance over the first. */
    bool (*run)(const struct gb_stability_scene *scene, double step, double *growth,
                struct gb_error *err);
    double (*used)(const struct gb_stability_scene *scene);
};

/* (15): the disturbance is multiplied by 1 - k lambda. */
static double steepest_bound(double frequency, double damping)
{
    (void)damping;
    return 2.0 / (frequency * frequency);
}

/* FIRE that is not let go downhill is (15) with k = step^2: the bound of its step where
 * the velocity is taken away at every move. */
static double fire_bound(double frequency, double damping)
{
    (void)damping;
    return M_SQRT2 / frequency;
}

static double length_of(const double *v, int64_t n)
{
    double square = 0.0;
    for (int64_t i = 0; i < n; i++) {
        square += v[i] * v[i];
    }
    return sqrt(square);
}

/* What keeps moving: the disturbance of a scene at rest shows in its forces. */
static double unrest(const struct gb_stability_scene *scene)
{
    const struct gb_bodies b = gb_world_bodies(scene->world);
    return hypot(length_of(b.force, 3 * b.count),
                 length_of(b.torque, 3 * b.count) / sqrt(scene->inertia));
}

static bool run_verlet(const struct gb_stability_scene *scene, double step,
                       double *growth, struct gb_error *err)
{
    static const double still[3] = {1.0, 1.0, 1.0};
    struct gb_verlet verlet;
    if (!gb_verlet_init(&verlet, &scene->model, err)) {
        return false;
    }
    const int64_t n = 3 * scene->model.count;
    const double speed = disturbance * scene->frequency;
    for (int64_t i = 0; i < n; i++) {
        verlet.velocity[i] = speed * scene->mode[i] / stability_scene_root(scene, i);
        verlet.spin[i] = speed * scene->mode[n + i] / stability_scene_root(scene, n + i);
    }
    const double first = gb_verlet_kinetic(&verlet);
    bool done = true;
    for (int i = 0; i < STEPS && done && *growth < grown; i++) {
        done = gb_verlet_step(&verlet, scene->world, step, still, err);
        *growth = fmax(*growth, sqrt(gb_verlet_kinetic(&verlet) / first));
    }
    gb_verlet_finish(&verlet);
    return done;
}

/* Moves and evaluations of a relaxer in turn, from the disturbed scene; data begins with
 * the struct gb_relax. */
static bool run_moves(const struct gb_stability_scene *scene,
                      void (*move)(void *data, struct gb_world *world), void *data,
                      double *growth, struct gb_error *err)
{
    struct gb_relax *relax = data;
    stability_scene_move(scene, scene->mode, disturbance);
    bool done = gb_relax_evaluate(relax, scene->world, err);
    const double first = unrest(scene);
    for (int i = 0; i < STEPS && done && *growth < grown; i++) {
        move(data, scene->world);
        done = gb_relax_evaluate(relax, scene->world, err);
        *growth = fmax(*growth, unrest(scene) / first);
    }
    return done;
}

/* Steepest held at one step. */
struct held_steepest {
    struct gb_relax relax;
    double step;
};

static void move_steepest(void *data, struct gb_world *world)
{
    gb_relax_steepest_step(world, ((struct held_steepest *)data)->step);
}

static bool run_steepest(const struct gb_stability_scene *scene, double step,
                         double *growth, struct gb_error *err)
{
    struct held_steepest steepest = {{.method = &gb_relax_steepest}, step};
    return run_moves(scene, move_steepest, &steepest, growth, err);
}

/* FIRE held at one step. */
struct held_fire {
    struct gb_relax relax;
    struct gb_relax_fire_state state;
    struct gb_relax_fire_tuning tuning;
};

static void move_fire(void *data, struct gb_world *world)
{
    struct held_fire *fire = data;
    gb_relax_fire_move(&fire->relax, &fire->state, &fire->tuning, world);
}

static bool run_held(const struct gb_stability_scene *scene, double step,
                     const struct gb_relax_fire_tuning *tuning, double *growth,
                     struct gb_error *err)
{
    struct held_fire fire = {.relax.method = &gb_relax_fire, .tuning = *tuning};
    fire.tuning.step_first = fire.tuning.step_most = step;
    fire.tuning.shrink = 1.0;
    const size_t n = 3 * (size_t)scene->model.count;
    bool done = true;
    for (int v = 0; v < 2 && done; v++) {
        fire.relax.vector[v] = gb_alloc_array(n, sizeof(double), err);
        done = fire.relax.vector[v] != NULL;
    }
    if (done) {
        gb_relax_fire_rest(&fire.relax, &fire.state, &fire.tuning, scene->world);
        done = run_moves(scene, move_fire, &fire, growth, err);
    }
    gb_alloc_free(fire.relax.vector[0]);
    gb_alloc_free(fire.relax.vector[1]);
    return done;
}

static bool run_fire(const struct gb_stability_scene *scene, double step, double *growth,
                     struct gb_error *err)
{
    return run_held(scene, step, &gb_relax_fire_plain, growth, err);
}

static bool run_predict(const struct gb_stability_scene *scene, double step,
                        double *growth, struct gb_error *err)
{
    return run_held(scene, step, &gb_relax_predict_tuning, growth, err);
}

/* What the engine takes here by itself. */
static double used_verlet(const struct gb_stability_scene *scene)
{
    double *scratch = gb_alloc_array((size_t)scene->model.count, sizeof *scratch, NULL);
    const double frequency = scratch ? gb_verlet_frequency(scene->world, scratch) : NAN;
    gb_alloc_free(scratch);
    /* where the guard cuts a given step */
    return gb_critical_step(frequency, 0.5 * scene->model.dynamics.viscous * frequency);
}

static double used_steepest(const struct gb_stability_scene *scene)
{
    double *scratch = gb_alloc_array((size_t)scene->model.count, sizeof *scratch, NULL);
    const double k =
        scratch ? 1.0 / gb_relax_steepest_stiffest(scene->world, scratch) : NAN;
    gb_alloc_free(scratch);
    return k;
}

static double used_fire(const struct gb_stability_scene *scene)
{
    (void)scene;
    return gb_relax_fire_plain.step_most;
}

static double used_predict(const struct gb_stability_scene *scene)
{
    (void)scene;
    return gb_relax_predict_tuning.step_most;
}

static const double sphere = 0.1;

static const struct method methods[] = {
    {"verlet", sphere, 3, 0.0, gb_critical_step, run_verlet, used_verlet},
    {"verlet", sphere, 3, 0.3, gb_critical_step, run_verlet, used_verlet},
    {"verlet", sphere, 3, 1.0, gb_critical_step, run_verlet, used_verlet},
    {"steepest", GB_RELAX_INERTIA, 0, 0.0, steepest_bound, run_steepest, used_steepest},
    {"fire", GB_RELAX_INERTIA, 1, 0.0, fire_bound, run_fire, used_fire},
    {"predict", GB_RELAX_INERTIA, 1, 0.0, fire_bound, run_predict, used_predict},
};
enum { METHODS = sizeof methods / sizeof methods[0] };

int gb_stability_rows(void)
{
    return METHODS * SCENES * LAWS;
}

static const struct method *method_of(int index)
{
    return &methods[index / (SCENES * LAWS)];
}

static bool open_scene(int index, struct gb_stability_scene *scene, struct gb_error *err)
{
    const struct method *method = method_of(index);
    if (!gb_stability_scene_init(
            scene, (enum gb_stability_packing)(index / LAWS % SCENES),
            (enum gb_stability_law)(index % LAWS), method->inertia, err)) {
        return false;
    }
    /* viscous forces are twice xi over omega times the rate of the elastic ones */
    scene->model.dynamics.viscous = 2.0 * method->damping / scene->frequency;
    return true;
}

static bool grows(const struct method *method, struct gb_stability_scene *scene,
                  double step, bool *result, struct gb_error *err)
{
    double growth = 1.0;
    gb_world_set_step(scene->world, step);
    if (!gb_stability_scene_reset(scene, err)) {
        return false;
    }
    const bool whole = method->run(scene, step, &growth, err);
    *result = !whole || growth >= grown;
    return whole || err->code == GB_ERR_GUARD;
}

static bool bisect(const struct method *method, struct gb_stability_scene *scene,
                   double theory, double *measured, struct gb_error *err)
{
    double low = share_low, high = share_high;
    for (int i = 0; i < BISECTIONS; i++) {
        const double middle = sqrt(low * high);
        bool unstable = false;
        if (!grows(method, scene, middle * theory, &unstable, err)) {
            return false;
        }
        *(unstable ? &high : &low) = middle;
    }
    *measured = theory * sqrt(low * high);
    return true;
}

bool gb_stability_measure(int index, struct gb_stability_row *row, struct gb_error *err)
{
    const struct method *method = method_of(index);
    struct gb_stability_scene scene;
    bool done = open_scene(index, &scene, err);
    if (done) {
        const double exact = stability_scene_exact(
            &scene, (enum gb_stability_packing)(index / LAWS % SCENES),
            (enum gb_stability_law)(index % LAWS));
        *row = (struct gb_stability_row){
            .method = method->name,
            .scene = scenes[index / LAWS % SCENES],
            .law = laws[index % LAWS],
            .damping = method->damping,
            .theory = method->bound(scene.frequency, method->damping),
            .exact =
                isfinite(exact) ? method->bound(exact, method->damping) : (double)NAN,
        };
        done = bisect(method, &scene, row->theory, &row->measured, err) &&
               gb_stability_scene_reset(&scene, err);
        row->used = done ? method->used(&scene) : (double)NAN;
    }
    gb_stability_scene_finish(&scene);
    return done;
}

bool gb_stability_grows(int index, double share, bool *result, struct gb_error *err)
{
    const struct method *method = method_of(index);
    struct gb_stability_scene scene;
    const bool done =
        open_scene(index, &scene, err) &&
        grows(method, &scene, share * method->bound(scene.frequency, method->damping),
              result, err);
    gb_stability_scene_finish(&scene);
    return done;
}

/* --- states of a run ------------------------------------------------------------------ */

static const struct method *const of_time = &methods[0], *const of_rest = &methods[3];

int gb_stability_methods(const struct gb_params *params, int *first)
{
    const bool follows_time = gb_loading_kind_of(params)->follows_time;
    *first = (int)((follows_time ? of_time : of_rest) - methods);
    return follows_time ? 1 : METHODS - *first;
}

/* The step of a dynamic run here, given or automatic. */
static double used_in_run(const struct gb_stability_scene *scene)
{
    char text[160];
    struct gb_dynamic motion = {
        .model = &scene->model, .stage = GB_DYNAMIC_LOAD, .limit = INFINITY};
    motion.scratch =
        gb_alloc_array((size_t)scene->model.count, sizeof *motion.scratch, NULL);
    const double step =
        motion.scratch
            ? gb_loading_dynamic_step_allowed(&motion, scene->world, text, sizeof text)
            : (double)NAN;
    gb_alloc_free(motion.scratch);
    return step;
}

/* Such a method at a copy of a world right after an evaluation, brought to rest.  Errors:
 * those of gb_probe_create. */
static bool stability_measure_world(int index, const struct gb_world *world,
                                    struct gb_stability_row *row, struct gb_error *err)
{
    const struct method *method = &methods[index];
    const bool in_time = method == of_time;
    struct gb_stability_scene scene;
    bool done = stability_scene_copy(&scene, world, method->inertia, method->power, err);
    if (done) {
        const double damping =
            in_time ? 0.5 * scene.model.dynamics.viscous * scene.frequency : 0.0;
        *row = (struct gb_stability_row){
            .method = method->name,
            .damping = damping,
            .theory = method->bound(scene.frequency, damping),
            .exact = (double)NAN,
        };
        done = bisect(method, &scene, row->theory, &row->measured, err) &&
               gb_stability_scene_reset(&scene, err);
        row->used = !done     ? (double)NAN
                    : in_time ? used_in_run(&scene)
                              : method->used(&scene);
    }
    gb_stability_scene_finish(&scene);
    return done;
}

/* --- states of a run ------------------------------------------------------------------ */

static const double default_pa[GB_STABILITY_RUN_POINTS] = {1e6, 10e6, 100e6};

struct walk {
    const struct gb_params *params;
    const struct gb_stability_sink *sink;
    int rows;
    char why[160]; /* of the last state that was left out */
};

static bool is_in_use(const struct gb_stability_row *row,
                      const struct gb_experiment *experiment)
{
    const struct gb_model *model = gb_experiment_model(experiment);
    return gb_loading_kind_at(model->kind)->follows_time ||
           strcmp(row->method, model->numerics.relaxer) == 0;
}

/* One that has no equilibrium near is told and left out. */
static bool leave_out(struct walk *walk, double p_pa, const struct gb_error *err)
{
    g_strlcpy(walk->why, err->text, sizeof walk->why);
    walk->sink->skipped(walk->sink->data, p_pa, walk->why);
    return true;
}

static bool visit(void *data, const struct gb_experiment *experiment, unsigned what,
                  struct gb_error *err)
{
    struct walk *walk = data;
    const struct gb_point *point = gb_experiment_point(experiment);
    int first = 0;
    if (what & GB_KEEP_WALK_VISITED) {
        return true;
    }
    const int count = gb_stability_methods(walk->params, &first);
    for (int k = first; k < first + count; k++) {
        struct gb_stability_row row;
        struct gb_error own = {0};
        if (!stability_measure_world(k, gb_experiment_world(experiment), &row, &own)) {
            return own.code == GB_ERR_INPUT || own.code == GB_ERR_GUARD ||
                           own.code == GB_ERR_NOT_CONVERGED
                       ? leave_out(walk, point->p_pa, &own)
                       : gb_error_set(err, own.code, "%s", own.text);
        }
        row.density = point->density;
        row.p_pa = point->p_pa;
        row.in_use = is_in_use(&row, experiment);
        walk->rows++;
        if (!walk->sink->row(walk->sink->data, &row, err)) {
            return false;
        }
        if (walk->sink->cancelled && walk->sink->cancelled(walk->sink->data)) {
            return gb_error_set(err, GB_ERR_CANCELLED, "stopped on request");
        }
    }
    return true;
}

bool gb_stability_run(const struct gb_params *params, const struct gb_keep_points *points,
                      const struct gb_stability_sink *sink, int *missed,
                      struct gb_error *err)
{
    struct gb_params pressed = *params;
    struct gb_keep_points usual = {.count = G_N_ELEMENTS(default_pa)};
    struct walk walk = {.params = params, .sink = sink};
    for (size_t k = 0; k < G_N_ELEMENTS(default_pa); k++) {
        usual.point[k].value = default_pa[k];
    }
    pressed.unload_count = 0;
    pressed.hold_s = 0.0;
    const struct gb_keep_walk keep = {points ? points : &usual, visit, &walk,
                                      sink->cancelled, sink->data};
    if (!gb_loading_kind_check_cell(params, "stability", err) ||
        !gb_kept_states_run(&pressed, &keep, missed, err)) {
        return false;
    }
    return walk.rows > 0 ||
           gb_error_set(err, GB_ERR_INPUT, "no state could be measured: %s", walk.why);
}

bool gb_stability_stable(const struct gb_stability_row *row)
{
    return row->used <= row->measured;
}

struct gb_listing *gb_stability_table(const char *comment)
{
    struct gb_listing *listing = gb_listing_new();
    gb_listing_comment(listing, comment);
    gb_listing_comment(listing,
                       "longest stable steps in sqrt(m/(E d)), of steepest in 1/(E d); "
                       "ratio: measured / theory; used: what the run takes; margin: "
                       "measured / used");
    gb_listing_columns(listing, "%s", "method");
    gb_listing_columns(listing, "%.8g",
                       "p_MPa,density,damping,theory,measured,ratio,used,margin");
    gb_listing_columns(listing, "%.0f", "stable,in_use");
    return listing;
}

void gb_stability_add(struct gb_listing *listing, const struct gb_stability_row *row)
{
    const double number[] = {1e-6 * row->p_pa,
                             row->density,
                             row->damping,
                             row->theory,
                             row->measured,
                             row->measured / row->theory,
                             row->used,
                             row->measured / row->used,
                             gb_stability_stable(row),
                             row->in_use};
    gb_listing_text(listing, row->method);
    gb_listing_numbers(listing, number, G_N_ELEMENTS(number));
}
