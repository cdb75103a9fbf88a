#include "cli/net/session.hpp"

#include <algorithm>
#include <iterator>

#include "base/file.hpp"
#include "base/text.hpp"
#include "cli/output.hpp"
#include "hub/hub.hpp"
#include "net/links.hpp"
#include "session/diagnostic_text.hpp"

namespace vagus::cli {
namespace {

constexpr Duration kFlushWithin = std::chrono::seconds(2);
constexpr Duration kFarewellWithin = std::chrono::milliseconds(200);

// Of a node that is named by its number.
std::optional<debug::NodeId> id_of(const std::string& name) {
    const auto number = decimal_number(name);
    const bool fits = number && *number > wire::kHostId && *number < wire::kInvalidId;
    return fits ? std::optional(static_cast<debug::NodeId>(*number)) : std::nullopt;
}

}  // namespace

struct NetSession::Bus {
    hub::Hub hub;
    net::Links net;  // after the hub: it goes first
    hub::LinkId own, peer;
    bool closed = false;
    bool signalled = false;
    std::string why;  // closed or failed

    void note(const std::vector<net::Event>& events) {
        for (const net::Event& event : events) {
            if (event.kind == net::EventKind::Opened) peer = event.link;
            if (event.kind == net::EventKind::Skipped) complain(event.what);
            const bool lost =
                event.kind == net::EventKind::Closed || event.kind == net::EventKind::Failed;
            closed = closed || lost;
            if (lost) why = event.what;
            signalled = signalled || event.kind == net::EventKind::Signal;
        }
    }
};

Result<session::ScriptFile> read_scripts(const std::string& file) {
    return session::read_script_file(TRY(read_file(file)), file);
}

int file_line(const aesl::Script& script, int script_line) {
    return script_line > 0 ? script.first_line + script_line - 1 : 0;
}

std::optional<Error> error_of(const std::vector<debug::Event>& events, debug::RequestId request) {
    for (const debug::Event& event : events) {
        const auto* done = std::get_if<debug::RequestDone>(&event.what);
        if (done != nullptr && done->request == request) return done->error;
    }
    return std::nullopt;
}

NetSession::NetSession(NetOptions options)
    : options_(std::move(options)), bus_(std::make_unique<Bus>()) {}

NetSession::~NetSession() = default;

bool NetSession::interrupted() const {
    return bus_->signalled;
}

Result<std::unique_ptr<NetSession>> NetSession::open(const NetOptions& options) {
    std::unique_ptr<NetSession> session(new NetSession(options));
    const Status connected = session->connect();
    if (!connected.ok()) return connected.error();
    return session;
}

Status NetSession::connect() {
    const net::Target target = TRY(net::parse_target(options_.target));
    bus_->own = TRY(bus_->hub.add({.name = "vagus net"}));
    (void)TRY(bus_->net.watch_signals());
    (void)TRY(bus_->net.connect(bus_->hub, target));
    while (!bus_->signalled) {
        bus_->note(bus_->net.poll(Time::max()));
        if (bus_->closed) return Error{Code::Unavailable, bus_->why};
        if (bus_->peer != hub::LinkId{}) return Status::done();
    }
    return Error{Code::Timeout, "interrupted while connecting to " + options_.target};
}

void NetSession::use_project(session::ScriptFile project) {
    network_.set_common(project.project.common);
    scripts_.clear();
    compiled_.clear();  // it knows the scripts of the project before
    project_ = std::move(project);
    match_scripts();
}

// ---- waiting ----

Time NetSession::now() const {
    return bus_->net.now();
}

Status NetSession::turn(Time deadline) {
    network_.tick(now());
    for (const wire::Frame& frame : network_.take_frames()) {
        if (told_of_frame_) told_of_frame_(frame);
        bus_->hub.receive(bus_->own, frame);
    }
    bus_->note(bus_->net.poll(std::min(deadline, network_.next_tick())));
    wire::Frame frame;
    while (bus_->hub.take(bus_->own, frame)) {
        if (told_of_frame_) told_of_frame_(frame);
        if (!hears_user_events_ && wire::is_user_event(frame.type)) continue;
        network_.receive(now(), frame);
    }
    for (debug::Event& event : network_.take_events()) events_.push_back(std::move(event));
    if (bus_->closed) return Error{Code::Unavailable, bus_->why};
    return Status::done();
}

std::vector<debug::Event> NetSession::take_events() {
    return std::exchange(events_, {});
}

void NetSession::put_back(std::vector<debug::Event> events) {
    events_.insert(events_.begin(), std::make_move_iterator(events.begin()),
                   std::make_move_iterator(events.end()));
}

Status NetSession::wait_for(const std::function<bool()>& ready, Time deadline) {
    while (!ready()) {
        if (interrupted()) return Error{Code::Timeout, "interrupted"};
        if (now() >= deadline) return Error{Code::Timeout, "nothing happened in time"};
        (void)TRY(turn(deadline));
    }
    return Status::done();
}

Status NetSession::wait_done(const std::vector<debug::RequestId>& requests,
                             std::vector<debug::Event>& events) {
    size_t done = 0;
    const auto all_done = [this, &requests, &events, &done] {
        for (debug::Event& event : take_events()) {
            const auto* end = std::get_if<debug::RequestDone>(&event.what);
            const bool ours = end != nullptr && std::find(requests.begin(), requests.end(),
                                                          end->request) != requests.end();
            done += ours ? 1 : 0;
            events.push_back(std::move(event));
        }
        return done >= requests.size();
    };
    return wait_for(all_done, Time::max());  // requests end by themselves
}

void NetSession::farewell() {
    for (const wire::Frame& frame : network_.take_frames()) bus_->hub.receive(bus_->own, frame);
    const Time deadline = now() + kFlushWithin;
    do {
        bus_->note(bus_->net.poll(now()));
    } while (bus_->net.has_unwritten() && !bus_->closed && now() < deadline);
    const Time end = now() + kFarewellWithin;
    if (bus_->closed || !bus_->net.end_writing(bus_->hub, bus_->peer)) return;
    while (!bus_->closed && now() < end) bus_->note(bus_->net.poll(end));
}

// ---- nodes ----

std::vector<debug::NodeId> NetSession::connected() const {
    std::vector<debug::NodeId> ids;
    for (const debug::NodeId id : network_.nodes()) {
        const debug::NodeView* node = network_.node(id);
        if (node->connected && node->described) ids.push_back(id);
    }
    return ids;
}

const debug::NodeView& NetSession::view(debug::NodeId id) const {
    const debug::NodeView* node = network_.node(id);
    return node == nullptr ? gone_ : *node;
}

std::vector<debug::NodeId> NetSession::undescribed() const {
    std::vector<debug::NodeId> ids;
    for (const debug::NodeId id : network_.nodes()) {
        if (view(id).connected && !view(id).described) ids.push_back(id);
    }
    return ids;
}

Status NetSession::discover(const debug::RollCallOptions& options) {
    debug::RollCall call(network_, now(), options);
    size_t heard = events_.size();
    while (!interrupted() && !call.over(network_, now())) {
        (void)TRY(turn(call.next()));
        for (; heard < events_.size(); heard++) call.hear(events_[heard]);
    }
    match_scripts();
    return Status::done();
}

Duration NetSession::wait_or(double seconds) const {
    const std::chrono::duration<double> wait(options_.wait_s.value_or(seconds));
    return std::chrono::duration_cast<Duration>(wait);
}

Result<std::vector<debug::NodeId>> NetSession::find_all(
    const std::vector<std::string>& named) const {
    std::vector<debug::NodeId> ids;
    for (const std::string& name : named) {
        if (name != "all") {
            ids.push_back(TRY(network_.find(name)));
            continue;
        }
        ids = connected();
        if (ids.empty()) return Error{Code::Timeout, "no node answers on " + options_.target};
    }
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
    return ids;
}

// A number is enough as soon as its node is there. A name might be that of two nodes: all must have
// answered.
Result<std::vector<debug::NodeId>> NetSession::nodes(const std::vector<std::string>& named,
                                                     Until until) {
    const Time deadline = now() + wait_or(0);
    debug::RollCallOptions how;
    for (const std::string& name : named) {
        if (const auto id = id_of(name)) how.wanted.push_back(*id);
    }
    how.only_wanted = until == Until::Named && how.wanted.size() == named.size();
    (void)TRY(discover(how));
    const auto found = [this, &named] { return find_all(named).ok(); };
    while (!found() && !interrupted() && now() < deadline) (void)TRY(turn(deadline));
    adopt_scripts();
    for (const debug::NodeId id : how.wanted) {
        if (network_.node(id) == nullptr) return no_answer(id);
    }
    return find_all(named);
}

// It may be there all the same.
Error NetSession::no_answer(debug::NodeId id) const {
    std::string sentence = "node " + std::to_string(id) + " did not answer";
    std::string others;
    for (const debug::NodeId other : connected()) {
        others += (others.empty() ? "" : ", ") + std::to_string(other) + " " + view(other).name;
    }
    sentence += others.empty() ? ", and no other node did either" : "; these did: " + others;
    return {Code::Timeout, sentence + "; if it is slow, give it more time (--wait SECONDS)"};
}

Result<debug::NodeId> NetSession::node(const std::string& named, Until until) {
    return TRY(nodes({named}, until)).front();
}

// ---- scripts ----

const aesl::Script* NetSession::script_of(debug::NodeId id) const {
    const auto found = scripts_.find(id);
    if (found == scripts_.end()) return nullptr;
    return &project_->project.scripts[static_cast<size_t>(found->second)];
}

void NetSession::match_scripts() {
    scripts_.clear();
    if (!project_) return;
    const std::vector<debug::NodeId> ids = connected();
    std::vector<aesl::NodeName> names;
    for (const debug::NodeId id : ids) names.push_back({view(id).name, id});
    const std::vector<int> found = aesl::scripts_for(project_->project, names);
    for (size_t i = 0; i < ids.size(); i++) {
        if (found[i] >= 0) scripts_[ids[i]] = found[i];
    }
}

NetSession::Compiled& NetSession::compiled(debug::NodeId id) {
    const aesl::Script* const script = script_of(id);
    const aesl::Target& target = view(id).target;
    for (Compiled& known : compiled_) {
        if (known.script == script && known.target == target) return known;
    }
    const aesl::Options how =
        session::options_for(network_.common(), {.first_line = script->first_line});
    compiled_.push_back({script, target, network_.compile(id, script->source, how)});
    return compiled_.back();
}

void NetSession::adopt_scripts() {
    match_scripts();
    for (const debug::NodeId id : connected()) {
        const aesl::Script* script = script_of(id);
        if (script == nullptr || view(id).program) continue;
        Compiled& script_for = compiled(id);
        if (script_for.done.ok()) (void)network_.adopt(id, script_for.done.program).ok();
        if (script_for.done.ok() || std::exchange(script_for.told, true)) continue;
        const session::SourceText text{project_->path, script->source, script->first_line};
        for (const Diagnostic& one : session::diagnostics_of(text, script_for.done)) {
            say(report_of(one));
        }
        complain(project_->path + ": the script for \"" + script->node +
                 "\" does not compile: its variables and lines are not known");
    }
}

}  // namespace vagus::cli
