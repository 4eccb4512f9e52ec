#ifndef GB_FIGURES_SEQUENCE_H
#define GB_FIGURES_SEQUENCE_H

#include "draw/packing_image.h"

/* Frames along a run: all states that its directory keeps, in the order of the run, seen
 * from one place and on one scale of colours and forces. */
struct gb_sequence {
    const char *directory;
    const char *output; /* x.png: moves; x.mp4, .webm, .mkv, .gif: film; x-%03d.png */
    double frames_per_s;
    bool force; /* replaces what is there */
};

/* Whether a name is one of numbered frames: it holds one %d or %03d.  Other uses of % in
 * it are an error of gb_sequence_write. */
bool gb_sequence_is_numbered(const char *output);

bool gb_sequence_write(const struct gb_sequence *sequence,
                       struct gb_packing_image *picture, struct gb_error *err);

#endif
