#include "serve/field/deploy_commands.hpp"

#include <algorithm>

#include "base/base64.hpp"
#include "serve/json.hpp"

namespace vagus::serve {

namespace {

constexpr size_t kFindingsTold = 2000;  // as the protocol has it

Json json_of(const DeployOutcome& outcome) {
    Json findings = Json::array();
    for (const DocFinding& finding : outcome.findings) {
        if (findings.size() < kFindingsTold) findings.push_back(serve::json_of(finding));
    }
    Json json = {{"result", word_of(outcome.result)},
                 {"version", outcome.version},
                 {"findings", std::move(findings)}};
    if (!outcome.why.empty()) json["why"] = outcome.why;
    return json;
}

void begin(const Call& call, Deployments& deployments) {
    auto bundle = bundle_from(call.in);
    call.answer(bundle.ok() ? deployments.begin(std::move(bundle.value()))
                            : Status(bundle.error()));
}

void part(const Call& call, Deployments& deployments) {
    const auto bytes = from_base64(call.in["base64"].get_ref<const std::string&>());
    if (!bytes) return call.fail("bad_input", "in.base64: expected base64 (RFC 4648)");
    deployments.part(call.in["path"], call.in["from"], *bytes,
                     [call](const Status& taken) { call.answer(taken); });
}

Json list(const Versions& versions) {
    Json list = Json::array();
    std::vector<uint32_t> numbers = versions.all();
    numbers.insert(numbers.begin(), 0);
    for (const uint32_t number : numbers) {
        Json one = {{"version", number},
                    {"name", "the folder as it was given"},
                    {"current", number == versions.current()}};
        const auto bundle = versions.bundle(number);
        if (bundle.ok()) {
            one["name"] = bundle.value().name;
            one["when_wall"] = bundle.value().when_wall;
        }
        list.push_back(std::move(one));
    }
    return {{"versions", std::move(list)}};
}

}  // namespace

void declare_deploy_commands(Desk& desk, const Versions& versions, Deployments& deployments) {
    desk.command("deploy.begin", [&deployments](const Call& call) { begin(call, deployments); });
    desk.command("deploy.part", [&deployments](const Call& call) { part(call, deployments); });
    desk.command("deploy.commit", [&deployments](const Call& call) {
        deployments.commit([call](const DeployOutcome& outcome) { call.done(json_of(outcome)); });
    });
    desk.command("deploy.back", [&deployments](const Call& call) {
        deployments.back([call](const DeployOutcome& outcome) { call.done(json_of(outcome)); });
    });
    desk.command("deploy.list", [&versions](const Call& call) { call.done(list(versions)); });
}

}  // namespace vagus::serve
