#include "tui/panel/sphere_shading.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

#include "greenbody/snapshot.h"

/* The packing as shaded spheres.  The camera turns the packing, the walls of a die
 * become outlines, and spheres are drawn in layers from back to front with a brightness
 * that depends on depth, or the shade of a value. */

/* Camera and colouring of the view of the packing. */

/* Fraction of the particles that the colour range covers. */
static const double covered = 0.95;

void gb_sphere_shading_rotate(struct gb_packing_look *look, double azimuth_deg,
                              double elevation_deg)
{
    look->azimuth_deg = fmod(look->azimuth_deg + azimuth_deg + 360.0, 360.0);
    look->elevation_deg = fmin(fmax(look->elevation_deg + elevation_deg, -90.0), 90.0);
}

/* Values of the particles for a colour; NULL for the depth. */
static const float *packing_look_values(const struct gb_view_sample *sample,
                                        enum gb_packing_colour colour)
{
    switch (colour) {
    case GB_PACKING_COLOUR_CONTACTS:
        return sample->value[GB_VIEW_VALUE_CONTACTS];
    case GB_PACKING_COLOUR_PRESSURE:
        return sample->value[GB_VIEW_VALUE_PRESSURE];
    case GB_PACKING_COLOUR_DISPLACEMENT:
        return sample->value[GB_VIEW_VALUE_DISPLACEMENT];
    case GB_PACKING_COLOUR_DEPTH:
    case GB_PACKING_COLOURS:
        break;
    }
    return NULL;
}

static int compare(const void *a, const void *b)
{
    const float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

/* Camera of the view of a packing, and the walls of a die as lines. */
struct die_outline_camera {
    double centre[3];          /* centre of rotation */
    double azimuth, elevation; /* of the viewer, rad */
    int rows, cols;
    double scale;       /* dots per diameter */
    double left, top;   /* dot of the centre */
    double front, back; /* depths of the front and back of the box, d */
};

static void tilt(const struct die_outline_camera *camera, double right, double behind,
                 double up, double seen[3])
{
    const double sine = sin(camera->elevation), cosine = cos(camera->elevation);
    seen[0] = right;
    seen[1] = behind * cosine - up * sine;
    seen[2] = behind * sine + up * cosine;
}

/* The same at azimuth 0, for what is round about the axis. */
static void die_outline_round(const struct die_outline_camera *camera,
                              const double point[3], double seen[3])
{
    tilt(camera, point[0] - camera->centre[0], point[1] - camera->centre[1],
         point[2] - camera->centre[2], seen);
}

struct pen {
    const struct die_outline_camera *camera;
    float *shade;
};

/* Moves the pen to a point of the silhouette: side 1 right, -1 left. */
static void at(const struct pen *pen, double side, double radius, double height,
               double seen[3])
{
    const double point[3] = {pen->camera->centre[0] + side * radius,
                             pen->camera->centre[1], height};
    die_outline_round(pen->camera, point, seen);
}

struct gb_packing_range gb_sphere_shading_range(const struct gb_view_sample *sample,
                                                enum gb_packing_colour colour)
{
    const float *value = packing_look_values(sample, colour);
    float sorted[GB_VIEW_SAMPLE_POINTS];
    int count = 0;
    for (int i = 0; value != NULL && i < sample->count; i++) {
        if (isfinite(value[i])) {
            sorted[count++] = value[i];
        }
    }
    if (count == 0) {
        return (struct gb_packing_range){0.0, 1.0, false};
    }
    qsort(sorted, (size_t)count, sizeof *sorted, compare);
    const int at = (int)(covered * (count - 1));
    const double low = fmin((double)sorted[0], 0.0), high = (double)sorted[at];
    return (struct gb_packing_range){low, high > low ? high : low + 1.0,
                                     (double)sorted[count - 1] > high};
}

const char *gb_sphere_shading_name(enum gb_packing_colour colour)
{
    static const char *const names[GB_PACKING_COLOURS] = {
        [GB_PACKING_COLOUR_DEPTH] = "depth",
        [GB_PACKING_COLOUR_CONTACTS] = "coordination number",
        [GB_PACKING_COLOUR_PRESSURE] = "pressure, MPa",
        [GB_PACKING_COLOUR_DISPLACEMENT] = "displacement, d",
    };
    return names[colour];
}

enum { AROUND = 48 };

/* Converts a point to the axes of the viewer, from the centre: right, depth, up.
 * Returns the depth behind the plane through the axis that faces the viewer,
 * independent of the elevation. */
static double die_outline_see(const struct die_outline_camera *camera,
                              const double point[3], double seen[3])
{
    const double x = point[0] - camera->centre[0], y = point[1] - camera->centre[1];
    const double sine = sin(camera->azimuth), cosine = cos(camera->azimuth);
    const double behind = y * cosine - x * sine;
    tilt(camera, x * cosine + y * sine, behind, point[2] - camera->centre[2], seen);
    return behind;
}

/* Value of the dots of a line for its direction, for screens with one character per
 * cell. */
static float sign_of(double across, double down)
{
    if (fabs(across) < 0.4 * fabs(down)) {
        return GB_SPHERE_SHADING_UPRIGHT;
    }
    if (fabs(down) < 0.4 * fabs(across)) {
        return GB_SPHERE_SHADING_LEVEL;
    }
    return across * down < 0.0 ? GB_SPHERE_SHADING_RISING : GB_SPHERE_SHADING_FALLING;
}

static void line(const struct pen *pen, const double from[3], const double to[3])
{
    const struct die_outline_camera *camera = pen->camera;
    const double col = camera->left + from[0] * camera->scale;
    const double row = camera->top - from[2] * camera->scale;
    const double across = (to[0] - from[0]) * camera->scale;
    const double down = -(to[2] - from[2]) * camera->scale;
    const int steps = (int)fmin(2.0 * fmax(fabs(across), fabs(down)) + 1.0, 8192.0);
    const float sign = sign_of(across, down);
    for (int k = 0; k <= steps; k++) {
        const double r = floor(row + down * k / steps);
        const double c = floor(col + across * k / steps);
        if (r >= 0.0 && r < camera->rows && c >= 0.0 && c < camera->cols) {
            pen->shade[(int)r * camera->cols + (int)c] = sign;
        }
    }
}

static void silhouette(const struct pen *pen, double radius, double height,
                       double to_radius, double to_height)
{
    for (double side = -1.0; side <= 1.0; side += 2.0) {
        double from[3], to[3];
        at(pen, side, radius, height, from);
        at(pen, side, to_radius, to_height, to);
        line(pen, from, to);
    }
}

static void circle(const struct pen *pen, double radius, double height)
{
    for (int k = 0; k < AROUND; k++) {
        double seen[2][3];
        for (int end = 0; end < 2; end++) {
            const double a = 2.0 * M_PI * (k + end) / AROUND;
            const double point[3] = {pen->camera->centre[0] + radius * cos(a),
                                     pen->camera->centre[1] + radius * sin(a), height};
            die_outline_round(pen->camera, point, seen[end]);
        }
        line(pen, seen[0], seen[1]);
    }
}

/* Draws side, floor, funnel and punch over the dots (sphere_shading.h).  Planes are
 * circles; open ends have no line across. */
static void die_outline_draw(const struct die_outline_camera *camera,
                             const struct gb_view_sample *sample, float *shade)
{
    const struct gb_view_die *die = &sample->die;
    const struct pen pen = {camera, shade};
    const double end = sample->window[2];
    circle(&pen, die->radius, 0.0);
    if (!die->gone && die->top > 0.0) {
        silhouette(&pen, die->radius, 0.0, die->radius, die->top);
    }
    if (die->funnel) {
        silhouette(&pen, die->radius, die->top, die->outlet, die->top);
        silhouette(&pen, die->outlet, die->top,
                   die->outlet + fmax(end - die->top, 0.0) * die->funnel_slope,
                   fmax(end, die->top));
    }
    if (die->punch) {
        circle(&pen, die->radius, die->punch_height);
    }
}

/* Direction to the light, from above, left and front. ambient: light on the shadow
 * side; depth_floor: factor of the deepest layer. */
static const double light[3] = {-0.40, -0.76, 0.51};
static const double ambient = 0.12;
static const double depth_floor = 0.15;
static const double depth_scale = 2.5; /* d */
static const double margin = 0.5;      /* d, around the window */

/* Spheres in the shade of a value.  The dark rim begins at the fraction `rim` of the
 * radius, if the radius has at least rim_reach dots.  The shades of the rim and of the
 * least value differ from the background. */
static const double rim = 0.8, rim_reach = 2.5;
static const float least = 0.05F;

/* Number of layers in depth. */
enum { LAYERS = 256 };

/* Finds the extent of the visible part, in the axes of the viewer. */
static void find_room(const struct gb_view_sample *sample,
                      struct die_outline_camera *camera, double room[3][2])
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
        if (sample->die
                .shown) { /* round: the half behind the axis, whatever the azimuth */
            point[1] *= 0.5;
            die_outline_round(camera, point, seen);
        } else {
            die_outline_see(camera, point, seen);
        }
        for (int k = 0; k < 3; k++) {
            room[k][0] = fmin(room[k][0], seen[k]);
            room[k][1] = fmax(room[k][1], seen[k]);
        }
    }
}

static struct die_outline_camera make_camera(const struct gb_view_sample *sample,
                                             const struct gb_packing_look *look, int rows,
                                             int cols)
{
    const bool spatial = look != NULL && sample->dimension == 3;
    const double radian = M_PI / 180.0;
    struct die_outline_camera camera = {
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
    struct die_outline_camera camera;
    const float *value; /* NULL: by depth */
    struct gb_packing_range range;
    float *shade;
};

/* Shade of a value.  A particle without a value has the least shade. */
static float shade_of(const struct picture *picture, int i)
{
    const double share = ((double)picture->value[i] - picture->range.low) /
                         (picture->range.high - picture->range.low);
    return share > 0.0 ? least + (1.0F - least) * (float)fmin(share, 1.0) : least;
}

/* Draws a sphere.  Layers are drawn from back to front, so nearer spheres cover farther
 * ones without a depth buffer. */
static void draw_sphere(const struct picture *picture, int i, const double seen[3])
{
    const struct gb_view_sample *sample = picture->sample;
    const struct die_outline_camera *camera = &picture->camera;
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
                    picture->value == NULL                   ? brightness(x, z, depth)
                    : reach > rim_reach && from2 > rim * rim ? 0.0F
                                                             : shade_of(picture, i);
            }
        }
    }
}

/* Position of a particle as seen; false: in front of the cut of a die. */
static bool see(const struct picture *picture, int i, double seen[3])
{
    const struct gb_view_sample *sample = picture->sample;
    const double point[3] = {(double)sample->position[i][0],
                             (double)sample->position[i][1],
                             (double)sample->position[i][2]};
    return die_outline_see(&picture->camera, point, seen) >= 0.0 || !sample->whole;
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
        picture.value = packing_look_values(sample, look->colour);
        picture.range = gb_sphere_shading_range(sample, look->colour);
    }
    draw_spheres(&picture);
    if (sample->die.shown) {
        die_outline_draw(&picture.camera, sample, shade);
    }
}
