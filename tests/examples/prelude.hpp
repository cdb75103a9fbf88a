// What examples in comments take for granted: verbs of the program around them, which may be called
// with anything and give anything. An example that needs one with a real type declares it in its
// context (extract.py); that hides the one here.
#pragma once

#include <chrono>

namespace vagus::examples {

using namespace std::chrono_literals;

// The `…` of an example, where a value is expected.
struct Any {
    template <typename T>
    operator T() const;
};

#define VAGUS_EXAMPLE_VERB(name) Any name(const auto&...);
VAGUS_EXAMPLE_VERB(act)
VAGUS_EXAMPLE_VERB(answer)
VAGUS_EXAMPLE_VERB(ask)
VAGUS_EXAMPLE_VERB(complain)
VAGUS_EXAMPLE_VERB(draw)
VAGUS_EXAMPLE_VERB(hear)
VAGUS_EXAMPLE_VERB(mark)
VAGUS_EXAMPLE_VERB(obey)
VAGUS_EXAMPLE_VERB(perform)
VAGUS_EXAMPLE_VERB(print)
VAGUS_EXAMPLE_VERB(reply)
VAGUS_EXAMPLE_VERB(report)
VAGUS_EXAMPLE_VERB(say)
VAGUS_EXAMPLE_VERB(see)
VAGUS_EXAMPLE_VERB(send)
VAGUS_EXAMPLE_VERB(show)
VAGUS_EXAMPLE_VERB(tell)
VAGUS_EXAMPLE_VERB(use)
#undef VAGUS_EXAMPLE_VERB

}  // namespace vagus::examples
