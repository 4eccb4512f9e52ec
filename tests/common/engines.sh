# shellcheck shell=sh
# Processes that a test left behind, to be sourced after patience.sh: those that it, or what it
# started, gave the folder of settings $here/config.

engines_left() { # their numbers, one a line; not those of the look itself
    env -u XDG_CONFIG_HOME sh -c 'grep -lszxF "$1" /proc/[0-9]*/environ | cut -d / -f 3' \
        sh "XDG_CONFIG_HOME=$here/config"
}

none_left() {
    [ -z "$(engines_left)" ]
}

end_engines() {
    for pid in $(engines_left); do
        kill -KILL "$pid" 2>/dev/null
    done
    until_true none_left
}
