// How generated code reads: in the order of the paper's Table I (docs/plans.md, section 9).
#include <gtest/gtest.h>

#include "plan/check.hpp"
#include "plan/generate.hpp"
#include "plan/generate_classes.hpp"
#include "plan/test_files.hpp"

namespace vagus {
namespace {

using plan::Kind;
using plan::Type;

plan::Library carbot() {
    plan::Toolbox core{.name = "core"};
    plan::Toolbox toolbox{.name = "carbot", .help = "Drives."};
    toolbox.templates = {
        {.name = "Forward",
         .help = "Drives so far.",
         .inputs = {{.name = "distance", .type = Type::Float, .unit = "cm", .help = "how far"}},
         .outcomes = {{.name = "ForwardSuccessful"}}},
        {.name = "SearchWall",
         .outputs = {{.name = "angle", .type = Type::Float}, {.name = "far", .type = Type::Float}},
         .outcomes = {{.name = "WallFound"}, {.name = "NoWallFound"}}},
        {.name = "CheckTouchSensor",
         .kind = Kind::Supervisor,
         .outcomes = {{.name = "TouchSensorPressed", .help = "it was \\"}}},
        {.name = "Lamp", .kind = Kind::Supervisor}};
    plan::Library library;
    library.add(core);
    library.add(toolbox);
    return library;
}

constexpr std::string_view kWall = R"({
  "format": "vagus-plan/1",
  "name": "Wall",
  "toolboxes": ["carbot"],
  "configuration": {
    "wallangle": { "type": "float", "initial": 30 },
    "wallfar": { "type": "float", "unit": "cm" }
  },
  "start": {
    "actor": "search",
    "supervisors": { "lamp": { "template": "Lamp" } }
  },
  "actors": {
    "search": {
      "template": "Forward",
      "in": { "distance": 100000 },
      "states": { "ForwardSuccessful": "search" },
      "supervisors": {
        "touch": {
          "template": "CheckTouchSensor",
          "period_ms": 50,
          "events": { "TouchSensorPressed": "while" }
        }
      }
    },
    "while": {
      "template": "SearchWall",
      "out": { "far": "wallfar", "angle": "wallangle" },
      "states": { "NoWallFound": "@terminate", "WallFound": "search" }
    }
  }
})";

TEST(GeneratedText, ReadsInTheOrderOfTableOne) {
    const plan::Library library = carbot();
    const plan::Checked checked = plan::check("Wall.plan.json", plan::OneText(kWall), library);
    ASSERT_TRUE(checked.ok()) << plan::format_findings_json(checked.findings);
    const auto files = plan::generate(checked);
    EXPECT_EQ(files.at("Wall.cpp"), R"(// The plan Wall.
#include "Wall.hpp"

#include <vagus/templates/carbot.hpp>

vagus::embed::Plan plans::make_Wall() {
    using vagus::embed::Plan;
    using vagus::embed::Type;
    namespace carbot = vagus::templates::carbot;

    // ---- actors ----
    carbot::Forward search("search", {.distance = "100000"});
    carbot::SearchWall while_("while", {}, {.angle = "wallangle", .far = "wallfar"});
    while_.writes_in_order({"far", "angle"});

    // ---- supervisors ----
    carbot::Lamp lamp("lamp");
    carbot::CheckTouchSensor touch("touch");
    touch.period_ms(50);

    // ---- the plan ----
    Plan plan("Wall", {"carbot"});
    plan.variable("wallangle", Type::Float, {.initial = 30});
    plan.variable("wallfar", Type::Float, {.unit = "cm"});
    plan.start_with(search);
    plan.always(lamp);

    // search
    plan.after(search, carbot::Forward::ForwardSuccessful, search);
    plan.during(search, touch, carbot::CheckTouchSensor::TouchSensorPressed, while_);

    // while
    plan.after(while_, carbot::SearchWall::NoWallFound, Plan::kTerminate);
    plan.after(while_, carbot::SearchWall::WallFound, search);

    return plan;
}
)");
    EXPECT_EQ(files.size(), 4u);
    EXPECT_NE(files.at("main.cpp").find("run_main(&plans::make_Wall, argc, argv)"),
              std::string::npos);
    EXPECT_NE(files.at("CMakeLists.txt").find("Vagus::embed"), std::string::npos);
}

TEST(GeneratedText, ClassesComeFromTheDeclarations) {
    const std::string header = plan::generate_toolbox_header(carbot().toolboxes().back());
    const size_t forward = header.find("class Forward final : public embed::ActorObject {");
    ASSERT_NE(forward, std::string::npos);
    EXPECT_EQ(header.substr(forward, header.find("\n};\n", forward) + 1 - forward),
              R"(class Forward final : public embed::ActorObject {
public:
    using Place = std::source_location;
    struct In {
        // how far, in cm
        std::string distance = {};
    };
    struct Out {};
    static constexpr embed::State<Forward> ForwardSuccessful{"ForwardSuccessful"};

    explicit Forward(std::string name, Place at = Place::current())
        : Forward(std::move(name), In(), Out(), at) {}
    Forward(std::string name, const In& in, Place at = Place::current())
        : Forward(std::move(name), in, Out(), at) {}
    Forward(std::string name, [[maybe_unused]] const In& in,
        [[maybe_unused]] const Out& out, Place at = Place::current())
        : embed::ActorObject(std::move(name), "Forward", at) {
        feed("distance", in.distance);
    }
)");
    // A `\` at the end of a comment would join the next line to it.
    EXPECT_EQ(header.find("\\\n"), std::string::npos);
    EXPECT_NE(header.find("embed::Event<CheckTouchSensor> TouchSensorPressed"), std::string::npos);
}

}  // namespace
}  // namespace vagus
