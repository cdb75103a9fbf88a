#include "serve/history/kept_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "base/file.hpp"
#include "base/seconds.hpp"
#include "mcap/reader.hpp"
#include "plan/check.hpp"
#include "record/bus_messages.hpp"
#include "record/damage.hpp"
#include "record/past_run.hpp"
#include "record/robot_topics.hpp"
#include "record/topics.hpp"
#include "serve/edit/text_places.hpp"
#include "serve/history/recorded_world.hpp"
#include "serve/json.hpp"
#include "wire/bytes.hpp"

namespace vagus::serve {

namespace {

constexpr double kForEver = 1e12;  // seconds; what is opened is kept whole
constexpr size_t kNameMax = 128;
constexpr size_t kNodesNamedMax = 2048;

std::shared_ptr<KeptRun> kept(const KeptFile& file) {
    auto run = std::make_shared<KeptRun>();
    run->path = file.path;
    run->written = file.written;
    return run;
}

// Files of plans as documents of the project.
PlanPast::DocOf doc_of(const KeptFile& file) {
    return [plans = file.plans](const std::string& real) {
        const auto found = std::ranges::find(plans, real, &KeptFile::Plan::real);
        return found == plans.end() ? real : found->doc;
    };
}

// The plan of the project that has this name; empty if none has.
std::string plan_file_of(const std::vector<KeptFile::Plan>& plans, const std::string& name) {
    const std::string plan = name.substr(0, name.find('/'));
    for (const KeptFile::Plan& one : plans) {
        const Json json = Json::parse(one.text, nullptr, false);
        if (json.is_object() && json.contains("name") && json["name"] == plan) return one.real;
    }
    return {};
}

// ---- traces ----

Result<std::shared_ptr<KeptRun>> read_trace(const KeptFile& file) {
    const std::string text = TRY(read_file(file.real));
    const auto first = TraceLine::read(text.substr(0, text.find('\n')));
    if (!first.ok()) {
        return Error{Code::BadInput, fmt::format("{}:1: {}", file.path, first.error().what)};
    }
    const std::string name = first.value().plan();
    auto run = kept(file);
    const std::string plan = plan_file_of(file.plans, name);
    run->has_plan = !plan.empty();
    History::Beginning beginning{.kind = "trace", .name = file.path, .plan_seconds = kForEver};
    if (run->has_plan) beginning.plans = read_plans(plan);
    // Without its plan a trace still says who worked, and when.
    if (beginning.plans.empty()) beginning.plans.emplace_back().name = name;
    beginning.doc_of = doc_of(file);
    run->history.begin(std::move(beginning));
    for (size_t at = 0; at < text.size();) {
        const size_t stop = std::min(text.find('\n', at), text.size());
        const bool good = run->history.trace(text.substr(at, stop - at));
        ++(good ? run->lines : run->refused);
        at = stop + 1;
    }
    return run;
}

// ---- recordings ----

// Plan files as they were: those of the recording, and over them what was saved while it ran.
class FilesThen final : public plan::Files {
public:
    explicit FilesThen(const mcap::Reader& reader) : reader_(reader) {}
    Result<std::string> read(const std::string& path) const override {
        const auto saved = saved_.find(path);
        if (saved != saved_.end()) return saved->second;
        const mcap::Attachment* const file = reader_.attachment(path);
        if (file != nullptr) return std::string(file->data);
        return Error{Code::NotFound, path + ": is not in the recording"};
    }
    void save(const std::map<std::string, std::string>& texts) {
        for (const auto& [name, text] : texts) saved_[name] = text;
    }

private:
    const mcap::Reader& reader_;
    std::map<std::string, std::string> saved_;
};

class RecordingReader {
public:
    RecordingReader(const KeptFile& file, const mcap::Reader& reader, record::RecordedRun recorded)
        : file_(file),
          reader_(reader),
          recorded_(std::move(recorded)),
          robots_(recorded_.about.robots.begin(), recorded_.about.robots.end()),
          world_(reader, recorded_.about),
          files_(reader) {}

    Result<std::shared_ptr<KeptRun>> read() {
        run_ = kept(file_);
        run_->scene = world_.scene();
        run_->robots = recorded_.about.robots;
        TRY(choose_robot());
        begin();
        mcap::Cursor cursor(reader_);
        while (const auto message = cursor.next()) {
            const mcap::Channel* const channel = reader_.channel(message->channel);
            if (channel == nullptr) continue;
            const Time at = record::time_of(message->log_time);
            const std::string robot = record::robot_of(channel->topic, robots_);
            if (world_.see(channel->topic, at, message->data)) {
                run_->history.record(world_.take());
            } else if (robot.empty()) {
                see(channel->topic, at, message->data);
            } else {
                see_of(robot, record::below_robot(channel->topic, robot), at, message->data);
            }
        }
        TRY(record::check_read(cursor, reader_));
        run_->history.passed(seconds_of(recorded_.end));
        return run_;
    }

private:
    Status choose_robot() {
        const std::vector<std::string>& all = run_->robots;
        plan_ = recorded_.about.plan;
        if (all.empty() && file_.robot.empty()) return Status::done();
        run_->robot = file_.robot.empty() ? all.front() : file_.robot;
        if (std::ranges::find(all, run_->robot) == all.end()) {
            return Error{Code::NotFound,
                         fmt::format("{}: no robot {} with a project of its own is in this "
                                     "recording{}",
                                     file_.path, file_.robot,
                                     all.empty() ? "" : "; the first that is there is " + all[0])};
        }
        plan_ = plan_of(run_->robot);
        return Status::done();
    }

    // The file of its plan, which the first line of its trace names; empty: it has none.
    std::string plan_of(const std::string& robot) const {
        const mcap::Channel* const trace = reader_.find(std::string(record::kRobotTopics) + robot +
                                                        std::string(record::kTraceTopic));
        mcap::Cursor cursor(reader_);
        while (const auto message = trace == nullptr ? std::nullopt : cursor.next()) {
            if (message->channel != trace->id) continue;
            const auto line = TraceLine::read(message->data);
            return line.ok() ? recorded_plan(line.value().plan()) : "";
        }
        return {};
    }

    std::string recorded_plan(const std::string& name) const {
        for (const mcap::Attachment& one : reader_.attachments()) {
            if (!one.name.ends_with(".plan.json")) continue;
            const Json json = Json::parse(one.data, nullptr, false);
            if (json.is_object() && json.value("name", Json()) == name)
                return std::string(one.name);
        }
        return {};
    }

    void begin() {
        History::Beginning beginning{.kind = "trace", .name = file_.path, .plan_seconds = kForEver};
        if (plan_.empty()) {
            run_->has_plan = true;
        } else {
            beginning.plans = read_plans(plan_, files_);
            beginning.doc_of = doc_of_recorded(plan_);
        }
        run_->history.begin(std::move(beginning));
    }

    // Of other robots than the chosen one there are the events; what its nodes tell each other is
    // known by their numbers alone.
    void see_of(const std::string& robot, std::string_view topic, Time at, std::string_view data) {
        if (topic == record::kTraceTopic && robot == run_->robot) {
            see_line(at, std::string(data));
        } else if (topic == record::kEventsTopic) {
            see_event(at, data, robot);
        }
    }

    // "r4" said what its plan, or another host, sends; "r4/drive" what its node drive does.
    std::string source_of(const std::string& robot, uint16_t node) {
        if (node == 0) return robot;
        const size_t index = size_t{node} - world_.first_node(robot);
        const std::vector<std::string>& names = nodes_of(robot);
        return robot + "/" + (index < names.size() ? names[index] : fmt::format("node {}", node));
    }

    // As their channels are named, which are in their order.
    const std::vector<std::string>& nodes_of(const std::string& robot) {
        const auto [found, is_new] = nodes_.try_emplace(robot);
        if (!is_new) return found->second;
        constexpr std::string_view kBegins = "/node/", kEnds = "/variables";
        for (const mcap::Channel& channel : reader_.channels()) {
            if (record::robot_of(channel.topic, robots_) != robot) continue;
            const std::string_view topic = record::below_robot(channel.topic, robot);
            if (!topic.starts_with(kBegins) || !topic.ends_with(kEnds)) continue;
            const std::string_view name = topic.substr(kBegins.size());
            found->second.emplace_back(name.substr(0, name.size() - kEnds.size()));
        }
        return found->second;
    }

    // The plan may lie in another folder of the project than then.
    PlanPast::DocOf doc_of_recorded(const std::string& plan) {
        for (const KeptFile::Plan& one : file_.plans) {
            const auto paths = record::paths_beside(plan, one.real);
            if (!paths) continue;
            run_->has_plan = true;
            return [here = doc_of(file_), paths = *paths](const std::string& name) {
                return here(paths.of(name));
            };
        }
        return [](const std::string& name) { return name; };
    }

    void see(std::string_view topic, Time at, std::string_view data) {
        if (topic == record::kTraceTopic) {
            see_line(at, std::string(data));
        } else if (topic == record::kEventsTopic) {
            see_event(at, data);
        } else if (topic == record::kNodesTopic) {
            see_node(at, data);
        } else if (topic == record::kFramesTopic) {
            see_frame(at, data);
        }
    }

    // A version of the plan was read when its files were saved, and takes over at its own line.
    void see_line(Time at, const std::string& text) {
        const auto line = TraceLine::read(text);
        const auto event = line.ok() ? line.value().event() : std::nullopt;
        if (event && std::holds_alternative<plan::PlanChanged>(event->what)) take_over(at);
        ++(run_->history.trace(text) ? run_->lines : run_->refused);
    }

    void take_over(Time at) {
        for (; input_ < recorded_.inputs.size() && recorded_.inputs[input_].at <= at; ++input_) {
            const auto* const saved =
                std::get_if<record::PlanFiles>(&recorded_.inputs[input_].what);
            if (saved != nullptr) files_.save(saved->texts);
        }
        run_->history.plan(++version_, read_plans(plan_, files_));
    }

    void see_event(Time at, std::string_view data, const std::string& robot = "") {
        const auto event = record::read_event(at, data);
        if (!event) return;
        Happened happened{.t = seconds_of(event->at), .kind = "event", .node = event->node};
        happened.source = event->by.empty() ? name_of(event->node) : kHostName;
        if (!robot.empty()) happened.source = source_of(robot, event->node);
        happened.name = line_of(event->name, kNameMax);
        happened.args = event->arguments;
        run_->history.happen(std::move(happened));
    }

    void see_node(Time at, std::string_view data) {
        const auto told = record::read_node(data);
        if (!told) return;
        if (names_.size() < kNodesNamedMax || names_.contains(told->node)) {
            names_[told->node] = line_of(told->name, kNameMax);
        }
        const std::string name = name_of(told->node);
        run_->history.happen({.t = seconds_of(at),
                              .kind = told->left ? "gone" : "appeared",
                              .node = told->node,
                              .source = name,
                              .name = name});
    }

    // What a node has told of its words.
    void see_frame(Time at, std::string_view data) {
        const auto recorded = record::read_frame(data);
        if (!recorded) return;
        const wire::Frame& frame = recorded->frame;
        if (frame.type != static_cast<uint16_t>(wire::MessageType::Variables)) return;
        wire::Reader reader(frame.payload, frame.size);
        const uint16_t begin = reader.u16();
        std::vector<int16_t> words;
        while (reader.left() >= 2) words.push_back(reader.i16());
        if (words.empty() || size_t{begin} + words.size() > 0x10000) return;
        run_->history.words(seconds_of(at), frame.source, begin, words);
    }

    std::string name_of(uint16_t node) const {
        const auto known = names_.find(node);
        return known == names_.end() ? fmt::format("node {}", node) : known->second;
    }

    const KeptFile& file_;
    const mcap::Reader& reader_;
    const record::RecordedRun recorded_;
    const record::RobotNames robots_;  // that have projects of their own
    RecordedWorld world_;
    FilesThen files_;
    std::string plan_;  // its file in the recording
    std::shared_ptr<KeptRun> run_;
    std::map<uint16_t, std::string> names_;  // of nodes, as they described themselves
    std::map<std::string, std::vector<std::string>> nodes_;  // names of those of a robot
    size_t input_ = 0;                                       // the next
    uint64_t version_ = 1;                                   // of the plan
};

Result<std::shared_ptr<KeptRun>> read_recording(const KeptFile& file) {
    const MappedFile mapped = TRY(MappedFile::open(file.real));
    const mcap::Reader reader = TRY(mcap::Reader::open(mapped.bytes(), file.path));
    record::RecordedRun recorded = TRY(record::read_recorded(reader));
    return RecordingReader(file, reader, std::move(recorded)).read();
}

}  // namespace

bool is_recording_file(const std::string& path) {
    return path.ends_with(".mcap");
}

Result<std::shared_ptr<KeptRun>> read_kept_run(const KeptFile& file) {
    return is_recording_file(file.path) ? read_recording(file) : read_trace(file);
}

}  // namespace vagus::serve
