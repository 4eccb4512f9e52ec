#include "io/runs/run_list.h"

#include <math.h>
#include <string.h>
#include <sys/stat.h>

#include "io/follow.h"
#include "io/rundir.h"
#include "io/runs/run_last_point.h"
#include "io/status/status_json.h"

enum { BLOCK = 512 }; /* unit of st_blocks */

static void free_item(void *data)
{
    struct gb_run_list_item *item = data;
    g_free(item->directory);
    g_free(item->name);
    g_free(item->title);
    g_free(item);
}

GPtrArray *gb_run_list_new(void)
{
    return g_ptr_array_new_with_free_func(free_item);
}

const char *gb_run_list_engine_word(enum gb_run_list_engine engine)
{
    static const char *const words[] = {[GB_RUN_LIST_NONE] = "none",
                                        [GB_RUN_LIST_LIVE] = "live",
                                        [GB_RUN_LIST_DETACHED] = "detached"};
    return words[engine];
}

/* Calls visit for the path of each entry of a directory. */
static void for_each(const char *path, void (*visit)(const char *inside, void *data),
                     void *data)
{
    GDir *dir = g_dir_open(path, 0, NULL);
    const char *name;
    while (dir != NULL && (name = g_dir_read_name(dir)) != NULL) {
        char *inside = g_build_filename(path, name, NULL);
        visit(inside, data);
        g_free(inside);
    }
    if (dir != NULL) {
        g_dir_close(dir);
    }
}

static void add_bytes(const char *path, void *data)
{
    struct stat info;
    int64_t *bytes = data;
    if (lstat(path, &info) == 0) {
        *bytes += (int64_t)info.st_blocks * BLOCK;
        if (S_ISDIR(info.st_mode)) {
            for_each(path, add_bytes, bytes);
        }
    }
}

int64_t gb_run_list_bytes(const char *path)
{
    int64_t bytes = 0;
    add_bytes(path, &bytes);
    return bytes;
}

static bool is_file(const char *directory, const char *name, int64_t *modified_s)
{
    struct stat info;
    char *path = g_build_filename(directory, name, NULL);
    const bool is = lstat(path, &info) == 0 && S_ISREG(info.st_mode);
    if (is) {
        *modified_s = (int64_t)info.st_mtime;
    }
    g_free(path);
    return is;
}

static enum gb_run_list_engine engine_of(const char *directory,
                                         const struct gb_follow_engine *engine)
{
    if (!gb_rundir_busy(directory)) {
        return GB_RUN_LIST_NONE;
    }
    return gb_follow_engine_detached(engine) ? GB_RUN_LIST_DETACHED : GB_RUN_LIST_LIVE;
}

static void read_run(struct gb_run_list_item *item)
{
    struct gb_params params;
    struct gb_snapshot snapshot = {.state = GB_RUN_STOPPED};
    struct gb_follow_engine engine = {0};
    item->density = item->pressure_pa = NAN;
    item->bytes = gb_run_list_bytes(item->directory);
    if (!gb_follow_params(item->directory, &params, NULL)) {
        item->state = "unreadable";
        item->title = g_strdup("");
        return;
    }
    item->title = g_strdup(params.title);
    const bool known = gb_follow_status(item->directory, &snapshot, &engine, NULL);
    item->engine = engine_of(item->directory, &engine);
    const bool busy = item->engine != GB_RUN_LIST_NONE;
    const bool live = snapshot.state <= GB_RUN_PAUSED;
    item->state = !known          ? (busy ? "packing" : "unreadable")
                  : live && !busy ? "interrupted"
                                  : gb_status_json_word(snapshot.state);
    item->progress = snapshot.state == GB_RUN_DONE ? 1.0 : snapshot.progress;
    double density = NAN, pressure_pa = NAN;
    if (gb_run_last_point_read(item->directory, &density, &pressure_pa)) {
        item->density = density;
        item->pressure_pa = pressure_pa;
    }
}

/* A folder of greenbody report, which has the preset of a run but none of its results. */
static bool is_report(const char *path)
{
    int64_t unused;
    return is_file(path, "report.md", &unused) && !is_file(path, "status.json", &unused);
}

/* A folder under search. */
struct search {
    GPtrArray *list;
    size_t prefix; /* bytes of the folder's path and its slash */
    int depth;
};

static void look_at(const char *path, void *data)
{
    const struct search *search = data;
    struct stat info;
    int64_t modified_s = 0;
    if (lstat(path, &info) != 0 || !S_ISDIR(info.st_mode) || is_report(path)) {
        return;
    }
    if (is_file(path, "preset.ini", &modified_s)) {
        struct gb_run_list_item *item = g_new0(struct gb_run_list_item, 1);
        is_file(path, "status.json", &modified_s);
        item->directory = g_strdup(path);
        item->name = g_strdup(path + search->prefix);
        item->modified_s = modified_s;
        read_run(item);
        g_ptr_array_add(search->list, item);
    } else if (search->depth < GB_RUN_LIST_DEPTH) {
        struct search deeper = *search;
        deeper.depth++;
        for_each(path, look_at, &deeper);
    }
}

void gb_run_list_add(GPtrArray *list, const char *folder)
{
    char *probe = g_build_filename(folder, "x", NULL);
    struct search search = {list, strlen(probe) - 1, 1};
    for_each(folder, look_at, &search);
    g_free(probe);
}

static gint compare(gconstpointer a, gconstpointer b)
{
    const struct gb_run_list_item *one = *(struct gb_run_list_item *const *)a;
    const struct gb_run_list_item *other = *(struct gb_run_list_item *const *)b;
    const int live =
        (other->engine != GB_RUN_LIST_NONE) - (one->engine != GB_RUN_LIST_NONE);
    const int newer =
        (other->modified_s > one->modified_s) - (other->modified_s < one->modified_s);
    return live != 0    ? live
           : newer != 0 ? newer
                        : strcmp(one->directory, other->directory);
}

void gb_run_list_sort(GPtrArray *list)
{
    g_ptr_array_sort(list, compare);
}
