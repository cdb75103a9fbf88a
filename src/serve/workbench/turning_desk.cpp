#include "serve/workbench/turning_desk.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <utility>

#include "serve/edit/text_places.hpp"
#include "serve/workbench/turning_talk.hpp"
#include "trial/turning.hpp"

namespace vagus::serve {

namespace {

namespace fs = std::filesystem;

constexpr const char* kTurningResults = ".vagus/turning-point";  // of the last answer
constexpr const char* kUnreadable = "what was found cannot be read; ask again";
constexpr size_t kTurningWhyMax = 2000, kSentenceMax = 400;
constexpr const char* kTurningStates[] = {"none", "running", "done", "stopped", "failed"};

}  // namespace

TurningDesk::TurningDesk(Desk& desk, Files& files, StartRunProcess start, ShownRun run,
                         Project project)
    : desk_(desk),
      files_(files),
      start_(std::move(start)),
      shown_(std::move(run)),
      project_(std::move(project)) {
    desk.command("turning.ask", [this](const Call& call) { ask(call); });
    desk.command("turning.stop", [this](const Call& call) { stop(call); });
    desk.topics().document("turning", [this](const Json&) { return document(); });
}

// ---- what is asked ----

void TurningDesk::ask(const Call& call) {
    if (!files_.is_open()) return call.fail("unavailable", "no project is open; open one first");
    if (state_ == State::Running) {
        return call.fail("unavailable",
                         "a turning point is being looked for; wait for it, or stop that");
    }
    const auto file = shown_.file();
    if (!file.ok()) return call.fail(file.error());
    state_ = State::Running;
    run_ = project_.run();
    condition_ = call.in["condition"];
    tries_ = call.in.value("tries", trial::kTriesUsual);
    why_.clear();
    progress_ = {{"stage", kTurningStages[0]}, {"done", 0}, {"of", 0}};
    result_ = nullptr;
    desk_.topics().touch("turning");
    call.done();
    shown_.flush([this, number = ++asked_, path = file.value()] {
        if (number == asked_ && state_ == State::Running) begin(path);
    });
}

void TurningDesk::begin(const std::string& file) {
    auto process = start_();
    if (!process.ok()) return end(State::Failed, process.error().what);
    process_.begin(std::move(process.value()));
    const std::string results = (files_.root() / kTurningResults).string();
    std::error_code failed;
    fs::remove_all(results, failed);
    process_.ask(kTurningAsked,
                 format_turning_asked(
                     {.file = file, .condition = condition_, .tries = tries_, .results = results}));
}

void TurningDesk::stop(const Call& call) {
    if (state_ == State::Running) end(State::Stopped);
    call.done();
}

void TurningDesk::forget() {
    result_ = nullptr;
    end(State::None);
}

void TurningDesk::end(State how, std::string why) {
    process_.end();
    state_ = how;
    why_ = std::move(why);
    desk_.topics().touch("turning");
}

// ---- what is told ----

void TurningDesk::tick(Time now) {
    now_ = now;
    if (state_ != State::Running || !process_.is_there()) return;
    process_.tick(now, [this](const Packet& packet) { hear(packet); });
    if (!process_.is_there()) return;
    if (const std::string how = process_.gone(); !how.empty()) {
        return end(State::Failed, "the process that looked for it " + how + "; ask again");
    }
    if (process_.silent() < kTurningSilentMax) return;
    end(State::Failed, fmt::format("no continuation of the run has ended for {} s; `vagus why "
                                   "--turning-point` in a terminal waits for it",
                                   seconds_of(kTurningSilentMax)));
}

Time TurningDesk::next_tick() const {
    return state_ == State::Running ? now_ + kTurningLookEvery : Time::max();
}

void TurningDesk::hear(const Packet& packet) {
    Json told = Json::parse(packet.bytes, nullptr, false);
    if (!told.is_object()) return end(State::Failed, kUnreadable);
    if (packet.kind == kTurningAnswered) return answer(told);
    progress_ = std::move(told);
    desk_.topics().touch("turning");
}

void TurningDesk::answer(const Json& answer) {
    if (answer.contains("error")) return end(State::Failed, answer["error"].get<std::string>());
    if (!answer.contains("found")) return end(State::Failed, kUnreadable);
    result_ = result_of(answer);
    end(State::Done);
}

Json TurningDesk::result_of(const Json& answer) const {
    const Json& found = answer["found"];
    Json result = {{"sentence", line_of(answer["sentence"].get<std::string>(), kSentenceMax)},
                   {"end", found["end"]},
                   {"continuations", found["continuations"]},
                   {"curve", found["curve"]}};
    if (!found["came"].is_null()) result["came"] = found["came"];
    if (!found["turn"].is_null()) result["turn"] = turn_of(found["turn"]);
    return result;
}

Json TurningDesk::turn_of(const Json& turn) const {
    Json shown = {{"before", turn["before"]},
                  {"after", turn["after"]},
                  {"narrowed", turn["narrowed"]},
                  {"there", project_.chain_of(turn["there"])}};
    for (const char* which : {"with", "without"}) {
        if (turn[which].is_null()) continue;
        const fs::path file = turn[which]["file"].get<std::string>();
        shown[which] = file.lexically_relative(files_.root()).generic_string();
    }
    return shown;
}

bool TurningDesk::has_recording(const std::string& path) const {
    if (path.empty() || !result_.is_object() || !result_.contains("turn")) return false;
    const Json& turn = result_["turn"];
    return turn.value("with", "") == path || turn.value("without", "") == path;
}

Json TurningDesk::document() const {
    Json json = {{"state", kTurningStates[static_cast<size_t>(state_)]}};
    if (state_ == State::None) return json;
    json["run"] = run_;
    json["condition"] = condition_;
    json["tries"] = tries_;
    if (state_ == State::Running) json["progress"] = progress_;
    if (!why_.empty()) json["why"] = line_of(project_.shorten(why_), kTurningWhyMax);
    if (!result_.is_null()) json["result"] = result_;
    return json;
}

}  // namespace vagus::serve
