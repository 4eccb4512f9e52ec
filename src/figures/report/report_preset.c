#include <string.h>

#include "base/file.h"
#include "base/text/visible.h"
#include "figures/provenance.h"
#include "figures/report/report.h"

static void show(struct gb_page *page, const char *text)
{
    char *shown = gb_visible_text(text, "\n\t");
    char *safe = g_markup_escape_text(shown, -1);
    g_string_append_printf(page->html,
                           "<details><summary>preset.ini of the first run</summary>"
                           "<pre>%s</pre></details>\n",
                           safe);
    g_string_append_printf(page->markdown, "\n```\n%s\n```\n", shown);
    g_free(safe);
    g_free(shown);
}

bool gb_report_preset(struct gb_report *report, struct gb_error *err)
{
    char *text = gb_provenance_preset(report->set->run[0].directory);
    char *path = g_build_filename(report->folder, "preset.ini", NULL);
    const bool good = text == NULL || gb_file_replace(path, text, strlen(text), err);
    if (good && text != NULL) {
        show(&report->page, text);
    }
    g_free(path);
    g_free(text);
    return good;
}
