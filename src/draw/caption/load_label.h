#ifndef GB_DRAW_CAPTION_LOAD_LABEL_H
#define GB_DRAW_CAPTION_LOAD_LABEL_H

#include "draw/scene.h"
#include "draw/view.h"

/* Lengths in lines of text. */
#define GB_LOAD_LABEL_WIDTH 4.4
#define GB_LOAD_LABEL_LINE  0.85 /* size of its letters */

/* Of `count` arrows of pressing (6 numbers each) the one that is steepest in the picture and so has the word beside it;
 * -1 when all lie along the view. */
int gb_load_label_arrow(const float *arrow, int count);

/* Whether an arrow is drawn as its end. */
bool gb_load_label_end_on(const float arrow[6]);

/* Frame of the word beside an arrow: on a side where the page, `page` pixels wide, has room,
 * and above all that is drawn there, but not above `top`.  unit: height of a line, pixels. */
void gb_load_label_find(const struct gb_scene *scene, int arrow, double unit, double page,
                        double top, struct gb_frame *frame);

#endif
