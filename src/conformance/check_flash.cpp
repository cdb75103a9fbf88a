// What outlasts a restart: WriteBytecode and Reboot (section 2.3), with the node's own flash. Asked
// for only if that may be overwritten.
#include <algorithm>

#include "conformance/checks.hpp"

namespace vagus::conformance {
namespace {

using wire::MessageType;

// Flash is erased and written word by word; a small processor starts in less.
constexpr Duration kSavedWithin = std::chrono::seconds(10);
constexpr Duration kRestartWithin = std::chrono::seconds(20);
constexpr int16_t kSavedValue = 77;
constexpr int16_t kValueBefore = 5;

// Nodes without flash say nothing; others tell how it went, as an error that is none.
Result<std::string> save(Bench& bench) {
    TRY(bench.command(MessageType::WriteBytecode));
    const std::optional<wire::Frame> frame = TRY(bench.listen(bench.now() + kSavedWithin));
    if (!frame)
        return lacking("a report of WriteBytecode", "makes none: it seems to have no flash");
    wire::NodeSpecificError report;
    if (wire::decode_message(*frame, report) == wire::Error::None)
        return std::string(report.text.bytes, report.text.size);
    return finding("expected NodeSpecificError (\"Flashing OK\") or nothing, found " +
                   text_of(*frame));
}

Status save_or_lack(Bench& bench) {
    const std::string told = TRY(save(bench));
    if (told.find("OK") != std::string::npos) return Status::done();
    return lacking("flash", "says \"" + told + "\"");
}

Words storing(uint16_t at) {
    return program_of(Instructions().push(kSavedValue).store(at).stop());
}

Status saving_changes_nothing(Bench& bench) {
    const uint16_t at = TRY(bench.room(1));
    TRY(bench.set(at, {kValueBefore}));
    TRY(bench.load(storing(at)));
    TRY(save_or_lack(bench));
    TRY(bench.ask_state({kInitStart, 3}));
    return bench.expect_values(at, {kValueBefore});
}

// Whatever comes meanwhile: it starts again. A node may answer before its program has run, with the
// 0 of a memory that is fresh: it is asked again.
Result<int16_t> value_after_restart(Bench& bench, uint16_t at) {
    const Time deadline = bench.now() + kRestartWithin;
    bool answers = false;
    while (bench.now() < deadline) {
        TRY(bench.command(MessageType::GetVariables, {at, 1}));
        const Time next = std::min(deadline, bench.now() + kAnswerAgainWithin);
        while (bench.now() < next) {
            const std::optional<wire::Frame> frame = TRY(bench.listen(next));
            wire::Variables part;
            const bool read = frame && wire::decode_message(*frame, part) == wire::Error::None;
            if (!read || part.start != at || part.values.count != 1) continue;
            if (part.values.values[0] != 0) return part.values.values[0];
            answers = true;
            break;
        }
    }
    if (answers) return int16_t{0};
    return finding("the node does not answer after Reboot");
}

Status starts_by_itself(Bench& bench, uint16_t at) {
    TRY(bench.load(storing(at)));
    TRY(save_or_lack(bench));
    TRY(bench.set(at, {kValueBefore}));
    TRY(bench.command(MessageType::Reboot));
    const int16_t found = TRY(value_after_restart(bench, at));
    if (found == kSavedValue) return Status::done();
    if (found == kValueBefore) return lacking("a restart by Reboot", "ignores it");
    return finding("expected " + std::to_string(kSavedValue) + " of the saved program, found " +
                   std::to_string(found));
}

// An empty program is left in flash.
Status saved_program_starts(Bench& bench) {
    const uint16_t at = TRY(bench.room(1));
    const Status started = starts_by_itself(bench, at);
    TRY(bench.clear());
    (void)TRY(save(bench));
    return started;
}

}  // namespace

void add_flash_checks(Checks& checks) {
    checks.push_back({kFlashGroup, "WriteBytecode leaves program and variables", "2.3", "",
                      saving_changes_nothing});
    checks.push_back({kFlashGroup, "a saved program starts by itself after Reboot", "2.3, 3.1", "",
                      saved_program_starts});
}

}  // namespace vagus::conformance
