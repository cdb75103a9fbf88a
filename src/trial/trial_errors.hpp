// How the Errors of a test that cannot be run begin: with what in it is wrong.
#pragma once

#include <string>

#include "base/json.hpp"
#include "base/result.hpp"
#include "trial/test_file.hpp"

namespace vagus::trial {

inline Error at_expectation(const TestFile& test, const Expectation& one, const std::string& what) {
    return {Code::BadInput, at_place(test.path, one.at, text_of(one) + ": " + what)};
}

// What the options of a run that it gives would be refused for, "--set speed=x: …", does not say
// where they come from.
inline Error in_test(const TestFile& test, const Error& error) {
    return {error.code, error.what.starts_with("--") ? test.path + ": " + error.what : error.what};
}

}  // namespace vagus::trial
