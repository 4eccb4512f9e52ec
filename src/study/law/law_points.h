#ifndef GB_STUDY_LAW_LAW_POINTS_H
#define GB_STUDY_LAW_LAW_POINTS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "greenbody/status.h"

enum { GB_LAW_POINTS_FIXED = 4, GB_LAW_POINTS_CORNERS = 4096 };
enum { GB_LAW_POINTS_MAX = 10000000 };

/* A number as typed: pure, or a length in m ("20 nm"). */
struct gb_law_points_number {
    double value;
    bool length;
};

/* A variable with its value. */
struct gb_law_points_value {
    char name[16];
    struct gb_law_points_number number;
};

/* "h=0.01" or "h_min=0.02,h=0.012". */
struct gb_law_points_at {
    struct gb_law_points_value item[GB_LAW_POINTS_FIXED];
    int count;
};

/* "h=0:0.1:101": ends, number of points. */
struct gb_law_points_range {
    char name[16];
    struct gb_law_points_number from, to;
    int64_t count;
};

/* "0,0.02,-0.01" or "h_m=0,2e-8,1e-8": at least two values. */
struct gb_law_points_path {
    char name[16]; /* may be empty */
    struct gb_law_points_number corner[GB_LAW_POINTS_CORNERS];
    int count;
};

/* All errors are GB_ERR_INPUT: option, what was given, what is accepted. */
bool gb_law_points_at(struct gb_law_points_at *at, const char *text,
                      struct gb_error *err);
bool gb_law_points_range(struct gb_law_points_range *range, const char *text,
                         struct gb_error *err);
bool gb_law_points_path(struct gb_law_points_path *path, const char *text,
                        struct gb_error *err);

/* The error of a range; also for `from` not below `to`, which is known only once both have
 * the same unit.  Returns false. */
bool gb_law_points_refuse_range(const char *text, struct gb_error *err);

/* Value `index` of `count` evenly spaced ones; the first and last are exact. */
double gb_law_points_between(double from, double to, int64_t count, int64_t index);

#endif
