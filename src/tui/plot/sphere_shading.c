#include "tui/plot/sphere_shading.h"

#include <math.h>

#include "tui/plot/die_outline.h"

/* Direction to the light, from above, left and front; ambient is the light of the shadow
 * side, depth_floor the factor of the deepest layer. */
static const double light[3] = {-0.40, -0.76, 0.51};
static const double ambient = 0.12;
static const double depth_floor = 0.15;
static const double depth_scale = 2.5; /* d */
static const double margin = 0.5;      /* d, around the window */

/* Spheres in the shade of a value: rim from this share of the radius on, where the radius has
 * some dots; shade of the rim, and of the least value, so that both differ from the
 * background. */
static const double rim = 0.8, rim_reach = 2.5;
static const float least = 0.05F;

/* Number of layers in depth. */
enum { LAYERS = 256 };

/* The range of what is seen, in the axes of the viewer. */
static void find_room(const struct gb_view_sample *sample, struct gb_die_outline_camera *camera,
                      double room[3][2])
{
    const double *window = sample->window;
    for (int k = 0; k < 3; k++) {
        room[k][0] = HUGE_VAL;
        room[k][1] = -HUGE_VAL;
    }
    for (int corner = 0; corner < 8; corner++) {
        double point[3], seen[3];
        for (int k = 0; k < 3; k++) {
            point[k] = (corner >> k & 1) * window[k];
        }
        if (sample->die.shown) { /* round: the half behind the axis, whatever the azimuth */
            point[1] *= 0.5;
            gb_die_outline_round(camera, point, seen);
        } else {
            gb_die_outline_see(camera, point, seen);
        }
        for (int k = 0; k < 3; k++) {
            room[k][0] = fmin(room[k][0], seen[k]);
            room[k][1] = fmax(room[k][1], seen[k]);
        }
    }
}

static struct gb_die_outline_camera make_camera(const struct gb_view_sample *sample,
                                                const struct gb_packing_look *look,
                                                int rows, int cols)
{
    const bool spatial = look != NULL && sample->dimension == 3;
    const double radian = M_PI / 180.0;
    struct gb_die_outline_camera camera = {
        .centre = {0.5 * sample->window[0],
                   sample->die.shown ? 0.0 : 0.5 * sample->window[1],
                   0.5 * sample->window[2]},
        .azimuth = spatial ? radian * look->azimuth_deg : 0.0,
        .elevation = spatial ? radian * look->elevation_deg : 0.0,
        .rows = rows,
        .cols = cols,
    };
    double room[3][2];
    find_room(sample, &camera, room);
    const double wide = room[0][1] - room[0][0] + 2.0 * margin;
    const double high = room[2][1] - room[2][0] + 2.0 * margin;
    camera.scale = fmin(cols / wide, rows / high);
    camera.left = 0.5 * cols - 0.5 * camera.scale * (room[0][0] + room[0][1]);
    camera.top = 0.5 * rows + 0.5 * camera.scale * (room[2][0] + room[2][1]);
    camera.front = room[1][0];
    camera.back = room[1][1];
    return camera;
}

/* Brightness of a sphere at (x, z) from its centre, in radii; depth behind the front in
 * d. */
static float brightness(double x, double z, double depth)
{
    const double y = -sqrt(fmax(0.0, 1.0 - x * x - z * z));
    const double lambert = fmax(0.0, x * light[0] + y * light[1] + z * light[2]);
    const double far = depth_floor + (1.0 - depth_floor) * exp(-depth / depth_scale);
    return (float)(far * (ambient + (1.0 - ambient) * lambert));
}

struct picture {
    const struct gb_view_sample *sample;
    struct gb_die_outline_camera camera;
    const float *value; /* NULL: by depth */
    struct gb_packing_range range;
    float *shade;
};

/* Of a value; a particle without one has the least. */
static float shade_of(const struct picture *picture, int i)
{
    const double share = ((double)picture->value[i] - picture->range.low) /
                         (picture->range.high - picture->range.low);
    return share > 0.0 ? least + (1.0F - least) * (float)fmin(share, 1.0) : least;
}

/* Layers are drawn from the back to the front, so that nearer spheres cover farther ones
 * without a depth buffer. */
static void draw_sphere(const struct picture *picture, int i, const double seen[3])
{
    const struct gb_view_sample *sample = picture->sample;
    const struct gb_die_outline_camera *camera = &picture->camera;
    const double reach = fmax(sample->radius[i] * camera->scale, 0.5);
    const double col = camera->left + seen[0] * camera->scale;
    const double row = camera->top - seen[2] * camera->scale;
    const double depth = sample->dimension == 3 ? seen[1] - camera->front : 0.0;
    const int last_row = (int)fmin(camera->rows - 1, floor(row + reach));
    const int last_col = (int)fmin(camera->cols - 1, floor(col + reach));
    for (int r = (int)fmax(0.0, floor(row - reach)); r <= last_row; r++) {
        for (int c = (int)fmax(0.0, floor(col - reach)); c <= last_col; c++) {
            const double x = (c + 0.5 - col) / reach;
            const double z = (row - r - 0.5) / reach;
            const double from2 = x * x + z * z;
            if (from2 <= 1.0) {
                picture->shade[r * camera->cols + c] =
                    picture->value == NULL ? brightness(x, z, depth)
                    : reach > rim_reach && from2 > rim * rim
                        ? 0.0F
                        : shade_of(picture, i);
            }
        }
    }
}

/* False: in front of the cut of a die. */
static bool see(const struct picture *picture, int i, double seen[3])
{
    const struct gb_view_sample *sample = picture->sample;
    const double point[3] = {(double)sample->position[i][0], (double)sample->position[i][1],
                             (double)sample->position[i][2]};
    return gb_die_outline_see(&picture->camera, point, seen) >= 0.0 || !sample->whole;
}

static int layer_of(const struct picture *picture, const double seen[3])
{
    const double span = picture->camera.back - picture->camera.front;
    if (picture->sample->dimension != 3) {
        return 0;
    }
    const double share = (seen[1] - picture->camera.front) / fmax(span, 1e-9);
    return (int)(fmin(fmax(share, 0.0), 0.999) * LAYERS);
}

static void draw_spheres(const struct picture *picture)
{
    /* counting sort by layer: first[l] is the first sphere of a linked list */
    int first[LAYERS];
    int16_t next[GB_VIEW_SAMPLE_POINTS];
    double seen[3];
    for (int l = 0; l < LAYERS; l++) {
        first[l] = -1;
    }
    for (int i = 0; i < picture->sample->count; i++) {
        if (see(picture, i, seen)) {
            const int l = layer_of(picture, seen);
            next[i] = (int16_t)first[l];
            first[l] = i;
        }
    }
    for (int l = LAYERS - 1; l >= 0; l--) {
        for (int i = first[l]; i >= 0; i = next[i]) {
            (void)see(picture, i, seen);
            draw_sphere(picture, i, seen);
        }
    }
}

void gb_sphere_shading_render(const struct gb_view_sample *sample,
                              const struct gb_packing_look *look, int rows, int cols,
                              float *shade)
{
    struct picture picture = {.sample = sample,
                              .camera = make_camera(sample, look, rows, cols),
                              .shade = shade};
    for (int i = 0; i < rows * cols; i++) {
        shade[i] = -1.0F;
    }
    if (look != NULL && look->colour != GB_PACKING_COLOUR_DEPTH) {
        picture.value = gb_packing_look_values(sample, look->colour);
        picture.range = gb_packing_look_range(sample, look->colour);
    }
    draw_spheres(&picture);
    if (sample->die.shown) {
        gb_die_outline_draw(&picture.camera, sample, shade);
    }
}
