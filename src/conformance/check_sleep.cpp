// SuspendToRam (section 2.3): a node that cannot sleep ignores it. Asked for only if a node that
// can may be sent to sleep, from which only its button wakes it.
#include "conformance/checks.hpp"

namespace vagus::conformance {
namespace {

using wire::MessageType;

constexpr Duration kAwakeWithin = std::chrono::seconds(5);

Status stays_awake(Bench& bench) {
    TRY(bench.command(MessageType::SuspendToRam));
    TRY(bench.command(MessageType::GetExecutionState));
    const std::optional<wire::Frame> frame = TRY(bench.listen(bench.now() + kAwakeWithin));
    if (!frame) return lacking("a node that cannot sleep", "sleeps now: switch it on again");
    if (frame->type == static_cast<uint16_t>(MessageType::ExecutionStateChanged))
        return bench.expect_silence();
    return finding("expected nothing but the answer to GetExecutionState, found " +
                   text_of(*frame));
}

}  // namespace

void add_sleep_checks(Checks& checks) {
    checks.push_back({kSleepGroup, "SuspendToRam leaves a node awake that cannot sleep", "2.3", "",
                      stays_awake});
}

}  // namespace vagus::conformance
