// What the templates of robots reach the robot through, besides events. The maker of the library
// fills it in, at the latest before a run starts; what is missing stays null.
#pragma once

namespace vagus::toolbox {

class BusNodes;
class Camera;
class Fleet;

struct Parts {
    const BusNodes* bus = nullptr;  // null: nobody knows which nodes there are, none is looked for
    Camera* camera = nullptr;       // null: templates that need it say so when they start
    Fleet* fleet = nullptr;         // the same
};

}  // namespace vagus::toolbox
