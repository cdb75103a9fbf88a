#include "aesl/types.hpp"

#include <algorithm>

#include "aesl/fix.hpp"
#include "aesl/scan.hpp"
#include "aesl/suggest.hpp"

namespace vagus::aesl {
namespace {

// Mixed: a list of both.
enum class Type { Number, Condition, Mixed, Unknown };

// Where conditions count as 0 or 1, and where they do not.
enum class Strictness { Strict, Lenient };

class TypeCheck {
public:
    TypeCheck(Tree& tree, const Target& target, Diagnostics& diagnostics)
        : tree_(tree), target_(target), diagnostics_(diagnostics) {}

    void block(NodeId id) {
        for (NodeId child = tree_[id].first; child != kNoNode; child = tree_[child].next) {
            statement(child);
        }
    }

private:
    void statement(NodeId id) {
        if (!tree_[id].bad) {
            failed_ = false;
            head(tree_[id]);
            tree_[id].bad = failed_;
        }
        for (NodeId child = tree_[id].first; child != kNoNode; child = tree_[child].next) {
            if (tree_[child].kind == NodeKind::Block) block(child);
            if (tree_[child].kind == NodeKind::Clause) statement(child);
        }
    }

    void head(const Node& node) {
        switch (node.kind) {
            case NodeKind::Assign:
                require(Type::Number, node.first, node.token, Strictness::Strict);
                require(Type::Number, tree_[node.first].next, node.token, Strictness::Strict);
                break;
            case NodeKind::Count:
            case NodeKind::For:
                type_of(node.first, Strictness::Strict);
                break;
            case NodeKind::Clause:
            case NodeKind::When:
            case NodeKind::While:
                require(Type::Condition, node.first, node.token, Strictness::Strict);
                break;
            case NodeKind::Emit:
            case NodeKind::Call:
                for (NodeId child = node.first; child != kNoNode; child = tree_[child].next) {
                    type_of(child, Strictness::Lenient);
                }
                break;
            case NodeKind::CallSub:
                if (node.value == kUnresolved) unknown_sub(node);
                break;
            default:
                break;
        }
    }

    // The first mistake in a statement ends its check.
    Type type_of(NodeId id, Strictness strictness) {
        if (failed_) return Type::Unknown;
        const Node& node = tree_[id];
        switch (node.kind) {
            case NodeKind::Number:
            case NodeKind::Variable:
            case NodeKind::Slice:
                return Type::Number;
            case NodeKind::Element:
                type_of(node.first, Strictness::Lenient);
                return Type::Number;
            case NodeKind::Tuple:
                return type_of_tuple(node, strictness);
            case NodeKind::Unary:
                require(Type::Number, node.first, node.token, strictness);
                return Type::Number;
            case NodeKind::Not:
                require(Type::Condition, node.first, node.token, strictness);
                return Type::Condition;
            case NodeKind::Binary: {
                const Type operands = is_logical(node.op) ? Type::Condition : Type::Number;
                require(operands, node.first, node.token, strictness);
                require(operands, tree_[node.first].next, node.token, strictness);
                const bool is_condition = is_logical(node.op) || is_comparison(node.op);
                return is_condition ? Type::Condition : Type::Number;
            }
            default:
                return Type::Unknown;
        }
    }

    // That of its elements: lists vanish when vectors are expanded.
    Type type_of_tuple(const Node& node, Strictness strictness) {
        Type common = Type::Unknown;
        for (NodeId child = node.first; child != kNoNode; child = tree_[child].next) {
            const Type type = type_of(child, strictness);
            if (type == Type::Unknown) return Type::Unknown;
            common = common == Type::Unknown || common == type ? type : Type::Mixed;
        }
        return common;
    }

    // At the operator or keyword that needs the type, not at the operand that lacks it.
    void require(Type wanted, NodeId operand, TokenId at, Strictness strictness) {
        const Type found = type_of(operand, strictness);
        if (failed_ || found == Type::Unknown || found == wanted) return;
        if (wanted == Type::Number && strictness == Strictness::Lenient) return;
        if (wanted == Type::Number)
            return report(Diag::NumberExpected, at, {shown(tree_.text(at))});
        report(Diag::ConditionExpected, at, {shown(tree_.text(at))}, {.fix = compared(operand)});
    }

    // Each unknown sub is reported once.
    void unknown_sub(const Node& node) {
        failed_ = true;
        const std::string_view name = tree_.text(node.token + 1);
        const bool is_known =
            std::find(unknown_subs_.begin(), unknown_subs_.end(), name) != unknown_subs_.end();
        if (is_known || diagnostics_.full()) return;
        unknown_subs_.push_back(name);
        std::vector<std::string_view> candidates;
        for (const TreeSub& sub : tree_.subs) candidates.push_back(sub.name);
        const std::string similar = shown(closest(name, candidates));
        const bool is_native =
            std::any_of(target_.natives.begin(), target_.natives.end(),
                        [name](const NativeFunction& native) { return native.name == name; });
        const Diag what = is_native         ? Diag::NativeNotSub
                          : similar.empty() ? Diag::UnknownSub
                                            : Diag::UnknownSubGuess;
        const Mark place = mark_of(tree_.source, tree_.tokens[node.token + 1]);
        report(what, node.token, {shown(name), similar},
               {.fix = what == Diag::UnknownSubGuess ? std::optional(replacing(place, similar))
                                                     : std::nullopt});
    }

    // `if near then` means `if near != 0 then`.
    std::optional<Fix> compared(NodeId operand) const {
        if (tree_[operand].kind != NodeKind::Variable) return std::nullopt;
        const Mark name = mark_of(tree_.source, tree_.token_of(operand));
        return inserting(name.end, " != 0");
    }

    void report(Diag what, TokenId token, std::initializer_list<std::string_view> words,
                Extra extra = {}) {
        failed_ = true;
        diagnostics_.report(what, mark_of(tree_.source, tree_.tokens[token]), words,
                            std::move(extra));
    }

    Tree& tree_;
    const Target& target_;
    Diagnostics& diagnostics_;
    std::vector<std::string_view> unknown_subs_;
    bool failed_ = false;
};

}  // namespace

void check_types(Tree& tree, const Target& target, Diagnostics& diagnostics) {
    TypeCheck check(tree, target, diagnostics);
    for (const Section& section : tree.sections) check.block(section.block);
}

}  // namespace vagus::aesl
