#include "serve/history/plan_past.hpp"

#include <algorithm>
#include <set>

#include "embed/loaded_plan.hpp"
#include "plan/file.hpp"
#include "serve/json.hpp"

namespace vagus::serve {

PlanPast::PlanPast(Plans plans, DocOf doc_of, double seconds, Texts texts)
    : plans_(std::make_shared<const Plans>(std::move(plans))),
      texts_(std::make_shared<const Texts>(std::move(texts))),
      doc_of_(std::move(doc_of)),
      seconds_(seconds) {}

bool PlanPast::add(const std::string& text) {
    const auto read = TraceLine::read(text);
    if (!read.ok() || !plans_ || plans_->empty()) return false;
    const TraceLine& line = read.value();
    const double t = std::max(to_, line.t());
    if (!now_) now_.emplace(plans_, doc_of_);
    if (blocks_.empty() || blocks_.back().lines.size() >= kTraceBlockLines) begin_block(t);
    if (const auto event = line.event()) {
        now_->see(*event);
        see(*event, t);
    }
    keep(text, t);
    bound();
    return true;
}

bool PlanPast::change(uint64_t version, Plans plans, Texts texts) {
    if (plans.empty() || version <= version_ || version > kPlanVersions) return false;
    version_ = version;
    plans_ = std::make_shared<const Plans>(std::move(plans));
    texts_ = std::make_shared<const Texts>(std::move(texts));
    if (!now_) return true;
    now_->change(plans_);
    begin_block(to_);
    return true;
}

void PlanPast::begin_block(double t) {
    blocks_.push_back({*now_, plans_, texts_, version_, t, t});
}

void PlanPast::cut(double t) {
    if (t > to_ || blocks_.empty()) return;
    const auto drop = [this](const Block& block) {
        bytes_ -= block.bytes;
        lines_ -= block.lines.size();
    };
    while (blocks_.size() > 1 && blocks_.back().from > t) {
        drop(blocks_.back());
        blocks_.pop_back();
    }
    Block last = std::move(blocks_.back());
    drop(last);
    blocks_.pop_back();
    plans_ = last.plans;
    texts_ = last.texts;
    version_ = last.version;
    now_ = last.before;
    for (std::deque<Lane>* lanes : {&actors_, &supervisors_}) {
        for (Lane& one : *lanes) one.cut(t);
        std::erase_if(*lanes,
                      [](const Lane& one) { return one.bars.empty() && one.marks.empty(); });
    }
    while (!steps_.empty() && steps_.back() > t) steps_.pop_back();
    to_ = std::min(last.from, t);
    begin_block(to_);
    for (const std::string& text : last.lines) again(text, t);
    if (lines_ > 0) return;
    blocks_.clear();
    now_.reset();
}

// A line whose lanes are there.
void PlanPast::again(const std::string& text, double until) {
    const auto read = TraceLine::read(text);
    if (!read.ok() || read.value().t() > until) return;
    if (const auto event = read.value().event()) now_->see(*event);
    keep(text, std::max(to_, read.value().t()));
}

void PlanPast::keep(const std::string& text, double t) {
    Block& block = blocks_.back();
    block.lines.push_back(text);
    block.bytes += text.size();
    block.to = to_ = t;
    bytes_ += text.size();
    ++lines_;
}

void PlanPast::bound() {
    const auto old = [&](const Block& block) {
        return lines_ > kTraceLines || bytes_ > kTraceBytes || block.to < to_ - seconds_;
    };
    while (blocks_.size() > 1 && old(blocks_.front())) {
        bytes_ -= blocks_.front().bytes;
        lines_ -= blocks_.front().lines.size();
        dropped_ += blocks_.front().lines.size();
        blocks_.pop_front();
    }
}

// ---- lanes ----

Lane* PlanPast::lane(const char* kind, const std::string& path, const std::string& name) {
    std::deque<Lane>& lanes = std::string_view(kind) == "actors" ? actors_ : supervisors_;
    for (Lane& one : lanes) {
        if (one.path == path && one.name == name) return &one;
    }
    if (actors_.size() + supervisors_.size() >= kPlanLanesMax) return nullptr;
    lanes.push_back({kind, path, name});
    return &lanes.back();
}

void PlanPast::see(const plan::TraceEvent& event, double t) {
    Lane* actors = lane("actors", event.plan, "");
    if (!actors) return;
    if (const auto* start = std::get_if<plan::ActorStarted>(&event.what)) {
        actors->end(t);
        actors->begin(t, std::string(start->actor));
        watch(t);
    } else if (const auto* end = std::get_if<plan::ActorEnded>(&event.what)) {
        actors->end(t, std::string(end->state));
        watch(t, event.plan);
        step_at(t);
    } else if (const auto* raised = std::get_if<plan::EventRaised>(&event.what)) {
        Lane* supervisor = lane("supervisor", event.plan, std::string(raised->supervisor));
        if (supervisor) {
            supervisor->mark({t, std::string(raised->event), std::string(raised->target)});
        }
        if (raised->target != plan::kIgnore) watch(t, event.plan);
        step_at(t);
    } else if (std::get_if<plan::ActorInterrupted>(&event.what)) {
        actors->end(t, "interrupted");
    } else if (std::get_if<plan::PlanEnded>(&event.what)) {
        actors->end(t);
        watch(t);
    }
}

void PlanPast::step_at(double t) {
    if (!steps_.empty() && steps_.back() == t) return;
    steps_.push_back(t);
    if (steps_.size() > kLaneItemsKept) steps_.pop_front();
}

// Opens and ends the bars of supervisors. Those of the active actor of `without_path` watch no
// more.
void PlanPast::watch(double t, std::string_view without_path) {
    const auto watching = now_->watching();
    std::set<std::pair<std::string, std::string>> now;
    for (const PlanFollower::Watching& one : watching) {
        if (!one.global && one.path == without_path) continue;
        now.emplace(one.path, one.name);
    }
    for (Lane& one : supervisors_) {
        const bool watches = now.erase({one.path, one.name}) > 0;
        if (watches && !one.is_open()) one.begin(t);
        if (!watches) one.end(t);
    }
    for (const auto& [path, name] : now) {
        if (Lane* fresh = lane("supervisor", path, name)) fresh->begin(t);
    }
}

std::vector<Json> PlanPast::lanes(const LaneWindow& window) const {
    std::vector<Json> found;
    for (const auto* lanes : {&actors_, &supervisors_}) {
        for (const Lane& one : *lanes) found.push_back(one.shown(window));
    }
    return found;
}

// ---- an instant ----

// Nothing before the first line that is kept.
const PlanPast::Block* PlanPast::block_at(double t) const {
    const auto after =
        std::upper_bound(blocks_.begin(), blocks_.end(), t,
                         [](double instant, const Block& block) { return instant < block.from; });
    return after == blocks_.begin() ? nullptr : &*std::prev(after);
}

std::optional<std::string> PlanPast::text_at(double t, const std::string& doc) const {
    const Block* const block = block_at(t);
    if (block == nullptr || !block->texts->contains(doc)) return std::nullopt;
    return block->texts->at(doc);
}

Json PlanPast::at(double t) const {
    const Block* const block = block_at(t);
    if (block == nullptr) {
        return {{"state", "none"}, {"t", t}, {"levels", Json::array()}, {"story", Json::array()}};
    }
    PlanFollower follower = block->before;
    for (const std::string& text : block->lines) {
        const auto line = TraceLine::read(text);
        if (!line.ok()) continue;
        if (line.value().t() > t) break;
        if (const auto event = line.value().event()) follower.see(*event);
    }
    return follower.document(t, false);
}

std::optional<double> PlanPast::next_step(double t) const {
    const auto found = std::upper_bound(steps_.begin(), steps_.end(), t);
    return found == steps_.end() ? std::nullopt : std::optional(*found);
}

std::optional<double> PlanPast::step_before(double t) const {
    const auto found = std::lower_bound(steps_.begin(), steps_.end(), t);
    return found == steps_.begin() ? std::nullopt : std::optional(*std::prev(found));
}

std::string PlanPast::text() const {
    std::string text;
    for (const Block& block : blocks_) {
        for (const std::string& line : block.lines) (text += line) += '\n';
    }
    return text;
}

// ---- plans ----

PlanPast::Plans read_plans(const std::string& file) {
    return read_plans(file, embed::PlanDisk(file));
}

PlanPast::Plans read_plans(const std::string& file, const plan::Files& files) {
    std::vector<plan::Plan> plans;
    std::vector<std::string> wanted = {file};
    std::set<std::string> seen;
    for (size_t i = 0; i < wanted.size() && i < plan::kPlanFilesMax; ++i) {
        if (!seen.insert(wanted[i]).second) continue;
        const auto text = files.read(wanted[i]);
        if (!text.ok()) continue;
        plan::PlanFile read = plan::parse_plan(text.value(), wanted[i]);
        for (const plan::Actor& actor : read.plan.actors) {
            if (actor.plan) wanted.push_back(plan::path_of_sub_plan(wanted[i], *actor.plan));
        }
        plans.push_back(std::move(read.plan));
    }
    return outlines_of(plans);
}

}  // namespace vagus::serve
