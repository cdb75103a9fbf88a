// A node as a board has it, src/vm and src/node and nothing between them, examined by all checks of
// `vagus conformance` in one thread. ./dev mutants builds it with one fault after the other
// (mutants.json), and with none.
//
// Exit code 0: no finding; 1: findings, on standard output. A node that never comes back ends the
// program by SIGALRM.
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <deque>

#include "conformance/examine.hpp"
#include "conformance/report_text.hpp"
#include "node/test_node.hpp"

namespace vagus::conformance {
namespace {

constexpr unsigned kEndsWithin_s = 60;
constexpr uint16_t kInstructionsAtOnce = 1000;
constexpr Duration kFrameTakes = std::chrono::microseconds(100);

const node::Variable kVariables[] = {{1, "id"}, {1, "source"}, {32, "args"}, {2, "_program"}};
constexpr uint16_t kProgramAt = 34;
const node::Description kDescription = {
    "plain",
    wire::kProtocolVersion,
    node::LocalEventSource::Kept,
    4,
    kVariables,
    2,
    node::kTestEvents,
    {{node::kStandardNatives, node::kStandardNativeCount}, {nullptr, 0}},
    kProgramAt};

class PlainLine : public Line {
public:
    Status send(const wire::Frame& frame) override {
        now_ += kFrameTakes;
        node::receive(node_.node, frame);
        node::run(node_.node, kInstructionsAtOnce);
        return Status::done();
    }
    Result<std::optional<wire::Frame>> receive(Time deadline) override {
        while (node_.sent.empty() && now_ < deadline) {
            const bool busy = node::run(node_.node, kInstructionsAtOnce) > 0;
            now_ = busy ? std::min(deadline, now_ + kFrameTakes) : deadline;
        }
        if (node_.sent.empty()) return std::optional<wire::Frame>{};
        const wire::Frame frame = node_.sent.front();
        node_.sent.erase(node_.sent.begin());
        return std::optional<wire::Frame>(frame);
    }
    Time now() const override { return now_; }

private:
    node::TestNode node_{kDescription};
    Time now_{};
};

int examine_plain_node() {
    PlainLine line;
    const auto target = describe(line, 1);
    if (!target.ok()) {
        std::printf("description: %s\n", target.error().what.c_str());
        return 1;
    }
    const Report report = examine(line, {.node = 1, .nobody = 2, .only = ""}, target.value());
    for (const Row& row : report.rows) {
        const bool found = row.verdict == Verdict::Failed || row.verdict == Verdict::NotRun;
        if (found) std::fputs(row_text(row).c_str(), stdout);
    }
    return report.count(Verdict::Failed) + report.count(Verdict::NotRun) == 0 ? 0 : 1;
}

}  // namespace
}  // namespace vagus::conformance

int main() {
    alarm(vagus::conformance::kEndsWithin_s);
    return vagus::conformance::examine_plain_node();
}
