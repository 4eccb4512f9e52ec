#include "io/run_list.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <glib.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/file.h"
#include "base/units.h"
#include "greenbody/status.h"
#include "io/follow.h"
#include "io/rundir.h"
#include "io/status_json.h"

/* The list of runs below a folder.
 *
 * A directory with preset.ini is a run.  Its lock says whether a process computes it,
 * status.json how far it is, and the last row of curve.csv gives density and pressure.
 * Nothing else is read, so that a list of hundreds of long runs appears at once.
 *
 * Below: the last point of a curve, the search, a run as a line of text, and deletion. */

/* More bytes than the comments with the header, and than a row. */
enum { END_BYTES = 16384 };

/* Reads at most END_BYTES bytes from a position and appends a zero. */
static void read_block(int fd, off_t from, char block[END_BYTES + 1])
{
    const ssize_t bytes = pread(fd, block, END_BYTES, from);
    block[bytes > 0 ? bytes : 0] = '\0';
}

/* The first line that is not a comment, terminated by a zero. */
static char *header_in(char *block)
{
    char *line = block;
    while (*line == '#' && (line = strchr(line, '\n')) != NULL) {
        line++;
    }
    char *end = line != NULL ? strchr(line, '\n') : NULL;
    if (end != NULL) {
        *end = '\0';
    }
    return end != NULL ? line : NULL;
}

/* The last complete line, terminated by a zero. */
static char *last_line_in(char *block)
{
    char *end = strrchr(block, '\n');
    if (end == NULL) {
        return NULL;
    }
    *end = '\0';
    char *before = strrchr(block, '\n');
    return before != NULL ? before + 1 : NULL;
}

static bool take(char **names, char **cells, const char *name, double *value)
{
    for (int k = 0; names[k] != NULL; k++) {
        if (strcmp(names[k], name) == 0) {
            char *end = cells[k];
            *value = g_ascii_strtod(cells[k], &end);
            return end != cells[k] && *end == '\0';
        }
    }
    return false;
}

bool gb_run_list_last_point(const char *directory, double *density, double *pressure_pa)
{
    char *path = g_build_filename(directory, "curve.csv", NULL);
    const int fd = gb_file_open(path, NULL);
    char first[END_BYTES + 1], last[END_BYTES + 1];
    double p_mpa = 0.0;
    g_free(path);
    if (fd < 0) {
        return false;
    }
    const off_t size = lseek(fd, 0, SEEK_END);
    read_block(fd, 0, first);
    read_block(fd, size > END_BYTES ? size - END_BYTES : 0, last);
    close(fd);
    const char *header = header_in(first), *row = last_line_in(last);
    if (header == NULL || row == NULL) {
        return false;
    }
    char **names = g_strsplit(header, ",", -1), **cells = g_strsplit(row, ",", -1);
    const bool good = g_strv_length(names) == g_strv_length(cells) &&
                      take(names, cells, "density", density) &&
                      take(names, cells, "p_MPa", &p_mpa);
    *pressure_pa = 1e6 * p_mpa;
    g_strfreev(names);
    g_strfreev(cells);
    return good;
}

enum { DISK_BLOCK = 512 }; /* unit of st_blocks */

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
        *bytes += (int64_t)info.st_blocks * DISK_BLOCK;
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
    if (gb_run_list_last_point(item->directory, &density, &pressure_pa)) {
        item->density = density;
        item->pressure_pa = pressure_pa;
    }
}

/* Is this a folder of greenbody report?  It has the preset of a run but no results. */
static bool is_report(const char *path)
{
    int64_t unused;
    return is_file(path, "report.md", &unused) && !is_file(path, "status.json", &unused);
}

/* A folder being searched. */
struct search {
    GPtrArray *list;
    size_t prefix; /* length of the folder's path with its slash */
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

enum { STATE_COLS = 14 };

/* "done", "live 45 %", "detached 45 %", "paused 45 %". */
static void write_state(const struct gb_run_list_item *item, char *text, size_t size)
{
    const bool paused = strcmp(item->state, "paused") == 0;
    if (item->engine == GB_RUN_LIST_NONE) {
        snprintf(text, size, "%s", item->state);
    } else {
        snprintf(text, size, "%s %.0f %%",
                 paused ? item->state : gb_run_list_engine_word(item->engine),
                 floor(100.0 * item->progress));
    }
}

char *gb_run_list_size_text(int64_t bytes)
{
    char *size = g_format_size((guint64)bytes);
    char **parts = g_strsplit(size, "\u00a0", 2); /* no-break space */
    char *text = g_strjoinv(" ", parts);
    g_strfreev(parts);
    g_free(size);
    return text;
}

/* "11-25 23:58", or "2025-11-25" in another year; g_free. */
static char *date_text(int64_t seconds)
{
    GDateTime *time = g_date_time_new_from_unix_local(seconds);
    GDateTime *now = g_date_time_new_now_local();
    const bool known = time != NULL && now != NULL;
    char *text = !known ? g_strdup("-")
                        : g_date_time_format(time, g_date_time_get_year(time) ==
                                                           g_date_time_get_year(now)
                                                       ? "%m-%d %H:%M"
                                                       : "%Y-%m-%d");
    g_clear_pointer(&time, g_date_time_unref);
    g_clear_pointer(&now, g_date_time_unref);
    return text;
}

static char *join(enum gb_run_list_extent extent, const char *state, const char *density,
                  const char *pressure, const char *size, const char *date)
{
    return extent == GB_RUN_LIST_LINE_ALL
               ? g_strdup_printf("%-*s  %7s  %8s  %8s  %s", STATE_COLS, state, density,
                                 pressure, size, date)
               : g_strdup_printf("%-*s  %8s  %s", STATE_COLS, state, size, date);
}

char *gb_run_list_line(const struct gb_run_list_item *item,
                       enum gb_run_list_extent extent)
{
    char state[48];
    char density[16] = "-";
    char pressure[32] = "-";
    char *date = date_text(item->modified_s);
    char *size = gb_run_list_size_text(item->bytes);
    write_state(item, state, sizeof state);
    if (isfinite(item->density)) {
        snprintf(density, sizeof density, "%.4f", item->density);
    }
    if (isfinite(item->pressure_pa)) {
        gb_units_format_short(item->pressure_pa, GB_DIM_PRESSURE, 3, pressure,
                              sizeof pressure);
    }
    char *line = join(extent, state, density, pressure, size, date);
    g_free(size);
    g_free(date);
    return line;
}

char *gb_run_list_line_head(enum gb_run_list_extent extent)
{
    return join(extent, "state", "density", "pressure", "size", "date");
}

/* Deletion uses file descriptors, so that a link created meanwhile cannot lead out of
 * the run.
 *
 * Calls visit for each entry of the directory `name` in `parent`.  False: visit failed,
 * or the directory cannot be read; see errno. */
static bool for_each_entry(int parent, const char *name,
                           bool (*visit)(int folder, const char *entry, void *data),
                           void *data)
{
    const int fd = openat(parent, name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    DIR *dir = fd >= 0 ? fdopendir(fd) : NULL;
    const struct dirent *entry;
    bool good = dir != NULL;
    if (dir == NULL) {
        const int reason = errno;
        if (fd >= 0) {
            close(fd);
        }
        errno = reason;
        return false;
    }
    while (good && (entry = readdir(dir)) != NULL) {
        if (strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0) {
            good = visit(fd, entry->d_name, data);
        }
    }
    const int reason = errno;
    closedir(dir);
    errno = reason;
    return good;
}

static bool is_directory(int folder, const char *name)
{
    struct stat info;
    return fstatat(folder, name, &info, AT_SYMLINK_NOFOLLOW) == 0 &&
           S_ISDIR(info.st_mode);
}

static bool remove_entry(int folder, const char *name, void *data)
{
    if (is_directory(folder, name)) {
        return for_each_entry(folder, name, remove_entry, data) &&
               unlinkat(folder, name, AT_REMOVEDIR) == 0;
    }
    return unlinkat(folder, name, 0) == 0;
}

static bool count_entry(int folder, const char *name, void *data)
{
    if (is_directory(folder, name)) {
        return for_each_entry(folder, name, count_entry, data);
    }
    *(int *)data += strcmp(name, ".lock") != 0; /* .lock is not a file of the run */
    return true;
}

int gb_run_list_count_files(const char *directory)
{
    int count = 0;
    (void)for_each_entry(AT_FDCWD, directory, count_entry, &count);
    return count;
}

bool gb_run_list_delete(const char *directory, struct gb_error *err)
{
    struct gb_rundir dir;
    if (!gb_rundir_open(&dir, directory, err)) {
        return false;
    }
    const bool good =
        for_each_entry(AT_FDCWD, directory, remove_entry, NULL) && rmdir(directory) == 0;
    const int reason = errno;
    gb_rundir_finish(&dir);
    return good || gb_error_set(err, GB_ERR_MACHINE, "%.300s: cannot be removed: %s",
                                directory, strerror(reason));
}
