// Plans tried by hand, for pages: the commands plan.try and plan.try.keep. Nothing of a try is kept
// here: a page asks with all that was chosen so far, and each question is answered by a process of
// its own.
//
//     TryDesk tries(desk, files, "/usr/bin/vagus", project);
//     tries.tick(now);
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "base/time.hpp"
#include "serve/json.hpp"
#include "serve/project/files.hpp"
#include "serve/studio/desk.hpp"
#include "serve/workbench/questions.hpp"

namespace vagus::serve {

constexpr size_t kTriesAtOnce = 4;    // processes; further questions are refused
constexpr Duration kTryWithin = 10s;  // then a question is not waited for any more
constexpr Duration kTryLookEvery = 5ms;
constexpr size_t kTryMemoryMax = size_t{1} << 30;

class TryDesk {
public:
    // Where files of the project are on this computer.
    struct Project {
        std::function<std::vector<std::string>()> toolboxes;  // their files
        std::function<std::string(const std::string& doc)> real;
        std::function<std::string(const std::string& file)> doc_of;
        // Writes a test beside a plan, and tells its path.
        std::function<Result<std::string>(const std::string& doc, const std::string& text)>
            new_test;
    };

    // Borrowed. Declares its commands.
    TryDesk(Desk& desk, Files& files, std::string program, Project project);

    void tick(Time now) { questions_.tick(now); }
    Time next_tick() const { return questions_.next_tick(); }

private:
    void ask(const Call& call, bool keep, Questions::Then then);
    Json texts_of(const std::string& doc);
    void keep(const Call& call, const std::string& test);
    Json shown(Json answer) const;

    Files& files_;
    const Project project_;
    Questions questions_;
};

}  // namespace vagus::serve
