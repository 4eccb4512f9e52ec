#include "pack/kernel/fabric_sums.h"

#include <math.h>

#include "pack/kernel/simd.h"

enum { COMPONENTS = 6, SUMS = COMPONENTS + 1 };

/* Fills the batch up to whole vectors with pairs that do not touch. */
static void pad(struct gb_fabric_sums_batch *batch)
{
    for (; batch->n % GB_LANES != 0; batch->n++) {
        const int k = batch->n;
        for (int c = 0; c < 3; c++) {
            batch->r[c][k] = 1.0;
            batch->force[c][k] = 0.0;
        }
        batch->deepest[k] = -1.0;
    }
}

GB_SIMD_LOOP void add_lanes_loop(const struct gb_fabric_sums_batch *restrict batch,
                                 double lane[GB_FABRIC_KINDS][SUMS][GB_LANES])
{
    for (int k = 0; k < batch->n; k += GB_LANES) {
        double term[SUMS][GB_LANES], weight[GB_FABRIC_KINDS][GB_LANES];
        for (int l = 0; l < GB_LANES; l++) {
            const double x = batch->r[0][k + l], y = batch->r[1][k + l],
                         z = batch->r[2][k + l];
            const double inverse2 = 1.0 / (x * x + y * y + z * z);
            const double force =
                (batch->force[0][k + l] * x + batch->force[1][k + l] * y +
                 batch->force[2][k + l] * z) *
                sqrt(inverse2);
            const double touches = batch->deepest[k + l] >= 0.0 ? 1.0 : 0.0;
            weight[GB_FABRIC_ALL][l] = touches;
            weight[GB_FABRIC_BRIDGED][l] = batch->deepest[k + l] > 0.0 ? 1.0 : 0.0;
            weight[GB_FABRIC_TENSION][l] = force < 0.0 ? touches : 0.0;
            weight[GB_FABRIC_FORCE][l] = touches * fabs(force);
            term[0][l] = x * x * inverse2;
            term[1][l] = y * y * inverse2;
            term[2][l] = z * z * inverse2;
            term[3][l] = x * y * inverse2;
            term[4][l] = x * z * inverse2;
            term[5][l] = y * z * inverse2;
            term[COMPONENTS][l] = 1.0;
        }
        for (int kind = 0; kind < GB_FABRIC_KINDS; kind++) {
            for (int s = 0; s < SUMS; s++) {
                for (int l = 0; l < GB_LANES; l++) {
                    lane[kind][s][l] += weight[kind][l] * term[s][l];
                }
            }
        }
    }
}
GB_SIMD_WIDTHS(add_lanes,
               (const struct gb_fabric_sums_batch *batch,
                double lane[GB_FABRIC_KINDS][SUMS][GB_LANES]),
               (batch, lane))

void gb_fabric_sums_add(struct gb_fabric_sums *sums, struct gb_fabric_sums_batch *batch)
{
    double lane[GB_FABRIC_KINDS][SUMS][GB_LANES] = {0};
    pad(batch);
    add_lanes(batch, lane);
    for (int kind = 0; kind < GB_FABRIC_KINDS; kind++) {
        for (int l = 0; l < GB_LANES; l++) {
            for (int s = 0; s < COMPONENTS; s++) {
                sums->tensor[kind][s] += lane[kind][s][l];
            }
            sums->weight[kind] += lane[kind][COMPONENTS][l];
        }
    }
}
