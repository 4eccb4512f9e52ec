#include "tui/term/term_image.h"

#include <glib.h>
#include <string.h>

#include "tui/term/pixels.h"

static const double spacing_s = 1.0;

void gb_term_image_init(struct gb_term_image *image, int images)
{
    *image = (struct gb_term_image){.images = images, .last_s = -spacing_s};
}

bool gb_term_image_before(struct gb_term_image *image, struct gb_term *term,
                          const struct gb_view_sample *sample)
{
    if (!image->shown || sample != NULL) {
        return false;
    }
    gb_term_send(term, 0, 0, gb_pixels_wipe(image->images));
    image->shown = image->waiting = false;
    return true;
}

static bool same_rect(const struct gb_rect *a, const struct gb_rect *b)
{
    return a->row == b->row && a->col == b->col && a->rows == b->rows &&
           a->cols == b->cols;
}

static bool same_look(const struct gb_packing_look *a, const struct gb_packing_look *b)
{
    return a->colour == b->colour && a->azimuth_deg == b->azimuth_deg &&
           a->elevation_deg == b->elevation_deg;
}

bool gb_term_image_due(const struct gb_term_image *image, double now_s)
{
    return image->waiting && now_s >= image->last_s + spacing_s;
}

static void show(struct gb_term_image *image, struct gb_term *term,
                 const struct gb_view_sample *sample,
                 const struct gb_packing_look *look, const struct gb_rect *cells)
{
    struct gb_pixels_cell cell;
    gb_term_cell(term, &cell.width, &cell.height);
    char *text = gb_pixels_encode(image->images, sample, look, cells->rows,
                                  cells->cols, cell);
    if (text != NULL) {
        gb_term_send(term, cells->row, cells->col, gb_pixels_wipe(image->images));
        gb_term_send(term, cells->row, cells->col, text);
    }
    g_free(text);
}

void gb_term_image_after(struct gb_term_image *image, struct gb_term *term,
                         const struct gb_view_sample *sample,
                         const struct gb_packing_look *look, const struct gb_rect *cells,
                         double now_s)
{
    const bool wiped = image->repaints != gb_term_repaints(term);
    image->repaints = gb_term_repaints(term);
    if (sample == NULL || cells->rows < 1 || cells->cols < 1) {
        return;
    }
    const bool other = !image->shown || wiped || !same_rect(cells, &image->rect) ||
                       !same_look(look, &image->look);
    image->waiting = sample->density != image->density;
    if (!other && !gb_term_image_due(image, now_s)) {
        return;
    }
    show(image, term, sample, look, cells);
    image->shown = true;
    image->waiting = false;
    image->rect = *cells;
    image->density = sample->density;
    image->look = *look;
    image->last_s = now_s;
}
