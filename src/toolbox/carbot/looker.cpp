#include "toolbox/carbot/looker.hpp"

#include "toolbox/carbot/inputs.hpp"

namespace vagus::toolbox::carbot {

namespace {

plan::Input part(std::string name, double value) {
    return {.name = std::move(name),
            .type = plan::Type::Float,
            .fallback = plan::Value(value),
            .help = "how much of it is in the object's colour",
            .low = 0,
            .high = 1};
}

Camera& camera_of(const Parts& parts, const plan::Template& of) {
    if (parts.camera != nullptr) return *parts.camera;
    throw run::CodeError(of.name +
                         " needs a camera, and there is none; run the plan with --world "
                         "and a carbot in that world");
}

ObjectColour colour_of(const run::ActorContext& context, const plan::Template& of) {
    const ObjectColour colour = {input_of(context, of, 0), input_of(context, of, 1),
                                 input_of(context, of, 2)};
    if (saturation(colour) >= kColourFullness) return colour;
    throw run::CodeError(fmt::format(
        "the colour {}, {}, {} is too grey to be told from walls; the largest part must be at "
        "least {:.2f} times the smallest",
        plan::text_of(colour.red), plan::text_of(colour.green), plan::text_of(colour.blue),
        1 / (1 - kColourFullness)));
}

}  // namespace

std::vector<plan::Input> colour_inputs() {
    return {part("red", 1), part("green", 0), part("blue", 0)};
}

Looker::Looker(const run::ActorContext& context, const Parts& parts, const plan::Template& of)
    : camera_(camera_of(parts, of)), eye_(colour_of(context, of)) {}

}  // namespace vagus::toolbox::carbot
