#include "net/client.hpp"

#include <utility>

#include "hub/hub.hpp"
#include "net/links.hpp"

namespace vagus::net {

// A hub of two links: this process, and the peer.
struct Client::State {
    hub::Hub hub;
    hub::LinkId own = hub.add({.name = "client"}).value();
    std::optional<hub::LinkId> peer;  // none: it has gone
    std::string name;
    std::string why_gone;
    Links links;  // after the hub: it goes first

    void poll(Time deadline) {
        for (const Event& event : links.poll(deadline)) {
            if (event.kind == EventKind::Opened) peer = event.link;
            if (event.kind != EventKind::Closed && event.kind != EventKind::Failed) continue;
            peer.reset();
            why_gone = event.what;
        }
    }
    Error gone() const { return Error{Code::Unavailable, why_gone}; }
};

Result<Client> Client::connect(const Target& target, Duration within) {
    auto state = std::make_unique<State>();
    state->name = to_string(target);
    TRY(state->links.connect(state->hub, target));
    const Time deadline = state->links.now() + within;
    while (!state->peer && state->why_gone.empty() && state->links.now() < deadline) {
        state->poll(deadline);
    }
    if (!state->why_gone.empty()) return state->gone();
    if (!state->peer) {
        return Error{Code::Timeout, state->name + ": cannot connect: no answer in time"};
    }
    return Client(std::move(state));
}

Client::Client(std::unique_ptr<State> state) : state_(std::move(state)) {}
Client::Client(Client&&) noexcept = default;
Client& Client::operator=(Client&&) noexcept = default;
Client::~Client() = default;

Status Client::send(const wire::Frame& frame) {
    const Time deadline = now() + kSendWithin;
    state_->hub.receive(state_->own, frame);
    do {
        state_->poll(now());
        if (!state_->peer) return state_->gone();
        if (!state_->links.has_unwritten()) return Status::done();
        state_->poll(deadline);
    } while (now() < deadline);
    return Error{Code::Timeout, state_->name + ": the peer has stopped reading"};
}

Result<std::optional<wire::Frame>> Client::receive(Time deadline) {
    wire::Frame frame;
    do {
        if (state_->hub.take(state_->own, frame)) return std::optional<wire::Frame>(frame);
        if (!state_->peer) return state_->gone();
        state_->poll(deadline);
    } while (now() < deadline);
    if (state_->hub.take(state_->own, frame)) return std::optional<wire::Frame>(frame);
    return std::optional<wire::Frame>{};
}

Time Client::now() const {
    return state_->links.now();
}

const std::string& Client::name() const {
    return state_->name;
}

}  // namespace vagus::net
