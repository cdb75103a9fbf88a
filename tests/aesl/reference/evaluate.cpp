// The evaluator: see evaluate.hpp. Statement by statement, element by element.
#include "reference/evaluate.hpp"

#include <bit>
#include <cassert>

#include "aesl/parse.hpp"
#include "reference/evaluate_fold.hpp"
#include "reference/evaluate_natives.hpp"

namespace vagus::aesl {
namespace {

using isa::BinaryOperator;
using isa::UnaryOperator;

// Where a statement leads: to the next one, out of the sub or handler, or nowhere after a fault.
enum class Flow { Next, Return, Stop };

// One value; nothing after a fault.
using Value = std::optional<int16_t>;

class Machine {
public:
    Machine(const Tree& tree, const NodeFile& node, Outcome& outcome)
        : tree_(tree),
          node_(node),
          outcome_(outcome),
          memory_(node.target.variables_size),
          when_(tree.nodes.size(), false) {}

    // Runs the section that starts with that event's number, if there is one.
    void start(size_t during, SectionKind kind, int32_t number) {
        during_ = during;
        for (const Section& section : tree_.sections) {
            if (section.kind != kind || section.is_ignored) continue;
            if (kind == SectionKind::Event && section.number != number) continue;
            block(section.block);
        }
    }

    void set(size_t address, const Words& words) {
        for (size_t i = 0; i < words.size(); ++i) memory_[address + i] = words[i];
    }

    bool has_stopped() const { return outcome_.fault || outcome_.out_of_steps; }

    void store_memory() {
        for (const TreeVariable& variable : tree_.variables) {
            const auto begin = memory_.begin() + variable.address;
            outcome_.memory[std::string(variable.name)] = Words(begin, begin + variable.size);
        }
    }

private:
    NodeId child(NodeId id, int position) const { return tree_.child(id, position); }

    void fault(NodeId id, FaultCause kind) {
        if (!outcome_.fault) outcome_.fault = Fault{kind, during_, tree_.line_of(id)};
    }

    bool has_step_left() {
        if (++steps_ > kEvaluateStepsMax) outcome_.out_of_steps = true;
        return !outcome_.out_of_steps;
    }

    // ---- expressions ----

    Value value(NodeId id, int k) {
        if (const auto number = constant(tree_, id, k)) return static_cast<int16_t>(*number);
        const Node& node = tree_[id];
        switch (node.kind) {
            case NodeKind::Variable:
            case NodeKind::Slice:
                return memory_[address(id) + static_cast<size_t>(k)];
            case NodeKind::Element: {
                const auto at = element_address(id);
                if (!at) return std::nullopt;
                return memory_[*at];
            }
            case NodeKind::Tuple: {
                const TupleElement element = tuple_element(tree_, id, k);
                return value(element.child, element.k);
            }
            case NodeKind::Unary:
                return unary(id, k);
            case NodeKind::Binary:
                return binary(id, child(id, 0), child(id, 1), k);
            case NodeKind::Not: {
                const Value operand = value(node.first, k);
                if (!operand) return std::nullopt;
                return *operand == 0 ? int16_t{1} : int16_t{0};
            }
            default:
                break;
        }
        assert(false);
        return std::nullopt;
    }

    // Of the first word of a variable or slice.
    size_t address(NodeId id) const {
        const TreeVariable& variable = tree_.variables[static_cast<size_t>(tree_[id].value)];
        const bool is_slice = tree_[id].kind == NodeKind::Slice;
        return static_cast<size_t>(variable.address + (is_slice ? tree_[child(id, 0)].value : 0));
    }

    // Of `v[e]`; nothing, and a fault in the line of its name, if e is outside.
    std::optional<size_t> element_address(NodeId id) {
        const Value index = value(tree_[id].first, 0);
        if (!index) return std::nullopt;
        const TreeVariable& variable = tree_.variables[static_cast<size_t>(tree_[id].value)];
        if (*index >= 0 && *index < variable.size)
            return static_cast<size_t>(variable.address + *index);
        fault(id, FaultCause::ArrayOutOfBounds);
        return std::nullopt;
    }

    Value unary(NodeId id, int k) {
        const Value operand = value(tree_[id].first, k);
        if (!operand) return std::nullopt;
        return static_cast<int16_t>(fold_unary(static_cast<UnaryOperator>(tree_[id].op), *operand));
    }

    // `left op right`; not constant as a whole. `id` has the operator: also a compound assignment.
    Value binary(NodeId id, NodeId left, NodeId right, int k) {
        const auto op = static_cast<BinaryOperator>(tree_[id].op);
        const auto right_number = constant(tree_, right, k);
        if (is_neutral_right(op, right_number)) return value(left, k);
        if (is_neutral_left(op, constant(tree_, left, k))) return value(right, k);
        const Value a = value(left, k);
        if (!a) return std::nullopt;
        if (const auto shift = quirk_shift(op, right_number))
            return static_cast<int16_t>(*fold_binary(BinaryOperator::ShiftRight, *a, *shift));
        const Value b = value(right, k);
        if (!b) return std::nullopt;
        const Value result = run_binary(op, *a, *b);
        if (!result) fault(id, FaultCause::DivisionByZero);
        return result;
    }

    // Rule 5.
    static bool is_neutral_right(BinaryOperator op, std::optional<int32_t> number) {
        if (!number) return false;
        switch (op) {
            case BinaryOperator::Multiply:
            case BinaryOperator::Divide:
                return *number == 1;
            case BinaryOperator::Add:
            case BinaryOperator::Subtract:
            case BinaryOperator::BitOr:
            case BinaryOperator::Or:
                return *number == 0;
            case BinaryOperator::BitAnd:
                return *number == -1;
            case BinaryOperator::And:
                return *number != 0;
            default:
                return false;
        }
    }

    static bool is_neutral_left(BinaryOperator op, std::optional<int32_t> number) {
        const bool is_one_sided = op == BinaryOperator::Divide || op == BinaryOperator::Subtract;
        return !is_one_sided && is_neutral_right(op, number);
    }

    // Rule 7: a division by a power of two above 1 is a shift.
    static std::optional<int32_t> quirk_shift(BinaryOperator op, std::optional<int32_t> number) {
        if (op != BinaryOperator::Divide || !number || *number <= 1) return std::nullopt;
        const auto divisor = static_cast<uint32_t>(*number);
        if (!std::has_single_bit(divisor)) return std::nullopt;
        return std::countr_zero(divisor);
    }

    // All elements, in order.
    std::optional<Words> values(NodeId id) {
        Words words;
        for (int k = 0; k < tree_[id].size; ++k) {
            const Value word = value(id, k);
            if (!word) return std::nullopt;
            words.push_back(*word);
        }
        return words;
    }

    // ---- statements ----

    Flow block(NodeId id) {
        for (NodeId each = tree_[id].first; each != kNoNode; each = tree_[each].next) {
            const Flow flow = statement(each);
            if (flow != Flow::Next) return flow;
        }
        return Flow::Next;
    }

    Flow statement(NodeId id) {
        if (!has_step_left()) return Flow::Stop;
        if (is_empty(tree_, id))
            return Flow::Next;  // rules 8 to 10: not even the condition is left
        switch (tree_[id].kind) {
            case NodeKind::Assign:
            case NodeKind::Count:
                return assignment(id);
            case NodeKind::If:
                return if_from(tree_[id].first);
            case NodeKind::When:
                return when(id);
            case NodeKind::While:
                return loop(id);
            case NodeKind::For:
                return for_loop(id);
            case NodeKind::Emit:
                return emit(id);
            case NodeKind::Call:
                return call(id);
            case NodeKind::CallSub:
                return call_sub(id);
            case NodeKind::Return:
                return Flow::Return;
            default:
                break;
        }
        assert(false);
        return Flow::Stop;
    }

    // What element `k` of the left side becomes.
    Value assigned(NodeId id, int k) {
        const NodeId left = child(id, 0);
        if (tree_[id].kind == NodeKind::Count) {
            const Value old = value(left, k);
            if (!old) return std::nullopt;
            return run_binary(static_cast<BinaryOperator>(tree_[id].op), *old, 1);
        }
        const NodeId right = child(id, 1);
        if (tree_[id].op == kPlainAssignment) return value(right, k);
        if (const auto number = absorbed_compound(id, right, k)) return number;
        return binary(id, left, right, k);
    }

    // `x *= 0` is `x = x * 0`, in which x is not evaluated (rule 6).
    Value absorbed_compound(NodeId id, NodeId right, int k) const {
        const auto number = constant(tree_, right, k);
        if (!number) return std::nullopt;
        switch (static_cast<BinaryOperator>(tree_[id].op)) {
            case BinaryOperator::Multiply:
            case BinaryOperator::BitAnd:
                return *number == 0 ? Value(int16_t{0}) : std::nullopt;
            case BinaryOperator::BitOr:
                return *number == -1 ? Value(int16_t{-1}) : std::nullopt;
            default:
                return std::nullopt;
        }
    }

    bool store(NodeId left, int k, int16_t word) {
        if (tree_[left].kind != NodeKind::Element) {
            memory_[address(left) + static_cast<size_t>(k)] = word;
            return true;
        }
        const auto at = element_address(left);
        if (at) memory_[*at] = word;
        return at.has_value();
    }

    bool mentions(NodeId id, int32_t variable) const {
        const Node& node = tree_[id];
        const bool is_name = node.kind == NodeKind::Variable || node.kind == NodeKind::Element ||
                             node.kind == NodeKind::Slice;
        if (is_name && node.value == variable) return true;
        for (NodeId each = node.first; each != kNoNode; each = tree_[each].next)
            if (mentions(each, variable)) return true;
        return false;
    }

    // Section 4.4: element by element; but if the variable on the left occurs on the right, the
    // whole right side first.
    Flow assignment(NodeId id) {
        const NodeId left = child(id, 0);
        const bool is_plain =
            tree_[id].kind == NodeKind::Assign && tree_[id].op == kPlainAssignment;
        const bool overlaps = !is_plain || mentions(child(id, 1), tree_[left].value);
        Words words;
        for (int k = 0; k < tree_[left].size; ++k) {
            const Value word = assigned(id, k);
            if (!word) return Flow::Stop;
            words.push_back(*word);
            if (!overlaps && !store(left, k, *word)) return Flow::Stop;
        }
        for (int k = 0; overlaps && k < tree_[left].size; ++k)
            if (!store(left, k, words[static_cast<size_t>(k)])) return Flow::Stop;
        return Flow::Next;
    }

    // From a clause on, or the block of `else`.
    Flow if_from(NodeId clause) {
        if (clause == kNoNode) return Flow::Next;
        if (tree_[clause].kind == NodeKind::Block) return block(clause);
        if (is_if_empty(tree_, clause)) return Flow::Next;
        const Value condition = value(child(clause, 0), 0);
        if (!condition) return Flow::Stop;
        return *condition != 0 ? block(child(clause, 1)) : if_from(tree_[clause].next);
    }

    // Section 4.7. An always-true condition has no edge (rule 8).
    Flow when(NodeId id) {
        const NodeId condition = child(id, 0);
        if (constant(tree_, condition, 0)) return block(child(id, 1));
        const Value is_true = value(condition, 0);
        if (!is_true) return Flow::Stop;
        const bool was_true = when_[id];
        when_[id] = *is_true != 0;
        return *is_true != 0 && !was_true ? block(child(id, 1)) : Flow::Next;
    }

    Flow loop(NodeId id) {
        while (has_step_left()) {
            const Value condition = value(child(id, 0), 0);
            if (!condition) return Flow::Stop;
            if (*condition == 0) return Flow::Next;
            const Flow flow = block(child(id, 1));
            if (flow != Flow::Next) return flow;
        }
        return Flow::Stop;
    }

    Flow for_loop(NodeId id) {
        const NodeId variable = child(id, 0);
        const int32_t first = tree_[child(id, 1)].value;
        const int32_t last = tree_[child(id, 2)].value;
        const int32_t step = tree_[child(id, 3)].value;
        const NodeId body = child(id, 4);
        if (!store(variable, 0, static_cast<int16_t>(first))) return Flow::Stop;
        if (first == last) return block(body);
        while (has_step_left()) {
            const Value before = value(variable, 0);
            if (!before) return Flow::Stop;
            if (first > last ? *before < last : *before > last) return Flow::Next;
            const Flow flow = block(body);
            if (flow != Flow::Next) return flow;
            const Value after = value(variable, 0);
            if (!after) return Flow::Stop;
            if (!store(variable, 0, static_cast<int16_t>(*after + step))) return Flow::Stop;
        }
        return Flow::Stop;
    }

    Flow emit(NodeId id) {
        const auto event = static_cast<size_t>(tree_[id].value);
        Emission emission{during_, node_.common.events[event].name, {}};
        if (tree_[id].first != kNoNode) {
            auto words = values(tree_[id].first);
            if (!words) return Flow::Stop;
            emission.arguments = std::move(*words);
        }
        outcome_.emitted.push_back(std::move(emission));
        return Flow::Next;
    }

    // Section 4.8: a variable, slice or element is handed over itself, all else as a copy.
    bool add_argument(NodeId id, Words& copy, std::span<int16_t>& argument) {
        const auto size = static_cast<size_t>(tree_[id].size);
        const NodeKind kind = tree_[id].kind;
        if (kind == NodeKind::Variable || kind == NodeKind::Slice) {
            argument = std::span(memory_).subspan(address(id), size);
            return true;
        }
        if (kind == NodeKind::Element) {
            const auto at = element_address(id);
            if (at) argument = std::span(memory_).subspan(*at, 1);
            return at.has_value();
        }
        auto words = values(id);
        if (!words) return false;
        copy = std::move(*words);
        argument = std::span(copy);
        return true;
    }

    Flow call(NodeId id) {
        std::vector<NodeId> parts;
        for (NodeId each = tree_[id].first; each != kNoNode; each = tree_[each].next)
            parts.push_back(each);
        NativeArguments arguments(parts.size());
        std::vector<Words> copies(parts.size());
        for (size_t i = parts.size(); i-- > 0;)  // the last one is evaluated first
            if (!add_argument(parts[i], copies[i], arguments[i])) return Flow::Stop;
        const std::string& name = node_.target.natives[static_cast<size_t>(tree_[id].value)].name;
        const auto ending = call_native(name, arguments, random_state_);
        if (!ending) return Flow::Next;
        fault(id, *ending);
        return Flow::Stop;
    }

    Flow call_sub(NodeId id) {
        const TreeSub& sub = tree_.subs[static_cast<size_t>(tree_[id].value)];
        return block(tree_.sections[sub.section].block) == Flow::Stop ? Flow::Stop : Flow::Next;
    }

    const Tree& tree_;
    const NodeFile& node_;
    Outcome& outcome_;
    Words memory_;
    std::vector<bool> when_;  // by node: the last truth of a `when`
    uint16_t random_state_ = 0;
    size_t during_ = 0;
    int steps_ = 0;
};

// The number of a global or local event in bytecode; nothing if there is none of that name.
std::optional<int32_t> event_number(const NodeFile& node, const std::string& name) {
    for (size_t i = 0; i < node.target.local_events.size(); ++i)
        if (node.target.local_events[i].name == name)
            return static_cast<int32_t>(isa::kLocalEventFirst - i);
    for (size_t i = 0; i < node.common.events.size(); ++i)
        if (node.common.events[i].name == name) return static_cast<int32_t>(i);
    return std::nullopt;
}

size_t address_of(const Target& target, const std::string& name) {
    size_t address = 0;
    for (const NamedVariable& variable : target.variables) {
        if (variable.name == name) return address;
        address += variable.size;
    }
    assert(false);
    return address;
}

void apply(Machine& machine, const Stimulus& stimulus, size_t during, const NodeFile& node) {
    constexpr size_t kSourceAddress = 1;
    constexpr size_t kArgumentsAddress = 2;
    for (const auto& [name, words] : stimulus.set)
        machine.set(address_of(node.target, name), words);
    if (stimulus.event.empty()) return;
    if (stimulus.source) machine.set(kSourceAddress, {*stimulus.source});
    machine.set(kArgumentsAddress, stimulus.arguments);
    if (const auto number = event_number(node, stimulus.event))
        machine.start(during, SectionKind::Event, *number);
}

}  // namespace

Outcome evaluate(const Case& program, const NodeFile& node) {
    Outcome outcome;
    const CheckedTree checked = parse_and_check(program.source, node.target, node.common, {});
    if (!checked.errors.empty()) {
        const Diagnostic& first = checked.errors[checked.first];
        outcome.error = CompileError{without_guess(first.code), first.formal_place().line};
        return outcome;
    }
    for (const Section& section : checked.tree.sections)
        if (!outcome.error) outcome.error = folding_error(checked.tree, section.block);
    if (outcome.error) return outcome;
    Machine machine(checked.tree, node, outcome);
    machine.start(0, SectionKind::Init, 0);
    for (size_t i = 0; i < program.stimuli.size() && !machine.has_stopped(); ++i)
        apply(machine, program.stimuli[i], i + 1, node);
    machine.store_memory();
    return outcome;
}

}  // namespace vagus::aesl
