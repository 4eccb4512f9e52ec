#include "study/stability/stability.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/vec.h"
#include "law/critical_step.h"
#include "scene/loading_kind.h"
#include "solve/loading/dynamic.h"
#include "solve/relax/relax_fire.h"
#include "solve/verlet.h"
#include "study/stability/stability_scene.h"

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
        verlet.velocity[i] = speed * scene->mode[i] / gb_stability_scene_root(scene, i);
        verlet.spin[i] =
            speed * scene->mode[n + i] / gb_stability_scene_root(scene, n + i);
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
    gb_stability_scene_move(scene, scene->mode, disturbance);
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
        const double exact = gb_stability_scene_exact(
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
            ? gb_dynamic_step_allowed(&motion, scene->world, text, sizeof text)
            : (double)NAN;
    gb_alloc_free(motion.scratch);
    return step;
}

bool gb_stability_measure_world(int index, const struct gb_world *world,
                                struct gb_stability_row *row, struct gb_error *err)
{
    const struct method *method = &methods[index];
    const bool in_time = method == of_time;
    struct gb_stability_scene scene;
    bool done = gb_stability_scene_copy(&scene, world, method->inertia, method->power, err);
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
