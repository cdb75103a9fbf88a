// vagus replay: runs a recorded run again, and tells where it differs.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <functional>

#include "base/file.hpp"
#include "base/json.hpp"
#include "base/seconds.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"
#include "cli/record/jumps.hpp"
#include "cli/verbs.hpp"
#include "embed/loaded_plan.hpp"
#include "mcap/writer.hpp"
#include "record/both_tapes.hpp"
#include "record/compare_tape.hpp"
#include "record/damage.hpp"
#include "record/file_tape.hpp"
#include "record/log_run.hpp"
#include "record/replay.hpp"
#include "record/topics.hpp"

namespace vagus::cli {

namespace {

struct ReplayOptions {
    std::string file;
    std::vector<std::string> with;
    std::optional<double> until;
    std::string repair;
    std::vector<std::pair<std::string, std::string>> log;
    bool json = false;
    std::optional<double> from;
    std::vector<std::string> set;
    std::optional<uint64_t> reseed;
    std::string record;
    std::string jumps;
};

// What is read is not written.
Status check_other_file(const std::string& option, const std::string& to,
                        const std::string& recording) {
    std::error_code error;
    if (!std::filesystem::equivalent(to, recording, error)) return Status::done();
    return Error{
        Code::Refused,
        fmt::format("{} {}: is the recording that is read; name another file", option, to)};
}

// ---- repair ----

// The same messages and attachments, with an end, and a mark where those of the run are missing.
int repair(const mcap::Reader& reader, const std::string& to) {
    auto file = record::create_recording(to);
    if (!file.ok()) return complain(file.error(), kExitUsage);
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
    uint64_t last = 0;
    for (; const auto message = cursor.next(); ++count) {
        writer.write(channels[message->channel], message->log_time, message->data);
        last = std::max(last, message->log_time);
    }
    const bool is_marked = reader.find(record::kCutTopic) != nullptr;
    if (!is_marked && (!record::is_whole(reader) || cursor.trouble())) {
        record::mark_as_cut(writer, last);
    }
    const Status ended = writer.end();
    if (!ended.ok()) return complain(ended.error());
    print(fmt::format("{}: {} messages{}\n", to, count,
                      cursor.trouble() ? "; " + cursor.trouble()->what : ""));
    return kExitDone;
}

// ---- replay ----

// `state`: of the instant at which it was to end; empty: there is none.
void tell_json(const record::CompareTape& tape, Time end, const std::string& state) {
    std::string difference = "null";
    if (const auto& found = tape.difference()) {
        difference =
            fmt::format(R"({{"t":{},"topic":{},"place":{},"then":{},"now":{}}})",
                        seconds_text(found->at), json_quote(found->topic), json_quote(found->place),
                        json_quote(found->then), json_quote(found->now));
    }
    print(fmt::format("{{\"t\":{},\"compared\":{},\"difference\":{}{}}}\n", seconds_text(end),
                      tape.compared(), difference,
                      state.empty() ? "" : fmt::format(",\"state\":\"{}\"", state)));
}

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
void tell_state(record::Rerun& rerun, Time at, const std::string& state) {
    const session::SimSession* const session = rerun.session();
    if (session == nullptr) return;
    print(fmt::format("at {} s:\nthe state is {}\n", seconds_text(at), state));
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
    if (options.from) how.from = from_seconds(*options.from);
    how.set = options.set;
    how.reseed = options.reseed;
    if (options.reseed && !options.from) {
        return Error{
            Code::BadInput,
            "--reseed goes with --from, the instant from which on chance is drawn again, as "
            "--from 20 --reseed 7"};
    }
    if (!options.set.empty() && !options.from) {
        return Error{Code::BadInput,
                     "--set goes with --from, the instant at which it is set, as --from 20 --set "
                     "walldist=40"};
    }
    if (!options.record.empty() && options.until && !options.from) {
        return Error{Code::BadInput,
                     "--record with --until: a run that ends earlier is another one; say from "
                     "when on it is, with --from"};
    }
    if (how.from && how.until && *how.until <= *how.from) {
        return Error{Code::BadInput,
                     "--until comes before --from; it ends the run that goes another way"};
    }
    return how;
}

// A recording of the run as it is now, with its files.
Result<std::unique_ptr<record::FileTape>> new_recording(const ReplayOptions& options,
                                                        const mcap::Reader& reader,
                                                        const record::RerunOptions& how) {
    if (options.record.empty()) return std::unique_ptr<record::FileTape>();
    TRY(check_other_file("--record", options.record, options.file));
    auto tape = TRY(record::FileTape::create(options.record, record::Pace::Waits));
    for (const mcap::Attachment& one : reader.attachments()) {
        const auto instead = how.with.find(one.name);
        const bool as_it_was = how.from || instead == how.with.end();
        tape->attach(one.name, as_it_was ? one.data : std::string_view(instead->second));
    }
    return tape;
}

// What is put into the run for a person who looks at it; the Error says what is not there.
Result<std::unique_ptr<record::LogPoints>> log_points(const ReplayOptions& options,
                                                      record::Rerun& rerun) {
    std::vector<record::LogWish> wishes;
    for (const auto& [where, values] : options.log) wishes.push_back({where, values});
    const auto show = [json = options.json](const record::LogHit& hit) {
        print((json ? record::format_hit_json(hit) : record::format_hit(hit)) + "\n");
    };
    auto points = TRY(record::LogPoints::set(wishes, record::buses_of(rerun), show));
    record::follow(rerun, *points);
    return points;
}

// What is compared: all that the two runs share.
struct Compared {
    std::set<std::string> topics = {};  // none: all
    Time until = Time::max();
    bool to_the_first = true;  // a difference ends the run
};

Compared compared(const record::RerunOptions& how, const record::Rerun& rerun) {
    Compared made;
    const bool has_plan = rerun.plan() != nullptr;
    if (rerun.about().is_of_bus()) made.topics.insert(std::string(record::kTraceTopic));
    if (how.until) made.until = *how.until;
    if (how.from) {
        made.until = *how.from - Duration(1);
    } else if (!how.with.empty()) {
        // With another file all else differs, too: what the plan did is what parts the two runs.
        made.to_the_first = false;
        if (has_plan) made.topics.insert(std::string(record::kTraceTopic));
    }
    return made;
}

// Of a real bus only the plan can do something again.
Status check_bus(const ReplayOptions& options, const record::Rerun& rerun) {
    if (!rerun.about().is_of_bus()) return Status::done();
    if (rerun.plan() == nullptr) {
        return Error{Code::Refused,
                     options.file +
                         ": is a recording of a real bus without a plan, so nothing can decide "
                         "again; ask it by `vagus why` or `vagus compare`, or record a plan with "
                         "`vagus plan run PLAN --bus TARGET --record FILE`"};
    }
    if (!options.record.empty()) {
        return Error{Code::Refused, "--record " + options.record + ": " + options.file +
                                        " is a recording of a real bus, whose nodes cannot be run "
                                        "again; what the plan decides now is told, not recorded"};
    }
    return Status::done();
}

// Looks at the run while it goes on. The Error is of a log point whose place there is not.
class Looker {
public:
    Looker(const ReplayOptions& options, record::Rerun& rerun, record::LogPoints& points,
           std::function<bool()> is_over)
        : options_(options),
          rerun_(rerun),
          points_(points),
          places_(points),
          is_over_(std::move(is_over)) {
        if (options.until) until_ = from_seconds(*options.until);
        rerun.each_instant([this](Time at) { look(at); });
    }

    Status end() {
        const Status& there = places_.ask();
        for (const std::string& place : points_.not_reached()) {
            if (there.ok()) complain("--log " + place + ": was not reached");
        }
        return there;
    }

    // Of the instant at which it was to end.
    const std::string& state() const { return state_; }

private:
    void look(Time at) {
        places_.look();
        if (places_.are_missing() || is_over_()) rerun_.stop();
        if (at < until_ || std::exchange(told_, true)) return;
        points_.close();
        state_ = record::state_hash(rerun_.check_at(at));
        if (!options_.json) tell_state(rerun_, at, state_);
    }

    const ReplayOptions& options_;
    record::Rerun& rerun_;
    record::LogPoints& points_;
    record::LogPlaces places_;
    std::function<bool()> is_over_;
    Time until_ = Time::max();
    std::string state_;
    bool told_ = false;
};

int tell_result(const ReplayOptions& options, const mcap::Reader& reader,
                const record::CompareTape& tape, const record::Rerun::Ended& ended, Time end,
                const std::string& state) {
    if (options.json) {
        tell_json(tape, end, state);
    } else if (tape.difference()) {
        tell(*tape.difference());
    } else {
        print(fmt::format("{}: {} s again, {} messages compared: no difference\n", options.file,
                          seconds_text(end), tape.compared()));
    }
    const bool parted = options.from || (!options.with.empty() && tape.difference());
    if (parted && !options.json) tell_ends(reader, ended);
    return tape.difference() ? kExitFailed : kExitDone;
}

// Runs it again, and gives the exit code.
int run_again(const ReplayOptions& options, const mcap::Reader& reader,
              const record::RerunOptions& how, record::Rerun& rerun, record::LogPoints& points) {
    const Compared what = compared(how, rerun);
    record::CompareTape tape(reader, what.topics, what.until);
    Looker looker(options, rerun, points,
                  [&] { return what.to_the_first && tape.difference().has_value(); });
    const auto file = new_recording(options, reader, how);
    if (!file.ok()) return complain(file.error(), kExitUsage);
    std::optional<record::BothTapes> both;
    if (file.value()) both.emplace(tape, *file.value());
    const auto ended = rerun.run(both ? static_cast<record::Tape&>(*both) : tape);
    if (!ended.ok()) return complain(ended.error(), options.from ? kExitUsage : kExitFailed);
    const Status there = looker.end();
    if (!there.ok()) return complain(there.error(), kExitUsage);
    const Status read = tape.end();
    if (!read.ok()) return complain(read.error(), kExitUsage);
    const Status written = file.value() ? file.value()->end() : Status::done();
    if (!written.ok()) return complain(written.error());
    const Time end = how.from ? *how.from : std::min(ended.value().at, what.until);
    return tell_result(options, reader, tape, ended.value(), end, looker.state());
}

int replay(const ReplayOptions& options) {
    const Status other = check_other_file("--repair", options.repair, options.file);
    if (!other.ok()) return complain(other.error(), kExitUsage);
    const auto file = MappedFile::open(options.file);
    if (!file.ok()) return complain(file.error(), kExitUsage);
    const auto reader = mcap::Reader::open(file.value().bytes(), options.file);
    if (!reader.ok()) return complain(reader.error(), kExitUsage);
    if (!options.repair.empty()) return repair(reader.value(), options.repair);
    if (!options.jumps.empty()) {
        return tell_jumps(reader.value(), {.list = options.jumps, .json = options.json});
    }
    const auto how = rerun_options(options, reader.value());
    if (!how.ok()) return complain(how.error(), kExitUsage);
    const auto rerun = record::Rerun::open(reader.value(), how.value());
    if (!rerun.ok()) return complain(rerun.error(), kExitUsage);
    const Status asked = check_bus(options, *rerun.value());
    if (!asked.ok()) return complain(asked.error(), kExitUsage);
    const auto points = log_points(options, *rerun.value());
    if (!points.ok()) return complain(points.error(), kExitUsage);
    if (!record::is_whole(reader.value())) {
        complain(options.file + ": " + std::string(record::kHasNoEnd));
    }
    return run_again(options, reader.value(), how.value(), *rerun.value(), *points.value());
}

// Nothing is compared and nothing is another way: of the other options none goes with it.
void add_jumps(CLI::App& verb, ReplayOptions& options) {
    CLI::Option* const jumps = verb.add_option(
        "--jumps", options.jumps,
        "compares nothing: goes to each instant of this list, back and forth, and tells which "
        "state there is; one instant a line, in seconds; - is the standard input");
    jumps->type_name("FILE|-");
    for (const char* const other :
         {"--until", "--with", "--from", "--set", "--reseed", "--record", "--log"}) {
        jumps->excludes(verb.get_option(other));
    }
}

}  // namespace

void add_replay(CLI::App& app, int& exit_code) {
    CLI::App* const verb = app.add_subcommand("replay", "runs a recorded run again, and compares");
    auto options = std::make_shared<ReplayOptions>();  // owners: CLI11's options and the callback
    takes_file(*verb->add_option("FILE", options->file, "the recording")->required(), {".mcap"});
    takes_seconds(*verb->add_option("--until", options->until,
                                    "ends at this instant and tells what there is at it"),
                  Seconds::Instant);
    verb->add_option("--with", options->with,
                     "a file in place of that of the same name in the recording; tells where the "
                     "two runs part; again for more")
        ->type_name("FILE|NAME=FILE")
        ->allow_extra_args(false);
    takes_seconds(
        *verb->add_option("--from", options->from,
                          "from this instant on the run goes another way: what was done from "
                          "outside later is not done, --set and --with take effect there"),
        Seconds::Instant);
    verb->add_option("--set", options->set,
                     "with --from: writes a variable of the plan at that instant; again for more")
        ->type_name("NAME=VALUE")
        ->allow_extra_args(false);
    takes_whole_number(
        *verb->add_option("--reseed", options->reseed,
                          "with --from: from that instant on noise, slip and math.rand are drawn "
                          "from this seed; what was done from outside is done all the same"),
        0, record::kReseedMax);
    takes_file(*verb->add_option("--record", options->record,
                                 "records the run as it is now, with its files"),
               {".mcap"});
    verb->add_option("--log", options->log,
                     "prints what these variables hold each time the line of a node's script "
                     "(drive:42), or the element of the plan (@followWall.enter, "
                     "@followWall.leave, @wallTouch.raise) is reached; of robots with projects of "
                     "their own that of each, or of one as r4/drive:42, r4/@takeTask.enter; again "
                     "for more")
        ->type_name("WHERE VALUES")
        ->allow_extra_args(false);
    add_jumps(*verb, *options);
    verb->add_flag("--json", options->json,
                   "log lines, states and result as lines of JSON on stdout");
    takes_file(*verb->add_option("--repair", options->repair,
                                 "runs nothing: writes what can be read of it as a whole file"),
               {".mcap"});
    verb->footer(
        "A recording has all files of its run in it. It runs again in virtual time, with what was "
        "done from outside at the same instants.\nValues of --log have commas between them: of a "
        "node, variables of its script and expressions in AESL, as \"token, watch.left[0]\"; of "
        "the plan, formulas. A line is reached before its first instruction, as by a breakpoint. "
        "The run stays as it was, which the comparison proves.\nExit codes: 0 no difference, 1 a "
        "difference, 2 not valid.\n\nExample:\n"
        "  vagus plan run WallFollow.plan.json --world hall.world.json --record run.mcap\n"
        "  vagus replay run.mcap\n"
        "  vagus replay run.mcap --with carbot.aesl\n"
        "  echo 82.5 | vagus replay run.mcap --jumps -\n"
        "  vagus replay run.mcap --from 20 --set walldist=40 --record other.mcap\n"
        "  vagus replay run.mcap --log drive:42 \"token, patience\" --log @followWall.enter "
        "walldist");
    verb->callback([options, &exit_code] { exit_code = replay(*options); });
}

}  // namespace vagus::cli
