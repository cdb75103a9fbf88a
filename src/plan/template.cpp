#include "plan/template.hpp"

#include <fmt/format.h>

namespace vagus::plan {

namespace {

template <typename List>
int find_in(const List& list, std::string_view name) {
    for (size_t i = 0; i < list.size(); ++i) {
        if (list[i].name == name) return static_cast<int>(i);
    }
    return -1;
}

}  // namespace

std::string_view name_of(Kind kind) {
    switch (kind) {
        case Kind::Actor:
            return "actor";
        case Kind::Computation:
            return "computation";
        case Kind::Supervisor:
            break;
    }
    return "supervisor";
}

const Toolbox* Library::find(std::string_view toolbox) const {
    const int index = find_in(toolboxes_, toolbox);
    return index < 0 ? nullptr : &toolboxes_[static_cast<size_t>(index)];
}

bool is_within(const Input& input, double number) {
    return number >= input.low.value_or(number) && number <= input.high.value_or(number);
}

std::string range_of(const Input& input) {
    if (!input.high) return "at least " + text_of(input.low.value_or(0));
    if (!input.low) return "at most " + text_of(*input.high);
    return fmt::format("from {} to {}", text_of(*input.low), text_of(*input.high));
}

int find_input(const Template& of, std::string_view name) {
    return find_in(of.inputs, name);
}

int find_output(const Template& of, std::string_view name) {
    return find_in(of.outputs, name);
}

int find_outcome(const Template& of, std::string_view name) {
    return find_in(of.outcomes, name);
}

}  // namespace vagus::plan
