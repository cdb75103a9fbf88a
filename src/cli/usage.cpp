#include "cli/usage.hpp"

#include <CLI/CLI.hpp>
#include <cctype>

#include "base/nearest.hpp"
#include "cli/options.hpp"

namespace vagus::cli {
namespace {

// The innermost verb that the command line reached: `net list`, not `net`.
const CLI::App& reached(const CLI::App& app) {
    const auto below = app.get_subcommands();
    return below.empty() ? app : reached(*below.front());
}

std::string full_name(const CLI::App& app) {
    if (app.get_parent() == nullptr) return app.get_name();
    return full_name(*app.get_parent()) + " " + app.get_name();
}

std::vector<std::string> options_of(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::Option* option : app.get_options()) {
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    }
    return names;
}

std::vector<std::string> verbs_of(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; })) {
        if (!verb->get_name().empty() && !verb->get_group().empty()) {
            names.push_back(verb->get_name());
        }
    }
    return names;
}

// An option comes before a word: in `--fromat json a.aesl` it is the option that is wrong.
std::string first_wrong(const std::vector<std::string>& words) {
    for (const std::string& word : words) {
        if (word.starts_with("-")) return word;
    }
    return words.empty() ? "" : words.front();
}

std::string unknown_word(const CLI::App& verb, const std::string& typed) {
    const bool is_option = typed.starts_with("-");
    const std::string name = typed.substr(0, is_option ? typed.find('=') : typed.npos);
    const auto verbs = verbs_of(verb);
    const char* kind = is_option ? "option" : verbs.empty() ? "argument" : "verb";
    std::string text = full_name(verb) + ": there is no " + kind + " \"" + name + "\" here";
    if (!is_option && verbs.empty())
        text = full_name(verb) + ": \"" + name + "\" is one argument too many";
    const std::string guess = nearest(name, is_option ? options_of(verb) : verbs);
    return text + (guess.empty() ? "." : "; did you mean " + guess + "?");
}

std::string hint(const CLI::App& verb) {
    return "Type `" + full_name(verb) + " --help` to see what it takes, with an example.\n";
}

}  // namespace

std::string usage_error(const CLI::App& app, const CLI::ParseError& error) {
    const CLI::App& verb = reached(app);
    // A mistyped verb of `net` is missed first and found to be too much only afterwards.
    const bool lacks_verb = dynamic_cast<const CLI::RequiredError*>(&error) != nullptr &&
                            !verbs_of(verb).empty() && !app.remaining(true).empty();
    if (lacks_verb || dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) {
        return unknown_word(verb, first_wrong(app.remaining(true))) + "\n" + hint(verb);
    }
    std::string sentence = error.what();
    if (sentence == "A subcommand is required")
        sentence = "say what to do: " + one_of(verbs_of(verb));
    // "--speed: At Most 1 required but received 2"
    const size_t twice = sentence.find(": At Most 1 required but received");
    if (twice != sentence.npos)
        sentence = sentence.substr(0, twice) + " is given more than once; keep one of them";
    if (!sentence.ends_with(".") && !sentence.ends_with("?")) sentence += ".";
    return full_name(verb) + ": " + sentence + "\n" + hint(verb);
}

// CLI11 takes the next word for a value whatever it is: `--trace --headless` would write a file
// "--headless".
void refuse_options_as_values(CLI::App& app) {
    const auto check = [](const std::string& value) -> std::string {
        const bool option =
            value.starts_with("--") || (value.size() > 1 && value[0] == '-' &&
                                        std::isalpha(static_cast<unsigned char>(value[1])) != 0);
        if (!option) return "";
        return "expected a value, found the option \"" + value + "\"; give a value before it";
    };
    for (CLI::Option* option : app.get_options()) {
        if (option->get_positional() || option->get_items_expected_max() == 0) continue;
        option->check(CLI::Validator(check, ""));
    }
    for (CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; })) {
        refuse_options_as_values(*verb);
    }
}

std::string no_verb_error() {
    return "vagus: say what to do with a verb, for instance `vagus sim WORLD`.\n"
           "Type `vagus --help` to see all verbs.\n";
}

}  // namespace vagus::cli
