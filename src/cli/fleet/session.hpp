// One run of `vagus fleet TARGET VERB`: a connection to a broker, an operator (fleet/operator.hpp),
// and the time. Every wait has an end: a deadline, an answer, Ctrl-C.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "fleet/operator.hpp"
#include "fleet/rollout.hpp"
#include "serve/broker/bell.hpp"
#include "serve/broker/fleet_options.hpp"
#include "serve/web/shelf.hpp"

namespace vagus::cli {

constexpr double kFleetWait_s = 10;  // for answers

struct FleetCall {
    serve::FleetOptions broker;
    std::optional<double> wait_s;
    bool json = false;
    std::string robot, group;  // neither: see the verbs
    fleet::Command command;    // of verbs that want something
    std::vector<int> values;
    std::string variable;
    std::string project, steps = fleet::kStepsUnlessTold;  // of deploy
    serve::ShelfOptions shelf;
    bool rollback = false;
};

// Whom it is for.
fleet::Chosen chosen_by(const FleetCall& call);

// What was called in the wrong way is told apart from what did not work. The exit code.
int complain_of(const Error& error);

class FleetSession {
public:
    static Result<std::unique_ptr<FleetSession>> open(const FleetCall& call,
                                                      fleet::Operator::Options options);

    fleet::Operator& desk() { return *desk_; }
    const std::string& fleet() const { return fleet_; }
    // Called with each event of the link, after the operator has heard it.
    void on_event(std::function<void(const fleet::LinkEvent&)> event) { event_ = std::move(event); }
    // Until it holds (true), the time is over, or the program is asked to end.
    bool wait_until(const std::function<bool()>& holds, Duration within);
    // The connection was made, and all that was retained has come; the Error says why not.
    Status know_all(Duration within);
    void publish(const fleet::Post& post) { link_->publish(post); }
    void subscribe(const std::vector<fleet::Filter>& filters) { link_->subscribe(filters); }
    Duration now() const;
    // Why nothing is known of the fleet after that time.
    std::string why_unknown(Duration waited) const;
    bool is_connected() const { return was_connected_ && lost_.empty(); }

private:
    FleetSession() = default;
    void turn();
    void note(const fleet::LinkEvent& event);

    std::string fleet_, target_;
    std::unique_ptr<fleet::Operator> desk_;
    std::string lost_;
    bool was_connected_ = false;
    std::function<void(const fleet::LinkEvent&)> event_ = [](auto&) {};
    serve::Bell bell_;
    std::unique_ptr<serve::MosquittoLink> link_;  // ends before what its thread wakes
};

}  // namespace vagus::cli
