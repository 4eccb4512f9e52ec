#ifndef GB_DRAW_CAPTION_H
#define GB_DRAW_CAPTION_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/units.h"
#include "draw/image.h"
#include "draw/picture_style.h"
#include "draw/scene.h"
#include "draw/text.h"
#include "draw/view.h"
#include "greenbody/status.h"
#include "io/state.h"

/* Height of a line of the legend of forces, lines of text. */
#define GB_CAPTION_LEGEND_LINE 1.45

/* Which sides of the page shrink to what is drawn. */
enum gb_caption_crop { GB_CAPTION_NO_CROP, GB_CAPTION_CROP_HEIGHT, GB_CAPTION_CROP_BOTH };

/* What a page is arranged for. */
struct gb_caption_page {
    int width, height; /* pixels; the largest ones of a side that is cropped */
    int per_inch;      /* pixels in print, whose letters have their size there
                          (image.h); 0: letters by the size of the image */
    enum gb_caption_crop crop;
    bool annotated;
    bool bar;      /* there is a colour bar */
    bool load;     /* there is an arrow of pressing with its word */
    int rods;      /* lines of the legend of forces; 0: none */
    double aspect; /* height over width of what is drawn */
};

/* Text, colour bar and scale bar around the packing. */
struct gb_caption_layout {
    int width, height;      /* of the page */
    struct gb_frame scene;  /* space of the packing */
    struct gb_frame bar;    /* colour bar */
    struct gb_frame legend; /* of forces */
    struct gb_frame axes;   /* of the cell, in the lower right corner */
    double unit;            /* height of a line of text, pixels; 0: no text */
};

/* The packing and, beside it, the column of its bar and legend fill the page; on a page that
 * is not cropped they are in its middle. */
void gb_caption_arrange(const struct gb_caption_page *page,
                        struct gb_caption_layout *layout);

/* Of `count` arrows of pressing (6 numbers each) the one that is steepest in the picture and so has the word beside it;
 * -1 when all lie along the view. */
int gb_caption_load_arrow(const float *arrow, int count);

/* Frame of the word beside an arrow: on a side where the page, `page` pixels wide, has room,
 * and above all that is drawn there, but not above `top`.  unit: height of a line, pixels. */
void gb_caption_load_word(const struct gb_scene *scene, int arrow, double unit,
                          double page, double top, struct gb_frame *frame);

/* Lines of the legend; 0: the style has no forces. */
int gb_caption_legend_lines(const struct gb_picture_style *style);

/* Largest of 1, 2, 5 x 10^k m that is at most `max_m`; label: its text. */
double gb_caption_bar_length(double max_m, char *label, size_t size);

bool gb_caption_draw(struct gb_image *image, const struct gb_caption_layout *layout,
                     const struct gb_scene *scene, const struct gb_picture_style *style,
                     const struct gb_state *state, struct gb_error *err);

/* Texts around a rose of forces in a box with half the edge `reach`; mean_n: mean force, N. */
bool gb_caption_draw_rose(struct gb_image *image, const struct gb_caption_layout *layout,
                          const struct gb_scene *scene, double reach, double mean_n,
                          struct gb_error *err);

#endif
