#ifndef GB_TESTS_PROGRAM_H
#define GB_TESTS_PROGRAM_H

#include <sys/wait.h>

#include <glib.h>

/* The real program as a user calls it. */
struct result {
    int status; /* exit status; -1 after a signal */
    char *out, *err;
};

/* Calls program with words split as by a shell, in folder (NULL: here). */
static inline struct result program_call(const char *program, const char *folder,
                                         const char *words)
{
    struct result result = {0};
    char **arguments = NULL;
    char *line = g_strconcat("greenbody ", words, NULL);
    g_assert_true(g_shell_parse_argv(line, NULL, &arguments, NULL));
    g_free(arguments[0]);
    arguments[0] = g_strdup(program);
    int wait = 0;
    g_assert_true(g_spawn_sync(folder, arguments, NULL, G_SPAWN_STDIN_FROM_DEV_NULL, NULL,
                               NULL, &result.out, &result.err, &wait, NULL));
    result.status = WIFEXITED(wait) ? WEXITSTATUS(wait) : -1;
    g_strfreev(arguments);
    g_free(line);
    return result;
}

static inline void program_finish(struct result *result)
{
    g_free(result->out);
    g_free(result->err);
}

#endif
