// A formula (docs/formulas.md) that may also ask for words of nodes: what tests of behaviour and
// the fleet of a project are conditions in.
//
//     const WordFormula near = TRY(WordFormula::parse("speed < 2 and node('drive', 'token') > 0"));
//     for (const WordFormula::Name& name : near.names()) values.push_back(read(name));
//     const Result<bool> holds = near.holds(values);
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "plan/formula.hpp"
#include "plan/value.hpp"

namespace vagus::plan {

class WordFormula {
public:
    // What a name in it stands for.
    struct Name {
        enum class Of : uint8_t {
            Unknown,   // whoever knows what names there are decides
            Variable,  // of the plan: variable("angle")
            Word       // of a node: node("drive", "sectors[3]")
        };
        std::string shown;  // as it is written
        Of of = Of::Unknown;
        std::string variable = {};  // of the plan, or of the node
        std::string node = {};
        uint16_t element = 0;  // of the node's array
    };

    // The Error says what is wrong with the text, without a place in a file.
    static Result<WordFormula> parse(std::string_view text);

    const std::string& text() const { return text_; }
    const std::vector<Name>& names() const { return names_; }
    // As those of Formula: with the types, or the values, of names(), in that order.
    Result<Type> type(std::span<const Type> types) const { return formula_.type(types); }
    Result<bool> holds(std::span<const Value> values) const;
    // As that of Formula; ComparedText::name is an index of names().
    std::vector<Formula::ComparedText> compared_texts() const { return formula_.compared_texts(); }

private:
    WordFormula(std::string text, Formula formula)
        : text_(std::move(text)), formula_(std::move(formula)) {}

    std::string text_;
    Formula formula_;
    std::vector<Name> names_;
};

}  // namespace vagus::plan
