#!/bin/sh
# The script bootstrap for a user who can install nothing: it goes on without an optional package
# and names one that it needs.  Packages, compiler and rights are stand-ins.
# Usage: bootstrap.sh GREENBODY PRESET_FOLDER SOURCE
source=$3
. "$(dirname "$0")/folder.sh"

mkdir tree tools
cp "$source/bootstrap" tree/bootstrap
for tool in sh env grep tr cat rm dirname mktemp; do
    ln -s "$(command -v $tool)" tools/$tool
done

tool() { # name, its lines
    printf '#!/bin/sh\n%s\n' "$2" >"tools/$1"
    chmod +x "tools/$1"
}
tool id 'echo 1000'
# All but those of the file missing: status of one package, or what all provide.
# shellcheck disable=SC2016  # for the stand-in
tool dpkg-query 'for last; do :; done
[ "$1" = -W ] && case $2 in *Provides*) exit 0 ;; esac
! grep -qx "$last" ../missing || exit 1
printf "install ok installed"'
tool apt-get 'echo "apt-get $*" >>../called'
# shellcheck disable=SC2016
tool meson 'echo meson >>../called; mkdir -p "$2"; : >"$2/build.ninja"'
tool ninja 'echo ninja >>../called'
ln -s "$(command -v mkdir)" tools/mkdir

bootstraps() {
    : >called
    (cd tree && PATH=$here/tools ./bootstrap build) >stdout 2>stderr
}

printf '%s\n' libchafa-dev libosmesa6-dev >missing
bootstraps
is 'without optional packages it goes on' [ $? -eq 0 ]
is 'and says without which' grep -q 'going on without libosmesa6-dev libchafa-dev' stderr
is 'nothing is installed' [ "$(grep -c apt-get called)" -eq 0 ]
is 'it is built' grep -qx ninja called
bootstraps
is 'the next start says nothing of it' [ "$(grep -c without stderr)" -eq 0 ]
is 'and builds' grep -qx ninja called

rm -rf tree/build
printf '%s\n' libgsl-dev libchafa-dev >missing
bootstraps
is 'without a package that it needs it ends' [ $? -eq 3 ]
is 'and names that one' grep -q 'as root: apt-get install libgsl-dev' stderr
is 'nothing is built' [ "$(grep -c ninja called)" -eq 0 ]

# As root: the lines of apt and dpkg go to a log, and to the screen only if it fails.
rm -rf tree/build
tool id 'echo 0'
# shellcheck disable=SC2016
tool apt-get 'echo "apt-get $*" >>../called
for k in 0 1 2 3; do for j in 0 1 2 3 4 5 6 7 8 9; do echo "Unpacking $k$j" >&2; done; done
case " $* " in *" install "*) : >../missing; exit "$(cat ../apt_status)" ;; esac'
tool apt-cache 'exit 0'
ln -s "$(command -v tail)" tools/tail
echo libgsl-dev >missing
echo 0 >apt_status
bootstraps
is 'as root it installs' [ $? -eq 0 ]
is 'what is missing' grep -q 'apt-get .*install.* libgsl-dev' called
is 'in a few lines' [ "$(wc -l <stderr)" -le 5 ]
is 'none of them of dpkg' [ "$(grep -c Unpacking stderr)" -eq 0 ]
is 'which are in a log' [ "$(grep -c Unpacking tree/build-packages.log)" -eq 80 ]
rm -rf tree/build
echo libgsl-dev >missing
echo 100 >apt_status
bootstraps
is 'a package that cannot be installed ends it' [ $? -eq 3 ]
is 'with the last lines of dpkg' [ "$(grep -c Unpacking stderr)" -eq 20 ]
is 'and the name of the log' grep -q 'build-packages.log' stderr

# A package of Debian is made of a build for /usr.
mkdir deb
cat >deb/meson <<'END'
#!/bin/sh
echo '[{"name": "python.install_env", "value": "prefix"}, {"name": "prefix", "value": "/opt/x"}]'
END
chmod +x deb/meson
PATH=$here/deb:$PATH sh "$source/packaging/deb.sh" some-build 1.0 . >stdout 2>stderr
is 'deb.sh refuses another prefix' [ $? -eq 2 ]
is 'in one line' grep -qx 'deb.sh: prefix = /opt/x of some-build: expected /usr (.*)' stderr
is 'and nothing else' [ "$(wc -l <stderr)" -eq 1 ]

echo "1..$tests"
exit $bad
