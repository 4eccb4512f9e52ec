#!/bin/sh
# A Debian package of a build with the prefix /usr.
# Usage: deb.sh BUILD_FOLDER VERSION OUTPUT_FOLDER
set -eu

build=$1
version=$2
output=$3
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
trap 'exit 1' HUP INT TERM
root=$scratch/root
architecture=$(dpkg --print-architecture)
package=$output/greenbody_${version}_$architecture.deb

prefix=$(meson introspect --buildoptions "$build" 2>/dev/null | tr '{' '\n' |
    sed -n 's/.*"name": "prefix", "value": "\([^"]*\)".*/\1/p')
if [ "$prefix" != /usr ]; then
    echo "deb.sh: prefix = ${prefix:-unknown} of $build: expected /usr" \
        "(meson configure $build --prefix /usr)" >&2
    exit 2
fi
DESTDIR=$root meson install -C "$build" --no-rebuild --quiet >"$scratch/log" 2>&1 || {
    cat "$scratch/log" >&2
    exit 3
}
# Python packages of Debian are found there by every version
modules=$(find "$root/usr/lib" "$root/usr/local" -type d -path '*-packages/greenbody' \
    2>/dev/null | head -n 1)
if [ -n "$modules" ] && [ "$modules" != "$root/usr/lib/python3/dist-packages/greenbody" ]; then
    mkdir -p "$root/usr/lib/python3/dist-packages"
    mv "$modules" "$root/usr/lib/python3/dist-packages/"
    find "$root/usr" -depth -type d -empty -delete
fi
find "$root/usr/share/man" -name '*.1' -exec gzip -9n {} +
strip "$root/usr/bin/greenbody"
find "$root/usr/lib" -name 'libgreenbody.so.*' -type f -exec strip --strip-unneeded {} +

mkdir -p "$scratch/debian" "$root/DEBIAN" "$root/usr/share/doc/greenbody"
printf 'Source: greenbody\n\nPackage: greenbody\nArchitecture: any\n' >"$scratch/debian/control"
depends=$(cd "$scratch" && find root/usr/bin root/usr/lib -type f \
    \( -name greenbody -o -name 'libgreenbody.so.*' \) -exec dpkg-shlibdeps \
    --ignore-missing-info -lroot/usr/lib -O {} + 2>/dev/null | sed -n 's/^shlibs:Depends=//p')
renderer= # which the program loads when a picture is made
if "$root/usr/bin/greenbody" --version | grep -q pictures; then
    renderer=', libosmesa6 | libegl1'
fi
cat >"$root/usr/share/doc/greenbody/copyright" <<'END'
Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/
Files: *
License: GPL-3.0-or-later
 On Debian systems the text is in /usr/share/common-licenses/GPL-3.
END
cat >"$root/DEBIAN/control" <<END
Package: greenbody
Version: $version
Architecture: $architecture
Maintainer: greenbody <greenbody@localhost>
Installed-Size: $(du -sk "$root/usr" | cut -f1)
Depends: $depends$renderer, fonts-dejavu-core
Recommends: tmux, ffmpeg
Suggests: python3-numpy
Section: science
Priority: optional
Description: cold compaction of powders by discrete elements, in the terminal
 A workbench for powders that are pressed: contact laws of nanopowders and metals, curves of
 pressure against density with errors, pictures, figures, sweeps, moduli and yield surfaces.
 With the library libgreenbody, its headers and a Python module.
END
(cd "$root" && find usr -type f -exec md5sum {} + >DEBIAN/md5sums)
printf 'activate-noawait ldconfig\n' >"$root/DEBIAN/triggers"
dpkg-deb --root-owner-group --build "$root" "$package" >/dev/null
echo "$package: $(du -h "$package" | cut -f1)"
