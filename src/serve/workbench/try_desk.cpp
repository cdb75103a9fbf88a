#include "serve/workbench/try_desk.hpp"

#include <fmt/format.h>

#include <utility>

#include "serve/runner/try_host.hpp"

namespace vagus::serve {

TryDesk::TryDesk(Desk& desk, Files& files, std::string program, Project project)
    : files_(files),
      project_(std::move(project)),
      questions_({.program = std::move(program),
                  .verb = "try-host",
                  .kind = kTryAsked,
                  .memory_max = kTryMemoryMax,
                  .within = kTryWithin,
                  .look_every = kTryLookEvery,
                  .refused = "bad_input",
                  .died = "the plan cannot be tried",
                  .late = fmt::format("the plan computes for more than {} s and does not come to "
                                      "an actor that waits; look for a loop that takes no time "
                                      "(`vagus plan explore`)",
                                      seconds_of(kTryWithin))}) {
    desk.command("plan.try", [this](const Call& call) {
        ask(call, false, [this, call](Json answer) { call.done(shown(std::move(answer))); });
    });
    desk.command("plan.try.keep", [this](const Call& call) {
        ask(call, true, [this, call](const Json& answer) { keep(call, answer["test"]); });
    });
}

void TryDesk::ask(const Call& call, bool keep, Questions::Then then) {
    const std::string doc = call.in["doc"];
    if (kind_of_file(doc) != "plan") {
        return call.fail("bad_input", doc + " is no plan; name a file that ends with .plan.json");
    }
    if (const auto there = files_.open(doc); !there.ok()) return call.fail(there.error());
    if (questions_.count() >= kTriesAtOnce) {
        return call.fail("limit",
                         fmt::format("{} plans are being tried; wait for them", kTriesAtOnce));
    }
    const Json question = {{"plan", project_.real(doc)},
                           {"texts", texts_of(doc)},
                           {"toolboxes", project_.toolboxes()},
                           {"way", call.in["way"]},
                           {"keep", keep}};
    questions_.ask(call, question, std::move(then));
}

// Plans as they are edited; what is saved the process reads itself.
Json TryDesk::texts_of(const std::string& doc) {
    Json texts = Json::object();
    const auto add = [&](const std::string& path) {
        const auto text = files_.text(path);
        if (text.ok()) texts[project_.real(path)] = text.value();
    };
    add(doc);
    bool more = false;
    for (const FileInfo& file : files_.list(more)) {
        if (file.kind == "plan" && file.unsaved && file.path != doc) add(file.path);
    }
    return texts;
}

void TryDesk::keep(const Call& call, const std::string& test) {
    const auto path = project_.new_test(call.in["doc"], test);
    path.ok() ? call.done({{"path", path.value()}}) : call.fail(path.error());
}

// With the documents of the project in place of files.
Json TryDesk::shown(Json answer) const {
    Json& plan = answer["plan"];
    if (plan.contains("doc")) plan["doc"] = project_.doc_of(plan["doc"]);
    for (Json& level : plan["levels"]) level["doc"] = project_.doc_of(level["doc"]);
    return answer;
}

}  // namespace vagus::serve
