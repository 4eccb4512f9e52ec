#ifndef GREENBODY_CURVE_H
#define GREENBODY_CURVE_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/point.h"
#include "greenbody/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Append-only list of points for one writer and any number of readers.  Readers need no
 * lock for points below gb_curve_count, because points never move and never change. */
struct gb_curve;

/* An empty curve.  Errors: GB_ERR_MEMORY. */
bool gb_curve_create(struct gb_curve **out, struct gb_error *err);
void gb_curve_destroy(struct gb_curve *curve); /* NULL is fine */
/* Adds a copy of a point.  Errors: GB_ERR_MEMORY. */
bool gb_curve_append(struct gb_curve *curve, const struct gb_point *point,
                     struct gb_error *err);
/* Number of points; it only grows. */
size_t gb_curve_count(const struct gb_curve *curve);
/* Point 0 <= index < gb_curve_count; valid as long as the curve exists. */
const struct gb_point *gb_curve_at(const struct gb_curve *curve, size_t index);

#ifdef __cplusplus
}
#endif

#endif
