#include "small_packing.h"

#include <glib.h>
#include <math.h>
#include <string.h>

struct gb_state *small_packing_make(int dimension)
{
    static const double centre[3][3] = {
        {5.0, 2.0, 5.0}, {5.0, 8.0, 5.0}, {2.0, 5.0, 8.0}};
    static const int contacts[3] = {2, 12, 7};
    struct gb_state *state = NULL;
    struct gb_error err = {0};
    g_assert_true(gb_state_create(&state, 3, 0, &err));
    state->dimension = dimension;
    for (int k = 0; k < 3; k++) {
        state->cell[k] = dimension == 2 && k == 1 ? 1.0 : 10.0;
        memcpy(&state->position[3 * k], centre[k], sizeof centre[k]);
        state->radius[k] = k == 1 ? 0.9 : 1.0;
        state->contacts[k] = contacts[k];
        if (dimension == 2) {
            state->position[3 * k] = 2.0 + 3.0 * k;
            state->position[3 * k + 1] = 0.0;
        }
    }
    state->point.density = 0.5123;
    state->point.p_pa = 1e8;
    state->metre_per_length = 1e-8;
    state->seed = 42;
    g_strlcpy(state->preset, "Al₂O₃ test", sizeof state->preset);
    return state;
}

struct gb_packing_image small_packing_front(void)
{
    struct gb_packing_image packing_image;
    gb_packing_image_init(&packing_image);
    packing_image.width = packing_image.height = SMALL_PACKING_SIDE;
    packing_image.annotated = false;
    g_assert_true(gb_view_parse("front", &packing_image.viewpoint, NULL));
    return packing_image;
}

struct gb_image *small_packing_paint(const struct gb_packing_image *packing_image,
                                     const struct gb_state *state)
{
    struct gb_image *image = NULL;
    struct gb_error err = {0};
    const bool done = gb_packing_image_render(&image, packing_image, state, &err);
    g_assert_cmpstr(err.text, ==, "");
    g_assert_true(done);
    return image;
}

const uint8_t *small_packing_pixel(const struct gb_image *image, double x, double y)
{
    return &image->rgba[4 *
                        ((size_t)lround(y) * (size_t)image->width + (size_t)lround(x))];
}

struct gb_scene *small_packing_scene(const struct gb_packing_image *packing_image,
                                     const struct gb_state *state,
                                     struct gb_caption_layout *layout)
{
    const struct gb_frame page = {0.0, 0.0, SMALL_PACKING_SIDE, SMALL_PACKING_SIDE};
    struct gb_picture_style *style = NULL;
    struct gb_scene *scene = NULL;
    struct gb_error err = {0};
    g_assert_true(gb_picture_style_create(&style, state, &packing_image->style, &err));
    g_assert_true(gb_scene_create(&scene, state, style, &packing_image->viewpoint, &page,
                                  packing_image->background, &err));
    gb_packing_image_arrange(packing_image, style, scene, layout);
    gb_picture_style_destroy(style);
    return scene;
}

const uint8_t *small_packing_particle(const struct gb_image *image,
                                      const struct gb_packing_image *packing_image,
                                      const struct gb_state *state, int index)
{
    struct gb_caption_layout layout;
    struct gb_scene *scene = small_packing_scene(packing_image, state, &layout);
    double pixel[2];
    const float *ball = &scene->sphere[4 * index];
    gb_view_pixel(&scene->view, (const double[3]){ball[0], ball[1], ball[2]}, pixel);
    gb_scene_destroy(scene);
    return small_packing_pixel(image, pixel[0], pixel[1]);
}
