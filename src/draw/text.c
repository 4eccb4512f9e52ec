#include "draw/text.h"

#include <fcntl.h>
#include <fontconfig/fontconfig.h>
#include <math.h>
#include <stdio.h>
#include <unistd.h>

int gb_text_mute_begin(void)
{
    fflush(stderr);
    const int saved = fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 3);
    const int null = open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (saved >= 0 && null >= 0) {
        dup2(null, STDERR_FILENO);
    }
    if (null >= 0) {
        close(null);
    }
    return saved;
}

void gb_text_mute_end(int saved)
{
    if (saved >= 0) {
        fflush(stderr);
        dup2(saved, STDERR_FILENO);
        close(saved);
    }
}

static const char *const face = "DejaVu Sans, Noto Sans, Liberation Sans, Sans";

bool gb_text_init(struct gb_text *text, cairo_t *cairo, struct gb_error *err)
{
    *text = (struct gb_text){.cairo = cairo};
    /* Pango aborts without a font */
    const FcFontSet *fonts = FcConfigGetFonts(NULL, FcSetSystem);
    if (fonts == NULL || fonts->nfont == 0) {
        return gb_error_set(err, GB_ERR_MACHINE,
                            "no font is installed; texts in pictures and figures need "
                            "one, as in the package fonts-dejavu-core");
    }
    text->layout = pango_cairo_create_layout(cairo);
    /* the same spacing at every size and in every kind of file */
    cairo_font_options_t *options = cairo_font_options_create();
    cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
    cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
    cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
    PangoContext *context = pango_layout_get_context(text->layout);
    pango_cairo_context_set_font_options(context, options);
    pango_context_set_round_glyph_positions(context, FALSE);
    pango_layout_context_changed(text->layout);
    cairo_font_options_destroy(options);
    return true;
}

void gb_text_finish(struct gb_text *text)
{
    if (text->layout != NULL) {
        g_object_unref(text->layout);
    }
    *text = (struct gb_text){0};
}

static void set(const struct gb_text *text, const char *markup, double size, double width)
{
    PangoFontDescription *font = pango_font_description_from_string(face);
    pango_font_description_set_absolute_size(font, size * PANGO_SCALE);
    pango_layout_set_font_description(text->layout, font);
    pango_font_description_free(font);
    pango_layout_set_attributes(text->layout, NULL);
    if (pango_parse_markup(markup, -1, 0, NULL, NULL, NULL, NULL)) {
        pango_layout_set_markup(text->layout, markup, -1);
    } else {
        pango_layout_set_text(text->layout, markup, -1);
    }
    pango_layout_set_width(text->layout, width > 0.0 ? (int)(width * PANGO_SCALE) : -1);
    pango_layout_set_wrap(text->layout, PANGO_WRAP_WORD_CHAR);
    pango_layout_set_ellipsize(text->layout, PANGO_ELLIPSIZE_NONE);
}

static void extent(const struct gb_text *text, double *wide, double *high)
{
    PangoRectangle logical;
    pango_layout_get_extents(text->layout, NULL, &logical);
    *wide = (double)logical.width / PANGO_SCALE;
    *high = (double)logical.height / PANGO_SCALE;
}

void gb_text_measure(const struct gb_text *text, const char *markup, double size,
                     double width, double *wide, double *high)
{
    set(text, markup, size, width);
    extent(text, wide, high);
}

/* What `set` has put into the layout. */
static void show(const struct gb_text *text, const double at[2], const double align[2],
                 int quarters)
{
    double wide = 0.0;
    double high = 0.0;
    extent(text, &wide, &high);
    cairo_save(text->cairo);
    cairo_translate(text->cairo, at[0], at[1]);
    cairo_rotate(text->cairo, -0.5 * G_PI * quarters);
    cairo_move_to(text->cairo, -align[0] * wide, -align[1] * high);
    pango_cairo_show_layout(text->cairo, text->layout);
    cairo_restore(text->cairo);
}

void gb_text_write(const struct gb_text *text, const char *markup, double size,
                   double width, const double at[2], const double align[2], int quarters)
{
    set(text, markup, size, width);
    show(text, at, align, quarters);
}

void gb_text_write_line(const struct gb_text *text, const char *markup, double size,
                        double least, double most, const double at[2],
                        const double align[2], int quarters)
{
    double wide = 0.0;
    double high = 0.0;
    gb_text_measure(text, markup, size, 0.0, &wide, &high);
    if (wide > most) {
        set(text, markup, fmax(size * most / wide, fmin(least, size)), 0.0);
        extent(text, &wide, &high);
        if (wide > 1.001 * most) {
            pango_layout_set_width(text->layout, (int)(most * PANGO_SCALE));
            pango_layout_set_ellipsize(text->layout, PANGO_ELLIPSIZE_MIDDLE);
        }
    }
    show(text, at, align, quarters);
}
