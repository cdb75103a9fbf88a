// A node's description while it arrives in parts: a header with three counts, then as many
// variables, local events and native functions (wire spec, 2.2 and 2.6).
#pragma once

#include "debug/network.hpp"
#include "wire/messages.hpp"

namespace vagus::debug {

enum class Progress {
    Ignored,     // more than was announced: a second host has asked too
    More,        // taken, more to come
    Complete,    // taken, the last one
    Impossible,  // cannot be right: why() says what
};

class Description {
public:
    // Begins with the header; Impossible is possible at once, and so is Complete.
    Progress begin(const wire::Description& header);
    Progress add(const wire::NamedVariableDescription& variable);
    Progress add(const wire::LocalEventDescription& event);
    Progress add(const wire::NativeFunctionDescription& native);

    bool begun() const { return begun_; }
    bool complete() const;
    // Parts that arrived, of those announced: the number of the next fragment (2.9).
    size_t items() const;
    // Bytes of names and texts so far.
    size_t bytes() const { return bytes_; }
    // Once complete(): what was told, which is kept no longer; of it only the header stays.
    aesl::Target give();
    const std::string& why() const { return why_; }
    // Announces the same node as this one.
    bool same_header(const wire::Description& header) const;

private:
    Progress progress();
    std::string take(wire::Text text);

    bool begun_ = false;
    size_t variables_ = 0, local_events_ = 0, natives_ = 0;  // announced
    size_t words_ = 0;                                       // of the variables so far
    size_t bytes_ = 0;
    aesl::Target target_;
    std::string why_;
};

}  // namespace vagus::debug
