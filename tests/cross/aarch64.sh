#!/bin/sh
# Builds for aarch64 and runs the suite `unit` under qemu.  Status 77, with the reason: it cannot
# be done here.
# Usage: aarch64.sh SOURCE [FOLDER, which is kept]
set -eu

source=$1
skip() {
    echo "skipped: $*"
    exit 77
}

for program in aarch64-linux-gnu-gcc qemu-aarch64 dpkg-deb apt-get; do
    command -v "$program" >/dev/null ||
        skip "no $program (Debian: gcc-aarch64-linux-gnu, qemu-user)"
done
if [ $# -gt 1 ]; then
    mkdir -p "$2"
    folder=$(CDPATH='' cd -- "$2" && pwd)
else
    folder=$(mktemp -d)
    trap 'rm -rf "$folder"' EXIT
fi
[ -e "$folder/root/usr/include/glib-2.0" ] ||
    "$source/tests/cross/sysroot.sh" arm64 "$folder" >"$folder/sysroot.log" 2>&1 ||
    skip "no packages of arm64: $(tail -n 1 "$folder/sysroot.log")"
sed "s|@SYSROOT@|$folder/root|" "$source/tests/cross/aarch64.txt" >"$folder/cross.txt"
[ -e "$folder/build/build.ninja" ] ||
    meson setup "$folder/build" "$source" --cross-file "$folder/cross.txt" \
        --buildtype=release -Dpictures=disabled -Dimages=disabled -Dmpi=disabled
ninja -C "$folder/build"
# Of the suite, pty starts the program by itself, which takes a kernel that knows the emulator.
tests=$(meson test -C "$folder/build" --no-rebuild --suite unit --list | sed 's/.* //')
[ -e /proc/sys/fs/binfmt_misc/qemu-aarch64 ] || {
    echo 'left out: pty (Debian: qemu-user-binfmt)'
    tests=$(printf '%s\n' "$tests" | grep -vx pty)
}
# shellcheck disable=SC2086  # words
meson test -C "$folder/build" --no-rebuild --timeout-multiplier 0 --print-errorlogs $tests
