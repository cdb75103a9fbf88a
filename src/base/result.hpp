// The two ways a function can end when the world does not cooperate: a value, or an Error that says
// why not. Bugs are asserts, never Errors. Errors that a user sees name the thing, the place, what
// was expected, what was found and how to fix it, all in `what`.
#pragma once

#include <cassert>
#include <string>
#include <utility>
#include <variant>

namespace vagus {

// What kind of failure: for programs to act on. The sentence is for people.
enum class Code {
    BadInput,     // text or bytes from outside that do not fit their format
    NotFound,     // a file, node, variable, event … of that name does not exist
    Unavailable,  // a device, port or peer cannot be reached now
    Limit,        // a named limit would be passed
    Timeout,      // no answer within the time given
    Refused,      // the thing exists but does not allow this
};

struct [[nodiscard]] Error {
    Code code;
    std::string what;
};

// A T, or the Error that says why there is none.
template <typename T>
class [[nodiscard]] Result {
public:
    Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}
    Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}

    bool ok() const { return state_.index() == 0; }
    T& value() {
        assert(ok());
        return *std::get_if<0>(&state_);
    }
    const T& value() const {
        assert(ok());
        return *std::get_if<0>(&state_);
    }
    const Error& error() const {
        assert(!ok());
        return *std::get_if<1>(&state_);
    }

private:
    std::variant<T, Error> state_;
};

// For functions that give nothing but may fail: `return Status::done();`
struct Done {};
class [[nodiscard]] Status : public Result<Done> {
public:
    using Result<Done>::Result;
    static Status done() { return Status(Done{}); }
};

}  // namespace vagus

// The value of `expression`, or return its Error from the function around. The only macro that
// alters control flow.
#define TRY(expression)                                  \
    __extension__({                                      \
        auto&& try_result = (expression);                \
        if (!try_result.ok()) return try_result.error(); \
        std::move(try_result.value());                   \
    })
