#include "session/standard_target.hpp"

#include "node/natives.hpp"
#include "wire/protocol.hpp"

namespace vagus::session {

aesl::Target standard_target(std::string name) {
    aesl::Target target;
    target.name = std::move(name);
    target.protocol_version = wire::kProtocolVersion;
    target.bytecode_size = 512;
    target.variables_size = 1060;
    target.stack_size = 64;
    target.variables = {
        {"id", 1}, {"source", 1}, {"args", 32}, {"_productId", 1}, {"timer.period", 1}};
    target.local_events = {{"timer", "every timer.period milliseconds, if that is above 0"}};
    target.natives = standard_natives();
    return target;
}

std::vector<aesl::NativeFunction> standard_natives() {
    std::vector<aesl::NativeFunction> natives;
    for (const node::Native& native : node::kStandardNatives) {
        aesl::NativeFunction function{native.name, native.doc, {}};
        for (uint16_t i = 0; i < native.parameter_count; ++i) {
            function.parameters.push_back({native.parameters[i].name, native.parameters[i].size});
        }
        natives.push_back(std::move(function));
    }
    return natives;
}

}  // namespace vagus::session
