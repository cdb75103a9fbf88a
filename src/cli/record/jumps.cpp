#include "cli/record/jumps.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <iostream>
#include <optional>
#include <sstream>

#include "base/file.hpp"
#include "base/json.hpp"
#include "base/seconds.hpp"
#include "base/text.hpp"
#include "cli/output.hpp"
#include "record/keyframes.hpp"
#include "record/recorder.hpp"

namespace vagus::cli {

namespace {

using record::Keyframes;

constexpr double kSecondsMax = 1e9;

std::optional<Time> instant_in(std::string_view line) {
    double seconds = 0;
    const char* const end = line.data() + line.size();
    const auto read = std::from_chars(line.data(), end, seconds);
    const bool good = read.ec == std::errc() && read.ptr == end && std::abs(seconds) <= kSecondsMax;
    return good ? std::optional(from_seconds(seconds)) : std::nullopt;
}

std::string text_of(const Keyframes::Look& look) {
    const std::string from = look.from ? fmt::format("from {:.3f} s", seconds_of(*look.from))
                                       : std::string("from the beginning");
    return fmt::format("{:11.3f} s  {}  {}\n", seconds_of(look.at), record::state_hash(look.text),
                       from);
}

std::string json_of(const Keyframes::Look& look) {
    return fmt::format("{{\"t\":{},\"state\":\"{}\",\"from\":{},\"check\":{}}}\n",
                       seconds_text(look.at), record::state_hash(look.text),
                       look.from ? seconds_text(*look.from) : "null", look.text);
}

class Answering {
public:
    Answering(Keyframes& keyframes, const JumpsOptions& options)
        : keyframes_(keyframes), options_(options) {}

    int all_of(std::istream& lines) {
        int exit_code = kExitDone;
        std::string line;
        for (size_t number = 1; std::getline(lines, line); ++number) {
            const std::string_view text = trimmed(line, " \t\r");
            if (text.empty()) continue;
            const Status answered = answer(text);
            if (!answered.ok()) {
                exit_code =
                    complain(fmt::format("line {}: {}", number, answered.error().what), kExitUsage);
            }
            say_why_none();
        }
        return exit_code;
    }

    // Once: it may be found out on the way.
    void say_why_none() {
        if (said_ || keyframes_.why_none().empty()) return;
        said_ = true;
        complain("each jump runs again from the beginning: " + keyframes_.why_none());
    }

private:
    Status answer(std::string_view text) {
        const auto at = text.size() <= kJumpLineMax ? instant_in(text) : std::nullopt;
        if (!at) {
            return Error{Code::BadInput, "expected an instant in seconds, as 82.5, found " +
                                             json_quote(std::string(text.substr(0, kJumpLineMax)))};
        }
        const Keyframes::Look look = TRY(keyframes_.look(*at));
        print(options_.json ? json_of(look) : text_of(look));
        return Status::done();
    }

    Keyframes& keyframes_;
    const JumpsOptions& options_;
    bool said_ = false;
};

}  // namespace

int tell_jumps(const mcap::Reader& reader, const JumpsOptions& options) {
    const auto keyframes =
        Keyframes::open(reader, [](record::Rerun& run, Time at) { return run.check_at(at); });
    if (!keyframes.ok()) return complain(keyframes.error(), kExitUsage);
    Answering answering(*keyframes.value(), options);
    answering.say_why_none();
    if (options.list == "-") return answering.all_of(std::cin);
    const auto list = read_file(options.list);
    if (!list.ok()) {
        return complain(fmt::format("--jumps {}; name a file of instants in seconds, one a line, "
                                    "or - for the standard input",
                                    list.error().what),
                        kExitUsage);
    }
    std::istringstream lines(list.value());
    return answering.all_of(lines);
}

}  // namespace vagus::cli
