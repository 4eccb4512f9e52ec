#ifndef GB_BASE_TEXT_TEXT_LIST_H
#define GB_BASE_TEXT_TEXT_LIST_H

#include <stddef.h>

/* Whole words with commas between in newly allocated memory (g_free), as far as they fit into
 * so many bytes without the 0; the other ones are counted at the end: "a, b and 3 more".  ""
 * when none fits. */
char *gb_text_list_join(char *const *words, size_t bytes);

#endif
