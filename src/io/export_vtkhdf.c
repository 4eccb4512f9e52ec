/* VTKHDF 1.0, UnstructuredGrid, for ParaView from 5.10 and VTK from 9.1; h5py reads it
 * like any HDF5 file.  Source: VTK, "VTKHDF File Format". */
#include <string.h>

#include "base/alloc.h"
#include "hdf/hdf.h"
#include "io/export.h"

enum {
    VERTEX = 1,
    LINE = 3,
    TENSOR = 6
}; /* types of VTK; components of a symmetric tensor */

#define ROOT "/VTKHDF/"

/* A file being written.  It keeps the first failure. */
struct vtk {
    struct gb_hdf *file;
    struct gb_error *err;
    bool good;
};

static void put(struct vtk *vtk, const char *name, enum gb_hdf_type type, int64_t rows,
                int columns, const char *unit, const void *data)
{
    const struct gb_hdf_array array = {name, type, rows, columns, unit};
    vtk->good = vtk->good && gb_hdf_put_array(vtk->file, &array, data, vtk->err);
}

/* Scratch memory for rows x columns numbers, until the next call. */
static double *numbers(struct vtk *vtk, int64_t rows, int columns)
{
    double *array =
        vtk->good ? gb_alloc_array((size_t)(rows * columns) + 1, sizeof *array, vtk->err)
                  : NULL;
    vtk->good = array != NULL;
    return array;
}

/* Writes cells of `each` points 0, 1, 2, ..., all of one type. */
static void put_cells(struct vtk *vtk, int64_t cells, int each, uint8_t type)
{
    const int64_t points = cells * each;
    int64_t *order = gb_alloc_array((size_t)points + (size_t)cells + 1, sizeof *order,
                                    vtk->good ? vtk->err : NULL);
    uint8_t *types = gb_alloc_array((size_t)cells + 1, 1, vtk->good ? vtk->err : NULL);
    vtk->good = vtk->good && order != NULL && types != NULL;
    if (vtk->good) {
        for (int64_t k = 0; k < points; k++) {
            order[k] = k;
        }
        memset(types, type, (size_t)cells);
        put(vtk, ROOT "NumberOfPoints", GB_HDF_INT64, 1, 1, "1", &points);
        put(vtk, ROOT "NumberOfCells", GB_HDF_INT64, 1, 1, "1", &cells);
        put(vtk, ROOT "NumberOfConnectivityIds", GB_HDF_INT64, 1, 1, "1", &points);
        put(vtk, ROOT "Connectivity", GB_HDF_INT64, points, 1, "1", order);
        for (int64_t k = 0; k <= cells; k++) {
            order[k] = each * k;
        }
        put(vtk, ROOT "Offsets", GB_HDF_INT64, cells + 1, 1, "1", order);
        put(vtk, ROOT "Types", GB_HDF_UINT8, cells, 1, "1", types);
    }
    gb_alloc_free(order);
    gb_alloc_free(types);
}

/* Writes the cell (edges as rows), density, pressure, seed and provenance as text. */
static void put_field(struct vtk *vtk, const struct gb_export_frame *frame)
{
    const struct gb_state *state = frame->state;
    const double *cell = state->cell, *tilt = state->tilt;
    double edges[9] = {cell[0], 0.0,     0.0,     tilt[0], cell[1],
                       0.0,     tilt[1], tilt[2], cell[2]};
    const double pressure = 1e-6 * state->point.p_pa;
    for (int k = 0; k < 9; k++) {
        edges[k] *= frame->nm;
    }
    put(vtk, ROOT "FieldData/cell_nm", GB_HDF_DOUBLE, 9, 1, "nm", edges);
    put(vtk, ROOT "FieldData/density", GB_HDF_DOUBLE, 1, 1, "1", &state->point.density);
    put(vtk, ROOT "FieldData/pressure_MPa", GB_HDF_DOUBLE, 1, 1, "MPa", &pressure);
    put(vtk, ROOT "FieldData/seed", GB_HDF_UINT64, 1, 1, "1", &state->seed);
    GString *text = g_string_new(NULL);
    gb_export_text_provenance(text, frame);
    vtk->good = vtk->good && gb_hdf_group_text(vtk->file, "/VTKHDF", "provenance",
                                               text->str, vtk->err);
    g_string_free(text, TRUE);
}

static void put_positions(struct vtk *vtk, const struct gb_export_frame *frame)
{
    const int64_t count = frame->state->count;
    double *points = numbers(vtk, count, 3);
    for (int64_t k = 0; vtk->good && k < 3 * count; k++) {
        points[k] = frame->nm * frame->state->position[k];
    }
    put(vtk, ROOT "Points", GB_HDF_DOUBLE, count, 3, "nm", points);
    gb_alloc_free(points);
}

/* Writes diameters, and stresses in the order of VTK: xx, yy, zz, xy, yz, xz. */
static void put_particle_data(struct vtk *vtk, const struct gb_export_frame *frame)
{
    static const int order[TENSOR] = {0, 1, 2, 3, 5, 4};
    const struct gb_state *state = frame->state;
    const int64_t count = state->count;
    double *values = numbers(vtk, count, TENSOR);
    for (int64_t i = 0; vtk->good && i < count; i++) {
        values[i] = 2.0 * frame->nm * state->radius[i];
    }
    put(vtk, ROOT "PointData/diameter_nm", GB_HDF_DOUBLE, count, 1, "nm", values);
    for (int64_t k = 0; vtk->good && k < TENSOR * count; k++) {
        values[k] = 1e-6 * frame->stress[TENSOR * (k / TENSOR) + order[k % TENSOR]];
    }
    put(vtk, ROOT "PointData/stress_MPa", GB_HDF_DOUBLE, count, TENSOR, "MPa", values);
    put(vtk, ROOT "PointData/coordination", GB_HDF_INT32, count, 1, "1", state->contacts);
    gb_alloc_free(values);
}

static void put_vectors(struct vtk *vtk, const struct gb_export_frame *frame)
{
    struct gb_export_vector vectors[GB_EXPORT_VECTORS];
    const int64_t count = frame->state->count;
    double *values = numbers(vtk, count, 3);
    gb_export_vectors(frame, vectors);
    for (int k = 0; vtk->good && k < GB_EXPORT_VECTORS; k++) {
        if (vectors[k].data == NULL) {
            continue;
        }
        for (int64_t i = 0; i < 3 * count; i++) {
            values[i] = vectors[k].factor * vectors[k].data[i];
        }
        char name[64];
        g_snprintf(name, sizeof name, ROOT "PointData/%s", vectors[k].vtk);
        put(vtk, name, GB_HDF_DOUBLE, count, 3, vectors[k].unit, values);
    }
    gb_alloc_free(values);
}

static void write_particles(struct vtk *vtk, const struct gb_export_frame *frame)
{
    put_positions(vtk, frame);
    put_cells(vtk, frame->state->count, 1, VERTEX);
    put_particle_data(vtk, frame);
    put_vectors(vtk, frame);
}

/* Writes a line from each first particle to the nearest image of the second. */
static void put_branches(struct vtk *vtk, const struct gb_export_frame *frame)
{
    const struct gb_state *state = frame->state;
    const int64_t pairs = gb_export_text_contacts(frame);
    double *points = numbers(vtk, pairs, 6);
    for (int64_t k = 0; vtk->good && k < pairs; k++) {
        const struct gb_export_contact contact = gb_export_text_contact(frame, k);
        for (int c = 0; c < 3; c++) {
            const double first = frame->nm * state->position[3 * contact.first + c];
            points[6 * k + c] = first;
            points[6 * k + 3 + c] = first - contact.branch[c];
        }
    }
    put(vtk, ROOT "Points", GB_HDF_DOUBLE, 2 * pairs, 3, "nm", points);
    gb_alloc_free(points);
}

/* A number of a contact, by column. */
static double scalar_of(const struct gb_export_contact *contact, int column)
{
    const double values[] = {contact->normal, contact->overlap, contact->shear,
                             contact->radius, contact->area,    contact->bridge_radius};
    return values[column];
}

/* Writes bridges and particles of the lines. */
static void put_pairs(struct vtk *vtk, const struct gb_export_frame *frame)
{
    const struct gb_state *state = frame->state;
    const int64_t pairs = gb_export_text_contacts(frame);
    const size_t contacts = (size_t)state->pair_count, gaps = (size_t)frame->gaps.count;
    const size_t room = (size_t)pairs + 1;
    struct gb_error *err = vtk->good ? vtk->err : NULL;
    uint8_t *bridged = gb_alloc_array(room, sizeof *bridged, err);
    int32_t *particles = gb_alloc_array(2 * room, sizeof *particles, err);
    vtk->good = vtk->good && bridged != NULL && particles != NULL;
    if (vtk->good && contacts > 0) {
        memcpy(bridged, state->pair_bridged, contacts * sizeof *bridged);
        memcpy(particles, state->pair, 2 * contacts * sizeof *particles);
    }
    if (vtk->good && gaps > 0) {
        memcpy(particles + 2 * contacts, frame->gaps.pair, 2 * gaps * sizeof *particles);
    }
    put(vtk, ROOT "CellData/bridged", GB_HDF_UINT8, pairs, 1, "1", bridged);
    put(vtk, ROOT "CellData/particles", GB_HDF_INT32, pairs, 2, "1", particles);
    gb_alloc_free(bridged);
    gb_alloc_free(particles);
}

/* Writes the columns of the lines that the state has. */
static void put_contact_data(struct vtk *vtk, const struct gb_export_frame *frame)
{
    static const struct {
        const char *name, *unit;
    } columns[] = {
        {ROOT "CellData/normal_nN", "nN"},  {ROOT "CellData/overlap_nm", "nm"},
        {ROOT "CellData/shear_nN", "nN"},   {ROOT "CellData/radius_nm", "nm"},
        {ROOT "CellData/area_nm2", "nm^2"}, {ROOT "CellData/bridge_radius_nm", "nm"}};
    const struct gb_state *state = frame->state;
    const int64_t pairs = gb_export_text_contacts(frame);
    const int count = state->contact_radius ? (int)G_N_ELEMENTS(columns) : 3;
    double *force = numbers(vtk, pairs, 3), *values = numbers(vtk, pairs, count);
    for (int64_t k = 0; vtk->good && k < pairs; k++) {
        const struct gb_export_contact contact = gb_export_text_contact(frame, k);
        memcpy(&force[3 * k], contact.force, sizeof contact.force);
        for (int c = 0; c < count; c++) {
            values[c * pairs + k] = scalar_of(&contact, c);
        }
    }
    put(vtk, ROOT "CellData/force_nN", GB_HDF_DOUBLE, pairs, 3, "nN", force);
    for (int c = 0; c < count; c++) {
        put(vtk, columns[c].name, GB_HDF_DOUBLE, pairs, 1, columns[c].unit,
            values ? values + c * pairs : NULL);
    }
    put_pairs(vtk, frame);
    gb_alloc_free(force);
    gb_alloc_free(values);
}

static void write_contacts(struct vtk *vtk, const struct gb_export_frame *frame)
{
    put_branches(vtk, frame);
    put_cells(vtk, gb_export_text_contacts(frame), 2, LINE);
    put_contact_data(vtk, frame);
}

/* Objects are written without times, so equal states make equal files. */
static bool write_file(const struct gb_export_frame *frame, const char *data,
                       void (*write)(struct vtk *vtk,
                                     const struct gb_export_frame *frame),
                       GString *bytes, struct gb_error *err)
{
    static const int64_t version[] = {1, 0};
    struct vtk vtk = {.err = err};
    vtk.good = gb_hdf_create_image(&vtk.file, "vtkhdf", err) &&
               gb_hdf_group_create(vtk.file, "/VTKHDF", err) &&
               gb_hdf_group_create(vtk.file, data, err) &&
               gb_hdf_group_create(vtk.file, "/VTKHDF/FieldData", err) &&
               gb_hdf_group_numbers(vtk.file, "/VTKHDF", "Version", 2, version, err) &&
               gb_hdf_group_text(vtk.file, "/VTKHDF", "Type", "UnstructuredGrid", err);
    if (vtk.good) {
        write(&vtk, frame);
        put_field(&vtk, frame);
    }
    const bool done = vtk.good && gb_hdf_group_image(vtk.file, bytes, err);
    gb_hdf_destroy(vtk.file);
    return done;
}

bool gb_export_vtkhdf_write(const struct gb_export_frame *frame, GString *particles,
                            GString *contacts, struct gb_error *err)
{
    return write_file(frame, "/VTKHDF/PointData", write_particles, particles, err) &&
           (contacts == NULL ||
            write_file(frame, "/VTKHDF/CellData", write_contacts, contacts, err));
}
