// The list of all checks, in the order in which they are made: what a node of the reference might
// not survive comes last.
#pragma once

#include "conformance/check.hpp"

namespace vagus::conformance {

// Its checks overwrite what the node keeps over a restart: made only if that is wanted.
constexpr const char* kFlashGroup = "flash";
// Its check sends a node that can sleep to sleep: made only if that is wanted, and last.
constexpr const char* kSleepGroup = "sleep";

// Each group adds its own.
void add_description_checks(Checks& checks);
void add_message_checks(Checks& checks);
void add_opcode_checks(Checks& checks);
void add_operator_checks(Checks& checks);
void add_native_checks(Checks& checks);
void add_native_fault_checks(Checks& checks);
void add_event_checks(Checks& checks);
void add_fault_checks(Checks& checks);
void add_control_checks(Checks& checks);
void add_breakpoint_checks(Checks& checks);
void add_program_checks(Checks& checks);
void add_flash_checks(Checks& checks);
void add_limit_checks(Checks& checks);
void add_stack_checks(Checks& checks);
void add_sleep_checks(Checks& checks);

Checks all_checks();

}  // namespace vagus::conformance
