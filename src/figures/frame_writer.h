#ifndef GB_FIGURES_FRAME_WRITER_H
#define GB_FIGURES_FRAME_WRITER_H

#include "draw/packing_image.h"

/* Files that the frames of a sequence go to. */
struct gb_frame_output {
    const char *path;
    const struct gb_packing_image *packing_image; /* background, preset */
    int width, height;                            /* of a frame */
    int count;                                    /* of all frames */
    double frames_per_s;
};

/* Methods of a kind of file; the writer is its own struct behind void. */
struct gb_frame_writer {
    bool (*open)(void **writer, const struct gb_frame_output *output,
                 const struct gb_state *first, struct gb_error *err);
    /* number: from 1 */
    bool (*add)(void *writer, const struct gb_image *image, const struct gb_state *state,
                int number, struct gb_error *err);
    /* Puts the files in place when all went well (done), and returns that.  NULL is fine. */
    bool (*close)(void *writer, bool done, struct gb_error *err);
};

extern const struct gb_frame_writer gb_frame_writer_apng;
extern const struct gb_frame_writer gb_frame_writer_video;
/* One PNG per frame, for a path with one %d or %03d. */
extern const struct gb_frame_writer gb_frame_writer_numbered;

/* Path of frame `number`; NULL unless the path has one %d or %0Nd.  g_free. */
char *gb_frame_writer_path(const char *path, int number);

#endif
