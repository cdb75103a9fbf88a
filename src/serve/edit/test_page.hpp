// A desk with one page that drives, a folder of its own, and everything that edits: for tests. Each
// answer and document is checked against the protocol.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <semaphore>
#include <string>
#include <vector>

#include "base/file.hpp"
#include "base/test_folder.hpp"
#include "serve/edit/editing.hpp"
#include "serve/json.hpp"
#include "session/known_nodes.hpp"

namespace vagus::serve {

// A script of two nodes that send each other an event.
constexpr std::string_view kTwoNodes =
    "<!DOCTYPE aesl-source>\n<network>\n<event size=\"1\" name=\"ping\"/>\n"
    "<constant value=\"5\" name=\"LIMIT\"/>\n"
    "<node nodeId=\"1\" name=\"left\">var x = LIMIT\nonevent ping\n  x = x + 1\n  emit ping x\n"
    "</node>\n<node nodeId=\"2\" name=\"right\">var y\nonevent ping\n  y = LIMIT\n</node>\n"
    "</network>\n";

class EditTest : public testing::Test {
protected:
    static constexpr const char* kToken = "0123456789abcdef";
    static constexpr const char* kEpoch = "e1";

    EditTest()
        : desk(Access(kToken, "fedcba9876543210"), {.send =
                                                        [this](ClientId, bool, std::string bytes) {
                                                            got.push_back(Json::parse(bytes));
                                                            unread += bytes.size();
                                                        },
                                                    .close = [](ClientId, const std::string&) {},
                                                    .log = [](const std::string&) {},
                                                    .wall_ms = [] { return 1e12; },
                                                    .random = [] { return std::string(kEpoch); }}),
          scripts(files, [this](const std::string& name, uint16_t) { return target(name); }),
          editing(desk, files, scripts, desk.epoch()) {
        files.on_wake([this] { disk_news.release(); });
        editing.on_text_changed([this](const std::string& path) { changed.push_back(path); });
        editing.on_saved([this](const std::string& path) { saved.push_back(path); });
        editing.on_renamed([this](const std::string& from, const std::string& to) {
            renamed.push_back(from + " -> " + to);
        });
        editing.on_say([this](const std::string& kind, const std::string& text) {
            said.push_back(kind + ": " + text);
        });
        desk.hear(ClientOpened{{1}, "127.0.0.1"}, now);
        ask("hello", {{"token", kToken}, {"client", "test"}});
    }

    void write(const std::string& path, std::string_view text) {
        std::filesystem::create_directories((root / path).parent_path());
        std::ofstream(root / path, std::ios::binary) << text;
    }
    std::string on_disk(const std::string& path) {
        const auto text = read_file((root / path).string());
        return text.ok() ? text.value() : "there is no " + path;
    }
    void enter(EditedProject project = {}, std::vector<std::string> only = {}) {
        files.enter(root, std::move(only));
        editing.set_project(std::move(project));
    }

    Json say(const std::string& command, const Json& in) {
        now += std::chrono::milliseconds(10);
        got.clear();
        const double until = static_cast<double>(now.count()) / 1000 + 3000;
        const Json message = {{"id", ++id}, {"do", command}, {"in", in}, {"until", until}};
        desk.hear(ClientText{{1}, message.dump()}, now);
        desk.hear(ClientTook{{1}, std::exchange(unread, 0)}, now);
        for (const Json* answer = answered(); true; answer = answered()) {
            if (answer) return *answer;
            // What is saved is answered when it is on the disk.
            if (!disk_news.try_acquire_for(std::chrono::seconds(20))) break;
            files.tick(now);
        }
        ADD_FAILURE() << command << " was not answered";
        return Json::object();
    }
    const Json* answered() const {
        for (const Json& answer : got) {
            if (answer.value("id", uint64_t{0}) == id) return &answer;
        }
        return nullptr;
    }
    // The answer of a command that is done.
    Json ask(const std::string& command, const Json& in) {
        const Json answer = say(command, in);
        EXPECT_TRUE(answer.contains("ok")) << command << " " << answer.dump();
        if (!answer.contains("ok")) return Json::object();
        EXPECT_EQ(Protocol::get().fault_of_answer(command, answer["ok"]), std::nullopt);
        return answer["ok"];
    }
    // "code: what" of one that is not.
    std::string refusal(const std::string& command, const Json& in) {
        const Json answer = say(command, in);
        EXPECT_TRUE(answer.contains("error")) << command << " " << answer.dump();
        if (!answer.contains("error")) return "";
        return answer["error"]["code"].get<std::string>() + ": " +
               answer["error"]["what"].get<std::string>();
    }
    Json document(const std::string& topic, const Json& of = nullptr) {
        const uint32_t number = ++watch;
        Json in = {{"watch", number}, {"topic", topic}};
        if (!of.is_null()) in["of"] = of;
        ask("watch", in);
        now += std::chrono::seconds(1);
        got.clear();
        desk.tick(now);
        Json whole;
        for (const Json& message : got) {
            if (message.value("watch", 0u) == number && message.contains("whole")) {
                whole = message["whole"];
            }
        }
        ask("unwatch", {{"watch", number}});
        EXPECT_EQ(Protocol::get().fault_of_document(topic, whole), std::nullopt) << whole.dump();
        return whole;
    }

    std::string text(const std::string& doc) { return ask("doc.open", {{"doc", doc}})["text"]; }
    uint32_t version(const std::string& doc) { return ask("doc.open", {{"doc", doc}})["version"]; }
    void edit(const std::string& doc, size_t from, size_t to, const std::string& with) {
        const Json change = {{"from", from}, {"to", to}, {"text", with}};
        const Json done = ask("doc.edit", edit_of(doc, version(doc), {change}));
        EXPECT_EQ(done.size(), 1u) << done.dump();  // neither behind nor another text
    }
    // What doc.edit takes from this page.
    static Json edit_of(const std::string& doc, uint32_t version,
                        const std::vector<Json>& changes) {
        return {{"doc", doc},
                {"epoch", kEpoch},
                {"version", version},
                {"by", "page"},
                {"changes", changes}};
    }
    // Replaces the one place that has a text, which is plain ASCII before it.
    void put(const std::string& doc, const std::string& what, const std::string& with) {
        const std::string before = text(doc);
        const size_t at = before.find(what);
        ASSERT_NE(at, std::string::npos) << what << " in " << before;
        edit(doc, at, at + what.size(), with);
    }
    static Json at(int line, int column) { return {{"line", line}, {"column", column}}; }

    // "error CODE DOC:LINE:COLUMN" of each finding.
    std::vector<std::string> findings() {
        std::vector<std::string> lines;
        for (const DocFinding& one : editing.findings()) {
            EXPECT_EQ(one.what.empty(), false);
            lines.push_back(std::string(name_of(one.severity)) + " " + one.code + " " + one.doc +
                            ":" + std::to_string(one.at.line) + ":" +
                            std::to_string(one.at.column));
        }
        return lines;
    }
    DocFinding finding(const std::string& code) {
        for (DocFinding& one : last_findings = editing.findings()) {
            if (one.code == code) return one;
        }
        ADD_FAILURE() << "no finding " << code;
        return {};
    }
    // As a click on a fix does it, through the protocol.
    void apply(const FindingFix& fix) {
        std::map<std::string, Json> changes;
        for (const TextEdit& one : fix.edits) {
            changes[one.doc].push_back({{"from", one.from}, {"to", one.to}, {"text", one.text}});
        }
        for (const auto& [doc, list] : changes) {
            ask("doc.edit", edit_of(doc, version(doc), list));
        }
    }

    test::Folder root;
    Time now = std::chrono::seconds(10);
    uint64_t id = 0;    // of the last command
    size_t unread = 0;  // bytes that the page has not taken
    std::vector<Json> got;
    std::vector<std::string> changed, saved, renamed, said;
    Desk desk;
    std::counting_semaphore<> disk_news{0};  // the files have something to hear
    Files files;
    Scripts scripts;
    Editing editing;

private:
    const aesl::Target& target(const std::string& name) {
        const auto known = targets.find(name);
        if (known != targets.end()) return known->second;
        return targets.emplace(name, session::known_node(name)).first->second;
    }

    std::map<std::string, aesl::Target> targets;
    std::vector<DocFinding> last_findings;
    uint32_t watch = 0;
};

}  // namespace vagus::serve
