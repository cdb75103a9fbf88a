// Programs made up from a seed: see generate.hpp.
#include "reference/generate.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "reference/generate_expression.hpp"

namespace vagus::aesl {
namespace {

constexpr uint16_t kRoomyBytecode = 4000;  // subs lie below 4096
constexpr uint16_t kRoomyVariables = 4000;
constexpr uint16_t kRoomyStack = 300;
constexpr int kBlockDepthMax = 3;
constexpr int kLoopDepthMax = 2;  // loops in each other: the rounds multiply
constexpr int kRoundsMax = 5;
constexpr int kDequeSize = 7;
constexpr std::string_view kDeque = "ring";

class ProgramGenerator {
public:
    ProgramGenerator(uint64_t seed, const NodeFile& node, Avoid avoid)
        : dice_(seed), node_(node), avoid_(avoid), expressions_(dice_, variables_, constants_) {}

    Case make() {
        Case made;
        made.source = declarations();
        made.source += block(0, dice_.from_to(2, 8));
        made.source += sections();
        const int stimuli = dice_.from_to(1, 6);
        for (int i = 0; i < stimuli; ++i) made.stimuli.push_back(stimulus());
        return made;
    }

private:
    // ---- declarations ----

    std::string declarations() {
        constants_ = {"LIMIT", "NEG", "ZERO"};
        std::string text;
        for (int i = dice_.below(4); i > 0; --i) {
            const std::string name = fmt::format("C{}", constants_.size());
            text += fmt::format("const {} = {} {} {}\n", name, dice_.pick(constants_),
                                dice_.chance(50) ? "+" : "-", dice_.below(100));
            constants_.push_back(name);
        }
        variables_ = {{"id", 1, false},          {"event.source", 1, false},
                      {"event.args", 32, false}, {"sensor.prox", 4, false},
                      {"motor.left", 1, true},   {"motor.right", 1, true}};
        text += fmt::format("var {}[{}]\n", kDeque, kDequeSize);
        for (int i = 0; i < kLoopDepthMax; ++i) {
            text += fmt::format("var round{}\nvar index{}\n", i, i);
            variables_.push_back({fmt::format("round{}", i), 1, false});
            variables_.push_back({fmt::format("index{}", i), 1, false});
        }
        for (int i = dice_.from_to(4, 9); i > 0; --i) text += variable();
        return text;
    }

    std::string variable() {
        constexpr int kSizes[] = {1, 1, 1, 2, 2, 3, 4, 5, 6};
        const int size = dice_.pick(kSizes);
        const std::string name = fmt::format("v{}", variables_.size());
        std::string text = "var " + name;
        const bool has_initial = dice_.chance(50);
        if (size > 1 && has_initial && dice_.chance(30)) {
            text += "[]";
        } else if (size > 1 || dice_.chance(20)) {
            text += fmt::format("[{}]", size);
        } else {
            // A scalar without brackets.
        }
        if (has_initial) text += " = " + initial(size);
        variables_.push_back({name, size, true});
        return text + "\n";
    }

    std::string initial(int size) {
        if (size == 1 || dice_.chance(60)) return expressions_.integer(size, 2);
        std::string list = expressions_.number();  // a bare list begins with a single number
        for (int i = 1; i < size; ++i) {
            const std::string element = expressions_.integer(1, 1);
            list += element[0] == '[' ? ", (" + element + ")" : ", " + element;
        }
        return list;
    }

    // ---- sections ----

    std::string sections() {
        std::vector<std::string> headers;
        for (const LocalEvent& event : node_.target.local_events)
            if (dice_.chance(70)) headers.push_back("onevent " + event.name);
        for (const GlobalEvent& event : node_.common.events)
            if (dice_.chance(30)) headers.push_back("onevent " + event.name);
        subs_ = dice_.below(4);
        for (int i = 0; i < subs_; ++i) headers.push_back(fmt::format("sub s{}", i));
        for (size_t i = headers.size(); i > 1; --i)
            std::swap(headers[i - 1],
                      headers[static_cast<size_t>(dice_.below(static_cast<int>(i)))]);
        std::string text;
        for (const std::string& header : headers) text += header + "\n" + section(header);
        return text;
    }

    std::string section(const std::string& header) {
        const bool is_sub = header.starts_with("sub ");
        // A sub calls later ones only, so that nothing is recursive.
        first_callable_ = is_sub ? header.back() - '0' + 1 : 0;
        std::string text = block(0, dice_.from_to(0, 5));
        first_callable_ = 0;
        if (is_sub && avoid_ == Avoid::DefectsOfTheReference) text += "call sys.nop()\n";
        return text;
    }

    // ---- statements ----

    std::string block(int depth, int statements) {
        std::string text;
        for (int i = 0; i < statements; ++i) text += statement(depth) + "\n";
        return text;
    }

    std::string inner(int depth) { return block(depth + 1, dice_.below(4)); }

    std::string statement(int depth) {
        const int kind = dice_.below(100);
        if (kind < 40) return assignment();
        if (kind < 50) return emit();
        if (kind < 65) return call();
        if (kind < 69) return call_sub();
        if (kind < 71 && depth > 0) return "return";
        if (depth >= kBlockDepthMax) return assignment();
        if (kind < 80) return if_statement(depth);
        if (kind < 87) return when_statement(depth);
        return loop(depth);
    }

    std::string assignment() {
        constexpr int kSizes[] = {1, 1, 1, 1, 2, 2, 3, 4, 5};
        const int size = dice_.pick(kSizes);
        const std::string left = expressions_.target(size);
        if (left.empty()) return "motor.left = 1";
        if (dice_.chance(10)) return left + (dice_.chance(50) ? "++" : "--");
        if (dice_.chance(65))
            return left + expressions_.gap() + "=" + expressions_.gap() +
                   expressions_.integer(size, 3);
        constexpr std::string_view kCompound[] = {"+=", "-=", "*=", "<<=", ">>=", "|=", "^=", "&="};
        if (dice_.chance(80))
            return left + " " + std::string(dice_.pick(kCompound)) + " " +
                   expressions_.integer(size, 2);
        return left + (dice_.chance(50) ? " /= " : " %= ") + expressions_.divisor(size);
    }

    std::string emit() {
        const GlobalEvent& event = dice_.pick(node_.common.events);
        const int size = event.size.value_or(0);
        if (size == 0) return "emit " + event.name;
        const bool is_short = dice_.chance(25);
        const int sent = is_short ? dice_.from_to(1, size) : size;
        const std::string whole = dice_.chance(40) ? expressions_.reference(sent) : "";
        return (is_short ? "_emit " : "emit ") + event.name + expressions_.gap() +
               (whole.empty() ? expressions_.integer(sent, 2) : whole);
    }

    std::string call_sub() {
        if (first_callable_ >= subs_) return assignment();
        return fmt::format("callsub s{}", dice_.from_to(first_callable_, subs_ - 1));
    }

    std::string if_statement(int depth) {
        std::string text = "if " + expressions_.condition(2) + " then\n" + inner(depth);
        while (dice_.chance(30))
            text += "elseif " + expressions_.condition(1) + " then\n" + inner(depth);
        if (dice_.chance(40)) text += "else\n" + inner(depth);
        return text + "end";
    }

    std::string when_statement(int depth) {
        return "when " + expressions_.condition(2) + " do\n" + inner(depth) + "end";
    }

    std::string loop(int depth) {
        if (loops_ >= kLoopDepthMax) return assignment();
        const int number = loops_++;
        const std::string text =
            dice_.chance(40) ? while_loop(depth, number) : for_loop(depth, number);
        --loops_;
        return text;
    }

    std::string while_loop(int depth, int number) {
        const std::string more = dice_.chance(30) ? " and (" + expressions_.condition(1) + ")" : "";
        return fmt::format("round{0} = 0\nwhile round{0} < {1}{2} do\n{3}round{0} += 1\nend",
                           number, dice_.from_to(1, kRoundsMax), more, inner(depth));
    }

    std::string for_loop(int depth, int number) {
        const int first = dice_.from_to(-10, 10);
        const int step = dice_.from_to(1, 4) * (dice_.chance(50) ? 1 : -1);
        const int last = first + step * dice_.below(kRoundsMax);
        std::string range = fmt::format("{}:{} step {}", first, last, step);
        if (step == 1 && dice_.chance(50)) range = fmt::format("{}:{}", first, last);
        if (dice_.chance(15)) range = "NEG:LIMIT step 5";
        const std::string variable =
            dice_.chance(90) ? fmt::format("index{}", number) : fmt::format("index{}[0]", number);
        return fmt::format("for {} in {} do\n{}end", variable, range, inner(depth));
    }

    // ---- natives ----

    // Functions that end most runs early: they divide, take roots, or need a filled deque.
    static bool fails_often(std::string_view name) {
        constexpr std::string_view kFailing[] = {
            "math.div",    "math.muldiv",  "math.sqrt",       "deque.get",     "deque.set",
            "deque.erase", "deque.insert", "deque.pop_front", "deque.pop_back"};
        return std::find(std::begin(kFailing), std::end(kFailing), name) != std::end(kFailing);
    }

    std::string call() {
        const NativeFunction& native = dice_.pick(node_.target.natives);
        const bool is_defect =
            avoid_ == Avoid::DefectsOfTheReference && native.name == "deque.insert";
        if (is_defect || (fails_often(native.name) && dice_.chance(80))) return assignment();
        const bool is_deque = native.name.starts_with("deque.");
        const int first_template = is_deque ? 0 : dice_.from_to(1, 5);
        const int second_template = dice_.from_to(1, 2);
        std::string arguments;
        for (const NativeParameter& parameter : native.parameters) {
            if (!arguments.empty()) arguments += "," + expressions_.gap();
            if (parameter.size == -1) {
                arguments += is_deque ? std::string(kDeque) : argument(first_template);
            } else if (parameter.size == -2) {
                arguments += argument(second_template);
            } else if (is_deque && parameter.name != "size") {
                arguments += small_index();
            } else {
                arguments += argument(parameter.size == 0 ? dice_.from_to(1, 6) : parameter.size);
            }
        }
        return fmt::format("call {}({})", native.name, arguments);
    }

    // Of a deque: usually inside.
    std::string small_index() {
        if (dice_.chance(70)) return fmt::format("{}", dice_.below(4));
        return fmt::format("{} & 3", expressions_.reference(1));
    }

    std::string argument(int size) {
        if (dice_.chance(25)) return expressions_.integer(size, 1);
        const std::string target = expressions_.target(size);
        return target.empty() ? expressions_.integer(size, 1) : target;
    }

    // ---- stimuli ----

    int16_t word() {
        constexpr int kEdges[] = {0, 1, -1, 2, 3, INT16_MAX, INT16_MIN, 100};
        return static_cast<int16_t>(dice_.chance(70) ? dice_.pick(kEdges)
                                                     : dice_.from_to(INT16_MIN, INT16_MAX));
    }

    Words words(int count) {
        Words list;
        for (int i = 0; i < count; ++i) list.push_back(word());
        return list;
    }

    Stimulus stimulus() {
        Stimulus made;
        if (dice_.chance(30)) made.set.push_back({"sensor.prox", words(4)});
        if (dice_.chance(70)) {
            made.event = dice_.pick(node_.target.local_events).name;
            return made;
        }
        const GlobalEvent& event = dice_.pick(node_.common.events);
        made.event = event.name;
        made.source = static_cast<int16_t>(dice_.below(10));
        made.arguments = words(event.size.value_or(0));
        return made;
    }

    Dice dice_;
    const NodeFile& node_;
    Avoid avoid_;
    std::vector<GeneratedVariable> variables_;
    std::vector<std::string> constants_;
    ExpressionGenerator expressions_;
    int subs_ = 0;
    int first_callable_ = 0;
    int loops_ = 0;
};

}  // namespace

NodeFile roomy(NodeFile golden_node) {
    golden_node.target.bytecode_size = kRoomyBytecode;
    golden_node.target.variables_size = kRoomyVariables;
    golden_node.target.stack_size = kRoomyStack;
    return golden_node;
}

Case generate(uint64_t seed, const NodeFile& node, Avoid avoid) {
    return ProgramGenerator(seed, node, avoid).make();
}

}  // namespace vagus::aesl
