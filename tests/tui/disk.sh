#!/bin/bash
# A preset saved from the workbench where the disk is full: the reason is told, an older one
# stays as it was, and with room again the same dialog saves.
# Usage: disk.sh GREENBODY PRESET_FOLDER
. "$(dirname "$0")/../common/own_disk.sh"
. "$(dirname "$0")/terminal.sh"
saved=$here/config/greenbody/presets

mkdir "$here/config" && mount -t tmpfs -o size=64k none "$here/config" || exit 1
finish() {
    term kill-server 2>/dev/null
    end_engines
    umount "$here/config"
    rm -rf "$here"
}

room() { # KiB
    mount -o "remount,size=${1}k" "$here/config"
}

# All of what is left there.
fill() {
    dd if=/dev/zero of="$here/config/filler" bs=4k 2>/dev/null
}

open_terminal
start default particles.count=300
shows "opens" '✓ done'
keys w C-u older Enter
shows "a preset is saved" 'saved as'
cp "$saved/older.ini" "$here/older.ini"
fill
keys w C-u newer Enter
shows "a full disk is told" 'No space left'
is "nothing is left of it" [ "$(ls -A "$saved")" = older.ini ]
keys C-u older Enter
shows "what is there is asked about" 'exists: Enter again'
keys Enter
shows "it cannot be replaced either" 'No space left'
is "and is as it was" cmp -s "$saved/older.ini" "$here/older.ini"
is "with nothing beside it" [ "$(ls -A "$saved")" = older.ini ]
room 256
keys C-u newer Enter
shows "with room again it is saved" 'saved as'
is "whole" grep -q '^count *= *300' "$saved/newer.ini"
leaves "closes"

echo "1..$tests"
exit "$bad"
