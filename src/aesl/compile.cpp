// The map of the compiler: the phases in their order, each a value in and a value out
// (docs/spec/aesl-language.md, section 3.2).
//
//     text → scan → tokens → parse → tree → check_sizes, check_places, check_types
//     tree → emit → sections of code → check_stack, link → Program
#include "aesl/compile.hpp"

#include <algorithm>

#include "aesl/emit.hpp"
#include "aesl/limits.hpp"
#include "aesl/link.hpp"
#include "aesl/parse.hpp"
#include "aesl/places.hpp"
#include "aesl/scan.hpp"
#include "aesl/sizes.hpp"
#include "aesl/stack.hpp"
#include "aesl/types.hpp"
#include "aesl/warn.hpp"

namespace vagus::aesl {
namespace {

// Phase 0, and what would not fit the compiler itself. False if there is nothing to go on with.
bool check_input(std::string_view source, const Target& target, Diagnostics& diagnostics) {
    int64_t words = 0;
    for (const NamedVariable& variable : target.variables) words += variable.size;
    const int64_t room = std::min<int64_t>(target.variables_size, kAddressableWords);
    if (words > room) {
        diagnostics.report(Diag::BrokenTarget, {},
                           {shown(target.name), std::to_string(words), std::to_string(room)});
        return false;
    }
    if (source.size() > kSourceBytesMax) {
        diagnostics.report(Diag::SourceTooBig, {},
                           {std::to_string(source.size()), std::to_string(kSourceBytesMax)});
        return false;
    }
    if (std::count(source.begin(), source.end(), '\n') >= kSourceLinesMax) {
        diagnostics.report(Diag::TooManyLines, {}, {std::to_string(kSourceLinesMax)});
        return false;
    }
    return true;
}

void check_tree(Tree& tree, const Target& target, Diagnostics& diagnostics) {
    if (tree.is_partial) return;
    check_sizes(tree, diagnostics);
    check_places(tree, diagnostics);
    check_types(tree, target, diagnostics);
}

}  // namespace

Compilation compile(std::string_view source, const Target& target, const CommonDefinitions& common,
                    const Options& options) {
    Diagnostics diagnostics(options.first_line);
    Compilation done;
    const auto failed = [&diagnostics] { return diagnostics.errors_found() > 0; };
    if (check_input(source, target, diagnostics)) {
        Tree tree = parse(source, target, common, options, diagnostics);
        check_tree(tree, target, diagnostics);
        if (!tree.is_partial) {
            const Code code = emit(tree, target, diagnostics);
            const int32_t stack = failed() ? 0 : check_stack(tree, code, target, diagnostics);
            if (!failed()) done.program = link(tree, code, target, diagnostics);
            if (!failed()) warn(tree, diagnostics);
            done.program.used.stack = static_cast<uint16_t>(stack);
        }
    }
    if (failed()) done.program = {};
    done.first = diagnostics.first_of();
    done.errors = diagnostics.take_errors();
    if (done.ok()) done.warnings = diagnostics.take_warnings();
    return done;
}

CheckedTree parse_and_check(std::string_view source, const Target& target,
                            const CommonDefinitions& common, const Options& options) {
    Diagnostics diagnostics(options.first_line);
    CheckedTree checked;
    if (check_input(source, target, diagnostics)) {
        checked.tree = parse(source, target, common, options, diagnostics);
        check_tree(checked.tree, target, diagnostics);
    }
    checked.first = diagnostics.first_of();
    checked.errors = diagnostics.take_errors();
    return checked;
}

}  // namespace vagus::aesl
