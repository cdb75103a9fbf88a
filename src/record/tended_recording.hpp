// A recording that is being made of a run of the studio, for those who are told of it: a person, of
// why it ended before its run and of what was left out; whoever asks it, when all of it is in the
// file.
//
//     TendedRecording tended(warn);
//     tended.keep(std::move(recording), "variables");
//     tended.flush([] { read(); });                  // told by tend() or end()
//     tended.tend();                                 // now and then, at the latest at next_tick()
//     tended.end();                                  // whatever it records is still there
//
// Without a recording it does nothing.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "record/recording.hpp"

namespace vagus::record {

constexpr uint64_t kStudioRecordingBytesMax = uint64_t{512} << 20;  // then it ends, and says so

class TendedRecording {
public:
    explicit TendedRecording(std::function<void(const std::string& warning)> warn)
        : warn_(std::move(warn)) {}

    // `samples` is what may be left out of it, in words.
    void keep(std::unique_ptr<Recording> recording, std::string samples);
    // There is none, and the run goes on.
    void cannot(const std::string& why) { warn_("this run is not recorded: " + why); }
    bool is_there() const { return recording_ != nullptr; }

    // `done` is told when all that has been recorded by now is in the file.
    void flush(std::function<void()> done);
    void tend();
    // By any clock: `now` is its time.
    Time next_tick(Time now) const;
    void end();

private:
    void tell_trouble();
    void answer_flushes(bool all);

    const std::function<void(const std::string& warning)> warn_;
    std::unique_ptr<Recording> recording_;
    std::string samples_;
    std::vector<std::pair<uint64_t, std::function<void()>>> flushes_;  // by numbers of the tape
};

}  // namespace vagus::record
