#include "serve/history/history.hpp"

#include "base/base64.hpp"
#include "serve/json.hpp"

#include <algorithm>
#include <cmath>

namespace vagus::serve {

namespace {

constexpr double kFromStep = 10;  // the start of what is kept is told in steps of so many seconds

Json json_of(const std::optional<int16_t>& word) {
    return word ? Json(*word) : Json();
}

Json things_json(const TapeState& state) {
    Json robots = Json::array();
    Json objects = Json::array();
    for (const auto& [key, standing] : state.things()) {
        const bool robot = (key & kRobotKey) != 0;
        (robot ? robots : objects)
            .push_back({key & ~kRobotKey, standing.x, standing.y, standing.angle});
    }
    return {{"robots", std::move(robots)}, {"objects", std::move(objects)}};
}

}  // namespace

void History::begin(Beginning beginning) {
    end();
    run_ = beginning.run;
    kind_ = beginning.kind;
    name_ = beginning.name;
    doc_of_ = std::move(beginning.doc_of);
    plan_seconds_ = beginning.plan_seconds;
    plan(1, std::move(beginning.plans));
}

void History::end() {
    kind_ = "none";
    name_.clear();
    plan_.reset();
    tape_ = {};
    events_ = {};
    pictures_ = {};
    passed_ = 0;
}

void History::continue_from(double t, uint64_t run) {
    run_ = run;
    if (plan_) plan_->cut(t);
    tape_.cut(t);
    events_.cut(t);
    pictures_.cut(t);
    passed_ = t;
}

bool History::record(std::string_view bytes) {
    return tape_.record(bytes);
}

void History::plan(uint64_t version, PlanPast::Plans plans, PlanPast::Texts texts) {
    if (plan_) return void(plan_->change(version, std::move(plans), std::move(texts)));
    if (plans.empty()) return;
    plan_ = std::make_unique<PlanPast>(std::move(plans), doc_of_, plan_seconds_, std::move(texts));
}

bool History::trace(const std::string& line) {
    return plan_ && plan_->add(line);
}

void History::words(double t, uint16_t node, uint16_t address, std::span<const int16_t> values) {
    RecordWriter writer;
    writer.begin(t);
    writer.words(node, address, values);
    tape_.record(writer.take());
}

void History::forget(double t, uint16_t node, uint16_t address, uint16_t count) {
    RecordWriter writer;
    writer.begin(t);
    writer.forget(node, address, count);
    tape_.record(writer.take());
}

// ---- the span ----

double History::to() const {
    return std::max({passed_, tape_.to(), events_.to(), plan_ ? plan_->to() : 0});
}

double History::from() const {
    if (kind_ == "trace") return plan_ ? plan_->from() : 0;
    const double kept = std::max(0.0, to() - kTapeSeconds);
    // A tape that was too short has begun later than that; at the start of a run it begins with
    // the first instant.
    const double taped = tape_.from() < kFromStep ? 0 : tape_.from();
    return kFromStep * std::floor(std::max(kept, kind_ == "simulated" ? taped : 0) / kFromStep);
}

Json History::document() const {
    Json document = {
        {"run", run_}, {"kind", kind_}, {"name", name_}, {"from", from()}, {"to", to()}};
    const double fine = kFromStep * std::floor(tape_.fine_from() / kFromStep);
    if (fine > from()) document["fine_from"] = fine;
    if (plan_ && plan_->dropped() > 0) {
        document["plan_from"] = kFromStep * std::floor(plan_->from() / kFromStep);
    }
    if (events_.dropped() > 0) {
        document["events_from"] = kFromStep * std::floor(events_.from() / kFromStep);
    }
    return document;
}

// ---- an instant ----

Json History::values_at(const TapeState& state, const std::vector<Range>& ranges) const {
    Json values = Json::array();
    size_t room = kInstantWords;
    for (const Range& range : ranges) {
        if (range.count > room) break;
        room -= range.count;
        Json words = Json::array();
        for (uint32_t i = 0; i < range.count; ++i) {
            const uint32_t address = uint32_t{range.first} + i;
            if (address > 0xffff) break;
            words.push_back(json_of(state.word(range.node, static_cast<uint16_t>(address))));
        }
        values.push_back({{"node", range.node}, {"address", range.first}, {"words", words}});
    }
    return values;
}

// As the topics rays and picture have them.
void History::add_sights(Json& found, const TapeState& state, const Instant& instant) const {
    if (instant.rays) found["rays"] = base64(state.rays());
    if (instant.picture.empty()) return;
    const KeptPicture* const picture = pictures_.at(instant.t, instant.picture);
    if (picture == nullptr) return;
    found["picture"] = base64(picture->bytes);
    found["picture_t"] = picture->t;
}

Json History::at(const Instant& instant) const {
    const double t = std::clamp(instant.t, 0.0, std::max(0.0, to()));
    const TapeState state = tape_.at(t);
    Json found = {{"run", run_},
                  {"t", t},
                  {"to", to()},
                  {"values", values_at(state, instant.ranges)},
                  {"events", events_.until(t, std::min(instant.events, kInstantEvents))},
                  {"nodes", events_.nodes_at(t)}};
    found.update(things_json(state));
    if (tape_.empty() || t >= tape_.fine_from()) found["exact"] = true;
    add_sights(found, state, {.t = t, .rays = instant.rays, .picture = instant.picture});
    if (plan_) {
        found["plan"] = plan_->at(t);
        if (const auto next = plan_->next_step(t)) found["next"] = *next;
        if (const auto before = plan_->step_before(t)) found["before"] = *before;
    }
    return found;
}

// ---- a window ----

// To a tenth of a millimetre, as pages draw it.
Json History::ways(double from, double to) const {
    const auto rounded = [](double value, double unit) { return std::round(value * unit) / unit; };
    Json ways = Json::array();
    for (const auto& [robot, points] : tape_.ways(from, to)) {
        if (ways.size() >= kWaysMax) break;
        Json way = {robot};
        for (const Tape::WayPoint& point : points) {
            way.push_back(rounded(point.t, 1e3));
            way.push_back(rounded(point.x, 1e4));
            way.push_back(rounded(point.y, 1e4));
        }
        ways.push_back(std::move(way));
    }
    return {{"run", run_}, {"ways", std::move(ways)}};
}

Json History::curve(const Word& word, const Window& window) const {
    Json low = Json::array();
    Json high = Json::array();
    for (const Tape::Column& column :
         tape_.columns(word.node, word.address, {window.from, window.to, window.width})) {
        low.push_back(json_of(column.low));
        high.push_back(json_of(column.high));
    }
    return {{"node", word.node}, {"address", word.address}, {"low", low}, {"high", high}};
}

Json History::loads(const Window& window) const {
    Json loads = Json::array();
    const TapeState now = tape_.at(tape_.to());
    const auto nodes = now.nodes().find(kLoadNode);
    if (nodes == now.nodes().end()) return loads;
    for (size_t i = 0; i < nodes->second.values.size(); ++i) {
        const auto node = static_cast<uint16_t>(i);
        if (!nodes->second.known[i]) continue;
        if (loads.size() >= kEventLanesMax) break;
        Json load = curve({kLoadNode, node}, window);
        load.erase("address");
        load.erase("low");
        load["node"] = node;
        loads.push_back(std::move(load));
    }
    return loads;
}

Json History::lanes(const Window& asked) const {
    Window window = asked;
    window.width = std::clamp<size_t>(window.width, 1, kTimelineWidthMax);
    window.to = std::max(window.to, window.from + 1e-6);
    const LaneWindow seen{window.from, window.to, window.width};
    size_t left_out = 0;
    Json lanes = Json::array();
    if (plan_) {
        for (Json& lane : plan_->lanes(seen)) lanes.push_back(std::move(lane));
    }
    for (Json& lane : events_.lanes(seen, left_out)) lanes.push_back(std::move(lane));
    Json curves = Json::array();
    for (size_t i = 0; i < window.words.size() && i < kTimelineWords; ++i) {
        curves.push_back(curve(window.words[i], window));
    }
    return {{"run", run_},      {"from", from()},         {"to", to()},          {"lanes", lanes},
            {"curves", curves}, {"loads", loads(window)}, {"left_out", left_out}};
}

}  // namespace vagus::serve
