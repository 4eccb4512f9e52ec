#ifndef GB_TUI_SESSION_PREVIOUS_H
#define GB_TUI_SESSION_PREVIOUS_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/curve.h"
#include "greenbody/params.h"
#include "io/preset.h"
#include "runner/runner.h"

enum { GB_PARAMS_DIFF_TEXT = 96 };

/* Do both have the same value of a field? */
bool gb_previous_diff_same(const struct gb_params *a, const struct gb_params *b,
                           const struct gb_field *field);

/* Number of fields that differ, except the title. */
int gb_previous_diff_count(const struct gb_params *a, const struct gb_params *b);

/* Writes "mu 0.1, alpha 0.24": the values of `own` that differ, or "same parameters".
 * Returns text. */
char *gb_previous_diff_text(const struct gb_params *own, const struct gb_params *other,
                            char *text, size_t size);

/* The shell command that runs the parameters on screen: the preset by name or path, and
 * every value that differs from the file.
 *
 * params  the parameters on screen
 * cols    longer lines are broken at a blank, with a backslash
 *
 * g_free. */
char *gb_previous_command(const struct gb_preset *preset, const struct gb_params *params,
                          int cols);

/* The previous curves of a session, oldest first: which are kept, shown and coloured. */

struct gb_session;

/* The cell that a curve comes from. */
enum gb_session_cell { GB_SESSION_FULL_CELL, GB_SESSION_QUICK_CELL };

enum { GB_SESSION_PREVIOUS = 6 };

enum { GB_CURVE_NAME = 40, GB_CURVE_COLOURS = 5 /* besides that of the run */ };

/* Name and style of a curve.  A run keeps them when it is shown again. */
struct gb_curve_label {
    char marker;              /* 'a', 'b', ...: marker in the plot; 0: none yet */
    int colour;               /* 1 to GB_CURVE_COLOURS; 0: dim */
    bool pinned;              /* stays among the previous curves */
    bool hidden;              /* not drawn and in no table */
    char name[GB_CURVE_NAME]; /* given by the user; "": named by its differences */
};

/* Label of the run (-1) or of a previous curve. */
struct gb_curve_label *gb_previous_list_label(struct gb_session *session, int index);

/* Curve of a replaced run or quick cell, as the plot shows it. */
struct gb_previous_curve {
    struct gb_params params;
    struct gb_curve_label label;
    bool quick;                           /* of a quick cell */
    char difference[GB_PARAMS_DIFF_TEXT]; /* its different values */
    size_t count;
    double *density, *pressure_pa; /* NaN between branches */
    bool *loading;                 /* point of the loading branch */
    double *elapsed;               /* gb_previous_curve_elapsed of the points */
};

/* The name of a curve, or its differences if it has none. */
const char *gb_previous_list_name(const struct gb_previous_curve *previous);

/* Is a curve drawn? hide: curves that are not pinned are hidden. */
bool gb_previous_list_shown(const struct gb_previous_curve *previous, bool hide);
/* The first colour from 1 up that no shown curve has; 0: none. */
int gb_previous_list_free_colour(const struct gb_session *session);

/* Adds the curve of a run or quick cell, unless it has fewer than two points or memory
 * is short.  The oldest curve that is not pinned makes room.  A pinned curve of the
 * same quick cell is replaced. */
void gb_previous_list_keep(struct gb_session *session, const struct gb_params *params,
                           const struct gb_runner *runner, enum gb_session_cell cell);
/* Updates the differences of the curves to these parameters. */
void gb_previous_list_describe(struct gb_session *session,
                               const struct gb_params *params);
/* Removes the previous curve with these parameters, because its run or quick cell is on
 * display again.  Pinned curves of quick cells stay. */
void gb_previous_list_forget(struct gb_session *session, const struct gb_params *params,
                             bool quick);
void gb_previous_list_delete(struct gb_session *session, int index);

/* Pins or unpins the run (-1) or a previous curve.  False: GB_PREVIOUS_PINNED curves
 * are pinned already; one place is kept for the last run. */
enum { GB_PREVIOUS_PINNED = GB_SESSION_PREVIOUS - 1 };
bool gb_previous_list_pin(struct gb_session *session, int index, bool pinned);
/* Hides or shows a curve.  A curve that is shown again takes a free colour. */
void gb_previous_list_hide(struct gb_session *session, int index, bool hidden);

/* Copies the first `count` points; false: out of memory. */
bool gb_previous_curve_copy(struct gb_previous_curve *previous,
                            const struct gb_params *params, const struct gb_curve *curve,
                            size_t count);

void gb_previous_curve_finish(struct gb_previous_curve *previous);

/* Time coordinate of a point: simulated ns of a dynamic run, number of the recorded step
 * of a quasi-static one. */
double gb_previous_curve_elapsed(int kind, const struct gb_point *point);

#endif
