#include "serve/workbench/compare_desk.hpp"

#include <fmt/format.h>

#include <utility>

#include "base/text.hpp"
#include "plan/differences.hpp"
#include "plan/file.hpp"
#include "serve/edit/text_places.hpp"
#include "serve/json.hpp"
#include "serve/workbench/git.hpp"

namespace vagus::serve {

namespace {

constexpr size_t kByMax = 100, kSubjectMax = 200;  // of the protocol

// A text or bytes as a plan: without a mark at its beginning.
std::string_view without_mark(std::string_view text) {
    constexpr std::string_view kMark = "\xEF\xBB\xBF";
    return text.starts_with(kMark) ? text.substr(kMark.size()) : text;
}

bool is_plan(const std::string& path) {
    return path.ends_with(".plan.json");
}

// What two texts differ in, as plan.differences answers it.
Result<Json> differences_of(std::string_view before, const std::string& name,
                            const DocumentView& now, const std::string& doc) {
    const JsonValue old_tree = TRY(plan::read_plan_tree(before, name));
    const JsonValue new_tree = TRY(plan::read_plan_tree(now.text, doc));
    const plan::Differences all = plan::differences(old_tree, new_tree);
    if (all.size() > kDifferencesToldMax) {
        return Error{Code::Limit,
                     fmt::format("{} and {} differ in {} places; more than {} are not shown: "
                                 "compare them with `vagus plan diff`",
                                 name, doc, all.size(), kDifferencesToldMax)};
    }
    const std::string saved = TRY(plan::format_plan(before, name));
    return Json{{"version", now.version},
                {"before", saved},
                {"differences", Json::parse(plan::format_json(all))}};
}

}  // namespace

CompareDesk::CompareDesk(Desk& desk, Files& files, Running running, Then then)
    : files_(files), running_(std::move(running)), then_(std::move(then)) {
    desk.command("plan.differences", [this](const Call& call) { differences(call); });
    desk.command("plan.versions", [this](const Call& call) { versions(call); });
}

void CompareDesk::differences(const Call& call) {
    const std::string doc = call.in["doc"];
    if (!is_plan(doc)) {
        return call.fail("bad_input", doc + " is no plan; name a file that ends with .plan.json");
    }
    // Also so that git is asked of nothing outside of the project.
    if (const auto there = files_.open(doc); !there.ok()) return call.fail(there.error());
    const std::string against = call.in["against"];
    if (against == "disk") return compare(call, on_disk(doc), doc + " on disk");
    if (against == "running") {
        const auto text = running_(doc);
        if (text) return compare(call, *text, doc + " as it runs");
        return call.fail("unavailable", "no plan runs that is made of " + doc + "; Run starts one");
    }
    if (against == "then") {
        const double t = call.in.value("t", 0.0);
        const auto text = then_(t, doc);
        if (text) return compare(call, *text, fmt::format("{} at {} s", doc, t));
        return call.fail("unavailable",
                         fmt::format("the plan that ran at {} s was not made of {}", t, doc));
    }
    if (against == "file") {
        const std::string file = call.in.value("file", "");
        if (is_plan(file)) return compare(call, files_.text(file), file);
        return call.fail("bad_input",
                         "in.file: expected the path of a .plan.json file, found \"" + file + "\"");
    }
    const std::string revision = call.in.value("revision", "");
    const std::string name = doc + " at " + revision;
    const auto then = [this, call, name](const Printing& git) {
        if (git.good()) return compare(call, git.text(), name);
        call.fail("not_found",
                  fmt::format("git does not have {}; choose a commit from its list", name));
    };
    ask_git(call, ask_git_for_text(files_.root().string(), doc, revision), then);
}

void CompareDesk::compare(const Call& call, const Result<std::string>& other,
                          const std::string& name) {
    if (!other.ok()) return call.fail(other.error());
    const std::string doc = call.in["doc"];
    const auto now = files_.open(doc);
    if (!now.ok()) return call.fail(now.error());
    const std::string_view before = without_mark(other.value());
    if (malformed_utf8_at(before)) {
        return call.fail("bad_input", name + " is no text in UTF-8; compare another version");
    }
    auto found = differences_of(before, name, now.value(), doc);
    if (!found.ok()) return call.fail(found.error());
    call.done(std::move(found.value()));
}

Result<std::string> CompareDesk::on_disk(const std::string& doc) {
    if (files_.has_conflict(doc)) return files_.disk_text(doc);
    return files_.bytes(doc);
}

// ---- git ----

void CompareDesk::versions(const Call& call) {
    const std::string doc = call.in["doc"];
    if (const auto there = files_.open(doc); !there.ok()) return call.fail(there.error());
    const auto then = [call](const Printing& git) {
        Json versions = Json::array();
        // Also where there is no repository, and no git.
        if (!git.good()) return call.done({{"versions", std::move(versions)}});
        for (const GitVersion& one : git_versions(git.text())) {
            versions.push_back({{"revision", one.revision},
                                {"when_wall", one.when_wall},
                                {"by", line_of(one.by, kByMax)},
                                {"subject", line_of(one.subject, kSubjectMax)}});
        }
        call.done({{"versions", std::move(versions)}});
    };
    ask_git(call, ask_git_for_versions(files_.root().string(), doc), then);
}

void CompareDesk::ask_git(const Call& call, Result<Printing> git,
                          std::function<void(const Printing& git)> then) {
    if (!git.ok()) return call.fail(git.error());
    if (asked_.size() >= kGitsAtOnce) {
        return call.fail("limit",
                         fmt::format("git is answering {} questions; wait for them", kGitsAtOnce));
    }
    asked_.push_back({call, std::move(git.value()), std::move(then), std::nullopt});
}

void CompareDesk::tick(Time now) {
    now_ = now;
    std::erase_if(asked_, [&](Asked& one) { return look(one, now); });
}

Time CompareDesk::next_tick() const {
    return asked_.empty() ? Time::max() : now_ + kGitLookEvery;
}

// True: it is answered, or waited for no longer.
bool CompareDesk::look(Asked& asked, Time now) {
    if (!asked.until) asked.until = now + kGitWithin;
    if (asked.git.read()) {
        asked.then(asked.git);
        return true;
    }
    if (asked.git.is_full()) {
        asked.call.fail("limit", fmt::format("git prints more than {} bytes; compare the files "
                                             "with `vagus plan diff`",
                                             kGitTextMax));
        return true;
    }
    if (now < *asked.until) return false;
    asked.call.fail("timeout",
                    fmt::format("git has not answered for {} s", seconds_of(kGitWithin)));
    return true;
}

}  // namespace vagus::serve
