#include <signal.h>
#include <string.h>

#include <glib.h>

#include "cli/commands.h"
#include "cli/options.h"

#if GB_WITH_PICTURES

#include "draw/image/contact_sheet.h"
#include "draw/picture_style_parse.h"
#include "figures/provenance.h"
#include "figures/sequence.h"
#include "figures/states.h"
#include "figures/video.h"

/* What the command line said. */
struct request {
    char *at, *view, *size, *ground, *output, *color, *show, *slice, *cut, *since;
    gboolean force, bare, rose, sequence;
    double fps;
};

static void free_request(struct request *request)
{
    char *const texts[] = {
        request->at,    request->view, request->size,  request->ground, request->output,
        request->color, request->show, request->slice, request->cut,    request->since};
    for (size_t k = 0; k < G_N_ELEMENTS(texts); k++) {
        g_free(texts[k]);
    }
}

static bool parse_ground(const char *text, enum gb_ground *ground, struct gb_error *err)
{
    static const char *const names[] = {"white", "dark", "transparent"};
    for (int k = 0; k < 3; k++) {
        if (strcmp(text, names[k]) == 0) {
            *ground = (enum gb_ground)k;
            return true;
        }
    }
    return gb_error_set(err, GB_ERR_INPUT,
                        "--ground %.80s: white, dark or transparent is accepted", text);
}

static bool parse_dress(const struct request *request,
                        struct gb_picture_style_request *dress, struct gb_error *err)
{
    return (request->color == NULL ||
            gb_picture_style_parse_colour(dress, request->color, err)) &&
           (request->show == NULL ||
            gb_picture_style_parse_show(dress, request->show, err)) &&
           (request->slice == NULL ||
            gb_picture_style_parse_slice(dress, request->slice, err)) &&
           (request->cut == NULL || gb_picture_style_parse_cut(dress, request->cut, err));
}

static bool parse_request(const struct request *request, struct gb_packing_image *picture,
                          struct gb_error *err)
{
    gb_packing_image_init(picture);
    picture->words = !request->bare;
    if (request->output == NULL) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "snapshot needs -o FILE.png for the picture");
    }
    if (!g_str_has_suffix(request->output, ".png") &&
        !(request->sequence && gb_video_knows(request->output))) {
        return gb_error_set(
            err, GB_ERR_INPUT, "-o %.300s: a name ending in .png is accepted%s",
            request->output, request->sequence ? ", or .mp4, .webm, .mkv, .gif" : "");
    }
    return (request->view == NULL || gb_view_parse(request->view, &picture->look, err)) &&
           (request->size == NULL ||
            gb_image_parse_size(request->size, &picture->width, &picture->height, err)) &&
           (request->ground == NULL ||
            parse_ground(request->ground, &picture->ground, err)) &&
           parse_dress(request, &picture->dress, err);
}

/* --since: another run directory or state file, or a point of the same run. */
static bool read_since(struct gb_state **out, const char *since, const char *place,
                       struct gb_error *err)
{
    const bool is_place = g_file_test(since, G_FILE_TEST_EXISTS);
    return gb_states_read(out, is_place ? since : place, is_place ? NULL : since, err);
}

enum { PLACES_MAX = 6 }; /* rows of one image */

/* All states and what --since names, which is measured within each run. */
static bool read_states(struct gb_state **states, const struct request *request,
                        char **places, struct gb_error *err)
{
    bool good = true;
    for (size_t i = 0; places[i] != NULL && good; i++) {
        good = gb_states_read(&states[i], places[i], request->at, err);
    }
    return good;
}

static bool write_picture(const struct request *request, struct gb_packing_image *picture,
                          char **places, struct gb_error *err)
{
    struct gb_state *states[PLACES_MAX] = {NULL};
    struct gb_state *since = NULL;
    char *preset = gb_provenance_preset(places[0]);
    bool done =
        read_states(states, request, places, err) &&
        (request->since == NULL || read_since(&since, request->since, places[0], err));
    if (done) {
        picture->preset = preset;
        picture->dress.since = since;
        done = gb_contact_sheet_write(picture, request->rose, states,
                                      g_strv_length(places), request->output, err);
    }
    for (int i = 0; i < PLACES_MAX; i++) {
        gb_state_destroy(states[i]);
    }
    gb_state_destroy(since);
    g_free(preset);
    return done;
}

static bool take_sequence(const struct request *request, struct gb_packing_image *picture,
                          char **words, struct gb_error *err)
{
    const struct gb_sequence sequence = {.directory = words[0],
                                         .output = request->output,
                                         .frames_per_s = request->fps,
                                         .force = request->force};
    struct gb_state *since = NULL;
    if (words[1] != NULL || request->at != NULL || request->rose) {
        return gb_error_set(
            err, GB_ERR_INPUT,
            "--sequence takes one run directory, without --at and --rose");
    }
    if (!(request->fps >= 0.1 && request->fps <= 100.0)) {
        return gb_error_set(err, GB_ERR_INPUT, "--fps %g: 0.1 to 100 is accepted",
                            request->fps);
    }
    bool done =
        request->since == NULL || read_since(&since, request->since, words[0], err);
    picture->dress.since = since;
    done = done && gb_sequence_write(&sequence, picture, err);
    gb_state_destroy(since);
    return done;
}

static bool take_picture(const struct request *request, char **words,
                         struct gb_error *err)
{
    struct gb_packing_image picture;
    const guint count = g_strv_length(words);
    if (count == 0 || count > PLACES_MAX || (count > 1 && request->since != NULL)) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "snapshot takes one run directory or .h5 file, or up to %d "
                            "without --since",
                            PLACES_MAX);
    }
    if (!parse_request(request, &picture, err)) {
        return false;
    }
    if (request->sequence) {
        return take_sequence(request, &picture, words, err);
    }
    if (!request->force && g_file_test(request->output, G_FILE_TEST_EXISTS)) {
        return gb_error_set(err, GB_ERR_INPUT, "%.300s: exists; --force replaces it",
                            request->output);
    }
    return write_picture(request, &picture, words, err);
}

int gb_cmd_snapshot(int argc, char **argv)
{
    struct request request = {.fps = 8.0};
    const GOptionEntry entries[] = {
        {"output", 'o', 0, G_OPTION_ARG_FILENAME, &request.output, "the picture",
         "FILE.png"},
        {"force", 0, 0, G_OPTION_ARG_NONE, &request.force, "replace an existing picture",
         NULL},
        {"view", 0, 0, G_OPTION_ARG_STRING, &request.view,
         "corner, front, side, top or AZIMUTH,ELEVATION in degrees; ,flat behind it: "
         "no perspective",
         "VIEW"},
        {"size", 0, 0, G_OPTION_ARG_STRING, &request.size, "pixels (1600x1200)",
         "WIDTHxHEIGHT"},
        {"ground", 0, 0, G_OPTION_ARG_STRING, &request.ground,
         "white, dark or transparent", "COLOUR"},
        {"bare", 0, 0, G_OPTION_ARG_NONE, &request.bare, "the packing without words",
         NULL},
        {"color", 0, 0, G_OPTION_ARG_STRING, &request.color,
         "of particles: coordination, pressure, bridges, size, displacement; of forces: "
         "sign, bridged",
         "WHAT"},
        {"show", 0, 0, G_OPTION_ARG_STRING, &request.show,
         "particles, forces (rods as thick as the force between two particles) or both",
         "WHAT"},
        {"slice", 0, 0, G_OPTION_ARG_STRING, &request.slice,
         "a slab alone, at a share of an edge: y=0.5, or z=0.25:3d for 3 diameters (2)",
         "PLANE"},
        {"cut", 0, 0, G_OPTION_ARG_STRING, &request.cut,
         "leave out what lies beyond y=0.5, or the corner of the usual view", "PLANE"},
        {"rose", 0, 0, G_OPTION_ARG_NONE, &request.rose,
         "beside it the mean normal force over all directions, as a body", NULL},
        {"at", 0, 0, G_OPTION_ARG_STRING, &request.at,
         "a kept state, as \"p=100 MPa\" or \"density=0.5\" (the last)", "POINT"},
        {"sequence", 0, 0, G_OPTION_ARG_NONE, &request.sequence,
         "all kept states: x.png moves, x.mp4 (.webm, .mkv, .gif) is a film by ffmpeg, "
         "x-%03d.png one picture each",
         NULL},
        {"fps", 0, 0, G_OPTION_ARG_DOUBLE, &request.fps, "frames a second (8)", "N"},
        {"since", 0, 0, G_OPTION_ARG_STRING, &request.since,
         "displacement: from which state, a point of the run or another directory",
         "POINT|DIR"},
        {0},
    };
    static const struct gb_options_page page = {
        .usage = "DIR... -o FILE.png",
        .summary =
            "Picture of a packing: particles in their box, coloured by coordination\n"
            "number or another measure, or the forces between them.  DIR is a run\n"
            "directory or a state.h5; several stand one below the other.\n"
            "The file carries the preset: greenbody run --from FILE.png makes the same\n"
            "run again.",
    };
    char **words = NULL;
    int status = 0;
    struct gb_error err = {0};
    if (!gb_options_parse(&page, entries, argc, argv, &words, &status)) {
        free_request(&request);
        return status;
    }
    /* a file that may not grow is an error of a write */
    signal(SIGXFSZ, SIG_IGN);
    signal(SIGPIPE, SIG_IGN); /* so is an ffmpeg that went away */
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
                 "snapshot: this build has no pictures (-Dpictures=enabled makes one)");
    return gb_options_fail(&err);
}

#endif
