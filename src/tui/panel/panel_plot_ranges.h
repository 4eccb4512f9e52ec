#ifndef GB_TUI_PANEL_PANEL_PLOT_RANGES_H
#define GB_TUI_PANEL_PANEL_PLOT_RANGES_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/status.h"
#include "tui/plot/plot.h"

/* Ranges of the axes that the user has typed, by the quantity on the axis. */

enum gb_plot_range_of {
    GB_PLOT_RANGE_PRESSURE,   /* Pa */
    GB_PLOT_RANGE_DENSITY,    /* relative density */
    GB_PLOT_RANGE_TIME,       /* ns, or recorded steps */
    GB_PLOT_RANGE_RATIO,      /* lateral-to-axial stress ratio */
    GB_PLOT_RANGE_DIFFERENCE, /* of densities */
    GB_PLOT_RANGES
};

struct gb_plot_range {
    bool typed; /* else automatic */
    double low, high;
};

struct gb_plot_ranges {
    struct gb_plot_range of[GB_PLOT_RANGES];
};

/* "p=10 MPa:500 MPa rho=0.3:0.6"; a quantity that is not named is automatic.  Errors:
 * GB_ERR_INPUT, ranges are unchanged. */
bool gb_panel_plot_ranges_parse(struct gb_plot_ranges *ranges, const char *text,
                                struct gb_error *err);
/* The text that sets them. */
void gb_panel_plot_ranges_write(const struct gb_plot_ranges *ranges, char *text,
                                size_t size);
bool gb_panel_plot_ranges_any(const struct gb_plot_ranges *ranges);

/* Whether a value is inside the typed range, or the axis is automatic. */
bool gb_panel_plot_ranges_inside(const struct gb_plot_ranges *ranges,
                                 enum gb_plot_range_of of, double value);

/* Before gb_plot_axes: the ends of the x and y axis become the typed ones and are kept
 * exactly.  unit: of the axis, in that of the range. */
void gb_panel_plot_ranges_x(const struct gb_plot_ranges *ranges,
                            enum gb_plot_range_of of, double unit, struct gb_plot *plot,
                            double ends[2]);
void gb_panel_plot_ranges_y(const struct gb_plot_ranges *ranges,
                            enum gb_plot_range_of of, double unit, struct gb_plot *plot,
                            double ends[2]);

#endif
