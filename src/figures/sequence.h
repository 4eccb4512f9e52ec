#ifndef GB_FIGURES_SEQUENCE_H
#define GB_FIGURES_SEQUENCE_H

#include "draw/packing_image.h"

/* Files that the frames of a sequence go to. */
struct gb_frame_output {
    const char *path;
    const struct gb_packing_image *packing_image; /* background, preset */
    int width, height;                            /* of a frame */
    int count;                                    /* of all frames */
    double frames_per_s;
};

/* Methods of a kind of file; `void *` points to the writer's own struct. */
struct gb_frame_writer {
    bool (*open)(void **writer, const struct gb_frame_output *output,
                 const struct gb_state *first, struct gb_error *err);
    /* number: from 1 */
    bool (*add)(void *writer, const struct gb_image *image, const struct gb_state *state,
                int number, struct gb_error *err);
    /* Puts the files in place when all went well (done), and returns that.  NULL is fine. */
    bool (*close)(void *writer, bool done, struct gb_error *err);
};

extern const struct gb_frame_writer gb_sequence_apng;

extern const struct gb_frame_writer gb_sequence_video;

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
