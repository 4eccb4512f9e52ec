#ifndef GB_FIGURES_PLOTTING_H
#define GB_FIGURES_PLOTTING_H

#include "base/table.h"
#include "draw/figure.h"
#include "figures/series.h"

enum gb_plotting_use {
    GB_PLOTTING_FIGURE = 1,   /* of plot */
    GB_PLOTTING_PICTURE = 2,  /* of snapshot */
    GB_PLOTTING_SEQUENCE = 4, /* of snapshot --sequence */
};

struct gb_frame_writer;

struct gb_plotting_format {
    const char *extension; /* with its dot */
    const char *doc;
    unsigned uses; /* sum of the above */
    /* of a figure; NULL: only the data, which every figure has in a file next to it */
    gb_figure_writer *figure;
    const struct gb_frame_writer *frames; /* of a sequence; NULL: none */
    const char *video_filter;             /* of ffmpeg; NULL: no video */
};

/* The last row has no extension. */
const struct gb_plotting_format *gb_plotting_formats(void);

/* By the extension of a path; NULL: no format for this use. */
const struct gb_plotting_format *gb_plotting_format_find(const char *path,
                                                         enum gb_plotting_use use);

/* ".png, .svg or .pdf"; g_free. */
char *gb_plotting_format_names(enum gb_plotting_use use);

/* "FILE.png|svg|pdf", for a list of options; g_free. */
char *gb_plotting_pattern(enum gb_plotting_use use);

/* ".mp4, .webm or .gif": the videos of a sequence; g_free. */
char *gb_plotting_videos(void);

enum gb_plotting_existing { GB_PLOTTING_KEEP, GB_PLOTTING_REPLACE };

/* Page of a figure. */
struct gb_plotting_page {
    int width, height;                  /* pixels */
    const char *name;                   /* of the figure */
    const char *title;                  /* plain text; NULL: none */
    const struct gb_runset *set;        /* source; NULL: contact laws */
    enum gb_plotting_existing existing; /* of a CSV with other data beside the figure */
    int per_inch;                       /* in print; 0: none (image.h) */
};

/* Checks the targets before the work: extension, folder, and an existing output.  Errors:
 * GB_ERR_INPUT. */
bool gb_plotting_check(const char *output, enum gb_plotting_existing existing,
                       struct gb_error *err);

/* Writes the figure in the format of the extension and its data beside it as .csv.  Errors:
 * GB_ERR_INPUT for a CSV with other data that is kept, before anything is written. */
bool gb_plotting_write(const struct gb_series *series,
                       const struct gb_plotting_page *page, const char *output,
                       struct gb_error *err);

/* Adds measured points: a table with the columns of both axes, optionally a column of
 * words (one marker per word: series, or branches as in a curve.csv) and
 * "<column>_error".  Errors: GB_ERR_INPUT. */
bool gb_plotting_data(struct gb_series *series, const struct gb_table *table,
                      struct gb_error *err);

#endif
