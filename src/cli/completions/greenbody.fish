# Completion of greenbody in fish: share/fish/vendor_completions.d holds it.
# The program itself knows what continues a line: greenbody --complete WORD... PREFIX.

function __greenbody_complete
    set -l words (commandline --tokenize --cut-at-cursor --current-process)
    set -l prefix (commandline --current-token --cut-at-cursor)
    # as the shell will take it, also within a quote that is open
    for end in '' "'" '"'
        set -l plain (string unescape -- "$prefix$end")
        if set --query plain[1]
            set prefix $plain[1]
            break
        end
    end
    command $words[1] --complete $words[2..-1] "$prefix" 2>/dev/null
end

complete --command greenbody --no-files --arguments '(__greenbody_complete)'
