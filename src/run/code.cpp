#include "run/code.hpp"

#include "run/options.hpp"

#include <cassert>

namespace vagus::run {

ActorContext::ActorContext(std::vector<plan::Value> in, size_t outputs, uint64_t number)
    : in_(std::move(in)), number_(number) {
    given_.outputs.resize(outputs);
}

void ActorContext::out(size_t index, plan::Value value) {
    given_.outputs[index] = std::move(value);
}

ActorContext::Woken ActorContext::wait_or_stop(Duration at_most, std::string_view event) {
    if (told_) throw Stop();
    return unless_stopped(wait(at_most, event));
}

ActorContext::Woken ActorContext::unless_stopped(Woken woken) {
    if (!woken.stop) return woken;
    told_ = true;
    throw Stop();
}

void ActorContext::sleep(Duration time) {
    // An unused name: no event of a bus is called this.
    constexpr std::string_view kNoEvent("\0", 1);
    wait_or_stop(time, kNoEvent);
}

BusEvent ActorContext::wait_event(std::string_view name) {
    return *wait_or_stop(kNever, name).event;
}

std::optional<BusEvent> ActorContext::wait_event(std::string_view name, Duration at_most) {
    return wait_or_stop(at_most, name).event;
}

void ActorContext::wait_until(const std::function<bool()>& holds, Duration every) {
    while (!holds()) sleep(every);
}

std::optional<BusEvent> ActorContext::next_event(Duration at_most) {
    if (told_) throw Stop();
    return unless_stopped(wait_kept(at_most)).event;
}

std::optional<BusEvent> ActorContext::linger_event(Duration at_most) {
    assert(told_);
    return wait_kept(at_most).event;
}

void Supervisor::started(const std::vector<plan::Value>&, SupervisorContext&) {}

void Supervisor::stopped(SupervisorContext&) noexcept {}

void CodeLibrary::add(std::string toolbox, std::string help, std::vector<Coded> templates,
                      std::string file) {
    plan::Toolbox declared{std::move(toolbox), std::move(help), {}, std::move(file)};
    for (const Coded& coded : templates) {
        declared.templates.push_back(coded.declared);
    }
    library_.add(std::move(declared));
    const plan::Toolbox& kept = library_.toolboxes().back();
    for (size_t i = 0; i < templates.size(); ++i) {
        makers_[&kept.templates[i]] = {std::move(templates[i].actor),
                                       std::move(templates[i].supervisor)};
    }
}

std::unique_ptr<Actor> CodeLibrary::make_actor(const plan::Template& of) const {
    return makers_.at(&of).actor();
}

std::unique_ptr<Supervisor> CodeLibrary::make_supervisor(const plan::Template& of) const {
    return makers_.at(&of).supervisor();
}

void throw_if_refused(const RunOptions& options, const BusEvent& event) {
    if (!options.may_emit) return;
    const Status may = options.may_emit(event);
    if (!may.ok()) throw CodeError(may.error().what);
}

int exit_status(const Ended& ended) {
    if (ended.result == plan::PlanResult::Error) return 4;
    if (ended.timed_out) return 5;
    return ended.result == plan::PlanResult::Ok ? 0 : 3;
}

}  // namespace vagus::run
