#include "debug/describer.hpp"

namespace vagus::debug {
namespace {

constexpr uint16_t kFragmentsSince = 8;     // protocol version (2.1)
constexpr uint16_t kNodeRequestsSince = 5;  // GetNodeDescription; before that only the broadcast
constexpr int16_t kHeaderFragment = -1;     // 2.9

}  // namespace

void Describer::start(Outbox& out, uint16_t protocol) {
    mode_ = protocol < kNodeRequestsSince ? Mode::Broadcast
            : protocol < kFragmentsSince  ? Mode::Whole
                                          : Mode::Fragments;
    state_ = State::Waiting;
    tries_ = 0;
    description_ = Description();
    why_.clear();
    if (out.descriptions.enter(id_, out.now)) begin_turn(out);
}

void Describer::begin_turn(Outbox& out) {
    if (state_ != State::Waiting) return out.descriptions.leave(id_);
    state_ = State::Asking;
    ask(out);
}

void Describer::receive(Outbox& out, const wire::Description& header) {
    if (state_ == State::Done && description_.same_header(header)) return;
    if (state_ !=
        State::Asking) {  // the rest follows: somebody else has asked, or it is an old node
        mode_ = header.protocol_version < kNodeRequestsSince ? Mode::Broadcast : Mode::Whole;
        tries_ = 0;
    }
    state_ = State::Asking;
    take(out, description_.begin(header));
}

void Describer::foreign_fragment(Outbox& out) {
    if (state_ != State::Asking || mode_ != Mode::Fragments) return;
    mode_ = Mode::Whole;
    ask(out);
}

void Describer::refuse(Outbox& out, std::string why) {
    if (state_ == State::Asking) fail(out, std::move(why));
}

void Describer::tick(Outbox& out) {
    if (state_ != State::Asking || out.now < deadline_) return;
    if (mode_ == Mode::Fragments && tries_ >= kFragmentTriesMax) {
        mode_ = Mode::Whole;
        tries_ = 0;
    }
    if (tries_ < kDescriptionTriesMax) return ask(out);
    fail(out, "it was asked " + std::to_string(tries_) + " times and sent " +
                  std::to_string(description_.items()) + " parts, not all that it announced");
}

void Describer::ask(Outbox& out) {
    tries_++;
    deadline_ = out.now + kDescriptionRetry;
    if (mode_ == Mode::Fragments) return ask_fragment(out);
    if (mode_ == Mode::Broadcast) {
        wire::GetDescription all{};
        all.version = wire::kProtocolVersion;
        return out.send(all);
    }
    auto whole = message_to<wire::GetNodeDescription>(id_);
    whole.version = wire::kProtocolVersion;
    out.send(whole);
}

void Describer::ask_fragment(Outbox& out) {
    auto part = message_to<wire::GetNodeDescriptionFragment>(id_);
    part.version = wire::kProtocolVersionMax;
    part.fragment =
        description_.begun() ? static_cast<int16_t>(description_.items()) : kHeaderFragment;
    out.send(part);
}

void Describer::take(Outbox& out, Progress progress) {
    switch (progress) {
        case Progress::Ignored:
            return;
        case Progress::Impossible:
            return fail(out, description_.why());
        case Progress::Complete:
            part_at_ = out.now;
            state_ = State::Done;
            return out.descriptions.leave(id_);
        case Progress::More:
            break;
    }
    tries_ = 0;
    part_at_ = out.now;
    deadline_ = out.now + kDescriptionRetry;
    out.descriptions.progress(id_, out.now);
    if (mode_ == Mode::Fragments) ask(out);
}

void Describer::fail(Outbox& out, std::string why) {
    state_ = State::Failed;
    out.descriptions.leave(id_);
    why_ = std::move(why);
    description_ = Description();
}

}  // namespace vagus::debug
