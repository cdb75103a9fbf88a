#include "record/past_run.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/file.hpp"
#include "base/seconds.hpp"
#include "record/topics.hpp"

namespace vagus::record {

Result<RunFile> run_of(const mcap::Reader& reader) {
    const mcap::Channel* const channel = reader.find(kRunTopic);
    mcap::Cursor cursor(reader);
    while (const auto message = cursor.next()) {
        if (channel != nullptr && message->channel == channel->id) {
            return read_run(message->data, reader.name());
        }
    }
    return read_run("", reader.name());
}

Result<std::vector<Input>> inputs_of(const mcap::Reader& reader) {
    std::vector<Input> inputs;
    const mcap::Channel* const channel = reader.find(kInputTopic);
    mcap::Cursor cursor(reader);
    while (const auto message = cursor.next()) {
        if (channel == nullptr || message->channel != channel->id) continue;
        const Time at = time_of(message->log_time);
        inputs.push_back(TRY(read_input(message->data, at, reader.name())));
    }
    return inputs;
}

Time end_of(const mcap::Reader& reader) {
    Time end{};
    mcap::Cursor cursor(reader);
    while (const auto message = cursor.next()) end = std::max(end, time_of(message->log_time));
    return end;
}

Result<std::string> PastRun::folder(const std::string& path) const {
    const std::string& name = about.plan.empty() ? about.world : about.plan;
    if (path.ends_with("/" + name)) return path.substr(0, path.size() - name.size());
    return Error{Code::Refused, fmt::format("{}: the recorded run was of {}", path, name)};
}

Result<PastRun> read_past(const std::string& path, Time until) {
    const MappedFile file = TRY(MappedFile::open(path));
    const mcap::Reader reader = TRY(mcap::Reader::open(file.bytes(), path));
    PastRun past{.about = TRY(run_of(reader)), .files = {}, .inputs = {}, .until = until};
    if (past.about.verb != kStudioVerb) {
        return Error{Code::Refused, fmt::format("{}: is no recording of a run of the studio; "
                                                "`vagus replay --from` continues it",
                                                path)};
    }
    const Time end = end_of(reader);
    if (until > end) {
        return Error{Code::BadInput, fmt::format("{} s: the recording of this run ends at {} s",
                                                 seconds_text(until), seconds_text(end))};
    }
    for (const mcap::Attachment& one : reader.attachments()) {
        past.files.emplace(one.name, one.data);
    }
    past.inputs = TRY(inputs_of(reader));
    std::erase_if(past.inputs,
                  [until](const Input& one) { return one.turn != 0 && one.at >= until; });
    return past;
}

}  // namespace vagus::record
