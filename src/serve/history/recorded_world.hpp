// The world of a recording, without running it: what was in it, and where things were. For pages
// that look at a run that cannot be run again here.
//
//     RecordedWorld world(reader, recorded.about);
//     kept.scene = world.scene();
//     if (world.see(topic, at, data)) history.record(world.take());
#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "base/time.hpp"
#include "mcap/reader.hpp"
#include "record/run_file.hpp"
#include "serve/follow/record.hpp"
#include "serve/json.hpp"

namespace vagus::serve {

class RecordedWorld {
public:
    // Without a world file, or with one that cannot be read any more, there is no scene, and no
    // place is known.
    RecordedWorld(const mcap::Reader& reader, const record::RunFile& about);

    // As the topic scene; null: there is none.
    const Json& scene() const { return scene_; }
    // The first node of that robot; 1 if nobody knows.
    uint16_t first_node(const std::string& robot) const;

    // A message tells where things were: take() gives it as records.
    bool see(std::string_view topic, Time at, std::string_view data);
    std::string take() { return writer_.take(); }

private:
    void see_entity(const Json& entity);

    Json scene_;
    std::map<std::string, uint32_t> keys_;  // of poses, by the id of an entity
    std::map<std::string, uint16_t> first_nodes_;
    RecordWriter writer_;
};

}  // namespace vagus::serve
