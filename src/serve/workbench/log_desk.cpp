#include "serve/workbench/log_desk.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "serve/runner/log_host.hpp"

namespace vagus::serve {

LogDesk::LogDesk(Desk& desk, Scripts& scripts, std::string program, ShownRun run)
    : scripts_(scripts),
      questions_({.program = std::move(program),
                  .verb = "log-host",
                  .kind = kLogAsked,
                  .memory_max = kLogMemoryMax,
                  .within = kLogWithin,
                  .look_every = kLogLookEvery,
                  .refused = "bad_input",
                  .died = "the run could not be run again",
                  .late = fmt::format("to run this run again takes longer than {} s; use `vagus "
                                      "replay FILE --log` in a terminal",
                                      seconds_of(kLogWithin))},
                 kLogsAtOnce, std::move(run)) {
    desk.command("log.ask", [this](const Call& call) { ask(call); });
    desk.command("log.cancel", [this](const Call& call) {
        questions_.cancel([&call](const Call& asked) {
            return asked.member == call.member && asked.in["number"] == call.in["number"];
        });
        call.done();
    });
}

void LogDesk::ask(const Call& call) {
    auto question = place_of(call.in);
    if (!question.ok()) return call.fail(question.error());
    question.value()["values"] = call.in["values"];
    questions_.ask(call, std::move(question.value()),
                   [call](Json answer) { call.done(std::move(answer)); });
}

Result<Json> LogDesk::place_of(const Json& in) const {
    const std::string doc = in["doc"];
    if (in.contains("line")) return line_of_script(doc, in["line"]);
    if (in.contains("element") && in.contains("when")) {
        return Json{{"plan", doc}, {"element", in["element"]}, {"when", in["when"]}};
    }
    return Error{
        Code::BadInput,
        "in: expected a line of a script, or an element of a plan and when; found neither"};
}

// The recording counts lines of files and knows nodes by their names.
Result<Json> LogDesk::line_of_script(const std::string& doc, int line) const {
    const auto& parts = scripts_.parts();
    const auto part = std::find_if(parts.begin(), parts.end(),
                                   [&](const ScriptPart& one) { return one.doc == doc; });
    if (part == parts.end() || part->node.empty()) {
        return Error{Code::NotFound, doc + ": there is no script of a node in this document"};
    }
    int before = 0;
    for (const Scripts::LinesOf& lines : scripts_.lines_in(part->file)) {
        if (lines.doc == doc) before = lines.first - 1;
    }
    return Json{{"node", part->node},
                {"line", before + line},
                {"script", part->file.substr(part->file.rfind('/') + 1)}};
}

}  // namespace vagus::serve
