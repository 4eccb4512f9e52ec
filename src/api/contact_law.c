#include "greenbody/contact_law.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <glib.h>

#include "api/arguments.h"
#include "api/parameters_private.h"
#include "study/law_table.h"

static const struct gb_law_table_law *law_at(size_t index)
{
    size_t count = 0;
    const struct gb_law_table_law *laws = gb_law_table_laws(&count);
    return index < count ? &laws[index] : NULL;
}

const char *gb_contact_law_name(size_t index)
{
    const struct gb_law_table_law *law = law_at(index);
    return law ? law->name : NULL;
}

const char *gb_contact_law_doc(size_t index)
{
    const struct gb_law_table_law *law = law_at(index);
    return law ? law->doc : NULL;
}

const char *gb_contact_law_columns(const char *law)
{
    const struct gb_law_table_law *found = law ? gb_law_table_find(law) : NULL;
    return found ? found->header : NULL;
}

const char *gb_contact_law_variable(const char *law)
{
    const struct gb_law_table_law *found = law ? gb_law_table_find(law) : NULL;
    return found ? found->variable : NULL;
}

size_t gb_contact_law_rows(const struct gb_contact_law_request *request)
{
    if (!request || request->size < sizeof *request || !request->law) {
        return 0;
    }
    const struct gb_law_table_law *law = gb_law_table_find(request->law);
    if (!law) {
        return 0;
    }
    if (!law->variable) {
        return 1;
    }
    if (request->history == GB_CONTACT_LAW_POINTS) {
        return request->count;
    }
    /* more does not fit into memory; the limit keeps rows times columns within size_t */
    return request->history == GB_CONTACT_LAW_PATH && request->count < SIZE_MAX >> 16
               ? gb_law_table_of_path(request->count)
               : 0;
}

/* --- the request as the options of `greenbody law` --------------------------------- */

/* Destination of the rows. */
struct rows {
    double *out;
    size_t room, filled;
};

static bool take_row(const double *value, int columns, void *data, struct gb_error *err)
{
    struct rows *rows = data;
    const size_t count = (size_t)columns;
    if (!gb_arguments_fit(rows->room, rows->filled + count, "room", err)) {
        return false;
    }
    memcpy(rows->out + rows->filled, value, count * sizeof *value);
    rows->filled += count;
    return true;
}

static char **points_of(const struct gb_contact_law_request *request,
                        const char *variable, size_t first, size_t count)
{
    char **at = g_new0(char *, count + 1);
    for (size_t i = 0; i < count; i++) {
        char x[G_ASCII_DTOSTR_BUF_SIZE], h_min[G_ASCII_DTOSTR_BUF_SIZE];
        g_ascii_dtostr(x, sizeof x, request->x[first + i]);
        g_ascii_dtostr(h_min, sizeof h_min, request->h_min);
        at[i] = isnan(request->h_min)
                    ? g_strdup_printf("%s=%s", variable, x)
                    : g_strdup_printf("%s=%s,h_min=%s", variable, x, h_min);
    }
    return at;
}

static char *path_of(const struct gb_contact_law_request *request, const char *variable)
{
    GString *path = g_string_new(variable);
    for (size_t i = 0; i < request->count; i++) {
        char x[G_ASCII_DTOSTR_BUF_SIZE];
        g_ascii_dtostr(x, sizeof x, request->x[i]);
        g_string_append_printf(path, "%c%s", i ? ',' : '=', x);
    }
    return g_string_free(path, FALSE);
}

static bool find(const struct gb_contact_law_request *request,
                 struct gb_law_table_request *rows, struct gb_error *err)
{
    GString *names = g_string_new(NULL);
    for (size_t i = 0; law_at(i); i++) {
        g_string_append_printf(names, "%s%s", i ? ", " : "", law_at(i)->name);
    }
    rows->law = gb_law_table_find(request->law);
    if (!rows->law) {
        gb_error_set(err, GB_ERR_INPUT, "law %.40s: expected %s", request->law,
                     names->str);
    }
    g_string_free(names, TRUE);
    if (!rows->law) {
        return false;
    }
    rows->lattice = request->lattice ? gb_law_table_find_lattice(request->lattice) : NULL;
    const bool needed = strcmp(request->law, "lattice") == 0;
    return (needed ? rows->lattice != NULL : request->lattice == NULL) ||
           gb_error_set(err, GB_ERR_INPUT, "law %s: lattice %s: expected %s",
                        request->law, request->lattice ? request->lattice : "missing",
                        needed ? "sc, fcc, bcc or diamond" : "none");
}

/* Checks that the request has everything that the law needs. */
static bool check(const struct gb_contact_law_request *request,
                  const struct gb_law_table_law *law,
                  const struct gb_parameters *parameters, const double *out, size_t room,
                  struct gb_error *err)
{
    const size_t rows = gb_contact_law_rows(request);
    const size_t columns = (size_t)gb_law_table_columns(law);
    if (!gb_arguments_given(parameters, "parameters", err) ||
        !gb_arguments_given(out, "out", err)) {
        return false;
    }
    if (law->variable && request->history != GB_CONTACT_LAW_POINTS &&
        request->history != GB_CONTACT_LAW_PATH) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "history = %d: expected GB_CONTACT_LAW_POINTS or _PATH",
                            request->history);
    }
    if (law->variable && request->count > 0 &&
        !gb_arguments_given(request->x, "x", err)) {
        return false;
    }
    if (request->count > SIZE_MAX >> 16) {
        return gb_error_set(err, GB_ERR_INPUT, "count = %zu: expected at most %zu",
                            request->count, SIZE_MAX >> 16);
    }
    return gb_arguments_fit(room, rows * columns, "room", err);
}

/* Computes the points in blocks, because each point is passed as text. */
static bool compute_points(struct gb_law_table_request *options,
                           const struct gb_contact_law_request *request,
                           const struct gb_params *params, struct rows *rows,
                           struct gb_error *err)
{
    enum { AT_A_TIME = 1024 };
    bool good = true;
    for (size_t i = 0; good && i < request->count; i += AT_A_TIME) {
        options->at = points_of(request, options->law->variable, i,
                                MIN((size_t)AT_A_TIME, request->count - i));
        good = gb_law_table_compute(options, params, take_row, rows, err);
        g_strfreev(options->at);
    }
    return good;
}

bool gb_contact_law_compute(const struct gb_contact_law_request *request,
                            const struct gb_parameters *parameters, double *out,
                            size_t room, struct gb_error *err)
{
    struct gb_law_table_request options = {0};
    struct rows rows = {.out = out, .room = room};
    if (!gb_arguments_given(request, "request", err)) {
        return false;
    }
    if (request->size < sizeof *request) {
        return gb_error_set(
            err, GB_ERR_INPUT,
            "size = %zu: must be sizeof(struct gb_contact_law_request), %zu",
            request->size, sizeof *request);
    }
    if (!gb_arguments_given(request->law, "law", err) || !find(request, &options, err) ||
        !check(request, options.law, parameters, out, room, err)) {
        return false;
    }
    const struct gb_params *params = gb_preset_params(parameters->preset);
    const char *variable = options.law->variable;
    if (variable && request->count > 0 && request->history == GB_CONTACT_LAW_POINTS) {
        return compute_points(&options, request, params, &rows, err);
    }
    if (variable && request->history == GB_CONTACT_LAW_PATH) {
        options.path = path_of(request, variable);
    }
    const bool good = gb_law_table_compute(&options, params, take_row, &rows, err);
    g_free(options.path);
    return good;
}
