#include "tui/legs/leg_editor.h"

#include <string.h>

#include "tui/app/keys.h"

void gb_leg_editor_init(struct gb_leg_editor *editor, const char *text, int dimension,
                        enum gb_plot_glyphs glyphs)
{
    *editor = (struct gb_leg_editor){.glyphs = glyphs};
    gb_leg_list_init(&editor->list, text, dimension);
    gb_plot_init(&editor->plot);
}

void gb_leg_editor_finish(struct gb_leg_editor *editor)
{
    gb_leg_list_finish(&editor->list);
    gb_plot_finish(&editor->plot);
}

/* The focus is on a leg, or on the line below the last one. */
static void go_to(struct gb_leg_editor *editor, int to)
{
    editor->focus = CLAMP(to, 0, gb_leg_list_count(&editor->list));
}

static bool on_leg(const struct gb_leg_editor *editor)
{
    return editor->focus < gb_leg_list_count(&editor->list);
}

void gb_leg_editor_go(struct gb_leg_editor *editor, int by)
{
    go_to(editor, CLAMP(by, -GB_LEG_LIST_MAX, GB_LEG_LIST_MAX) + editor->focus);
}

static void begin(struct gb_leg_editor *editor, enum gb_leg_editor_typing typing,
                  const char *text)
{
    editor->typing = typing;
    editor->offer = 0;
    gb_prompt_set(&editor->prompt, text);
}

void gb_leg_editor_change(struct gb_leg_editor *editor)
{
    begin(editor, on_leg(editor) ? GB_LEG_EDITOR_CHANGE : GB_LEG_EDITOR_INSERT,
          on_leg(editor) ? gb_leg_list_at(&editor->list, editor->focus) : "");
}

void gb_leg_editor_insert(struct gb_leg_editor *editor, int behind)
{
    go_to(editor, editor->focus + behind);
    begin(editor, GB_LEG_EDITOR_INSERT, "");
}

void gb_leg_editor_whole(struct gb_leg_editor *editor)
{
    char *text = gb_leg_list_join(&editor->list);
    begin(editor, GB_LEG_EDITOR_WHOLE, text);
    g_free(text);
}

void gb_leg_editor_delete(struct gb_leg_editor *editor)
{
    if (on_leg(editor)) {
        gb_leg_list_remove(&editor->list, editor->focus);
        go_to(editor, editor->focus);
    }
}

void gb_leg_editor_move(struct gb_leg_editor *editor, int by)
{
    if (gb_leg_list_move(&editor->list, editor->focus, by)) {
        go_to(editor, editor->focus + by);
    }
}

void gb_leg_editor_undo(struct gb_leg_editor *editor)
{
    gb_leg_list_undo(&editor->list);
    go_to(editor, editor->focus);
}

/* "shear" fits "sh", and "shear xz to" too. */
static bool fits(const char *usage, const char *typed)
{
    const size_t word = strcspn(usage, " ");
    const size_t length = strcspn(typed, " ");
    return strncmp(usage, typed, length) == 0 &&
           (length == word || (length < word && typed[length] == '\0'));
}

bool gb_leg_editor_offer(struct gb_leg_editor *editor, int index, const char **usage,
                         const char **doc)
{
    const char *typed = gb_prompt_text(&editor->prompt);
    int found = -1;
    for (int i = 0; gb_path_parse_shorthand(i, usage, doc); i++) {
        found += fits(*usage, typed);
        if (found == index) {
            return true;
        }
    }
    return false;
}

static void move_offer(struct gb_leg_editor *editor, int by)
{
    const char *usage, *doc;
    const int to = editor->offer + by;
    if (to >= 0 && gb_leg_editor_offer(editor, to, &usage, &doc)) {
        editor->offer = to;
    }
}

/* Writes the word of the focused shorthand; false: none fits, or it is there. */
static bool complete(struct gb_leg_editor *editor)
{
    const char *usage, *doc;
    const char *typed = gb_prompt_text(&editor->prompt);
    if (strchr(typed, ' ') != NULL ||
        !gb_leg_editor_offer(editor, editor->offer, &usage, &doc) ||
        strcspn(usage, " ") == strlen(typed)) {
        return false;
    }
    char *word = g_strndup(usage, strcspn(usage, " "));
    char *begun = g_strconcat(word, " ", NULL);
    gb_prompt_set(&editor->prompt, begun);
    editor->offer = 0;
    g_free(begun);
    g_free(word);
    return true;
}

static void accept(struct gb_leg_editor *editor)
{
    const char *text = gb_prompt_text(&editor->prompt);
    int count = 0;
    switch (editor->typing) {
    case GB_LEG_EDITOR_CHANGE:
        gb_leg_list_replace(&editor->list, editor->focus, text);
        break;
    case GB_LEG_EDITOR_INSERT:
        count = gb_leg_list_insert(&editor->list, editor->focus, text);
        break;
    default:
        gb_leg_list_set(&editor->list, text);
        break;
    }
    go_to(editor, editor->focus + MAX(count - 1, 0));
    editor->typing = GB_LEG_EDITOR_LIST;
}

/* Without a shorthand nothing is meant: Enter takes the one in focus. */
static void enter(struct gb_leg_editor *editor)
{
    const char *text = gb_prompt_text(&editor->prompt);
    const bool chosen = editor->typing == GB_LEG_EDITOR_INSERT && text[0] == '\0';
    if (!chosen || !complete(editor)) {
        accept(editor);
    }
}

bool gb_leg_editor_type(struct gb_leg_editor *editor, const struct gb_term_event *event)
{
    if (editor->typing == GB_LEG_EDITOR_LIST) {
        return false;
    }
    if (gb_prompt_handle(&editor->prompt, event)) {
        editor->offer = 0;
        return true;
    }
    switch (gb_keys_action(event->code)) {
    case GB_ACTION_UP:
        move_offer(editor, -1);
        break;
    case GB_ACTION_DOWN:
        move_offer(editor, 1);
        break;
    case GB_ACTION_ENTER:
        enter(editor);
        break;
    case GB_ACTION_BACK:
        editor->typing = GB_LEG_EDITOR_LIST;
        break;
    default:
        if (event->code == '\t') {
            complete(editor);
        }
        break;
    }
    return true;
}
