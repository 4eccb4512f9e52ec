#include <signal.h>
#include <string.h>

#include <glib.h>

#include "cli/commands.h"
#include "cli/options.h"

#if GB_WITH_PICTURES

#include "draw/picture.h"
#include "run/state.h"

/* What the command line said. */
struct request {
    char *at, *view, *size, *ground, *output;
    gboolean force, bare;
};

static void free_request(struct request *request)
{
    g_free(request->at);
    g_free(request->view);
    g_free(request->size);
    g_free(request->ground);
    g_free(request->output);
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

static bool parse_request(const struct request *request, struct gb_picture *picture,
                          struct gb_error *err)
{
    gb_picture_init(picture);
    picture->words = !request->bare;
    if (request->output == NULL) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "snapshot needs -o FILE.png for the picture");
    }
    if (!g_str_has_suffix(request->output, ".png")) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "-o %.300s: a name ending in .png is accepted",
                            request->output);
    }
    return (request->view == NULL || gb_view_parse(request->view, &picture->look, err)) &&
           (request->size == NULL ||
            gb_image_parse_size(request->size, &picture->width, &picture->height, err)) &&
           (request->ground == NULL ||
            parse_ground(request->ground, &picture->ground, err));
}

/* The state file of a run directory, or the file itself. */
static char *state_path(const char *place)
{
    return g_file_test(place, G_FILE_TEST_IS_DIR)
               ? g_build_filename(place, "state.h5", NULL)
               : g_strdup(place);
}

static bool take_picture(const struct request *request, char **words,
                         struct gb_error *err)
{
    struct gb_picture picture;
    struct gb_state *state = NULL;
    if (words[0] == NULL || words[1] != NULL) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "snapshot takes one run directory or .h5 file");
    }
    if (!parse_request(request, &picture, err)) {
        return false;
    }
    if (request->at != NULL) {
        return gb_error_set(
            err, GB_ERR_INPUT,
            "--at %.80s: %.200s keeps only its final state; leave --at out", request->at,
            words[0]);
    }
    if (!request->force && g_file_test(request->output, G_FILE_TEST_EXISTS)) {
        return gb_error_set(err, GB_ERR_INPUT, "%.300s: exists; --force replaces it",
                            request->output);
    }
    char *path = state_path(words[0]);
    const bool done = gb_state_read(&state, path, err) &&
                      gb_picture_write(&picture, state, request->output, err);
    gb_state_destroy(state);
    g_free(path);
    return done;
}

int gb_cmd_snapshot(int argc, char **argv)
{
    struct request request = {0};
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
        {"at", 0, 0, G_OPTION_ARG_STRING, &request.at, "a kept state, as \"p=100 MPa\"",
         "POINT"},
        {0},
    };
    static const struct gb_options_page page = {
        .usage = "DIR -o FILE.png",
        .summary =
            "Picture of a packing: particles in their box, coloured by coordination\n"
            "number.  DIR is a run directory or a state.h5.",
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
