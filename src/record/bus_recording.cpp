#include "record/bus_recording.hpp"

#include <utility>
#include <variant>

namespace vagus::record {

Result<std::unique_ptr<BusRecording>> BusRecording::begin(
    const std::string& path, RunFile about, const std::map<std::string, std::string>& files,
    const debug::Network& network, Clock clock) {
    about.kind = kBusKind;
    PackedFiles packed = pack(files);
    auto tape = TRY(start_tape(path, about, packed, Pace::NeverWaits));
    // make_unique cannot reach the constructor.
    return std::unique_ptr<BusRecording>(new BusRecording(
        std::move(tape), format_run(about), std::move(packed), network, std::move(clock)));
}

BusRecording::BusRecording(std::unique_ptr<FileTape> tape, std::string_view run, PackedFiles files,
                           const debug::Network& network, Clock clock)
    : Recording(std::move(tape), run, std::move(files)),
      network_(network),
      clock_(std::move(clock)),
      bus_(*tape_) {
    bus_.begin(network_.common());
}

BusRecording::~BusRecording() {
    (void)end().ok();
}

void BusRecording::described(const debug::NodeView& node) {
    if (!is_stopped()) bus_.described(now(), node);
}

void BusRecording::frame(const wire::Frame& frame) {
    if (is_stopped()) return;
    ++frames_;
    (void)bus_.frame(now(), {.frame = frame});
}

void BusRecording::happened(const debug::Event& event) {
    if (is_stopped()) return;
    if (std::holds_alternative<debug::NodeDescribed>(event.what)) {
        const debug::NodeView* const node = network_.node(event.node);
        if (node != nullptr) described(*node);
    }
    bus_.happened(now(), event);
}

void BusRecording::loaded(uint16_t node, const std::string& file, const std::string& text) {
    if (is_stopped()) return;
    bus_.begin(network_.common());
    const std::string name = name_in_it(file);
    if (!name.empty()) put(ScriptLoaded{node, name, text});
}

Status BusRecording::end(const std::string& why) {
    if (!recorder_) return Status::done();
    if (!is_stopped()) put(RecordingEnds{why});
    recorder_.reset();
    const Status written = tape_->end();
    return is_stopped() ? Status::done() : written;
}

}  // namespace vagus::record
