#include "figures/output_formats.h"

#include <glib.h>

#include "base/built_with.h"

#if GB_WITH_PICTURES
#include "figures/frame_writer.h"
#define FRAMES(writer) .frames = &(writer)
#else
#define FRAMES(writer) .frames = NULL
#endif

/* Even sides and 4:2:0 colours, which all encoders accept and all players show. */
#define EVEN_YUV420 "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white,format=yuv420p"
/* GIF has 256 colours, chosen from all frames. */
#define OWN_PALETTE "split[a][b];[a]palettegen[p];[b][p]paletteuse"

static const struct gb_output_formats_row table[] = {
    {".png", "image with the preset in its text chunks; a sequence is an animated PNG",
     GB_OUTPUT_FORMATS_FIGURE | GB_OUTPUT_FORMATS_PICTURE | GB_OUTPUT_FORMATS_SEQUENCE,
     .figure = gb_figure_write_png, FRAMES(gb_frame_writer_apng)},
    {".svg", "vector figure", GB_OUTPUT_FORMATS_FIGURE, .figure = gb_figure_write_svg},
    {".pdf", "vector figure", GB_OUTPUT_FORMATS_FIGURE, .figure = gb_figure_write_pdf},
    {".csv", "data of a figure", GB_OUTPUT_FORMATS_FIGURE, .figure = NULL},
    {".mp4", "video (ffmpeg)", GB_OUTPUT_FORMATS_SEQUENCE, FRAMES(gb_frame_writer_video),
     .video_filter = EVEN_YUV420},
    {".webm", "video (ffmpeg)", GB_OUTPUT_FORMATS_SEQUENCE, FRAMES(gb_frame_writer_video),
     .video_filter = EVEN_YUV420},
    {".mkv", "video (ffmpeg)", GB_OUTPUT_FORMATS_SEQUENCE, FRAMES(gb_frame_writer_video),
     .video_filter = EVEN_YUV420},
    {".gif", "animated image (ffmpeg)", GB_OUTPUT_FORMATS_SEQUENCE,
     FRAMES(gb_frame_writer_video), .video_filter = OWN_PALETTE},
    {0},
};

const struct gb_output_formats_row *gb_output_formats_table(void)
{
    return table;
}

static bool is_for(const struct gb_output_formats_row *row,
                   enum gb_output_formats_use use)
{
    return (row->uses & use) != 0;
}

const struct gb_output_formats_row *gb_output_formats_find(const char *path,
                                                           enum gb_output_formats_use use)
{
    for (const struct gb_output_formats_row *row = table; row->extension; row++) {
        if (is_for(row, use) && g_str_has_suffix(path, row->extension)) {
            return row;
        }
    }
    return NULL;
}

/* Rows of a use, or its videos alone. */
enum chosen { ALL, VIDEOS };

static char *join_names(enum gb_output_formats_use use, enum chosen chosen)
{
    GPtrArray *names = g_ptr_array_new();
    for (const struct gb_output_formats_row *row = table; row->extension; row++) {
        if (is_for(row, use) && (chosen == ALL || row->video_filter != NULL)) {
            g_ptr_array_add(names, (gpointer)(uintptr_t)row->extension);
        }
    }
    GString *text = g_string_new(NULL);
    for (guint k = 0; k < names->len; k++) {
        const char *before = k == 0 ? "" : k + 1 < names->len ? ", " : " or ";
        g_string_append_printf(text, "%s%s", before,
                               (const char *)g_ptr_array_index(names, k));
    }
    g_ptr_array_unref(names);
    return g_string_free(text, FALSE);
}

char *gb_output_formats_names(enum gb_output_formats_use use)
{
    return join_names(use, ALL);
}

char *gb_output_formats_videos(void)
{
    return join_names(GB_OUTPUT_FORMATS_SEQUENCE, VIDEOS);
}

char *gb_output_formats_pattern(enum gb_output_formats_use use)
{
    GString *text = g_string_new("FILE.");
    for (const struct gb_output_formats_row *row = table; row->extension; row++) {
        if (is_for(row, use)) {
            g_string_append_printf(text, "%s|", row->extension + 1);
        }
    }
    g_string_truncate(text, text->len - 1);
    return g_string_free(text, FALSE);
}
