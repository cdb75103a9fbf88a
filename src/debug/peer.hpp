// One node as the host sees it: its description, its program, its variables, its connection.
#pragma once

#include <memory>
#include <vector>

#include "debug/control.hpp"
#include "debug/describer.hpp"
#include "debug/fetch.hpp"

namespace vagus::debug {

class Peer {
public:
    Peer(NodeId id, uint16_t protocol, Outbox& out, const aesl::CommonDefinitions& common);
    Peer(const Peer&) = delete;  // its parts refer to each other
    Peer& operator=(const Peer&) = delete;

    // Any frame of the node but user events, NodePresent and Disconnected. False: malformed or not
    // for hosts.
    bool receive(const wire::Frame& frame);
    // Any sign of life; brings a disconnected node back.
    void seen();
    // A command of another host to this node.
    void foreign_command(const wire::Frame& frame);
    // Nothing comes from it any more: its link is gone.
    void lost();
    void leave(const std::string& why);
    void tick();
    Time next_tick() const;
    // It waited for its turn, which has come.
    void ask_description() { describer_.begin_turn(out_); }
    void share_id(const std::string& other_name) {
        view_.id_shared = true;
        if (!other_name.empty()) view_.other_name = other_name;
    }

    const NodeView& view() const { return view_; }
    Control& control() { return control_; }
    Result<RequestId> load(SharedValue<aesl::Program> program, AfterLoad then);
    size_t description_bytes() const { return describer_.bytes(); }
    // kDescriptionBytesTotalMax is passed: this description is dropped.
    void refuse_description();

    Result<RequestId> get(const VariableRange& range);
    Result<RequestId> set(const VariableRange& range, std::span<const int16_t> values);
    void write(const VariableRange& range, std::span<const int16_t> values);
    Result<RequestId> ask_program();
    Status watch(const VariableRange& range, Duration every);
    void unwatch(std::string_view name);

private:
    enum class Purpose { Get, Confirm, Watch, Condition, Program };
    struct Reading {
        Purpose purpose = Purpose::Get;
        RequestId request{};            // Get, Confirm, Program; 0: nobody asked
        VariableRange range{};          // Get, Watch
        uint32_t condition_number = 0;  // Condition
        size_t variable = 0;            // Condition: which of its variables
        Fetch fetch;
    };
    struct Watch {
        VariableRange range;
        Duration every{};
        Time next{};
        bool asked = false;
        std::vector<int16_t> told;  // empty: nothing yet
    };

    bool receive_fault(const wire::Frame& frame);
    bool receive_description(const wire::Frame& frame);
    void describe_progress();
    void described();
    void read(Reading reading);
    void receive_variables(const wire::Variables& reply);
    void arrived(const Reading& reading);
    void failed(const Reading& reading);
    void watched(const Reading& reading);
    void read_program(RequestId request);
    void program_told(const Reading& reading);
    // Whether an answer was still to come that nobody but us has asked for.
    bool forget_told_program();
    void read_condition();
    void condition_word(const Reading& reading);
    void tick_readings();
    void tick_watches();
    Result<RequestId> may_read() const;
    std::string who() const;

    NodeView view_;
    Outbox& out_;
    const aesl::CommonDefinitions& common_;
    Control control_;
    Describer describer_;
    Describer::State told_describer_ = Describer::State::Idle;
    Time last_seen_{};
    std::vector<Reading> readings_;
    std::vector<Watch> watches_;
    uint32_t condition_asked_ = 0;  // condition_number() of the readings under way
    std::vector<std::vector<int16_t>> condition_values_;
    size_t condition_missing_ = 0;
};

}  // namespace vagus::debug
