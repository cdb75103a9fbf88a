// What the table of vectors of every Cortex-M board is made of.
#pragma once

#include <stdint.h>

extern "C" {

void start();
void fault();               // of the processor, and interrupts that a board does not take
extern uint32_t stack_top;  // of the linker script

typedef void (*Handler)();

}  // extern "C"
