// The recording of scripts that run on the bus of a robot without a plan. The server makes it
// itself, for there is no process of the run that could (runner/run_recording.hpp).
//
//     ScriptsRecording scripts(warn);
//     scripts.begin(path, about, files, network, clock);
//     scripts.frame(frame);                          // as it comes or goes
//     scripts.happened(event);                       // of the network
//     scripts.tended().tend();                       // now and then
//     scripts.end();
//
// While nothing is recorded, what it is told is of no interest.
#pragma once

#include <functional>
#include <map>
#include <string>

#include "record/bus_recording.hpp"
#include "record/tended_recording.hpp"

namespace vagus::serve {

class ScriptsRecording {
public:
    explicit ScriptsRecording(std::function<void(const std::string& warning)> warn)
        : tended_(std::move(warn)) {}

    // Ends the one before. The network is borrowed until end(); the clock counts from now. Whatever
    // goes wrong is said, and the scripts run on.
    void begin(const std::string& path, record::RunFile about,
               const std::map<std::string, std::string>& files, const debug::Network& network,
               record::BusRecording::Clock clock);
    void frame(const wire::Frame& frame) {
        if (bus_) bus_->frame(frame);
    }
    void happened(const debug::Event& event) {
        if (bus_) bus_->happened(event);
    }
    // A node has got what this file says.
    void loaded(uint16_t node, const std::string& file, const std::string& text) {
        if (bus_) bus_->loaded(node, file, text);
    }
    void end();

    record::TendedRecording& tended() { return tended_; }
    const record::TendedRecording& tended() const { return tended_; }

private:
    record::TendedRecording tended_;
    record::BusRecording* bus_ = nullptr;  // the same one, as what it is
};

}  // namespace vagus::serve
