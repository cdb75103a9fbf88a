#include "cli/options.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <utility>

#include "base/nearest.hpp"
#include "base/text.hpp"

namespace vagus::cli {
namespace {

constexpr double kSecondsMax = 1e9;  // some thirty years

aesl::Dialect dialect_of(const std::string& word) {
    if (word == "modern") return aesl::Dialect::Modern;
    return word == "2007" ? aesl::Dialect::Year2007 : aesl::Dialect::Auto;
}

}  // namespace

std::string one_of(const std::vector<std::string>& words) {
    std::string text;
    for (size_t i = 0; i < words.size(); i++) {
        text += (i == 0 ? "" : i + 1 == words.size() ? " or " : ", ") + words[i];
    }
    return text;
}

void takes_one_of(CLI::Option& option, std::vector<std::string> words) {
    std::string kinds;
    for (const std::string& word : words) kinds += (kinds.empty() ? "" : "|") + word;
    option.type_name(kinds);
    option.check(CLI::Validator(
        [words](std::string& given) -> std::string {
            if (std::find(words.begin(), words.end(), given) != words.end()) return "";
            const std::string guess = nearest(given, words);
            return "expected " + one_of(words) + ", found \"" + given + "\"" +
                   (guess.empty() ? "" : "; did you mean " + guess + "?");
        },
        ""));
}

void takes_whole_number(CLI::Option& option, int64_t low, uint64_t high) {
    option.check(CLI::Validator(
        [low, high](std::string& given) -> std::string {
            const char* end = given.data() + given.size();
            int64_t below = 0;
            uint64_t above = 0;
            const bool negative = given.starts_with('-');
            const auto read = negative ? std::from_chars(given.data(), end, below)
                                       : std::from_chars(given.data(), end, above);
            const bool whole = !given.empty() && read.ec == std::errc() && read.ptr == end;
            const bool fits =
                negative ? below >= low : std::cmp_greater_equal(above, low) && above <= high;
            if (whole && fits) return "";
            return "expected a whole number from " + std::to_string(low) + " to " +
                   std::to_string(high) + ", found \"" + given + "\"";
        },
        ""));
}

void takes_seconds(CLI::Option& option, Seconds kind) {
    option.type_name("S");
    option.check(CLI::Validator(
        [kind](std::string& given) -> std::string {
            char* end = nullptr;
            const double seconds = std::strtod(given.c_str(), &end);
            const bool number = !given.empty() && *end == '\0';
            const bool begun = kind == Seconds::Instant ? seconds >= 0 : seconds > 0;
            if (number && begun && seconds <= kSecondsMax) return "";
            return fmt::format("expected a number of seconds {}, found \"{}\"",
                               kind == Seconds::Instant ? "from 0 on" : "above 0", given);
        },
        ""));
}

void add_seed_option(CLI::App& verb, std::optional<uint64_t>& seed, const std::string& help) {
    verb.add_option_function<std::string>(
            "--seed",
            [&seed](const std::string& text) {
                seed = decimal_number(text);
                if (seed) return;
                throw CLI::ValidationError("--seed", "expected a whole number from 0 to " +
                                                         std::to_string(UINT64_MAX) +
                                                         " in digits, found \"" + text + "\"");
            },
            help)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeLast)
        ->type_name("N");
}

void takes_file(CLI::Option& option, std::vector<std::string> endings) {
    std::string kinds = "FILE";
    for (const std::string& ending : endings) kinds += (kinds == "FILE" ? "(" : "|") + ending;
    option.type_name(endings.empty() ? kinds : kinds + ")");
}

void add_toolbox_option(CLI::App& verb, std::vector<std::string>& files) {
    takes_file(
        *verb.add_option(
                 "--toolbox", files,
                 "more templates: a toolbox file or a shared library; can be given several times")
             ->allow_extra_args(false),
        {".toolbox.json", ".so"});
}

void add_record_options(CLI::App& verb, std::string& file, bool& camera) {
    CLI::Option* const record =
        verb.add_option("--record", file, "records the run, to be run again by `vagus replay`");
    takes_file(*record, {".mcap"});
    verb.add_flag("--record-camera", camera,
                  "beside a world, with --record: also what the robots' cameras see, ten pictures "
                  "a second")
        ->needs(record);
}

void add_dialect_options(CLI::App& verb, aesl::Options& options) {
    CLI::Option* dialect = verb.add_option_function<std::string>(
        "--dialect", [&options](const std::string& word) { options.dialect = dialect_of(word); },
        "the language of the script; auto looks at the text");
    takes_one_of(*dialect, {"auto", "modern", "2007"});
    verb.add_option("--ontimer", options.ontimer,
                    "the local event that `ontimer` means in scripts of 2007")
        ->type_name("EVENT");
}

void add_certificate_options(CLI::App& verb, const CertificateOptions& names,
                             std::string& certificate, std::string& key) {
    CLI::Option* const its_certificate =
        verb.add_option(names.certificate, certificate, "PEM: " + names.help);
    CLI::Option* const its_key = verb.add_option(names.key, key, "PEM: its key");
    takes_file(*its_certificate, {".crt", ".pem"});
    takes_file(*its_key, {".key", ".pem"});
    its_certificate->needs(its_key);
    its_key->needs(its_certificate);
}

}  // namespace vagus::cli
