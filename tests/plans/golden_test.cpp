// Every case of testdata/golden/plans (its README says what is normative): traces and exit statuses
// of runs in virtual time, findings of checks.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "base/file.hpp"
#include "base/json.hpp"
#include "base/test_places.hpp"
#include "plan/check.hpp"
#include "plan/graph.hpp"
#include "plan/test_files.hpp"
#include "run/virtual_time.hpp"
#include "tests/plans/sha256.hpp"
#include "toolbox/core.hpp"
#include "toolbox/core_values.hpp"

namespace vagus {
namespace {

namespace fs = std::filesystem;

const fs::path kFolder = test::testdata("golden/plans");

std::vector<std::string> cases() {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(kFolder)) {
        const std::string name = entry.path().filename().string();
        constexpr std::string_view kSuffix = ".plan.json";
        if (name.ends_with(kSuffix)) {
            names.push_back(name.substr(0, name.size() - kSuffix.size()));
        }
    }
    std::sort(names.begin(), names.end());
    return names;
}

std::vector<std::string> lines_of(const fs::path& path) {
    std::vector<std::string> lines;
    std::ifstream file(path, std::ios::binary);
    for (std::string line; std::getline(file, line);) lines.push_back(line);
    return lines;
}

// The line with the value of `message` replaced by "...", after a look that it says something.
std::string without_message(const std::string& line) {
    const size_t at = line.rfind(",\"message\":\"");
    if (at == std::string::npos) return line;
    const bool error = line.find("\"kind\":\"error\"") != std::string::npos;
    const bool end = line.find("\"kind\":\"plan-end\"") != std::string::npos;
    if (!error && !end) return line;
    const std::string message = line.substr(at + 12, line.size() - at - 14);
    EXPECT_NE(message, "") << line;
    return line.substr(0, at) + ",\"message\":\"...\"}";
}

std::string json_line_value(const std::string& line, const std::string& key) {
    const auto json = read_json(line);
    const JsonValue* value = std::get<JsonValue>(json).find(key);
    return value ? value->text : std::string();
}

struct Arguments {
    run::RunOptions options;
    std::vector<std::string> sets;
};

Arguments arguments_of(const std::string& name) {
    Arguments arguments;
    const auto words = lines_of(kFolder / (name + ".args"));
    for (size_t i = 0; i + 1 < words.size(); i += 2) {
        if (words[i] == "--seed") arguments.options.seed = std::stoull(words[i + 1]);
        if (words[i] == "--set") arguments.sets.push_back(words[i + 1]);
        if (words[i] == "--max-time") {
            arguments.options.max_time = toolbox::duration_of(std::stod(words[i + 1]));
        }
    }
    return arguments;
}

std::pair<int, plan::Value> set_of(const plan::GraphPlan& plan, const std::string& text) {
    const size_t equals = text.find('=');
    for (size_t i = 0; i < plan.variables.size(); ++i) {
        if (plan.variables[i].name != text.substr(0, equals)) continue;
        const plan::Value value{text.substr(equals + 1)};
        return {static_cast<int>(i), plan::convert(value, plan.variables[i].type).value()};
    }
    ADD_FAILURE() << "no variable for --set " << text;
    return {};
}

struct Ran {
    std::vector<std::string> lines;
    int status = 0;
};

Ran run_case(const std::string& name, const plan::Checked& checked,
             const run::CodeLibrary& library) {
    const plan::Graph graph = plan::make_graph(checked);
    Arguments arguments = arguments_of(name);
    for (const std::string& text : arguments.sets) {
        arguments.options.set.push_back(set_of(graph.plans.front(), text));
    }
    Ran ran;
    arguments.options.on_trace = [&ran](const plan::TraceEvent& event) {
        ran.lines.push_back(without_message(plan::format_trace(event)));
    };
    ran.status = run::exit_status(run::VirtualTime(graph, library, arguments.options).run());
    return ran;
}

int expected_status(const std::string& name, const std::string& last_line) {
    const auto exit = lines_of(kFolder / (name + ".exit"));
    if (!exit.empty()) return std::stoi(exit.front());
    const std::string result = json_line_value(last_line, "result");
    return result == "OK" ? 0 : result == "Interrupted" ? 3 : 4;
}

void expect_digest(const Ran& ran, const fs::path& path) {
    const JsonValue digest = std::get<JsonValue>(read_json(read_file(path.string()).value()));
    std::string all;
    for (const std::string& line : ran.lines) all += line + "\n";
    EXPECT_EQ(static_cast<int64_t>(ran.lines.size()), digest.find("lines")->integer);
    EXPECT_EQ(sha256_hex(all), digest.find("sha256")->text);
}

using Found = std::tuple<std::string, std::string, std::string, int64_t>;

void expect_findings(const plan::Checked& checked, const fs::path& path) {
    const JsonValue json = std::get<JsonValue>(read_json(read_file(path.string()).value()));
    std::multiset<Found> wanted, found;
    for (const JsonValue& one : json.items) {
        wanted.emplace(one.find("severity")->text, one.find("rule")->text,
                       one.find("element")->text, one.find("line")->integer);
    }
    for (const plan::Finding& one : checked.findings) {
        const bool error = one.severity == plan::Severity::Error;
        found.emplace(error ? "error" : "warning", one.rule, one.element, one.line);
        EXPECT_NE(one.message, "");
    }
    EXPECT_EQ(found, wanted) << plan::format_findings_json(checked.findings);
}

class GoldenPlan : public testing::TestWithParam<std::string> {};

TEST_P(GoldenPlan, DoesWhatThePageSays) {
    const std::string& name = GetParam();
    run::CodeLibrary library;
    toolbox::add_core(library);
    const plan::Disk disk;
    const std::string file = (kFolder / (name + ".plan.json")).string();
    const plan::Checked checked = plan::check(file, disk, library.templates());
    const fs::path findings = kFolder / (name + ".check.json");
    if (fs::exists(findings)) {
        expect_findings(checked, findings);
        return;
    }
    ASSERT_TRUE(checked.ok()) << plan::format_findings_json(checked.findings);
    const Ran ran = run_case(name, checked, library);
    const fs::path digest = kFolder / (name + ".digest.json");
    if (fs::exists(digest)) {
        expect_digest(ran, digest);
        return;
    }
    const auto wanted = lines_of(kFolder / (name + ".trace.jsonl"));
    EXPECT_EQ(ran.lines, wanted);
    ASSERT_FALSE(wanted.empty());
    EXPECT_EQ(ran.status, expected_status(name, wanted.back()));
}

std::string test_name(const testing::TestParamInfo<std::string>& info) {
    std::string name = info.param;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}

INSTANTIATE_TEST_SUITE_P(All, GoldenPlan, testing::ValuesIn(cases()), test_name);

TEST(GoldenPlans, AreAllThere) {
    EXPECT_EQ(cases().size(), 62u);
}

}  // namespace
}  // namespace vagus
