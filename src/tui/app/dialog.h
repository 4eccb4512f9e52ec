#ifndef GB_TUI_APP_DIALOG_H
#define GB_TUI_APP_DIALOG_H

#include "greenbody/params.h"
#include "tui/app/keys.h"
#include "tui/app/leg_editor.h"
#include "tui/app/preset_browser.h"
#include "tui/panel/list_box.h"
#include "tui/panel/prompt.h"
#include "tui/session/session.h"
#include "tui/term/paint.h"
#include "tui/term/pixels.h"

struct gb_param_finder {
    struct gb_list_box list; /* rows of the field table */
    struct gb_params params; /* values to show */
};

/* Row of the field table of the selected parameter; -1: nothing matches. */
int gb_dialog_found(const struct gb_param_finder *finder);

/* The run and the previous curves, one line each, with their densities at a pressure. */
struct gb_curve_list {
    struct gb_list_box box;
    bool naming; /* the name of the focused curve is being typed */
    struct gb_prompt prompt;
    double pressure_pa; /* pressure of the densities */
};

enum { GB_CURVE_LIST_RUN = -1, GB_CURVE_LIST_NONE = -2 };

/* Index of the focused previous curve, or one of these. */
int gb_dialog_curve(struct gb_curve_list *list, const struct gb_session *session);

struct gb_dialog;
struct gb_session;

enum gb_dialog_result {
    GB_DIALOG_OPEN,     /* incomplete */
    GB_DIALOG_ACCEPTED, /* Enter or y; gb_dialog_answer has the answer */
    GB_DIALOG_CANCELLED /* Esc, or n: closed */
};

/* Functions that draw one kind of dialog and handle its keys (dialog.c). */
struct gb_dialog_form {
    void (*draw)(struct gb_dialog *dialog, const struct gb_paint *screen);
    /* Handles an event as input; false: the keys below apply. */
    bool (*edit)(struct gb_dialog *dialog, const struct gb_term_event *event);
    enum gb_dialog_result (*key)(struct gb_dialog *dialog, int code);
};

/* One row for each dialog (dialogs.c). */
struct gb_dialog_type {
    const struct gb_dialog_form *form;
    const char *title;
    const char *label;    /* of the input line */
    const char *yes, *no; /* answers of a question */
    bool completes_path;  /* Tab completes a path */
    int scope;            /* bit of the table keys that are valid in it; 0: none */
    void (*opened_by)(struct gb_app *app,
                      const struct gb_key *key); /* its key closes the dialog, too */
    char *(*copied)(struct gb_app *app); /* what y copies, g_free; NULL: nothing */
    /* Handles a key before the form does; NULL: none. */
    bool (*press)(struct gb_app *app, const struct gb_term_event *event);
    void (*accept)(struct gb_app *app);
    void (*decline)(struct gb_app *app); /* NULL: only closes */
};

/* Choices for a picture of the packing, its width in print and its file.  At first they
 * are the defaults of `greenbody snapshot`. */
enum {
    GB_PICTURE_FORM_SHOW,
    GB_PICTURE_FORM_COLOUR,
    GB_PICTURE_FORM_CUT,
    GB_PICTURE_FORM_VIEW,
    GB_PICTURE_FORM_CHOICES,
    GB_PICTURE_FORM_WIDTH = GB_PICTURE_FORM_CHOICES,
    GB_PICTURE_FORM_FILE,
    GB_PICTURE_FORM_ROWS
};

struct gb_picture_form {
    int row;
    int choice[GB_PICTURE_FORM_CHOICES];
    struct gb_prompt width; /* as 8cm; empty: pixels of a screen */
    struct gb_prompt file;
};

enum gb_dialog_note { GB_DIALOG_NOTE_ERROR, GB_DIALOG_NOTE_WARNING };

/* The dialog over the panes; at most one is open: help, list of presets, input line,
 * shell command, question, ... */
struct gb_dialog {
    const struct gb_dialog_type *type; /* NULL: none is open */
    int top, focus, page; /* first line, focused line and lines per page of a list */
    struct gb_preset_browser browser; /* list of presets or materials */
    struct gb_leg_editor legs;
    struct gb_picture_form picture;
    struct gb_curve_list curves;
    struct gb_param_finder finder;
    struct gb_help_list help;
    struct gb_session *session;  /* data of densities, results and curves */
    struct gb_png_pixels pixels; /* shown in pixels; owned */
    struct gb_rect field;        /* its cells on the screen */
    bool hide_previous;          /* in the table of densities */
    char *text;                  /* shell command shown, or file asked about; owned */
    char note[480];              /* question, or why the last answer was refused */
    const char *other; /* a third answer of a question, its key first; NULL: none */
    enum gb_dialog_note kind; /* after a warning the same answer is accepted */
    struct gb_prompt prompt;
};

/* text: initial contents of the line, or the question or command; may be NULL. */
void gb_dialog_show(struct gb_dialog *dialog, const struct gb_dialog_type *type,
                    const char *text);
/* The list of presets or materials, compared with the parameters `current`. */
void gb_dialog_show_presets(struct gb_dialog *dialog, const struct gb_dialog_type *type,
                            const struct gb_preset_browser_kind *kind,
                            const struct gb_params *current);
/* Opens the editor of the loading path of these parameters. */
void gb_dialog_show_legs(struct gb_dialog *dialog, const struct gb_dialog_type *type,
                         const struct gb_params *params, enum gb_plot_glyphs glyphs);
/* Opens the search for a parameter; shows the values of `params`. */
void gb_dialog_show_finder(struct gb_dialog *dialog, const struct gb_dialog_type *type,
                           const struct gb_params *params);
/* Opens the table of densities, which each frame updates. */
void gb_dialog_show_densities(struct gb_dialog *dialog, const struct gb_dialog_type *type,
                              struct gb_session *session, bool hide_previous);
/* Opens the form of a picture, which is written to `path` unless another file is typed.
 */
void gb_dialog_show_picture(struct gb_dialog *dialog, const struct gb_dialog_type *type,
                            const char *path);
/* The results of the session, the newest first. */
void gb_dialog_show_results(struct gb_dialog *dialog, const struct gb_dialog_type *type,
                            struct gb_session *session);
/* Shows a picture, which the dialog owns from now on, with the path below it. */
void gb_dialog_show_pixels(struct gb_dialog *dialog, const struct gb_dialog_type *type,
                           const struct gb_png_pixels *picture, const char *path);
/* Opens the list of curves with their densities at `typed_pa`, or the usual pressure. */
void gb_dialog_show_curves(struct gb_dialog *dialog, const struct gb_dialog_type *type,
                           struct gb_session *session, double typed_pa);
void gb_dialog_close(struct gb_dialog *dialog);

void gb_dialog_draw(struct gb_dialog *dialog, const struct gb_paint *screen);

/* Do keys of the key table apply?  Not while something is typed. */
bool gb_dialog_takes_keys(const struct gb_dialog *dialog);

enum gb_dialog_result gb_dialog_handle(struct gb_dialog *dialog,
                                       const struct gb_term_event *event);

/* The selected preset or material, or the text of the line. */
const char *gb_dialog_answer(struct gb_dialog *dialog);

void gb_dialog_set_note(struct gb_dialog *dialog, enum gb_dialog_note kind,
                        const char *format, ...) __attribute__((format(printf, 3, 4)));

/* The kinds of dialogs. */
extern const struct gb_dialog_form gb_dialog_forms_help; /* the key table */

extern const struct gb_dialog_form gb_dialog_forms_densities; /* the table */

extern const struct gb_dialog_form gb_dialog_forms_curves; /* run and previous ones */

extern const struct gb_dialog_form gb_dialog_forms_presets; /* list with a preview */

extern const struct gb_dialog_form gb_dialog_forms_finder; /* search of a parameter */

extern const struct gb_dialog_form gb_dialog_forms_legs; /* legs of a loading path */

extern const struct gb_dialog_form gb_dialog_forms_prompt; /* input line */

extern const struct gb_dialog_form gb_dialog_forms_picture; /* rows of choices */

extern const struct gb_dialog_form gb_dialog_forms_command; /* shell command */

extern const struct gb_dialog_form gb_dialog_forms_question; /* y or n */

extern const struct gb_dialog_form gb_dialog_forms_cards; /* dialog.c: cards */

extern const struct gb_dialog_form gb_dialog_forms_pixels; /* pixels */

/* Options for the command: at most GB_PICTURE_FORM_WORDS, NULL after the last; valid
 * until the form changes. */
enum { GB_PICTURE_FORM_WORDS = GB_PICTURE_FORM_CHOICES + 2 };

void gb_dialog_words(struct gb_picture_form *form,
                     const char *words[GB_PICTURE_FORM_WORDS + 1]);

#endif
