#include "serve/workbench/telling_process.hpp"

#include <utility>

namespace vagus::serve {

void TellingProcess::begin(std::unique_ptr<RunProcess> process) {
    process_ = std::move(process);
    heard_.reset();
}

void TellingProcess::tick(Time now, const std::function<void(const Packet&)>& hear) {
    now_ = now;
    if (!heard_) heard_ = now;
    Pipe& pipe = process_->pipe();
    pipe.flush();
    for (const Packet& packet : pipe.receive()) {
        heard_ = now;
        hear(packet);
        if (!process_) return;
    }
}

std::string TellingProcess::gone() {
    if (const auto ended = process_->ended()) return ended->what;
    return process_->pipe().closed() ? "has gone" : "";
}

}  // namespace vagus::serve
