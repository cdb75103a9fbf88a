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

    std::vector<ListedInstruction> instructions() {
        std::vector<ListedInstruction> list;
        if (program_.bytecode.empty()) return list;
        add(list, 1, "event table of " + std::to_string(word(0)) + " words");
        while (at_ + 1 < program_.bytecode.size() && at_ < word(0)) {
            add(list, 2, handler_name(word(at_)) + " at " + std::to_string(word(at_ + 1)));
        }
        while (at_ < program_.bytecode.size()) {
            const Instruction one = instruction_at();
            add(list, one.words, one.operand.empty() ? one.name : one.name + " " + one.operand);
        }
        return list;
    }

    std::vector<Part> parts() const {
        std::vector<Part> list;
        for (size_t entry = 1; entry + 1 < word(0) && entry + 1 < program_.bytecode.size();
             entry += 2) {
            const uint16_t id = word(entry);
            const bool init = id == isa::kInitEvent;
            list.push_back({init ? Part::Kind::Init : Part::Kind::Event, init ? "" : event_name(id),
                            word(entry + 1), 0});
        }
        for (const SubroutinePlace& sub : program_.subroutines) {
            list.push_back({Part::Kind::Sub, sub.name, sub.address, 0});
        }
        std::sort(list.begin(), list.end(),
                  [](const Part& a, const Part& b) { return a.address < b.address; });
        for (size_t i = 0; i < list.size(); ++i) {
            const size_t end = i + 1 < list.size() ? list[i + 1].address : program_.bytecode.size();
            list[i].words = static_cast<uint16_t>(end - list[i].address);
        }
        return list;
    }

private:
    struct Instruction {
        std::string name, operand;
        size_t words = 1;
        bool known = false;
    };

    void add(std::vector<ListedInstruction>& list, size_t words, std::string text) {
        const int line = at_ < program_.lines.size() ? program_.lines[at_] : 0;
        list.push_back(
            {line, static_cast<uint16_t>(at_), static_cast<uint16_t>(words), std::move(text)});
        at_ += words;
    }

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
            text_ += handler_name(word(at_));
            print(" at %u\n", word(at_ + 1));
            at_ += 2;
        }
    }

    const std::string* known_event(uint16_t id) const {
        if (id < common_.events.size()) return &common_.events[id].name;
        const size_t local = size_t{isa::kLocalEventFirst} - id;
        return local < target_.local_events.size() ? &target_.local_events[local].name : nullptr;
    }

    std::string event_name(uint16_t id) const {
        const std::string* name = known_event(id);
        return name ? *name : "event " + std::to_string(id);
    }

    std::string handler_name(uint16_t id) const {
        if (id == isa::kInitEvent) return "initialisation";
        return (known_event(id) ? "onevent " : "") + event_name(id);
    }

    // A title where the code of an event or sub begins.
    void section_header() {
        for (size_t entry = 1; entry + 1 < word(0) && entry < program_.bytecode.size();
             entry += 2) {
            if (word(entry + 1) == at_) title(handler_name(word(entry)));
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

    Instruction instruction_at() const {
        const uint16_t first = word(at_);
        const auto code = static_cast<size_t>(isa::opcode_of(first));
        const bool is_known = code < isa::kOpcodeCount;
        const size_t left = program_.bytecode.size() - at_;
        const size_t words = is_known ? std::min(kOpcodes[code].words, left) : 1;
        if (!is_known || words != kOpcodes[code].words) return {"no instruction", "", words, false};
        return {kOpcodes[code].name, operand(first), words, true};
    }

    void instruction() {
        const Instruction one = instruction_at();
        print("%5zu ", at_);
        for (size_t i = 0; i < 3; ++i) {
            if (i < one.words) {
                print(" %04x", word(at_ + i));
            } else {
                text_ += "     ";
            }
        }
        if (one.known) {
            print("  %-10s ", one.name.c_str());
            text_ += one.operand;
            while (text_.ends_with(' ')) text_.pop_back();
        } else {
            text_ += "  no instruction";
        }
        text_ += '\n';
        at_ += one.words;
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

std::vector<ListedInstruction> instructions(const Program& program, const Target& target,
                                            const CommonDefinitions& common) {
    return Listing(program, "", target, common, 1).instructions();
}

std::vector<Part> parts_of(const Program& program, const Target& target,
                           const CommonDefinitions& common) {
    return Listing(program, "", target, common, 1).parts();
}

}  // namespace vagus::aesl
