// vagus replay: runs a recorded run again, and tells where it differs.
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "base/file.hpp"
#include "base/seconds.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"
#include "cli/verbs.hpp"
#include "mcap/writer.hpp"
#include "record/compare_tape.hpp"
#include "record/replay.hpp"

namespace vagus::cli {

namespace {

struct ReplayOptions {
    std::string file;
    std::vector<std::string> with;
    std::optional<double> until;
    std::string repair;
};

// ---- repair ----

// The same messages and attachments, with an end.
int repair(const mcap::Reader& reader, const std::string& to) {
    auto file = GrowingFile::create(to);
    if (!file.ok()) return complain(file.error());
    mcap::Writer writer([&file](std::string_view bytes) { return file.value().append(bytes); });
    for (const mcap::Attachment& one : reader.attachments()) writer.attach(one);
    std::map<uint16_t, uint16_t> schemas;
    for (const mcap::Schema& one : reader.schemas()) schemas[one.id] = writer.add_schema(one);
    std::map<uint16_t, uint16_t> channels;
    for (mcap::Channel one : reader.channels()) {
        const uint16_t id = one.id;
        one.schema = one.schema == 0 ? uint16_t{0} : schemas[one.schema];
        channels[id] = writer.add_channel(std::move(one));
    }
    mcap::Cursor cursor(reader);
    uint64_t count = 0;
    for (; const auto message = cursor.next(); ++count) {
        writer.write(channels[message->channel], message->log_time, message->data);
    }
    const Status ended = writer.end();
    if (!ended.ok()) return complain(ended.error());
    print(fmt::format("{}: {} messages{}\n", to, count,
                      cursor.trouble() ? "; " + cursor.trouble()->what : ""));
    return kExitDone;
}

// ---- replay ----

void tell(const record::Difference& found) {
    print(fmt::format("differs at {} s: {}{}\n  then: {}\n  now:  {}\n", seconds_text(found.at),
                      found.topic, found.place.empty() ? "" : ", " + found.place,
                      found.then.empty() ? "nothing" : found.then,
                      found.now.empty() ? "nothing" : found.now));
}

// How the recorded run ended: the last line of its trace that says so.
std::string recorded_end(const mcap::Reader& reader) {
    const mcap::Channel* const channel = reader.find(record::kTraceTopic);
    std::string last;
    mcap::Cursor cursor(reader);
    while (const auto message = cursor.next()) {
        if (channel != nullptr && message->channel == channel->id) last = message->data;
    }
    return last;
}

void tell_ends(const mcap::Reader& reader, const record::Rerun::Ended& ended) {
    const std::string then = recorded_end(reader);
    if (!then.empty()) print("it ended then: " + then + "\n");
    if (ended.how.empty()) return;
    print(fmt::format("it ends now:   {} at {} s{}\n", ended.how, seconds_text(ended.at),
                      ended.message.empty() ? "" : ": " + ended.message));
}

// What there is at the instant at which it was ended.
void tell_state(record::Rerun& rerun, Time at) {
    const session::SimSession* const session = rerun.session();
    if (session == nullptr) return;
    print(fmt::format("at {} s:\n", seconds_text(at)));
    for (const sim::RobotView& robot : session->world().robots()) {
        print(fmt::format("{} is at {:.3f}, {:.3f} m, {:.1f} deg\n", robot.name, robot.pose.at.x,
                          robot.pose.at.y, robot.pose.angle * 180 / 3.14159265358979));
    }
    for (const session::NodeState& node : session->nodes()) {
        print(fmt::format("{} is {}", node.name, debug::name_of(node.state)));
        const char* between = ": ";
        for (const auto& [name, words] : session->script_variables(node.id)) {
            if (words.size() != 1) continue;
            print(fmt::format("{}{} = {}", between, name, words[0]));
            between = ", ";
        }
        print("\n");
    }
}

Result<record::RerunOptions> rerun_options(const ReplayOptions& options,
                                           const mcap::Reader& reader) {
    record::RerunOptions how;
    for (const std::string& typed : options.with) {
        const auto [name, path] = TRY(record::named_file(reader, typed));
        how.with[name] = TRY(read_file(path));
    }
    if (options.until) how.until = from_seconds(*options.until);
    return how;
}

int replay(const ReplayOptions& options) {
    const auto file = MappedFile::open(options.file);
    if (!file.ok()) return complain(file.error(), kExitUsage);
    const auto reader = mcap::Reader::open(file.value().bytes(), options.file);
    if (!reader.ok()) return complain(reader.error(), kExitUsage);
    if (!options.repair.empty()) return repair(reader.value(), options.repair);
    const auto how = rerun_options(options, reader.value());
    if (!how.ok()) return complain(how.error(), kExitUsage);
    auto rerun = record::Rerun::open(reader.value(), how.value());
    if (!rerun.ok()) return complain(rerun.error(), kExitUsage);
    if (!reader.value().is_complete()) {
        complain(options.file +
                 ": has no end (the run was killed, or the file is cut off); it is "
                 "compared up to its last whole chunk");
    }
    // With another file all else differs, too: what the plan did is what parts the two runs.
    std::set<std::string> only;
    const bool has_plan = rerun.value()->plan() != nullptr;
    if (!options.with.empty() && has_plan) only.insert(std::string(record::kTraceTopic));
    record::CompareTape tape(reader.value(), only, how.value().until.value_or(Time::max()));
    const bool first_only = options.with.empty();
    bool told = false;
    rerun.value()->each_instant([&](Time at) {
        if (first_only && tape.difference()) rerun.value()->stop();
        if (!how.value().until || at < *how.value().until || std::exchange(told, true)) return;
        tell_state(*rerun.value(), at);
    });
    const auto ended = rerun.value()->run(tape);
    if (!ended.ok()) return complain(ended.error());
    tape.end();
    if (!tape.difference()) {
        const Time end = std::min(ended.value().at, how.value().until.value_or(Time::max()));
        print(fmt::format("{}: {} s again, {} messages compared: no difference\n", options.file,
                          seconds_text(end), tape.compared()));
        return kExitDone;
    }
    tell(*tape.difference());
    if (!options.with.empty()) tell_ends(reader.value(), ended.value());
    return kExitFailed;
}

}  // namespace

void add_replay(CLI::App& app, int& exit_code) {
    CLI::App* verb = app.add_subcommand("replay", "runs a recorded run again, and compares");
    auto options = std::make_shared<ReplayOptions>();  // owners: CLI11's options and the callback
    takes_file(*verb->add_option("FILE", options->file, "the recording")->required(), {".mcap"});
    verb->add_option("--until", options->until,
                     "ends at this instant and tells what there is at it")
        ->type_name("S");
    verb->add_option("--with", options->with,
                     "a file in place of that of the same name in the recording; tells where the "
                     "two runs part; again for more")
        ->type_name("FILE|NAME=FILE")
        ->allow_extra_args(false);
    takes_file(*verb->add_option("--repair", options->repair,
                                 "runs nothing: writes what can be read of it as a whole file"),
               {".mcap"});
    verb->footer(
        "A recording has all files of its run in it. It runs again in virtual time, with what was "
        "done from outside at the same instants.\nExit codes: 0 no difference, 1 a difference, 2 "
        "not valid.\n\nExample:\n"
        "  vagus plan run WallFollow.plan.json --world hall.world.json --record run.mcap\n"
        "  vagus replay run.mcap\n"
        "  vagus replay run.mcap --with carbot.aesl");
    verb->callback([options, &exit_code] { exit_code = replay(*options); });
}

}  // namespace vagus::cli
