#include "cli/moduli_folder.h"

#include <errno.h>
#include <string.h>

#include <glib/gstdio.h>

#include "base/file.h"

void gb_moduli_folder_init(struct gb_moduli_folder *folder, const char *path,
                           const char *command)
{
    *folder = (struct gb_moduli_folder){
        path, command, g_array_new(FALSE, TRUE, sizeof(struct gb_moduli_state))};
}

void gb_moduli_folder_finish(struct gb_moduli_folder *folder)
{
    g_array_free(folder->earlier, TRUE);
}

static bool exists(const struct gb_moduli_folder *folder, const char *name)
{
    char *path = g_build_filename(folder->path, name, NULL);
    const bool found = g_file_test(path, G_FILE_TEST_EXISTS);
    g_free(path);
    return found;
}

static bool make(const struct gb_moduli_folder *folder, struct gb_error *err)
{
    return g_mkdir_with_parents(folder->path, 0777) == 0 ||
           gb_error_set(err, GB_ERR_MACHINE, "--out %.300s: cannot be made: %s",
                        folder->path, g_strerror(errno));
}

bool gb_moduli_folder_begin(const struct gb_moduli_folder *folder,
                            struct gb_preset *preset, struct gb_error *err)
{
    static const char *const names[] = {GB_MODULI_STATES_FILE, "preset.ini"};
    if (folder->path == NULL) {
        return true;
    }
    for (size_t k = 0; k < G_N_ELEMENTS(names); k++) {
        if (exists(folder, names[k])) {
            return gb_error_set(err, GB_ERR_INPUT,
                                "--out %.300s: holds %s already; choose another folder",
                                folder->path, names[k]);
        }
    }
    char *path = g_build_filename(folder->path, "preset.ini", NULL);
    const bool good =
        make(folder, err) && gb_preset_save(preset, path, GB_PRESET_ALL_KEYS, err);
    g_free(path);
    return good;
}

bool gb_moduli_folder_open(struct gb_moduli_folder *folder, const char *directory,
                           struct gb_error *err)
{
    if (folder->path == NULL) {
        return true;
    }
    char *path = g_build_filename(folder->path, GB_MODULI_STATES_FILE, NULL);
    bool good = make(folder, err);
    if (good && g_file_test(path, G_FILE_TEST_EXISTS)) {
        good = gb_file_is_same(directory, folder->path)
                   ? gb_moduli_states_read(folder->earlier, path, err)
                   : gb_error_set(err, GB_ERR_INPUT,
                                  "--out %.300s: holds %s already; choose another folder",
                                  folder->path, GB_MODULI_STATES_FILE);
    }
    good = good && gb_file_check_target(path, err);
    g_free(path);
    return good;
}

bool gb_moduli_folder_write(const struct gb_moduli_folder *folder, const GArray *states,
                            struct gb_error *err)
{
    if (folder->path == NULL) {
        return true;
    }
    GArray *all = g_array_new(FALSE, FALSE, sizeof(struct gb_moduli_state));
    g_array_append_vals(all, folder->earlier->data, folder->earlier->len);
    g_array_append_vals(all, states->data, states->len);
    gb_moduli_states_sort(all);
    char *comment = g_strdup_printf("greenbody %s\n%s", GB_VERSION, folder->command);
    char *path = g_build_filename(folder->path, GB_MODULI_STATES_FILE, NULL);
    GString *text = gb_moduli_states_csv(all, comment);
    const bool good = gb_file_replace(path, text->str, text->len, err);
    g_string_free(text, TRUE);
    g_free(path);
    g_free(comment);
    g_array_free(all, TRUE);
    return good;
}
