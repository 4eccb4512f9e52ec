#include "measure/fit/decay_start.h"

#include <math.h>

#include "base/alloc.h"

/* Time constants of the grid: from the span / 3000 to the span * 3, a factor of 1.5
 * apart. Between neighbours the sum of squares has no second minimum. */
enum { GRID = 26, SIZE = GRID + 1 };
static const double shortest = 1.0 / 3000.0;
static const double longest = 3.0;

/* Centred columns: the exponentials of the grid, then p.  All sums that the linear
 * problems need, collected in one pass over the points. */
struct sums {
    double tau[GRID];
    double mean[SIZE];
    double product[SIZE][SIZE];
};

static void fill_row(const struct sums *sums, double t, double p, double row[SIZE])
{
    for (int k = 0; k < GRID; k++) {
        row[k] = exp(-t / sums->tau[k]);
    }
    row[GRID] = p;
}

static void collect(struct sums *sums, const double *t, const double *p, size_t count)
{
    double row[SIZE];
    for (size_t i = 0; i < count; i++) {
        fill_row(sums, t[i], p[i], row);
        for (int a = 0; a < SIZE; a++) {
            sums->mean[a] += row[a] / (double)count;
        }
    }
    for (size_t i = 0; i < count; i++) {
        fill_row(sums, t[i], p[i], row);
        for (int a = 0; a < SIZE; a++) {
            row[a] -= sums->mean[a];
        }
        for (int a = 0; a < SIZE; a++) {
            for (int b = 0; b <= a; b++) {
                sums->product[a][b] += row[a] * row[b];
            }
        }
    }
}

/* Reduction of the sum of squares by one exponential. */
static double gain_of_one(const struct sums *sums, int a, double *amplitude)
{
    const double square = sums->product[a][a];
    *amplitude = square > 0.0 ? sums->product[GRID][a] / square : 0.0;
    return *amplitude * sums->product[GRID][a];
}

/* The same for two, a < b; 0 where they are linearly dependent. */
static double gain_of_two(const struct sums *sums, int a, int b, double amplitude[2])
{
    const double aa = sums->product[a][a];
    const double bb = sums->product[b][b];
    const double ab = sums->product[b][a];
    const double ap = sums->product[GRID][a];
    const double bp = sums->product[GRID][b];
    const double determinant = aa * bb - ab * ab;
    if (!(determinant > 1e-10 * aa * bb)) {
        return 0.0;
    }
    amplitude[0] = (ap * bb - bp * ab) / determinant;
    amplitude[1] = (bp * aa - ap * ab) / determinant;
    return amplitude[0] * ap + amplitude[1] * bp;
}

static void best_one(struct gb_decay_start *start, const struct sums *sums)
{
    double most = -1.0;
    for (int a = 0; a < GRID; a++) {
        double amplitude = 0.0;
        const double gain = gain_of_one(sums, a, &amplitude);
        if (gain > most) {
            most = gain;
            start->amplitude[0] = amplitude;
            start->tau[0] = sums->tau[a];
            start->p0 = sums->mean[GRID] - amplitude * sums->mean[a];
        }
    }
}

static void best_two(struct gb_decay_start *start, const struct sums *sums)
{
    double most = -1.0;
    for (int b = 1; b < GRID; b++) {
        for (int a = 0; a < b; a++) {
            double amplitude[2] = {0.0, 0.0};
            const double gain = gain_of_two(sums, a, b, amplitude);
            if (gain > most) {
                most = gain;
                start->amplitude[0] = amplitude[0];
                start->amplitude[1] = amplitude[1];
                start->tau[0] = sums->tau[a];
                start->tau[1] = sums->tau[b];
                start->p0 = sums->mean[GRID] - amplitude[0] * sums->mean[a] -
                            amplitude[1] * sums->mean[b];
            }
        }
    }
}

bool gb_decay_start(struct gb_decay_start *start, int terms, const double *t,
                    const double *p, size_t count, struct gb_error *err)
{
    struct sums *sums = gb_alloc_array(1, sizeof *sums, err);
    if (sums == NULL) {
        return false;
    }
    double first = t[0];
    double last = t[0];
    for (size_t i = 0; i < count; i++) {
        first = fmin(first, t[i]);
        last = fmax(last, t[i]);
    }
    for (int k = 0; k < GRID; k++) {
        sums->tau[k] =
            (last - first) * shortest * pow(longest / shortest, k / (GRID - 1.0));
    }
    collect(sums, t, p, count);
    *start = (struct gb_decay_start){0};
    if (terms == 1) {
        best_one(start, sums);
    } else {
        best_two(start, sums);
    }
    gb_alloc_free(sums);
    return true;
}
