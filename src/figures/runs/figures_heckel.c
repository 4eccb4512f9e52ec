#include "figures/figures_compute.h"
#include "figures/runs/compaction_series.h"

bool gb_figures_heckel(struct gb_series *series, const struct gb_figures_input *input,
                       struct gb_error *err)
{
    return gb_compaction_series_runs(series, input->set, gb_compaction_series_heckel,
                                     err);
}
