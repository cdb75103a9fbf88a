// The history of the run, and traces that were opened as files, for pages: the topic history, and
// the commands history.at, history.lanes, history.open, history.save. Told what happens by whoever
// has the run and the robot.
//
//     HistoryDesk histories(desk, files);
//     histories.begin({.kind = "simulated", .name = "Hall"});
//     histories.trace(line);
//     histories.tick(clock);
#pragma once

#include <list>
#include <string>

#include "serve/history/history.hpp"
#include "serve/project/files.hpp"
#include "serve/studio/desk.hpp"

namespace vagus::serve {

constexpr size_t kTracesOpen = 4;              // that are kept in memory
constexpr size_t kTraceFileBytes = 32u << 20;  // as much as a run keeps
constexpr size_t kTraceNamesMax = 1000;        // NAME-1.trace.jsonl, NAME-2, …
constexpr const char* kTraceEnding = ".trace.jsonl";

class HistoryDesk {
public:
    using Json = nlohmann::json;
    // Both are borrowed. Declares its topic and commands.
    HistoryDesk(Desk& desk, Files& files);

    void set_doc_of(std::function<std::string(const std::string& file)> doc_of) {
        doc_of_ = std::move(doc_of);
    }

    // Something else may run from now on. What was kept of the run before stays until it does.
    void begin(History::Beginning beginning);
    // Another project or target: nothing is kept.
    void forget();

    // ---- what is told ----
    void trace(const std::string& line);
    void records(const std::string& bytes);
    void happening(const Json& happening, double t);
    void stands(double t, uint16_t node, const std::string& state, int line);
    void words(double t, uint16_t node, uint16_t address, std::span<const int16_t> values);
    void unwatched(double t, uint16_t node, uint16_t address, uint16_t count);
    // The clock of what runs, whether it goes or stands.
    void tick(double t);

private:
    struct OpenTrace {
        std::string path;
        std::filesystem::file_time_type written{};
        std::unique_ptr<History> history;
        size_t lines = 0, refused = 0;
        bool has_plan = false;
    };
    History& told_at(double t);
    void declare();
    Result<const History*> asked(const Json& in);
    Result<OpenTrace*> open(const std::string& path);
    Result<OpenTrace> read(const std::string& path) const;
    std::string plan_file_of(const std::string& name) const;
    Result<std::string> save();

    Desk& desk_;
    Files& files_;
    std::function<std::string(const std::string&)> doc_of_ = [](const std::string& f) { return f; };
    std::unique_ptr<History> now_ = std::make_unique<History>();
    std::unique_ptr<History> next_;  // of what has been opened and does not go yet
    uint64_t run_ = 0;
    std::list<OpenTrace> traces_;  // the one that was asked for last first
    double told_to_ = 0;
};

}  // namespace vagus::serve
