#include "net/links.hpp"

#include "net/loop.hpp"

namespace vagus::net {

Links::Links() : loop_(std::make_unique<Loop>()) {}
Links::~Links() = default;

Result<Listening> Links::listen(hub::Hub& hub, const Target& target, ListenOptions options) {
    return loop_->listen(hub, target, options);
}
Result<PlaceId> Links::connect(hub::Hub& hub, const Target& target, ConnectOptions options) {
    return loop_->connect(hub, target, options);
}
Result<PlaceId> Links::join(hub::Hub& hub, int descriptor, const std::string& name) {
    return loop_->join(hub, descriptor, name);
}
void Links::close(hub::Hub& hub, hub::LinkId link) {
    loop_->close(hub, link);
}
bool Links::end_writing(hub::Hub& hub, hub::LinkId link) {
    return loop_->end_writing(hub, link);
}
void Links::close(PlaceId place) {
    loop_->close(place);
}
Status Links::watch_signals() {
    return loop_->watch_signals();
}
Status Links::watch_input(int descriptor) {
    return loop_->watch_input(descriptor);
}
void Links::unwatch_input(int descriptor) {
    loop_->unwatch_input(descriptor);
}
std::vector<Event> Links::poll(Time deadline) {
    return loop_->poll(deadline);
}
void Links::flush() {
    loop_->flush();
}
void Links::wake() {
    loop_->wake();
}
Time Links::now() const {
    return loop_->now();
}
bool Links::has_unwritten() const {
    return loop_->has_unwritten();
}

}  // namespace vagus::net
