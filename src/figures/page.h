#ifndef GB_FIGURES_REPORT_PAGE_H
#define GB_FIGURES_REPORT_PAGE_H

#include <glib.h>

/* A document written as HTML and Markdown.  Texts are plain unless called markup; file
 * names are relative to the page. */
struct gb_page {
    GString *html, *markdown;
};

/* The subtitle is the line below the title. */
void gb_page_begin(struct gb_page *page, const char *title, const char *subtitle);
void gb_page_end(struct gb_page *page);
void gb_page_finish(struct gb_page *page); /* zeroed is fine */

void gb_page_heading(struct gb_page *page, const char *text);
void gb_page_paragraph(struct gb_page *page, const char *text);
/* A picture with its caption and links to other files of it, a NULL-terminated list. */
void gb_page_image(struct gb_page *page, const char *file, const char *caption,
                   const char *const *others);
/* The items of a numbered list, char *. */
void gb_page_list(struct gb_page *page, const GPtrArray *items);
/* In print the next part begins a page. */
void gb_page_break(struct gb_page *page);

struct gb_page_table_content {
    const char *caption;
    const char *file; /* the table as CSV; NULL: none */
    const char *const *heads;
    guint columns;
    int markup; /* column whose cells have <i>, <sub>, <sup>; -1: none */
};

/* Cells row by row, below a row of heads. */
void gb_page_table(struct gb_page *page, const struct gb_page_table_content *content,
                   const GPtrArray *cells);
/* A cell of markup without its tags; g_free. */
char *gb_page_plain(const char *markup);

#endif
