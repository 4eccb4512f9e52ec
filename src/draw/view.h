#ifndef GB_DRAW_VIEW_H
#define GB_DRAW_VIEW_H

#include <stdbool.h>

#include "greenbody/status.h"
#include "pack/cell/cell.h"

/* Direction of view of a picture. */
struct gb_viewpoint {
    double azimuth_deg;   /* of the viewer around z; 0 is on the x axis, -90 on -y */
    double elevation_deg; /* of the viewer above the x-y plane */
    bool orthographic;
    double extent[3]; /* upper corner of the box that fits the frame; 0: the packing's */
    double lowest[3]; /* its lower corner: below 0 for tilted cells */
};

/* "corner", "front" (along y), "side" (along x), "top", or "AZIMUTH,ELEVATION" in
 * degrees; ",flat" behind any of them makes it orthographic.  Errors: GB_ERR_INPUT
 * saying what is expected. */
bool gb_view_parse(const char *text, struct gb_viewpoint *viewpoint,
                   struct gb_error *err);

/* Extends the box that fits the frame by the corners of a cell. */
void gb_view_include(struct gb_viewpoint *viewpoint, const struct gb_cell *cell);

/* Rectangle of the image that the box may fill, pixels, y downwards. */
struct gb_frame {
    double left, top, width, height;
};

/* Camera of one picture.  Eye coordinates: x right, y up, w depth away from the viewer;
 * a point is seen at pixel (centre + focal (x, -y) / w), without the division when
 * orthographic. */
struct gb_view {
    double right[3], up[3], away[3]; /* orthonormal, in cell axes */
    double target[3];                /* middle of the box */
    double distance;                 /* depth of target; 0 when orthographic */
    double focal, centre[2];
    bool orthographic;
    double near, far; /* depths of the box and the spheres that extend beyond it */
    double low[2],
        high[2]; /* what fits the frame: x/w and y/w, x and y when orthographic */
};

/* Camera with the whole box in its frame, with `margin` around it, as large as the frame
 * allows. */
void gb_view_init(struct gb_view *view, const struct gb_viewpoint *viewpoint,
                  const double cell[3], double margin, const struct gb_frame *frame);

/* The camera's scale and centre for its bounds and another frame. */
void gb_view_set_frame(struct gb_view *view, const struct gb_frame *frame);

/* Eye coordinates of a point of the cell. */
void gb_view_eye(const struct gb_view *view, const double point[3], double eye[3]);
/* Pixel of a point in eye coordinates. */
void gb_view_pixel(const struct gb_view *view, const double eye[3], double pixel[2]);
/* Pixels per diameter in the middle of the box. */
double gb_view_scale(const struct gb_view *view);

#endif
