#ifndef GB_DRAW_MUTE_STDERR_H
#define GB_DRAW_MUTE_STDERR_H

/* Mesa, LLVM, fontconfig, GLib and Pango complain on stderr by themselves; between begin
 * and end stderr leads nowhere.  Not for a process in which another thread has something
 * to say there.  What begin returns goes to end. */
int gb_mute_stderr_begin(void);
void gb_mute_stderr_end(int kept);

#endif
