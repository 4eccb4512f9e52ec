#ifndef GB_TUI_APP_HELP_LIST_H
#define GB_TUI_APP_HELP_LIST_H

#include "tui/panel/list_box.h"
#include "tui/term/paint.h"

/* The keys in groups and the glossary (docs/glossary.md), as far as they contain the words
 * that are typed. */

struct gb_help_list {
    struct gb_list_box box;
};

void gb_help_list_init(struct gb_help_list *list);

/* Typing filters; false: another key. */
bool gb_help_list_handle(struct gb_help_list *list, const struct gb_term_event *event);

/* Draws the lines that are in view. */
void gb_help_list_draw(struct gb_help_list *list, const struct gb_paint *paint);

/* Entries of the glossary; the word is NULL in a heading. */
struct gb_help_word {
    const char *word, *meaning;
};
const struct gb_help_word *gb_help_list_words(size_t *count);

#endif
