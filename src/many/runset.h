#ifndef GB_MANY_RUNSET_H
#define GB_MANY_RUNSET_H

#include <glib.h>
#include <stdbool.h>
#include <stddef.h>

#include "base/table.h"
#include "greenbody/params.h"

/* Keys without effect on the experiment: title, seed, threads, [output]. */
bool gb_runset_bookkeeping(const struct gb_field *field);

/* The first key in which two scenes differ, other than bookkeeping and the keys of
 * `ignored`, a NULL-terminated list of "group.key" and "group."; NULL: none. */
const struct gb_field *gb_runset_differing_key(const struct gb_params *a,
                                               const struct gb_params *b,
                                               const char *const *ignored);

/* Finished runs read back from their directories.  Runs whose presets are equal but for
 * seed, title, threads and [output] are one group: replicas of one experiment. */
struct gb_runset_run {
    char *directory;
    struct gb_params params;
    struct gb_table *table; /* curve.csv; NULL for what `pack` made */
    size_t group;
};

struct gb_runset {
    struct gb_runset_run *run; /* in the order given */
    size_t count;
    size_t groups; /* numbered by their first run */
};

/* Order of names in which numbers count as numbers: 9.7nm before 16nm, 0.15 before 0.2.
 */
int gb_runset_compare(const char *a, const char *b);

/* Adds (g_strdup) a run directory to a list, or, for a directory of many runs, those of
 * its runs that were done, by name.  A word that is neither is added as it is: the error
 * follows from reading it. */
void gb_runset_expand(GPtrArray *list, const char *directory);

/* Reads preset.ini and curve.csv of each directory.  Errors are one line:
 * GB_ERR_INPUT for anything in the files, and for two runs of one group with the same
 * seed, or of a scene in which nothing depends on it: they are one run, and would make its
 * error too small. */
bool gb_runset_read(struct gb_runset *set, char *const *directories, size_t count,
                    struct gb_error *err);
void gb_runset_finish(struct gb_runset *set); /* zeroed is fine */

/* Groups again, as if runs that differ in these keys only ("group.key", "group.", NULL at
 * the end) were one experiment.  A seed that its group has already stays apart: the same
 * run twice would make the error too small. */
void gb_runset_merge(struct gb_runset *set, const char *const *keys);

/* Are these one experiment: equal but for seed, title, threads and [output]? */
bool gb_runset_same(const struct gb_params *a, const struct gb_params *b);

/* First run of a group, and how many it has. */
const struct gb_runset_run *gb_runset_first(const struct gb_runset *set, size_t group);
size_t gb_runset_members(const struct gb_runset *set, size_t group);

/* Whether groups of one material.name have one value of the key, another one of [material]:
 * the name tells it. */
bool gb_runset_follows_material(const struct gb_runset *set,
                                const struct gb_field *field);

/* What tells a group from the others: "contact.mu = 0.2, loading.rate = 68 1/us"; "" for
 * a single group.  Keys that follow from the material are left out.  Caller g_frees. */
char *gb_runset_label(const struct gb_runset *set, size_t group);

/* The same, from the groups of the same title alone. */
char *gb_runset_label_of_title(const struct gb_runset *set, size_t group);

/* The first key in which two groups differ, other than the keys of `ignored`, a
 * NULL-terminated list of "group.key" and "group."; NULL when there is none. */
const struct gb_field *gb_runset_difference(const struct gb_runset *set, size_t a,
                                            size_t b, const char *const *ignored);

/* Points (x, y) of one branch of a run (NULL: of all) where x is there, without those that
 * are not in equilibrium (column unrelaxed); arrays to be given to gb_alloc_free.  Errors:
 * GB_ERR_INPUT for a missing column or no such points. */
bool gb_runset_points(const struct gb_runset_run *run, const char *branch, const char *x,
                      const char *y, double **xs, double **ys, size_t *count,
                      struct gb_error *err);
/* Those that are not; count may be 0. */
bool gb_runset_unrelaxed(const struct gb_runset_run *run, const char *branch,
                         const char *x, const char *y, double **xs, double **ys,
                         size_t *count, struct gb_error *err);

#endif
