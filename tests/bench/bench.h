#ifndef GB_TESTS_BENCH_BENCH_H
#define GB_TESTS_BENCH_BENCH_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/params.h"
#include "greenbody/status.h"
#include "pack/cell/world.h"
#include "scene/model.h"
#include "solve/relax/relax.h"

/* What the benchmarks share.  A benchmark times all its rows in turn, round after round, so
 * that other work on the machine slows all of them alike. */

enum { ROUNDS = 5 };

/* A quantity measured in rounds. */
struct figure {
    double value;  /* median of the rounds */
    double spread; /* half of the difference between the largest and the smallest */
};

/* The rounds are sorted.  NaN if a round is NaN. */
struct figure figure_of(double round[ROUNDS]);

/* Prints "name  value +- spread unit"; nothing if the figure is NaN.  Values are multiplied
 * by scale. */
void print_figure(const char *name, struct figure figure, double scale, const char *unit);

/* Prints a quantity that is measured once. */
void print_fact(const char *name, double value, const char *unit);

/* Sets the scene of the benchmarks, changed by the assignments "group.key=value" (NULL at
 * the end): P1's set II, 8000 particles of 9.7 nm, pressed with `fast`. */
bool make_scene(struct gb_params *params, char **assignment, struct gb_error *err);

/* Prints the error to stderr.  Returns the exit status: 0 if good. */
int finish(bool good, const struct gb_error *err);

/* The median of a batch counts on one core by processor time, which other work on the
 * machine does not lengthen; on several by the wall clock. */
double now_s(int threads);

/* The packing of a scene, pressed in steps of 1 % until each particle has 6 contacts. */
struct packing {
    struct gb_model model;
    struct gb_world *world;
    struct gb_world_copy *copy; /* of world, to start again from */
    double grow_s, coordination;
    size_t bytes; /* held by world and relaxer */
};

/* packing_finish must be called, also after an error.  Errors: as of the engine, and
 * GB_ERR_GUARD if the coordination number is not reached. */
bool packing_press(struct packing *packing, const struct gb_params *params,
                   struct gb_error *err);
void packing_finish(struct packing *packing);

/* Median time, s, of one evaluation (forces, torques, histories) with its move over batches
 * of 24 evaluations, each after a strain step of 0.1 % as in a run. */
enum { BATCHES_MOST = 15 };
bool packing_time(struct gb_world *world, struct gb_relax *relax, int batches,
                  double *median, struct gb_error *err);

#endif
