#include "measure/fit/compaction/compaction_fits.h"

#include <math.h>

#include "measure/fit/compaction/equation_profile.h"

static bool set_intervals(struct gb_equation_fit *fit,
                          const struct gb_equations_points *points,
                          enum gb_compaction_intervals intervals, struct gb_error *err)
{
    return intervals == GB_COMPACTION_LINEAR ||
           (gb_equation_profile(fit, points, err) &&
            gb_equation_fit_jackknife(fit, points, err));
}

static bool fit_one(struct gb_compaction_fit *row, const struct gb_equation *equation,
                    const struct gb_equations_points *points,
                    enum gb_compaction_intervals intervals, struct gb_error *err)
{
    *row = (struct gb_compaction_fit){.equation = equation, .delta = NAN};
    row->fitted = gb_equation_fit(&row->all, equation, points, &row->refusal);
    if (row->refusal.code == GB_ERR_MEMORY) {
        return gb_error_set(err, GB_ERR_MEMORY, "%s", row->refusal.text);
    }
    return !row->fitted || set_intervals(&row->all, points, intervals, err);
}

static bool fit_stretch(struct gb_compaction_fits *fits,
                        const struct gb_equation *equation,
                        const struct gb_equations_points *points,
                        enum gb_compaction_intervals intervals, struct gb_error *err)
{
    struct gb_equations_points part = *points;
    if (!gb_heckel_stretch(&fits->stretch, points, err)) {
        return false;
    }
    const size_t first = fits->stretch.first;
    part.count = fits->stretch.count;
    part.pressure += first;
    part.density += first;
    part.error = points->error != NULL ? points->error + first : NULL;
    part.rows = points->rows != NULL ? points->rows + first : NULL;
    return gb_equation_fit(&fits->heckel, equation, &part, err) &&
           set_intervals(&fits->heckel, &part, intervals, err);
}

/* 1/K; unbounded where the interval of K contains 0 or K is not above it. */
static void set_yield(struct gb_compaction_fits *fits)
{
    const struct gb_fit_value *k = &fits->heckel.value[0];
    fits->yield = (struct gb_fit_value){
        .value = k->value > 0.0 ? 1.0 / k->value : (double)INFINITY,
        .error = k->error / (k->value * k->value),
        .low = k->high > 0.0 ? 1.0 / k->high : -(double)INFINITY,
        .high = k->low > 0.0 ? 1.0 / k->low : (double)INFINITY,
    };
}

/* The straightest stretch of Heckel's plot, where the equation is defined. */
static bool fit_heckel(struct gb_compaction_fits *fits, struct gb_compaction_fit *row,
                       const struct gb_equations_points *points,
                       enum gb_compaction_intervals intervals, struct gb_error *err)
{
    struct gb_error cause = {0};
    if (!row->fitted) {
        return true;
    }
    if (fit_stretch(fits, row->equation, points, intervals, &cause)) {
        set_yield(fits);
        return true;
    }
    row->fitted = false;
    row->refusal = cause;
    return cause.code != GB_ERR_MEMORY || gb_error_set(err, cause.code, "%s", cause.text);
}

static bool before(const struct gb_compaction_fit *a, const struct gb_compaction_fit *b)
{
    return a->fitted != b->fitted ? a->fitted : a->fitted && a->all.aicc < b->all.aicc;
}

/* By AICc; equal ones, such as Walker's and Balshin's, in the order of the table. */
static void sort(struct gb_compaction_fits *fits)
{
    for (size_t i = 1; i < fits->count; i++) {
        const struct gb_compaction_fit moved = fits->fit[i];
        size_t at = i;
        for (; at > 0 && before(&moved, &fits->fit[at - 1]); at--) {
            fits->fit[at] = fits->fit[at - 1];
        }
        fits->fit[at] = moved;
    }
    for (size_t i = 0; i < fits->count; i++) {
        struct gb_compaction_fit *row = &fits->fit[i];
        fits->fitted += row->fitted;
        row->delta = row->fitted ? row->all.aicc - fits->fit[0].all.aicc : (double)NAN;
    }
}

static bool is_heckel(const struct gb_equation *equation)
{
    return equation == gb_equations_find("heckel");
}

bool gb_compaction_fits(struct gb_compaction_fits *fits,
                        const struct gb_equations_points *points,
                        const struct gb_equation *only,
                        enum gb_compaction_intervals intervals, struct gb_error *err)
{
    *fits = (struct gb_compaction_fits){0};
    for (size_t i = 0; i < gb_equations_count(); i++) {
        const struct gb_equation *equation = gb_equations_at(i);
        if (only != NULL && only != equation) {
            continue;
        }
        struct gb_compaction_fit *row = &fits->fit[fits->count++];
        if (!fit_one(row, equation, points, intervals, err) ||
            (is_heckel(equation) && !fit_heckel(fits, row, points, intervals, err))) {
            return false;
        }
    }
    sort(fits);
    return true;
}

const struct gb_equation_fit *
gb_compaction_fits_reported(const struct gb_compaction_fits *fits, size_t index)
{
    const struct gb_compaction_fit *row = &fits->fit[index];
    return is_heckel(row->equation) ? &fits->heckel : &row->all;
}

size_t gb_compaction_fits_values(const struct gb_compaction_fits *fits, size_t index)
{
    return gb_compaction_fits_reported(fits, index)->size +
           is_heckel(fits->fit[index].equation);
}

struct gb_compaction_value gb_compaction_fits_value(const struct gb_compaction_fits *fits,
                                                    size_t index, size_t k)
{
    const struct gb_equation_fit *fit = gb_compaction_fits_reported(fits, index);
    if (k == fit->size) {
        return (struct gb_compaction_value){"yield_pressure", "MPa", fits->yield};
    }
    const struct gb_equations_parameter *parameter =
        gb_equations_parameter(fit->equation, k);
    return (struct gb_compaction_value){parameter->name, parameter->unit, fit->value[k]};
}
