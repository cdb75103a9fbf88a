#include "conformance/report_text.hpp"

#include "base/json.hpp"
#include "base/text.hpp"

namespace vagus::conformance {
namespace {

constexpr size_t kVerdictWidth = 9;
constexpr size_t kGroupWidth = 13;

const char* word_of(Verdict verdict) {
    switch (verdict) {
        case Verdict::Passed:
            return "passed";
        case Verdict::Failed:
            return "failed";
        case Verdict::Skipped:
            return "skipped";
        case Verdict::NotRun:
            return "not run";
    }
    return "";
}

std::string padded(std::string text, size_t width) {
    const size_t size = count_code_points(text);
    return size < width ? text.append(width - size, ' ') : text;
}

JsonValue row_json(const Row& row) {
    std::vector<JsonMember> members{
        json_member("group", row.check.group), json_member("check", row.check.name),
        json_member("section", row.check.section), json_member("result", word_of(row.verdict))};
    if (!row.found.empty()) members.push_back(json_member("found", row.found));
    if (!row.check.defects.empty()) members.push_back(json_member("defects", row.check.defects));
    return json_object(std::move(members));
}

JsonValue count_json(const Report& report, Verdict verdict) {
    return json_integer(static_cast<int64_t>(report.count(verdict)));
}

}  // namespace

std::string row_text(const Row& row) {
    const std::string indent(kVerdictWidth + kGroupWidth, ' ');
    std::string text = padded(word_of(row.verdict), kVerdictWidth) +
                       padded(row.check.group, kGroupWidth) + row.check.name + "  (" +
                       row.check.section + ")\n";
    if (!row.found.empty()) text += indent + visible(row.found) + "\n";
    if (row.verdict == Verdict::Failed && !row.check.defects.empty())
        text += indent + "a defect of the reference, too (section 8): " + row.check.defects + "\n";
    return text;
}

std::string summary_text(const Report& report) {
    std::string text = std::to_string(report.count(Verdict::Passed)) + " passed, " +
                       std::to_string(report.count(Verdict::Failed)) + " failed, " +
                       std::to_string(report.count(Verdict::Skipped)) + " skipped";
    const size_t not_run = report.count(Verdict::NotRun);
    if (not_run > 0) text += ", " + std::to_string(not_run) + " not run";
    return text + ": node " + std::to_string(report.node) + " \"" + visible(report.target.name) +
           "\"\n";
}

std::string report_json(const Report& report) {
    std::vector<JsonValue> rows;
    for (const Row& row : report.rows) rows.push_back(row_json(row));
    const int64_t foreign = static_cast<int64_t>(report.foreign);
    return format_json(json_object({json_member("node", json_integer(report.node)),
                                    json_member("name", report.target.name),
                                    json_member("passed", count_json(report, Verdict::Passed)),
                                    json_member("failed", count_json(report, Verdict::Failed)),
                                    json_member("skipped", count_json(report, Verdict::Skipped)),
                                    json_member("notRun", count_json(report, Verdict::NotRun)),
                                    json_member("otherHosts", json_integer(foreign)),
                                    json_member("checks", json_array(std::move(rows)))}));
}

}  // namespace vagus::conformance
