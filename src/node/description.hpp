// What a node tells about itself: constant tables of its variables, local events and native
// functions (docs/spec/aseba-wire-and-vm.md, sections 2.2 and 5). A robot writes them as constants,
// a host builds them at run time; on an AVR all of them, texts included, lie in flash.
//
//     VAGUS_FLASH_TEXT(kName, "blinker");
//     VAGUS_FLASH_TEXT(kId, "_id");
//     VAGUS_FLASH_TABLE(node::Variable, kVariables, 1) = {{1, kId}};
//     VAGUS_FLASH_TABLE(node::Description, kDescription, 1) = {
//         {kName, wire::kProtocolVersion, node::LocalEventSource::OwnId, 1, kVariables, 0, nullptr,
//          {{node::kStandardNatives, node::kStandardNativeCount}, {nullptr, 0}}, 0}};
//
// Texts end with '\0'. One that is too long for its message is cut there, at the border of a
// character.
#pragma once

#include <stdint.h>

namespace vagus {
namespace node {

struct Node;

// One named variable. They lie from address 0, one behind the other (section 3.10).
struct Variable {
    uint16_t size;  // words
    const char* name;
};

// The k-th of them has event id 0xfffe - k.
struct LocalEvent {
    const char* name;
    const char* doc;
};

struct Parameter {
    int16_t size;  // > 0 words; < 0 number of a template; 0 any size, which is then passed too
    const char* name;
};

// Pops all its arguments exactly once, also when it then fails (section 4.1 and vm.hpp, "For
// natives").
typedef void (*NativeFunction)(Node& node);

struct Native {
    const char* name;
    const char* doc;
    const Parameter* parameters;
    uint16_t parameter_count;  // at most wire::kParametersMax are told to hosts
    NativeFunction function;
};

struct NativeTable {
    const Native* natives;
    uint16_t count;
};

// Does a local event leave the node's own id in event.source? Robots do it; others keep what was
// there (section 3.6).
enum class LocalEventSource : uint8_t { Kept, OwnId };

struct Description {
    const char* name;
    uint16_t protocol_version;
    LocalEventSource local_event_source;
    uint16_t variable_count;
    const Variable* variables;
    uint16_t local_event_count;
    const LocalEvent* local_events;
    // Ids count through both tables: usually the 30 standard natives, then the node's own.
    NativeTable natives[2];
    // Where `_program` lies, the last variable, of two words (docs/vm.md); 0: it has none.
    uint16_t program_at;
};

}  // namespace node
}  // namespace vagus
