// For tests of desks that ask a process of its own: the other end is a script of the shell.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "serve/edit/test_page.hpp"
#include "serve/workbench/run_questions.hpp"

namespace vagus::serve {

class OtherEndTest : public EditTest {
protected:
    // Its path.
    std::string other_end(const std::string& script) {
        write("other-end", "#!/bin/sh\n" + script);
        const auto path = root / "other-end";
        std::filesystem::permissions(path, std::filesystem::perms::owner_all);
        return path.string();
    }
    void tell(const std::string& command, const Json& in) {
        desk.hear(ClientText{{1}, Json{{"id", ++id}, {"do", command}, {"in", in}}.dump()}, now);
    }
    // The sentence of a refusal of what was told last.
    std::string refused(const std::function<void(Time now)>& tick) {
        const Json* answer = nullptr;
        while (!(answer = answered())) tick(now);
        return answer->contains("error") ? answer->at("error").at("what").get<std::string>()
                                         : answer->dump();
    }
    // It is recorded in run-1.mcap, and writes at once unless `holds`.
    ShownRun shown_run(bool has_run = true) {
        return {.file = [has_run]() -> Result<std::string> {
                    if (has_run) return std::string("run-1.mcap");
                    return Error{Code::Unavailable, "nothing has run yet"};
                },
                .flush =
                    [this](std::function<void()> done) {
                        holds ? held.push_back(std::move(done)) : done();
                    }};
    }

    bool holds = false;
    std::vector<std::function<void()>> held;
};

}  // namespace vagus::serve
