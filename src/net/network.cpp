#include "net/network.hpp"

#include "net/loop.hpp"

namespace vagus::net {

Network::Network() : loop_(std::make_unique<Loop>()) {}
Network::~Network() = default;

Result<Listening> Network::listen(hub::Hub& hub, const Target& target, ListenOptions options) {
    return loop_->listen(hub, target, options);
}
Result<PlaceId> Network::connect(hub::Hub& hub, const Target& target, ConnectOptions options) {
    return loop_->connect(hub, target, options);
}
Result<PlaceId> Network::join(hub::Hub& hub, int descriptor, const std::string& name) {
    return loop_->join(hub, descriptor, name);
}
void Network::close(hub::Hub& hub, hub::LinkId link) {
    loop_->close(hub, link);
}
bool Network::end_writing(hub::Hub& hub, hub::LinkId link) {
    return loop_->end_writing(hub, link);
}
void Network::close(PlaceId place) {
    loop_->close(place);
}
Status Network::watch_signals() {
    return loop_->watch_signals();
}
Status Network::watch_input(int descriptor) {
    return loop_->watch_input(descriptor);
}
void Network::unwatch_input(int descriptor) {
    loop_->unwatch_input(descriptor);
}
std::vector<Event> Network::poll(Time deadline) {
    return loop_->poll(deadline);
}
void Network::flush() {
    loop_->flush();
}
void Network::wake() {
    loop_->wake();
}
Time Network::now() const {
    return loop_->now();
}
bool Network::has_unwritten() const {
    return loop_->has_unwritten();
}

}  // namespace vagus::net
