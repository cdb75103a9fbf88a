#include "serve/edit/own_script.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "aesl/compile.hpp"
#include "aesl/project_text.hpp"

namespace vagus::serve {

namespace {

Error refused_script(std::string what) {
    return Error{Code::Refused, std::move(what)};
}

bool has_variable(const aesl::Target& target, std::string_view name) {
    return std::ranges::any_of(target.variables, [&](const auto& one) { return one.name == name; });
}

}  // namespace

Result<OwnScript> own_script(const ScriptPart& part, const OwnTemplate& wanted, const Files& files,
                             Scripts& scripts) {
    const CompiledScript* script = scripts.compiled(part.doc);
    const aesl::CommonDefinitions* known = scripts.common(part.file);
    const size_t mark = part.doc.rfind('#');
    if (!script || !known || mark == std::string::npos) {
        return refused_script(
            fmt::format("{} is a plain script, which declares no events; take a script "
                        "of an .aesl project",
                        part.doc));
    }
    if (!script->result.ok()) {
        return refused_script(fmt::format(
            "the script of {} has an error; fix it first: line {}: {}", part.node,
            script->result.first_error().at.line, script->result.first_error().message));
    }
    OwnTemplate of = wanted;
    if (!has_variable(script->target, of.args)) of.args = "args";
    aesl::CommonDefinitions common = *known;
    std::string text = TRY(files.text(part.file));
    for (const aesl::GlobalEvent& event : events_of(of)) {
        const bool taken = std::ranges::any_of(
            common.events, [&](const aesl::GlobalEvent& one) { return one.name == event.name; });
        if (taken) {
            return refused_script(
                fmt::format("{} has an event “{}” already; take another name for the "
                            "template",
                            part.file, event.name));
        }
        common.events.push_back(event);
        text = aesl::ProjectText(text).add({"event", event.name, *event.size});
    }
    const FilledIn filled = script_with(script->source, of);
    const auto compiled = aesl::compile(filled.script, script->target, common, {});
    if (!compiled.ok()) {
        return refused_script(fmt::format(
            "the handlers of “{}” do not fit into the script of {}: line "
            "{}: {}",
            of.name, part.node, compiled.first_error().at.line, compiled.first_error().message));
    }
    const size_t index = std::stoul(part.doc.substr(mark + 1)) - 1;
    return OwnScript{aesl::ProjectText(text).replace(
                         index, 0, aesl::ProjectText(text).script(index).size(), filled.script),
                     filled.line};
}

}  // namespace vagus::serve
