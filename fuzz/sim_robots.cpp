// Any stream of frames, programs among them, for a Thymio, an e-puck and a Carbot: their natives
// and their glue stay inside their memories, and the world goes on.
#include <cstddef>
#include <cstdint>

#include "sim/world.hpp"

using namespace vagus;

namespace {

constexpr size_t kFramesMax = 200;

sim::World make() {
    sim::WorldDefinition definition;
    definition.height = 2;
    definition.robots = {
        {.name = "t", .at = {0.3, 0.5}, .node = 1},
        {.name = "e", .type = sim::RobotType::Epuck, .at = {0.7, 0.5}, .node = 2},
        {.name = "c", .type = sim::RobotType::Carbot, .at = {0.5, 1.3}, .node = 3}};
    return std::move(sim::World::create(std::move(definition)).value());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    static sim::World world = make();
    static const hub::LinkId host = world.bus().add({.name = "host"}).value();
    world.reset();
    wire::FrameReader reader;
    for (size_t frames = 0; size > 0 && frames < kFramesMax;) {
        const auto piece = static_cast<uint16_t>(size < 1000 ? size : 1000);
        const uint16_t used = reader.feed(data, piece);
        data += used;
        size -= used;
        if (!reader.complete()) continue;
        ++frames;
        world.bus().receive(host, reader.frame());
        world.step(std::chrono::milliseconds(1));
    }
    world.step(std::chrono::milliseconds(35));
    (void)world.lamps({1});
    wire::Frame frame;
    while (world.bus().take(host, frame)) {
    }
    return 0;
}
