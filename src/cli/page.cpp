#include "cli/page.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "base/text.hpp"
#include "cli/man_page.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"

namespace vagus::cli {
namespace {

constexpr size_t kHelpColumns = 100;
constexpr size_t kNameColumns = 30;

std::vector<CLI::App*> verbs_of(CLI::App& app) {
    std::vector<CLI::App*> verbs;
    for (CLI::App* verb : app.get_subcommands([](CLI::App*) { return true; })) {
        if (!verb->get_group().empty()) verbs.push_back(verb);
    }
    return verbs;
}

std::string path_of(const CLI::App& app) {
    if (app.get_parent() == nullptr) return "";
    const std::string above = path_of(*app.get_parent());
    return above + (above.empty() ? "" : " ") + app.get_name();
}

// What an option or argument takes, as the completion script reads it: "file .aesl", "words a b",
// "any", "none".
std::string kind_of(const CLI::Option& option) {
    if (option.get_items_expected_max() == 0) return "none";
    std::string type = option.get_type_name();
    if (type.starts_with("FILE")) {
        std::string kind = "file";
        for (char& c : type) c = c == '(' || c == ')' || c == '|' ? ' ' : c;
        return kind + type.substr(4);
    }
    std::string words;
    for (const std::string_view word : split(type, '|')) {
        // Upper case stands for something that a person fills in.
        const bool fixed = !word.empty() && std::none_of(word.begin(), word.end(), [](char c) {
            return std::isupper(static_cast<unsigned char>(c)) != 0 || c == ' ';
        });
        if (fixed) words += " " + std::string(word);
    }
    return words.empty() ? "any" : "words" + words;
}

void add_tables(CLI::App& app, std::string& names, std::string& takes) {
    const std::string path = path_of(app);
    std::string list;
    for (const CLI::App* verb : verbs_of(app)) list += verb->get_name() + " ";
    int position = 0;
    for (const CLI::Option* option : app.get_options()) {
        if (option->get_positional() && option->get_lnames().empty()) {
            const std::string key = path + " " + std::to_string(++position);
            takes += "    [\"" + key + "\"]=\"" + kind_of(*option) + "\"\n";
            continue;
        }
        for (const auto* forms : {&option->get_lnames(), &option->get_snames()}) {
            for (const std::string& form : *forms) {
                const std::string name = (forms == &option->get_lnames() ? "--" : "-") + form;
                if (name.starts_with("--")) list += name + " ";
                takes += "    [\"" + path + " " + name + "\"]=\"" + kind_of(*option) + "\"\n";
            }
        }
    }
    if (!list.empty()) list.pop_back();
    names += "    [\"" + path + " \"]=\"" + list + "\"\n";
    for (CLI::App* verb : verbs_of(app)) add_tables(*verb, names, takes);
}

constexpr std::string_view kBashHead =
    R"sh(# Completion of `vagus` for bash. Made by `vagus page bash`; do not edit.
#
#     source completions/vagus.bash

# What may follow each verb, by its name.
declare -A _vagus_names=(
)sh";

constexpr std::string_view kBashMiddle = R"sh()
# What each option and argument (by its number) takes: "none", "any", "file ENDING", "words WORD".
declare -A _vagus_takes=(
)sh";

constexpr std::string_view kBashTail = R"sh()

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
)sh";

void add_help(CLI::App& app, std::string& page) {
    const std::string path = path_of(app);
    page += "## vagus " + path + "\n\n```\n" + app.help("", CLI::AppFormatMode::Normal) + "```\n\n";
    for (CLI::App* verb : verbs_of(app)) add_help(*verb, page);
}

// Words of `text` in lines of `width`; lines that are there stay.
std::vector<std::string> broken(const std::string& text, size_t width) {
    std::vector<std::string> lines;
    for (const std::string_view paragraph : split(text, '\n')) {
        std::string line;
        for (const std::string_view word : split(paragraph, ' ')) {
            if (!line.empty() && line.size() + 1 + word.size() > width) {
                lines.push_back(line);
                line.clear();
            } else if (!line.empty()) {
                line += ' ';
            }
            line += word;
        }
        lines.push_back(line);
    }
    return lines;
}

std::string row(const std::string& name, const std::string& description) {
    std::string text = "  " + name;
    const bool long_name = text.size() + 2 > kNameColumns;
    if (long_name) text += "\n";
    bool first = !long_name;
    for (const std::string& line : broken(description, kHelpColumns - kNameColumns)) {
        const size_t used = first ? text.size() : 0;
        text += std::string(kNameColumns - used, ' ') + line + "\n";
        first = false;
    }
    return text;
}

// CLI11's layout with our words: a title, how it is called, then rows of name and sentence.
class Help : public CLI::Formatter {
public:
    std::string make_help(const CLI::App* app, std::string, CLI::AppFormatMode) const override {
        std::string text = app->get_description() + "\n\nUsage:  " + usage(*app) + "\n\n";
        std::string arguments;
        std::string options;
        for (const CLI::Option* option : app->get_options()) {
            const bool argument = option->get_positional() && option->get_lnames().empty();
            if (option->get_group().empty()) continue;
            (argument ? arguments : options) += row(name(*option), option->get_description());
        }
        std::string verbs;
        for (const CLI::App* verb : app->get_subcommands([](const CLI::App*) { return true; })) {
            if (verb->get_group().empty()) continue;
            verbs += row(verb->get_name(), verb->get_description());
        }
        if (!arguments.empty()) text += arguments + "\n";
        if (!verbs.empty()) text += "Verbs:\n" + verbs + "\n";
        text += "Options:\n" + options;
        if (!app->get_footer().empty()) text += "\n" + app->get_footer() + "\n";
        return text;
    }

private:
    static std::string name(const CLI::Option& option) {
        const bool argument = option.get_positional() && option.get_lnames().empty();
        if (argument) return option.get_name(true);
        std::string text;
        for (const std::string& form : option.get_snames()) text += "-" + form + ", ";
        for (const std::string& form : option.get_lnames()) text += "--" + form + ", ";
        text.resize(text.size() - 2);
        if (option.get_items_expected_max() == 0) return text;
        return text + " " + placeholder(option);
    }

    // "FILE(.aesl)" tells the completion about endings, "N:UINT" CLI11 about checks; a person needs
    // the word.
    static std::string placeholder(const CLI::Option& option) {
        const std::string type = option.get_type_name();
        return type.starts_with("FILE") ? "FILE" : type.substr(0, type.find(':'));
    }

    static std::string usage(const CLI::App& app) {
        const std::string path = path_of(app);
        std::string text = "vagus" + (path.empty() ? "" : " " + path);
        bool any_option = false;
        std::string arguments;
        for (const CLI::Option* option : app.get_options()) {
            if (!(option->get_positional() && option->get_lnames().empty())) {
                any_option = true;
                continue;
            }
            const bool many = option->get_items_expected_max() > 1;
            std::string word = option->get_name(true) + (many ? "…" : "");
            if (option->get_required()) arguments += " " + word;
            if (!option->get_required()) arguments += " [" + word + "]";
        }
        const auto verbs = app.get_subcommands([](const CLI::App*) { return true; });
        const bool has_verb = std::any_of(verbs.begin(), verbs.end(), [](const CLI::App* verb) {
            return !verb->get_group().empty();
        });
        if (has_verb) arguments += " VERB …";
        return text + arguments + (any_option ? " [OPTION]…" : "");
    }
};

}  // namespace

void shape_help(CLI::App& app) {
    app.formatter(std::make_shared<Help>());
    for (CLI::App* verb : app.get_subcommands([](CLI::App*) { return true; })) {
        verb->set_help_flag("-h,--help", "this text");
        shape_help(*verb);
    }
}

std::string own_help(CLI::App& app) {
    return app.get_formatter()->make_help(&app, "", CLI::AppFormatMode::Normal);
}

std::string bash_completion(CLI::App& app) {
    std::string names;
    std::string takes;
    add_tables(app, names, takes);
    return std::string(kBashHead) + names + std::string(kBashMiddle) + takes +
           std::string(kBashTail);
}

std::string manual_page(CLI::App& app) {
    std::string page =
        "# The command line\n\n"
        "Made by `vagus page manual`; do not edit. What the outputs look like is in "
        "[formats.md](formats.md).\n\n"
        "```\n" +
        own_help(app) + "```\n\n";
    for (CLI::App* verb : verbs_of(app)) add_help(*verb, page);
    page.pop_back();
    return page;
}

void add_page(CLI::App& app, int& exit_code) {
    CLI::App* verb = app.add_subcommand("page", "prints what is derived from this help");
    verb->group("");
    auto kind = std::make_shared<std::string>();  // owners: CLI11's option and the callback
    CLI::Option* option = verb->add_option("KIND", *kind, "which")->required();
    takes_one_of(*option, {"bash", "man", "manual"});
    verb->footer("Example:\n  vagus page bash > completions/vagus.bash");
    verb->callback([kind, &app, &exit_code] {
        print(*kind == "bash"  ? bash_completion(app)
              : *kind == "man" ? man_page(app)
                               : manual_page(app));
        exit_code = kExitDone;
    });
}

}  // namespace vagus::cli
