#!/bin/sh
# The libraries of another architecture of Debian in a folder, for a cross compiler: nothing on
# this machine is changed, no root is needed.
# Usage: sysroot.sh ARCHITECTURE FOLDER
set -eu

[ $# -eq 2 ] || { echo "usage: $0 arm64 FOLDER" >&2; exit 2; }
architecture=$1
mkdir -p "$2"
folder=$(CDPATH='' cd -- "$2" && pwd)

packages="libc6-dev libgcc-12-dev libglib2.0-dev libncurses-dev libgsl-dev \
librandom123-dev libhdf5-dev libpng-dev libcairo2-dev libpango1.0-dev libfontconfig-dev \
libjson-glib-dev"

mkdir -p "$folder/apt/lists/partial" "$folder/apt/archives/partial" "$folder/apt/dpkg" \
    "$folder/root"
: >"$folder/apt/dpkg/status"

apt() {
    apt-get -q -o APT::Architecture="$architecture" -o APT::Architectures="$architecture" \
        -o Dir::State="$folder/apt" -o Dir::State::lists="$folder/apt/lists" \
        -o Dir::State::status="$folder/apt/dpkg/status" -o Dir::Cache="$folder/apt" \
        -o Debug::NoLocking=1 -o APT::Install-Recommends=0 -o APT::Sandbox::User= "$@"
}

apt update
# shellcheck disable=SC2086  # a list of words
apt install -y --download-only $packages
# Debian 12 has links from /lib to /usr/lib; packages name both
mkdir -p "$folder/root/usr/lib" "$folder/root/usr/bin" "$folder/root/usr/sbin"
for name in lib bin sbin; do
    [ -e "$folder/root/$name" ] || ln -s "usr/$name" "$folder/root/$name"
done
for package in "$folder"/apt/archives/*.deb; do
    dpkg-deb --fsys-tarfile "$package" | tar -x -C "$folder/root" --keep-directory-symlink
done
# links to absolute paths would lead out of the folder
find "$folder/root" -type l -lname '/*' | while read -r link; do
    ln -sfn "$folder/root$(readlink "$link")" "$link"
done
echo "$folder/root"
