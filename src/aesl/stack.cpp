#include "aesl/stack.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "aesl/scan.hpp"

namespace vagus::aesl {
namespace {

struct StackNeed {
    int32_t words = 0;
    int32_t line = 0;  // where the stack is deepest
};

// A sub that calls one of those on the way to it, perhaps itself.
struct Circle {
    size_t caller = 0;
    size_t callee = 0;
};

// The `callsub` by which a circle closes; the header of the sub if folding has removed it.
Mark place_of(const Circle& circle, const Tree& tree) {
    const TokenId header = tree.subs[circle.caller].token;
    TokenId end = static_cast<TokenId>(tree.tokens.size());
    for (const Section& section : tree.sections)
        if (section.token > header) end = std::min(end, section.token);
    TokenId call = header;
    for (const Node& node : tree.nodes) {
        const bool is_it = node.kind == NodeKind::CallSub && node.token > header &&
                           node.token < end && node.value == static_cast<int32_t>(circle.callee);
        if (is_it && (call == header || node.token < call)) call = node.token;
    }
    return {mark_of(tree.source, tree.tokens[call]).at,
            mark_of(tree.source, tree.tokens[call + 1]).end};
}

class StackCheck {
public:
    StackCheck(const Tree& tree, const Code& code)
        : tree_(tree), code_(code), needs_(tree.subs.size()), is_open_(tree.subs.size(), false) {}

    // What a section needs, its subs being known.
    StackNeed need_of(size_t section) const {
        const CodeSection& code = code_.sections[section];
        StackNeed need{code.depth, code.deepest_line};
        for (const CodeCall& call : code.calls) {
            const auto sub = static_cast<size_t>(call.sub);
            const StackNeed inner = needs_[sub].value_or(StackNeed{});
            if (inner.words + 1 <= need.words) continue;
            need = {inner.words + 1, inner.line == 0 ? call.line : inner.line};
        }
        return need;
    }

    // Depth first over the calls, without recursion: a chain of calls may be as long as the
    // program. Gives a call that leads back to where it came from, if there is one.
    std::optional<Circle> resolve(size_t root) {
        if (needs_[root]) return std::nullopt;
        std::vector<Visit> path{{root, 0}};
        is_open_[root] = true;
        while (!path.empty()) {
            Visit& visit = path.back();
            const auto& calls = code_.sections[tree_.subs[visit.sub].section].calls;
            if (visit.next_call == calls.size()) {
                needs_[visit.sub] = need_of(tree_.subs[visit.sub].section);
                is_open_[visit.sub] = false;
                path.pop_back();
                continue;
            }
            const auto callee = static_cast<size_t>(calls[visit.next_call++].sub);
            if (is_open_[callee]) return Circle{visit.sub, callee};
            if (needs_[callee]) continue;
            is_open_[callee] = true;
            path.push_back({callee, 0});
        }
        return std::nullopt;
    }

private:
    struct Visit {
        size_t sub;
        size_t next_call;
    };

    const Tree& tree_;
    const Code& code_;
    std::vector<std::optional<StackNeed>> needs_;
    std::vector<bool> is_open_;  // on the path to the sub that is being resolved
};

}  // namespace

int32_t check_stack(const Tree& tree, const Code& code, const Target& target,
                    Diagnostics& diagnostics) {
    StackCheck check(tree, code);
    for (size_t sub = 0; sub < tree.subs.size(); ++sub) {
        const auto circle = check.resolve(sub);
        if (!circle) continue;
        const TreeSub& found = tree.subs[circle->callee];
        const std::string through =
            circle->caller == circle->callee
                ? ""
                : " through \"" + shown(tree.subs[circle->caller].name) + "\"";
        // The reference gives no position (section 3.8), so neither does `exec`.
        diagnostics.report(
            Diag::Recursion, place_of(*circle, tree),
            {shown(found.name), diagnostics.line_text(tree.tokens[found.token].line), through},
            {.formal = Position{}});
        return 0;
    }
    StackNeed deepest;
    for (size_t i = 0; i < code.sections.size(); ++i) {
        const StackNeed need = check.need_of(i);
        if (need.words > deepest.words) deepest = need;
    }
    if (deepest.words > target.stack_size) {
        diagnostics.report(Diag::StackOverflow, {},
                           {std::to_string(deepest.words), std::to_string(target.stack_size),
                            diagnostics.line_text(deepest.line)});
    }
    return deepest.words;
}

}  // namespace vagus::aesl
