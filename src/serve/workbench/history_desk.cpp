#include "serve/workbench/history_desk.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/file.hpp"

namespace vagus::serve {

namespace fs = std::filesystem;
using Json = nlohmann::json;

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

HistoryDesk::HistoryDesk(Desk& desk, Files& files) : desk_(desk), files_(files) {
    declare();
}

void HistoryDesk::declare() {
    desk_.board().document("history", [this](const Json&) { return now_->document(); });
    desk_.command("history.at", [this](const Call& call) {
        const auto instant = instant_of(call.in);
        const auto history = asked(call.in);
        if (!instant.ok()) return call.fail(instant.error());
        if (!history.ok()) return call.fail(history.error());
        call.done(history.value()->at(instant.value()));
    });
    desk_.command("history.lanes", [this](const Call& call) {
        const auto window = window_of(call.in);
        const auto history = asked(call.in);
        if (!window.ok()) return call.fail(window.error());
        if (!history.ok()) return call.fail(history.error());
        call.done(history.value()->lanes(window.value()));
    });
    desk_.command("history.open", [this](const Call& call) {
        const auto opened = open(call.in["trace"]);
        if (!opened.ok()) return call.fail(opened.error());
        const OpenTrace& trace = *opened.value();
        call.done({{"from", trace.history->plan()->from()},
                   {"to", trace.history->to()},
                   {"lines", trace.lines},
                   {"refused", trace.refused},
                   {"plan", trace.has_plan}});
    });
    desk_.command("history.save", [this](const Call& call) {
        const auto saved = save();
        if (!saved.ok()) return call.fail(saved.error());
        call.done({{"path", saved.value()}});
    });
}

Result<const History*> HistoryDesk::asked(const Json& in) {
    if (in.contains("trace")) return TRY(open(in["trace"]))->history.get();
    if (!now_->empty()) return now_.get();
    return Error{Code::Unavailable, "nothing has run yet; Run starts it"};
}

// ---- what is told ----

void HistoryDesk::begin(History::Beginning beginning) {
    beginning.doc_of = [this](const std::string& file) { return doc_of_(file); };
    beginning.run = ++run_;
    next_ = std::make_unique<History>();
    next_->begin(std::move(beginning));
    if (now_->empty()) now_ = std::move(next_);
    desk_.board().touch("history");
}

void HistoryDesk::forget() {
    next_.reset();
    now_ = std::make_unique<History>();
    traces_.clear();
    desk_.board().touch("history");
}

// What was opened goes as soon as time passes: then it takes the place of what ran before.
History& HistoryDesk::told_at(double t) {
    if (next_ && t <= 0) return *next_;
    if (next_) {
        now_ = std::move(next_);
        desk_.board().touch("history");
    }
    return *now_;
}

void HistoryDesk::trace(const std::string& line) {
    History& history = next_ ? *next_ : *now_;
    (void)history.trace(line);
    // Quotes inside of a text are escaped, so this is the kind. What was saved is what runs now.
    if (!history.plan() || line.find(R"("kind":"change")") == line.npos) return;
    history.change_plan(read_plans(history.plan()->file()));
}

void HistoryDesk::records(const std::string& bytes) {
    double last = 0;
    (void)each_record(bytes, {[&](double t, std::string_view) { last = t; }});
    (void)told_at(last).record(bytes);
}

void HistoryDesk::happening(const Json& happening, double t) {
    told_at(t).happen({t, happening["wall"], happening["kind"], happening["node"],
                       happening["source"], happening["name"], happening["text"],
                       happening["args"].get<std::vector<int16_t>>()});
}

void HistoryDesk::stands(double t, uint16_t node, const std::string& state, int line) {
    told_at(t).stand(t, node, state, line);
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
    desk_.board().touch("history");
}

// ---- traces as files ----

Result<HistoryDesk::OpenTrace*> HistoryDesk::open(const std::string& path) {
    (void)TRY(files_.size(path));
    std::error_code failed;
    const auto written = fs::last_write_time(files_.root() / path, failed);
    for (auto one = traces_.begin(); one != traces_.end(); ++one) {
        if (one->path != path) continue;
        traces_.splice(traces_.begin(), traces_, one);
        if (traces_.front().written == written) return &traces_.front();
        traces_.pop_front();
        break;
    }
    traces_.push_front(TRY(read(path)));
    traces_.front().written = written;
    if (traces_.size() > kTracesOpen) traces_.pop_back();
    return &traces_.front();
}

Result<HistoryDesk::OpenTrace> HistoryDesk::read(const std::string& path) const {
    const uintmax_t size = TRY(files_.size(path));
    if (size > kTraceFileBytes) {
        return Error{Code::BadInput, fmt::format("{}: a trace has at most {} bytes, this one has "
                                                 "{}; take its last part",
                                                 path, kTraceFileBytes, size)};
    }
    const std::string text = TRY(read_file((files_.root() / path).string()));
    const size_t end = text.find('\n');
    const auto first = TraceLine::read(text.substr(0, end));
    if (!first.ok()) {
        return Error{Code::BadInput, fmt::format("{}:1: {}", path, first.error().what)};
    }
    const std::string name = first.value().plan();
    OpenTrace opened;
    opened.path = path;
    const std::string plan = plan_file_of(name);
    opened.has_plan = !plan.empty();
    History::Beginning beginning{.kind = "trace", .name = path, .plan_seconds = 1e12};
    if (opened.has_plan) beginning.plans = read_plans(plan);
    // Without its plan a trace still says who worked, and when.
    if (beginning.plans.empty()) beginning.plans.emplace_back().name = name;
    beginning.doc_of = [this](const std::string& file) { return doc_of_(file); };
    opened.history = std::make_unique<History>();
    opened.history->begin(std::move(beginning));
    for (size_t at = 0; at < text.size();) {
        const size_t stop = std::min(text.find('\n', at), text.size());
        const bool good = opened.history->trace(text.substr(at, stop - at));
        ++(good ? opened.lines : opened.refused);
        at = stop + 1;
    }
    return opened;
}

// The plan of the project that has this name; empty if none has.
std::string HistoryDesk::plan_file_of(const std::string& name) const {
    const std::string plan = name.substr(0, name.find('/'));
    bool more = false;
    for (const FileInfo& file : files_.list(more)) {
        if (file.kind != "plan") continue;
        const std::string real = (files_.root() / file.path).string();
        const auto text = files_.text(file.path);
        if (!text.ok()) continue;
        const Json json = Json::parse(text.value(), nullptr, false);
        if (json.is_object() && json.contains("name") && json["name"] == plan) return real;
    }
    return {};
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
