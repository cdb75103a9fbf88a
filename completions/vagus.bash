# Completion of `vagus` for bash. Made by `vagus page bash`; do not edit.
#
#     source completions/vagus.bash

# What may follow each verb, by its name.
declare -A _vagus_names=(
    [" "]="studio serve deploy compile exec switch node emulate net conformance sim plan toolbox --version --help"
    ["studio "]="--example --listen --port --token-file --look-token-file --tls-cert --tls-key --host --pages --data --config --no-browser --help"
    ["serve "]="--start --stop-only --target --listen --port --token-file --look-token-file --tls-cert --tls-key --host --pages --data --config --help"
    ["deploy "]="--token-file --tls-cert --rollback --list --help"
    ["compile "]="--node --node-name --format --out --dialect --ontimer --help"
    ["exec "]="--node --stimuli --max-steps --dialect --ontimer --help"
    ["switch "]="--listen --verbose --loop --help"
    ["node "]="--id --name --describe --flash --listen --connect --help"
    ["emulate "]="--count --id --listen --connect --keep --help"
    ["net "]="list describe log get set emit watch run pause step reset stop save load break --json --project --wait --help"
    ["net list "]="--help"
    ["net describe "]="--help"
    ["net log "]="--help"
    ["net get "]="--help"
    ["net set "]="--leave --help"
    ["net emit "]="--help"
    ["net watch "]="--help"
    ["net run "]="--help"
    ["net pause "]="--help"
    ["net step "]="--help"
    ["net reset "]="--help"
    ["net stop "]="--help"
    ["net save "]="--help"
    ["net load "]="--help"
    ["net break "]="--clear --keep --help"
    ["conformance "]="--node --only --max-time --json --flash --sleep --may-drive --help"
    ["sim "]="--load --watch --headless --theme --speed --duration --seed --threads --listen --trace --dialect --ontimer --help"
    ["plan "]="check run debug generate format formulas --help"
    ["plan check "]="--toolbox --world --robot --project --json --help"
    ["plan run "]="--toolbox --set --from --clock --seed --max-time --trace --world --robot --threads --trace-all --listen --bus --project --headless --quiet --theme --watch --help"
    ["plan debug "]="--toolbox --set --from --clock --seed --max-time --trace --world --robot --threads --trace-all --listen --bus --project --help"
    ["plan generate "]="--toolbox --output --force --help"
    ["plan format "]="--toolbox --write --check --help"
    ["plan formulas "]="--json --help"
    ["toolbox "]="list show --help"
    ["toolbox list "]="--toolbox --json --help"
    ["toolbox show "]="--toolbox --json --help"
)
# What each option and argument (by its number) takes: "none", "any", "file ENDING", "words WORD".
declare -A _vagus_takes=(
    [" --version"]="none"
    [" --help"]="none"
    [" -h"]="none"
    ["studio 1"]="file vagus.json .aesl .plan.json .world.json "
    ["studio --example"]="any"
    ["studio --listen"]="any"
    ["studio --port"]="any"
    ["studio --token-file"]="file"
    ["studio --look-token-file"]="file"
    ["studio --tls-cert"]="file .pem "
    ["studio --tls-key"]="file .pem "
    ["studio --host"]="any"
    ["studio --pages"]="any"
    ["studio --data"]="any"
    ["studio --config"]="any"
    ["studio --no-browser"]="none"
    ["studio --help"]="none"
    ["studio -h"]="none"
    ["serve 1"]="file vagus.json "
    ["serve --start"]="none"
    ["serve --stop-only"]="none"
    ["serve --target"]="any"
    ["serve --listen"]="any"
    ["serve --port"]="any"
    ["serve --token-file"]="file"
    ["serve --look-token-file"]="file"
    ["serve --tls-cert"]="file .pem "
    ["serve --tls-key"]="file .pem "
    ["serve --host"]="any"
    ["serve --pages"]="any"
    ["serve --data"]="any"
    ["serve --config"]="any"
    ["serve --help"]="none"
    ["serve -h"]="none"
    ["deploy 1"]="file vagus.json "
    ["deploy 2"]="any"
    ["deploy --token-file"]="file"
    ["deploy --tls-cert"]="file .pem "
    ["deploy --rollback"]="none"
    ["deploy --list"]="none"
    ["deploy --help"]="none"
    ["deploy -h"]="none"
    ["compile 1"]="file .aesl "
    ["compile --node"]="file .json "
    ["compile --node-name"]="any"
    ["compile --format"]="words listing json hex abo"
    ["compile --out"]="file"
    ["compile -o"]="file"
    ["compile --dialect"]="words auto modern 2007"
    ["compile --ontimer"]="any"
    ["compile --help"]="none"
    ["compile -h"]="none"
    ["exec 1"]="file .aesl "
    ["exec --node"]="file .json "
    ["exec --stimuli"]="file .json "
    ["exec --max-steps"]="any"
    ["exec --dialect"]="words auto modern 2007"
    ["exec --ontimer"]="any"
    ["exec --help"]="none"
    ["exec -h"]="none"
    ["switch --listen"]="any"
    ["switch 1"]="any"
    ["switch --verbose"]="none"
    ["switch -v"]="none"
    ["switch --loop"]="none"
    ["switch -l"]="none"
    ["switch --help"]="none"
    ["switch -h"]="none"
    ["node --id"]="any"
    ["node --name"]="any"
    ["node --describe"]="file .json "
    ["node --flash"]="file .abo "
    ["node --listen"]="any"
    ["node --connect"]="any"
    ["node --help"]="none"
    ["node -h"]="none"
    ["emulate 1"]="any"
    ["emulate --count"]="any"
    ["emulate --id"]="any"
    ["emulate --listen"]="any"
    ["emulate --connect"]="any"
    ["emulate --keep"]="any"
    ["emulate --help"]="none"
    ["emulate -h"]="none"
    ["net 1"]="any"
    ["net --json"]="none"
    ["net --project"]="file .aesl "
    ["net --wait"]="any"
    ["net --help"]="none"
    ["net -h"]="none"
    ["net list --help"]="none"
    ["net list -h"]="none"
    ["net describe 1"]="any"
    ["net describe --help"]="none"
    ["net describe -h"]="none"
    ["net log 1"]="any"
    ["net log --help"]="none"
    ["net log -h"]="none"
    ["net get 1"]="any"
    ["net get 2"]="any"
    ["net get --help"]="none"
    ["net get -h"]="none"
    ["net set 1"]="any"
    ["net set 2"]="any"
    ["net set 3"]="any"
    ["net set --leave"]="none"
    ["net set --help"]="none"
    ["net set -h"]="none"
    ["net emit 1"]="any"
    ["net emit 2"]="any"
    ["net emit --help"]="none"
    ["net emit -h"]="none"
    ["net watch 1"]="any"
    ["net watch 2"]="any"
    ["net watch --help"]="none"
    ["net watch -h"]="none"
    ["net run 1"]="any"
    ["net run --help"]="none"
    ["net run -h"]="none"
    ["net pause 1"]="any"
    ["net pause --help"]="none"
    ["net pause -h"]="none"
    ["net step 1"]="any"
    ["net step --help"]="none"
    ["net step -h"]="none"
    ["net reset 1"]="any"
    ["net reset --help"]="none"
    ["net reset -h"]="none"
    ["net stop 1"]="any"
    ["net stop --help"]="none"
    ["net stop -h"]="none"
    ["net save 1"]="any"
    ["net save --help"]="none"
    ["net save -h"]="none"
    ["net load 1"]="file .aesl "
    ["net load 2"]="any"
    ["net load --help"]="none"
    ["net load -h"]="none"
    ["net break 1"]="any"
    ["net break 2"]="any"
    ["net break --clear"]="none"
    ["net break --keep"]="none"
    ["net break --help"]="none"
    ["net break -h"]="none"
    ["conformance 1"]="any"
    ["conformance --node"]="any"
    ["conformance --only"]="any"
    ["conformance --max-time"]="any"
    ["conformance --json"]="none"
    ["conformance --flash"]="none"
    ["conformance --sleep"]="none"
    ["conformance --may-drive"]="none"
    ["conformance --help"]="none"
    ["conformance -h"]="none"
    ["sim 1"]="file .world.json "
    ["sim --load"]="file .aesl "
    ["sim --watch"]="none"
    ["sim --headless"]="none"
    ["sim --theme"]="words dark light"
    ["sim --speed"]="words max"
    ["sim --duration"]="any"
    ["sim --seed"]="any"
    ["sim --threads"]="any"
    ["sim --listen"]="any"
    ["sim --trace"]="file"
    ["sim --dialect"]="words auto modern 2007"
    ["sim --ontimer"]="any"
    ["sim --help"]="none"
    ["sim -h"]="none"
    ["plan --help"]="none"
    ["plan -h"]="none"
    ["plan check 1"]="file .plan.json "
    ["plan check --toolbox"]="file .toolbox.json .so "
    ["plan check --world"]="file .world.json "
    ["plan check --robot"]="any"
    ["plan check --project"]="file .aesl "
    ["plan check --json"]="none"
    ["plan check --help"]="none"
    ["plan check -h"]="none"
    ["plan run 1"]="file .plan.json "
    ["plan run --toolbox"]="file .toolbox.json .so "
    ["plan run --set"]="any"
    ["plan run --from"]="any"
    ["plan run --clock"]="words real virtual"
    ["plan run --seed"]="any"
    ["plan run --max-time"]="any"
    ["plan run --trace"]="file .jsonl "
    ["plan run --world"]="file .world.json "
    ["plan run --robot"]="any"
    ["plan run --threads"]="any"
    ["plan run --trace-all"]="file .jsonl "
    ["plan run --listen"]="any"
    ["plan run --bus"]="any"
    ["plan run --project"]="file .aesl "
    ["plan run --headless"]="none"
    ["plan run --quiet"]="none"
    ["plan run --theme"]="words dark light"
    ["plan run --watch"]="none"
    ["plan run --help"]="none"
    ["plan run -h"]="none"
    ["plan debug 1"]="file .plan.json "
    ["plan debug --toolbox"]="file .toolbox.json .so "
    ["plan debug --set"]="any"
    ["plan debug --from"]="any"
    ["plan debug --clock"]="words real virtual"
    ["plan debug --seed"]="any"
    ["plan debug --max-time"]="any"
    ["plan debug --trace"]="file .jsonl "
    ["plan debug --world"]="file .world.json "
    ["plan debug --robot"]="any"
    ["plan debug --threads"]="any"
    ["plan debug --trace-all"]="file .jsonl "
    ["plan debug --listen"]="any"
    ["plan debug --bus"]="any"
    ["plan debug --project"]="file .aesl "
    ["plan debug --help"]="none"
    ["plan debug -h"]="none"
    ["plan generate 1"]="file .plan.json "
    ["plan generate --toolbox"]="file .toolbox.json .so "
    ["plan generate --output"]="file"
    ["plan generate -o"]="file"
    ["plan generate --force"]="none"
    ["plan generate --help"]="none"
    ["plan generate -h"]="none"
    ["plan format 1"]="file .plan.json "
    ["plan format --toolbox"]="file .toolbox.json .so "
    ["plan format --write"]="none"
    ["plan format -w"]="none"
    ["plan format --check"]="none"
    ["plan format --help"]="none"
    ["plan format -h"]="none"
    ["plan formulas --json"]="none"
    ["plan formulas --help"]="none"
    ["plan formulas -h"]="none"
    ["toolbox --help"]="none"
    ["toolbox -h"]="none"
    ["toolbox list --toolbox"]="file .toolbox.json .so "
    ["toolbox list --json"]="none"
    ["toolbox list --help"]="none"
    ["toolbox list -h"]="none"
    ["toolbox show 1"]="any"
    ["toolbox show --toolbox"]="file .toolbox.json .so "
    ["toolbox show --json"]="none"
    ["toolbox show --help"]="none"
    ["toolbox show -h"]="none"
)

# Files with one of the endings, and folders; all files if there is no ending.
_vagus_files() {
    local cur=$1 ending
    shift
    compopt -o filenames 2>/dev/null
    if [ $# -eq 0 ]; then
        mapfile -t COMPREPLY < <(compgen -f -- "$cur")
        return
    fi
    mapfile -t COMPREPLY < <(
        {
            compgen -d -- "$cur"
            for ending; do compgen -f -X "!*$ending" -- "$cur"; done
        } | sort -u
    )
}

_vagus_complete_kind() {
    local kind=$1 cur=$2
    case $kind in
        file*) read -ra kind <<<"$kind"; _vagus_files "$cur" "${kind[@]:1}" ;;
        words*) mapfile -t COMPREPLY < <(compgen -W "${kind#words}" -- "$cur") ;;
    esac
}

_vagus() {
    local cur=${COMP_WORDS[COMP_CWORD]} verb="" position=0 value_of="" glue="" word names i
    local -a words=()
    COMPREPLY=()
    # bash cuts words at : and =, which targets like tcp:localhost:33333 have: join them again.
    for ((i = 1; i < COMP_CWORD; i++)); do
        word=${COMP_WORDS[i]}
        if [[ ${#words[@]} -gt 0 && ( -n $glue || $word == [:=] ) ]]; then
            words[-1]+=$word
        else
            words+=("$word")
        fi
        if [[ $word == [:=] ]]; then glue=yes; else glue=""; fi
    done
    for word in "${words[@]}"; do
        if [ -n "$value_of" ]; then
            value_of=""
        elif [[ $word == -* ]]; then
            [[ $word == *=* || ${_vagus_takes["$verb $word"]:-none} == none ]] || value_of=$word
        elif [[ " ${_vagus_names["$verb "]} " == *" $word "* ]]; then
            verb="${verb:+$verb }$word"
            position=0
        else
            position=$((position + 1))
        fi
    done
    if [ -n "$value_of" ]; then
        _vagus_complete_kind "${_vagus_takes["$verb $value_of"]}" "$cur"
        return
    fi
    if [[ $cur != -* ]]; then
        _vagus_complete_kind "${_vagus_takes["$verb $((position + 1))"]:-any}" "$cur"
    fi
    if [[ $cur == -* || ${#COMPREPLY[@]} -eq 0 ]]; then
        names=${_vagus_names["$verb "]}
        # Options are offered when one is begun; verbs always.
        [[ $cur == -* ]] || names=$(printf '%s\n' $names | grep -v '^-')
        mapfile -t COMPREPLY < <(compgen -W "$names" -- "$cur")
    fi
}

complete -F _vagus vagus
