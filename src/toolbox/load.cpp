#include "toolbox/load.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <set>
#include <string_view>
#include <utility>

#include "base/file.hpp"
#include "plan/formula.hpp"
#include "toolbox/plugin.hpp"

namespace vagus::toolbox {

namespace {

constexpr std::string_view kFileEnding = ".toolbox.json";

Error refused(const std::string& path, std::string_view sentence) {
    return {Code::Refused, fmt::format("the toolbox {}: {}", path, sentence)};
}

// Plans look in `core` first: what has the name of one of its templates could never be used.
Status check_reachable(const run::CodeLibrary& library, const std::string& path,
                       const Plugin& plugin) {
    const plan::Toolbox* core = library.templates().find(plan::kCoreToolbox);
    if (!core) return Status::done();
    for (const run::Coded& coded : plugin.templates) {
        const plan::Template& mine = coded.declared;
        const bool supervisor = mine.kind == plan::Kind::Supervisor;
        for (const plan::Template& other : core->templates) {
            if (other.name != mine.name || (other.kind == plan::Kind::Supervisor) != supervisor) {
                continue;
            }
            const std::string place = mine.line > 0 ? fmt::format("in line {} ", mine.line) : "";
            return refused(path, fmt::format("its template \"{}\" {}can never be used: the toolbox "
                                             "core has one of that name, and plans look there "
                                             "first; give it another name",
                                             mine.name, place));
        }
    }
    return Status::done();
}

Status add(run::CodeLibrary& library, const std::string& path, Plugin plugin) {
    if (library.templates().find(plugin.name)) {
        return refused(path, fmt::format("there is a toolbox named \"{}\" already; give this one "
                                         "another name",
                                         plugin.name));
    }
    TRY(check_reachable(library, path, plugin));
    library.add(std::move(plugin.name), std::move(plugin.help), std::move(plugin.templates), path);
    return Status::done();
}

// ---- shared libraries ----

std::string loader_sentence() {
    const char* const said = dlerror();
    return said ? said : "the loader does not say why";
}

template <typename Function>
Function find_function(void* loaded, const char* name) {
    return reinterpret_cast<Function>(dlsym(loaded, name));
}

Status check_version(const std::string& path, PluginVersionFunction tell) {
    PluginVersion theirs;
    tell(theirs);
    const PluginVersion ours;
    if (std::string_view(theirs.version) == ours.version &&
        std::equal(std::begin(ours.sizes), std::end(ours.sizes), std::begin(theirs.sizes))) {
        return Status::done();
    }
    return refused(path, fmt::format("it was built for another Vagus ({}) than this one ({}); "
                                     "rebuild it with the package installed with this one",
                                     theirs.version, ours.version));
}

Result<Plugin> make_plugin(const std::string& path, PluginMakeFunction make, const Parts& parts) {
    Plugin plugin;
    try {
        make(plugin, parts);
    } catch (const std::exception& error) {
        return refused(path, fmt::format("its code failed: {}; fix it there", error.what()));
    }
    const Status checked = check_declared(plugin.name, plugin.templates);
    if (!checked.ok()) return refused(path, checked.error().what);
    return plugin;
}

Status load_library(run::CodeLibrary& library, const std::string& path, const Parts& parts) {
    // Without a slash the loader would look in the system's folders.
    const std::string absolute = std::filesystem::absolute(path).string();
    // Never unloaded: code and texts of it are used until the program ends.
    void* const loaded = dlopen(absolute.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
    if (!loaded) {
        return refused(path, fmt::format("it cannot be loaded as a shared library: {}; build it as "
                                         "a MODULE library that links Vagus::toolbox",
                                         loader_sentence()));
    }
    const auto version = find_function<PluginVersionFunction>(loaded, kPluginVersionFunction);
    const auto make = find_function<PluginMakeFunction>(loaded, kPluginMakeFunction);
    if (!version || !make) {
        return refused(path, fmt::format("it has no function {}; end its code with "
                                         "VAGUS_TOOLBOX(make) (vagus/toolbox/plugin.hpp)",
                                         version ? kPluginMakeFunction : kPluginVersionFunction));
    }
    TRY(check_version(path, version));
    Plugin plugin = TRY(make_plugin(path, make, parts));
    return add(library, path, std::move(plugin));
}

// ---- checks ----

Status check_names(std::string_view what, std::vector<std::string> names,
                   const std::string& owner) {
    std::set<std::string> seen;
    for (const std::string& name : names) {
        if (!plan::is_name(name)) {
            return Error{Code::BadInput,
                         fmt::format("\"{}\" of {} cannot be the name of {}: use letters, digits "
                                     "and _, not beginning with a digit",
                                     name, owner, what)};
        }
        if (!seen.insert(name).second) {
            return Error{Code::BadInput, fmt::format("{} has {} named \"{}\" twice; give one "
                                                     "another name",
                                                     owner, what, name)};
        }
    }
    return Status::done();
}

template <typename List>
std::vector<std::string> names_of(const List& list) {
    std::vector<std::string> names;
    for (const auto& one : list) names.push_back(one.name);
    return names;
}

Status check_template(const run::Coded& coded) {
    const plan::Template& declared = coded.declared;
    const std::string owner = fmt::format("the template \"{}\"", declared.name);
    TRY(check_names("an input", names_of(declared.inputs), owner));
    TRY(check_names("an output", names_of(declared.outputs), owner));
    TRY(check_names("a state or event", names_of(declared.outcomes), owner));
    for (const plan::Input& input : declared.inputs) {
        if (input.type && input.fallback && input.fallback->type() != *input.type) {
            return Error{Code::BadInput,
                         fmt::format("the default of the input \"{}\" of {} is of another type "
                                     "than the input",
                                     input.name, owner)};
        }
    }
    const bool supervisor = declared.kind == plan::Kind::Supervisor;
    if (static_cast<bool>(coded.supervisor) != supervisor ||
        static_cast<bool>(coded.actor) == supervisor) {
        return Error{Code::BadInput, fmt::format("{} must have the code of {}, and no other", owner,
                                                 supervisor ? "a supervisor" : "an actor")};
    }
    const bool period_fits = declared.period_ms >= 0 && declared.period_ms <= plan::kPeriodMaxMs;
    if (!period_fits || declared.grace_ms < 0) {
        return Error{Code::BadInput, fmt::format("{} must have a period from 0 to {} ms, and a "
                                                 "grace time of 0 ms or more",
                                                 owner, plan::kPeriodMaxMs)};
    }
    return Status::done();
}

}  // namespace

Status check_declared(const std::string& name, const std::vector<run::Coded>& templates) {
    TRY(check_names("a toolbox", {name}, "it"));
    if (templates.size() > kTemplatesMax) {
        return Error{Code::Limit, fmt::format("it has {} templates; {} are enough",
                                              templates.size(), kTemplatesMax)};
    }
    std::vector<std::string> names;
    for (const run::Coded& coded : templates) names.push_back(coded.declared.name);
    TRY(check_names("a template", names, "it"));
    for (const run::Coded& coded : templates) TRY(check_template(coded));
    return Status::done();
}

Status load_toolbox(run::CodeLibrary& library, const std::string& path, const Parts& parts,
                    const ReadProject& read_project) {
    if (path.ends_with(kLibraryEnding)) return load_library(library, path, parts);
    if (!path.ends_with(kFileEnding)) {
        return refused(path, "expected a file NAME.toolbox.json or a shared library NAME.so");
    }
    return load_toolbox_text(library, TRY(read_file(path)), path, parts, read_project);
}

Status load_toolbox_text(run::CodeLibrary& library, std::string_view text, const std::string& path,
                         const Parts& parts, const ReadProject& read_project) {
    const ToolboxFile file = TRY(read_toolbox(text, path, read_project));
    return add(library, path, {file.name, file.help, code_of(file, parts)});
}

}  // namespace vagus::toolbox
