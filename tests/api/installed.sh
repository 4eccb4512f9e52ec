#!/bin/sh
# The installed library: the examples compile with nothing but pkg-config, against the shared
# and the static one, as C11 and (headers) C++17, and run.
# Usage: installed.sh BUILD_DIR SOURCE_DIR COMPILER [ARGUMENT]...
set -u

build=$1
source=$2
shift 2
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
unset DESTDIR
prefix=$scratch/prefix
keys="particles.count=100 loading.unload_from= loading.until=5MPa"

fail() {
    echo "installed: $*"
    exit 1
}

command -v pkg-config >/dev/null || { echo "SKIP: no pkg-config" && exit 77; }
DESTDIR=$scratch/root meson install -C "$build" --no-rebuild --quiet >"$scratch/log" 2>&1 ||
    fail "meson install: $(cat "$scratch/log")"
pc=$(find "$scratch/root" -name greenbody.pc)
[ -n "$pc" ] || fail "no greenbody.pc"
# what was installed below the root, as an ordinary prefix
installed=$(sed -n 's/^prefix=//p' "$pc")
mv "$scratch/root$installed" "$prefix" || fail "nothing below $installed"
pc=$(find "$prefix" -name greenbody.pc)
sed -i "s|^prefix=.*|prefix=$prefix|" "$pc"
PKG_CONFIG_PATH=$(dirname "$pc")
export PKG_CONFIG_PATH
libdir=$(pkg-config --variable=libdir greenbody)
[ -e "$libdir/libgreenbody.so.0" ] || fail "no libgreenbody.so.0 in $libdir"
GB_PRESET_DIR=$prefix/share/greenbody/presets
export GB_PRESET_DIR

warnings="-std=c11 -D_POSIX_C_SOURCE=200809L -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror"
cd "$scratch" || exit 1
for example in press contacts two_runs; do
    # shellcheck disable=SC2046,SC2086  # words of their own
    "$@" $warnings "$source/examples/$example.c" -o "$example" \
        $(pkg-config --cflags --libs greenbody) -pthread "-Wl,-rpath,$libdir" ||
        fail "$example does not compile"
    # shellcheck disable=SC2086
    "./$example" default $keys >"$example.out" || fail "$example: $(cat "$example.out")"
    [ -s "$example.out" ] || fail "$example prints nothing"
done
cp press.out shared.out
# shellcheck disable=SC2046,SC2086
"$@" $warnings "$source/examples/press.c" -o press_static $(pkg-config --cflags greenbody) \
    "$libdir/libgreenbody.a" $(pkg-config --libs --static greenbody | sed 's/-lgreenbody//') \
    -pthread || fail "press does not link statically"
# shellcheck disable=SC2086
./press_static default $keys >static.out || fail "press, static"
cmp shared.out static.out || fail "shared and static differ"
./press default contact.muu=1 2>wrong.out
[ $? -eq 2 ] || fail "a wrong key has another status"
grep -q 'press: contact.muu: no such key; did you mean contact.mu? must be one of' wrong.out ||
    fail "message of a wrong key: $(cat wrong.out)"
for cxx in c++ g++ clang++; do
    command -v "$cxx" >/dev/null || continue
    printf '#include <greenbody/greenbody.h>\nint main() { return gb_library_version()[0] == 0; }\n' \
        >one.cc
    # shellcheck disable=SC2046
    "$cxx" -std=c++17 -Wall -Wextra -Wpedantic -Werror one.cc -o one \
        $(pkg-config --cflags --libs greenbody) "-Wl,-rpath,$libdir" && ./one ||
        fail "C++: $cxx"
    break
done
echo "installed: examples compile and run"
