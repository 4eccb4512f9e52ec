#ifndef GB_TUI_LEGS_LEG_LIST_H
#define GB_TUI_LEGS_LEG_LIST_H

#include <glib.h>

#include "scene/path/path.h"

/* The legs of a loading path under edit, one text each, with what is wrong with them. */

enum { GB_LEG_LIST_MAX = 64 }; /* more than a path takes: the surplus is an error */

struct gb_leg_list {
    GPtrArray *text;            /* char *; owned */
    GPtrArray *former;          /* joined texts before each change, for undo; owned */
    int dimension;              /* of the scene */
    struct gb_path path;        /* the good legs */
    int index[GB_LEG_LIST_MAX]; /* of a text in path; -1: not good */
    struct gb_error error[GB_LEG_LIST_MAX]; /* why not, and what is accepted */
    int errors;
};

void gb_leg_list_init(struct gb_leg_list *list, const char *text, int dimension);
void gb_leg_list_finish(struct gb_leg_list *list); /* zeroed is fine */

int gb_leg_list_count(const struct gb_leg_list *list);
const char *gb_leg_list_at(const struct gb_leg_list *list, int at);
/* The leg at a position; NULL: it is not good. */
const struct gb_leg *gb_leg_list_leg(const struct gb_leg_list *list, int at);
/* The whole path, "isotropic to 50 MPa; unload"; g_free. */
char *gb_leg_list_join(const struct gb_leg_list *list);

/* Changes; each can be undone.  A text with ';' or `then` becomes several legs, an empty
 * one none.  Returns the number of legs put in. */
int gb_leg_list_insert(struct gb_leg_list *list, int at, const char *text);
int gb_leg_list_replace(struct gb_leg_list *list, int at, const char *text);
void gb_leg_list_remove(struct gb_leg_list *list, int at);
/* Exchanges a leg with the next (1) or former (-1); false: there is none. */
bool gb_leg_list_move(struct gb_leg_list *list, int at, int by);
void gb_leg_list_set(struct gb_leg_list *list, const char *text);
/* The list before the last change; false: there was none. */
bool gb_leg_list_undo(struct gb_leg_list *list);

/* What is wrong with a text in place of the leg at a position, or behind the last one;
 * leg: what it says where nothing is. */
bool gb_leg_list_try(const struct gb_leg_list *list, int at, const char *text,
                     struct gb_leg *leg, struct gb_error *err);

#endif
