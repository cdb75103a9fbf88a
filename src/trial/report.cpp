#include "trial/report.hpp"

#include <fmt/format.h>

#include <utility>

#include "base/text.hpp"

namespace vagus::trial {

namespace {

// Characters that XML 1.0 has no way to hold are shown as visible() does.
std::string xml(std::string_view text) {
    std::string out;
    for (const char c : visible_lines(text)) {
        switch (c) {
            case '<':
                out += "&lt;";
                break;
            case '>':
                out += "&gt;";
                break;
            case '&':
                out += "&amp;";
                break;
            case '"':
                out += "&quot;";
                break;
            default:
                out += c;
        }
    }
    return out;
}

// A test case is a name and what came of it.
using Case = std::pair<std::string, const SeedResult*>;

std::vector<Case> cases_of(const TestResult& result) {
    std::vector<Case> cases;
    for (const SeedResult& one : result.seeds) {
        cases.emplace_back(fmt::format("seed {}", one.seed), &one);
    }
    for (const FaultsResult& one : result.faults) {
        cases.emplace_back(fmt::format("seed {} --chaos {}", one.result.seed, one.words),
                           &one.result);
    }
    return cases;
}

std::string test_case(const TestFile& test, const std::string& name, const SeedResult& result) {
    const std::string head =
        fmt::format("    <testcase classname=\"{}\" name=\"{}\" time=\"{:.3f}\"", xml(test.path),
                    xml(name), result.seconds);
    if (as_expected(result)) return head + "/>\n";
    const std::string what = xml(describe_failure(test, result));
    const std::string_view kind = result.trouble.empty() ? "failure" : "error";
    return fmt::format("{}>\n      <{} message=\"{}\">{}</{}>\n    </testcase>\n", head, kind,
                       what.substr(0, what.find('\n')), what, kind);
}

}  // namespace

bool as_expected(const SeedResult& result) {
    return result.trouble.empty() && result.outcome.as_expected();
}

std::vector<Failure> failures_of(const TestFile& test, const Outcome& outcome) {
    std::vector<Failure> failures;
    for (size_t i = 0; i < test.expect.size(); ++i) {
        const Verdict& verdict = outcome.verdicts[i];
        if (verdict.as_expected) continue;
        const Expectation& one = test.expect[i];
        failures.push_back({one.at, seconds_of(verdict.at), text_of(one), verdict.what, one.help});
    }
    return failures;
}

std::string describe_failure(const TestFile& test, const SeedResult& result) {
    if (!result.trouble.empty()) {
        return fmt::format("{}: seed {}: {}", test.path, result.seed, result.trouble);
    }
    std::vector<std::string> lines;
    for (const Failure& one : failures_of(test, result.outcome)) {
        lines.push_back(at_place(
            test.path, one.at,
            fmt::format("seed {}, at {} s: {}: {}{}", result.seed, plan::text_of(one.t),
                        one.expected, one.what, one.help.empty() ? "" : " (" + one.help + ")")));
    }
    return joined_lines(lines);
}

std::string format_junit(const std::vector<TestResult>& results) {
    std::string suites;
    for (const TestResult& result : results) {
        size_t troubles = 0, bad = 0;
        double seconds = 0;
        std::string cases;
        const std::vector<Case> all = cases_of(result);
        for (const auto& [name, one] : all) {
            troubles += one->trouble.empty() ? 0 : 1;
            bad += as_expected(*one) ? 0 : 1;
            seconds += one->seconds;
            cases += test_case(result.test, name, *one);
        }
        suites += fmt::format(
            "  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"{}\" "
            "time=\"{:.3f}\">\n{}  </testsuite>\n",
            xml(result.test.path), all.size(), bad - troubles, troubles, seconds, cases);
    }
    return std::string(kJunitBegins) + suites + "</testsuites>\n";
}

}  // namespace vagus::trial
