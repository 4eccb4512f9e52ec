#!/bin/sh
# `greenbody snapshot` as a user meets it, and the way back: `greenbody run --from`.
# Usage: snapshot.sh GREENBODY PRESET_FOLDER
. "$(dirname "$0")/folder.sh"

unset DISPLAY
export TERM=dumb

good() { # name, arguments of the program: nothing on stderr; progress comes on a busy machine
    name=$1
    shift
    "$greenbody" "$@" >stdout 2>stderr && [ ! -s stderr ]
    result "$name" $?
}

refused() { # name, part of the line, arguments: one line, status 2 or 3
    name=$1
    part=$2
    shift 2
    "$greenbody" "$@" >stdout 2>stderr
    status=$?
    { [ "$status" -eq 2 ] || [ "$status" -eq 3 ]; } && [ "$(wc -l <stderr)" -eq 1 ] &&
        grep -qF -- "$part" stderr
    result "$name" $?
}

"$greenbody" run default particles.count=200 "loading.until=5 MPa" loading.unload_from= \
    numerics.fidelity=fast "output.snapshots_at=every 8" -q --out a >stdout 2>stderr || { cat stderr; exit 1; }

for color in coordination pressure bridges; do
    good "coloured by $color" snapshot a -o "$color.png" --size 300x300 --color "$color"
done
good "forces" snapshot a -o forces.png --size 300x300 --show forces --ground dark
good "slice, cut, no perspective" snapshot a -o slice.png --size 300x300 --show both \
    --slice y=0.5:3d --cut corner --view front,flat
kept=$(awk -F, '/^load/ { p = $7 } END { printf "%.4g", p }' a/curve.csv)
good "a point that is kept" snapshot a -o at.png --size 300x300 --at "p=$kept MPa"
good "two rows with roses" snapshot a a/state.h5 --rose -o rose.png --size 600x600
good "displacement since itself" snapshot a --since a --color displacement -o d.png \
    --size 300x300

good "a sequence that moves" snapshot a --sequence --quiet -o moves.png --size 200x200
grep -aq acTL moves.png && [ "$(grep -ao fcTL moves.png | wc -l)" -ge 2 ]
result "it has frames" $?
good "a sequence of numbered frames" snapshot a --sequence --quiet -o f-%02d.png --size 200x200 \
    --show both --color pressure
[ -s f-01.png ] && [ -s f-02.png ] && [ ! -e f-00.png ]
result "they are numbered from 1" $?
refused "numbered frames that exist" "f-01.png: exists; --force replaces it" \
    snapshot a --sequence -o f-%02d.png
refused "two numbers in a name" "expected one number" snapshot a --sequence -o %d-%d.png
refused "no frames a second" "0.1 to 100" snapshot a --sequence --fps 0 -o g.png
refused "a sequence of one state" "output.snapshots_at" snapshot a/state.h5 --sequence \
    -o g.png
on_terminal() { # words of the program: what it says on a terminal
    python3 -c 'import pty, sys; sys.exit(pty.spawn(sys.argv[1:]) >> 8)' "$greenbody" "$@" \
        </dev/null >stdout 2>stderr
}
frames=$(ls f-*.png | wc -l)
on_terminal snapshot a --sequence -o shown.png --size 200x200 &&
    grep -q "$frames of $frames frames  100 %  0 s left" stdout
result "progress of the frames on a terminal" $?
on_terminal snapshot a --sequence -q -o silent.png --size 200x200 && ! grep -q frames stdout
result "none with --quiet" $?
if command -v ffmpeg >/dev/null; then
    good "a film" snapshot a --sequence --quiet -o film.gif --size 201x203
    [ -s film.gif ] && [ ! -e film.gif.part.gif ]
    result "it is there" $?
fi
# ffmpeg gets words, not a line of a shell, and a name cannot be an option of it.
mkdir stub
cat >stub/ffmpeg <<'STUB'
#!/bin/sh
printf '%s\n' "$@" >words
cat >/dev/null
for last; do :; done
: >"${last#file:}"
STUB
chmod +x stub/ffmpeg
# shellcheck disable=SC2016  # a name
PATH=$here/stub:$PATH good "a film of any name" snapshot a --sequence --quiet -o '-y $(touch hit).gif'
# shellcheck disable=SC2016
[ ! -e hit ] && grep -qxF 'file:-y $(touch hit).gif.part.gif' words
result "which ffmpeg gets as one word" $?
mkdir empty
PATH=$here/empty "$greenbody" snapshot a --sequence -o other.mp4 >stdout 2>stderr
[ $? -eq 3 ] && [ "$(wc -l <stderr)" -eq 1 ] && grep -qF "needs the program ffmpeg" stderr
result "a film without ffmpeg" $?
refused "exists" "exists; --force replaces it" snapshot a -o forces.png
good "8 cm wide in print" snapshot a -o wide.png --width 8cm --dpi 300
good "its figure" plot a --figure densification -o wide-figure.png --width 8cm
printed='import struct, sys
for path in sys.argv[1:]:
    data = open(path, "rb").read()
    at = data.find(b"pHYs") + 4
    wide = struct.unpack(">I", data[16:20])[0]
    assert struct.unpack(">IIB", data[at:at + 9]) == (11811, 11811, 1) and wide == 945, path'
python3 -c "$printed" wide.png wide-figure.png
result "as many pixels, and their density in the file" $?
refused "a width without a unit" "8cm, 80mm, 3.3in" snapshot a -o x.png --width 8
refused "pixels and a width" "--size, --width: expected one of them" plot a \
    --figure densification -o x.png --width 8cm --size 300x300
refused "a density alone" "--dpi: expected with --width" snapshot a -o x.png --dpi 300
refused "size 0" "16 to 16384" snapshot a -o x.png --size 0x0
refused "size 100000" "16 to 16384" snapshot a -o x.png --size 100000x100000
refused "no such point" "keeps states at" snapshot a -o x.png --at "p=5 GPa"
refused "no point" "--at 5" snapshot a -o x.png --at 5
refused "unknown colour" "coordination, pressure" snapshot a -o x.png --color red
good "a range, a scale of colours" snapshot a -o range.png --size 300x300 --color pressure \
    --range 0:200MPa --colormap diverging
good "a logarithmic scale" snapshot a -o log.png --size 300x300 --color pressure --log
good "a range of forces" snapshot a -o rods.png --show forces --range 0:50nN
refused "a range of another quantity" "as in 0:200MPa" snapshot a -o x.png --color pressure \
    --range 0:5nm
refused "no such scale of colours" "viridis, fire, blue-yellow, grey, diverging" \
    snapshot a -o x.png --colormap jet
refused "the logarithm of counts" "whole numbers" snapshot a -o x.png --log
refused "displacement without a start" "--since" snapshot a -o x.png --color displacement
refused "no folder" "no/x.png" snapshot a -o no/x.png --size 300x300
refused "no picture" "No such file" run --from none.png
cp stdout stdout.png
refused "not a picture" "stdout.png" run --from stdout.png
printf '<fontconfig><dir>/nonexistent</dir></fontconfig>\n' >fonts.conf
FONTCONFIG_FILE=$here/fonts.conf "$greenbody" snapshot a -o x.png --size 300x300 \
    >stdout 2>stderr
[ $? -eq 3 ] && grep -q "no font is installed" stderr
result "no font" $?
[ ! -e x.png ]
result "nothing is left by what was refused" $?

"$greenbody" run --from forces.png -q --out b >stdout 2>stderr &&
    cut -d, -f1-13 a/curve.csv | grep -v '^#' >one &&
    cut -d, -f1-13 b/curve.csv | grep -v '^#' >two && cmp -s one two
result "the picture makes the same run again" $?
"$greenbody" snapshot b -o again.png --size 300x300 --show forces --ground dark \
    >stdout 2>stderr && cmp -s forces.png again.png
result "and the same picture" $?

echo "1..$tests"
exit "$bad"
