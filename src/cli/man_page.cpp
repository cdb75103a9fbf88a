#include "cli/man_page.hpp"

#include <CLI/CLI.hpp>

#include "base/text.hpp"
#include "cli/page.hpp"

namespace vagus::cli {
namespace {

// A line as it is: roff reads a leading dot or apostrophe as a request, a backslash as an
// escape, and shows a plain minus as a hyphen that cannot be copied.
std::string literal(std::string_view line) {
    std::string text;
    if (line.starts_with('.') || line.starts_with('\'')) text = "\\&";
    for (const char letter : line) {
        if (letter == '\\') {
            text += "\\e";
        } else if (letter == '-') {
            text += "\\-";
        } else {
            text += letter;
        }
    }
    return text;
}

std::string as_it_stands(const std::string& text) {
    std::string page = ".nf\n";
    std::string_view rest = text;
    while (rest.ends_with('\n')) rest.remove_suffix(1);
    for (const std::string_view line : split(rest, '\n')) page += literal(line) + "\n";
    return page + ".fi\n";
}

void add_verbs(CLI::App& app, const std::string& above, std::string& page) {
    for (CLI::App* verb : app.get_subcommands([](CLI::App*) { return true; })) {
        if (verb->get_group().empty()) continue;
        const std::string name = above + " " + verb->get_name();
        page += ".SS \"" + literal(name) + "\"\n" +
                as_it_stands(verb->help("", CLI::AppFormatMode::Normal));
        add_verbs(*verb, name, page);
    }
}

}  // namespace

std::string man_page(CLI::App& app) {
    std::string page =
        ".\\\" Made by `vagus page man`; do not edit.\n"
        ".TH VAGUS 1 \"\" \"Vagus " VAGUS_VERSION
        "\" \"User Commands\"\n"
        ".SH NAME\nvagus \\- programs robots made of many microcontrollers\n"
        ".SH SYNOPSIS\n.B vagus\nVERB [OPTION]...\n.SH DESCRIPTION\n";
    page += as_it_stands(own_help(app));
    page += ".SH VERBS\n";
    add_verbs(app, "vagus", page);
    page +=
        ".SH FILES\n"
        ".TP\n.I vagus.json\nmakes its folder a project\n"
        ".TP\n.I /etc/default/vagus\noptions of the service vagus.service\n"
        ".SH EXIT STATUS\n0 if it was done, 1 if not, 2 if the command line or a file is wrong.\n";
    return page;
}

}  // namespace vagus::cli
