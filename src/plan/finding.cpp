#include "plan/finding.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "base/json.hpp"

namespace vagus::plan {
namespace {

// The keys are fixed (docs/plans.md, section 5): where the text itself is wrong, the column is
// part of the message.
std::string message_of(const Finding& finding) {
    if (finding.rule != "P0" || finding.column == 0) return finding.message;
    return fmt::format("{} (column {})", finding.message, finding.column);
}

}  // namespace

Findings sorted(const std::vector<Findings>& found, const std::string& first) {
    std::vector<std::string> order;
    for (const Findings& findings : found) {
        for (const Finding& finding : findings) {
            if (std::find(order.begin(), order.end(), finding.file) == order.end()) {
                order.push_back(finding.file);
            }
        }
    }
    std::stable_partition(order.begin(), order.end(),
                          [&first](const std::string& file) { return file == first; });
    Findings all;
    for (const std::string& file : order) {
        Findings of_file;
        for (const Findings& findings : found) {
            std::copy_if(findings.begin(), findings.end(), std::back_inserter(of_file),
                         [&file](const Finding& finding) { return finding.file == file; });
        }
        std::stable_sort(of_file.begin(), of_file.end(),
                         [](const Finding& a, const Finding& b) { return a.line < b.line; });
        all.insert(all.end(), of_file.begin(), of_file.end());
    }
    return all;
}

std::string format_findings_json(const Findings& findings) {
    std::string text = "[";
    for (const Finding& finding : findings) {
        text += fmt::format(
            "{}\n  {{\"severity\": \"{}\", \"rule\": {}, \"file\": {}, \"plan\": {}, \"element\": "
            "{}, \"line\": {}, \"message\": {}}}",
            text.size() > 1 ? "," : "", name_of(finding.severity), json_quote(finding.rule),
            json_quote(finding.file), json_quote(finding.plan), json_quote(finding.element),
            finding.line, json_quote(message_of(finding)));
    }
    return text + (findings.empty() ? "]\n" : "\n]\n");
}

}  // namespace vagus::plan
