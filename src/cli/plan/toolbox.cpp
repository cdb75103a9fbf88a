// `vagus toolbox`: which templates there are, and what they take and give.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "base/nearest.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"
#include "cli/plan/toolbox_text.hpp"
#include "cli/verbs.hpp"
#include "session/toolboxes.hpp"

namespace vagus::cli {

namespace {

struct Options {
    std::string name;
    std::vector<std::string> toolboxes;
    bool json = false;
};

// The toolbox of that name, or the templates of that name in all of them (`drive.Forward`: in one);
// all toolboxes if there is no name.
std::vector<ShownToolbox> select(const plan::Library& library, const std::string& name) {
    std::vector<ShownToolbox> selected;
    for (const plan::Toolbox& toolbox : library.toolboxes()) {
        ShownToolbox shown{&toolbox, {}};
        for (const plan::Template& one : toolbox.templates) {
            const bool whole = name.empty() || name == toolbox.name;
            if (whole || name == one.name || name == toolbox.name + "." + one.name) {
                shown.templates.push_back(&one);
            }
        }
        if (!shown.templates.empty()) selected.push_back(std::move(shown));
    }
    return selected;
}

int complain_of_name(const plan::Library& library, const std::string& name) {
    std::vector<std::string> known;
    for (const plan::Toolbox& toolbox : library.toolboxes()) {
        known.push_back(toolbox.name);
        for (const plan::Template& one : toolbox.templates) known.push_back(one.name);
    }
    const std::string near = nearest(name, known);
    return complain(fmt::format("there is no toolbox or template \"{}\"; {}", name,
                                near.empty() ? "`vagus toolbox list` shows all"
                                             : fmt::format("did you mean \"{}\"?", near)),
                    kExitUsage);
}

int show(const Options& options, Detail detail) {
    const toolbox::Parts parts;
    run::CodeLibrary library;
    const Status added = session::add_toolboxes(library, parts, options.toolboxes);
    if (!added.ok()) return complain(added.error(), kExitUsage);
    const auto selected = select(library.templates(), options.name);
    if (selected.empty()) return complain_of_name(library.templates(), options.name);
    if (options.json) {
        print(toolboxes_json(selected, detail));
    } else {
        print(detail == Detail::Names ? list_text(selected) : show_text(selected));
    }
    return kExitDone;
}

void add_options(CLI::App& verb, Options& options) {
    add_toolbox_option(verb, options.toolboxes);
    verb.add_flag("--json", options.json, "as a JSON array of toolboxes");
}

void add_list(CLI::App& toolbox, int& exit_code) {
    CLI::App* verb = toolbox.add_subcommand("list", "all toolboxes and their templates");
    verb->footer("Example:\n  vagus toolbox list");
    auto options = std::make_shared<Options>();  // owners: CLI11's options and the callback
    add_options(*verb, *options);
    verb->callback([options, &exit_code] { exit_code = show(*options, Detail::Names); });
}

void add_show(CLI::App& toolbox, int& exit_code) {
    CLI::App* verb =
        toolbox.add_subcommand("show", "inputs, outputs, units, states and events of templates");
    verb->footer("Example:\n  vagus toolbox show Forward");
    auto options = std::make_shared<Options>();  // owners: CLI11's options and the callback
    verb->add_option("NAME", options->name,
                     "a toolbox, a template, or TOOLBOX.TEMPLATE; all if there is none");
    add_options(*verb, *options);
    verb->callback([options, &exit_code] { exit_code = show(*options, Detail::All); });
}

}  // namespace

void add_toolbox(CLI::App& app, int& exit_code) {
    CLI::App* toolbox = app.add_subcommand("toolbox", "the templates that plans are made of");
    toolbox->require_subcommand(1);
    toolbox->footer("Example:\n  vagus toolbox show carbot --json");
    add_list(*toolbox, exit_code);
    add_show(*toolbox, exit_code);
}

}  // namespace vagus::cli
