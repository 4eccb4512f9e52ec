/* Starts the program of a bundle by the bundle's own loader and libraries, whatever the
 * system has: a static program, bin/greenbody of the bundle and libexec/launcher.
 *
 *   bin/greenbody          this
 *   libexec/greenbody      the loader, under the name that ps and pgrep show
 *   libexec/greenbody.bin  the program
 *   lib/                   its libraries
 *   share/                 presets, data, fonts, terminal descriptions, character sets
 */
#define _GNU_SOURCE /* strcasestr */

#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { LOADER_WORDS = 6, STATUS_MACHINE = 3 };

static int fail(const char *what)
{
    fprintf(stderr, "greenbody: %s: %s\n", what, strerror(errno));
    return STATUS_MACHINE;
}

/* root becomes the folder two levels above the running file. */
static int find_root(char *root, size_t size)
{
    const ssize_t length = readlink("/proc/self/exe", root, size - 1);
    if (length < 0) {
        return -1;
    }
    root[length] = '\0';
    for (int up = 0; up < 2; up++) {
        char *slash = strrchr(root, '/');
        if (slash == NULL) {
            errno = ENOENT;
            return -1;
        }
        *slash = '\0';
    }
    return 0;
}

/* ROOT/name, and behind it more; for the whole life of the process. */
static char *below(const char *root, const char *name, const char *more)
{
    const size_t size = strlen(root) + strlen(name) + strlen(more) + 2;
    char *path = malloc(size);
    if (path != NULL) {
        snprintf(path, size, "%s/%s%s", root, name, more);
    }
    return path;
}

/* Variables that the user has set stay. */
static void give(const char *name, const char *value)
{
    if (value != NULL) {
        (void)setenv(name, value, 0);
    }
}

/* The bundle has one locale, for UTF-8: names of files and the screen need no other. */
static void give_locale(const char *root)
{
    static const char *const names[] = {"LC_ALL", "LC_CTYPE", "LANG"};
    const char *value = "";
    for (size_t k = 0; k < sizeof names / sizeof names[0] && *value == '\0'; k++) {
        const char *given = getenv(names[k]);
        value = given != NULL ? given : "";
    }
    if (strcasestr(value, "utf-8") != NULL || strcasestr(value, "utf8") != NULL) {
        give("LOCPATH", below(root, "lib/locale", ""));
        (void)setenv("LC_ALL", "C.UTF-8", 1);
    }
}

int main(int argc, char **argv)
{
    char root[PATH_MAX];
    if (find_root(root, sizeof root) != 0) {
        return fail("/proc/self/exe");
    }
    give("FONTCONFIG_FILE", below(root, "share/fonts/fonts.conf", ""));
    give_locale(root);
    give("GCONV_PATH", below(root, "lib/gconv", ""));
    give("TERMINFO_DIRS", below(root, "share/terminfo",
                                ":/etc/terminfo:/lib/terminfo:/usr/share/terminfo"));
    char **words = calloc((size_t)argc + LOADER_WORDS + 1, sizeof *words);
    if (words == NULL) {
        return fail("out of memory");
    }
    char *const loader[LOADER_WORDS] = {
        (char[]){"greenbody"},  (char[]){"--library-path"},
        below(root, "lib", ""), (char[]){"--argv0"},
        (char[]){"greenbody"},  below(root, "libexec/greenbody.bin", "")};
    memcpy(words, loader, sizeof loader);
    for (int k = 1; k < argc; k++) {
        words[LOADER_WORDS + k - 1] = argv[k];
    }
    char *program = below(root, "libexec/greenbody", "");
    if (program == NULL || loader[2] == NULL || loader[5] == NULL) {
        return fail("out of memory");
    }
    execv(program, words);
    return fail(program);
}
