#!/bin/sh
# What `meson install` leaves is complete, found from anywhere and by any user, wherever it is
# moved, and goes away whole.  Usage: install.sh GREENBODY PRESETS BUILD_FOLDER MESON
build=$3
meson=$4
. "$(dirname "$0")/folder.sh"
unset GB_PRESET_DIR GB_DATA_DIR
chmod 755 "$here"
prefix=$("$meson" introspect --buildoptions "$build" | tr '{' '\n' |
    sed -n 's/.*"name": "prefix", "value": "\([^"]*\)".*/\1/p')

# the list of a real installation is kept for its own removal
list=$build/meson-logs/install-log.txt
[ ! -f "$list" ] || cp "$list" kept-list
put_back() {
    if [ -f "$here/kept-list" ]; then
        cp "$here/kept-list" "$list"
    else
        rm -f "$list"
    fi
    end_engines
    rm -rf "$here"
}
trap put_back EXIT

installs() {
    DESTDIR=$here/dest "$meson" install -C "$build" --no-rebuild --quiet >stdout 2>stderr
}
is 'it is installed below DESTDIR' installs
root=$here/dest$prefix

all_there() {
    for file in bin/greenbody share/man/man1/greenbody.1 share/man/man1/greenbody-run.1 \
        share/greenbody/presets/default.ini \
        share/greenbody/presets/materials/yttria.ini share/greenbody/data/papers.csv \
        share/bash-completion/completions/greenbody share/zsh/site-functions/_greenbody \
        share/fish/vendor_completions.d/greenbody.fish include/greenbody/greenbody.h; do
        [ -f "$root/$file" ] || {
            echo "no $file" >stderr
            return 1
        }
    done
    for file in greenbody.pc libgreenbody.so.0 libgreenbody.a; do
        [ -n "$(find "$root" -name "$file")" ] || {
            echo "no $file" >stderr
            return 1
        }
    done
}
is 'program, pages, presets, data, completions and headers are there' all_there

every_page() {
    "$root/bin/greenbody" --commands | while read -r name _; do
        [ -s "$root/share/man/man1/greenbody-$name.1" ] || exit 1
    done
}
is 'every command has its manual page' every_page

# From / as another user, which only root may; otherwise from / at least.
other=65534
why_not=
if [ "$(id -u)" -ne 0 ]; then
    why_not='only root may start programs as another user'
elif ! command -v setpriv >/dev/null; then
    why_not='no setpriv here'
fi
as_other() {
    if [ -z "$why_not" ]; then
        (cd / && setpriv --reuid=$other --regid=$other --clear-groups env -i \
            PATH=/usr/bin:/bin HOME=/nonexistent LC_ALL=C.UTF-8 ASAN_OPTIONS=detect_leaks=0 \
            "$@") >stdout 2>stderr
    else
        (cd / && env HOME=/nonexistent "$@") >stdout 2>stderr
    fi
}
# A folder that any user may write to.
mkdir out
chmod 777 out

works() { # program
    as_other "$1" --help && grep -q '^  p1-set1-uniaxial' stdout &&
        as_other "$1" run p3-cycle particles.count=-1
    [ $? -eq 2 ] && grep -q 'particles.count' stderr &&
        as_other "$1" run default particles.count=100 structure.base='4 d' \
            loading.until='2 MPa' loading.unload_from='1 MPa' --quiet --out "$2" &&
        [ -s "$2/curve.csv" ]
}
is 'presets are found from another folder' works "$root/bin/greenbody" "$here/out/first"
if [ -z "$why_not" ]; then
    is 'by another user, whose run it is' \
        [ "$(find out/first -user $other -type f | wc -l)" -ge 4 ]
else
    tests=$((tests + 1))
    echo "ok $tests by another user # SKIP $why_not"
fi

names_data() { # program: the numbers of the papers, too
    as_other "$1" papers --only no-such --out "$here/out/p"
    [ $? -eq 2 ] && grep -q 'no-such' stderr && ! grep -q 'papers.csv' stderr
}
is 'the numbers of the papers are found' names_data "$root/bin/greenbody"

mv "$root" "$here/moved"
is 'so are they from a prefix that was moved' works "$here/moved/bin/greenbody" \
    "$here/out/second"
same_points() { # all columns but the last ones, which are times
    for run in first second; do
        grep -v '^#' "out/$run/curve.csv" | cut -d, -f1-11 >"$run.points"
    done
    [ "$(wc -l <first.points)" -gt 2 ] && cmp first.points second.points >stdout
}
is 'and the same points come out' same_points

told_folders() {
    "$here/moved/bin/greenbody" run no-preset >stdout 2>stderr
    [ $? -eq 2 ] && grep -q "$here/config/greenbody/presets" stderr &&
        grep -q "$here/moved/share/greenbody/presets" stderr
}
is 'the message about a missing preset names the folders' told_folders

mv "$here/moved" "$root"
nothing_left() {
    DESTDIR='' ninja -C "$build" uninstall >stdout 2>stderr && [ ! -e "$here/dest" ]
}
is 'uninstall leaves neither file nor folder' nothing_left
echo "1..$tests"
exit "$bad"
