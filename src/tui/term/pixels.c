#include "tui/term/pixels.h"

#include <glib.h>
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/built_with.h"
#include "tui/plot/sphere_shading.h"
#include "tui/term/settings.h"

const char *gb_pixels_wipe(int images)
{
    return images == GB_IMAGES_KITTY ? "\033_Ga=d\033\\" : "";
}

#if GB_WITH_CHAFA

#include <chafa.h>

/* The shades of term_style.c, as red, green, blue. */
static const uint8_t ramp[][3] = {{0, 0, 95},      {0, 95, 95},    {0, 95, 135},
                                  {0, 135, 175},   {0, 175, 215},  {95, 175, 215},
                                  {135, 215, 255}, {215, 255, 255}};
static const uint8_t background[3] = {12, 12, 16}, outline[3] = {150, 150, 150};

enum { RAMP = sizeof ramp / sizeof ramp[0], LEVELS = 28, PIXELS_MAX = 1600 * 1200 };

bool gb_pixels_available(void)
{
    return true;
}

static ChafaTermInfo *describe_terminal(void)
{
    char **env = g_get_environ();
    ChafaTermDb *db = chafa_term_db_get_default();
    ChafaTermInfo *info = chafa_term_db_detect(db, env);
    g_strfreev(env);
    return info;
}

int gb_pixels_detect(void)
{
    ChafaTermInfo *info = describe_terminal();
    const bool kitty =
        chafa_term_info_have_seq(info, CHAFA_TERM_SEQ_BEGIN_KITTY_IMMEDIATE_IMAGE_V1);
    const bool sixel = chafa_term_info_have_seq(info, CHAFA_TERM_SEQ_BEGIN_SIXELS);
    chafa_term_info_unref(info);
    return kitty ? GB_IMAGES_KITTY : sixel ? GB_IMAGES_SIXEL : GB_IMAGES_NONE;
}

static void put_pixel(uint8_t *pixel, float shade)
{
    if (shade < 0.0F) {
        memcpy(pixel, background, sizeof background);
        return;
    }
    if (shade > 1.0F) {
        memcpy(pixel, outline, sizeof outline);
        return;
    }
    /* in levels: runs of one colour compress well */
    const float level = floorf(CLAMP(shade, 0.0F, 1.0F) * (float)LEVELS) / (float)LEVELS;
    const float at = level * (float)(RAMP - 1);
    const int low = MIN((int)at, RAMP - 2);
    const float part = at - (float)low;
    for (int k = 0; k < 3; k++) {
        pixel[k] = (uint8_t)((1.0F - part) * (float)ramp[low][k] +
                             part * (float)ramp[low + 1][k] + 0.5F);
    }
}

static char *print(int images, const uint8_t *rgb, int high, int wide, int rows, int cols,
                   struct gb_pixels_cell cell)
{
#if GB_CHAFA_POOL
    /* one thread: the cores belong to the engine */
    chafa_set_n_threads(1);
#endif
    ChafaTermInfo *info = describe_terminal();
    ChafaTermInfo *all = chafa_term_db_get_fallback_info(chafa_term_db_get_default());
    ChafaCanvasConfig *config = chafa_canvas_config_new();
    chafa_term_info_supplement(info, all);
    chafa_canvas_config_set_geometry(config, cols, rows);
    chafa_canvas_config_set_cell_geometry(config, cell.width, cell.height);
    chafa_canvas_config_set_canvas_mode(config, CHAFA_CANVAS_MODE_TRUECOLOR);
    chafa_canvas_config_set_dither_mode(config, CHAFA_DITHER_MODE_NONE);
    chafa_canvas_config_set_pixel_mode(config, images == GB_IMAGES_KITTY
                                                   ? CHAFA_PIXEL_MODE_KITTY
                                                   : CHAFA_PIXEL_MODE_SIXELS);
    ChafaCanvas *canvas = chafa_canvas_new(config);
    chafa_canvas_draw_all_pixels(canvas, CHAFA_PIXEL_RGB8, rgb, wide, high, wide * 3);
    GString *text = chafa_canvas_print(canvas, info);
    chafa_canvas_unref(canvas);
    chafa_canvas_config_unref(config);
    chafa_term_info_unref(all);
    chafa_term_info_unref(info);
    return g_string_free(text, FALSE);
}

char *gb_pixels_encode(int images, const struct gb_view_sample *sample,
                       const struct gb_packing_look *look, int rows, int cols,
                       struct gb_pixels_cell cell)
{
    const int wide = cols * cell.width, high = rows * cell.height;
    const size_t count = (size_t)wide * (size_t)high;
    if (count == 0 || count > PIXELS_MAX) {
        return NULL;
    }
    float *shade = gb_alloc_array(count, sizeof *shade, NULL);
    uint8_t *rgb = gb_alloc_array(count, 3, NULL);
    char *text = NULL;
    if (shade != NULL && rgb != NULL) {
        gb_sphere_shading_render(sample, look, high, wide, shade);
        for (size_t i = 0; i < count; i++) {
            put_pixel(rgb + 3 * i, shade[i]);
        }
        text = print(images, rgb, high, wide, rows, cols, cell);
    }
    gb_alloc_free(shade);
    gb_alloc_free(rgb);
    return text;
}

char *gb_pixels_encode_picture(int images, const struct gb_png_pixels *picture, int rows,
                               int cols, struct gb_pixels_cell cell)
{
    return print(images, picture->rgb, picture->high, picture->wide, rows, cols, cell);
}

#else

bool gb_pixels_available(void)
{
    return false;
}

int gb_pixels_detect(void)
{
    return GB_IMAGES_NONE;
}

char *gb_pixels_encode(int images, const struct gb_view_sample *sample,
                       const struct gb_packing_look *look, int rows, int cols,
                       struct gb_pixels_cell cell)
{
    (void)images;
    (void)sample;
    (void)look;
    (void)rows;
    (void)cols;
    (void)cell;
    return NULL;
}

char *gb_pixels_encode_picture(int images, const struct gb_png_pixels *picture, int rows,
                               int cols, struct gb_pixels_cell cell)
{
    (void)images;
    (void)picture;
    (void)rows;
    (void)cols;
    (void)cell;
    return NULL;
}

#endif
