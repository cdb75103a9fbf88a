#include "serve/workbench/scripts_recording.hpp"

#include <fmt/format.h>

#include "record/studio_recording.hpp"

namespace vagus::serve {

namespace {

constexpr Duration kFlushLookEvery = 20ms;

}  // namespace

void ScriptsRecording::begin(const std::string& path, record::RunFile about,
                             const std::map<std::string, std::string>& files,
                             const debug::Network& network, record::BusRecording::Clock clock) {
    end();
    auto begun =
        record::BusRecording::begin(path, std::move(about), files, network, std::move(clock));
    if (!begun.ok()) return say_("warning", "this run is not recorded: " + begun.error().what);
    recording_ = std::move(begun.value());
    recording_->keep_at_most(record::kStudioRecordingBytesMax);
    for (const debug::NodeId id : network.nodes()) {
        const debug::NodeView* const node = network.node(id);
        if (node != nullptr && node->described) recording_->described(*node);
    }
}

void ScriptsRecording::end() {
    if (!recording_) return;
    const Status ended = recording_->end();
    tell_trouble();
    if (!ended.ok()) say_("warning", ended.error().what);
    if (recording_->dropped() > 0) {
        say_("warning", fmt::format("the disk was too slow for the recording of this run: {} "
                                    "samples of variables were left out",
                                    recording_->dropped()));
    }
    answer_flushes(true);
    recording_.reset();
}

void ScriptsRecording::flush(std::function<void()> done) {
    if (!recording_) return done();
    flushes_.emplace_back(recording_->flush(), std::move(done));
}

void ScriptsRecording::tick() {
    if (!recording_) return;
    recording_->tend();
    tell_trouble();
    answer_flushes(false);
}

Time ScriptsRecording::next_tick(Time now) const {
    return flushes_.empty() ? Time::max() : now + kFlushLookEvery;
}

void ScriptsRecording::tell_trouble() {
    if (const auto trouble = recording_->take_trouble()) say_("warning", *trouble);
}

// Whoever is answered may ask for the next one.
void ScriptsRecording::answer_flushes(bool all) {
    std::vector<std::function<void()>> done;
    std::erase_if(flushes_, [&](auto& one) {
        if (!all && !recording_->flushed(one.first)) return false;
        done.push_back(std::move(one.second));
        return true;
    });
    for (const auto& tell : done) tell();
}

}  // namespace vagus::serve
