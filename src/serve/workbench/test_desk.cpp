#include "serve/workbench/test_desk.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <utility>

#include "serve/edit/text_places.hpp"
#include "serve/workbench/test_talk.hpp"

namespace vagus::serve {

namespace {

namespace fs = std::filesystem;

constexpr const char* kResults = ".vagus/test-results";  // of the last run
constexpr size_t kWhyMax = 2000, kExpectedMax = 1000, kHelpMax = 500;

bool is_test(const std::string& path) {
    return path.ends_with(trial::kTestEnding);
}

constexpr const char* kStates[] = {"none", "running", "done", "stopped", "failed"};

template <typename Map>
Json share_of(std::string_view name, const Map& map) {
    const auto taken = std::ranges::count_if(map, [](const auto& one) { return one.second > 0; });
    return {{"name", name}, {"taken", taken}, {"of", map.size()}};
}

Json ways_of(const trial::ScriptCoverage& script) {
    size_t taken = 0;
    for (const auto& [branch, counts] : script.branches) {
        for (const uint64_t count : counts) taken += count > 0 ? 1 : 0;
    }
    return {{"name", "branches"}, {"taken", taken}, {"of", script.branches.size() * 2}};
}

// Of the lines from `first` to `last` of a file those that are code, counted from the first.
Json lines_of(const trial::ScriptCoverage& script, int first, int last) {
    Json lines = Json::array();
    const auto end = script.lines.upper_bound(last);
    for (auto line = script.lines.lower_bound(first); line != end; ++line) {
        Json one = {{"line", line->first - first + 1}, {"count", line->second}};
        size_t ways = 0, taken = 0;
        auto way = script.branches.lower_bound({line->first, 0});
        for (; way != script.branches.end() && way->first.first == line->first; ++way) {
            ways += way->second.size();
            taken += static_cast<size_t>(
                std::ranges::count_if(way->second, [](uint64_t count) { return count > 0; }));
        }
        if (ways > 0) one.update({{"ways", ways}, {"taken", taken}});
        lines.push_back(std::move(one));
    }
    return lines;
}

}  // namespace

TestDesk::TestDesk(Desk& desk, Files& files, Scripts& scripts, StartRunProcess start,
                   Project project)
    : desk_(desk),
      files_(files),
      scripts_(scripts),
      start_(std::move(start)),
      project_(std::move(project)) {
    desk.command("tests.run", [this](const Call& call) { run(call); });
    desk.command("tests.stop", [this](const Call& call) { stop(call); });
    desk.topics().document("tests", [this](const Json&) { return document(); });
    desk.topics().document("coverage", [this](const Json& of) { return coverage_of(of["doc"]); });
}

// ---- what is asked ----

void TestDesk::run(const Call& call) {
    if (!files_.is_open()) return call.fail("unavailable", "no project is open; open one first");
    if (state_ == State::Running) {
        return call.fail("unavailable",
                         "tests of this project are running; wait for them, or stop them");
    }
    if (!project_.save_all(call)) return;
    const auto paths = paths_of(call);
    if (!paths.ok()) return call.fail(paths.error());
    call.answer(begin(paths.value(), call.in.value("scripts", false)));
}

Result<std::vector<std::string>> TestDesk::paths_of(const Call& call) const {
    std::vector<std::string> paths;
    if (call.in.contains("tests")) {
        for (const Json& one : call.in["tests"]) paths.push_back(one);
    } else {
        bool more = false;
        for (const FileInfo& file : files_.list(more)) {
            if (file.kind != "folder" && is_test(file.path)) paths.push_back(file.path);
        }
    }
    for (const std::string& path : paths) {
        if (!is_test(path)) {
            return Error{Code::BadInput, path + ": expected a test, NAME.test.json"};
        }
        if (!files_.exists(path)) return Error{Code::NotFound, path + ": there is no such file"};
    }
    if (paths.empty()) {
        return Error{Code::NotFound,
                     "the project has no test, no file NAME.test.json; \"Keep the run as a test\" "
                     "in the timeline writes one"};
    }
    if (paths.size() <= kTestsRunMax) return paths;
    return Error{
        Code::Limit,
        fmt::format("the project has {} tests, of which at most {} are run at once; `vagus "
                    "test` in a terminal runs them all",
                    paths.size(), kTestsRunMax)};
}

std::string TestDesk::real(const std::string& path) const {
    return (files_.root() / path).string();
}

Status TestDesk::begin(const std::vector<std::string>& paths, bool scripts) {
    std::error_code failed;
    fs::remove_all(real(kResults), failed);
    trial::TestOrder order{.tests = {}, .results = real(kResults), .scripts = scripts};
    for (const std::string& path : paths) order.tests.push_back(real(path));
    process_.begin(TRY(start_()));
    process_.ask(kTestsOrdered, trial::format_order(order));
    state_ = State::Running;
    why_.clear();
    counts_scripts_ = scripts;
    tests_.clear();
    for (const std::string& path : paths) tests_.push_back({.path = path});
    coverage_ = {};
    changed_.clear();
    began_with_.clear();
    bool more = false;
    for (const FileInfo& file : files_.list(more)) began_with_[file.path] = stamp_of(file.path);
    told_ = 0;
    touch();
    return Status::done();
}

void TestDesk::stop(const Call& call) {
    if (state_ == State::Running) end(State::Stopped);
    call.done();
}

void TestDesk::forget() {
    end(State::None);
    tests_.clear();
    coverage_ = {};
    changed_.clear();
    touch();
}

// What was told until then stays.
void TestDesk::end(State how, std::string why) {
    process_.end();
    state_ = how;
    why_ = std::move(why);
    touch();
}

// A file that was made or saved just before they began is told of again when the folder is listed.
void TestDesk::text_changed(const std::string& path) {
    if (state_ == State::None) return;
    const auto before = began_with_.find(path);
    const bool same = stamp_of(path) == (before == began_with_.end() ? Stamp{} : before->second);
    if (same && !files_.is_unsaved(path)) return;
    if (changed_.insert(path).second) touch();
}

TestDesk::Stamp TestDesk::stamp_of(const std::string& path) const {
    Stamp stamp;
    std::error_code failed;
    const fs::path file = real(path);
    stamp.exists = fs::exists(file, failed);
    // That of a folder changes with what others put into it.
    if (!stamp.exists || fs::is_directory(file, failed)) return stamp;
    stamp.written = fs::last_write_time(file, failed);
    stamp.size = fs::file_size(file, failed);
    return stamp;
}

bool TestDesk::has_recording(const std::string& path) const {
    return std::ranges::any_of(tests_, [&](const Test& test) {
        return std::ranges::find(test.failures, path, &Failed::recording) != test.failures.end();
    });
}

// ---- what is told ----

void TestDesk::tick(Time now) {
    now_ = now;
    if (state_ != State::Running) return;
    process_.tick(now, [this](const Packet& packet) { hear(packet); });
    if (std::ranges::all_of(tests_, &Test::is_over)) return end(State::Done);
    if (const std::string how = process_.gone(); !how.empty()) {
        return end(State::Failed, "the process that ran them " + how + "; run them again");
    }
    if (process_.silent() >= kTestsSilentMax) end(State::Failed, why_silent());
}

Time TestDesk::next_tick() const {
    return state_ == State::Running ? now_ + kTestsLookEvery : Time::max();
}

std::string TestDesk::why_silent() const {
    const auto waits = std::ranges::find_if_not(tests_, &Test::is_over);
    return fmt::format(
        "no run of {} has ended for {} s: it hangs, or takes longer; `vagus test` "
        "in a terminal waits for it",
        waits == tests_.end() ? "a test" : waits->path, seconds_of(kTestsSilentMax));
}

void TestDesk::hear(const Packet& packet) {
    if (packet.kind == kTestsPlanned) return planned(trial::read_planned(packet.bytes));
    if (packet.kind == kSeedTold) take(trial::read_seed(packet.bytes));
}

void TestDesk::planned(const std::vector<trial::PlannedTest>& tests) {
    for (size_t i = 0; i < std::min(tests.size(), tests_.size()); ++i) {
        tests_[i].refused = tests[i].refused;
        tests_[i].world = tests[i].world;
        if (!tests[i].refused.empty()) continue;
        tests_[i].runs = tests[i].seeds.last - tests[i].seeds.first + 1;
    }
    touch();
}

void TestDesk::take(trial::SeedTold told) {
    if (told.test >= tests_.size()) return;
    Test& test = tests_[told.test];
    if (!told.refused.empty()) {
        test.refused = told.refused;
    } else {
        ++test.done;
        if (!told.as_expected()) add_failures(test, told);
        add_coverage(told.coverage);
    }
    touch();
}

void TestDesk::add_failures(Test& test, trial::SeedTold& told) {
    ++test.failed;
    if (!told.trouble.empty()) told.failures.resize(1);
    // One without a world cannot be opened.
    const std::string recording =
        test.world && !told.recording.empty()
            ? fs::path(told.recording).lexically_relative(files_.root()).generic_string()
            : "";
    for (trial::Failure& one : told.failures) {
        if (test.failures.size() >= kFailuresToldMax || told_ >= kFailuresOfRunMax) return;
        ++told_;
        // Seeds end in any order; all that failed of one come together.
        const auto behind = std::ranges::upper_bound(test.failures, told.seed, {}, &Failed::seed);
        test.failures.insert(behind, {told.seed, std::move(one), told.trouble, recording});
    }
}

void TestDesk::add_coverage(trial::Coverage& told) {
    const auto doc_of = [this](const std::string& file) {
        return project_.doc_of(fs::path(file).lexically_normal().string());
    };
    trial::Coverage by_doc;
    for (auto& [file, one] : told.plans) by_doc.plans[doc_of(file)] = std::move(one);
    for (auto& [file, one] : told.scripts) by_doc.scripts[doc_of(file)] = std::move(one);
    coverage_.add(by_doc);
}

// ---- documents ----

void TestDesk::touch() {
    desk_.topics().touch("tests");
    desk_.topics().touch("coverage");
}

Json TestDesk::document() const {
    uint64_t runs = 0, done = 0, failed = 0;
    Json tests = Json::array();
    for (const Test& one : tests_) {
        runs += one.runs;
        done += one.done;
        failed += one.failed;
        tests.push_back(document_of(one));
    }
    Json json = {{"state", kStates[static_cast<size_t>(state_)]},
                 {"runs", runs},
                 {"done", done},
                 {"failed", failed},
                 {"scripts", counts_scripts_},
                 {"tests", std::move(tests)},
                 {"coverage", coverage_table()},
                 {"changed", Json::array()}};
    for (const std::string& one : changed_) json["changed"].push_back(one);
    if (!why_.empty()) json["why"] = line_of(why_, kWhyMax);
    return json;
}

Json TestDesk::document_of(const Test& test) const {
    Json json = {{"path", test.path},
                 {"runs", test.runs},
                 {"done", test.done},
                 {"failed", test.failed},
                 {"failures", Json::array()}};
    for (const Failed& one : test.failures) json["failures"].push_back(document_of(one));
    if (test.refused.empty()) return json;
    json["why"] = line_of(project_.shorten(test.refused), kWhyMax);
    json["at"] = place_in(test);
    return json;
}

// Of the mistake in it: "FILE:LINE:COLUMN: …"; its beginning if it is in another file.
Json TestDesk::place_in(const Test& test) const {
    unsigned line = 1, column = 1;
    const std::string file = real(test.path) + ":";
    if (test.refused.starts_with(file)) {
        (void)sscanf(test.refused.c_str() + file.size(), "%9u:%9u", &line, &column);
    }
    return {{"line", std::max(line, 1u)}, {"column", std::max(column, 1u)}};
}

Json TestDesk::document_of(const Failed& failed) const {
    Json json = {{"seed", failed.seed}};
    if (!failed.recording.empty()) json["recording"] = failed.recording;
    if (!failed.trouble.empty()) {
        json["what"] = line_of(project_.shorten(failed.trouble), kWhyMax);
        return json;
    }
    const trial::Failure& one = failed.failure;
    json["t"] = one.t;
    json["at"] = {{"line", one.at.line}, {"column", one.at.column}};
    json["expected"] = line_of(one.expected, kExpectedMax);
    json["what"] = line_of(one.what, kWhyMax);
    if (!one.help.empty()) json["help"] = line_of(one.help, kHelpMax);
    return json;
}

Json TestDesk::coverage_table() const {
    Json table = Json::array();
    for (const auto& [doc, plan] : coverage_.plans) {
        Json kinds = Json::array();
        for (const trial::CoverageKind& kind : trial::coverage_kinds()) {
            kinds.push_back(share_of(kind.name, plan.*kind.counts));
        }
        table.push_back({{"path", doc}, {"kinds", std::move(kinds)}});
    }
    for (const auto& [doc, script] : coverage_.scripts) {
        table.push_back(
            {{"path", doc},
             {"kinds", Json::array({share_of("lines", script.lines), ways_of(script)})}});
    }
    return table;
}

Json TestDesk::coverage_of(const std::string& doc) {
    const std::string file = doc.substr(0, doc.find('#'));
    Json json = {{"changed", changed_.contains(file)}};
    if (const auto plan = coverage_.plans.find(doc); plan != coverage_.plans.end()) {
        for (const trial::CoverageKind& kind : trial::coverage_kinds()) {
            json["plan"][kind.name] = plan->second.*kind.counts;
        }
    }
    const auto script = coverage_.scripts.find(file);
    if (script == coverage_.scripts.end()) return json;
    const auto parts = scripts_.lines_in(file);
    const auto part = std::ranges::find(parts, doc, &Scripts::LinesOf::doc);
    if (part != parts.end()) json["lines"] = lines_of(script->second, part->first, part->last);
    return json;
}

}  // namespace vagus::serve
