#include "study/yield/yield_files.h"

#include <math.h>

#include "base/number.h"
#include "study/compact/study_text.h"

static void begin(GString *text, const char *comment, const char *head)
{
    gb_study_text_comment(text, comment);
    g_string_append(text, head);
}

static void add_direction(GString *text, const struct gb_yield_surface *surface, int d)
{
    const struct gb_yield_surface_direction *direction = &surface->direction[d];
    const struct gb_yield_point *mean = &direction->mean;
    const double number[] = {surface->density.value,
                             100.0 * surface->offset,
                             mean->direction * 180.0 / G_PI,
                             direction->cells,
                             1e-6 * mean->p_pa,
                             1e-6 * mean->p_error_pa,
                             1e-6 * mean->q_pa,
                             1e-6 * mean->q_error_pa,
                             mean->flow_volume,
                             mean->flow_shear,
                             direction->angle.value,
                             direction->angle.error,
                             direction->dilatancy.value,
                             direction->dilatancy.error};
    gb_study_text_numbers(text, number, G_N_ELEMENTS(number));
}

GString *gb_yield_files_points(const struct gb_yield_study *study, const char *comment)
{
    GString *text = g_string_new(NULL);
    begin(text, comment,
          "density,offset_percent,direction_deg,cells,p_MPa,p_error_MPa,q_MPa,"
          "q_error_MPa,flow_volume,flow_shear,angle_deg,angle_error_deg,dilatancy,"
          "dilatancy_error\n");
    for (guint i = 0; i < study->surface->len; i++) {
        const struct gb_yield_surface *surface = g_ptr_array_index(study->surface, i);
        for (int d = 0; d < surface->directions; d++) {
            if (surface->direction[d].cells > 0) {
                add_direction(text, surface, d);
            }
        }
    }
    return text;
}

GString *gb_yield_files_cells(const struct gb_yield_study *study, const char *comment)
{
    GString *text = g_string_new(NULL);
    begin(text, comment,
          "density,cell,direction_deg,p_MPa,q_MPa,flow_volume,flow_shear\n");
    for (guint i = 0; i < study->point->len; i++) {
        const struct gb_yield_point *point =
            &g_array_index(study->point, struct gb_yield_point, i);
        const double number[] = {
            point->density,     point->replica,     point->direction * 180.0 / G_PI,
            1e-6 * point->p_pa, 1e-6 * point->q_pa, point->flow_volume,
            point->flow_shear};
        gb_study_text_numbers(text, number, G_N_ELEMENTS(number));
    }
    return text;
}

static void add_quantity(GString *text, const struct gb_yield_surface *surface,
                         const char *name, const struct gb_fit_value *value,
                         const char *unit, double factor)
{
    const double number[] = {factor * value->value, factor * value->error,
                             factor * value->low, factor * value->high};
    g_string_append_printf(text, "%s,", name);
    const double head[] = {surface->density.value, 100.0 * surface->offset};
    gb_study_text_cells(text, head, G_N_ELEMENTS(head));
    g_string_append_c(text, ',');
    gb_study_text_cells(text, number, G_N_ELEMENTS(number));
    g_string_append_printf(text, ",%s\n", unit);
}

GString *gb_yield_files_fit(const struct gb_yield_study *study, const char *comment)
{
    GString *text = g_string_new(NULL);
    begin(text, comment, "quantity,density,offset_percent,value,error,low,high,unit\n");
    for (guint i = 0; i < study->surface->len; i++) {
        const struct gb_yield_surface *surface = g_ptr_array_index(study->surface, i);
        add_quantity(text, surface, "compact_p", &surface->top_p, "MPa", 1e-6);
        add_quantity(text, surface, "compact_q", &surface->top_q, "MPa", 1e-6);
        for (int k = 0; k < GB_YIELD_QUANTITIES; k++) {
            const struct gb_yield_surface_row *row = &gb_yield_surface_rows[k];
            add_quantity(text, surface, row->name, &surface->quantity[k], row->unit,
                         row->factor);
        }
    }
    return text;
}

/* --- the page ---------------------------------------------------------------------- */

static const struct gb_fit_value *quantity(const struct gb_yield_surface *surface,
                                           enum gb_yield_surface_quantity which)
{
    return &surface->quantity[which];
}

static void add_surfaces(GString *text, const struct gb_yield_study *study)
{
    g_string_append(text,
                    "\n## Ellipses\n\n"
                    "| density | pressed to p (MPa) | offset (%) | centre p (MPa) | "
                    "centre q | half axis p | half axis q | misfit |\n"
                    "|---|---|---|---|---|---|---|---|\n");
    for (guint i = 0; i < study->surface->len; i++) {
        const struct gb_yield_surface *surface = g_ptr_array_index(study->surface, i);
        char number[GB_NUMBER_MAX];
        g_string_append_printf(text, "| %.4f", surface->density.value);
        gb_study_text_value(text, " | ", &surface->top_p, 1e-6);
        g_string_append_printf(text, " | %g", 100.0 * surface->offset);
        for (int k = GB_YIELD_CENTRE_P; k <= GB_YIELD_HALF_Q; k++) {
            gb_study_text_value(text, " | ", &surface->quantity[k], 1e-6);
        }
        g_string_append_printf(
            text, " | %s |\n",
            gb_number_shown("%.3f", quantity(surface, GB_YIELD_MISFIT)->value, number));
    }
}

/* Whether the interval holds zero. */
static const char *verdict(const struct gb_fit_value *value)
{
    if (!isfinite(value->low)) {
        return "without an error";
    }
    return value->low > 0.0    ? "above 0"
           : value->high < 0.0 ? "below 0"
                               : "0 within its error";
}

/* Directions whose angle differs from 0 by more than its 95 % interval. */
static int count_angles(const struct gb_yield_surface *surface, int *all)
{
    int count = 0;
    *all = 0;
    for (int d = 0; d < surface->directions; d++) {
        const struct gb_fit_value *angle = &surface->direction[d].angle;
        *all += isfinite(angle->value);
        count += angle->low > 0.0 || angle->high < 0.0;
    }
    return count;
}

static void add_statements_on(GString *text, const struct gb_yield_surface *surface)
{
    int all = 0;
    char number[GB_NUMBER_MAX];
    const int different = count_angles(surface, &all);
    const struct gb_fit_value *centre = quantity(surface, GB_YIELD_CENTRE_P);
    const struct gb_fit_value *loaded = quantity(surface, GB_YIELD_DILATANCY_COMPRESSION);
    const struct gb_fit_value *pulled = quantity(surface, GB_YIELD_DILATANCY_EXTENSION);
    g_string_append_printf(text,
                           "\nDensity %.4f, offset %g %%:\n\n- centre of the ellipse",
                           surface->density.value, 100.0 * surface->offset);
    gb_study_text_value(text, " at p = ", centre, 1e-6);
    g_string_append_printf(text, " MPa, %s: shift over half axis", verdict(centre));
    gb_study_text_value(text, " ", quantity(surface, GB_YIELD_SHIFT), 1.0);
    gb_study_text_value(
        text, "\n- dilatancy -dv/|dw| under shear at constant p: ", loaded, 1.0);
    g_string_append_printf(text, " (%s) in compression", verdict(loaded));
    gb_study_text_value(text, ", ", pulled, 1.0);
    g_string_append_printf(text, " (%s) in extension", verdict(pulled));
    gb_study_text_value(text, "\n- angle of the flow from the normal: rms ",
                        quantity(surface, GB_YIELD_ANGLE_RMS), 1.0);
    g_string_append_printf(
        text,
        " degrees (flow along the normal would show %s by the errors); in %d of %d "
        "directions its 95 %% interval leaves out 0\n",
        gb_number_shown("%.1f", quantity(surface, GB_YIELD_ANGLE_NOISE)->value, number),
        different, all);
    gb_study_text_value(text, "- mean deviation of the flow from the normal towards +p: ",
                        quantity(surface, GB_YIELD_FLOW_DEVIATION), 1.0);
    g_string_append_printf(text, " degrees, %s\n",
                           verdict(quantity(surface, GB_YIELD_FLOW_DEVIATION)));
}

static void add_directions(GString *text, const struct gb_yield_study *study)
{
    g_string_append(text,
                    "\n## Points at the chosen offset\n\n"
                    "| density | direction (deg) | cells | p (MPa) | q (MPa) | angle "
                    "to normal (deg) | dilatancy |\n|---|---|---|---|---|---|---|\n");
    for (int m = 0; m < study->options.marks.count; m++) {
        const struct gb_yield_surface *surface =
            gb_yield_study_surface(study, m, GB_YIELD_OFFSET_CHOSEN);
        for (int d = 0; d < surface->directions; d++) {
            const struct gb_yield_surface_direction *at = &surface->direction[d];
            const struct gb_fit_value p = {.value = at->mean.p_pa,
                                           .error = at->mean.p_error_pa};
            const struct gb_fit_value q = {.value = at->mean.q_pa,
                                           .error = at->mean.q_error_pa};
            g_string_append_printf(
                text, "| %.4f | %.0f | %d", surface->density.value,
                gb_yield_options_direction(&study->options, d) * 180.0 / G_PI, at->cells);
            gb_study_text_value(text, " | ", &p, 1e-6);
            gb_study_text_value(text, " | ", &q, 1e-6);
            gb_study_text_value(text, " | ", &at->angle, 1.0);
            gb_study_text_value(text, " | ", &at->dilatancy, 1.0);
            g_string_append(text, " |\n");
        }
    }
}

GString *gb_yield_files_page(const struct gb_yield_study *study, const char *title,
                             const char *command)
{
    const struct gb_yield_options *options = &study->options;
    GString *text = g_string_new(NULL);
    g_string_append_printf(
        text,
        "# Yield surface: %s\n\n`%s`\n\n%d cells. Each compact is unloaded to p = %g of "
        "its pressure at q = 0 and loaded from there in %d directions of the (p, q) "
        "plane, until the plastic strain reaches the offset: the total less the elastic "
        "strain, by the elastic constants of the unloaded compact (`greenbody moduli`). "
        "Strain steps of %g, relaxed to %g. Means with standard errors over the "
        "cells.\n",
        title, command, options->replicas, options->inside, options->directions,
        options->step, options->tolerance);
    if (study->failed > 0) {
        g_string_append_printf(text, "\nIncomplete: %s\n", study->why.text);
    }
    add_surfaces(text, study);
    g_string_append(text, "\n## Statements\n");
    for (guint i = 0; i < study->surface->len; i++) {
        add_statements_on(text, g_ptr_array_index(study->surface, i));
    }
    add_directions(text, study);
    return text;
}

bool gb_yield_files_write(const struct gb_yield_study *study, const char *directory,
                          const char *title, const char *command, struct gb_error *err)
{
    char *comment = g_strdup_printf(
        "preset: %s\ncommand: %s\np = tr/3, q = p_z - (p_x + p_y)/2, compression positive; "
        "flow: plastic strain increments; angle: of the flow from the outward normal of "
        "the fitted ellipse; errors: standard, over the cells",
        title, command);
    const struct gb_study_text_file file[] = {
        {"yield.csv", gb_yield_files_points(study, comment)},
        {"yield_cells.csv", gb_yield_files_cells(study, comment)},
        {"yield_fit.csv", gb_yield_files_fit(study, comment)},
        {"yield.md", gb_yield_files_page(study, title, command)}};
    g_free(comment);
    return gb_study_text_write(file, G_N_ELEMENTS(file), directory, err);
}
