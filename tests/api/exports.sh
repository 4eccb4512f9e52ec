#!/bin/sh
# The library shows the functions of its installed headers and no others, and takes no function
# from the system that prints, exits or handles signals.
# Usage: exports.sh LIBRARY HEADER...
set -u

library=$1
shift
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
bad=0

sed 's|^ \*.*||' "$@" | grep -o '\bgb_[a-z0-9_]*(' | tr -d '(' | sort -u >"$scratch/declared"
nm -D --defined-only "$library" | sed -n 's/.* T \([a-z0-9_]*\)@@GREENBODY_0$/\1/p' | sort -u \
    >"$scratch/shown"
nm -D --defined-only "$library" | awk '$2 != "A" { print $3 }' | sed 's/@@.*//' | sort -u \
    >"$scratch/all"
diff "$scratch/declared" "$scratch/shown" >"$scratch/difference" || {
    echo "exports: declared (<) and shown (>) functions differ:"
    cat "$scratch/difference"
    bad=1
}
# what a sanitizer adds is not ours
grep -v '^gb_\|^_*asan\|^_*odr_asan\|^_*ubsan\|^_*tsan\|^_*gcov' "$scratch/all" && {
    echo "exports: these are shown besides"
    bad=1
}
nm -D --undefined-only "$library" | sed 's/.* U //; s/@.*//' |
    grep -x 'exit\|_exit\|_Exit\|quick_exit\|abort\|printf\|vprintf\|puts\|putchar\|perror\|fork\|signal\|sigaction\|__printf_chk\|__vprintf_chk\|psignal\|alarm' && {
    echo "exports: the library may not call these"
    bad=1
}
[ -s "$scratch/shown" ] || bad=1
[ "$bad" -eq 0 ] && echo "exports: $(wc -l <"$scratch/shown") functions"
exit "$bad"
