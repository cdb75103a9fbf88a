// vagus net: record.
#include <fmt/format.h>

#include "base/seconds.hpp"
#include "cli/net/verbs.hpp"
#include "cli/output.hpp"
#include "debug/names.hpp"
#include "record/bus_recording.hpp"

namespace vagus::cli {

namespace {

// So that little is asked of a bus: at most one node each kReadEvery, and each at most once in
// kReadAgain.
constexpr Duration kReadEvery = std::chrono::milliseconds(100);
constexpr Duration kReadAgain = std::chrono::seconds(1);

// Asks nodes for their variables, one after the other; the answers are frames as any.
class Reading {
public:
    explicit Reading(NetSession& session) : session_(session) {}

    void ask(Time now) {
        if (now < next_) return;
        next_ = now + kReadEvery;
        const std::vector<debug::NodeId> ids = session_.connected();
        const auto due = [&](debug::NodeId id) {
            return !asked_.contains(id) || asked_[id] + kReadAgain <= now;
        };
        auto first = std::find_if(ids.begin(), ids.end(),
                                  [&](debug::NodeId id) { return id > last_ && due(id); });
        if (first == ids.end()) first = std::find_if(ids.begin(), ids.end(), due);
        if (first == ids.end()) return;
        last_ = *first;
        asked_[last_] = now;
        uint16_t words = 0;
        for (const aesl::VariablePlace& one : debug::variables_of(session_.view(last_))) {
            words = std::max(words, static_cast<uint16_t>(one.address + one.size));
        }
        if (words == 0) return;
        (void)session_.network().get(last_, {.name = "", .address = 0, .count = words}).ok();
    }
    Time next() const { return next_; }

private:
    NetSession& session_;
    std::map<debug::NodeId, Time> asked_;
    debug::NodeId last_ = 0;
    Time next_{};
};

// A bus is recorded on when a node is missing: others may be there, and it may come back.
void tell_presence(const NetSession& session, const debug::Event& event, Time at) {
    const auto* const gone = std::get_if<debug::NodeDisconnected>(&event.what);
    const bool again = std::holds_alternative<debug::NodeReconnected>(event.what);
    if (gone == nullptr && !again) return;
    const std::string& name = session.view(event.node).name;
    const char* const what = again             ? "is there again"
                             : gone->forgotten ? "has left"
                                               : "has left, or it is silent";
    complain(fmt::format("node {}{}{} {}, at {} s", event.node, name.empty() ? "" : " ", name, what,
                         seconds_text(at)));
}

// Until it is over; the Error is of the bus, or of the file.
Status follow(NetSession& session, record::BusRecording& recording) {
    const Time end = session.options().wait_s ? session.now() + session.wait_or(0) : Time::max();
    Reading reading(session);
    while (!session.interrupted() && session.now() < end) {
        reading.ask(session.now());
        TRY(session.turn(std::min(end, reading.next())));
        for (const debug::Event& event : session.take_events()) {
            if (std::holds_alternative<debug::NodeDescribed>(event.what)) session.adopt_scripts();
            recording.happened(event);
            tell_presence(session, event, recording.now());
        }
        TRY(recording.state());
    }
    return Status::done();
}

}  // namespace

Verdict net_record(NetSession& session, const std::string& path, const FilesRead& files) {
    record::RunFile about;
    about.verb = record::kNetVerb;
    about.bus = session.options().target;
    about.project = session.options().project_file;
    const auto recording = TRY(record::BusRecording::begin(
        path, about, files.all(), session.network(),
        [&session, began = session.now()] { return session.now() - began; }));
    session.on_frame([&recording](const wire::Frame& frame) { recording->frame(frame); });
    const Status followed = follow(session, *recording);
    session.on_frame({});
    const Time at = recording->now();
    const Status written = recording->end(followed.ok() ? "" : followed.error().what);
    complain_left_out(path, recording->dropped(), "variables");
    say(fmt::format("{}: {} s, {} frames\n", path, seconds_text(at), recording->frames()));
    TRY(followed);
    TRY(written);
    return kExitDone;
}

}  // namespace vagus::cli
