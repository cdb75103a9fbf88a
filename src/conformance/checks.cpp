#include "conformance/checks.hpp"

namespace vagus::conformance {

Checks all_checks() {
    Checks checks;
    add_description_checks(checks);
    add_message_checks(checks);
    add_opcode_checks(checks);
    add_operator_checks(checks);
    add_native_checks(checks);
    add_native_fault_checks(checks);
    add_event_checks(checks);
    add_fault_checks(checks);
    add_control_checks(checks);
    add_breakpoint_checks(checks);
    add_program_checks(checks);
    add_flash_checks(checks);
    add_limit_checks(checks);
    add_stack_checks(checks);
    add_sleep_checks(checks);
    return checks;
}

}  // namespace vagus::conformance
