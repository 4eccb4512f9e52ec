#include "draw/packing_image.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/file.h"
#include "base/units.h"
#include "draw/caption/caption.h"
#include "draw/caption/force_legend.h"
#include "draw/caption/load_label.h"
#include "draw/gl/renderer.h"
#include "draw/image/png.h"
#include "draw/mute_stderr.h"
#include "draw/scene_bounds.h"

void gb_packing_image_init(struct gb_packing_image *packing_image)
{
    *packing_image =
        (struct gb_packing_image){.width = 1600, .height = 1200, .annotated = true};
    gb_view_parse("corner", &packing_image->viewpoint, NULL);
    gb_picture_style_init(&packing_image->style);
}

void gb_packing_image_arrange(const struct gb_packing_image *packing_image,
                              const struct gb_picture_style *style,
                              struct gb_scene *scene, struct gb_caption_layout *layout)
{
    const struct gb_view *view = &scene->view;
    struct gb_caption_page page = {
        .width = packing_image->width,
        .height = packing_image->height,
        .per_inch = packing_image->per_inch,
        .crop = packing_image->crop,
        .annotated = packing_image->annotated,
        .bar = style->scale.title != NULL,
        .load = gb_load_label_arrow(scene->frame_arrow[0], scene->frame_arrows) >= 0,
        .rods = gb_force_legend_lines(style),
        .aspect = (view->high[1] - view->low[1]) / (view->high[0] - view->low[0])};
    gb_caption_layout_arrange(&page, layout);
    if (layout->unit > 0.0 && scene->frame_arrows > 0) {
        gb_scene_bounds_include_arrows(scene);
        page.aspect = (view->high[1] - view->low[1]) / (view->high[0] - view->low[0]);
        gb_caption_layout_arrange(&page, layout);
    }
    gb_view_set_frame(&scene->view, &layout->scene);
}

/* What is drawn; its camera gets its scale from the page. */
static bool create_scene(struct gb_scene **scene, struct gb_picture_style **style,
                         const struct gb_packing_image *packing_image,
                         const struct gb_state *state, struct gb_error *err)
{
    const struct gb_frame page = {0.0, 0.0, packing_image->width, packing_image->height};
    return gb_picture_style_create(style, state, &packing_image->style, err) &&
           gb_scene_create(scene, state, *style, &packing_image->viewpoint, &page,
                           packing_image->background, err);
}

static bool render(struct gb_image *image, const struct gb_packing_image *packing_image,
                   const struct gb_caption_layout *layout, const struct gb_scene *scene,
                   const struct gb_picture_style *style, const struct gb_state *state,
                   struct gb_error *err)
{
    struct gb_renderer *renderer = packing_image->renderer;
    image->per_inch = packing_image->per_inch;
    const bool done = (renderer != NULL || gb_renderer_open(&renderer, err)) &&
                      gb_renderer_render(renderer, scene, image, err) &&
                      gb_caption_draw(image, layout, scene, style, state, err);
    if (renderer != packing_image->renderer) {
        gb_renderer_close(renderer);
    }
    return done;
}

bool gb_packing_image_render(struct gb_image **out,
                             const struct gb_packing_image *packing_image,
                             const struct gb_state *state, struct gb_error *err)
{
    struct gb_scene *scene = NULL;
    struct gb_picture_style *style = NULL;
    struct gb_caption_layout layout;
    *out = NULL;
    const int saved = gb_mute_stderr_begin();
    bool done = create_scene(&scene, &style, packing_image, state, err);
    if (done) {
        gb_packing_image_arrange(packing_image, style, scene, &layout);
        done = gb_image_create(out, layout.width, layout.height, err) &&
               render(*out, packing_image, &layout, scene, style, state, err);
    }
    gb_mute_stderr_end(saved);
    gb_picture_style_destroy(style);
    gb_scene_destroy(scene);
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

enum gb_png_alpha gb_packing_image_alpha(const struct gb_packing_image *packing_image)
{
    return packing_image->background == GB_BACKGROUND_TRANSPARENT ? GB_PNG_ALPHA
                                                                  : GB_PNG_OPAQUE;
}

bool gb_packing_image_save(const struct gb_image *image,
                           const struct gb_packing_image *packing_image,
                           const struct gb_state *state, const char *path,
                           struct gb_error *err)
{
    struct gb_packing_image_texts texts;
    gb_packing_image_describe(&texts, state, packing_image->preset);
    return gb_png_write(image, gb_packing_image_alpha(packing_image), texts.text,
                        texts.count, path, err);
}

bool gb_packing_image_write(const struct gb_packing_image *packing_image,
                            const struct gb_state *state, const char *path,
                            struct gb_error *err)
{
    struct gb_image *image = NULL;
    /* the target is checked before the work */
    const bool done = gb_file_check_target(path, err) &&
                      gb_packing_image_render(&image, packing_image, state, err) &&
                      gb_packing_image_save(image, packing_image, state, path, err);
    gb_image_destroy(image);
    return done;
}
