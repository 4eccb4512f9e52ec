#!/bin/sh
# The walls of the house, checked on the sources and on the libraries:
#   1. a layer includes only headers of itself and of the layers to its left,
#   2. what an object exports starts with gb_<file>_.
# Usage: layers.sh SOURCE_DIR [library.a | object directory]...
set -u

source=$1
shift
bad=0

# base < phys < pack < solve < measure < run < { tui, draw } < cli.  tui and draw never see
# each other; cli sees all.
below() {
    case $1 in
    base) echo "base" ;;
    phys) echo "base phys" ;;
    pack) echo "base phys pack" ;;
    solve) echo "base phys pack solve" ;;
    measure) echo "base phys pack solve measure" ;;
    run) echo "base phys pack solve measure run" ;;
    tui) echo "base phys pack solve measure run tui" ;;
    draw) echo "base phys pack solve measure run draw" ;;
    cli) echo "base phys pack solve measure run tui draw cli" ;;
    esac
}

# Layer of include/greenbody/X.h: that of src/*/X.c.  Headers without a source of their name
# are listed.
layer_of_public() {
    file=$(find "$source/src" -name "${1%.h}.c" | head -n 1)
    case ${file:-$1} in
    snapshot.h | curve.h) echo run ;;
    model.h | params.h) echo phys ;;
    status.h) echo base ;;
    *) basename "$(dirname "$file")" ;;
    esac
}

complain() {
    printf 'layers: %s\n' "$*"
    bad=1
}

check_include() { # file, its layer, the header
    case $3 in
    greenbody/*) layer=$(layer_of_public "${3#greenbody/}") ;;
    base/* | phys/* | pack/* | solve/* | measure/* | run/* | tui/* | draw/* | cli/*)
        layer=${3%%/*}
        ;;
    */*)
        [ ! -e "$source/src/$3" ] || complain "$1: unknown layer of $3"
        return
        ;;
    *)
        complain "$1: include \"$3\" without its layer"
        return
        ;;
    esac
    case " $(below "$2") " in
    *" $layer "*) ;;
    *) complain "$1: $2 must not see $3 ($layer)" ;;
    esac
}

check_file() { # file, its layer
    # shellcheck disable=SC2013  # a header has no blank in its name
    for header in $(sed -n 's/^#[ ]*include[ ]*"\(.*\)".*/\1/p' "$1"); do
        check_include "$1" "$2" "$header"
    done
}

for layer_dir in base phys pack solve measure run tui draw cli; do
    for file in "$source/src/$layer_dir"/*.[ch]; do
        [ ! -e "$file" ] || check_file "$file" "$layer_dir"
    done
done
for file in "$source"/include/greenbody/*.h; do
    check_file "$file" "$(layer_of_public "$(basename "$file")")"
done

# file:prefix pairs besides gb_<file>_: several things one file is about.
exceptions() {
    cat <<'TABLE'
publish:gb_command_ring_
batch:gb_contacts_
status:gb_error_
main:main
TABLE
}

check_symbol() { # object, file name without .c, symbol
    case $3 in
    gb_"$2" | gb_"$2"_* | __asan_* | __odr_asan* | __gcov_* | __ubsan_* | __start_* | __stop_*) return ;;
    esac
    for pair in $(exceptions); do
        case $2:$3 in
        "$pair"*) return ;;
        esac
    done
    complain "$1: exports $3, which does not start with gb_$2_"
}

# nm -A prints "lib.a:law_rod.c.o:0000 T name" or "dir/law_rod.c.o:0000 T name".
# i is left out: an ifunc's resolver appears under the function's own name.
check_exports() { # archive or object
    [ -r "$1" ] || complain "$1: cannot be read"
    nm -A -g --defined-only "$1" 2>/dev/null |
        sed -n 's/^\(.*\):[0-9a-fA-F]* [A-Zi] \([A-Za-z0-9_]*\).*$/\1 \2/p' |
        {
            while read -r where symbol; do
                object=${where##*[:/]}
                check_symbol "$where" "${object%.c.o}" "$symbol"
            done
            exit "$bad"
        } || bad=1
}

for library in "$@"; do
    if [ -d "$library" ]; then
        for object in "$library"/*.o; do
            [ ! -e "$object" ] || check_exports "$object"
        done
    else
        check_exports "$library"
    fi
done

[ "$bad" -eq 0 ] && echo "layers: the walls stand"
exit "$bad"
