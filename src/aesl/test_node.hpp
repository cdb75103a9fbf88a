// The node that the compiler's tests compile for, and short ways to say what a program must give.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <vector>

#include "aesl/compile.hpp"

namespace vagus::aesl {

inline std::string repeated(std::string_view text, int count) {
    std::string all;
    for (int i = 0; i < count; ++i) all += text;
    return all;
}

// User variables start at address 40, as on the node of the golden vectors.
inline Target test_target() {
    Target target;
    target.name = "rover";
    target.bytecode_size = 600;
    target.variables_size = 200;
    target.stack_size = 32;
    target.variables = {{"id", 1},   {"event.source", 1}, {"event.args", 32},
                        {"prox", 4}, {"motor.left", 1},   {"motor.right", 1}};
    target.local_events = {{"tick", ""}, {"button", ""}};
    target.natives = {{"math.fill", "", {{"dest", -1}, {"value", 1}}},
                      {"math.copy", "", {{"dest", -1}, {"src", -1}}},
                      {"sys.sum", "", {{"dest", 1}, {"src", 0}}},
                      {"sys.nop", "", {}},
                      {"math.sqrt", "", {{"dest", -1}, {"x", -1}}}};
    return target;
}

inline CommonDefinitions test_common() {
    return {.events = {{"ping", 0}, {"report", 1}, {"triple", 3}},
            .constants = {{"LIMIT", 10}, {"ZERO", 0}, {"HUGE", 40000}}};
}

inline Compilation compile_here(std::string_view source, const Options& options = {}) {
    return compile(source, test_target(), test_common(), options);
}

inline std::string place_and_code(const Diagnostic& diagnostic) {
    return std::to_string(diagnostic.at.line) + ":" + std::to_string(diagnostic.at.column) + " " +
           diagnostic.code;
}

// "3:5 ARRAY_SIZE_MISMATCH" for each error, in the order of the text.
inline std::vector<std::string> errors_of(std::string_view source) {
    std::vector<std::string> errors;
    for (const Diagnostic& error : compile_here(source).errors) {
        errors.push_back(place_and_code(error));
    }
    return errors;
}

// The one that section 3.2 selects.
inline std::string first_error_of(std::string_view source) {
    const Compilation done = compile_here(source);
    return done.ok() ? "none" : place_and_code(done.first_error());
}

inline std::vector<std::string> warnings_of(std::string_view source) {
    const Compilation done = compile_here(source);
    EXPECT_TRUE(done.ok()) << done.errors[0].message;
    std::vector<std::string> warnings;
    for (const Diagnostic& warning : done.warnings) {
        warnings.push_back(place_and_code(warning));
    }
    return warnings;
}

// The sentence of the first error.
inline std::string sentence_of(std::string_view source) {
    const Compilation done = compile_here(source);
    return done.ok() ? "no error" : done.first_error().message;
}

using List = std::vector<std::string>;

}  // namespace vagus::aesl
