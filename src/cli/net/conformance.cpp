// `vagus conformance`: examines a live node, row by row.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "base/text.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"
#include "cli/verbs.hpp"
#include "conformance/examine.hpp"
#include "conformance/report_text.hpp"
#include "net/client.hpp"
#include "net/end_signal.hpp"

namespace vagus::cli {
namespace {

using namespace std::chrono_literals;

constexpr Duration kConnectWithin = 5s;
constexpr Duration kLookForEndEvery = 100ms;
constexpr uint32_t kMaxTimeMost_s = 24 * 3600;
constexpr uint16_t kNobodyHighest = 250;  // fits a CAN identifier

struct ConformanceOptions {
    std::string target;
    std::string node;
    std::string only;
    uint32_t max_time_s = 0;
    bool json = false;
    bool may_drive = false;
    bool flash = false;
    bool sleep = false;
};

// The connection, which Ctrl-C cuts.
class LiveLine : public conformance::Line {
public:
    explicit LiveLine(net::Client client) : client_(std::move(client)) {}
    Status send(const wire::Frame& frame) override {
        if (net::end_asked()) return interrupted();
        return client_.send(frame);
    }
    Result<std::optional<wire::Frame>> receive(Time deadline) override {
        do {
            if (net::end_asked()) return interrupted();
            const Time until = std::min(deadline, now() + kLookForEndEvery);
            std::optional<wire::Frame> frame = TRY(client_.receive(until));
            if (frame) return frame;
        } while (now() < deadline);
        return std::optional<wire::Frame>{};
    }
    Time now() const override { return client_.now(); }

private:
    static Error interrupted() { return Error{Code::Timeout, "interrupted"}; }
    net::Client client_;
};

struct Candidate {
    uint16_t id = 0;
    aesl::Target target;
};

std::string name_of(const Candidate& node) {
    return "node " + std::to_string(node.id) + " \"" + node.target.name + "\"";
}

// Words of a name, by which variables of motors are known: motor.left.target, speed.left.
bool sounds_like_a_motor(const std::string& name) {
    static const std::vector<std::string_view> kWords = {"motor",  "motors", "speed", "wheel",
                                                         "wheels", "drive",  "servo", "pwm"};
    const std::string small = small_letters(name);
    for (const std::string_view part : split(small, '.'))
        if (std::ranges::find(kWords, part) != kWords.end()) return true;
    return false;
}

Status refuse_to_drive(const Candidate& node) {
    for (const aesl::NamedVariable& variable : node.target.variables) {
        if (!sounds_like_a_motor(variable.name)) continue;
        return Error{Code::Refused,
                     name_of(node) + " seems to have motors (" + variable.name +
                         "): without its program nothing stops them. Hold the robot, or put it "
                         "where it may drive, and say --may-drive"};
    }
    return Status::done();
}

Result<Candidate> only_node(conformance::Line& line, const std::vector<uint16_t>& ids,
                            const std::string& target) {
    if (ids.empty()) return Error{Code::NotFound, "no node answers on " + target};
    if (ids.size() == 1) {
        auto described = TRY(conformance::describe(line, ids[0]));
        return Candidate{ids[0], std::move(described)};
    }
    std::string list;
    for (const uint16_t id : ids) list += (list.empty() ? "" : ", ") + std::to_string(id);
    return Error{Code::BadInput,
                 "several nodes answer on " + target + " (" + list + "): say which, by --node"};
}

// By its number, or by the name that it describes itself with.
Result<Candidate> named_node(conformance::Line& line, const std::vector<uint16_t>& ids,
                             const ConformanceOptions& options) {
    const std::optional<uint64_t> number = decimal_number(options.node);
    std::string others;
    for (const uint16_t id : ids) {
        if (number && *number != id) continue;
        auto described = TRY(conformance::describe(line, id));
        Candidate node{id, std::move(described)};
        if (number || node.target.name == options.node) return node;
        others += (others.empty() ? "; there is " : ", ") + name_of(node);
    }
    return Error{Code::NotFound,
                 "no node " + options.node + " answers on " + options.target + others};
}

uint16_t unused_id(const std::vector<uint16_t>& ids) {
    uint16_t id = kNobodyHighest;
    while (std::ranges::find(ids, id) != ids.end()) --id;
    return id;
}

void say_beforehand(const Candidate& node, const ConformanceOptions& options) {
    const std::string flash =
        options.flash ? "what it keeps in flash, too" : "what it keeps in flash stays";
    say("vagus: examining " + visible(name_of(node)) +
        ": its program is replaced, and cannot be put back; " + flash + "\n");
}

void say_afterwards(const conformance::Report& report) {
    say(report.left_clear ? "vagus: the node is left without a program; load yours again\n"
                          : "vagus: the node could not be cleared; restart it\n");
    if (report.foreign > 0)
        say("vagus: another program sends commands to this node; findings may come from that: "
            "end it and repeat\n");
}

// A reader that holds up the rows must not make the node look late. The result waits as usual.
conformance::Report examine_unhindered(conformance::Line& line, const conformance::Order& order,
                                       const aesl::Target& target) {
    const OutputNeverWaits never;
    return conformance::examine(line, order, target);
}

Result<int> examine(const ConformanceOptions& options) {
    const net::Target target = TRY(net::parse_target(options.target));
    if (!conformance::is_any_check(options.only))
        return Error{Code::BadInput, "no check has \"" + options.only + "\" in its group or name"};
    LiveLine line(TRY(net::Client::connect(target, kConnectWithin)));
    const std::vector<uint16_t> ids = TRY(conformance::who_is_there(line));
    const Candidate node = options.node.empty() ? TRY(only_node(line, ids, options.target))
                                                : TRY(named_node(line, ids, options));
    if (!options.may_drive) TRY(refuse_to_drive(node));
    say_beforehand(node, options);
    conformance::Order order{.node = node.id,
                             .nobody = unused_id(ids),
                             .flash = options.flash,
                             .sleep = options.sleep,
                             .time_limit = std::chrono::seconds(options.max_time_s),
                             .only = options.only};
    if (!options.json)
        order.tell = [](const conformance::Row& row) { print(conformance::row_text(row)); };
    const conformance::Report report = examine_unhindered(line, order, node.target);
    print(options.json ? conformance::report_json(report) : conformance::summary_text(report));
    say_afterwards(report);
    const bool clean = report.count(conformance::Verdict::Failed) == 0 &&
                       report.count(conformance::Verdict::NotRun) == 0;
    return clean ? kExitDone : kExitFailed;
}

int run_conformance(const ConformanceOptions& options) {
    net::watch_for_end();
    const Result<int> done = examine(options);
    if (done.ok()) return net::end_as_asked(done.value());
    const Code code = done.error().code;
    const bool wrong = code == Code::BadInput || code == Code::Refused;
    return complain(done.error(), wrong ? kExitUsage : kExitFailed);
}

}  // namespace

void add_conformance(CLI::App& app, int& exit_code) {
    CLI::App* verb = app.add_subcommand(
        "conformance", "examines whether a live node does all that the specification says");
    auto options = std::make_shared<ConformanceOptions>();  // owners: the options, the callback
    verb->add_option("TARGET", options->target, "tcp:HOST:PORT, ser:DEVICE or can:INTERFACE")
        ->required();
    verb->add_option("--node", options->node, "which, if there are several: number or name")
        ->type_name("NODE");
    verb->add_option("--only", options->only, "only checks that have this in their group or name")
        ->type_name("TEXT");
    options->max_time_s = static_cast<uint32_t>(
        std::chrono::duration_cast<std::chrono::seconds>(conformance::kTimeLimit).count());
    CLI::Option* max_time =
        verb->add_option("--max-time", options->max_time_s,
                         "seconds for all checks; those that are left then are not run (exit 1)");
    max_time->type_name("S")->capture_default_str();
    takes_whole_number(*max_time, 1, kMaxTimeMost_s);
    verb->add_flag("--json", options->json, "the result as JSON, at the end");
    verb->add_flag("--flash", options->flash,
                   "also WriteBytecode and Reboot: the program that the node keeps is overwritten");
    verb->add_flag(
        "--sleep", options->sleep,
        "also SuspendToRam, as the last: a node that can sleep must be switched on again");
    verb->add_flag("--may-drive", options->may_drive,
                   "go on although the node has motors, which keep what they were told last");
    verb->footer(
        "The program of the node is replaced by small ones, one for each check, and is not put "
        "back.\nMotors are not touched. No other host may talk to the node meanwhile. A check that "
        "the node\nis too small for is skipped, and says so. Exit codes: 0 nothing failed, 1 "
        "something did, or no\nnode answers, 2 wrong command line.\n"
        "Example:\n  vagus conformance tcp:127.0.0.1:33333\n"
        "  vagus conformance ser:/dev/ttyACM0 --node 3 --only natives");
    verb->callback([options, &exit_code] { exit_code = run_conformance(*options); });
}

}  // namespace vagus::cli
