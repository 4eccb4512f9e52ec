#include "tui/app/dialog/picture_form.h"

#include <stddef.h>
#include <stdio.h>
#include <string.h>

enum { NAME_COLS = 9, CHOICES_MOST = 6 };

/* A choice: what the screen says, and the option of the command; NULL: none. */
struct choice {
    const char *text, *word;
};

struct row {
    const char *name;
    struct choice choice[CHOICES_MOST]; /* the first one is the command's own */
};

static const struct row rows[GB_PICTURE_FORM_CHOICES] = {
    [GB_PICTURE_FORM_SHOW] = {"show",
                              {{"particles", NULL},
                               {"forces", "--show=forces"},
                               {"particles and forces", "--show=both"},
                               {"particles, force rose beside", "--rose"}}},
    [GB_PICTURE_FORM_COLOUR] = {"colour",
                                {{"coordination number", NULL},
                                 {"pressure", "--color=pressure"},
                                 {"bridges", "--color=bridges"},
                                 {"size", "--color=size"}}},
    [GB_PICTURE_FORM_CUT] = {"cut",
                             {{"none", NULL},
                              {"the nearest corner", "--cut=corner"},
                              {"the front half", "--cut=y=0.5"},
                              {"a slice in the middle", "--slice=y=0.5"}}},
    [GB_PICTURE_FORM_VIEW] = {"view",
                              {{"corner", NULL},
                               {"front", "--view=front"},
                               {"side", "--view=side"},
                               {"top", "--view=top"}}},
};

/* Colours of forces alone. */
static const struct row force_colours = {"colour",
                                         {{"compressive or tensile", NULL},
                                          {"bridged or not", "--color=bridged"}}};

static const struct row *row_at(const struct gb_picture_form *form, int row)
{
    const bool forces = form->choice[GB_PICTURE_FORM_SHOW] == 1;
    return row == GB_PICTURE_FORM_COLOUR && forces ? &force_colours : &rows[row];
}

static int count_of(const struct row *row)
{
    int count = 0;
    while (count < CHOICES_MOST && row->choice[count].text != NULL) {
        count++;
    }
    return count;
}

static const struct choice *chosen(const struct gb_picture_form *form, int row)
{
    return &row_at(form, row)->choice[form->choice[row]];
}

void gb_picture_form_init(struct gb_picture_form *form, const char *path)
{
    *form = (struct gb_picture_form){.row = 0};
    gb_prompt_set(&form->file, path);
}

/* The line that a row edits; NULL: a row of choices. */
static struct gb_prompt *line_of(struct gb_picture_form *form, int row)
{
    return row == GB_PICTURE_FORM_WIDTH  ? &form->width
           : row == GB_PICTURE_FORM_FILE ? &form->file
                                         : NULL;
}

static void draw_width(struct gb_prompt *width, const struct gb_paint *paint, int room)
{
    const char *text = gb_prompt_text(width);
    const bool empty = *text == '\0';
    gb_paint_cell(paint, GB_PICTURE_FORM_WIDTH, NAME_COLS + 2, room,
                  empty ? GB_STYLE_DIM : GB_STYLE_PLAIN,
                  empty ? "for a screen; 8cm, elsevier: in print" : text);
}

/* The end of a long path says more than its beginning. */
static void draw_file(struct gb_prompt *file, const struct gb_paint *paint, int room)
{
    char text[64];
    const char *path = gb_prompt_text(file);
    if (gb_paint_width(path) > room && strrchr(path, '/') != NULL) {
        snprintf(text, sizeof text, "\u2026%s", strrchr(path, '/'));
        path = text;
    }
    gb_paint_cell(paint, GB_PICTURE_FORM_FILE, NAME_COLS + 2, room, GB_STYLE_PLAIN, path);
}

void gb_picture_form_draw(const struct gb_picture_form *form,
                          const struct gb_paint *paint)
{
    char text[64];
    struct gb_picture_form shown = *form;
    const int room = paint->rect.cols - NAME_COLS - 1;
    for (int i = 0; i < GB_PICTURE_FORM_CHOICES; i++) {
        const bool here = i == form->row;
        snprintf(text, sizeof text, here ? "< %s >" : "  %s", chosen(form, i)->text);
        gb_paint_cell(paint, i, 1, NAME_COLS, GB_STYLE_DIM, row_at(form, i)->name);
        gb_paint_cell(paint, i, NAME_COLS, room, here ? GB_STYLE_BOLD : GB_STYLE_PLAIN,
                      text);
    }
    gb_paint_cell(paint, GB_PICTURE_FORM_WIDTH, 1, NAME_COLS, GB_STYLE_DIM, "width");
    gb_paint_cell(paint, GB_PICTURE_FORM_FILE, 1, NAME_COLS, GB_STYLE_DIM, "file");
    draw_width(&shown.width, paint, room - 2);
    draw_file(&shown.file, paint, room - 2);
    const struct gb_prompt *line = line_of(&shown, form->row);
    if (line != NULL) {
        gb_prompt_draw(line, paint, form->row, NAME_COLS + 2, room - 2);
    }
}

static void change(struct gb_picture_form *form, int by)
{
    const int row = form->row;
    const int count = count_of(row_at(form, row));
    form->choice[row] = (form->choice[row] + count + by) % count;
    if (row == GB_PICTURE_FORM_SHOW) { /* its colours are others */
        form->choice[GB_PICTURE_FORM_COLOUR] = 0;
    }
}

bool gb_picture_form_handle(struct gb_picture_form *form,
                            const struct gb_term_event *event, enum gb_action action)
{
    struct gb_prompt *line = line_of(form, form->row);
    if (line != NULL && gb_prompt_handle(line, event)) {
        return true;
    }
    if (line != NULL && event->kind == GB_TERM_TEXT) {
        return false;
    }
    switch (action) {
    case GB_ACTION_UP:
        form->row = (form->row + GB_PICTURE_FORM_ROWS - 1) % GB_PICTURE_FORM_ROWS;
        return true;
    case GB_ACTION_DOWN:
        form->row = (form->row + 1) % GB_PICTURE_FORM_ROWS;
        return true;
    case GB_ACTION_LEFT:
    case GB_ACTION_RIGHT:
        if (line == NULL) {
            change(form, action == GB_ACTION_LEFT ? -1 : 1);
        }
        return true;
    default:
        return false;
    }
}

void gb_picture_form_words(struct gb_picture_form *form,
                           const char *words[GB_PICTURE_FORM_WORDS + 1])
{
    int count = 0;
    for (int i = 0; i < GB_PICTURE_FORM_CHOICES; i++) {
        if (chosen(form, i)->word != NULL) {
            words[count++] = chosen(form, i)->word;
        }
    }
    if (*gb_prompt_text(&form->width) != '\0') {
        words[count++] = "--width";
        words[count++] = gb_prompt_text(&form->width);
    }
    words[count] = NULL;
}
