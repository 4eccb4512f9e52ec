#ifndef GB_PHYS_MARKS_H
#define GB_PHYS_MARKS_H

#include "greenbody/params.h"

/* At which points of a run a state is kept (output.snapshots_at): "100 MPa; 1 GPa;
 * density = 0.5; every 20", the last for each 20th recorded point. */
enum { GB_MARKS_MAX = 16 };

struct gb_mark {
    bool by_density;
    double value; /* Pa, or density */
};

struct gb_marks {
    int count;
    struct gb_mark mark[GB_MARKS_MAX];
    int64_t every; /* recorded points; 0: none */
};

/* Errors: GB_ERR_INPUT, naming the entry and what is accepted. */
bool gb_marks_parse(const char *text, struct gb_marks *marks, struct gb_error *err);

#endif
