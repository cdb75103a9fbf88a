#include "session/software_natives.hpp"

#include <algorithm>
#include <set>
#include <string>

#include "node/fixed_math.hpp"
#include "node/natives.hpp"
#include "node/node.hpp"

namespace vagus::session {

namespace {

void nop(node::Node&) {}

// dest = the sum of all words of src, wrapped. src has any size, so its size is an argument, too.
void sum(node::Node& node) {
    const uint16_t dest = vm::pop(node.vm);
    const uint16_t src = vm::pop(node.vm);
    const uint16_t size = vm::pop(node.vm);
    int16_t* result = vm::memory(node.vm, dest, 1);
    const int16_t* words = vm::memory(node.vm, src, size);
    if (result == nullptr || words == nullptr) return;
    uint32_t total = 0;
    for (uint16_t i = 0; i < size; ++i) total += static_cast<uint16_t>(words[i]);
    *result = node::wrap16(total);
}

constexpr node::Parameter kSumParameters[] = {{1, "dest"}, {0, "src"}};
constexpr node::Native kOwnNatives[] = {{"sys.nop", "", nullptr, 0, nop},
                                        {"sys.sum", "", kSumParameters, 2, sum}};

const node::Native* find_native(std::string_view name) {
    const auto has_name = [name](const node::Native& native) { return name == native.name; };
    const auto standard = std::ranges::find_if(node::kStandardNatives, has_name);
    if (standard != std::end(node::kStandardNatives)) return standard;
    const auto own = std::ranges::find_if(kOwnNatives, has_name);
    return own != std::end(kOwnNatives) ? own : nullptr;
}

// What a caller pushes: an address for each parameter, a size for each template and each parameter
// of any size (docs/spec/aseba-wire-and-vm.md, section 4.1).
template <typename Parameters>
size_t words_pushed(const Parameters& parameters) {
    size_t words = parameters.size();
    std::set<int16_t> templates;
    for (const auto& parameter : parameters) {
        if (parameter.size == 0) ++words;
        if (parameter.size < 0) templates.insert(parameter.size);
    }
    return words + templates.size();
}

}  // namespace

Result<const node::Native*> code_of_native(const aesl::NativeFunction& native) {
    const node::Native* found = find_native(native.name);
    if (found == nullptr) {
        return Error{Code::NotFound,
                     "native " + native.name +
                         " has no code in a software node; those with code are the 30 standard "
                         "ones (math.*, deque.*), sys.nop and sys.sum: take it out of the node"};
    }
    const std::vector<node::Parameter> own(found->parameters,
                                           found->parameters + found->parameter_count);
    const size_t expected = words_pushed(own);
    const size_t declared = words_pushed(native.parameters);
    if (expected == declared) return found;
    return Error{Code::BadInput, "native " + native.name + " takes " + std::to_string(expected) +
                                     " words from the stack (addresses and sizes), but its "
                                     "parameters here make " +
                                     std::to_string(declared) +
                                     ": declare it as in the table of standard natives"};
}

}  // namespace vagus::session
