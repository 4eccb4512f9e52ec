#ifndef GB_DRAW_STYLE_PICTURE_STYLE_PARSE_H
#define GB_DRAW_STYLE_PICTURE_STYLE_PARSE_H

#include "draw/style/picture_style.h"

/* "coordination", "pressure", ... into colour or force; "particles", "forces", "both";
 * "z=0.5" or "z=0.5:3 d"; "corner" or "y=0.5".  Errors: GB_ERR_INPUT with what is
 * accepted. */
bool gb_picture_style_parse_colour(struct gb_picture_style_request *request,
                                   const char *text, struct gb_error *err);
bool gb_picture_style_parse_show(struct gb_picture_style_request *request,
                                 const char *text, struct gb_error *err);
bool gb_picture_style_parse_slice(struct gb_picture_style_request *request,
                                  const char *text, struct gb_error *err);
/* "0:200MPa" of the quantity that colours particles, with its unit, or "0:50nN" of forces:
 * of the thickest rod.  After the colour. */
bool gb_picture_style_parse_range(struct gb_picture_style_request *request,
                                  const char *text, struct gb_error *err);
bool gb_picture_style_parse_colormap(struct gb_picture_style_request *request,
                                     const char *text, struct gb_error *err);
/* Names of the scales of colours, separated by commas; g_free. */
char *gb_picture_style_parse_colormaps(void);
bool gb_picture_style_parse_cut(struct gb_picture_style_request *request,
                                const char *text, struct gb_error *err);

#endif
