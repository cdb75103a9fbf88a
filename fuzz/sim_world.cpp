// Any text as a world file: refused with a sentence, or a world that can be stepped.
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "sim/world.hpp"
#include "sim/world_file.hpp"

using namespace vagus;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    const Result<sim::WorldDefinition> read = sim::read_world(text, "fuzz.world.json");
    if (!read.ok()) {
        if (read.error().what.empty()) std::abort();
        return 0;
    }
    const sim::WorldDefinition& definition = read.value();
    // Large worlds are right, and slow; files are not for a fuzzer to open.
    if (definition.robots.size() > 8 || definition.objects.size() > 100) return 0;
    if (!definition.ground_image.empty()) return 0;
    Result<sim::World> world = sim::World::create(definition);
    if (!world.ok()) std::abort();  // what was read has been checked
    world.value().step(std::chrono::milliseconds(60));
    for (const sim::RobotView& robot : world.value().robots()) (void)world.value().beams(robot.id);
    return 0;
}
