#ifndef GB_FIGURES_OUTPUT_FORMATS_H
#define GB_FIGURES_OUTPUT_FORMATS_H

#include "draw/figure.h"

/* The table of output formats: extension of a file -> writer.  A format is a writer and a
 * row in output_formats.c; messages and help follow from the row. */

enum gb_output_formats_use {
    GB_OUTPUT_FORMATS_FIGURE = 1,   /* of plot */
    GB_OUTPUT_FORMATS_PICTURE = 2,  /* of snapshot */
    GB_OUTPUT_FORMATS_SEQUENCE = 4, /* of snapshot --sequence */
};

struct gb_frame_writer;

struct gb_output_formats_row {
    const char *extension; /* with its dot */
    const char *doc;
    unsigned uses; /* sum of the above */
    /* of a figure; NULL: only the data, which every figure has beside it */
    gb_figure_writer *figure;
    const struct gb_frame_writer *frames; /* of a sequence; NULL: none */
    const char *video_filter;             /* of ffmpeg; NULL: no video */
};

/* The last row has no extension. */
const struct gb_output_formats_row *gb_output_formats_table(void);
/* By the extension of a path; NULL: no format for this use. */
const struct gb_output_formats_row *
gb_output_formats_find(const char *path, enum gb_output_formats_use use);
/* ".png, .svg or .pdf"; g_free. */
char *gb_output_formats_names(enum gb_output_formats_use use);
/* "FILE.png|svg|pdf", for a list of options; g_free. */
char *gb_output_formats_pattern(enum gb_output_formats_use use);
/* ".mp4, .webm or .gif": the videos of a sequence; g_free. */
char *gb_output_formats_videos(void);

#endif
