#include "tui/term/term_image.h"

#include <glib.h>
#include <string.h>

#include "tui/term/pixels.h"

static const double spacing_s = 1.0;

void gb_term_image_init(struct gb_term_image *image, int images)
{
    *image = (struct gb_term_image){.images = images, .last_s = -spacing_s};
}

static bool is_empty(const struct gb_term_picture *wanted)
{
    return wanted->sample == NULL && wanted->picture == NULL;
}

bool gb_term_image_before(struct gb_term_image *image, struct gb_term *term,
                          const struct gb_term_picture *wanted)
{
    if (!image->shown || (!is_empty(wanted) && wanted->picture == image->picture)) {
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

/* The largest rectangle of the picture's shape in the middle of the cells. */
static struct gb_rect fit_shape(const struct gb_png_pixels *picture,
                                const struct gb_rect *cells, struct gb_pixels_cell cell)
{
    struct gb_rect fitted = *cells;
    const double shape = (double)picture->wide / (double)picture->high;
    const double cols_per_row = shape * (double)cell.height / (double)cell.width;
    fitted.cols = CLAMP((int)(cols_per_row * (double)cells->rows), 1, cells->cols);
    fitted.rows = CLAMP((int)((double)fitted.cols / cols_per_row + 0.5), 1, cells->rows);
    fitted.row += (cells->rows - fitted.rows) / 2;
    fitted.col += (cells->cols - fitted.cols) / 2;
    return fitted;
}

static void show(struct gb_term_image *image, struct gb_term *term,
                 const struct gb_term_picture *wanted)
{
    struct gb_pixels_cell cell;
    struct gb_rect cells = *wanted->cells;
    char *text = NULL;
    gb_term_cell(term, &cell.width, &cell.height);
    if (wanted->picture != NULL) {
        cells = fit_shape(wanted->picture, &cells, cell);
        text = gb_pixels_encode_picture(image->images, wanted->picture, cells.rows,
                                        cells.cols, cell);
    } else {
        text = gb_pixels_encode(image->images, wanted->sample, wanted->look, cells.rows,
                                cells.cols, cell);
    }
    if (text != NULL) {
        gb_term_send(term, cells.row, cells.col, gb_pixels_wipe(image->images));
        gb_term_send(term, cells.row, cells.col, text);
    }
    g_free(text);
}

void gb_term_image_after(struct gb_term_image *image, struct gb_term *term,
                         const struct gb_term_picture *wanted, double now_s)
{
    const struct gb_rect *cells = wanted->cells;
    const bool wiped = image->repaints != gb_term_repaints(term);
    image->repaints = gb_term_repaints(term);
    if (is_empty(wanted) || cells->rows < 1 || cells->cols < 1) {
        return;
    }
    const double density = wanted->sample != NULL ? wanted->sample->density : 0.0;
    const bool other = !image->shown || wiped || !same_rect(cells, &image->rect) ||
                       (wanted->sample != NULL && !same_look(wanted->look, &image->look));
    image->waiting = density != image->density;
    if (!other && !gb_term_image_due(image, now_s)) {
        return;
    }
    show(image, term, wanted);
    image->shown = true;
    image->waiting = false;
    image->rect = *cells;
    image->density = density;
    image->picture = wanted->picture;
    image->look = *wanted->look;
    image->last_s = now_s;
}
