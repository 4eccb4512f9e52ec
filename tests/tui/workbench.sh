#!/bin/sh
# The workbench in a real terminal, as a user meets it.
# Usage: workbench.sh GREENBODY PRESET_FOLDER
. "$(dirname "$0")/terminal.sh"
# The header says "quick cell" while that is what runs.
full_cell_runs() {
    screen | head -n 1 | grep -q '▶ running'
}

runs_or_asks() {
    full_cell_runs || has 'the full cell takes long'
}

# Where the machine is so slow that the full cell would take over an hour it waits for r.
full_cell_follows() {
    until_true runs_or_asks && full_cell_runs && return
    keys r
    until_true has 'A long run: start it?' && keys y && until_true full_cell_runs
}


open_terminal

# --- the default scene
start default
shows "opens the default preset" 'Pressure against relative density'
[ "$bad" -eq 0 ] || { # without it every step below would end at its limit
    echo "Bail out! the workbench does not open"
    exit 1
}
grows "the curve grows"
is "dots of braille" until_true has_braille
shows "parameters are listed" 'Parameters'
shows "state is shown" 'State'
shows "events are shown" 'Events'

# --- editing
# By itself the full cell follows in a second or two, and the marks of an edit are gone: where
# those are looked at it waits.
shows "its run comes to its end" '✓ done'
keys a
shows "a lets the full cell wait for r" 'the full cell waits for r'
keys g
is "focus reaches mu" go_to mu
keys Enter C-u abc Enter
shows "a bad value is refused with the reason" 'contact.mu = abc: must be'
keys C-u 0.2 Enter
shows "a good value is marked" '^\*mu  *0\.2'
shows "what applies when is said" 'the quick cell runs first'
shows "a quick cell answers" 'q quick cell'
told "behind it the full one waits" 'r starts the full cell'
keys a
shows "a lets it follow by itself" 'the full cell follows'
keys Enter C-u 0.3 Enter
is "the full cell follows" until_true [ -e "$runs/default-2/curve.csv" ]
grows "the new curve grows"
told "which is told among the events" 'run 2 started'
shows "the earlier run is named by what differed" 'b mu 0\.1'
shows "and the quick cell before it" 'a quick: mu 0\.2'
keys r
is "r starts anew" until_true [ -e "$runs/default-3/curve.csv" ]
keys Enter C-u 0.25 Escape
shows "Esc leaves the value" '^ mu  *0\.3'
keys a
shows "a lets the full cell wait again" 'the full cell waits for r'
keys +
shows "+ turns it up" '^[*]mu  *0\.32'
keys -
shows "- turns it down again" '^ mu  *0\.3 '
keys a
shows "a run comes to its end" '✓ done'

# --- an idle screen sends nothing
is "an idle screen sends nothing" until_true sends_nothing

# --- views and dialogs
keys L
shows "L makes the axis logarithmic" '(log)'
keys 2
shows "2 shows contacts" '2 Distribution of the coordination'
keys 3
shows "3 shows directions" '3 Mean normal force'
keys 4
shows "4 shows the steps of a quasi-static run" '4 Pressure against step'
is "its loading is one line" [ "$(screen | grep -c "● loading")" -eq 1 ]
keys 1 '?'
shows "? lists the keys" 'Keys and glossary'
keys Escape
hides "Esc closes the help" 'Keys and glossary'
keys w
shows "w asks for a name" 'Save the parameters'
keys C-u mine Enter
shows "saves" 'saved as'
is "the preset stands on disk" grep -q '^mu *= *0.3' "$here/config/greenbody/presets/mine.ini"
keys w C-u mine Enter
shows "does not replace silently" 'exists: Enter again'
keys Escape o
shows "o lists presets" 'Open a preset'
shows "its own among them" 'mine'
keys set2-38
shows "what is typed filters" 'P1 set II, 38 nm'
shows "what differs is said" 'diameter 38 nm'
hides "others are gone" 'p1-set1-biaxial'
keys Escape
hides "Esc closes the list" 'Open a preset'
keys c
shows "c shows the command" 'greenbody run mine'
keys c
hides "c closes it" 'greenbody run mine'

# --- a picture from the stored run, made beside the screen
keys s
shows "s asks what to show" 'colour *coordination number'
keys Down Right Down Right
shows "a choice is changed" 'colour *pressure'
shows "another" '< the nearest corner >'
keys Escape
hides "Esc makes none" 'coordination number'
keys s
shows "as it opens it is the usual picture" '< particles >'
keys Enter
if "$greenbody" --version | grep -q 'no pictures'; then
    told "s says that there are no pictures" 'this build has no pictures'
else
    told "s makes a picture" 'picture saved:'
    hides "and is no longer told to be at it" 'rendering'
    is "and it is there" [ -s "$(ls "$runs"/default-*/picture-1.png)" ]
fi

# --- an experiment over the plot
printf 'density,p_MPa\n0.4,100\n0.55,500\n' >"$here/experiment.csv"
printf 'density,force\n0.4,100\n' >"$here/other.csv"
keys e "$here/exp" Tab Enter
shows "an experiment is drawn" '▲ measured, RMS misfit'
keys e C-u "$here/other.csv" Enter
shows "a force without its unit is a question" 'in which unit'
keys Escape
hides "Esc leaves the experiment" 'How is this file read'
printf 'Druck (MPa);Dichte (%%)\n100;40,5\n500;55,5\n' >"$here/german.csv"
keys e C-u "$here/german.csv" Enter
shows "how a spreadsheet was read is an event" 'german.csv: between'
printf 'Druck (MPa);Dichte (%%)\n1,125;40\n2,125;55\n' >"$here/t.csv"
keys e C-u "$here/t.csv" Enter
shows "1,125 is a question" 'is it 1.125 (decimal comma)'
keys Enter
hides "which its first answer settles" 'How is this file read'
shows "by a decimal comma" '2 points, 1.125'
keys e C-u Enter
hides "an empty name removes it" '▲ measured'
keys q
shows "q leaves at once when the run is over" 'status=0'
is "the terminal is back" terminal_is_back

# --- a longer run: pause, freeze, sizes
start "$long"
shows "opens with settings" 'N 6000'
is "the full cell follows its quick one" full_cell_follows
told "how long it takes is estimated" 'full cell of 6000: about [0-9]'
keys p
shows "p pauses the engine" '‖ paused'
keys p
hides "p again resumes it" '‖ paused'
is "it runs again" until_true full_cell_runs
keys f C-u 'mu=0.3; count=3' Enter
shows "a what-if says what can change" 'count=3: cannot change during a run'
keys C-u 'mu=0.3' Enter
told "a what-if goes on from a point" 'changed after step'
is "from then on it runs" until_true full_cell_runs
keys c
shows "the command repeats it" 'loading.changes='
keys c Space
shows "space freezes the view" 'view frozen'
keys Space
hides "space again lets it go" 'view frozen'
term resize-window -x 60 -y 20
hides "60 x 20 has one pane" 'State'
keys Tab
shows "60 x 20 shows the plot" 'Pressure against relative density'
shows "60 x 20 shows the state" 'State'
term resize-window -x 30 -y 10
shows "too small says so" 'needs 40 x 12'
term resize-window -x 200 -y 60
shows "200 x 60 spells names out" 'mean coordination number'
shows "nothing was lost" 'run 1 started'
term resize-window -x 80 -y 24
is "80 x 24 again" until_true fits_80
keys C-z
shows "Ctrl-Z gives the shell" 'Stopped'
keys "clear; fg; echo status=\$?" Enter
shows "fg brings the screen back" 'Parameters'
keys q
shows "q asks while a run is live" 'Quit?'
keys n
hides "n goes back" 'Quit?'
keys q
shows "q asks again" 'Quit?'
keys y
shows "y quits" 'status=0'
is "the terminal is back after y" terminal_is_back

# --- a run that takes long is asked about; stages of a dynamic run
start p2-v5
shows "a long run is asked about" 'A long run: start it?'
shows "with its time" 'This run will take about'
shows "with what makes it cheaper" 'loading.rate'
shows "and is not started" 'not started'
keys n
hides "n leaves it" 'A long run: start it?'
shows "what follows is said" 'r asks again'
shows "its parameters stay" 'P2 2D, rate v5'
shows "still not started" 'not started: declined'
keys r
shows "r asks again" 'A long run: start it?'
keys Escape
hides "Esc leaves it, too" 'A long run: start it?'
keys g
is "focus reaches the rate" go_to rate
keys Enter C-u '6.8e8 1/s' Enter
shows "a cheaper rate is typed" '^ rate  *680 1/us'
is "focus reaches the first stage" go_to relax
keys Enter C-u '1 ns' Enter
keys r
is "the cheaper run starts" until_true [ -e "$runs/p2-v5-1/curve.csv" ]
is "it is not asked about" has_not 'A long run'
shows "the stage is told" 'stage  *[a-z]'
shows "energies have a unit" 'work  *[0-9.]* [a-z]*J'
keys f
shows "a what-if is refused with the reason" 'only quasi-static runs'
hides "its quick cell comes to its end behind it" '▶ quick cell'
shows "the refusal stays" 'only quasi-static runs'
is "and so does the run that r started" has_not 'same parameters'
keys 4
shows "4 shows pressure against time" '4 Pressure against time'
shows "in nanoseconds" 't, ns'
shows "compression is named" '● compress'
shows "holding is named" '◇ hold'
term resize-window -x 60 -y 20
shows "60 x 20 has one pane of it" '^── Parameters'
keys Tab
shows "60 x 20 shows the stage" 'stage  *[a-z]'
term resize-window -x 80 -y 24
# held for so long that no machine is through with it before it is asked to quit
keys Tab g
is "focus reaches the last stage" go_to hold
keys Enter C-u '100 us' Enter
keys r
shows "a long stage is asked about" 'A long run: start it?'
keys y
shows "y starts it" '▶ running'
keys q
shows "q asks while it runs" 'Quit?'
keys y
shows "and quits" 'status=0'

# --- other ways out
start "$long"
shows "opens again" 'Parameters'
keys C-c
shows "Ctrl-C asks" 'Quit?'
keys C-c
shows "Ctrl-C again leaves" 'status=130'
is "the terminal is back after Ctrl-C" terminal_is_back
keep_pid="sh -c 'echo \$\$ >$here/pid; exec $greenbody $long'"
keys "clear; $keep_pid; echo status=\$?" Enter
shows "opens a third time" 'Parameters'
kill -TERM "$(cat "$here/pid")"
shows "SIGTERM leaves" 'status=143'
is "the terminal is back after SIGTERM" terminal_is_back
rm -rf "$here/state"
keep_pid="sh -c 'echo \$\$ >$here/pid; exec $greenbody default particles.count=6000 \
output.checkpoint_every=0.1s'"
keys "clear; ulimit -c 0; $keep_pid; echo status=\$?" Enter
shows "opens a fourth time" 'Parameters'
is "a checkpoint is written" until_true eval 'ls "$here"/state/greenbody/runs/*/state.h5 >"$here/ls" 2>&1'
kill -SEGV "$(cat "$here/pid")"
shows "a crash is told" 'the program has failed'
shows "with its last checkpoint" 'greenbody resume'
shows "with a status of its own" 'status=[1-9]' # 139, or what a sanitizer says
is "the terminal is back after a crash" terminal_is_back

# --- other terminals
with='LC_ALL=C' start default
shows "without UTF-8 it opens" 'Parameters'
grows "without UTF-8 the curve grows"
is "without UTF-8 all is ASCII" eval '! screen | LC_ALL=C grep -q "[^ -~]"'
leaves "and closes"
with='NO_COLOR=1' start default
grows "with NO_COLOR the curve grows"
is "with NO_COLOR there is none" \
    eval '! term capture-pane -p -e | grep -q "$(printf "\033")\[[0-9;]*[34][0-8]"'
leaves "and closes, too"
with='TERM=of-tomorrow' start default
shows "an unknown terminal gets the usual one" 'Parameters'
leaves "and closes as well"
with='TERM=dumb' start default
shows "a dumb terminal gets one line" 'dumb cannot position the cursor'
shows "and status 3" 'status=3'

# --- the terminal goes away
# where the run is not to outlive it (life.sh is about those that do)
keys "clear; sh -c 'echo \$\$ >$here/pid; exec $greenbody $long \
output.on_hangup=stop'" Enter
shows "opens a last time" 'Parameters'
pid=$(cat "$here/pid")
close_terminal
is "ends when the terminal is closed" until_true eval "! kill -0 $pid 2>/dev/null"

echo "1..$tests"
exit "$bad"
