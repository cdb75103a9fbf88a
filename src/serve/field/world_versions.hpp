// The versions that a fleet gives robots of a world (docs/decisions/0246): each robot fetches,
// checks, starts and takes back what is wanted of it as a robot that serves itself does
// (wanted.hpp, deployments.hpp). They are kept for this run: the next one begins with what the
// file of the world says.
//
//     const auto versions = TRY(WorldVersions::open(robots, {.authority = "ca.crt", .wake = …}));
//     robots.step(span);
//     versions->pass(span);     // between two steps
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/result.hpp"
#include "base/temporary_folder.hpp"
#include "base/time.hpp"
#include "embed/robots_run.hpp"
#include "serve/field/deployments.hpp"
#include "serve/field/starter.hpp"
#include "serve/field/versions.hpp"
#include "serve/field/wanted.hpp"
#include "serve/script/scripts.hpp"
#include "serve/worker.hpp"

namespace vagus::serve {

struct WorldVersionsOptions {
    std::string authority = {};       // PEM file of who may give versions
    std::function<void()> wake = {};  // called on another thread when pass() has something to do
};

class WorldVersions {
public:
    // The run is borrowed.
    static Result<std::unique_ptr<WorldVersions>> open(embed::RobotsRun& run,
                                                       WorldVersionsOptions options);
    ~WorldVersions();
    WorldVersions(const WorldVersions&) = delete;
    WorldVersions& operator=(const WorldVersions&) = delete;

    // So much time of the world has passed; none while it is paused.
    void pass(Duration span);

private:
    struct Robot {
        Robot(WorldVersions& all, size_t index, const std::string& folder);
        Versions versions;
        Starter starter;
        Deployments deployments;
        Wanted wanted;
    };
    WorldVersions(embed::RobotsRun& run, WorldVersionsOptions options, TemporaryFolder folder);
    Starter::Callbacks starter_callbacks(size_t index);
    Deployments::Callbacks callbacks(size_t index);
    Wanted::Callbacks wanted_callbacks(size_t index, const std::string& folder);
    Scripts::TargetOf targets_of(size_t index) const;
    void pass(size_t index);

    embed::RobotsRun& run_;
    const WorldVersionsOptions options_;
    const TemporaryFolder folder_;
    Time now_{};  // also goes on as the world begins again
    std::vector<std::unique_ptr<Robot>> robots_;
    std::vector<std::pair<size_t, fleet::Want>> wants_;  // since the last pass
    Worker worker_, fetcher_;                            // end before what their work uses
};

}  // namespace vagus::serve
