#include "draw/image/contact_sheet.h"

#include <math.h>
#include <string.h>

#include "base/file.h"
#include "draw/caption.h"
#include "draw/mute_stderr.h"
#include "draw/osmesa.h"
#include "draw/rose.h"

static void copy(const struct gb_image *from, struct gb_image *to, int left, int top)
{
    for (int y = 0; y < from->height; y++) {
        const size_t width = (size_t)from->width;
        memcpy(&to->rgba[4 * ((size_t)(top + y) * (size_t)to->width + (size_t)left)],
               &from->rgba[4 * (size_t)y * width], 4 * width);
    }
}

static bool draw_rose(struct gb_image *image, const struct gb_packing_image *picture,
                      const struct gb_harmonics *rose, double reach, double newton,
                      struct gb_error *err)
{
    struct gb_osmesa *painter = NULL;
    struct gb_scene *scene = NULL;
    struct gb_caption_layout layout;
    gb_caption_place(image->width, image->height, picture->words, &layout);
    const bool done =
        gb_rose_scene(&scene, rose, reach, &picture->look, &layout.scene, picture->ground,
                      err) &&
        gb_osmesa_open(&painter, err) && gb_osmesa_paint(painter, scene, image, err) &&
        gb_caption_draw_rose(image, &layout, scene, reach, rose->mean * newton, err);
    gb_osmesa_close(painter);
    gb_scene_destroy(scene);
    return done;
}

static bool add_packing(struct gb_image *sheet, const struct gb_packing_image *picture,
                        const struct gb_state *state, int top, struct gb_error *err)
{
    struct gb_image *panel = NULL;
    const bool done = gb_packing_image_paint(&panel, picture, state, err);
    if (done) {
        copy(panel, sheet, 0, top);
    }
    gb_image_destroy(panel);
    return done;
}

static bool add_rose(struct gb_image *sheet, const struct gb_packing_image *picture,
                     const struct gb_state *state, double reach, int top,
                     struct gb_error *err)
{
    struct gb_harmonics rose;
    struct gb_image *panel = NULL;
    const int width = sheet->width - picture->width;
    const double newton =
        state->pascal_per_stress * state->metre_per_length * state->metre_per_length;
    if (!gb_rose_of_state(&rose, state, err) ||
        !gb_image_create(&panel, width, picture->height, err)) {
        return false;
    }
    const int kept = gb_mute_stderr_begin();
    const bool done = draw_rose(panel, picture, &rose, reach, newton, err);
    gb_mute_stderr_end(kept);
    if (done) {
        copy(panel, sheet, picture->width, top);
    }
    gb_image_destroy(panel);
    return done;
}

/* The reach that all roses need. */
static bool find_reach(struct gb_state *const *states, size_t count, double *reach,
                       struct gb_error *err)
{
    *reach = 1.0;
    for (size_t i = 0; i < count; i++) {
        struct gb_harmonics rose;
        if (!gb_rose_of_state(&rose, states[i], err)) {
            return false;
        }
        if (!(rose.mean > 0.0)) {
            return gb_error_set(err, GB_ERR_INPUT,
                                "rose: the contacts of a packing pull more than they "
                                "press; accepted one under pressure");
        }
        *reach = fmax(*reach, gb_rose_reach(&rose));
    }
    return true;
}

static bool fill(struct gb_image *sheet, const struct gb_packing_image *picture,
                 bool roses, struct gb_state *const *states, size_t count,
                 struct gb_error *err)
{
    struct gb_packing_image panel = *picture;
    double reach = 1.0;
    panel.height = sheet->height / (int)count;
    panel.width = roses ? sheet->width / 2 : sheet->width;
    bool done = !roses || find_reach(states, count, &reach, err);
    for (size_t i = 0; i < count && done; i++) {
        const int top = (int)i * panel.height;
        done = add_packing(sheet, &panel, states[i], top, err) &&
               (!roses || add_rose(sheet, &panel, states[i], reach, top, err));
    }
    return done;
}

bool gb_contact_sheet_write(const struct gb_packing_image *picture, bool roses,
                            struct gb_state *const *states, size_t count,
                            const char *path, struct gb_error *err)
{
    struct gb_image *sheet = NULL;
    if (count == 1 && !roses) {
        return gb_packing_image_write(picture, states[0], path, err);
    }
    const bool done = gb_file_check_target(path, err) &&
                      gb_image_create(&sheet, picture->width, picture->height, err) &&
                      fill(sheet, picture, roses, states, count, err) &&
                      gb_packing_image_save(sheet, picture, states[0], path, err);
    gb_image_destroy(sheet);
    return done;
}
