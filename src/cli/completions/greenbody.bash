# Completion of greenbody in bash (4 or newer): found by bash-completion where it is installed
# in share/bash-completion/completions/greenbody, else `source` it.  The program itself knows
# what continues a line: greenbody --complete WORD... PREFIX.

# What a word as typed stands for (value), the quote that is open at its end (quote), and how
# much of it readline keeps: so many characters of the typed word (kept) and of its value
# (head).  False where the shell would make something else of it: an expansion, a redirection.
_greenbody_word() {
    local typed=$1 c i before_kept before_head
    value= quote= kept=0 head=0
    for ((i = 0; i < ${#typed}; i++)); do
        c=${typed:i:1}
        case ${quote:-none}$c in
        \'\' | \"\") quote= kept=$before_kept head=$before_head ;;
        \'*) value+=$c ;;
        \"[\$\`] | none[\$\`\;\|\&\<\>\(\)]) return 1 ;;
        \"\\)
            [[ ${typed:i+1:1} == [\$\`\"\\] ]] && c=${typed:++i:1}
            value+=$c
            ;;
        \"*) value+=$c ;;
        none\\) value+=${typed:++i:1} ;;
        none\' | none\")
            before_kept=$kept before_head=$head
            quote=$c kept=$((i + 1)) head=${#value}
            ;;
        *)
            value+=$c
            [[ $COMP_WORDBREAKS == *"$c"* ]] && kept=$((i + 1)) head=${#value}
            ;;
        esac
    done
    return 0
}

# A text as it must be typed for the shell to take it literally (REPLY), within a quote that is
# open.  A "~/" that was typed stays.
_greenbody_quoted() { # text, quote, what was typed
    local text=$1 home=
    case $2 in
    \') REPLY=${text//\'/\'\\\'\'} ;;
    \")
        text=${text//\\/\\\\}
        text=${text//\"/\\\"}
        text=${text//\$/\\\$}
        text=${text//\`/\\\`}
        REPLY=${text//\!/\"\'!\'\"} # in double quotes it would take a line of the history
        ;;
    *)
        [[ $3 == '~/'* && $text == '~/'* ]] && home='~/' text=${text:2}
        # only letters, digits and these are themselves everywhere
        if [[ $text == *[![:alnum:]_./=:,+@%-]* ]]; then
            printf -v REPLY %q "$text"
        else
            REPLY=$text
        fi
        REPLY=$home$REPLY
        ;;
    esac
    # readline closes the quote, unless the text ends with one
    [[ -z $2 || $REPLY != *"$2" ]] || REPLY+=$2
}

_greenbody() {
    # readline cuts words at = and :, too; pieces without a blank between belong together
    local rest=${COMP_LINE:0:COMP_POINT} piece trimmed line candidate i
    local value quote kept head REPLY
    local -a typed=() words=()
    COMPREPLY=()
    for ((i = 0; i <= COMP_CWORD; i++)); do
        trimmed=${rest#"${rest%%[![:space:]]*}"}
        piece=${trimmed:0:${#COMP_WORDS[i]}}
        if ((i == 0)) || [[ $trimmed != "$rest" ]]; then
            typed+=("$piece")
        else
            typed[${#typed[@]} - 1]+=$piece
        fi
        rest=${trimmed:${#piece}}
    done
    for piece in "${typed[@]}"; do
        _greenbody_word "$piece" || return 0
        words+=("$value")
    done
    piece=${piece:kept}
    while IFS= read -r line; do
        candidate=${line%%$'\t'*}
        # readline puts it in place of what follows the head
        [[ ${candidate:0:head} == "${value:0:head}" ]] || continue
        [[ $candidate == *[=/.,\;] ]] && compopt -o nospace
        _greenbody_quoted "${candidate:head}" "$quote" "$piece"
        [[ -n $REPLY ]] && COMPREPLY+=("$REPLY")
    done < <("${words[0]/#\~/$HOME}" --complete "${words[@]:1}" 2>/dev/null)
}

complete -F _greenbody greenbody
