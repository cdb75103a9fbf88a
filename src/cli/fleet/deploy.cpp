#include "cli/fleet/deploy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>

#include "base/file.hpp"
#include "base/temporary_folder.hpp"
#include "base/text.hpp"
#include "cli/output.hpp"
#include "fleet/rollout.hpp"
#include "serve/field/pack.hpp"
#include "serve/process.hpp"
#include "serve/web/server.hpp"

namespace vagus::cli {
namespace {

namespace fs = std::filesystem;

constexpr size_t kTokenBytes = 24;

// A folder with one file, whose name nobody can guess, served while this lives.
class Shelf {
public:
    static Result<std::unique_ptr<Shelf>> open(const FleetCall& call, const std::string& bytes) {
        // make_unique cannot reach the constructor.
        std::unique_ptr<Shelf> shelf(new Shelf(TRY(TemporaryFolder::make("shelf"))));
        const fs::path folder = shelf->folder_.path();
        TRY(write_file(folder / "index.html", "A version of a fleet of Vagus.\n"));
        TRY(write_file(folder / shelf->token_, bytes));
        TRY(shelf->serve(call));
        return shelf;
    }
    const std::string& address() const { return address_; }

private:
    explicit Shelf(TemporaryFolder folder) : folder_(std::move(folder)) {}

    Status serve(const FleetCall& call) {
        serve::WebOptions options{
            .pages = folder_.path(), .tls_cert = call.certificate, .tls_key = call.key};
        const size_t colon = call.listen.rfind(':');
        const std::string port = colon == std::string::npos ? "" : call.listen.substr(colon + 1);
        const char* const end = port.data() + port.size();
        const auto read = std::from_chars(port.data(), end, options.port);
        if (port.empty() || read.ec != std::errc() || read.ptr != end) {
            return Error{Code::BadInput, "--listen " + call.listen +
                                             ": expected ADDRESS:PORT, such as 0.0.0.0:8443"};
        }
        options.address = call.listen.substr(0, colon);
        const bool here = options.address.starts_with("127.");
        if (!here && call.certificate.empty()) {
            return Error{Code::BadInput,
                         "--listen " + call.listen +
                             ": robots fetch from another computer by HTTPS alone; name a "
                             "certificate that they trust: --serve-cert FILE --serve-key FILE"};
        }
        const std::string host = !call.host.empty() ? call.host
                                 : here             ? "localhost"
                                                    : serve::host_name();
        options.hosts = {host};
        server_ = TRY(serve::WebServer::start(options, [] {}));
        address_ = fmt::format("{}://{}:{}/{}", call.certificate.empty() ? "http" : "https", host,
                               server_->port(), token_);
        return Status::done();
    }

    TemporaryFolder folder_;  // goes after the server
    const std::string token_ = hex_of(serve::random_bytes(kTokenBytes));
    std::string address_;
    std::unique_ptr<serve::WebServer> server_;
};

// Those that are there come first: they say at once whether it is a good version.
std::vector<std::string> in_order(FleetSession& session, const FleetCall& call) {
    std::vector<std::string> names = session.desk().chosen(chosen_by(call));
    const auto is_there = [&](const std::string& name) {
        const auto found = session.desk().robots().find(name);
        return found != session.desk().robots().end() && fleet::Operator::is_online(found->second);
    };
    std::stable_partition(names.begin(), names.end(), is_there);
    return names;
}

int roll_out(FleetSession& session, fleet::Rollout rollout) {
    std::map<std::string, std::string> told;
    session.on_event([&](const fleet::LinkEvent& event) { rollout.hear(event, session.now()); });
    session.subscribe({{fleet::filter_of(session.fleet(), fleet::Kind::Version)}});
    const auto turn = [&] {
        rollout.tick(session.now());
        for (const fleet::Post& post : rollout.take()) session.publish(post);
        for (const auto& [robot, line] : rollout.table()) {
            if (line == "as it was" || std::exchange(told[robot], line) == line) continue;
            print(fmt::format("{}: {}\n", robot, line));
        }
        return rollout.is_over();
    };
    const bool ended = session.wait_until(turn, Duration::max() / 4);
    session.on_event([](auto&) {});
    size_t well = 0;
    const auto table = rollout.table();
    for (const auto& [robot, line] : table) {
        if (line == "well") ++well;
        if (line == "as it was") print(robot + ": as it was\n");
    }
    print(fmt::format("{} of {} robots: well\n", well, table.size()));
    if (!ended) say("the roll-out was left; robots that have it go on with it\n");
    return rollout.all_are_well() ? kExitDone : kExitFailed;
}

}  // namespace

int deploy(FleetSession& session, const FleetCall& call) {
    const std::vector<std::string> robots = in_order(session, call);
    if (robots.empty()) return complain("no robot is there that this is for");
    const auto steps = fleet::read_steps(call.steps, robots.size());
    if (!steps.ok()) return complain_of(steps.error());
    fleet::Want want{.number = 1 + serve::random_number(), .back = call.rollback};
    std::unique_ptr<Shelf> shelf;
    if (!call.rollback) {
        const auto collected = serve::collect_bundle(call.project);
        if (!collected.ok()) return complain_of(collected.error());
        const auto bytes = serve::pack(collected.value());
        if (!bytes.ok()) return complain_of(bytes.error());
        auto opened = Shelf::open(call, bytes.value());
        if (!opened.ok()) return complain_of(opened.error());
        shelf = std::move(opened.value());
        want.sha256 = serve::sha256_of(bytes.value());
        want.address = shelf->address();
    }
    const auto within = std::chrono::duration_cast<Duration>(
        std::chrono::duration<double>(call.wait_s.value_or(kRolloutWait_s)));
    return roll_out(session, fleet::Rollout({.fleet = session.fleet(),
                                             .want = want,
                                             .robots = robots,
                                             .steps = steps.value(),
                                             .within = within}));
}

}  // namespace vagus::cli
