#include <math.h>
#include <stdio.h>

#include "base/alloc.h"
#include "tui/plot/sphere_shading.h"
#include "tui/view/views.h"

/* Characters of increasing darkness, one per cell, for screens with few colours. */
static const uint32_t wide_ramp[] = {0x2591, 0x2592, 0x2593, 0x2588};
static const uint32_t ascii_ramp[] = {'.', ':', '-', '=', '+', '*', '#', '%', '@'};

enum {
    WIDE = sizeof wide_ramp / sizeof wide_ramp[0],
    ASCII = sizeof ascii_ramp / sizeof ascii_ramp[0]
};

static int level(float shade, int levels)
{
    const int k = (int)(shade * (float)levels);
    return k < 0 ? 0 : k >= levels ? levels - 1 : k;
}

/* A half block shows two dots of a cell: foreground above, background below. */
static void put_halves(struct gb_plot_cell *cell, float above, float below)
{
    if (above < 0.0F && below < 0.0F) {
        return;
    }
    const int up = above < 0.0F ? -1 : level(above, GB_PLOT_SHADES);
    const int down = below < 0.0F ? -1 : level(below, GB_PLOT_SHADES);
    cell->fixed = true;
    cell->ch = up < 0 ? 0x2584 : 0x2580;
    cell->ink = GB_PLOT_INK_SHADE + (up < 0 ? down : up);
    cell->back = up < 0 ? 0 : down + 1;
}

static void put_mean(struct gb_plot_cell *cell, float above, float below, bool ascii)
{
    const float mean = above < 0.0F   ? 0.5F * below
                       : below < 0.0F ? 0.5F * above
                                      : 0.5F * (above + below);
    if (above < 0.0F && below < 0.0F) {
        return;
    }
    cell->fixed = true;
    cell->ink = GB_PLOT_INK_TEXT;
    cell->ch = ascii ? ascii_ramp[level(mean, ASCII)] : wide_ramp[level(mean, WIDE)];
}

enum caption { CAPTION_CORNER, CAPTION_BELOW };

/* The caption: two short lines in the corner, or one below an image. */
static void write_caption(struct gb_plot *plot, const struct gb_view_sample *sample,
                          const struct gb_params *params, enum caption caption)
{
    char share[48];
    char size[48];
    char text[128];
    snprintf(share, sizeof share, "%d of %lld", sample->count, (long long)params->count);
    snprintf(size, sizeof size, "%.3g x %.3g d", sample->window[0], sample->window[2]);
    if (caption == CAPTION_BELOW) {
        snprintf(text, sizeof text, "%s, %s, z upwards", share, size);
        gb_plot_text(plot, plot->rows - 1, 0, GB_PLOT_INK_TEXT, text);
        return;
    }
    gb_plot_text(plot, plot->rows - 1, 0, GB_PLOT_INK_TEXT, share);
    gb_plot_text(plot, plot->rows - 2, 0, GB_PLOT_INK_TEXT, size);
    gb_plot_text(plot, 0, 0, GB_PLOT_INK_TEXT, "z");
}

void gb_view_packing_draw(struct gb_panel_plot *panel, const struct gb_session *session)
{
    const struct gb_session_shown shown = gb_session_shown(session);
    struct gb_plot *plot = &panel->plot;
    if (shown.sample == NULL || !shown.sample->valid) {
        gb_plot_text(plot, plot->rows / 2, 2, GB_PLOT_INK_TEXT, "no packing yet");
        return;
    }
    if (panel->pixels) { /* the image covers these cells */
        write_caption(plot, shown.sample, shown.params, CAPTION_BELOW);
        return;
    }
    const size_t dots = (size_t)plot->rows * (size_t)plot->cols * 2;
    float *shade = gb_alloc_array(dots, sizeof *shade, NULL);
    if (shade == NULL) {
        return;
    }
    gb_sphere_shading_render(shown.sample, 2 * plot->rows, plot->cols, shade);
    const bool ascii = plot->glyphs == GB_PLOT_ASCII;
    for (int r = 0; r < plot->rows; r++) {
        for (int c = 0; c < plot->cols; c++) {
            struct gb_plot_cell *cell = &plot->cell[r * plot->cols + c];
            const float above = shade[2 * r * plot->cols + c];
            const float below = shade[(2 * r + 1) * plot->cols + c];
            if (panel->shades && !ascii) {
                put_halves(cell, above, below);
            } else {
                put_mean(cell, above, below, ascii);
            }
        }
    }
    gb_alloc_free(shade);
    write_caption(plot, shown.sample, shown.params, CAPTION_CORNER);
}
