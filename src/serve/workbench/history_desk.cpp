#include "serve/workbench/history_desk.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/file.hpp"
#include "serve/json.hpp"

namespace vagus::serve {

namespace fs = std::filesystem;

namespace {

constexpr double kTellEvery = 0.1;  // seconds of the run, while it goes

std::optional<uint16_t> word_of(const Json& json) {
    if (!json.is_number_unsigned() || json.get<uint64_t>() > 0xffff) return std::nullopt;
    return json.get<uint16_t>();
}

// Lists of numbers, each of `count`: [node, first, count], [node, address].
Result<std::vector<std::vector<uint16_t>>> numbers_in(const Json& in, const char* key,
                                                      size_t count) {
    std::vector<std::vector<uint16_t>> lists;
    for (const Json& json : in.value(key, Json::array())) {
        std::vector<uint16_t> list;
        for (const Json& one : json.is_array() ? json : Json::array()) {
            if (const auto word = word_of(one)) list.push_back(*word);
        }
        if (list.size() != count || json.size() != count) {
            return Error{Code::BadInput,
                         fmt::format("in.{}[{}]: expected {} whole numbers from 0 to 65535", key,
                                     lists.size(), count)};
        }
        lists.push_back(std::move(list));
    }
    return lists;
}

Status check_time(const Json& in, const char* key) {
    const double t = in[key];
    if (std::isfinite(t) && t >= 0 && t <= 1e12) return Status::done();
    return Error{Code::BadInput,
                 fmt::format("in.{}: expected seconds from 0 to 1e12, found {}", key, t)};
}

Result<History::Instant> instant_of(const Json& in) {
    TRY(check_time(in, "t"));
    History::Instant instant{in["t"], {}, in.value("events", size_t{0})};
    for (const auto& one : TRY(numbers_in(in, "ranges", 3))) {
        instant.ranges.push_back({one[0], one[1], one[2]});
    }
    instant.rays = in.value("rays", false);
    instant.picture = in.value("picture", "");
    return instant;
}

Result<History::Window> window_of(const Json& in) {
    TRY(check_time(in, "from"));
    TRY(check_time(in, "to"));
    History::Window window{in["from"], in["to"], in["width"], {}};
    if (window.to <= window.from) {
        return Error{Code::BadInput, fmt::format("in.to: expected a time after in.from, {} s; "
                                                 "found {} s",
                                                 window.from, window.to)};
    }
    for (const auto& one : TRY(numbers_in(in, "words", 2))) {
        window.words.push_back({one[0], one[1]});
    }
    return window;
}

}  // namespace

HistoryDesk::HistoryDesk(Desk& desk, Files& files, Worker::Post post)
    : desk_(desk), files_(files), post_(std::move(post)) {
    declare();
}

void HistoryDesk::declare() {
    desk_.topics().document("history", [this](const Json&) { return now_->document(); });
    desk_.command("history.at", [this](const Call& call) {
        const auto instant = instant_of(call.in);
        if (!instant.ok()) return call.fail(instant.error());
        ask(call,
            [call, instant](const History& history) { call.done(history.at(instant.value())); });
    });
    desk_.command("history.lanes", [this](const Call& call) {
        const auto window = window_of(call.in);
        if (!window.ok()) return call.fail(window.error());
        ask(call,
            [call, window](const History& history) { call.done(history.lanes(window.value())); });
    });
    desk_.command("history.ways", [this](const Call& call) {
        for (const char* key : {"from", "to"}) {
            const Status good = check_time(call.in, key);
            if (!good.ok()) return call.fail(good.error());
        }
        ask(call, [call](const History& history) {
            call.done(history.ways(call.in["from"], call.in["to"]));
        });
    });
    desk_.command("history.open", [this](const Call& call) {
        open(call, [call](const KeptRun& run) {
            Json opened = {{"from", run.history.from()},
                           {"to", run.history.to()},
                           {"lines", run.lines},
                           {"refused", run.refused},
                           {"plan", run.has_plan}};
            if (!run.robots.empty()) {
                opened["robots"] = run.robots;
                opened["robot"] = run.robot;
            }
            if (!run.scene.is_null()) opened["scene"] = run.scene;
            call.done(std::move(opened));
        });
    });
    desk_.command("history.save", [this](const Call& call) {
        const auto saved = save();
        if (!saved.ok()) return call.fail(saved.error());
        call.done({{"path", saved.value()}});
    });
}

void HistoryDesk::ask(const Call& call, const Ask& then) {
    if (call.in.contains("trace")) {
        return open(call, [then](const KeptRun& run) { then(run.history); });
    }
    if (now_->empty()) return call.fail("unavailable", "nothing has run yet; Run starts it");
    then(*now_);
}

// ---- what is told ----

void HistoryDesk::begin(History::Beginning beginning) {
    beginning.doc_of = [this](const std::string& file) { return doc_of_(file); };
    beginning.run = ++run_;
    next_ = std::make_unique<History>();
    next_->begin(std::move(beginning));
    if (now_->empty()) now_ = std::move(next_);
    desk_.topics().touch("history");
}

void HistoryDesk::continue_from(double t) {
    next_.reset();
    now_->continue_from(t, ++run_);
    desk_.topics().touch("history");
}

void HistoryDesk::forget() {
    next_.reset();
    now_ = std::make_unique<History>();
    for (auto& run : std::exchange(kept_, {})) drop(std::move(run));
    for (const auto& [key, waiting] : std::exchange(waiting_, {})) {
        for (const Waiting& one : waiting) {
            one.call.fail("unavailable", key.path + ": the project was closed while it was read");
        }
    }
    desk_.topics().touch("history");
}

// What was opened goes as soon as time passes: then it takes the place of what ran before.
History& HistoryDesk::told_at(double t) {
    if (next_ && t <= 0) return *next_;
    if (next_) {
        now_ = std::move(next_);
        desk_.topics().touch("history");
    }
    return *now_;
}

void HistoryDesk::plan(const talk::PlanVersion& version) {
    PlanPast::Texts texts;
    for (const auto& [file, text] : version.texts) texts.emplace(doc_of_(file), text);
    (next_ ? *next_ : *now_).plan(version.number, version.plans, std::move(texts));
}

std::optional<std::string> HistoryDesk::plan_text(double t, const std::string& doc) const {
    return now_->plan() ? now_->plan()->text_at(t, doc) : std::nullopt;
}

void HistoryDesk::trace(const std::string& line) {
    (void)(next_ ? *next_ : *now_).trace(line);
}

void HistoryDesk::records(const std::string& bytes) {
    double last = 0;
    (void)each_record(bytes, {[&](double t, std::string_view) { last = t; }});
    (void)told_at(last).record(bytes);
}

void HistoryDesk::picture(KeptPicture picture) {
    told_at(picture.t).picture(std::move(picture));
}

void HistoryDesk::happened(Happened happened) {
    told_at(happened.t).happen(std::move(happened));
}

void HistoryDesk::words(double t, uint16_t node, uint16_t address,
                        std::span<const int16_t> values) {
    told_at(t).words(t, node, address, values);
}

void HistoryDesk::unwatched(double t, uint16_t node, uint16_t address, uint16_t count) {
    told_at(t).forget(t, node, address, count);
}

void HistoryDesk::tick(double t) {
    told_at(t).passed(t);
    const double to = now_->to();
    if (std::abs(to - told_to_) < kTellEvery) return;
    told_to_ = to;
    desk_.topics().touch("history");
}

// ---- runs as files ----

bool HistoryDesk::is(const KeptRun& run, const KeptKey& key) {
    const bool first = run.robots.empty() || run.robot == run.robots.front();
    return run.path == key.path && (run.robot == key.robot || (key.robot.empty() && first));
}

void HistoryDesk::open(const Call& call, const Use& use) {
    const std::string path = call.in["trace"];
    auto file = look_for(path);
    if (!file.ok()) return call.fail(file.error());
    file.value().robot = call.in.value("robot", "");
    const KeptKey key{path, file.value().robot};
    const auto known = std::ranges::find_if(kept_, [&](const auto& one) { return is(*one, key); });
    if (known != kept_.end() && (*known)->written == file.value().written) {
        kept_.splice(kept_.begin(), kept_, known);
        return use(*kept_.front());
    }
    std::vector<Waiting>& waiting = waiting_[key];
    waiting.push_back({call, use});
    if (waiting.size() > 1) return;
    using Read = Result<std::shared_ptr<KeptRun>>;
    worked<Read>(
        post_, [file = std::move(file.value())] { return read_kept_run(file); },
        [this, key](const Read& read) { opened(key, read); });
}

// Of several requests while it was read each gets its answer.
void HistoryDesk::opened(const KeptKey& key, const Result<std::shared_ptr<KeptRun>>& read) {
    const auto waiting = waiting_.extract(key);
    if (waiting.empty()) return;
    if (read.ok()) {
        for (auto one = kept_.begin(); one != kept_.end();) {
            const auto next = std::next(one);
            if (is(**one, key)) drop(std::move(*one)), kept_.erase(one);
            one = next;
        }
        kept_.push_front(read.value());
        if (kept_.size() > kRunsOpen) drop(std::move(kept_.back())), kept_.pop_back();
    }
    for (const Waiting& one : waiting.mapped()) {
        read.ok() ? one.use(*read.value()) : one.call.fail(read.error());
    }
}

// To forget a long one takes a while, too.
void HistoryDesk::drop(std::shared_ptr<KeptRun> run) {
    post_([run = std::move(run)]() -> Worker::Then { return [] {}; });
}

// Recordings of the last runs are no files of the project, and are found all the same.
Result<KeptFile> HistoryDesk::look_for(const std::string& path) const {
    const bool recording = is_recording_file(path);
    KeptFile file{.path = path, .real = (files_.root() / path).string()};
    uintmax_t size = 0;
    std::error_code failed;
    if (recording) {
        file.real = TRY(recording_at_(path));
        size = fs::file_size(file.real, failed);
    } else {
        size = TRY(files_.size(path));
    }
    const uintmax_t most = recording ? kRecordingFileBytes : kTraceFileBytes;
    if (size > most) {
        return Error{Code::BadInput,
                     fmt::format("{}: a file that is opened as what was recorded has at most {} "
                                 "bytes, this one has {}; {}",
                                 path, most, size,
                                 recording ? "record for a shorter time" : "take its last part")};
    }
    file.written = fs::last_write_time(file.real, failed);
    bool more = false;
    for (const FileInfo& one : files_.list(more)) {
        if (one.kind != "plan") continue;
        const auto text = files_.text(one.path);
        const std::string real = (files_.root() / one.path).string();
        if (text.ok()) file.plans.push_back({real, text.value(), doc_of_(real)});
    }
    return file;
}

Result<std::string> HistoryDesk::save() {
    const std::string text = now_->trace_text();
    if (text.empty()) {
        return Error{Code::Unavailable, "no plan has run: there is no trace to save; run a plan"};
    }
    const std::string name = now_->plan_name();
    for (size_t i = 1; i <= kTraceNamesMax; ++i) {
        const std::string path = fmt::format("{}-{}{}", name, i, kTraceEnding);
        if (files_.exists(path)) continue;
        TRY(files_.make(path, text));
        return path;
    }
    return Error{Code::Refused, fmt::format("there are {} traces of {} already; delete some",
                                            kTraceNamesMax, name)};
}

}  // namespace vagus::serve
