#!/bin/sh
# The headers in include/greenbody are self-contained: each one compiles alone, as C11 and
# as C++17, in a folder with nothing but include/; C++ sees their functions as C functions.
# Without a C++ compiler its part is left out.
# Usage: headers.sh SOURCE_DIR COMPILER [ARGUMENT]...
set -u

include=$1/include
shift
warnings="-Wall -Wextra -Wpedantic -Werror"
bad=0

complain() {
    printf 'headers: %s\n' "$*"
    bad=1
}

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cp -R "$include" "$scratch"
cd "$scratch" || exit 1

cxx=
for name in c++ g++ clang++; do
    [ -n "$cxx" ] || ! command -v "$name" >/dev/null || cxx=$name
done

# Names of the functions that a header declares.
functions() {
    sed 's|^ \*.*||' "$1" | grep -o 'gb_[a-z0-9_]*(' | tr -d '(' | sort -u
}

for header in include/greenbody/*.h; do
    name=$(basename "$header")
    printf '#include "greenbody/%s"\nextern int unused;\n' "$name" >one.c
    # shellcheck disable=SC2086  # words of their own
    "$@" -std=c11 $warnings -Iinclude -c one.c -o one.o || complain "$name: not C11"
    [ -n "$cxx" ] || continue
    {
        printf '#include "greenbody/%s"\n' "$name"
        for function in $(functions "$header"); do
            printf 'extern const void *const use_%s = (const void *)&%s;\n' "$function" "$function"
        done
    } >one.cc
    # shellcheck disable=SC2086
    "$cxx" -std=c++17 $warnings -Iinclude -c one.cc -o one.o || complain "$name: not C++17"
    for function in $(functions "$header"); do
        nm -u one.o | grep -q " $function\$" || complain "$name: $function is not extern \"C\""
    done
done

[ -n "$cxx" ] || echo "headers: no C++ compiler, C11 only"
[ "$bad" -eq 0 ] && echo "headers: self-contained"
exit "$bad"
