#ifndef GB_FIGURES_VIDEO_H
#define GB_FIGURES_VIDEO_H

#include "draw/image/image.h"
#include "greenbody/status.h"

/* A film through the program ffmpeg, which gets the frames as they come. */
struct gb_video;

/* Endings of names that are made into films. */
bool gb_video_knows(const char *path);

/* Errors: GB_ERR_MACHINE when there is no ffmpeg. */
bool gb_video_open(struct gb_video **out, const char *path, int width, int height,
                   double frames_per_s, const char *title, struct gb_error *err);
bool gb_video_add(struct gb_video *video, const struct gb_image *image,
                  struct gb_error *err);
/* The file is in place when this is true; else there is none.  NULL is fine. */
bool gb_video_close(struct gb_video *video, bool good, struct gb_error *err);

#endif
