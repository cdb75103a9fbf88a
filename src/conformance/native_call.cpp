#include "conformance/native_call.hpp"

#include <algorithm>
#include <map>

#include "conformance/standard_natives.hpp"

namespace vagus::conformance {
namespace {

// The length of each template, by its number.
std::map<int16_t, size_t> template_sizes(const Values& sizes,
                                         const std::vector<Values>& arguments) {
    std::map<int16_t, size_t> lengths;
    for (size_t i = 0; i < sizes.size(); i++)
        if (sizes[i] < 0) lengths[sizes[i]] = arguments[i].size();
    return lengths;
}

}  // namespace

Result<Instructions> native_call(const Bench& bench, const std::string& name,
                                 const std::vector<Values>& arguments, uint16_t at) {
    const uint16_t id = TRY(bench.native(name));
    const auto all = standard_natives();
    const auto standard = std::ranges::find(all, name, &StandardNative::name);
    Instructions code;
    // Rising: the last template, -2, comes before -1.
    for (const auto& [number, length] : template_sizes(standard->sizes, arguments))
        code.push(static_cast<int>(length));
    size_t address = at;
    for (const Values& argument : arguments) address += argument.size();
    for (auto argument = arguments.rbegin(); argument != arguments.rend(); ++argument) {
        address -= argument->size();
        code.push(static_cast<int>(address));
    }
    code.native(id);
    return code;
}

}  // namespace vagus::conformance
