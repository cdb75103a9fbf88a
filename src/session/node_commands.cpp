#include "session/node_commands.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/text.hpp"

namespace vagus::session {

std::vector<debug::NodeId> NodeCommands::nodes() const {
    std::vector<debug::NodeId> ids;
    for (const NodeState& node : session_.nodes()) ids.push_back(node.id);
    return ids;
}

// Of those with a script.
std::vector<debug::NodeId> NodeCommands::with_state(debug::ProgramState state) const {
    std::vector<debug::NodeId> ids;
    for (const NodeState& node : session_.nodes()) {
        if (node.has_script && node.state == state) ids.push_back(node.id);
    }
    return ids;
}

// ---- stop ----

// A node that is away is no node that is at rest: it counts as silent.
void NodeCommands::begin(const SafeStop& safe, Stopping::How how) {
    safe_ = safe;
    stopping_.begin(session_.network(), safe_,
                    {.how = how, .until = Stopping::Until::Forgotten, .link = false},
                    session_.clock(), nodes());
}

void NodeCommands::stop(const SafeStop& safe, Stopped done) {
    session_.hold_scripts();
    paused_ = false;
    stopped_ = true;
    begin(safe, Stopping::How::Stop);
    stops_.push_back({std::move(done), session_.clock() + kStopReportWithin});
}

void NodeCommands::answer_stops(bool anyway) {
    if (stops_.empty()) return;
    const bool all = anyway || stopping_.settled();
    std::vector<Stopped> due;
    std::erase_if(stops_, [&](WaitsForStop& one) {
        if (!all && session_.clock() < one.until) return false;
        due.push_back(std::move(one.done));
        return true;
    });
    if (due.empty()) return;
    const std::vector<StopNode> report = stopping_.report();
    for (const Stopped& done : due) done(report);
}

// ---- start ----

void NodeCommands::start(Done done) {
    if (paused_) return go_on(std::move(done));
    answer_stops(true);
    stopping_.end();
    const bool all = std::exchange(stopped_, false);
    session_.run_scripts(all ? SimSession::Again::All : SimSession::Again::WhatDoesNotRun);
    starts_.push_back({std::move(done), session_.clock() + kStartReportWithin});
}

void NodeCommands::answer_starts(const std::string& anyway) {
    if (starts_.empty()) return;
    std::vector<Done> due;
    const bool all = !anyway.empty() || session_.settled();
    std::erase_if(starts_, [&](WaitsForStart& one) {
        if (!all && session_.clock() < one.until) return false;
        due.push_back(std::move(one.done));
        return true;
    });
    if (due.empty()) return;
    const std::string why = anyway.empty() ? why_not_started() : anyway;
    for (const Done& done : due) done(why);
}

std::string NodeCommands::why_not_started() const {
    const std::vector<Diagnostic> mistakes = session_.mistakes();
    if (!mistakes.empty()) return text_of(mistakes.front());
    const std::vector<std::string> missing = session_.without_script();
    if (missing.empty()) return "";
    return "nothing started on " + list_of({missing.begin(), missing.end()}) +
           ": a node that is away, or was told to stop meanwhile, gets no script";
}

// ---- pause and continue ----

void NodeCommands::pause(const SafeStop& safe, Done done) {
    Batch batch{.open = {}, .why = {}, .done = std::move(done)};
    for (const debug::NodeId node : with_state(debug::ProgramState::Running)) {
        if (const auto asked = session_.network().pause_now(node)) batch.open.push_back(*asked);
    }
    if (batch.open.empty()) return batch.done("nothing runs");
    paused_ = true;
    // Behind the pause: a script that runs would write over it.
    begin(safe, Stopping::How::Rest);
    wait_for(std::move(batch));
}

void NodeCommands::go_on(Done done) {
    if (!std::exchange(paused_, false)) return done("it is not paused");
    stopping_.end();
    Batch batch{.open = {}, .why = {}, .done = std::move(done)};
    for (const NodeState& node : session_.nodes()) {
        if (!node.has_script || node.state == debug::ProgramState::Running) continue;
        const auto asked = session_.network().run(node.id);
        if (asked.ok()) {
            batch.open.push_back(asked.value());
        } else {
            batch.why = asked.error().what;
        }
    }
    wait_for(std::move(batch));
}

// ---- variables ----

void NodeCommands::set(const std::string& node, const std::string& name,
                       const std::vector<int16_t>& values, Done done) {
    debug::Network& network = session_.network();
    const auto id = network.find(node);
    if (!id.ok()) return done(id.error().what);
    const auto range = network.variable(id.value(), name);
    if (!range.ok()) return done(range.error().what);
    if (values.size() != range.value().count) {
        return done(fmt::format("{} has {} words; found {} values", name, range.value().count,
                                values.size()));
    }
    const auto asked = network.set(id.value(), range.value(), values);
    if (!asked.ok()) return done(asked.error().what);
    wait_for({.open = {asked.value()}, .why = {}, .done = std::move(done)});
}

// ---- what the bus says ----

void NodeCommands::wait_for(Batch batch) {
    if (batch.open.empty()) return batch.done(batch.why);
    batches_.push_back(std::move(batch));
}

void NodeCommands::finish(const debug::RequestDone& done) {
    const auto batch = std::ranges::find_if(batches_, [&](const Batch& one) {
        return std::ranges::find(one.open, done.request) != one.open.end();
    });
    if (batch == batches_.end()) return;
    std::erase(batch->open, done.request);
    if (done.error && batch->why.empty()) batch->why = done.error->what;
    if (!batch->open.empty()) return;
    const Batch over = std::move(*batch);
    batches_.erase(batch);
    over.done(over.why);
}

void NodeCommands::hear(const debug::Event& event) {
    (void)stopping_.hear(event);
    if (const auto* done = std::get_if<debug::RequestDone>(&event.what)) finish(*done);
}

void NodeCommands::tick() {
    stopping_.tick(session_.clock());
    answer_stops(false);
    answer_starts("");
}

void NodeCommands::begin_again() {
    constexpr const char* kBeginsAgain = "the world begins again";
    paused_ = stopped_ = false;
    answer_stops(true);
    stopping_.end();
    answer_starts(kBeginsAgain);
    for (const Batch& batch : std::exchange(batches_, {})) batch.done(kBeginsAgain);
}

}  // namespace vagus::session
