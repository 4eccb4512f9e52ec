#include "tui/app/keys.h"

#include <ncurses.h>

enum { CTRL_L = 'L' & 31 };

/* Every action has a plain letter: terminals and multiplexers eat function keys. */
static const struct gb_key table[] = {
    {{KEY_UP, 'k'}, "Up k", NULL, "up", GB_ACTION_UP},
    {{KEY_DOWN, 'j'}, "Down j", NULL, "down", GB_ACTION_DOWN},
    {{KEY_LEFT, 'h'}, "Left h", NULL, "plot: cursor to the point before", GB_ACTION_LEFT},
    {{KEY_RIGHT, 'l'},
     "Right l",
     NULL,
     "plot: cursor to the next point",
     GB_ACTION_RIGHT},
    {{KEY_PPAGE, '['}, "PgUp [", NULL, "one page or ten points back", GB_ACTION_PAGE_UP},
    {{KEY_NPAGE, ']'}, "PgDn ]", NULL, "one page or ten points on", GB_ACTION_PAGE_DOWN},
    {{KEY_HOME, 'g'}, "Home g", NULL, "to the beginning", GB_ACTION_HOME},
    {{KEY_END, 'G'}, "End G", NULL, "to the end", GB_ACTION_END},
    {{'\t', 'n'}, "Tab n", "pane", "next pane", GB_ACTION_NEXT_PANE},
    {{KEY_BTAB, 'N'}, "S-Tab N", NULL, "previous pane", GB_ACTION_PREVIOUS_PANE},
    {{'\n', '\r', KEY_ENTER, 'i'},
     "Enter i",
     "edit",
     "change the parameter; accept",
     GB_ACTION_ENTER},
    {{GB_KEY_ESCAPE}, "Esc", NULL, "one level back; cursor off", GB_ACTION_BACK},
    {{'/'}, "/", NULL, "find a parameter by its name", GB_ACTION_FIND},
    {{'+', '='},
     "+ =",
     "turn",
     "turn the parameter up, or to the next choice",
     GB_ACTION_MORE},
    {{'-', '_'}, "- _", NULL, "turn the parameter down", GB_ACTION_LESS},
    {{'u'}, "u", NULL, "parameter back to what the run uses", GB_ACTION_UNDO},
    {{'r'},
     "r",
     "run",
     "start with the parameters shown; asks if costly",
     GB_ACTION_RESTART},
    {{'p'}, "p", "pause", "pause or resume the engine", GB_ACTION_PAUSE},
    {{' '}, "Space", "freeze", "freeze the view; the engine goes on", GB_ACTION_FREEZE},
    {{'1'}, "1", NULL, "pressure against density", GB_ACTION_VIEW_CURVE},
    {{'2'}, "2", NULL, "contacts per particle", GB_ACTION_VIEW_HISTOGRAM},
    {{'3'}, "3", NULL, "contact force against direction", GB_ACTION_VIEW_ROSE},
    {{'4'}, "4", NULL, "pressure against time, or against step", GB_ACTION_VIEW_TIME},
    {{'5'}, "5", NULL, "radial distribution function", GB_ACTION_VIEW_DISTANCES},
    {{'6'}, "6", NULL, "lateral over axial pressure", GB_ACTION_VIEW_RATIO},
    {{'7'}, "7", NULL, "law: normal force of two particles", GB_ACTION_VIEW_FORCE},
    {{'8'}, "8", NULL, "law: strength of a bridge", GB_ACTION_VIEW_STRENGTH},
    {{'9'}, "9", NULL, "the packing itself", GB_ACTION_VIEW_PACKING},
    {{'0'}, "0", NULL, "error against cost, from a chart.csv", GB_ACTION_VIEW_CHART},
    {{'v'}, "v", "view", "next view", GB_ACTION_NEXT_VIEW},
    {{'V'}, "V", NULL, "previous view", GB_ACTION_PREVIOUS_VIEW},
    {{'L'}, "L", "log", "logarithmic or linear pressure", GB_ACTION_LOG},
    {{'m'}, "m", NULL, "show or hide earlier runs", GB_ACTION_EARLIER},
    {{'b'}, "b", NULL, "draw with braille, blocks or ASCII", GB_ACTION_GLYPHS},
    {{'f'}, "f", NULL, "what if the run went on with other values", GB_ACTION_FORK},
    {{'a'},
     "a",
     NULL,
     "full cell behind the quick one: by itself, or r",
     GB_ACTION_FOLLOW},
    {{'A'}, "A", NULL, "list all parameters, or those in use", GB_ACTION_ALL},
    {{'e'}, "e", "data", "experiment over the plot, or a chart.csv", GB_ACTION_DATA},
    {{'c'}, "c", NULL, "the command that repeats the run", GB_ACTION_COMMAND},
    {{'t'}, "t", NULL, "take over the run that is attached", GB_ACTION_TAKE_OVER},
    {{'s'}, "s", NULL, "picture of the packing as last stored", GB_ACTION_PICTURE},
    {{'x'}, "x", NULL, "report on the run, a folder to hand in", GB_ACTION_REPORT},
    {{'R'}, "R", NULL, "more cells of this scene: mean and band", GB_ACTION_CELLS},
    {{'C'}, "C", NULL, "fit parameters to the experiment", GB_ACTION_FIT},
    {{'w'}, "w", "save", "save the parameters as a preset", GB_ACTION_SAVE},
    {{'o'}, "o", "open", "open a preset and run it", GB_ACTION_OPEN},
    {{'M'}, "M", NULL, "mouse on or off (Shift-drag selects text)", GB_ACTION_MOUSE},
    {{CTRL_L}, "^L", NULL, "paint the screen anew", GB_ACTION_REPAINT},
    {{'?', KEY_F(1)}, "? F1", "help", "this list", GB_ACTION_HELP},
    {{'q', KEY_F(10)}, "q F10", "quit", "quit; asks while a run is live", GB_ACTION_QUIT},
};

const struct gb_key *gb_keys_table(size_t *count)
{
    *count = sizeof table / sizeof table[0];
    return table;
}

enum gb_action gb_keys_action(int code)
{
    for (size_t i = 0; i < sizeof table / sizeof table[0]; i++) {
        for (int k = 0; k < GB_KEYS_PER_ROW && table[i].code[k] != 0; k++) {
            if (table[i].code[k] == code) {
                return table[i].action;
            }
        }
    }
    return GB_ACTION_NONE;
}
