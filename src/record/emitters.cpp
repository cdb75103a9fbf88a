#include "record/emitters.hpp"

#include <map>

#include "aesl/mentions.hpp"

namespace vagus::record {

using aesl::Mention;
using aesl::MentionKind;

Emitters emitters_of(const aesl::Script& script, const aesl::CommonDefinitions& common,
                     const std::string& event) {
    Emitters found;
    std::map<std::string, std::set<Section>> callers;  // by sub
    std::set<Section> open;
    Section here;
    for (const Mention& one : aesl::mentions(script.source, common)) {
        const bool sub = one.kind == MentionKind::Sub;
        if (one.kind == MentionKind::Event && one.handles) {
            here = {Section::Kind::Handler, one.name, one.at.line};
        } else if (sub && one.declares) {
            here = {Section::Kind::Sub, one.name, one.at.line};
        } else if (sub) {
            callers[one.name].insert(here);
        } else if (one.kind == MentionKind::Event && one.name == event) {
            found.lines.insert(one.at.line);
            open.insert(here);
        }
    }
    std::set<Section> seen;
    while (!open.empty()) {
        const Section one = open.extract(open.begin()).value();
        if (!seen.insert(one).second) continue;
        if (one.kind == Section::Kind::Sub) {
            open.insert(callers[one.name].begin(), callers[one.name].end());
        } else {
            found.sections.insert(one);
        }
    }
    return found;
}

}  // namespace vagus::record
