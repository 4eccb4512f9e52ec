#ifndef GB_TUI_VIEW_VIEW_LEGS_H
#define GB_TUI_VIEW_VIEW_LEGS_H

#include "scene/path/path.h"
#include "tui/view/views.h"

/* Branches of a curve in any pair of quantities: loading, legs of a loading path,
 * unloading. */

/* The legs of the run on display; none without a loading path. */
struct gb_path gb_view_legs_path(const struct gb_session *session);

/* Line, mark and legend of leg n (from 1). */
struct gb_plot_series gb_view_legs_style(int leg);
/* Name of leg n in the legend: "shear xz". */
void gb_view_legs_name(const struct gb_path *path, int leg, char *text, size_t size);

/* The number of the leg of a branch, from 1; 0: no leg, or no loading path. */
int gb_view_legs_number(const struct gb_path *path, int branch);

#endif
