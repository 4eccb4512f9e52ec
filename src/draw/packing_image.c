#include "draw/packing_image.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/file.h"
#include "base/units.h"
#include "draw/caption.h"
#include "draw/image/png.h"
#include "draw/mute_stderr.h"
#include "draw/osmesa.h"

void gb_packing_image_init(struct gb_packing_image *picture)
{
    *picture = (struct gb_packing_image){.width = 1600, .height = 1200, .words = true};
    gb_view_parse("corner", &picture->look, NULL);
    gb_picture_style_init(&picture->dress);
}

static bool paint(struct gb_image *image, const struct gb_packing_image *picture,
                  const struct gb_state *state, struct gb_error *err)
{
    struct gb_osmesa *painter = picture->painter;
    struct gb_scene *scene = NULL;
    struct gb_picture_style *dress = NULL;
    struct gb_caption_layout layout;
    gb_caption_place(image->width, image->height, picture->words, &layout);
    const bool done = gb_picture_style_create(&dress, state, &picture->dress, err) &&
                      gb_scene_create(&scene, state, dress, &picture->look, &layout.scene,
                                      picture->ground, err) &&
                      (painter != NULL || gb_osmesa_open(&painter, err)) &&
                      gb_osmesa_paint(painter, scene, image, err) &&
                      gb_caption_draw(image, &layout, scene, dress, state, err);
    if (painter != picture->painter) {
        gb_osmesa_close(painter);
    }
    gb_picture_style_destroy(dress);
    gb_scene_destroy(scene);
    return done;
}

bool gb_packing_image_paint(struct gb_image **out, const struct gb_packing_image *picture,
                            const struct gb_state *state, struct gb_error *err)
{
    if (!gb_image_create(out, picture->width, picture->height, err)) {
        return false;
    }
    const int kept = gb_mute_stderr_begin();
    const bool done = paint(*out, picture, state, err);
    gb_mute_stderr_end(kept);
    if (!done) {
        gb_image_destroy(*out);
        *out = NULL;
    }
    return done;
}

void gb_packing_image_describe(struct gb_packing_image_texts *texts,
                               const struct gb_state *state, const char *preset)
{
    char branch[48];
    snprintf(texts->seed, sizeof texts->seed, "%" PRIu64, state->seed);
    snprintf(texts->density, sizeof texts->density, "%.6g", state->point.density);
    snprintf(texts->pressure, sizeof texts->pressure, "unknown");
    if (isfinite(state->point.p_pa)) {
        gb_units_format_short(state->point.p_pa, GB_DIM_PRESSURE, 6, texts->pressure,
                              sizeof texts->pressure);
    }
    gb_curve_branch_name(&state->point, branch, sizeof branch);
    snprintf(texts->point, sizeof texts->point, "%s, step %" PRId64, branch,
             state->point.step);
    const struct gb_png_text all[] = {
        {"Software", "greenbody " GB_VERSION},
        {"Title", state->preset},
        {"Seed", texts->seed},
        {"Point", texts->point},
        {"Density", texts->density},
        {"Pressure", texts->pressure},
        {"Preset", preset},
    };
    memcpy(texts->text, all, sizeof all);
    texts->count = (int)(sizeof all / sizeof all[0]) - (preset == NULL);
}

bool gb_packing_image_save(const struct gb_image *image,
                           const struct gb_packing_image *picture,
                           const struct gb_state *state, const char *path,
                           struct gb_error *err)
{
    struct gb_packing_image_texts texts;
    gb_packing_image_describe(&texts, state, picture->preset);
    return gb_png_write(image, picture->ground != GB_GROUND_TRANSPARENT, texts.text,
                        texts.count, path, err);
}

bool gb_packing_image_write(const struct gb_packing_image *picture,
                            const struct gb_state *state, const char *path,
                            struct gb_error *err)
{
    struct gb_image *image = NULL;
    /* before the work, not after it */
    const bool done = gb_file_check_target(path, err) &&
                      gb_packing_image_paint(&image, picture, state, err) &&
                      gb_packing_image_save(image, picture, state, path, err);
    gb_image_destroy(image);
    return done;
}
