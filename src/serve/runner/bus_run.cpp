#include "serve/runner/bus_run.hpp"

namespace vagus::serve {

BusRun::BusRun(embed::PreparedRun& prepared, run::Debugger& debugger) {
    prepared.listen([this](const plan::TraceEvent& event) {
        const std::lock_guard lock(mutex_);
        seen_.push_back(event);
    });
    prepared.tell([this](const std::string& sentence) { say(talk::LineKind::Warning, sentence); });
    runner_ = std::thread([this, &prepared, &debugger] {
        const auto ended = prepared.run(&debugger);
        if (!ended.ok()) say(talk::LineKind::Error, ended.error().what);
        const std::lock_guard lock(mutex_);
        over_ = true;
    });
}

BusRun::~BusRun() {
    runner_.join();
}

void BusRun::say(talk::LineKind kind, const std::string& text) {
    const std::lock_guard lock(mutex_);
    lines_.push_back({kind, text});
}

bool BusRun::over() {
    const std::lock_guard lock(mutex_);
    return over_;
}

std::vector<plan::TraceEvent> BusRun::take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(seen_, {});
}

std::vector<BusRun::Line> BusRun::take_lines() {
    const std::lock_guard lock(mutex_);
    return std::exchange(lines_, {});
}

}  // namespace vagus::serve
