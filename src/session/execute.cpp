#include "session/execute.hpp"

#include <algorithm>

#include "base/nearest.hpp"
#include "isa/isa.hpp"
#include "session/software_node.hpp"
#include "wire/reports.hpp"

namespace vagus::session {

namespace {

using Words = std::vector<int16_t>;

constexpr uint16_t kBatch = 10'000;  // instructions between two looks at the limit

std::string unknown(std::string_view kind, const std::string& name,
                    const std::vector<std::string_view>& known) {
    std::string sentence = "stimuli: there is no " + std::string(kind) + " " + name;
    const std::string near = nearest(name, known);
    return sentence +
           (near.empty() ? ": use one that the node has" : ": did you mean " + near + "?");
}

// One run of one program: a node, and a list of what it says.
class Run {
public:
    Run(const aesl::Program& program, const aesl::NodeFile& file)
        : program_(program), file_(file) {}

    Result<Execution> all(const std::vector<aesl::Stimulus>& stimuli, uint32_t steps_per_event);

private:
    Status prepare();
    Status apply(const aesl::Stimulus& stimulus);
    Status assign(const std::string& name, const Words& words);
    Status write_convention(size_t index, const Words& words);
    Status write(const aesl::VariablePlace& place, const Words& words);
    Result<uint16_t> number_of(const std::string& event) const;
    void finish_event(uint16_t event, uint32_t steps);
    void hear(const wire::Frame& frame);
    void hear_emission(const wire::Frame& frame);
    void fail(StopKind kind, uint16_t pc);
    void collect_memory();

    const aesl::Program& program_;
    const aesl::NodeFile& file_;
    std::unique_ptr<SoftwareNode> node_;
    int during_ = 0;
    Execution result_;
};

Status Run::prepare() {
    SoftwareNodeOptions options;
    options.transmit = [this](const wire::Frame& frame) { hear(frame); };
    node_ = TRY(SoftwareNode::make(file_.target, std::move(options)));
    return node_->load(program_.bytecode);
}

Result<Execution> Run::all(const std::vector<aesl::Stimulus>& stimuli, uint32_t steps_per_event) {
    TRY(prepare());
    finish_event(isa::kInitEvent, steps_per_event);
    for (const aesl::Stimulus& stimulus : stimuli) {
        if (result_.error) break;
        ++during_;
        TRY(apply(stimulus));
        if (stimulus.event.empty()) continue;
        finish_event(TRY(number_of(stimulus.event)), steps_per_event);
    }
    collect_memory();
    return std::move(result_);
}

// All but the run of the handler.
Status Run::apply(const aesl::Stimulus& stimulus) {
    for (const aesl::Assignment& assignment : stimulus.set) {
        TRY(assign(assignment.variable, assignment.words));
    }
    if (stimulus.source) TRY(write_convention(1, {*stimulus.source}));
    if (!stimulus.arguments.empty()) TRY(write_convention(2, stimulus.arguments));
    return Status::done();
}

Status Run::assign(const std::string& name, const Words& words) {
    const auto place = std::ranges::find(program_.variables, name, &aesl::VariablePlace::name);
    if (place != program_.variables.end()) return write(*place, words);
    std::vector<std::string_view> names;
    for (const auto& variable : program_.variables) names.push_back(variable.name);
    return Error{Code::NotFound, unknown("variable", name, names)};
}

// Into the node's second or third variable: source and arguments of an event.
Status Run::write_convention(size_t index, const Words& words) {
    if (index < file_.target.variables.size()) return write(program_.variables[index], words);
    return Error{Code::NotFound, "stimuli: node " + file_.target.name + " has only " +
                                     std::to_string(file_.target.variables.size()) +
                                     " variables; source and arguments of an event go to the "
                                     "second and third: leave them out"};
}

Status Run::write(const aesl::VariablePlace& place, const Words& words) {
    if (words.size() > place.size) {
        return Error{Code::Limit, "stimuli: " + place.name + " has " + std::to_string(place.size) +
                                      " words, but " + std::to_string(words.size()) +
                                      " are given: give at most as many"};
    }
    std::ranges::copy(words, node_->variables().begin() + place.address);
    return Status::done();
}

Result<uint16_t> Run::number_of(const std::string& event) const {
    if (const auto local = node_->find_local_event(event)) {
        return static_cast<uint16_t>(isa::kLocalEventFirst - *local);
    }
    const auto& globals = file_.common.events;
    const auto global = std::ranges::find(globals, event, &aesl::GlobalEvent::name);
    if (global != globals.end()) return static_cast<uint16_t>(global - globals.begin());
    std::vector<std::string_view> names;
    for (const auto& known : file_.target.local_events) names.push_back(known.name);
    for (const auto& known : globals) names.push_back(known.name);
    return Error{Code::NotFound, unknown("event", event, names)};
}

void Run::finish_event(uint16_t event, uint32_t steps) {
    node_->start_event(event);
    while (node_->is_active()) {
        const uint32_t batch = std::min<uint32_t>(steps, kBatch);
        if (batch == 0 || result_.emitted.size() >= kEmissionsMax) {
            return fail(StopKind::StepLimit, node_->pc());
        }
        steps -= node_->run(static_cast<uint16_t>(batch));
    }
}

void Run::hear(const wire::Frame& frame) {
    if (wire::is_user_event(frame.type)) return hear_emission(frame);
    wire::Fault fault;
    if (!wire::read_fault(frame, fault)) return;
    switch (fault.kind) {
        case wire::FaultKind::DivisionByZero:
            return fail(StopKind::DivisionByZero, fault.pc);
        case wire::FaultKind::ArrayAccess:
            fail(StopKind::ArrayOutOfBounds, fault.pc);
            result_.error->size = fault.size;
            result_.error->index = fault.index;
            return;
        case wire::FaultKind::NodeSpecific:
            fail(StopKind::NodeSpecific, fault.pc);
            result_.error->text.assign(fault.text.bytes, fault.text.size);
            return;
        case wire::FaultKind::Killed:
            return;
    }
}

void Run::hear_emission(const wire::Frame& frame) {
    if (result_.emitted.size() >= kEmissionsMax) return;
    const auto& events = file_.common.events;
    Emission emission{.during = during_, .event = {}, .arguments = {}};
    emission.event =
        frame.type < events.size() ? events[frame.type].name : std::to_string(frame.type);
    emission.arguments = wire::arguments_of<std::vector<int16_t>>(frame);
    result_.emitted.push_back(std::move(emission));
}

void Run::fail(StopKind kind, uint16_t pc) {
    RuntimeError error;
    error.kind = kind;
    error.during = during_;
    error.line = pc < program_.lines.size() ? program_.lines[pc] : 0;
    result_.error = std::move(error);
}

void Run::collect_memory() {
    const size_t described = file_.target.variables.size();
    for (size_t i = 0; i < program_.variables.size(); ++i) {
        const aesl::VariablePlace& place = program_.variables[i];
        const auto words = node_->variables().subspan(place.address, place.size);
        const bool zero = std::ranges::all_of(words, [](int16_t word) { return word == 0; });
        if (i < described && zero) continue;
        result_.memory.push_back({place.name, Words(words.begin(), words.end())});
    }
}

}  // namespace

Result<Execution> execute(const aesl::Program& program, const aesl::NodeFile& node,
                          const std::vector<aesl::Stimulus>& stimuli, uint32_t steps_per_event) {
    return Run(program, node).all(stimuli, steps_per_event);
}

}  // namespace vagus::session
