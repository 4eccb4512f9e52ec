#include "tui/plot/sphere_shading.h"

#include <math.h>

/* Direction to the light, from above, left and front; ambient is the light of the shadow
 * side, depth_floor the factor of the deepest layer. */
static const double light[3] = {-0.40, -0.76, 0.51};
static const double ambient = 0.12;
static const double depth_floor = 0.15;
static const double depth_scale = 2.5; /* d */
static const double margin = 0.5;      /* d, around the window */

struct frame {
    int rows, cols;
    double scale;     /* dots per diameter */
    double left, top; /* dots from the corner of the picture to the window */
};

static struct frame fit(const struct gb_view_sample *sample, int rows, int cols)
{
    const double wide = sample->window[0] + 2.0 * margin;
    const double high = sample->window[2] + 2.0 * margin;
    const double scale = fmin(cols / wide, rows / high);
    return (struct frame){rows, cols, scale, 0.5 * (cols - scale * wide),
                          0.5 * (rows - scale * high)};
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

/* Layers are drawn from the back to the front, so that nearer spheres cover farther ones
 * without a depth buffer. */
static void draw_sphere(const struct frame *frame, const struct gb_view_sample *sample,
                        int i, float *shade)
{
    const float *position = sample->position[i];
    const double reach = fmax(sample->radius[i] * frame->scale, 0.5);
    const double col = frame->left + (position[0] + margin) * frame->scale;
    const double row =
        frame->top + (sample->window[2] + margin - position[2]) * frame->scale;
    const double depth = sample->dimension == 3 ? position[1] : 0.0;
    const int last_row = (int)fmin(frame->rows - 1, floor(row + reach));
    const int last_col = (int)fmin(frame->cols - 1, floor(col + reach));
    for (int r = (int)fmax(0.0, floor(row - reach)); r <= last_row; r++) {
        for (int c = (int)fmax(0.0, floor(col - reach)); c <= last_col; c++) {
            const double x = (c + 0.5 - col) / reach;
            const double z = (row - r - 0.5) / reach;
            if (x * x + z * z <= 1.0) {
                shade[r * frame->cols + c] = brightness(x, z, depth);
            }
        }
    }
}

/* Number of layers in depth. */
enum { LAYERS = 256 };

static int layer_of(const struct gb_view_sample *sample, int i)
{
    if (sample->dimension != 3) {
        return 0;
    }
    const double depth_share = sample->position[i][1] / fmax(sample->window[1], 1e-9);
    return (int)(fmin(fmax(depth_share, 0.0), 0.999) * LAYERS);
}

void gb_sphere_shading_render(const struct gb_view_sample *sample, int rows, int cols,
                              float *shade)
{
    /* counting sort by layer: first[l] is the first sphere of a linked list */
    int first[LAYERS];
    int16_t next[GB_VIEW_SAMPLE_POINTS];
    for (int i = 0; i < rows * cols; i++) {
        shade[i] = -1.0F;
    }
    for (int l = 0; l < LAYERS; l++) {
        first[l] = -1;
    }
    for (int i = 0; i < sample->count; i++) {
        const int l = layer_of(sample, i);
        next[i] = (int16_t)first[l];
        first[l] = i;
    }
    const struct frame frame = fit(sample, rows, cols);
    for (int l = LAYERS - 1; l >= 0; l--) {
        for (int i = first[l]; i >= 0; i = next[i]) {
            draw_sphere(&frame, sample, i, shade);
        }
    }
}
