#ifndef GB_PACK_LIST_ESCAPED_SEARCH_H
#define GB_PACK_LIST_ESCAPED_SEARCH_H

#include <stdint.h>

#include "pack/list/missing_pairs.h"

struct gb_engine;

/* Pairs count as touching, or as within the cutoff, from a distance larger by this (d): a
 * sweep in single precision has a coarser resolution. */
#define GB_ESCAPED_SEARCH_TOLERANCE 1e-6

/* Largest number of bins to each side. */
enum { GB_ESCAPED_SEARCH_SPAN_MAX = 2 };

/* Adds the pairs of escaped particle i that are not in the list they belong to.  The search
 * covers `span` bins to each side of the particle's bin at the build. */
void gb_escaped_search_run(const struct gb_engine *engine, int64_t i, int span,
                           struct gb_missing_pairs *missing);

#endif
