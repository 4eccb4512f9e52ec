#define _GNU_SOURCE /* dladdr */

#include "base/program.h"

#include <dlfcn.h>
#include <sys/prctl.h>

#include <glib.h>

static const char running_file[] = "/proc/self/exe";

char *gb_program_folder(void)
{
    char *file = g_file_read_link(running_file, NULL);
    char *folder = file != NULL ? g_path_get_dirname(file) : NULL;
    g_free(file);
    return folder;
}

char *gb_program_library_folder(void)
{
    Dl_info info;
    static const char here = 0;
    if (dladdr(&here, &info) == 0 || info.dli_fname == NULL) {
        return NULL;
    }
    char *file = g_canonicalize_filename(info.dli_fname, NULL);
    char *folder = g_path_get_dirname(file);
    g_free(file);
    return folder;
}

char *gb_program_executable(void)
{
    char *folder = gb_program_folder();
    char *launcher = g_build_filename(folder != NULL ? folder : "/", "launcher", NULL);
    g_free(folder);
    if (g_file_test(launcher, G_FILE_TEST_IS_EXECUTABLE)) {
        return launcher;
    }
    g_free(launcher);
    return g_strdup(running_file);
}

void gb_program_name_process(void)
{
    (void)prctl(PR_SET_NAME, "greenbody");
}
