#include "figures/report/report.h"

#include "base/built_with.h"

#if GB_WITH_PICTURES

#include "draw/packing_image.h"
#include "draw/picture_colours.h"
#include "figures/provenance.h"
#include "figures/states.h"

/* Thickness of the slab of forces, d. */
static const double slab_d = 3.0;

static void set_packing(struct gb_packing_image *packing_image,
                        const struct gb_state *state)
{
    (void)state;
    packing_image->height = 900; /* two panels side by side */
}

static void set_stress(struct gb_packing_image *packing_image,
                       const struct gb_state *state)
{
    packing_image->style.particles = gb_picture_colours_find("pressure");
    packing_image->style.cut_corner = state->dimension == 3;
}

static void set_forces(struct gb_packing_image *packing_image,
                       const struct gb_state *state)
{
    packing_image->style.show = GB_PICTURE_STYLE_FORCES;
    if (state->dimension == 3) {
        packing_image->style.slice_axis = 1;
        packing_image->style.slice_at = 0.5;
        packing_image->style.slice_width = slab_d;
        gb_view_parse("front", &packing_image->viewpoint, NULL);
    }
}

enum contacts { CONTACTS_OPTIONAL, CONTACTS_REQUIRED };

/* Pictures of the last state of the first run of each scene. */
static const struct picture {
    const char *name, *caption;
    enum contacts contacts;
    enum gb_packing_image_panels content; /* with contacts */
    void (*set)(struct gb_packing_image *packing_image, const struct gb_state *state);
} pictures[] = {
    {"packing",
     "particles by coordination number, and the mean normal force by direction",
     CONTACTS_OPTIONAL, GB_PACKING_IMAGE_WITH_ROSE, set_packing},
    {"pressure", "particles by their mean stress", CONTACTS_REQUIRED,
     GB_PACKING_IMAGE_ALONE, set_stress},
    {"forces", "forces between particles, in 3D in a slab 3 diameters thick",
     CONTACTS_REQUIRED, GB_PACKING_IMAGE_ALONE, set_forces},
};

static void show(struct gb_report *report, const struct gb_state *state, const char *file,
                 const char *content)
{
    char *text = g_strdup_printf("%s: %s.", state->preset, content);
    char *caption = gb_report_figure_caption(report, text);
    gb_page_image(&report->page, file, caption, NULL);
    g_free(caption);
    g_free(text);
}

static bool add_picture(struct gb_report *report, size_t group, struct gb_state *state,
                        const struct picture *picture, const char *preset,
                        struct gb_error *err)
{
    char *file = g_strdup_printf("pictures/%zu-%s.png", group + 1, picture->name);
    char *path = g_build_filename(report->folder, file, NULL);
    struct gb_packing_image packing_image;
    struct gb_error cause = {0};
    gb_packing_image_init(&packing_image);
    packing_image.crop = GB_CAPTION_CROP_BOTH;
    packing_image.preset = preset;
    picture->set(&packing_image, state);
    const bool drawn = gb_packing_image_write_panels(
        &packing_image,
        state->pair_count > 0 ? picture->content : GB_PACKING_IMAGE_ALONE, &state, 1,
        path, &cause);
    const bool no_data = !drawn && cause.code == GB_ERR_INPUT;
    if (drawn) {
        show(report, state, file, picture->caption);
    } else if (!no_data && err != NULL) {
        *err = cause;
    }
    g_free(path);
    g_free(file);
    return drawn || no_data;
}

static bool add_scene(struct gb_report *report, size_t group, struct gb_error *err)
{
    const char *directory = gb_runset_first(report->set, group)->directory;
    struct gb_state *state = NULL;
    struct gb_error cause = {0};
    bool good = true;
    if (!gb_states_read(&state, directory, NULL, &cause)) {
        return true; /* of a run without a state */
    }
    char *preset = gb_provenance_preset(directory);
    for (size_t k = 0; k < G_N_ELEMENTS(pictures) && good; k++) {
        if (pictures[k].contacts == CONTACTS_OPTIONAL || state->pair_count > 0) {
            good = add_picture(report, group, state, &pictures[k], preset, err);
        }
    }
    g_free(preset);
    gb_state_destroy(state);
    return good;
}

bool gb_report_pictures(struct gb_report *report, struct gb_error *err)
{
    const int before = report->figures;
    bool good = true;
    for (size_t g = 0; g < report->set->groups && good; g++) {
        good = add_scene(report, g, err);
    }
    if (report->figures > before) {
        gb_page_paragraph(&report->page,
                          "The last kept state of the first run of each scene. Each file "
                          "contains its preset: greenbody run --from FILE.png repeats "
                          "the run.");
    }
    return good;
}

#else

bool gb_report_pictures(struct gb_report *report, struct gb_error *err)
{
    (void)report;
    (void)err;
    return true;
}

#endif
