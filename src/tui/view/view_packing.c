#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/alloc.h"
#include "tui/panel/sphere_shading.h"
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

static bool is_outline(float dot)
{
    return dot > 1.0F;
}

/* Sets the cell of an outline, which is in front of spheres and background. */
static void put_outline(struct gb_plot_cell *cell, float above, float below)
{
    const float behind = is_outline(above) ? below : above;
    cell->fixed = true;
    cell->ink = GB_PLOT_INK_AXIS;
    cell->ch = is_outline(above) && is_outline(below) ? 0x2588
               : is_outline(above)                    ? 0x2580
                                                      : 0x2584;
    cell->back =
        behind < 0.0F || is_outline(behind) ? 0 : level(behind, GB_PLOT_SHADES) + 1;
}

/* A half block shows two dots: above as foreground and below as background. */
static void put_halves(struct gb_plot_cell *cell, float above, float below)
{
    if (above < 0.0F && below < 0.0F) {
        return;
    }
    if (is_outline(above) || is_outline(below)) {
        put_outline(cell, above, below);
        return;
    }
    const int up = above < 0.0F ? -1 : level(above, GB_PLOT_SHADES);
    const int down = below < 0.0F ? -1 : level(below, GB_PLOT_SHADES);
    cell->fixed = true;
    cell->ch = up < 0 ? 0x2584 : 0x2580;
    cell->ink = GB_PLOT_INK_SHADE + (up < 0 ? down : up);
    cell->back = up < 0 ? 0 : down + 1;
}

static void put_sign(struct gb_plot_cell *cell, float dot, bool ascii)
{
    static const uint32_t signs[2][4] = {{0x2502, 0x2500, '/', '\\'},
                                         {'|', '-', '/', '\\'}};
    const int k = (int)(dot - GB_SPHERE_SHADING_UPRIGHT);
    cell->fixed = true;
    cell->ink = GB_PLOT_INK_AXIS;
    cell->ch = signs[ascii][k];
}

static void put_mean(struct gb_plot_cell *cell, float above, float below, bool ascii)
{
    if (is_outline(above) || is_outline(below)) {
        put_sign(cell, is_outline(above) ? above : below, ascii);
        return;
    }
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

/* Sets one cell of the colour ramp. */
static void put_shade(const struct gb_panel_plot *panel, struct gb_plot_cell *cell, int k,
                      int cells)
{
    const float shade = ((float)k + 0.5F) / (float)cells;
    const bool ascii = panel->plot.glyphs == GB_PLOT_ASCII;
    if (panel->shades && !ascii) {
        put_halves(cell, shade, shade);
    } else {
        put_mean(cell, shade, shade, ascii);
    }
}

/* Writes "coordination number 0 ######## 9", with ">" if some particles are beyond the
 * range. */
static void write_legend(struct gb_panel_plot *panel, const struct gb_view_sample *sample)
{
    struct gb_plot *plot = &panel->plot;
    const struct gb_packing_range range =
        gb_sphere_shading_range(sample, panel->look.colour);
    char text[96];
    snprintf(text, sizeof text, "%s %.3g ", gb_sphere_shading_name(panel->look.colour),
             range.low);
    const int from = 3, at = from + (int)strlen(text);
    gb_plot_text(plot, 0, from, GB_PLOT_INK_TEXT, text);
    for (int k = 0; k < GB_PLOT_SHADES && at + k < plot->cols; k++) {
        put_shade(panel, &plot->cell[at + k], k, GB_PLOT_SHADES);
    }
    snprintf(text, sizeof text, " %s%.3g", range.beyond ? ">" : "", range.high);
    gb_plot_text(plot, 0, at + GB_PLOT_SHADES, GB_PLOT_INK_TEXT, text);
}

enum caption { CAPTION_CORNER, CAPTION_BELOW };

/* Writes the caption: two short lines in the corner, or one line below an image. */
static void write_caption(struct gb_panel_plot *panel,
                          const struct gb_view_sample *sample,
                          const struct gb_params *params, enum caption caption)
{
    struct gb_plot *plot = &panel->plot;
    char legend[96] = "";
    char share[48];
    char size[48];
    char text[256];
    snprintf(share, sizeof share, "%d of %lld", sample->count, (long long)params->count);
    snprintf(size, sizeof size, "%.3g x %.3g d", sample->window[0], sample->window[2]);
    if (caption == CAPTION_BELOW) {
        if (panel->look.colour != GB_PACKING_COLOUR_DEPTH) {
            const struct gb_packing_range range =
                gb_sphere_shading_range(sample, panel->look.colour);
            snprintf(legend, sizeof legend, ", %s %.3g to %s%.3g",
                     gb_sphere_shading_name(panel->look.colour), range.low,
                     range.beyond ? ">" : "", range.high);
        }
        snprintf(text, sizeof text, "%s, %s, z upwards%s", share, size, legend);
        gb_plot_text(plot, plot->rows - 1, 0, GB_PLOT_INK_TEXT, text);
        return;
    }
    gb_plot_text(plot, plot->rows - 1, 0, GB_PLOT_INK_TEXT, share);
    gb_plot_text(plot, plot->rows - 2, 0, GB_PLOT_INK_TEXT, size);
    gb_plot_text(plot, 0, 0, GB_PLOT_INK_TEXT, "z");
    if (panel->look.colour != GB_PACKING_COLOUR_DEPTH) {
        write_legend(panel, sample);
    }
    if (panel->look.azimuth_deg != 0.0 || panel->look.elevation_deg != 0.0) {
        snprintf(text, sizeof text, "turned by %.0f, %.0f degrees",
                 panel->look.azimuth_deg, panel->look.elevation_deg);
        gb_plot_text(plot, plot->rows - 1, plot->cols - (int)strlen(text) - 1,
                     GB_PLOT_INK_TEXT, text);
    }
}

/* Angle by which arrow keys turn the packing, degrees. */
static const double step_deg = 15.0;

/* Left turns the packing to the left, so the viewer moves to the right. */
void gb_view_packing_navigate(struct gb_panel_plot *panel, enum gb_action action)
{
    switch (action) {
    case GB_ACTION_LEFT:
        gb_sphere_shading_rotate(&panel->look, step_deg, 0.0);
        break;
    case GB_ACTION_RIGHT:
        gb_sphere_shading_rotate(&panel->look, -step_deg, 0.0);
        break;
    case GB_ACTION_UP:
        gb_sphere_shading_rotate(&panel->look, 0.0, step_deg);
        break;
    case GB_ACTION_DOWN:
        gb_sphere_shading_rotate(&panel->look, 0.0, -step_deg);
        break;
    case GB_ACTION_HOME:
    case GB_ACTION_BACK:
        panel->look.azimuth_deg = panel->look.elevation_deg = 0.0;
        break;
    default:
        break;
    }
}

void gb_view_packing_draw(struct gb_panel_plot *panel, const struct gb_session *session)
{
    const struct gb_session_shown shown = gb_session_shown(session);
    struct gb_plot *plot = &panel->plot;
    if (shown.sample == NULL || !shown.sample->valid) {
        gb_plot_text(plot, plot->rows / 2, 2, GB_PLOT_INK_TEXT,
                     session->attached != NULL
                         ? "no packing yet: it comes with the run's first checkpoint"
                         : "no packing yet");
        return;
    }
    if (panel->pixels) { /* the image covers these cells */
        write_caption(panel, shown.sample, shown.params, CAPTION_BELOW);
        return;
    }
    const size_t dots = (size_t)plot->rows * (size_t)plot->cols * 2;
    float *shade = gb_alloc_array(dots, sizeof *shade, NULL);
    if (shade == NULL) {
        return;
    }
    gb_sphere_shading_render(shown.sample, &panel->look, 2 * plot->rows, plot->cols,
                             shade);
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
    write_caption(panel, shown.sample, shown.params, CAPTION_CORNER);
}
