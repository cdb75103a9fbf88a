// The history of the run, and of runs that were opened as files, for pages: the topic history, and
// the commands history.at, history.lanes, history.open, history.save. Told what happens by what
// has the run and the robot.
//
//     HistoryDesk histories(desk, files);
//     histories.begin({.kind = "simulated", .name = "Hall"});
//     histories.trace(line);
//     histories.tick(12.34);  // what the clock of the run shows
#pragma once

#include <filesystem>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "serve/history/history.hpp"
#include "serve/history/kept_run.hpp"
#include "serve/json.hpp"
#include "serve/project/files.hpp"
#include "serve/studio/desk.hpp"
#include "serve/talk/news.hpp"
#include "serve/worker.hpp"

namespace vagus::serve {

constexpr size_t kRunsOpen = 4;          // files that are kept in memory
constexpr size_t kTraceNamesMax = 1000;  // NAME-1.trace.jsonl, NAME-2, …
constexpr const char* kTraceEnding = ".trace.jsonl";

class HistoryDesk {
public:
    // Both are borrowed. Declares its topic and commands. Traces that are files are read where
    // `post` puts it.
    HistoryDesk(Desk& desk, Files& files, Worker::Post post = Worker::at_once);

    void set_doc_of(std::function<std::string(const std::string& file)> doc_of) {
        doc_of_ = std::move(doc_of);
    }

    // Where a recording lies on this computer; the Error says that there is none.
    void set_recording_at(
        std::function<Result<std::string>(const std::string& path)> recording_at) {
        recording_at_ = std::move(recording_at);
    }

    // Something else may run from now on. What was kept of the run before stays until it does.
    void begin(History::Beginning beginning);
    // What runs from now on has the past of the run before, up to an instant.
    void continue_from(double t);
    // Another project or target: nothing is kept.
    void forget();

    // What a document said in the plan that ran at an instant; nothing: it was not of it.
    std::optional<std::string> plan_text(double t, const std::string& doc) const;

    // The number of what was begun last.
    uint64_t run() const { return run_; }

    // ---- what is told ----
    // What runs from the next line of the trace on, by its number.
    void plan(const talk::PlanVersion& version);
    void trace(const std::string& line);
    void records(const std::string& bytes);
    void happened(Happened happened);
    void picture(KeptPicture picture);
    void words(double t, uint16_t node, uint16_t address, std::span<const int16_t> values);
    void unwatched(double t, uint16_t node, uint16_t address, uint16_t count);
    // The clock of what runs, whether it runs or is paused.
    void tick(double t);

private:
    using Ask = std::function<void(const History&)>;
    using Use = std::function<void(const KeptRun&)>;
    struct Waiting {
        Call call;
        Use use;
    };
    // A file, and whose plan of it is shown; no robot: that of the first, or of the only one.
    struct KeptKey {
        std::string path, robot;
        auto operator<=>(const KeptKey&) const = default;
    };
    static bool is(const KeptRun& run, const KeptKey& key);
    History& told_at(double t);
    void declare();
    void ask(const Call& call, const Ask& then);
    void open(const Call& call, const Use& use);
    void opened(const KeptKey& key, const Result<std::shared_ptr<KeptRun>>& read);
    Result<KeptFile> look_for(const std::string& path) const;
    void drop(std::shared_ptr<KeptRun> run);
    Result<std::string> save();

    Desk& desk_;
    Files& files_;
    std::function<Result<std::string>(const std::string&)> recording_at_;
    std::function<std::string(const std::string&)> doc_of_ = [](const std::string& f) { return f; };
    std::unique_ptr<History> now_ = std::make_unique<History>();
    std::unique_ptr<History> next_;  // of what has been opened and does not go yet
    uint64_t run_ = 0;
    std::list<std::shared_ptr<KeptRun>> kept_;  // the one that was asked for last first
    // For files that are being read.
    std::map<KeptKey, std::vector<Waiting>> waiting_;
    const Worker::Post post_;
    double told_to_ = 0;
};

}  // namespace vagus::serve
