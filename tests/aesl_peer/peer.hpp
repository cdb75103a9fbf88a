// A case through Debian's compiler and machine (libasebacompiler, libasebavm), as an Outcome.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "aesl/node_file.hpp"
#include "reference/outcome.hpp"

namespace vagus::aesl {

struct PeerProgram {
    std::vector<uint16_t> bytecode;
    std::vector<int> lines;                                      // from 1
    std::map<std::string, std::pair<size_t, size_t>> variables;  // address and size
    std::optional<CompileError> error;
};

// Debian's compiler with its node and definitions set up, for more than one program.
class PeerCompiler {
public:
    explicit PeerCompiler(const NodeFile& node);
    ~PeerCompiler();
    PeerCompiler(const PeerCompiler&) = delete;
    PeerCompiler& operator=(const PeerCompiler&) = delete;

    PeerProgram compile(const std::string& source);
    // Nothing but the compiler's work, for benchmarks: whether it found no error.
    bool compiles(const std::wstring& source);

private:
    struct Insides;
    std::unique_ptr<Insides> insides_;
};

// UTF-8 as the compiler wants it.
std::wstring widened(std::string_view text);

// Compiles and runs. One at a time: the machine's surroundings are global functions.
Outcome run_peer(PeerCompiler& compiler, const Case& program, const NodeFile& node);

}  // namespace vagus::aesl
