#ifndef GB_CLI_POINTS_H
#define GB_CLI_POINTS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "greenbody/status.h"

enum { GB_POINTS_FIXED = 4, GB_POINTS_CORNERS = 4096 };
enum { GB_POINTS_MOST = 10000000 };

/* A variable with its value. */
struct gb_points_value {
    char name[16];
    double value;
};

/* "h=0.01" or "h_min=0.02,h=0.012". */
struct gb_points_at {
    struct gb_points_value item[GB_POINTS_FIXED];
    int count;
};

/* "h=0:0.1:101": from, to, number of points. */
struct gb_points_range {
    char name[16];
    double from, to;
    int64_t count;
};

/* All errors are GB_ERR_INPUT: option, what was given, what is accepted. */
bool gb_points_at(struct gb_points_at *at, const char *text, struct gb_error *err);
bool gb_points_range(struct gb_points_range *range, const char *text,
                     struct gb_error *err);
double gb_points_range_value(const struct gb_points_range *range, int64_t index);

/* "0,0.02,-0.01": at least two values, at most GB_POINTS_CORNERS. */
bool gb_points_path(double *corners, int *count, const char *text, struct gb_error *err);

#endif
