#include "serve/workbench/try_desk.hpp"

#include <fmt/format.h>

#include <utility>

#include "serve/runner/try_host.hpp"

namespace vagus::serve {

namespace {

constexpr std::string_view kPlanEnding = ".plan.json";

}  // namespace

TryDesk::TryDesk(Desk& desk, Files& files, std::string program, Project project)
    : files_(files), program_(std::move(program)), project_(std::move(project)) {
    desk.command("plan.try", [this](const Call& call) {
        ask(call, false, [this, call](Json answer) { call.done(shown(std::move(answer))); });
    });
    desk.command("plan.try.keep", [this](const Call& call) {
        ask(call, true, [this, call](const Json& answer) { keep(call, answer["test"]); });
    });
}

void TryDesk::ask(const Call& call, bool keep, Then then) {
    const std::string doc = call.in["doc"];
    if (!doc.ends_with(kPlanEnding)) {
        return call.fail("bad_input", doc + " is no plan; name a file that ends with .plan.json");
    }
    if (const auto there = files_.open(doc); !there.ok()) return call.fail(there.error());
    if (asked_.size() >= kTriesAtOnce) {
        return call.fail("limit",
                         fmt::format("{} plans are being tried; wait for them", kTriesAtOnce));
    }
    auto child = Child::start({.program = program_,
                               .arguments = {"try-host"},
                               .name = "vagus",
                               .memory_max = kTryMemoryMax});
    if (!child.ok()) return call.fail(child.error());
    const Json question = {{"plan", project_.real(doc)},
                           {"texts", texts_of(doc)},
                           {"toolboxes", project_.toolboxes()},
                           {"way", call.in["way"]},
                           {"keep", keep}};
    child.value().pipe().send(kTryAsked, question.dump());
    asked_.push_back({call, std::move(child.value()), std::move(then), std::nullopt});
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

void TryDesk::tick(Time now) {
    now_ = now;
    std::erase_if(asked_, [&](Asked& one) { return look(one, now); });
}

Time TryDesk::next_tick() const {
    return asked_.empty() ? Time::max() : now_ + kTryLookEvery;
}

// True: it is answered, or waited for no longer.
bool TryDesk::look(Asked& asked, Time now) {
    if (!asked.until) asked.until = now + kTryWithin;
    Pipe& pipe = asked.child.pipe();
    pipe.flush();
    for (const Packet& packet : pipe.receive()) {
        Json answer = Json::parse(packet.bytes, nullptr, false);
        if (!answer.is_object()) {
            asked.call.fail("failed", "the answer cannot be read");
        } else if (answer.contains("error")) {
            asked.call.fail("bad_input", answer["error"].get<std::string>());
        } else {
            asked.then(std::move(answer));
        }
        return true;
    }
    if (const auto ended = asked.child.ended(); ended || pipe.closed()) {
        asked.call.fail("failed", "the plan cannot be tried: its process " +
                                      (ended ? ended->what : std::string("has gone")));
        return true;
    }
    if (now < *asked.until) return false;
    constexpr auto kSeconds = std::chrono::duration_cast<std::chrono::seconds>(kTryWithin).count();
    asked.call.fail("timeout", fmt::format("the plan computes for more than {} s and does not come "
                                           "to an actor that waits; look for a loop that takes no "
                                           "time (`vagus plan explore`)",
                                           kSeconds));
    return true;
}

}  // namespace vagus::serve
