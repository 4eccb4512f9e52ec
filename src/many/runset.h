#ifndef GB_MANY_RUNSET_H
#define GB_MANY_RUNSET_H

#include <glib.h>
#include <stdbool.h>
#include <stddef.h>

#include "base/table.h"
#include "greenbody/params.h"

/* Keys without effect on the experiment: title, seed, threads, [output]. */
bool gb_runset_bookkeeping(const struct gb_field *field);

/* The first key in which two scenes differ, except bookkeeping keys and the keys in
 * `ignored`, a NULL-terminated list of "group.key" and "group."; NULL: none. */
const struct gb_field *gb_runset_differing_key(const struct gb_params *a,
                                               const struct gb_params *b,
                                               const char *const *ignored);

/* Finished runs, read from their directories.  Runs whose presets differ only by seed,
 * title, threads and [output] form one group: replicas of one experiment. */
struct gb_runset_run {
    char *directory;
    struct gb_params params;
    struct gb_table *table; /* curve.csv; NULL for a directory of `pack` */
    size_t group;
};

struct gb_runset {
    struct gb_runset_run *run; /* in the order given */
    size_t count;
    size_t groups; /* numbered in the order of their first runs */
};

/* Compares names with numbers by their value: 9.7nm before 16nm, 0.15 before 0.2. */
int gb_runset_compare(const char *a, const char *b);

/* Adds (g_strdup) a run directory to a list.  For a directory of many runs, adds the
 * runs in it that are done, by name.  Any other word is added unchanged; reading it
 * reports the error. */
void gb_runset_expand(GPtrArray *list, const char *directory);

/* Reads preset.ini and curve.csv of each directory.  Errors are one line: GB_ERR_INPUT
 * for anything in the files.  It is also an error if two runs of one group are the same
 * run, with the same seed or without dependence on it: they would make the standard
 * error too small. */
bool gb_runset_read(struct gb_runset *set, char *const *directories, size_t count,
                    struct gb_error *err);
void gb_runset_finish(struct gb_runset *set); /* zeroed is fine */

/* Groups again and ignores differences in these keys ("group.key", "group.", NULL at
 * the end).  A run whose seed the group already has stays separate: the same run twice
 * would make the standard error too small. */
void gb_runset_merge(struct gb_runset *set, const char *const *keys);

/* Are these one experiment: equal except for seed, title, threads and [output]? */
bool gb_runset_same(const struct gb_params *a, const struct gb_params *b);

/* First run of a group, and the number of its runs. */
const struct gb_runset_run *gb_runset_first(const struct gb_runset *set, size_t group);
size_t gb_runset_members(const struct gb_runset *set, size_t group);

/* Is the key, another key of [material], the same in all groups with the same
 * material.name?  Then the name implies it. */
bool gb_runset_follows_material(const struct gb_runset *set,
                                const struct gb_field *field);

/* What distinguishes a group from the others: "contact.mu = 0.2, loading.rate = 68
 * 1/us"; "" for a single group.  Keys that follow from the material are omitted.
 * g_free. */
char *gb_runset_label(const struct gb_runset *set, size_t group);

/* The same, compared only with groups of the same title. */
char *gb_runset_label_of_title(const struct gb_runset *set, size_t group);

/* The first key in which two groups differ, except the keys in `ignored`, a
 * NULL-terminated list of "group.key" and "group."; NULL: none. */
const struct gb_field *gb_runset_difference(const struct gb_runset *set, size_t a,
                                            size_t b, const char *const *ignored);

/* Points (x, y) of one branch of a run (NULL: all) that have x and are in equilibrium
 * (column unrelaxed); arrays for gb_alloc_free.  Errors: GB_ERR_INPUT for a missing
 * column or no such points. */
bool gb_runset_points(const struct gb_runset_run *run, const char *branch, const char *x,
                      const char *y, double **xs, double **ys, size_t *count,
                      struct gb_error *err);
/* Points that are not in equilibrium; count may be 0. */
bool gb_runset_unrelaxed(const struct gb_runset_run *run, const char *branch,
                         const char *x, const char *y, double **xs, double **ys,
                         size_t *count, struct gb_error *err);

#endif
