#include "debug/network.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "debug/names.hpp"
#include "debug/peer.hpp"
#include "debug/presence.hpp"
#include "debug/text.hpp"
#include "debug/user_event.hpp"

namespace vagus::debug {

const char* name_of(ProgramState state) {
    switch (state) {
        case ProgramState::Unknown:
            return "unknown";
        case ProgramState::Running:
            return "running";
        case ProgramState::Paused:
            return "paused";
        case ProgramState::Stopped:
            return "stopped";
    }
    return "";
}

const char* name_of(FaultKind kind) {
    switch (kind) {
        case FaultKind::ArrayAccess:
            return "array_access";
        case FaultKind::DivisionByZero:
            return "division_by_zero";
        case FaultKind::Killed:
            return "killed";
        case FaultKind::NodeSpecific:
            return "node_specific";
    }
    return "";
}

// Who is there: discovery as in section 2.6 of the wire spec. What a node says is for its Peer.
class Network::Impl {
public:
    void receive(Time now, const wire::Frame& frame);
    void tick(Time now);
    Time next_tick() const;
    void list_nodes();
    Peer* peer(NodeId id) const;
    // Something happens to the node, which may change when it has something to do next …
    void touch(NodeId id);
    // … or to all of them.
    void touch_all();
    template <typename Message>
    std::optional<RequestId> at_once(NodeId id, Control::Kind kind) {
        touch(id);
        if (Peer* const known = peer(id)) return known->control().at_once(kind);
        out.command<Message>(id);
        return std::nullopt;
    }
    std::vector<const NodeView*> views() const;
    std::vector<std::pair<NodeId, std::string>> left() const;
    void acknowledge_left();
    Error unknown(NodeId id) const;

    Outbox out;
    aesl::CommonDefinitions common;
    std::map<NodeId, std::unique_ptr<Peer>> peers;
    uint64_t malformed = 0;
    Presences presences;

private:
    Time next_tick_of_peers() const;
    void note_name(NodeId id, const wire::Description& header);
    void note_words(const wire::Frame& frame);
    void examine(NodeId id, const NodeView& node);
    void tell_shared(NodeId id, std::string other_name);
    // Those that waited for their turn and have it now.
    void give_turns();
    void receive_event(const wire::Frame& frame);
    void receive_command(const wire::Frame& frame);
    void receive_node(const wire::Frame& frame);
    // The node of that id, made if there is room; nullptr if its protocol is not ours.
    Peer* meet(NodeId id, uint16_t protocol);
    void forget(NodeId id);
    bool anybody_connected() const;

    std::set<NodeId> mismatched_;  // told already
    // Of nodes that said good-bye: they get them back when they return under the same name.
    struct Farewell {
        std::string name;
        std::vector<LineBreakpoint> breakpoints;
        bool known_of = false;  // a person acknowledged it
    };
    std::map<NodeId, Farewell> farewells_;  // until they are described again
    Time next_list_{};
    size_t description_bytes_ = 0;
    bool told_too_many_ = false;
    // When a node has something to do next, or before. Ten thousand of them cannot each be asked
    // after every frame: only those to which something has happened are, the others after a tick.
    mutable std::optional<Time> peers_tick_;
    mutable std::vector<NodeId> touched_;  // since it was found
};

void Network::Impl::receive(Time now, const wire::Frame& frame) {
    out.now = std::max(out.now, now);
    touch(wire::is_command(frame.type) ? frame.first_word() : frame.source);
    if (wire::is_user_event(frame.type)) return receive_event(frame);
    if (wire::is_command(frame.type)) return receive_command(frame);
    if (frame.type == static_cast<uint16_t>(wire::MessageType::ListNodes)) presences.asked(out.now);
    if (frame.source == wire::kHostId || frame.source == wire::kInvalidId) return;
    receive_node(frame);
    give_turns();
}

void Network::Impl::receive_event(const wire::Frame& frame) {
    if (Peer* known = peer(frame.source)) known->seen();
    out.tell(frame.source, user_event_of(frame, common));
}

void Network::Impl::receive_command(const wire::Frame& frame) {
    if (Peer* to = peer(frame.first_word())) to->foreign_command(frame);
}

void Network::Impl::receive_node(const wire::Frame& frame) {
    Peer* from = peer(frame.source);
    if (frame.type == static_cast<uint16_t>(wire::MessageType::NodePresent)) {
        wire::NodePresent present;
        if (wire::decode_message(frame, present) != wire::Error::None) {
            malformed++;
        } else if (Peer* met = meet(frame.source, present.version)) {
            met->seen();
            presences.answered(frame.source, out.now);
        }
        return;
    }
    if (frame.type == static_cast<uint16_t>(wire::MessageType::Disconnected)) {
        return forget(frame.source);
    }
    if (frame.type == static_cast<uint16_t>(wire::MessageType::Description)) {
        wire::Description header;
        if (wire::decode_message(frame, header) != wire::Error::None) {
            malformed++;
            return;
        }
        from = meet(frame.source, header.protocol_version);
        if (from != nullptr) note_name(frame.source, header);
    }
    if (frame.type == static_cast<uint16_t>(wire::MessageType::Variables)) note_words(frame);
    if (from == nullptr) return;  // all else from unknown sources is ignored (2.6, 3)
    const bool was_described = from->view().described;
    const size_t before = from->description_bytes();
    from->seen();
    if (!from->receive(frame)) malformed++;
    description_bytes_ += from->description_bytes() - before;  // may be less: a header begins again
    if (description_bytes_ > kDescriptionBytesTotalMax) {
        description_bytes_ -= from->description_bytes();
        from->refuse_description();
        description_bytes_ += from->description_bytes();
    }
    if (was_described || !from->view().described) return;
    const auto known = farewells_.find(frame.source);
    if (known == farewells_.end()) return;
    if (known->second.name == from->view().name) {
        from->control().restore_breakpoints(known->second.breakpoints);
    }
    farewells_.erase(known);
}

void Network::Impl::note_name(NodeId id, const wire::Description& header) {
    const std::string other = presences.named(id, clean_text(header.name), out.now);
    if (!other.empty()) tell_shared(id, other);
}

void Network::Impl::note_words(const wire::Frame& frame) {
    wire::Variables words;
    if (wire::decode_message(frame, words) != wire::Error::None) return;
    if (presences.told(frame.source, {words.start, words.values.count})) {
        tell_shared(frame.source, "");
    }
}

void Network::Impl::examine(NodeId id, const NodeView& node) {
    const uint16_t words = node.target->variables_size;
    if (!node.connected || !node.described || words < 2 || !presences.doubts(id)) return;
    for (const Probe& probe : presences.settle(id, words, out.now)) {
        auto question = message_to<wire::GetVariables>(id);
        question.start = probe.start;
        question.length = probe.count;
        out.send(question);
    }
}

void Network::Impl::tell_shared(NodeId id, std::string other_name) {
    peer(id)->share_id(other_name);
    out.tell(id, NodeIdShared{std::move(other_name)});
}

void Network::Impl::give_turns() {
    while (const auto next = out.descriptions.next(out.now)) {
        touch(*next);
        if (Peer* const whose = peer(*next)) whose->ask_description();
    }
    while (const auto next = out.requests.next(out.now)) {
        touch(*next);
        if (Peer* const whose = peer(*next)) whose->control().begin_turn();
    }
}

Peer* Network::Impl::meet(NodeId id, uint16_t protocol) {
    if (protocol < wire::kProtocolVersionMin || protocol > wire::kProtocolVersionMax) {
        if (mismatched_.size() < kNodesMax && mismatched_.insert(id).second) {
            out.tell(id, ProtocolMismatch{protocol});
        }
        return nullptr;
    }
    mismatched_.erase(id);
    if (Peer* known = peer(id)) return known;
    if (peers.size() < kNodesMax) {
        return (peers[id] = std::make_unique<Peer>(id, protocol, out, common)).get();
    }
    if (!std::exchange(told_too_many_, true)) out.tell(id, TooManyNodes{});
    return nullptr;
}

void Network::Impl::forget(NodeId id) {
    Peer* peer_left = peer(id);
    if (peer_left == nullptr) return;
    peer_left->leave("has left the network");
    const NodeView& view = peer_left->view();
    if (farewells_.size() < kNodesMax) farewells_[id] = {view.name, view.breakpoints};
    description_bytes_ -= peer_left->description_bytes();
    peers.erase(id);
    presences.forget(id);
    out.tell(id, NodeDisconnected{.forgotten = true});
}

void Network::Impl::tick(Time now) {
    out.now = std::max(out.now, now);
    touch_all();
    if (out.now >= next_list_) list_nodes();
    for (const auto& [id, known] : peers) {
        const size_t before = known->description_bytes();
        known->tick();
        description_bytes_ += known->description_bytes() - before;
    }
    give_turns();
}

void Network::Impl::list_nodes() {
    next_list_ = out.now + kListEvery;
    presences.asked(out.now);
    wire::ListNodes list{};
    list.version = wire::kProtocolVersion;
    out.send(list);
    if (presences.doubtful()) {
        for (const auto& [id, known] : peers) examine(id, known->view());
        presences.drop_doubts();
    }
    if (anybody_connected()) return;
    wire::GetDescription old{};  // nodes of version 4 know nothing newer (2.6, 6)
    old.version = wire::kProtocolVersion;
    out.send(old);
}

bool Network::Impl::anybody_connected() const {
    for (const auto& [id, known] : peers) {
        if (known->view().connected) return true;
    }
    return false;
}

Time Network::Impl::next_tick() const {
    return std::min(
        {next_list_, out.descriptions.next_tick(), out.requests.next_tick(), next_tick_of_peers()});
}

Time Network::Impl::next_tick_of_peers() const {
    Time next = peers_tick_.value_or(Time::max());
    if (peers_tick_) {
        for (const NodeId id : touched_)
            if (const Peer* known = peer(id)) next = std::min(next, known->next_tick());
    } else {
        for (const auto& [id, known] : peers) next = std::min(next, known->next_tick());
    }
    touched_.clear();
    peers_tick_ = next;
    return next;
}

void Network::Impl::touch(NodeId id) {
    if (!peers_tick_ || (!touched_.empty() && touched_.back() == id)) return;
    touched_.push_back(id);
    if (touched_.size() > peers.size()) touch_all();
}

void Network::Impl::touch_all() {
    peers_tick_.reset();
    touched_.clear();
}

Peer* Network::Impl::peer(NodeId id) const {
    const auto found = peers.find(id);
    return found == peers.end() ? nullptr : found->second.get();
}

std::vector<const NodeView*> Network::Impl::views() const {
    std::vector<const NodeView*> all;
    for (const auto& [id, known] : peers) all.push_back(&known->view());
    return all;
}

std::vector<std::pair<NodeId, std::string>> Network::Impl::left() const {
    std::vector<std::pair<NodeId, std::string>> left;
    for (const auto& [id, farewell] : farewells_) {
        if (peer(id) == nullptr && !farewell.known_of) left.emplace_back(id, farewell.name);
    }
    return left;
}

void Network::Impl::acknowledge_left() {
    for (auto& [id, farewell] : farewells_) farewell.known_of = true;
}

Error Network::Impl::unknown(NodeId id) const {
    const auto found = find_node(views(), std::to_string(id));
    if (!found.ok()) return found.error();
    return {Code::NotFound, "there is no node " + std::to_string(id)};
}

// ---- the public face: finds the node, then its Peer or Control does the work ----

Network::Network() : impl_(std::make_unique<Impl>()) {}
Network::~Network() = default;
Network::Network(Network&&) noexcept = default;
Network& Network::operator=(Network&&) noexcept = default;

void Network::receive(Time now, const wire::Frame& frame) {
    impl_->receive(now, frame);
}
void Network::tick(Time now) {
    impl_->tick(now);
}
Time Network::next_tick() const {
    return impl_->next_tick();
}
std::vector<wire::Frame> Network::take_frames() {
    return impl_->out.take_frames();
}
std::vector<Event> Network::take_events() {
    return impl_->out.take_events();
}
Counts Network::counts() const {
    return {.dropped = impl_->out.dropped(), .malformed = impl_->malformed};
}

std::vector<NodeId> Network::nodes() const {
    std::vector<NodeId> ids;
    for (const auto& [id, known] : impl_->peers) ids.push_back(id);
    return ids;
}

std::vector<std::pair<NodeId, std::string>> Network::left() const {
    return impl_->left();
}
void Network::acknowledge_left() {
    impl_->acknowledge_left();
}

const NodeView* Network::node(NodeId id) const {
    const Peer* known = impl_->peer(id);
    return known == nullptr ? nullptr : &known->view();
}

Result<NodeId> Network::find(std::string_view name_or_id) const {
    return find_node(impl_->views(), name_or_id);
}

void Network::list_nodes() {
    impl_->list_nodes();
}

void Network::link_lost() {
    impl_->touch_all();
    for (const auto& [id, known] : impl_->peers) known->lost();
}

void Network::call(NodeId id) {
    if (node(id) != nullptr) return;
    auto question = message_to<wire::GetNodeDescription>(id);
    question.version = wire::kProtocolVersion;
    impl_->out.send(question);
}

bool Network::doubts_an_id() const {
    return impl_->presences.doubtful();
}

bool Network::examines_ids() const {
    return impl_->presences.waits();
}

void Network::set_common(aesl::CommonDefinitions common) {
    impl_->common = std::move(common);
}

const aesl::CommonDefinitions& Network::common() const {
    return impl_->common;
}

// The Peer of a node that is to be worked with, or an Error from the function around.
Result<Peer*> Network::usable(NodeId id) const {
    Peer* const known = impl_->peer(id);
    if (known == nullptr) return impl_->unknown(id);
    (void)TRY(debug::usable(known->view()));
    impl_->touch(id);
    return known;
}

Result<RequestId> Network::load(NodeId id, SharedValue<aesl::Program> program, AfterLoad then) {
    return TRY(usable(id))->load(std::move(program), then);
}

Status Network::adopt(NodeId id, const aesl::Program& program) {
    TRY(usable(id))->control().adopt(program);
    return Status::done();
}

void Network::forget_program(NodeId id) {
    if (Peer* const known = impl_->peer(id)) known->control().forget_program();
}

Result<RequestId> Network::run(NodeId id) {
    return TRY(usable(id))->control().ask(Control::Kind::Run);
}
Result<RequestId> Network::pause(NodeId id) {
    return TRY(usable(id))->control().ask(Control::Kind::Pause);
}
Result<RequestId> Network::stop(NodeId id) {
    return TRY(usable(id))->control().ask(Control::Kind::Stop);
}
std::optional<RequestId> Network::stop_now(NodeId id) {
    return impl_->at_once<wire::Stop>(id, Control::Kind::Stop);
}
std::optional<RequestId> Network::pause_now(NodeId id) {
    return impl_->at_once<wire::Pause>(id, Control::Kind::Pause);
}
bool Network::stay_after_load(NodeId id) {
    Peer* const known = impl_->peer(id);
    return known && known->control().stay_after_load();
}
Result<RequestId> Network::reset(NodeId id) {
    return TRY(usable(id))->control().ask(Control::Kind::Reset);
}
Result<RequestId> Network::step(NodeId id) {
    return TRY(usable(id))->control().ask(Control::Kind::Step);
}
Result<RequestId> Network::query(NodeId id) {
    return TRY(usable(id))->control().ask(Control::Kind::Query);
}
Result<RequestId> Network::ask_program(NodeId id) {
    return TRY(usable(id))->ask_program();
}
Result<RequestId> Network::save(NodeId id) {
    return TRY(usable(id))->control().ask(Control::Kind::Save);
}

Result<RequestId> Network::set_breakpoint(NodeId id, int line, std::string_view condition) {
    return TRY(usable(id))->control().set_breakpoint(line, condition, impl_->common.constants);
}
Status Network::clear_breakpoint(NodeId id, int line) {
    return TRY(usable(id))->control().clear_breakpoint(line);
}
Status Network::clear_breakpoints(NodeId id) {
    TRY(usable(id))->control().clear_breakpoints();
    return Status::done();
}

Result<VariableRange> Network::variable(NodeId id, std::string_view text) const {
    return find_range(TRY(usable(id))->view(), text);
}

Result<RequestId> Network::get(NodeId id, const VariableRange& range) {
    return TRY(usable(id))->get(range);
}

namespace {

Status check_count(const VariableRange& range, std::span<const int16_t> values) {
    if (!values.empty() && values.size() <= range.count) return Status::done();
    return Error{Code::BadInput, range.name + " takes 1 to " + std::to_string(range.count) +
                                     " values here, found " + std::to_string(values.size())};
}

}  // namespace

Result<RequestId> Network::set(NodeId id, const VariableRange& range,
                               std::span<const int16_t> values) {
    const Status counted = check_count(range, values);
    if (!counted.ok()) return counted.error();
    return TRY(usable(id))->set(range, values);
}

Status Network::write(NodeId id, const VariableRange& range, std::span<const int16_t> values) {
    const Status counted = check_count(range, values);
    if (!counted.ok()) return counted;
    TRY(usable(id))->write(range, values);
    return Status::done();
}

Status Network::watch(NodeId id, const VariableRange& range, Duration every) {
    return TRY(usable(id))->watch(range, every);
}

void Network::unwatch(NodeId id, std::string_view name) {
    impl_->touch(id);
    if (Peer* known = impl_->peer(id)) known->unwatch(name);
}

Status Network::emit(std::string_view event, std::span<const int16_t> arguments) {
    const EventShape shape = TRY(find_event(impl_->common, event));
    if (shape.size && *shape.size != arguments.size()) {
        return Error{Code::BadInput, "event \"" + std::string(event) + "\" takes " +
                                         std::to_string(*shape.size) + " arguments, found " +
                                         std::to_string(arguments.size())};
    }
    if (arguments.size() > wire::kArgumentsMax) {
        return Error{Code::Limit, "an event has at most " + std::to_string(wire::kArgumentsMax) +
                                      " arguments, found " + std::to_string(arguments.size())};
    }
    wire::Frame frame{};
    frame.source = wire::kHostId;
    frame.type = shape.number;
    for (const int16_t word : arguments) wire::add_argument(frame, word);
    impl_->out.send_frame(frame);
    return Status::done();
}

}  // namespace vagus::debug
