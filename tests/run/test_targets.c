/* Contacts of P1's compacts, and relaxers against each other (suite slow): means over 16
 * cells with their standard error, compared with accepted ranges.  The other numbers of P1
 * are those of tests/study/test_papers_slow.c. */
#include <glib.h>
#include <gsl/gsl_statistics.h>
#include <math.h>

#include "common/scene.h"
#include "run/experiment.h"

enum { CELLS = 16 };

/* What is read off one run; branch 0 is loading. */
struct curve {
    GArray *points;
    double share10, share12; /* of particles with 10, 12 contacts at the end */
};

static struct curve compute(const struct gb_params *params)
{
    struct curve curve = {.points = g_array_new(FALSE, FALSE, sizeof(struct gb_point))};
    struct gb_experiment *experiment = NULL;
    struct gb_error err = {0};
    if (!gb_experiment_create(&experiment, params, NULL, NULL, &err)) {
        g_error("%s", err.text);
    }
    for (;;) {
        const enum gb_step_outcome result =
            gb_experiment_advance(experiment, 100000, &err);
        if (result == GB_STEP_STOPPED) {
            g_error("%s", err.text);
        }
        if (result == GB_STEP_DONE) {
            break;
        }
        if (result == GB_STEP_POINT) {
            g_array_append_vals(curve.points, gb_experiment_point(experiment), 1);
        }
    }
    struct gb_snapshot snapshot;
    gb_experiment_observe(experiment, &snapshot);
    curve.share10 = snapshot.histogram[10];
    curve.share12 = snapshot.histogram[12];
    gb_experiment_destroy(experiment);
    return curve;
}

typedef double (*reader)(const struct gb_point *point);

static double density(const struct gb_point *p)
{
    return p->density;
}

/* Value where the pressure of a branch first crosses p: upwards when loading, down to
 * zero when unloading; linear between the two points. */
static double cross(const struct curve *curve, int branch, double p, reader read)
{
    const struct gb_point *before = NULL;
    for (guint i = 0; i < curve->points->len; i++) {
        const struct gb_point *now = &g_array_index(curve->points, struct gb_point, i);
        if (now->branch != branch) {
            continue;
        }
        const bool crossed = before && (branch == 0 ? now->p_pa >= p && before->p_pa < p
                                                    : now->p_pa <= p && before->p_pa > p);
        if (crossed) {
            const double t = (p - before->p_pa) / (now->p_pa - before->p_pa);
            return read(before) + t * (read(now) - read(before));
        }
        before = now;
    }
    return before && branch > 0 ? read(before) : (double)NAN; /* ended just above zero */
}

static void compute_cells(struct curve cells[CELLS], const char *const *assignment)
{
    for (int c = 0; c < CELLS; c++) {
        struct gb_params params = scene_params("particles.count=1000", NULL);
        struct gb_error err = {0};
        for (int i = 0; assignment[i]; i++) {
            if (!gb_params_assign(&params, assignment[i], &err)) {
                g_error("%s", err.text);
            }
        }
        params.seed = (uint64_t)c + 1;
        cells[c] = compute(&params);
    }
}

static void drop_cells(struct curve cells[CELLS])
{
    for (int c = 0; c < CELLS; c++) {
        g_array_free(cells[c].points, TRUE);
    }
}

/* Prints mean and standard error beside the paper and fails outside target +- accept. */
static void judge(const char *name, const double value[CELLS], double target,
                  double accept)
{
    const double mean = gsl_stats_mean(value, 1, CELLS);
    const double error = gsl_stats_sd(value, 1, CELLS) / sqrt(CELLS);
    g_test_message("%-46s %8.4f +- %.4f  target %g +- %g", name, mean, error, target,
                   accept);
    if (!(fabs(mean - target) <= accept)) {
        g_test_message("%s: outside", name);
        g_test_fail();
    }
}

static void read_cells(const struct curve cells[CELLS], int branch, double p, reader read,
                       double out[CELLS])
{
    for (int c = 0; c < CELLS; c++) {
        out[c] = cross(&cells[c], branch, p, read);
    }
}

/* P1 section V: at 1 GPa 0.5 and 0.3 % of the particles have 10 contacts, none has 12. */
static void test_contacts(void)
{
    static const char *const diameter[] = {"particles.diameter=9.7 nm",
                                           "particles.diameter=38 nm"};
    static const double printed[] = {0.005, 0.003};
    for (int d = 0; d < 2; d++) {
        const char *const assignment[] = {diameter[d], NULL};
        struct curve cells[CELLS];
        double v[CELLS];
        compute_cells(cells, assignment);
        for (int c = 0; c < CELLS; c++) {
            v[c] = cells[c].share10;
            g_assert_cmpfloat(cells[c].share12, ==, 0.0);
        }
        judge(diameter[d], v, printed[d], 0.005);
        drop_cells(cells);
    }
}

/* FIRE and the reference relaxer meet at 20 MPa within the scatter of seeds. */
static void test_relaxers(void)
{
    static const char *const fire[] = {"particles.count=250", "loading.until=22 MPa",
                                       "numerics.relaxer=fire", NULL};
    static const char *const steepest[] = {"particles.count=250", "loading.until=22 MPa",
                                           "numerics.relaxer=steepest", NULL};
    struct curve a[CELLS], b[CELLS];
    double x[CELLS], y[CELLS];
    compute_cells(a, fire);
    compute_cells(b, steepest);
    read_cells(a, 0, 20e6, density, x);
    read_cells(b, 0, 20e6, density, y);
    const double scatter = fmax(gsl_stats_sd(x, 1, CELLS), gsl_stats_sd(y, 1, CELLS));
    judge("relaxers at 20 MPa: fire", x, gsl_stats_mean(y, 1, CELLS), 2.0 * scatter);
    for (int m = 0; m < 2; m++) {
        const struct curve *cells = m == 0 ? a : b;
        double evaluations = 0.0, steps = 0.0;
        for (int c = 0; c < CELLS; c++) {
            for (guint i = 0; i < cells[c].points->len; i++) {
                evaluations += (double)g_array_index(cells[c].points, struct gb_point, i)
                                   .evaluations;
                steps += 1.0;
            }
        }
        g_test_message(
            "%s: %.0f evaluations per strain step, density at 20 MPa %.4f +- %.4f",
            m == 0 ? "fire" : "steepest", evaluations / steps,
            gsl_stats_mean(m == 0 ? x : y, 1, CELLS),
            gsl_stats_sd(m == 0 ? x : y, 1, CELLS) / sqrt(CELLS));
    }
    drop_cells(a);
    drop_cells(b);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/targets/contacts", test_contacts);
    g_test_add_func("/targets/relaxers", test_relaxers);
    return g_test_run();
}
