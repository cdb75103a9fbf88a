#include "aesl/link.hpp"

#include <algorithm>

#include "aesl/limits.hpp"
#include "aesl/scan.hpp"

namespace vagus::aesl {
namespace {

struct EventCode {
    uint16_t id;
    size_t section;
};

// The sections of events that have code, by ascending id; the initialisation has the highest.
std::vector<EventCode> event_codes(const Tree& tree, const Code& code) {
    std::vector<EventCode> events;
    for (size_t i = 0; i < tree.sections.size(); ++i) {
        const Section& section = tree.sections[i];
        if (section.kind == SectionKind::Sub || code.sections[i].words.empty()) continue;
        const bool is_init = section.kind == SectionKind::Init;
        events.push_back({is_init ? isa::kInitEvent : static_cast<uint16_t>(section.number), i});
    }
    std::sort(events.begin(), events.end(),
              [](const EventCode& a, const EventCode& b) { return a.id < b.id; });
    return events;
}

class Linker {
public:
    Linker(const Tree& tree, const Code& code, Diagnostics& diagnostics)
        : tree_(tree), code_(code), diagnostics_(diagnostics) {}

    Program run(const Target& target) {
        const std::vector<EventCode> events = event_codes(tree_, code_);
        place(events);
        if (size_ > target.bytecode_size) {
            diagnostics_.report(Diag::ScriptTooBig, {},
                                {std::to_string(size_), std::to_string(target.bytecode_size)});
            return {};
        }
        write_table(events);
        for (const EventCode& event : events) append(event.section);
        for (const TreeSub& sub : tree_.subs) append(sub.section);
        name_places();
        return std::move(program_);
    }

private:
    // Decides where each section goes.
    void place(const std::vector<EventCode>& events) {
        addresses_.assign(code_.sections.size(), 0);
        size_ = 1 + 2 * events.size();
        for (const EventCode& event : events) place_one(event.section);
        for (const TreeSub& sub : tree_.subs) place_one(sub.section);
    }

    void place_one(size_t section) {
        addresses_[section] = size_;
        size_ += code_.sections[section].words.size();
    }

    void write_table(const std::vector<EventCode>& events) {
        program_.bytecode.reserve(size_);
        program_.bytecode.push_back(static_cast<uint16_t>(1 + 2 * events.size()));
        for (const EventCode& event : events) {
            program_.bytecode.push_back(event.id);
            program_.bytecode.push_back(static_cast<uint16_t>(addresses_[event.section]));
        }
        program_.lines.assign(program_.bytecode.size(), 0);
    }

    void append(size_t section) {
        const CodeSection& code = code_.sections[section];
        const size_t start = program_.bytecode.size();
        program_.bytecode.insert(program_.bytecode.end(), code.words.begin(), code.words.end());
        program_.lines.insert(program_.lines.end(), code.lines.begin(), code.lines.end());
        for (const CodeCall& call : code.calls) {
            const TreeSub& sub = tree_.subs[static_cast<size_t>(call.sub)];
            const size_t address = addresses_[sub.section];
            if (address >= isa::kArgumentLimit) {
                too_far(sub, address);
                return;
            }
            program_.bytecode[start + call.word] =
                isa::instruction(isa::Opcode::SubCall, static_cast<uint16_t>(address));
        }
    }

    void too_far(const TreeSub& sub, size_t address) {
        if (is_reported_) return;
        is_reported_ = true;
        diagnostics_.report(
            Diag::SubTooFar, {},
            {shown(sub.name), std::to_string(address), std::to_string(isa::kArgumentLimit - 1)});
    }

    void name_places() {
        for (const TreeVariable& variable : tree_.variables) {
            program_.variables.push_back({std::string(variable.name),
                                          static_cast<uint16_t>(variable.address),
                                          static_cast<uint16_t>(variable.size)});
        }
        for (const TreeSub& sub : tree_.subs) {
            program_.subroutines.push_back({std::string(sub.name),
                                            static_cast<uint16_t>(addresses_[sub.section]),
                                            tree_.tokens[sub.token].line});
        }
        program_.used.bytecode = static_cast<uint16_t>(size_);
        program_.used.variables = static_cast<uint16_t>(tree_.variable_words + code_.temporaries);
    }

    const Tree& tree_;
    const Code& code_;
    Diagnostics& diagnostics_;
    Program program_;
    std::vector<size_t> addresses_;
    size_t size_ = 0;
    bool is_reported_ = false;
};

}  // namespace

Program link(const Tree& tree, const Code& code, const Target& target, Diagnostics& diagnostics) {
    return Linker(tree, code, diagnostics).run(target);
}

}  // namespace vagus::aesl
