#!/bin/sh
# One archive with the program and everything that it needs, for machines without root:
# loader, libraries, presets, fonts, terminal descriptions, character sets.
# Usage: bundle.sh BUILD_FOLDER SOURCE_FOLDER OUTPUT.tar.gz
set -eu

build=$1
source=$2
output=$3
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
trap 'exit 1' HUP INT TERM
name=$(basename "$output" .tar.gz)
root=$scratch/$name

fail() {
    echo "bundle: $*" >&2
    exit 3
}

DESTDIR=$scratch/installed meson install -C "$build" --no-rebuild --quiet >"$scratch/log" 2>&1 ||
    fail "meson install: $(cat "$scratch/log")"
prefix=$(find "$scratch/installed" -type d -path '*/share/greenbody')
prefix=${prefix%/share/greenbody}
mkdir -p "$root/bin" "$root/libexec" "$root/lib/gconv" "$root/share/fonts" \
    "$root/share/terminfo"
cp -r "$prefix/share/greenbody" "$prefix/share/man" "$prefix/share/bash-completion" \
    "$prefix/share/zsh" "$prefix/share/fish" "$root/share/"
program=$root/libexec/greenbody.bin
cp "$prefix/bin/greenbody" "$program"
strip "$program"

# --- loader and libraries ---------------------------------------------------------------
cp_libraries() {
    ldd "$1" >"$scratch/libraries" || fail "ldd: $1"
    if grep -q 'not found' "$scratch/libraries"; then
        fail "$(grep 'not found' "$scratch/libraries")"
    fi
    sed -n 's/.*=> \(\/[^ ]*\) (.*/\1/p' "$scratch/libraries" | while read -r library; do
        cp -L "$library" "$root/lib/"
    done
}
renderer=libOSMesa.so.8 # the program loads it when a picture is made
if grep -q "$renderer" "$program"; then
    found=$(ldconfig -p | sed -n "s/.*$renderer .*=> //p" | head -n 1)
    [ -n "$found" ] || fail "no $renderer"
    cp -L "$found" "$root/lib/$renderer"
    cp_libraries "$found"
fi
cp_libraries "$program"
loader=$(sed -n 's/^[[:space:]]*\(\/[^ ]*ld-linux[^ ]*\) (.*/\1/p' "$scratch/libraries")
cp -L "$loader" "$root/libexec/greenbody"
${CC:-cc} -static -O2 -o "$root/bin/greenbody" "$source/packaging/launcher.c"
strip "$root/bin/greenbody"
ln -s ../bin/greenbody "$root/libexec/launcher"

# --- character sets of measured data, as GLib asks glibc for them ------------------------
gconv=$(dirname "$(ldconfig -p 2>/dev/null | sed -n 's/.*libc\.so\.6 .*=> //p' | head -n 1)")/gconv
for set in ISO8859-1 ISO8859-15 CP1252 UTF-16 UTF-32 CP850 CP437 MACINTOSH; do
    [ ! -e "$gconv/$set.so" ] || cp "$gconv/$set.so" "$root/lib/gconv/"
done
cp "$gconv/gconv-modules" "$root/lib/gconv/"
[ ! -d "$gconv/gconv-modules.d" ] || cp -r "$gconv/gconv-modules.d" "$root/lib/gconv/"

mkdir -p "$root/lib/locale"
for folder in /usr/lib/locale/C.utf8 /usr/lib/locale/C.UTF-8; do
    [ ! -d "$folder" ] || cp -r "$folder" "$root/lib/locale/"
done

# --- fonts ------------------------------------------------------------------------------
fc-list :family=DejaVu\ Sans file | sed 's/: *$//' >"$scratch/fonts"
[ -s "$scratch/fonts" ] || fail "no DejaVu Sans (Debian: fonts-dejavu-core)"
while read -r font; do
    cp "$font" "$root/share/fonts/"
done <"$scratch/fonts"
cat >"$root/share/fonts/fonts.conf" <<'END'
<?xml version="1.0"?>
<!DOCTYPE fontconfig SYSTEM "fonts.dtd">
<fontconfig>
  <dir prefix="relative">.</dir>
  <dir>/usr/share/fonts</dir>
  <cachedir prefix="xdg">fontconfig</cachedir>
  <alias><family>sans-serif</family><prefer><family>DejaVu Sans</family></prefer></alias>
  <alias><family>Sans</family><prefer><family>DejaVu Sans</family></prefer></alias>
</fontconfig>
END

# --- terminals --------------------------------------------------------------------------
for folder in /lib/terminfo /usr/share/terminfo /etc/terminfo; do
    [ -d "$folder" ] || continue
    for letter in a d g k l r s t v w x; do
        [ ! -d "$folder/$letter" ] || cp -rn "$folder/$letter" "$root/share/terminfo/"
    done
done

cat >"$root/README" <<'END'
greenbody for any x86-64 Linux (kernel 3.2 or newer), without root: unpack it anywhere and start
bin/greenbody.  Completion for bash: source share/bash-completion/completions/greenbody.
END
cp "$source/LICENSE" "$root/"
tar -C "$scratch" --owner=0 --group=0 -czf "$output.part" "$name"
mv "$output.part" "$output"
echo "$output: $(du -h "$output" | cut -f1), unpacked $(du -sh "$root" | cut -f1)"
