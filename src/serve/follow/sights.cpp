#include "serve/follow/sights.hpp"

#include "serve/bytes.hpp"

namespace vagus::serve {

std::string rays_payload(std::string_view looks, std::string_view lamps) {
    std::string bytes;
    append(bytes, static_cast<uint16_t>(looks.size() / kLookBytes));
    append(bytes, static_cast<uint16_t>(lamps.size() / kLampBytes));
    return bytes.append(looks).append(lamps);
}

}  // namespace vagus::serve
