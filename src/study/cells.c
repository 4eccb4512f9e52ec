#include "study/cells.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/alloc.h"
#include "base/clock.h"
#include "base/file.h"
#include "io/text_file.h"
#include "many/ensemble.h"
#include "many/pool.h"

enum { QUESTION_BYTES_MAX = 1 << 24 };

static const double poll_s = 0.2;
static const double patience_s = 60.0;
static const char taken_text[] = "another process measures this cell or has done so";
static const char group[] = "cell";

static void free_cell(void *data)
{
    struct gb_cells_item *cell = data;
    g_free(cell->name);
    g_free(cell->question);
    g_free(cell);
}

bool gb_cells_init(struct gb_cells *cells, const char *directory, struct gb_error *err)
{
    cells->list = g_ptr_array_new_with_free_func(free_cell);
    cells->directory = g_build_filename(directory, "cells", NULL);
    return gb_ensemble_make_directory(directory, err) &&
           gb_ensemble_make_directory(cells->directory, err);
}

void gb_cells_finish(struct gb_cells *cells)
{
    if (cells->list != NULL) {
        g_ptr_array_unref(cells->list);
    }
    g_free(cells->directory);
    memset(cells, 0, sizeof *cells);
}

/* Every parameter that changes a result. */
static void add_params(GString *text, const struct gb_params *params)
{
    size_t count = 0;
    const struct gb_field *field = gb_params_fields(&count);
    for (size_t i = 0; i < count; i++) {
        char value[GB_PARAMS_VALUE_MAX];
        if (strcmp(field[i].group, "output") != 0 &&
            strcmp(field[i].key, "threads") != 0 && strcmp(field[i].key, "title") != 0) {
            g_string_append_printf(
                text, "%s.%s=%s\n", field[i].group, field[i].key,
                gb_params_format(params, &field[i], value, sizeof value));
        }
    }
}

struct gb_cells_item *gb_cells_add(struct gb_cells *cells, const struct gb_params *params,
                                   char *name, const char *options)
{
    struct gb_cells_item *cell = g_new0(struct gb_cells_item, 1);
    GString *text = g_string_new(NULL);
    g_string_append_printf(text, "[%s]\nversion=%s\n%s", group, GB_VERSION, options);
    add_params(text, params);
    cell->params = *params;
    cell->name = name;
    cell->question = g_string_free(text, FALSE);
    g_ptr_array_add(cells->list, cell);
    return cell;
}

char *gb_cells_name(const struct gb_keep_point *mark, int replica)
{
    return mark->by_density
               ? g_strdup_printf("density-%.9g-cell-%03d", mark->value, replica + 1)
               : g_strdup_printf("p-%.9gMPa-cell-%03d", 1e-6 * mark->value, replica + 1);
}

static char *path_of(const struct gb_cells *cells, const struct gb_cells_item *cell,
                     const char *ending)
{
    char *file = g_strconcat(cell->name, ending, NULL);
    char *path = g_build_filename(cells->directory, file, NULL);
    g_free(file);
    return path;
}

/* An answer to the same question is there. */
static bool is_done(const struct gb_cells *cells, const struct gb_cells_item *cell)
{
    char *question = path_of(cells, cell, ".ini");
    char *answer = path_of(cells, cell, ".csv");
    char *text = NULL;
    size_t length = 0;
    const bool done = gb_file_read(question, QUESTION_BYTES_MAX, &text, &length, NULL) &&
                      strcmp(text, cell->question) == 0 &&
                      g_file_test(answer, G_FILE_TEST_IS_REGULAR);
    gb_alloc_free(text);
    g_free(answer);
    g_free(question);
    return done;
}

void gb_cells_find_done(struct gb_cells *cells)
{
    for (guint i = 0; i < cells->list->len; i++) {
        struct gb_cells_item *cell = g_ptr_array_index(cells->list, i);
        cell->done = is_done(cells, cell);
    }
}

/* The answer to another question goes before the question changes. */
static bool ask(const struct gb_cells *cells, const struct gb_cells_item *cell,
                struct gb_error *err)
{
    char *question = path_of(cells, cell, ".ini");
    char *answer = path_of(cells, cell, ".csv");
    char *text = NULL;
    size_t length = 0;
    bool good = gb_file_read(question, QUESTION_BYTES_MAX, &text, &length, NULL) &&
                strcmp(text, cell->question) == 0;
    if (!good) {
        (void)remove(answer);
        good = gb_text_file_replace(question, cell->question, strlen(cell->question),
                                    GB_TEXT_FILE_OF_RUN, err);
    }
    gb_alloc_free(text);
    g_free(answer);
    g_free(question);
    return good;
}

/* Does another process measure the cell? */
static bool is_held(const struct gb_cells *cells, const struct gb_cells_item *cell)
{
    char *name = g_strconcat(cell->name, ".lock", NULL);
    const bool held = gb_lock_is_held(cells->directory, name);
    g_free(name);
    return held;
}

static bool submit(struct gb_cells *cells, struct gb_pool *pool, size_t index,
                   struct gb_error *err)
{
    struct gb_cells_item *cell = g_ptr_array_index(cells->list, index);
    char *path = path_of(cells, cell, "");
    cell->submitted =
        ask(cells, cell, err) && gb_pool_submit(pool, index, &cell->params, path, err);
    g_free(path);
    return cell->submitted;
}

static void report(const struct gb_cells *cells,
                   const struct gb_cells_callbacks *callbacks,
                   const struct gb_cells_item *cell, size_t done)
{
    if (callbacks->progress != NULL) {
        callbacks->progress(callbacks->data, cell, done, cells->list->len);
    }
}

/* A study under way. */
struct work {
    struct gb_cells *cells;
    struct gb_pool *pool;
    const struct gb_cells_callbacks *callbacks;
    size_t ended;
    double idle_since; /* clock: nothing is under way here since then */
};

static void wait_for(const struct work *work, struct gb_cells_item *cell)
{
    if (!cell->named && work->callbacks->on_wait != NULL &&
        gb_clock_s() - work->idle_since > patience_s) {
        char *name = g_strconcat(cell->name, ".lock", NULL);
        char *holder = gb_lock_holder(work->cells->directory, name);
        cell->named = true;
        work->callbacks->on_wait(work->callbacks->data, cell, holder);
        g_free(holder);
        g_free(name);
    }
}

/* Submits cells in the order of the list to idle workers.  In this order: a cell that
 * another process ends between the two looks is done. */
static bool submit_idle(struct work *work, struct gb_error *err)
{
    for (guint i = 0; i < work->cells->list->len && gb_pool_idle(work->pool) > 0; i++) {
        struct gb_cells_item *cell = g_ptr_array_index(work->cells->list, i);
        if (cell->ended || cell->submitted) {
            continue;
        }
        if (is_held(work->cells, cell)) {
            wait_for(work, cell);
            continue;
        }
        cell->done = cell->ended = is_done(work->cells, cell);
        work->ended += cell->ended;
        if (!cell->ended && !submit(work->cells, work->pool, i, err)) {
            return false;
        }
    }
    return true;
}

static void receive(struct work *work)
{
    struct gb_pool_report end;
    if (!gb_pool_receive(work->pool, poll_s, &end)) {
        return;
    }
    struct gb_cells_item *cell = g_ptr_array_index(work->cells->list, end.ticket);
    if (end.error.code == GB_ERR_INPUT && strcmp(end.error.text, taken_text) == 0) {
        cell->submitted = false;
        return;
    }
    cell->error = end.error;
    cell->done = end.error.code == GB_OK;
    cell->ended = true;
    report(work->cells, work->callbacks, cell, ++work->ended);
}

static bool run(struct work *work, struct gb_error *err)
{
    const struct gb_cells_callbacks *callbacks = work->callbacks;
    bool stopped = false;
    while (true) {
        if (!stopped && callbacks->cancelled != NULL &&
            callbacks->cancelled(callbacks->data)) {
            gb_pool_stop(work->pool);
            stopped = true;
        }
        if (!stopped && !submit_idle(work, err)) {
            return false;
        }
        if (gb_pool_busy(work->pool) > 0) {
            work->idle_since = gb_clock_s();
        } else if (stopped || work->ended == work->cells->list->len) {
            break;
        }
        receive(work);
    }
    return !stopped || gb_error_set(err, GB_ERR_CANCELLED, "stopped on request");
}

bool gb_cells_work(struct gb_cells *cells, int jobs, gb_pool_work *work,
                   const struct gb_cells_callbacks *callbacks, struct gb_error *err)
{
    static const struct gb_cells_callbacks none;
    const struct gb_launch launch = gb_pool_launch();
    const size_t workers = (size_t)(jobs > 0 ? jobs : gb_pool_cores(&launch));
    struct work study = {.cells = cells,
                         .callbacks = callbacks != NULL ? callbacks : &none,
                         .idle_since = gb_clock_s()};
    const bool good = gb_pool_create(&study.pool, workers, work, err) && run(&study, err);
    gb_pool_destroy(study.pool);
    return good;
}

bool gb_cells_check(const struct gb_cells *cells, struct gb_error *err)
{
    const struct gb_cells_item *first = NULL;
    size_t failed = 0;
    for (size_t i = 0; i < cells->list->len; i++) {
        const struct gb_cells_item *cell = g_ptr_array_index(cells->list, i);
        if (!cell->done) {
            first = first != NULL ? first : cell;
            failed++;
        }
    }
    return first == NULL ||
           gb_error_set(err, GB_ERR_GUARD, "%zu of %u cells failed; %s: %.300s", failed,
                        cells->list->len, first->name, first->error.text);
}

double gb_cells_option(GKeyFile *question, const char *key)
{
    GError *error = NULL;
    const double value = g_key_file_get_double(question, group, key, &error);
    if (error != NULL) {
        g_error_free(error);
        return (double)NAN;
    }
    return value;
}

void gb_cells_write(GString *text, const struct gb_keep_point *mark, const void *options,
                    const struct gb_cells_number *number, size_t count)
{
    g_string_append_printf(text, "by_density=%d\nmark=%.17g\n", mark->by_density,
                           mark->value);
    for (size_t i = 0; i < count; i++) {
        const char *at = (const char *)options + number[i].offset;
        g_string_append_printf(text, "%s=%.17g\n", number[i].key,
                               *(const double *)(const void *)at);
    }
}

void gb_cells_read(GKeyFile *question, struct gb_keep_point *mark, void *options,
                   const struct gb_cells_number *number, size_t count)
{
    mark->by_density = gb_cells_option(question, "by_density") != 0.0;
    mark->value = gb_cells_option(question, "mark");
    for (size_t i = 0; i < count; i++) {
        char *at = (char *)options + number[i].offset;
        *(double *)(void *)at = gb_cells_option(question, number[i].key);
    }
}

/* Locks a cell that has no answer yet. */
static bool claim(struct gb_lock *lock, const char *path, struct gb_error *err)
{
    char *folder = g_path_get_dirname(path);
    char *answer = g_strconcat(path, ".csv", NULL);
    char *file = g_path_get_basename(path), *name = g_strconcat(file, ".lock", NULL);
    bool good = gb_lock_take(lock, folder, name);
    if (!good && errno != EWOULDBLOCK) {
        gb_error_set(err, GB_ERR_MACHINE, "%.300s.lock: %s", path, g_strerror(errno));
    } else if (!good || g_file_test(answer, G_FILE_TEST_EXISTS)) {
        good = gb_error_set(err, GB_ERR_INPUT, "%s", taken_text);
    }
    g_free(name);
    g_free(file);
    g_free(answer);
    g_free(folder);
    return good;
}

bool gb_cells_question(GKeyFile **question, struct gb_lock *lock, const char *path,
                       struct gb_error *err)
{
    char *file = g_strconcat(path, ".ini", NULL);
    GError *error = NULL;
    char *text = NULL;
    size_t length = 0;
    *question = g_key_file_new();
    *lock = GB_LOCK_NONE;
    const bool good =
        claim(lock, path, err) &&
        gb_file_read(file, QUESTION_BYTES_MAX, &text, &length, err) &&
        (g_key_file_load_from_data(*question, text, length, G_KEY_FILE_NONE, &error) ||
         gb_error_set(err, GB_ERR_MACHINE, "%.300s: %.200s", file, error->message));
    g_clear_error(&error);
    gb_alloc_free(text);
    if (!good) {
        gb_lock_release(lock);
        g_key_file_free(*question);
        *question = NULL;
    }
    g_free(file);
    return good;
}

bool gb_cells_answer(const char *path, const char *ending, const GString *text,
                     struct gb_error *err)
{
    char *file = g_strconcat(path, ending, NULL);
    const bool good =
        gb_text_file_replace(file, text->str, text->len, GB_TEXT_FILE_OF_RUN, err);
    g_free(file);
    return good;
}

bool gb_cells_table(const char *path, const char *ending,
                    const struct gb_listing *listing, struct gb_error *err)
{
    GString *text = gb_listing_print(listing, GB_LISTING_CSV);
    const bool good = gb_cells_answer(path, ending, text, err);
    g_string_free(text, TRUE);
    return good;
}
