/* The rose of forces: the mean force of the contacts along each direction.  It is fitted with the
 * even spherical harmonics of orders 0, 2 and 4 by least squares, and drawn as a surface. */
#include "draw/rose.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>
#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <string.h>

#include "base/alloc.h"
#include "base/vec.h"
#include "draw/image.h"
#include "greenbody/status.h"
#include "pack/cell/cell.h"

/* Powers of x, y, z of the terms. */
static const int power[GB_ROSE_TERMS][3] = {
    {4, 0, 0}, {0, 0, 4}, {2, 0, 2}, {3, 0, 1}, {1, 0, 3},
    {0, 4, 0}, {2, 2, 0}, {0, 2, 2}, {3, 1, 0}, {1, 3, 0},
    {0, 3, 1}, {0, 1, 3}, {2, 1, 1}, {1, 2, 1}, {1, 1, 2},
};

/* The first five terms are the terms of the plane y = 0. */
enum { PLANAR_TERMS = 5 };

static double raise(double x, int exponent)
{
    double result = 1.0;
    for (int k = 0; k < exponent; k++) {
        result *= x;
    }
    return result;
}

static void terms_of(const double direction[3], double *term)
{
    const double size = gb_vec_length(direction);
    for (int k = 0; k < GB_ROSE_TERMS; k++) {
        term[k] = raise(direction[0] / size, power[k][0]) *
                  raise(direction[1] / size, power[k][1]) *
                  raise(direction[2] / size, power[k][2]);
    }
}

/* Normal equations of the terms; returns the mean of the values. */
static double add_up(double *matrix, double *right, size_t terms, const double *axis,
                     const double *value, size_t count)
{
    double sum = 0.0;
    memset(matrix, 0, terms * terms * sizeof *matrix);
    memset(right, 0, terms * sizeof *right);
    for (size_t i = 0; i < count; i++) {
        double term[GB_ROSE_TERMS];
        terms_of(&axis[3 * i], term);
        for (size_t a = 0; a < terms; a++) {
            for (size_t b = 0; b < terms; b++) {
                matrix[a * terms + b] += term[a] * term[b];
            }
            right[a] += term[a] * value[i];
        }
        sum += value[i];
    }
    return sum / (double)count;
}

bool gb_rose_fit(struct gb_rose *rose, int dimension, const double *axis,
                 const double *value, size_t count, struct gb_error *err)
{
    double matrix[GB_ROSE_TERMS * GB_ROSE_TERMS];
    double right[GB_ROSE_TERMS];
    const size_t terms = dimension == 2 ? PLANAR_TERMS : GB_ROSE_TERMS;
    *rose = (struct gb_rose){.count = count, .dimension = dimension};
    if (count < terms) {
        return gb_error_set(err, GB_ERR_INPUT, "rose of %zu forces: must be at least %zu",
                            count, terms);
    }
    rose->mean = add_up(matrix, right, terms, axis, value, count);
    gsl_matrix_view a = gsl_matrix_view_array(matrix, terms, terms);
    gsl_vector_view b = gsl_vector_view_array(right, terms);
    gsl_vector_view x = gsl_vector_view_array(rose->term, terms);
    if (gsl_linalg_cholesky_decomp1(&a.matrix) != GSL_SUCCESS ||
        gsl_linalg_cholesky_solve(&a.matrix, &b.vector, &x.vector) != GSL_SUCCESS) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "rose of %zu forces: too few different directions", count);
    }
    return true;
}

double gb_rose_at(const struct gb_rose *rose, const double direction[3])
{
    double term[GB_ROSE_TERMS];
    double sum = 0.0;
    terms_of(direction, term);
    for (int k = 0; k < GB_ROSE_TERMS; k++) {
        sum += rose->term[k] * term[k];
    }
    return sum;
}

/* Meridians and parallels of the surface, segments of a ring and of a planar rose. */
enum { AROUND = 160, DOWN = 80, RING = 72, PLANAR = 2 * DOWN };

/* Half a turn: the meridian of x > 0 goes on in that of x < 0. */
enum { OPPOSITE = AROUND / 2 };

static const double ring_radius = 0.008;
static const double axis_radius = 0.012;

/* Around a planar rose, over its reach: names of the axes beside the colour bar and below the
 * title.  The corners of the box around a body leave that room. */
static const double label_room = 0.2;

bool gb_rose_of_state(struct gb_rose *rose, const struct gb_state *state,
                      struct gb_error *err)
{
    const size_t count = (size_t)state->pair_count;
    const struct gb_cell cell = gb_state_cell(state);
    double *axis = gb_alloc_array(count + 1, 3 * sizeof *axis, err);
    if (axis == NULL) {
        return false;
    }
    for (size_t k = 0; k < count; k++) {
        const double *a = &state->position[3 * state->pair[2 * k]];
        const double *b = &state->position[3 * state->pair[2 * k + 1]];
        for (int j = 0; j < 3; j++) {
            axis[3 * k + (size_t)j] = a[j] - b[j];
        }
        gb_cell_nearest(&cell, &axis[3 * k]);
    }
    const bool good =
        gb_rose_fit(rose, state->dimension, axis, state->pair_normal, count, err);
    gb_alloc_free(axis);
    return good;
}

static void direction(int around, int down, double out[3])
{
    const double a = 2.0 * M_PI * around / AROUND;
    const double b = M_PI * down / DOWN;
    out[0] = sin(b) * cos(a);
    out[1] = sin(b) * sin(a);
    out[2] = cos(b);
}

static double radius_at(const struct gb_rose *rose, const double towards[3])
{
    return fmax(gb_rose_at(rose, towards) / rose->mean, 0.0);
}

double gb_rose_reach(const struct gb_rose *rose)
{
    double most = 1.0;
    for (int down = 0; down <= DOWN; down++) {
        for (int around = 0; around < AROUND;
             around += rose->dimension == 2 ? OPPOSITE : 1) {
            double towards[3];
            direction(around, down, towards);
            most = fmax(most, radius_at(rose, towards));
        }
    }
    return ceil(5.0 * most + 0.25) / 5.0;
}

/* Vertex of the surface in eye coordinates; its radius is added to *sum. */
static void corner(const struct gb_scene *scene, const struct gb_rose *rose, double reach,
                   int around, int down, float *out, double *sum)
{
    double towards[3];
    double point[3];
    double eye[3];
    direction(around, down, towards);
    const double radius = radius_at(rose, towards);
    for (int k = 0; k < 3; k++) {
        point[k] = reach + radius * towards[k];
    }
    gb_view_eye(&scene->view, point, eye);
    for (int k = 0; k < 3; k++) {
        out[k] = (float)eye[k];
    }
    *sum += radius;
}

static void set_surface(struct gb_scene *scene, const struct gb_rose *rose, double reach)
{
    static const int corners[2][3][2] = {{{0, 0}, {0, 1}, {1, 1}},
                                         {{0, 0}, {1, 1}, {1, 0}}};
    uint8_t *colour = scene->colour + 4 * (scene->count + scene->rods);
    float *facet = scene->facet;
    for (int down = 0; down < DOWN; down++) {
        for (int around = 0; around < AROUND; around++) {
            for (int half = 0; half < 2; half++) {
                double sum = 0.0;
                for (int k = 0; k < 3; k++) {
                    corner(scene, rose, reach, around + corners[half][k][0],
                           down + corners[half][k][1], facet + 3 * k, &sum);
                }
                gb_image_map_colour(NULL, sum / 3.0 / reach, colour);
                colour[3] = 255;
                facet += 9;
                colour += 4;
            }
        }
    }
}

/* Of 2D: triangles from the centre to the outline in the plane y = 0. */
static void set_plane(struct gb_scene *scene, const struct gb_rose *rose, double reach)
{
    const double centre[3] = {reach, reach, reach};
    uint8_t *colour = scene->colour + 4 * (scene->count + scene->rods);
    double eye[3];
    gb_view_eye(&scene->view, centre, eye);
    for (int k = 0; k < PLANAR; k++) {
        float *facet = scene->facet + 9 * k;
        double sum = 0.0;
        for (int j = 0; j < 3; j++) {
            facet[j] = (float)eye[j];
        }
        for (int end = 0; end < 2; end++) { /* 0 to DOWN on one side, back on the other */
            const int at = k + end;
            corner(scene, rose, reach, at <= DOWN ? 0 : OPPOSITE,
                   at <= DOWN ? at : PLANAR - at, facet + 3 + 3 * end, &sum);
        }
        gb_image_map_colour(NULL, sum / 2.0 / reach, colour + 4 * k);
        colour[4 * k + 3] = 255;
    }
}

static void set_rod(struct gb_scene *scene, size_t index, const double from[3],
                    const double to[3], double reach, double radius)
{
    const double *ends[2] = {from, to};
    uint8_t *colour = &scene->colour[4 * (scene->count + index)];
    for (size_t end = 0; end < 2; end++) {
        double point[3];
        double eye[3];
        for (int k = 0; k < 3; k++) {
            point[k] = reach + ends[end][k];
        }
        gb_view_eye(&scene->view, point, eye);
        for (size_t k = 0; k < 3; k++) {
            scene->rod[8 * index + 4 * end + k] = (float)eye[k];
        }
    }
    scene->rod[8 * index + 3] = (float)radius;
    gb_scene_foreground(scene->background, colour);
    colour[3] = 255;
}

/* Three axes through the centre, and three rings of radius 1; of 2D those of its plane. */
static void set_frame(struct gb_scene *scene, const struct gb_rose *rose, double reach)
{
    const bool planar = rose->dimension == 2;
    size_t index = 0;
    for (int k = 0; k < 3; k++) {
        double from[3] = {0.0, 0.0, 0.0};
        double to[3] = {0.0, 0.0, 0.0};
        from[k] = -reach;
        to[k] = reach;
        if (!planar || k != 1) {
            set_rod(scene, index++, from, to, reach, axis_radius);
        }
    }
    for (int k = 0; k < 3; k++) { /* around axis k */
        for (int piece = 0; piece < RING && (!planar || k == 1); piece++) {
            double ends[2][3] = {{0.0}};
            for (int end = 0; end < 2; end++) {
                const double a = 2.0 * M_PI * (piece + end) / RING;
                ends[end][(k + 1) % 3] = cos(a);
                ends[end][(k + 2) % 3] = sin(a);
            }
            set_rod(scene, index++, ends[0], ends[1], reach, ring_radius);
        }
    }
}

bool gb_rose_scene(struct gb_scene **out, const struct gb_rose *rose, double reach,
                   const struct gb_viewpoint *viewpoint, const struct gb_frame *frame,
                   enum gb_background background, struct gb_error *err)
{
    static const struct gb_viewpoint along_y = {.azimuth_deg = -90.0,
                                                .orthographic = true};
    const bool planar = rose->dimension == 2;
    const size_t parts[3] = {0, planar ? 2 + RING : 3 + 3 * RING,
                             planar ? PLANAR : 2 * (size_t)AROUND * DOWN};
    const double cell[3] = {2.0 * reach, 2.0 * reach, 2.0 * reach};
    if (!gb_scene_begin(out, cell, planar ? label_room * reach : 0.0, parts,
                        planar ? &along_y : viewpoint, frame, background, err)) {
        return false;
    }
    set_frame(*out, rose, reach);
    if (planar) {
        set_plane(*out, rose, reach);
        (*out)->shadow_share = 0.0F;
    } else {
        set_surface(*out, rose, reach);
    }
    (*out)->diameter = 0.15F; /* length of occlusion and shadows */
    (*out)->depth_cue = 0.0F;
    return true;
}
