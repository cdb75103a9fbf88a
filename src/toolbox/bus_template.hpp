// Templates whose work is done by scripts on nodes: what they declare, and the code that stands for
// them in a plan (docs/formats.md, "Toolbox file"). Command and answer travel as events whose first
// argument is a token; what carries another token belongs to something that is over.
//
//     library.add(file.name, file.help, code_of(file, parts));
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "plan/template.hpp"
#include "run/code.hpp"
#include "toolbox/bus_talk.hpp"
#include "toolbox/parts.hpp"
#include "toolbox/safe_stop.hpp"

namespace vagus::toolbox {

constexpr Duration kAlivePeriod = std::chrono::milliseconds(100);

// How a value travels: times `scale`, rounded half away from zero, in that many words, the low word
// first. There is one for each input and each output of the template, in its order.
struct BusValue {
    double scale = 1;
    int words = 1;  // or 2
};

// A state or event of the template: `event` brings it, with these outputs behind its token.
struct BusOutcome {
    std::string event;
    std::vector<size_t> outputs;
};

struct BusTemplate {
    plan::Template declared;
    NodeNames nodes;
    std::vector<BusValue> inputs;
    std::vector<BusValue> outputs;
    std::vector<BusOutcome> outcomes;
    std::string start;
    std::string stop;     // empty: nobody needs to be told
    std::string stopped;  // an actor's answer to `stop`
    std::string alive;    // empty: none; an actor's sign of life
    std::string ended;    // empty: none; says that the node has ended an actor's work by itself
};

struct ToolboxFile {
    std::string name;
    std::string help;
    std::string project;  // as it is written
    std::vector<BusTemplate> templates;
    SafeStop safe_stop;
};

// The parts are borrowed by the code.
std::vector<run::Coded> code_of(const ToolboxFile& file, const Parts& parts);

// All events that the template sends or waits for; not `ended`, which a project may do without.
std::vector<std::string> events_of(const BusTemplate& of);

// ---- values on the bus ----

// Appends a value of the input to `words`; the Error names the input, the value and what it may be.
Status encode(const plan::Input& input, const BusValue& as, const plan::Value& value,
              std::vector<int16_t>& words);
// The value of the `words` at `at`, which are there.
plan::Value decode(plan::Type type, const BusValue& as, const int16_t* at);

}  // namespace vagus::toolbox
