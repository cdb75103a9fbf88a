// Every name of a script and what it stands for: for editors that complete, rename, look up. Made
// from the tokens alone, so that a script that does not compile has mentions, too. All names of a
// script are in one scope.
//
//     for (const Mention& mention : mentions(source, common))
//         if (mention.kind == MentionKind::Event && mention.name == "ping") mark(mention);
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "aesl/diagnostic.hpp"
#include "aesl/target.hpp"

namespace vagus::aesl {

enum class MentionKind { Variable, Constant, Event, Sub, Native };

struct Mention {
    std::string name;
    MentionKind kind = MentionKind::Variable;
    bool declares = false;  // behind var, const, sub; events and natives are declared elsewhere
    bool handles = false;   // behind onevent
    Position at, end;       // end: one past the last character
    size_t offset = 0;      // of its first byte in the source
};

// In the order of the text. `common` tells constants from variables.
std::vector<Mention> mentions(std::string_view source, const CommonDefinitions& common);

// What may be written where a cursor is: the kind of name that its place asks for.
enum class Wanted {
    Statement,   // the beginning of a line: keywords, variables to assign to
    Expression,  // variables, constants
    Handler,     // behind onevent: local events and those of the project
    Emitted,     // behind emit: those of the project
    Sub,         // behind callsub
    Native,      // behind call
    NewName,     // behind var, const, sub: nothing to offer
    Comment,     // nothing either
};
struct Cursor {
    Wanted wanted = Wanted::Statement;
    size_t word_begin = 0;  // of the name that is being typed, which may be empty
    // The native whose arguments are being written, with the number of the argument from 0.
    std::string native;
    size_t argument = 0;
};
// `offset`: in bytes, at most the size of the source.
Cursor cursor_at(std::string_view source, size_t offset);

}  // namespace vagus::aesl
