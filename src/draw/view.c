#include "draw/view.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/units.h"

/* Distance of the viewer in half diagonals of the box: a long focal length, so that near
 * and far particles have comparable sizes. */
static const double viewer_distance = 6.5;

static const struct {
    const char *name;
    double azimuth, elevation;
} named[] = {
    {"corner", -58.0, 20.0},
    {"front", -90.0, 0.0},
    {"side", 0.0, 0.0},
    {"top", -90.0, 90.0},
};

static bool parse_angles(const char *text, struct gb_viewpoint *viewpoint)
{
    const char *end = NULL;
    double azimuth = 0.0;
    double elevation = 0.0;
    if (!gb_units_number(text, &end, &azimuth) || *end != ',' ||
        !gb_units_number(end + 1, &end, &elevation) || *end != '\0' ||
        !(fabs(azimuth) <= 360.0) || !(fabs(elevation) <= 90.0)) {
        return false;
    }
    viewpoint->azimuth_deg = azimuth;
    viewpoint->elevation_deg = elevation;
    return true;
}

bool gb_view_parse(const char *text, struct gb_viewpoint *viewpoint, struct gb_error *err)
{
    struct gb_viewpoint result = *viewpoint;
    char direction[64];
    const int length = snprintf(direction, sizeof direction, "%s", text);
    char *flat = strstr(direction, ",flat");
    bool known = length > 0 && length < (int)sizeof direction;
    if (flat != NULL && flat[5] == '\0') {
        *flat = '\0';
        result.orthographic = true;
    }
    bool by_name = false;
    for (size_t k = 0; k < sizeof named / sizeof named[0]; k++) {
        if (strcmp(direction, named[k].name) == 0) {
            result.azimuth_deg = named[k].azimuth;
            result.elevation_deg = named[k].elevation;
            by_name = true;
        }
    }
    known = known && (by_name || parse_angles(direction, &result));
    if (!known) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "--view %s: expected corner, front, side, top or "
                            "AZIMUTH,ELEVATION in degrees (-360..360, -90..90), with "
                            ",flat for no perspective",
                            text);
    }
    *viewpoint = result;
    return true;
}

static void set_axes(struct gb_view *view, const struct gb_viewpoint *viewpoint)
{
    const double a = viewpoint->azimuth_deg * M_PI / 180.0;
    const double e = viewpoint->elevation_deg * M_PI / 180.0;
    const double right[3] = {-sin(a), cos(a), 0.0};
    const double up[3] = {-sin(e) * cos(a), -sin(e) * sin(a), cos(e)};
    const double away[3] = {-cos(e) * cos(a), -cos(e) * sin(a), -sin(e)};
    memcpy(view->right, right, sizeof right);
    memcpy(view->up, up, sizeof up);
    memcpy(view->away, away, sizeof away);
}

void gb_view_eye(const struct gb_view *view, const double point[3], double eye[3])
{
    double d[3];
    for (int k = 0; k < 3; k++) {
        d[k] = point[k] - view->target[k];
    }
    eye[0] = d[0] * view->right[0] + d[1] * view->right[1] + d[2] * view->right[2];
    eye[1] = d[0] * view->up[0] + d[1] * view->up[1] + d[2] * view->up[2];
    eye[2] = d[0] * view->away[0] + d[1] * view->away[1] + d[2] * view->away[2] +
             view->distance;
}

void gb_view_pixel(const struct gb_view *view, const double eye[3], double pixel[2])
{
    const double scale = view->orthographic ? view->focal : view->focal / eye[2];
    pixel[0] = view->centre[0] + scale * eye[0];
    pixel[1] = view->centre[1] - scale * eye[1];
}

double gb_view_scale(const struct gb_view *view)
{
    return view->orthographic ? view->focal : view->focal / view->distance;
}

/* Bounds of the box grown by margin in the plane of focal length 1, and depths. */
static void find_bounds(struct gb_view *view, const double lowest[3],
                        const double highest[3], double margin)
{
    double *low = view->low;
    double *high = view->high;
    low[0] = low[1] = view->near = INFINITY;
    high[0] = high[1] = view->far = -INFINITY;
    for (int corner = 0; corner < 8; corner++) {
        double point[3];
        double eye[3];
        for (int k = 0; k < 3; k++) {
            point[k] = (corner >> k & 1) != 0 ? highest[k] + margin : lowest[k] - margin;
        }
        gb_view_eye(view, point, eye);
        for (int k = 0; k < 2; k++) {
            const double at = view->orthographic ? eye[k] : eye[k] / eye[2];
            low[k] = fmin(low[k], at);
            high[k] = fmax(high[k], at);
        }
        view->near = fmin(view->near, eye[2]);
        view->far = fmax(view->far, eye[2]);
    }
}

void gb_view_set_frame(struct gb_view *view, const struct gb_frame *frame)
{
    const double *low = view->low;
    const double *high = view->high;
    view->focal =
        fmin(frame->width / (high[0] - low[0]), frame->height / (high[1] - low[1]));
    view->centre[0] =
        frame->left + 0.5 * frame->width - 0.5 * view->focal * (low[0] + high[0]);
    view->centre[1] =
        frame->top + 0.5 * frame->height + 0.5 * view->focal * (low[1] + high[1]);
}

void gb_view_include(struct gb_viewpoint *viewpoint, const struct gb_cell *cell)
{
    double matrix[3][3];
    gb_cell_matrix(cell, matrix);
    for (int k = 0; k < 3; k++) {
        double low = 0.0, high = 0.0;
        for (int edge = 0; edge < 3; edge++) {
            low += fmin(matrix[k][edge], 0.0);
            high += fmax(matrix[k][edge], 0.0);
        }
        viewpoint->lowest[k] = fmin(viewpoint->lowest[k], low);
        viewpoint->extent[k] = fmax(viewpoint->extent[k], high);
    }
}

void gb_view_init(struct gb_view *view, const struct gb_viewpoint *viewpoint,
                  const double cell[3], double margin, const struct gb_frame *frame)
{
    double diagonal = 0.0;
    const double *extent = viewpoint->extent[0] > 0.0 ? viewpoint->extent : cell;
    *view = (struct gb_view){.orthographic = viewpoint->orthographic, .focal = 1.0};
    set_axes(view, viewpoint);
    for (int k = 0; k < 3; k++) {
        const double width = extent[k] - viewpoint->lowest[k] + 2.0 * margin;
        view->target[k] = 0.5 * (viewpoint->lowest[k] + extent[k]);
        diagonal += width * width;
    }
    if (!viewpoint->orthographic) {
        view->distance = viewer_distance * 0.5 * sqrt(diagonal);
    }
    find_bounds(view, viewpoint->lowest, extent, margin);
    gb_view_set_frame(view, frame);
}
