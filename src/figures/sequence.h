#ifndef GB_FIGURES_SEQUENCE_H
#define GB_FIGURES_SEQUENCE_H

#include "draw/packing_image.h"

/* Images of all kept states of a run in the order of the run, with one camera and one scale
 * of colours and forces. */
struct gb_sequence {
    const char *directory;
    const char *output; /* x.png: animated; x-%03d.png: one file per frame; a video */
    double frames_per_s;
    bool force; /* replaces existing files */
    /* Called after each frame; NULL: not called. */
    void (*progress)(size_t done, size_t total, void *data);
    void *data;
};

bool gb_sequence_write(const struct gb_sequence *sequence,
                       struct gb_packing_image *packing_image, struct gb_error *err);

#endif
