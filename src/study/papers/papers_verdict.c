#include "study/papers/papers_verdict.h"

#include <math.h>

#include <glib.h>

static double difference_of(const struct gb_papers_printed *printed, double value)
{
    return printed->relation == GB_PAPERS_BELOW ? fmax(fabs(value) - printed->value, 0.0)
                                                : value - printed->value;
}

/* NaN: unknown. */
static double error_of(const struct gb_papers_printed *printed,
                       const struct gb_papers_here *here)
{
    const double own = here->exact ? 0.0 : here->error;
    const double size = here->size > 0.0 ? here->size : 1.0;
    const double sampled = isfinite(printed->cells) && !here->exact
                               ? own * sqrt(size * (double)here->cells / printed->cells)
                               : 0.0;
    return hypot(hypot(own, sampled), printed->error);
}

struct gb_papers_verdict gb_papers_verdict_of(const struct gb_papers_printed *printed,
                                              const struct gb_papers_here *here)
{
    struct gb_papers_verdict verdict = {GB_PAPERS_NOT_COMPUTED, NAN, NAN};
    if (here->cells == 0 && !here->exact) {
        return verdict;
    }
    if (!isfinite(here->value)) {
        verdict.outcome = GB_PAPERS_ABSENT;
        return verdict;
    }
    verdict.difference = difference_of(printed, here->value);
    verdict.error = error_of(printed, here);
    if (!isfinite(verdict.error)) {
        verdict.outcome = GB_PAPERS_UNJUDGED;
    } else if (fabs(verdict.difference) <= GB_PAPERS_VERDICT_ERRORS * verdict.error) {
        verdict.outcome = GB_PAPERS_WITHIN;
    } else {
        verdict.outcome = GB_PAPERS_OFF;
    }
    return verdict;
}

int gb_papers_verdict_digits(double error)
{
    return error > 0.0 ? (int)fmin(fmax(1.0 - floor(log10(error)), 0.0), 9.0) : 4;
}

char *gb_papers_verdict_text(const struct gb_papers_verdict *verdict)
{
    switch (verdict->outcome) {
    case GB_PAPERS_WITHIN:
        return g_strdup("within error");
    case GB_PAPERS_OFF:
        return g_strdup_printf("off by %.*f (%.1f standard errors)",
                               gb_papers_verdict_digits(verdict->error),
                               verdict->difference,
                               fabs(verdict->difference) / verdict->error);
    case GB_PAPERS_UNJUDGED:
        return g_strdup_printf("differs by %.2g, without an error", verdict->difference);
    case GB_PAPERS_ABSENT:
        return g_strdup("not found in the runs");
    default:
        return g_strdup("not computed");
    }
}
