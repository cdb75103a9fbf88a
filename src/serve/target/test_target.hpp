// For tests: a robot of software nodes behind a hub, a Target that talks to it, and one page, on
// scripted time. What the robot's own loop does in a second takes no time here.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "base/test_folder.hpp"
#include "hub/hub.hpp"
#include "serve/json.hpp"
#include "serve/target/target.hpp"
#include "session/software_node.hpp"

namespace vagus::serve {

constexpr const char* kPageToken = "0123456789abcdef";

// "drive" moves, "bumper" only senses, and can tell which program it runs.
inline aesl::Target test_target(const std::string& name) {
    aesl::Target target;
    target.name = name;
    target.protocol_version = 9;
    target.bytecode_size = target.variables_size = 256;
    target.stack_size = 32;
    target.variables = {{"id", 1}, {"source", 1}, {"args", 32}};
    if (name == "drive") {
        target.variables.push_back({"wheel.target", 1});
        target.variables.push_back({"wheel.speed", 1});
    }
    if (name == "bumper") target.variables.push_back({"_program", 2});
    target.local_events = {{"tick", "each step"}};
    return target;
}

// Nodes on a hub, as a switch has them, and a link on which others may say anything.
class TestBus final : public Carrier {
public:
    TestBus() : own_(hub_.add({.name = "studio"}).value()) {
        others_ = hub_.add({.name = "others"}).value();
    }

    void add(uint16_t id, const std::string& name) {
        Place& place = places_[id];
        place.name = name;
        place.link = hub_.add({.name = name, .only_node = id}).value();
        switch_on(id);
    }
    // Memories as after power-up.
    void switch_on(uint16_t id) {
        Place& place = places_[id];
        const auto transmit = [this, &place](const wire::Frame& frame) {
            const bool variables =
                frame.type == static_cast<uint16_t>(wire::MessageType::Variables);
            if (!place.mute && !(place.tells_nothing && variables))
                said_.push_back({place.link, frame});
        };
        auto made =
            session::SoftwareNode::make(test_target(place.name), {.id = id, .transmit = transmit});
        place.node = std::move(made.value());
    }
    session::SoftwareNode& node(uint16_t id) { return *places_.at(id).node; }
    int16_t& word(uint16_t id, const std::string& name) {
        return node(id).variables()[node(id).find_variable(name)->address];
    }
    // It hears, and nobody hears it.
    void mute(uint16_t id, bool on = true) { places_.at(id).mute = on; }
    // It answers no question for its variables.
    void tells_nothing(uint16_t id, bool on = true) { places_.at(id).tells_nothing = on; }
    void others_say(const wire::Frame& frame) { hub_.receive(others_, frame); }
    // Who is on our side of a link that is held, as a plan's process is.
    void guest_says(const wire::Frame& frame) { guest_said_.push_back({frame}); }

    // Each node looks at 16 frames, as a simulated one in a millisecond, and hears its tick.
    void step() {
        if (held()) return;
        for (auto& [id, place] : places_) {
            wire::Frame frame;
            for (int i = 0; i < 16 && hub_.take(place.link, frame); ++i) {
                by_nodes.push_back({id, frame});
                place.node->receive(frame);
                place.node->run(1000);
            }
            place.node->local_event(0);
            place.node->run(1000);
        }
        for (const auto& [link, frame] : std::exchange(said_, {})) {
            ++heard_from_nodes_;
            hub_.receive(link, frame);
        }
    }

    void send(const wire::Frame& frame) override {
        sent.push_back(frame);
        if (state == Connection::Connected) hub_.receive(own_, frame);
    }
    std::vector<Carried> take() override {
        std::vector<Carried> frames = std::exchange(guest_said_, {});
        wire::Frame frame;
        while (!held() && frames.size() < kTakenAtOnce && hub_.take(own_, frame)) {
            frames.push_back({frame});
        }
        return frames;
    }
    uint64_t heard() const override { return heard_from_nodes_; }
    Connection connection() const override { return state; }
    std::string why() const override { return {}; }
    std::vector<LinkView> links() const override {
        return {{"others", hub_.nodes(others_), 0, 0, 0}};
    }

    Connection state = Connection::Connected;
    bool frozen = false;  // as a switch that is held: what is said waits
    std::vector<wire::Frame> sent;
    std::vector<std::pair<uint16_t, wire::Frame>> by_nodes;  // heard

private:
    bool held() const { return frozen || state != Connection::Connected; }
    struct Place {
        std::string name;
        hub::LinkId link;
        std::unique_ptr<session::SoftwareNode> node;
        bool mute = false;
        bool tells_nothing = false;
    };
    hub::Hub hub_;
    hub::LinkId own_, others_;
    std::map<uint16_t, Place> places_;
    std::vector<std::pair<hub::LinkId, wire::Frame>> said_;
    std::vector<Carried> guest_said_;
    uint64_t heard_from_nodes_ = 0;
};

class TargetTest : public testing::Test {
protected:
    static constexpr uint16_t kDrive = 1, kBumper = 2;

    TargetTest()
        : desk(Access(kPageToken, "fedcba9876543210"),
               {.send =
                    [this](ClientId, bool binary, std::string bytes) {
                        if (binary)
                            frames_.push_back(bytes);
                        else
                            got_.push_back(Json::parse(bytes));
                    },
                .close = [](ClientId, const std::string&) {},
                .log = [](const std::string&) {},
                .wall_ms = [] { return 1e12; }}),
          scripts(files, [](const std::string& name, uint16_t) { return test_target(name); }),
          target(desk, files, scripts, breakpoints) {
        // The script of drive drives as long as it runs.
        std::ofstream(root_ / "robot.aesl")
            << "<!DOCTYPE aesl-source>\n<network>\n<event size=\"0\" name=\"go\"/>\n"
               "<node nodeId=\"1\" name=\"drive\">onevent tick\n  wheel.target = 100\n</node>\n"
               "<node nodeId=\"2\" name=\"bumper\">var n\nonevent tick\n  n = n + 1\n</node>\n"
               "</network>\n";
        files.on_change([this](const std::string& path) { scripts.changed(path); });
        files.enter(root_);
        scripts.reread();
        target.set_safe_stop(
            {{"drive", {.set = {{"wheel.target", {0}}}, .read = {"wheel.speed"}}}});
        target.on_say(
            [this](const std::string&, const std::string& text) { said.push_back(text); });
        bus.add(kDrive, "drive");
        bus.add(kBumper, "bumper");
        open_page();
    }

    void open_page() {
        desk.hear(ClientOpened{{1}, "127.0.0.1"}, now);
        ask("hello", {{"token", kPageToken}, {"client", "test"}});
    }
    void close_page() { desk.hear(ClientClosed{{1}}, now); }
    // The message that answers it, once it has come.
    Json say(const std::string& command, const Json& in) {
        const uint64_t id = ++id_;
        got_.clear();
        const double until = static_cast<double>(now.count()) / 1000 + 3000;
        const Json message = {{"id", id}, {"do", command}, {"in", in}, {"until", until}};
        desk.hear(ClientText{{1}, message.dump()}, now);
        for (int i = 0; i < 300; ++i) {
            for (const Json& answer : got_) {
                if (answer.value("id", uint64_t{0}) == id) return answer;
            }
            pass(10ms);
        }
        ADD_FAILURE() << command << " was not answered";
        return {};
    }
    // Its answer, checked against the protocol.
    Json ask(const std::string& command, const Json& in) {
        const Json answer = say(command, in);
        EXPECT_TRUE(answer.contains("ok")) << command << answer.dump();
        if (!answer.contains("ok")) return answer;
        EXPECT_EQ(Protocol::get().fault_of_answer(command, answer["ok"]), std::nullopt);
        return answer["ok"];
    }

    void pass(Duration time) {
        for (const Time end = now + time; now < end;) {
            now += 10ms;
            target.tick(now);
            bus.step();
        }
    }
    void connect(const char* kind = "bus") {
        target.connect(bus, "tcp:x", "x", kind, now);
        pass(500ms);
        ASSERT_TRUE(target.all_described(2));
    }
    // Both have their scripts, which run.
    void run(const char* kind = "bus") {
        connect(kind);
        target.load_changed(true, [](auto failed) { EXPECT_TRUE(failed.empty()); });
        pass(500ms);
        ASSERT_EQ(bus.word(kDrive, "wheel.target"), 100);
        bus.sent.clear();
        bus.by_nodes.clear();
    }
    // What comes of Stop, once it is answered.
    void stop() {
        report.reset();
        target.stop_all([this](const StopReport& it) {
            EXPECT_FALSE(report.has_value()) << "answered twice";
            report = it;
        });
    }
    StopNode::State state_of(uint16_t node) const {
        for (const StopNode& one : report.value_or(StopReport{}).nodes) {
            if (one.node == node) return one.state;
        }
        ADD_FAILURE() << "node " << node << " is not in the report";
        return StopNode::State::Gone;
    }
    // Types of the frames that were sent to a node, in their order.
    std::vector<wire::MessageType> sent_to(uint16_t node) const {
        std::vector<wire::MessageType> types;
        for (const wire::Frame& frame : bus.sent) {
            if (wire::is_command(frame.type) && frame.first_word() == node)
                types.push_back(static_cast<wire::MessageType>(frame.type));
        }
        return types;
    }
    size_t count_sent(uint16_t node, wire::MessageType type) const {
        const auto types = sent_to(node);
        return static_cast<size_t>(std::count(types.begin(), types.end(), type));
    }
    Json node_document(uint16_t id) {
        Json whole;
        const uint32_t number = ++watches_;
        ask("watch", {{"watch", number}, {"topic", "robot"}});
        got_.clear();
        desk.tick(now);
        for (const Json& message : got_) {
            if (message.value("watch", 0u) == number) whole = message["whole"];
        }
        ask("unwatch", {{"watch", number}});
        EXPECT_EQ(Protocol::get().fault_of_document("robot", whole), std::nullopt) << whole.dump();
        for (const Json& one : whole["nodes"]) {
            if (one["id"] == id) return one;
        }
        return {};
    }
    bool runs(uint16_t node) { return node_document(node)["state"] == "running"; }

    test::Folder root_;
    Time now = 10s;
    std::vector<Json> got_;
    std::vector<std::string> frames_;  // of binary topics
    uint64_t id_ = 0;
    uint32_t watches_ = 0;
    Desk desk;
    Files files;
    Scripts scripts;
    ScriptBreakpoints breakpoints;
    TestBus bus;
    Target target;
    std::vector<std::string> said;
    std::optional<StopReport> report;
};

}  // namespace vagus::serve
