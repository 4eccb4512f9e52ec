#ifndef GB_STUDY_STRENGTH_STRENGTH_OPTIONS_H
#define GB_STUDY_STRENGTH_STRENGTH_OPTIONS_H

#include <glib.h>

#include "scene/field/keep_points.h"

/* Tests of a compact without stress on it. */
enum gb_strength_test {
    GB_STRENGTH_TENSION,     /* z is stretched, p_x = p_y = 0 */
    GB_STRENGTH_COMPRESSION, /* z is compressed, p_x = p_y = 0 */
    GB_STRENGTH_SHEAR,       /* simple shear xz, p_z = 0 */
    GB_STRENGTH_TESTS
};

struct gb_strength_test_row {
    const char *name;
    const char *leg; /* with the largest strain in per cent */
    double sense;    /* of the stress that is the strength */
    int component;   /* of strain: zz or xz, in the order of struct gb_point */
};
extern const struct gb_strength_test_row gb_strength_options_tests[GB_STRENGTH_TESTS];

struct gb_strength_options {
    struct gb_keep_points marks; /* pressing pressures or densities */
    int replicas;
    double step;        /* strain step of a test */
    double strain_most; /* at which a test ends */
    double
        fall; /* a test has passed its peak when the stress is below this share of it */
    double tolerance; /* numerics.tolerance of unloading and tests */
};

enum { GB_STRENGTH_REPLICAS_MAX = 1000 };

void gb_strength_options_init(struct gb_strength_options *options);
/* Errors: GB_ERR_INPUT naming the option and what is accepted. */
bool gb_strength_options_check(const struct gb_strength_options *options,
                               struct gb_error *err);

/* For the question of a cell (study/compact/cells.h) and back. */
void gb_strength_options_write(const struct gb_strength_options *options,
                               const struct gb_keep_point *mark, GString *text);
void gb_strength_options_read(struct gb_strength_options *options,
                              struct gb_keep_point *mark, GKeyFile *question);

#endif
