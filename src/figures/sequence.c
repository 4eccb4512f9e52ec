/* Frames of all kept states of a run with one camera and one scale. */
#include "figures/sequence.h"

#include <math.h>
#include <string.h>

#include <glib.h>

#include "base/file.h"
#include "draw/text.h"
#include "figures/frame_writer.h"
#include "figures/output_formats.h"
#include "figures/states.h"
#include "io/rundir.h"

enum { MAX_FRAMES = 10000 };

struct job {
    const struct gb_sequence *sequence;
    struct gb_packing_image *packing_image;
    GPtrArray *paths; /* of the states */
    const struct gb_frame_writer *methods;
    void *writer;
};

static bool is_numbered(const char *output)
{
    return strchr(output, '%') != NULL;
}

static bool check_target(const char *path, bool force, struct gb_error *err)
{
    return gb_rundir_files_protect(path, err) && gb_file_check_target(path, err) &&
           (force || !g_file_test(path, G_FILE_TEST_EXISTS) ||
            gb_error_set(err, GB_ERR_INPUT, "%.300s: exists; --force replaces it", path));
}

static bool check_numbered_targets(const struct job *job, struct gb_error *err)
{
    bool good = true;
    for (guint k = 0; k < job->paths->len && good; k++) {
        char *path = gb_frame_writer_path(job->sequence->output, (int)k + 1);
        good = path != NULL
                   ? check_target(path, job->sequence->force, err)
                   : gb_error_set(err, GB_ERR_INPUT,
                                  "-o %.300s: expected one number as in frame-%%03d.png",
                                  job->sequence->output);
        g_free(path);
    }
    return good;
}

/* Chooses the writer, and checks its targets before the first frame. */
static bool choose_writer(struct job *job, struct gb_error *err)
{
    const char *output = job->sequence->output;
    if (is_numbered(output)) {
        job->methods = &gb_frame_writer_numbered;
        return check_numbered_targets(job, err);
    }
    const struct gb_output_formats_row *format =
        gb_output_formats_find(output, GB_OUTPUT_FORMATS_SEQUENCE);
    job->methods = format != NULL ? format->frames : &gb_frame_writer_apng;
    return check_target(output, job->sequence->force, err);
}

/* Extends the box in view and the scales by those of a state. */
static bool include_state(struct gb_packing_image *packing_image,
                          struct gb_picture_style_request *all,
                          const struct gb_state *state, struct gb_error *err)
{
    struct gb_picture_style *style = NULL;
    const struct gb_cell cell = gb_state_cell(state);
    gb_view_include(&packing_image->viewpoint, &cell);
    if (!gb_picture_style_create(&style, state, &packing_image->style, err)) {
        return false;
    }
    all->low = fmin(all->low, style->scale.low);
    all->high = fmax(all->high, style->scale.high);
    all->max_force_n = fmax(all->max_force_n, style->max_force_n);
    gb_picture_style_destroy(style);
    return true;
}

/* Sets the common box and scales. */
static bool set_common_scales(struct job *job, struct gb_error *err)
{
    struct gb_packing_image *packing_image = job->packing_image;
    struct gb_picture_style_request all = packing_image->style;
    bool good = true;
    all.low = INFINITY;
    all.high = -INFINITY;
    for (guint k = 0; k < job->paths->len && good; k++) {
        struct gb_state *state = NULL;
        good = gb_state_read(&state, g_ptr_array_index(job->paths, k), err) &&
               include_state(packing_image, &all, state, err);
        gb_state_destroy(state);
    }
    packing_image->style = all;
    return good;
}

static bool open_writer(struct job *job, const struct gb_state *first,
                        const struct gb_image *image, struct gb_error *err)
{
    const struct gb_frame_output output = {
        job->sequence->output, job->packing_image,   image->width,
        image->height,         (int)job->paths->len, job->sequence->frames_per_s};
    return job->methods->open(&job->writer, &output, first, err);
}

static bool render_frame(struct job *job, guint k, struct gb_error *err)
{
    struct gb_state *state = NULL;
    struct gb_image *image = NULL;
    const bool done = gb_state_read(&state, g_ptr_array_index(job->paths, k), err) &&
                      gb_packing_image_render(&image, job->packing_image, state, err) &&
                      (k > 0 || open_writer(job, state, image, err)) &&
                      job->methods->add(job->writer, image, state, (int)k + 1, err);
    gb_image_destroy(image);
    gb_state_destroy(state);
    return done;
}

static bool render_all(struct job *job, struct gb_error *err)
{
    bool done = set_common_scales(job, err);
    if (done) {
        const int saved = gb_text_mute_begin();
        done = gb_renderer_open(&job->packing_image->renderer, err);
        gb_text_mute_end(saved);
    }
    for (guint k = 0; k < job->paths->len && done; k++) {
        done = render_frame(job, k, err);
        if (done && job->sequence->progress != NULL) {
            job->sequence->progress(k + 1, job->paths->len, job->sequence->data);
        }
    }
    gb_renderer_close(job->packing_image->renderer);
    job->packing_image->renderer = NULL;
    return job->writer != NULL ? job->methods->close(job->writer, done, err) : done;
}

static bool check_count(const struct job *job, struct gb_error *err)
{
    return (job->paths->len >= 2 && job->paths->len <= MAX_FRAMES) ||
           gb_error_set(err, GB_ERR_INPUT,
                        "%.300s: keeps %u states; --sequence takes 2 to %d: run it with "
                        "output.snapshots_at=\"every 20\" or another number of points",
                        job->sequence->directory, job->paths->len, MAX_FRAMES);
}

bool gb_sequence_write(const struct gb_sequence *sequence,
                       struct gb_packing_image *packing_image, struct gb_error *err)
{
    struct job job = {.sequence = sequence, .packing_image = packing_image};
    job.paths = gb_states_along(sequence->directory, err);
    if (job.paths == NULL) {
        return false;
    }
    char *preset = gb_states_preset(sequence->directory);
    packing_image->preset = preset;
    const bool done =
        check_count(&job, err) && choose_writer(&job, err) && render_all(&job, err);
    g_ptr_array_unref(job.paths);
    packing_image->preset = NULL;
    g_free(preset);
    return done;
}
