#include "conformance/examine.hpp"

#include <algorithm>
#include <chrono>
#include <set>

#include "conformance/checks.hpp"
#include "debug/description.hpp"
#include "wire/messages.hpp"

namespace vagus::conformance {
namespace {

template <typename Message>
wire::Frame frame_of(const Message& message) {
    wire::Frame frame{};
    (void)!(wire::encode_message(message, wire::kHostId, frame) == wire::Error::None);
    return frame;
}

// Adds the frame if it is a part of a description.
debug::Progress add_part(debug::Description& description, const wire::Frame& frame) {
    wire::Description header;
    if (wire::decode_message(frame, header) == wire::Error::None && !description.begun())
        return description.begin(header);
    wire::NamedVariableDescription variable;
    if (wire::decode_message(frame, variable) == wire::Error::None)
        return description.add(variable);
    wire::LocalEventDescription event;
    if (wire::decode_message(frame, event) == wire::Error::None) return description.add(event);
    wire::NativeFunctionDescription native;
    if (wire::decode_message(frame, native) == wire::Error::None) return description.add(native);
    return debug::Progress::Ignored;
}

Row row_of(const Check& check, const Status& looked) {
    if (looked.ok()) return {check, Verdict::Passed, ""};
    const bool skipped = looked.error().code == kLacking;
    return {check, skipped ? Verdict::Skipped : Verdict::Failed, looked.error().what};
}

bool wanted(const Check& check, const std::string& only) {
    return check.group.find(only) != std::string::npos ||
           check.name.find(only) != std::string::npos;
}

}  // namespace

Result<std::vector<uint16_t>> who_is_there(Line& line) {
    wire::ListNodes ask;
    ask.version = wire::kProtocolVersion;
    TRY(line.send(frame_of(ask)));
    std::set<uint16_t> ids;
    const Time last = line.now() + kPresenceMost;
    Time deadline = last;
    while (line.now() < deadline && ids.size() < kNodesMax) {
        const std::optional<wire::Frame> frame = TRY(line.receive(deadline));
        wire::NodePresent present;
        if (!frame || wire::decode_message(*frame, present) != wire::Error::None) continue;
        if (ids.insert(frame->source).second)
            deadline = std::min(last, line.now() + kPresenceWithin);
    }
    return std::vector<uint16_t>(ids.begin(), ids.end());
}

Result<aesl::Target> describe(Line& line, uint16_t node) {
    wire::GetNodeDescription ask;
    ask.dest = node;
    ask.version = wire::kProtocolVersion;
    TRY(line.send(frame_of(ask)));
    debug::Description description;
    const Time deadline = line.now() + kDescriptionWithin;
    while (line.now() < deadline && !(description.begun() && description.complete())) {
        const std::optional<wire::Frame> frame = TRY(line.receive(deadline));
        if (!frame || frame->source != node) continue;
        if (add_part(description, *frame) == debug::Progress::Impossible)
            return Error{kFinding, "its description is impossible: " + description.why()};
    }
    if (description.begun() && description.complete()) return description.give();
    return Error{Code::Timeout, "it does not describe itself whole: " +
                                    std::to_string(description.items()) + " parts came"};
}

bool is_any_check(const std::string& only) {
    return std::ranges::any_of(all_checks(),
                               [&only](const Check& check) { return wanted(check, only); });
}

size_t Report::count(Verdict verdict) const {
    return static_cast<size_t>(std::ranges::count(rows, verdict, &Row::verdict));
}

namespace {

constexpr const char* kFlashStays =
    "it would overwrite the program that the node keeps: say --flash";
constexpr const char* kStaysAwake =
    "a node that can sleep would have to be switched on: say --sleep";

// Why the check is not to be made; nullptr if it is.
const char* unwanted(const Check& check, const Order& order) {
    if (check.group == kFlashGroup && !order.flash) return kFlashStays;
    if (check.group == kSleepGroup && !order.sleep) return kStaysAwake;
    return nullptr;
}

// Ends when the time is over, in the middle of whatever is waited for.
class LimitedLine : public Line {
public:
    LimitedLine(Line& line, Duration limit)
        : line_(line), limit_(limit), end_(line.now() + limit) {}

    Status send(const wire::Frame& frame) override {
        if (is_over()) return over();
        return line_.send(frame);
    }
    Result<std::optional<wire::Frame>> receive(Time deadline) override {
        if (is_over()) return over();
        return line_.receive(std::min(deadline, end_));
    }
    Time now() const override { return line_.now(); }
    bool is_over() const { return line_.now() >= end_; }
    Error over() const {
        const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(limit_).count();
        return Error{Code::Timeout, "the time limit of " + std::to_string(seconds) +
                                        " s is over: give more, by --max-time, or fewer checks, "
                                        "by --only"};
    }

private:
    Line& line_;
    Duration limit_;
    Time end_;
};

// Goes through the list; knows which check the node was lost at.
class Examination {
public:
    Examination(Line& line, const Order& order, const aesl::Target& target)
        : order_(order),
          line_(line),
          limited_(line, order.time_limit),
          bench_(limited_, order.node, target) {
        bench_.set_nobody(order.nobody);
    }

    Row make(const Check& check) {
        if (const char* reason = unwanted(check, order_)) return {check, Verdict::Skipped, reason};
        if (!lost_.empty()) return {check, Verdict::NotRun, lost_};
        const Status cleared = bench_.clear();
        if (limited_.is_over()) return end_of_time(check);
        if (!cleared.ok()) {
            lost_ = "lost at \"" + last_ + "\": " + cleared.error().what;
            return {check, Verdict::NotRun, lost_};
        }
        last_ = check.name;
        const Status looked = check.look(bench_);
        if (!looked.ok() && limited_.is_over()) return end_of_time(check);
        return row_of(check, looked);
    }
    // Also when the time is over: this takes no longer than one answer.
    bool leave() {
        if (!lost_.empty() && !limited_.is_over()) return false;
        return Bench(line_, order_.node, bench_.target()).clear().ok();
    }
    size_t foreign() const { return bench_.foreign(); }

private:
    Row end_of_time(const Check& check) {
        lost_ = limited_.over().what;
        return {check, Verdict::NotRun, lost_};
    }

    const Order& order_;
    Line& line_;
    LimitedLine limited_;
    Bench bench_;
    std::string lost_;
    std::string last_ = "the beginning";
};

}  // namespace

Report examine(Line& line, const Order& order, const aesl::Target& target) {
    Report report{.node = order.node, .target = target, .rows = {}, .foreign = 0};
    Examination examination(line, order, target);
    for (const Check& check : all_checks()) {
        if (!wanted(check, order.only)) continue;
        report.rows.push_back(examination.make(check));
        order.tell(report.rows.back());
    }
    report.left_clear = examination.leave();
    report.foreign = examination.foreign();
    return report;
}

}  // namespace vagus::conformance
