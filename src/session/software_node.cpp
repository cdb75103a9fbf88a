#include "session/software_node.hpp"

#include <algorithm>

#include "debug/program_mark.hpp"
#include "session/software_natives.hpp"

namespace vagus::session {

namespace {

SoftwareNode& self(node::Node& node) {
    return *static_cast<SoftwareNode*>(node.owner);
}

size_t described_words(const aesl::Target& target) {
    size_t words = 0;
    for (const aesl::NamedVariable& variable : target.variables) words += variable.size;
    return words;
}

Status check_sizes(const aesl::Target& target) {
    const std::string node = "node " + target.name;
    if (target.bytecode_size == 0) {
        return Error{Code::BadInput, node + " has no bytecode memory: give it at least one word"};
    }
    const size_t words = described_words(target);
    if (words > target.variables_size) {
        return Error{Code::Limit, node + " describes variables of " + std::to_string(words) +
                                      " words, but has memory for " +
                                      std::to_string(target.variables_size) +
                                      ": enlarge variablesSize or describe fewer"};
    }
    return Status::done();
}

// Words of a user event that the node keeps: the third variable, by convention `event.args`
// (section 3.10).
uint16_t arguments_capacity(const aesl::Target& target) {
    return target.variables.size() < 3 ? uint16_t{0} : target.variables[2].size;
}

}  // namespace

Result<std::unique_ptr<SoftwareNode>> SoftwareNode::make(aesl::Target target,
                                                         SoftwareNodeOptions options) {
    TRY(check_sizes(target));
    // The constructor is private: a node must not move, its parts point to each other.
    std::unique_ptr<SoftwareNode> node(new SoftwareNode(std::move(target), std::move(options)));
    TRY(node->describe());
    return node;
}

SoftwareNode::SoftwareNode(aesl::Target target, SoftwareNodeOptions options)
    : target_(std::move(target)),
      options_(std::move(options)),
      bytecode_(target_.bytecode_size),
      variables_(target_.variables_size),
      stack_(target_.stack_size) {
    static constexpr node::Board kBoard = {
        [](node::Node& node, uint16_t type) { self(node).maker_.begin(node, type); },
        [](node::Node& node, uint8_t byte) { self(node).maker_.put(byte); },
        [](node::Node& node) { self(node).options_.transmit(self(node).maker_.frame()); },
        [](node::Node& node, vm::Notice notice) { self(node).notice(notice); },
        wire::kVariablesReplyWordsMax};
    config_ = {.id = options_.id,
               .bytecode_size = target_.bytecode_size,
               .variables_size = target_.variables_size,
               .stack_size = target_.stack_size,
               .arguments_capacity = arguments_capacity(target_),
               .bytecode = bytecode_.memory(),
               .variables = variables_.data(),
               .stack = stack_.data(),
               .breakpoints = breakpoints_,
               .host = &node::kMachineHost,
               .owner = &node_};
    node::init(node_, config_, description_, kBoard, this);
}

void SoftwareNode::notice(vm::Notice notice) {
    bytecode_.notice(notice);
    options_.notify(notice);
}

Status SoftwareNode::describe() {
    for (const auto& variable : target_.variables) {
        variable_list_.push_back({variable.size, variable.name.c_str()});
    }
    for (const auto& event : target_.local_events) {
        event_list_.push_back({event.name.c_str(), event.doc.c_str()});
    }
    for (const auto& native : target_.natives) {
        const node::Native* code = TRY(code_of_native(native));
        std::vector<node::Parameter> parameters;
        for (const auto& parameter : native.parameters) {
            parameters.push_back({parameter.size, parameter.name.c_str()});
        }
        // The vector of vectors may move them; their words stay where they are.
        parameter_lists_.push_back(std::move(parameters));
        native_list_.push_back({native.name.c_str(), native.doc.c_str(),
                                parameter_lists_.back().data(),
                                static_cast<uint16_t>(native.parameters.size()), code->function});
    }
    description_ = {.name = target_.name.c_str(),
                    .protocol_version = target_.protocol_version,
                    .local_event_source = options_.local_event_source,
                    .variable_count = static_cast<uint16_t>(variable_list_.size()),
                    .variables = variable_list_.data(),
                    .local_event_count = static_cast<uint16_t>(event_list_.size()),
                    .local_events = event_list_.data(),
                    .natives = {{native_list_.data(), static_cast<uint16_t>(native_list_.size())},
                                {nullptr, 0}},
                    .program_at = debug::mark_address(target_).value_or(0)};
    return Status::done();
}

std::optional<VariableRange> SoftwareNode::find_variable(std::string_view name) const {
    uint16_t address = 0;
    for (const aesl::NamedVariable& variable : target_.variables) {
        if (variable.name == name) return VariableRange{address, variable.size};
        address = static_cast<uint16_t>(address + variable.size);
    }
    return std::nullopt;
}

std::optional<uint16_t> SoftwareNode::find_local_event(std::string_view name) const {
    const auto found = std::ranges::find(target_.local_events, name, &aesl::LocalEvent::name);
    if (found == target_.local_events.end()) return std::nullopt;
    return static_cast<uint16_t>(found - target_.local_events.begin());
}

void SoftwareNode::start_program() {
    node::start_program(node_);
    node::identify(node_, loaded_);  // without what a `when` remembered in its words
}

std::span<const uint16_t> SoftwareNode::program() const {
    const size_t end = node_.identity.end;
    return end <= bytecode_.size() ? bytecode().first(end) : bytecode();
}

Status SoftwareNode::load(std::span<const uint16_t> program) {
    if (program.size() > bytecode_.size()) {
        return Error{Code::Limit, "the program has " + std::to_string(program.size()) +
                                      " words, but node " + target_.name + " has memory for " +
                                      std::to_string(bytecode_.size())};
    }
    bytecode_.load(program);
    loaded_ = static_cast<uint16_t>(program.size());
    node::identify(node_, loaded_);
    return Status::done();
}

}  // namespace vagus::session
