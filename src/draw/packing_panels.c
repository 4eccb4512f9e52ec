#include "draw/packing_panels.h"

#include <math.h>
#include <string.h>

#include "base/file.h"
#include "draw/caption/caption.h"
#include "draw/gl/renderer.h"
#include "draw/mute_stderr.h"
#include "draw/rose.h"

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
                      const struct gb_harmonics *rose, double reach, double newton,
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
    gb_caption_layout_arrange(&page, &layout);
    bool done = gb_rose_scene(&scene, rose, reach, &packing_image->viewpoint, &whole,
                              packing_image->background, err) &&
                gb_renderer_open(&renderer, err);
    if (done) {
        gb_view_set_frame(&scene->view, &layout.scene);
        done = gb_renderer_render(renderer, scene, image, err) &&
               gb_caption_draw_rose(image, &layout, scene, reach, rose->mean * newton,
                                    err);
    }
    gb_renderer_close(renderer);
    gb_scene_destroy(scene);
    return done;
}

/* A rose as high as its packing, over the rest of the width. */
static bool render_rose(struct row *row, const struct gb_packing_image *packing_image,
                        const struct gb_state *state, double reach, struct gb_error *err)
{
    struct gb_harmonics rose;
    const double newton =
        state->pascal_per_stress * state->metre_per_length * state->metre_per_length;
    if (!gb_rose_of_state(&rose, state, err) ||
        !gb_image_create(&row->rose, packing_image->width - row->packing->width,
                         row->packing->height, err)) {
        return false;
    }
    const int saved = gb_mute_stderr_begin();
    const bool done = draw_rose(row->rose, packing_image, &rose, reach, newton, err);
    gb_mute_stderr_end(saved);
    return done;
}

/* Maximum radius of all roses. */
static bool find_reach(struct gb_state *const *states, size_t count, double *reach,
                       struct gb_error *err)
{
    *reach = 1.0;
    for (size_t i = 0; i < count; i++) {
        struct gb_harmonics rose;
        if (!gb_rose_of_state(&rose, states[i], err)) {
            return false;
        }
        if (!(rose.mean > 0.0)) {
            return gb_error_set(err, GB_ERR_INPUT,
                                "rose: the mean normal force of a packing is tensile; "
                                "accepted a packing under pressure");
        }
        *reach = fmax(*reach, gb_rose_reach(&rose));
    }
    return true;
}

static bool render_rows(struct row *rows, const struct gb_packing_image *packing_image,
                        enum gb_packing_panels_content content,
                        struct gb_state *const *states, size_t count,
                        struct gb_error *err)
{
    const bool roses = content == GB_PACKING_PANELS_WITH_ROSE;
    struct gb_packing_image panel = *packing_image;
    double reach = 1.0;
    panel.width = roses ? packing_image->width / 2 : packing_image->width;
    if (panel.crop == GB_CAPTION_LAYOUT_NO_CROP) {
        panel.height = packing_image->height / (int)count;
    } else {
        panel.crop = GB_CAPTION_LAYOUT_CROP_HEIGHT; /* panels of one width */
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

bool gb_packing_panels_write(const struct gb_packing_image *packing_image,
                             enum gb_packing_panels_content content,
                             struct gb_state *const *states, size_t count,
                             const char *path, struct gb_error *err)
{
    struct gb_image *page = NULL;
    struct row rows[GB_PACKING_PANELS_ROWS] = {{NULL, NULL}};
    if (count == 1 && content == GB_PACKING_PANELS_PACKING) {
        return gb_packing_image_write(packing_image, states[0], path, err);
    }
    const bool done =
        gb_file_check_target(path, err) &&
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
