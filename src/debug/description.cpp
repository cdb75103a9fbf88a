#include "debug/description.hpp"

#include <utility>

#include "debug/text.hpp"

namespace vagus::debug {
namespace {

std::string too_many(const char* what, size_t count) {
    return "it announces " + std::to_string(count) + " " + what + "; " +
           std::to_string(kDescriptionItemsMax) + " are the most that is accepted";
}

}  // namespace

Progress Description::begin(const wire::Description& header) {
    *this = Description();
    begun_ = true;
    variables_ = header.variable_count;
    local_events_ = header.local_event_count;
    natives_ = header.native_count;
    target_.name = take(header.name);
    target_.protocol_version = header.protocol_version;
    target_.bytecode_size = header.bytecode_size;
    target_.variables_size = header.variables_size;
    target_.stack_size = header.stack_size;
    if (variables_ > kDescriptionItemsMax) why_ = too_many("variables", variables_);
    if (local_events_ > kDescriptionItemsMax) why_ = too_many("local events", local_events_);
    if (natives_ > kDescriptionItemsMax) why_ = too_many("native functions", natives_);
    return progress();
}

Progress Description::add(const wire::NamedVariableDescription& variable) {
    if (target_.variables.size() >= variables_) return Progress::Ignored;
    target_.variables.push_back({take(variable.name), variable.size});
    words_ += variable.size;
    if (words_ > target_.variables_size) {
        why_ = "its variables need " + std::to_string(words_) + " words up to \"" +
               target_.variables.back().name + "\", but it announces memory for " +
               std::to_string(target_.variables_size);
    }
    return progress();
}

Progress Description::add(const wire::LocalEventDescription& event) {
    if (target_.local_events.size() >= local_events_) return Progress::Ignored;
    target_.local_events.push_back({take(event.name), take(event.doc)});
    return progress();
}

Progress Description::add(const wire::NativeFunctionDescription& native) {
    if (target_.natives.size() >= natives_) return Progress::Ignored;
    aesl::NativeFunction function{take(native.name), take(native.doc), {}};
    for (uint16_t i = 0; i < native.parameter_count; i++) {
        function.parameters.push_back({take(native.parameters[i].name), native.parameters[i].size});
    }
    target_.natives.push_back(std::move(function));
    return progress();
}

bool Description::complete() const {
    return begun_ && target_.variables.size() == variables_ &&
           target_.local_events.size() == local_events_ && target_.natives.size() == natives_;
}

aesl::Target Description::give() {
    aesl::Target header;
    header.name = target_.name;
    header.protocol_version = target_.protocol_version;
    header.bytecode_size = target_.bytecode_size;
    header.variables_size = target_.variables_size;
    header.stack_size = target_.stack_size;
    target_.variables.shrink_to_fit();
    target_.local_events.shrink_to_fit();
    target_.natives.shrink_to_fit();
    return std::exchange(target_, std::move(header));
}

size_t Description::items() const {
    return target_.variables.size() + target_.local_events.size() + target_.natives.size();
}

bool Description::same_header(const wire::Description& header) const {
    return begun_ && target_.name == clean_text(header.name) &&
           target_.protocol_version == header.protocol_version &&
           target_.bytecode_size == header.bytecode_size &&
           target_.variables_size == header.variables_size &&
           target_.stack_size == header.stack_size && variables_ == header.variable_count &&
           local_events_ == header.local_event_count && natives_ == header.native_count;
}

Progress Description::progress() {
    if (bytes_ > kDescriptionBytesMax && why_.empty()) {
        why_ =
            "its names and texts have more than " + std::to_string(kDescriptionBytesMax) + " bytes";
    }
    if (!why_.empty()) return Progress::Impossible;
    return complete() ? Progress::Complete : Progress::More;
}

std::string Description::take(wire::Text text) {
    bytes_ += text.size;
    return clean_text(text);
}

}  // namespace vagus::debug
