#include "serve/field/sender.hpp"

#include <fmt/format.h>

#include <ctime>

#include "base/base64.hpp"
#include "base/file.hpp"
#include "serve/json.hpp"
#include "serve/workbench/bundle.hpp"

namespace vagus::serve {

namespace {

// Only the driver may send another version; control is requested as by a page.
Status take_control(LiveClient& robot) {
    const auto attempts = kAskForControlWithin / kAskAgainEvery;
    for (long i = 0; i < attempts; ++i) {
        const Json asked = TRY(robot.ask("driver.ask", Json::object()));
        if (asked.at("driver")) return Status::done();
        robot.wait(kAskAgainEvery);
    }
    return Error{
        Code::Refused,
        "another page has control of this robot and did not release it; ask them, or close that "
        "page"};
}

Status send_file(LiveClient& robot, const BundleFile& file, const std::string& bytes) {
    size_t from = 0;
    do {
        const std::string part = bytes.substr(from, kBundlePartBytesMax);
        (void)TRY(robot.ask("deploy.part",
                            {{"path", file.path}, {"from", from}, {"base64", base64(part)}}));
        from += part.size();
    } while (from < bytes.size());
    return Status::done();
}

Status send_files(LiveClient& robot, const CollectedBundle& collected) {
    for (const BundleFile& file : collected.bundle.files) {
        const std::string bytes = TRY(read_file((collected.root / file.path).string()));
        if (sha256_of(bytes) != file.sha256) {
            return Error{Code::Unavailable,
                         file.path + ": it was changed meanwhile; deploy once more"};
        }
        TRY(send_file(robot, file, bytes));
    }
    return Status::done();
}

void say_findings(const Json& findings, const Say& say) {
    for (const Json& one : findings) {
        say(fmt::format("{}:{}:{}: {}: {}", one.at("doc").get<std::string>(),
                        one.at("at").at("line").get<int>(), one.at("at").at("column").get<int>(),
                        one.at("severity").get<std::string>(), one.at("what").get<std::string>()));
    }
}

bool say_outcome(const Json& outcome, const Say& say) {
    say_findings(outcome.at("findings"), say);
    const std::string result = outcome.at("result");
    const uint32_t version = outcome.at("version");
    const std::string why = outcome.value("why", "");
    if (result == "started") {
        say(fmt::format("version {} runs{}", version, why.empty() ? "" : "; " + why));
    } else if (result == "refused") {
        say("refused: " + why);
    } else if (result == "rolled_back") {
        say(fmt::format("rolled back to version {}: {}", version, why));
    } else {
        say(fmt::format("version {} is in force, but does not run: {}", version, why));
    }
    return result == "started";
}

// Control is released, whatever came of the deployment.
Result<bool> obey(LiveClient& robot, const char* command, const Say& say) {
    const auto outcome = robot.ask(command, Json::object());
    (void)robot.ask("driver.leave", Json::object()).ok();
    if (!outcome.ok()) return outcome.error();
    return say_outcome(outcome.value(), say);
}

// A server that answers otherwise than the protocol says is none of ours.
template <typename Work>
auto guarded(const Work& work) -> decltype(work()) {
    try {
        return work();
    } catch (const Json::exception& odd) {
        return Error{Code::Unavailable,
                     fmt::format("the robot answers what this version of vagus does not know: {}; "
                                 "use the version that runs there",
                                 odd.what())};
    }
}

std::string day_and_time(double wall_ms) {
    const auto seconds = static_cast<std::time_t>(wall_ms / 1000);
    std::tm local = {};
    localtime_r(&seconds, &local);
    char text[32];
    std::strftime(text, sizeof text, "%Y-%m-%d %H:%M", &local);
    return text;
}

Result<bool> deploy_it(LiveClient& robot, const std::string& project, const Say& say) {
    const CollectedBundle collected = TRY(collect_bundle(project));
    TRY(take_control(robot));
    Json begun = to_json(collected.bundle);
    for (const char* key : {"format", "before", "when_wall"}) begun.erase(key);
    (void)TRY(robot.ask("deploy.begin", std::move(begun)));
    TRY(send_files(robot, collected));
    return obey(robot, "deploy.commit", say);
}

Status list_them(LiveClient& robot, const Say& say) {
    const Json listed = TRY(robot.ask("deploy.list", Json::object()));
    for (const Json& one : listed.at("versions")) {
        const std::string when =
            one.contains("when_wall") ? day_and_time(one["when_wall"]) : std::string(16, ' ');
        say(fmt::format("{} {:>5}  {}  {}", one.at("current") ? "*" : " ",
                        one.at("version").get<uint32_t>(), when,
                        one.at("name").get<std::string>()));
    }
    return Status::done();
}

}  // namespace

Result<bool> deploy(LiveClient& robot, const std::string& project, const Say& say) {
    return guarded([&] { return deploy_it(robot, project, say); });
}

Result<bool> roll_back(LiveClient& robot, const Say& say) {
    return guarded([&]() -> Result<bool> {
        TRY(take_control(robot));
        return obey(robot, "deploy.back", say);
    });
}

Status list_versions(LiveClient& robot, const Say& say) {
    return guarded([&] { return list_them(robot, say); });
}

}  // namespace vagus::serve
