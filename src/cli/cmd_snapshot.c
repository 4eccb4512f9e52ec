/* `greenbody snapshot`: pictures of a packing, or of all states of a run as frames of a
 * film.  It reads states from run directories or files, draws them with the chosen
 * colours, camera and size, and pipes frames to ffmpeg. */
#include <signal.h>
#include <string.h>

#include <glib.h>

#include "base/built_with.h"
#include "base/clock.h"
#include "cli/commands.h"
#include "cli/options.h"
#include "cli/progress.h"

#if GB_WITH_PICTURES

#include "draw/packing_image.h"
#include "draw/picture_colours.h"
#include "draw/picture_style.h"
#include "figures/plotting.h"
#include "figures/sequence.h"
#include "figures/states.h"
#include "io/rundir.h"

/* The options of the command line. */
struct request {
    char *at, *view, *background, *output, *color, *show, *slice, *cut, *since, *range,
        *colormap;
    gboolean force, bare, rose, sequence, quiet, log;
    struct gb_page_options page;
    double fps;
};

static void free_request(struct request *request)
{
    char *const texts[] = {request->at,     request->view,    request->background,
                           request->output, request->color,   request->show,
                           request->slice,  request->cut,     request->since,
                           request->range,  request->colormap};
    for (size_t k = 0; k < G_N_ELEMENTS(texts); k++) {
        g_free(texts[k]);
    }
    gb_options_page_finish(&request->page);
}

static bool parse_background(const char *text, enum gb_background *background,
                             struct gb_error *err)
{
    static const char *const names[] = {"white", "dark", "transparent"};
    for (int k = 0; k < 3; k++) {
        if (strcmp(text, names[k]) == 0) {
            *background = (enum gb_background)k;
            return true;
        }
    }
    return gb_error_set(err, GB_ERR_INPUT,
                        "--ground %.80s: expected white, dark or transparent", text);
}

static bool parse_style(const struct request *request,
                        struct gb_picture_style_request *style, struct gb_error *err)
{
    style->log = request->log;
    return (request->color == NULL ||
            gb_picture_style_parse_colour(style, request->color, err)) &&
           (request->show == NULL ||
            gb_picture_style_parse_show(style, request->show, err)) &&
           (request->range == NULL ||
            gb_picture_style_parse_range(style, request->range, err)) &&
           (request->colormap == NULL ||
            gb_picture_style_parse_colormap(style, request->colormap, err)) &&
           (request->slice == NULL ||
            gb_picture_style_parse_slice(style, request->slice, err)) &&
           (request->cut == NULL || gb_picture_style_parse_cut(style, request->cut, err));
}

static bool parse_request(const struct request *request,
                          struct gb_packing_image *packing_image, struct gb_error *err)
{
    gb_packing_image_init(packing_image);
    packing_image->annotated = !request->bare;
    packing_image->crop = request->page.size != NULL    ? GB_CAPTION_NO_CROP
                          : request->page.width != NULL ? GB_CAPTION_CROP_HEIGHT
                                                        : GB_CAPTION_CROP_BOTH;
    if (request->output == NULL) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "snapshot needs -o FILE.png for the picture");
    }
    const enum gb_plotting_use use =
        request->sequence ? GB_PLOTTING_SEQUENCE : GB_PLOTTING_PICTURE;
    if (gb_plotting_format_find(request->output, use) == NULL) {
        char *names = gb_plotting_format_names(use);
        gb_error_set(err, GB_ERR_INPUT, "-o %.300s: expected a name ending in %s",
                     request->output, names);
        g_free(names);
        return false;
    }
    return (request->view == NULL ||
            gb_view_parse(request->view, &packing_image->viewpoint, err)) &&
           gb_options_page_take(&request->page, &packing_image->width,
                                &packing_image->height, &packing_image->per_inch, err) &&
           (request->background == NULL ||
            parse_background(request->background, &packing_image->background, err)) &&
           parse_style(request, &packing_image->style, err);
}

/* Reads the state of --since: another run directory or state file, or a point of the
 * same run. */
static bool read_since(struct gb_state **out, const char *since, const char *path,
                       struct gb_error *err)
{
    const bool is_path = g_file_test(since, G_FILE_TEST_EXISTS);
    return gb_states_read(out, is_path ? since : path, is_path ? NULL : since, err);
}

enum { PATHS_MAX = GB_PACKING_IMAGE_ROWS };

/* Reads the states of all paths. */
static bool read_states(struct gb_state **states, const struct request *request,
                        char **paths, struct gb_error *err)
{
    bool good = true;
    for (size_t i = 0; paths[i] != NULL && good; i++) {
        good = gb_states_read(&states[i], paths[i], request->at, err);
    }
    return good;
}

static bool write_picture(const struct request *request,
                          struct gb_packing_image *packing_image, char **paths,
                          struct gb_error *err)
{
    struct gb_state *states[PATHS_MAX] = {NULL};
    struct gb_state *since = NULL;
    char *preset = gb_states_preset(paths[0]);
    bool done =
        read_states(states, request, paths, err) &&
        (request->since == NULL || read_since(&since, request->since, paths[0], err));
    if (done) {
        packing_image->preset = preset;
        packing_image->style.since = since;
        done = gb_packing_image_write_panels(
            packing_image,
            request->rose ? GB_PACKING_IMAGE_WITH_ROSE : GB_PACKING_IMAGE_ALONE, states,
            g_strv_length(paths), request->output, err);
    }
    for (int i = 0; i < PATHS_MAX; i++) {
        gb_state_destroy(states[i]);
    }
    gb_state_destroy(since);
    g_free(preset);
    return done;
}

/* Progress of the frames, with the time of the start. */
struct frames {
    struct gb_progress progress;
    double from_s;
};

static void on_frame(size_t done, size_t total, void *data)
{
    struct frames *frames = data;
    gb_progress_count(&frames->progress, done, total, "frames",
                      gb_clock_s() - frames->from_s);
}

static bool take_sequence(const struct request *request,
                          struct gb_packing_image *packing_image, char **words,
                          struct gb_error *err)
{
    struct frames frames = {.from_s = gb_clock_s()};
    const struct gb_sequence sequence = {.directory = words[0],
                                         .output = request->output,
                                         .frames_per_s = request->fps,
                                         .force = request->force,
                                         .progress = on_frame,
                                         .data = &frames};
    struct gb_state *since = NULL;
    if (words[1] != NULL || request->at != NULL || request->rose) {
        return gb_error_set(
            err, GB_ERR_INPUT,
            "--sequence takes one run directory, without --at and --rose");
    }
    if (!(request->fps >= 0.1 && request->fps <= 100.0)) {
        return gb_error_set(err, GB_ERR_INPUT, "--fps %g: expected 0.1 to 100",
                            request->fps);
    }
    bool done =
        request->since == NULL || read_since(&since, request->since, words[0], err);
    packing_image->style.since = since;
    gb_progress_init(&frames.progress, request->quiet);
    done = done && gb_sequence_write(&sequence, packing_image, err);
    gb_progress_clear(&frames.progress);
    gb_state_destroy(since);
    return done;
}

static bool take_picture(const struct request *request, char **words,
                         struct gb_error *err)
{
    struct gb_packing_image packing_image;
    const guint count = g_strv_length(words);
    if (count == 0 || count > PATHS_MAX || (count > 1 && request->since != NULL)) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "snapshot takes one run directory or .h5 file, or up to %d "
                            "without --since",
                            PATHS_MAX);
    }
    if (!parse_request(request, &packing_image, err)) {
        return false;
    }
    if (request->sequence) {
        return take_sequence(request, &packing_image, words, err);
    }
    if (!request->force && g_file_test(request->output, G_FILE_TEST_EXISTS)) {
        return gb_error_set(err, GB_ERR_INPUT, "%.300s: exists; --force replaces it",
                            request->output);
    }
    return gb_rundir_files_protect(request->output, err) &&
           write_picture(request, &packing_image, words, err);
}

/* The quantities of --color, for the help; g_free. */
static char *describe_colours(void)
{
    char *particles = gb_picture_colours_names(GB_PICTURE_COLOURS_PARTICLES);
    char *forces = gb_picture_colours_names(GB_PICTURE_COLOURS_FORCES);
    char *text = g_strdup_printf("of particles: %s; of forces: %s", particles, forces);
    g_free(forces);
    g_free(particles);
    return text;
}

static char *describe_sequence(void)
{
    char *videos = gb_plotting_videos();
    char *text = g_strdup_printf("all kept states: .png is animated, %s a video by "
                                 "ffmpeg, x-%%03d.png one image per state",
                                 videos);
    g_free(videos);
    return text;
}

static const struct gb_options_page page = {
    .usage = "DIR... -o FILE.png",
    .summary = "Picture of a packing: particles in their box, coloured by coordination\n"
               "number or another measure, or the forces between them.  DIR is a run\n"
               "directory or a state.h5; several are drawn one below the other.\n"
               "The file contains the preset: greenbody run --from FILE.png repeats the "
               "run.",
};

/* Reads the options, as gb_options_parse. */
static bool parse_options(struct request *request, int argc, char **argv, char ***words,
                          int *status)
{
    char *colours = describe_colours();
    char *sequence = describe_sequence();
    char *colormaps = gb_picture_style_parse_colormaps();
    const GOptionEntry entries[] = {
        {"output", 'o', 0, G_OPTION_ARG_FILENAME, &request->output, "the picture",
         "FILE.png"},
        {"force", 0, 0, G_OPTION_ARG_NONE, &request->force, "replace an existing picture",
         NULL},
        {"view", 0, 0, G_OPTION_ARG_STRING, &request->view,
         "corner, front, side, top or AZIMUTH,ELEVATION in degrees; ,flat after it: "
         "no perspective",
         "VIEW"},
        GB_PAGE_OPTIONS_ENTRIES(&request->page),
        {"ground", 0, 0, G_OPTION_ARG_STRING, &request->background,
         "white, dark or transparent", "COLOUR"},
        {"bare", 0, 0, G_OPTION_ARG_NONE, &request->bare, "the packing without text",
         NULL},
        {"color", 0, 0, G_OPTION_ARG_STRING, &request->color, colours, "WHAT"},
        {"show", 0, 0, G_OPTION_ARG_STRING, &request->show,
         "particles, forces (rods as thick as the force between two particles) or both",
         "WHAT"},
        {"range", 0, 0, G_OPTION_ARG_STRING, &request->range,
         "ends of the colours, as 0:200MPa (default: of the values, without outliers); "
         "0:50nN: force of the thickest rod",
         "LOW:HIGH"},
        {"colormap", 0, 0, G_OPTION_ARG_STRING, &request->colormap, colormaps, "NAME"},
        {"log", 0, 0, G_OPTION_ARG_NONE, &request->log, "logarithmic scale of colours",
         NULL},
        {"slice", 0, 0, G_OPTION_ARG_STRING, &request->slice,
         "a slab at a fraction of an edge: y=0.5, or z=0.25:3d for 3 diameters (2)",
         "PLANE"},
        {"cut", 0, 0, G_OPTION_ARG_STRING, &request->cut,
         "cut away what is beyond y=0.5, or the corner nearest to the viewer", "PLANE"},
        {"rose", 0, 0, G_OPTION_ARG_NONE, &request->rose,
         "next to it the mean normal force by direction, as a surface", NULL},
        {"at", 0, 0, G_OPTION_ARG_STRING, &request->at,
         "a kept state, as \"p=100 MPa\" or \"density=0.5\" (default: the last)",
         "POINT"},
        {"sequence", 0, 0, G_OPTION_ARG_NONE, &request->sequence, sequence, NULL},
        gb_options_quiet(&request->quiet),
        {"fps", 0, 0, G_OPTION_ARG_DOUBLE, &request->fps, "frames a second (8)", "N"},
        {"since", 0, 0, G_OPTION_ARG_STRING, &request->since,
         "displacement from this state: a point of the run, or another directory",
         "POINT|DIR"},
        {0},
    };
    const bool parsed = gb_options_parse(&page, entries, argc, argv, words, status);
    g_free(colormaps);
    g_free(sequence);
    g_free(colours);
    return parsed;
}

int gb_cmd_snapshot(int argc, char **argv)
{
    struct request request = {.fps = 8.0};
    char **words = NULL;
    int status = 0;
    struct gb_error err = {0};
    if (!parse_options(&request, argc, argv, &words, &status)) {
        free_request(&request);
        return status;
    }
    signal(SIGPIPE, SIG_IGN); /* writing to an ffmpeg that has ended is an error */
    const bool done = take_picture(&request, words, &err);
    g_strfreev(words);
    free_request(&request);
    return done ? 0 : gb_options_fail(&err);
}

#else

int gb_cmd_snapshot(int argc, char **argv)
{
    struct gb_error err = {0};
    (void)argc;
    (void)argv;
    gb_error_set(&err, GB_ERR_INPUT,
                 "snapshot: built without pictures (-Dpictures=enabled)");
    return gb_options_fail(&err);
}

#endif
