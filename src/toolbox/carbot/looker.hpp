// What FindObject and FollowObject share: the object's colour among their inputs, and a camera that
// must be there.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "run/code.hpp"
#include "toolbox/carbot/object_eye.hpp"
#include "toolbox/parts.hpp"

namespace vagus::toolbox::carbot {

// The inputs `red`, `green`, `blue`: the first three of the template.
std::vector<plan::Input> colour_inputs();

// Looks through the camera for an object of the colour that these inputs say.
class Looker {
public:
    // CodeError if there is no camera, or the colour is too grey to be told from walls.
    Looker(const run::ActorContext& context, const Parts& parts, const plan::Template& of);

    std::optional<Sighting> find() { return eye_.find(camera_.take()); }
    std::optional<Sighting> follow() { return eye_.follow(camera_.take()); }

private:
    Camera& camera_;
    ObjectEye eye_;
};

}  // namespace vagus::toolbox::carbot
