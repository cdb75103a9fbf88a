#include "aesl/stack.hpp"

#include <optional>
#include <vector>

#include "aesl/scan.hpp"

namespace vagus::aesl {
namespace {

struct Need {
    int32_t words = 0;
    int32_t line = 0;  // where the stack is deepest
};

class StackCheck {
public:
    StackCheck(const Tree& tree, const Code& code)
        : tree_(tree), code_(code), needs_(tree.subs.size()), is_open_(tree.subs.size(), false) {}

    // What a section needs, its subs being known.
    Need need_of(size_t section) const {
        const CodeSection& code = code_.sections[section];
        Need need{code.depth, code.deepest_line};
        for (const CodeCall& call : code.calls) {
            const auto sub = static_cast<size_t>(call.sub);
            const Need inner = needs_[sub].value_or(Need{});
            if (inner.words + 1 <= need.words) continue;
            need = {inner.words + 1, inner.line == 0 ? call.line : inner.line};
        }
        return need;
    }

    // Depth first over the calls, without recursion: a chain of calls may be as long as the
    // program. Gives a sub that calls itself, if there is one.
    std::optional<size_t> resolve(size_t root) {
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
            if (is_open_[callee]) return callee;
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
    std::vector<std::optional<Need>> needs_;
    std::vector<bool> is_open_;  // on the path to the sub that is being resolved
};

}  // namespace

int32_t check_stack(const Tree& tree, const Code& code, const Target& target,
                    Diagnostics& diagnostics) {
    StackCheck check(tree, code);
    for (size_t sub = 0; sub < tree.subs.size(); ++sub) {
        const auto recursive = check.resolve(sub);
        if (!recursive) continue;
        const TreeSub& found = tree.subs[*recursive];
        diagnostics.report(Diag::Recursion, {},
                           {shown(found.name), std::to_string(tree.tokens[found.token].line)});
        return 0;
    }
    Need deepest;
    for (size_t i = 0; i < code.sections.size(); ++i) {
        const Need need = check.need_of(i);
        if (need.words > deepest.words) deepest = need;
    }
    if (deepest.words > target.stack_size) {
        diagnostics.report(Diag::StackOverflow, {},
                           {std::to_string(deepest.words), std::to_string(target.stack_size),
                            std::to_string(deepest.line)});
    }
    return deepest.words;
}

}  // namespace vagus::aesl
