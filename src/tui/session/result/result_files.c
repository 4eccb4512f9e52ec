#include "tui/session/result/result_fills.h"

#include <string.h>
#include <sys/stat.h>

#include "io/runs/run_line.h"
#include "tui/term/png_pixels.h"

bool gb_result_files_picture(struct gb_result_card *card,
                             const struct gb_session *session)
{
    struct gb_png_pixels picture;
    struct gb_error err = {0};
    (void)session;
    if (!gb_png_pixels_measure(&picture, card->path, &err)) {
        gb_result_card_add(card, GB_RESULT_WARNING, "%s", err.text);
        return true;
    }
    char *size = gb_run_line_size(gb_run_list_bytes(card->path));
    gb_result_card_add(card, GB_RESULT_VALUE, "%d x %d pixels, %s", picture.wide,
                       picture.high, size);
    if (picture.per_inch > 0.0) {
        gb_result_card_add(card, GB_RESULT_VALUE,
                           "in print %.3g x %.3g cm at %.0f pixels per inch",
                           2.54 * picture.wide / picture.per_inch,
                           2.54 * picture.high / picture.per_inch, picture.per_inch);
    }
    gb_result_card_add(card, GB_RESULT_NOTE,
                       "greenbody run --from FILE repeats the run of it");
    card->picture = g_strdup(card->path);
    g_free(size);
    return true;
}

/* Files of a folder with this ending; *first: the first of them by name, g_free. */
static int count_files(const char *folder, const char *ending, char **first)
{
    int count = 0;
    GDir *dir = g_dir_open(folder, 0, NULL);
    const char *name;
    while (dir != NULL && (name = g_dir_read_name(dir)) != NULL) {
        if (!g_str_has_suffix(name, ending)) {
            continue;
        }
        count++;
        if (first != NULL && (*first == NULL || strcmp(name, *first) < 0)) {
            g_free(*first);
            *first = g_strdup(name);
        }
    }
    if (dir != NULL) {
        g_dir_close(dir);
    }
    return count;
}

bool gb_result_files_report(struct gb_result_card *card, const struct gb_session *session)
{
    char *figures = g_build_filename(card->path, "figures", NULL);
    char *pictures = g_build_filename(card->path, "pictures", NULL);
    char *tables = g_build_filename(card->path, "tables", NULL);
    char *size = gb_run_line_size(gb_run_list_bytes(card->path));
    char *first = NULL;
    (void)session;
    const int drawn = count_files(figures, ".png", NULL);
    const int shown = count_files(pictures, ".png", &first);
    gb_result_card_add(card, GB_RESULT_VALUE, "%d figures, %d pictures, %d tables, %s",
                       drawn, shown, count_files(tables, ".csv", NULL), size);
    if (first != NULL) {
        card->picture = g_build_filename(pictures, first, NULL);
    }
    card->page = g_build_filename(card->path, "index.html", NULL);
    g_free(first);
    g_free(size);
    g_free(tables);
    g_free(pictures);
    g_free(figures);
    return true;
}
