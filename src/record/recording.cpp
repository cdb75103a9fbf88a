#include "record/recording.hpp"

#include <fmt/format.h>

#include "base/seconds.hpp"

namespace vagus::record {

Recording::Recording(std::unique_ptr<FileTape> tape, std::string_view run, PackedFiles files)
    : tape_(std::move(tape)),
      recorder_(std::make_unique<Recorder>(*tape_, run)),
      files_(std::move(files)) {
    for (auto& [name, content] : files_.files) content.clear();
}

void Recording::tend() {
    if (stopped_ || !recorder_) return;
    const Status state = tape_->state();
    if (!state.ok()) return stop(state.error().what);
    if (tape_->bytes() <= bytes_max_) return;
    stop(fmt::format("it has {} MB, and more are not kept of one run", bytes_max_ >> 20));
}

void Recording::stop(const std::string& why) {
    if (std::exchange(stopped_, true)) return;
    const Time at = now();
    put(RecordingEnds{why});
    tape_->close();
    trouble_ = fmt::format("the recording of this run ends at {} s: {}", seconds_text(at), why);
}

std::string Recording::name_in_it(const std::string& path) const {
    const std::string name = files_.name_of(path);
    return name.starts_with("..") ? "" : name;
}

Result<PlanFiles> Recording::named(const FilesSaved& files) const {
    PlanFiles named;
    for (const std::string& path : files.saved) named.saved.push_back(name_in_it(path));
    for (const auto& [path, text] : files.read) {
        const std::string name = name_in_it(path);
        if (name.empty()) {
            return Error{Code::Refused, path +
                                            " is outside of the folder of this recording; "
                                            "begin the run again"};
        }
        named.texts[name] = text;
    }
    return named;
}

}  // namespace vagus::record
