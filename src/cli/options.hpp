// Options that several verbs share, with the same words and the same checks.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include "aesl/compile.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace vagus::cli {

// `--dialect auto|modern|2007` and `--ontimer EVENT` (docs/spec/aesl-language.md, section 6).
void add_dialect_options(CLI::App& verb, aesl::Options& options);

// "a, b or c"
std::string one_of(const std::vector<std::string>& words);

// The option takes one of these words; anything else is answered with the list and the nearest of
// them. The words are also what the shell completes.
void takes_one_of(CLI::Option& option, std::vector<std::string> words);

// The option takes whole numbers of this range; anything else is answered with the range and what
// was found.
void takes_whole_number(CLI::Option& option, int64_t low, uint64_t high);

// The option takes seconds: of a time that passes those above 0; of an instant, or of a wait, 0 as
// well. What is no such number, as nan, is answered with what was found.
enum class Seconds { Passing, Instant };
void takes_seconds(CLI::Option& option, Seconds kind);

// `--toolbox FILE`, as often as wanted.
void add_toolbox_option(CLI::App& verb, std::vector<std::string>& files);

// `--seed N`: decimal digits of a number below 2^64; the last one holds.
void add_seed_option(CLI::App& verb, std::optional<uint64_t>& seed, const std::string& help);

// `--record FILE.mcap` and `--record-camera`.
void add_record_options(CLI::App& verb, std::string& file, bool& camera);

// The option takes the path of a file or folder: the shell completes it, with these endings first
// (".aesl").
void takes_file(CLI::Option& option, std::vector<std::string> endings);

// A certificate and its key, two files in PEM; neither without the other. `help`: of the
// certificate.
struct CertificateOptions {
    std::string certificate, key;  // their names: "--tls-cert"
    std::string help;
};
void add_certificate_options(CLI::App& verb, const CertificateOptions& names,
                             std::string& certificate, std::string& key);

}  // namespace vagus::cli
