#ifndef GB_TESTS_TREE_H
#define GB_TESTS_TREE_H

#include <glib.h>

/* Removes a folder with all that it holds. */
static inline void remove_tree(char *path)
{
    char rm[] = "rm", all[] = "-rf";
    char *command[] = {rm, all, path, NULL};
    g_spawn_sync(NULL, command, NULL, G_SPAWN_SEARCH_PATH, NULL, NULL, NULL, NULL, NULL,
                 NULL);
}

#endif
