// Two versions of a plan compared, for pages: the commands plan.differences and plan.versions. The
// one is always the document as it is edited; the other is on disk, runs, ran at an instant, is in
// git, or is another file.
//
//     const auto running = [&](const std::string& doc) { return run_.plan_text(doc); };
//     const auto then = [&](double t, const std::string& doc) { return past_.plan_text(t, doc); };
//     CompareDesk compares(desk, files, running, then);
//     compares.tick(now);
#pragma once

#include <functional>
#include <list>
#include <optional>
#include <string>

#include "base/result.hpp"
#include "base/time.hpp"
#include "serve/process.hpp"
#include "serve/project/files.hpp"
#include "serve/studio/desk.hpp"

namespace vagus::serve {

constexpr size_t kGitsAtOnce = 4;     // processes; further questions are refused
constexpr Duration kGitWithin = 10s;  // then git is not waited for any more
constexpr Duration kGitLookEvery = 10ms;
constexpr size_t kDifferencesToldMax = 20'000;

class CompareDesk {
public:
    // What a document says in the plan that runs; nothing: it does not run.
    using Running = std::function<std::optional<std::string>(const std::string& doc)>;
    // What it said in the plan that ran at an instant, s.
    using Then = std::function<std::optional<std::string>(double t, const std::string& doc)>;

    // Borrowed. Declares its commands.
    CompareDesk(Desk& desk, Files& files, Running running, Then then);

    void tick(Time now);
    Time next_tick() const;

private:
    struct Asked {
        Call call;
        Printing git;
        std::function<void(const Printing& git)> then;
        std::optional<Time> until;  // set by the first tick
    };

    void differences(const Call& call);
    void versions(const Call& call);
    void compare(const Call& call, const Result<std::string>& other, const std::string& name);
    Result<std::string> on_disk(const std::string& doc);
    void ask_git(const Call& call, Result<Printing> git,
                 std::function<void(const Printing& git)> then);
    bool look(Asked& asked, Time now);

    Files& files_;
    const Running running_;
    const Then then_;
    std::list<Asked> asked_;
    Time now_{};
};

}  // namespace vagus::serve
