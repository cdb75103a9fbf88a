#include "serve/runner/reliving.hpp"

#include <algorithm>
#include <utility>
#include <variant>

#include "base/seconds.hpp"
#include "sim/world.hpp"

namespace vagus::serve {

namespace {

std::map<std::string, std::string> values_of(const std::vector<std::string>& set) {
    std::map<std::string, std::string> values;
    for (const std::string& one : set) {
        const size_t equals = one.find('=');
        values[one.substr(0, equals)] = one.substr(std::min(equals, one.size() - 1) + 1);
    }
    return values;
}

}  // namespace

Status Reliving::begin(talk::Open& order) {
    past_.reset();
    instead_.reset();
    if (!order.past) return Status::done();
    std::optional<Time> until;
    if (order.past->t) until = from_seconds(*order.past->t);
    record::PastRun past = TRY(record::read_past(order.past->recording, until));
    paths_ = TRY(past.paths(order.plan.empty() ? order.world : order.plan));
    instead_.emplace();
    for (const auto& [name, content] : past.files) instead_->put(path_of(name), content);
    order.world_text.reset();
    order.poses.clear();  // they are among what came before the run
    order.breakpoints.clear();
    order.set = values_of(past.about.set);
    order.from = past.about.from;
    order.robot = past.about.robot;
    order.seed = past.about.seed;
    order.starts = past.about.poses;
    order.chaos = past.about.chaos;
    for (const std::string& name : past.about.loads) order.scripts.push_back(path_of(name));
    next_ = 0;
    breakpoints_ = 0;
    past_ = std::move(past);
    return Status::done();
}

void Reliving::enter(session::SimSession& session, hub::LinkId link) {
    session_ = &session;
    link_ = link;
    const auto is_before_run = [this] {
        if (!past_ || next_ >= past_->inputs.size()) return false;
        const record::Input& next = past_->inputs[next_];
        return next.turn == 0 && next.at == Time{};
    };
    while (is_before_run()) do_again(past_->inputs[next_++]);
}

// The end of a plan is recorded at the end of the instant in which it ends.
bool Reliving::is_due(Time now) const {
    if (next_ >= past_->inputs.size()) return false;
    const record::Input& next = past_->inputs[next_];
    const bool ends = std::holds_alternative<record::Aborted>(next.what);
    return next.at <= (ends ? now + sim::kNodeStep : now);
}

bool Reliving::between_instants(Time now) {
    while (is_due(now)) do_again(past_->inputs[next_++]);
    return now < past_->until;
}

bool Reliving::while_held(Time now) {
    if (!is_due(now)) return false;
    const uint32_t turn = past_->inputs[next_].turn;
    while (is_due(now) && past_->inputs[next_].turn == turn) do_again(past_->inputs[next_++]);
    return true;
}

// Acts, frames and looks ahead are recorded where they come in.
void Reliving::do_again(const record::Input& input) {
    if (const auto* const act = std::get_if<sim::Act>(&input.what)) {
        (void)session_->world().act(*act).ok();  // it worked then
    } else if (const auto* const frame = std::get_if<wire::Frame>(&input.what)) {
        session_->world().bus().receive(link_, *frame);
    } else if (std::holds_alternative<record::HeldMoment>(input.what)) {
        run_.recording.hold(session_->world());
    } else if (std::holds_alternative<record::HeardAhead>(input.what)) {
        session_->hear_ahead();
    } else if (const auto* const script = std::get_if<record::ScriptLoaded>(&input.what)) {
        run_.recording.loaded(script->node, path_of(script->file), script->text);
        run_.loaded(script->node);
    } else if (const auto* const request = std::get_if<run::Request>(&input.what)) {
        ask(*request);
    } else if (const auto* const files = std::get_if<record::PlanFiles>(&input.what)) {
        take(*files);
    } else if (const auto* const drawn = std::get_if<record::Reseeded>(&input.what)) {
        run_.recording.reseeded(drawn->seed);
        run_.reseed(drawn->seed);
    } else if (std::holds_alternative<record::Aborted>(input.what)) {
        run_.abort();
    }
}

void Reliving::ask(const run::Request& request) {
    run::Request asked = request;
    if (auto* const stop = std::get_if<run::AddBreakpoint>(&asked)) {
        ++breakpoints_;
        std::string& plan = stop->breakpoint.plan;
        if (!plan.empty()) plan = path_of(plan);
    }
    run_.plan.ask_again(asked);
}

void Reliving::take(const record::PlanFiles& files) {
    for (const auto& [name, text] : files.texts) {
        past_->files[name] = text;
        instead_->put(path_of(name), text);
    }
    talk::ChangePlan change;
    for (const std::string& name : files.saved) change.files.push_back(path_of(name));
    run_.plan.obey(change);
}

// Breakpoints of then go; those of now come by the order.
std::vector<std::string> Reliving::end() {
    for (int id = 1; id <= breakpoints_; ++id) run_.plan.ask_again(run::RemoveBreakpoint{id});
    instead_.reset();
    std::vector<std::string> others;
    for (const auto& [name, content] : past_->files) {
        const auto now = read_file(path_of(name));
        if (now.ok() && now.value() != content) others.push_back(path_of(name));
    }
    past_.reset();
    return others;
}

}  // namespace vagus::serve
