#include "draw/scene.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "draw/palette.h"

/* Share of the ground mixed into the farthest particles: enough to tell near from far,
 * too little to be read as another coordination number. */
static const float depth_cue = 0.14F;
/* Light that a shadow takes; the sky keeps it readable. */
static const float shadow_share = 0.75F;

static double largest_radius(const struct gb_state *state)
{
    double largest = 0.0;
    for (int64_t i = 0; i < state->count; i++) {
        largest = fmax(largest, state->radius[i]);
    }
    return largest;
}

static void set_spheres(struct gb_scene *scene, const struct gb_state *state)
{
    for (size_t i = 0; i < scene->count; i++) {
        double eye[3];
        uint8_t *colour = &scene->colour[4 * i];
        gb_view_eye(&scene->view, &state->position[3 * i], eye);
        for (int k = 0; k < 3; k++) {
            scene->sphere[4 * i + (size_t)k] = (float)eye[k];
        }
        scene->sphere[4 * i + 3] = (float)state->radius[i];
        gb_palette_contacts(state->contacts[i], colour);
        colour[3] = 255;
    }
}

/* The edges of the box: corner pairs that differ in one axis; in 2D the four of y = 0. */
static void set_edges(struct gb_scene *scene, const struct gb_state *state)
{
    for (int corner = 0; corner < 8; corner++) {
        for (int axis = 0; axis < 3; axis++) {
            const int other = corner | 1 << axis;
            const bool planar = state->dimension == 2 && (other & 2) != 0;
            if (other == corner || planar) {
                continue;
            }
            float *edge = scene->edge[scene->edge_count++];
            for (int end = 0; end < 2; end++) {
                const int at = end == 0 ? corner : other;
                double point[3];
                double eye[3];
                for (int k = 0; k < 3; k++) {
                    point[k] = (at >> k & 1) != 0 ? state->cell[k] : 0.0;
                }
                gb_view_eye(&scene->view, point, eye);
                for (int k = 0; k < 3; k++) {
                    edge[3 * end + k] = (float)eye[k];
                }
            }
        }
    }
}

static void set_camera(struct gb_scene *scene, const struct gb_state *state,
                       const struct gb_look *look, const struct gb_frame *frame)
{
    const bool planar = state->dimension == 2;
    const struct gb_look along_y = {-90.0, 0.0, true};
    double cell[3];
    memcpy(cell, state->cell, sizeof cell);
    if (planar) {
        cell[1] = 0.0; /* discs lie in the plane y = 0 */
    }
    gb_view_init(&scene->view, planar ? &along_y : look, cell, largest_radius(state),
                 frame);
}

bool gb_scene_create(struct gb_scene **out, const struct gb_state *state,
                     const struct gb_look *look, const struct gb_frame *frame,
                     enum gb_ground ground, struct gb_error *err)
{
    *out = NULL;
    struct gb_scene *scene = gb_alloc_array(1, sizeof *scene, err);
    if (scene == NULL) {
        return false;
    }
    scene->count = (size_t)state->count;
    scene->sphere = gb_alloc_array(scene->count, 4 * sizeof *scene->sphere, err);
    scene->colour = gb_alloc_array(scene->count, 4, err);
    if (scene->sphere == NULL || scene->colour == NULL) {
        gb_scene_destroy(scene);
        return false;
    }
    set_camera(scene, state, look, frame);
    set_spheres(scene, state);
    set_edges(scene, state);
    /* over the viewer's left shoulder */
    scene->light[0] = -0.45F;
    scene->light[1] = 0.70F;
    scene->light[2] = -0.55F;
    scene->diameter = 1.0F;
    scene->ground = ground;
    const bool solid = state->dimension == 3;
    scene->depth_cue = solid && ground != GB_GROUND_TRANSPARENT ? depth_cue : 0.0F;
    scene->shadow_share = solid ? shadow_share : 0.0F;
    *out = scene;
    return true;
}

void gb_scene_destroy(struct gb_scene *scene)
{
    if (scene == NULL) {
        return;
    }
    gb_alloc_free(scene->sphere);
    gb_alloc_free(scene->colour);
    gb_alloc_free(scene);
}

void gb_scene_ground(enum gb_ground ground, uint8_t rgb[3])
{
    static const uint8_t white[3] = {255, 255, 255};
    static const uint8_t dark[3] = {24, 27, 31};
    memcpy(rgb, ground == GB_GROUND_DARK ? dark : white, 3);
}

void gb_scene_ink(enum gb_ground ground, uint8_t rgb[3])
{
    static const uint8_t light[3] = {225, 228, 232};
    static const uint8_t black[3] = {38, 42, 48};
    memcpy(rgb, ground == GB_GROUND_DARK ? light : black, 3);
}
