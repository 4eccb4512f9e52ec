# Completion of greenbody in bash (4 or newer): found by bash-completion where it is installed
# in share/bash-completion/completions/greenbody, else `source` it.  The program itself knows
# what continues a line: greenbody --complete WORD... PREFIX.

_greenbody() {
    # readline cuts words at = and :, too; pieces without a blank between belong together
    local rest=${COMP_LINE:0:COMP_POINT} piece trimmed line candidate i
    local -a words=() found=()
    for ((i = 0; i <= COMP_CWORD; i++)); do
        trimmed=${rest#"${rest%%[![:space:]]*}"}
        piece=${trimmed:0:${#COMP_WORDS[i]}}
        if ((i == 0)) || [[ $trimmed != "$rest" ]]; then
            words+=("$piece")
        else
            words[${#words[@]} - 1]+=$piece
        fi
        rest=${trimmed:${#piece}}
    done
    local last=${words[${#words[@]} - 1]}
    local cut=${last%"${last##*[=:]}"} # readline replaces what is behind it
    while IFS= read -r line; do
        candidate=${line%%$'\t'*}
        [[ $candidate == *[=/.,\;] ]] && compopt -o nospace
        candidate=${candidate#"$cut"}
        [[ $candidate == *[[:space:]\;\&\(\)\'\"\$]* ]] && printf -v candidate %q "$candidate"
        found+=("$candidate")
    done < <("${words[0]/#\~/$HOME}" --complete "${words[@]:1}" 2>/dev/null)
    COMPREPLY=("${found[@]}")
}

complete -F _greenbody greenbody
