#include "run/record/live_export.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <sys/stat.h>
#include <unistd.h>

#include <glib.h>

#include "base/file.h"

enum { PARTICLES, CONTACTS, FILES };

static const char *const tails[FILES] = {"", "-contacts"};

void gb_live_export_init(struct gb_live_export *live, const struct gb_params *params)
{
    *live = (struct gb_live_export){.density_kg_m3 = params->density_kg_m3,
                                    .extent.format = params->export_format,
                                    .fd = {-1, -1}};
    if (params->export_format != GB_LIVE_NONE) {
        live->format = gb_export_at((size_t)params->export_format - 1);
    }
}

void gb_live_export_finish(struct gb_live_export *live)
{
    for (int k = 0; k < FILES; k++) {
        if (live->fd[k] >= 0) {
            close(live->fd[k]);
        }
        live->fd[k] = -1;
    }
}

static char *file_name(const struct gb_live_export *live, const char *name, int which)
{
    return g_strdup_printf("%s%s.%s", name, tails[which],
                           which == CONTACTS ? live->format->contacts
                                             : live->format->name);
}

/* What is told of a file: its name and the reason. */
static void tell(struct gb_live_export *live, const char *name, int which,
                 const char *reason)
{
    char *file = file_name(live, name, which);
    snprintf(live->told, sizeof live->told,
             "output.export: %s: %s: left out, the run continues", file, reason);
    g_free(file);
}

/* Opens a file of the trajectory and cuts it to what is known of it. */
static bool open_file(struct gb_live_export *live, const char *directory, int which)
{
    char *name = file_name(live, "trajectory", which);
    char *path = g_build_filename(directory, name, NULL);
    const off_t length = (off_t)live->extent.bytes[which];
    struct stat info;
    const int fd =
        open(path, O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0666);
    g_free(path);
    g_free(name);
    if (fd < 0 || fstat(fd, &info) != 0) {
        tell(live, "trajectory", which, g_strerror(errno));
    } else if (!S_ISREG(info.st_mode)) {
        tell(live, "trajectory", which, "is not a regular file");
    } else if (info.st_size < length) {
        tell(live, "trajectory", which, "is shorter than the checkpoint left it");
    } else if (ftruncate(fd, length) != 0) {
        tell(live, "trajectory", which, g_strerror(errno));
    } else {
        live->fd[which] = fd;
        return true;
    }
    if (fd >= 0) {
        close(fd);
    }
    return false;
}

static bool open_files(struct gb_live_export *live, const char *directory)
{
    bool good = true;
    for (int k = 0; k < FILES && good; k++) {
        good = live->fd[k] >= 0 || open_file(live, directory, k);
    }
    return good;
}

void gb_live_export_resume(struct gb_live_export *live, const char *directory,
                           const struct gb_live_extent *extent)
{
    if (live->format == NULL || !live->format->trajectory) {
        return;
    }
    if (extent->format == live->extent.format) {
        live->extent = *extent;
    }
    if (!open_files(live, directory)) {
        gb_live_export_finish(live);
        live->format = NULL;
    }
}

/* Both texts of a state; false where there is no memory. */
static bool write_texts(struct gb_live_export *live, const struct gb_state *state,
                        GString *text[FILES])
{
    struct gb_error err = {0};
    const bool good =
        gb_export_add(live->format, state, live->density_kg_m3, live->extent.frames,
                      text[PARTICLES], text[CONTACTS], &err);
    if (!good) {
        tell(live, "trajectory", PARTICLES, err.text);
    }
    return good;
}

/* Both files have the frame, or neither. */
static void append(struct gb_live_export *live, GString *const text[FILES])
{
    for (int k = 0; k < FILES; k++) {
        const off_t length = (off_t)live->extent.bytes[k];
        if (!gb_file_append_at(live->fd[k], length, text[k]->str, text[k]->len) ||
            fsync(live->fd[k]) != 0) {
            tell(live, "trajectory", k, g_strerror(errno));
            for (int back = 0; back <= k; back++) {
                (void)!ftruncate(live->fd[back], (off_t)live->extent.bytes[back]);
            }
            return;
        }
    }
    for (int k = 0; k < FILES; k++) {
        live->extent.bytes[k] += (int64_t)text[k]->len;
    }
    live->extent.frames++;
}

static void free_texts(GString *text[FILES])
{
    for (int k = 0; k < FILES; k++) {
        g_string_free(text[k], TRUE);
    }
}

void gb_live_export_frame(struct gb_live_export *live, const char *directory,
                          const struct gb_state *state)
{
    if (live->format == NULL || !live->format->trajectory ||
        !open_files(live, directory)) {
        return;
    }
    GString *text[FILES] = {g_string_new(NULL), g_string_new(NULL)};
    if (write_texts(live, state, text)) {
        append(live, text);
    }
    free_texts(text);
}

static void write_file(struct gb_live_export *live, const char *directory,
                       const char *name, int which, const GString *text)
{
    struct gb_error err = {0};
    char *file = file_name(live, name, which);
    char *path = g_build_filename(directory, "snapshots", file, NULL);
    if (!gb_file_replace(path, text->str, text->len, &err)) {
        snprintf(live->told, sizeof live->told,
                 "output.export: %.400s: left out, the run continues", err.text);
    }
    g_free(path);
    g_free(file);
}

void gb_live_export_files(struct gb_live_export *live, const char *directory,
                          const struct gb_kept_names *names, const struct gb_state *state)
{
    if (live->format == NULL || live->format->trajectory) {
        return;
    }
    GString *text[FILES] = {g_string_new(NULL), g_string_new(NULL)};
    const bool good = write_texts(live, state, text);
    for (int i = 0; good && i < names->count; i++) {
        for (int k = 0; k < FILES; k++) {
            write_file(live, directory, names->name[i], k, text[k]);
        }
    }
    free_texts(text);
}

bool gb_live_export_told(struct gb_live_export *live, char *text, size_t size)
{
    const bool told = live->told[0] != '\0';
    if (told) {
        g_strlcpy(text, live->told, size);
        live->told[0] = '\0';
    }
    return told;
}
