#ifndef GB_TUI_SESSION_EARLIER_H
#define GB_TUI_SESSION_EARLIER_H

#include "greenbody/curve.h"
#include "greenbody/params.h"

enum { GB_EARLIER_DIFFERENCE = 96 };

/* A curve that was replaced: what the plot needs of it. */
struct gb_earlier {
    struct gb_params params;
    char letter;                            /* 'a', 'b', ...: its mark in the plot */
    bool quick;                             /* of a quick cell */
    char difference[GB_EARLIER_DIFFERENCE]; /* its own values where the new run differs */
    size_t count;
    double *density, *pressure_pa; /* NaN between branches */
    double *elapsed;               /* gb_earlier_elapsed of the points */
};

/* Copies the first count points; false without memory. */
bool gb_earlier_copy(struct gb_earlier *earlier, const struct gb_params *params,
                     const struct gb_curve *curve, size_t count);
void gb_earlier_drop(struct gb_earlier *earlier);

/* Where a point of a run of that kind lies in time: ns simulated of a dynamic run, the
 * number of the recorded step of a quasi-static one. */
double gb_earlier_elapsed(int kind, const struct gb_point *point);

/* Whether two scenes have the same value, as a preset would write it. */
bool gb_earlier_same(const struct gb_params *a, const struct gb_params *b,
                     const struct gb_field *field);
/* Fields, besides the title, in which they differ. */
int gb_earlier_differences(const struct gb_params *a, const struct gb_params *b);

/* "mu 0.1, alpha 0.24": its own values where they are not those of the other; "same
 * parameters" when there are none.  Returns text. */
char *gb_earlier_describe(const struct gb_params *own, const struct gb_params *other,
                          char *text, size_t size);

#endif
