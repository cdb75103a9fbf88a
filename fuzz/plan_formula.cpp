// Any text as a formula: a sentence, or a formula whose value has the type that was foretold, for
// values of every type.
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>
#include <vector>

#include "plan/formula.hpp"

using namespace vagus;
using plan::Value;

namespace {

const std::array<Value, 8>& samples() {
    static const std::array<Value, 8> kSamples = {
        Value(true), Value(int64_t{7}),         Value(INT64_MIN),          Value(2.5),
        Value(-0.0), Value(std::string("1e3")), Value(std::string("abc")), Value(plan::Object()),
    };
    return kSamples;
}

// Variables get the samples from this one on.
void try_values(const plan::Formula& formula, size_t first) {
    std::vector<Value> values;
    std::vector<plan::Type> types;
    for (size_t i = 0; i < formula.names().size(); ++i) {
        values.push_back(samples().at((first + i) % samples().size()));
        types.push_back(values.back().type());
    }
    const Result<plan::Type> type = formula.type(types);
    if (!type.ok() && type.error().what.empty()) std::abort();
    const Result<Value> value = formula.evaluate(values);
    if (!value.ok() && value.error().what.empty()) std::abort();
    // Without an object where none can be, a value has the type that was foretold.
    if (type.ok() && value.ok() && value.value().type() != type.value()) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    const Result<plan::Formula> formula = plan::parse_formula(text);
    if (!formula.ok()) {
        if (formula.error().what.empty()) std::abort();
        return 0;
    }
    for (size_t first = 0; first < samples().size(); ++first) try_values(formula.value(), first);
    return 0;
}
