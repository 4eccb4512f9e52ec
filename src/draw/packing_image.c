/* Pictures of packings: arrange the page, make the scene, render it, write the texts around
 * it, save it as a PNG.  Several packings, each with its rose of forces, share one page. */
#include "draw/packing_image.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/file.h"
#include "base/units.h"
#include "draw/caption.h"
#include "draw/image.h"
#include "draw/renderer.h"
#include "draw/rose.h"
#include "draw/scene.h"
#include "draw/text.h"

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
        .load = gb_caption_load_arrow(scene->frame_arrow[0], scene->frame_arrows) >= 0,
        .rods = gb_caption_legend_lines(style),
        .aspect = (view->high[1] - view->low[1]) / (view->high[0] - view->low[0])};
    gb_caption_arrange(&page, layout);
    if (layout->unit > 0.0 && scene->frame_arrows > 0) {
        gb_scene_include_arrows(scene);
        page.aspect = (view->high[1] - view->low[1]) / (view->high[0] - view->low[0]);
        gb_caption_arrange(&page, layout);
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
    const int saved = gb_text_mute_begin();
    bool done = create_scene(&scene, &style, packing_image, state, err);
    if (done) {
        gb_packing_image_arrange(packing_image, style, scene, &layout);
        done = gb_image_create(out, layout.width, layout.height, err) &&
               render(*out, packing_image, &layout, scene, style, state, err);
    }
    gb_text_mute_end(saved);
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
    const struct gb_image_text all[] = {
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

enum gb_image_alpha gb_packing_image_alpha(const struct gb_packing_image *packing_image)
{
    return packing_image->background == GB_BACKGROUND_TRANSPARENT ? GB_IMAGE_ALPHA
                                                                  : GB_IMAGE_OPAQUE;
}

bool gb_packing_image_save(const struct gb_image *image,
                           const struct gb_packing_image *packing_image,
                           const struct gb_state *state, const char *path,
                           struct gb_error *err)
{
    struct gb_packing_image_texts texts;
    gb_packing_image_describe(&texts, state, packing_image->preset);
    return gb_image_write(image, gb_packing_image_alpha(packing_image), texts.text,
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

/* Rows of an image: a packing, and its rose or NULL. */
struct row {
    struct gb_image *packing, *rose;
};

static void copy(const struct gb_image *from, struct gb_image *to, int left, int top)
{
    for (int y = 0; y < from->height; y++) {
        const size_t width = (size_t)from->width;
        memcpy(&to->rgba[4 * ((size_t)(top + y) * (size_t)to->width + (size_t)left)],
               &from->rgba[4 * (size_t)y * width], 4 * width);
    }
}

static bool draw_rose(struct gb_image *image,
                      const struct gb_packing_image *packing_image,
                      const struct gb_rose *rose, double reach, double newton,
                      struct gb_error *err)
{
    const struct gb_frame whole = {0.0, 0.0, image->width, image->height};
    const struct gb_caption_page page = {.width = image->width,
                                         .height = image->height,
                                         .per_inch = packing_image->per_inch,
                                         .annotated = packing_image->annotated,
                                         .bar = true,
                                         .aspect = 1.0};
    struct gb_renderer *renderer = NULL;
    struct gb_scene *scene = NULL;
    struct gb_caption_layout layout;
    image->per_inch = packing_image->per_inch;
    gb_caption_arrange(&page, &layout);
    bool done = gb_rose_scene(&scene, rose, reach, &packing_image->viewpoint, &whole,
                              packing_image->background, err) &&
                gb_renderer_open(&renderer, err);
    if (done) {
        gb_view_set_frame(&scene->view, &layout.scene);
        done =
            gb_renderer_render(renderer, scene, image, err) &&
            gb_caption_draw_rose(image, &layout, scene, reach, rose->mean * newton, err);
    }
    gb_renderer_close(renderer);
    gb_scene_destroy(scene);
    return done;
}

/* A rose as high as its packing, over the rest of the width. */
static bool render_rose(struct row *row, const struct gb_packing_image *packing_image,
                        const struct gb_state *state, double reach, struct gb_error *err)
{
    struct gb_rose rose;
    const double newton =
        state->pascal_per_stress * state->metre_per_length * state->metre_per_length;
    if (!gb_rose_of_state(&rose, state, err) ||
        !gb_image_create(&row->rose, packing_image->width - row->packing->width,
                         row->packing->height, err)) {
        return false;
    }
    const int saved = gb_text_mute_begin();
    const bool done = draw_rose(row->rose, packing_image, &rose, reach, newton, err);
    gb_text_mute_end(saved);
    return done;
}

/* Maximum radius of all roses. */
static bool find_reach(struct gb_state *const *states, size_t count, double *reach,
                       struct gb_error *err)
{
    *reach = 1.0;
    for (size_t i = 0; i < count; i++) {
        struct gb_rose rose;
        if (!gb_rose_of_state(&rose, states[i], err)) {
            return false;
        }
        if (!(rose.mean > 0.0)) {
            return gb_error_set(err, GB_ERR_INPUT,
                                "rose: the mean normal force of a packing is tensile; "
                                "expected a packing under pressure");
        }
        *reach = fmax(*reach, gb_rose_reach(&rose));
    }
    return true;
}

static bool render_rows(struct row *rows, const struct gb_packing_image *packing_image,
                        enum gb_packing_image_panels content,
                        struct gb_state *const *states, size_t count,
                        struct gb_error *err)
{
    const bool roses = content == GB_PACKING_IMAGE_WITH_ROSE;
    struct gb_packing_image panel = *packing_image;
    double reach = 1.0;
    panel.width = roses ? packing_image->width / 2 : packing_image->width;
    if (panel.crop == GB_CAPTION_NO_CROP) {
        panel.height = packing_image->height / (int)count;
    } else {
        panel.crop = GB_CAPTION_CROP_HEIGHT; /* panels of one width */
    }
    bool done = !roses || find_reach(states, count, &reach, err);
    for (size_t i = 0; i < count && done; i++) {
        done = gb_packing_image_render(&rows[i].packing, &panel, states[i], err) &&
               (!roses || render_rose(&rows[i], packing_image, states[i], reach, err));
    }
    return done;
}

/* Rows one below the other. */
static bool join_rows(struct gb_image **page, const struct row *rows, size_t count,
                      struct gb_error *err)
{
    const struct row *first = &rows[0];
    const int left = first->packing->width;
    int height = 0;
    for (size_t i = 0; i < count; i++) {
        height += rows[i].packing->height;
    }
    if (!gb_image_create(page, left + (first->rose != NULL ? first->rose->width : 0),
                         height, err)) {
        return false;
    }
    (*page)->per_inch = first->packing->per_inch;
    for (size_t i = 0, top = 0; i < count; top += (size_t)rows[i++].packing->height) {
        copy(rows[i].packing, *page, 0, (int)top);
        if (rows[i].rose != NULL) {
            copy(rows[i].rose, *page, left, (int)top);
        }
    }
    return true;
}

bool gb_packing_image_write_panels(const struct gb_packing_image *packing_image,
                                   enum gb_packing_image_panels content,
                                   struct gb_state *const *states, size_t count,
                                   const char *path, struct gb_error *err)
{
    struct gb_image *page = NULL;
    struct row rows[GB_PACKING_IMAGE_ROWS] = {{NULL, NULL}};
    if (count == 1 && content == GB_PACKING_IMAGE_ALONE) {
        return gb_packing_image_write(packing_image, states[0], path, err);
    }
    const bool done = gb_file_check_target(path, err) &&
                      render_rows(rows, packing_image, content, states, count, err) &&
                      join_rows(&page, rows, count, err) &&
                      gb_packing_image_save(page, packing_image, states[0], path, err);
    for (size_t i = 0; i < count; i++) {
        gb_image_destroy(rows[i].packing);
        gb_image_destroy(rows[i].rose);
    }
    gb_image_destroy(page);
    return done;
}
