#include "conformance/checks.hpp"

namespace vagus::conformance {

Checks all_checks() {
    Checks checks;
    add_description_checks(checks);
    add_message_checks(checks);
    add_opcode_checks(checks);
    return checks;
}

}  // namespace vagus::conformance
