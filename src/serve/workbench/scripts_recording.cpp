#include "serve/workbench/scripts_recording.hpp"

#include <utility>

namespace vagus::serve {

void ScriptsRecording::begin(const std::string& path, record::RunFile about,
                             const std::map<std::string, std::string>& files,
                             const debug::Network& network, record::BusRecording::Clock clock) {
    end();
    auto begun =
        record::BusRecording::begin(path, std::move(about), files, network, std::move(clock));
    if (!begun.ok()) return tended_.cannot(begun.error().what);
    bus_ = begun.value().get();
    tended_.keep(std::move(begun.value()), "variables");
    for (const debug::NodeId id : network.nodes()) {
        const debug::NodeView* const node = network.node(id);
        if (node != nullptr && node->described) bus_->described(*node);
    }
}

void ScriptsRecording::end() {
    tended_.end();
    bus_ = nullptr;
}

}  // namespace vagus::serve
