// Any bytes as the picture of a ground.
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "sim/ground.hpp"

using namespace vagus;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    Result<sim::Picture> picture =
        sim::read_png({reinterpret_cast<const char*>(data), size}, "fuzz.png");
    if (!picture.ok()) return 0;
    sim::Ground ground(2, 1, {1, 1, 1});
    ground.set_picture(std::move(picture.value()));
    for (const double at : {-1.0, 0.0, 0.7, 2.0, 5.0}) {
        const sim::Colour colour = ground.colour_at({at, at});
        if (!(colour.r >= 0 && colour.r <= 1)) std::abort();
    }
    return 0;
}
