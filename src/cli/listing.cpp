#include "cli/listing.hpp"

#include <array>
#include <cstdio>
#include <map>
#include <vector>

#include "base/text.hpp"
#include "isa/isa.hpp"

namespace vagus::cli {
namespace {

struct OpcodeRow {
    std::string_view name;
    size_t words = 1;
};
constexpr std::array<OpcodeRow, isa::kOpcodeCount> kOpcodes = {{
#define OP(name, opcode, words, popped, pushed) {#name, words},
#include "isa/opcodes.def"
#undef OP
}};

constexpr std::array<std::string_view, isa::kBinaryOperatorCount> kBinary = {
#define BINARY(name, code, symbol) symbol,
#include "isa/operators.def"
#undef BINARY
};

constexpr std::array<std::string_view, isa::kUnaryOperatorCount> kUnary = {
#define UNARY(name, code, symbol) symbol,
#include "isa/operators.def"
#undef UNARY
};

template <typename Names>
std::string name_at(const Names& names, size_t index) {
    return index < names.size() ? std::string(names[index]) : "operator " + std::to_string(index);
}

std::string hex(uint16_t word) {
    char text[8];
    std::snprintf(text, sizeof text, "%04x", word);
    return text;
}

std::string padded(const std::string& text, size_t width) {
    return text + std::string(width > text.size() ? width - text.size() : 0, ' ');
}

std::string right(const std::string& text, size_t width) {
    return std::string(width > text.size() ? width - text.size() : 0, ' ') + text;
}

class Lister {
public:
    explicit Lister(const Listed& listed) : listed_(listed), words_(listed.program.bytecode) {
        for (const aesl::VariablePlace& place : listed.program.variables) {
            places_[place.address] = &place;
        }
    }

    std::string text() const {
        const aesl::Used& used = listed_.program.used;
        std::string text = "bytecode " + of(used.bytecode, listed_.target.bytecode_size) +
                           ", variables " + of(used.variables, listed_.target.variables_size) +
                           ", stack " + of(used.stack, listed_.target.stack_size) + " words\n\n";
        const size_t code = add_vector(text);
        add_code(code, text);
        return text;
    }

private:
    static std::string of(uint16_t part, uint16_t whole) {
        return std::to_string(part) + " of " + std::to_string(whole);
    }

    uint16_t word(size_t at) const { return at < words_.size() ? words_[at] : uint16_t{0}; }

    std::string event_name(uint16_t id) const {
        if (id == isa::kInitEvent) return "start";
        const auto local = static_cast<size_t>(isa::kLocalEventFirst - id);
        if (id >= isa::kUserEventLimit && local < listed_.target.local_events.size()) {
            return "onevent " + listed_.target.local_events[local].name;
        }
        const auto& events = listed_.common.events;
        return "onevent " + (id < events.size() ? events[id].name : std::to_string(id));
    }

    // The variable that holds the word, as "name", "name[2]", or the address for temporaries.
    std::string variable(uint16_t address) const {
        const auto after = places_.upper_bound(address);
        if (after == places_.begin()) return "temporary " + std::to_string(address);
        const aesl::VariablePlace& place = *std::prev(after)->second;
        const int offset = address - place.address;
        if (offset >= place.size) return "temporary " + std::to_string(address);
        return place.size == 1 ? place.name : place.name + "[" + std::to_string(offset) + "]";
    }

    // Gives where the code begins.
    size_t add_vector(std::string& text) const {
        const size_t length = std::min<size_t>(word(0), words_.size());
        text += "       " + right("0", 6) + "  " + hex(word(0)) + "       table of events\n";
        for (size_t at = 1; at + 1 < length; at += 2) {
            text += "       " + right(std::to_string(at), 6) + "  " + hex(word(at)) + " " +
                    hex(word(at + 1)) + "  " + event_name(word(at)) + ", at " +
                    std::to_string(word(at + 1)) + "\n";
        }
        return std::max<size_t>(length, 1);
    }

    std::string label(size_t at) const {
        for (const aesl::SubroutinePlace& place : listed_.program.subroutines) {
            if (place.address == at) return place.name;
        }
        return std::to_string(at);
    }

    std::string operands(size_t at) const {
        const uint16_t first = word(at);
        const uint16_t argument = isa::argument_of(first);
        const auto jump = [&](int16_t distance) {
            return std::to_string(static_cast<int>(at) + distance);
        };
        switch (isa::opcode_of(first)) {
            case isa::Opcode::Stop:
            case isa::Opcode::SubRet:
                return "";
            case isa::Opcode::SmallImm:
                return std::to_string(isa::signed_argument_of(first));
            case isa::Opcode::LargeImm:
                return std::to_string(static_cast<int16_t>(word(at + 1)));
            case isa::Opcode::Load:
            case isa::Opcode::Store:
                return variable(argument);
            case isa::Opcode::LoadInd:
            case isa::Opcode::StoreInd:
                return variable(argument) + " of " + std::to_string(word(at + 1));
            case isa::Opcode::Unary:
                return name_at(kUnary, isa::operator_of(first));
            case isa::Opcode::Binary:
                return name_at(kBinary, isa::operator_of(first));
            case isa::Opcode::Jump:
                return "to " + jump(isa::signed_argument_of(first));
            case isa::Opcode::Branch:
                return ((first & isa::kBranchIsWhen) != 0 ? "when " : "") +
                       name_at(kBinary, isa::operator_of(first)) + ", else to " +
                       jump(static_cast<int16_t>(word(at + 1)));
            case isa::Opcode::Emit:
                return emitted(argument, word(at + 1), word(at + 2));
            case isa::Opcode::Native: {
                const auto& natives = listed_.target.natives;
                return argument < natives.size() ? natives[argument].name
                                                 : std::to_string(argument);
            }
            case isa::Opcode::SubCall:
                return label(argument);
        }
        return "";
    }

    std::string emitted(uint16_t event, uint16_t address, uint16_t size) const {
        const auto& events = listed_.common.events;
        const std::string name = event < events.size() ? events[event].name : std::to_string(event);
        if (size == 0) return name;
        return name + ", " + std::to_string(size) + " words at " + variable(address);
    }

    void add_instruction(size_t at, size_t length, std::string& text) const {
        std::string words;
        for (size_t i = 0; i < length; i++) words += (i > 0 ? " " : "") + hex(word(at + i));
        const auto number = static_cast<size_t>(word(at) >> 12);
        const std::string name =
            number < kOpcodes.size() ? std::string(kOpcodes[number].name) : "no instruction";
        const std::string rest = operands(at);
        text += "       " + right(std::to_string(at), 6) + "  " + padded(words, 9) + "  " + name +
                (rest.empty() ? "" : " " + rest) + "\n";
    }

    // Each run of instructions stands under the source line it came from.
    void add_code(size_t at, std::string& text) const {
        const std::vector<std::string_view> lines = split(listed_.source, '\n');
        const auto& numbers = listed_.program.lines;
        size_t shown = 0;
        while (at < words_.size()) {
            const size_t line = at < numbers.size() ? numbers[at] : 0;
            if (line != shown && line > 0 && line <= lines.size()) {
                const int number = static_cast<int>(line) + listed_.first_line - 1;
                std::string_view source = lines[line - 1];
                if (source.ends_with('\r')) source.remove_suffix(1);
                text += right(std::to_string(number), 5) + " | " + std::string(source) + "\n";
            }
            shown = line;
            const auto number = static_cast<size_t>(word(at) >> 12);
            const size_t length = number < kOpcodes.size() ? kOpcodes[number].words : 1;
            add_instruction(at, std::min(length, words_.size() - at), text);
            at += length;
        }
    }

    const Listed& listed_;
    const std::vector<uint16_t>& words_;
    std::map<uint16_t, const aesl::VariablePlace*> places_;
};

}  // namespace

std::string listing(const Listed& listed) {
    return Lister(listed).text();
}

}  // namespace vagus::cli
