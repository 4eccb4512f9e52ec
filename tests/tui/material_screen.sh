#!/bin/sh
# A material from the list of the workbench, in a real terminal.
# Usage: material_screen.sh GREENBODY PRESET_FOLDER
. "$(dirname "$0")/terminal.sh"

open_terminal
start default particles.count=200 loading.until=1MPa loading.unload_from=
shows "opens" '✓ done'
keys d
shows "d lists the materials" 'Choose a material'
shows "zirconia among them" '^.*│ zirconia'
keys y t
hides "what is typed filters" '│ zirconia'
shows "what would change is said" 'young 179.8 GPa'
shows "and what of it is guessed" 'Guessed: epsilon, yield'
keys Escape
hides "Esc closes the list" 'Choose a material'
shows "nothing has changed" 'young  *382 GPa'

# From alumina to yttria in four keys.
keys d y t Enter
shows "Enter sets it" 'young  *179.8 GPa'
shows "its name too" 'name  *yttria'
shows "and the header" '^ greenbody  yttria 10 nm, set II'
hides "and closes the list" 'Choose a material'
told "an event says so" 'material yttria'
keys c
shows "the command repeats it" "material.name=yttria"
keys c
hides "c closes it" 'material.name=yttria'

mkdir -p "$here/config/greenbody/presets/materials"
printf '[material]\nname = half\n' >"$here/config/greenbody/presets/materials/half.ini"
keys d half
shows "one that is none is told" 'no material.young'
keys Enter
shows "and not taken" 'Choose a material'
keys Escape
shows "the material stays" 'name  *yttria'

keys d
keys zirc Enter
shows "another one" 'young  *210 GPa'
keys r
kept() {
    grep -qs '^young = 210 GPa' "$here"/state/greenbody/runs/*/preset.ini
}
until_true kept
result "is kept in a run" $?
leaves "quits"

echo "1..$tests"
exit "$bad"
