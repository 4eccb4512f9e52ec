#include "tui/legs/leg_list.h"

/* Reads every text anew: what a leg means may follow from those in front of it. */
static void read_legs(struct gb_leg_list *list)
{
    list->path.count = 0;
    list->errors = 0;
    for (int i = 0; i < gb_leg_list_count(list); i++) {
        list->error[i] = (struct gb_error){0};
        const bool good = gb_path_parse_leg(&list->path, gb_leg_list_at(list, i),
                                            list->dimension, &list->error[i]);
        list->index[i] = good ? list->path.count - 1 : -1;
        list->errors += !good;
    }
}

static int put(struct gb_leg_list *list, int at, const char *text)
{
    char **legs = gb_path_parse_split(text);
    int count = 0;
    for (; legs[count] != NULL; count++) {
        if (legs[count][0] != '\0' && list->text->len < GB_LEG_LIST_MAX) {
            g_ptr_array_insert(list->text, at + count, g_strdup(legs[count]));
        }
    }
    g_strfreev(legs);
    return count;
}

void gb_leg_list_init(struct gb_leg_list *list, const char *text, int dimension)
{
    *list = (struct gb_leg_list){.text = g_ptr_array_new_with_free_func(g_free),
                                 .former = g_ptr_array_new_with_free_func(g_free),
                                 .dimension = dimension};
    put(list, 0, text);
    read_legs(list);
}

void gb_leg_list_finish(struct gb_leg_list *list)
{
    if (list->text != NULL) {
        g_ptr_array_unref(list->text);
        g_ptr_array_unref(list->former);
    }
    *list = (struct gb_leg_list){0};
}

int gb_leg_list_count(const struct gb_leg_list *list)
{
    return (int)list->text->len;
}

const char *gb_leg_list_at(const struct gb_leg_list *list, int at)
{
    return g_ptr_array_index(list->text, at);
}

const struct gb_leg *gb_leg_list_leg(const struct gb_leg_list *list, int at)
{
    return at < gb_leg_list_count(list) && list->index[at] >= 0
               ? &list->path.leg[list->index[at]]
               : NULL;
}

char *gb_leg_list_join(const struct gb_leg_list *list)
{
    GString *all = g_string_new(NULL);
    for (int i = 0; i < gb_leg_list_count(list); i++) {
        g_string_append_printf(all, "%s%s", i > 0 ? "; " : "", gb_leg_list_at(list, i));
    }
    return g_string_free(all, FALSE);
}

static void remember(struct gb_leg_list *list)
{
    g_ptr_array_add(list->former, gb_leg_list_join(list));
}

int gb_leg_list_insert(struct gb_leg_list *list, int at, const char *text)
{
    remember(list);
    const int count = put(list, at, text);
    read_legs(list);
    return count;
}

int gb_leg_list_replace(struct gb_leg_list *list, int at, const char *text)
{
    remember(list);
    g_ptr_array_remove_index(list->text, (guint)at);
    const int count = put(list, at, text);
    read_legs(list);
    return count;
}

void gb_leg_list_remove(struct gb_leg_list *list, int at)
{
    remember(list);
    g_ptr_array_remove_index(list->text, (guint)at);
    read_legs(list);
}

bool gb_leg_list_move(struct gb_leg_list *list, int at, int by)
{
    const int to = at + by;
    if (at < 0 || at >= gb_leg_list_count(list) || to < 0 ||
        to >= gb_leg_list_count(list)) {
        return false;
    }
    remember(list);
    gpointer *text = list->text->pdata;
    gpointer moved = text[at];
    text[at] = text[to];
    text[to] = moved;
    read_legs(list);
    return true;
}

void gb_leg_list_set(struct gb_leg_list *list, const char *text)
{
    remember(list);
    g_ptr_array_set_size(list->text, 0);
    put(list, 0, text);
    read_legs(list);
}

bool gb_leg_list_undo(struct gb_leg_list *list)
{
    if (list->former->len == 0) {
        return false;
    }
    char *text = g_ptr_array_steal_index(list->former, list->former->len - 1);
    g_ptr_array_set_size(list->text, 0);
    put(list, 0, text);
    read_legs(list);
    g_free(text);
    return true;
}

bool gb_leg_list_try(const struct gb_leg_list *list, int at, const char *text,
                     struct gb_leg *leg, struct gb_error *err)
{
    struct gb_path path = {.count = 0};
    char **legs = gb_path_parse_split(text);
    for (int i = 0; i < at; i++) {
        struct gb_error ignored = {0};
        gb_path_parse_leg(&path, gb_leg_list_at(list, i), list->dimension, &ignored);
    }
    bool good = true;
    for (int i = 0; legs[i] != NULL && good; i++) {
        good = gb_path_parse_leg(&path, legs[i], list->dimension, err);
    }
    if (good && path.count > 0) {
        *leg = path.leg[path.count - 1];
    }
    g_strfreev(legs);
    return good;
}
