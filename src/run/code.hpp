// What the author of a template writes: the code of an actor, plain and blocking; the check of a
// supervisor (docs/plans.md, sections 1 and 8).
//
//     class Blink : public Actor {
//         void run(ActorContext& context) override {
//             for (int i = 0; i < context.in(0).integer(); ++i) {
//                 lamp_.toggle();
//                 context.sleep(500ms);        // may throw Stop: the plan has been interrupted
//             }
//             context.end(0);                  // the first of the template's states
//         }
//     };
//
// Code waits only through its context. When the plan takes another way, the wait throws Stop; code
// that must put something in order first catches it, does so (waiting with stop_time() to come,
// if need be), and throws on. It then has the template's grace time (P27).
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/rng.hpp"
#include "base/time.hpp"
#include "plan/graph.hpp"
#include "plan/machine.hpp"

namespace vagus::run {

constexpr size_t kEventArgumentsMax = 8;      // of an event that a plan sends or hears
constexpr size_t kKeptEventsMax = 256;        // that code has asked for and not yet taken
constexpr Duration kNever = Duration::max();  // a wait that only an event or Stop ends

// An event of the bus, as plans see it: by name.
struct BusEvent {
    std::string name;
    std::vector<int16_t> arguments;
    uint16_t from = 0;   // the node that emitted it; 0: a host, or the plan itself
    uint32_t frame = 0;  // number of the frame that brought it, where frames have one
    // Of what the plan emits: the element whose code it was, and the number of the frame that this
    // code heard last; of a supervisor in real time no number. The name is the Graph's.
    std::string_view by = {};
    uint32_t cause = 0;
};

// Thrown by waits when the code is told to stop. No error; catch it only to put things in order.
struct Stop {};

// Any other exception of a template's code ends the plan with an internal error (P27).
class CodeError : public std::exception {
public:
    explicit CodeError(std::string what) : what_(std::move(what)) {}
    const char* what() const noexcept override { return what_.c_str(); }

private:
    std::string what_;
};

// The running numbers of a run, one for each running of code and each watching of a supervisor.
// Their low 15 bits are the tokens by which the scripts of nodes know an activation. Those with
// token 0 are left out, for 0 is nobody's.
constexpr uint16_t kTokenMax = 0x7fff;

class Numbers {
public:
    // The token of the first one, 1 to kTokenMax.
    explicit Numbers(uint16_t first_token = 1) : last_(first_token - 1u) {}

    uint64_t next() {
        if ((++last_ & kTokenMax) == 0) ++last_;
        return last_;
    }
    // The next one has this token, 1 to kTokenMax; no number comes twice.
    void move_to(uint16_t token) { last_ = (((last_ >> 15) + 1) << 15) + token - 1u; }

private:
    uint64_t last_;
};

// What one running of an actor's code can do. Used by that code only, from where it runs.
class ActorContext {
public:
    virtual ~ActorContext() = default;

    // Inputs in the order of the template's declaration, converted to their types.
    const plan::Value& in(size_t index) const { return in_[index]; }
    // Outputs are kept until the actor ends (P17); the last value counts.
    void out(size_t index, plan::Value value);
    // Ends in this state (by its number) when run() returns.
    void end(int state) { given_.outcome = state; }

    // Since the start of the run.
    virtual Time now() const = 0;
    // These throw Stop when the actor is interrupted, also when it was before the call. Events of
    // others that came since the last wait returned are looked at first, in their order; those that
    // a wait does not wait for are over with it, so a sleep hears nothing.
    void sleep(Duration time);
    BusEvent wait_event(std::string_view name);
    // Gives nothing when the time is over first.
    std::optional<BusEvent> wait_event(std::string_view name, Duration at_most);
    // Waits until `holds` does, looking every `every`.
    void wait_until(const std::function<bool()>& holds, Duration every);

    // From here on events of these names are kept, in their order, until next_event() takes them:
    // for code that talks with a node, and must miss nothing between one wait and the next.
    virtual void listen(std::vector<std::string> names) = 0;
    // Gives nothing when the time is over first. Throws Stop as the waits above, and CodeError when
    // more than kKeptEventsMax came untaken.
    std::optional<BusEvent> next_event(Duration at_most);

    // After Stop has been thrown: time to put things in order. These do not throw it again. Nothing
    // also when the run cannot wait any longer: then return.
    virtual void linger(Duration time) = 0;
    std::optional<BusEvent> linger_event(Duration at_most);
    bool told_to_stop() const { return told_; }

    virtual void log(std::string text) = 0;
    // Emits on the bus; it is heard in its own run too.
    virtual void emit(BusEvent event) = 0;
    // The one generator of the run (`Random` draws from it).
    virtual SplitMix64& random() = 0;
    // Of this running of the code: see Numbers.
    uint64_t number() const { return number_; }

    const plan::Given& given() const { return given_; }

protected:
    ActorContext(std::vector<plan::Value> in, size_t outputs, uint64_t number);
    // Until the time, an event of that name (empty: any), or Stop, whichever comes first.
    struct Woken {
        bool stop = false;
        std::optional<BusEvent> event = {};
    };
    virtual Woken wait(Duration at_most, std::string_view event) = 0;
    // Until the time, a kept event, or Stop; when told already, until one of the first two.
    virtual Woken wait_kept(Duration at_most) = 0;

    bool told_ = false;

private:
    Woken wait_or_stop(Duration at_most, std::string_view event);
    Woken unless_stopped(Woken woken);

    std::vector<plan::Value> in_;
    uint64_t number_;
    plan::Given given_;
};

class Actor {
public:
    virtual ~Actor() = default;
    virtual void run(ActorContext& context) = 0;
    // In real time, around each pause of the run by a debugger while the code is at a wait; called
    // there, on the code's thread. Code that drives and is not stopped by its own silence brings
    // the robot to rest in held(), and takes up again in released() (decision 0090). No waiting
    // here.
    virtual void held() {}
    virtual void released() {}
};

// One check of a supervisor.
struct Check {
    std::vector<plan::Value> in;
    Duration since_start{};           // of the watching
    const BusEvent* event = nullptr;  // with period 0: what has come
};

// What a supervisor can do besides raising, where its watching begins and ends.
class SupervisorContext {
public:
    virtual ~SupervisorContext() = default;
    // As an actor's.
    virtual void emit(BusEvent event) = 0;
    // Of this watching: see Numbers.
    virtual uint64_t number() const = 0;
};

// None of these may wait.
class Supervisor {
public:
    virtual ~Supervisor() = default;
    // The watching begins: with the inputs of its first check, which follows; with period 0, with
    // those that are read in the place of one (P22b). What it throws is an internal error (P27).
    virtual void started(const std::vector<plan::Value>& in, SupervisorContext& context);
    // The event to raise, or nothing.
    virtual std::optional<plan::Given> check(const Check& check) = 0;
    // The watching is over, for whatever reason. Follows each started(), also one that threw, but
    // not one whose check has not returned when the run is over (P18b).
    virtual void stopped(SupervisorContext& context) noexcept;
};

using MakeActor = std::function<std::unique_ptr<Actor>()>;
using MakeSupervisor = std::function<std::unique_ptr<Supervisor>()>;

// One template with its code: exactly one of the two makers is set, by the template's kind.
struct Coded {
    plan::Template declared;
    MakeActor actor = {};
    MakeSupervisor supervisor = {};
};

// A toolbox as a program has it: what is declared, and the code behind it.
class CodeLibrary {
public:
    CodeLibrary() = default;
    CodeLibrary(const CodeLibrary&) = delete;
    CodeLibrary& operator=(const CodeLibrary&) = delete;

    // `file` is what it was read from, if it was.
    void add(std::string toolbox, std::string help, std::vector<Coded> templates,
             std::string file = {});
    // What checks and graphs need.
    const plan::Library& templates() const { return library_; }
    // Fresh code for one activation, one watching.
    std::unique_ptr<Actor> make_actor(const plan::Template& of) const;
    std::unique_ptr<Supervisor> make_supervisor(const plan::Template& of) const;

private:
    struct Makers {
        MakeActor actor;
        MakeSupervisor supervisor;
    };
    plan::Library library_;
    std::map<const plan::Template*, Makers> makers_;
};

}  // namespace vagus::run
