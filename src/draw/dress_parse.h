#ifndef GB_DRAW_DRESS_PARSE_H
#define GB_DRAW_DRESS_PARSE_H

#include "draw/dress.h"

/* "coordination", "pressure", ... into colour or force; "particles", "forces", "both";
 * "z=0.5" or "z=0.5:3 d"; "corner" or "y=0.5".  Errors: GB_ERR_INPUT with what is
 * accepted. */
bool gb_dress_parse_colour(struct gb_dress_request *request, const char *text,
                           struct gb_error *err);
bool gb_dress_parse_show(struct gb_dress_request *request, const char *text,
                         struct gb_error *err);
bool gb_dress_parse_slice(struct gb_dress_request *request, const char *text,
                          struct gb_error *err);
bool gb_dress_parse_cut(struct gb_dress_request *request, const char *text,
                        struct gb_error *err);

#endif
