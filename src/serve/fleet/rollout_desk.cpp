#include "serve/fleet/rollout_desk.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/file.hpp"
#include "base/text.hpp"
#include "serve/process.hpp"

namespace vagus::serve {

namespace {

using Place = fleet::Rollout::Place;

constexpr const char* kNoAddress =
    "robots cannot fetch a version from this studio: it was started without an address that they "
    "reach; start it again with --deploy-listen 0.0.0.0:8443 --deploy-cert FILE --deploy-key FILE, "
    "the certificate of this computer by an authority that robots trust, and perhaps "
    "--deploy-host NAME";
constexpr const char* kNoProject =
    "no project is open, whose version robots could get; open one beside the fleet";
constexpr const char* kRuns = "a roll-out is under way; stop it, or wait for its end";
constexpr const char* kEnded =
    "the studio that gave it ended before it was over: robots that have the version keep it, and "
    "no other robot gets it";

constexpr std::pair<Place, const char*> kPlaceWords[] = {{Place::Later, "later"},
                                                         {Place::Wanted, "wanted"},
                                                         {Place::Started, "started"},
                                                         {Place::Well, "well"},
                                                         {Place::Failed, "failed"}};

const char* protocol_word_of(Place place) {
    for (const auto& [one, word] : kPlaceWords) {
        if (one == place) return word;
    }
    return "later";
}

Place place_of_word(const std::string& word) {
    for (const auto& [place, one] : kPlaceWords) {
        if (word == one) return place;
    }
    return Place::Later;
}

// Nobody deploys less than they see on their screen without knowing it.
Status check_unsaved(const OpenVersion& version, const std::vector<std::string>& without) {
    for (const std::string& file : version.unsaved) {
        if (std::ranges::find(without, file) != without.end()) continue;
        return Error{Code::Refused,
                     fmt::format("{} has unsaved changes, which robots would not get; save it, or "
                                 "deploy without them",
                                 file)};
    }
    return Status::done();
}

Json robots_of(const std::vector<fleet::Rollout::Line>& lines) {
    Json robots = Json::object();
    for (size_t at = 0; at < lines.size(); ++at) {
        robots[lines[at].robot] = {{"at", at},
                                   {"is", protocol_word_of(lines[at].place)},
                                   {"why", lines[at].why},
                                   {"has", lines[at].has}};
    }
    return robots;
}

std::vector<fleet::Rollout::Line> lines_of(const Json& robots) {
    std::vector<fleet::Rollout::Line> lines;
    for (const auto& [name, one] : robots.items()) {
        lines.push_back({name, place_of_word(one["is"]), one["why"], one["has"].get<bool>()});
    }
    std::ranges::sort(lines, {}, [&](const fleet::Rollout::Line& line) {
        return robots[line.robot]["at"].get<size_t>();
    });
    return lines;
}

}  // namespace

RolloutDesk::RolloutDesk(Desk& desk, RolloutPlaces places)
    : desk_(desk), places_(std::move(places)) {
    desk.topics().document("rollout", [this](const Json&) { return document(); });
    read_kept();
}

// ---- what pages order ----

void RolloutDesk::begin(Order order, Time now, Done done) {
    now_ = now;
    if (runs() || packing_) return done(Error{Code::Refused, kRuns});
    if (order.robots.empty()) {
        return done(Error{Code::NotFound, "no robot is there that this is for"});
    }
    const auto steps = fleet::read_steps(order.steps, order.robots.size());
    if (!steps.ok()) return done(steps.error());
    const auto version = places_.version();
    if (!version) return done(Error{Code::NotFound, kNoProject});
    const Status decided = check_unsaved(*version, order.without);
    if (!decided.ok()) return done(decided.error());
    if (places_.shelf.listen.empty() && !order.broker_is_here) {
        return done(Error{Code::Refused, kNoAddress});
    }
    packing_ = true;
    worked<vagus::Result<PackedVersion>>(
        places_.work, version->pack,
        [this, order = std::move(order), name = version->name,
         done = std::move(done)](const vagus::Result<PackedVersion>& bytes) {
            packing_ = false;
            packed(order, name, bytes, done);
        });
}

void RolloutDesk::packed(const Order& order, const std::string& project,
                         const vagus::Result<PackedVersion>& version, const Done& done) {
    if (!version.ok()) return done(version.error());
    auto shelf = Shelf::open(places_.shelf, version.value().bytes);
    if (!shelf.ok()) return done(shelf.error());
    back_ = false;
    by_ = order.by;
    target_ = order.target;
    version_ = project;
    number_ = 1 + random_number();
    const fleet::Want want{
        .number = number_, .sha256 = version.value().sha256, .address = shelf.value()->address()};
    start({.fleet = order.fleet,
           .want = want,
           .robots = order.robots,
           .steps = fleet::read_steps(order.steps, order.robots.size()).value()},
          std::move(shelf.value()));
    done(Status::done());
}

Status RolloutDesk::roll_back(const Order& order, Time now) {
    now_ = now;
    if (runs() || packing_) return Error{Code::Refused, kRuns};
    if (target_ != order.target || back_) {
        return Error{Code::NotFound, "there is no roll-out in this fleet that could be taken back"};
    }
    std::vector<std::string> robots;
    for (const fleet::Rollout::Line& line : lines_) {
        if (line.has) robots.push_back(line.robot);
    }
    if (robots.empty()) {
        return Error{Code::NotFound, "no robot has the version of the last roll-out"};
    }
    back_ = true;
    by_ = order.by;
    number_ = 1 + random_number();
    // All at once: none of them is better off with a version that somebody takes back.
    const std::vector<size_t> steps = {robots.size()};
    start({.fleet = order.fleet,
           .want = {.number = number_, .back = true},
           .robots = std::move(robots),
           .steps = steps},
          nullptr);
    return Status::done();
}

void RolloutDesk::start(fleet::Rollout::Options options, std::unique_ptr<Shelf> shelf) {
    rollout_.emplace(std::move(options));
    shelf_ = std::move(shelf);
    state_ = "running";
    why_.clear();
    begun_wall_ = desk_.wall_ms();
    rollout_->tick(now_);
    lines_ = rollout_->table();
    changed();
    keep();
}

Status RolloutDesk::stop(const std::string& by) {
    if (!runs()) return Error{Code::Refused, "no roll-out is under way"};
    halt(
        fmt::format("stopped by {}; robots that have the version keep it, and no other robot "
                    "gets it",
                    by.empty() ? "somebody" : by));
    return Status::done();
}

// It is still heard what becomes of robots that are just putting it in force.
void RolloutDesk::halt(const std::string& why) {
    shelf_.reset();
    if (rollout_) rollout_->stop();
    if (runs()) return end("left", why);
    changed();
}

// Of one that a studio before this one gave robots may have come further than was kept.
void RolloutDesk::enter(const std::string& target) {
    if (!rollout_ && target == target_) rollout_.emplace(number_, lines_);
}

void RolloutDesk::leave(const std::string& why) {
    halt(why);
    rollout_.reset();
}

void RolloutDesk::end(const char* state, const std::string& why) {
    state_ = state;
    why_ = why;
    const auto well = std::ranges::count(lines_, Place::Well, &fleet::Rollout::Line::place);
    desk_.topics().add("fleet_events",
                       {{"wall", desk_.wall_ms()},
                        {"kind", "order"},
                        {"robot", by_},
                        {"name", back_ ? "rollback" : "deploy"},
                        {"args", Json::array()},
                        {"text", fmt::format("{} of {} robots: well{}{}", well, lines_.size(),
                                             why.empty() ? "" : "; ", why)}});
    changed();
    keep();
}

// ---- time ----

void RolloutDesk::hear(const fleet::LinkEvent& event, Time now) {
    now_ = now;
    if (!rollout_) return;
    rollout_->hear(event, now);
    const auto* acknowledged = std::get_if<fleet::Acknowledged>(&event);
    if (!acknowledged || acknowledged->number != kWantNumber || acknowledged->refused.empty()) {
        return;
    }
    if (runs()) {
        halt("the broker does not pass it on (" + acknowledged->refused +
             "); open the fleet with the login of an operator");
    }
}

void RolloutDesk::tick(Time now) {
    now_ = now;
    if (rollout_) {
        rollout_->tick(now);
        std::vector<fleet::Rollout::Line> lines = rollout_->table();
        if (lines != lines_) {
            lines_ = std::move(lines);
            changed();
        }
        if (runs() && rollout_->is_over()) end(rollout_->all_are_well() ? "well" : "failed", "");
    }
    if (to_show_ && now >= next_shown_) {
        to_show_ = false;
        next_shown_ = now + kRolloutShownEvery;
        desk_.topics().touch("rollout");
    }
    if (to_keep_ && now >= next_kept_) keep();
}

Time RolloutDesk::next_tick() const {
    Time next = rollout_ ? rollout_->next_tick() : Time::max();
    if (to_show_) next = std::min(next, next_shown_);
    if (to_keep_) next = std::min(next, next_kept_);
    return next;
}

std::vector<fleet::Post> RolloutDesk::take() {
    if (!rollout_) return {};
    std::vector<fleet::Post> posts = rollout_->take();
    for (fleet::Post& post : posts) post.number = kWantNumber;
    return posts;
}

void RolloutDesk::changed() {
    to_show_ = to_keep_ = true;
}

// ---- the document, and what is kept of it ----

Json RolloutDesk::last_document() const {
    return {{"state", state_},
            {"target", target_},
            {"version", version_},
            {"back", back_},
            {"by", by_},
            {"why", why_},
            {"begun_wall", begun_wall_},
            {"served", shelf_ != nullptr},
            {"robots", robots_of(lines_)}};
}

Json RolloutDesk::document() const {
    Json document = last_document();
    const auto version = places_.version();
    if (version) document["project"] = version->name;
    return document;
}

void RolloutDesk::keep() {
    to_keep_ = false;
    next_kept_ = now_ + kRolloutKeptEvery;
    if (places_.file.empty()) return;
    const Json json = {{"number", number_}, {"rollout", last_document()}};
    const Status kept = write_file(places_.file, json_text(json) + "\n");
    // It runs all the same; only who starts the studio again does not read of it.
    if (!kept.ok() && !std::exchange(told_unkept_, true)) {
        why_ = kept.error().what;
        to_show_ = true;
    }
}

void RolloutDesk::read_kept() {
    if (places_.file.empty()) return;
    const auto text = read_file(places_.file);
    if (!text.ok()) return;
    const Json kept = Json::parse(text.value(), nullptr, false);
    if (!kept.is_object() || !kept.contains("number") || !kept["number"].is_number_integer())
        return;
    const Json json = kept.value("rollout", Json());
    if (Protocol::get().fault_of_document("rollout", json)) return;
    number_ = kept["number"];
    state_ = json["state"];
    target_ = json["target"];
    version_ = json["version"];
    back_ = json["back"];
    by_ = json["by"];
    why_ = json["why"];
    begun_wall_ = json["begun_wall"];
    lines_ = lines_of(json["robots"]);
    if (!runs()) return;
    state_ = "left";
    why_ = kEnded;
}

}  // namespace vagus::serve
