#ifndef GB_TUI_TERM_RECT_H
#define GB_TUI_TERM_RECT_H

/* A rectangle of character cells; rows or cols 0: hidden. */
struct gb_rect {
    int row, col;
    int rows, cols;
};

#endif
