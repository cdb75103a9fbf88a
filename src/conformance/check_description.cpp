// Discovery and description: sections 2.2, 2.6, 3.10 and 4.2.
#include "conformance/checks.hpp"
#include "conformance/standard_natives.hpp"

namespace vagus::conformance {
namespace {

using wire::MessageType;

constexpr uint16_t kLastBroadcastVersion = 4;  // section 2.1
constexpr uint16_t kFragmentsSince = 8;

Status answers_list_nodes(Bench& bench) {
    TRY(bench.send(number(MessageType::ListNodes), {wire::kProtocolVersion}));
    return bench.expect(MessageType::NodePresent, {bench.target().protocol_version});
}

Status has_a_known_version(Bench& bench) {
    const uint16_t version = bench.target().protocol_version;
    if (version >= wire::kProtocolVersionMin && version <= wire::kProtocolVersionMax)
        return Status::done();
    return finding("expected a version from " + std::to_string(wire::kProtocolVersionMin) + " to " +
                   std::to_string(wire::kProtocolVersionMax) + ", found " +
                   std::to_string(version));
}

// So many messages of this type are next.
Status expect_parts(Bench& bench, MessageType type, size_t count) {
    const std::string name = wire::message_name(number(type));
    for (size_t i = 0; i < count; i++) {
        const wire::Frame frame = TRY(bench.hear(name));
        if (frame.type == number(type)) continue;
        return finding("expected " + name + " " + std::to_string(i) + " of " +
                       std::to_string(count) + ", found " + text_of(frame));
    }
    return Status::done();
}

Status expect_description(Bench& bench) {
    const aesl::Target& target = bench.target();
    TRY(expect_parts(bench, MessageType::Description, 1));
    TRY(expect_parts(bench, MessageType::NamedVariableDescription, target.variables.size()));
    TRY(expect_parts(bench, MessageType::LocalEventDescription, target.local_events.size()));
    TRY(expect_parts(bench, MessageType::NativeFunctionDescription, target.natives.size()));
    return bench.expect_silence();
}

Status describes_itself_in_order(Bench& bench) {
    TRY(bench.command(MessageType::GetNodeDescription, {wire::kProtocolVersion}));
    return expect_description(bench);
}

Status answers_an_old_broadcast(Bench& bench) {
    TRY(bench.send(number(MessageType::GetDescription), {kLastBroadcastVersion}));
    return expect_description(bench);
}

Status leaves_a_new_broadcast(Bench& bench) {
    TRY(bench.send(number(MessageType::GetDescription), {wire::kProtocolVersion}));
    return bench.expect_silence();
}

Status places_source_and_arguments(Bench& bench) {
    const auto& variables = bench.target().variables;
    if (variables.size() < 3)
        return finding("expected at least 3 variables (id, source, arguments), found " +
                       std::to_string(variables.size()));
    if (variables[0].size == 1 && variables[1].size == 1) return Status::done();
    return finding("expected \"" + variables[0].name + "\" and \"" + variables[1].name +
                   "\" of 1 word each, found " + std::to_string(variables[0].size) + " and " +
                   std::to_string(variables[1].size));
}

Status declares_standard_natives(Bench& bench) {
    for (const StandardNative& standard : standard_natives()) {
        const Result<uint16_t> id = bench.native(standard.name);
        if (!id.ok()) continue;  // its own check says so
        Values sizes;
        for (const auto& parameter : bench.target().natives[id.value()].parameters)
            sizes.push_back(parameter.size);
        if (sizes == standard.sizes) continue;
        return finding(std::string(standard.name) + ": expected parameters of sizes " +
                       text_of(standard.sizes) + ", found " + text_of(sizes));
    }
    return Status::done();
}

Status sends_fragments(Bench& bench) {
    const aesl::Target& target = bench.target();
    if (target.protocol_version < kFragmentsSince)
        return lacking("protocol version 8", "has " + std::to_string(target.protocol_version));
    const auto ask = [&bench](int fragment) {
        return bench.command(MessageType::GetNodeDescriptionFragment,
                             {wire::kProtocolVersion, static_cast<uint16_t>(fragment)});
    };
    TRY(ask(-1));
    TRY(expect_parts(bench, MessageType::Description, 1));
    TRY(ask(0));
    TRY(expect_parts(bench, MessageType::NamedVariableDescription, 1));
    TRY(ask(0x7fff));
    return bench.expect_silence();
}

}  // namespace

void add_description_checks(Checks& checks) {
    const char* const group = "description";
    checks.insert(
        checks.end(),
        {{group, "ListNodes is answered by NodePresent", "2.6", "", answers_list_nodes},
         {group, "the protocol version is one that hosts accept", "2.1", "", has_a_known_version},
         {group, "the parts of the description come whole and in order", "2.2", "",
          describes_itself_in_order},
         {group, "GetDescription of version 4 is answered", "2.3", "", answers_an_old_broadcast},
         {group, "GetDescription of version 5 is not answered", "2.3", "", leaves_a_new_broadcast},
         {group, "source and arguments have their places", "3.10", "", places_source_and_arguments},
         {group, "standard natives have their parameters", "4.2", "", declares_standard_natives},
         {group, "fragments of the description can be asked for", "2.9", "", sends_fragments}});
}

}  // namespace vagus::conformance
