// The recording of a bus without a plan, from when it is begun until it is ended.
//
//     auto bus = TRY(BusRecording::begin("monday.mcap", about, files.all(), network, clock));
//     bus->described(*network.node(3));              // each that is there already
//     bus->frame(frame);                             // each, as it comes or goes
//     bus->happened(event);                          // each that the network has to tell
//     const Status written = bus->end();             // or end("the bus is gone: …")
//
// On one thread. The bus waits for none of it (file_tape.hpp).
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "debug/network.hpp"
#include "record/bus_recorder.hpp"
#include "record/recording.hpp"

namespace vagus::record {

class BusRecording final : public Recording {
public:
    using Clock = std::function<Time()>;  // since the recording began

    // Of `about` the verb, the target and the project are used; its paths and those of `files` are
    // as they were typed. The network is borrowed, until end(). The Error says why there can be no
    // recording.
    static Result<std::unique_ptr<BusRecording>> begin(
        const std::string& path, RunFile about, const std::map<std::string, std::string>& files,
        const debug::Network& network, Clock clock);
    ~BusRecording() override;

    void described(const debug::NodeView& node);
    void frame(const wire::Frame& frame);
    void happened(const debug::Event& event);
    // A node was loaded with what this file holds for it now; the names of events are those of the
    // network from here on.
    void loaded(uint16_t node, const std::string& file, const std::string& text);
    // There is no plan.
    void changed(const FilesSaved&) override {}

    uint64_t frames() const { return frames_; }
    Status state() const { return tape_->state(); }  // so far
    Time now() const override { return clock_(); }
    Status end() override { return end(""); }
    // With why, if the bus goes on without it.
    Status end(const std::string& why);

private:
    BusRecording(std::unique_ptr<FileTape> tape, std::string_view run, PackedFiles files,
                 const debug::Network& network, Clock clock);
    void put(InputWhat what) override { recorder_->input_at(now(), std::move(what)); }

    const debug::Network& network_;
    const Clock clock_;
    BusRecorder bus_;
    uint64_t frames_ = 0;
};

}  // namespace vagus::record
