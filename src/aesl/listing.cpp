#include "aesl/listing.hpp"

#include <algorithm>
#include <cstdio>
#include <vector>

#include "isa/isa.hpp"

namespace vagus::aesl {
namespace {

using isa::Opcode;

struct OpcodeInfo {
    const char* name;
    size_t words;
};

constexpr OpcodeInfo kOpcodes[] = {
#define OP(name, opcode, words, popped, pushed) {#name, words},
#include "isa/opcodes.def"
#undef OP
};

constexpr const char* kBinaryOperators[] = {
#define BINARY(name, code, symbol) symbol,
#include "isa/operators.def"
#undef BINARY
};

constexpr const char* kUnaryOperators[] = {
#define UNARY(name, code, symbol) symbol,
#include "isa/operators.def"
#undef UNARY
};

std::vector<std::string_view> lines_of(std::string_view source) {
    std::vector<std::string_view> lines;
    while (!source.empty()) {
        const size_t end = source.find('\n');
        std::string_view line = source.substr(0, end);
        if (line.ends_with('\r')) line.remove_suffix(1);
        lines.push_back(line);
        if (end == source.npos) break;
        source.remove_prefix(end + 1);
    }
    return lines;
}

class Listing {
public:
    Listing(const Program& program, std::string_view source, const Target& target,
            const CommonDefinitions& common, int first_line)
        : program_(program),
          target_(target),
          common_(common),
          lines_(lines_of(source)),
          first_line_(first_line) {
        for (const VariablePlace& variable : program.variables) {
            variables_end_ =
                std::max<size_t>(variables_end_, size_t{variable.address} + variable.size);
        }
    }

    std::string run() {
        summary();
        event_table();
        while (at_ < program_.bytecode.size()) {
            section_header();
            source_line();
            instruction();
        }
        return std::move(text_);
    }

private:
    template <typename... Values>
    void print(const char* format, Values... values) {
        char line[200];
        std::snprintf(line, sizeof line, format, values...);
        text_ += line;
    }

    uint16_t word(size_t address) const {
        return address < program_.bytecode.size() ? program_.bytecode[address] : uint16_t{0};
    }

    void summary() {
        print("%u of %u words of bytecode, %u of %u words of variables, %u of %u words of stack\n",
              program_.used.bytecode, target_.bytecode_size, program_.used.variables,
              target_.variables_size, program_.used.stack, target_.stack_size);
    }

    void event_table() {
        if (program_.bytecode.empty()) return;
        print("\n%5d  %04x            event table of %u words\n", 0, word(0), word(0));
        at_ = 1;
        while (at_ + 1 < program_.bytecode.size() && at_ < word(0)) {
            print("%5zu  %04x %04x       ", at_, word(at_), word(at_ + 1));
            text_ += event_name(word(at_));
            print(" at %u\n", word(at_ + 1));
            at_ += 2;
        }
    }

    std::string event_name(uint16_t id) const {
        if (id == isa::kInitEvent) return "initialisation";
        if (id < common_.events.size()) return "onevent " + common_.events[id].name;
        const size_t local = size_t{isa::kLocalEventFirst} - id;
        if (local < target_.local_events.size())
            return "onevent " + target_.local_events[local].name;
        return "event " + std::to_string(id);
    }

    // A title where the code of an event or sub begins.
    void section_header() {
        for (size_t entry = 1; entry + 1 < word(0) && entry < program_.bytecode.size();
             entry += 2) {
            if (word(entry + 1) == at_) title(event_name(word(entry)));
        }
        for (const SubroutinePlace& sub : program_.subroutines) {
            if (sub.address == at_) title("sub " + sub.name);
        }
    }

    void title(const std::string& name) {
        text_ += "\n" + name + ":\n";
        line_ = 0;
    }

    void source_line() {
        const size_t line = at_ < program_.lines.size() ? program_.lines[at_] : 0;
        if (line == 0 || line == line_) return;
        line_ = line;
        print("%8zu | ", line + static_cast<size_t>(first_line_) - 1);
        if (line <= lines_.size()) text_ += lines_[line - 1];
        text_ += '\n';
    }

    void instruction() {
        const uint16_t first = word(at_);
        const auto code = static_cast<size_t>(isa::opcode_of(first));
        const bool is_known = code < isa::kOpcodeCount;
        const size_t left = program_.bytecode.size() - at_;
        const size_t words = is_known ? std::min(kOpcodes[code].words, left) : 1;
        print("%5zu ", at_);
        for (size_t i = 0; i < 3; ++i) {
            if (i < words) {
                print(" %04x", word(at_ + i));
            } else {
                text_ += "     ";
            }
        }
        if (is_known && words == kOpcodes[code].words) {
            print("  %-10s ", kOpcodes[code].name);
            text_ += operand(first);
            while (text_.ends_with(' ')) text_.pop_back();
        } else {
            text_ += "  no instruction";
        }
        text_ += '\n';
        at_ += words;
    }

    std::string operand(uint16_t first) const {
        const uint16_t argument = isa::argument_of(first);
        const uint16_t second = word(at_ + 1);
        switch (isa::opcode_of(first)) {
            case Opcode::Stop:
            case Opcode::SubRet:
                return "";
            case Opcode::SmallImm:
                return std::to_string(isa::signed_argument_of(first));
            case Opcode::LargeImm:
                return std::to_string(static_cast<int16_t>(second));
            case Opcode::Load:
            case Opcode::Store:
                return place(argument);
            case Opcode::LoadInd:
            case Opcode::StoreInd:
                return array(argument) + ", index below " + std::to_string(second);
            case Opcode::Unary:
                return unary(argument);
            case Opcode::Binary:
                return binary(argument);
            case Opcode::Jump:
                return "to " + target_of(isa::signed_argument_of(first));
            case Opcode::Branch:
                return branch(first, second);
            case Opcode::Emit:
                return emit(argument, second);
            case Opcode::Native:
                return native(argument);
            case Opcode::SubCall:
                return sub(argument);
        }
        return "";
    }

    // A word of memory by the variable that it belongs to.
    std::string place(size_t address) const {
        for (const VariablePlace& variable : program_.variables) {
            const size_t start = variable.address;
            if (address < start || address >= start + variable.size) continue;
            if (variable.size == 1) return variable.name;
            return variable.name + "[" + std::to_string(address - start) + "]";
        }
        return (address >= variables_end_ ? "temporary " : "word ") + std::to_string(address);
    }

    std::string array(size_t address) const {
        for (const VariablePlace& variable : program_.variables) {
            if (variable.address == address) return variable.name;
        }
        return place(address);
    }

    static std::string unary(uint16_t argument) {
        const size_t code = argument & 0xffu;
        return code < isa::kUnaryOperatorCount ? kUnaryOperators[code] : "no operator";
    }

    static std::string binary(uint16_t argument) {
        const size_t code = argument & 0xffu;
        return code < isa::kBinaryOperatorCount ? kBinaryOperators[code] : "no operator";
    }

    std::string target_of(int32_t distance) const {
        return std::to_string(static_cast<int64_t>(at_) + distance);
    }

    std::string branch(uint16_t first, uint16_t second) const {
        const bool is_when = (first & isa::kBranchIsWhen) != 0;
        return binary(first) + (is_when ? " becomes true, else to " : ", else to ") +
               target_of(static_cast<int16_t>(second));
    }

    std::string emit(uint16_t event, uint16_t address) const {
        const uint16_t size = word(at_ + 2);
        std::string text = event < common_.events.size() ? common_.events[event].name
                                                         : "event " + std::to_string(event);
        if (size == 0) return text;
        return text + ", " + std::to_string(size) + (size == 1 ? " word" : " words") + " from " +
               place(address);
    }

    std::string native(uint16_t number) const {
        return number < target_.natives.size() ? target_.natives[number].name
                                               : "native " + std::to_string(number);
    }

    std::string sub(uint16_t address) const {
        for (const SubroutinePlace& known : program_.subroutines) {
            if (known.address == address) return known.name;
        }
        return "to " + std::to_string(address);
    }

    const Program& program_;
    const Target& target_;
    const CommonDefinitions& common_;
    std::vector<std::string_view> lines_;
    int first_line_;
    std::string text_;
    size_t at_ = 0;
    size_t line_ = 0;
    size_t variables_end_ = 0;
};

}  // namespace

std::string listing(const Program& program, std::string_view source, const Target& target,
                    const CommonDefinitions& common, int first_line) {
    return Listing(program, source, target, common, first_line).run();
}

}  // namespace vagus::aesl
