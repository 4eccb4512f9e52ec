#include "draw/packing_panels.h"

#include <math.h>
#include <string.h>

#include "base/file.h"
#include "draw/caption.h"
#include "draw/gl/renderer.h"
#include "draw/mute_stderr.h"
#include "draw/rose.h"

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
    struct gb_renderer *renderer = NULL;
    struct gb_scene *scene = NULL;
    struct gb_caption_layout layout;
    image->per_inch = packing_image->per_inch;
    gb_caption_arrange(image->width, image->height, image->per_inch,
                       packing_image->annotated, &layout);
    const bool done =
        gb_rose_scene(&scene, rose, reach, &packing_image->viewpoint, &layout.scene,
                      packing_image->background, err) &&
        gb_renderer_open(&renderer, err) &&
        gb_renderer_render(renderer, scene, image, err) &&
        gb_caption_draw_rose(image, &layout, scene, reach, rose->mean * newton, err);
    gb_renderer_close(renderer);
    gb_scene_destroy(scene);
    return done;
}

static bool add_packing(struct gb_image *page,
                        const struct gb_packing_image *packing_image,
                        const struct gb_state *state, int top, struct gb_error *err)
{
    struct gb_image *panel = NULL;
    const bool done = gb_packing_image_render(&panel, packing_image, state, err);
    if (done) {
        copy(panel, page, 0, top);
    }
    gb_image_destroy(panel);
    return done;
}

static bool add_rose(struct gb_image *page, const struct gb_packing_image *packing_image,
                     const struct gb_state *state, double reach, int top,
                     struct gb_error *err)
{
    struct gb_harmonics rose;
    struct gb_image *panel = NULL;
    const int width = page->width - packing_image->width;
    const double newton =
        state->pascal_per_stress * state->metre_per_length * state->metre_per_length;
    if (!gb_rose_of_state(&rose, state, err) ||
        !gb_image_create(&panel, width, packing_image->height, err)) {
        return false;
    }
    const int saved = gb_mute_stderr_begin();
    const bool done = draw_rose(panel, packing_image, &rose, reach, newton, err);
    gb_mute_stderr_end(saved);
    if (done) {
        copy(panel, page, packing_image->width, top);
    }
    gb_image_destroy(panel);
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

static bool fill_page(struct gb_image *page, const struct gb_packing_image *packing_image,
                      enum gb_packing_panels_content content,
                      struct gb_state *const *states, size_t count, struct gb_error *err)
{
    const bool roses = content == GB_PACKING_PANELS_WITH_ROSE;
    struct gb_packing_image panel = *packing_image;
    double reach = 1.0;
    panel.height = page->height / (int)count;
    panel.width = roses ? page->width / 2 : page->width;
    bool done = !roses || find_reach(states, count, &reach, err);
    for (size_t i = 0; i < count && done; i++) {
        const int top = (int)i * panel.height;
        done = add_packing(page, &panel, states[i], top, err) &&
               (!roses || add_rose(page, &panel, states[i], reach, top, err));
    }
    return done;
}

bool gb_packing_panels_write(const struct gb_packing_image *packing_image,
                             enum gb_packing_panels_content content,
                             struct gb_state *const *states, size_t count,
                             const char *path, struct gb_error *err)
{
    struct gb_image *page = NULL;
    if (count == 1 && content == GB_PACKING_PANELS_PACKING) {
        return gb_packing_image_write(packing_image, states[0], path, err);
    }
    const bool done =
        gb_file_check_target(path, err) &&
        gb_image_create(&page, packing_image->width, packing_image->height, err) &&
        (page->per_inch = packing_image->per_inch, true) &&
        fill_page(page, packing_image, content, states, count, err) &&
        gb_packing_image_save(page, packing_image, states[0], path, err);
    gb_image_destroy(page);
    return done;
}
