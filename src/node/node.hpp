// A node on the bus: the machine of vm.hpp, and around it everything else that a node answers: who
// is there, what it is called, which variables, events and natives it has
// (docs/spec/aseba-wire-and-vm.md, sections 2 and 3.6). Freestanding C++14: no heap, no library, no
// globals.
//
//     const vm::Config kConfig = {3, 1500, 600, 32, 32, bytecode, variables, stack, breakpoints,
//                                 &node::kMachineHost, &the_node};
//     node::init(the_node, kConfig, kDescription, kBoard, nullptr);
//     for (;;) {                                    // the loop of section 3.6
//         while (bus.read(frame)) node::receive(the_node, frame);
//         if (sensor.ready()) node::local_event(the_node, kProx);
//         if (node::run(the_node, 1000) == 0) sleep_until_interrupt();
//     }
//
// There is no queue: the newest event kills the one that is running, and says so. A node that is to
// finish one event before it looks at the next calls local_event() only when vm::is_active() is
// false.
//
// It does not know: time, sockets, pins, flash memory. It asks its Board.
#pragma once

#include <stdint.h>

#include "node/description.hpp"
#include "vm/vm.hpp"
#include "wire/frame.hpp"

namespace vagus {
namespace node {

// What the surroundings do for a node. All must be there; none may call receive, local_event, start
// or run of the same node.
struct Board {
    // A message for the bus as it is made, so that no node needs room for a whole one: begin, put
    // for each byte of the payload, at most wire::kPayloadMax, end. What was begun and then begun
    // again was not meant. With nobody connected it is thrown away. Boards that send whole frames
    // have frame_maker.hpp.
    void (*begin)(Node& node, uint16_t type);
    void (*put)(Node& node, uint8_t byte);
    void (*end)(Node& node);
    // See vm::Notice. A board that cannot keep bytecode, restart or sleep does nothing.
    void (*notify)(Node& node, vm::Notice notice);
    // Words of one Variables message: 1 to wire::kVariablesReplyWordsMax.
    uint16_t variables_at_once;
};

// Which program was loaded. Its words are counted in steps: no board needs to do all at once.
struct Identity {
    uint32_t checksum;  // of the words so far (wire/checksum.hpp)
    uint16_t end;       // words that were loaded, one piece behind the other
    uint16_t counted;   // of these, in the checksum
};

struct Node {
    vm::Vm vm;
    const Description* description;  // in flash on an AVR
    const Board* board;
    void* owner;            // for the board and its natives; the node does not touch it
    uint16_t random_state;  // of math.rand (section 4.4)
    uint16_t message_size;  // bytes of the payload that is being made
    // What is still to be sent of a description and of variables that a host has asked for.
    uint16_t next_item;
    uint16_t items_left;
    uint16_t next_variable;
    uint16_t variables_left;
    Identity identity;
};

// The `host` of the Config of a node's machine; its `owner` must be the Node.
extern const vm::Host kMachineHost;

// Makes a fresh node: idle, without a program, all variables 0. What it keeps a pointer to must
// live as long as it. The node's id is variable 0 by convention (section 3.10): a board that wants
// it there writes it.
void init(Node& node, const vm::Config& config, const Description& description, const Board& board,
          void* owner);

// A frame has come from the bus: answers it, obeys it, or ignores it. Never runs the script.
void receive(Node& node, const wire::Frame& frame);

// Words of the program are still to be counted: answer() does some, and sends nothing.
inline bool is_counting(const Node& node) {
    return node.identity.counted != node.identity.end;
}

// The same in pieces, for a board whose line takes only so much at once: only the first message of
// the answer is sent, and answer() sends one more for each call while is_answering(). `words` is
// the payload, `count` words: an odd last byte does not count. A command must wait until what was
// asked before it is answered.
void begin_receive(Node& node, uint16_t source, uint16_t type, const uint16_t* words,
                   uint16_t count);
inline bool is_answering(const Node& node) {
    return (node.items_left | node.variables_left) != 0 || is_counting(node);
}
void answer(Node& node);

// The node's local event `index` has happened. Ignored while the script is paused inside an event.
void local_event(Node& node, uint16_t index);

// Starts a program that lies in the bytecode already, in running mode: what a robot does when it is
// switched on and finds a program in its flash (section 3.1). The bus is told of the new state.
void start_program(Node& node);

// What the bytecode holds did not come from the bus, but from where the node keeps it: `count`
// words, before the first frame …
void identify(Node& node, uint16_t count);
// … or what program() gave when it was kept.
void identify_as(Node& node, uint32_t mark);
// What `_program` tells: wire::program_mark() of what was loaded, wire::kProgramUnknown if pieces
// came in another order than that of their words.
uint32_t program(const Node& node);

// Goes on with the running event for at most `limit` instructions; gives how many were executed.
uint16_t run(Node& node, uint16_t limit);

// The host has gone: its breakpoints go with it (section 1.4), all else stays.
void host_left(Node& node);

// Sends `text` as a NodeSpecificError without stopping the script: a report, for instance of
// WriteBytecode. In flash on an AVR.
void report(Node& node, const char* text);

}  // namespace node
}  // namespace vagus
