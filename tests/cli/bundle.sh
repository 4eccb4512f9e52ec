#!/bin/bash
# The bundle in a root that holds nothing else, as an ordinary user: every kind of command, its
# workers, its workbench.  Usage: bundle.sh GREENBODY PRESETS BUILD_FOLDER SOURCE_FOLDER
build=$3
source=$4
. "$(dirname "$0")/folder.sh"
unset GB_PRESET_DIR XDG_CONFIG_HOME

if ! unshare -rm true 2>/dev/null && [ "$(id -u)" -ne 0 ]; then
    echo "1..0 # SKIP no root of our own can be had here"
    exit 0
fi
for tool in tmux fc-list strip ldconfig; do
    PATH=$PATH:/sbin:/usr/sbin command -v $tool >/dev/null || {
        echo "1..0 # SKIP no $tool here"
        exit 0
    }
done
export PATH=$PATH:/sbin:/usr/sbin
made() {
    "$source/packaging/bundle.sh" "$build" "$source" "$here/greenbody.tar.gz" >stdout 2>stderr
}
is 'it is made' made
mkdir -p root/proc root/dev root/tmp
chmod 755 "$here" root
chmod 1777 root/tmp
tar -xzf greenbody.tar.gz -C root || exit 1

# Runs the bundle's program in that root.
cat >inside.sh <<'END'
#!/bin/bash
here=$1
shift
space=(unshare -m)
user=(--userspec=65534:65534)
[ "$(id -u)" -eq 0 ] || { space=(unshare -rm) user=(); }
# shellcheck disable=SC2016  # the inner shell's own
exec "${space[@]}" bash -c 'mount --rbind /proc "$0/root/proc" && mount --rbind /dev "$0/root/dev" &&
    exec env -i HOME=/tmp PATH=/greenbody/bin LANG=en_US.UTF-8 TERM="$TERM" "$@"' \
    "$here" "$(command -v chroot)" "${user[@]}" "$here/root" /greenbody/bin/greenbody "$@"
END
chmod +x inside.sh
inside() {
    TERM=${TERM:-xterm} "$here/inside.sh" "$here" "$@" >stdout 2>stderr
}
small=(particles.count=100 'loading.until=2 MPa' loading.unload_from=)

is 'it starts' inside --version
is 'a run' inside run default "${small[@]}" --quiet --out /tmp/run
is 'a picture' inside snapshot /tmp/run -o /tmp/picture.png
is 'a figure' inside plot --figure densification /tmp/run -o /tmp/figure.pdf
is 'a report' inside report /tmp/run -o /tmp/report
is 'a sweep with its workers' inside sweep default --vary contact.mu=0.1,0.2 --set \
    particles.count=100 --set 'loading.until=2 MPa' --set loading.unload_from= --out /tmp/sweep
printf 'Druck (MPa);Dichte (g/cm\263)\n' >root/tmp/data.csv
for row in '1;1,2' '3;1,35' '10;1,5' '30;1,75' '100;2,0' '300;2,3'; do
    echo "$row" >>root/tmp/data.csv
done
is 'measured data in Latin-1' inside fit /tmp/data.csv --true-density '3.95 g/cm3' \
    --equation heckel

screen="tmux -L greenbody-bundle-$$ -u -f /dev/null"
$screen new-session -d -x 100 -y 30 \
    "$here/inside.sh $here default particles.count=100 loading.unload_from="
seen() {
    $screen capture-pane -p >stdout && grep -qF -- "$1" stdout
}
is 'the workbench' until_true seen 'done'
is 'in the characters of UTF-8' seen '│'
called() {
    pgrep -x greenbody >stdout
}
is 'called greenbody' called
$screen kill-server 2>/dev/null
echo "1..$tests"
exit "$bad"
