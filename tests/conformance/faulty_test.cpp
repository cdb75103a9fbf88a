// Nodes with one fault each: the right check finds it, and nothing hangs.
#include <gtest/gtest.h>

#include "isa/isa.hpp"
#include "virtual_line.hpp"
#include "wire/messages.hpp"
#include "wire/reports.hpp"

namespace vagus::conformance {
namespace {

using wire::MessageType;

bool is(const wire::Frame& frame, MessageType type) {
    return frame.type == static_cast<uint16_t>(type);
}

// The node never sends this.
Fault without(MessageType type) {
    return {.from_node = [type](const wire::Frame& frame) {
        return is(frame, type) ? std::vector<wire::Frame>{} : std::vector<wire::Frame>{frame};
    }};
}

TEST(ConformanceFaults, AnAnswerThatNeverComesIsFoundAndEndsNothing) {
    const Report report = examine_virtual(node_with(), without(MessageType::NodePresent));
    EXPECT_EQ(rows_with(report, Verdict::Failed),
              "description: ListNodes is answered by NodePresent: expected NodePresent 5, found "
              "nothing within 3 s\n");
    EXPECT_EQ(rows_with(report, Verdict::NotRun), "");
}

}  // namespace
}  // namespace vagus::conformance
