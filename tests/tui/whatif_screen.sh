#!/bin/sh
# A key by mistake ends no what-if and no long run; what a what-if leaves is told and can be
# dropped.
# Usage: whatif_screen.sh GREENBODY PRESET_FOLDER
. "$(dirname "$0")/terminal.sh"

open_terminal
start "$long"
is "a long run starts" until_true runs_fully
keys g
is "focus reaches mu" go_to mu
keys f C-u 'mu=0.3' Enter
told "a what-if goes on" 'changed after step'
keys =
shows "a mistaken = changes a value" '^[*]mu '
told "its quick cell answers" 'quick cell of'
told "the what-if is not replaced" 'the what-if continues; r'
is "it still runs" until_true runs_fully
is "there is no third run" runs_number 2

# --- what it leaves
keys r
told "r replaces it" 'run 3 started'
shows "its changes are told" 'this run has the changes after step [0-9]* contact.mu=0\.3; D'
told "and stay among the events" 'this run has the changes after'
keys D
told "D drops them" 'dropped: the changes'
keys Escape D
shows "once" 'no changes during the run to drop'
leaves "quits"

# --- a long run
start "$long"
is "another long run starts" until_true runs_fully
keys g
is "focus reaches mu" go_to mu
keys =
told "a mistaken = has a quick cell" 'quick cell of'
told "the run is not replaced" 'the current run continues; r'
is "it still runs" until_true runs_fully
leaves "quits"

echo "1..$tests"
exit "$bad"
