#include "debug/peer.hpp"

#include <algorithm>

#include "debug/program_mark.hpp"
#include "debug/text.hpp"

namespace vagus::debug {
namespace {

constexpr uint16_t kListedSince =
    5;  // older versions do not answer ListNodes: their silence means nothing (2.6, 5)

// Fills `message` from the frame and hands it on; false if it is malformed.
template <typename Message, typename Use>
bool with(const wire::Frame& frame, Use use) {
    Message message;
    if (wire::decode_message(frame, message) != wire::Error::None) return false;
    use(message);
    return true;
}

}  // namespace

Peer::Peer(NodeId id, uint16_t protocol, Outbox& out, const aesl::CommonDefinitions& common)
    : out_(out), common_(common), control_(view_, out), describer_(id) {
    view_.id = id;
    view_.protocol = protocol;
    view_.connected = true;
    last_seen_ = out.now;
    out_.tell(id, NodeAppeared{protocol});
    if (protocol >= kListedSince) describer_.start(out_, protocol);
}

void Peer::seen() {
    last_seen_ = out_.now;
    if (view_.connected) return;
    view_.connected = true;
    out_.tell(view_.id, NodeReconnected{});
    // It may have been started again with other firmware: what it says now counts.
    describer_.start(out_, view_.protocol);
    told_describer_ = describer_.state();
}

bool Peer::receive(const wire::Frame& frame) {
    switch (static_cast<wire::MessageType>(frame.type)) {
        case wire::MessageType::Description:
        case wire::MessageType::NamedVariableDescription:
        case wire::MessageType::LocalEventDescription:
        case wire::MessageType::NativeFunctionDescription:
            return receive_description(frame);
        case wire::MessageType::Variables:
            return with<wire::Variables>(frame, [this](const auto& m) {
                control_.receive(m);
                receive_variables(m);
            });
        case wire::MessageType::ExecutionStateChanged:
            return with<wire::ExecutionStateChanged>(frame, [this](const auto& m) {
                control_.receive(m);
                read_condition();
            });
        case wire::MessageType::BreakpointSetResult:
            return with<wire::BreakpointSetResult>(frame,
                                                   [this](const auto& m) { control_.receive(m); });
        default:  // types are numbers from outside: most of them are not for hosts
            return receive_fault(frame);
    }
}

bool Peer::receive_fault(const wire::Frame& frame) {
    wire::Fault fault;
    if (!wire::read_fault(frame, fault)) return false;
    char text[wire::kFaultTextMax];
    const uint16_t size = wire::write_fault_text(fault, text);
    const std::string sentence = clean_text({text, static_cast<uint8_t>(size)});
    if (fault.kind == FaultKind::NodeSpecific) {
        control_.node_specific(sentence, fault.pc);
    } else {
        control_.fault(fault.kind, fault.pc, sentence);
    }
    return true;
}

bool Peer::receive_description(const wire::Frame& frame) {
    const auto take = [this](const auto& message) { describer_.receive(out_, message); };
    bool good = false;
    if (frame.type == static_cast<uint16_t>(wire::MessageType::Description)) {
        good = with<wire::Description>(frame, take);
    } else if (frame.type == static_cast<uint16_t>(wire::MessageType::NamedVariableDescription)) {
        good = with<wire::NamedVariableDescription>(frame, take);
    } else if (frame.type == static_cast<uint16_t>(wire::MessageType::LocalEventDescription)) {
        good = with<wire::LocalEventDescription>(frame, take);
    } else {
        good = with<wire::NativeFunctionDescription>(frame, take);
    }
    view_.part_at = describer_.part_at();
    describe_progress();
    return good;
}

void Peer::describe_progress() {
    if (describer_.state() == told_describer_) return;
    told_describer_ = describer_.state();
    if (told_describer_ == Describer::State::Done) described();
    if (told_describer_ == Describer::State::Failed) {
        out_.tell(view_.id, DescriptionFailed{describer_.why()});
    }
}

void Peer::described() {
    SharedValue<aesl::Target> target = out_.targets.of(describer_.give());
    const bool same = view_.described && *view_.target == *target;
    if (!same) {
        view_.target = std::move(target);
        view_.name = view_.target->name;
        view_.protocol = view_.target->protocol_version;
        view_.described = true;
        view_.program.reset();  // was made for another node
        watches_.clear();
        out_.tell(view_.id, NodeDescribed{view_.target->name});
    } else {
        out_.tell(view_.id, NodeConfirmed{});
    }
    if (mark_address(view_.target)) read_program({});
    control_.connected(common_.constants);
}

// What the node told is over from now on.
Result<RequestId> Peer::load(SharedValue<aesl::Program> program, AfterLoad then) {
    (void)forget_told_program();
    return control_.load(std::move(program), then);
}

void Peer::refuse_description() {
    describer_.refuse(out_, "the descriptions of all nodes together have more than " +
                                std::to_string(kDescriptionBytesTotalMax) + " bytes");
    describe_progress();
}

void Peer::foreign_command(const wire::Frame& frame) {
    if (frame.type == static_cast<uint16_t>(wire::MessageType::SetBytecode)) {
        if (forget_told_program()) out_.tell(view_.id, ProgramUntold{});
        with<wire::SetBytecode>(frame, [this](const auto& m) { control_.foreign_bytecode(m); });
    }
    if (frame.type == static_cast<uint16_t>(wire::MessageType::Stop)) control_.foreign_stop();
    if (frame.type == static_cast<uint16_t>(wire::MessageType::GetNodeDescriptionFragment)) {
        describer_.foreign_fragment(out_);
    }
}

void Peer::leave(const std::string& why) {
    view_.connected = false;
    (void)forget_told_program();
    out_.descriptions.leave(view_.id);
    const std::string reason = who() + " " + why;
    control_.disconnected(reason);
    for (const Reading& reading : std::exchange(readings_, {})) {
        if (reading.request == RequestId{}) continue;
        out_.tell(view_.id, RequestDone{reading.request, Error{Code::Unavailable, reason}, ""});
    }
    for (Watch& watch : watches_) watch.asked = false;
}

void Peer::lost() {
    if (!view_.connected) return;
    leave("is disconnected: the connection to its bus is lost");
    out_.tell(view_.id, NodeDisconnected{});
}

void Peer::tick() {
    // A node that is away can be told to stop all the same, and the caller gets its answer.
    if (!view_.connected) return control_.tick();
    if (view_.protocol >= kListedSince && out_.now - last_seen_ >= kSilenceMax) {
        leave("is disconnected: it was silent for " +
              std::to_string(kSilenceMax / std::chrono::seconds(1)) + " s");
        return out_.tell(view_.id, NodeDisconnected{});
    }
    describer_.tick(out_);
    describe_progress();
    control_.tick();
    tick_readings();
    tick_watches();
}

Time Peer::next_tick() const {
    if (!view_.connected) return control_.next_tick().value_or(Time::max());
    Time next = view_.protocol >= kListedSince ? last_seen_ + kSilenceMax : Time::max();
    if (describer_.state() == Describer::State::Asking)
        next = std::min(next, describer_.next_tick());
    next = std::min(next, control_.next_tick().value_or(next));
    for (const Reading& reading : readings_) next = std::min(next, reading.fetch.deadline());
    for (const Watch& watch : watches_) {
        if (!watch.asked) next = std::min(next, watch.next);
    }
    return next;
}

std::string Peer::who() const {
    return "node " + std::to_string(view_.id) + (view_.described ? " \"" + view_.name + "\"" : "");
}

}  // namespace vagus::debug
