#ifndef GB_DRAW_MUTE_STDERR_H
#define GB_DRAW_MUTE_STDERR_H

/* Mesa, LLVM, fontconfig, GLib and Pango print to stderr; between begin and end it is
 * redirected to /dev/null (not thread-safe).  end takes the descriptor that begin
 * returned. */
int gb_mute_stderr_begin(void);
void gb_mute_stderr_end(int saved);

#endif
