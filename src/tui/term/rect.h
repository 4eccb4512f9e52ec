#ifndef GB_TUI_TERM_RECT_H
#define GB_TUI_TERM_RECT_H

/* Character cells of the screen; rows or cols 0: not shown. */
struct gb_rect {
    int row, col;
    int rows, cols;
};

#endif
