#!/bin/sh
# The tables of the glossary as rows of a C array: a heading, or a word and its meaning.
# Usage: glossary_rows.sh docs/glossary.md OUTPUT
sed -n -e '/^| word | meaning/d' -e '/^|---/d' \
    -e 's/\[\([^]]*\)\]([^)]*)/\1/g' -e 's/`//g' -e 's/\\/\\\\/g' -e 's/"/\\"/g' \
    -e 's/^## \(.*\)$/{NULL, "\1"},/p' \
    -e 's/^| *\([^|]*[^| ]\) *| *\(.*[^ ]\) *|$/{"\1", "\2"},/p' "$1" >"$2"
