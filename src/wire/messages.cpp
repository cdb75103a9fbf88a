#include "wire/messages.hpp"

namespace vagus {
namespace wire {

const char* message_name(uint16_t type) {
    switch (type) {
#define MESSAGE(name, number, sender) \
    case number:                      \
        return #name;
#include "wire/messages.def"
#undef MESSAGE
        default:  // types come from outside: most of the 65536 have no name
            return nullptr;
    }
}

}  // namespace wire
}  // namespace vagus
