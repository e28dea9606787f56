# Completion for fish. The program itself knows what may stand where: this asks
# it and tells fish.
function __errmap_complete
    set -l words (commandline -opc)
    set -l token (commandline -ct)
    # Names of files complete what follows the last ':' or '='.
    set -l kept (string match -r '^.*[:=]' -- $token)
    set -l tail (string replace -r '^.*[:=]' '' -- $token)
    for line in (command $words[1] __complete $words[2..-1] "$token" 2>/dev/null)
        switch $line
            case ':files' ':folders'
                for path in (__fish_complete_path "$tail")
                    echo "$kept$path"
                end
            case ':files *'
                set -l extension (string replace ':files ' '' -- $line)
                for path in (__fish_complete_path "$tail")
                    set -l name (string split -m1 \t -- $path)[1]
                    if string match -q -- "*/" $name
                        or string match -q -- "*.$extension" $name
                        echo "$kept$path"
                    end
                end
            case '*'
                echo $line
        end
    end
end
complete -c errmap -f -a '(__errmap_complete)'
