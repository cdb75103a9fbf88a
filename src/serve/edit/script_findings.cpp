#include "serve/edit/script_findings.hpp"

#include "aesl/project_text.hpp"
#include "serve/edit/text_places.hpp"
#include "serve/project/difference.hpp"
#include "serve/project/utf16.hpp"

namespace vagus::serve {

namespace {

// One edit that makes a file out of another text of it.
TextEdit edit_between(const std::string& doc, std::string_view before, std::string_view after) {
    const TextDifference change = difference(before, after);
    return {doc, units_of(before, change.from), units_of(before, change.to),
            std::string(change.insert)};
}

FindingFix fix_of(const ScriptPart& part, const aesl::Fix& fix, const TextPlaces& places,
                  const std::string& file) {
    FindingFix found{fix.label, {}};
    for (const aesl::Edit& edit : fix.edits) {
        found.edits.push_back(
            {part.doc, places.unit_of(edit.range.at), places.unit_of(edit.range.end), edit.text});
    }
    if (fix.declares && part.doc != part.file && !file.empty()) {
        const aesl::ProjectText project(file);
        const std::string after = project.add(
            {"event", fix.declares->name, static_cast<int32_t>(fix.declares->size.value_or(0))});
        found.edits.push_back(edit_between(part.file, file, after));
    }
    return found;
}

}  // namespace

std::vector<DocFinding> findings_of_script(const ScriptPart& part, const CompiledScript& script,
                                           const std::string& file) {
    const TextPlaces places(script.source);
    std::vector<DocFinding> findings;
    const auto add = [&](const aesl::Diagnostic& diagnostic, Severity severity) {
        DocFinding finding{part.doc,      severity,       diagnostic.code,    {},
                           diagnostic.at, diagnostic.end, diagnostic.message, {}};
        if (diagnostic.fix) {
            FindingFix fix = fix_of(part, *diagnostic.fix, places, file);
            if (!fix.edits.empty()) finding.fixes.push_back(std::move(fix));
        }
        findings.push_back(std::move(finding));
    };
    for (const auto& error : script.result.errors) add(error, Severity::Error);
    for (const auto& warning : script.result.warnings) add(warning, Severity::Warning);
    return findings;
}

}  // namespace vagus::serve
