#include "record/tended_recording.hpp"

#include <fmt/format.h>

namespace vagus::record {

namespace {

constexpr Duration kFlushLookEvery = std::chrono::milliseconds(20);

}  // namespace

void TendedRecording::keep(std::unique_ptr<Recording> recording, std::string samples) {
    recording_ = std::move(recording);
    recording_->keep_at_most(kStudioRecordingBytesMax);
    samples_ = std::move(samples);
}

void TendedRecording::flush(std::function<void()> done) {
    if (!recording_) return done();
    flushes_.emplace_back(recording_->flush(), std::move(done));
}

void TendedRecording::tend() {
    if (!recording_) return;
    recording_->tend();
    tell_trouble();
    answer_flushes(false);
}

Time TendedRecording::next_tick(Time now) const {
    return flushes_.empty() ? Time::max() : now + kFlushLookEvery;
}

void TendedRecording::end() {
    if (!recording_) return;
    const Status ended = recording_->end();
    tell_trouble();
    if (!ended.ok()) warn_(ended.error().what);
    if (recording_->dropped() > 0) {
        warn_(
            fmt::format("the disk was too slow for the recording of this run: {} samples of {} "
                        "were left out",
                        recording_->dropped(), samples_));
    }
    answer_flushes(true);
    recording_.reset();
}

void TendedRecording::tell_trouble() {
    if (const auto trouble = recording_->take_trouble()) warn_(*trouble);
}

// Whoever is answered may ask for the next one.
void TendedRecording::answer_flushes(bool all) {
    std::vector<std::function<void()>> done;
    std::erase_if(flushes_, [&](auto& one) {
        if (!all && !recording_->flushed(one.first)) return false;
        done.push_back(std::move(one.second));
        return true;
    });
    for (const auto& tell : done) tell();
}

}  // namespace vagus::record
