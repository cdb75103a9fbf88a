// Nodes with one fault each: the check that is there for it finds it.
#include <gtest/gtest.h>

#include "conformance/checks.hpp"
#include "conformance/standard_natives.hpp"
#include "isa/isa.hpp"
#include "virtual_line.hpp"
#include "wire/messages.hpp"
#include "wire/reports.hpp"

namespace vagus::conformance {
namespace {

using wire::MessageType;
using Frames = std::vector<wire::Frame>;

bool is(const wire::Frame& frame, MessageType type) {
    return frame.type == static_cast<uint16_t>(type);
}

// ---- a machine that takes one thing for another ----

// Words of each instruction, by its opcode; section 3.4.
constexpr uint8_t kWordsOf[16] = {1, 1, 2, 1, 1, 2, 2, 1, 1, 1, 2, 3, 1, 1, 1, 1};

using WordChange = std::function<uint16_t(uint16_t)>;

// The first word of every instruction of an uploaded program is changed on its way.
Fault with_instructions(const WordChange& change) {
    return {.to_node = [change](const wire::Frame& frame) {
        if (!is(frame, MessageType::SetBytecode)) return Frames{frame};
        Values words = wire::arguments_of<Values>(frame);
        if (words.size() < 4 || words[1] != 0) return Frames{frame};  // a piece of a program
        const auto word = [&words](size_t i) { return static_cast<uint16_t>(words[i + 2]); };
        for (size_t i = word(0); i + 2 < words.size(); i += kWordsOf[word(i) >> 12])
            words[i + 2] = static_cast<int16_t>(change(word(i)));
        wire::Frame changed = frame;
        changed.size = 0;
        for (const int16_t each : words) wire::add_argument(changed, each);
        return Frames{changed};
    }};
}

// In an instruction with this opcode, `from` in the bits of `mask` becomes `to`.
struct Swap {
    isa::Opcode opcode;
    uint16_t mask, from, to;
};

WordChange swapping(const Swap& swap) {
    return [swap](uint16_t word) {
        const bool meant = isa::opcode_of(word) == swap.opcode && (word & swap.mask) == swap.from;
        return meant ? static_cast<uint16_t>((word & ~swap.mask) | swap.to) : word;
    };
}

bool finds(const std::string& check, const Fault& fault) {
    return failed(examine_virtual(node_with(), fault, check), check);
}

TEST(ConformanceFaults, AnOperatorThatIsAnotherIsFound) {
    const char* const symbols[] = {
#define BINARY(name, code, symbol) symbol,
#include "isa/operators.def"
#undef BINARY
    };
    for (uint16_t from = 0; from < isa::kBinaryOperatorCount; from++) {
        for (uint16_t to = 0; to < isa::kBinaryOperatorCount; to++) {
            if (from == to) continue;
            const Swap swap{isa::Opcode::Binary, 0xff, from, to};
            EXPECT_TRUE(
                finds(std::string("operator ") + symbols[from], with_instructions(swapping(swap))))
                << symbols[from] << " computed as " << symbols[to];
        }
    }
}

TEST(ConformanceFaults, AUnaryOperatorThatIsAnotherIsFound) {
    const char* const names[] = {"operator negation", "operator abs", "operator ~"};
    for (uint16_t from = 0; from < 3; from++) {
        for (uint16_t to = 0; to < 3; to++) {
            if (from == to) continue;
            const Swap swap{isa::Opcode::Unary, 0xff, from, to};
            EXPECT_TRUE(finds(names[from], with_instructions(swapping(swap))))
                << names[from] << " computed as " << names[to];
        }
    }
}

TEST(ConformanceFaults, ANativeThatIsAnotherIsFound) {
    const auto natives = standard_natives();
    for (uint16_t from = 0; from < natives.size(); from++) {
        for (uint16_t to = 0; to < natives.size(); to++) {
            if (from == to) continue;
            const Swap swap{isa::Opcode::Native, 0xfff, from, to};
            const Report report =
                examine_virtual(node_with(), with_instructions(swapping(swap)), natives[from].name);
            EXPECT_GT(report.count(Verdict::Failed), 0u)
                << natives[from].name << " done as " << natives[to].name;
        }
    }
}

// Instructions of one word, each taken for every other of one word.
TEST(ConformanceFaults, AnInstructionThatIsAnotherIsFound) {
    struct Named {
        isa::Opcode opcode;
        const char* check;
    };
    const Named all[] = {{isa::Opcode::Stop, "Stop ends the event"},
                         {isa::Opcode::SmallImm, "SmallImm pushes -2048 to 2047"},
                         {isa::Opcode::Load, "Load and Store move variables"},
                         {isa::Opcode::Store, "Load and Store move variables"},
                         {isa::Opcode::Jump, "Jump goes both ways"},
                         {isa::Opcode::SubCall, "SubCall and SubRet"},
                         {isa::Opcode::SubRet, "SubCall and SubRet"}};
    for (const Named& from : all) {
        for (const Named& to : all) {
            if (from.opcode == to.opcode) continue;
            const WordChange change = [&from, &to](uint16_t word) {
                if (isa::opcode_of(word) != from.opcode) return word;
                return isa::instruction(to.opcode, isa::argument_of(word));
            };
            EXPECT_TRUE(finds(from.check, with_instructions(change)))
                << from.check << ": opcode " << int(from.opcode) << " done as " << int(to.opcode);
        }
    }
}

TEST(ConformanceFaults, AWhenThatIsAnIfIsFound) {
    const WordChange no_when = [](uint16_t word) {
        return isa::opcode_of(word) == isa::Opcode::Branch
                   ? static_cast<uint16_t>(word & ~isa::kBranchIsWhen)
                   : word;
    };
    EXPECT_TRUE(finds("Branch of `when` sees edges only", with_instructions(no_when)));
    const WordChange all_when = [](uint16_t word) {
        return isa::opcode_of(word) == isa::Opcode::Branch
                   ? static_cast<uint16_t>(word | isa::kBranchIsWhen)
                   : word;
    };
    EXPECT_TRUE(finds("Branch closes a loop", with_instructions(all_when)));
}

// ---- a node that says the wrong thing ----

using FrameChange = std::function<Frames(wire::Frame)>;

Fault saying(MessageType type, const FrameChange& change) {
    return {.from_node = [type, change](const wire::Frame& frame) {
        return is(frame, type) ? change(frame) : Frames{frame};
    }};
}

Frames lost(const wire::Frame&) {
    return {};
}
Frames doubled(const wire::Frame& frame) {
    return {frame, frame};
}
Frames one_more_in_front(wire::Frame frame) {
    frame.payload[0]++;
    return {frame};
}
Frames one_more_behind(wire::Frame frame) {
    if (frame.size >= 2) frame.payload[frame.size - 2]++;
    return {frame};
}
Frames a_word_longer(wire::Frame frame) {
    wire::add_argument(frame, 0);
    return {frame};
}
Frames a_word_shorter(wire::Frame frame) {
    frame.size = frame.size < 2 ? uint16_t{0} : static_cast<uint16_t>(frame.size - 2);
    return {frame};
}

struct Wrong {
    const char* what;
    FrameChange change;
};
const Wrong kWrongs[] = {{"lost", lost},
                         {"doubled", doubled},
                         {"first word wrong", one_more_in_front},
                         {"last word wrong", one_more_behind},
                         {"a word longer", a_word_longer},
                         {"a word shorter", a_word_shorter}};

TEST(ConformanceFaults, AMessageThatIsWrongIsFoundByItsCheck) {
    struct Named {
        MessageType type;
        const char* check;
    };
    const Named all[] = {
        {MessageType::NodePresent, "ListNodes is answered by NodePresent"},
        {MessageType::ExecutionStateChanged, "GetExecutionState changes nothing"},
        {MessageType::BreakpointSetResult, "a breakpoint stops, Step leaves it"},
        {MessageType::DivisionByZero, "division by zero"},
        {MessageType::ArrayAccessOutOfBounds, "an index behind the array, read"},
        {MessageType::EventExecutionKilled, "an event ends the one that runs, and says so"},
    };
    for (const Named& each : all) {
        for (const Wrong& wrong : kWrongs) {
            // A second NodePresent may be the answer to another host.
            if (each.type == MessageType::NodePresent && std::string(wrong.what) == "doubled")
                continue;
            EXPECT_TRUE(finds(each.check, saying(each.type, wrong.change)))
                << each.check << ": " << wrong.what;
        }
    }
}

TEST(ConformanceFaults, AVariableThatIsWrongIsFound) {
    for (const Wrong& wrong : kWrongs) {
        const Report report =
            examine_virtual(node_with(), saying(MessageType::Variables, wrong.change), "variables");
        EXPECT_GT(report.count(Verdict::Failed) + report.count(Verdict::NotRun), 0u) << wrong.what;
    }
}

TEST(ConformanceFaults, ADescriptionThatIsWrongIsFound) {
    const char* const check = "the parts of the description come whole and in order";
    for (const MessageType type :
         {MessageType::Description, MessageType::NamedVariableDescription,
          MessageType::LocalEventDescription, MessageType::NativeFunctionDescription}) {
        EXPECT_TRUE(finds(check, saying(type, lost)));
        EXPECT_TRUE(finds(check, saying(type, doubled)));
    }
}

TEST(ConformanceFaults, AnEventThatIsWrongIsFound) {
    for (const Wrong& wrong : kWrongs) {
        const Fault fault{.from_node = [&wrong](const wire::Frame& frame) {
            return wire::is_user_event(frame.type) ? wrong.change(frame) : Frames{frame};
        }};
        EXPECT_TRUE(finds("Emit sends variables as an event", fault)) << wrong.what;
    }
}

// Section 8, D3 and D4, as the reference does it.
TEST(ConformanceFaults, TheDequeFaultsOfTheReferenceAreFound) {
    const Fault short_one = saying(MessageType::ArrayAccessOutOfBounds, [](wire::Frame frame) {
        frame.size = 2;
        return Frames{frame};
    });
    EXPECT_TRUE(finds("deque.get outside tells pc, cells and index", short_one));
    EXPECT_TRUE(finds("deque.pop_front of too many is told once",
                      saying(MessageType::ArrayAccessOutOfBounds, doubled)));
}

// ---- a node that does not do as it is told ----

TEST(ConformanceFaults, ACommandThatIsNotObeyedIsFoundByItsCheck) {
    struct Named {
        MessageType type;
        const char* check;
    };
    const Named all[] = {
        {MessageType::SetBytecode, "a loaded program waits for Run"},
        {MessageType::Reset, "Reset starts init, paused, and keeps variables"},
        {MessageType::Run, "Pause in an event, and Run goes on"},
        {MessageType::Pause, "Pause in an event, and Run goes on"},
        {MessageType::Step, "Step executes one instruction"},
        {MessageType::Stop, "Stop abandons the event"},
        {MessageType::GetExecutionState, "GetExecutionState changes nothing"},
        {MessageType::BreakpointSet, "a breakpoint stops, Step leaves it"},
        {MessageType::BreakpointClear, "BreakpointClear removes one"},
        {MessageType::BreakpointClearAll, "BreakpointClearAll takes all away"},
        {MessageType::SetVariables, "SetVariables and GetVariables agree"},
        {MessageType::GetNodeDescription, "the parts of the description come whole and in order"},
    };
    for (const Named& each : all) {
        const Fault deaf{.to_node = [&each](const wire::Frame& frame) {
            return is(frame, each.type) ? Frames{} : Frames{frame};
        }};
        EXPECT_TRUE(finds(each.check, deaf)) << each.check;
    }
}

// The command of a host does what another one does.
TEST(ConformanceFaults, ACommandTakenForAnotherIsFound) {
    struct Mixed {
        MessageType from, to;
        const char* check;
    };
    const Mixed all[] = {
        {MessageType::Stop, MessageType::Pause, "Stop abandons the event"},
        {MessageType::Pause, MessageType::Stop, "Pause in an event, and Run goes on"},
        {MessageType::Reset, MessageType::Stop, "Reset starts init, paused, and keeps variables"},
        {MessageType::Step, MessageType::Run, "Step executes one instruction"},
        {MessageType::BreakpointClear, MessageType::BreakpointClearAll,
         "BreakpointClear removes one"},
        {MessageType::BootloaderReset, MessageType::Reset, "commands to a boot loader are ignored"},
    };
    for (const Mixed& each : all) {
        const Fault mixed{.to_node = [&each](wire::Frame frame) {
            if (is(frame, each.from)) frame.type = static_cast<uint16_t>(each.to);
            return Frames{frame};
        }};
        EXPECT_TRUE(finds(each.check, mixed)) << each.check;
    }
}

Report sent_to_sleep(Fault fault) {
    const aesl::Target target = node_with();
    VirtualLine line(target, std::move(fault));
    return examine(line, {.node = 1, .nobody = 2, .sleep = true, .only = "sleep"}, target);
}

// One that can sleep is no fault, but says nothing any more.
TEST(ConformanceFaults, ANodeThatSleepsIsToldFromOneThatCannot) {
    EXPECT_EQ(sent_to_sleep({}).count(Verdict::Passed), 1u);
    const auto asleep = std::make_shared<bool>(false);
    const Fault sleeper{.to_node = [asleep](const wire::Frame& frame) {
        *asleep = *asleep || is(frame, MessageType::SuspendToRam);
        return *asleep ? Frames{} : Frames{frame};
    }};
    EXPECT_EQ(rows_with(sent_to_sleep(sleeper), Verdict::Skipped),
              "sleep: SuspendToRam leaves a node awake that cannot sleep: needs a node that cannot "
              "sleep; the node sleeps now: switch it on again\n");
    const Fault tells{.to_node = [](wire::Frame frame) {
        if (is(frame, MessageType::SuspendToRam))
            frame.type = static_cast<uint16_t>(MessageType::Reset);
        return Frames{frame};
    }};
    EXPECT_EQ(sent_to_sleep(tells).count(Verdict::Failed), 1u);
}

// The node obeys what is meant for any node.
TEST(ConformanceFaults, ANodeThatObeysForAnotherIsFound) {
    const Fault vain{.to_node = [](wire::Frame frame) {
        if (wire::is_command(frame.type) && frame.size >= 2) frame.payload[0] = 1;
        return Frames{frame};
    }};
    EXPECT_TRUE(finds("commands to another id are ignored", vain));
}

// The source is left out; an odd byte counts; what the node sends comes back to it.
TEST(ConformanceFaults, EventsThatAreStoredWronglyAreFound) {
    const Fault nameless{.to_node = [](wire::Frame frame) {
        frame.source = 0;
        return Frames{frame};
    }};
    EXPECT_TRUE(finds("source and arguments are stored", nameless));
    const Fault odd{.to_node = [](wire::Frame frame) {
        if (frame.size % 2 != 0) frame.payload[frame.size++] = 0;
        return Frames{frame};
    }};
    EXPECT_TRUE(finds("an odd last byte does not count", odd));
    const Fault shorter{.to_node = [](wire::Frame frame) {
        if (wire::is_user_event(frame.type) && frame.size > 40) frame.size = 40;
        return Frames{frame};
    }};
    EXPECT_TRUE(finds("arguments that do not fit are cut", shorter));
}

TEST(ConformanceFaults, AReplyCutAt256WordsIsFound) {
    const Fault cut = saying(MessageType::Variables, [](wire::Frame frame) {
        if (frame.size > 512) frame.size = 512;
        return Frames{frame};
    });
    EXPECT_TRUE(finds("257 variables are read at once, or all there are", cut));
}

}  // namespace
}  // namespace vagus::conformance
