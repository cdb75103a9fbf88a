#include "record/past_run.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/file.hpp"
#include "base/seconds.hpp"
#include "record/damage.hpp"
#include "record/topics.hpp"

namespace vagus::record {

Time end_of(const mcap::Reader& reader) {
    Time end{};
    mcap::Cursor cursor(reader);
    while (const auto message = cursor.next()) end = std::max(end, time_of(message->log_time));
    return end;
}

Result<RecordedRun> read_recorded(const mcap::Reader& reader) {
    const mcap::Channel* const run = reader.find(kRunTopic);
    const mcap::Channel* const input = reader.find(kInputTopic);
    std::string about;
    RecordedRun recorded;
    mcap::Cursor cursor(reader);
    while (const auto message = cursor.next()) {
        const Time at = time_of(message->log_time);
        recorded.end = std::max(recorded.end, at);
        if (run != nullptr && message->channel == run->id && about.empty()) about = message->data;
        if (input == nullptr || message->channel != input->id) continue;
        recorded.inputs.push_back(TRY(read_input(message->data, at, reader.name())));
    }
    TRY(check_read(cursor, reader));
    recorded.about = TRY(read_run(about, reader.name()));
    return recorded;
}

std::string PastPaths::of(const std::string& name) const {
    const std::filesystem::path from = name_.empty() ? "." : name_;
    return (folder_ / std::filesystem::path(name).lexically_relative(from))
        .lexically_normal()
        .string();
}

std::optional<PastPaths> paths_beside(const std::string& name, const std::string& path) {
    const std::filesystem::path here(path), then(name);
    if (here.filename() != then.filename()) return std::nullopt;
    return PastPaths(here.parent_path(), then.parent_path());
}

Result<PastPaths> PastRun::paths(const std::string& path) const {
    if (const auto paths = paths_beside(main(), path)) return *paths;
    return Error{Code::Refused, fmt::format("{}: the recorded run was of {}", path, main())};
}

namespace {

bool ends_it(const Input& input) {
    return std::holds_alternative<RecordingEnds>(input.what);
}

bool comes_by_itself(const Input& input) {
    return ends_it(input) || std::holds_alternative<Reseeded>(input.what);
}

// Inputs of other verbs than the studio's have no turns.
Status check_lived(const PastRun& past, const std::string& path) {
    if (past.about.is_of_bus()) {
        return Error{Code::Refused, path +
                                        ": is a recording of a real bus, whose robot cannot be "
                                        "run again"};
    }
    if (!past.about.answers.empty()) {
        return Error{Code::Refused, path +
                                        ": is of a run with answers instead of a robot; "
                                        "`vagus replay` runs it again"};
    }
    TRY(check_no_fleet(past.about, path,
                       ", which the studio does not run; `vagus replay` runs it again"));
    const bool loads_first = past.about.verb == kStudioVerb || past.about.verb == kTestVerb;
    if (!loads_first && past.about.plan.empty()) {
        return Error{Code::Refused, path +
                                        ": is of a world without a plan, recorded by `vagus "
                                        "sim`; `vagus replay` runs it again"};
    }
    if (past.about.verb == kStudioVerb || std::ranges::all_of(past.inputs, comes_by_itself)) {
        return Status::done();
    }
    return Error{Code::Refused, fmt::format("{}: somebody did something to this run of `vagus {}`; "
                                            "`vagus replay` runs it again",
                                            path, past.about.verb)};
}

}  // namespace

Result<PastRun> read_past(const std::string& path, std::optional<Time> until) {
    const MappedFile file = TRY(MappedFile::open(path));
    const mcap::Reader reader = TRY(mcap::Reader::open(file.bytes(), path));
    RecordedRun recorded = TRY(read_recorded(reader));
    const Time end = recorded.end;
    if (until.value_or(end) > end) {
        return Error{Code::BadInput, fmt::format("{} s: the recording of this run ends at {} s",
                                                 seconds_text(*until), seconds_text(end))};
    }
    PastRun past{.about = std::move(recorded.about),
                 .files = {},
                 .inputs = std::move(recorded.inputs),
                 .until = until.value_or(end)};
    TRY(check_lived(past, path));
    for (const mcap::Attachment& one : reader.attachments()) {
        past.files.emplace(one.name, one.data);
    }
    std::erase_if(past.inputs, [&past](const Input& one) {
        return ends_it(one) || (one.turn != 0 && one.at >= past.until);
    });
    return past;
}

}  // namespace vagus::record
