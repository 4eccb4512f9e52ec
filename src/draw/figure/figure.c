#include "draw/figure/figure.h"

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <glib.h>
#include <math.h>
#include <string.h>

#include "base/file.h"
#include "draw/figure/figure_marks.h"
#include "draw/figure/figure_names.h"
#include "draw/figure/figure_room.h"
#include "draw/image/text.h"
#include "draw/mute_stderr.h"

/* A page is as wide as this at least, and as high as that, in points; all else follows.
 */
static const double page_width = 420.0;
static const double page_height = 300.0;

static const double label_size = 10.0;
static const double tick_size = 8.8;
static const double inset_size = 7.4; /* of its tick labels */
static const double title_size = 10.6;
static const double caption_size = 8.0;
static const double rule = 0.6; /* frame and ticks */
static const double tick = 4.0; /* length */
static const double minor = 2.2;
static const double gap = 4.0;

/* A page under way; lengths in points. */
struct page {
    const struct gb_figure *figure;
    struct gb_text text;
    double width, height;
    double tick_size;
    double beside; /* room kept for a legend right of the frame */
    struct gb_figure_layout layout;
    struct gb_figure_names names;
};

/* Least and greatest value of a curve along one axis, with its errors. */
static void widen(const struct gb_figure_axis *axis, const double *value,
                  const double *error, size_t count, double *low, double *high)
{
    for (size_t k = 0; k < count; k++) {
        const double spread = error != NULL && isfinite(error[k]) ? error[k] : 0.0;
        if (!isfinite(value[k]) || (axis->log && value[k] <= 0.0)) {
            continue;
        }
        const double bottom = value[k] - spread;
        *low = fmin(*low, axis->log && bottom <= 0.0 ? value[k] : bottom);
        *high = fmax(*high, value[k] + spread);
    }
}

/* Marks and letters need room of their own beyond the outermost values. */
static bool has_marks(const struct gb_figure *figure)
{
    for (size_t i = 0; i < figure->count; i++) {
        if (figure->curve[i].kind == GB_FIGURE_POINTS ||
            figure->curve[i].kind == GB_FIGURE_BOTH) {
            return true;
        }
    }
    return figure->notes > 0;
}

/* An axis that begins at zero does so, but for marks that stand there. */
static void pad(const struct gb_figure_axis *axis, double share, bool marks, double *low,
                double *high)
{
    if (axis->log && *low > 0.0) {
        const double factor = pow(*high / *low, share);
        *low /= factor;
        *high *= factor;
    } else if (!axis->log) {
        const double span = *high - *low;
        *low -= *low == 0.0 && !marks ? 0.0 : share * span;
        *high += share * span;
    }
}

/* The ends of an axis: those given, else those of the data.  What begins at a small part
 * of its range begins at zero. */
static void ends(const struct page *page, bool along_x, double *low, double *high)
{
    const struct gb_figure *figure = page->figure;
    const struct gb_figure_axis *axis = along_x ? &figure->x : &figure->y;
    *low = INFINITY;
    *high = -INFINITY;
    for (size_t i = 0; i < figure->count; i++) {
        const struct gb_figure_curve *curve = &figure->curve[i];
        widen(axis, along_x ? curve->x : curve->y,
              along_x ? curve->x_error : curve->error, curve->count, low, high);
        if (!along_x && curve->kind == GB_FIGURE_STEPS) {
            *low = fmin(*low, 0.0);
        }
    }
    const bool marked = *low == 0.0 && has_marks(figure);
    if (!axis->log && *low > 0.0 && *low < 0.2 * *high) {
        *low = 0.0;
    }
    if (isfinite(*high - *low)) {
        const double share = figure->notes > 0 ? 0.08 : has_marks(figure) ? 0.04 : 0.0;
        pad(axis, along_x ? share : fmax(share, 0.03), marked, low, high);
    }
    *low = isfinite(axis->low) ? axis->low : *low;
    *high = isfinite(axis->high) ? axis->high : *high;
}

static void fit_axes(struct page *page)
{
    const struct gb_figure *figure = page->figure;
    struct gb_figure_layout *layout = &page->layout;
    for (int k = 0; k < 2; k++) {
        const struct gb_figure_axis *axis = k == 0 ? &figure->x : &figure->y;
        const bool exact[2] = {isfinite(axis->low), isfinite(axis->high)};
        const int wanted = (int)fmax(
            k == 0 ? (page->width - page->beside) / 62.0 : page->height / 48.0, 2.0);
        double low = 0.0;
        double high = 1.0;
        ends(page, k == 0, &low, &high);
        gb_figure_axis_fit(k == 0 ? &layout->x : &layout->y, axis->log, low, high, wanted,
                           exact);
    }
}

/* The name of an axis with the power its labels leave out. */
static char *axis_name(const struct gb_figure_axis *axis,
                       const struct gb_figure_axis_scale *scale)
{
    if (scale->power == 0) {
        return g_strdup(axis->label);
    }
    return g_strdup_printf("%s × 10<sup>%s%d</sup>", axis->label,
                           scale->power < 0 ? "\xe2\x88\x92" : "", abs(scale->power));
}

static double widest_label(const struct page *page)
{
    double most = 0.0;
    for (int k = 0; k < page->layout.y.ticks; k++) {
        double wide = 0.0;
        double high = 0.0;
        gb_text_measure(&page->text, page->layout.y.label[k], page->tick_size, 0.0, &wide,
                        &high);
        most = fmax(most, wide);
    }
    return most;
}

static double text_height(const struct page *page, const char *markup, double size)
{
    double wide = 0.0;
    double high = 0.0;
    if (markup != NULL && markup[0] != '\0') {
        gb_text_measure(&page->text, markup, size, page->width - 24.0, &wide, &high);
    }
    return high;
}

/* The axes run along the frame. */
static void aim(struct gb_figure_layout *layout)
{
    layout->x.from = layout->frame[0];
    layout->x.to = layout->frame[2];
    layout->y.from = layout->frame[3];
    layout->y.to = layout->frame[1];
}

static void set_frame(struct page *page)
{
    const struct gb_figure *figure = page->figure;
    struct gb_figure_layout *layout = &page->layout;
    const double title = text_height(page, figure->title, title_size);
    const double caption = text_height(page, figure->caption, caption_size);
    double *frame = layout->frame;
    frame[0] = 10.0 + 1.5 * label_size + widest_label(page) + 2.0 * gap;
    frame[1] = 8.0 + (title > 0.0 ? title + 5.0 : 0.0);
    frame[2] = page->width - 14.0 - page->beside;
    frame[3] = page->height - 6.0 - (caption > 0.0 ? caption + 6.0 : 0.0) -
               1.7 * label_size - 1.5 * tick_size - gap;
    frame[2] = fmax(frame[2], frame[0] + 10.0);
    frame[3] = fmax(frame[3], frame[1] + 10.0);
    aim(layout);
}

/* The largest free rectangle of some that will do. */
static void place_inset(struct page *page)
{
    static const double shares[] = {0.5, 0.46, 0.42, 0.38, 0.34};
    const double *f = page->layout.frame;
    struct gb_figure_room room;
    if (!(page->figure->inset[0] < page->figure->inset[1])) {
        return;
    }
    gb_figure_room_init(&room, page->figure, &page->layout);
    for (size_t k = 0; k < G_N_ELEMENTS(shares); k++) {
        if (gb_figure_room_find(&room, shares[k] * (f[2] - f[0]),
                                shares[k] * (f[3] - f[1]), page->layout.inset)) {
            break;
        }
    }
    gb_figure_room_finish(&room);
}

/* The legend beside the frame, when there is no room in it. */
static void set_names(struct page *page)
{
    gb_figure_names_place(&page->names, page->figure, &page->layout, &page->text);
    if (!page->names.outside) {
        return;
    }
    page->beside = fmin(page->names.legend[2] + gap, 0.5 * page->width);
    fit_axes(page);
    set_frame(page);
    memset(page->layout.inset, 0, sizeof page->layout.inset);
    place_inset(page);
    const double wide = page->names.legend[2];
    const double high = page->names.legend[3];
    gb_figure_names_finish(&page->names);
    gb_figure_names_place(&page->names, page->figure, &page->layout, &page->text);
    if (page->names.outside) {
        const double left = page->layout.frame[2] + gap;
        const double top = page->layout.frame[1];
        const double box[4] = {left, top, left + wide, top + high};
        memcpy(page->names.legend, box, sizeof box);
    }
}

static void rule_at(cairo_t *cairo, double x0, double y0, double x1, double y1)
{
    cairo_move_to(cairo, x0, y0);
    cairo_line_to(cairo, x1, y1);
}

/* Ticks stand inside the frame, on both sides. */
static void draw_ticks(const struct page *page, bool along_x, const double *values,
                       int count, double length)
{
    cairo_t *cairo = page->text.cairo;
    const double *f = page->layout.frame;
    for (int k = 0; k < count; k++) {
        const double at =
            gb_figure_axis_place(along_x ? &page->layout.x : &page->layout.y, values[k]);
        if (along_x) {
            rule_at(cairo, at, f[3], at, f[3] - length);
            rule_at(cairo, at, f[1], at, f[1] + length);
        } else {
            rule_at(cairo, f[0], at, f[0] + length, at);
            rule_at(cairo, f[2], at, f[2] - length, at);
        }
    }
    cairo_stroke(cairo);
}

static void draw_tick_labels(const struct page *page)
{
    const struct gb_figure_layout *layout = &page->layout;
    for (int k = 0; k < layout->x.ticks; k++) {
        const double at[2] = {gb_figure_axis_place(&layout->x, layout->x.tick[k]),
                              layout->frame[3] + gap};
        gb_text_write(&page->text, layout->x.label[k], page->tick_size, 0.0, at,
                      (double[2]){0.5, 0.0}, 0);
    }
    for (int k = 0; k < layout->y.ticks; k++) {
        const double at[2] = {layout->frame[0] - gap,
                              gb_figure_axis_place(&layout->y, layout->y.tick[k])};
        gb_text_write(&page->text, layout->y.label[k], page->tick_size, 0.0, at,
                      (double[2]){1.0, 0.5}, 0);
    }
}

static void draw_rules(const struct page *page)
{
    cairo_t *cairo = page->text.cairo;
    const struct gb_figure_layout *layout = &page->layout;
    const double *f = layout->frame;
    cairo_set_source_rgb(cairo, 0.1, 0.1, 0.12);
    cairo_set_line_width(cairo, rule);
    cairo_rectangle(cairo, f[0], f[1], f[2] - f[0], f[3] - f[1]);
    cairo_stroke(cairo);
    draw_ticks(page, true, layout->x.tick, layout->x.ticks, tick);
    draw_ticks(page, false, layout->y.tick, layout->y.ticks, tick);
    draw_ticks(page, true, layout->x.minor, layout->x.minors, minor);
    draw_ticks(page, false, layout->y.minor, layout->y.minors, minor);
    draw_tick_labels(page);
}

static void draw_axes(const struct page *page)
{
    const struct gb_figure_layout *layout = &page->layout;
    const double *f = layout->frame;
    draw_rules(page);
    char *x_name = axis_name(&page->figure->x, &layout->x);
    char *y_name = axis_name(&page->figure->y, &layout->y);
    gb_text_write(&page->text, x_name, label_size, 0.0,
                  (double[2]){0.5 * (f[0] + f[2]), f[3] + gap + 1.5 * tick_size},
                  (double[2]){0.5, 0.0}, 0);
    gb_text_write(&page->text, y_name, label_size, 0.0,
                  (double[2]){8.0, 0.5 * (f[1] + f[3])}, (double[2]){0.5, 0.0}, 1);
    g_free(x_name);
    g_free(y_name);
}

static void draw_notes(const struct page *page)
{
    for (size_t k = 0; k < page->figure->notes; k++) {
        const struct gb_figure_note *note = &page->figure->note[k];
        const double at[2] = {
            gb_figure_axis_place(&page->layout.x, note->x) + (note->left ? -4.0 : 4.0),
            gb_figure_axis_place(&page->layout.y, note->y) + (note->below ? 3.0 : -3.0)};
        const double align[2] = {note->left ? 1.0 : 0.0, note->below ? 0.0 : 1.0};
        gb_text_write(&page->text, note->text, tick_size, 0.0, at, align, 0);
    }
}

static void draw_words(const struct page *page)
{
    const struct gb_figure *figure = page->figure;
    cairo_set_source_rgb(page->text.cairo, 0.1, 0.1, 0.12);
    if (figure->title != NULL && figure->title[0] != '\0') {
        char *bold = g_strdup_printf("<b>%s</b>", figure->title);
        gb_text_write(&page->text, bold, title_size, page->width - 24.0,
                      (double[2]){12.0, 7.0}, (double[2]){0.0, 0.0}, 0);
        g_free(bold);
    }
    if (figure->caption != NULL && figure->caption[0] != '\0') {
        cairo_set_source_rgb(page->text.cairo, 0.32, 0.33, 0.36);
        gb_text_write(&page->text, figure->caption, caption_size, page->width - 24.0,
                      (double[2]){12.0, page->height - 6.0}, (double[2]){0.0, 1.0}, 0);
    }
}

/* Faint curves lie under bands, bands and lines under points. */
static void draw_curves(const struct page *page)
{
    static const enum gb_figure_kind order[] = {GB_FIGURE_FAINT, GB_FIGURE_STEPS,
                                                GB_FIGURE_LINE, GB_FIGURE_BOTH,
                                                GB_FIGURE_POINTS};
    cairo_t *cairo = page->text.cairo;
    const double *f = page->layout.frame;
    cairo_save(cairo);
    cairo_rectangle(cairo, f[0], f[1], f[2] - f[0], f[3] - f[1]);
    cairo_clip(cairo);
    for (size_t layer = 0; layer < G_N_ELEMENTS(order); layer++) {
        for (size_t i = 0; i < page->figure->count; i++) {
            if (page->figure->curve[i].kind == order[layer]) {
                gb_figure_marks_curve(cairo, &page->layout, &page->figure->curve[i]);
            }
        }
    }
    cairo_restore(cairo);
}

/* The part of the x axis that is drawn larger, and what y has there. */
static void inset_axes(const struct gb_figure *figure, struct gb_figure *part)
{
    double low = INFINITY;
    double high = -INFINITY;
    *part = *figure;
    part->x.low = figure->inset[0];
    part->x.high = figure->inset[1];
    for (size_t i = 0; i < figure->count; i++) {
        const struct gb_figure_curve *curve = &figure->curve[i];
        for (size_t k = 0; k < curve->count; k++) {
            if (curve->x[k] >= part->x.low && curve->x[k] <= part->x.high) {
                widen(&figure->y, &curve->y[k], curve->error ? &curve->error[k] : NULL, 1,
                      &low, &high);
            }
        }
    }
    pad(&figure->y, 0.06, true, &low, &high);
    part->y.low = low;
    part->y.high = high;
}

static void draw_inset(const struct page *page)
{
    cairo_t *cairo = page->text.cairo;
    const double *box = page->layout.inset;
    struct gb_figure part;
    if (!(box[2] > box[0])) {
        return;
    }
    inset_axes(page->figure, &part);
    struct page small = *page;
    small.figure = &part;
    small.width = 1.15 * (box[2] - box[0]); /* for the number of ticks */
    small.height = 1.3 * (box[3] - box[1]);
    small.tick_size = inset_size;
    fit_axes(&small);
    double *frame = small.layout.frame;
    frame[0] = box[0] + widest_label(&small) + gap;
    frame[1] = box[1];
    frame[2] = box[2] - inset_size; /* half a number sticks out */
    frame[3] = box[3] - 1.5 * inset_size - gap;
    aim(&small.layout);
    cairo_set_source_rgb(cairo, 1.0, 1.0, 1.0);
    cairo_rectangle(cairo, frame[0], frame[1], frame[2] - frame[0], frame[3] - frame[1]);
    cairo_fill(cairo);
    draw_curves(&small);
    draw_rules(&small);
}

/* The whole page onto a surface of which a point is `unit` long. */
static bool draw(cairo_surface_t *surface, const struct gb_figure *figure, double width,
                 double height, double unit, struct gb_figure_layout *out,
                 struct gb_error *err)
{
    cairo_t *cairo = cairo_create(surface);
    struct page page = {
        .figure = figure, .width = width, .height = height, .tick_size = tick_size};
    bool good = gb_text_init(&page.text, cairo, err);
    if (good) {
        cairo_scale(cairo, unit, unit);
        cairo_set_source_rgb(cairo, 1.0, 1.0, 1.0);
        cairo_paint(cairo);
        fit_axes(&page);
        set_frame(&page);
        place_inset(&page);
        set_names(&page);
        draw_curves(&page);
        draw_axes(&page);
        draw_inset(&page);
        draw_notes(&page);
        gb_figure_names_draw(&page.names, figure, &page.text);
        draw_words(&page);
        page.layout.unit = unit;
        memcpy(page.layout.legend, page.names.legend, sizeof page.layout.legend);
        page.layout.direct = page.names.at[0][2] > 0.0;
        *out = page.layout;
    }
    const cairo_status_t status = cairo_status(cairo);
    gb_figure_names_finish(&page.names);
    gb_text_finish(&page.text);
    cairo_destroy(cairo);
    if (good && status != CAIRO_STATUS_SUCCESS) {
        good = gb_error_set(
            err, status == CAIRO_STATUS_NO_MEMORY ? GB_ERR_MEMORY : GB_ERR_MACHINE,
            "the figure cannot be drawn: %s", cairo_status_to_string(status));
    }
    return good;
}

/* From points to pixels. */
static void enlarge(struct gb_figure_layout *layout)
{
    for (int k = 0; k < 4; k++) {
        layout->frame[k] *= layout->unit;
        layout->legend[k] *= layout->unit;
        layout->inset[k] *= layout->unit;
    }
    layout->x.from *= layout->unit;
    layout->x.to *= layout->unit;
    layout->y.from *= layout->unit;
    layout->y.to *= layout->unit;
}

/* Points per page so that neither side is less than it may be. */
static double pixels_per_point(int width, int height)
{
    return fmin(width / page_width, height / page_height);
}

bool gb_figure_paint(struct gb_image **out, const struct gb_figure *figure, int width,
                     int height, struct gb_figure_layout *layout, struct gb_error *err)
{
    if (!gb_image_create(out, width, height, err)) {
        return false;
    }
    const double unit = pixels_per_point(width, height);
    cairo_surface_t *surface = cairo_image_surface_create_for_data(
        (*out)->rgba, CAIRO_FORMAT_ARGB32, width, height, 4 * width);
    const int kept = gb_mute_stderr_begin();
    const bool good =
        draw(surface, figure, width / unit, height / unit, unit, layout, err);
    gb_mute_stderr_end(kept);
    cairo_surface_finish(surface);
    cairo_surface_destroy(surface);
    if (!good) {
        gb_image_destroy(*out);
        *out = NULL;
        return false;
    }
    enlarge(layout);
    gb_image_swap_red_blue(*out);
    return true;
}

static cairo_status_t collect(void *closure, const unsigned char *data, unsigned length)
{
    g_byte_array_append(closure, data, length);
    return CAIRO_STATUS_SUCCESS;
}

static bool write_vector(const struct gb_figure *figure, int width, int height,
                         const char *path, struct gb_error *err)
{
    const double unit = pixels_per_point(width, height);
    struct gb_figure_layout layout;
    GByteArray *bytes = g_byte_array_new();
    cairo_surface_t *surface = NULL;
    if (g_str_has_suffix(path, ".pdf")) {
        surface = cairo_pdf_surface_create_for_stream(collect, bytes, width / unit,
                                                      height / unit);
        cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_CREATOR,
                                       "greenbody " GB_VERSION);
        /* the same figure, the same bytes */
        cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_CREATE_DATE, "");
    } else {
        surface = cairo_svg_surface_create_for_stream(collect, bytes, width / unit,
                                                      height / unit);
        cairo_svg_surface_set_document_unit(surface, CAIRO_SVG_UNIT_PT);
    }
    const int kept = gb_mute_stderr_begin();
    bool good = draw(surface, figure, width / unit, height / unit, 1.0, &layout, err);
    cairo_surface_finish(surface);
    gb_mute_stderr_end(kept);
    const cairo_status_t status = cairo_surface_status(surface);
    cairo_surface_destroy(surface);
    if (good && status != CAIRO_STATUS_SUCCESS) {
        good = gb_error_set(err, GB_ERR_MACHINE, "%.300s: cannot be drawn: %s", path,
                            cairo_status_to_string(status));
    }
    good = good && gb_file_replace(path, bytes->data, bytes->len, err);
    g_byte_array_unref(bytes);
    return good;
}

bool gb_figure_is_file(const char *path)
{
    return g_str_has_suffix(path, ".png") || g_str_has_suffix(path, ".svg") ||
           g_str_has_suffix(path, ".pdf");
}

bool gb_figure_write(const struct gb_figure *figure, int width, int height,
                     const struct gb_png_text *texts, int text_count, const char *path,
                     struct gb_error *err)
{
    struct gb_figure_layout layout;
    struct gb_image *image = NULL;
    if (!gb_file_check_target(path, err)) {
        return false;
    }
    if (!g_str_has_suffix(path, ".png")) {
        return write_vector(figure, width, height, path, err);
    }
    const bool good = gb_figure_paint(&image, figure, width, height, &layout, err) &&
                      gb_png_write(image, true, texts, text_count, path, err);
    gb_image_destroy(image);
    return good;
}
