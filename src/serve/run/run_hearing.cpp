// What the process of a run tells: checked where it enters (serve/talk), then kept for pages and
// passed on. A process that sends what nobody understands is ended, and the server goes on.
#include <fmt/format.h>

#include <tuple>
#include <utility>

#include "serve/run/run.hpp"
#include "serve/thrown.hpp"

namespace vagus::serve {

void Run::hear_all() {
    const RunProcess* const process = child_.get();
    std::optional<std::string> fault;
    const auto thrown = thrown_by([&] { fault = hear_packets(); });
    if (!fault && thrown) fault = "the run cannot be followed: " + *thrown + "; it was ended";
    if (!fault || !child_ || child_.get() != process) return;
    child_->kill();
    hear_end(*fault);
}

// Gives why it cannot go on: the beginning of a sentence. A listener of one thing may close the
// run, or open another.
std::optional<std::string> Run::hear_packets() {
    const RunProcess* const process = child_.get();
    for (const Packet& packet : child_->pipe().receive()) {
        heard_ = now_;
        auto news = talk::decode_news(packet);
        if (!news.ok()) {
            return fmt::format("the run's process sent {}; it was ended", news.error().what);
        }
        if (counts(news.value())) {
            std::visit([this](auto& one) { hear(one); }, news.value());
        }
        if (child_.get() != process) break;
    }
    return std::nullopt;
}

// Only what is of the order that was given last: another may have overtaken one before.
bool Run::counts(const talk::News& news) const {
    if (const auto* opening = std::get_if<talk::Opening>(&news)) return opening->order == orders_;
    if (const auto* opened = std::get_if<talk::Opened>(&news)) return opened->order == orders_;
    if (const auto* failed = std::get_if<talk::OpenFailed>(&news)) return failed->order == orders_;
    const bool of_any =
        std::holds_alternative<talk::Line>(news) || std::holds_alternative<talk::Answer>(news);
    return of_any || !opening_;
}

// ---- it begins ----

void Run::hear(talk::Opened& opened) {
    opening_ = false;
    if (!keeps_objects_) opened_order_ = opened.order;
    has_world_ = opened.scene.has_value();
    scene_ = std::move(opened.scene);
    programs_.clear();
    for (talk::Program& one : opened.programs) {
        programs_.emplace(one.node, std::move(one.source));
    }
    changed_since_ = std::move(opened.others);
    hears_ = std::move(opened.hears);
    stops_work_ = std::move(opened.stops);
    desk_.topics().touch("scene");
    for (HandOrder& order : std::exchange(by_hand_next_, {})) {
        lend_hand(std::move(order), [](auto, auto&) {});
    }
    opened_();
}

void Run::hear(const talk::OpenFailed& failure) {
    opening_ = false;
    why_ = failure.why;
    state_ = State::None;
    say_("error", why_);
    failed_(why_);
    desk_.topics().touch("clock");
}

// ---- the plan ----

void Run::hear(const talk::Traced& traced) {
    if (traced.late) ++late_checks_;
    if (traced.actor) last_actor_ = *traced.actor;
    told_.trace(traced.line);
}

void Run::hear(talk::PlanNow& plan) {
    // One that fails at once is over the first time that it is told.
    const bool was_over = plan_ && plan_->state == talk::PlanState::Ended;
    plan_ = std::move(plan);
    desk_.topics().touch("plan");
    if (was_over || plan_->state != talk::PlanState::Ended) return;
    plan_ended_({plan_->result.value_or(""), plan_->message});
}

void Run::hear(talk::HeldNow& held) {
    held_ = std::move(held.document.json);
    desk_.topics().touch("held");
}

// ---- answers and sentences ----

void Run::hear(const talk::PlanVersion& version) {
    plan_texts_.clear();
    for (const auto& [file, text] : version.texts) plan_texts_[doc_of_(file)] = text;
    told_.plan(version);
}

void Run::hear(const talk::Answer& answer) {
    const auto found = answers_.find(answer.request);
    if (found == answers_.end()) return;
    const Answered answered = std::move(found->second);
    answers_.erase(found);
    answered(answer);
}

void Run::hear(const talk::Line& line) {
    say_(std::string(talk::word_of(line.kind)), line.text);
}

// ---- the world ----

// A paused run tells its clock ten times a second, too; pages hear of it when something is new, and
// once a second that the run is there.
void Run::hear(const talk::Clock& clock) {
    const auto told = [this] { return std::tuple(t_, paused_, real_, state_); };
    const auto before = told();
    t_ = clock.t;
    paused_ = clock.paused;
    real_ = clock.real;
    if (clock.load) load_ = clock.load;
    if (state_ != State::Dead) state_ = paused_ ? State::Paused : State::Running;
    if (told() == before && now_ < clock_told_ + kClockAgainAfter) return;
    clock_told_ = now_;
    desk_.topics().touch("clock");
}

void Run::hear(talk::SceneNow& scene) {
    scene_ = std::move(scene.scene);
    desk_.topics().touch("scene");
}

void Run::hear(const talk::FrameSeen& seen) {
    ++frames_in_;
    frames_.push_back({seen.frame.frame, seen.t});
}

void Run::hear(const talk::HappenedNow& happened) {
    for (const talk::HappenedOne& one : happened.list) told_.happened(one.what);
}

// ---- its end ----

// What it told last is known to the moment, but for the clock: that is a tenth of a second old.
void Run::hear_end(const std::string& what) {
    be_over(what);
    died_(why_);
}

void Run::be_over(const std::string& what) {
    const std::string last = last_actor_.empty() ? "" : "; the active actor was " + last_actor_;
    why_ = fmt::format(
        "{} after {:.1f} s{}. Everything that was recorded is kept; run it again to start over",
        what, t_, last);
    state_ = State::Dead;
    has_world_ = false;
    child_.reset();
    ++deaths_;
    if (plan_ && plan_->state != talk::PlanState::Ended) {
        plan_->state = talk::PlanState::Ended;
        plan_->result = "Error";
        plan_->message = why_;
        desk_.topics().touch("plan");
    }
    forget_asked(why_);
    forget_held();
    breakpoints_told_({});
    say_("error", why_);
    desk_.topics().touch("clock");
    desk_.topics().touch("robot");
}

}  // namespace vagus::serve
