#ifndef GB_FIGURES_SEQUENCE_VIDEO_H
#define GB_FIGURES_SEQUENCE_VIDEO_H

#include "draw/image/image.h"
#include "greenbody/status.h"

/* A video encoded by the program ffmpeg, which reads the frames from a pipe. */
struct gb_video;

struct gb_video_settings {
    const char *path;
    const char *extension; /* of the path */
    const char *filter;    /* of ffmpeg */
    int width, height;     /* pixels */
    double frames_per_s;
    const char *title;
};

/* Errors: GB_ERR_MACHINE when there is no ffmpeg. */
bool gb_video_open(struct gb_video **out, const struct gb_video_settings *settings,
                   struct gb_error *err);
bool gb_video_add(struct gb_video *video, const struct gb_image *image,
                  struct gb_error *err);
/* Puts the file in place when all frames were added (done), and returns that; removes it
 * otherwise.  NULL is fine. */
bool gb_video_close(struct gb_video *video, bool done, struct gb_error *err);

#endif
