#include "figures/sequence.h"

#include <math.h>
#include <string.h>

#include <glib.h>

#include "base/file.h"
#include "draw/image/apng.h"
#include "draw/mute_stderr.h"
#include "figures/provenance.h"
#include "figures/states.h"
#include "figures/video.h"

/* How long the last frame stays, of an animated PNG. */
static const int last_ms = 1500;

/* Longest sequence, and digits of a frame's number. */
enum { FRAMES_MAX = 10000, DIGITS_MAX = 9 };

struct frames {
    const struct gb_sequence *sequence;
    struct gb_packing_image *picture;
    GPtrArray *paths; /* in the order of the run */
    struct gb_apng *apng;
    struct gb_video *video;
    struct gb_packing_image_texts texts; /* of the first */
};

/* Where the number stands, %d or %03d; NULL when there is none. */
static const char *find_number(const char *output, int *digits)
{
    const char *at = strchr(output, '%');
    if (at == NULL) {
        return NULL;
    }
    const char *end = at + 1;
    *digits = (int)g_ascii_strtoull(end, NULL, 10);
    end += strspn(end, "0123456789");
    return *end == 'd' && *digits <= DIGITS_MAX && strchr(end, '%') == NULL ? at : NULL;
}

bool gb_sequence_is_numbered(const char *output)
{
    return strchr(output, '%') != NULL;
}

static char *frame_path(const char *output, int number)
{
    int digits = 0;
    const char *at = find_number(output, &digits);
    char *head = g_strndup(output, (gsize)(at - output));
    char *path = g_strdup_printf("%s%0*d%s", head, digits, number, strchr(at, 'd') + 1);
    g_free(head);
    return path;
}

static bool check_free(const char *path, bool force, struct gb_error *err)
{
    return gb_file_check_target(path, err) &&
           (force || !g_file_test(path, G_FILE_TEST_EXISTS) ||
            gb_error_set(err, GB_ERR_INPUT, "%.300s: exists; --force replaces it", path));
}

/* All names before the first frame is painted. */
static bool check_names(const struct frames *frames, struct gb_error *err)
{
    const char *output = frames->sequence->output;
    int digits = 0;
    if (!gb_sequence_is_numbered(output)) {
        return check_free(output, frames->sequence->force, err);
    }
    if (find_number(output, &digits) == NULL) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "-o %.300s: accepted one number as in frame-%%03d.png",
                            output);
    }
    bool good = true;
    for (guint k = 0; k < frames->paths->len && good; k++) {
        char *path = frame_path(output, (int)k + 1);
        good = check_free(path, frames->sequence->force, err);
        g_free(path);
    }
    return good;
}

/* The room and the scales that all frames need. */
static bool widen(struct gb_packing_image *picture, struct gb_picture_style_request *all,
                  const struct gb_state *state, struct gb_error *err)
{
    struct gb_picture_style *dress = NULL;
    for (int k = 0; k < 3; k++) {
        picture->look.room[k] = fmax(picture->look.room[k], state->cell[k]);
    }
    if (!gb_picture_style_create(&dress, state, &picture->dress, err)) {
        return false;
    }
    all->low = fmin(all->low, dress->scale.low);
    all->high = fmax(all->high, dress->scale.high);
    all->thickest_n = fmax(all->thickest_n, dress->thickest_n);
    gb_picture_style_destroy(dress);
    return true;
}

static bool survey(struct frames *frames, struct gb_error *err)
{
    struct gb_packing_image *picture = frames->picture;
    struct gb_picture_style_request all = picture->dress;
    bool good = true;
    all.low = INFINITY;
    all.high = -INFINITY;
    for (guint k = 0; k < frames->paths->len && good; k++) {
        struct gb_state *state = NULL;
        good = gb_state_read(&state, g_ptr_array_index(frames->paths, k), err) &&
               widen(picture, &all, state, err);
        gb_state_destroy(state);
    }
    picture->dress = all;
    return good;
}

/* The files that frames go into. */
static bool open_output(struct frames *frames, const struct gb_state *first,
                        struct gb_error *err)
{
    const struct gb_sequence *sequence = frames->sequence;
    const struct gb_packing_image *picture = frames->picture;
    if (gb_sequence_is_numbered(sequence->output)) {
        return true;
    }
    if (gb_video_knows(sequence->output)) {
        return gb_video_open(&frames->video, sequence->output, picture->width,
                             picture->height, sequence->frames_per_s, first->preset, err);
    }
    gb_packing_image_describe(&frames->texts, first, picture->preset);
    return gb_apng_create(&frames->apng, (int)frames->paths->len,
                          picture->ground != GB_GROUND_TRANSPARENT, frames->texts.text,
                          frames->texts.count, err);
}

static bool put(struct frames *frames, const struct gb_image *image,
                const struct gb_state *state, guint number, struct gb_error *err)
{
    if (frames->video != NULL) {
        return gb_video_add(frames->video, image, err);
    }
    if (frames->apng != NULL) {
        const bool last = number == frames->paths->len;
        const int usual = (int)lround(1000.0 / frames->sequence->frames_per_s);
        return gb_apng_add(frames->apng, image, last ? MAX(usual, last_ms) : usual, err);
    }
    char *path = frame_path(frames->sequence->output, (int)number);
    const bool done = gb_packing_image_save(image, frames->picture, state, path, err);
    g_free(path);
    return done;
}

static bool paint_one(struct frames *frames, guint k, struct gb_error *err)
{
    struct gb_state *state = NULL;
    struct gb_image *image = NULL;
    const bool done = gb_state_read(&state, g_ptr_array_index(frames->paths, k), err) &&
                      (k > 0 || open_output(frames, state, err)) &&
                      gb_packing_image_paint(&image, frames->picture, state, err) &&
                      put(frames, image, state, k + 1, err);
    gb_image_destroy(image);
    gb_state_destroy(state);
    return done;
}

static bool paint_all(struct frames *frames, struct gb_error *err)
{
    bool done = survey(frames, err);
    if (done) {
        const int kept = gb_mute_stderr_begin();
        done = gb_osmesa_open(&frames->picture->painter, err);
        gb_mute_stderr_end(kept);
    }
    for (guint k = 0; k < frames->paths->len && done; k++) {
        done = paint_one(frames, k, err);
    }
    gb_osmesa_close(frames->picture->painter);
    frames->picture->painter = NULL;
    return done && (frames->apng == NULL ||
                    gb_apng_write(frames->apng, frames->sequence->output, err));
}

bool gb_sequence_write(const struct gb_sequence *sequence,
                       struct gb_packing_image *picture, struct gb_error *err)
{
    struct frames frames = {.sequence = sequence, .picture = picture};
    frames.paths = gb_states_along(sequence->directory, err);
    if (frames.paths == NULL) {
        return false;
    }
    bool done = frames.paths->len >= 2 && frames.paths->len <= FRAMES_MAX;
    if (!done) {
        gb_error_set(err, GB_ERR_INPUT,
                     "%.300s: keeps %u states; --sequence takes 2 to %d: run it with "
                     "output.snapshots_at=\"every 20\" or another number of points",
                     sequence->directory, frames.paths->len, FRAMES_MAX);
    }
    char *preset = gb_provenance_preset(sequence->directory);
    picture->preset = preset;
    done = done && check_names(&frames, err) && paint_all(&frames, err);
    done = gb_video_close(frames.video, done, err);
    gb_apng_destroy(frames.apng);
    g_ptr_array_unref(frames.paths);
    picture->preset = NULL;
    g_free(preset);
    return done;
}
