#include "figures/page.h"

#include <stdbool.h>
#include <string.h>

#include "base/visible.h"

/* For screen and print; no external font, script or picture. */
static const char style[] =
    "body{font:16px/1.5 'DejaVu Sans',Verdana,sans-serif;color:#1a1c20;background:#fff;"
    "max-width:60rem;margin:2rem auto;padding:0 1.2rem}"
    "h1{font-size:1.7rem;line-height:1.25;margin:0 0 .2rem}"
    "h2{font-size:1.2rem;margin:2.4rem 0 .6rem;border-bottom:1px solid #c8ccd2;"
    "padding-bottom:.2rem}"
    ".sub{color:#555b66;margin-top:0}"
    "figure{margin:1.4rem 0 2rem;break-inside:avoid}"
    "figure img{width:100%;max-width:46rem;height:auto;display:block}"
    "figcaption{font-size:.88rem;color:#444a54;margin-top:.4rem;max-width:46rem}"
    "a{color:#0b5c9c}"
    ".scroll{overflow-x:auto}"
    "table{border-collapse:collapse;font-size:.86rem;margin:.4rem 0 1.4rem}"
    "th,td{text-align:right;padding:.22rem .7rem;border-bottom:1px solid #dfe2e6;"
    "font-variant-numeric:tabular-nums}"
    "th{border-bottom:1.5px solid #50565f;font-weight:600;vertical-align:bottom}"
    "th.text,td.text,td.symbol{text-align:left}"
    "td{vertical-align:top}"
    "td.symbol{white-space:nowrap}"
    "li{margin:.3rem 0}"
    "caption{text-align:left;font-size:.88rem;color:#444a54;padding-bottom:.4rem}"
    "@media print{body{font-size:10pt;max-width:none;margin:0}a{color:inherit;"
    "text-decoration:none}h2{break-after:avoid}tr{break-inside:avoid}"
    "figure img{max-width:14cm}.break{break-after:page}}";

static char *escape(const char *text)
{
    char *shown = gb_visible_text(text, "\n\t");
    char *safe = g_markup_escape_text(shown, -1);
    g_free(shown);
    return safe;
}

/* Escapes the characters with a meaning in Markdown. */
static void append_plain(GString *out, const char *text)
{
    char *shown = gb_visible_text(text, "\n\t");
    for (const char *c = shown; *c != '\0'; c++) {
        if (strchr("\\`*_{}[]<>#|", *c) != NULL) {
            g_string_append_c(out, '\\');
        }
        g_string_append_c(out, *c == '\n' ? ' ' : *c);
    }
    g_free(shown);
}

void gb_page_begin(struct gb_page *page, const char *title, const char *subtitle)
{
    char *name = escape(title);
    char *below = escape(subtitle);
    page->html = g_string_new(NULL);
    page->markdown = g_string_new("# ");
    g_string_append_printf(
        page->html,
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
        "<meta name=\"viewport\" content=\"width=device-width\">\n"
        "<title>%s</title>\n<style>%s</style>\n</head>\n<body>\n<h1>%s</h1>\n"
        "<p class=\"sub\">%s</p>\n",
        name, style, name, below);
    append_plain(page->markdown, title);
    g_string_append(page->markdown, "\n\n");
    append_plain(page->markdown, subtitle);
    g_string_append(page->markdown, "\n");
    g_free(below);
    g_free(name);
}

void gb_page_end(struct gb_page *page)
{
    g_string_append(page->html, "</body>\n</html>\n");
}

void gb_page_finish(struct gb_page *page)
{
    if (page->html != NULL) {
        g_string_free(page->html, TRUE);
        g_string_free(page->markdown, TRUE);
    }
    *page = (struct gb_page){0};
}

void gb_page_heading(struct gb_page *page, const char *text)
{
    char *safe = escape(text);
    g_string_append_printf(page->html, "<h2>%s</h2>\n", safe);
    g_string_append(page->markdown, "\n## ");
    append_plain(page->markdown, text);
    g_string_append(page->markdown, "\n");
    g_free(safe);
}

void gb_page_paragraph(struct gb_page *page, const char *text)
{
    char *safe = escape(text);
    g_string_append_printf(page->html, "<p>%s</p>\n", safe);
    g_string_append(page->markdown, "\n");
    append_plain(page->markdown, text);
    g_string_append(page->markdown, "\n");
    g_free(safe);
}

static void append_link(struct gb_page *page, const char *file)
{
    char *safe = g_uri_escape_string(file, "/", FALSE);
    const char *dot = strrchr(file, '.');
    const char *name = dot != NULL ? dot + 1 : file;
    g_string_append_printf(page->html, " <a href=\"%s\">%s</a>", safe, name);
    g_string_append_printf(page->markdown, " [%s](%s)", name, safe);
    g_free(safe);
}

void gb_page_image(struct gb_page *page, const char *file, const char *caption,
                   const char *const *others)
{
    char *safe = escape(caption);
    char *path = g_uri_escape_string(file, "/", FALSE);
    g_string_append_printf(page->html,
                           "<figure>\n<img src=\"%s\" alt=\"%s\">\n<figcaption>%s", path,
                           safe, safe);
    g_string_append(page->markdown, "\n![");
    append_plain(page->markdown, caption);
    g_string_append_printf(page->markdown, "](%s)\n\n", path);
    append_plain(page->markdown, caption);
    for (int k = 0; others != NULL && others[k] != NULL; k++) {
        append_link(page, others[k]);
    }
    g_string_append(page->html, "</figcaption>\n</figure>\n");
    g_string_append(page->markdown, "\n");
    g_free(path);
    g_free(safe);
}

char *gb_page_plain(const char *markup)
{
    GString *text = g_string_new(NULL);
    bool inside = false;
    for (const char *c = markup; *c != '\0'; c++) {
        if (*c == '<' || *c == '>') {
            inside = *c == '<';
        } else if (!inside) {
            g_string_append_c(text, *c);
        }
    }
    return g_string_free(text, FALSE);
}

void gb_page_list(struct gb_page *page, const GPtrArray *items)
{
    g_string_append(page->html, items->len > 0 ? "<ol>\n" : "");
    g_string_append(page->markdown, items->len > 0 ? "\n" : "");
    for (guint k = 0; k < items->len; k++) {
        const char *text = g_ptr_array_index(items, k);
        char *safe = escape(text);
        g_string_append_printf(page->html, "<li>%s</li>\n", safe);
        g_string_append_printf(page->markdown, "%u. ", k + 1);
        append_plain(page->markdown, text);
        g_string_append(page->markdown, "\n");
        g_free(safe);
    }
    g_string_append(page->html, items->len > 0 ? "</ol>\n" : "");
}

void gb_page_break(struct gb_page *page)
{
    g_string_append(page->html, "<div class=\"break\"></div>\n");
}

/* Markup of constant tables stands in both pages as it is: Markdown takes tags of HTML. */
static void append_markup(struct gb_page *page, const char *markup)
{
    g_string_append_printf(page->html, "<td class=\"symbol\">%s</td>", markup);
    g_string_append_printf(page->markdown, " %s |", markup);
}

/* A column of words, on the left, and not of numbers. */
static bool is_words(const struct gb_page_table_content *content, const GPtrArray *cells,
                     guint column)
{
    bool found = column == 0;
    for (guint k = column; k < cells->len && !found; k += content->columns) {
        const char *cell = g_ptr_array_index(cells, k);
        found = *cell == '<';
        for (const char *c = cell; *c != '\0' && !found; c++) {
            found = g_ascii_isalpha(c[0]) && g_ascii_isalpha(c[1]);
        }
    }
    return found;
}

static void append_cell(struct gb_page *page, const char *tag, const char *text,
                        bool words)
{
    char *safe = escape(text);
    g_string_append_printf(page->html, "<%s%s>%s</%s>", tag,
                           words ? " class=\"text\"" : "", safe, tag);
    g_string_append(page->markdown, " ");
    append_plain(page->markdown, text);
    g_string_append(page->markdown, " |");
    g_free(safe);
}

static void append_row(struct gb_page *page, const char *tag, const char *const *cells,
                       const struct gb_page_table_content *content, const bool *words)
{
    const bool body = strcmp(tag, "td") == 0;
    g_string_append(page->html, "<tr>");
    g_string_append(page->markdown, "|");
    for (guint k = 0; k < content->columns; k++) {
        if (body && (int)k == content->markup) {
            append_markup(page, cells[k]);
        } else {
            append_cell(page, tag, cells[k], words[k]);
        }
    }
    g_string_append(page->html, "</tr>\n");
    g_string_append(page->markdown, "\n");
}

void gb_page_table(struct gb_page *page, const struct gb_page_table_content *content,
                   const GPtrArray *cells)
{
    const guint columns = content->columns;
    bool *words = g_new(bool, columns);
    for (guint k = 0; k < columns; k++) {
        words[k] = is_words(content, cells, k);
    }
    char *safe = escape(content->caption);
    g_string_append_printf(page->html, "<div class=\"scroll\"><table>\n<caption>%s",
                           safe);
    g_string_append(page->markdown, "\n");
    append_plain(page->markdown, content->caption);
    if (content->file != NULL) {
        append_link(page, content->file);
    }
    g_string_append(page->html, "</caption>\n");
    g_string_append(page->markdown, "\n\n");
    append_row(page, "th", content->heads, content, words);
    g_string_append(page->markdown, "|");
    for (guint k = 0; k < columns; k++) {
        g_string_append(page->markdown, words[k] ? "---|" : "---:|");
    }
    g_string_append(page->markdown, "\n");
    for (guint row = 0; row + columns <= cells->len; row += columns) {
        append_row(page, "td", (const char *const *)cells->pdata + row, content, words);
    }
    g_string_append(page->html, "</table></div>\n");
    g_free(words);
    g_free(safe);
}
