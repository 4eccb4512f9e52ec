#!/bin/sh
# The layers, checked on the sources and on the libraries:
#   1. a layer includes only headers of itself and of the layers that it may see,
#   2. no two layers see each other,
#   3. an exported symbol starts with gb_<file>_,
#   4. no two files, struct, union or enum tags of one name; no file takes the symbols of another,
#   5. the files of the periodic engine call each other in one direction only (docs/engine.md),
#   6. another file uses each exported symbol.
# Usage: layers.sh SOURCE_DIR [library.a | object directory]...
set -u

source=$1
shift
bad=0
layers="base hdf law scene pack solve measure io run many study api runner draw figures tui cli"

# What each layer sees besides itself.  `draw`, `study` and `tui` stand beside each other.
below() {
    core="base hdf law scene pack solve measure io run"
    case $1 in
    many | draw) echo "$core" ;;
    study) echo "$core many" ;;
    tui) echo "$core many study api runner" ;;
    figures) echo "$core many study draw" ;;
    api) echo "$core many study" ;;
    runner) echo "$core many study api" ;;
    cli) echo "$core many study api runner draw figures tui" ;;
    *) echo "${core%%"$1"*}" ;;
    esac
}

# Layer of a header in include/greenbody.
layer_of_public() {
    case $1 in
    dimension.h | status.h) echo base ;;
    params.h | stage.h) echo scene ;;
    curve.h | point.h | snapshot.h | view_sample.h) echo io ;;
    outcome.h) echo run ;;
    array.h | contact_law.h | greenbody.h | parameters.h | recorded_run.h | \
        saved_state.h | simulation.h) echo api ;;
    *) echo unknown ;;
    esac
}

complain() {
    printf 'layers: %s\n' "$*"
    bad=1
}

check_include() { # file, its layer, the header
    case $3 in
    greenbody/*) layer=$(layer_of_public "${3#greenbody/}") ;;
    */*) layer=${3%%/*} ;;
    *) layer= ;;
    esac
    case " $2 $(below "$2") " in
    *" $layer "*) ;;
    *) complain "$1: $2 must not see $3" ;;
    esac
}

is_made() { # a header that the build writes
    grep -qs "output : '$(basename "$1")'" "$source/src/$(dirname "$1")/meson.build"
}

check_includes_of() { # layer, files
    layer_name=$1
    shift
    sed -n 's/^#[ ]*include[ ]*"\(.*\)".*/\1/p' "$@" | sort -u >"$scratch/headers"
    while read -r header; do
        check_include "$layer_name" "$layer_name" "$header"
        [ -e "$source/src/$header" ] || [ -e "$source/include/$header" ] ||
            is_made "$header" || complain "$layer_name: no header $header"
    done <"$scratch/headers"
}

check_cycles() {
    for one in $layers; do
        for other in $(below "$one"); do
            case " $(below "$other") " in
            *" $one "*) complain "$one and $other see each other" ;;
            esac
        done
    done
}

# Prints every line of standard input that stands there more than once.
repeated() {
    sort | uniq -d
}

sources() { # name pattern
    find "$source/src" "$source/include" -name "$1"
}

check_names() {
    for ending in c h; do
        for name in $(sources "*.$ending" | sed 's|.*/||' | repeated); do
            complain "two files are called $name"
        done
    done
    for tag in $(sources '*.[ch]' | xargs sed -n \
        's/^\(struct\|union\|enum\) \([a-zA-Z0-9_]*\)[ ]*{.*/\2/p' | grep '^gb_' | repeated); do
        complain "two definitions of the tag $tag"
    done
}

# file:prefix pairs besides gb_<file>_: several things one file is about.
exceptions() {
    cat <<'TABLE'
publish:gb_command_ring_
status:gb_error_
simulation_read:gb_simulation_
main:main
cmd_compact:gb_cmd_
cmd_run:gb_cmd_
cmd_runs:gb_cmd_
TABLE
}

# nm -A prints "lib.a:law_rod.c.o:0000 T name" or "dir/law_rod.c.o:0000 T name".  An object of
# a folder inside a layer is called folder_law_rod.c.o there.  The symbols of figure_page.c start
# with gb_figure_ too: the longest file name that fits owns a symbol.
# i is left out: an ifunc's resolver appears under the function's own name.
check_exports() { # archive or object
    [ -r "$1" ] || complain "$1: cannot be read"
    exceptions >"$scratch/exceptions"
    nm -A -g --defined-only "$1" 2>/dev/null |
        sed -n 's/^\(.*\):[0-9a-fA-F]* [A-Zi] \([A-Za-z0-9_]*\).*$/\1 \2/p' |
        awk -v scratch="$scratch" '
            function owner(symbol) {
                sub(/^gb_/, "", symbol)
                while (symbol != "" && !(symbol in stem)) {
                    if (!sub(/_[^_]*$/, "", symbol)) { return "" }
                }
                return symbol
            }
            BEGIN {
                while ((getline line < (scratch "/stems")) > 0) { stem[line] = 1 }
                while ((getline line < (scratch "/objects")) > 0) {
                    split(line, part, "\t")
                    file[part[1]] = part[2]
                }
                while ((getline line < (scratch "/exceptions")) > 0) { allowed[line] = 1 }
            }
            $2 !~ /^__(asan|odr_asan|gcov|ubsan|start|stop)_?/ {
                object = $1
                sub(/.*[:\/]/, "", object)
                sub(/\.c\.o$/, "", object)
                name = object in file ? file[object] : object
                if ($2 ~ /^gb_/ && owner($2) == name) { next }
                for (pair in allowed) {
                    if (index(name ":" $2, pair) == 1) { next }
                }
                print $1 ": exports " $2 ", which does not start with gb_" name \
                    "_ or belongs to another file"
            }' >"$scratch/wrong"
    while read -r line; do
        complain "$line"
    done <"$scratch/wrong"
}

check_calls() { # archive
    nm -A -g "$1" 2>/dev/null | awk '
        {
            split($1, part, ":")
            object = part[2]
            kind = $(NF - 1)
            sub(/.*\//, "", object)
        }
        object !~ /^(cell|f32|kernel|list)_/ { next }
        kind == "U" { user[++uses] = object; used[uses] = $NF; next }
        { owner[$NF] = object }
        END {
            for (k = 1; k <= uses; k++) {
                called = owner[used[k]]
                if (called != "" && called != user[k]) { print user[k], called }
            }
        }' | sort -u | tsort 2>"$scratch/cycle" >"$scratch/order"
    if [ -s "$scratch/cycle" ]; then
        complain "$1: files call each other in a circle: $(sed 's/.*: //' "$scratch/cycle" | tr '\n' ' ')"
    fi
    [ -s "$scratch/order" ] || complain "$1: no calls between its files"
}

# "name file" of each name of ours in a source, without the header that declares it.
list_uses() {
    find "$source/src" "$source/tests" "$source/examples" -name '*.[ch]' |
        xargs grep -oE '\<gb_[a-zA-Z0-9_]+\>' | sed 's|^.*/||; s|\.[ch]:| |' |
        awk '{ print $2 " " $1 }' | sort -u
}

# Functions of include/greenbody are for programs that use the library.
check_uses() { # archives and object directories
    list_uses >"$scratch/uses"
    cat "$source"/include/greenbody/*.h | grep -oE '\<gb_[a-zA-Z0-9_]+\>' | sort -u >"$scratch/public"
    for library in "$@"; do
        if [ -d "$library" ]; then set -- "$library"/*.o; else set -- "$library"; fi
        nm -A -g --defined-only "$@" 2>/dev/null
    done | awk '$2 ~ /^[TDRB]$/ && $3 ~ /^gb_/ { print $3 }' | sort -u >"$scratch/exported"
    awk -v public="$scratch/public" '
        BEGIN { while ((getline line < public) > 0) { known[line] = 1 } }
        FILENAME ~ /uses$/ { files[$1]++; next }
        files[$1] < 2 && !($1 in known) { print $1 }' "$scratch/uses" "$scratch/exported" \
        >"$scratch/unused"
    while read -r name; do
        complain "no other file uses $name: make it static"
    done <"$scratch/unused"
    [ -s "$scratch/exported" ] || complain "no exported symbols"
}

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
(cd "$source/src" && find . -name '*.c') | sed 's|^\./||; s|\.c$||' >"$scratch/paths"
sed 's|.*/||' "$scratch/paths" >"$scratch/stems"
sources '*.h' | sed 's|.*/||; s|\.h$||' >>"$scratch/stems"
# meson's name of an object ("folder_file" or "file", seen from the layer) and the file's own
awk -F/ '{ name = $2; for (k = 3; k <= NF; k++) { name = name "_" $k }
           print name "\t" $NF }' "$scratch/paths" >"$scratch/objects"

for name in $layers; do
    [ -d "$source/src/$name" ] || continue
    # shellcheck disable=SC2046  # no file has a blank in its name
    check_includes_of "$name" $(find "$source/src/$name" -name '*.[ch]')
done
for name in "$source"/src/*/; do
    case " $layers " in
    *" $(basename "$name") "*) ;;
    *) complain "$name is no layer" ;;
    esac
done
for file in "$source"/include/greenbody/*.h; do
    check_includes_of "$(layer_of_public "$(basename "$file")")" "$file"
done
check_cycles
check_names
for library in "$@"; do
    if [ -d "$library" ]; then
        for object in "$library"/*.o; do
            [ ! -e "$object" ] || check_exports "$object"
        done
    else
        check_exports "$library"
    fi
    case $library in
    */libpack.a) check_calls "$library" ;;
    esac
done
check_uses "$@"

[ "$bad" -eq 0 ] && echo "layers: no violation"
exit "$bad"
