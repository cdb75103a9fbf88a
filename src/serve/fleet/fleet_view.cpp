#include "serve/fleet/fleet_view.hpp"

#include <algorithm>

#include "fleet/limits.hpp"

namespace vagus::serve {

namespace {

// A robot must not lead a browser anywhere but to a page.
bool is_page(const std::string& address) {
    return address.starts_with("http://") || address.starts_with("https://");
}

}  // namespace

FleetView::FleetView(Options options)
    : options_(std::move(options)),
      desk_({.fleet = options_.fleet, .name = options_.name, .events = true}) {}

void FleetView::hear(const fleet::LinkEvent& event, Time now, double wall_ms) {
    now_ = now;
    if (const auto* received = std::get_if<fleet::Received>(&event)) hear_robot(*received, wall_ms);
    if (const auto* lost = std::get_if<fleet::Lost>(&event)) {
        connected_ = false;
        why_ = lost->why;
    }
    if (std::holds_alternative<fleet::Connected>(event)) {
        connected_ = was_connected_ = true;
        connected_at_ = now;
        why_.clear();
    }
    if (const auto* taken = std::get_if<fleet::TakenBack>(&event)) told_.erase(taken->topic.robot);
    desk_.hear(event, now);
    news_ = true;
}

void FleetView::hear_robot(const fleet::Received& received, double wall_ms) {
    const fleet::Topic& topic = received.heard.topic;
    const fleet::Message& message = received.heard.message;
    if (const auto* connection = std::get_if<fleet::Connection>(&message)) {
        return hear_connection(topic.robot, *connection, received.retained, wall_ms);
    }
    if (const auto* state = std::get_if<fleet::State>(&message)) {
        if (!received.retained) hear_state(topic.robot, *state, wall_ms);
        return;
    }
    const auto* event = std::get_if<fleet::Event>(&message);
    if (!event || !heard_.is_new(topic.robot, event->epoch, event->number)) return;
    events_.push_back({{"wall", wall_ms},
                       {"kind", "event"},
                       {"robot", topic.robot},
                       {"name", topic.name},
                       {"args", event->args},
                       {"text", ""}});
}

// Told as it changes: what is retained was so before we looked.
void FleetView::hear_connection(const std::string& robot, const fleet::Connection& connection,
                                bool retained, double wall_ms) {
    const auto known = desk_.robots().find(robot);
    const bool same = known != desk_.robots().end() && known->second.connection &&
                      known->second.connection->state == connection.state;
    if (retained || same) return;
    events_.push_back({{"wall", wall_ms},
                       {"kind", "connection"},
                       {"robot", robot},
                       {"name", connection.state},
                       {"args", Json::array()},
                       {"text", ""}});
}

void FleetView::hear_state(const std::string& robot, const fleet::State& state, double wall_ms) {
    if (told_.size() >= fleet::kRobotsMax && !told_.contains(robot)) return;
    Told& told = told_[robot];
    told.at = now_;
    told.at_wall = wall_ms;
    // Reckoned once for each state: what every message would say differs by its time on the way.
    if (told.epoch == state.epoch && told.since == state.since) return;
    told.epoch = state.epoch;
    told.since = state.since;
    told.since_wall =
        wall_ms - static_cast<double>(std::max<int64_t>(state.clock - state.since, 0));
}

FleetView::Age FleetView::age_of(const std::string& robot, const fleet::Known& known) const {
    if (!connected_) return Age::Stale;
    if (known.state_at && now_ - *known.state_at <= fleet::kStale) return Age::Fresh;
    const bool told = told_.contains(robot) && known.state_at;
    return !told && now_ - connected_at_ <= fleet::kStale ? Age::Waiting : Age::Stale;
}

bool FleetView::age(Time now) {
    now_ = now;
    std::map<std::string, Age> ages;
    for (const auto& [name, known] : desk_.robots()) ages.emplace(name, age_of(name, known));
    const bool other = ages != ages_;
    ages_ = std::move(ages);
    return other;
}

std::string FleetView::why() const {
    if (!why_.empty() || desk_.refused().empty() || desk_.knows_all()) return why_;
    return "the broker does not pass on what this user says (" + desk_.refused() +
           "); look at its access list, or use the login of an operator or looker";
}

std::string FleetView::state_word() const {
    if (is_connected()) return "connected";
    return was_connected_ && !connected_ ? "lost" : "connecting";
}

Json FleetView::document() const {
    Json robots = Json::object();
    for (const auto& [name, known] : desk_.robots()) robots[name] = robot_document(name, known);
    Json document = {{"state", state_word()},
                     {"target", options_.target},
                     {"fleet", options_.fleet},
                     {"user", options_.user},
                     {"robots", std::move(robots)}};
    const std::string trouble = why();
    if (!trouble.empty()) document["why"] = trouble;
    return document;
}

Json FleetView::robot_document(const std::string& name, const fleet::Known& known) const {
    static const char* const kAges[] = {"fresh", "waiting", "stale"};
    const Age age = age_of(name, known);
    Json robot = {{"connection", known.connection ? known.connection->state : "unknown"},
                  {"age", kAges[static_cast<size_t>(age)]}};
    const auto told = told_.find(name);
    if (known.state) {
        robot["state"] = known.state->state;
        robot["actor"] = known.state->actor;
        robot["problems"] = known.state->problems;
        robot["left_out"] = known.state->left_out;
        const bool same = told != told_.end() && told->second.epoch == known.state->epoch &&
                          told->second.since == known.state->since;
        if (same) robot["since_wall"] = told->second.since_wall;
    }
    if (age == Age::Stale && told != told_.end()) robot["told_wall"] = told->second.at_wall;
    if (!known.description) return robot;
    const fleet::Description& about = *known.description;
    robot["project"] = about.project;
    robot["vagus"] = about.vagus;
    robot["plan"] = about.plan;
    robot["groups"] = about.groups;
    robot["nodes"] = about.nodes;
    robot["hear"] = about.hear;
    if (is_page(about.studio)) robot["studio"] = about.studio;
    return robot;
}

}  // namespace vagus::serve
