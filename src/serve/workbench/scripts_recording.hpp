// The recording of scripts that run on the bus of a robot without a plan. The server makes it
// itself, for there is no process of the run that could (runner/run_recording.hpp).
//
//     ScriptsRecording scripts;
//     scripts.on_say(say);
//     scripts.begin(path, about, files, network, clock);
//     scripts.frame(frame);                          // as it comes or goes
//     scripts.happened(event);                       // of the network
//     scripts.tick();                                // now and then
//     scripts.end();
//
// While nothing is recorded, what it is told is of no interest.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/time.hpp"
#include "record/bus_recording.hpp"

namespace vagus::serve {

class ScriptsRecording {
public:
    using Say = std::function<void(const std::string& kind, const std::string& text)>;
    void on_say(Say say) { say_ = std::move(say); }

    // Ends the one before. The network is borrowed until end(); the clock counts from now. Whatever
    // goes wrong is said, and the scripts run on.
    void begin(const std::string& path, record::RunFile about,
               const std::map<std::string, std::string>& files, const debug::Network& network,
               record::BusRecording::Clock clock);
    bool records() const { return recording_ != nullptr; }
    void frame(const wire::Frame& frame) {
        if (recording_) recording_->frame(frame);
    }
    void happened(const debug::Event& event) {
        if (recording_) recording_->happened(event);
    }
    // A node has got what this file says.
    void loaded(uint16_t node, const std::string& file, const std::string& text) {
        if (recording_) recording_->loaded(node, file, text);
    }
    void end();

    // `done` is told when all that has been recorded by now is in the file.
    void flush(std::function<void()> done);
    void tick();
    Time next_tick(Time now) const;

private:
    void answer_flushes(bool all);
    void tell_trouble();

    Say say_ = [](auto&, auto&) {};
    std::unique_ptr<record::BusRecording> recording_;
    std::vector<std::pair<uint64_t, std::function<void()>>> flushes_;  // by the tape's numbers
};

}  // namespace vagus::serve
